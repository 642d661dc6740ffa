// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what the contact tests share: curved slabs, their faces, and a
// projection that takes no answer on trust.

#ifndef npt_dealii_tests_contact_test_tools_h
#define npt_dealii_tests_contact_test_tools_h

#include <npt_dealii/contact/geometry/closest_point_projection.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace ContactTests
{
  using dealii::Point;
  using dealii::Tensor;
  using NPT::Basis;
  using NPT::ClosestPoint;
  using NPT::ContactSurface;
  using NPT::IGASpace;
  using NPT::IGASurface;
  using NPT::KnotVector;
  using NPT::NURBSPatch;
  using NPT::SymmetricIndices;

  template <int dim>
  using Map = std::function<Point<dim>(const Point<dim> &)>;

  // A patch whose control points are the mapped Greville points; the last
  // direction goes through the thickness in one span.
  template <int dim>
  NURBSPatch<dim>
  slab(const std::array<KnotVector, dim - 1> &knots, const Map<dim> &map)
  {
    std::vector<KnotVector> all(knots.begin(), knots.end());
    all.push_back(KnotVector::uniform(knots[0].degree(), 1));
    unsigned int n = 1;
    for (const KnotVector &k : all)
      n *= k.n_functions();
    std::vector<Point<dim>> points;
    for (unsigned int A = 0; A < n; ++A)
      {
        Point<dim>   u;
        unsigned int rest = A;
        for (int d = 0; d < dim; ++d)
          {
            u[d] = all[d].greville(rest % all[d].n_functions());
            rest /= all[d].n_functions();
          }
        points.push_back(map(u));
      }
    if constexpr (dim == 2)
      return NURBSPatch<2>({{all[0], all[1]}}, points);
    else
      return NURBSPatch<3>({{all[0], all[1], all[2]}}, points);
  }



  // The face through whose outward normal the last direction ends (1) or
  // begins (0), with the current positions of its control points.
  template <int dim>
  struct Face
  {
    IGASpace<dim>           space;
    IGASurface<dim>         iga_surface;
    ContactSurface<dim>     surface;
    std::vector<Point<dim>> positions;

    Face(const NURBSPatch<dim> &patch,
         const unsigned int     direction,
         const unsigned int     side,
         const Basis            basis         = Basis::NURBS,
         const double           kink_rounding = 0.)
      : space({patch}, {}, basis)
      , iga_surface(space, 0, direction, side, kink_rounding)
      , surface(iga_surface)
    {
      for (unsigned int l = 0; l < iga_surface.n_control_points(); ++l)
        positions.push_back(iga_surface.reference_position(l));
    }

    ClosestPoint<dim>
    project(const Point<dim>                  &x,
            const std::array<double, dim - 1> &start,
            const bool                         third = false) const
    {
      ClosestPoint<dim> c;
      NPT::project(surface, positions, x, start, third, c);
      return c;
    }

    Point<dim>
    value(const std::array<double, dim - 1> &u) const
    {
      NPT::SurfaceShape<dim - 1> shape;
      iga_surface.evaluate(u, 0, shape);
      Point<dim> x;
      for (unsigned int l = 0; l < shape.lattice.size(); ++l)
        x += shape.value[l] * positions[shape.lattice[l]];
      return x;
    }
  };



  template <int dim>
  Tensor<1, dim>
  random_vector(std::mt19937 &generator, const double size = 1.)
  {
    std::uniform_real_distribution<double> unit(-size, size);
    Tensor<1, dim>                         v;
    for (int i = 0; i < dim; ++i)
      v[i] = unit(generator);
    return v;
  }



  // A wavy top face over [-1,1]^m, C1, with uneven spans.
  template <int dim>
  NURBSPatch<dim>
  wavy_slab(const unsigned int degree = 2, const double height = 0.15)
  {
    std::vector<double> knots(degree + 1, -1.);
    for (const double k : {-0.4, 0.1, 0.5})
      knots.push_back(k);
    knots.insert(knots.end(), degree + 1, 1.);
    const KnotVector                k(degree, knots);
    std::array<KnotVector, dim - 1> all = [&]() {
      if constexpr (dim == 2)
        return std::array<KnotVector, 1>{{k}};
      else
        return std::array<KnotVector, 2>{{k, k}};
    }();
    return slab<dim>(all, [height](const Point<dim> &u) {
      Point<dim>   x = u;
      const double y = dim == 3 ? u[1] : 0.3;
      x[0] += 0.1 * u[0] * y;
      x[dim - 1] =
        u[dim - 1] - 1 + height * (std::sin(2. * u[0]) + std::cos(3. * y));
      return x;
    });
  }



  // A roof (slope > 0: ridge, slope < 0: valley) with the edge at x = 0:
  // z = -slope |x| - 0.2 x^2, C0 there by a knot of full multiplicity.
  template <int dim>
  NURBSPatch<dim>
  roof(const double slope)
  {
    const KnotVector folded(2, {-1, -1, -1, 0, 0, 1, 1, 1});
    const Map<dim>   map = [slope](const Point<dim> &u) {
      Point<dim> x = u;
      x[dim - 1] = u[dim - 1] - 1. - slope * std::abs(u[0]) - 0.2 * u[0] * u[0];
      return x;
    };
    if constexpr (dim == 2)
      return slab<2>({{folded}}, map);
    else
      return slab<3>({{folded, KnotVector(2, {-1, -1, -1, 0.2, 1, 1, 1})}},
                     map);
  }
} // namespace ContactTests

#endif
