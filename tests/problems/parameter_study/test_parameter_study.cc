// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about parameter studies: which cases a file stands for, what is
// refused, and a whole study as a user runs it.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/io/table_file.h>
#include <npt_dealii/problems/parameter_study/parameter_study.h>
#include <npt_dealii/problems/plate_test/plate_test_parameters.h>

#include <catch2/catch.hpp>

#include "run_program.h"

using namespace NPT;
using namespace TopTests;
namespace fs = std::filesystem;

namespace
{
  const std::string problem = "set Problem = parameter study\n";

  StudyParameters
  read(const std::string              &content,
       const std::vector<std::string> &overrides = {})
  {
    return StudyParameters::read(make_parameter_text(problem + content,
                                                     NPT_SOURCE_DIR
                                                     "/prm/made.prm"),
                                 overrides);
  }

  std::string
  message_of(const std::string &content)
  {
    try
      {
        read(content);
      }
    catch (const InputError &error)
      {
        const std::string prefix  = NPT_SOURCE_DIR "/prm/";
        std::string       message = error.what();
        for (std::size_t at = message.find(prefix); at != std::string::npos;
             at             = message.find(prefix))
          message.erase(at, prefix.size());
        return message;
      }
    return "no error";
  }
} // namespace



TEST_CASE("A study's cases are its base file with the values of the loops",
          "[top]")
{
  const auto study = read("subsection Study\n"
                          "  set Base = {shear | biaxial}.prm\n"
                          "end\n"
                          "subsection Mesh\n"
                          "  set Elements along = {3 | 5}\n"
                          "end\n");
  REQUIRE(study.cases.size() == 4);
  CHECK(describe_case(study.cases[3]) == "Base biaxial, Elements along 5");
  for (unsigned int c = 0; c < 4; ++c)
    {
      const PlateTestParameters parameters = PlateTestParameters::read(
        make_parameter_text(study.cases[c].parameters, "case.prm"));
      // The file of a case is complete: it repeats itself.
      CHECK(parameters.used_file == study.cases[c].parameters);
      CHECK(parameters.load_programme.stages.back().name ==
            (c % 2 == 0 ? "shear" : "biaxial"));
      CHECK(parameters.mesh.elements_along == (c < 2 ? 3 : 5));
      CHECK(parameters.output.fields == OutputParameters::Fields::none);
      CHECK(study.details[c].component == (c % 2 == 0 ? 2u : 0u));
    }
}



TEST_CASE("The file that is kept with a study's results means the same study",
          "[top]")
{
  const auto study = read("subsection Study\n"
                          "  set Kind = work-precision\n"
                          "  set Base = {shear.prm | biaxial.prm}\n"
                          "  subsection Reference\n"
                          "    subsection Mesh\n"
                          "      set Elements along = {{7 | 9}}\n"
                          "    end\n"
                          "  end\n"
                          "end\n"
                          "subsection Mesh\n"
                          "  set Elements along = {3 | 5}\n"
                          "end\n",
                          {"Friction/Friction coefficient=0.1"});
  REQUIRE(study.references.size() == 2);
  REQUIRE(study.references[0].size() == 2);

  const fs::path folder = fresh_folder("used_study");
  std::ofstream(folder / "used_study.prm")
    << study.used_file_in(folder.string());
  const auto again = StudyParameters::read(
    read_parameter_text((folder / "used_study.prm").string()));
  REQUIRE(again.cases.size() == study.cases.size());
  for (unsigned int c = 0; c < study.cases.size(); ++c)
    CHECK(again.cases[c].parameters == study.cases[c].parameters);
  for (unsigned int g = 0; g < 2; ++g)
    for (unsigned int i = 0; i < 2; ++i)
      CHECK(again.references[g][i].parameters ==
            study.references[g][i].parameters);
}



