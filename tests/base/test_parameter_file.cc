// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about the parameter-file reader: it reads what deal.II reads, and each
// kind of mistake gets its own sentence.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/parameter_file.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>

#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <sstream>

using namespace NPT;
namespace Patterns = dealii::Patterns;

namespace
{
  void
  declare(dealii::ParameterHandler &prm)
  {
    prm.declare_entry("Title",
                      "none",
                      Patterns::Anything(),
                      "What the run is about.");
    prm.enter_subsection("Friction");
    prm.declare_entry("Friction coefficient",
                      "0.3",
                      Patterns::Double(0),
                      "Coulomb friction coefficient mu [-], Eq. (12) of "
                      "doc/theory.md, the same for every pair of surfaces.");
    prm.declare_entry("Tangential penalty", "1e3", Patterns::Double(0, 1e6));
    prm.declare_entry("Active", "true", Patterns::Bool());
    prm.leave_subsection();
    prm.enter_subsection("Contact");
    prm.declare_entry("Averaging", "mortar", Patterns::Selection("mortar|KTS"));
    prm.declare_entry("Normal penalty", "1e4", Patterns::Double(0));
    prm.declare_entry("Points", "3", Patterns::Integer(1, 20));
    prm.declare_alias("Points", "Number of points");
    prm.enter_subsection("Search");
    prm.declare_entry("Radius", "0.5", Patterns::Double());
    prm.declare_entry("value", "0", Patterns::Double());
    prm.declare_entry("Box", "1, 2", Patterns::List(Patterns::Double(0), 2, 2));
    prm.leave_subsection();
    prm.leave_subsection();
  }

  /// The message of the InputError that @p action throws.
  std::string
  message_of(const std::function<void()> &action)
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

  std::string
  parse_message(const std::string              &content,
                const std::vector<std::string> &overrides = {})
  {
    return message_of([&]() {
      dealii::ParameterHandler prm;
      declare(prm);
      parse_parameter_text(prm,
                           make_parameter_text(content, "shear.prm"),
                           overrides);
    });
  }

  std::string
  all_values(const dealii::ParameterHandler &prm)
  {
    std::ostringstream out;
    prm.print_parameters(out, dealii::ParameterHandler::ShortPRM);
    return out.str();
  }

  /// A folder of its own for each test case, empty at the start.
  std::filesystem::path
  fresh_folder(const std::string &name)
  {
    const auto folder =
      std::filesystem::path(NPT_BINARY_DIR) / "test_base_files" / name;
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    return folder;
  }

  void
  write(const std::filesystem::path &path, const std::string &content)
  {
    std::ofstream(path, std::ios::binary) << content;
  }
} // namespace



TEST_CASE("A parameter file means the same to us and to deal.II", "[base]")
{
  const std::string content =
    "# a comment\r\n"
    "set Title = M\xC3\xBCller = \xCE\xBC # behind a value\r\n"
    "\tsubsection\tFriction\t \r\n"
    "set Friction coefficient\t=\t0.25\t\r\n"
    "  SET Tangential penalty = \\\r\n"
    "     2e3   # joined\r\n"
    "END # of Friction\r\n"
    "\n"
    "subsection   Contact\n"
    "  set Averaging=KTS\n"
    "  set Number of points = 7\n"
    "  # a comment that goes on \\\n"
    "  Points = 9\n"
    "  subsection Search\n"
    "    set value = -1 \n"
    "    set Box = 3 ,4\n"
    "  end\n"
    "end\n"
    "set Title = two \\\n"
    "   words \\";

  // deal.II accepts the second Title, which we refuse: leave it out there.
  const std::string first  = content.substr(0, content.find("set Title = two"));
  const std::string second = "set Title = two \\\n   words \\";
  for (const std::string &text : {first, second})
    {
      dealii::ParameterHandler expected, found;
      declare(expected);
      declare(found);
      expected.parse_input_from_string(text);
      parse_parameter_text(found, make_parameter_text(text, "a.prm"));
      CHECK(all_values(found) == all_values(expected));
    }
}



TEST_CASE("A file that starts with a UTF-8 mark is read as without it",
          "[base]")
{
  const auto text =
    make_parameter_text("\xEF\xBB\xBFset Title = x\n", "shear.prm");
  CHECK(get_entry(text, {}, "Title").value() == "x");
}



