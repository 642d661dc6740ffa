// SPDX-License-Identifier: LGPL-2.1-or-later
// Couplings of a fabric cell.

#include <npt_dealii/homogenization/periodicity.h>

#include <deal.II/numerics/rtree.h>

#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>

#include <cmath>
#include <set>

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
        : tolerance_(1e-7 * cell.parameters().crossing_spacing.smaller())
      {
        std::vector<Entry> entries[3];
        for (unsigned int b = 0; b < space.n_patches(); ++b)
          boxes_[static_cast<int>(cell.bundles()[b].family)].emplace_back(
            Point<3>(1e99, 1e99, 1e99), Point<3>(-1e99, -1e99, -1e99));
        unsigned int n_of_family[3] = {0, 0, 0};
        for (unsigned int b = 0; b < space.n_patches(); ++b)
          {
            const int f   = static_cast<int>(cell.bundles()[b].family);
            auto     &box = boxes_[f][n_of_family[f]++];
            for (unsigned int l = 0; l < space.patch(b).n_control_points(); ++l)
              {
                const unsigned int A = space.control_point(b, l);
                const auto        &P = space.control_points()[A];
                entries[f].emplace_back(BPoint(P[0], P[1], P[2]), A);
                for (unsigned int i = 0; i < 3; ++i)
                  {
                    box.first[i]  = std::min(box.first[i], P[i]);
                    box.second[i] = std::max(box.second[i], P[i]);
                  }
              }
          }
        for (unsigned int f = 0; f < 3; ++f)
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

      // Whether a position lies inside the box of a bundle of the base cell.
      bool
      inside_base_cell(const FiberBundle::Family family,
                       const Point<3>           &P) const
      {
        for (const auto &box : boxes_[static_cast<int>(family)])
          {
            bool inside = true;
            for (unsigned int i = 0; i < 3; ++i)
              inside = inside && P[i] > box.first[i] + tolerance_ &&
                       P[i] < box.second[i] - tolerance_;
            if (inside)
              return true;
          }
        return false;
      }

    private:
      const double                               tolerance_;
      bgi::rtree<Entry, bgi::rstar<16>>          trees_[3];
      std::vector<std::pair<Point<3>, Point<3>>> boxes_[3];
    };
  } // namespace



  dealii::AffineConstraints<double>
  make_couplings(const FabricCell                &cell,
                 const IGASpace<3>               &space,
                 const MacroUnknowns             &macro,
                 const std::vector<GhostSurface> &ghosts,
                 const std::vector<Point<3>>     &woven)
  {
    using Affine = OrbitConstraints::Affine;
    OrbitConstraints  orbits(macro.first, MacroUnknowns::n_macro);
    const PointFinder finder(cell, space);

    std::vector<bool> mode_allowed;
    for (unsigned int n = 0; n < MacroUnknowns::n_modes; ++n)
      mode_allowed.push_back(cell.represents_mode(n));

    // w_m(gY) - Q w_m(Y) per unit of each macro unknown.
    const auto jump = [&](const unsigned int       A,
                          const SymmetryOperation &g,
                          const unsigned int       i) {
      const Point<3> Y = woven.empty() ? space.control_points()[A] : woven[A];
      const Point<3> Z = g(Y);
      Affine         affine(MacroUnknowns::n_macro, 0.);
      for (unsigned int n = 0; n < MacroUnknowns::n_modes; ++n)
        if (mode_allowed[n])
          affine[n] = macroscopic_displacement(n, Z)[i] -
                      g.Q[i] * macroscopic_displacement(n, Y)[i];
      return affine;
    };

    for (unsigned int b = 0; b < space.n_patches(); ++b)
      {
        const FiberBundle &bundle = cell.bundles()[b];
        for (unsigned int l = 0; l < space.patch(b).n_control_points(); ++l)
          {
            const unsigned int A = space.control_point(b, l);
            for (const SymmetryOperation &g : cell.operations())
              {
                const Point<3> image = g(space.control_points()[A]);
                const int      B     = finder.find(bundle.family, image);
                if (B < 0)
                  {
                    // The image lies in a neighboring cell, or else the mesh
                    // lacks the symmetry.
                    if (finder.inside_base_cell(bundle.family, image))
                      throw std::logic_error(
                        "The control points of bundle " + std::to_string(b) +
                        " are not mapped onto control points by: " + g.name +
                        ".");
                    continue;
                  }
                for (unsigned int i = 0; i < 3; ++i)
                  orbits.relate(
                    3 * B + i, g.Q[i], 3 * A + i, jump(A, g, i), g.name);
              }
          }
      }
    if (cell.needs_vertical_pin())
      {
        // Vertical forces on the whole cell are in equilibrium, so this pin is
        // free of reactions: w3 = -w3.
        const unsigned int A = space.control_point(0, 0);
        orbits.relate(3 * A + 2,
                      -1.,
                      3 * A + 2,
                      Affine(MacroUnknowns::n_macro, 0.),
                      "vertical pin");
      }

    dealii::AffineConstraints<double> constraints;
    orbits.write(constraints);

    for (const GhostSurface &ghost : ghosts)
      for (unsigned int l = 0; l < ghost.control_points.size(); ++l)
        for (unsigned int i = 0; i < 3; ++i)
          {
            const unsigned int A    = ghost.control_points[l];
            const unsigned int line = ghost.first_unknown + 3 * l + i;
            constraints.add_line(line);
            constraints.add_entry(line, 3 * A + i, ghost.operation.Q[i]);
            const Affine affine = jump(A, ghost.operation, i);
            for (unsigned int n = 0; n < MacroUnknowns::n_modes; ++n)
              if (std::abs(affine[n]) > 1e-14)
                constraints.add_entry(line, macro.mode(n), affine[n]);
            if (i == 2)
              constraints.add_entry(line,
                                    macro.weaving_offset(),
                                    ghost.offset_sign);
          }

    if (!cell.has_two_fold_axis())
      {
        // Pins w = w_m in plane of each body's center, mean over the thickness:
        // a weighted sum of control points, solved for its largest term. (w = 0
        // would hold bundles whose centers are apart against the macroscopic
        // shear.)
        std::set<unsigned int> pinned;
        for (unsigned int b = 0; b < space.n_patches(); ++b)
          {
            if (!pinned.insert(space.body(b)).second)
              continue;
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
            const Point<3> center = patch.value(Point<3>(0.5, 0.5, 0.5));
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
                for (unsigned int n = 0; n < MacroUnknowns::n_modes; ++n)
                  {
                    const double value = macroscopic_displacement(n, center)[c];
                    if (mode_allowed[n] && std::abs(value) > 1e-14)
                      constraints.add_entry(line,
                                            macro.mode(n),
                                            value / weights[pivot].second);
                  }
              }
          }
      }
    constraints.close();
    return constraints;
  }
} // namespace NPT
