// SPDX-License-Identifier: LGPL-2.1-or-later
// Weaves in the XML files of TexGen.

#include <npt_dealii/base/describe_pattern.h>
#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/message_words.h>
#include <npt_dealii/base/short_number.h>
#include <npt_dealii/base/text_file.h>
#include <npt_dealii/fabric/weave_pattern.h>
#include <npt_dealii/fabric_files/texgen.h>
#include <npt_dealii/fabric_files/xml_depth.h>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>
#include <ostream>
#include <sstream>

namespace NPT
{
  namespace
  {
    using Tree = boost::property_tree::ptree;

    // Thin enough for the areas of TexGen, whose edges are sharp; sections that
    // are steep at their edges need more.
    const double       thinnest_blunt_tip = 0.01, step_of_blunt_tip = 0.01;
    const unsigned int max_depth = 100; // of its elements
    // Between face and edge [degrees]; at 75 the cells count as degenerate.
    const double steepest_edge = 72.;

    struct Section
    {
      std::string shape;
      double      width = 0, height = 0, power = 0;

      bool
      operator==(const Section &other) const
      {
        const auto near = [](const double a, const double b) {
          return std::abs(a - b) <= 1e-6 * std::max(std::abs(a), std::abs(b));
        };
        return shape == other.shape && near(width, other.width) &&
               near(height, other.height) && near(power, other.power);
      }
    };

    // Yarn as the file has it, in its order.
    struct Yarn
    {
      std::string                        name; // "yarn 3" in messages
      std::optional<Section>             section;
      std::vector<std::array<double, 3>> nodes;
      std::vector<std::array<double, 3>> repeats;
    };



    class TexGenReader
    {
    public:
      explicit TexGenReader(const std::string &filename)
        : file_(filename)
      {}

      ImportedWeave
      read()
      {
        Tree tree;
        if (const std::string obstacle = obstacle_to_file(file_);
            !obstacle.empty())
          refuse("it cannot be read: " + obstacle);
        if (!std::filesystem::exists(file_))
          refuse("there is no such file" + home_folder_hint(file_));
        if (std::filesystem::is_directory(file_))
          refuse("it is a directory");
        std::istringstream in(
          read_text_file(file_, "The TexGen file " + file_));
        if (const unsigned int depth = xml_depth(in.str()); depth > max_depth)
          refuse("it has elements within " + std::to_string(depth) +
                 " others, which no weave has");
        try
          {
            boost::property_tree::read_xml(in, tree);
          }
        catch (const boost::property_tree::xml_parser_error &error)
          {
            refuse("it is no XML file: " + error.message() + " in line " +
                   std::to_string(error.line()));
          }
        const auto model = tree.get_child_optional("TexGenModel");
        if (!model)
          refuse("it has no element TexGenModel");
        const Tree *textile = nullptr;
        for (const auto &[name, child] : *model)
          if (name == "Textile")
            {
              if (textile != nullptr)
                refuse("it has several textiles; export one of them");
              textile = &child;
            }
        if (textile == nullptr)
          refuse("it has no textile");
        return read_textile(*textile);
      }

    private:
      [[noreturn]] void
      refuse(const std::string &what) const
      {
        throw InputError("The TexGen file " + file_ +
                         " cannot be used: " + printable(what) + ".");
      }

      ImportedWeave
      read_textile(const Tree &textile)
      {
        weave_.name            = text(textile, "name", "");
        const std::string type = text(textile, "type", "");
        scale_                 = unit(text(textile, "GeometryScale", "mm"));
        read_yarns(textile);
        if (type == "CTextileWeave2D")
          read_weave(textile);
        else if (type == "CTextile")
          find_weave();
        else
          refuse(
            "its textile is a " +
            (type.empty() ? "textile without a type" : type) +
            ", and only two-dimensional weaves of straight families of yarns "
            "(CTextileWeave2D, CTextile) are read");
        set_sections();
        set_blunt_tip();
        note_materials(textile);
        return weave_;
      }

      // -------------------------------------------------------------- values

