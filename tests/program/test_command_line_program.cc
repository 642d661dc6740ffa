// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about the program as a process: options, exit status, and which files
// a run leaves behind.

#include <npt_dealii/base/command_line.h>
#include <npt_dealii/base/parameter_file.h>
#include <npt_dealii/base/problem.h>
#include <npt_dealii/problems/plate_results/curve_writer.h>
#include <npt_dealii/problems/plate_test/plate_test_parameters.h>

#include <catch2/catch.hpp>

#include <iostream>
#include <set>
#include <sstream>

#include "run_program.h"

using namespace NPT;
using namespace TopTests;
namespace fs = std::filesystem;

namespace
{
  const std::string shear = NPT_SOURCE_DIR "/prm/shear.prm";

  // Weaving to one half on a mesh of some dozen cells: the smallest run in
  // which bundles touch.
  const std::vector<std::string> small = {
    "--set=Mesh/Elements along=3",
    "--set=Mesh/Elements across=3",
    "--set=Mesh/Elements through=1",
    "--set=Cell/Weaving depth=0.5",
    "--set=Load programme/Stage shear/Targets=H3: 0.02",
    "--set=Load programme/Stage shear/Initial step=0.5",
    "--set=Load programme/Stage shear/Maximum step=0.5"};

  /// What is written on the screen goes into a stream instead.
  class CaptureScreen
  {
  public:
    CaptureScreen(std::ostream &out)
      : before(std::cout.rdbuf(out.rdbuf()))
    {}

    ~CaptureScreen()
    {
      std::cout.rdbuf(before);
    }

  private:
    std::streambuf *before;
  };

  std::vector<std::string>
  operator+(std::vector<std::string> a, const std::vector<std::string> &b)
  {
    a.insert(a.end(), b.begin(), b.end());
    return a;
  }
} // namespace



TEST_CASE("Help and version are printed without a parameter file", "[top]")
{
  const fs::path work   = fresh_folder("help");
  ProgramResult  result = run_program(work, {"--help"});
  CHECK(result.status == 0);
  CHECK(result.out == help_text());
  CHECK(result.err.empty());

  result = run_program(work, {"--version"});
  CHECK(result.status == 0);
  CHECK(result.out == version_text());
  CHECK(result.err.empty());
}



TEST_CASE("A mistake on the command line ends with status 2", "[top]")
{
  const fs::path work   = fresh_folder("command_line");
  ProgramResult  result = run_program(work, {});
  CHECK(result.status == 2);
  CHECK(result.err == "npt_dealii: the parameter file is missing, write "
                      "npt_dealii FILE.prm (see npt_dealii --help)\n");

  result = run_program(work, {shear, "--otput", "x"});
  CHECK(result.status == 2);
  CHECK(result.err == "npt_dealii: unknown option '--otput'; did you mean "
                      "'--output'? (see npt_dealii --help)\n");
  CHECK(result.out.empty());
}



TEST_CASE("Validation computes nothing", "[top]")
{
  const fs::path      work   = fresh_folder("validate");
  const ProgramResult result = run_program(work, {shear, "--validate"});
  CHECK(result.status == 0);
  CHECK(result.out == shear + " is valid.\n");
  CHECK(result.err.empty());
  CHECK_FALSE(fs::exists(work / "output"));
}



TEST_CASE("The printed defaults are a parameter file that means the defaults",
          "[top]")
{
  const fs::path      work    = fresh_folder("defaults");
  const ProgramResult printed = run_program(work, {"--print-defaults"});
  REQUIRE(printed.status == 0);
  CHECK(printed.err.empty());
  CHECK(printed.out == PlateTestParameters::documented_defaults());

  // An empty file has all defaults as well.
  const PlateTestParameters defaults =
    PlateTestParameters::read(make_parameter_text("", "empty.prm"));
  const PlateTestParameters again =
    PlateTestParameters::read(make_parameter_text(printed.out, "defaults.prm"));
  CHECK(again.used_file == defaults.used_file);
  CHECK(again.used_file == printed.out);

  // With a file, its values and the overrides are printed, and their reading
  // back gives the same once more.
  const ProgramResult of_file =
    run_program(work, {shear, "--print-defaults", "--set", "Mesh/Degree=3"});
  REQUIRE(of_file.status == 0);
  const PlateTestParameters read =
    PlateTestParameters::read(make_parameter_text(of_file.out, "used.prm"));
  CHECK(read.used_file == of_file.out);
  CHECK(read.mesh.degree == 3);
}



