// SPDX-License-Identifier: LGPL-2.1-or-later
// What follows from a data sheet, and whether its numbers agree.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/message_words.h>
#include <npt_dealii/base/short_number.h>
#include <npt_dealii/fabric/weave_pattern.h>
#include <npt_dealii/fabric_files/data_sheet.h>
#include <npt_dealii/fabric_files/sheet_formulas.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace NPT
{
  namespace
  {
    const std::string of_sheet = " (subsection Data sheet).";

    // Fractions outside are possible but rare.
    const double lowest_usual_fraction = 0.4, highest_usual_fraction = 0.8;
    // Of T in tex, rho in g/cm^3 and areas in mm^2.
    const double tex_per_area = 1000.;

    // A number as a file shows it; the cell has exactly this number.
    double
    five_digits(const double value)
    {
      return std::strtod(short_number(value, 5).c_str(), nullptr);
    }



    std::string
    percent(const double fraction, const unsigned int digits = 3)
    {
      return short_number(100. * fraction, digits) + " %";
    }



    // Of a plain weave 1: changes of side per crossing along the bundles.
    double
    changes_per_crossing(const WeavePattern &weave, const bool warp)
    {
      unsigned int changes = 0;
      for (unsigned int i = 0; i < weave.n_warp(); ++i)
        for (unsigned int j = 0; j < weave.n_weft(); ++j)
          changes +=
            weave.warp_is_over(i, j) != (warp ? weave.warp_is_over(i, j + 1) :
                                                weave.warp_is_over(i + 1, j));
      return double(changes) / (weave.n_warp() * weave.n_weft());
    }



    // What is known of the bundles of one family.
    struct SheetFamily
    {
      std::string           name;
      double                spacing = 0, changes = 0;
      std::optional<double> tex, density, fraction, width, thickness, crimp;
      double                height = 0; // of the wave

      unsigned int
      n_unknown() const
      {
        return !tex + !density + !fraction + !width + !thickness;
      }
    };



    class FabricDesigner
    {
    public:
      explicit FabricDesigner(const DataSheet &sheet)
        : sheet_(sheet)
        , weave_(sheet.weave)
      {}

      FabricDesign
      design()
      {
        set_families();
        complete_sections();
        take_thickness_from_fabric();
        take_thickness_from_crimp();
        for (const SheetFamily &family : families_)
          if (!family.thickness)
            refuse("The thickness of the " + family.name +
                   " bundles is missing; give Bundle thickness, or Fabric "
                   "thickness, or Crimp, or Linear density, Fiber density, "
                   "Fiber fraction and Bundle width");
        set_waves();
        take_tex_from_areal_density();
        set_cell();
        check_fractions();
        check_areal_density();
        check_fabric_thickness();
        set_cover_factor();
        set_material();
        return result_;
      }

    private:
      [[noreturn]] static void
      refuse(const std::string &what)
      {
        throw InputError(what + of_sheet);
      }

      void
      note(const std::string &sentence)
      {
        result_.notes.push_back(sentence + ".");
      }

      WarpWeft
      both(double SheetFamily::*member) const
      {
        return {families_[0].*member, families_[1].*member};
      }

      std::string
      both(std::optional<double> SheetFamily::*member,
           const unsigned int                  digits = 4) const
      {
        const double warp = *(families_[0].*member);
        const double weft = *(families_[1].*member);
        return short_number(warp, digits) +
               (warp == weft ? "" : " and " + short_number(weft, digits));
      }

      void
      set_families()
      {
        for (const bool warp : {true, false})
          {
            SheetFamily &family = families_[warp ? 0 : 1];
            family.name         = warp ? "warp" : "weft";
            family.changes      = changes_per_crossing(weave_, warp);
            const auto of       = [&](const DataSheet::Pair &pair) {
              return pair ?
                             std::optional<double>(warp ? pair->warp : pair->weft) :
                             std::nullopt;
            };
            family.tex       = of(sheet_.linear_density);
            family.density   = of(sheet_.fiber_density);
            family.fraction  = of(sheet_.fiber_fraction);
            family.width     = of(sheet_.bundle_width);
            family.thickness = of(sheet_.bundle_thickness);
            family.crimp     = of(sheet_.crimp);
            set_spacing(family, of(sheet_.count), of(sheet_.spacing));
          }
      }

      void
      set_spacing(SheetFamily                 &family,
                  const std::optional<double> &count,
                  const std::optional<double> &spacing)
      {
        if (!count && !spacing)
          refuse("How near the " + family.name +
                 " bundles lie is missing; give Yarn count or Yarn spacing");
        family.spacing = five_digits(spacing ? *spacing : 10. / *count);
        if (count && spacing &&
            std::abs(*count * *spacing / 10. - 1.) > SheetTolerance::count)
          refuse("Yarn spacing of the " + family.name + " is " +
                 short_number(*spacing, 4) + " mm, but a Yarn count of " +
                 short_number(*count, 4) + " per cm is a spacing of " +
                 short_number(10. / *count, 4) + " mm (tolerance " +
                 percent(SheetTolerance::count) + ")");
      }

      BundleSection
      section(const double width, const double thickness) const
      {
        return {sheet_.section,
                width,
                thickness,
                sheet_.blunt_tip * thickness,
                sheet_.section_numbers};
      }

      double
      area(const double width, const double thickness) const
      {
        return section(width, thickness).area();
      }

      // (A39) for the one that is not known.
      void
      complete_section(SheetFamily &f)
      {
        if (f.n_unknown() != 1)
          return;
        const auto of_fibers = [&]() {
          return *f.tex / (tex_per_area * *f.density);
        };
        std::string what;
        if (!f.fraction)
          f.fraction = of_fibers() / area(*f.width, *f.thickness);
        else if (!f.tex)
          {
            f.tex = five_digits(tex_per_area * *f.density * *f.fraction *
                                area(*f.width, *f.thickness));
            what  = "linear density, " + short_number(*f.tex, 4) + " tex";
          }
        else if (!f.density)
          {
            f.density = five_digits(*f.tex / (tex_per_area * *f.fraction *
                                              area(*f.width, *f.thickness)));
            what = "fiber density, " + short_number(*f.density, 4) + " g/cm^3";
            // The range of the entry: beyond it a unit was mistaken.
            if (!(*f.density >= 0.5 && *f.density <= 25.))
              refuse("Linear density, Fiber fraction, width and thickness of "
                     "the " +
                     f.name + " bundles give fibers of " +
                     short_number(*f.density, 4) +
                     " g/cm^3; fibers have 0.5 to 25");
          }
        else
          {
            const bool   wide    = !f.width;
            const double wanted  = of_fibers() / *f.fraction;
            const double largest = wide ? 1e3 : *f.width;
            const auto   area_of = [&](const double x) {
              return wide ? area(x, *f.thickness) : area(*f.width, x);
            };
            if (!(area_of(largest) >= wanted))
              refuse(
                "The fibers of a " + f.name + " bundle fill " +
                short_number(wanted, 4) + " mm^2 at this Fiber fraction; " +
                (wide ? "no bundle of this thickness" :
                        "a bundle that is as thick as it is wide") +
                " has only " + short_number(area_of(largest), 4) + " mm^2");
            const double size =
              root_of_increasing(area_of, wanted, 0., largest);
            (wide ? f.width : f.thickness) = five_digits(size);
            what = std::string(wide ? "width" : "thickness") +
                   " of a bundle, " + short_number(size, 4) + " mm";
          }
        if (!what.empty())
          note("The " + f.name + " " + what +
               ", follows from the rest of (A39)");
      }

      void
      complete_sections()
      {
        for (SheetFamily &family : families_)
          complete_section(family);
      }

      void
      take_thickness_from_fabric()
      {
        SheetFamily &warp = families_[0], &weft = families_[1];
        if (!sheet_.fabric_thickness || (warp.thickness && weft.thickness))
          return;
        const double T = sheet_.fabric_thickness->warp;
        if (!warp.thickness && !weft.thickness)
          {
            warp.thickness = weft.thickness = five_digits(0.5 * T);
            note("The bundles are half as thick as the fabric, " +
                 short_number(*warp.thickness, 4) + " mm");
          }
        else
          {
            SheetFamily &missing = warp.thickness ? weft : warp;
            const double other =
              warp.thickness ? *warp.thickness : *weft.thickness;
            if (other >= T)
              refuse("Fabric thickness is " + short_number(T, 4) +
                     " mm, but the bundles of one family alone are " +
                     short_number(other, 4) + " mm thick");
            missing.thickness = five_digits(T - other);
            note("The " + missing.name +
                 " bundles are as thick as the others "
                 "leave of the fabric, " +
                 short_number(*missing.thickness, 4) + " mm");
          }
        complete_sections();
      }

      // Equally thick bundles that touch, if the waves are known.
      void
      take_thickness_from_crimp()
      {
        SheetFamily &warp = families_[0], &weft = families_[1];
        if (warp.thickness || weft.thickness || !warp.crimp)
          return;
        const double sum = wave_of_family(0) + wave_of_family(1);
        if (!(sum > 0.))
          return;
        warp.thickness = weft.thickness = five_digits(sum);
        note("The bundles are as thick as their crimp needs, " +
             short_number(sum, 4) + " mm");
        complete_sections();
      }

      // Of the given crimp.
      double
      wave_of_family(const unsigned int k) const
      {
        return wave_of_crimp(*families_[k].crimp,
                             families_[1 - k].spacing,
                             families_[k].changes);
      }

      // (A41): where bundles touch, their middle lines are half the sum of the
      // thicknesses apart.
      void
      set_waves()
      {
        const double apart =
          0.5 * (*families_[0].thickness + *families_[1].thickness);
        if (families_[0].crimp)
          {
            const double warp = wave_of_family(0), weft = wave_of_family(1);
            if (std::abs(warp + weft - apart) >
                SheetTolerance::wave_height * apart)
              refuse("Crimp is " + percent(*families_[0].crimp) + " and " +
                     percent(*families_[1].crimp) +
                     ", which needs waves of warp and weft of " +
                     short_number(warp, 3) + " and " + short_number(weft, 3) +
                     " mm, together " + short_number(warp + weft, 3) +
                     " mm, but bundles that touch with a Bundle thickness of " +
                     both(&SheetFamily::thickness) + " mm have together " +
                     short_number(apart, 3) + " mm (tolerance " +
                     percent(SheetTolerance::wave_height) + ")");
            // As the sheet divides it, but such that bundles touch.
            families_[0].height = apart * warp / (warp + weft);
            families_[1].height = apart * weft / (warp + weft);
          }
        else
          families_[0].height = families_[1].height = 0.5 * apart;
        result_.wave_height = both(&SheetFamily::height);
        std::array<double, 2> crimp;
        for (const unsigned int k : {0u, 1u})
          crimp[k] = crimp_of_wave(families_[k].height,
                                   families_[1 - k].spacing,
                                   families_[k].changes);
        result_.crimp = {crimp[0], crimp[1]};
        std::string of_sheet_text;
        if (families_[0].crimp)
          of_sheet_text = "; the sheet says " + percent(*families_[0].crimp) +
                          " and " + percent(*families_[1].crimp);
        note("Crimp by the geometry (A40): warp " + percent(crimp[0]) +
             ", weft " + percent(crimp[1]) + of_sheet_text);
      }

      double
      mass_per_tex() const
      {
        // Bundles per meter times kg per km.
        return (1. + result_.crimp.warp) / families_[0].spacing +
               (1. + result_.crimp.weft) / families_[1].spacing;
      }

      void
      take_tex_from_areal_density()
      {
        if (families_[0].tex || families_[1].tex || !sheet_.areal_density)
          return;
        const double tex =
          five_digits(sheet_.areal_density->warp / mass_per_tex());
        families_[0].tex = families_[1].tex = tex;
        note("The linear density follows from the areal density, the same for "
             "warp and weft: " +
             short_number(tex, 4) + " tex");
        complete_sections();
      }

      void
      set_cell()
      {
        for (const SheetFamily &f : families_)
          {
            if (!f.width)
              refuse("The width of the " + f.name +
                     " bundles is missing; give Bundle width, or Linear "
                     "density, Fiber density and Fiber fraction");
            if (*f.width >= f.spacing)
              refuse("The " + f.name + " bundles are " +
                     short_number(*f.width, 4) + " mm wide" +
                     (sheet_.bundle_width ?
                        "" :
                        " (by Linear density, Fiber density, Fiber fraction "
                        "and thickness)") +
                     ", but only " + short_number(f.spacing, 4) +
                     " mm apart, so that they would overlap");
          }
        CellParameters &cell  = result_.cell;
        cell.weave            = sheet_.weave;
        cell.section          = sheet_.section;
        cell.section_numbers  = sheet_.section_numbers;
        cell.blunt_tip        = sheet_.blunt_tip;
        cell.crossing_spacing = both(&SheetFamily::spacing);
        cell.bundle_width     = {*families_[0].width, *families_[1].width};
        cell.bundle_thickness = {*families_[0].thickness,
                                 *families_[1].thickness};
        cell.check();
      }

      // What the section of the cell makes of the fibers counts.
      void
      check_fractions()
      {
        std::array<double, 2> fraction = {{0., 0.}}, tex = fraction,
                              density = fraction;
        for (const unsigned int k : {0u, 1u})
          {
            const SheetFamily &f = families_[k];
            if (f.tex && f.density)
              fraction[k] = fraction_of_section(f);
            else if (f.fraction)
              fraction[k] = *f.fraction;
            else if (sheet_.fiber_modulus)
              refuse("The fiber fraction of the " + f.name +
                     " bundles is missing; give Fiber fraction, or Linear "
                     "density (or Areal density) and Fiber density");
            tex[k]     = f.tex.value_or(0.);
            density[k] = f.density.value_or(0.);
          }
        result_.fiber_fraction = {fraction[0], fraction[1]};
        result_.linear_density = {tex[0], tex[1]};
        result_.fiber_density  = {density[0], density[1]};
        if (!(fraction[0] > 0.))
          return;
        note("Fiber fraction in the bundles: warp " +
             short_number(fraction[0], 3) + ", weft " +
             short_number(fraction[1], 3));
        for (const double v : fraction)
          if (v < lowest_usual_fraction || v > highest_usual_fraction)
            {
              note("A fiber fraction of " + short_number(v, 3) +
                   " is unusual, .5 to .75 is usual: look at width, thickness "
                   "and shape of the sections");
              return;
            }
      }

      double
      fraction_of_section(const SheetFamily &f) const
      {
        const double of_fibers = *f.tex / (tex_per_area * *f.density);
        const double whole     = area(*f.width, *f.thickness);
        const double v         = of_fibers / whole;
        if (v > SheetTolerance::packing)
          refuse("Fibers of " + short_number(*f.tex, 4) + " tex and " +
                 short_number(*f.density, 4) + " g/cm^3 fill " +
                 short_number(of_fibers, 4) + " mm^2, but the section of a " +
                 f.name + " bundle (" + sheet_.section + ", " +
                 short_number(*f.width, 4) + " by " +
                 short_number(*f.thickness, 4) + " mm) has " +
                 short_number(whole, 4) + " mm^2, a fiber fraction of " +
                 short_number(v, 3) +
                 "; no packing of fibers has more than .907");
        if (f.fraction &&
            std::abs(v / *f.fraction - 1.) > SheetTolerance::fiber_fraction)
          refuse(
            "Fiber fraction of the " + f.name + " is " +
            short_number(*f.fraction, 3) + ", but " + short_number(*f.tex, 4) +
            " tex of " + short_number(*f.density, 4) +
            " g/cm^3 in a section of " + short_number(whole, 4) + " mm^2 (" +
            sheet_.section + ", " + short_number(*f.width, 4) + " by " +
            short_number(*f.thickness, 4) + " mm) are " + short_number(v, 3) +
            " (tolerance " + percent(SheetTolerance::fiber_fraction) + ")");
        return v;
      }

      void
      check_areal_density()
      {
        if (!families_[0].tex || !families_[1].tex)
          return;
        const double m =
          *families_[0].tex * (1. + result_.crimp.warp) / families_[0].spacing +
          *families_[1].tex * (1. + result_.crimp.weft) / families_[1].spacing;
        result_.areal_density = m;
        const bool known      = sheet_.areal_density.has_value();
        if (known && std::abs(m / sheet_.areal_density->warp - 1.) >
                       SheetTolerance::areal_density)
          refuse("Areal density is " +
                 short_number(sheet_.areal_density->warp, 4) +
                 " g/m^2, but bundles of " + both(&SheetFamily::tex) +
                 " tex every " + short_number(families_[0].spacing, 4) +
                 " and " + short_number(families_[1].spacing, 4) +
                 " mm with a crimp of " + percent(result_.crimp.warp) +
                 " and " + percent(result_.crimp.weft) + " have " +
                 short_number(m, 4) + " g/m^2 (tolerance " +
                 percent(SheetTolerance::areal_density) + ")");
        note("Areal density: " + short_number(m, 4) + " g/m^2" +
             (known ? "; the sheet says " +
                        short_number(sheet_.areal_density->warp, 4) :
                      ""));
      }

      void
      check_fabric_thickness()
      {
        const double warp        = *families_[0].thickness;
        const double weft        = *families_[1].thickness;
        const double T           = std::max(2. * families_[0].height + warp,
                                  2. * families_[1].height + weft);
        result_.fabric_thickness = T;
        const bool known         = sheet_.fabric_thickness.has_value();
        if (known)
          {
            const double given = sheet_.fabric_thickness->warp;
            // Flat on both sides at least; one family straight at most.
            const double least = warp + weft;
            const double most  = least + std::max(warp, weft);
            if (given < (1. - SheetTolerance::fabric_thickness) * least ||
                given > (1. + SheetTolerance::fabric_thickness) * most)
              refuse("Fabric thickness is " + short_number(given, 4) +
                     " mm, but bundles with a thickness of " +
                     both(&SheetFamily::thickness) + " mm make a fabric of " +
                     short_number(least, 4) + " to " + short_number(most, 4) +
                     " mm (tolerance " +
                     percent(SheetTolerance::fabric_thickness) + ")");
          }
        note("Thickness of the fabric: " + short_number(T, 4) + " mm" +
             (known ? "; the sheet says " +
                        short_number(sheet_.fabric_thickness->warp, 4) :
                      ""));
      }

      void
      set_cover_factor()
      {
        const double d1      = *families_[0].width / families_[0].spacing;
        const double d2      = *families_[1].width / families_[1].spacing;
        result_.cover_factor = d1 + d2 - d1 * d2;
        note("Cover factor: " + short_number(result_.cover_factor, 3));
        result_.locking_angle = std::acos(std::max(d1, d2));
        note(
          "Parallel bundles touch at a shear angle of " +
          short_number(result_.locking_angle * 180. / dealii::numbers::PI, 3) +
          " degrees");
      }

      void
      set_material()
      {
        if (!sheet_.fiber_modulus)
          {
            const DataSheet defaults;
            if (sheet_.shear_modulus_along != defaults.shear_modulus_along ||
                sheet_.shear_modulus_across != defaults.shear_modulus_across)
              refuse("Shear moduli of the bundles are given without a Fiber "
                     "modulus; the three make the material together");
            note("Without a Fiber modulus the bundles have the default "
                 "material, that of the paper");
            return;
          }
        const double MPa_per_GPa = 1000.;
        const auto   of          = [&](const double v, const double E_f) {
          const double E_L = v * E_f * MPa_per_GPa;
          const double G_L = sheet_.shear_modulus_along;
          return with_few_digits(
            bundle_constants(E_L, G_L, sheet_.shear_modulus_across), E_L, G_L);
        };
        const WarpWeft &v = result_.fiber_fraction, &E = *sheet_.fiber_modulus;
        result_.material                = {of(v.warp, E.warp)};
        const FiberBundleConstants weft = of(v.weft, E.weft);
        if (weft.c != result_.material[0].c)
          result_.material.push_back(weft);
        note("Modulus along the bundles, fiber fraction times that of the "
             "fibers: warp " +
             short_number(v.warp * E.warp, 3) + ", weft " +
             short_number(v.weft * E.weft, 3) + " GPa; shear moduli " +
             short_number(sheet_.shear_modulus_along, 3) + " MPa along and " +
             short_number(sheet_.shear_modulus_across, 3) +
             " MPa across the fibers are assumed unless the sheet says more");
      }

      const DataSheet           &sheet_;
      const WeavePattern         weave_;
      std::array<SheetFamily, 2> families_; // warp, weft
      FabricDesign               result_;
    };
  } // namespace



  FabricDesign
  design_fabric(const DataSheet &sheet)
  {
    try
      {
        return FabricDesigner(sheet).design();
      }
    catch (const InputError &error)
      {
        // The cell speaks of its own subsection.
        const std::string cell = "subsection Cell";
        std::string       what = error.what();
        if (const auto at = what.find(cell); at != std::string::npos)
          what.replace(at, cell.size(), "subsection Data sheet");
        throw InputError(what);
      }
  }
} // namespace NPT
