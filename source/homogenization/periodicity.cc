// SPDX-License-Identifier: LGPL-2.1-or-later
// Couplings of a fabric cell.

#include <npt_dealii/homogenization/periodicity.h>

#include <deal.II/numerics/rtree.h>

#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>

#include <cmath>

namespace NPT
{
  using dealii::Point;
  using dealii::Tensor;
  namespace bgi = boost::geometry::index;

  namespace
  {
    // Finds control points of a family of bundles by reference position.
    class PointFinder
    {
    public:
      using BPoint = boost::geometry::model::
        point<double, 3, boost::geometry::cs::cartesian>;
      using Entry = std::pair<BPoint, unsigned int>;

      PointFinder(const FabricCell &cell, const IGASpace<3> &space)
        : tolerance_(1e-7 * cell.parameters().crossing_spacing)
      {
        std::vector<Entry> entries[2];
        for (unsigned int b = 0; b < space.n_patches(); ++b)
          for (unsigned int l = 0; l < space.patch(b).n_control_points(); ++l)
            {
              const unsigned int A = space.control_point(b, l);
              const auto        &P = space.control_points()[A];
              entries[static_cast<int>(cell.bundles()[b].family)].emplace_back(
                BPoint(P[0], P[1], P[2]), A);
            }
        for (unsigned int f = 0; f < 2; ++f)
          trees_[f] = bgi::rtree<Entry, bgi::rstar<16>>(entries[f].begin(),
                                                        entries[f].end());
      }

      // Control point at a position, or -1.
      int
      find(const FiberBundle::Family family, const Point<3> &P) const
      {
        const double       d = tolerance_;
        std::vector<Entry> found;
        trees_[static_cast<int>(family)].query(
          bgi::intersects(boost::geometry::model::box<BPoint>(
            BPoint(P[0] - d, P[1] - d, P[2] - d),
            BPoint(P[0] + d, P[1] + d, P[2] + d))),
          std::back_inserter(found));
        return found.empty() ? -1 : found[0].second;
      }

    private:
      const double                      tolerance_;
      bgi::rtree<Entry, bgi::rstar<16>> trees_[2];
    };
  } // namespace



