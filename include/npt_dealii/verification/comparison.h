// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the comparison of a computed quantity with its exact value, and the
// tolerance that it may miss.

#ifndef npt_dealii_verification_comparison_h
#define npt_dealii_verification_comparison_h

#include <npt_dealii/base/exceptions.h>

#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace NPT
{
  /// Some quantity of a benchmark is farther from its exact value than allowed.
  /// All results are on disk then.
  class ToleranceMissed : public StageFailed
  {
  public:
    explicit ToleranceMissed(const std::string &message)
      : StageFailed(message, "tolerance missed")
    {}
  };



  /// What a benchmark will say of a quantity.
  struct ComparedQuantity
  {
    std::string name; ///< "peak pressure"
    std::string unit;
    /// Whether there is an exact value; else it is only reported.
    bool has_exact_value = true;
  };

  /// Largest allowed errors by quantity; those without are not judged.
  using Tolerances = std::map<std::string, double>;

  /// Nothing for "none"; a number >= 0, or one in per cent. Throws InputError
  /// with entry and subsection for another text.
  std::optional<double>
  parse_tolerance(const std::string &value,
                  const std::string &entry,
                  const std::string &subsection);

  /// A quantity as the name of an entry: "Peak pressure"; a slash, which means
  /// a subsection to the option --set, becomes "over".
  std::string
  tolerance_entry(const std::string &quantity);

  /// Declare the entries of subsection "Tolerances", one per quantity with an
  /// exact value; default "none".
  void
  declare_tolerances(dealii::ParameterHandler            &prm,
                     const std::vector<ComparedQuantity> &quantities);

  Tolerances
  parse_tolerances(dealii::ParameterHandler            &prm,
                   const std::vector<ComparedQuantity> &quantities);



  /// A computed quantity beside its exact value.
  struct Comparison
  {
    std::string quantity;
    std::string unit;
    double      computed = 0;
    /// Nothing: only reported.
    std::optional<double> exact;
    /// Largest allowed |error()|; nothing: not judged.
    std::optional<double> allowed;

    /// Relative error [-]; where zero is exact, the computed value itself; zero
    /// without an exact value.
    double
    error() const
    {
      if (!exact)
        return 0.;
      return *exact == 0. ? computed : (computed - *exact) / std::abs(*exact);
    }

    /// Not a number misses every tolerance.
    bool
    is_missed() const
    {
      return allowed && !(std::abs(error()) <= *allowed);
    }

    /// "peak pressure is 13.5 MPa, exact 14 MPa: off by -3.6 %, allowed 1 %".
    std::string
    sentence() const;
  };

  /// Throws ToleranceMissed with one sentence that names all quantities that
  /// miss their tolerance.
  void
  judge(const std::vector<Comparison> &comparisons);

  /// Write comparison.csv: quantity, unit, computed, exact, error, allowed;
  /// cells without a value are empty.
  void
  write_comparisons(const std::string             &filename,
                    const std::vector<Comparison> &comparisons);
} // namespace NPT

#endif
