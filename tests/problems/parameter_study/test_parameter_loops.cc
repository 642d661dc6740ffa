// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about loops in the values of parameter files.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/problems/parameter_study/parameter_loops.h>

#include <catch2/catch.hpp>

using namespace NPT;

namespace
{
  ParameterLoops
  loops_of(const std::string &content)
  {
    return ParameterLoops(make_parameter_text(content, "study.prm"));
  }

  std::string
  value(const ParameterLoops &loops,
        const unsigned int    c,
        const std::string    &path)
  {
    return get_entry(loops.text_of_case(c), {}, path).value_or("missing");
  }

  std::string
  message_of_loops(const std::string &content)
  {
    try
      {
        loops_of(content);
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "no error";
  }
} // namespace



TEST_CASE("Loops in single braces give all combinations, the first fastest",
          "[study]")
{
  const auto loops =
    loops_of("set A = {1 | 2 | 3}\n"
             "subsection S\n set B = H3: { 0.1|0.2 } end\nend\n"
             "set C = 7\n");
  REQUIRE(loops.n_cases() == 6);
  CHECK(loops.loops()[1].path == "S/B");
  CHECK(loops.loops()[1].name == "B");
  for (unsigned int c = 0; c < 6; ++c)
    {
      CHECK(value(loops, c, "A") == std::to_string(c % 3 + 1));
      CHECK(value(loops, c, "S/B") == (c < 3 ? "H3: 0.1 end" : "H3: 0.2 end"));
      CHECK(value(loops, c, "C") == "7");
    }
}



TEST_CASE("An array goes along with the loop of its length, else with the "
          "number of the case as in deal.II",
          "[study]")
{
  const auto along = loops_of("set A = {1 | 2}\nset B = {{x | y}}\n"
                              "set C = {a | b | c}\nset D = {{p | q | r}}\n");
  REQUIRE(along.n_cases() == 6);
  for (unsigned int c = 0; c < 6; ++c)
    {
      CHECK(value(along, c, "B") == (value(along, c, "A") == "1" ? "x" : "y"));
      CHECK(value(along, c, "D")[0] - 'p' == value(along, c, "C")[0] - 'a');
    }

  // Of two loops of the same length it is the last before the array.
  const auto second = loops_of("set A = {1 | 2}\nset B = {3 | 4}\n"
                               "set C = {{x | y}}\n");
  CHECK(value(second, 1, "C") == "x");
  CHECK(value(second, 2, "C") == "y");

  const auto number = loops_of("set A = {1 | 2}\nset B = {3 | 4}\n"
                               "set Name = {{n0 | n1 | n2 | n3}}\n");
  for (unsigned int c = 0; c < 4; ++c)
    CHECK(value(number, c, "Name") == "n" + std::to_string(c));

  const auto alone = loops_of("set A = {{1 | 2}}\nset B = {{x | y}}\n");
  REQUIRE(alone.n_cases() == 2);
  CHECK(value(alone, 1, "A") + value(alone, 1, "B") == "2y");
}



TEST_CASE("The last value of an entry decides whether it is a loop", "[study]")
{
  CHECK(loops_of("set A = {1 | 2}\nset A = 3\n").n_cases() == 1);
  CHECK(value(loops_of("set A = {1 | 2}\nset A = 3\n"), 0, "A") == "3");
  const auto loops = ParameterLoops(
    with_overrides(make_parameter_text("subsection S\nset A = 3\nend", "f.prm"),
                   {"S/A={4 | 5}"}));
  REQUIRE(loops.n_cases() == 2);
  CHECK(value(loops, 1, "S/A") == "5");
}



TEST_CASE("Loops of the same entry in two subsections are named by both",
          "[study]")
{
  const auto loops = loops_of("subsection S\nset A = {1 | 2}\nend\n"
                              "subsection T\nset A = {3 | 4}\nend\n");
  CHECK(loops.loops()[0].name == "S/A");
  CHECK(loops.find("T/A", "") == 1);
  CHECK_THROWS_WITH(loops.find("A", "."),
                    "'A' means more than one loop; take one of: S/A, T/A.");
  CHECK_THROWS_WITH(loops.find("S/B", "."),
                    Catch::Contains("did you mean 'S/A'?"));
}



TEST_CASE("Braces that are no loop are refused with file and line", "[study]")
{
  CHECK(message_of_loops("\nset A = {1 | 2\n") ==
        "study.prm:2: the braces of '{1 | 2' do not match; write a loop as "
        "{a | b} or, to go along with another loop, {{a | b}}");
  CHECK(message_of_loops("set A = {1} {2}") ==
        "study.prm:1: '{1} {2}' contains more than one pair of braces; a value "
        "can hold one loop only, {a | b} or {{a | b}}");
  CHECK(message_of_loops("set A = {1 | }") ==
        "study.prm:1: a choice of the loop '{1 | }' is empty; write {a | b}");
  CHECK(message_of_loops("set A = {1 | 2}\nset B = {{1 | 2 | 3}}") ==
        "study.prm:2: the array of 'B' has 3 values; it needs as many as a "
        "loop that it can go along with (A: 2) or as there are cases (2)");
  CHECK(message_of_loops("set A = {{1 | 2}}\nset B = {{1 | 2 | 3}}") ==
        "study.prm:2: the array of 'B' has 3 values, another array of this "
        "file has 2; arrays go along with each other and need equal lengths");
}



TEST_CASE("A subsection can be taken out of a text and printed again",
          "[study]")
{
  const auto [inside, rest] = extract_subsection(
    make_parameter_text(
      "set A = 1\nsubsection S\nsubsection T\nset B = 2\nend\n"
      "set C = 3\nend\n",
      "f.prm"),
    "S/T");
  CHECK(print_parameter_text(inside) == "set B = 2\n");
  CHECK(print_parameter_text(rest) ==
        "set A = 1\nsubsection S\n  set C = 3\nend\n");
}



TEST_CASE("A study of more cases than can be read is refused", "[study]")
{
  std::string loop = "{1";
  for (unsigned int i = 0; i < 100; ++i)
    loop += " | 1";
  loop += "}";
  std::string content;
  for (const char name : {'A', 'B', 'C', 'D', 'E', 'F'})
    content += std::string("set ") + name + " = " + loop + "\n";
  CHECK_THAT(message_of_loops(content),
             Catch::StartsWith("The loops of this study make more than 10000 "
                               "cases"));
  CHECK(message_of_loops("set A = " + loop + "\n") == "no error");
}
