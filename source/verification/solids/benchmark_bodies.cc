// SPDX-License-Identifier: LGPL-2.1-or-later
// Control points of the bodies of solid benchmarks.

#include <npt_dealii/verification/solids/benchmark_bodies.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace NPT
{
  using dealii::Point;

  namespace
  {
    using KnotVectors = std::array<KnotVector, 3>;

    // Fill the lattice of control points of one span per direction.
    NURBSPatch<3>
    make_patch(const std::array<unsigned int, 3>             &degrees,
               const std::function<Point<3>(const std::array<unsigned int, 3> &,
                                            double &weight)> &control_point)
    {
      std::vector<Point<3>>       points;
      std::vector<double>         weights;
      std::array<unsigned int, 3> i;
      for (i[2] = 0; i[2] <= degrees[2]; ++i[2])
        for (i[1] = 0; i[1] <= degrees[1]; ++i[1])
          for (i[0] = 0; i[0] <= degrees[0]; ++i[0])
            {
              double weight = 1.;
              points.push_back(control_point(i, weight));
              weights.push_back(weight);
            }
      return NURBSPatch<3>(KnotVectors{{KnotVector::uniform(degrees[0], 1),
                                        KnotVector::uniform(degrees[1], 1),
                                        KnotVector::uniform(degrees[2], 1)}},
                           points,
                           weights);
    }

    // Control point k = 0, 1, 2 of a circular arc of unit radius: the middle
    // one is where the end tangents meet, its weight the cosine of half the
    // opening angle.
    Point<2>
    arc(const double       begin,
        const double       end,
        const unsigned int k,
        double            &weight)
    {
      const double half  = 0.5 * (end - begin);
      const double angle = begin + k * half;
      const double r     = k == 1 ? 1. / std::cos(half) : 1.;
      weight             = k == 1 ? std::cos(half) : 1.;
      Point<2> P(r * std::cos(angle), r * std::sin(angle));
      // Exact zeros on the axes, where control points are held.
      for (unsigned int d = 0; d < 2; ++d)
        if (std::abs(P[d]) < 1e-14)
          P[d] = 0.;
      return P;
    }
  } // namespace



  std::vector<NURBSPatch<3>>
  quarter_plate_with_hole(const double radius,
                          const double half_width,
                          const double thickness)
  {
    const double               eighth = std::atan(1.);
    std::vector<NURBSPatch<3>> patches;
    for (unsigned int half = 0; half < 2; ++half)
      patches.push_back(make_patch(
        {{1, 2, 1}}, [&](const std::array<unsigned int, 3> &i, double &weight) {
          const Point<2> on_arc =
            arc(half * eighth, (half + 1) * eighth, i[1], weight);
          const Point<2> on_edge = half == 0 ? Point<2>(1., 0.5 * i[1]) :
                                               Point<2>(1. - 0.5 * i[1], 1.);
          if (i[0] == 1)
            weight = 1.;
          const Point<2> P = i[0] == 0 ? radius * on_arc : half_width * on_edge;
          return Point<3>(P[0], P[1], i[2] * thickness);
        }));
    return patches;
  }



  NURBSPatch<3>
  quarter_tube(const double inner_radius,
               const double outer_radius,
               const double height)
  {
    const double quarter = 2. * std::atan(1.);
    return make_patch(
      {{1, 2, 1}}, [&](const std::array<unsigned int, 3> &i, double &weight) {
        const Point<2> P = arc(0., quarter, i[1], weight);
        const double   r = i[0] == 0 ? inner_radius : outer_radius;
        return Point<3>(r * P[0], r * P[1], i[2] * height);
      });
  }



  NURBSPatch<3>
  sphere_octant(const double inner_radius, const double outer_radius)
  {
    const double quarter = 2. * std::atan(1.);
    return make_patch(
      {{1, 2, 2}}, [&](const std::array<unsigned int, 3> &i, double &weight) {
        // A meridian from the pole: (height, distance from the axis).
        double         weight_meridian, weight_parallel;
        const Point<2> meridian = arc(0., quarter, i[1], weight_meridian);
        const Point<2> parallel = arc(0., quarter, i[2], weight_parallel);
        const double   r        = i[0] == 0 ? inner_radius : outer_radius;
        weight                  = weight_meridian * weight_parallel;
        return Point<3>(r * meridian[1] * parallel[0],
                        r * meridian[1] * parallel[1],
                        r * meridian[0]);
      });
  }



  NURBSPatch<3>
  unit_block()
  {
    return make_patch({{1, 1, 1}},
                      [](const std::array<unsigned int, 3> &i, double &) {
                        return Point<3>(i[0], i[1], i[2]);
                      });
  }



  void
  refine(NURBSPatch<3>                     &patch,
         const unsigned int                 degree,
         const std::array<unsigned int, 3> &n_spans)
  {
    for (unsigned int d = 0; d < 3; ++d)
      {
        const unsigned int present = patch.knot_vector(d).degree();
        AssertThrow(present <= degree,
                    dealii::ExcMessage("The geometry needs a higher degree."));
        if (present < degree)
          patch.elevate_degree(d, degree - present);
        if (n_spans[d] > 1)
          patch.subdivide(d, n_spans[d]);
      }
  }



  void
  distort(NURBSPatch<3> &block, const double fraction)
  {
    // The raw numbers of this generator are the same everywhere; those of the
    // distributions of the standard library are not.
    std::mt19937 generator;
    const auto   random = [&]() {
      return 2. * generator() /
               static_cast<double>(std::numeric_limits<std::uint32_t>::max()) -
             1.;
    };
    std::vector<Point<3>> points = block.control_points();
    for (unsigned int A = 0; A < points.size(); ++A)
      {
        const auto index = block.multi_index(A);
        for (unsigned int d = 0; d < 3; ++d)
          {
            const double shift = random();
            if (index[d] == 0 || index[d] + 1 == block.n_control_points(d))
              continue;
            auto before = index, after = index;
            --before[d];
            ++after[d];
            const double X = block.control_points()[A][d];
            points[A][d] +=
              fraction * shift *
              std::min(X - block.control_points()[block.index(before)][d],
                       block.control_points()[block.index(after)][d] - X);
          }
      }
    block = NURBSPatch<3>(block.knot_vectors(), points, block.weights());
  }
} // namespace NPT
