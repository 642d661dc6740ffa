// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the contact benchmark: one contact problem with an exact solution,
// from the parameter file to the comparison, in the order of run().

#ifndef npt_dealii_verification_contact_contact_benchmark_h
#define npt_dealii_verification_contact_contact_benchmark_h

#include <npt_dealii/contact/contact_pair.h>
#include <npt_dealii/io/run_log.h>
#include <npt_dealii/io/table_file.h>
#include <npt_dealii/linear_algebra/constrained_system.h>
#include <npt_dealii/linear_algebra/linear_solver.h>
#include <npt_dealii/load_step/load_stepper.h>
#include <npt_dealii/solid/deformable_bodies.h>
#include <npt_dealii/verification/contact/contact_benchmark_parameters.h>
#include <npt_dealii/verification/contact/contact_cases.h>

#include <cmath>
#include <memory>

namespace NPT
{
  /// A computed quantity beside its exact value.
  struct ContactComparison
  {
    std::string quantity;
    std::string unit;
    double      computed = 0;
    double      exact    = 0;

    /// Relative error; the computed value itself where zero is exact.
    double
    error() const
    {
      return exact == 0. ? computed : (computed - exact) / std::abs(exact);
    }
  };

  /// One accepted load step of a contact benchmark.
  struct ContactRow
  {
    unsigned int        step = 0;
    std::string         stage;
    double              load_factor = 0;
    std::vector<double> value;                   ///< of each handle
    std::vector<double> force;                   ///< on each handle, whole body
    double              dissipation         = 0; ///< cumulative, whole body
    double              largest_penetration = 0; ///< [mm]
    unsigned int        n_active = 0, n_stick = 0, n_slip = 0;
    /// Sum of all contact forces over the sum of their magnitudes [-].
    double force_imbalance = 0;
    /// Sum of the moments of all contact forces over the sum of the magnitudes
    /// of both [-].
    double       moment_imbalance = 0;
    unsigned int iterations       = 0;
  };

  /// State at a Gauss point of the secondary surface.
  struct ContactSample
  {
    dealii::Point<3>     x;            ///< current position [mm]
    double               area     = 0; ///< reference [mm^2]
    double               pressure = 0; ///< [MPa]
    dealii::Tensor<1, 3> traction;     ///< of friction, along the slip [MPa]
  };

  /**
   * A contact problem whose solution is known.
   *
   * Unknowns are u = (w of all control points, handles); the couplings of the
   * case leave independent ones m, u = C m. Handles have prescribed values or
   * forces; a step solves
   *
   * @f[ C^T ( f_{int}(u) + f_{contact}(u) ) = f_{handles} @f]
   *
   * by Newton's method, with the solids and contact of the plate test. The
   * comparisons with exact solutions are in contact_comparisons.cc.
   */
  class ContactBenchmark
  {
  public:
    /**
     * @param directory Existing folder for all results; empty: write nothing
     *   (tests).
     * @param screen Where the log is shown.
     */
    ContactBenchmark(const ContactBenchmarkParameters &parameters,
                     const std::string                &directory,
                     std::ostream                     &screen);

    /// All stages. Throws StageFailed if a stage cannot be finished.
    void
    run();

    const std::vector<ContactComparison> &
    comparisons() const
    {
      return comparisons_;
    }
    /// Throws if there is no such quantity.
    const ContactComparison &
    comparison(const std::string &quantity) const;
    /// One row per accepted step.
    const std::vector<ContactRow> &
    rows() const
    {
      return rows_;
    }

  private:
    void
    setup_system();
    void
    run_stage(const unsigned int index);
    void
    add_row(const ContactStage &stage, const AcceptedStep &step);
    void
    balance(const AcceptedStep &step, ContactRow &row) const;

    // Comparisons, contact_comparisons.cc.
    void
    compare(const ContactStage &stage);
    void
    compare_patch_test();
    void
    compare_cylinders();
    void
    compare_point_contact();
    void
    compare_partial_slip(const std::string &stage);
    void
    compare_block();
    void
    compare_capstan();
    void
    compare_disc_twist();
    void
    compare_sphere_twist();
    void
    compare_ironing();
    void
    compare_value(const std::string &quantity,
                  const std::string &unit,
                  const double       computed,
                  const double       exact);
    std::vector<ContactSample>
    samples() const;
    /// Boundary of the sticking zone, |x| or the radius in the plane x, y.
    double
    stick_radius(const bool in_plane) const;
    /// Abscissa, computed, exact; sorted by the abscissa unless in_order.
    void
    write_profile(const std::string                 &x_name,
                  const std::string                 &y_name,
                  std::vector<std::array<double, 3>> rows,
                  const bool                         in_order = false);

    void
    output_fields();
    void
    finish_output();

    const ContactBenchmarkParameters parameters_;
    const std::string                directory_;
    RunLog                           log_;
    const double                     cpu_start_;

    ContactModel                      model_;
    std::unique_ptr<DeformableBodies> bodies_;
    std::unique_ptr<IGASurface<3>>    surfaces_[2]; // secondary, primary
    ContactPairs                      contacts_;    // one
    ConstrainedSystem                 system_;
    DeformableBodies::CellGroups      cell_groups_; // in system_
    LinearSolver                      linear_solver_;

    State                state_;      // accepted
    ContactEvaluation<3> evaluation_; // of the last accepted step

    std::vector<ContactRow>                     rows_;
    std::vector<ContactComparison>              comparisons_;
    std::unique_ptr<TableWriter>                table_;
    std::vector<std::pair<double, std::string>> files_;
  };
} // namespace NPT

#endif
