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

    MaterialTest() = default;

    /// A test with the defaults that its name has: "tension 1" to 20 %, "shear
    /// 12" as a symmetric H of 10 %, and so on; others have no targets.
    explicit MaterialTest(const std::string &name);

    /// Bind the members to the entries of subsection "Test NAME".
    void
    add_parameters(dealii::ParameterHandler &prm);

    /**
     * Throws InputError without targets, and if both P_iJ and P_Ji are
     * prescribed: then nothing holds the rotation of the cell in the plane of
     * i and J.
     */
    void
    check() const;

    /// "H11: 0.2, P22: 0".
    std::string
    targets() const;

    /// Throws InputError if a component is prescribed twice.
    void
    set_targets(const std::string &text);

  private:
    std::array<bool, 9> is_named_{};
  };

  /**
   * Subsection "Material tests". The tests are named by the user, so their
   * names have to be known before their entries can be declared; each has a
   * subsection "Test NAME" with its targets "H11: 0.2, P22: 0".
   */
  class MaterialTestProgramme
  {
  public:
    std::vector<MaterialTest> tests;

    /**
     * @param names Entry Tests, the names separated by commas; empty: the six
     *   default tests. "none": no test.
     */
    explicit MaterialTestProgramme(const std::string &names = "");

    /// Bind all tests to their entries, those of the subsection that are no
    /// test excepted. The default tests can be described even if they are not
    /// run.
    void
    add_parameters(dealii::ParameterHandler &prm);

    /// Throws InputError for names twice and for what a test finds impossible.
    void
    check() const;

  private:
    /// Described, but not run.
    std::vector<MaterialTest> others_;
  };

  /// A numerical material test, `set Problem = material test`.
  struct MaterialTestParameters
  {
    MicroCellParameters   cell;
    MicroMeshParameters   mesh;
    MaterialParameters    fiber  = MaterialParameters("neo-Hookean");
    MaterialParameters    matrix = MaterialParameters("neo-Hookean");
    bool                  uniform_along_fiber = true;
    MaterialTestProgramme programme;
    /// A smooth problem: two more digits cost less than one iteration, and the
    /// averages then agree with the reactions. Fibers of a few micrometers have
    /// small forces.
    NewtonParameters         newton = {1e-10};
    LinearSolverParameters   linear_solver;
    bool                     identify = true;
    IdentificationParameters identification;
    MaterialOutputParameters output = {"output-nmt"};

    /// The matrix is a hundred times softer than the fiber.
    MaterialTestParameters();

    void
    add_parameters(dealii::ParameterHandler &prm);

    /// The complete file with defaults, as it will be kept with the results.
    std::string used_file;

    /// What of the file is not used, in sentences.
    std::vector<std::string> remarks;

    /// Throws InputError with one sentence for the first mistake.
    static MaterialTestParameters
    read(const ParameterText            &text,
         const std::vector<std::string> &overrides = {});
    static std::string
    documented_defaults();
  };
} // namespace NPT

#endif
