// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about data sheets: what follows from which numbers, what is refused by
// which sentence, and that a written file gives the same cell.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/parameter_file.h>
#include <npt_dealii/fabric_files/data_sheet.h>
#include <npt_dealii/fabric_files/sheet_formulas.h>
#include <npt_dealii/material/make_material.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <sstream>

using namespace NPT;

namespace
{
  // A plain weave of 2 bundles per cm, 4 x 0.5 mm, of glass.
  const std::vector<std::string> sheet_of_glass = {"Yarn count=2",
                                                   "Bundle width=4",
                                                   "Bundle thickness=0.5",
                                                   "Linear density=2000",
                                                   "Fiber density=2.5",
                                                   "Fiber modulus=72"};

  DataSheet
  read_sheet(const std::vector<std::string> &entries)
  {
    std::vector<std::string> overrides;
    for (const std::string &entry : entries)
      overrides.push_back("Data sheet/" + entry);
    return DataSheet::read(ParameterText(), overrides);
  }

  DataSheet
  glass_with(const std::vector<std::string> &more)
  {
    auto entries = sheet_of_glass;
    for (const std::string &entry : more)
      {
        const std::string name   = entry.substr(0, entry.find('='));
        bool              is_new = true;
        for (std::string &other : entries)
          if (other.substr(0, other.find('=')) == name)
            {
              other  = entry;
              is_new = false;
            }
        if (is_new)
          entries.push_back(entry);
      }
    // What is to be missing.
    std::vector<std::string> given;
    for (const std::string &entry : entries)
      if (entry.back() != '=')
        given.push_back(entry);
    return read_sheet(given);
  }

