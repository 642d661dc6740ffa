// SPDX-License-Identifier: LGPL-2.1-or-later
// The entries of a data sheet and their units.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/message_words.h>
#include <npt_dealii/base/nearest_name.h>
#include <npt_dealii/base/parameter_file.h>
#include <npt_dealii/base/registry.h>
#include <npt_dealii/base/short_number.h>
#include <npt_dealii/fabric/named_weave.h>
#include <npt_dealii/fabric/section_shape.h>
#include <npt_dealii/fabric_files/data_sheet.h>

#include <cmath>
#include <cstdlib>
#include <utility>

namespace NPT
{
  namespace Patterns = dealii::Patterns;

  namespace
  {
    // A unit and what it is in the unit of the program.
    using Units = std::vector<std::pair<std::string, double>>;

    // A quantity of a data sheet: its units, the first one where none is given,
    // and the range in it. Beyond the range a unit was mistaken.
    struct Quantity
    {
      std::string entry;
      Units       units;
      double      smallest, largest;
      bool        one_number; // for warp and weft together
      std::string documentation;
    };

    const Units per_length = {{"per cm", 1.},
                              {"/cm", 1.},
                              {"per inch", 1. / 2.54},
                              {"/inch", 1. / 2.54},
                              {"per 25 mm", 0.4}};
    const Units lengths    = {{"mm", 1.},
                              {"um", 1e-3},
                              {"mil", 0.0254},
                              {"inch", 25.4}};
    const Units fractions  = {{"", 1.}, {"%", 0.01}};
    const Units percents   = {{"%", 0.01}};



    double
    number_before(const std::string &text, std::string &rest)
    {
      char        *end   = nullptr;
      const double value = std::strtod(text.c_str(), &end);
      rest               = trim(end);
      return end == text.c_str() ? std::nan("") : value;
    }



    // The factor of a unit, or nothing.
    std::optional<double>
    factor_of(const Units &units, const std::string &unit)
    {
      if (unit.empty())
        return units.front().second;
      for (const auto &[name, factor] : units)
        if (name == unit)
          return factor;
      return {};
    }



    std::string
    refusal(const Quantity &quantity, const std::string &text)
    {
      std::vector<std::string> names;
      for (const auto &[name, factor] : quantity.units)
        if (!name.empty())
          names.push_back(name);
      return quantity.entry + " is '" + text + "'; it must be " +
             (quantity.one_number ?
                "one number" :
                "one number, or two for warp and weft, separated by a comma") +
             ", with a unit behind it if it is not " +
             (quantity.units.front().first.empty() ?
                "a fraction of 1" :
                quantity.units.front().first) +
             ": " + joined(names, ", ");
    }



    WarpWeft
    value_of_quantity(const Quantity &quantity, const std::string &text)
    {
      const auto parts = split_list(text);
      if (parts.empty() || parts.size() > (quantity.one_number ? 1 : 2))
        throw InputError(refusal(quantity, text));
      std::vector<double>      values;
      std::vector<std::string> units;
      for (const std::string &part : parts)
        {
          std::string rest;
          values.push_back(number_before(part, rest));
          units.push_back(rest);
          if (!std::isfinite(values.back()))
            throw InputError(refusal(quantity, text));
        }
      const std::string unit = units.back();
      if (!units.front().empty() && units.front() != unit)
        throw InputError(refusal(quantity, text) +
                         "; the unit stands behind the last number, for both");
      const auto factor = factor_of(quantity.units, unit);
      if (!factor)
        {
          std::vector<std::string> names;
          for (const auto &[name, f] : quantity.units)
            names.push_back(name);
          throw InputError(refusal(quantity, text) + did_you_mean(unit, names));
        }
      for (double &value : values)
        {
          value *= *factor;
          if (!(value >= quantity.smallest && value <= quantity.largest))
            throw InputError(
              quantity.entry + " is '" + text + "', which is " +
              short_number(value / quantity.units.front().second) + " " +
              quantity.units.front().first + "; it must be from " +
              short_number(quantity.smallest / quantity.units.front().second) +
              " to " +
              short_number(quantity.largest / quantity.units.front().second));
          // In a file 0.10357 inch are 2.630678 mm, not 2.6306779999999996.
          if (*factor != 1.)
            value = std::strtod(short_number(value, 12).c_str(), nullptr);
        }
      return {values.front(), values.back()};
    }



    void
    add_quantity(dealii::ParameterHandler &prm,
                 DataSheet::Pair          &member,
                 const Quantity           &quantity)
    {
      add_parameter(
        prm,
        quantity.entry,
        "",
        [&member, quantity](const std::string &text) {
          member.reset();
          if (!text.empty())
            member = value_of_quantity(quantity, text);
        },
        quantity.documentation,
        Patterns::Anything());
    }



