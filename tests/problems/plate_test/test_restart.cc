// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims that a load step is a function of the accepted state and the increment
// alone, and that a run that was stopped goes on as if it had not been.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/interruption.h>
#include <npt_dealii/problems/plate_results/run_summary.h>
#include <npt_dealii/problems/plate_test/plate_test.h>

#include <catch2/catch.hpp>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <thread>

#include "plate_run.h"

using namespace PlateTestTools;
using Catch::Contains;
namespace fs = std::filesystem;

namespace
{
  const std::vector<std::string> methods      = {"mortar", "KTS"};
  const std::vector<std::string> enforcements = {"penalty",
                                                 "augmented Lagrangian"};

  std::vector<std::string>
  small_cell(const std::string &method, const std::string &enforcement)
  {
    return {"Mesh/Elements along=3",
            "Mesh/Elements across=3",
            "Mesh/Elements through=1",
            "Contact/Method=" + method,
            "Contact/Enforcement=" + enforcement,
            "Friction/Friction coefficient=0.3",
            "Output/Picture=false",
            "Checkpoint/Every steps=1",
            "Load programme/Stages=weave, release, shear, back",
            "Load programme/Stage weave/Initial step=0.2",
            "Load programme/Stage weave/Maximum step=0.2",
            "Load programme/Stage shear/Targets=H3: 0.06",
            "Load programme/Stage shear/Initial step=0.25",
            "Load programme/Stage shear/Maximum step=0.25",
            "Load programme/Stage back/Targets=H3: 0.02",
            "Load programme/Stage back/Initial step=0.5",
            "Load programme/Stage back/Maximum step=0.5"};
  }

  // What a line of overrides sets.
  std::string
  entry_of(const std::string &override_line)
  {
    return override_line.substr(0, override_line.find('='));
  }

  /// @param more Replaces entries; those of stages that are no more are
  /// dropped.
  std::vector<std::string>
  merged(const std::vector<std::string> &overrides,
         const std::vector<std::string> &more)
  {
    const std::string stages     = "Load programme/Stages",
                      stage      = "Load programme/Stage ";
    std::vector<std::string> all = more;
    std::string              names;
    for (const std::string &line : overrides)
      if (std::none_of(more.begin(), more.end(), [&](const std::string &other) {
            return entry_of(other) == entry_of(line);
          }))
        all.push_back(line);
    for (const std::string &line : all)
      if (entry_of(line) == stages)
        names = line.substr(stages.size() + 1) + ",";
    std::vector<std::string> kept;
    for (const std::string &line : all)
      {
        const std::string entry = entry_of(line);
        const std::string name  = entry.substr(0, entry.rfind('/'));
        if (entry.compare(0, stage.size(), stage) != 0 ||
            names.find(name.substr(stage.size()) + ",") != std::string::npos)
          kept.push_back(line);
      }
    return kept;
  }

  PlateTestParameters
  read(const std::vector<std::string> &overrides,
       const std::vector<std::string> &more = {})
  {
    return PlateTestParameters::read(make_parameter_text("", "small.prm"),
                                     merged(overrides, more));
  }

  fs::path
  empty_folder(const std::string &name)
  {
    const fs::path folder =
      fs::path(NPT_BINARY_DIR) / "test_restart_files" / name;
    fs::remove_all(folder);
    fs::create_directories(folder);
    return folder;
  }

  /// Raises SIGTERM at the first accepted step that it is told of.
  class StopAtStep : public std::stringbuf
  {
  protected:
    std::streamsize
    xsputn(const char *text, const std::streamsize n) override
    {
      // Lines of steps begin with a number in five places.
      const bool is_step = n > 5 && std::isdigit(text[4]) && text[5] == ' ';
      if (is_step && !raised_)
        std::raise(SIGTERM);
      raised_ = raised_ || is_step;
      return n;
    }

  private:
    bool raised_ = false;
  };

