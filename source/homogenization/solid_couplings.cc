// SPDX-License-Identifier: LGPL-2.1-or-later
// Couplings of a cell that is periodic in three directions.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/homogenization/orbit_constraints.h>
#include <npt_dealii/homogenization/solid_couplings.h>

#include <deal.II/numerics/rtree.h>

#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>

#include <algorithm>
#include <map>
#include <string>

namespace NPT
{
  using dealii::Point;
  using dealii::Tensor;
  namespace bgi = boost::geometry::index;

  namespace
  {
    using BPoint =
      boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;
    using Entry = std::pair<BPoint, unsigned int>;

    // Finds control points by reference position.
    class PointFinder
    {
    public:
      PointFinder(const std::vector<Point<3>> &points, const double tolerance)
        : tolerance_(tolerance)
      {
        std::vector<Entry> entries;
        for (unsigned int A = 0; A < points.size(); ++A)
          entries.emplace_back(BPoint(points[A][0], points[A][1], points[A][2]),
                               A);
        tree_ =
          bgi::rtree<Entry, bgi::rstar<16>>(entries.begin(), entries.end());
      }

      int
      find(const Point<3> &P) const
      {
        const double       d = tolerance_;
        std::vector<Entry> found;
        tree_.query(bgi::intersects(boost::geometry::model::box<BPoint>(
                      BPoint(P[0] - d, P[1] - d, P[2] - d),
                      BPoint(P[0] + d, P[1] + d, P[2] + d))),
                    std::back_inserter(found));
        return found.empty() ? -1 : static_cast<int>(found[0].second);
      }

    private:
      const double                      tolerance_;
      bgi::rtree<Entry, bgi::rstar<16>> tree_;
    };



    // Control points of the patch faces that no other patch shares.
    std::vector<std::vector<unsigned int>>
    outer_faces(const IGASpace<3> &space)
    {
      std::map<std::vector<unsigned int>, unsigned int> count;
      for (unsigned int b = 0; b < space.n_patches(); ++b)
        for (unsigned int d = 0; d < 3; ++d)
          for (unsigned int side = 0; side < 2; ++side)
            {
              const NURBSPatch<3>      &patch = space.patch(b);
              std::vector<unsigned int> face;
              for (unsigned int l = 0; l < patch.n_control_points(); ++l)
                if (patch.multi_index(l)[d] ==
                    side * (patch.n_control_points(d) - 1))
                  face.push_back(space.control_point(b, l));
              std::sort(face.begin(), face.end());
              ++count[face];
            }
      std::vector<std::vector<unsigned int>> faces;
      for (const auto &[face, n] : count)
        if (n == 1)
          faces.push_back(face);
      return faces;
    }
  } // namespace



  dealii::AffineConstraints<double>
  make_solid_couplings(const IGASpace<3>                 &space,
                       const SolidMacroUnknowns          &macro,
                       const std::array<Tensor<1, 3>, 3> &periods,
                       const int                          uniform_direction)
  {
    using Affine = OrbitConstraints::Affine;
    OrbitConstraints orbits(macro.first, SolidMacroUnknowns::n_macro);
    const auto      &points = space.control_points();
    const double     size =
      std::min({periods[0].norm(), periods[1].norm(), periods[2].norm()});
    const PointFinder finder(points, 1e-7 * size);

    const auto relate = [&](const unsigned int B, const unsigned int A) {
      const Tensor<1, 3> L = points[B] - points[A];
      for (unsigned int i = 0; i < 3; ++i)
        {
          Affine affine(SolidMacroUnknowns::n_macro, 0.);
          for (unsigned int J = 0; J < 3; ++J)
            affine[3 * i + J] = L[J];
          orbits.relate(3 * B + i, 1., 3 * A + i, affine, "periodicity");
        }
    };

    // Outer faces and their partners, over all neighboring cells.
    for (const std::vector<unsigned int> &face : outer_faces(space))
      {
        bool has_partner = false;
        for (int n = 0; n < 27; ++n)
          {
            if (n == 13)
              continue; // the cell itself
            const Tensor<1, 3> L = (n % 3 - 1.) * periods[0] +
                                   (n / 3 % 3 - 1.) * periods[1] +
                                   (n / 9 - 1.) * periods[2];
            std::vector<unsigned int> partners;
            for (const unsigned int A : face)
              {
                const int B = finder.find(points[A] + L);
                if (B < 0)
                  break;
                partners.push_back(B);
              }
            if (partners.size() < face.size())
              continue;
            has_partner = true;
            for (unsigned int k = 0; k < face.size(); ++k)
              relate(partners[k], face[k]);
          }
        if (!has_partner)
          {
            Point<3> center;
            for (const unsigned int A : face)
              center += points[A] / static_cast<double>(face.size());
            throw InputError(
              "The cell is not periodic: its boundary face about (" +
              std::to_string(center[0]) + ", " + std::to_string(center[1]) +
              ", " + std::to_string(center[2]) +
              ") mm has no opposite face with the same control points.");
          }
      }

    if (uniform_direction >= 0)
      {
        // Every control point follows the one of the first layer below it.
        const Tensor<1, 3> e =
          periods[uniform_direction] / periods[uniform_direction].norm();
        double lowest = e * points[0];
        for (const Point<3> &P : points)
          lowest = std::min(lowest, e * P);
        for (unsigned int A = 0; A < points.size(); ++A)
          {
            const int B = finder.find(points[A] - (e * points[A] - lowest) * e);
            AssertThrow(B >= 0,
                        dealii::ExcMessage(
                          "A uniform direction needs control points in "
                          "layers."));
            relate(A, B);
          }
      }

    // The held point: w = -w.
    for (unsigned int i = 0; i < 3; ++i)
      orbits.relate(
        i, -1., i, Affine(SolidMacroUnknowns::n_macro, 0.), "held point");

    dealii::AffineConstraints<double> constraints;
    orbits.write(constraints);
    constraints.close();
    return constraints;
  }
} // namespace NPT
