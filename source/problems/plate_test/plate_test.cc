// SPDX-License-Identifier: LGPL-2.1-or-later
// The problem "plate test": the run, its summary, its registration.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/interruption.h>
#include <npt_dealii/base/problem.h>
#include <npt_dealii/problems/plate_results/run_summary.h>
#include <npt_dealii/problems/plate_test/numerical_plate_testing.h>
#include <npt_dealii/problems/plate_test/plate_test.h>

#include <algorithm>
#include <iostream>

namespace NPT
{
  void
  run_plate_test(const PlateTestParameters &parameters,
                 const std::string         &directory,
                 std::ostream              &screen,
                 const Ranks               &ranks)
  {
    const Interruption    interruption;
    NumericalPlateTesting test(parameters, directory, screen, ranks);
    const auto            write = [&](const RunSummary &summary) {
      if (ranks.is_first())
        write_run_summary(directory + "/summary.csv", summary);
    };
    const auto summarize = [&]() {
      RunSummary summary = summarize_curve(test.curve());
      summary.status     = "done";
      summary.n_unknowns = test.n_unknowns();
      return summary;
    };
    try
      {
        test.run();
      }
    catch (const StageFailed &failure)
      {
        RunSummary summary = summarize();
        summary.status     = "failed";
        summary.reason     = failure.reason();
        if (summary.stage.empty()) // not even one step
          summary.stage = failure.stage();
        summary.message = failure.what();
        // The curve has the cuts of accepted steps only.
        unsigned int cuts_of_stage = 0;
        for (const CurveRow &row : test.curve())
          cuts_of_stage += row.stage == failure.stage() ? row.cuts : 0;
        summary.cuts +=
          std::max(failure.n_cuts(), cuts_of_stage) - cuts_of_stage;
        write(summary);
        throw;
      }
    write(summarize());
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
      if (done_with_parameters(command, parameters))
        return;
      parameters.linear_solver.check(ranks);
      const std::string directory =
        make_output_directory(command, parameters.output.directory, ranks);
      if (command.action == CommandLine::Action::geometry)
        {
          if (ranks.is_first())
            NumericalPlateTesting(parameters, directory, std::cout).preview();
        }
      else
        run_plate_test(parameters, directory, std::cout, ranks);
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
                    becomes});
  } // namespace
} // namespace NPT