TEST_CASE("An unknown entry is answered by the nearest name", "[base]")
{
  CHECK(parse_message("subsection Friction\n"
                      "  set Frction coefficient = 0.2\n"
                      "end\n") ==
        "shear.prm:2: unknown entry 'Frction coefficient' in subsection "
        "'Friction'; did you mean 'Friction coefficient'?");
  CHECK(parse_message("subsection Friction\n"
                      "  set friction coefficient = 0.2\n"
                      "end\n") ==
        "shear.prm:2: unknown entry 'friction coefficient' in subsection "
        "'Friction'; did you mean 'Friction coefficient'?");
  CHECK(parse_message("set title = x") ==
        "shear.prm:1: unknown entry 'title' outside all subsections; did you "
        "mean 'Title'?");
}



TEST_CASE("An entry of another subsection is told its home", "[base]")
{
  CHECK(parse_message("subsection Friction\nset Normal penalty = 1\nend\n") ==
        "shear.prm:2: unknown entry 'Normal penalty' in subsection "
        "'Friction'; it belongs to subsection 'Contact'");
  CHECK(parse_message("set Radius = 1\n") ==
        "shear.prm:1: unknown entry 'Radius' outside all subsections; it "
        "belongs to subsection 'Contact/Search'");
  CHECK(parse_message("subsection Friction\nset Title = 1\nend\n") ==
        "shear.prm:2: unknown entry 'Title' in subsection 'Friction'; it "
        "belongs to the top level");
  CHECK(parse_message("subsection Friction\nset Radus = 1\nend\n") ==
        "shear.prm:2: unknown entry 'Radus' in subsection 'Friction'; did you "
        "mean 'Radius' of subsection 'Contact/Search'?");
}



TEST_CASE("A name that resembles nothing is answered by what is valid",
          "[base]")
{
  CHECK(parse_message("subsection Friction\nset xyz = 1\nend\n") ==
        "shear.prm:2: unknown entry 'xyz' in subsection 'Friction'; valid "
        "here: Friction coefficient, Tangential penalty, Active");
  CHECK(parse_message("set Contact = 1\n") ==
        "shear.prm:1: unknown entry 'Contact' outside all subsections; "
        "'Contact' is a subsection and has no value itself");
}



TEST_CASE("A name with a pasted non-breaking space is explained", "[base]")
{
  CHECK_THAT(parse_message("subsection Friction\n"
                           "set Friction\xC2\xA0"
                           "coefficient = 1\nend\n"),
             Catch::Contains("it contains a non-breaking space"));
}



TEST_CASE("An unknown subsection is answered by the nearest or its place",
          "[base]")
{
  CHECK(parse_message("subsection Fricton\nend\n") ==
        "shear.prm:1: unknown subsection 'Fricton' outside all subsections; "
        "did you mean 'Friction'?");
  CHECK(parse_message("subsection Search\nend\n") ==
        "shear.prm:1: unknown subsection 'Search' outside all subsections; it "
        "belongs to subsection 'Contact'");
  CHECK(parse_message("subsection Friction\nsubsection Title\nend\nend\n") ==
        "shear.prm:2: unknown subsection 'Title' in subsection 'Friction'; "
        "there is no subsection here");
  CHECK(parse_message("subsection Title\nend\n") ==
        "shear.prm:1: unknown subsection 'Title' outside all subsections; "
        "'Title' is an entry, write 'set Title = VALUE'");
}



