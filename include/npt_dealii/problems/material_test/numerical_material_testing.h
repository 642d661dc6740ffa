// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the numerical material test of a micro cell, from the parameter file
// to stresses and the identified bundle law, in the order of run().

#ifndef npt_dealii_problems_material_test_numerical_material_testing_h
#define npt_dealii_problems_material_test_numerical_material_testing_h

#include <npt_dealii/homogenization/solid_couplings.h>
#include <npt_dealii/iga/iga_space.h>
#include <npt_dealii/io/run_log.h>
#include <npt_dealii/io/table_file.h>
#include <npt_dealii/linear_algebra/constrained_system.h>
#include <npt_dealii/linear_algebra/linear_solver.h>
#include <npt_dealii/load_step/load_stepper.h>
#include <npt_dealii/problems/identification/identification.h>
#include <npt_dealii/problems/material_test/fiber_array.h>
#include <npt_dealii/problems/material_test/material_test_parameters.h>
#include <npt_dealii/solid/deformable_bodies.h>
#include <npt_dealii/solid/solid_kernel.h>

#include <memory>

namespace NPT
{
  /// One accepted load step of a material test.
  struct MaterialTestRow
  {
    std::string          test;
    double               load_factor = 0;
    dealii::Tensor<2, 3> H;
    dealii::Tensor<2, 3> P;         ///< reactions of H over the volume [MPa]
    dealii::Tensor<2, 3> P_average; ///< volume average [MPa]
    double               energy       = 0; ///< per volume [MPa]
    double               work         = 0; ///< int P:dH by trapezoids [MPa]
    double               mean_J       = 1; ///< mean of det F
    double               P_times_F    = 0; ///< mean of P : F [MPa]
    unsigned int         iterations   = 0;
    double               newton_order = 0;
  };

  /**
   * Numerical material test: a periodic cell of fibers and matrix is deformed
   * by its macroscopic displacement gradient H or loaded by the first
   * Piola-Kirchhoff stress, component by component.
   *
   * Unknowns are u = (w of all control points, H_11 ... H_33); periodicity
   * leaves the independent ones m, u = C m. A load step solves
   *
   * @f[ C^T f_{int}(u) = |V| P_{prescribed} @f]
   *
   * for the free m by Newton's method. The reaction of H_iJ over the cell's
   * volume is the macroscopic P_iJ (Hill and Mandel), which equals the volume
   * average of P.
   */
  class NumericalMaterialTesting
  {
  public:
    /// @param directory Existing folder for all results; empty: write nothing.
    NumericalMaterialTesting(const MaterialTestParameters &parameters,
                             const std::string            &directory,
                             std::ostream                 &screen);

    /// Moduli, tests, fit. Throws StageFailed if a test cannot be finished;
    /// results up to there are complete on disk.
    void
    run();

    const std::vector<MaterialTestRow> &
    rows() const
    {
      return rows_;
    }
    /// The tests as the identification reads them.
    std::vector<MaterialCurve>
    curves() const;
    /// At the natural state, 6 x 6 in the order 11, 22, 33, 23, 31, 12 with
    /// engineering shears [MPa]; set by run().
    const dealii::FullMatrix<double> &
    small_strain_stiffness() const
    {
      return stiffness_;
    }
    /**
     * Macroscopic tangent dP/dH (9 x 9, row major components) at the end of the
     * last test (before: at the natural state) by static condensation,
     *
     * @f[ |V| A = K_{HH} - K_{Hf} K_{ff}^{-1} K_{fH} @f]
     *
     * with f all independent unknowns but H.
     */
    dealii::FullMatrix<double>
    macroscopic_tangent();
    /// Empty without identification.
    const std::unique_ptr<IdentificationResult> &
    identified() const
    {
      return identified_;
    }
    unsigned int
    n_unknowns() const
    {
      return system_.n_independent();
    }

  private:
    void
    make_micro_cell();
    void
    setup_system();
    void
    compute_moduli();
    void
    run_test(const MaterialTest &test);
    void
    identify_bundle_law();

    void
    begin_test(const MaterialTest &test);
    void
    add_row(const MaterialTest &test, const AcceptedStep &step);
    void
    write_row(const MaterialTestRow &row);
    void
    compute_averages(const dealii::Vector<double> &u,
                     MaterialTestRow              &row) const;
    void
    output_fields(const MaterialTest &test) const;

    const MaterialTestParameters parameters_;
    const std::string            directory_;
    RunLog                       log_;
    const double                 cpu_start_;

    // The cell and its discretization.
    std::unique_ptr<FiberArray>       cell_;
    std::unique_ptr<DeformableBodies> bodies_; // fibers and matrix
    SolidMacroUnknowns                macro_;
    std::vector<unsigned int>         cell_groups_;

    ConstrainedSystem system_;
    LinearSolver      linear_solver_;
    State             state_; // accepted last

    dealii::FullMatrix<double>            stiffness_;
    std::vector<MaterialTestRow>          rows_;
    std::unique_ptr<TableWriter>          table_;
    std::unique_ptr<IdentificationResult> identified_;
  };
} // namespace NPT

#endif