  /// Run to the end, or stopped after the first step; whether it has ended.
  bool
  run_in(const fs::path                    &folder,
         const PlateTestParameters         &parameters,
         const bool                         stop,
         std::optional<PlateTestCheckpoint> checkpoint = {})
  {
    StopAtStep     stopping;
    std::stringbuf silent;
    std::ostream   screen(stop ? static_cast<std::streambuf *>(&stopping) :
                               &silent);
    try
      {
        run_plate_test(parameters, folder.string(), screen, {}, checkpoint);
      }
    catch (const StageFailed &failure)
      {
        REQUIRE(failure.reason() == "interrupted");
        return false;
      }
    return true;
  }

  bool
  same_bits(const double a, const double b)
  {
    return std::memcmp(&a, &b, sizeof(double)) == 0;
  }

  void
  check_same_curves(const fs::path &a, const fs::path &b)
  {
    const auto first  = read_curves((a / "curves.csv").string()),
               second = read_curves((b / "curves.csv").string());
    REQUIRE(first.size() == second.size());
    for (unsigned int i = 0; i < first.size(); ++i)
      for (const std::string &column : curve_columns())
        if (column == "stage")
          CHECK(first[i].stage == second[i].stage);
        else if (column != "cpu_seconds")
          {
            INFO("row " << i << ", " << column);
            CHECK(same_bits(curve_value(first[i], column),
                            curve_value(second[i], column)));
          }
  }

  /// What a test does besides solving each step.
  enum class Disturbance
  {
    none,
    solve_twice,
    reject_longer ///< every third step, of twice the length
  };

  /// The displacements behind every step.
  std::vector<dealii::Vector<double>>
  drive(const std::vector<std::string> &overrides,
        const Disturbance               disturbance)
  {
    PlateRun    run(overrides);
    const auto &stages = run.parameters.load_programme.stages;
    std::vector<dealii::Vector<double>> result;
    for (unsigned int i = 0; i < stages.size(); ++i)
      {
        const PlateTestStage problem(
          run.cell, run.parameters, i, run.state, run.woven, run.system);
        StepControl          control(stages[i].steps);
        State                state = problem.start();
        std::optional<State> previous;
        const auto           solve = [&](const double load_factor) {
          LoadStep step(problem,
                        state,
                        problem.increment(state, load_factor),
                        run.system,
                        run.linear_solver);
          if (!previous ||
              !step.extrapolate(previous->u,
                                (load_factor - state.load_factor) /
                                  (state.load_factor - previous->load_factor)))
            step.follow_tangent();
          const auto report =
            step.solve(run.parameters.newton, run.parameters.contact);
          return std::make_pair(problem.accept(state,
                                               step.increment(),
                                               step.trial()),
                                report.newton.iterations);
        };
        while (!control.finished())
          {
            const double to       = control.trial();
            const double longer   = std::min(1., 2. * to - state.load_factor);
            const bool   is_third = control.n_accepted() % 3 == 2;
            if (disturbance == Disturbance::solve_twice ||
                (disturbance == Disturbance::reject_longer && is_third))
              try
                {
                  solve(disturbance == Disturbance::solve_twice ? to : longer);
                }
              catch (const LoadStepFailure &)
                {
                  // So much the better.
                }
            try
              {
                auto [accepted, iterations] = solve(to);
                control.accept(iterations);
                previous = state;
                state    = accepted;
              }
            catch (const LoadStepFailure &failure)
              {
                control.reject(failure);
                continue;
              }
            result.push_back(state.u);
          }
        run.state = state;
        if (stages[i].type == LoadStage::Type::weave ||
            stages[i].type == LoadStage::Type::release)
          run.woven = run.cell.woven_positions(state.u);
      }
    return result;
  }
} // namespace



