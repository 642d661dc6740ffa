// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the material entries of a parameter file and the step from them to a
// law.

#ifndef npt_dealii_material_make_material_h
#define npt_dealii_material_make_material_h

#include <npt_dealii/material/fiber_bundle_law.h>
#include <npt_dealii/material/hyperelastic_law.h>
#include <npt_dealii/material/law_parameters.h>
#include <npt_dealii/material/neo_hookean.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/tensor.h>

#include <map>
#include <memory>
#include <string>
#include <utility>

namespace NPT
{
  /**
   * One material of a parameter file: which law, and the constants of all laws
   * that are registered. Several materials are several objects of this type
   * with subsections of their own.
   */
  class MaterialParameters
  {
  public:
    /// A name of Registry<RegisteredLaw>, or "as NAME" until check() puts the
    /// material of that name in its place.
    std::string law;

    explicit MaterialParameters(const std::string &law = "fiber bundle");
    MaterialParameters(const MaterialParameters &other);
    MaterialParameters &
    operator=(const MaterialParameters &other);

    /// The constants of a law by the type of its parameters, as in
    /// `material.constants<NeoHookeanParameters>().young_modulus`, whether it
    /// is the selected law or not.
    template <typename Parameters>
    const Parameters &
    constants() const
    {
      const Parameters *found = nullptr;
      for (const auto &item : constants_)
        if (!found)
          found = dynamic_cast<const Parameters *>(item.second.get());
      AssertThrow(found, dealii::ExcMessage("The law is not registered."));
      return *found;
    }

    template <typename Parameters>
    Parameters &
    constants()
    {
      return const_cast<Parameters &>(
        std::as_const(*this).template constants<Parameters>());
    }

    /// The same for the selected law; null if that is another one.
    template <typename Parameters>
    const Parameters *
    selected() const
    {
      const auto found = constants_.find(law);
      return found == constants_.end() ?
               nullptr :
               dynamic_cast<const Parameters *>(found->second.get());
    }

    /// Of the selected law; throws InputError if there is none of this name.
    const LawParameters &
    selected_constants() const;

    /**
     * Bind law and constants to the entries of a subsection.
     *
     * @param same_as Name of another material; not empty: the entry Law has
     *   the further choice "as NAME".
     */
    void
    add_parameters(dealii::ParameterHandler &prm,
                   const std::string &subsection = "Fiber bundle material",
                   const std::string &same_as    = "");

    /**
     * Check the constants of the selected law.
     *
     * @param other The material that Law = as NAME refers to, whose copy this
     *   one then becomes, or none.
     *
     * Throws InputError if the small-strain stiffness is not positive
     * definite, if Young's modulus or Poisson's ratio is out of range, or if
     * constants are given that the law "as NAME" would ignore.
     */
    void
    check(const std::string        &subsection = "Fiber bundle material",
          const MaterialParameters *other      = nullptr);

  private:
    /// The first constant that is not the default, or empty.
    std::string
    first_changed_constant() const;

    std::map<std::string, std::unique_ptr<LawParameters>> constants_;
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
                const dealii::Tensor<1, dim> &fiber_direction)
  {
    return parameters.selected_constants().make_law(fiber_direction);
  }
} // namespace NPT

#endif
