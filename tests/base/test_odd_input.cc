// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about input of other systems and of haste: line ends, pipes, files
// without permission, backslashes, numbers beyond all numbers, long lines.

#include <npt_dealii/base/declared_parameters.h>
#include <npt_dealii/base/describe_pattern.h>
#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/message_words.h>
#include <npt_dealii/base/nearest_name.h>
#include <npt_dealii/base/parameter_file.h>
#include <npt_dealii/base/text_file.h>
#include <npt_dealii/base/unused_sections.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>

#include <catch2/catch.hpp>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <thread>

namespace
{
  namespace odd
  {
    using namespace NPT;
    namespace Patterns = dealii::Patterns;
    namespace fs       = std::filesystem;

    std::string
    complaint_of(const std::function<void()> &action)
    {
      try
        {
          action();
        }
      catch (const InputError &error)
        {
          return error.what();
        }
      return "no InputError";
    }

    /// The complaint about a file that sets `x`, of this pattern.
    std::string
    complaint_of_value(const std::string           &value,
                       const Patterns::PatternBase &pattern,
                       const std::string           &start)
    {
      return complaint_of([&]() {
        dealii::ParameterHandler prm;
        prm.declare_entry("x", start, pattern);
        parse_parameter_text(prm, make_parameter_text("set x = " + value, "f"));
      });
    }

    fs::path
    folder_of(const std::string &name)
    {
      const fs::path folder =
        fs::path(NPT_BINARY_DIR) / "test_base_files" / ("odd_" + name);
      fs::remove_all(folder);
      fs::create_directories(folder);
      return folder;
    }

    std::string
    value_of_x(const std::string &content)
    {
      return get_entry(make_parameter_text(content, "f"), {}, "x").value_or("");
    }
  } // namespace odd
} // namespace

using odd::complaint_of;
using odd::complaint_of_value;



TEST_CASE("Lines end as systems end them, old ones too", "[base]")
{
  CHECK(odd::value_of_x("# a\rset x = 1\r") == "1");
  CHECK(odd::value_of_x("# a\r\nset x = 1\r\n") == "1");
  CHECK(odd::value_of_x("# a\r\r\nset x = 1\r\r\n") == "1");
  CHECK(odd::value_of_x("\xEF\xBB\xBF# a\rset x = 1") == "1");
  CHECK(NPT::with_plain_lines("a\rb\r\n\rc") == "a\nb\n\nc");
  // Lines are counted alike.
  for (const std::string end : {"\n", "\r", "\r\n", "\r\r\n"})
    CHECK_THAT(complaint_of([&]() {
                 NPT::make_parameter_text("#" + end + end + "sett", "f");
               }),
               Catch::StartsWith("f:3: "));
}



TEST_CASE("A backslash does not swallow the next statement", "[base]")
{
  const auto complaint = [](const std::string &content) {
    return complaint_of([&]() { NPT::make_parameter_text(content, "f"); });
  };
  const std::string of_set =
    "f:1: the backslash at the end of the line makes 'set y = 1' in the next "
    "one a part of it; remove the backslash";
  CHECK(complaint("set x = C:\\results\\\nset y = 1\n") == of_set);
  CHECK(complaint("# C:\\results\\\nset y = 1\n") == of_set);
  CHECK_THAT(complaint("subsection a\nset x = b\\\n  end # of a\n"),
             Catch::StartsWith("f:2: the backslash"));
  CHECK_THAT(complaint("set x = \\\ninclude shear.prm"),
             Catch::StartsWith("f:1: the backslash"));
  // Words of a list are no statements.
  CHECK(odd::value_of_x("set x = a, \\\n  set 1, \\\n  ending") ==
        "a, set 1, ending");
  CHECK(complaint("# goes on \\\n# here\nset x = 1\n") == "no InputError");
}



TEST_CASE(
  "A parameter file may come from a pipe, and includes the files of the "
  "present folder",
  "[base]")
{
  const auto        folder = odd::folder_of("pipe");
  const std::string pipe   = folder / "pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  CHECK(NPT::is_stream(pipe));
  std::thread writer(
    [&]() { std::ofstream(pipe) << "set x = 1\ninclude no_such.prm\n"; });
  CHECK_THAT(complaint_of([&]() { NPT::read_parameter_text(pipe); }),
             Catch::Contains("pipe:2: file 'no_such.prm' not found"));
  writer.join();
}



