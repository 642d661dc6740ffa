// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the material entries of a parameter file and the step from them to a
// law.

#ifndef npt_dealii_material_make_material_h
#define npt_dealii_material_make_material_h

#include <npt_dealii/material/fiber_bundle_law.h>
#include <npt_dealii/material/hyperelastic_law.h>
#include <npt_dealii/material/neo_hookean.h>

#include <deal.II/base/tensor.h>

#include <memory>
#include <string>

namespace dealii
{
  class ParameterHandler;
}

namespace NPT
{
  /**
   * One material of a parameter file: which law, and its constants. Several
   * materials are several objects of this type with subsections of their own.
   */
  struct MaterialParameters
  {
    enum class Law
    {
      fiber_bundle,
      neo_hookean
    };

    Law                  law = Law::fiber_bundle;
    FiberBundleConstants fiber_bundle;             ///< (51), (52) [MPa]
    double               young_modulus     = 100.; ///< neo-Hookean [MPa]
    double               poisson_ratio     = 0.3;  ///< neo-Hookean [-]
    VolumetricEnergy     volumetric_energy = VolumetricEnergy::logarithm;

    /**
     * @param same_as Name of another material; not empty: the entry Law has
     *   the further choice "as NAME", which is its default.
     */
    static void
    declare_parameters(dealii::ParameterHandler &prm,
                       const std::string &subsection = "Fiber bundle material",
                       const std::string &same_as    = "");

    /**
     * Read the entries and check those of the selected law.
     *
     * @param other The material that Law = as NAME refers to, or none.
     *
     * Throws InputError if the small-strain stiffness is not positive
     * definite, if Young's modulus or Poisson's ratio is out of range, or if
     * constants are given that the law "as NAME" would ignore.
     */
    void
    parse_parameters(dealii::ParameterHandler &prm,
                     const std::string &subsection   = "Fiber bundle material",
                     const MaterialParameters *other = nullptr);
  };

  /**
   * Make the law that the parameters select.
   *
   * @param fiber_direction Unit vector in the reference configuration; ignored
   *   by isotropic laws.
   */
  template <int dim>
  std::unique_ptr<HyperelasticLaw<dim>>
  make_material(const MaterialParameters     &parameters,
                const dealii::Tensor<1, dim> &fiber_direction);
} // namespace NPT

#endif