      static std::string
      text(const Tree        &tree,
           const std::string &attribute,
           const std::string &otherwise)
      {
        return tree.get<std::string>("<xmlattr>." + attribute, otherwise);
      }

      double
      to_number(const std::string &value, const std::string &where) const
      {
        char        *end    = nullptr;
        const double result = std::strtod(value.c_str(), &end);
        if (value.empty() || *end != '\0' || !std::isfinite(result))
          refuse(where + " is " + in_quotes(value) + ", which is no number");
        if (const std::string fault = number_beyond_doubles(value);
            !fault.empty())
          refuse(where + " is a number that " +
                 fault.substr(fault.find(" is ") + 1));
        return result;
      }

      double
      length(const Tree        &tree,
             const std::string &attribute,
             const std::string &where) const
      {
        const double value =
          to_number(text(tree, attribute, ""), attribute + " of " + where);
        if (!(value > 0.))
          refuse(attribute + " of " + where + " is " + short_number(value) +
                 " and must be positive");
        return scale_ * value;
      }

      unsigned int
      count(const Tree &tree, const std::string &attribute) const
      {
        const double value =
          to_number(text(tree, attribute, ""), attribute + " of the textile");
        if (!(value >= 1. && value <= 1000.) || value != std::floor(value))
          refuse(attribute + " of the textile is " + short_number(value) +
                 "; it must be a whole number from 1 to 1000");
        return static_cast<unsigned int>(value);
      }

      unsigned int
      index_below(const Tree        &tree,
                  const std::string &attribute,
                  const unsigned int end,
                  const std::string &where) const
      {
        const double value =
          to_number(text(tree, attribute, ""), attribute + " of a " + where);
        if (!(value >= 0. && value < end) || value != std::floor(value))
          refuse(attribute + " of a " + where + " is " + short_number(value) +
                 ", outside 0 to " + std::to_string(end - 1));
        return static_cast<unsigned int>(value);
      }

      double
      unit(const std::string &name) const
      {
        static const std::map<std::string, double> units = {{"mm", 1.},
                                                            {"m", 1000.},
                                                            {"cm", 10.},
                                                            {"um", 1e-3},
                                                            {"micron", 1e-3},
                                                            {"in", 25.4},
                                                            {"inch", 25.4},
                                                            {"ft", 304.8}};
        const auto                                 found = units.find(name);
        if (found == units.end())
          refuse("its GeometryScale is '" + name +
                 "', which is none of mm, m, cm, um, micron, in, inch, ft");
        return found->second;
      }

      std::array<double, 3>
      vector_of(const std::string &value, const std::string &where) const
      {
        std::array<double, 3> result{};
        std::istringstream    in(value);
        std::string           item;
        for (unsigned int i = 0; i < 3; ++i)
          {
            if (!std::getline(in, item, ','))
              refuse(where + " is '" + value + "', not three numbers");
            item.erase(0, item.find_first_not_of(' '));
            result[i] = scale_ * to_number(item, where);
          }
        return result;
      }

      // --------------------------------------------------------------- yarns

      void
      read_yarns(const Tree &textile)
      {
        for (const auto &[element, child] : textile)
          if (element == "Yarn")
            {
              Yarn yarn;
              yarn.name =
                "yarn " + text(child, "index", std::to_string(yarns_.size()));
              for (const auto &[part, data] : child)
                if (part == "YarnSection")
                  yarn.section = read_yarn_section(data, yarn.name);
                else if (part == "Repeat")
                  yarn.repeats.push_back(vector_of(text(data, "value", ""),
                                                   "a repeat of " + yarn.name));
                else if (part == "MasterNode")
                  yarn.nodes.push_back(vector_of(text(data, "Position", ""),
                                                 "a node of " + yarn.name));
              yarns_.push_back(yarn);
            }
      }

      Section
      read_yarn_section(const Tree &tree, const std::string &yarn) const
      {
        const std::string type = text(tree, "type", "");
        if (type != "CYarnSectionConstant")
          refuse("the section of " + yarn + " is a " + type +
                 ", which changes along the yarn; only constant sections are "
                 "read");
        const auto section = tree.get_child_optional("Section");
        if (!section)
          refuse(yarn + " has no section");
        return read_section(*section, yarn);
      }