TEST_CASE("A mistake in a study is refused with one sentence", "[top]")
{
  CHECK(message_of("subsection Study\n set Kind = swep\nend\n") ==
        "made.prm:3: entry 'Kind' in subsection 'Study' is 'swep'; it must be "
        "one of: sweep, work-precision, stability map, sensitivity; did you "
        "mean 'sweep'?");
  CHECK(message_of("subsection Study\n set Base = sheer.prm\nend\n") ==
        "made.prm:3: Base: file 'sheer.prm' not found; did you mean "
        "'shear.prm'?");
  CHECK(message_of("subsection Study\n set Base = nmt.prm\nend\n") ==
        "The base file 'nmt.prm' is a material test; studies run plate tests "
        "(subsection Study).");
  CHECK(message_of("subsection Study\n set Curve = H3\nend\n") ==
        "Curve is 'H3'; it must be 'automatic' or two columns of curves.csv, "
        "as in 'H3: n3' (subsection Study).");
  CHECK_THAT(message_of("subsection Study\n set Curve = H3: n7\nend\n"),
             Catch::StartsWith("There is no curve column 'n7'"));
  CHECK(message_of("subsection Study\n set Panels = Degree\nend\n"
                   "subsection Mesh\n set Elements along = {3 | 5}\nend\n") ==
        "'Degree' is not an entry with a loop; the loops of this study are: "
        "Elements along (subsection Study).");
  CHECK(message_of("subsection Study\n set Kind = stability map\nend\n"
                   "subsection Mesh\n set Degree = {2 | 3}\nend\n") ==
        "A stability map needs two swept entries as axes, found 1 loops; write "
        "values in braces, {10 | 100} (subsection Study).");
  CHECK(message_of("subsection Study\n set Kind = work-precision\nend\n"
                   "subsection Mesh\n set Degree = {2 | 3}\nend\n") ==
        "A work-precision study needs a reference: set 'Mesh/Degree', which is "
        "swept, in subsection Reference of subsection Study as well; {{a | b}} "
        "there gives the two finest cases, the finest last.");
  // A value that only one case has: the case is named.
  CHECK(message_of("subsection Mesh\n set Degree = {2 | 3.5}\nend\n") ==
        "made.prm:3: entry 'Degree' in subsection 'Mesh' is '3.5'; it must be "
        "an integer in [2, 5] [case 2: Degree 3.5]");
}



TEST_CASE("A study runs its cases, survives a failed one, goes on where it was "
          "and recommends a setting",
          "[top]")
{
  // The smallest run in which bundles touch, with two penalties and lengths of
  // a step; with one Newton iteration the stage cannot be finished.
  const fs::path work = fresh_folder("study");
  std::ofstream(work / "small.prm")
    << "subsection Mesh\n set Elements along = 3\n set Elements across = 3\n"
       " set Elements through = 1\nend\n"
       "subsection Cell\n set Weaving depth = 0.5\nend\n"
       "subsection Load programme\n subsection Stage weave\n"
       "  set Initial step = 0.1\n  set Minimum step = 0.05\n end\n"
       " subsection Stage shear\n"
       "  set Targets = H3: 0.02\n  set Initial step = 0.5\n"
       "  set Maximum step = 0.5\n end\nend\n";
  const std::string reference = " subsection Reference\n  subsection Newton\n"
                                "   set Maximum iterations = 25\n  end\n"
                                "  subsection Contact\n"
                                "   set Normal penalty = {{100 | 200}}\n"
                                "  end\n end\n";
  const std::string cases = "subsection Newton\n set Maximum iterations = {1 | "
                            "25}\nend\nsubsection Contact\n set Normal penalty "
                            "= {50 | 100}\nend\n";
  std::ofstream(work / "study.prm")
    << problem << "subsection Study\n set Kind = work-precision\n"
    << " set Base = small.prm\n set Accuracies = 0.9\n"
    << reference << "end\n"
    << cases;

  const ProgramResult first = run_program(work, {"study.prm"});
  INFO(first.out + first.err);
  REQUIRE(first.status == 0);
  CHECK(first.err.empty());
  CHECK_THAT(first.out, Catch::Contains("6 cases, 5 to run"));

  const fs::path results = work / "output-study";
  const Table    table   = read_table((results / "cases.csv").string());
  REQUIRE(table.n_rows() == 6);
  const auto status = table.text_column("status");
  CHECK(std::count(status.begin(), status.end(), "done") == 4);
  CHECK(std::count(status.begin(), status.end(), "failed") == 2);
  for (unsigned int r = 0; r < 6; ++r)
    {
      CHECK(table.column("unknowns")[r] > 100);
      CHECK(table.text_column("stage")[r] ==
            (status[r] == "done" ? "shear" : "weave"));
      CHECK(table.text_column("reason")[r] ==
            (status[r] == "done" ? "" : "iteration limit"));
      CHECK(table.column("cpu_seconds")[r] > 0);
    }
  const Table recommended = read_table((results / "recommended.csv").string());
  REQUIRE(recommended.n_rows() == 1);
  CHECK_THAT(recommended.text_column("setting")[0],
             Catch::StartsWith("Maximum iterations 25"));

  // The second start computes one new case only.
  const ProgramResult second =
    run_program(work,
                {"study.prm", "--set", "Contact/Normal penalty={50 | 25}"});
  INFO(second.out + second.err);
  CHECK(second.status == 0);
  CHECK_THAT(second.out, Catch::Contains("6 cases, 2 to run"));
}