TEST_CASE("A value that does not fit is shown with what is allowed", "[base]")
{
  const auto friction = [](const std::string &set) {
    return parse_message("subsection Friction\n" + set + "\nend\n");
  };
  const auto contact = [](const std::string &set) {
    return parse_message("subsection Contact\n" + set + "\nend\n");
  };

  CHECK(friction("set Friction coefficient = -0.1") ==
        "shear.prm:2: entry 'Friction coefficient' in subsection 'Friction' is "
        "'-0.1'; it must be a number >= 0");
  CHECK(friction("set Tangential penalty =") ==
        "shear.prm:2: entry 'Tangential penalty' in subsection 'Friction' is "
        "empty; it must be a number in [0, 1e+06]");
  CHECK(friction("set Friction coefficient = 0,1") ==
        "shear.prm:2: entry 'Friction coefficient' in subsection 'Friction' is "
        "'0,1'; it must be a number >= 0; did you mean '0.1'?");
  CHECK(friction("set Active = yes") ==
        "shear.prm:2: entry 'Active' in subsection 'Friction' is 'yes'; it "
        "must be true or false; did you mean 'true'?");
  CHECK(contact("set Averaging = motar") ==
        "shear.prm:2: entry 'Averaging' in subsection 'Contact' is 'motar'; it "
        "must be one of: mortar, KTS; did you mean 'mortar'?");
  CHECK(contact("set Averaging = xxxxxx") ==
        "shear.prm:2: entry 'Averaging' in subsection 'Contact' is 'xxxxxx'; "
        "it must be one of: mortar, KTS");
  CHECK(contact("set Points = 3.0") ==
        "shear.prm:2: entry 'Points' in subsection 'Contact' is '3.0'; it must "
        "be an integer in [1, 20]; did you mean '3'?");
  CHECK(contact("set Points = {1|2}") ==
        "shear.prm:2: entry 'Points' in subsection 'Contact' is '{1|2}'; it "
        "must be an integer in [1, 20]");
  CHECK_THAT(parse_message("subsection Contact\nsubsection Search\n"
                           "set Box = 1\nend\nend"),
             Catch::EndsWith("in subsection 'Contact/Search' is '1'; it must "
                             "be exactly 2 values separated by ',', each a "
                             "number >= 0"));
  CHECK_THAT(parse_message("subsection Contact\nsubsection Search\n"
                           "set Radius = \xE2\x88\x92"
                           "1\nend\nend"),
             Catch::EndsWith("it must be a number; did you mean '-1'?"));
}



TEST_CASE("Not-a-number and infinity are no numbers", "[base]")
{
  for (const std::string word :
       {"nan", "NaN", "inf", "-inf", "Infinity", "+INF"})
    CHECK(parse_message("subsection Contact\nsubsection Search\nset Radius = " +
                        word + "\nend\nend\n") ==
          "shear.prm:3: entry 'Radius' in subsection 'Contact/Search' is '" +
            word + "'; it must be a number; nan and inf are not accepted");
  CHECK_THAT(parse_message("subsection Contact\nsubsection Search\n"
                           "set Radius = 1e999\nend\nend\n"),
             Catch::Contains("is '1e999'; it must be a number"));
}



TEST_CASE("A line that is no statement is named with the nearest keyword",
          "[base]")
{
  CHECK(parse_message("set Title 5") ==
        "shear.prm:1: 'set' without '=' in the line 'set Title 5', write 'set "
        "NAME = VALUE'");
  CHECK_THAT(parse_message("set = 5"),
             Catch::StartsWith("shear.prm:1: 'set' without the name of an "
                               "entry"));
  CHECK(parse_message("subsecton Friction") ==
        "shear.prm:1: cannot understand the line 'subsecton Friction', a line "
        "begins with set, subsection, end or include; did you mean "
        "'subsection'?");
  CHECK_THAT(parse_message("Set Title = 3"),
             Catch::EndsWith("did you mean 'set'?"));
  CHECK_THAT(parse_message("\n\nTitle = 3"),
             Catch::StartsWith("shear.prm:3: cannot understand") &&
               Catch::EndsWith("did you forget 'set'?"));
  CHECK(parse_message("subsection") ==
        "shear.prm:1: 'subsection' without a name");
  CHECK(parse_message("include") ==
        "shear.prm:1: 'include' without the name of a file");
  CHECK_THAT(parse_message("subsection Friction\nend Friction"),
             Catch::Contains("shear.prm:2: 'end' must stand alone"));
}



TEST_CASE("A subsection left open is named with the line that opened it",
          "[base]")
{
  CHECK(parse_message("subsection Friction\n"
                      "  set Active = true\n"
                      "subsection Contact\n"
                      "end\n") ==
        "shear.prm:1: subsection 'Friction' opened in line 1 is still open at "
        "the end of the file (line 4), an 'end' is missing");
  CHECK_THAT(parse_message("subsection Friction\nend\nend\n"),
             Catch::StartsWith("shear.prm:3: 'end' without a 'subsection'"));
}



