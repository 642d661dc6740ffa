// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the comparison of solids with exact solutions.

#ifndef npt_dealii_verification_solids_solid_benchmark_h
#define npt_dealii_verification_solids_solid_benchmark_h

#include <npt_dealii/io/run_log.h>
#include <npt_dealii/io/table_file.h>
#include <npt_dealii/linear_algebra/constrained_system.h>
#include <npt_dealii/solid/deformable_bodies.h>
#include <npt_dealii/verification/solids/exact_solids.h>
#include <npt_dealii/verification/solids/solid_benchmark_parameters.h>
#include <npt_dealii/verification/solids/solid_case.h>

#include <limits>
#include <memory>

namespace NPT
{
  /// One mesh of a series. Errors are relative to the norm of the solution.
  struct ConvergenceRow
  {
    std::string  basis;
    unsigned int degree;
    unsigned int n_elements; ///< spans per direction and patch
    unsigned int n_cells;
    unsigned int n_unknowns; ///< independent ones
    double       error_energy;
    double       error_L2;
    /// log(e_1 / e_2) / log(n_2 / n_1); NaN for the first mesh.
    double rate_energy = std::numeric_limits<double>::quiet_NaN();
    double rate_L2     = std::numeric_limits<double>::quiet_NaN();
    double cpu_seconds;
  };

  /// One homogeneous state in one mesh.
  struct HomogeneousRow
  {
    std::string          mode;
    unsigned int         fiber_axis; ///< from 0
    std::string          basis;
    unsigned int         degree;
    unsigned int         n_elements;
    unsigned int         n_iterations; ///< Newton, summed over the steps
    dealii::Tensor<2, 3> P;            ///< volume average [MPa]
    dealii::Tensor<2, 3> P_exact;
    /// Largest difference of a component over the largest component.
    double error_average;
    double error_pointwise; ///< the same at the worst quadrature point
  };

  /**
   * Compare bodies with exact solutions.
   *
   * A plate with a hole, a cylinder or a sphere: the law is linearized at the
   * natural state, K(0) w = f, so the exact solution is the one of linear
   * elasticity. For every basis and degree a series of meshes is solved, with
   * the errors
   *
   * @f[ e_E^2 = \frac{\int (\sigma_h - \sigma) : S : (\sigma_h - \sigma) \, dV}
   *                  {\int \sigma : S : \sigma \, dV}, \qquad
   *     e_0^2 = \frac{\int |u_h - u|^2 dV}{\int |u|^2 dV}, @f]
   *
   * S the compliance, integrated with p + 2 Gauss points per direction (one
   * more than the leading terms of the errors need). Theory
   * expects e_E ~ h^p and e_0 ~ h^{p+1}.
   *
   * A block: homogeneous states at finite strain in a distorted mesh. The
   * driven faces are moved in load steps, Newton's method finds the interior
   * and the free faces, and the average of P is compared with the closed form.
   */
  class SolidBenchmark
  {
  public:
    /// @param directory Existing folder for all results; empty: write nothing.
    SolidBenchmark(const SolidBenchmarkParameters &parameters,
                   const std::string              &directory,
                   std::ostream                   &screen);

    /// Throws ToleranceMissed at the end if a rate or a stress misses its
    /// tolerance; all rows are on disk then.
    void
    run();

    const std::vector<ConvergenceRow> &
    rates() const
    {
      return rates_;
    }
    const std::vector<HomogeneousRow> &
    states() const
    {
      return states_;
    }

  private:
    void
    measure_rates();
    void
    make_body(const Basis        basis,
              const unsigned int degree,
              const unsigned int n_elements);
    void
    hold_symmetry_planes();
    void
    assemble_load();
    void
    solve_linear_problem();
    void
    compute_errors(ConvergenceRow &row) const;

    void
    compare_homogeneous_states();
    void
    make_block(const Basis        basis,
               const unsigned int degree,
               const unsigned int n_elements,
               const unsigned int fiber_axis);
    void
    drive_faces(const HomogeneousMode mode, const dealii::Tensor<2, 3> &F);
    /// Newton iterations, summed over the load steps.
    unsigned int
    solve_load_steps(const std::string &name);
    void
    compute_stress(HomogeneousRow &row) const;

    // Results, solid_benchmark_results.cc.
    void
    begin_output();
    void
    judge_and_write(ConvergenceRow row);
    void
    judge_and_write(const HomogeneousRow &row);
    void
    finish_output();

    const SolidBenchmarkParameters   parameters_;
    const std::string                directory_;
    RunLog                           log_;
    const SolidCase                  case_;
    std::unique_ptr<ElasticSolution> exact_; // not for homogeneous states

    // The present body and its system.
    std::unique_ptr<DeformableBodies> body_;
    ConstrainedSystem                 system_;
    DeformableBodies::CellGroups      cell_groups_; // in system_
    LinearSolver                      linear_solver_;
    dealii::Vector<double>            load_;   // full
    dealii::Vector<double>            u_;      // full
    dealii::Vector<double>            target_; // independent, block only

    std::vector<ConvergenceRow>  rates_;
    std::vector<HomogeneousRow>  states_;
    std::unique_ptr<TableWriter> table_;
    std::vector<std::string>     misses_; // of the tolerances
  };
} // namespace NPT

#endif
