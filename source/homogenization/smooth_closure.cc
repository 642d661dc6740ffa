// SPDX-License-Identifier: LGPL-2.1-or-later
// The smooth closure (A18).

#include <npt_dealii/homogenization/macro_unknowns.h>
#include <npt_dealii/homogenization/smooth_closure.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <string>

namespace NPT
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    const std::string name = "smooth closure";

    // alpha of X_0 = alpha X_1 + (1 - alpha) X_{-1}, or a negative number if
    // X_{-1} lies on the same side as X_1: then an operation maps the end of
    // the bundle onto itself.
    double
    share_of_next(const Point<3> &before,
                  const Point<3> &seam,
                  const Point<3> &after)
    {
      const Tensor<1, 3> a = seam - before, b = after - seam;
      if (a * b < 0.)
        return -1.;
      const double alpha = a.norm() / (a.norm() + b.norm());
      AssertThrow((alpha * b - (1. - alpha) * a).norm() <
                    1e-9 * (a.norm() + b.norm()),
                  dealii::ExcMessage("Bundles must be straight at a smooth "
                                     "seam in the reference configuration."));
      return alpha;
    }



    // Control point of a patch next to its control point l in a direction.
    unsigned int
    neighbor(const IGASpace<3> &space,
             const unsigned int b,
             const unsigned int l,
             const unsigned int d,
             const int          step)
    {
      const NURBSPatch<3> &patch = space.patch(b);
      auto                 next  = patch.multi_index(l);
      next[d] += step;
      const unsigned int n = patch.index(next);
      AssertThrow(std::abs(patch.weights()[n] - patch.weights()[l]) <
                    1e-9 * patch.weights()[l],
                  dealii::ExcMessage("A smooth closure needs weights that do "
                                     "not change along the bundle."));
      return space.control_point(b, n);
    }



    // Places in a direction of the control points where the patch is only C0.
    std::vector<unsigned int>
    joints_of(const KnotVector &knots)
    {
      std::vector<unsigned int> joints;
      for (unsigned int k = 1; k + 1 < knots.breaks().size(); ++k)
        if (knots.multiplicity(knots.breaks()[k]) >= knots.degree())
          joints.push_back(knots.first_function(k));
      return joints;
    }



    // Inner neighbors of the control points at both ends of a direction.
    using InnerNeighbors = std::map<unsigned int, unsigned int>;

    // Add the conditions between the crossings of a bundle, and remember the
    // inner neighbors at its ends.
    void
    join_crossings(const IGASpace<3> &space,
                   const unsigned int b,
                   const unsigned int d,
                   InnerNeighbors    &inner,
                   OrbitConstraints  &orbits)
    {
      const auto                     &X      = space.control_points();
      const NURBSPatch<3>            &patch  = space.patch(b);
      const std::vector<unsigned int> joints = joints_of(patch.knot_vector(d));
      const OrbitConstraints::Affine  none(MacroUnknowns::n_macro, 0.);
      AssertThrow(patch.knot_vector(d).degree() >= 2,
                  dealii::ExcMessage("A smooth closure needs degree 2."));
      for (unsigned int l = 0; l < patch.n_control_points(); ++l)
        {
          const unsigned int at = patch.multi_index(l)[d];
          const unsigned int A  = space.control_point(b, l);
          if (at == 0)
            inner[A] = neighbor(space, b, l, d, 1);
          else if (at == patch.n_control_points(d) - 1)
            inner[A] = neighbor(space, b, l, d, -1);
          else if (std::find(joints.begin(), joints.end(), at) != joints.end())
            {
              const unsigned int before = neighbor(space, b, l, d, -1),
                                 after  = neighbor(space, b, l, d, 1);
              const double alpha = share_of_next(X[before], X[A], X[after]);
              for (unsigned int i = 0; i < 3; ++i)
                orbits.combine(3 * A + i,
                               {{alpha, 3 * after + i},
                                {1. - alpha, 3 * before + i}},
                               none,
                               name + " between crossings");
            }
        }
    }



    // Continue the end of a bundle at control point B by all operations that
    // take it to an end; adds the control points that are closed by this.
    void
    close_end(const FabricCell         &cell,
              const IGASpace<3>        &space,
              const BundlePointFinder  &finder,
              const FiberBundle::Family family,
              const unsigned int        B,
              const InnerNeighbors     &inner,
              const JumpOfImage        &jump,
              std::set<unsigned int>   &closed,
              OrbitConstraints         &orbits)
    {
      const auto        &X       = space.control_points();
      const unsigned int B_inner = inner.at(B);
      for (const SymmetryOperation &g : cell.operations())
        {
          const int A = finder.find(family, g(X[B]));
          if (A < 0 || inner.count(A) == 0)
            continue;
          const unsigned int A_inner = inner.at(A);
          const double alpha = share_of_next(g(X[B_inner]), X[A], X[A_inner]);
          if (alpha < 0.)
            continue;
          for (unsigned int i = 0; i < 3; ++i)
            {
              OrbitConstraints::Affine affine = jump(B_inner, g, i);
              for (double &value : affine)
                value *= 1. - alpha;
              orbits.combine(3 * A + i,
                             {{alpha, 3 * A_inner + i},
                              {(1. - alpha) * g.Q[i], 3 * B_inner + i}},
                             affine,
                             name + " by: " + g.name);
            }
          closed.insert(A);
        }
    }
  } // namespace



  unsigned int
  n_closed_directions(const FiberBundle &bundle)
  {
    return bundle.family == FiberBundle::Family::ply ? 2 : 1;
  }



  unsigned int
  nearest_seam(const NURBSPatch<3> &patch,
               const unsigned int   n_closed,
               const unsigned int   l)
  {
    auto place = patch.multi_index(l);
    for (unsigned int d = 0; d < n_closed; ++d)
      {
        std::vector<unsigned int> seams = joints_of(patch.knot_vector(d));
        seams.push_back(0);
        seams.push_back(patch.n_control_points(d) - 1);
        for (const unsigned int seam : seams)
          if (place[d] + 1 == seam || place[d] == seam + 1)
            {
              place[d] = seam;
              break;
            }
      }
    return patch.index(place);
  }



  void
  close_smoothly(const FabricCell        &cell,
                 const IGASpace<3>       &space,
                 const BundlePointFinder &finder,
                 const JumpOfImage       &jump,
                 OrbitConstraints        &orbits)
  {
    InnerNeighbors inner[2];
    for (unsigned int b = 0; b < space.n_patches(); ++b)
      for (unsigned int d = 0; d < n_closed_directions(cell.bundles()[b]); ++d)
        join_crossings(space, b, d, inner[d], orbits);

    std::set<unsigned int> closed[2];
    for (unsigned int b = 0; b < space.n_patches(); ++b)
      for (unsigned int d = 0; d < n_closed_directions(cell.bundles()[b]); ++d)
        for (unsigned int l = 0; l < space.patch(b).n_control_points(); ++l)
          {
            const unsigned int B = space.control_point(b, l);
            if (inner[d].count(B) > 0)
              close_end(cell,
                        space,
                        finder,
                        cell.bundles()[b].family,
                        B,
                        inner[d],
                        jump,
                        closed[d],
                        orbits);
          }
    for (unsigned int d = 0; d < 2; ++d)
      if (closed[d].size() < inner[d].size())
        throw std::logic_error("No operation of the cell continues some end "
                               "of a bundle.");
  }
} // namespace NPT