TEST_CASE("Every parameter file that comes with the program is valid", "[top]")
{
  // Read here as the programs read it; of each problem one file is given to the
  // program as well, since a start takes half a second.
  std::set<std::string> started;
  unsigned int          n_files = 0;
  for (const auto &entry :
       fs::recursive_directory_iterator(NPT_SOURCE_DIR "/prm"))
    if (entry.path().extension() == ".prm")
      {
        const std::string file = entry.path().string();
        INFO(file);
        const ParameterText text = read_parameter_text(file);
        const std::string   problem =
          get_entry(text, {}, "Problem").value_or("plate test");
        CommandLine command;
        command.parameter_file = file;
        command.action         = CommandLine::Action::validate;
        std::ostringstream out;
        {
          const CaptureScreen capture(out);
          CHECK_NOTHROW(
            Registry<Problem>::instance().get(problem).start(text, command));
        }
        CHECK_THAT(out.str(), Catch::EndsWith(file + " is valid.\n"));

        if (started.insert(problem).second)
          {
            const ProgramResult result =
              run_program(fresh_folder("valid"), {file, "--validate"});
            CHECK(result.out == out.str());
            CHECK(result.err.empty());
            CHECK(result.status == 0);
          }
        ++n_files;
      }
  CHECK(n_files >= 50);
  CHECK(started.size() == Registry<Problem>::instance().names().size());
}



TEST_CASE("A run leaves curves, fields, log, picture and the parameters that "
          "made them",
          "[top]")
{
  const fs::path      work = fresh_folder("run");
  const ProgramResult result =
    run_program(work,
                std::vector<std::string>{shear, "--output", "results"} + small);
  INFO(result.out);
  REQUIRE(result.status == 0);
  CHECK(result.err.empty());
  CHECK_FALSE(fs::exists(work / "output"));

  const fs::path results = work / "results";
  for (const char *name : {"curves.csv",
                           "log.txt",
                           "used_parameters.prm",
                           "fields.pvd",
                           "contact.pvd",
                           "curves.gp",
                           "cell_weave.gp",
                           "cell_weave.dat",
                           "cell_shear.gp",
                           "cell_shear.dat"})
    CHECK(fs::exists(results / name));
  // One pair of field files per stage, and the records name existing files.
  for (const char *record : {"fields.pvd", "contact.pvd"})
    {
      const std::string text    = read_text(results / record);
      unsigned int      n_files = 0;
      for (std::size_t at = text.find("file=\""); at != std::string::npos;
           at             = text.find("file=\"", at + 1), ++n_files)
        {
                      const std::size_t begin = at + 6;
                      const std::string name =
                        text.substr(begin, text.find('"', begin) - begin);
                      CHECK(fs::exists(results / name));
        }
      CHECK(n_files == 3);
    }

  const auto curve = read_curves((results / "curves.csv").string());
  REQUIRE(curve.size() >= 4);
  CHECK(curve.back().stage == "shear");
  CHECK(curve.back().load_factor == 1.);
  CHECK(curve.back().H[2] == Approx(0.02).epsilon(1e-14));
  CHECK(curve.back().n[2] > 0);
  CHECK(curve.back().n_active > 0);

  // The file kept with the results repeats the run.
  const std::string used = read_text(results / "used_parameters.prm");
  CHECK(PlateTestParameters::read(make_parameter_text(used, "used.prm"))
          .used_file == used);
  const ProgramResult second =
    run_program(work, {"results/used_parameters.prm", "--output", "second"});
  REQUIRE(second.status == 0);
  const auto again = read_curves((work / "second/curves.csv").string());
  REQUIRE(again.size() == curve.size());
  for (unsigned int s = 0; s < curve.size(); ++s)
    for (unsigned int k = 0; k < 6; ++k)
      {
        CHECK(again[s].H[k] == curve[s].H[k]);
        CHECK(again[s].n[k] ==
              Approx(curve[s].n[k]).epsilon(1e-9).margin(1e-12));
      }
}



