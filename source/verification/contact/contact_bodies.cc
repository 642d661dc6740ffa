// SPDX-License-Identifier: LGPL-2.1-or-later
// Control points and knots of the bodies of contact benchmarks.

#include <npt_dealii/verification/contact/contact_bodies.h>

#include <algorithm>
#include <cmath>

namespace NPT
{
  using dealii::Point;

  Profile::Profile(const double R, const double begin, const double end)
    : radius(R)
  {
    if (R == flat)
      {
        middle_weight = 1.;
        points = {{{{begin, 0.}}, {{0.5 * (begin + end), 0.}}, {{end, 0.}}}};
        return;
      }
    const double a = std::asin(begin / R), b = std::asin(end / R);
    const double half = 0.5 * (b - a), center = 0.5 * (a + b);
    middle_weight      = std::cos(half);
    const double outer = R / middle_weight;
    points             = {{{{begin, R * std::cos(a) - R}},
                           {{outer * std::sin(center), outer * std::cos(center) - R}},
                           {{end, R * std::cos(b) - R}}}};
  }



  double
  Profile::abscissa(const double u) const
  {
    const double b[3] = {(1 - u) * (1 - u),
                         2 * u * (1 - u) * middle_weight,
                         u * u};
    return (b[0] * points[0][0] + b[1] * points[1][0] + b[2] * points[2][0]) /
           (b[0] + b[1] + b[2]);
  }



  std::vector<double>
  Profile::parameters(const std::vector<double> &abscissae) const
  {
    std::vector<double> result;
    for (const double s : abscissae)
      {
        double low = 0, high = 1;
        for (unsigned int i = 0; i < 60; ++i)
          (abscissa(0.5 * (low + high)) < s ? low : high) = 0.5 * (low + high);
        if (low > 1e-9 && high < 1. - 1e-9)
          result.push_back(0.5 * (low + high));
      }
    return result;
  }



  std::vector<double>
  graded(const double fine,
         const double h,
         const double end,
         const double growth)
  {
    std::vector<double> result;
    const unsigned int  n = std::max(1., std::round(fine / h));
    for (unsigned int i = 1; i <= n && i * h < end - 0.5 * h; ++i)
      result.push_back(i * h);
    const double begin = result.empty() ? 0. : result.back();
    // Smallest number of spans that reaches the end, then the factor that
    // meets it exactly.
    const auto reach = [&](const double factor, const unsigned int m) {
      double sum = 0, length = h;
      for (unsigned int i = 0; i < m; ++i)
        sum += (length *= factor);
      return sum;
    };
    unsigned int m = 1;
    while (m < 200 && reach(growth, m) < end - begin)
      ++m;
    double low = 0, high = std::max(growth, 1. + (end - begin) / h);
    for (unsigned int i = 0; i < 100; ++i)
      (reach(0.5 * (low + high), m) < end - begin ? low : high) =
        0.5 * (low + high);
    double position = begin, length = h;
    for (unsigned int i = 0; i + 1 < m; ++i)
      {
        position += (length *= low);
        result.push_back(position);
      }
    return result;
  }



  std::vector<double>
  mirrored(const std::vector<double> &positive)
  {
    std::vector<double> result;
    for (auto it = positive.rbegin(); it != positive.rend(); ++it)
      result.push_back(-*it);
    result.push_back(0.);
    result.insert(result.end(), positive.begin(), positive.end());
    return result;
  }



  std::vector<double>
  equal_spans(const double begin, const double end, const unsigned int n)
  {
    std::vector<double> result;
    for (unsigned int i = 1; i < n; ++i)
      result.push_back(begin + (end - begin) * i / n);
    return result;
  }



  namespace
  {
    /// A patch that ends in `knots` (parameters) in three directions, after
    /// its degree was raised, so that all continuities are C^{p-1}.
    NURBSPatch<3>
    refined(NURBSPatch<3>                             patch,
            const unsigned int                        degree,
            const std::array<std::vector<double>, 3> &knots)
    {
      patch.make_isotropic();
      for (unsigned int d = 0; d < 3; ++d)
        {
          if (degree > patch.knot_vector(d).degree())
            patch.elevate_degree(d, degree - patch.knot_vector(d).degree());
          if (!knots[d].empty())
            patch.insert_knots(d, knots[d]);
        }
      return patch;
    }
  } // namespace



