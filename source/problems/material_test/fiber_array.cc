// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the geometry of the micro cells and their entries.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/problems/material_test/fiber_array.h>

#include <deal.II/base/numbers.h>

#include <cmath>
#include <sstream>

namespace NPT
{
  using dealii::Point;
  using dealii::Tensor;
  using dealii::numbers::PI;
  namespace Patterns = dealii::Patterns;

  namespace
  {
    // Corner radius of the fiber's core over the fiber radius: core and shell
    // then have about equal thickness.
    constexpr double core_ratio = 0.55;

    unsigned int
    n_corners(const Packing packing)
    {
      return packing == Packing::square ? 4 : 6;
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



  template <>
  const EnumNames<Packing> &
  enum_names<Packing>()
  {
    static const EnumNames<Packing> names = {{Packing::square, "square"},
                                             {Packing::hexagonal, "hexagonal"}};
    return names;
  }



  void
  MicroCellParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    const ParameterSubsection subsection(prm, "Micro cell");
    add_parameter(prm,
                  "Packing",
                  packing,
                  "Lattice of the fibers in the plane of directions 2 "
                  "and 3; fibers run along direction 1.");
    add_parameter(prm,
                  "Volume fraction",
                  volume_fraction,
                  "Volume fraction of the fibers [-], below pi/4 = "
                  "0.7854 (square) or pi/(2 sqrt 3) = 0.9069 "
                  "(hexagonal), where fibers touch. Not used if a fiber "
                  "radius is given.",
                  Patterns::Double(0.));
    add_parameter(prm,
                  "Fiber radius",
                  fiber_radius,
                  "Radius R of the fibers [mm], smaller than half the "
                  "spacing; 0 takes the radius that gives the volume "
                  "fraction.",
                  Patterns::Double(0.));
    add_parameter(prm,
                  "Fiber spacing",
                  fiber_spacing,
                  "Distance s between the axes of neighboring fibers "
                  "[mm]. Only R/s matters for the stresses.",
                  positive_number());
    add_parameter(prm,
                  "Fibers",
                  n_fibers,
                  "Fibers in the periodic cell. The smallest cell is "
                  "enough as long as the deformation repeats from fiber "
                  "to fiber; more serve to verify just that.",
                  Patterns::Selection("1|2|4"));
  }