TEST_CASE("An entry set twice in a file is an error that names both lines",
          "[base]")
{
  CHECK(parse_message("subsection Contact\n"
                      "set Points = 2\n"
                      "end\n"
                      "subsection Contact\n"
                      "set Number of points = 3\n"
                      "end\n") ==
        "shear.prm:5: entry 'Points' in subsection 'Contact' is already set in "
        "line 2 of this file; keep only one of the two");
  // The same name elsewhere is another entry.
  CHECK(parse_message("set Title = a\n") == "no InputError");
}



TEST_CASE("Overrides replace values of the file", "[base]")
{
  dealii::ParameterHandler prm;
  declare(prm);
  parse_parameter_text(
    prm,
    make_parameter_text("subsection Contact\nset Points = 2\nend\n", "a.prm"),
    {"Contact/Points=5", "Contact / Search/Radius = 2.5", "Title=a=b"});
  CHECK(prm.get("Title") == "a=b");
  prm.enter_subsection("Contact");
  CHECK(prm.get_integer("Points") == 5);
  prm.enter_subsection("Search");
  CHECK(prm.get_double("Radius") == 2.5);
}



TEST_CASE("A bad override gets the same sentences as a line of a file",
          "[base]")
{
  CHECK(parse_message("", {"Friction/Frction coefficient=0.2"}) ==
        "--set 'Friction/Frction coefficient=0.2': unknown entry 'Frction "
        "coefficient' in subsection 'Friction'; did you mean 'Friction "
        "coefficient'?");
  CHECK(parse_message("", {"Friction coefficient=0.2"}) ==
        "--set 'Friction coefficient=0.2': unknown entry 'Friction "
        "coefficient' outside all subsections; it belongs to subsection "
        "'Friction'");
  CHECK(parse_message("", {"Contcat/Points=2"}) ==
        "--set 'Contcat/Points=2': unknown subsection 'Contcat' outside all "
        "subsections; did you mean 'Contact'?");
  CHECK(parse_message("", {"Contact/Points=0"}) ==
        "--set 'Contact/Points=0': entry 'Points' in subsection 'Contact' is "
        "'0'; it must be an integer in [1, 20]");
  CHECK(parse_message("", {"Contact/Search=1"}) ==
        "--set 'Contact/Search=1': unknown entry 'Search' in subsection "
        "'Contact'; 'Search' is a subsection and has no value itself");
  CHECK(parse_message("", {"Contact/Points"}) ==
        "--set 'Contact/Points': '=' is missing, write "
        "'Subsection/Entry=value'");
  CHECK(parse_message("", {"=1"}) ==
        "--set '=1': the name of the entry is missing, write "
        "'Subsection/Entry=value'");
  CHECK(parse_message("", {"Contact/Points=2", "Contact/Points=3"}) ==
        "--set 'Contact/Points=3': entry 'Points' in subsection 'Contact' is "
        "already set by --set 'Contact/Points=2'; keep only one of the two");
  CHECK_THAT(parse_message("", {"Title=a # b"}),
             Catch::Contains("the value contains '#'"));
}



TEST_CASE("Included files are found beside the file that names them", "[base]")
{
  const auto folder = fresh_folder("include");
  std::filesystem::create_directories(folder / "parts" / "deep");
  write(folder / "main.prm",
        "include parts/contact.prm\n"
        "subsection Contact\n  set Points = 4\nend\n");
  write(folder / "parts" / "contact.prm",
        "subsection Contact\n"
        "  set Points = 2\n"
        "  include deep/search.prm # nested, inside a subsection\n"
        "end\n");
  write(folder / "parts" / "deep" / "search.prm",
        "subsection Search\n  set Radius = 9\nend\n");

  dealii::ParameterHandler prm;
  declare(prm);
  const auto text = read_parameter_text((folder / "main.prm").string());
  parse_parameter_text(prm, text);
  CHECK(get_entry(text, {}, "Contact/Search/Radius").value() == "9");
  prm.enter_subsection("Contact");
  CHECK(prm.get_integer("Points") == 4);
  prm.enter_subsection("Search");
  CHECK(prm.get_double("Radius") == 9);

  // A mistake is reported where it stands.
  write(folder / "parts" / "deep" / "search.prm",
        "subsection Search\n  set Radus = 9\nend\n");
  CHECK_THAT(
    message_of([&]() {
      dealii::ParameterHandler fresh;
      declare(fresh);
      parse_parameter_text(fresh,
                           read_parameter_text((folder / "main.prm").string()));
    }),
    Catch::Contains("parts/deep/search.prm:2: unknown entry 'Radus' in "
                    "subsection 'Contact/Search'; did you mean 'Radius'?"));

  // An included file closes what it opens, and nothing else.
  write(folder / "parts" / "deep" / "search.prm", "end\n");
  CHECK_THAT(message_of(
               [&]() { read_parameter_text((folder / "main.prm").string()); }),
             Catch::Contains("search.prm:1: 'end' without a 'subsection'"));
}