      Section
      read_section(const Tree &tree, const std::string &yarn) const
      {
        const std::string type = text(tree, "type", "");
        Section           result;
        if (type == "CSectionEllipse")
          result.shape = "ellipse";
        else if (type == "CSectionLenticular")
          {
            if (to_number(text(tree, "Distortion", "0"),
                          "Distortion of " + yarn) != 0.)
              refuse("the lenticular section of " + yarn +
                     " has a Distortion, and only symmetric ones are read");
            result.shape = "lens";
          }
        else if (type == "CSectionRectangle")
          result.shape = "rounded rectangle";
        else if (type == "CSectionPowerEllipse")
          {
            if (to_number(text(tree, "XOffset", "0"), "XOffset of " + yarn) !=
                0.)
              refuse("the power ellipse of " + yarn +
                     " has an XOffset, and only symmetric ones are read");
            result.shape = "power ellipse";
            result.power = to_number(text(tree, "Power", ""),
                                     "Power of the section of " + yarn);
          }
        else
          refuse("the section of " + yarn + " is a " +
                 (type.empty() ? "section without a type" : type) +
                 ", and only ellipse, power ellipse, lenticular and rectangle "
                 "are read");
        result.width  = length(tree, "Width", "the section of " + yarn);
        result.height = length(tree, "Height", "the section of " + yarn);
        return result;
      }

      // ------------------------------------------------- CTextileWeave2D

      struct YarnSizes
      {
        double width = 0, height = 0, spacing = 0;
      };

      // All yarns of a family, which must be equal.
      YarnSizes
      read_sizes(const Tree        &textile,
                 const std::string &element,
                 const unsigned int n) const
      {
        std::vector<YarnSizes> sizes;
        for (const auto &[name, child] : textile)
          if (name == element)
            {
              const std::string yarn =
                element.substr(0, 1) + " yarn " +
                text(child, "index", std::to_string(sizes.size()));
              sizes.push_back({length(child, "Width", yarn),
                               length(child, "Height", yarn),
                               length(child, "Spacing", yarn)});
              const auto differs =
                [&](const double a, const double b, const std::string &what) {
                  if (std::abs(a - b) > 1e-6 * b)
                    refuse(what + " of " + yarn + " is " + short_number(a) +
                           " mm, that of the first one " + short_number(b) +
                           " mm, and all yarns of a family must be equal here");
                };
              differs(sizes.back().width, sizes[0].width, "Width");
              differs(sizes.back().height, sizes[0].height, "Height");
              differs(sizes.back().spacing, sizes[0].spacing, "Spacing");
            }
        if (sizes.size() != n)
          refuse("it has " + std::to_string(sizes.size()) + " elements " +
                 element + " for " + std::to_string(n) + " yarns");
        return sizes[0];
      }