    void
    add_quantities_of_yarns(dealii::ParameterHandler &prm, DataSheet &sheet)
    {
      add_quantity(prm,
                   sheet.count,
                   {"Yarn count",
                    per_length,
                    0.1,
                    200.,
                    false,
                    "Warp bundles per length along the weft, weft bundles per "
                    "length along the warp [per cm]; also per inch, per 25 mm. "
                    "Needed, unless Yarn spacing is given."});
      add_quantity(prm,
                   sheet.spacing,
                   {"Yarn spacing",
                    lengths,
                    0.05,
                    100.,
                    false,
                    "Distance between neighboring warp bundles, between "
                    "neighboring weft bundles [mm]; also um, mil, inch. "
                    "Instead of Yarn count."});
      add_quantity(prm,
                   sheet.linear_density,
                   {"Linear density",
                    {{"tex", 1.}, {"dtex", 0.1}, {"denier", 1. / 9.}},
                    1.,
                    1e5,
                    false,
                    "Mass per length of a bundle, T in (A39) of doc/theory.md "
                    "[tex = g/km]; also dtex, denier."});
      add_quantity(prm,
                   sheet.fiber_density,
                   {"Fiber density",
                    {{"g/cm^3", 1.}, {"kg/m^3", 1e-3}},
                    0.5,
                    25.,
                    false,
                    "Density rho of the fibers, not of the bundle [g/cm^3]; "
                    "also kg/m^3. Glass 2.54, carbon 1.76, aramid 1.44."});
      add_quantity(prm,
                   sheet.fiber_modulus,
                   {"Fiber modulus",
                    {{"GPa", 1.}, {"MPa", 1e-3}},
                    0.1,
                    1500.,
                    false,
                    "Young's modulus of the fibers along them [GPa]; also MPa. "
                    "Glass 72, carbon 230, aramid 85. Without it the bundles "
                    "have the default material."});
    }



    void
    add_quantities_of_sections(dealii::ParameterHandler &prm, DataSheet &sheet)
    {
      add_quantity(prm,
                   sheet.bundle_width,
                   {"Bundle width",
                    lengths,
                    0.01,
                    100.,
                    false,
                    "Width w of a bundle [mm]; also um, mil, inch."});
      add_quantity(prm,
                   sheet.bundle_thickness,
                   {"Bundle thickness",
                    lengths,
                    0.001,
                    20.,
                    false,
                    "Thickness t of a bundle in its middle [mm]; also um, "
                    "mil, inch."});
      add_quantity(prm,
                   sheet.fiber_fraction,
                   {"Fiber fraction",
                    fractions,
                    0.01,
                    SheetTolerance::packing,
                    false,
                    "Part of the section of a bundle that is fibers, v in "
                    "(A39) [-]; also %. Usual is .5 to .75; .907 is the "
                    "hexagonal packing."});
    }



    void
    add_quantities_of_fabric(dealii::ParameterHandler &prm, DataSheet &sheet)
    {
      add_quantity(prm,
                   sheet.fabric_thickness,
                   {"Fabric thickness",
                    lengths,
                    0.005,
                    50.,
                    true,
                    "Thickness of the fabric [mm]; also um, mil, inch. Half of "
                    "it is the thickness of the bundles if that does not "
                    "follow otherwise; else it is a check."});
      add_quantity(prm,
                   sheet.areal_density,
                   {"Areal density",
                    {{"g/m^2", 1.}, {"oz/yd^2", 33.9057}},
                    1.,
                    1e4,
                    true,
                    "Mass per area of the fabric [g/m^2]; also oz/yd^2. A "
                    "check, or else the Linear density follows from it."});
      add_quantity(prm,
                   sheet.crimp,
                   {"Crimp",
                    percents,
                    0.,
                    1.,
                    false,
                    "By how much a bundle is longer than the fabric [%]. A "
                    "check, or else the thickness follows from it, (A40)."});
    }
  } // namespace



  void
  DataSheet::add_parameters(dealii::ParameterHandler &prm)
  {
    const ParameterSubsection subsection(prm, "Data sheet");
    add_parameter(prm, "Name", name, "Name of the fabric, for the comments.");
    add_parameter(prm,
                  "Weave",
                  weave,
                  joined(Registry<NamedWeave>::instance().names(), ", ") +
                    ", or a table, see the entry of the same name in "
                    "subsection Cell of a parameter file.");
    add_quantities_of_yarns(prm, *this);
    add_quantities_of_sections(prm, *this);
    const auto &shapes = Registry<SectionShape>::instance();
    add_parameter(prm,
                  "Section",
                  section,
                  "Cross section of the bundles. Its area decides about the "
                  "fiber fraction: of width times thickness the lens has 73 %, "
                  "the ellipse 79 %, the rounded rectangle nearly all.",
                  Patterns::Selection(shapes.selection()));
    add_own_numbers(prm, section_numbers, shapes);
    add_parameter(prm,
                  "Blunt tip",
                  blunt_tip,
                  "Half height of the edge of a bundle as a fraction e/t of "
                  "its thickness [-].",
                  Patterns::Double(0.001, 0.499));
    add_quantities_of_fabric(prm, *this);
    add_parameter(prm,
                  "Shear modulus along",
                  shear_modulus_along,
                  "Of a bundle, along its fibers, G_L [MPa]. No data sheet has "
                  "it; the default is assumed.",
                  Patterns::Double(1e-3, 1e5));
    add_parameter(prm,
                  "Shear modulus across",
                  shear_modulus_across,
                  "Of a bundle, across its fibers, G_T [MPa]; it decides about "
                  "how easily a bundle is flattened, too. Assumed as well.",
                  Patterns::Double(1e-3, 1e5));
    add_parameter(prm,
                  "Friction coefficient",
                  friction,
                  "Between the bundles [-]. The default is assumed.",
                  Patterns::Double(0.));
    add_parameter(prm,
                  "Tension",
                  tension,
                  "n1 = n2 under which the fabric is sheared and bent [N/mm].",
                  Patterns::Double(1e-9, 1e6));
  }



  DataSheet
  DataSheet::read(const ParameterText            &text,
                  const std::vector<std::string> &overrides)
  {
    DataSheet                sheet;
    dealii::ParameterHandler prm;
    sheet.add_parameters(prm);
    parse_parameter_text(prm, text, overrides);
    return sheet;
  }



  std::string
  DataSheet::documented_form()
  {
    DataSheet                sheet;
    dealii::ParameterHandler prm;
    sheet.add_parameters(prm);
    return documented_parameters(prm);
  }
} // namespace NPT
