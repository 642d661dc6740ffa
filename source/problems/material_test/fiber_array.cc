// SPDX-License-Identifier: LGPL-2.1-or-later
// Geometry of the micro cells.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/problems/material_test/fiber_array.h>

#include <deal.II/base/numbers.h>

#include <cmath>
#include <limits>
#include <sstream>

namespace NPT
{
  using dealii::Point;
  using dealii::Tensor;
  using dealii::numbers::PI;
  namespace Patterns = dealii::Patterns;

  namespace
  {
    const double tiny = std::numeric_limits<double>::min();

    // Corner radius of the fiber's core over the fiber radius: core and shell
    // then have about equal thickness.
    constexpr double core_ratio = 0.55;

    unsigned int
    n_corners(const Packing packing)
    {
      return packing == Packing::square ? 4 : 6;
    }

    std::string
    packing_name(const Packing packing)
    {
      return packing == Packing::square ? "square" : "hexagonal";
    }

    // Area of the polygon around a fiber, over the square of the spacing.
    double
    polygon_area(const Packing packing)
    {
      return packing == Packing::square ? 1. : 0.5 * std::sqrt(3.);
    }

    // Interior knots of a sector in [0,1], dense about the middle.
    std::vector<double>
    graded_knots(const unsigned int n, const double beta)
    {
      std::vector<double> knots;
      for (unsigned int k = 1; k < n; ++k)
        {
          const double t = 2. * k / n - 1.;
          knots.push_back(0.5 + 0.5 * std::sinh(beta * t) / std::sinh(beta));
        }
      return knots;
    }
  } // namespace



  double
  volume_fraction_limit(const Packing packing)
  {
    return 0.25 * PI / polygon_area(packing);
  }