TEST_CASE("What keeps a file from being read is said in the system's words",
          "[base]")
{
  const auto        folder = odd::folder_of("locked");
  const std::string loop   = folder / "loop.prm";
  odd::fs::create_symlink("loop.prm", loop);
  const auto read = [](const std::string &name) {
    return complaint_of([&]() { NPT::read_parameter_text(name); });
  };
  CHECK(read(loop) == "file '" + loop +
                        "' cannot be read: Too many levels of symbolic links");
  CHECK_THAT(read("/dev/zero"),
             Catch::EndsWith("another file than it should be"));

  // A folder that may not be entered, asked by somebody who is not root.
  const std::string inside = folder / "closed" / "shear.prm";
  odd::fs::create_directory(folder / "closed");
  std::ofstream(inside) << "set x = 1\n";
  odd::fs::permissions(folder / "closed", odd::fs::perms::none);
  const pid_t pid = fork();
  if (pid == 0)
    {
      const bool is_other = geteuid() != 0 || setuid(65534) == 0;
      // Some containers know no other user.
      _exit(!is_other ||
                read(inside) ==
                  "file '" + inside + "' cannot be read: Permission denied" ?
              0 :
              1);
    }
  int status = 1;
  waitpid(pid, &status, 0);
  odd::fs::permissions(folder / "closed", odd::fs::perms::owner_all);
  // Where the way to the folder is closed already, nothing is said of this one.
  CHECK(WEXITSTATUS(status) == 0);
}



TEST_CASE("Files that include one another twice do not become thousands",
          "[base]")
{
  const auto folder = odd::folder_of("twice");
  for (unsigned int i = 0; i <= 20; ++i)
    {
      const std::string before = "include " + std::to_string(i - 1) + ".prm\n";
      std::ofstream(folder / (std::to_string(i) + ".prm"))
        << (i == 0 ? "" : before + before);
    }
  CHECK_THAT(complaint_of(
               [&]() { NPT::read_parameter_text(folder / "20.prm"); }),
             Catch::Contains("files are included 1001 times"));
  std::string deep;
  for (unsigned int i = 0; i < 1000; ++i)
    deep += "subsection a\n";
  CHECK(complaint_of([&]() { NPT::make_parameter_text(deep, "f"); }) ==
        "f:51: subsection 'a' lies within 50 others, an 'end' is missing");
}



TEST_CASE("A number that a computer cannot store is refused", "[base]")
{
  CHECK(complaint_of_value("1e-400", odd::Patterns::Double(), "0") ==
        "f:1: entry 'x' outside all subsections is '1e-400'; it must be a "
        "number; '1e-400' is too close to 0 for a computer (2.3e-308)");
  CHECK_THAT(complaint_of_value("-1e400", odd::Patterns::Double(), "0"),
             Catch::EndsWith("'-1e400' is larger than all numbers of a "
                             "computer (1.8e308)"));
  CHECK_THAT(complaint_of_value("1, 1e-400",
                                odd::Patterns::List(odd::Patterns::Double()),
                                "0"),
             Catch::EndsWith("'1e-400' is too close to 0 for a computer "
                             "(2.3e-308)"));
  CHECK_THAT(complaint_of_value("H1: 1e-320",
                                odd::Patterns::Map(odd::Patterns::Anything(),
                                                   odd::Patterns::Double()),
                                ""),
             Catch::Contains("'1e-320' is too close to 0"));
  for (const std::string fine : {"0", "-0.0", "2.3e-308", "1.7e308"})
    CHECK(complaint_of_value(fine, odd::Patterns::Double(), "1") ==
          "no InputError");
  // Not everything that looks like a number is meant to be one.
  CHECK(complaint_of_value("1e-400", odd::Patterns::Anything(), "1") ==
        "no InputError");
}



