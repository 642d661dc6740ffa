// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the parameters of solid benchmarks.

#ifndef npt_dealii_verification_solids_solid_benchmark_parameters_h
#define npt_dealii_verification_solids_solid_benchmark_parameters_h

#include <npt_dealii/base/parameter_binding.h>
#include <npt_dealii/base/parameter_file.h>
#include <npt_dealii/iga/iga_space.h>
#include <npt_dealii/linear_algebra/linear_solver.h>
#include <npt_dealii/load_step/newton.h>
#include <npt_dealii/load_step/step_control.h>
#include <npt_dealii/material/make_material.h>
#include <npt_dealii/verification/solids/exact_solids.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace NPT
{
  /// A benchmark of solids, `set Problem = solid benchmark`.
  struct SolidBenchmarkParameters
  {
    /// Subsection "Benchmark".
    std::string name         = "plate with hole"; ///< of the case
    double      inner_radius = 1;                 ///< [mm]
    double      outer_size   = 4;                 ///< [mm]
    double      load         = 1;                 ///< T or p [MPa]
    std::vector<std::pair<std::string, Basis>> bases = {
      {"NURBS", Basis::NURBS},
      {"Bernstein", Basis::Bernstein},
      {"Lagrange", Basis::Lagrange}};
    std::vector<unsigned int> degrees       = {2, 3, 4};
    std::vector<unsigned int> n_elements    = {4, 8, 16}; ///< increasing
    unsigned int              radial_factor = 1;
    unsigned int              additional_gauss_points = 0;
    double                    rate_tolerance          = 0.1;
    /// On the computed body only, to see comparisons fail [-].
    double stiffness_factor = 1;

    /// Subsection "Homogeneous states", for the block.
    std::vector<std::pair<std::string, HomogeneousMode>> modes = {
      {"uniaxial", HomogeneousMode::uniaxial},
      {"equibiaxial", HomogeneousMode::equibiaxial},
      {"dilation", HomogeneousMode::dilation},
      {"simple shear", HomogeneousMode::simple_shear}};
    std::vector<unsigned int> fiber_axes       = {0, 1}; ///< from 0
    double                    stretch          = 1.1;    ///< [-]
    double                    shear            = 0.2;    ///< gamma [-]
    double                    distortion       = 0.25;
    double                    stress_tolerance = 1e-9; ///< relative
    std::optional<double> pointwise_tolerance; ///< relative; none: not judged
    StepParameters        steps = {0.25, 1e-4, 0.25};

    MaterialParameters     material = MaterialParameters("neo-Hookean");
    NewtonParameters       newton   = {1e-12};
    LinearSolverParameters linear_solver;

    std::string directory = "output-benchmark";
    bool        picture   = true;

    /// The complete file with defaults, as it will be kept with the results.
    std::string used_file;

    /// Bind all members to their entries.
    void
    add_parameters(dealii::ParameterHandler &prm);

    /**
     * Throws InputError with one sentence for the first mistake; besides what
     * single entries allow: the outer size must exceed the radius, elements
     * must increase, and rates of convergence are those of the isotropic law.
     */
    static SolidBenchmarkParameters
    read(const ParameterText            &text,
         const std::vector<std::string> &overrides = {});
    static std::string
    documented_defaults();

  private:
    void
    add_convergence_parameters(dealii::ParameterHandler &prm);

    void
    add_block_parameters(dealii::ParameterHandler &prm);

    void
    check() const;
  };

} // namespace NPT

#endif
