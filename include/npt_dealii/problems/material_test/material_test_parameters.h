// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines all parameters of a numerical material test: gathers the rooms'
// structs, declares, reads and cross-checks them.

#ifndef npt_dealii_problems_material_test_material_test_parameters_h
#define npt_dealii_problems_material_test_material_test_parameters_h

#include <npt_dealii/base/parameter_file.h>
#include <npt_dealii/linear_algebra/linear_solver.h>
#include <npt_dealii/load_step/newton.h>
#include <npt_dealii/load_step/step_control.h>
#include <npt_dealii/material/make_material.h>
#include <npt_dealii/problems/identification/identification_run.h>
#include <npt_dealii/problems/material_test/fiber_array.h>

#include <deal.II/base/parameter_handler.h>

#include <array>
#include <string>
#include <vector>

namespace NPT
{
  /// One test of the micro cell, from the natural state to its targets.
  struct MaterialTest
  {
    std::string name;

    /// Component iJ, row major: is the stress P_iJ prescribed instead of H_iJ?
    std::array<bool, 9> stress_controlled{};
    /// H_iJ [-] or P_iJ [MPa] at the end; a component not named has H_iJ = 0.
    std::array<double, 9> target{};
    StepParameters        steps;
  };

  /**
   * Subsection "Material tests". The tests are named by the user; each has a
   * subsection "Test NAME" with its targets "H11: 0.2, P22: 0".
   */
  class MaterialTestProgramme
  {
  public:
    std::vector<MaterialTest> tests;

    /// The entry Tests of a parameter file, or the six default tests.
    static std::vector<std::string>
    read_test_names(const ParameterText            &text,
                    const std::vector<std::string> &overrides);

    static void
    declare_parameters(dealii::ParameterHandler       &prm,
                       const std::vector<std::string> &names);

    /**
     * Throws InputError for names twice, a component prescribed twice, and if
     * both P_iJ and P_Ji are prescribed: then nothing holds the rotation of the
     * cell in the plane of i and J.
     */
    void
    parse_parameters(dealii::ParameterHandler       &prm,
                     const std::vector<std::string> &names);
  };

  /// A numerical material test, `set Problem = material test`.
  struct MaterialTestParameters
  {
    MicroCellParameters      cell;
    MicroMeshParameters      mesh;
    MaterialParameters       fiber;
    MaterialParameters       matrix;
    bool                     uniform_along_fiber = true;
    MaterialTestProgramme    programme;
    NewtonParameters         newton;
    LinearSolverParameters   linear_solver;
    bool                     identify = true;
    IdentificationParameters identification;
    MaterialOutputParameters output;

    /// The complete file with defaults, as it will be kept with the results.
    std::string used_file;

    /// Throws InputError with one sentence for the first mistake.
    static MaterialTestParameters
    read(const ParameterText            &text,
         const std::vector<std::string> &overrides = {});
    static std::string
    documented_defaults();
  };
} // namespace NPT

#endif