  void
  MicroCellParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Micro cell");
    {
      prm.declare_entry("Packing",
                        "square",
                        Patterns::Selection("square|hexagonal"),
                        "Lattice of the fibers in the plane of directions 2 "
                        "and 3; fibers run along direction 1.");
      prm.declare_entry("Volume fraction",
                        "0.77",
                        Patterns::Double(0.),
                        "Volume fraction of the fibers [-], below pi/4 = "
                        "0.7854 (square) or pi/(2 sqrt 3) = 0.9069 "
                        "(hexagonal), where fibers touch. Not used if a fiber "
                        "radius is given.");
      prm.declare_entry("Fiber radius",
                        "0",
                        Patterns::Double(0.),
                        "Radius R of the fibers [mm], smaller than half the "
                        "spacing; 0 takes the radius that gives the volume "
                        "fraction.");
      prm.declare_entry("Fiber spacing",
                        "1",
                        Patterns::Double(tiny),
                        "Distance s between the axes of neighboring fibers "
                        "[mm]. Only R/s matters for the stresses.");
      prm.declare_entry("Fibers",
                        "1",
                        Patterns::Selection("1|2|4"),
                        "Fibers in the periodic cell. The smallest cell is "
                        "enough as long as the deformation repeats from fiber "
                        "to fiber; more serve to verify just that.");
    }
    prm.leave_subsection();
  }



  void
  MicroCellParameters::parse_parameters(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Micro cell");
    packing =
      prm.get("Packing") == "square" ? Packing::square : Packing::hexagonal;
    volume_fraction = prm.get_double("Volume fraction");
    fiber_radius    = prm.get_double("Fiber radius");
    fiber_spacing   = prm.get_double("Fiber spacing");
    n_fibers        = prm.get_integer("Fibers");
    prm.leave_subsection();
    check();
  }



  void
  MicroCellParameters::check()
  {
    std::ostringstream message;
    if (fiber_radius > 0.)
      {
        if (2. * fiber_radius >= fiber_spacing)
          message << "Fiber radius is " << fiber_radius
                  << " mm, with which neighboring fibers touch or overlap; it "
                     "must be smaller than half the fiber spacing of "
                  << fiber_spacing << " mm (subsection Micro cell).";
        volume_fraction =
          PI * fiber_radius * fiber_radius /
          (polygon_area(packing) * fiber_spacing * fiber_spacing);
      }
    else
      {
        const double limit = volume_fraction_limit(packing);
        if (!(volume_fraction > 0.))
          message << "Volume fraction is " << volume_fraction
                  << "; it must be > 0 (subsection Micro cell).";
        else if (volume_fraction >= limit)
          message << "Volume fraction is " << volume_fraction
                  << ", with which the fibers of a " << packing_name(packing)
                  << " array overlap; it must be smaller than " << limit
                  << (packing == Packing::square &&
                          volume_fraction <
                            volume_fraction_limit(Packing::hexagonal) ?
                        ", or choose the hexagonal packing" :
                        "")
                  << " (subsection Micro cell).";
        fiber_radius = fiber_spacing *
                       std::sqrt(volume_fraction * polygon_area(packing) / PI);
      }
    if (!message.str().empty())
      throw InputError(message.str());
  }



  void
  MicroMeshParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    const MicroMeshParameters defaults;
    prm.enter_subsection("Micro mesh");
    {
      prm.declare_entry(
        "Basis",
        "NURBS",
        Patterns::Selection("NURBS|Bernstein|Lagrange"),
        "Functions of geometry and displacement: NURBS (exact circles, smooth "
        "within a patch), Bernstein (the same patches cut to C0), Lagrange "
        "(deal.II's FE_Q with nodes on the circles, as a cross-check).");
      prm.declare_entry("Degree",
                        std::to_string(defaults.degree),
                        Patterns::Integer(2, 5),
                        "Polynomial degree p in all directions [-].");
      prm.declare_entry("Elements around",
                        std::to_string(defaults.elements_around),
                        Patterns::Integer(1, 100),
                        "Knot spans around the fiber in each of the 4 (square) "
                        "or 6 (hexagonal) sectors, dense where the fibers are "
                        "near each other [-].");
      prm.declare_entry("Elements in fiber",
                        std::to_string(defaults.elements_fiber),
                        Patterns::Integer(1, 100),
                        "Knot spans from the core to the surface of the fiber "
                        "[-].");
      prm.declare_entry("Elements in matrix",
                        std::to_string(defaults.elements_matrix),
                        Patterns::Integer(1, 100),
                        "Knot spans from the surface of the fiber to half the "
                        "way to its neighbor [-].");
      prm.declare_entry("Elements along",
                        std::to_string(defaults.elements_along),
                        Patterns::Integer(1, 100),
                        "Knot spans along the fiber [-]. One is exact as long "
                        "as the fiber does not buckle, since all sections are "
                        "then alike.");
      prm.declare_entry(
        "Additional Gauss points",
        std::to_string(defaults.additional_gauss_points),
        Patterns::Integer(0, 10),
        "Gauss points per direction beyond p + 1 [-]. The circles are "
        "rational, so that no number of points is exact; on a mesh of 6 "
        "elements around at 77 % the moduli are wrong by up to 1e-4 with 0, "
        "2e-6 with 1 and 1e-9 with 2 additional points.");
    }
    prm.leave_subsection();
  }



  void
  MicroMeshParameters::parse_parameters(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Micro mesh");
    basis                   = basis_from_name(prm.get("Basis"));
    degree                  = prm.get_integer("Degree");
    elements_around         = prm.get_integer("Elements around");
    elements_fiber          = prm.get_integer("Elements in fiber");
    elements_matrix         = prm.get_integer("Elements in matrix");
    elements_along          = prm.get_integer("Elements along");
    additional_gauss_points = prm.get_integer("Additional Gauss points");
    prm.leave_subsection();
  }



  FiberArray::FiberArray(const MicroCellParameters &cell,
                         const MicroMeshParameters &mesh)
    : parameters_(cell)
  {
    parameters_.check();
    const double s = parameters_.fiber_spacing;

    // Lattice of the fibers.
    Tensor<1, 3> a, b;
    a[1] = s;
    if (cell.packing == Packing::square)
      b[2] = s;
    else
      {
        b[1] = 0.5 * s;
        b[2] = std::sqrt(0.75) * s;
      }

    // As long as a span is wide, roughly: no bad aspect ratio, no influence.
    periods_[0][0] = 0.2 * s * mesh.elements_along;
    periods_[1]    = a;
    periods_[2]    = b;
    std::vector<Tensor<1, 3>> centers(1);
    if (cell.n_fibers >= 2)
      {
        // Hexagonal: 2b - a makes the cell of two fibers a rectangle.
        centers.push_back(b);
        periods_[2] = cell.packing == Packing::square ? 2. * b : 2. * b - a;
      }
    if (cell.n_fibers == 4)
      {
        centers.push_back(a);
        centers.push_back(a + b);
        periods_[1] = 2. * a;
      }
    for (const auto &center : centers)
      add_polygon(center, mesh);
    volume_ =
      polygon_area(cell.packing) * s * s * periods_[0][0] * centers.size();
  }



  void
  FiberArray::add_polygon(const Tensor<1, 3>        &center,
                          const MicroMeshParameters &mesh)
  {
    const unsigned int n        = n_corners(parameters_.packing);
    const double       half     = PI / n; // half the angle of a sector
    const double       R        = parameters_.fiber_radius;
    const double       side     = 0.5 * parameters_.fiber_spacing;
    const double       weight   = std::cos(half);
    const double       critical = std::sqrt(2. * (side - R) / R);
    const double       beta     = std::asinh(half / critical);
    const auto         around   = graded_knots(mesh.elements_around, beta);

    const auto in_plane = [&](const double radius, const double angle) {
      Point<3> P;
      P[1] = center[1] + radius * std::cos(angle);
      P[2] = center[2] + radius * std::sin(angle);
      return P;
    };
    const auto middle = [](const Point<3> &P, const Point<3> &Q) {
      return Point<3>(0.5 * (P + Q));
    };

    // A patch from its section (m x 3 control points, the first direction
    // fastest) extruded along the fiber, then elevated and refined. All
    // patches refine their common edges by the same knots.
    const auto add = [&](const std::vector<Point<3>> &section,
                         const std::vector<double>   &section_weights,
                         const std::vector<double>   &first,
                         const std::vector<double>   &second,
                         const bool                   fiber) {
      const unsigned int    m = section.size() / 3;
      std::vector<Point<3>> points;
      std::vector<double>   weights;
      for (unsigned int k = 0; k < section.size(); ++k)
        for (unsigned int end = 0; end < 2; ++end)
          {
            points.push_back(section[k] +
                             static_cast<double>(end) * periods_[0]);
            weights.push_back(section_weights[k]);
          }
      NURBSPatch<3> patch({{KnotVector::uniform(1, 1),
                            KnotVector::uniform(m - 1, 1),
                            KnotVector::uniform(2, 1)}},
                          points,
                          weights);
      for (unsigned int d = 0; d < 3; ++d)
        patch.elevate_degree(d, mesh.degree - patch.knot_vector(d).degree());
      patch.subdivide(0, mesh.elements_along);
      patch.insert_knots(1, first);
      patch.insert_knots(2, second);
      patches_.push_back(patch);
      is_fiber_.push_back(fiber);
    };
    const auto even = [](const unsigned int parts) {
      return graded_knots(parts, 1e-6);
    };

    const auto corner = [&](const double radius, const unsigned int i) {
      return in_plane(radius, (2. * i + 1.) * half);
    };
    for (unsigned int i = 0; i < n; ++i)
      {
        const Point<3> arc0 = corner(R, i), arc2 = corner(R, i + 1),
                       arc1   = in_plane(R / weight, (2. * i + 2.) * half);
        const Point<3> outer0 = corner(side / weight, i),
                       outer2 = corner(side / weight, i + 1);
        const Point<3> core0  = corner(core_ratio * R, i),
                       core2  = corner(core_ratio * R, i + 1);
        add({arc0, outer0, arc1, middle(outer0, outer2), arc2, outer2},
            {1., 1., weight, 1., 1., 1.},
            even(mesh.elements_matrix),
            around,
            false);
        add({core0, arc0, middle(core0, core2), arc1, core2, arc2},
            {1., 1., 1., weight, 1., 1.},
            even(mesh.elements_fiber),
            around,
            true);
      }

    // The core: parallelograms with the corners c0, c1, c2 = c1 + c3 - c0, c3.
    const auto add_core = [&](const Point<3> &c0,
                              const Point<3> &c1,
                              const Point<3> &c2,
                              const Point<3> &c3) {
      const Point<3> bottom = middle(c0, c1), top = middle(c3, c2);
      add({c0,
           bottom,
           c1,
           middle(c0, c3),
           middle(bottom, top),
           middle(c1, c2),
           c3,
           top,
           c2},
          std::vector<double>(9, 1.),
          around,
          around,
          true);
    };
    const double r = core_ratio * R;
    if (n == 4)
      add_core(corner(r, 2), corner(r, 3), corner(r, 0), corner(r, 1));
    else
      for (unsigned int i = 0; i < 6; i += 2)
        add_core(in_plane(0., 0.),
                 corner(r, i),
                 corner(r, i + 1),
                 corner(r, i + 2));
  }
} // namespace NPT
