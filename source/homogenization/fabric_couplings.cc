// SPDX-License-Identifier: LGPL-2.1-or-later
// Couplings of a fabric cell.

#include <npt_dealii/homogenization/fabric_couplings.h>

#include <deal.II/numerics/rtree.h>

#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>

#include <algorithm>
#include <cmath>
#include <map>
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



    // Directions of a bundle in which it goes on in neighboring cells.
    unsigned int
    n_closed_directions(const FiberBundle &bundle)
    {
      return bundle.family == FiberBundle::Family::ply ? 2 : 1;
    }



    // The smooth closure (A18): at periodic faces through the operations of the
    // cell, between crossings inside the patch.
    template <typename Jump>
    void
    close_smoothly(const FabricCell  &cell,
                   const IGASpace<3> &space,
                   const PointFinder &finder,
                   const Jump        &jump,
                   OrbitConstraints  &orbits)
    {
      using Affine        = OrbitConstraints::Affine;
      const auto       &X = space.control_points();
      const Affine      none(MacroUnknowns::n_macro, 0.);
      const std::string name = "smooth closure";

      // alpha of X_0 = alpha X_1 + (1 - alpha) X_{-1}, or a negative number if
      // X_{-1} lies on the same side as X_1: then an operation maps the end of
      // the bundle onto itself.
      const auto share = [&](const Point<3> &before,
                             const Point<3> &seam,
                             const Point<3> &after) {
        const Tensor<1, 3> a = seam - before, b = after - seam;
        if (a * b < 0.)
          return -1.;
        const double alpha = a.norm() / (a.norm() + b.norm());
        AssertThrow((alpha * b - (1. - alpha) * a).norm() <
                      1e-9 * (a.norm() + b.norm()),
                    dealii::ExcMessage("Bundles must be straight at a smooth "
                                       "seam in the reference configuration."));
        return alpha;
      };

      // Inner neighbors of the control points at both ends, by direction, and
      // the conditions between crossings.
      std::map<unsigned int, unsigned int> inner[2];
      for (unsigned int b = 0; b < space.n_patches(); ++b)
        for (unsigned int d = 0; d < n_closed_directions(cell.bundles()[b]);
             ++d)
          {
            const NURBSPatch<3> &patch  = space.patch(b);
            const KnotVector    &knots  = patch.knot_vector(d);
            const unsigned int   last   = patch.n_control_points(d) - 1;
            const unsigned int   degree = knots.degree();
            AssertThrow(degree >= 2,
                        dealii::ExcMessage("A smooth closure needs degree 2."));
            std::vector<unsigned int> joints;
            for (unsigned int k = 1; k + 1 < knots.breaks().size(); ++k)
              if (knots.multiplicity(knots.breaks()[k]) >= degree)
                joints.push_back(knots.first_function(k));
            for (unsigned int l = 0; l < patch.n_control_points(); ++l)
              {
                const auto at       = patch.multi_index(l);
                const auto neighbor = [&](const int step) {
                  auto next = at;
                  next[d] += step;
                  const unsigned int n = patch.index(next);
                  AssertThrow(std::abs(patch.weights()[n] -
                                       patch.weights()[l]) <
                                1e-9 * patch.weights()[l],
                              dealii::ExcMessage(
                                "A smooth closure needs weights that do not "
                                "change along the bundle."));
                  return space.control_point(b, n);
                };
                const unsigned int A = space.control_point(b, l);
                if (at[d] == 0)
                  inner[d][A] = neighbor(1);
                else if (at[d] == last)
                  inner[d][A] = neighbor(-1);
                else if (std::find(joints.begin(), joints.end(), at[d]) !=
                         joints.end())
                  {
                    const unsigned int before = neighbor(-1),
                                       after  = neighbor(1);
                    const double alpha = share(X[before], X[A], X[after]);
                    for (unsigned int i = 0; i < 3; ++i)
                      orbits.combine(3 * A + i,
                                     {{alpha, 3 * after + i},
                                      {1. - alpha, 3 * before + i}},
                                     none,
                                     name + " between crossings");
                  }
              }
          }

      std::set<unsigned int> closed[2];
      for (unsigned int b = 0; b < space.n_patches(); ++b)
        for (unsigned int d = 0; d < n_closed_directions(cell.bundles()[b]);
             ++d)
          for (unsigned int l = 0; l < space.patch(b).n_control_points(); ++l)
            {
              const unsigned int B = space.control_point(b, l);
              if (inner[d].count(B) == 0)
                continue;
              const unsigned int B_inner = inner[d].at(B);
              for (const SymmetryOperation &g : cell.operations())
                {
                  const int A = finder.find(cell.bundles()[b].family, g(X[B]));
                  if (A < 0 || inner[d].count(A) == 0)
                    continue;
                  const unsigned int A_inner = inner[d].at(A);
                  const double alpha = share(g(X[B_inner]), X[A], X[A_inner]);
                  if (alpha < 0.)
                    continue;
                  for (unsigned int i = 0; i < 3; ++i)
                    {
                      Affine affine = jump(B_inner, g, i);
                      for (double &value : affine)
                        value *= 1. - alpha;
                      orbits.combine(3 * A + i,
                                     {{alpha, 3 * A_inner + i},
                                      {(1. - alpha) * g.Q[i], 3 * B_inner + i}},
                                     affine,
                                     name + " by: " + g.name);
                    }
                  closed[d].insert(A);
                }
            }
      for (unsigned int d = 0; d < 2; ++d)
        if (closed[d].size() < inner[d].size())
          throw std::logic_error("No operation of the cell continues some end "
                                 "of a bundle.");
    }
  } // namespace



  dealii::AffineConstraints<double>
  make_couplings(const FabricCell                 &cell,
                 const IGASpace<3>                &space,
                 const MacroUnknowns              &macro,
                 const std::vector<PeriodicImage> &images,
                 const std::vector<Point<3>>      &woven,
                 const Pins                       &pins)
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
      Affine         affine(MacroUnknowns::n_macro, 0.);
      for (unsigned int n = 0; n < MacroUnknowns::n_modes; ++n)
        if (mode_allowed[n])
          affine[n] = macroscopic_jump(n, g, Y)[i];
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
    const bool smooth = cell.parameters().smooth_closure;
    if (smooth)
      close_smoothly(cell, space, finder, jump, orbits);
    if (pins.used && cell.needs_vertical_pin())
      {
        // Vertical forces on the whole cell are in equilibrium, so this pin is
        // free of reactions: w3 = -w3. (A18) has use for the ends of a bundle.
        std::array<unsigned int, 3> at = pins.vertical;
        for (unsigned int d = 0;
             smooth && d < n_closed_directions(cell.bundles()[0]);
             ++d)
          at[d] = std::min(std::max(at[d], 1u),
                           space.patch(0).n_control_points(d) - 2);
        const unsigned int A = space.control_point(0, space.patch(0).index(at));
        orbits.relate(3 * A + 2,
                      -1.,
                      3 * A + 2,
                      Affine(MacroUnknowns::n_macro, 0.),
                      "vertical pin");
      }

    dealii::AffineConstraints<double> constraints;
    orbits.write(constraints);

    for (const PeriodicImage &periodic_image : images)
      for (unsigned int l = 0; l < periodic_image.control_points.size(); ++l)
        for (unsigned int i = 0; i < 3; ++i)
          {
            const unsigned int A    = periodic_image.control_points[l];
            const unsigned int line = periodic_image.first_unknown + 3 * l + i;
            constraints.add_line(line);
            constraints.add_entry(line,
                                  3 * A + i,
                                  periodic_image.operation.Q[i]);
            const Affine affine = jump(A, periodic_image.operation, i);
            for (unsigned int n = 0; n < MacroUnknowns::n_modes; ++n)
              if (std::abs(affine[n]) > 1e-14)
                constraints.add_entry(line, macro.mode(n), affine[n]);
            if (i == 2)
              constraints.add_entry(line,
                                    macro.weaving_offset(),
                                    periodic_image.offset_sign);
          }

    if (pins.used && !cell.has_two_fold_axis())
      {
        // Pins w = w_m in plane of each body on a 2-fold axis, mean over the
        // thickness: a weighted sum of control points, reduced to free unknowns
        // and solved for its largest term. (w = 0 would hold bundles whose
        // pins are apart against the macroscopic shear. The middle of a bundle
        // between two crossings is on no axis: sticking friction would push
        // against a pin there in bending and torsion.)
        std::set<unsigned int> pinned;
        for (unsigned int b = 0; b < space.n_patches(); ++b)
          {
            if (!pinned.insert(space.body(b)).second)
              continue;
            const NURBSPatch<3>        &patch = space.patch(b);
            const std::array<double, 2> place = pins.in_plane.value_or(
              std::array<double, 2>{{cell.axis_parameter(b), 0.5}});
            std::vector<std::pair<unsigned int, double>> weights;
            std::array<unsigned int, 2>                  span;
            std::array<std::vector<double>, 2>           N;
            for (unsigned int d = 0; d < 2; ++d)
              {
                span[d] = patch.knot_vector(d).find_span(place[d]);
                N[d]    = patch.knot_vector(d).values(span[d], place[d], 0)[0];
              }
            const unsigned int n_3 = patch.n_control_points(2);
            for (unsigned int k = 0; k < n_3; ++k)
              for (unsigned int j = 0; j < N[1].size(); ++j)
                for (unsigned int i = 0; i < N[0].size(); ++i)
                  weights.emplace_back(
                    space.control_point(
                      b,
                      patch.index(
                        {{patch.knot_vector(0).first_function(span[0]) + i,
                          patch.knot_vector(1).first_function(span[1]) + j,
                          k}})),
                    N[0][i] * N[1][j] / n_3);
            // The axis keeps the woven height, which enters w_m.
            Point<3> center = patch.value(Point<3>(place[0], place[1], 0.5));
            center[2]       = 0.;
            for (const auto &[A, weight] : weights)
              center[2] +=
                weight *
                (woven.empty() ? space.control_points()[A][2] : woven[A][2]);
            for (unsigned int c = 0; c < 2; ++c)
              {
                // sum of factors times unknowns = 0
                std::map<unsigned int, double> sum;
                for (const auto &[A, weight] : weights)
                  if (constraints.is_constrained(3 * A + c))
                    for (const auto &entry :
                         *constraints.get_constraint_entries(3 * A + c))
                      sum[entry.first] += weight * entry.second;
                  else
                    sum[3 * A + c] += weight;
                for (unsigned int n = 0; n < MacroUnknowns::n_modes; ++n)
                  if (mode_allowed[n])
                    sum[macro.mode(n)] -=
                      macroscopic_displacement(n, center)[c];
                auto pivot = sum.begin();
                for (auto term = sum.begin(); term != sum.end(); ++term)
                  if (term->first < macro.first &&
                      term->second > pivot->second + 1e-12)
                    pivot = term;
                constraints.add_line(pivot->first);
                for (const auto &[unknown, factor] : sum)
                  if (unknown != pivot->first && std::abs(factor) > 1e-14)
                    constraints.add_entry(pivot->first,
                                          unknown,
                                          -factor / pivot->second);
              }
          }
      }
    constraints.close();
    return constraints;
  }
} // namespace NPT