TEST_CASE("Files that include each other are an error that shows the circle",
          "[base]")
{
  const auto folder = fresh_folder("circle");
  write(folder / "a.prm", "\ninclude b.prm\n");
  write(folder / "b.prm", "include ./a.prm\n");
  const std::string a = (folder / "a.prm").string(),
                    b = (folder / "b.prm").string();
  CHECK(message_of([&]() { read_parameter_text(a); }) ==
        b + ":1: a file cannot include itself: " + a + " -> " + b + " -> " + a);
}



TEST_CASE("A file that cannot be read is an error that says what is there",
          "[base]")
{
  const auto folder = fresh_folder("missing");
  const auto read   = [&](const std::string &name) {
    return message_of([&]() { read_parameter_text((folder / name).string()); });
  };
  CHECK_THAT(read("shear.prm"),
             Catch::EndsWith("/shear.prm' not found; that folder contains no "
                             ".prm file"));

  write(folder / "shear.prm", "include tensile.prm\n");
  write(folder / "tension.prm", "");
  CHECK_THAT(read("sheer.prm"),
             Catch::EndsWith("/sheer.prm' not found; did you mean "
                             "'shear.prm'?"));
  CHECK_THAT(read("bending.prm"),
             Catch::EndsWith("/bending.prm' not found; that folder contains: "
                             "shear.prm, tension.prm"));
  CHECK_THAT(read("shear.prm"),
             Catch::Contains("/shear.prm:1: file '") &&
               Catch::Contains("/tensile.prm' not found"));
  CHECK_THAT(read("."),
             Catch::Contains("is a directory, not a parameter file; "
                             "it contains: shear.prm, tension.prm"));
  CHECK_THAT(read("no/shear.prm"), Catch::Contains("there is no folder '"));
  CHECK(message_of([]() { read_parameter_text(""); }) ==
        "the name of the parameter file is empty");

  write(folder / "binary.prm", std::string("set\0", 4));
  CHECK_THAT(read("binary.prm"), Catch::Contains("is not plain text"));
}



TEST_CASE("Raw entries are found before declaration, overrides last", "[base]")
{
  const auto text = make_parameter_text("subsection Load programme\n"
                                        "  set Stages = 3 # three\n"
                                        "end\n",
                                        "a.prm");
  CHECK(get_entry(text, {}, "Load programme/Stages").value() == "3");
  CHECK(get_entry(text, {"Load programme/Stages=4"}, "Load programme/Stages")
          .value() == "4");
  CHECK_FALSE(get_entry(text, {}, "Stages").has_value());
  CHECK_FALSE(get_entry(text, {"nonsense"}, "Load programme").has_value());
}



TEST_CASE("The documented parameters read back to the same values", "[base]")
{
  dealii::ParameterHandler prm;
  declare(prm);
  parse_parameter_text(prm,
                       make_parameter_text("", "a.prm"),
                       {"Contact/Points=5", "Contact/Averaging=KTS"});
  std::ostringstream out;
  print_documented_parameters(prm, out);

  dealii::ParameterHandler again;
  declare(again);
  parse_parameter_text(again, make_parameter_text(out.str(), "out.prm"));
  CHECK(all_values(again) == all_values(prm));

  CHECK_THAT(out.str(),
             Catch::Contains(
               "subsection Friction\n"
               "  # Coulomb friction coefficient mu [-], Eq. (12) of "
               "doc/theory.md, the same "
               "for\n"
               "  # every pair of surfaces.\n"
               "  # Allowed: a number >= 0.\n"
               "  set Friction coefficient = 0.3\n"
               "\n"
               "  # Allowed: a number in [0, 1e+06].\n"
               "  set Tangential penalty   = 1e3\n"));
  CHECK_THAT(out.str(),
             Catch::Contains("  # Allowed: an integer in [1, 20]. Default: 3.\n"
                             "  set Points         = 5\n"));

  std::istringstream lines(out.str());
  for (std::string line; std::getline(lines, line);)
    {
      INFO(line);
      CHECK(line.size() <= 80);
      CHECK((line.empty() || line.back() != ' '));
    }
}