namespace
{
  void
  check_purity(const std::vector<std::string> &overrides)
  {
    const auto straight = drive(overrides, Disturbance::none);
    for (const auto disturbance :
         {Disturbance::solve_twice, Disturbance::reject_longer})
      {
        const auto disturbed = drive(overrides, disturbance);
        REQUIRE(disturbed.size() == straight.size());
        for (unsigned int i = 0; i < straight.size(); ++i)
          {
            INFO("step " << i + 1);
            dealii::Vector<double> difference(disturbed[i]);
            difference -= straight[i];
            // The pattern of the matrix may be wider, so round-off differs.
            CHECK(difference.linfty_norm() <=
                  1e-10 * straight[i].linfty_norm());
          }
      }
  }
} // namespace



TEST_CASE("What was solved and thrown away before a step does not change it",
          "[plate_test]")
{
  for (const std::string &method : methods)
    for (const std::string &enforcement : enforcements)
      {
        INFO(method << ", " << enforcement);
        check_purity(small_cell(method, enforcement));
      }
}



namespace
{
  // Steps in which more than friction remembers: stress that relaxes, a plate
  // whose neighboring cells turn.
  const std::vector<std::string> relaxing = {
    "Load programme/Stages=weave, release, rest, shear",
    "Load programme/Stage rest/Type=relax",
    "Load programme/Stage rest/Relaxed fraction=0.6",
    "Load programme/Stage rest/Initial step=0.25",
    "Load programme/Stage rest/Maximum step=0.25"};
  const std::vector<std::string> bending = {
    "Homogenization/Jumps=objective",
    "Load programme/Stages=weave, release, bend",
    "Load programme/Stage bend/Targets=H4: 0.01",
    "Load programme/Stage bend/Initial step=0.25",
    "Load programme/Stage bend/Maximum step=0.25"};
} // namespace



TEST_CASE("The same while stress relaxes, and in bending with objective jumps",
          "[plate_test]")
{
  check_purity(merged(small_cell("mortar", "penalty"), relaxing));
  check_purity(merged(small_cell("KTS", "penalty"), bending));
}



namespace
{
  // Stop a run after every step, and go on.
  void
  check_stopped_run(const PlateTestParameters &parameters)
  {
    const fs::path straight = empty_folder("straight"),
                   stopped  = empty_folder("stopped");
    REQUIRE(run_in(straight, parameters, false));
    unsigned int n_starts = 1;
    for (bool ended = run_in(stopped, parameters, true); !ended; ++n_starts)
      {
        CHECK(read_run_summary((stopped / "summary.csv").string()).reason ==
              "interrupted");
        const auto checkpoint =
          read_checkpoint(stopped.string(), parameters, {});
        REQUIRE(checkpoint);
        REQUIRE(n_starts < 100);
        ended = run_in(stopped, parameters, true, checkpoint);
      }
    check_same_curves(straight, stopped);
    CHECK(n_starts >= read_curves((straight / "curves.csv").string()).size());
    CHECK(read_run_summary((stopped / "summary.csv").string()).status ==
          "done");
  }
} // namespace



TEST_CASE("A run stopped after every step ends as if it had not been",
          "[plate_test]")
{
  for (const std::string &method : methods)
    for (const std::string &enforcement : enforcements)
      {
        INFO(method << ", " << enforcement);
        check_stopped_run(read(small_cell(method, enforcement)));
      }
}



TEST_CASE("So does one with factors of single precision, and their solutions "
          "are those of double precision",
          "[plate_test]")
{
  const auto overrides = small_cell("mortar", "penalty");
  const auto with      = [&](const std::string &factors) {
    return read(overrides, {"Linear solver/Factors=" + factors});
  };
  check_stopped_run(with("single"));
  const fs::path single = empty_folder("single"), full = empty_folder("double");
  REQUIRE(run_in(single, with("single"), false));
  REQUIRE(run_in(full, with("double"), false));
  const auto a = read_curves((single / "curves.csv").string()),
             b = read_curves((full / "curves.csv").string());
  REQUIRE(a.size() == b.size());
  for (unsigned int i = 0; i < a.size(); ++i)
    for (unsigned int k = 0; k < 3; ++k)
      CHECK(a[i].n[k] == Approx(b[i].n[k]).epsilon(1e-7).margin(1e-9));
}