      void
      read_weave(const Tree &textile)
      {
        const unsigned int n_warp = count(textile, "NumXYarns");
        const unsigned int n_weft = count(textile, "NumYYarns");
        const YarnSizes    warp   = read_sizes(textile, "XYarnData", n_warp);
        const YarnSizes    weft   = read_sizes(textile, "YYarnData", n_weft);
        // Warp bundles are as far apart as the spacing of X yarns says.
        weave_.cell.crossing_spacing = {warp.spacing, weft.spacing};
        weave_.cell.bundle_width     = {warp.width, weft.width};
        weave_.cell.bundle_thickness = {warp.height, weft.height};

        std::vector<std::string> rows(n_weft, std::string(n_warp, '?'));
        for (const auto &[name, child] : textile)
          if (name == "PatternCell")
            {
              const unsigned int  j = index_below(child, "x", n_weft, name);
              const unsigned int  i = index_below(child, "y", n_warp, name);
              std::vector<double> layers;
              for (const auto &[part, element] : child)
                if (part == "PatternElement")
                  layers.push_back(
                    to_number(text(element, "value", ""), part + " value"));
              if (layers.size() != 2 || layers[0] + layers[1] != 1.)
                refuse("the crossing of X yarn " + std::to_string(i) +
                       " and Y yarn " + std::to_string(j) + " has " +
                       std::to_string(layers.size()) +
                       " layers that are not one X and one Y yarn; weaves with "
                       "several layers are not read");
              rows[j][i] = layers.back() == 1. ? 'o' : 'u';
            }
        for (unsigned int j = 0; j < n_weft; ++j)
          if (const auto i = rows[j].find('?'); i != std::string::npos)
            refuse("the crossing of X yarn " + std::to_string(i) +
                   " and Y yarn " + std::to_string(j) + " has no PatternCell");
        set_table(rows);

        const double      sum       = warp.height + weft.height;
        const std::string thickness = text(textile, "FabricThickness", "");
        if (!thickness.empty())
          {
            const double T =
              scale_ * to_number(thickness, "FabricThickness of the textile");
            if (std::abs(T - sum) > 1e-3 * sum)
              weave_.notes.push_back(
                "The FabricThickness of the file is " + short_number(T, 4) +
                " mm; yarns that touch are " + short_number(sum, 4) +
                " mm thick together, which is the thickness here.");
          }
        if (const std::string gap = text(textile, "GapSize", "0");
            to_number(gap, "GapSize of the textile") != 0.)
          weave_.notes.push_back("The GapSize of " + gap +
                                 " is not taken: bundles touch here.");
      }

      void
      set_table(const std::vector<std::string> &rows)
      {
        std::string table;
        for (const std::string &row : rows)
          table += (table.empty() ? "" : "/") + row;
        weave_.cell.weave = table;
      }

      // ---------------------------------------------------- CTextile by nodes

      struct StraightYarn
      {
        std::size_t index; // among yarns_
        double      at;    // its coordinate across
      };

      void
      find_weave()
      {
        if (yarns_.empty())
          refuse("it has no yarns");
        // Along x: warp; across them along y: weft.
        std::array<std::vector<StraightYarn>, 2> families;
        std::array<double, 2>                    period = {{0., 0.}};
        for (std::size_t k = 0; k < yarns_.size(); ++k)
          {
            const Yarn &yarn = yarns_[k];
            if (yarn.nodes.size() < 2)
              refuse(yarn.name + " has less than two nodes");
            const auto  &a = yarn.nodes.front(), &b = yarn.nodes.back();
            const double dx = std::abs(b[0] - a[0]), dy = std::abs(b[1] - a[1]);
            const unsigned int along = dx > dy ? 0 : 1;
            if (std::min(dx, dy) > 1e-6 * std::max(dx, dy) ||
                !(std::max(dx, dy) > 0.))
              refuse(yarn.name +
                     " runs neither along x nor along y; sheared weaves are "
                     "not read");
            for (const auto &node : yarn.nodes)
              if (std::abs(node[1 - along] - a[1 - along]) >
                  1e-6 * std::max(dx, dy))
                refuse(yarn.name + " is not straight in the plane");
            families[along].push_back({k, a[1 - along]});
            for (const auto &repeat : yarn.repeats)
              for (unsigned int d = 0; d < 2; ++d)
                if (repeat[d] != 0. && repeat[1 - d] == 0.)
                  period[d] = std::abs(repeat[d]);
          }
        for (unsigned int along = 0; along < 2; ++along)
          {
            if (families[along].empty())
              refuse(std::string("no yarn runs along ") +
                     (along == 0 ? "x" : "y"));
            if (!(period[1 - along] > 0.))
              refuse(std::string("its yarns have no repeat along ") +
                     (along == 0 ? "y" : "x"));
            auto &family = families[along];
            std::sort(family.begin(),
                      family.end(),
                      [](const StraightYarn &a, const StraightYarn &b) {
                        return a.at < b.at;
                      });
            check_spacing(family, period[1 - along]);
          }
        weave_.cell.crossing_spacing = {period[1] / families[0].size(),
                                        period[0] / families[1].size()};
        read_heights(families, period);
      }

