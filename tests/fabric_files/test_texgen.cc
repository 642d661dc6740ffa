// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about TexGen files: what is read, what is refused by which sentence,
// and that a written file gives the same cell.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/fabric/weave_pattern.h>
#include <npt_dealii/fabric_files/texgen.h>
#include <npt_dealii/fabric_files/xml_depth.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

using namespace NPT;

namespace
{
  std::string
  write(const std::string &name, const std::string &content)
  {
    const auto folder =
      std::filesystem::path(NPT_BINARY_DIR) / "test_texgen_files";
    std::filesystem::create_directories(folder);
    std::ofstream(folder / name) << content;
    return (folder / name).string();
  }

  std::string
  model(const std::string &textile)
  {
    return "<?xml version=\"1.0\" ?>\n<TexGenModel version=\"3.13.1\">\n" +
           textile + "</TexGenModel>\n";
  }

  // A weave with its table as over[weft][warp], after a change of the text.
  std::string
  weave(const std::vector<std::string>                  &rows,
        const std::string                               &attributes = "",
        const std::function<void(std::string &content)> &change     = {},
        const std::string                               &yarns      = "")
  {
    std::ostringstream out;
    out << "<Textile name=\"w\" type=\"CTextileWeave2D\" NumXYarns=\""
        << rows[0].size() << "\" NumYYarns=\"" << rows.size()
        << "\" GapSize=\"0\" FabricThickness=\"0.6\" " << attributes << ">\n";
    for (std::size_t j = 0; j < rows.size(); ++j)
      for (std::size_t i = 0; i < rows[0].size(); ++i)
        out << "<PatternCell x=\"" << j << "\" y=\"" << i
            << "\"><PatternElement value=\"" << (rows[j][i] == 'o' ? 0 : 1)
            << "\" /><PatternElement value=\"" << (rows[j][i] == 'o' ? 1 : 0)
            << "\" /></PatternCell>\n";
    for (std::size_t i = 0; i < rows[0].size(); ++i)
      out << "<XYarnData index=\"" << i
          << "\" Width=\"1.6\" Height=\"0.4\" Spacing=\"2\" />\n";
    for (std::size_t j = 0; j < rows.size(); ++j)
      out << "<YYarnData index=\"" << j
          << "\" Width=\"1.2\" Height=\"0.2\" Spacing=\"3\" />\n";
    std::string content = model(out.str() + yarns + "</Textile>\n");
    if (change)
      change(content);
    return write("weave.tg3", content);
  }

  void
  replace(std::string &text, const std::string &from, const std::string &to)
  {
    const auto at = text.find(from);
    REQUIRE(at != std::string::npos);
    text.replace(at, from.size(), to);
  }

  std::string
  yarn(const std::string &section)
  {
    return "<Yarn index=\"0\"><YarnSection type=\"CYarnSectionConstant\">"
           "<Section type=\"" +
           section + " /></YarnSection></Yarn>";
  }

  // Yarns of a plain weave by nodes: x along X, heights at the crossings.
  std::string
  by_nodes(const std::string &first_position = "0, 0, 0")
  {
    const auto strand = [&](const int                       index,
                            const std::vector<std::string> &nodes) {
      std::string text =
        "<Yarn index=\"" + std::to_string(index) +
        "\"><YarnSection type=\"CYarnSectionConstant\"><Section "
        "type=\"CSectionLenticular\" Width=\"0.3\" Height=\"0.14\" "
        "Distortion=\"0\" /></YarnSection><Repeat value=\"0.7, 0, 0\" />"
        "<Repeat value=\"0, 0.7, 0\" />";
      for (const std::string &node : nodes)
        text += "<MasterNode Position=\"" + node + "\" />";
      return text + "</Yarn>\n";
    };
    return model(
      "<Textile name=\"cotton\" type=\"CTextile\">\n" +
      strand(0, {first_position, "0.35, 0, 0.15", "0.7, 0, 0"}) +
      strand(1, {"0, 0.35, 0.15", "0.35, 0.35, 0", "0.7, 0.35, 0.15"}) +
      strand(2, {"0, 0, 0.15", "0, 0.35, 0", "0, 0.7, 0.15"}) +
      strand(3, {"0.35, 0, 0", "0.35, 0.35, 0.15", "0.35, 0.7, 0"}) +
      "</Textile>\n");
  }