TEST_CASE("A stage that cannot be finished ends with status 1 and keeps its "
          "results",
          "[top]")
{
  // One Newton iteration per step is too few, whatever the step.
  const fs::path      work   = fresh_folder("failed");
  const ProgramResult result = run_program(
    work,
    std::vector<std::string>{shear,
                             "--output",
                             "results",
                             "--set",
                             "Newton/Maximum iterations=1",
                             "--set",
                             "Load programme/Stage weave/Initial step=0.1",
                             "--set",
                             "Load programme/Stage weave/Minimum step=0.05"} +
      small);
  CHECK(result.status == 1);
  CHECK_THAT(result.err, Catch::StartsWith("npt_dealii: "));
  CHECK_THAT(result.err, Catch::Contains("weave"));
  CHECK(fs::exists(work / "results/used_parameters.prm"));
  CHECK_NOTHROW(read_curves((work / "results/curves.csv").string()));
}



TEST_CASE("An output directory that cannot be made ends with status 2", "[top]")
{
  const fs::path work = fresh_folder("no_directory");
  std::ofstream(work / "taken") << "a file\n";
  for (const std::string name : {"taken", "taken/below"})
    {
      const ProgramResult result = run_program(work, {shear, "--output", name});
      CHECK(result.status == 2);
      CHECK_THAT(result.err,
                 Catch::StartsWith("npt_dealii: The output directory '" + name +
                                   "' cannot be created"));
      CHECK(result.out.empty());
    }
}



TEST_CASE("What only reads needs no MPI, and one process needs no helper of it",
          "[top]")
{
  const fs::path work = fresh_folder("no_mpi");
  // Open MPI finds no way to send messages, and then not its own programs.
  const std::string broken = "OMPI_MCA_pml=nothing",
                    alone  = "OPAL_BINDIR=" + work.string();
  const auto run           = [&](const std::string              &variable,
                       const std::vector<std::string> &arguments) {
    return run_program(
      work,
      std::vector<std::string>{"-i",
                               "PATH=" + std::string(std::getenv("PATH")),
                               "OMPI_ALLOW_RUN_AS_ROOT=1",
                               "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1",
                               variable,
                               NPT_PROGRAM,
                               shear} +
        arguments,
      "env");
  };
  CHECK(run(broken, {"--validate"}).status == 0);
  CHECK(run(broken, {"--print-defaults"}).status == 0);
  CHECK(run(broken, {"--geometry-only", "--output=cell"}).status == 0);
  CHECK(fs::exists(work / "cell/geometry.vtu"));
  CHECK(run(broken, small).status != 0);
  CHECK(run(alone, small).status == 0);
}



TEST_CASE("A problem of one process is refused under mpirun with status 2 "
          "before it makes a folder",
          "[top]")
{
  const fs::path    work    = fresh_folder("mpirun");
  const std::string command = "cd '" + work.string() +
                              "' && env -i PATH=\"$PATH\" HOME=\"$HOME\" "
                              "OMPI_ALLOW_RUN_AS_ROOT=1 "
                              "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
                              "mpirun --oversubscribe -n 2 '" NPT_PROGRAM
                              "' '" NPT_SOURCE_DIR
                              "/prm/nmt.prm' > out.txt 2> err.txt";
  const int status = std::system(command.c_str());
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 2);
  const std::string message = read_text(work / "err.txt");
  CHECK_THAT(message, Catch::Contains("mpirun started 2"));
  // One of them speaks for all.
  CHECK(message.find("npt_dealii: ") == message.rfind("npt_dealii: "));
  CHECK_FALSE(fs::exists(work / "output"));
}
