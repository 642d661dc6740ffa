// SPDX-License-Identifier: LGPL-2.1-or-later
// GMRES with a preconditioner that is nearly the inverse.

#include <npt_dealii/linear_algebra/flexible_gmres.h>
#include <npt_dealii/linear_algebra/linear_solver_backend.h>

#include <cmath>
#include <vector>

namespace NPT
{
  using dealii::Vector;

  unsigned int
  flexible_gmres(const LinearMap      &A,
                 const LinearMap      &M,
                 const Vector<double> &b,
                 const double          tolerance,
                 const unsigned int    max_iterations,
                 Vector<double>       &x)
  {
    x.reinit(b.size());
    const double size = b.l2_norm();
    if (size <= tolerance)
      return 0;
    // Column j of the Hessenberg matrix, rotated to a triangle, and the
    // rotated right-hand side, whose last entry is the residual.
    std::vector<std::vector<double>> H;
    std::vector<double>              cosine, sine, rhs = {size};
    std::vector<Vector<double>>      v = {b}, z;
    v[0] /= size;
    unsigned int n_iterations = 0;
    while (std::abs(rhs.back()) > tolerance && n_iterations < max_iterations)
      {
        const unsigned int j = n_iterations;
        Vector<double>     w;
        z.emplace_back();
        M(v[j], z[j]);
        if (!is_finite(z[j]))
          break;
        A(z[j], w);
        std::vector<double> h(j + 2);
        for (unsigned int i = 0; i <= j; ++i)
          {
            h[i] = w * v[i];
            w.add(-h[i], v[i]);
          }
        h[j + 1] = w.l2_norm();
        if (h[j + 1] > 0)
          w /= h[j + 1];
        v.push_back(w);
        for (unsigned int i = 0; i < j; ++i)
          {
            const double upper = h[i];
            h[i]               = cosine[i] * upper + sine[i] * h[i + 1];
            h[i + 1]           = cosine[i] * h[i + 1] - sine[i] * upper;
          }
        const double r = std::hypot(h[j], h[j + 1]);
        if (!(r > 0))
          break;
        cosine.push_back(h[j] / r);
        sine.push_back(h[j + 1] / r);
        h[j] = r;
        H.push_back(h);
        rhs.push_back(-sine[j] * rhs[j]);
        rhs[j] *= cosine[j];
        ++n_iterations;
      }
    for (unsigned int j = n_iterations; j-- > 0;)
      {
        double y = rhs[j];
        for (unsigned int k = j + 1; k < n_iterations; ++k)
          y -= H[k][j] * rhs[k];
        rhs[j] = y / H[j][j];
        x.add(rhs[j], z[j]);
      }
    return n_iterations;
  }
} // namespace NPT