  std::string
  complaint(const std::string &file)
  {
    try
      {
        read_texgen(file);
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "";
  }
} // namespace



TEST_CASE("A weave keeps its table, its sizes and its ellipses", "[texgen]")
{
  const auto  w    = read_texgen(weave({"oou", "uuo"}));
  const auto &cell = w.cell;
  CHECK(cell.weave == "oou/uuo");
  CHECK(WeavePattern(cell.weave).n_warp() == 3);
  CHECK(cell.section == "ellipse");
  CHECK(cell.crossing_spacing.warp == 2.);
  CHECK(cell.crossing_spacing.weft == 3.);
  CHECK(cell.bundle_width.warp == 1.6);
  CHECK(cell.bundle_width.weft == 1.2);
  CHECK(cell.bundle_thickness.warp == 0.4);
  CHECK(cell.bundle_thickness.weft == 0.2);
  REQUIRE(w.notes.size() == 1);
  CHECK(w.notes[0].find("% larger") != std::string::npos);
}



TEST_CASE("Lengths in other units become millimeters", "[texgen]")
{
  const auto w = read_texgen(weave({"ou", "uo"}, "GeometryScale=\"cm\""));
  CHECK(w.cell.crossing_spacing.weft == Approx(30.));
  CHECK(w.cell.bundle_thickness.weft == Approx(2.));
  CHECK(complaint(weave({"ou", "uo"}, "GeometryScale=\"parsec\""))
          .find("GeometryScale is 'parsec'") != std::string::npos);
}



TEST_CASE("Yarns given by nodes are a weave by their heights", "[texgen]")
{
  const auto w = read_texgen(write("cotton.tg3", by_nodes()));
  CHECK(w.cell.weave == "uo/ou");
  CHECK(w.cell.crossing_spacing.warp == Approx(0.35));
  CHECK(w.cell.bundle_width.warp == Approx(0.3));
  CHECK(w.cell.section == "lens");
}



TEST_CASE("The area of a lens is that of two circular arcs, as in TexGen",
          "[texgen]")
{
  const auto cell = read_texgen(write("cotton.tg3", by_nodes())).cell;
  // Two circular arcs of height h/2 over the chord w.
  const double w = 0.3, h = 0.07, R = (0.25 * w * w + h * h) / (2. * h);
  const double arc  = std::asin(0.5 * w / R);
  const double area = 2. * R * R * (arc - std::sin(arc) * std::cos(arc));
  CHECK(cell.warp_section().area() == Approx(area).epsilon(1e-6));
}



TEST_CASE("A written weave is read as the same cell", "[texgen]")
{
  for (const std::string section :
       {"lens", "ellipse", "power ellipse", "rounded rectangle"})
    for (const std::string table : {"plain", "2/1 twill", "ouu/uou/uuo"})
      {
        CellParameters cell;
        cell.weave            = table;
        cell.section          = section;
        cell.crossing_spacing = {2.78, 2.94};
        cell.bundle_width     = {2.4, 2.2};
        cell.bundle_thickness = {0.25, 0.2};
        if (section == "power ellipse")
          cell.section_numbers["Section power"] = 1.4;
        std::ostringstream out;
        write_texgen(cell, "again", out);
        const CellParameters again =
          read_texgen(write("again.tg3", out.str())).cell;
        INFO(section << ", " << table);
        const WeavePattern a(cell.weave), b(again.weave);
        REQUIRE(a.n_warp() == b.n_warp());
        REQUIRE(a.n_weft() == b.n_weft());
        for (unsigned int i = 0; i < a.n_warp(); ++i)
          for (unsigned int j = 0; j < a.n_weft(); ++j)
            CHECK(a.warp_is_over(i, j) == b.warp_is_over(i, j));
        CHECK(again.section == section);
        CHECK(again.crossing_spacing.warp == 2.78);
        CHECK(again.crossing_spacing.weft == 2.94);
        CHECK(again.bundle_width.weft == 2.2);
        CHECK(again.bundle_thickness.warp == 0.25);
        CHECK(again.section_numbers == cell.section_numbers);
      }
}



TEST_CASE("Every kind of file that is no such weave is refused by its sentence",
          "[texgen]")
{
  const std::vector<std::string> plain = {"ou", "uo"};
  const auto changed = [&](const std::string &from, const std::string &to) {
    return complaint(weave(plain, "", [&](std::string &content) {
      replace(content, from, to);
    }));
  };
  const auto says = [](const std::string &text, const std::string &part) {
    INFO(text);
    CHECK(text.find(part) != std::string::npos);
  };
  says(complaint("no_such.tg3"), "there is no such file");
  says(complaint(write("no.tg3", "set Weave = plain\n")), "no XML file");
  says(complaint(write("no.tg3", "<Other />")), "no element TexGenModel");
  says(complaint(write("no.tg3", model(""))), "no textile");
  says(changed("CTextileWeave2D", "CTextileWeave3D"), "CTextileWeave3D");
  says(changed("CTextileWeave2D", "CShearedTextileWeave2D"), "CSheared");
  says(changed("CTextileWeave2D", "CTextileLayered"), "CTextileLayered");
  says(changed("NumXYarns=\"2\"", "NumXYarns=\"two\""), "NumXYarns");
  says(changed("NumXYarns=\"2\"", "NumXYarns=\"3\""), "2 elements XYarnData");
  says(changed("index=\"1\" Width=\"1.6\"", "index=\"1\" Width=\"1.5\""),
       "Width of X yarn 1 is 1.5 mm");
  says(changed("Height=\"0.2\" Spacing=\"3\"", "Height=\"0.2\" Spacing=\"4\""),
       "Spacing of Y yarn 1");
  says(changed("Height=\"0.4\"", "Height=\"-0.4\""), "must be positive");
  says(changed("<PatternElement value=\"0\" />", ""), "layers");
  says(changed("<PatternCell x=\"0\" y=\"0\">",
               "<PatternCell x=\"7\" y=\"0\">"),
       "outside 0 to 1");
  const auto with_section = [&](const std::string &section) {
    return complaint(weave(plain, "", {}, yarn(section)));
  };
  says(with_section("CSectionPolygon\""), "CSectionPolygon");
  says(with_section("CSectionBezier\""), "CSectionBezier");
  says(with_section("CSectionLenticular\" Width=\"1.6\" Height=\"0.4\" "
                    "Distortion=\"0.1\""),
       "Distortion");
  says(with_section("CSectionEllipse\" Width=\"2\" Height=\"0.4\""),
       "build the textile again");
  says(complaint(
         weave(plain,
               "",
               {},
               "<Yarn index=\"0\"><YarnSection "
               "type=\"CYarnSectionInterpNode\"></YarnSection></Yarn>")),
       "CYarnSectionInterpNode with 0 sections");
  const auto with_node = [&](const std::string &section) {
    return complaint(
      weave(plain,
            "",
            {},
            "<Yarn index=\"0\"><YarnSection type=\"CYarnSectionInterpNode\">"
            "<NodeSection nodeindex=\"0\"><Section type=\"" +
              section + "</Section></NodeSection></YarnSection></Yarn>"));
  };
  says(with_node("CSectionEllipse\" Width=\"1.6\" Height=\"0.4\">"),
       "one of them is a CSectionEllipse");
  says(with_node("CSectionPolygon\"><PolygonPoint value=\"0, 0\" />"
                 "<PolygonPoint value=\"1, 0\" />"),
       "has 2 corners");
  says(with_node("CSectionPolygon\"><PolygonPoint value=\"0, 0\" />"
                 "<PolygonPoint value=\"1, 0\" />"
                 "<PolygonPoint value=\"2, 0\" />"),
       "has no area");
  says(with_node("CSectionPolygon\"><PolygonPoint value=\"0\" />"),
       "not two numbers");
  says(complaint(write("skew.tg3", by_nodes("0, 0.1, 0"))), "neither along x");
  CHECK(
    with_section("CSectionLenticular\" Width=\"1.6\" Height=\"0.4\"").empty());
}



TEST_CASE("Nothing in the names of a file gets behind the comments", "[texgen]")
{
  ImportedWeave w = read_texgen(weave({"ou", "uo"}));
  w.name          = "a\nset Problem = none\r";
  std::ostringstream out;
  write_parameter_file(w, "weave.tg3", out);
  CHECK(out.str().find("# The weave 'a set Problem = none '") == 0);
}



TEST_CASE("Materials of the file are named and not taken", "[texgen]")
{
  const auto tow = read_texgen(
    weave({"ou", "uo"}, "YoungsModulusX=\"200000\" YoungsModulusY=\"10000\""));
  REQUIRE(tow.notes.size() == 2);
  CHECK(tow.notes[1].find("impregnated") != std::string::npos);
  const auto glass = read_texgen(weave({"ou", "uo"},
                                       "YoungsModulusX=\"72\" "
                                       "YoungsModulusXUnits=\"GPa\""));
  REQUIRE(glass.notes.size() == 2);
  CHECK(glass.notes[1].find("72 GPa") != std::string::npos);
}



TEST_CASE("A file that is no weave is refused, however deep or long it is",
          "[texgen]")
{
  std::string deep;
  for (unsigned int i = 0; i < 200000; ++i)
    deep += "<a>";
  CHECK_THAT(complaint(write("deep.tg3", deep)),
             Catch::Contains("it has elements within 200000 others"));
  CHECK_THAT(complaint(write("text.tg3", "1 < 2")),
             Catch::Contains("it is no XML file"));
  CHECK_THAT(complaint(write("zero.tg3", std::string("<a\0>", 4))),
             Catch::Contains("is not plain text"));
  CHECK_THAT(complaint("/dev/zero"),
             Catch::Contains("another file than it should be"));
  CHECK_THAT(complaint(NPT_BINARY_DIR), Catch::Contains("it is a directory"));
  CHECK_THAT(complaint("~/weave.tg3"), Catch::Contains("'~' is the home"));
  // Comments, declarations and text within quotes are no elements.
  CHECK(xml_depth("<?a <b> ?><!-- <c><d> --><e f=\"<g>\"><h/><i></i></e>") ==
        2);
  CHECK(xml_depth("<![CDATA[<a><b>]]><!DOCTYPE c><d") == 1);
  // A name that is a text stays a part of the sentence.
  CHECK_THAT(complaint(weave({"ou", "uo"},
                             "",
                             [](std::string &content) {
                               replace(content, "CTextileWeave2D", "a\nb");
                             })),
             Catch::Contains("its textile is a a?b, and only"));
  // Tiny and huge numbers.
  CHECK_THAT(complaint(
               weave({"ou", "uo"},
                     "",
                     [](std::string &content) {
                       replace(content, "GapSize=\"0\"", "GapSize=\"1e-400\"");
                     })),
             Catch::Contains("GapSize of the textile is a number that is too "
                             "close to 0"));
  CHECK_THAT(complaint(
               weave(std::vector<std::string>(65, std::string(65, 'o')))),
             Catch::Contains("a table of 65 rows with 65 letters; there may be "
                             "at most 64 of each"));
}
