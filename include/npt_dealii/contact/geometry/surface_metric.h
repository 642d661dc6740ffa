// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the inverse of the small symmetric matrices of surface geometry.

#ifndef npt_dealii_contact_geometry_surface_metric_h
#define npt_dealii_contact_geometry_surface_metric_h

#include <array>

namespace NPT
{
  template <int m>
  using SurfaceMatrix = std::array<std::array<double, m>, m>;

  /**
   * Inverse of a symmetric m x m matrix (m = 1, 2) restricted to the free
   * directions; rows and columns of held directions are zero.
   */
  template <int m>
  SurfaceMatrix<m>
  invert_symmetric(const SurfaceMatrix<m> &A, const std::array<bool, m> &free)
  {
    SurfaceMatrix<m> inverse{};
    if constexpr (m == 2)
      if (free[0] && free[1])
        {
          const double det = A[0][0] * A[1][1] - A[0][1] * A[1][0];
          inverse[0][0]    = A[1][1] / det;
          inverse[1][1]    = A[0][0] / det;
          inverse[0][1]    = -A[0][1] / det;
          inverse[1][0]    = -A[1][0] / det;
          return inverse;
        }
    for (int a = 0; a < m; ++a)
      if (free[a])
        inverse[a][a] = 1. / A[a][a];
    return inverse;
  }

  template <int m>
  SurfaceMatrix<m>
  invert_symmetric(const SurfaceMatrix<m> &A)
  {
    std::array<bool, m> all;
    all.fill(true);
    return invert_symmetric<m>(A, all);
  }
} // namespace NPT

#endif
