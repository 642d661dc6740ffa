// SPDX-License-Identifier: LGPL-2.1-or-later
// Weaves into parameter files and into the XML files of TexGen.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/fabric/weave_pattern.h>
#include <npt_dealii/fabric_files/texgen.h>

#include <array>
#include <map>
#include <ostream>

namespace NPT
{
  namespace
  {
    // A line of a comment, whatever a file of another program has in its names.
    std::string
    one_line(std::string text)
    {
      for (char &c : text)
        if (static_cast<unsigned char>(c) < ' ')
          c = ' ';
      return text;
    }



    std::string
    two(const WarpWeft &value)
    {
      return EntryValue<WarpWeft>::text(value);
    }
  } // namespace



  void
  write_parameter_file(const ImportedWeave &weave,
                       const std::string   &source,
                       std::ostream        &out)
  {
    const CellParameters &cell = weave.cell;
    out << "# The weave '" << one_line(weave.name) << "' of the TexGen file "
        << one_line(source) << ".\n";
    for (const std::string &note : weave.notes)
      out << "# " << one_line(note) << "\n";
    out << "# The material is not in the file: see subsection Fiber bundle "
           "material of\n# `npt_dealii --print-defaults`.\n\n"
        << "subsection Cell\n"
        << "  set Weave            = " << cell.weave << "\n"
        << "  set Crossing spacing = " << two(cell.crossing_spacing) << "\n"
        << "  set Bundle width     = " << two(cell.bundle_width) << "\n"
        << "  set Bundle thickness = " << two(cell.bundle_thickness) << "\n"
        << "  set Section          = " << cell.section << "\n";
    for (const auto &[entry, number] : cell.section_numbers)
      out << "  set " << entry << " = " << EntryValue<double>::text(number)
          << "\n";
    out << "  set Blunt tip        = "
        << EntryValue<double>::text(cell.blunt_tip) << "\n"
        << "end\n\n"
        << "subsection Load programme\n"
        << "  set Stages = weave, release, shear\n"
        << "end\n";
  }



  void
  write_texgen(const CellParameters &cell,
               const std::string    &name,
               std::ostream         &out)
  {
    if (cell.type == "laminate")
      throw InputError("A laminate has no yarns, so it cannot be written as a "
                       "TexGen weave (subsection Cell, entry Type).");
    if (cell.n_layers > 1)
      throw InputError("Layers is " + std::to_string(cell.n_layers) +
                       "; a TexGen weave is one layer (subsection Cell).");
    static const std::map<std::string, std::string> sections = {
      {"lens", "CSectionLenticular\" Distortion=\"0"},
      {"ellipse", "CSectionEllipse"},
      {"power ellipse", "CSectionPowerEllipse\" XOffset=\"0"},
      {"rounded rectangle", "CSectionRectangle"}};
    const auto section = sections.find(cell.section);
    if (section == sections.end())
      throw InputError("TexGen has no section '" + cell.section +
                       "'; it has lens, ellipse, power ellipse and rectangle "
                       "(subsection Cell, entry Section).");
    const WeavePattern pattern(cell.weave);
    const double T = cell.bundle_thickness.warp + cell.bundle_thickness.weft;
    const auto   number = [](const double value) {
      return EntryValue<double>::text(value);
    };
    out << "<?xml version=\"1.0\" ?>\n<TexGenModel version=\"3.13.1\">\n"
        << "    <Textile name=\"" << name
        << "\" type=\"CTextileWeave2D\" NeedsBuilding=\"1\" "
           "GeometryScale=\"mm\" NumXYarns=\""
        << pattern.n_warp() << "\" NumYYarns=\"" << pattern.n_weft()
        << "\" GapSize=\"0\" FabricThickness=\"" << number(T)
        << "\" Resolution=\"20\" Refine=\"1\" InPlaneTangents=\"1\">\n";
    for (unsigned int i = 0; i < pattern.n_warp(); ++i)
      for (unsigned int j = 0; j < pattern.n_weft(); ++j)
        {
          const bool over = pattern.warp_is_over(i, j);
          out << "        <PatternCell x=\"" << j << "\" y=\"" << i
              << "\">\n            <PatternElement value=\"" << (over ? 0 : 1)
              << "\" />\n            <PatternElement value=\"" << (over ? 1 : 0)
              << "\" />\n        </PatternCell>\n";
        }
    const auto write_family = [&](const std::string &element,
                                  const unsigned int n,
                                  const double       width,
                                  const double       height,
                                  const double       spacing) {
      for (unsigned int k = 0; k < n; ++k)
        out << "        <" << element << " index=\"" << k << "\" Width=\""
            << number(width) << "\" Height=\"" << number(height)
            << "\" Spacing=\"" << number(spacing) << "\" />\n";
    };
    write_family("XYarnData",
                 pattern.n_warp(),
                 cell.bundle_width.warp,
                 cell.bundle_thickness.warp,
                 cell.crossing_spacing.warp);
    write_family("YYarnData",
                 pattern.n_weft(),
                 cell.bundle_width.weft,
                 cell.bundle_thickness.weft,
                 cell.crossing_spacing.weft);
    // A yarn of each family says what the section is.
    for (unsigned int k = 0; k < pattern.n_warp() + pattern.n_weft(); ++k)
      {
        const bool is_warp = k < pattern.n_warp();
        out << "        <Yarn index=\"" << k
            << "\" NumSlaveNodes=\"20\" NumSectionPoints=\"40\" "
               "NeedsBuilding=\"7\">\n"
            << "            <YarnSection type=\"CYarnSectionConstant\">\n"
            << "                <Section type=\"" << section->second
            << "\" Width=\""
            << number(is_warp ? cell.bundle_width.warp : cell.bundle_width.weft)
            << "\" Height=\""
            << number(is_warp ? cell.bundle_thickness.warp :
                                cell.bundle_thickness.weft)
            << "\"";
        if (const auto power = cell.section_numbers.find("Section power");
            cell.section == "power ellipse" &&
            power != cell.section_numbers.end())
          out << " Power=\"" << number(power->second) << "\"";
        out << " />\n            </YarnSection>\n        </Yarn>\n";
      }
    out << "    </Textile>\n</TexGenModel>\n";
  }