TEST_CASE("Patterns of deal.II are put into words", "[base]")
{
  using namespace Patterns;
  const auto words = [](const PatternBase &pattern) {
    return describe_pattern(pattern.description());
  };
  CHECK(words(Double()) == "a number");
  CHECK(words(Double(0, 1)) == "a number in [0, 1]");
  CHECK(words(Double(-1e-9, 0.5)) == "a number in [-1e-09, 0.5]");
  CHECK(words(Double(Double::min_double_value, 2)) == "a number <= 2");
  CHECK(words(Double(std::numeric_limits<double>::min())) == "a number > 0");
  CHECK(words(Double(std::numeric_limits<double>::min(), 1)) ==
        "a number in (0, 1]");
  CHECK(words(Integer()) == "an integer");
  CHECK(words(Integer(1)) == "an integer >= 1");
  CHECK(words(Bool()) == "true or false");
  CHECK(words(Selection("mortar | KTS")) == "one of: mortar, KTS");
  CHECK(words(List(Double())) ==
        "any number of values separated by ',', each a number");
  CHECK(words(List(List(Integer(0, 3), 1, 2), 0, 5, ";")) ==
        "at most 5 values separated by ';', each 1 to 2 values separated by "
        "',', each an integer in [0, 3]");
  CHECK(words(List(Anything(), 1)) ==
        "at least 1 value separated by ',', each any text");
  CHECK(words(Map(Anything(), Double(0))) ==
        "pairs 'key:value' separated by ',' (key: any text; value: a number "
        ">= 0)");
  CHECK(words(DirectoryName()) == "the name of a directory");
  CHECK(describe_pattern("[New thing]") == "[New thing]");
}



TEST_CASE("Bounds decide with all their digits, not as they are printed",
          "[base]")
{
  dealii::ParameterHandler prm;
  prm.declare_entry("x", "0", Patterns::Double(0, 0.123456789));
  // deal.II describes the bound as 0.123457.
  parse_parameter_text(prm, make_parameter_text("set x = 0.1234567", "a"));
  CHECK_THROWS_AS(
    parse_parameter_text(prm, make_parameter_text("set x = 0.1234569", "a")),
    InputError);
}



TEST_CASE("A swap of neighboring letters counts as one edit", "[base]")
{
  CHECK(edit_distance("", "") == 0);
  CHECK(edit_distance("contact", "contact") == 0);
  CHECK(edit_distance("Contact", "contact") == 0);
  CHECK(edit_distance("contcat", "contact") == 1);
  CHECK(edit_distance("", "abc") == 3);
  CHECK(edit_distance("kitten", "sitting") == 3);
  CHECK(edit_distance("abc", "cab") == edit_distance("cab", "abc"));
}



TEST_CASE("Nearest names come in order of distance, far ones never", "[base]")
{
  const std::vector<std::string> names = {"Normal penalty",
                                          "Tangential penalty",
                                          "Points"};
  CHECK(nearest_names("Normal penatly", names) ==
        std::vector<std::string>{"Normal penalty"});
  CHECK(nearest_names("penalty", names, 3) ==
        std::vector<std::string>{"Normal penalty", "Tangential penalty"});
  CHECK(nearest_names("banana", names).empty());
  CHECK(nearest_names("", names).empty());
  CHECK(nearest_names("x", {"y"}).empty());
  CHECK(did_you_mean("point", names) == "; did you mean 'Points'?");
  CHECK(did_you_mean("penalty normal", names) ==
        "; did you mean 'Normal penalty'?");
}
