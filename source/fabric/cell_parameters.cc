// SPDX-License-Identifier: LGPL-2.1-or-later
// Cell and mesh entries of the parameter file.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/fabric/cell_parameters.h>

#include <deal.II/base/utilities.h>

#include <cmath>
#include <limits>
#include <sstream>

namespace NPT
{
  namespace Patterns = dealii::Patterns;

  namespace
  {
    const double tiny = std::numeric_limits<double>::min();

    // One number for warp and weft, or one for each.
    WarpWeft
    get_pair(const dealii::ParameterHandler &prm, const std::string &entry)
    {
      const auto values = dealii::Utilities::string_to_double(
        dealii::Utilities::split_string_list(prm.get(entry), ','));
      return WarpWeft(values.front(), values.back());
    }

    std::string
    prm_number(const double value)
    {
      std::ostringstream text;
      text << value;
      return text.str();
    }
  } // namespace



  void
  CellParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Cell");
    {
      prm.declare_entry(
        "Type",
        "automatic",
        Patterns::Selection("automatic|sub-unit cell|two-crossing cell|"
                            "primitive cell|unit cell|laminate"),
        "Which periodic piece is computed. The sub-unit cell is the piece of a "
        "weave between its glide planes, Eqs. (47)-(48), one crossing of a "
        "plain weave; it represents H1, H2 and H3 only. The primitive cell is "
        "the smallest piece coupled by translations and represents all six "
        "modes; for the plain weave it is the two-crossing cell. The unit cell "
        "is the whole repeat of the table. automatic takes the smallest one "
        "that is valid for the load programme. laminate is a stack of plies "
        "without contact, to check against classical plate theory.");
      prm.declare_entry(
        "Weave",
        "plain",
        Patterns::Anything(),
        "plain, 2/2 twill, 5-harness satin, or a table with one row per weft "
        "bundle, rows separated by '/', o where the warp is over and u where "
        "it is under: ou/uo is the plain weave.");
      prm.declare_entry("Images",
                        "true",
                        Patterns::Bool(),
                        "Let bundles touch the continuation of bundles in "
                        "neighboring cells, Eq. (49); needed when large shear "
                        "carries the contact zone over the edge of the cell.");
      prm.declare_entry(
        "Side contact",
        "automatic",
        Patterns::Selection("automatic|on|off"),
        "Contact between the edges of parallel neighbors, which jam at large "
        "shear (locking). automatic: on if the shear of the load programme "
        "brings them nearer than a tenth of the width.");
      prm.declare_entry("Secondary bundles",
                        "weft",
                        Patterns::Selection("warp|weft"),
                        "Which bundles carry the contact nodes: the secondary "
                        "side, which is projected onto the other one. The "
                        "finer mesh should be the secondary one.");
      prm.declare_entry("Plies",
                        "0",
                        Patterns::List(Patterns::Double(-180., 180.), 1),
                        "Laminate only: fiber angles of the plies from bottom "
                        "to top [degrees]. The total thickness is the bundle "
                        "thickness.");
      prm.declare_entry("Crossing spacing",
                        "5",
                        Patterns::List(Patterns::Double(tiny), 1, 2),
                        "Distance Lbar between neighboring parallel bundles "
                        "[mm]; two numbers: between warp bundles (along Y2), "
                        "between weft bundles (along Y1).");
      prm.declare_entry("Bundle width",
                        "4",
                        Patterns::List(Patterns::Double(tiny), 1, 2),
                        "Width w of a bundle [mm], smaller than the crossing "
                        "spacing; two numbers: of warp, of weft.");
      prm.declare_entry("Bundle thickness",
                        "1.2",
                        Patterns::List(Patterns::Double(tiny), 1, 2),
                        "Thickness t of a bundle at its center [mm]; two "
                        "numbers: of warp, of weft.");
      prm.declare_entry(
        "Section",
        "lens",
        Patterns::Selection("lens|ellipse|power ellipse|rounded rectangle"),
        "Cross section of the bundles. The first three are arches "
        "h = t/2 (1 - c (2y/w)^2)^(n/2) that end in a blunt edge, with n = 2 "
        "for the lens, n = 1 for the ellipse; the rounded rectangle has flat "
        "faces, arcs of 60 degrees and side faces.");
      prm.declare_entry("Section power",
                        "1.5",
                        Patterns::Double(0.1, 4.),
                        "Power ellipse only: n of its arch [-]; below 1 fuller "
                        "than the ellipse, above 2 slimmer than the lens.");
      prm.declare_entry("Blunt tip",
                        "0.1",
                        Patterns::Double(0.001, 0.499),
                        "Half height of the blunt edge of a bundle as a "
                        "fraction e/t of its thickness [-]. The arcs of the "
                        "rounded rectangle have the radius t - 2e.");
      prm.declare_entry("Weaving depth",
                        "1",
                        Patterns::Double(0., 1.),
                        "Fraction of the full weaving displacement [-]: at 1 "
                        "the ends of both bundles meet at the mid-plane, at 0 "
                        "the bundles stay straight and just touch.");
      prm.declare_entry("Two-fold axis",
                        "true",
                        Patterns::Bool(),
                        "Use the two-fold axis of the weave through the "
                        "crossing as a constraint. It holds for all modes, "
                        "removes rigid motions without pins and makes the "
                        "centered state stable; false pins the center of each "
                        "bundle instead.");
      prm.declare_entry(
        "Smooth closure",
        "false",
        Patterns::Bool(),
        "Join the end of a bundle to its continuation in the next cell, and "
        "the pieces between crossings, with a common tangent (C1), Eq. (A18), "
        "instead of continuously only (C0). Needs the NURBS basis. It takes "
        "away the kink at the seam and three unknowns per control point of "
        "it; mind that a bundle then has less freedom than with C0 seams, so "
        "that a coarse mesh is stiffer.");
    }
    prm.leave_subsection();
  }



  void
  CellParameters::parse_parameters(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Cell");
    type                   = prm.get("Type");
    weave                  = prm.get("Weave");
    images                 = prm.get_bool("Images");
    const std::string side = prm.get("Side contact");
    side_contact           = side == "on"  ? SideContact::on :
                             side == "off" ? SideContact::off :
                                             SideContact::automatic;
    plies                  = dealii::Utilities::string_to_double(
      dealii::Utilities::split_string_list(prm.get("Plies"), ','));
    crossing_spacing = get_pair(prm, "Crossing spacing");
    bundle_width     = get_pair(prm, "Bundle width");
    bundle_thickness = get_pair(prm, "Bundle thickness");
    section          = BundleSection::shape_from_name(prm.get("Section"));
    section_power    = prm.get_double("Section power");
    blunt_tip        = prm.get_double("Blunt tip");
    warp_secondary   = prm.get("Secondary bundles") == "warp";
    weaving_depth    = prm.get_double("Weaving depth");
    two_fold_axis    = prm.get_bool("Two-fold axis");
    smooth_closure   = prm.get_bool("Smooth closure");
    prm.leave_subsection();

    // With one number for both, the sentence need not say whose it is.
    const bool equal = crossing_spacing.warp == crossing_spacing.weft &&
                       bundle_width.warp == bundle_width.weft &&
                       bundle_thickness.warp == bundle_thickness.weft;
    for (const bool warp : {true, false})
      {
        const std::string   whose = equal ? "" : warp ? "warp " : "weft ";
        const BundleSection shape = warp ? warp_section() : weft_section();
        const double        spacing =
          warp ? crossing_spacing.warp : crossing_spacing.weft;
        const double       w = shape.width, t = shape.thickness;
        std::ostringstream message;
        if (w >= spacing)
          message << "Bundle width " << (equal ? "" : "of " + whose) << "is "
                  << w << " mm; it must be smaller than the "
                  << "crossing spacing of " << spacing
                  << " mm, or parallel bundles overlap (subsection Cell).";
        else if (t >= w)
          message << "Bundle thickness " << (equal ? "" : "of " + whose)
                  << "is " << t << " mm; it must be smaller than the bundle "
                  << "width of " << w << " mm (subsection Cell).";
        else if (section == BundleSection::Shape::rounded_rectangle &&
                 std::sqrt(3.) * (t - 2 * shape.tip) >= 0.95 * w)
          message << "Blunt tip is " << blunt_tip
                  << "; the arcs of the rounded rectangle would leave no flat "
                  << "face between them on a bundle of " << w << " mm by " << t
                  << " mm; take a Blunt tip above "
                  << 0.5 * (1 - 0.95 * w / (std::sqrt(3.) * t))
                  << " (subsection Cell).";
        else if (shape.edge_angle() > 75.)
          message << (section == BundleSection::Shape::power_ellipse ?
                        "Section power is " + prm_number(section_power) +
                          " with a Blunt tip of " :
                        "Blunt tip is ")
                  << blunt_tip << "; the wide face of a " << whose
                  << "bundle of " << w << " mm by " << t
                  << " mm would meet the edge at "
                  << std::round(shape.edge_angle())
                  << " degrees, and beyond 75 cells degenerate; take a larger "
                  << "Blunt tip"
                  << (section == BundleSection::Shape::power_ellipse ?
                        " or a larger Section power" :
                        "")
                  << " (subsection Cell).";
        if (!message.str().empty())
          throw InputError(message.str());
      }
  }



  BundleSection
  CellParameters::warp_section() const
  {
    return {section,
            bundle_width.warp,
            bundle_thickness.warp,
            blunt_tip * bundle_thickness.warp,
            section_power};
  }



  BundleSection
  CellParameters::weft_section() const
  {
    return {section,
            bundle_width.weft,
            bundle_thickness.weft,
            blunt_tip * bundle_thickness.weft,
            section_power};
  }



  void
  MeshParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Mesh");
    {
      prm.declare_entry(
        "Basis",
        "NURBS",
        Patterns::Selection("NURBS|Bernstein|Lagrange"),
        "Functions of geometry and displacement: NURBS are smooth splines "
        "(Model A), Bernstein cuts the same patches to C0 (Model B), Lagrange "
        "uses deal.II's FE_Q on the same knot spans.");
      prm.declare_entry("Degree",
                        "2",
                        Patterns::Integer(2, 5),
                        "Polynomial degree p in all directions [-].");
      prm.declare_entry("Elements along",
                        "9",
                        Patterns::Integer(1, 200),
                        "Knot spans n_A along a bundle [-].");
      prm.declare_entry("Elements across",
                        "9",
                        Patterns::Integer(1, 200),
                        "Knot spans n_B across a bundle [-].");
      prm.declare_entry("Elements through",
                        "2",
                        Patterns::Integer(1, 50),
                        "Knot spans through the thickness [-].");
    }
    prm.leave_subsection();
  }



  void
  MeshParameters::parse_parameters(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Mesh");
    basis            = basis_from_name(prm.get("Basis"));
    degree           = prm.get_integer("Degree");
    elements_along   = prm.get_integer("Elements along");
    elements_across  = prm.get_integer("Elements across");
    elements_through = prm.get_integer("Elements through");
    prm.leave_subsection();
  }
} // namespace NPT