  std::string
  refusal_of_glass_with(const std::vector<std::string> &more)
  {
    try
      {
        design_fabric(glass_with(more));
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "";
  }
} // namespace



TEST_CASE("Values of a data sheet may carry the units of their trade",
          "[data_sheet]")
{
  const DataSheet sheet = read_sheet({"Yarn count=34, 25.4 per inch",
                                      "Linear density=600 denier",
                                      "Fiber density=1440 kg/m^3",
                                      "Bundle thickness=4 mil",
                                      "Fiber fraction=70 %",
                                      "Areal density=5 oz/yd^2",
                                      "Crimp=2, 3 %"});
  CHECK(sheet.count->warp == Approx(34 / 2.54));
  CHECK(sheet.count->weft == Approx(10.));
  CHECK(sheet.linear_density->weft == Approx(600. / 9.));
  CHECK(sheet.fiber_density->warp == Approx(1.44));
  CHECK(sheet.bundle_thickness->warp == Approx(0.1016));
  CHECK(sheet.fiber_fraction->warp == Approx(0.7));
  CHECK(sheet.areal_density->warp == Approx(169.53).epsilon(1e-4));
  CHECK(sheet.crimp->warp == Approx(0.02));
  CHECK(sheet.crimp->weft == Approx(0.03));
  CHECK_FALSE(sheet.bundle_width);
}



TEST_CASE("A value with a unit is the number that is written in the unit of "
          "the program",
          "[data_sheet]")
{
  CHECK(read_sheet({"Bundle width=0.10357 inch"}).bundle_width->warp ==
        2.630678);
  CHECK(read_sheet({"Bundle thickness=191 um"}).bundle_thickness->weft ==
        0.191);
}



TEST_CASE("A value that is no number with a known unit is refused with the "
          "units",
          "[data_sheet]")
{
  CHECK_THROWS_WITH(read_sheet({"Linear density=600 denir"}),
                    Catch::Contains("Linear density is '600 denir'") &&
                      Catch::Contains("tex, dtex, denier") &&
                      Catch::Contains("did you mean 'denier'"));
  CHECK_THROWS_WITH(read_sheet({"Yarn count=many"}),
                    Catch::Contains("two for warp and weft"));
  CHECK_THROWS_WITH(read_sheet({"Yarn count=1, 2, 3"}),
                    Catch::Contains("two for warp and weft"));
  CHECK_THROWS_WITH(read_sheet({"Yarn count=34 per inch, 34"}),
                    Catch::Contains("behind the last number"));
  CHECK_THROWS_WITH(read_sheet({"Yarn count=34 %, 34"}),
                    Catch::Contains("behind the last number"));
  CHECK(read_sheet({"Fiber fraction=60 %, 70 %"}).fiber_fraction->warp ==
        Approx(0.6));
  CHECK_THROWS_WITH(read_sheet({"Areal density=200, 300"}),
                    Catch::Contains("one number"));
  CHECK_THROWS_WITH(read_sheet({"Fiber modulus=72000"}),
                    Catch::Contains("from 0.1 to 1500"));
  CHECK_THROWS_WITH(read_sheet({"Fiber fraction=0.95"}),
                    Catch::Contains("0.9069"));
  CHECK_THROWS_WITH(read_sheet({"Yarn cuont=2"}),
                    Catch::Contains("Yarn count"));
}



TEST_CASE(
  "Cell, fiber fraction, areal density and cover factor follow by their "
  "formulas",
  "[data_sheet]")
{
  const FabricDesign design =
    design_fabric(glass_with({"Yarn count=2, 2.5", "Bundle width=4, 3"}));
  CHECK(design.cell.crossing_spacing.warp == 5.);
  CHECK(design.cell.crossing_spacing.weft == 4.);
  CHECK(design.cell.bundle_width.weft == 3.);
  // (A39): 2000 tex of 2.5 g/cm^3 fill 0.8 mm^2; the lens has 2/3 w t (1 +
  // e/t).
  CHECK(design.fiber_fraction.warp ==
        Approx(0.8 / (2. / 3. * 4. * 0.5 * 1.1)).epsilon(1e-12));
  CHECK(design.fiber_fraction.weft ==
        Approx(0.8 / (2. / 3. * 3. * 0.5 * 1.1)).epsilon(1e-12));
  CHECK(design.cover_factor == Approx(0.8 + 0.75 - 0.8 * 0.75));
  CHECK(std::cos(design.locking_angle) == Approx(0.8).epsilon(1e-12));
  CHECK(design.wave_height.warp == 0.25);
  CHECK(design.fabric_thickness == 1.);
  CHECK(design.areal_density == Approx(2000. / 5. * (1. + design.crimp.warp) +
                                       2000. / 4. * (1. + design.crimp.weft))
                                  .epsilon(1e-12));
}



TEST_CASE("The crimp of a wave is the length of its sine line", "[data_sheet]")
{
  const double h = 0.3, L = 2.;
  double       length = 0;
  // The trapezoidal rule is exact to round-off for a period.
  const unsigned int n = 200;
  for (unsigned int k = 0; k < n; ++k)
    length += std::hypot(1., M_PI * h / L * std::sin(2. * M_PI * k / n)) / n;
  CHECK(crimp_of_wave(h, L, 1.) == Approx(length - 1.).epsilon(1e-12));
  // A 5-harness satin changes its side twice in five crossings.
  CHECK(crimp_of_wave(h, L, 0.4) == Approx(0.4 * (length - 1.)).epsilon(1e-12));
  CHECK(wave_of_crimp(crimp_of_wave(h, L, 0.4), L, 0.4) ==
        Approx(h).epsilon(1e-9));
  CHECK(crimp_of_wave(0., L, 1.) == Approx(0.).margin(1e-15));
  const FabricDesign satin =
    design_fabric(glass_with({"Weave=5-harness satin"}));
  CHECK(satin.crimp.warp ==
        Approx(crimp_of_wave(0.25, 5., 0.4)).epsilon(1e-12));
}



TEST_CASE("The constants of a bundle have the moduli that were asked for",
          "[data_sheet]")
{
  // In the file, too: over the ranges of the entries.
  for (const double E_L : {1., 1e6})
    for (const double G_L : {1e-3, 1e5})
      for (const double G_T : {1e-3, 1e5})
        {
          const auto written =
            with_few_digits(bundle_constants(E_L, G_L, G_T), E_L, G_L)
              .engineering_constants();
          INFO(E_L << ' ' << G_L << ' ' << G_T);
          CHECK(written.E_L == Approx(E_L).epsilon(3e-4));
          CHECK(written.G_L == Approx(G_L).epsilon(3e-4));
          CHECK(written.G_T == Approx(G_T).epsilon(1e-12));
        }
  const auto moduli = bundle_constants(40e3, 10., 5.).engineering_constants();
  CHECK(moduli.E_L == Approx(40e3).epsilon(1e-10));
  CHECK(moduli.G_L == Approx(10.).epsilon(1e-12));
  CHECK(moduli.G_T == Approx(5.).epsilon(1e-12));
  CHECK(moduli.nu_LT == Approx(0.2).epsilon(1e-12));
  CHECK(bundle_constants(1e-3, 10., 5.).lowest_stiffness_eigenvalue().value >
        0.);
}



TEST_CASE("Each number that is missing follows from the others", "[data_sheet]")
{
  const double      crimp = design_fabric(glass_with({})).crimp.warp;
  const double      v     = design_fabric(glass_with({})).fiber_fraction.warp;
  const std::string fraction  = "Fiber fraction=" + EntryValue<double>::text(v);
  const auto        same_cell = [](const FabricDesign &design) {
    CHECK(design.cell.bundle_width.warp == Approx(4.).epsilon(1e-4));
    CHECK(design.cell.bundle_thickness.weft == Approx(0.5).epsilon(1e-4));
    CHECK(design.cell.crossing_spacing.warp == 5.);
    CHECK(design.linear_density.warp == Approx(2000.).epsilon(1e-4));
    CHECK(design.fiber_density.weft == Approx(2.5).epsilon(1e-4));
  };
  same_cell(design_fabric(glass_with({"Yarn count=", "Yarn spacing=5"})));
  same_cell(design_fabric(glass_with({"Bundle width=", fraction})));
  same_cell(design_fabric(glass_with({"Bundle thickness=", fraction})));
  same_cell(design_fabric(glass_with({"Linear density=", fraction})));
  same_cell(design_fabric(glass_with({"Fiber density=", fraction})));
  same_cell(
    design_fabric(glass_with({"Bundle thickness=", "Fabric thickness=1"})));
  same_cell(design_fabric(glass_with(
    {"Bundle thickness=", "Fabric thickness=1", "Bundle width=", fraction})));
  same_cell(design_fabric(glass_with(
    {"Bundle thickness=", "Crimp=" + EntryValue<double>::text(100. * crimp)})));
  same_cell(design_fabric(glass_with(
    {"Linear density=",
     "Areal density=" + EntryValue<double>::text(800. * (1. + crimp))})));
}



TEST_CASE("A number that is missing and does not follow is asked for",
          "[data_sheet]")
{
  using Catch::Contains;
  CHECK_THAT(refusal_of_glass_with({"Yarn count="}),
             Contains("give Yarn count or Yarn spacing"));
  CHECK_THAT(refusal_of_glass_with({"Bundle thickness="}),
             Contains("The thickness of the warp bundles is missing") &&
               Contains("Fabric thickness"));
  CHECK_THAT(refusal_of_glass_with({"Bundle width="}),
             Contains("The width of the warp bundles is missing") &&
               Contains("Fiber fraction"));
  CHECK_THAT(refusal_of_glass_with({"Fiber density="}),
             Contains("The fiber fraction of the warp bundles is missing"));
}



TEST_CASE("Numbers that disagree are named with both values and the tolerance",
          "[data_sheet]")
{
  using Catch::Contains;
  CHECK_THAT(refusal_of_glass_with({"Yarn spacing=4"}),
             Contains("Yarn spacing of the warp is 4 mm, but a Yarn count of 2 "
                      "per cm is a spacing of 5 mm (tolerance 2 %)"));
  CHECK_THAT(refusal_of_glass_with({"Areal density=900"}),
             Contains("Areal density is 900 g/m^2, but bundles of 2000 tex") &&
               Contains("have 80") && Contains("(tolerance 5 %)"));
  CHECK_THAT(refusal_of_glass_with({"Fiber fraction=0.4"}),
             Contains("Fiber fraction of the warp is 0.4, but") &&
               Contains("are 0.545") && Contains("(tolerance 10 %)"));
  CHECK_THAT(refusal_of_glass_with({"Linear density=4000"}),
             Contains("a fiber fraction of 1.09; no packing of fibers has more "
                      "than .907"));
  CHECK_THAT(refusal_of_glass_with({"Crimp=5, 5"}),
             Contains("Crimp is 5 % and 5 %") && Contains("together 0.5 mm") &&
               Contains("(tolerance 30 %)"));
  CHECK_THAT(refusal_of_glass_with({"Fabric thickness=0.6"}),
             Contains("Fabric thickness is 0.6 mm, but bundles with a "
                      "thickness of 0.5 mm make a fabric of 1 to 1.5 mm "
                      "(tolerance 15 %)"));
  CHECK_THAT(refusal_of_glass_with({"Bundle width=5.5"}),
             Contains("The warp bundles are 5.5 mm wide, but only 5 mm apart"));
  CHECK_THAT(refusal_of_glass_with({"Section=ellipse",
                                    "Blunt tip=0.01",
                                    "Bundle width=1.2",
                                    "Linear density=800"}),
             Contains("meet the edge at") &&
               Contains("(subsection Data sheet)"));
  CHECK_THAT(refusal_of_glass_with({"Fiber density=", "Fiber fraction=0.01"}),
             Contains("fibers have 0.5 to 25"));
  CHECK_THAT(refusal_of_glass_with({"Fiber modulus=", "Shear modulus along=1"}),
             Contains("without a Fiber modulus"));
  CHECK_THAT(refusal_of_glass_with({"Weave=plane"}),
             Contains("did you mean 'plain'") &&
               Contains("(subsection Data sheet)"));
}



TEST_CASE("Numbers that agree within their tolerances are taken and noted",
          "[data_sheet]")
{
  const FabricDesign design = design_fabric(glass_with(
    {"Areal density=820", "Fabric thickness=1.1", "Crimp=0.7, 0.5"}));
  std::string        notes;
  for (const std::string &note : design.notes)
    notes += note + "\n";
  CHECK_THAT(notes, Catch::Contains("the sheet says 820"));
  CHECK_THAT(notes, Catch::Contains("the sheet says 1.1"));
  CHECK_THAT(notes, Catch::Contains("the sheet says 0.7 % and 0.5 %"));
  // The wave is divided as the sheet says, and the bundles touch.
  CHECK(design.wave_height.warp > design.wave_height.weft);
  CHECK(design.wave_height.warp + design.wave_height.weft ==
        Approx(0.5).epsilon(1e-12));
}



TEST_CASE("A written parameter file is read as the same cell and material",
          "[data_sheet]")
{
  const std::vector<std::vector<std::string>> sheets = {
    {"Shear modulus along=12", "Shear modulus across=7"},
    {"Weave=2/2 twill",
     "Section=power ellipse",
     "Section power=1.3",
     "Blunt tip=0.2"},
    {"Yarn count=2.1, 1.9",
     "Bundle width=3.9, 4.1",
     "Bundle thickness=0.45, 0.55",
     "Linear density=1800, 2200",
     "Fiber modulus=72, 85"}};
  for (const auto &entries : sheets)
    {
      const DataSheet    sheet  = glass_with(entries);
      const FabricDesign design = design_fabric(sheet);
      std::ostringstream out;
      write_parameter_file(sheet, "glass.sheet", out);
      const ParameterText text = make_parameter_text(out.str(), "glass.prm");

      const auto value = [&](const std::string &entry) {
        return get_entry(text, {}, entry).value_or("");
      };
      const CellParameters &cell = design.cell;
      CHECK(value("Cell/Weave") == cell.weave);
      CHECK(value("Cell/Section") == cell.section);
      CHECK(EntryValue<double>::value(value("Cell/Blunt tip")) ==
            cell.blunt_tip);
      const auto pair = [&](const std::string &entry, const WarpWeft &wanted) {
        const auto found = EntryValue<WarpWeft>::value(value(entry));
        CHECK(found.warp == wanted.warp);
        CHECK(found.weft == wanted.weft);
      };
      pair("Cell/Crossing spacing", cell.crossing_spacing);
      pair("Cell/Bundle width", cell.bundle_width);
      pair("Cell/Bundle thickness", cell.bundle_thickness);
      CHECK(design.material.size() == (entries.size() == 5 ? 2 : 1));
      for (std::size_t k = 0; k < design.material.size(); ++k)
        {
          const FiberBundleConstants &wanted = design.material[k];
          for (const auto &[name, constant] :
               {std::pair("mu_iso", wanted.mu),
                std::pair("lambda_iso", wanted.lambda),
                std::pair("a_trn", wanted.a),
                std::pair("c_trn", wanted.c)})
            CHECK(EntryValue<double>::value(value(
                    (k == 0 ? "Fiber bundle material/" : "Weft material/") +
                    std::string(name))) == constant);
        }
    }
}



TEST_CASE("The printed form is an empty data sheet", "[data_sheet]")
{
  const std::string form = DataSheet::documented_form();
  const DataSheet   sheet =
    DataSheet::read(make_parameter_text(form, "form.sheet"));
  CHECK_FALSE(sheet.count);
  CHECK_FALSE(sheet.linear_density);
  CHECK(sheet.weave == "plain");
  CHECK_THAT(form, Catch::Contains("set Yarn count"));
}



TEST_CASE("Nothing in the name of a sheet gets behind the comments",
          "[data_sheet]")
{
  DataSheet sheet = glass_with({});
  sheet.name      = "a\nset Problem = none\r";
  std::ostringstream out;
  write_parameter_file(sheet, "x\nset Problem = none", out);
  CHECK_FALSE(
    get_entry(make_parameter_text(out.str(), "x.prm"), {}, "Problem"));
}
