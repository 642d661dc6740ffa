// SPDX-License-Identifier: LGPL-2.1-or-later
// What memory a plate test needs, before it is taken.

#include <npt_dealii/base/short_number.h>
#include <npt_dealii/fabric/weave_pattern.h>
#include <npt_dealii/problems/plate_test/memory_need.h>

#include <algorithm>

namespace NPT
{
  double
  least_gigabytes(const PlateTestParameters &parameters)
  {
    const MeshParameters &mesh        = parameters.mesh;
    const double          p           = mesh.degree;
    double                n_crossings = 1;
    if (parameters.cell.type == "unit cell")
      {
        const WeavePattern weave(parameters.cell.weave);
        n_crossings = weave.n_warp() * weave.n_weft();
      }
    const auto pairs = [p](const double n_elements) {
      return (n_elements + p) * (2 * p + 1) - p * (p + 1);
    };
    const double n_entries = 9 * 2 * n_crossings * mesh.elements_along *
                             (2 * p + 1) * pairs(mesh.elements_across) *
                             pairs(mesh.elements_through);
    constexpr double bytes_per_entry = 2 * (sizeof(double) + sizeof(int));
    const double     share =
      parameters.cell.mirror_planes == CellParameters::MirrorPlanes::yes ?
            0.1e-9 :
            0.4e-9;
    return share * bytes_per_entry * n_entries;
  }



  std::string
  obstacle_of_memory(const PlateTestParameters &parameters,
                     const double               available)
  {
    const double needed = least_gigabytes(parameters);
    if (needed <= available)
      return "";
    const MeshParameters &mesh = parameters.mesh;
    return "The matrix of " + std::to_string(mesh.elements_along) + " x " +
           std::to_string(mesh.elements_across) + " x " +
           std::to_string(mesh.elements_through) +
           " elements per crossing takes at least " + short_number(needed, 2) +
           " GB, and " + short_number(available, 2) + " GB are available.";
  }
} // namespace NPT
