// SPDX-License-Identifier: LGPL-2.1-or-later
// The list of comparisons, and the files that show it.

#include <npt_dealii/io/replace_file.h>
#include <npt_dealii/io/table_file.h>
#include <npt_dealii/verification/contact/contact_comparisons.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace NPT
{
  ContactComparisons::ContactComparisons(
    const std::vector<ComparedQuantity> &quantities,
    const Tolerances                    &tolerances)
    : quantities_(quantities)
    , tolerances_(tolerances)
  {}



  const ComparedQuantity &
  ContactComparisons::declared(const std::string &quantity) const
  {
    const auto found = std::find_if(quantities_.begin(),
                                    quantities_.end(),
                                    [&](const ComparedQuantity &item) {
                                      return item.name == quantity;
                                    });
    AssertThrow(found != quantities_.end(),
                dealii::ExcMessage("'" + quantity +
                                   "' is none of the quantities of its case."));
    return *found;
  }



  void
  ContactComparisons::compare(const std::string &quantity,
                              const double       computed,
                              const double       exact)
  {
    const ComparedQuantity &item = declared(quantity);
    Assert(item.has_exact_value, dealii::ExcInternalError());
    Comparison comparison{item.name, item.unit, computed, exact, {}};
    const auto tolerance = tolerances_.find(quantity);
    if (tolerance != tolerances_.end())
      comparison.allowed = tolerance->second;
    list_.push_back(comparison);
  }



  void
  ContactComparisons::report(const std::string &quantity, const double computed)
  {
    const ComparedQuantity &item = declared(quantity);
    Assert(!item.has_exact_value, dealii::ExcInternalError());
    list_.push_back({item.name, item.unit, computed, {}, {}});
  }



  void
  ContactComparisons::set_profile(const std::string                 &x_name,
                                  const std::string                 &y_name,
                                  std::vector<std::array<double, 3>> rows,
                                  const bool                         in_order)
  {
    if (!in_order)
      std::sort(rows.begin(), rows.end());
    x_name_  = x_name;
    y_name_  = y_name;
    profile_ = std::move(rows);
  }



  const Comparison &
  ContactComparisons::get(const std::string &quantity) const
  {
    const auto found =
      std::find_if(list_.begin(), list_.end(), [&](const Comparison &item) {
        return item.quantity == quantity;
      });
    AssertThrow(found != list_.end(),
                dealii::ExcMessage("There is no comparison of '" + quantity +
                                   "'."));
    return *found;
  }



  void
  ContactComparisons::check_complete() const
  {
    for (const ComparedQuantity &quantity : quantities_)
      get(quantity.name);
  }



  void
  ContactComparisons::write(const std::string &directory) const
  {
    write_comparisons(directory + "/comparison.csv", list_);
    if (profile_.empty())
      return;
    TableWriter table(directory + "/profile.csv",
                      {x_name_, "computed " + y_name_, "exact " + y_name_});
    for (const auto &row : profile_)
      table.add_row({row[0], row[1], row[2]});
    replace_file(directory + "/profile.gp", [&](std::ostream &out) {
      out << "# Draws profile.csv to profile.svg. Run `gnuplot` in this "
             "folder.\n"
             "set datafile separator comma\n"
             "set datafile columnheaders\n"
             "set terminal svg size 640,420 font 'sans-serif,13' background "
             "'white' dynamic\n"
             "set output 'profile.svg'\n"
             "set grid linecolor rgb '#dddddd' linetype 1 linewidth 1\n"
             "set tics nomirror out\n"
             "set format '%g'\n"
             "set key top right\n"
          << "set xlabel '" << x_name_ << "'\n"
          << "set ylabel '" << y_name_ << "'\n"
          << "plot 'profile.csv' using 1:3 with lines linewidth 2 linecolor "
             "rgb '#d55e00' title 'exact', '' using 1:2 with points pointtype "
             "7 pointsize 0.5 linecolor rgb '#0072b2' title 'computed'\n";
    });
  }
} // namespace NPT