      void
      check_spacing(const std::vector<StraightYarn> &family,
                    const double                     period) const
      {
        const double spacing = period / family.size();
        for (std::size_t k = 1; k < family.size(); ++k)
          if (std::abs(family[k].at - family[k - 1].at - spacing) >
              1e-4 * spacing)
            refuse(yarns_[family[k].index].name + " lies " +
                   short_number(family[k].at - family[k - 1].at) +
                   " mm beside its neighbor, where equal spacing would be " +
                   short_number(spacing) + " mm");
      }

      // Height of a yarn at a coordinate along it, linear between nodes.
      double
      height_at(const Yarn        &yarn,
                const unsigned int along,
                double             s,
                const double       period) const
      {
        const double first = yarn.nodes.front()[along];
        s = first + std::fmod(s - first + 1e3 * period, period);
        for (std::size_t k = 1; k < yarn.nodes.size(); ++k)
          {
            const auto &a = yarn.nodes[k - 1], &b = yarn.nodes[k];
            if (s <= b[along] + 1e-9 * period)
              return a[2] +
                     (b[2] - a[2]) * (s - a[along]) / (b[along] - a[along]);
          }
        return yarn.nodes.back()[2];
      }

      void
      read_heights(const std::array<std::vector<StraightYarn>, 2> &families,
                   const std::array<double, 2>                    &period)
      {
        std::vector<std::string> rows;
        for (const StraightYarn &weft : families[1])
          {
            rows.emplace_back();
            for (const StraightYarn &warp : families[0])
              {
                const double of_warp =
                  height_at(yarns_[warp.index], 0, weft.at, period[0]);
                const double of_weft =
                  height_at(yarns_[weft.index], 1, warp.at, period[1]);
                if (of_warp == of_weft)
                  refuse(yarns_[warp.index].name + " and " +
                         yarns_[weft.index].name +
                         " are at the same height where they cross");
                rows.back() += of_warp > of_weft ? 'o' : 'u';
              }
          }
        set_table(rows);
        for (const auto &family : families)
          for (const StraightYarn &yarn : family)
            if (!yarns_[yarn.index].section)
              refuse(yarns_[yarn.index].name + " has no section");
        const Section warp           = common_section(families[0]);
        const Section weft           = common_section(families[1]);
        weave_.cell.bundle_width     = {warp.width, weft.width};
        weave_.cell.bundle_thickness = {warp.height, weft.height};
      }

      Section
      common_section(const std::vector<StraightYarn> &family) const
      {
        const Section first = *yarns_[family[0].index].section;
        for (const StraightYarn &yarn : family)
          if (!(*yarns_[yarn.index].section == first))
            refuse("the section of " + yarns_[yarn.index].name +
                   " is another one than that of " +
                   yarns_[family[0].index].name +
                   ", and all yarns of a family must be equal here");
        return first;
      }

      // ------------------------------------------------------------- sections

      void
      set_sections()
      {
        CellParameters &cell = weave_.cell;
        cell.section         = "ellipse"; // of a weave without yarns
        const Section *first = nullptr;
        for (const Yarn &yarn : yarns_)
          if (yarn.section)
            {
              if (first == nullptr)
                first = &*yarn.section;
              else if (yarn.section->shape != first->shape ||
                       yarn.section->power != first->power)
                refuse("the section of " + yarn.name + " is " +
                       yarn.section->shape + ", that of the first yarn " +
                       first->shape +
                       "; warp and weft have one shape of section here");
              check_sizes(yarn);
            }
        if (first == nullptr)
          return;
        cell.section = first->shape;
        if (cell.section == "power ellipse")
          cell.section_numbers["Section power"] = first->power;
      }

