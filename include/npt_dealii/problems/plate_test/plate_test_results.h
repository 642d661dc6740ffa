// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what a plate test leaves: the curve, the log, fields and pictures.

#ifndef npt_dealii_problems_plate_test_plate_test_results_h
#define npt_dealii_problems_plate_test_plate_test_results_h

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/io/run_log.h>
#include <npt_dealii/linear_algebra/linear_solver.h>
#include <npt_dealii/load_step/load_stepper.h>
#include <npt_dealii/problems/plate_results/curve_writer.h>
#include <npt_dealii/problems/plate_results/step_table.h>
#include <npt_dealii/problems/plate_test/plate_cell.h>
#include <npt_dealii/problems/plate_test/plate_test_stage.h>

#include <deal.II/base/timer.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace NPT
{
  /**
   * The results of a plate test, collected step by step. Every file is complete
   * on disk as far as the test has come. Nothing here acts back on the test.
   */
  class PlateTestResults
  {
  public:
    /// @param parameters Must outlive the results, as log and timer must.
    /// @param directory Existing folder; empty: write nothing (tests).
    PlateTestResults(const PlateTestParameters &parameters,
                     const std::string         &directory,
                     RunLog                    &log,
                     dealii::TimerOutput       &timer);

    /// What results remember of the steps so far; a value.
    struct Memory
    {
      std::vector<CurveRow> curve; ///< one row per accepted step
      /// Of the fields, with load times.
      std::vector<std::pair<double, std::string>> bundle_files, contact_files;
      std::vector<std::string> cell_scripts; ///< of pictures not drawn yet
      double                   stages_done = 0;
      EnergyBalance            energy_balance;
    };

    const Memory &
    memory() const
    {
      return memory_;
    }

    /// One row per accepted step.
    const std::vector<CurveRow> &
    curve() const
    {
      return memory_.curve;
    }
    const std::string &
    directory() const
    {
      return directory_;
    }

    /// used_parameters.prm, and the head of the log with the sizes.
    void
    begin_log(const PlateCell &cell);
    /// The same, and an empty curve file.
    void
    begin(const PlateCell &cell);
    /// The same for a run that goes on: files and CPU time go on as well.
    void
    resume(const PlateCell &cell, const Memory &memory);
    /// Contact of the last accepted step, of a run that goes on.
    void
    set_last_contact(const std::vector<ContactEvaluation<3>> &contact);
    void
    begin_stage(const LoadStage &stage);
    /// A row of the curve, a line of the log, and fields if they are due.
    void
    add_step(const PlateCell                     &cell,
             const LoadStage                     &stage,
             const AcceptedStep                  &step,
             const std::vector<dealii::Point<3>> &woven);
    /// Script and points of the picture of the deformed cell; draw_pictures()
    /// draws them all. Exports. What goes wrong is a warning in the log.
    void
    end_stage(const PlateCell                     &cell,
              const LoadStage                     &stage,
              const State                         &state,
              const std::vector<dealii::Point<3>> &woven);
    /// At the end of a stage: what pins and foundation bear, as a warning if it
    /// is not small against contact and stays.
    void
    report_supports(const unsigned int stage, const SupportForces &forces);
    /// A stage ends before its end: fields and picture of the last accepted
    /// step. What goes wrong is a warning in the log, so that it does not hide
    /// why the stage ended.
    void
    end_early(const PlateCell                     &cell,
              const LoadStage                     &stage,
              const State                         &state,
              const std::vector<dealii::Point<3>> &woven);
    /// Hysteresis, warnings, pictures, times: of every run, also of one that
    /// ends early.
    void
    finish(const PlateCell    &cell,
           const LinearSolver &linear_solver,
           ConstrainedSystem  &system);

    /// Throws OutputError if the cell could not be drawn or exported; on the
    /// way that is a warning.
    void
    check_pictures() const;

  private:
    CurveRow
    make_row(const PlateCell    &cell,
             const LoadStage    &stage,
             const AcceptedStep &step) const;
    void
    write_fields(const PlateCell                         &cell,
                 const State                             &state,
                 const std::vector<ContactEvaluation<3>> &contact);
    void
    write_picture(const PlateCell                     &cell,
                  const LoadStage                     &stage,
                  const State                         &state,
                  const std::vector<dealii::Point<3>> &woven);
    /// For other programs, if they are due.
    void
    export_stage(const PlateCell                     &cell,
                 const LoadStage                     &stage,
                 const State                         &state,
                 const std::vector<dealii::Point<3>> &woven);
    /// All pictures by one gnuplot; to start it takes half as long as a simple
    /// picture.
    void
    draw_pictures();
    void
    warn_of_penetration();
    void
    report_energies();
    double
    cpu_seconds() const;

    const PlateTestParameters &parameters_;
    const std::string          directory_;
    RunLog                    &log_;
    dealii::TimerOutput       &timer_;
    double                     cpu_start_;
    StepTable                  step_table_;

    Memory                       memory_;
    std::unique_ptr<CurveWriter> curve_writer_;
    // Of the last accepted step, if its fields may still be wanted.
    std::vector<ContactEvaluation<3>> last_contact_;
    // Why a picture or an export was not written; told when all else is done.
    std::optional<OutputError> not_drawn_;
  };
} // namespace NPT

#endif
