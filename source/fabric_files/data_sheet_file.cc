// SPDX-License-Identifier: LGPL-2.1-or-later
// The parameter file of a fabric with a data sheet.

#include <npt_dealii/fabric/section_shape.h>
#include <npt_dealii/fabric/weave_pattern.h>
#include <npt_dealii/fabric_files/data_sheet.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <ostream>
#include <sstream>

namespace NPT
{
  namespace
  {
    // Curvature times length of a bundle in the cell. Bundles of this law bend
    // as solids do, so that more would lift them off one another.
    const double largest_rotation = 0.01;
    // Of the tension in which is tested.
    const double largest_tension_ratio = 10.;

    std::string
    as_entry(const double value)
    {
      return EntryValue<double>::text(value);
    }



    std::string
    as_entry(const WarpWeft &value)
    {
      return EntryValue<WarpWeft>::text(value);
    }



    void
    write_comment(const std::string &text, std::ostream &out)
    {
      std::string printable = text;
      for (char &c : printable)
        if (static_cast<unsigned char>(c) < ' ')
          c = ' ';
      for (const std::string &line :
           dealii::Utilities::break_text_into_lines(printable, 76))
        out << "# " << line << "\n";
    }



    // Of the results, after the name of the data sheet.
    std::string
    directory_for(const std::string &source)
    {
      std::string name = std::filesystem::path(source).stem().string();
      for (char &c : name)
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-')
          c = '_';
      return "output-" + name;
    }



    void
    write_material(const std::string          &subsection,
                   const FiberBundleConstants &constants,
                   std::ostream               &out)
    {
      out << "subsection " << subsection << "\n";
      if (subsection == "Weft material")
        out << "  set Law        = fiber bundle\n";
      out << "  set mu_iso     = " << as_entry(constants.mu) << "\n"
          << "  set lambda_iso = " << as_entry(constants.lambda) << "\n"
          << "  set a_trn      = " << as_entry(constants.a) << "\n"
          << "  set b_trn      = " << as_entry(constants.b) << "\n"
          << "  set c_trn      = " << as_entry(constants.c) << "\n"
          << "  set d_trn      = " << as_entry(constants.d) << "\n"
          << "end\n\n";
    }



    void
    write_cell(const CellParameters &cell, std::ostream &out)
    {
      out << "subsection Cell\n"
          << "  set Weave            = " << cell.weave << "\n"
          << "  set Crossing spacing = " << as_entry(cell.crossing_spacing)
          << "\n"
          << "  set Bundle width     = " << as_entry(cell.bundle_width) << "\n"
          << "  set Bundle thickness = " << as_entry(cell.bundle_thickness)
          << "\n"
          << "  set Section          = " << cell.section << "\n";
      for (const OwnNumber &own :
           Registry<SectionShape>::instance().get(cell.section).numbers)
        out << "  set " << own.entry
            << std::string(16 - std::min<std::size_t>(16, own.entry.size()),
                           ' ')
            << " = " << as_entry(cell.warp_section().number(own.entry)) << "\n";
      out << "  set Blunt tip        = " << as_entry(cell.blunt_tip) << "\n"
          << "end\n\n";
    }



    void
    write_stage(const std::string &name,
                const std::string &entries,
                const double       initial_step,
                const double       maximum_step,
                std::ostream      &out)
    {
      out << "\n  subsection Stage " << name << "\n"
          << entries << "    set Initial step = " << as_entry(initial_step)
          << "\n"
          << "    set Maximum step = " << as_entry(maximum_step) << "\n"
          << "  end\n";
    }



    void
    write_load_programme(const DataSheet    &sheet,
                         const FabricDesign &design,
                         std::ostream       &out)
    {
      const WeavePattern weave(sheet.weave);
      const double       length =
        std::max(weave.n_weft() * design.cell.crossing_spacing.weft,
                 weave.n_warp() * design.cell.crossing_spacing.warp);
      std::ostringstream curvature;
      curvature.precision(2);
      curvature << largest_rotation / length;
      // On the path of inextensible bundles, to where they touch.
      std::ostringstream shear;
      shear.precision(2);
      shear << 2. * std::sin(0.5 * design.locking_angle);
      const auto both = [](const double n) {
        return "    set Targets      = n1: " + as_entry(n) +
               ", n2: " + as_entry(n) + "\n";
      };
      out << "subsection Load programme\n"
          << "  # Three tests of the same stretched fabric.\n"
          << "  set Stages = weave, release, relax, stretch, tension, bend, "
             "shear\n";
      write_stage("relax",
                  "    set Type             = relax\n"
                  "    set Relaxed fraction = 1\n",
                  1.,
                  1.,
                  out);
      write_stage("stretch", both(sheet.tension), 0.25, 0.25, out);
      const std::string start = "    set Start        = stretch\n";
      write_stage("tension",
                  start + "    set Targets      = n1: " +
                    as_entry(largest_tension_ratio * sheet.tension) + "\n",
                  0.025,
                  0.2,
                  out);
      write_stage("bend",
                  start + "    set Targets      = H4: " + curvature.str() +
                    "\n",
                  0.1,
                  0.2,
                  out);
      // Last, for it comes nearest to where a cell may fail.
      write_stage("shear",
                  start + "    set Targets      = H3: " + shear.str() + "\n",
                  0.02,
                  0.05,
                  out);
      out << "end\n";
    }
  } // namespace



  void
  write_parameter_file(const DataSheet   &sheet,
                       const std::string &source,
                       std::ostream      &out)
  {
    const FabricDesign design = design_fabric(sheet);
    write_comment((sheet.name.empty() ? "A fabric" : sheet.name) +
                    ", from the data sheet " + source + ":",
                  out);
    for (const std::string &note : design.notes)
      write_comment(note, out);
    out << "\n";
    write_cell(design.cell, out);
    out << "subsection Mesh\n"
        << "  set Elements along   = 5\n"
        << "  set Elements across  = 5\n"
        << "  set Elements through = 1\n"
        << "end\n\n";
    for (std::size_t k = 0; k < design.material.size(); ++k)
      write_material(k == 0 ? "Fiber bundle material" : "Weft material",
                     design.material[k],
                     out);
    out << "subsection Contact\n"
        << "  set Method              = KTS\n"
        << "  set Automatic penalties = true\n"
        << "  # Edges meet when the bundles lock.\n"
        << "  set Maximum overlap     = 1\n"
        << "end\n\n"
        << "subsection Friction\n"
        << "  set Friction coefficient = " << as_entry(sheet.friction) << "\n"
        << "end\n\n";
    write_load_programme(sheet, design, out);
    out << "\nsubsection Output\n"
        << "  set Directory = " << directory_for(source) << "\n"
        << "end\n";
  }
} // namespace NPT
