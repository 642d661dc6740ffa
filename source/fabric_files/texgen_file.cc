// SPDX-License-Identifier: LGPL-2.1-or-later
// Values and yarns of TexGen's XML files.

#include <npt_dealii/base/describe_pattern.h>
#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/message_words.h>
#include <npt_dealii/base/short_number.h>
#include <npt_dealii/base/text_file.h>
#include <npt_dealii/fabric_files/texgen_file.h>
#include <npt_dealii/fabric_files/xml_depth.h>

#include <boost/property_tree/xml_parser.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>

namespace NPT
{
  namespace
  {
    const unsigned int max_depth = 100; // of the elements of a file
  }



  bool
  TexGenSection::operator==(const TexGenSection &other) const
  {
    const double tolerance = is_woven() && other.is_woven() ? 1e-2 : 1e-6;
    const auto   near      = [&](const double a, const double b) {
      return std::abs(a - b) <= tolerance * std::max(std::abs(a), std::abs(b));
    };
    return shape == other.shape && near(width, other.width) &&
           near(height, other.height) && near(power, other.power) &&
           near(area, other.area);
  }



  TexGenFile::TexGenFile(const std::string &filename)
    : file_(filename)
  {
    if (const std::string obstacle = obstacle_to_file(file_); !obstacle.empty())
      refuse("it cannot be read: " + obstacle);
    if (!std::filesystem::exists(file_))
      refuse("there is no such file" + home_folder_hint(file_));
    if (std::filesystem::is_directory(file_))
      refuse("it is a directory");
    std::istringstream in(read_text_file(file_, "The TexGen file " + file_));
    if (const unsigned int depth = xml_depth(in.str()); depth > max_depth)
      refuse("it has elements within " + std::to_string(depth) +
             " others, which no weave has");
    try
      {
        boost::property_tree::read_xml(in, tree_);
      }
    catch (const boost::property_tree::xml_parser_error &error)
      {
        refuse("it is no XML file: " + error.message() + " in line " +
               std::to_string(error.line()));
      }
  }



  void
  TexGenFile::refuse(const std::string &what) const
  {
    throw InputError("The TexGen file " + file_ +
                     " cannot be used: " + printable(what) + ".");
  }



  const TexGenFile::Tree &
  TexGenFile::textile()
  {
    const auto model = tree_.get_child_optional("TexGenModel");
    if (!model)
      refuse("it has no element TexGenModel");
    const Tree *found = nullptr;
    for (const auto &[name, child] : *model)
      if (name == "Textile")
        {
          if (found != nullptr)
            refuse("it has several textiles; export one of them");
          found = &child;
        }
    if (found == nullptr)
      refuse("it has no textile");
    scale_ = unit(text(*found, "GeometryScale", "mm"));
    return *found;
  }



  std::string
  TexGenFile::text(const Tree        &tree,
                   const std::string &attribute,
                   const std::string &otherwise)
  {
    return tree.get<std::string>("<xmlattr>." + attribute, otherwise);
  }



  double
  TexGenFile::to_number(const std::string &value,
                        const std::string &where) const
  {
    char        *end    = nullptr;
    const double result = std::strtod(value.c_str(), &end);
    if (value.empty() || *end != '\0' || !std::isfinite(result))
      refuse(where + " is " + in_quotes(value) + ", which is no number");
    if (const std::string fault = number_beyond_doubles(value); !fault.empty())
      refuse(where + " is a number that " +
             fault.substr(fault.find(" is ") + 1));
    return result;
  }



