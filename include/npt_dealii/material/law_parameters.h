// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what a law has to know of parameter files: its entries, their checks,
// and the law that they make.

#ifndef npt_dealii_material_law_parameters_h
#define npt_dealii_material_law_parameters_h

#include <npt_dealii/base/registry.h>
#include <npt_dealii/material/hyperelastic_law.h>

#include <deal.II/base/tensor.h>

#include <functional>
#include <memory>
#include <string>

namespace dealii
{
  class ParameterHandler;
}

namespace NPT
{
  /**
   * The constants of one law as a parameter file gives them. A law derives its
   * own struct and registers it at the end of its file, see neo_hookean.cc;
   * nothing else has to be edited.
   */
  class LawParameters
  {
  public:
    virtual ~LawParameters() = default;

    virtual std::unique_ptr<LawParameters>
    clone() const = 0;

    /// Bind the constants to entries of the present subsection. All laws share
    /// it, so names must be their own.
    virtual void
    add_parameters(dealii::ParameterHandler &prm) = 0;

    /// Throws InputError for constants with which the law is no stable solid
    /// at rest.
    virtual void
    check(const std::string &subsection) const = 0;

    /// @param fiber_direction Unit vector in the reference configuration;
    ///   isotropic laws ignore it.
    virtual std::unique_ptr<HyperelasticLaw<2>>
    make_law(const dealii::Tensor<1, 2> &fiber_direction) const = 0;

    virtual std::unique_ptr<HyperelasticLaw<3>>
    make_law(const dealii::Tensor<1, 3> &fiber_direction) const = 0;
  };



  /// A law that a parameter file selects by its name in
  /// Registry<RegisteredLaw>.
  struct RegisteredLaw
  {
    /// For the text of the entry Law: "the isotropic neo-Hookean law, Eq. (51)"
    std::string description;

    std::function<std::unique_ptr<LawParameters>()> make_parameters;
  };
} // namespace NPT

#endif