  NURBSPatch<3>
  segment(const bool                 upper,
          const Profile             &along_x,
          const Profile             &along_y,
          const double               height,
          const unsigned int         degree,
          const std::vector<double> &x_knots,
          const std::vector<double> &y_knots,
          const std::vector<double> &depths)
  {
    std::vector<Point<3>> points;
    std::vector<double>   weights;
    for (unsigned int k = 0; k < 2; ++k)
      for (unsigned int j = 0; j < 3; ++j)
        for (unsigned int i = 0; i < 3; ++i)
          {
            const double x = along_x.points[i][0];
            double       y = along_y.points[j][0], z = along_x.points[i][1];
            if (along_y.radius != flat)
              {
                const double R      = along_y.radius;
                const double sine   = y / R,
                             cosine = 1 + along_y.points[j][1] / R;
                y                   = (R + z) * sine;
                z                   = (R + z) * cosine - R;
              }
            // The surface is the upper end of the lower body and the lower
            // end of the upper one.
            const bool surface = upper == (k == 0);
            z                  = surface ? z : -height;
            points.emplace_back(x, y, upper ? -z : z);
            weights.push_back((i == 1 ? along_x.middle_weight : 1.) *
                              (j == 1 ? along_y.middle_weight : 1.));
          }
    std::vector<double> w;
    for (const double depth : depths)
      w.push_back(upper ? depth / height : 1. - depth / height);
    std::sort(w.begin(), w.end());
    const KnotVector quadratic = KnotVector::uniform(2, 1);
    return refined(
      NURBSPatch<3>({{quadratic, quadratic, KnotVector::uniform(1, 1)}},
                    points,
                    weights),
      degree,
      {{along_x.parameters(x_knots), along_y.parameters(y_knots), w}});
  }



  NURBSPatch<3>
  box(const Point<3>                    &low,
      const Point<3>                    &high,
      const unsigned int                 degree,
      const std::array<unsigned int, 3> &n)
  {
    std::vector<Point<3>> points;
    for (unsigned int A = 0; A < 8; ++A)
      points.emplace_back(A & 1 ? high[0] : low[0],
                          A & 2 ? high[1] : low[1],
                          A & 4 ? high[2] : low[2]);
    const KnotVector                   linear = KnotVector::uniform(1, 1);
    std::array<std::vector<double>, 3> knots;
    NURBSPatch<3> patch({{linear, linear, linear}}, points);
    for (unsigned int d = 0; d < 3; ++d)
      {
        patch.elevate_degree(d, degree - 1);
        knots[d] = equal_spans(0., 1., n[d]);
      }
    return refined(patch, degree, knots);
  }



  NURBSPatch<3>
  ring(const double       inner_radius,
       const double       outer_radius,
       const double       half_angle,
       const double       width,
       const unsigned int degree,
       const unsigned int n_arc,
       const unsigned int n_radial)
  {
    const double          w = std::cos(half_angle);
    std::vector<Point<3>> points;
    std::vector<double>   weights;
    for (const double r : {inner_radius, outer_radius})
      for (const double y : {0., width})
        for (int i = -1; i <= 1; ++i)
          {
            const double R = i == 0 ? r / w : r, angle = i * half_angle;
            points.emplace_back(R * std::sin(angle), y, R * std::cos(angle));
            weights.push_back(i == 0 ? w : 1.);
          }
    // Equal angles, not equal parameters.
    std::vector<double> knots;
    for (const double angle : equal_spans(-half_angle, half_angle, n_arc))
      {
        double low = 0, high = 1;
        for (unsigned int i = 0; i < 60; ++i)
          {
            const double u    = 0.5 * (low + high);
            const double b[3] = {(1 - u) * (1 - u), 2 * u * (1 - u) * w, u * u};
            const double x    = std::sin(half_angle) * (b[2] - b[0]);
            const double z    = std::cos(half_angle) * (b[0] + b[2]) + b[1] / w;
            (std::atan2(x, z) < angle ? low : high) = u;
          }
        knots.push_back(0.5 * (low + high));
      }
    const KnotVector linear = KnotVector::uniform(1, 1);
    return refined(NURBSPatch<3>({{KnotVector::uniform(2, 1), linear, linear}},
                                 points,
                                 weights),
                   degree,
                   {{knots, {}, equal_spans(0., 1., n_radial)}});
  }



  NURBSPatch<3>
  disc(const double       radius,
       const double       low,
       const double       high,
       const unsigned int degree,
       const unsigned int n)
  {
    const double          s = std::sqrt(0.5);
    std::vector<Point<3>> points;
    std::vector<double>   weights;
    for (const double z : {low, high})
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i)
          {
            // Corners on the circle, middles where its tangents meet.
            const double stretch = i == 0 || j == 0 ? 2 * s : s;
            points.emplace_back(radius * stretch * i, radius * stretch * j, z);
            weights.push_back(i != 0 && j != 0 ? 1. :
                              i == 0 && j == 0 ? 1. :
                                                 s);
          }
    const KnotVector          quadratic = KnotVector::uniform(2, 1);
    const std::vector<double> knots     = equal_spans(0., 1., n);
    return refined(
      NURBSPatch<3>({{quadratic, quadratic, KnotVector::uniform(1, 1)}},
                    points,
                    weights),
      degree,
      {{knots, knots, {}}});
  }
} // namespace NPT
