// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the claims on reading a load programme.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/parameter_file.h>
#include <npt_dealii/problems/load_programme/load_programme.h>
#include <npt_dealii/problems/plate_test/plate_test_parameters.h>

#include <catch2/catch.hpp>

using namespace NPT;
using Type = LoadStage::Type;

namespace
{
  /// Both passes, as the program does them.
  LoadProgramme
  read(const std::string &entries)
  {
    const auto text =
      make_parameter_text("subsection Load programme\n" + entries + "\nend\n",
                          "file.prm");
    LoadProgramme programme(
      get_entry(text, {}, "Load programme/Stages").value_or(""));
    dealii::ParameterHandler prm;
    programme.add_parameters(prm);
    parse_parameter_text(prm, text);
    programme.check();
    return programme;
  }

  std::string
  stage(const std::string &name, const std::string &entries)
  {
    return "subsection Stage " + name + "\n" + entries + "\nend\n";
  }

  std::string
  input_error(const std::string &entries)
  {
    try
      {
        read(entries);
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "none";
  }
} // namespace

TEST_CASE("Without entries the programme weaves, releases and shears",
          "[solver]")
{
  const auto stages = read("").stages;
  REQUIRE(stages.size() == 3);

  CHECK(stages[0].name == "weave");
  CHECK(stages[0].type == Type::weave);
  CHECK(stages[0].H_targets.empty());
  CHECK_FALSE(stages[0].friction);
  CHECK(stages[0].steps.initial_step == 0.025);
  CHECK(stages[0].steps.maximum_step == 0.1);

  CHECK(stages[1].name == "release");
  CHECK(stages[1].type == Type::release);
  CHECK_FALSE(stages[1].friction);
  CHECK(stages[1].steps.initial_step == 1);
  CHECK(stages[1].steps.maximum_step == 1);

  CHECK(stages[2].name == "shear");
  CHECK(stages[2].type == Type::load);
  CHECK(stages[2].H_targets == std::map<unsigned int, double>{{2, 0.2}});
  CHECK(stages[2].n_targets.empty());
  CHECK(stages[2].friction);
  CHECK(stages[2].steps.initial_step == 0.05);
  CHECK(stages[2].steps.minimum_step == 1e-4);
  CHECK(stages[2].steps.maximum_step == 0.05);
  CHECK(stages[2].steps.target_iterations == 8);
}

TEST_CASE("Stages, targets and choices are read as written", "[solver]")
{
  const auto stages =
    read("set Stages = interlace, release, pull, tension\n" +
         stage("interlace",
               "set Type = weave\nset Targets = n1: 0, n2: 0\n"
               "set Friction = true") +
         stage("pull",
               "set Targets = H1: 0.1, n2: 0, H6: -0.02, n4: 1.5\n"
               "set Initial step = 0.02\nset Maximum step = 0.08\n"
               "set Minimum step = 0.001\nset Target iterations = 6\n"
               "set Friction = false"))
      .stages;
  REQUIRE(stages.size() == 4);
  CHECK(stages[0].type == Type::weave);
  CHECK(stages[0].friction);
  CHECK(stages[0].n_targets ==
        std::map<unsigned int, double>{{0, 0.}, {1, 0.}});
  CHECK(stages[2].name == "pull");
  CHECK(stages[2].type == Type::load);
  CHECK(stages[2].H_targets ==
        std::map<unsigned int, double>{{0, 0.1}, {5, -0.02}});
  CHECK(stages[2].n_targets ==
        std::map<unsigned int, double>{{1, 0.}, {3, 1.5}});
  CHECK_FALSE(stages[2].friction);
  CHECK(stages[2].steps.initial_step == 0.02);
  CHECK(stages[2].steps.maximum_step == 0.08);
  CHECK(stages[2].steps.minimum_step == 0.001);
  CHECK(stages[2].steps.target_iterations == 6);
  CHECK(stages[3].H_targets == std::map<unsigned int, double>{{0, 0.2}});
}

TEST_CASE("A programme that cannot be is refused in one sentence", "[solver]")
{
  using Catch::Contains;
  CHECK_THAT(input_error(stage("shear", "set Targets = H3: 0.1, n3: 0")),
             Contains("both H3 and n3") && Contains("Stage shear"));
  CHECK_THAT(input_error(stage("shear", "set Targets = H3: 0.1, H3: 0.2")),
             Contains("H3 twice"));
  CHECK_THAT(input_error("set Stages = weave, release, shear, shear"),
             Contains("shear twice"));
  CHECK_THAT(input_error("set Stages = shear, weave, release"),
             Contains("weave weaves after load stage shear"));
  CHECK_THAT(input_error("set Stages = release, shear"),
             Contains("no stage before it weaves"));
  CHECK_THAT(input_error("set Stages = weave, shear, release"),
             Contains("shear loads before"));
  CHECK_THAT(input_error("set Stages = weave, shear"),
             Contains("shear loads before"));
  CHECK_THAT(input_error("set Stages = weave, again, release\n" +
                         stage("again", "set Type = weave")),
             Contains("woven already"));
  CHECK_THAT(input_error("set Stages = weave, release, again\n" +
                         stage("again", "set Type = release")),
             Contains("released already"));
  CHECK_THAT(input_error("set Stages = weave, release, bend"),
             Contains("Targets is empty") && Contains("Stage bend"));
  CHECK_THAT(input_error(stage("shear", "set Initial step = 0.5")),
             Contains("Initial step is 0.5") && Contains("Maximum step 0.05"));
  CHECK_THAT(input_error(stage("shear", "set Minimum step = 0.2")),
             Contains("Minimum step is 0.2"));
  // Allowed: bodies that need no weaving, weaving alone.
  CHECK(input_error("set Stages = shear") == "none");
  CHECK(input_error("set Stages = weave, release") == "none");
  CHECK(input_error("set Stages = tension, shear") == "none");
}

TEST_CASE("A component that does not exist is refused by the pattern",
          "[solver]")
{
  CHECK_THROWS(read(stage("shear", "set Targets = H7: 0.1")));
  CHECK_THROWS(read(stage("shear", "set Targets = 0.1")));
}



TEST_CASE("No two stages share the names of their files", "[solver]")
{
  const LoadProgramme program =
    read("set Stages = load +, load *, Load _, load -, load __2\n" +
         stage("load +", "set Targets = H3: 0.02") +
         stage("load *", "set Targets = H3: 0") +
         stage("Load _", "set Targets = H3: 0.02") +
         stage("load -", "set Targets = H3: 0") +
         stage("load __2", "set Targets = H3: 0"));
  CHECK(program.file_name("load +") == "load__");
  CHECK(program.file_name("load *") == "load___2");
  CHECK(program.file_name("Load _") == "Load___3");
  CHECK(program.file_name("load -") == "load_-");
  CHECK(program.file_name("load __2") == "load___2_2");
}



TEST_CASE(
  "A later list of stages leaves out stages with their subsections, and "
  "misspelt ones are still refused",
  "[solver]")
{
  const std::string file = "subsection Load programme\n"
                           "set Stages = weave, release, pull, shear\n" +
                           stage("pull", "set Targets = n1: 0.1") +
                           stage("shear", "set Targets = H3: 0.3") + "end\n";
  const auto later = [](const std::string &text, const std::string &stages) {
    return PlateTestParameters::read(make_parameter_text(text, "file.prm"),
                                     {"Load programme/Stages=" + stages})
      .load_programme.stages;
  };
  const auto kept = later(file, "weave, release, shear");
  REQUIRE(kept.size() == 3);
  CHECK(kept[2].H_targets.at(2) == 0.3);
  CHECK(later(file, "weave, release, pull").size() == 3);
  CHECK(later("subsection Load programme\nset Stages = weave, release, shear\n"
              "set Further stages = pull\n" +
                stage("pull", "set Targets = n1: 0.1") + "end\n",
              "weave, release, pull")
          .size() == 3);
  CHECK_THROWS_AS(later(file + "subsection Load programme\n" +
                          stage("pul", "set Targets = n1: 1") + "end\n",
                        "weave, release, shear"),
                  InputError);
  // What is wrong in them is wrong today.
  const std::string further =
    "subsection Load programme\nset Further stages = pull\n";
  CHECK_THROWS_AS(later(further + stage("pull", "set Initial step = pi") +
                          "end\n",
                        "weave, release"),
                  InputError);
  CHECK_THROWS_AS(later("subsection Load programme\n"
                        "set Stages = weave, release, pull\n" +
                          stage("pull", "set Initial step = pi") + "end\n",
                        "weave, release"),
                  InputError);
  CHECK_NOTHROW(
    later(further + stage("pull", "set Initial step = 0.1") + "end\n",
          "weave, release"));
}



TEST_CASE("Stages are so many, and their names so long, as files can be named",
          "[solver]")
{
  std::string many = "a";
  for (unsigned int i = 0; i < 1000; ++i)
    many += ", a";
  CHECK(input_error("set Stages = " + many) ==
        "Stages names 1001 stages; there may be at most 1000 (subsection Load "
        "programme).");
  const std::string name(101, 'x');
  CHECK(
    input_error("set Stages = " + name) ==
    "Stages names '" + name +
      "', which has 101 characters; a name may have at most 100 (subsection "
      "Load programme).");
}



TEST_CASE("A stage begins at the end of the earlier one that it names",
          "[solver]")
{
  using Catch::Contains;
  const std::string list =
    "set Stages = weave, release, pull, shear, again, tension\n" +
    stage("pull", "set Targets = n1: 0.1");
  const auto stages = read(list + stage("shear", "set Start = pull") +
                           stage("again", "set Targets = H3: 0") +
                           stage("tension", "set Start = release"))
                        .stages;
  CHECK_FALSE(stage_before(stages, 0));
  CHECK(*stage_before(stages, 3) == 2);
  CHECK(*stage_before(stages, 4) == 3);
  CHECK(path_to(stages, 4) == std::vector<unsigned int>{0, 1, 2, 3, 4});
  CHECK(path_to(stages, 5) == std::vector<unsigned int>{0, 1, 5});

  const std::string again = stage("again", "set Targets = H3: 0");
  CHECK_THAT(
    input_error(list + again + stage("shear", "set Start = pul")),
    Contains("Start is 'pul', which is no stage before shear in Stages; those "
             "are weave, release, pull; did you mean 'pull'?") &&
      Contains("Stage shear"));
  CHECK_THAT(input_error(list + again + stage("shear", "set Start = tension")),
             Contains("no stage before shear"));
  CHECK_THAT(input_error("set Stages = shear\n" +
                         stage("shear", "set Start = shear")),
             Contains("first stage has none before it"));
  // The order counts on the way to a stage.
  CHECK_THAT(input_error(list + again + stage("shear", "set Start = weave")),
             Contains("shear loads before the weave"));
  CHECK(input_error("set Stages = weave, release, shear, rest, tension\n" +
                    stage("rest",
                          "set Type = relax\nset Relaxed fraction = 1\n"
                          "set Start = release")) == "none");
}



TEST_CASE("Tests that begin at one stage know nothing of each other",
          "[solver]")
{
  const auto read_test = [](const std::string &start) {
    return PlateTestParameters::read(
      make_parameter_text("subsection Load programme\n"
                          "set Stages = weave, release, bend, turn, shear\n" +
                            stage("bend", "set Targets = H4: 0.01") +
                            stage("turn", "set Targets = H5: 0.01" + start) +
                            stage("shear", "set Targets = H3: 0.3" + start) +
                            "end\n",
                          "file.prm"));
  };
  // One after the other they would bend about two axes.
  CHECK_FALSE(read_test("").load_programme.stages[2].bends_along);
  const auto stages = read_test("\nset Start = release").load_programme.stages;
  REQUIRE(stages[2].bends_along);
  REQUIRE(stages[3].bends_along);
  CHECK(std::abs(*stages[2].bends_along * *stages[3].bends_along) < 1e-12);
  CHECK_FALSE(stages[4].bends_along);
}