TEST_CASE("A directory has a name, and '~' is none", "[base]")
{
  const odd::Patterns::DirectoryName directory;
  CHECK(complaint_of_value("", directory, "output") ==
        "f:1: entry 'x' outside all subsections is empty; it must be the name "
        "of a directory, '.' is the present one");
  setenv("HOME", "/home/me", 1);
  CHECK(complaint_of_value("~/a", directory, "output") ==
        "f:1: entry 'x' outside all subsections is '~/a'; '~' is the home "
        "folder for shells only, write '/home/me/a'");
  CHECK(complaint_of_value("a~", directory, "output") == "no InputError");
  CHECK_THAT(complaint_of([]() { NPT::read_parameter_text("~/a.prm"); }),
             Catch::EndsWith("not found; '~' is the home folder for shells "
                             "only, write '/home/me/a.prm'"));
  CHECK_THAT(complaint_of([]() {
               NPT::make_parameter_text("include ~/a.prm", "folder/f");
             }),
             Catch::StartsWith("folder/f:1: file '~/a.prm' not found; '~'"));
}



TEST_CASE("A misspelt part of a list or of targets is answered by the nearest "
          "value",
          "[base]")
{
  const odd::Patterns::Map targets(odd::Patterns::Selection("H1|H2|n1|shear"),
                                   odd::Patterns::Double());
  const auto               complaint = [&](const std::string &value) {
    return complaint_of_value(value, targets, "");
  };
  CHECK_THAT(complaint("h1: 0.2"), Catch::EndsWith("; did you mean 'H1'?"));
  CHECK_THAT(complaint("n1: 0, shaer: 1"),
             Catch::EndsWith("; did you mean 'shear'?"));
  // All are as near.
  CHECK_THAT(complaint("H7: 0.2"), Catch::EndsWith("value: a number)"));
  CHECK_THAT(complaint("H1: 0,2"), Catch::EndsWith("did you mean 'H1: 0.2'?"));
  CHECK_THAT(complaint("n1: 3, H1: 0,2, H2: 1"),
             Catch::EndsWith("did you mean 'n1: 3, H1: 0.2'?"));
  CHECK_THAT(complaint("H1: nan"),
             Catch::EndsWith("nan and inf are not accepted"));
  CHECK_THAT(complaint_of_value("mortar, motar",
                                odd::Patterns::List(
                                  odd::Patterns::Selection("mortar|KTS")),
                                "KTS"),
             Catch::EndsWith("; did you mean 'mortar'?"));
}



TEST_CASE("A message stays a sentence, whatever the file holds", "[base]")
{
  CHECK(NPT::in_quotes("a\x1B[2J\nb") == "'a?[2J?b'");
  CHECK(NPT::in_quotes(std::string(100000, 'x')).size() < 600);
  CHECK(NPT::nearest_names(std::string(1000000, 'x'), {"xxx"}).empty());
  CHECK(complaint_of([]() {
          NPT::make_parameter_text(std::string(1000000, 'x'), "f");
        }).size() < 1000);
}



TEST_CASE("A shortened list leaves its subsections unused, a misspelt one does "
          "not",
          "[base]")
{
  const NPT::ListOfSections stages{"Load", "Stages", "Stage "};
  const std::string         first = "subsection Load\nset Stages = a, b\n"
                                    "subsection Stage a\nset x = 1\nend\n"
                                    "subsection Stage b\nsubsection c\nend\nend\n"
                                    "subsection Stage d\nend\nend\n";
  auto                      text  = NPT::make_parameter_text(first, "f");
  const std::size_t         n     = text.statements.size();
  CHECK(NPT::remove_unused_sections(text, {}, stages).empty());
  CHECK(text.statements.size() == n);
  // By the command line, as by a file that includes this one.
  CHECK(NPT::remove_unused_sections(text, {"Load/Stages=a, e"}, stages) ==
        std::vector<std::string>{"f:6: subsection 'Stage b' is not used, "
                                 "because Stages no longer names it."});
  CHECK(text.statements.size() == n - 4);
  CHECK(NPT::get_entry(text, {}, "Load/Stage a/x").value() == "1");
}
