// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines all parameters of a contact benchmark: declares, reads and
// cross-checks them.

#ifndef npt_dealii_verification_contact_contact_benchmark_parameters_h
#define npt_dealii_verification_contact_contact_benchmark_parameters_h

#include <npt_dealii/base/parameter_binding.h>
#include <npt_dealii/base/parameter_file.h>
#include <npt_dealii/contact/contact_parameters.h>
#include <npt_dealii/linear_algebra/linear_solver.h>
#include <npt_dealii/load_step/newton.h>
#include <npt_dealii/load_step/step_control.h>
#include <npt_dealii/material/neo_hookean.h>
#include <npt_dealii/verification/comparison.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace NPT
{
  /// Subsections "Benchmark", "Upper body" and "Lower body".
  struct ContactCaseParameters
  {
    struct Body
    {
      double       young_modulus = 1000.; ///< [MPa]
      double       poisson_ratio = 0.3;   ///< [-]
      double       radius        = 1.;    ///< of the surface [mm]
      unsigned int n_elements    = 8;

      NeoHookeanConstants
      constants() const
      {
        return NeoHookeanConstants::from_young_and_poisson(young_modulus,
                                                           poisson_ratio);
      }

      void
      add_parameters(dealii::ParameterHandler &prm,
                     const std::string        &subsection);

      void
      check(const std::string &subsection) const;
    };

    std::string  name        = "cylinders"; ///< of the ContactCase
    double       half_width  = 0.01;        ///< a of Hertz' contact [mm]
    double       body_size   = 20.;         ///< over the half width [-]
    double       span_growth = 1.6;
    unsigned int degree      = 2;
    double       pressure    = 1.;   ///< nominal [MPa]
    double       stick_ratio = 0.5;  ///< c/a [-]
    double       distance    = 0.1;  ///< [mm]
    double       wrap_angle  = 120.; ///< [degrees]
    double       thickness   = 0.01; ///< of the belt [mm]
    unsigned int load_steps  = 10;
    /// Factors that only the computation knows, to see comparisons fail [-].
    double stiffness_factor = 1., friction_factor = 1.;
    Body   upper, lower;

    /// Bind the members to the entries of the three subsections.
    void
    add_parameters(dealii::ParameterHandler &prm);

    /// Throws InputError for sizes with which the case cannot be posed.
    void
    check() const;
  };

  /// Subsection "Output" of a contact benchmark.
  struct ContactOutputParameters
  {
    std::string directory = "output-contact";
    bool        picture   = true;
    bool        fields    = false;

    /// Bind the members to the entries of the subsection.
    void
    add_parameters(dealii::ParameterHandler &prm);
  };

  /// A contact benchmark, `set Problem = contact benchmark`.
  struct ContactBenchmarkParameters
  {
    ContactCaseParameters benchmark;
    ContactParameters     contact;
    FrictionParameters    friction;
    /// Errors of the formulation are to be seen, not those of the iteration;
    /// small bodies have small forces.
    NewtonParameters        newton = {1e-9};
    LinearSolverParameters  linear_solver;
    ContactOutputParameters output;
    Tolerances              tolerances; ///< subsection "Tolerances"

    /// The complete file with defaults, as it will be kept with the results.
    std::string used_file;

    /// Bind all members to their entries.
    void
    add_parameters(dealii::ParameterHandler &prm);

    /// Throws InputError with one sentence for the first mistake.
    static ContactBenchmarkParameters
    read(const ParameterText            &text,
         const std::vector<std::string> &overrides = {});
  };
} // namespace NPT

#endif
