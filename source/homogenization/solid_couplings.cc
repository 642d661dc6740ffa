// SPDX-License-Identifier: LGPL-2.1-or-later
// Couplings of a cell that is periodic in three directions.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/homogenization/orbit_constraints.h>
#include <npt_dealii/homogenization/point_finder.h>
#include <npt_dealii/homogenization/solid_couplings.h>

#include <algorithm>
#include <map>
#include <string>

namespace NPT
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
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



    class SolidCouplings
    {
    public:
      using Affine = OrbitConstraints::Affine;

      SolidCouplings(const IGASpace<3>                 &space,
                     const SolidMacroUnknowns          &macro,
                     const std::array<Tensor<1, 3>, 3> &periods)
        : points_(space.control_points())
        , periods_(periods)
        , finder_(numbered(points_),
                  1e-7 * std::min({periods[0].norm(),
                                   periods[1].norm(),
                                   periods[2].norm()}))
        , orbits_(macro.first,
                  Affine(SolidMacroUnknowns::n_macro,
                         std::min({periods[0].norm(),
                                   periods[1].norm(),
                                   periods[2].norm()})))
      {}

      // Relate a face to its partners, over all neighboring cells.
      void
      relate_to_opposite(const std::vector<unsigned int> &face)
      {
        bool has_partner = false;
        for (int n = 0; n < 27; ++n)
          {
            if (n == 13)
              continue; // the cell itself
            const Tensor<1, 3> L = (n % 3 - 1.) * periods_[0] +
                                   (n / 3 % 3 - 1.) * periods_[1] +
                                   (n / 9 - 1.) * periods_[2];
            std::vector<unsigned int> partners;
            for (const unsigned int A : face)
              {
                const int B = finder_.find(points_[A] + L);
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
          throw_no_partner(face);
      }

      // Every control point follows the one of the first layer below it.
      void
      make_uniform(const unsigned int direction)
      {
        const Tensor<1, 3> e = periods_[direction] / periods_[direction].norm();
        double             lowest = e * points_[0];
        for (const Point<3> &P : points_)
          lowest = std::min(lowest, e * P);
        for (unsigned int A = 0; A < points_.size(); ++A)
          {
            const int B =
              finder_.find(points_[A] - (e * points_[A] - lowest) * e);
            AssertThrow(B >= 0,
                        dealii::ExcMessage(
                          "A uniform direction needs control points in "
                          "layers."));
            relate(A, B);
          }
      }

      // w = -w of one point.
      void
      hold_point()
      {
        for (unsigned int i = 0; i < 3; ++i)
          orbits_.relate(
            i, -1., i, Affine(SolidMacroUnknowns::n_macro, 0.), "held point");
      }

      dealii::AffineConstraints<double>
      constraints() const
      {
        dealii::AffineConstraints<double> result;
        orbits_.write(result);
        result.close();
        return result;
      }

    private:
      static std::vector<PointFinder::Entry>
      numbered(const std::vector<Point<3>> &points)
      {
        std::vector<PointFinder::Entry> entries;
        for (unsigned int A = 0; A < points.size(); ++A)
          entries.emplace_back(points[A], A);
        return entries;
      }

      void
      relate(const unsigned int B, const unsigned int A)
      {
        const Tensor<1, 3> L = points_[B] - points_[A];
        for (unsigned int i = 0; i < 3; ++i)
          {
            Affine affine(SolidMacroUnknowns::n_macro, 0.);
            for (unsigned int J = 0; J < 3; ++J)
              affine[3 * i + J] = L[J];
            orbits_.relate(3 * B + i, 1., 3 * A + i, affine, "periodicity");
          }
      }

      [[noreturn]] void
      throw_no_partner(const std::vector<unsigned int> &face) const
      {
        Point<3> center;
        for (const unsigned int A : face)
          center += points_[A] / static_cast<double>(face.size());
        throw InputError(
          "The cell is not periodic: its boundary face about (" +
          std::to_string(center[0]) + ", " + std::to_string(center[1]) + ", " +
          std::to_string(center[2]) +
          ") mm has no opposite face with the same control points.");
      }

      const std::vector<Point<3>>       &points_;
      const std::array<Tensor<1, 3>, 3> &periods_;
      const PointFinder                  finder_;
      OrbitConstraints                   orbits_;
    };
  } // namespace



  dealii::AffineConstraints<double>
  make_solid_couplings(const IGASpace<3>                 &space,
                       const SolidMacroUnknowns          &macro,
                       const std::array<Tensor<1, 3>, 3> &periods,
                       const int                          uniform_direction)
  {
    SolidCouplings couplings(space, macro, periods);
    for (const std::vector<unsigned int> &face : outer_faces(space))
      couplings.relate_to_opposite(face);
    if (uniform_direction >= 0)
      couplings.make_uniform(uniform_direction);
    couplings.hold_point();
    return couplings.constraints();
  }
} // namespace NPT