  double
  TexGenFile::length(const Tree        &tree,
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



  double
  TexGenFile::scaled(const std::string &value, const std::string &where) const
  {
    return scale_ * to_number(value, where);
  }



  unsigned int
  TexGenFile::count(const Tree &tree, const std::string &attribute) const
  {
    const double value =
      to_number(text(tree, attribute, ""), attribute + " of the textile");
    if (!(value >= 1. && value <= 1000.) || value != std::floor(value))
      refuse(attribute + " of the textile is " + short_number(value) +
             "; it must be a whole number from 1 to 1000");
    return static_cast<unsigned int>(value);
  }



  unsigned int
  TexGenFile::index_below(const Tree        &tree,
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
  TexGenFile::unit(const std::string &name) const
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



  std::vector<double>
  TexGenFile::lengths(const std::string &value,
                      const unsigned int n,
                      const std::string &where) const
  {
    std::vector<double> result;
    std::istringstream  in(value);
    std::string         item;
    while (result.size() < n && std::getline(in, item, ','))
      {
        item.erase(0, item.find_first_not_of(' '));
        result.push_back(scale_ * to_number(item, where));
      }
    if (result.size() < n)
      refuse(where + " is '" + value + "', not " + (n == 2 ? "two" : "three") +
             " numbers");
    return result;
  }



  std::array<double, 3>
  TexGenFile::vector_of(const std::string &value,
                        const std::string &where) const
  {
    const auto v = lengths(value, 3, where);
    return {{v[0], v[1], v[2]}};
  }



  // ------------------------------------------------------------------ yarns

  std::vector<TexGenYarn>
  TexGenFile::read_yarns(const Tree &textile) const
  {
    std::vector<TexGenYarn> yarns;
    for (const auto &[element, child] : textile)
      if (element == "Yarn")
        {
          TexGenYarn yarn;
          yarn.name =
            "yarn " + text(child, "index", std::to_string(yarns.size()));
          for (const auto &[part, data] : child)
            if (part == "YarnSection")
              yarn.section = read_yarn_section(data, yarn.name);
            else if (part == "Repeat")
              yarn.repeats.push_back(
                vector_of(text(data, "value", ""), "a repeat of " + yarn.name));
            else if (part == "MasterNode")
              yarn.nodes.push_back(vector_of(text(data, "Position", ""),
                                             "a node of " + yarn.name));
          yarns.push_back(yarn);
        }
    return yarns;
  }



  TexGenSection
  TexGenFile::read_yarn_section(const Tree &tree, const std::string &yarn) const
  {
    const std::string type = text(tree, "type", "");
    if (type == "CYarnSectionInterpNode")
      return read_polygons(tree, yarn);
    if (type != "CYarnSectionConstant")
      refuse("the section of " + yarn + " is a " + type +
             ", which changes along the yarn; only constant sections and "
             "polygons at the nodes are read");
    const auto section = tree.get_child_optional("Section");
    if (!section)
      refuse(yarn + " has no section");
    return read_section(*section, yarn);
  }



  TexGenSection
  TexGenFile::read_section(const Tree &tree, const std::string &yarn) const
  {
    const std::string type = text(tree, "type", "");
    TexGenSection     result;
    if (type == "CSectionEllipse")
      result.shape = "ellipse";
    else if (type == "CSectionLenticular")
      {
        if (to_number(text(tree, "Distortion", "0"), "Distortion of " + yarn) !=
            0.)
          refuse("the lenticular section of " + yarn +
                 " has a Distortion, and only symmetric ones are read");
        result.shape = "lens";
      }
    else if (type == "CSectionRectangle")
      result.shape = "rounded rectangle";
    else if (type == "CSectionPowerEllipse")
      {
        if (to_number(text(tree, "XOffset", "0"), "XOffset of " + yarn) != 0.)
          refuse("the power ellipse of " + yarn +
                 " has an XOffset, and only symmetric ones are read");
        result.shape = "power ellipse";
        result.power =
          to_number(text(tree, "Power", ""), "Power of the section of " + yarn);
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



  /*
   * The last node of a periodic yarn is its first one again; with equal shares
   * the ends would count twice.
   */
  TexGenSection
  TexGenFile::read_polygons(const Tree &tree, const std::string &yarn) const
  {
    std::vector<TexGenSection> sections;
    for (const auto &[name, node] : tree)
      if (name == "NodeSection")
        {
          const auto        section = node.get_child_optional("Section");
          const std::string type    = section ? text(*section, "type", "") : "";
          if (type != "CSectionPolygon")
            refuse("the sections of " + yarn +
                   " change along the yarn, and one of them is a " +
                   (type.empty() ? "section without a type" : type) +
                   "; only constant sections and polygons at the nodes are "
                   "read");
          sections.push_back(read_polygon(*section, yarn));
        }
    if (sections.size() < 3)
      refuse("the section of " + yarn + " is a CYarnSectionInterpNode with " +
             std::to_string(sections.size()) +
             " sections, and at least three are needed");
    TexGenSection mean{"lens"};
    for (std::size_t k = 0; k < sections.size(); ++k)
      {
        const bool   is_end = k == 0 || k + 1 == sections.size();
        const double share  = (is_end ? 0.5 : 1.) / (sections.size() - 1.);
        mean.width += share * sections[k].width;
        mean.height += share * sections[k].height;
        mean.area += share * sections[k].area;
      }
    return mean;
  }



  TexGenSection
  TexGenFile::read_polygon(const Tree &tree, const std::string &yarn) const
  {
    std::vector<std::array<double, 2>> corners;
    for (const auto &[name, point] : tree)
      if (name == "PolygonPoint")
        {
          const auto corner = lengths(text(point, "value", ""),
                                      2,
                                      "a corner of a section of " + yarn);
          corners.push_back({{corner[0], corner[1]}});
        }
    if (corners.size() < 3)
      refuse("a section of " + yarn + " has " + std::to_string(corners.size()) +
             " corners, and a polygon has at least three");
    std::array<double, 2> low = corners[0], high = corners[0];
    double                twice_area = 0;
    for (std::size_t k = 0; k < corners.size(); ++k)
      {
        const auto &a = corners[k], &b = corners[(k + 1) % corners.size()];
        twice_area += a[0] * b[1] - a[1] * b[0];
        for (unsigned int c = 0; c < 2; ++c)
          {
            low[c]  = std::min(low[c], a[c]);
            high[c] = std::max(high[c], a[c]);
          }
      }
    TexGenSection result{"lens", high[0] - low[0], high[1] - low[1]};
    result.area = 0.5 * std::abs(twice_area);
    if (!(result.area > 0.))
      refuse("a section of " + yarn + " has no area");
    return result;
  }
} // namespace NPT
