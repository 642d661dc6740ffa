// SPDX-License-Identifier: LGPL-2.1-or-later
// Cell and mesh entries of the parameter file.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/cell/cell_parameters.h>

#include <deal.II/base/utilities.h>

#include <limits>
#include <sstream>

namespace NPT
{
  namespace Patterns = dealii::Patterns;

  namespace
  {
    const double tiny = std::numeric_limits<double>::min();
  }



  void
  CellParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Cell");
    {
      prm.declare_entry(
        "Type",
        "automatic",
        Patterns::Selection("automatic|sub-unit cell|two-crossing cell|unit "
                            "cell|laminate"),
        "Which periodic piece is computed. The sub-unit cell has one crossing "
        "of a plain weave and is coupled by glide planes, Eqs. (47)-(48); it "
        "represents H1, H2 and H3 only. The two-crossing cell (plain weave) "
        "and the unit cell (any weave) are coupled by translations and "
        "represent all six modes. automatic takes the smallest one that is "
        "valid for the load programme. laminate is a stack of plies without "
        "contact, to check against classical plate theory.");
      prm.declare_entry(
        "Weave",
        "plain",
        Patterns::Anything(),
        "plain, 2/2 twill, 5-harness satin, or a table with one row per weft "
        "bundle, rows separated by '/', o where the warp is over and u where "
        "it is under: ou/uo is the plain weave. Weaves other than plain are "
        "built but cannot be woven yet.");
      prm.declare_entry("Images",
                        "true",
                        Patterns::Bool(),
                        "Let bundles touch the continuation of bundles in "
                        "neighboring cells, Eq. (49); needed when large shear "
                        "carries the contact zone over the edge of the cell.");
      prm.declare_entry("Plies",
                        "0",
                        Patterns::List(Patterns::Double(-180., 180.), 1),
                        "Laminate only: fiber angles of the plies from bottom "
                        "to top [degrees]. The total thickness is the bundle "
                        "thickness.");
      prm.declare_entry("Crossing spacing",
                        "5",
                        Patterns::Double(tiny),
                        "Distance Lbar between crossings, which is the length "
                        "of a bundle in the sub-unit cell [mm].");
      prm.declare_entry("Bundle width",
                        "4",
                        Patterns::Double(tiny),
                        "Width w of a bundle [mm], smaller than the crossing "
                        "spacing.");
      prm.declare_entry("Bundle thickness",
                        "1.2",
                        Patterns::Double(tiny),
                        "Thickness t of a bundle at its center [mm].");
      prm.declare_entry("Blunt tip",
                        "0.1",
                        Patterns::Double(0.001, 0.499),
                        "Half height of the blunt edge of the lens section as "
                        "a fraction e/t of the thickness [-].");
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
    }
    prm.leave_subsection();
  }



  void
  CellParameters::parse_parameters(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Cell");
    type   = prm.get("Type");
    weave  = prm.get("Weave");
    images = prm.get_bool("Images");
    plies  = dealii::Utilities::string_to_double(
      dealii::Utilities::split_string_list(prm.get("Plies"), ','));
    crossing_spacing = prm.get_double("Crossing spacing");
    bundle_width     = prm.get_double("Bundle width");
    bundle_thickness = prm.get_double("Bundle thickness");
    blunt_tip        = prm.get_double("Blunt tip");
    weaving_depth    = prm.get_double("Weaving depth");
    two_fold_axis    = prm.get_bool("Two-fold axis");
    prm.leave_subsection();

    std::ostringstream message;
    if (bundle_width >= crossing_spacing)
      message << "Bundle width is " << bundle_width
              << " mm; it must be smaller than the crossing spacing of "
              << crossing_spacing
              << " mm, or parallel bundles overlap (subsection Cell).";
    else if (bundle_thickness >= bundle_width)
      message << "Bundle thickness is " << bundle_thickness
              << " mm; it must be smaller than the bundle width of "
              << bundle_width << " mm (subsection Cell).";
    if (!message.str().empty())
      throw InputError(message.str());
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