TEST_CASE("So does one whose friction depends on angle and slip",
          "[plate_test]")
{
  const auto overrides = small_cell("mortar", "augmented Lagrangian");
  const std::vector<std::string> of_yarns = {
    "Friction/Coefficient by angle=80: 0.4, 90: 0.25",
    "Friction/Dynamic friction ratio=0.5",
    "Friction/Slip length=0.01"};
  const auto parameters = read(overrides, of_yarns);
  check_stopped_run(parameters);

  // It is another curve than that of the constant coefficient, so something
  // was remembered.
  const fs::path constant = empty_folder("constant"),
                 yarns    = empty_folder("yarns");
  REQUIRE(run_in(constant, read(overrides), false));
  REQUIRE(run_in(yarns, parameters, false));
  const auto last = [](const fs::path &folder) {
    return read_curves((folder / "curves.csv").string()).back().n[2];
  };
  CHECK(std::abs(last(constant) - last(yarns)) >
        1e-3 * std::abs(last(constant)));
}



TEST_CASE(
  "So does one that is stopped while stress relaxes, or in bending with "
  "objective jumps",
  "[plate_test]")
{
  const auto small = small_cell("KTS", "penalty");
  check_stopped_run(read(small, relaxing));
  check_stopped_run(read(small, bending));
}



namespace
{
  /// Raises SIGTERM, once, when the checkpoint of a folder becomes another one.
  class StopAtCheckpoint
  {
  public:
    explicit StopAtCheckpoint(const fs::path &folder)
      : old_handler(std::signal(SIGTERM, SIG_IGN)) // behind the end of the run
      , thread([this, file = folder / checkpoint_name]() {
        const auto time_of = [&]() {
          std::error_code error;
          return fs::last_write_time(file, error);
        };
        for (const auto before = time_of(); !has_ended;)
          if (time_of() != before)
            {
              kill(getpid(), SIGTERM);
              return;
            }
          else
            std::this_thread::sleep_for(std::chrono::microseconds(200));
      })
    {}

    ~StopAtCheckpoint()
    {
      has_ended = true;
      thread.join();
      std::signal(SIGTERM, old_handler);
    }

  private:
    void (*old_handler)(int);
    std::atomic<bool> has_ended{false};
    std::thread       thread;
  };
} // namespace



TEST_CASE("So does one that is stopped while it weaves on a coarser mesh",
          "[plate_test]")
{
  const auto     parameters = read(small_cell("mortar", "penalty"),
                               {"Mesh/Elements along=7",
                                    "Mesh/Elements across=7",
                                    "Mesh/Weave on coarser mesh=true",
                                    "Load programme/Stages=weave, release"});
  const fs::path straight   = empty_folder("straight"),
                 stopped    = empty_folder("stopped");
  REQUIRE(run_in(straight, parameters, false));
  unsigned int                       n_starts = 0, n_stops_while_weaving = 0;
  std::optional<PlateTestCheckpoint> checkpoint;
  for (bool ended = false; !ended; ++n_starts)
    {
      REQUIRE(n_starts < 100);
      {
        const StopAtCheckpoint watch(stopped);
        ended = run_in(stopped, parameters, false, checkpoint);
      }
      checkpoint = read_checkpoint(stopped.string(), parameters, {});
      REQUIRE(checkpoint);
      if (!ended && checkpoint->coarser_mesh == "4 x 4 x 1")
        ++n_stops_while_weaving;
    }
  CHECK(n_stops_while_weaving > 2);
  CHECK(checkpoint->coarser_mesh.empty());
  check_same_curves(straight, stopped);
}



