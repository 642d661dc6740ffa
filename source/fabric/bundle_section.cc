// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines cross sections of fiber bundles by the shapes that are registered.

#include <npt_dealii/fabric/bundle_section.h>
#include <npt_dealii/fabric/section_shape.h>

namespace NPT
{
  using dealii::Point;

  namespace
  {
    const SectionShape &
    shape_of(const BundleSection &section)
    {
      return Registry<SectionShape>::instance().get(section.shape);
    }
  } // namespace



  double
  BundleSection::number(const std::string &entry) const
  {
    return own_number(numbers, shape_of(*this).numbers, entry);
  }



  double
  BundleSection::half_height(const double y) const
  {
    return shape_of(*this).half_height(*this, y);
  }



  double
  BundleSection::area() const
  {
    return shape_of(*this).area(*this);
  }



  double
  BundleSection::edge_angle() const
  {
    return shape_of(*this).edge_angle(*this);
  }



  NURBSPatch<2>
  BundleSection::patch(const unsigned int degree,
                       const unsigned int n_across) const
  {
    return shape_of(*this).patch(*this, degree, n_across);
  }



  std::string
  BundleSection::obstacle() const
  {
    const SectionShape &own = shape_of(*this);
    return own.check ? own.check(*this) : "";
  }



  namespace SectionTools
  {
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
  } // namespace SectionTools
} // namespace NPT
