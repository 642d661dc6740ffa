// SPDX-License-Identifier: LGPL-2.1-or-later
// Values and yarns of TexGen's XML files.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/short_number.h>
#include <npt_dealii/fabric_files/texgen_file.h>

#include <boost/property_tree/xml_parser.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>

namespace NPT
{
  bool
  TexGenSection::operator==(const TexGenSection &other) const
  {
    const auto near = [](const double a, const double b) {
      return std::abs(a - b) <= 1e-6 * std::max(std::abs(a), std::abs(b));
    };
    return shape == other.shape && near(width, other.width) &&
           near(height, other.height) && near(power, other.power);
  }



  TexGenFile::TexGenFile(const std::string &filename)
    : file_(filename)
  {
    if (!std::filesystem::is_regular_file(file_))
      refuse("there is no such file");
    try
      {
        boost::property_tree::read_xml(file_, tree_);
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
    throw InputError("The TexGen file " + file_ + " cannot be used: " + what +
                     ".");
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
      refuse(where + " is '" + value + "', which is no number");
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



  std::array<double, 3>
  TexGenFile::vector_of(const std::string &value,
                        const std::string &where) const
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
    if (type != "CYarnSectionConstant")
      refuse("the section of " + yarn + " is a " + type +
             ", which changes along the yarn; only constant sections are "
             "read");
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
} // namespace NPT