TEST_CASE("So does one that is stopped in a picture frame or between plates",
          "[plate_test]")
{
  const auto small = small_cell("KTS", "penalty");
  check_stopped_run(
    read(small,
         {"Load programme/Stages=weave, release, turn, press",
          "Load programme/Stage turn/Type=picture frame",
          "Load programme/Stage turn/Targets=shear_angle: 3, warp_tension: "
          "0.3, weft_tension: 0.3",
          "Load programme/Stage turn/Initial step=0.5",
          "Load programme/Stage turn/Maximum step=0.5",
          "Load programme/Stage press/Type=compression",
          "Load programme/Stage press/Targets=plate_distance: 2.3",
          "Load programme/Stage press/Initial step=0.5",
          "Load programme/Stage press/Maximum step=0.5"}));
}



TEST_CASE("Stages may be added to a run that was stopped or has ended",
          "[plate_test]")
{
  const auto                whole = small_cell("mortar", "penalty");
  const PlateTestParameters all   = read(whole);
  const PlateTestParameters short_one =
    read(whole, {"Load programme/Stages=weave, release, shear"});
  const fs::path straight = empty_folder("straight"),
                 extended = empty_folder("extended");
  REQUIRE(run_in(straight, all, false));
  REQUIRE(run_in(extended, short_one, false));
  const auto checkpoint = read_checkpoint(extended.string(), all, {});
  REQUIRE(checkpoint);
  CHECK(checkpoint->stage == 2);
  REQUIRE(run_in(extended, all, false, checkpoint));
  check_same_curves(straight, extended);

  // A run that is done has nothing to do.
  const auto at_end = read_checkpoint(extended.string(), all, {});
  REQUIRE(at_end);
  REQUIRE(run_in(extended, all, false, at_end));
  check_same_curves(straight, extended);
}



TEST_CASE("A checkpoint of another test is refused by the entry",
          "[plate_test]")
{
  const auto                whole  = small_cell("mortar", "penalty");
  const PlateTestParameters given  = read(whole);
  const fs::path            folder = empty_folder("other");
  REQUIRE_FALSE(run_in(folder, given, true));
  const auto refusal = [&](const std::vector<std::string> &more) {
    try
      {
        read_checkpoint(folder.string(), read(whole, more), {});
      }
    catch (const InputError &error)
      {
        return std::string(error.what());
      }
    return std::string("none");
  };
  CHECK_THAT(refusal({"Friction/Friction coefficient=0.2"}),
             Contains("checkpoint.bin") &&
               Contains("Friction coefficient = 0.2 instead of 0.3"));
  CHECK_THAT(refusal({"Mesh/Elements along=4"}), Contains("Elements along"));
  CHECK_THAT(refusal({"Load programme/Stage weave/Initial step=0.05"}),
             Contains("Stage weave/Initial step"));
  CHECK_THAT(refusal({"Load programme/Stages=shear"}),
             Contains("has begun stage 1, weave") && Contains("is shear"));
  // What lies ahead, and what does not change the state.
  CHECK(refusal({"Friction/Friction coefficient=3e-1"}) == "none");
  CHECK(refusal({"Load programme/Stage back/Targets=H3: 0.01"}) == "none");
  CHECK(refusal({"Load programme/Stages=weave, release"}) == "none");
  CHECK(refusal({"Newton/Maximum iterations=50"}) == "none");
  CHECK(refusal({"Output/Fields=none"}) == "none");
  // A cell that the program would choose otherwise for the new stages.
  CHECK_THAT(refusal({"Load programme/Stage back/Targets=H4: 0.01"}),
             Contains("the program chooses Type = "));

  fs::resize_file(folder / "checkpoint.bin", 1000);
  CHECK_THAT(refusal({}), Contains("cut short"));
}



