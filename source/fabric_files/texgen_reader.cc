// SPDX-License-Identifier: LGPL-2.1-or-later
// Weaves from the XML files of TexGen.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/short_number.h>
#include <npt_dealii/fabric/weave_pattern.h>
#include <npt_dealii/fabric_files/texgen.h>
#include <npt_dealii/fabric_files/texgen_file.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace NPT
{
  namespace
  {
    using Section = TexGenSection;
    using Yarn    = TexGenYarn;


    // Thin enough for the areas of TexGen, whose edges are sharp; sections that
    // are steep at their edges need more.
    const double thinnest_blunt_tip = 0.01, step_of_blunt_tip = 0.01;
    // Between face and edge [degrees]; at 75 the cells count as degenerate.
    const double steepest_edge = 72.;

    class TexGenReader : private TexGenFile
    {
    public:
      explicit TexGenReader(const std::string &filename)
        : TexGenFile(filename)
      {}

      ImportedWeave
      read()
      {
        const Tree &tree       = textile();
        weave_.name            = text(tree, "name", "");
        const std::string type = text(tree, "type", "");
        yarns_                 = read_yarns(tree);
        if (type == "CTextileWeave2D")
          read_weave(tree);
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
        note_materials(tree);
        return weave_;
      }

    private:
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
              scaled(thickness, "FabricThickness of the textile");
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
            // Woven yarns swerve a little where their neighbors differ.
            const bool   woven = yarn.section && yarn.section->is_woven();
            const double bend  = woven ? 0.02 : 1e-6;
            if (std::min(dx, dy) > 1e-6 * std::max(dx, dy) ||
                !(std::max(dx, dy) > 0.))
              refuse(yarn.name +
                     " runs neither along x nor along y; sheared weaves are "
                     "not read");
            for (const auto &node : yarn.nodes)
              if (std::abs(node[1 - along] - a[1 - along]) >
                  bend * std::max(dx, dy))
                refuse(yarn.name + " is not straight in the plane");
            families[along].push_back({k, mean_across(yarn, 1 - along)});
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

      bool
      is_woven(const std::vector<StraightYarn> &family) const
      {
        const auto &section = yarns_[family[0].index].section;
        return section && section->is_woven();
      }

      static double
      mean_across(const Yarn &yarn, const unsigned int across)
      {
        double sum = 0;
        for (const auto &node : yarn.nodes)
          sum += node[across] / yarn.nodes.size();
        return sum;
      }

      void
      check_spacing(const std::vector<StraightYarn> &family,
                    const double                     period) const
      {
        const double spacing = period / family.size();
        for (std::size_t k = 1; k < family.size(); ++k)
          if (std::abs(family[k].at - family[k - 1].at - spacing) >
              (is_woven(family) ? 1e-2 : 1e-4) * spacing)
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
              if (!yarn.section->is_woven())
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
        if (std::any_of(yarns_.begin(), yarns_.end(), [](const Yarn &yarn) {
              return yarn.section && yarn.section->is_woven();
            }))
          {
            set_woven_sections();
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

      // Lenses with the mean areas of the sections: the tip fits both families
      // in the mean, the widths the rest.
      void
      set_woven_sections()
      {
        CellParameters &cell = weave_.cell;
        const auto      area = [&](const double width, const double height) {
          for (const Yarn &yarn : yarns_)
            if (yarn.section && yarn.section->width == width &&
                yarn.section->height == height)
              return yarn.section->area;
          refuse("its yarns have different kinds of sections");
        };
        double &warp_width     = cell.bundle_width.warp,
               &weft_width     = cell.bundle_width.weft;
        const double warp_box  = warp_width * cell.bundle_thickness.warp,
                     weft_box  = weft_width * cell.bundle_thickness.weft;
        const double warp_area = area(warp_width, cell.bundle_thickness.warp),
                     weft_area = area(weft_width, cell.bundle_thickness.weft);
        const double filled =
          0.5 * (warp_area / warp_box + weft_area / weft_box);
        cell.blunt_tip =
          std::clamp(1.5 * filled - 1., thinnest_blunt_tip, 0.45);
        const double lens = 2. / 3. * (1. + cell.blunt_tip);
        warp_width *= warp_area / (lens * warp_box);
        weft_width *= weft_area / (lens * weft_box);
        weave_.notes.push_back(
          "The sections of the file are polygons of a woven state; the straight "
          "bundles are lenses with their mean areas, " +
          short_number(warp_area, 4) + " mm^2 (X) and " +
          short_number(weft_area, 4) + " mm^2 (Y), and their mean heights.");
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

      std::vector<Yarn> yarns_;
      ImportedWeave     weave_;
    };
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
} // namespace NPT