      // Edges as thin as the cells of the bundles can be.
      void
      set_blunt_tip()
      {
        CellParameters &cell = weave_.cell;
        if (cell.section == "rounded rectangle")
          {
            // The sides of a rectangle are as high as its arcs are small.
            cell.blunt_tip = 0.45;
            weave_.notes.push_back(
              "The corners of the rectangle are rounded by a tenth of its "
              "height (Blunt tip).");
            return;
          }
        if (cell.section == "lens")
          {
            cell.blunt_tip = std::max(thinnest_blunt_tip,
                                      0.5 * (tip_of_arcs(cell.warp_section()) +
                                             tip_of_arcs(cell.weft_section())));
            return;
          }
        cell.blunt_tip = thinnest_blunt_tip;
        while (cell.blunt_tip < 0.3 &&
               std::max(cell.warp_section().edge_angle(),
                        cell.weft_section().edge_angle()) > steepest_edge)
          cell.blunt_tip += step_of_blunt_tip;
        if (cell.blunt_tip == thinnest_blunt_tip)
          return;
        BundleSection sharp = cell.warp_section();
        sharp.tip           = 1e-9 * sharp.thickness;
        weave_.notes.push_back(
          "The edges of the bundles are " +
          short_number(2. * cell.blunt_tip * sharp.thickness, 2) +
          " mm high, where those of the file are sharp: sections are " +
          short_number(100. * (cell.warp_section().area() / sharp.area() - 1.),
                       2) +
          " % larger.");
      }

      // e/t with which a lens, whose faces are parabolas of half height e at
      // the edge, has the area w (2/3 t + 2/3 e) of two circular arcs.
      static double
      tip_of_arcs(const BundleSection &section)
      {
        const double w = section.width, h = 0.5 * section.thickness;
        const double R     = (0.25 * w * w + h * h) / (2. * h);
        const double angle = std::asin(std::min(1., 0.5 * w / R));
        const double area =
          2. * R * R * (angle - std::sin(angle) * std::cos(angle));
        return 1.5 * area / (w * section.thickness) - 1.;
      }

      // Weave parameters of a file may be older than its yarns.
      void
      check_sizes(const Yarn &yarn)
      {
        const auto fits = [&](const double width, const double height) {
          return std::abs(yarn.section->width - width) <= 1e-6 * width &&
                 std::abs(yarn.section->height - height) <= 1e-6 * height;
        };
        const CellParameters &cell = weave_.cell;
        if (!fits(cell.bundle_width.warp, cell.bundle_thickness.warp) &&
            !fits(cell.bundle_width.weft, cell.bundle_thickness.weft))
          refuse("the section of " + yarn.name + " is " +
                 short_number(yarn.section->width) + " x " +
                 short_number(yarn.section->height) +
                 " mm, but the weave says " +
                 short_number(cell.bundle_width.warp) + " x " +
                 short_number(cell.bundle_thickness.warp) + " mm (X) and " +
                 short_number(cell.bundle_width.weft) + " x " +
                 short_number(cell.bundle_thickness.weft) +
                 " mm (Y); build the textile again and save it");
      }

      // ------------------------------------------------------------ materials

      void
      note_materials(const Tree &textile)
      {
        const std::string E = text(textile, "YoungsModulusX", "");
        if (E.empty())
          return;
        const bool is_default =
          std::strtod(E.c_str(), nullptr) == 200000. &&
          std::strtod(text(textile, "YoungsModulusY", "").c_str(), nullptr) ==
            10000.;
        weave_.notes.push_back(
          is_default ?
            "The moduli of the file (200000 and 10000 MPa) are those that "
            "TexGen writes into every file, of an impregnated tow; they are "
            "not taken." :
            "The file has a Young's modulus of " + E + " " +
              text(textile, "YoungsModulusXUnits", "MPa") +
              " along the yarns; moduli are not taken, because a dry bundle "
              "needs others than an impregnated one.");
      }

      const std::string file_;
      double            scale_ = 1.;
      std::vector<Yarn> yarns_;
      ImportedWeave     weave_;
    };



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



  ImportedWeave
  read_texgen(const std::string &filename)
  {
    ImportedWeave weave = TexGenReader(filename).read();
    try
      {
        WeavePattern(weave.cell.weave);
        weave.cell.check();
      }
    catch (const InputError &error)
      {
        throw InputError(
          "The TexGen file " + filename +
          " gives a cell that cannot be computed: " + error.what());
      }
    return weave;
  }



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
} // namespace NPT
