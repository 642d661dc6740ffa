// SPDX-License-Identifier: LGPL-2.1-or-later
// The problem "plate test": the run, its summary, its registration.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/interruption.h>
#include <npt_dealii/base/problem.h>
#include <npt_dealii/io/output_folder.h>
#include <npt_dealii/problems/plate_results/run_summary.h>
#include <npt_dealii/problems/plate_test/numerical_plate_testing.h>
#include <npt_dealii/problems/plate_test/plate_test.h>

#include <algorithm>
#include <iostream>
#include <new>
#include <utility>

namespace NPT
{
  namespace
  {
    // How a run ended that a stage ended before its end.
    void
    add_failure(const StageFailed           &failure,
                const std::vector<CurveRow> &curve,
                RunSummary                  &summary)
    {
      summary.reason = failure.reason();
      if (summary.stage.empty()) // not even one step
        summary.stage = failure.stage();
      summary.message = failure.what();
      // The curve has the cuts of accepted steps only.
      unsigned int cuts_of_stage = 0;
      for (const CurveRow &row : curve)
        cuts_of_stage += row.stage == failure.stage() ? row.cuts : 0;
      summary.cuts += std::max(failure.n_cuts(), cuts_of_stage) - cuts_of_stage;
    }

    // summary.csv of one run.
    class SummaryFile
    {
    public:
      SummaryFile(const NumericalPlateTesting &test,
                  const std::string           &directory)
        : test_(test)
        , directory_(directory)
      {}

      RunSummary
      summarize(const std::string &status) const
      {
        RunSummary summary = summarize_curve(test_.curve());
        summary.status     = status;
        summary.n_unknowns = test_.n_unknowns();
        return summary;
      }

      void
      write(const RunSummary &summary) const
      {
        if (!directory_.empty())
          write_run_summary(directory_ + "/summary.csv", summary);
      }

      // Of a run that is about to end by an error, which is not to be hidden by
      // one more.
      void
      write_failure(const std::string &reason, const std::string &message) const
      {
        RunSummary summary = summarize("failed");
        summary.reason     = reason;
        summary.message    = message;
        try
          {
            write(summary);
          }
        catch (const OutputError &)
          {
            // The error on its way says more.
          }
      }

    private:
      const NumericalPlateTesting &test_;
      const std::string            directory_;
    };
  } // namespace



  void
  run_plate_test(const PlateTestParameters         &parameters,
                 const std::string                 &directory,
                 std::ostream                      &screen,
                 const Ranks                       &ranks,
                 std::optional<PlateTestCheckpoint> checkpoint)
  {
    const Interruption    interruption;
    NumericalPlateTesting test(
      parameters, directory, screen, ranks, std::move(checkpoint));
    const SummaryFile file(test, directory);
    file.write(file.summarize("running"));
    try
      {
        test.run();
      }
    catch (const StageFailed &failure)
      {
        RunSummary summary = file.summarize("failed");
        add_failure(failure, test.curve(), summary);
        file.write(summary);
        throw;
      }
    catch (const OutputError &failure)
      {
        file.write_failure("output", failure.what());
        throw;
      }
    catch (const std::bad_alloc &)
      {
        file.write_failure("out of memory", "The memory did not suffice.");
        throw;
      }
    catch (const std::exception &failure)
      {
        file.write_failure("unexpected error", failure.what());
        throw;
      }
    file.write(file.summarize("done"));
  }



  namespace
  {
    void
    start(const ParameterText &text, const CommandLine &command)
    {
      const Ranks ranks(MPI_COMM_WORLD);
      silence_all_but_first(ranks);
      const auto parameters =
        PlateTestParameters::read(text, command.overrides);
      if (done_with_parameters(command, parameters, parameters.remarks))
        return;
      parameters.linear_solver.check(ranks);
      const std::string directory =
        make_output_directory(command, parameters.output.directory, ranks);
      if (command.action == CommandLine::Action::geometry)
        {
          const OutputFolder folder(directory, OutputFolder::Start::add);
          if (ranks.is_first())
            NumericalPlateTesting(parameters, directory, std::cout).preview();
          return;
        }
      OutputFolder                       folder(directory,
                          command.continues ? OutputFolder::Start::add :
                                                                    OutputFolder::Start::clean);
      std::optional<PlateTestCheckpoint> checkpoint;
      if (command.continues)
        {
          checkpoint = read_checkpoint(directory, parameters, ranks);
          std::vector<std::string> kept;
          if (checkpoint)
            {
              kept = checkpoint->files;
              kept.insert(kept.end(), {checkpoint_name, "log.txt"});
            }
          else
            std::cout << "There is no checkpoint to go on from; the run begins "
                         "at its start."
                      << std::endl;
          folder.keep_only(kept);
        }
      run_plate_test(parameters, directory, std::cout, ranks, checkpoint);
    }

    std::string
    becomes(const ParameterText &text, const CommandLine &command)
    {
      return get_entry(text, command.overrides, "Accuracy/Target")
                   .value_or("off") == "off" ?
               "" :
               PlateTestParameters::error_controlled;
    }

    const Registry<Problem>::Registration
      registration("plate test",
                   {0,
                    "numerical plate testing of a woven cell",
                    start,
                    true,
                    true,
                    true,
                    true,
                    becomes});
  } // namespace
} // namespace NPT
