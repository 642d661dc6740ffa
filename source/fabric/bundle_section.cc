// SPDX-License-Identifier: LGPL-2.1-or-later
// Cross sections of fiber bundles.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/fabric/bundle_section.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <cmath>

namespace NPT
{
  using dealii::Point;

  namespace
  {
    const double pi = dealii::numbers::PI;
    // Opening of the arcs of the rounded rectangle.
    const double arc_angle = pi / 3;

    // Coefficients of one wide face as functions of y, to be mirrored.
    NURBSPatch<2>
    between_faces(const KnotVector          &across,
                  const std::vector<double> &y,
                  const std::vector<double> &h,
                  const std::vector<double> &weights)
    {
      std::vector<Point<2>> points;
      std::vector<double>   all_weights;
      for (const double side : {-1., 1.})
        for (unsigned int i = 0; i < y.size(); ++i)
          {
            points.emplace_back(y[i], side * h[i]);
            all_weights.push_back(weights[i]);
          }
      return NURBSPatch<2>({{across, KnotVector::uniform(1, 1)}},
                           points,
                           all_weights);
    }

    // Knots that cut [0,1] at equally spaced y between existing breaks.
    // y(u) increases and is odd about u = 1/2; the knots are made exactly
    // symmetric, because symmetry operations map control points onto each
    // other.
    std::vector<double>
    equally_wide(const NURBSPatch<2>             &section,
                 const std::vector<unsigned int> &parts)
    {
      const std::vector<double> breaks = section.knot_vector(0).breaks();
      const auto                y      = [&](const double u) {
        return section.value(Point<2>(u, 0.5))[0];
      };
      std::vector<double> knots;
      for (unsigned int e = 0; e + 1 < breaks.size(); ++e)
        {
          const double begin = y(breaks[e]), end = y(breaks[e + 1]);
          for (unsigned int k = 1; k < parts[e]; ++k)
            {
              const double target = begin + (end - begin) * k / parts[e];
              double       low = breaks[e], high = breaks[e + 1];
              for (unsigned int i = 0; i < 60; ++i)
                (y(0.5 * (low + high)) < target ? low : high) =
                  0.5 * (low + high);
              knots.push_back(0.5 * (low + high));
            }
        }
      for (unsigned int i = 0; i < knots.size() / 2; ++i)
        knots[knots.size() - 1 - i] = 1. - knots[i];
      if (knots.size() % 2 == 1)
        knots[knots.size() / 2] = 0.5;
      return knots;
    }
  } // namespace



  BundleSection::Shape
  BundleSection::shape_from_name(const std::string &name)
  {
    if (name == "lens")
      return Shape::lens;
    if (name == "ellipse")
      return Shape::ellipse;
    if (name == "power ellipse")
      return Shape::power_ellipse;
    AssertThrow(name == "rounded rectangle", dealii::ExcInternalError());
    return Shape::rounded_rectangle;
  }



  double
  BundleSection::exponent() const
  {
    return shape == Shape::lens ? 2. : shape == Shape::ellipse ? 1. : power;
  }



  double
  BundleSection::half_height(const double y) const
  {
    if (shape == Shape::rounded_rectangle)
      {
        const double r    = thickness - 2 * tip;
        const double flat = 0.5 * width - r * std::sin(arc_angle);
        const double x    = std::max(std::abs(y) - flat, 0.);
        return 0.5 * thickness - r + std::sqrt(r * r - x * x);
      }
    const double n   = exponent();
    const double eta = 2 * y / width;
    const double cut = 1. - std::pow(2 * tip / thickness, 2. / n);
    return 0.5 * thickness * std::pow(1. - cut * eta * eta, 0.5 * n);
  }



  double
  BundleSection::area() const
  {
    if (shape == Shape::lens)
      return width * (2 * tip + 4. / 3. * (0.5 * thickness - tip));
    if (shape == Shape::rounded_rectangle)
      {
        // The rectangle less four times what each arc cuts off.
        const double r = thickness - 2 * tip;
        const double s = std::sin(arc_angle), c = std::cos(arc_angle);
        const double below_arc = 0.5 * r * r * (arc_angle + s * c);
        return width * thickness - 4 * (r * r * s - below_arc);
      }
    if (shape == Shape::ellipse)
      {
        // Two segments of the affine circle beyond the cuts are missing.
        const double epsilon = 2 * tip / thickness;
        const double cut     = std::sqrt(1 - epsilon * epsilon);
        return 0.5 * width / cut * thickness * (std::asin(cut) + cut * epsilon);
      }
    const dealii::QGauss<1> gauss(64);
    double                  sum = 0;
    for (unsigned int q = 0; q < gauss.size(); ++q)
      sum += gauss.weight(q) * width * 2 *
             half_height(width * (gauss.point(q)[0] - 0.5));
    return sum;
  }



