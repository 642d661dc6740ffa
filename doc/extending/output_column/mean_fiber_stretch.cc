// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the column mean_fiber_stretch of curves.csv, an example of a further
// column.

#include <npt_dealii/problems/plate_results/curve_column.h>
#include <npt_dealii/problems/plate_test/plate_step.h>

namespace NPT
{
  namespace
  {
    // Mean of |F A| over the volume of all bundles, A the fiber direction.
    double
    mean_fiber_stretch(const PlateStep &plate)
    {
      const auto &bodies = plate.cell.bodies();
      double      sum = 0., volume = 0.;
      bodies.for_each_point(plate.step.after.u, [&](const auto &point) {
        const unsigned int bundle = bodies.space().cells()[point.cell].patch;
        const auto        &A = plate.cell.fabric().bundles()[bundle].direction;
        sum += (point.F * A).norm() * point.dV;
        volume += point.dV;
      });
      return sum / volume;
    }

    const Registry<CurveColumn>::Registration column("mean_fiber_stretch",
                                                     {"-", mean_fiber_stretch});
  } // namespace
} // namespace NPT
