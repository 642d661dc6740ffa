// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the lens with flat faces, its entry in a parameter file, and its name
// there.

#include "flattened_lens.h"

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/fabric/section_shape.h>

#include <algorithm>
#include <cmath>

namespace NPT
{
  namespace
  {
    double
    flat_share(const BundleSection &section)
    {
      return section.number("Flat share");
    }
  } // namespace



  double
  FlattenedLens::half_height(const BundleSection &section, const double y)
  {
    const double f = flat_share(section);
    const double x =
      std::max(0., std::abs(2. * y / section.width) - f) / (1. - f);
    return 0.5 * section.thickness -
           (0.5 * section.thickness - section.tip) * x * x;
  }



  namespace
  {
    double
    area(const BundleSection &section)
    {
      // The rectangle less a third of what is beside the flat.
      const double b = 0.5 * section.thickness;
      return 2. * section.width *
             (b - (1. - flat_share(section)) * (b - section.tip) / 3.);
    }

    double
    edge_angle(const BundleSection &section)
    {
      const double flank = 0.5 * (1. - flat_share(section)) * section.width;
      return std::atan(2. * (0.5 * section.thickness - section.tip) / flank) *
             180. / dealii::numbers::PI;
    }

    NURBSPatch<2>
    patch(const BundleSection &section,
          const unsigned int   degree,
          const unsigned int   n_across)
    {
      if (n_across < 3)
        throw InputError("Elements across is " + std::to_string(n_across) +
                         "; a flattened lens needs at least 3, for its two "
                         "flanks and the flat between them (subsection Mesh).");
      const double a = 0.5 * section.width, b = 0.5 * section.thickness;
      const double flank = 0.5 * (1. - flat_share(section)); // of the width
      // y is linear in the parameter: its coefficients are the Greville points.
      // The tangents at the two ends of a flank meet above its middle.
      const double     middle = a * (1. - flank);
      const KnotVector knots(2, {0, 0, 0, flank, 1 - flank, 1, 1, 1});
      NURBSPatch<2>    result =
        SectionTools::between_faces(knots,
                                    {-a, -middle, 0., middle, a},
                                    {section.tip, b, b, b, section.tip},
                                    std::vector<double>(5, 1.));
      result.elevate_degree(0, degree - 2);

      // At least one span for each flank and for the flat.
      const unsigned int n_flank =
        std::min<unsigned int>(std::max<long>(1, std::lround(n_across * flank)),
                               (n_across - 1) / 2);
      result.insert_knots(
        0,
        SectionTools::equally_wide(result,
                                   {n_flank, n_across - 2 * n_flank, n_flank}));
      return result;
    }

    const Registry<SectionShape>::Registration flattened_lens(
      "flattened lens",
      {FlattenedLens::half_height,
       area,
       edge_angle,
       patch,
       {{"Flat share",
         0.4,
         "Flattened lens only: share f of the width that is flat [-].",
         std::make_shared<dealii::Patterns::Double>(0.05, 0.9)}}});
  } // namespace
} // namespace NPT
