// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what is told of an identification: the report, the file for other
// runs, the picture of fit against test.

#ifndef npt_dealii_problems_identification_identification_report_h
#define npt_dealii_problems_identification_identification_report_h

#include <npt_dealii/problems/identification/identification.h>

#include <string>
#include <vector>

namespace NPT
{
  /// A report of several lines for the log.
  std::vector<std::string>
  describe(const IdentificationResult &result);

  /**
   * Write the file that other parameter files include: subsection "Fiber
   * bundle material" with the constants, and the report as comments.
   */
  void
  write_material_file(const std::string          &filename,
                      const IdentificationResult &result);

  /**
   * Write fit.csv, fit.gp and the pictures fit.svg, fit.png (test as points,
   * fit as lines, tension left, shear right, as Fig. 8) into a folder.
   *
   * @param picture Call gnuplot.
   * @return Empty, or a warning of one line.
   */
  std::string
  write_fit(const std::string                &directory,
            const std::vector<MaterialCurve> &curves,
            const FiberBundleConstants       &constants,
            const bool                        picture);
} // namespace NPT

#endif
