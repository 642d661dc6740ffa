// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the list of what a contact benchmark has compared with its exact
// solution, and the profile that is drawn.

#ifndef npt_dealii_verification_contact_contact_comparisons_h
#define npt_dealii_verification_contact_contact_comparisons_h

#include <npt_dealii/verification/comparison.h>

#include <array>
#include <string>
#include <vector>

namespace NPT
{
  class ContactComparisons
  {
  public:
    /// @param quantities All that will be compared or reported.
    ContactComparisons(const std::vector<ComparedQuantity> &quantities,
                       const Tolerances                    &tolerances);

    /// The quantity must be one of those of the constructor and have an exact
    /// value.
    void
    compare(const std::string &quantity,
            const double       computed,
            const double       exact);

    /// A quantity without an exact value.
    void
    report(const std::string &quantity, const double computed);

    /// Abscissa, computed, exact; sorted by the abscissa unless @p in_order.
    void
    set_profile(const std::string                 &x_name,
                const std::string                 &y_name,
                std::vector<std::array<double, 3>> rows,
                const bool                         in_order = false);

    const std::vector<Comparison> &
    list() const
    {
      return list_;
    }

    /// Throws dealii::ExcMessage if there is no such quantity.
    const Comparison &
    get(const std::string &quantity) const;

    /// Throws dealii::ExcMessage if a declared quantity was never compared: its
    /// tolerance would mean nothing.
    void
    check_complete() const;

    /// Write comparison.csv and, if there is a profile, profile.csv with its
    /// gnuplot script profile.gp.
    void
    write(const std::string &directory) const;

  private:
    const ComparedQuantity &
    declared(const std::string &quantity) const;

    const std::vector<ComparedQuantity> quantities_;
    const Tolerances                    tolerances_;
    std::vector<Comparison>             list_;
    std::string                         x_name_, y_name_;
    std::vector<std::array<double, 3>>  profile_;
  };



  /// Relative L2 difference of a field from its exact values, which may be
  /// zero outside of the contact.
  class ProfileError
  {
  public:
    void
    add(const double area, const double computed, const double exact)
    {
      difference_ += area * (computed - exact) * (computed - exact);
      size_ += area * exact * exact;
    }
    double
    value() const
    {
      return std::sqrt(difference_ / size_);
    }

  private:
    double difference_ = 0, size_ = 0;
  };
} // namespace NPT

#endif