namespace
{
  // Two tests of the released cell, the second after the first.
  std::vector<std::string>
  two_tests(const std::string &stages)
  {
    std::vector<std::string> all = {
      "Cell/Type=two-crossing cell",
      "Cell/Side contact=off",
      "Cell/Mirror planes=false",
      "Load programme/Stages=" + stages,
      "Load programme/Stage pull/Targets=n1: 0.5, n2: 0.2",
      "Load programme/Stage pull/Initial step=0.5",
      "Load programme/Stage pull/Maximum step=0.5",
      "Load programme/Stage bend/Targets=H4: 0.01",
      "Load programme/Stage bend/Initial step=0.5",
      "Load programme/Stage bend/Maximum step=0.5"};
    const std::string later = stages + ",";
    if (later.find("shear,") != std::string::npos)
      for (const std::string name : {"pull", "bend"})
        all.push_back("Load programme/Stage " + name + "/Start=release");
    return all;
  }

  // All but the number of the step.
  void
  check_same_stage(const std::vector<CurveRow> &a,
                   const std::vector<CurveRow> &b,
                   const std::string           &stage)
  {
    const auto of_stage = [&](const std::vector<CurveRow> &rows) {
      std::vector<CurveRow> result;
      for (const CurveRow &row : rows)
        if (row.stage == stage)
          result.push_back(row);
      return result;
    };
    const auto first = of_stage(a), second = of_stage(b);
    REQUIRE(first.size() == second.size());
    REQUIRE(!first.empty());
    for (unsigned int i = 0; i < first.size(); ++i)
      for (const std::string &column : curve_columns())
        if (column != "stage" && column != "step" && column != "cpu_seconds")
          {
            INFO(stage << ", row " << i << ", " << column);
            CHECK(same_bits(curve_value(first[i], column),
                            curve_value(second[i], column)));
          }
  }

  std::vector<CurveRow>
  curve_in(const fs::path &folder)
  {
    return read_curves((folder / "curves.csv").string());
  }
} // namespace



TEST_CASE("A test that begins at an earlier stage is the one that no other "
          "precedes, to the last bit",
          "[plate_test]")
{
  for (const std::string &method : methods)
    {
      INFO(method);
      const auto     small   = small_cell(method, "penalty");
      const fs::path several = empty_folder("several"),
                     pull = empty_folder("pull"), bend = empty_folder("bend");
      REQUIRE(run_in(several,
                     read(small,
                          two_tests("weave, release, shear, back, pull, bend")),
                     false));
      REQUIRE(
        run_in(pull, read(small, two_tests("weave, release, pull")), false));
      REQUIRE(
        run_in(bend, read(small, two_tests("weave, release, bend")), false));
      check_same_stage(curve_in(several), curve_in(pull), "pull");
      check_same_stage(curve_in(several), curve_in(bend), "bend");
    }
}



TEST_CASE("So is one that is stopped in a later test, and a test that is added "
          "to a run that is done",
          "[plate_test]")
{
  const auto small = small_cell("KTS", "penalty");
  check_stopped_run(
    read(small, two_tests("weave, release, shear, pull, bend")));

  const auto added = [&](const std::vector<std::string> &more) {
    return read(merged(small, two_tests("weave, release, shear, pull")), more);
  };
  const fs::path straight = empty_folder("straight"),
                 extended = empty_folder("extended");
  REQUIRE(run_in(straight, added({}), false));
  REQUIRE(run_in(extended,
                 read(small,
                      {"Cell/Type=two-crossing cell",
                       "Cell/Side contact=off",
                       "Cell/Mirror planes=false",
                       "Load programme/Stages=weave, release, shear"}),
                 false));
  const auto checkpoint = read_checkpoint(extended.string(), added({}), {});
  REQUIRE(checkpoint);
  REQUIRE(run_in(extended, added({}), false, checkpoint));
  check_same_curves(straight, extended);
  // The run had no reason to keep other ends.
  CHECK_THROWS_WITH(
    read_checkpoint(extended.string(),
                    read(merged(small,
                                two_tests("weave, release, shear, pull, bend")),
                         {"Load programme/Stage bend/Start=shear"}),
                    {}),
    Contains("has not kept the end of stage shear, where stage bend begins"));
}