  dealii::AffineConstraints<double>
  make_couplings(const FabricCell          &cell,
                 const IGASpace<3>         &space,
                 const MacroUnknowns       &macro,
                 const CouplingOptions     &options,
                 const std::vector<double> &height)
  {
    using Affine = OrbitConstraints::Affine;
    OrbitConstraints  orbits(macro.first, MacroUnknowns::n_macro);
    const PointFinder finder(cell, space);

    const auto position = [&](const unsigned int A) {
      Point<3> Y = space.control_points()[A];
      if (!height.empty())
        Y[2] = height[A];
      return Y;
    };

    std::vector<bool> mode_allowed;
    for (unsigned int n = 0; n < MacroUnknowns::n_modes; ++n)
      mode_allowed.push_back(cell.represents_mode(n));

    for (unsigned int b = 0; b < space.n_patches(); ++b)
      {
        const FiberBundle &bundle = cell.bundles()[b];
        for (unsigned int l = 0; l < space.patch(b).n_control_points(); ++l)
          {
            const unsigned int A = space.control_point(b, l);
            for (const SymmetryOperation &g : cell.operations())
              {
                const int B =
                  finder.find(bundle.family, g(space.control_points()[A]));
                if (B < 0)
                  continue; // the image lies in a neighboring cell
                for (unsigned int i = 0; i < 3; ++i)
                  {
                    // w(gY) = Q w(Y) + w_m(gY) - Q w_m(Y), mode by mode.
                    Affine affine(MacroUnknowns::n_macro, 0.);
                    for (unsigned int n = 0; n < MacroUnknowns::n_modes; ++n)
                      if (mode_allowed[n])
                        affine[n] =
                          macroscopic_displacement(n, position(B))[i] -
                          g.Q[i] * macroscopic_displacement(n, position(A))[i];
                    // Straight bundles are held at side * offset / 2.
                    if (i == 2)
                      affine[MacroUnknowns::n_modes] =
                        0.5 * bundle.side * (1. - g.Q[2]);
                    orbits.relate(3 * B + i, g.Q[i], 3 * A + i, affine, g.name);
                  }
              }
          }

        if (options.hold_end_middles)
          {
            // The middle of the end faces moves with half the offset: the mean
            // of the two middle control points, or the middle one.
            const NURBSPatch<3> &patch = space.patch(b);
            const unsigned int   n     = patch.n_control_points(2);
            for (const unsigned int i : {0u, patch.n_control_points(0) - 1})
              for (unsigned int j = 0; j < patch.n_control_points(1); ++j)
                {
                  Affine             affine(MacroUnknowns::n_macro, 0.);
                  const unsigned int A =
                    space.control_point(b, patch.index({{i, j, (n - 1) / 2}}));
                  const unsigned int B =
                    space.control_point(b, patch.index({{i, j, n / 2}}));
                  affine[MacroUnknowns::n_modes] = bundle.side;
                  orbits.relate(3 * A + 2,
                                -1.,
                                3 * B + 2,
                                affine,
                                "middle of the end faces");
                }
          }
      }

    dealii::AffineConstraints<double> constraints;
    orbits.write(constraints);

    if (!cell.parameters().two_fold_axis)
      {
        // Pins w1 = w2 = 0 of each bundle's center, mean over the thickness:
        // a weighted sum of control points, solved for its largest term.
        for (unsigned int b = 0; b < space.n_patches(); ++b)
          {
            const NURBSPatch<3>                         &patch = space.patch(b);
            std::vector<std::pair<unsigned int, double>> weights;
            std::array<unsigned int, 2>                  span;
            std::array<std::vector<double>, 2>           N;
            for (unsigned int d = 0; d < 2; ++d)
              {
                span[d] = patch.knot_vector(d).find_span(0.5);
                N[d]    = patch.knot_vector(d).values(span[d], 0.5, 0)[0];
              }
            const unsigned int n_3 = patch.n_control_points(2);
            for (unsigned int k = 0; k < n_3; ++k)
              for (unsigned int j = 0; j < N[1].size(); ++j)
                for (unsigned int i = 0; i < N[0].size(); ++i)
                  if (N[0][i] * N[1][j] > 1e-14)
                    weights.emplace_back(
                      space.control_point(
                        b,
                        patch.index(
                          {{patch.knot_vector(0).first_function(span[0]) + i,
                            patch.knot_vector(1).first_function(span[1]) + j,
                            k}})),
                      N[0][i] * N[1][j] / n_3);
            for (unsigned int c = 0; c < 2; ++c)
              {
                unsigned int pivot = 0;
                for (unsigned int k = 1; k < weights.size(); ++k)
                  if (!constraints.is_constrained(3 * weights[k].first + c) &&
                      (constraints.is_constrained(3 * weights[pivot].first +
                                                  c) ||
                       weights[k].second > weights[pivot].second + 1e-12))
                    pivot = k;
                const unsigned int line = 3 * weights[pivot].first + c;
                constraints.add_line(line);
                for (unsigned int k = 0; k < weights.size(); ++k)
                  if (k != pivot)
                    constraints.add_entry(line,
                                          3 * weights[k].first + c,
                                          -weights[k].second /
                                            weights[pivot].second);
              }
          }
      }
    constraints.close();
    return constraints;
  }



  dealii::Vector<double>
  straight_bundles(const FabricCell    &cell,
                   const IGASpace<3>   &space,
                   const MacroUnknowns &macro,
                   const double         offset)
  {
    dealii::Vector<double> w(macro.n_unknowns());
    for (unsigned int b = 0; b < space.n_patches(); ++b)
      for (unsigned int l = 0; l < space.patch(b).n_control_points(); ++l)
        w[3 * space.control_point(b, l) + 2] =
          0.5 * cell.bundles()[b].side * offset;
    w[macro.weaving_offset()] = offset;
    return w;
  }
} // namespace NPT
