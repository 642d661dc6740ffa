// SPDX-License-Identifier: LGPL-2.1-or-later
// Friction coefficient by angle and slip.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/short_number.h>
#include <npt_dealii/contact/friction_coefficient.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace NPT
{
  namespace
  {
    double
    number_of_table(const std::string &text, const std::string &pair)
    {
      const std::string trimmed = dealii::Utilities::trim(text);
      char             *end     = nullptr;
      const double      value   = std::strtod(trimmed.c_str(), &end);
      if (trimmed.empty() || *end != '\0' || !std::isfinite(value))
        throw InputError("Coefficient by angle has '" +
                         dealii::Utilities::trim(pair) +
                         "', which is no pair 'angle: coefficient' such as "
                         "'45: 0.27' (subsection Friction).");
      return value;
    }
  } // namespace



  std::string
  EntryValue<FrictionTable>::text(const FrictionTable &table)
  {
    std::string result;
    for (const auto &[angle, mu] : table.values)
      result += (result.empty() ? "" : ", ") + EntryValue<double>::text(angle) +
                ": " + EntryValue<double>::text(mu);
    return result;
  }



  FrictionTable
  EntryValue<FrictionTable>::value(const std::string &text)
  {
    FrictionTable table;
    for (const std::string &pair : split_list(text))
      {
        const std::size_t colon = pair.find(':');
        const double      angle = number_of_table(pair.substr(0, colon), pair),
                     mu         = number_of_table(colon == std::string::npos ?
                                            "" :
                                            pair.substr(colon + 1),
                                          pair);
        const std::string here = "Coefficient by angle has ";
        if (!(angle >= 0. && angle <= 90.))
          throw InputError(here + "the angle " + short_number(angle) +
                           "; the angle between two fibers is from 0 to 90 "
                           "degrees (subsection Friction).");
        if (!table.values.empty() && !(angle > table.values.back().first))
          throw InputError(here + "the angle " + short_number(angle) +
                           " behind " +
                           short_number(table.values.back().first) +
                           "; angles must rise from pair to pair (subsection "
                           "Friction).");
        if (!(mu >= 0.))
          throw InputError(here + "the coefficient " + short_number(mu) +
                           " at " + short_number(angle) +
                           " degrees; it must be >= 0 (subsection Friction).");
        table.values.emplace_back(angle, mu);
      }
    return table;
  }



  std::unique_ptr<dealii::Patterns::PatternBase>
  EntryValue<FrictionTable>::pattern()
  {
    namespace Patterns = dealii::Patterns;
    return std::make_unique<Patterns::Map>(Patterns::Double(0., 90.),
                                           Patterns::Double(0.));
  }



  FrictionCoefficient::FrictionCoefficient(const FrictionParameters &parameters)
    : coefficient_(parameters.coefficient)
    , ratio_(parameters.dynamic_ratio)
    , slip_length_(parameters.slip_length)
    , by_angle_(parameters.by_angle.values)
  {
    Assert(!varies() || coefficient_ > 0.,
           dealii::ExcMessage("mu is a multiple of a coefficient > 0"));
  }



  double
  FrictionCoefficient::static_factor(const double cosine) const
  {
    if (by_angle_.empty())
      return 1.;
    const double angle =
      std::acos(std::clamp(cosine, 0., 1.)) * 180. / dealii::numbers::PI;
    const auto next =
      std::find_if(by_angle_.begin(), by_angle_.end(), [&](const auto &pair) {
        return pair.first >= angle;
      });
    if (next == by_angle_.end())
      return by_angle_.back().second / coefficient_;
    if (next == by_angle_.begin())
      return next->second / coefficient_;
    const auto  &before = *(next - 1);
    const double share  = (angle - before.first) / (next->first - before.first);
    // The same bits where neighbors are equal.
    return (before.second + share * (next->second - before.second)) /
           coefficient_;
  }



  double
  FrictionCoefficient::decay(const double slip_path) const
  {
    return ratio_ + (1. - ratio_) * std::exp(-slip_path / slip_length_);
  }



  double
  FrictionCoefficient::slip_of_step(const double dissipation,
                                    const double law_pressure) const
  {
    const double limit = coefficient_ * law_pressure;
    return limit > 0. ? dissipation / limit : 0.;
  }
} // namespace NPT