  namespace
  {
    std::string
    three(const dealii::Tensor<1, 3> &v)
    {
      std::string result;
      for (unsigned int c = 0; c < 3; ++c)
        result += (c == 0 ? "" : ", ") + EntryValue<double>::text(v[c]);
      return result;
    }



    // Half spaces that hold the repeat.
    void
    write_domain(const std::array<dealii::Point<3>, 2> &box, std::ostream &out)
    {
      out << "        <Domain type=\"CDomainPlanes\">\n";
      for (unsigned int d = 0; d < 3; ++d)
        for (const double sign : {1., -1.})
          {
            dealii::Tensor<1, 3> normal;
            normal[d] = sign;
            out << "            <Plane Normal=\"" << three(normal) << "\" d=\""
                << EntryValue<double>::text(sign * box[sign > 0. ? 0 : 1][d])
                << "\" />\n";
          }
      out << "        </Domain>\n";
    }



    void
    write_yarn(const std::vector<WovenTextile::Station>  &yarn,
               const unsigned int                         index,
               const std::array<dealii::Tensor<1, 3>, 2> &repeats,
               std::ostream                              &out)
    {
      out << "        <Yarn index=\"" << index << "\" NumSlaveNodes=\""
          << 4 * yarn.size() << "\" NumSectionPoints=\""
          << yarn[0].section.size() << "\" NeedsBuilding=\"7\">\n"
          << "            <Interpolation Periodic=\"1\" "
             "type=\"CInterpolationCubic\" />\n"
          << "            <YarnSection type=\"CYarnSectionInterpNode\" "
             "Ramped=\"0\" Polar=\"0\">\n";
      for (std::size_t k = 0; k < yarn.size(); ++k)
        {
          out << "                <NodeSection nodeindex=\"" << k
              << "\">\n                    <Section "
                 "type=\"CSectionPolygon\">\n";
          for (const auto &corner : yarn[k].section)
            out << "                        <PolygonPoint value=\""
                << EntryValue<double>::text(corner[0]) << ", "
                << EntryValue<double>::text(corner[1]) << "\" />\n";
          out << "                    </Section>\n                "
                 "</NodeSection>\n";
        }
      out << "            </YarnSection>\n";
      for (const auto &repeat : repeats)
        out << "            <Repeat value=\"" << three(repeat) << "\" />\n";
      for (std::size_t k = 0; k < yarn.size(); ++k)
        out << "            <MasterNode index=\"" << k << "\" Position=\""
            << three(yarn[k].position) << "\" Tangent=\""
            << three(yarn[k].tangent) << "\" Up=\"" << three(yarn[k].up)
            << "\" />\n";
      out << "        </Yarn>\n";
    }
  } // namespace



  void
  write_texgen(const WovenTextile &textile, std::ostream &out)
  {
    out << "<?xml version=\"1.0\" ?>\n<TexGenModel version=\"3.13.1\">\n"
        << "    <Textile name=\"" << textile.name
        << "\" type=\"CTextile\" NeedsBuilding=\"1\" "
           "GeometryScale=\"mm\">\n";
    write_domain(textile.box, out);
    for (std::size_t k = 0; k < textile.yarns.size(); ++k)
      write_yarn(textile.yarns[k], k, textile.repeats, out);
    out << "    </Textile>\n</TexGenModel>\n";
  }
} // namespace NPT
