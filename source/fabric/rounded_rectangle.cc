// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the section with flat faces, arcs and side faces, and registers it.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/fabric/rounded_rectangle.h>
#include <npt_dealii/fabric/section_shape.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace NPT
{
  using namespace SectionTools;

  double
  RoundedRectangle::half_height(const BundleSection &section, const double y)
  {
    const double r    = section.thickness - 2 * section.tip;
    const double flat = 0.5 * section.width - r * std::sin(arc_angle);
    const double x    = std::max(std::abs(y) - flat, 0.);
    return 0.5 * section.thickness - r + std::sqrt(r * r - x * x);
  }



  namespace
  {
    using RoundedRectangle::arc_angle;

    double
    area(const BundleSection &section)
    {
      // The rectangle less four times what each arc cuts off.
      const double r = section.thickness - 2 * section.tip;
      const double s = std::sin(arc_angle), c = std::cos(arc_angle);
      const double below_arc = 0.5 * r * r * (arc_angle + s * c);
      return section.width * section.thickness - 4 * (r * r * s - below_arc);
    }

    double
    edge_angle(const BundleSection &)
    {
      return arc_angle * 180. / dealii::numbers::PI;
    }

    NURBSPatch<2>
    patch(const BundleSection &section,
          const unsigned int   degree,
          const unsigned int   n_across)
    {
      if (n_across < 3)
        throw InputError(
          "Elements across is " + std::to_string(n_across) +
          "; a rounded rectangle needs at least 3, for its two arcs and "
          "the flat between them (subsection Mesh).");
      // Three conics: arc, flat, arc. With the weights 1/c^2, 1, 1 of the arc
      // (c the cosine of half its opening) the weight is stationary where the
      // arc ends, and with the lengths of spans in the ratio of the control
      // polygon's sides the quadratic spline with single knots is C1.
      const double     a = 0.5 * section.width, b = 0.5 * section.thickness;
      const double     r    = section.thickness - 2 * section.tip;
      const double     leg  = r * std::tan(0.5 * arc_angle);
      const double     flat = a - r * std::sin(arc_angle);
      const double     c    = std::cos(0.5 * arc_angle);
      const double     arc  = leg / (2 * leg + flat); // parameter length
      const KnotVector knots(2, {0, 0, 0, arc, 1 - arc, 1, 1, 1});
      const double     w      = 1. / (c * c);
      NURBSPatch<2>    result = between_faces(knots,
                                           {-a, -flat - leg, 0., flat + leg, a},
                                           {section.tip, b, b, b, section.tip},
                                           {w, 1., 1., 1., w});
      result.elevate_degree(0, degree - 2);
      // At least one span for each arc.
      const double       share = r * std::sin(arc_angle) / section.width;
      const unsigned int n_arc =
        std::min<unsigned int>(std::max<long>(1, std::lround(n_across * share)),
                               (n_across - 1) / 2);
      result.insert_knots(0,
                          equally_wide(result,
                                       {n_arc, n_across - 2 * n_arc, n_arc}));
      return result;
    }

    std::string
    check(const BundleSection &section)
    {
      const double w = section.width, t = section.thickness;
      if (std::sqrt(3.) * (t - 2 * section.tip) < 0.95 * w)
        return "";
      std::ostringstream message;
      message << "Blunt tip is " << section.tip / t
              << "; the arcs of the rounded rectangle would leave no flat "
              << "face between them on a bundle of " << w << " mm by " << t
              << " mm; take a Blunt tip above "
              << 0.5 * (1 - 0.95 * w / (std::sqrt(3.) * t));
      return message.str();
    }

    const Registry<SectionShape>::Registration rounded_rectangle(
      "rounded rectangle",
      {RoundedRectangle::half_height, area, edge_angle, patch, {}, check});
  } // namespace
} // namespace NPT