TEST_CASE("Cases that copies of a study compute are those of a program started "
          "anew, to the last bit",
          "[top]")
{
  const fs::path work = fresh_folder("study_copies");
  std::ofstream(work / "study.prm")
    << problem << "subsection Study\n set Base = " << NPT_SOURCE_DIR
    << "/prm/shear.prm\nend\n"
       "subsection Mesh\n set Elements along = 3\n set Elements across = 3\n"
       " set Elements through = 1\nend\n"
       "subsection Friction\n set Friction coefficient = {0.1 | 0.5}\nend\n"
       "subsection Load programme\n subsection Stage shear\n"
       "  set Targets = H3: 0.05\n  set Initial step = 0.5\n"
       "  set Maximum step = 0.5\n end\nend\n";
  const ProgramResult copies = run_program(work, {"study.prm"});
  INFO(copies.out + copies.err);
  REQUIRE(copies.status == 0);
  // mpirun has MPI initialized, which no copy can use.
  std::vector<std::string> arguments = settings_of_openblas();
  arguments.insert(arguments.begin(), "-i");
  for (const std::string &argument :
       {"PATH=" + std::string(std::getenv("PATH")),
        "HOME=" + work.string(),
        std::string("OMPI_ALLOW_RUN_AS_ROOT=1"),
        std::string("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1"),
        std::string("mpirun"),
        std::string("-n"),
        std::string("1"),
        std::string(NPT_PROGRAM),
        std::string("study.prm"),
        std::string("--output"),
        std::string("anew")})
    arguments.push_back(argument);
  const ProgramResult anew = run_program(work, arguments, "env");
  INFO(anew.out + anew.err);
  REQUIRE(anew.status == 0);
  for (const std::string name : {"0001", "0002"})
    {
      const Table a = read_table(
        (work / "output-study/cases" / name / "curves.csv").string());
      const Table b =
        read_table((work / "anew/cases" / name / "curves.csv").string());
      REQUIRE(a.n_rows() > 5);
      CHECK(a.column_names == b.column_names);
      for (const std::string &column : a.column_names)
        if (column != "cpu_seconds")
          {
            INFO(name + " " + column);
            CHECK(a.text_column(column) == b.text_column(column));
          }
    }
}



TEST_CASE("Processes of MPI share the cases of a study", "[top][.slow]")
{
  const fs::path work = fresh_folder("study_mpi");
  std::ofstream(work / "study.prm")
    << problem << "subsection Study\n set Base = " << NPT_SOURCE_DIR
    << "/prm/shear.prm\nend\n"
       "subsection Mesh\n set Elements along = 3\n set Elements across = 3\n"
       " set Elements through = 1\nend\n"
       "subsection Cell\n set Weaving depth = {0.4 | 0.5 | 0.6 | 0.7}\nend\n"
       "subsection Load programme\n subsection Stage shear\n"
       "  set Targets = H3: 0.02\n  set Initial step = 0.5\n"
       "  set Maximum step = 0.5\n end\nend\n";
  const std::string command =
    "cd '" + work.string() +
    "' && env -i PATH=\"$PATH\" HOME=\"$HOME\" OMPI_ALLOW_RUN_AS_ROOT=1 "
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun -n "
    "2 --oversubscribe '" NPT_PROGRAM "' study.prm > out.txt 2> err.txt";
  const int         status = std::system(command.c_str());
  const std::string out    = read_text(work / "out.txt");
  INFO(out + read_text(work / "err.txt"));
  REQUIRE(status == 0);
  CHECK_THAT(out, Catch::Contains("4 cases, 4 to run, 2 processes with 1"));
  const Table table = read_table((work / "output-study/cases.csv").string());
  CHECK(table.text_column("status") == std::vector<std::string>(4, "done"));
  // Every case was run once: each has its line.
  for (const std::string &name : table.text_column("case"))
    CHECK(out.find(name + "  done") == out.rfind(name + "  done"));
}