  void
  MicroCellParameters::check()
  {
    std::ostringstream message;
    // Volumes and their derivatives are products of many lengths.
    for (const auto &[name, length] :
         {std::pair("Fiber spacing", fiber_spacing),
          std::pair("Fiber radius", fiber_radius)})
      if (length > 1e20 || (length > 0. && length < 1e-20))
        throw InputError(std::string(name) + " is " +
                         EntryValue<double>::text(length) +
                         " mm; it must be between 1e-20 and 1e20 mm "
                         "(subsection Micro cell).");
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
                  << ", with which the fibers of a " << name_of(packing)
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
  MicroMeshParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    const ParameterSubsection subsection(prm, "Micro mesh");
    add_parameter(
      prm,
      "Basis",
      basis,
      "Functions of geometry and displacement: NURBS (exact circles, smooth "
      "within a patch), Bernstein (the same patches cut to C0), Lagrange "
      "(deal.II's FE_Q with nodes on the circles, as a cross-check).");
    add_parameter(prm,
                  "Degree",
                  degree,
                  "Polynomial degree p in all directions [-].",
                  Patterns::Integer(2, 5));
    add_parameter(prm,
                  "Elements around",
                  elements_around,
                  "Knot spans around the fiber in each of the 4 (square) "
                  "or 6 (hexagonal) sectors, dense where the fibers are "
                  "near each other [-].",
                  Patterns::Integer(1, 100));
    add_parameter(prm,
                  "Elements in fiber",
                  elements_fiber,
                  "Knot spans from the core to the surface of the fiber "
                  "[-].",
                  Patterns::Integer(1, 100));
    add_parameter(prm,
                  "Elements in matrix",
                  elements_matrix,
                  "Knot spans from the surface of the fiber to half the "
                  "way to its neighbor [-].",
                  Patterns::Integer(1, 100));
    add_parameter(prm,
                  "Elements along",
                  elements_along,
                  "Knot spans along the fiber [-]. One is exact as long "
                  "as the fiber does not buckle, since all sections are "
                  "then alike.",
                  Patterns::Integer(1, 100));
    add_parameter(
      prm,
      "Additional Gauss points",
      additional_gauss_points,
      "Gauss points per direction beyond p + 1 [-]. The circles are "
      "rational, so that no number of points is exact; on a mesh of 6 "
      "elements around at 77 % the moduli are wrong by up to 1e-4 with 0, "
      "2e-6 with 1 and 1e-9 with 2 additional points.",
      Patterns::Integer(0, 10));
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



  namespace
  {
    // The patches of one polygon and its fiber.
    class PolygonMaker
    {
    public:
      PolygonMaker(const MicroCellParameters &cell,
                   const MicroMeshParameters &mesh,
                   const Tensor<1, 3>        &center,
                   const Tensor<1, 3>        &period_along)
        : mesh_(mesh)
        , center_(center)
        , period_along_(period_along)
        , n_(n_corners(cell.packing))
        , half_(PI / n_)
        , R_(cell.fiber_radius)
        , side_(0.5 * cell.fiber_spacing)
        , weight_(std::cos(half_))
      {
        const double critical = std::sqrt(2. * (side_ - R_) / R_);
        const double beta     = std::asinh(half_ / critical);
        around_               = graded_knots(mesh.elements_around, beta);
      }

      // Matrix and fiber between the sides of the polygon and the core, sector
      // by sector, then the core.
      void
      make()
      {
        for (unsigned int i = 0; i < n_; ++i)
          add_sector(i);
        const double r = core_ratio * R_;
        if (n_ == 4)
          add_core(corner(r, 2), corner(r, 3), corner(r, 0), corner(r, 1));
        else
          for (unsigned int i = 0; i < n_; i += 2)
            add_core(in_plane(0., 0.),
                     corner(r, i),
                     corner(r, i + 1),
                     corner(r, i + 2));
      }

      std::vector<NURBSPatch<3>> patches;
      std::vector<bool>          is_fiber;

    private:
      Point<3>
      in_plane(const double radius, const double angle) const
      {
        Point<3> P;
        P[1] = center_[1] + radius * std::cos(angle);
        P[2] = center_[2] + radius * std::sin(angle);
        return P;
      }

      Point<3>
      corner(const double radius, const unsigned int i) const
      {
        return in_plane(radius, (2. * i + 1.) * half_);
      }

      static Point<3>
      middle(const Point<3> &P, const Point<3> &Q)
      {
        return Point<3>(0.5 * (P + Q));
      }

      static std::vector<double>
      even(const unsigned int parts)
      {
        return graded_knots(parts, 1e-6);
      }

      // A patch from its section (m x 3 control points, the first direction
      // fastest) extruded along the fiber, then elevated and refined. All
      // patches refine their common edges by the same knots.
      void
      add(const std::vector<Point<3>> &section,
          const std::vector<double>   &section_weights,
          const std::vector<double>   &first,
          const std::vector<double>   &second,
          const bool                   fiber)
      {
        const unsigned int    m = section.size() / 3;
        std::vector<Point<3>> points;
        std::vector<double>   weights;
        for (unsigned int k = 0; k < section.size(); ++k)
          for (unsigned int end = 0; end < 2; ++end)
            {
              points.push_back(section[k] +
                               static_cast<double>(end) * period_along_);
              weights.push_back(section_weights[k]);
            }
        NURBSPatch<3> patch({{KnotVector::uniform(1, 1),
                              KnotVector::uniform(m - 1, 1),
                              KnotVector::uniform(2, 1)}},
                            points,
                            weights);
        for (unsigned int d = 0; d < 3; ++d)
          patch.elevate_degree(d, mesh_.degree - patch.knot_vector(d).degree());
        patch.subdivide(0, mesh_.elements_along);
        patch.insert_knots(1, first);
        patch.insert_knots(2, second);
        patches.push_back(patch);
        is_fiber.push_back(fiber);
      }

      void
      add_sector(const unsigned int i)
      {
        const Point<3> arc0 = corner(R_, i), arc2 = corner(R_, i + 1),
                       arc1   = in_plane(R_ / weight_, (2. * i + 2.) * half_);
        const Point<3> outer0 = corner(side_ / weight_, i),
                       outer2 = corner(side_ / weight_, i + 1);
        const Point<3> core0  = corner(core_ratio * R_, i),
                       core2  = corner(core_ratio * R_, i + 1);
        add({arc0, outer0, arc1, middle(outer0, outer2), arc2, outer2},
            {1., 1., weight_, 1., 1., 1.},
            even(mesh_.elements_matrix),
            around_,
            false);
        add({core0, arc0, middle(core0, core2), arc1, core2, arc2},
            {1., 1., 1., weight_, 1., 1.},
            even(mesh_.elements_fiber),
            around_,
            true);
      }

      // A parallelogram with the corners c0, c1, c2 = c1 + c3 - c0, c3.
      void
      add_core(const Point<3> &c0,
               const Point<3> &c1,
               const Point<3> &c2,
               const Point<3> &c3)
      {
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
            around_,
            around_,
            true);
      }

      const MicroMeshParameters &mesh_;
      const Tensor<1, 3>         center_, period_along_;
      const unsigned int         n_;
      const double               half_; // half the angle of a sector
      const double               R_, side_, weight_;
      std::vector<double>        around_;
    };
  } // namespace



  void
  FiberArray::add_polygon(const Tensor<1, 3>        &center,
                          const MicroMeshParameters &mesh)
  {
    PolygonMaker polygon(parameters_, mesh, center, periods_[0]);
    polygon.make();
    patches_.insert(patches_.end(),
                    polygon.patches.begin(),
                    polygon.patches.end());
    is_fiber_.insert(is_fiber_.end(),
                     polygon.is_fiber.begin(),
                     polygon.is_fiber.end());
  }
} // namespace NPT
