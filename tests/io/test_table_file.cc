// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about CSV tables: nothing is lost on the way to the disk and back.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/io/table_file.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <random>
#include <sstream>

using namespace NPT;

namespace
{
  std::string
  file_name(const std::string &name)
  {
    const auto folder =
      std::filesystem::path(NPT_BINARY_DIR) / "test_base_files" / "table";
    std::filesystem::create_directories(folder);
    return (folder / name).string();
  }

  std::string
  content_of(const std::string &filename)
  {
    std::ifstream     in(filename, std::ios::binary);
    std::stringstream content;
    content << in.rdbuf();
    return content.str();
  }

  std::uint64_t
  bits(const double x)
  {
    std::uint64_t result;
    std::memcpy(&result, &x, sizeof(x));
    return result;
  }

  std::string
  message_of(const std::string &content, const std::string &column = "")
  {
    const std::string filename = file_name("bad.csv");
    std::ofstream(filename, std::ios::binary) << content;
    try
      {
        const Table table = read_table(filename);
        if (!column.empty())
          table.column(column);
      }
    catch (const InputError &error)
      {
        std::string text = error.what();
        const auto  pos  = text.find(filename);
        return text.replace(pos, filename.size(), "t.csv");
      }
    return "no InputError";
  }
} // namespace



TEST_CASE("Doubles come back from a table bit by bit", "[base]")
{
  using Limits               = std::numeric_limits<double>;
  std::vector<double> values = {0.,
                                -0.,
                                0.1,
                                1. / 3,
                                -1e-300,
                                1e22,
                                123456789,
                                Limits::max(),
                                Limits::min(),
                                Limits::denorm_min(),
                                Limits::epsilon(),
                                Limits::infinity(),
                                -Limits::infinity()};

  // Any pattern of bits that is a number, with a fixed seed.
  std::mt19937_64 random(1);
  while (values.size() < 1000)
    {
      const std::uint64_t pattern = random();
      double              x;
      std::memcpy(&x, &pattern, sizeof(x));
      if (std::isfinite(x))
        values.push_back(x);
    }

  const std::string filename = file_name("doubles.csv");
  {
    TableWriter writer(filename, {"row", "x"});
    for (std::size_t i = 0; i < values.size(); ++i)
      writer.add_row({i, values[i]});
    writer.add_row({values.size(), std::nan("")});
  }
  const auto read = read_table(filename).column("x");
  REQUIRE(read.size() == values.size() + 1);
  for (std::size_t i = 0; i < values.size(); ++i)
    CHECK(bits(read[i]) == bits(values[i]));
  CHECK(std::isnan(read.back()));
}



TEST_CASE("A table is plain text that a person can read", "[base]")
{
  const std::string filename = file_name("plain.csv");
  TableWriter       writer(filename,
                     {"step", "H1 [-]", "stage"},
                     {"Shear test", "units: mm, N"});
  writer.add_row({1, 0.1, "weave"});
  writer.add_row({2u, 1e-12, std::string("load, slow")});
  CHECK(content_of(filename) == "# Shear test\n"
                                "# units: mm, N\n"
                                "step,H1 [-],stage\n"
                                "1,0.1,weave\n"
                                "2,1e-12,\"load, slow\"\n");
}



TEST_CASE("Each row is in the file while the table is still open", "[base]")
{
  const std::string filename = file_name("open.csv");
  TableWriter       writer(filename, {"x", "y"});
  CHECK(read_table(filename).n_rows() == 0);
  writer.add_row(std::vector<double>{1.5, 2.5});
  CHECK(read_table(filename).column("y") == std::vector<double>{2.5});
  writer.add_row({3, 4});
  CHECK(read_table(filename).column("x") == std::vector<double>{1.5, 3.});
}



TEST_CASE("Texts come back from a table as they were", "[base]")
{
  const std::vector<std::string> texts = {
    "weave", "", "#1", "a,b", "say \"no\"", " blanks ", "\xC3\xBC"};
  const std::string filename = file_name("texts.csv");
  TableWriter       writer(filename, {"only"});
  for (const std::string &text : texts)
    writer.add_row({text});
  CHECK(read_table(filename).text_column("only") == texts);
}



TEST_CASE("Tables of other programs are read too", "[base]")
{
  const std::string filename = file_name("other.csv");
  std::ofstream(filename, std::ios::binary)
    << "\xEF\xBB\xBF# published curve\r\n\r\n x , \"y, [N]\" \r\n"
       "# in between\r\n +1 ,.5\r\n\t-2e0, 1E3\r\n";
  const Table table = read_table(filename);
  CHECK(table.comments ==
        std::vector<std::string>{"published curve", "in between"});
  CHECK(table.column_names == std::vector<std::string>{"x", "y, [N]"});
  CHECK(table.has_column("x"));
  CHECK_FALSE(table.has_column("z"));
  CHECK(table.column("x") == std::vector<double>{1, -2});
  CHECK(table.column("y, [N]") == std::vector<double>{.5, 1000});
  CHECK(table.lines == std::vector<unsigned int>{5, 6});
}