  double
  BundleSection::edge_angle() const
  {
    if (shape == Shape::rounded_rectangle)
      return arc_angle * 180. / pi;
    const double n       = exponent();
    const double epsilon = 2 * tip / thickness;
    const double slope   = n * thickness / width *
                         (1. - std::pow(epsilon, 2. / n)) *
                         std::pow(epsilon, 1. - 2. / n);
    return std::atan(slope) * 180. / pi;
  }



  NURBSPatch<2>
  BundleSection::patch(const unsigned int degree,
                       const unsigned int n_across) const
  {
    const double a = 0.5 * width, b = 0.5 * thickness;
    switch (shape)
      {
        case Shape::lens:
          {
            // In Bernstein form 1 - (2y/w)^2 has the coefficients 0, 2, 0.
            NURBSPatch<2> section = between_faces(KnotVector::uniform(2, 1),
                                                  {-a, 0., a},
                                                  {tip, thickness - tip, tip},
                                                  {1., 1., 1.});
            section.elevate_degree(0, degree - 2);
            section.subdivide(0, n_across);
            return section;
          }

        case Shape::ellipse:
          {
            // Affine image of a circular arc: the weight of the middle control
            // point is the cosine of half the opening, which is 2e/t here, and
            // the tangents at the ends meet at t/2 over this cosine.
            const double  weight  = tip / b;
            NURBSPatch<2> section = between_faces(KnotVector::uniform(2, 1),
                                                  {-a, 0., a},
                                                  {tip, b / weight, tip},
                                                  {1., weight, 1.});
            section.elevate_degree(0, degree - 2);
            section.insert_knots(0, equally_wide(section, {n_across}));
            return section;
          }

        case Shape::power_ellipse:
          {
            const KnotVector   knots = KnotVector::uniform(degree, n_across);
            const unsigned int n     = knots.n_functions();
            dealii::FullMatrix<double> N(n, n);
            std::vector<double>        y(n), h(n), value(n);
            for (unsigned int i = 0; i < n; ++i)
              {
                const double       u   = knots.greville(i);
                const unsigned int e   = knots.find_span(u);
                const auto         N_i = knots.values(e, u, 0)[0];
                for (unsigned int k = 0; k < N_i.size(); ++k)
                  N(i, knots.first_function(e) + k) = N_i[k];
                y[i]     = width * (u - 0.5);
                value[i] = half_height(y[i]);
              }
            N.gauss_jordan();
            for (unsigned int i = 0; i < n; ++i)
              {
                h[i] = 0;
                for (unsigned int k = 0; k < n; ++k)
                  h[i] += N(i, k) * value[k];
              }
            // y(u) is linear, and its coefficients are the Greville points.
            return between_faces(knots, y, h, std::vector<double>(n, 1.));
          }

        case Shape::rounded_rectangle:
          {
            if (n_across < 3)
              throw InputError(
                "Elements across is " + std::to_string(n_across) +
                "; a rounded rectangle needs at least 3, for its two arcs and "
                "the flat between them (subsection Mesh).");
            // Three conics: arc, flat, arc. With the weights 1/c^2, 1, 1 of
            // the arc (c the cosine of half its opening) the weight is
            // stationary where the arc ends, and with the lengths of spans in
            // the ratio of the control polygon's sides the quadratic spline
            // with single knots is C1.
            const double     r    = thickness - 2 * tip;
            const double     leg  = r * std::tan(0.5 * arc_angle);
            const double     flat = a - r * std::sin(arc_angle);
            const double     c    = std::cos(0.5 * arc_angle);
            const double     arc  = leg / (2 * leg + flat); // parameter length
            const KnotVector knots(2, {0, 0, 0, arc, 1 - arc, 1, 1, 1});
            const double     w = 1. / (c * c);
            NURBSPatch<2>    section =
              between_faces(knots,
                            {-a, -flat - leg, 0., flat + leg, a},
                            {tip, b, b, b, tip},
                            {w, 1., 1., 1., w});
            section.elevate_degree(0, degree - 2);
            // At least one span for each arc.
            const double       share = r * std::sin(arc_angle) / width;
            const unsigned int n_arc = std::min<unsigned int>(
              std::max<long>(1, std::lround(n_across * share)),
              (n_across - 1) / 2);
            section.insert_knots(
              0, equally_wide(section, {n_arc, n_across - 2 * n_arc, n_arc}));
            return section;
          }
      }
    AssertThrow(false, dealii::ExcInternalError());
    return between_faces(KnotVector::uniform(1, 1), {}, {}, {});
  }
} // namespace NPT
