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
#include <npt_dealii/verification/contact/contact_case.h>
#include <npt_dealii/verification/contact/contact_comparisons.h>
#include <npt_dealii/verification/contact/contact_results.h>

#include <memory>

namespace NPT
{
  /**
   * A contact problem whose solution is known.
   *
   * Unknowns are u = (w of all control points, handles); the couplings of the
   * case leave independent ones m, u = C m. Handles have prescribed values or
   * forces; a step solves
   *
   * @f[ C^T ( f_{int}(u) + f_{contact}(u) ) = f_{handles} @f]
   *
   * by Newton's method, with the solids and contact of the plate test. Bodies,
   * stages and comparisons with the exact solution are those of a ContactCase.
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

    /// All stages. Throws StageFailed if a stage cannot be finished, and
    /// ToleranceMissed at the end, when all results are on disk.
    void
    run();

    const std::vector<Comparison> &
    comparisons() const
    {
      return comparisons_.list();
    }
    /// Throws dealii::ExcMessage if there is no such quantity.
    const Comparison &
    comparison(const std::string &quantity) const
    {
      return comparisons_.get(quantity);
    }
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

    /// With the exact solution, where the case has one of this stage.
    void
    compare(const ContactStage &stage);
    void
    output_fields();
    void
    finish_output();

    const ContactBenchmarkParameters parameters_;
    const std::string                directory_;
    RunLog                           log_;
    const double                     cpu_start_;

    const ContactCase                &case_;
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
    ContactComparisons                          comparisons_;
    std::unique_ptr<TableWriter>                table_;
    std::vector<std::pair<double, std::string>> files_;
  };
} // namespace NPT

#endif
