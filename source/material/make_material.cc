// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the material subsection of a parameter file: entries, checks, and the
// choice of the law.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/material/make_material.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>

#include <sstream>
#include <utility>

namespace NPT
{
  namespace
  {
    void
    check_stiffness(const FiberBundleConstants &constants,
                    const std::string          &subsection)
    {
      const auto lowest = constants.lowest_stiffness_eigenvalue();
      if (lowest.value > 0.)
        return;

      std::ostringstream text;
      text << "The small-strain stiffness of the fiber bundle must be positive "
           << "definite, but its lowest eigenvalue, the one of " << lowest.mode
           << ", is " << lowest.value << " MPa; change mu_iso, lambda_iso, "
           << "a_trn, b_trn, c_trn or d_trn (subsection " << subsection << ")";

      FiberBundleConstants reversed = constants;
      reversed.d                    = -constants.d;
      if (reversed.lowest_stiffness_eigenvalue().value > 0.)
        text << ": with d_trn = " << reversed.d
             << " it is positive definite, and the sign of d_trn printed in "
             << "Table 1 is a misprint";
      throw InputError(text.str() + ".");
    }
  } // namespace



  void
  MaterialParameters::declare_parameters(dealii::ParameterHandler &prm,
                                         const std::string        &subsection,
                                         const std::string        &same_as)
  {
    using namespace dealii;
    const std::string same = same_as.empty() ? "" : "as " + same_as;

    // The defaults are those of the struct, so that there is one list of them.
    const MaterialParameters defaults;
    const auto               number = [](const double value) {
      std::ostringstream text;
      text << value;
      return text.str();
    };

    prm.enter_subsection(subsection);

    prm.declare_entry("Law",
                      same.empty() ? "fiber bundle" : same,
                      Patterns::Selection((same.empty() ? "" : same + "|") +
                                          "fiber bundle|neo-Hookean"),
                      "Strain energy: the transversely isotropic fiber bundle, "
                      "Eqs. (50)-(53), or the isotropic neo-Hookean law, "
                      "Eq. (51)" +
                        (same.empty() ? "." :
                                        "; or law and constants " + same +
                                          ". Constants not given here have "
                                          "their defaults, not those of the " +
                                          same_as + "."));

    const FiberBundleConstants &m = defaults.fiber_bundle;
    prm.declare_entry("mu_iso",
                      number(m.mu),
                      Patterns::Double(),
                      "Fiber bundle: shear modulus mu_iso across the fiber "
                      "[MPa], Eq. (51).");
    prm.declare_entry(
      "lambda_iso",
      number(m.lambda),
      Patterns::Double(),
      "Fiber bundle: Lame constant lambda_iso [MPa], Eq. (51).");
    prm.declare_entry("a_trn",
                      number(m.a),
                      Patterns::Double(),
                      "Fiber bundle: a_trn [MPa], Eq. (52). The shear modulus "
                      "along the fiber is mu_iso - a_trn.");
    prm.declare_entry("b_trn",
                      number(m.b),
                      Patterns::Double(),
                      "Fiber bundle: b_trn [MPa], Eq. (52), couples volume "
                      "change and fiber stretch.");
    prm.declare_entry("c_trn",
                      number(m.c),
                      Patterns::Double(),
                      "Fiber bundle: c_trn [MPa], Eq. (52), stiffness along "
                      "the fiber.");
    prm.declare_entry("d_trn",
                      number(m.d),
                      Patterns::Double(),
                      "Fiber bundle: d_trn [MPa], Eq. (52). Table 1 prints it "
                      "with the opposite sign, with which the bundle is not "
                      "stable at rest.");

    prm.declare_entry("Young modulus",
                      number(defaults.young_modulus),
                      Patterns::Double(),
                      "neo-Hookean: Young's modulus E > 0 [MPa] at small "
                      "strain, mu = E/(2 (1 + nu)) in Eq. (51).");
    prm.declare_entry("Poisson ratio",
                      number(defaults.poisson_ratio),
                      Patterns::Double(),
                      "neo-Hookean: Poisson's ratio -1 < nu < 0.5 [-] at small "
                      "strain, lambda = E nu/((1 + nu)(1 - 2 nu)) in "
                      "Eq. (51).");
    prm.declare_entry("Volumetric energy",
                      "logarithm",
                      Patterns::Selection("logarithm|Ciarlet"),
                      "neo-Hookean: lambda/2 (ln J)^2 of Eq. (51), or "
                      "lambda/4 (J^2 - 1 - 2 ln J) of Ciarlet, which other "
                      "programs have too. They differ in the third order of "
                      "the strain.");

    prm.leave_subsection();
  }