TEST_CASE("A mistake in a table is reported with column and line", "[base]")
{
  CHECK(message_of("force,gap\n1,2\n", "froce") ==
        "table 't.csv' has no column 'froce'; did you mean 'force'?");
  CHECK(message_of("force,gap\n1,2\n", "time") ==
        "table 't.csv' has no column 'time'; its columns are: force, gap");
  CHECK(message_of("# c\nforce\n1\n1.5x\n", "force") ==
        "t.csv:4: column 'force' is '1.5x'; it must be a number");
  CHECK(message_of("a,b\n1,\n", "b") ==
        "t.csv:2: column 'b' is empty; it must be a number");
  CHECK(message_of("a,b\n1,2\n1\n") ==
        "t.csv:3: the row has 1 cells, but the table has 2 columns");
  CHECK(message_of("a,a\n1,2\n") == "table 't.csv': column 'a' occurs twice");
  CHECK(message_of("# only a comment\n") ==
        "table 't.csv' is empty; it needs a line with column names");
  CHECK(message_of("a\n\"x\n") == "t.csv:2: a double quote is not closed");
  CHECK_THAT(message_of("a\n\"x\"y\n"),
             Catch::StartsWith("t.csv:2: text follows a closing double"));
}



TEST_CASE("A table that cannot be opened is an error", "[base]")
{
  CHECK_THROWS_WITH(read_table("no/such.csv"), "table 'no/such.csv' not found");
  CHECK_THROWS_WITH(read_table("/"), "table '/' is a directory");
  CHECK_THROWS_WITH(TableWriter("no/such.csv", {"x"}),
                    "The file 'no/such.csv' cannot be written: No such file or "
                    "directory.");
  CHECK_THROWS_AS(TableWriter(file_name("x.csv"), {"x", "x"}), InputError);
}



TEST_CASE("A table of a country with decimal commas has the same numbers",
          "[base]")
{
  const std::string filename = file_name("commas.csv");
  const auto        x_of     = [&](const std::string &content) {
    std::ofstream(filename, std::ios::binary) << content;
    return read_table(filename).column("x");
  };
  const std::vector<double> expected = {0.5, -1e-3, 2};
  CHECK(x_of("x;y\n0,5;1\n-1e-3;2,5\n2;3\n") == expected);
  CHECK(x_of("y\tx\r\t0,5\r1\t-0,001\r\t2\r") == expected);
  CHECK(x_of("x;y\n0.5;a,b\n-1e-3;\n2;\n") == expected);
  CHECK(message_of("x;y\n0,5;1.234\n", "x") ==
        "t.csv:2: '1.234' has a decimal point, other numbers of the table have "
        "decimal commas; write all alike");
  CHECK_THAT(message_of("x;y\n1.234,5;1\n", "x"),
             Catch::Contains("'1.234,5'; it must be a number"));
  CHECK_THAT(message_of("x,y\n0,5,1,5\n"),
             Catch::EndsWith("decimal commas need semicolons between them"));
  CHECK_THAT(message_of("x\n1e-400\n", "x"),
             Catch::EndsWith("it must be a number; '1e-400' is too close to 0 "
                             "for a computer (2.3e-308)"));
}



TEST_CASE("Units stand behind the names of a table or in a line below them",
          "[base]")
{
  const std::string filename = file_name("units.csv");
  std::ofstream(filename) << "H11 [-],P11 [ MPa ],t\n1,2,3\n";
  Table table = read_table(filename);
  CHECK(table.column("P11") == std::vector<double>{2});
  CHECK(table.unit("P11") == "MPa");
  CHECK(table.unit("H11 [-]") == "-");
  CHECK(table.unit("t").empty());
  std::ofstream(filename) << "H11,P11,t\n[-],[kPa],\n1,2,3\n";
  table = read_table(filename);
  CHECK(table.n_rows() == 1);
  CHECK(table.unit("P11") == "kPa");
  CHECK(table.column("t") == std::vector<double>{3});
  CHECK(message_of("P11,t\nMPa,s\n1,2\n", "P11") ==
        "t.csv:2: column 'P11' is 'MPa'; it must be a number; a line of units "
        "needs brackets, as [MPa]");
  CHECK_THAT(message_of("P11 [MPa],P11 [kPa]\n1,2\n", "P11"),
             Catch::Contains("has two columns 'P11'"));
}