  void
  MaterialParameters::parse_parameters(dealii::ParameterHandler &prm,
                                       const std::string        &subsection,
                                       const MaterialParameters *other)
  {
    if (other != nullptr)
      {
        const MaterialParameters defaults;
        prm.enter_subsection(subsection);
        const std::string choice = prm.get("Law");
        std::string       ignored;
        for (const auto &[entry, value] :
             {std::pair<std::string, double>("mu_iso",
                                             defaults.fiber_bundle.mu),
              {"lambda_iso", defaults.fiber_bundle.lambda},
              {"a_trn", defaults.fiber_bundle.a},
              {"b_trn", defaults.fiber_bundle.b},
              {"c_trn", defaults.fiber_bundle.c},
              {"d_trn", defaults.fiber_bundle.d},
              {"Young modulus", defaults.young_modulus},
              {"Poisson ratio", defaults.poisson_ratio}})
          if (ignored.empty() && prm.get_double(entry) != value)
            ignored = entry;
        prm.leave_subsection();
        if (choice.compare(0, 3, "as ") == 0)
          {
            if (!ignored.empty())
              throw InputError(ignored + " is given, but Law is " + choice +
                               ", which ignores it; choose Law = fiber bundle "
                               "or neo-Hookean, or remove the entry "
                               "(subsection " +
                               subsection + ").");
            *this = *other;
            return;
          }
      }

    prm.enter_subsection(subsection);
    law =
      prm.get("Law") == "neo-Hookean" ? Law::neo_hookean : Law::fiber_bundle;
    fiber_bundle.mu     = prm.get_double("mu_iso");
    fiber_bundle.lambda = prm.get_double("lambda_iso");
    fiber_bundle.a      = prm.get_double("a_trn");
    fiber_bundle.b      = prm.get_double("b_trn");
    fiber_bundle.c      = prm.get_double("c_trn");
    fiber_bundle.d      = prm.get_double("d_trn");
    young_modulus       = prm.get_double("Young modulus");
    poisson_ratio       = prm.get_double("Poisson ratio");
    volumetric_energy   = prm.get("Volumetric energy") == "Ciarlet" ?
                            VolumetricEnergy::ciarlet :
                            VolumetricEnergy::logarithm;
    prm.leave_subsection();

    if (law == Law::fiber_bundle)
      {
        check_stiffness(fiber_bundle, subsection);
        return;
      }

    std::ostringstream text;
    if (!(young_modulus > 0.))
      text << "Young modulus is " << young_modulus
           << " MPa; it must be > 0 (subsection " << subsection << ").";
    else if (!(poisson_ratio > -1. && poisson_ratio < 0.5))
      text << "Poisson ratio is " << poisson_ratio
           << "; it must be > -1 and < 0.5, both exclusive (subsection "
           << subsection << ").";
    if (!text.str().empty())
      throw InputError(text.str());
  }



  template <int dim>
  std::unique_ptr<HyperelasticLaw<dim>>
  make_material(const MaterialParameters     &parameters,
                const dealii::Tensor<1, dim> &fiber_direction)
  {
    switch (parameters.law)
      {
        case MaterialParameters::Law::fiber_bundle:
          return std::make_unique<FiberBundleLaw<dim>>(parameters.fiber_bundle,
                                                       fiber_direction);
        case MaterialParameters::Law::neo_hookean:
          return std::make_unique<NeoHookean<dim>>(
            NeoHookeanConstants::from_young_and_poisson(
              parameters.young_modulus,
              parameters.poisson_ratio,
              parameters.volumetric_energy));
      }
    AssertThrow(false, dealii::ExcNotImplemented());
    return {};
  }



  template std::unique_ptr<HyperelasticLaw<2>>
  make_material(const MaterialParameters &, const dealii::Tensor<1, 2> &);
  template std::unique_ptr<HyperelasticLaw<3>>
  make_material(const MaterialParameters &, const dealii::Tensor<1, 3> &);
} // namespace NPT
