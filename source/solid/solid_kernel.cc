// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the cell kernel of a solid; its inner loops are the hot spot of the
// program.

#include <npt_dealii/base/simd_clones.h>
#include <npt_dealii/solid/solid_kernel.h>

#include <algorithm>

namespace NPT
{
  namespace
  {
    // Functions that are treated at once, in registers and in memory.
    constexpr unsigned int n_lanes = CellGradients::n_lanes;
    typedef double Lanes __attribute__((vector_size(n_lanes * sizeof(double))));
    typedef double LanesInMemory
      __attribute__((vector_size(n_lanes * sizeof(double)),
                     aligned(sizeof(double)),
                     may_alias));
    using Load  = const LanesInMemory *;
    using Store = LanesInMemory *;

    // Functions B to B + 3 in block (i, k) of the stiffness.
    struct Columns
    {
      unsigned int i, k, B;
    };

    // Two sets of columns are computed together: one load of G for eight
    // products.
    constexpr unsigned int n_together = 2;
    constexpr unsigned int width      = n_together * n_lanes;



    // T[3 q + J][lane] = A[q][iJ][kL] G[q][L][B + lane].
    NPT_SIMD_CLONES void
    apply_tangents(const Columns        columns,
                   const CellGradients &cell,
                   const double        *tangents,
                   double              *T)
    {
      const unsigned int stride = cell.stride;
      const double      *a      = tangents + columns.i * 27 + columns.k * 3;
      const double      *g      = cell.gradients.data() + columns.B;
      for (unsigned int q = 0; q < cell.n_points; ++q, a += 81, g += 3 * stride)
        {
          const Lanes g0 = *Load(g);
          const Lanes g1 = *Load(g + stride);
          const Lanes g2 = *Load(g + 2 * stride);
          for (unsigned int J = 0; J < 3; ++J, T += width)
            *Store(T) = a[9 * J] * g0 + a[9 * J + 1] * g1 + a[9 * J + 2] * g2;
        }
    }



    // C[A][column] = sum_d G[d][A] T[d][column] for A < n_rows, d = 3 q + J.
    // The sums stay in registers.
    NPT_SIMD_CLONES void
    apply_gradients(const unsigned int   n_rows,
                    const CellGradients &cell,
                    const double        *T,
                    double              *C)
    {
      for (unsigned int A = 0; A < n_rows; A += n_lanes)
        {
          Lanes         sums[n_lanes][n_together] = {};
          const double *g = cell.gradients.data() + A, *t = T;
          for (unsigned int d = 0; d < 3 * cell.n_points;
               ++d, g += cell.stride, t += width)
            {
              const Lanes t0 = *Load(t);
              const Lanes t1 = *Load(t + n_lanes);
              for (unsigned int r = 0; r < n_lanes; ++r)
                {
                  sums[r][0] += g[r] * t0;
                  sums[r][1] += g[r] * t1;
                }
            }
          for (unsigned int r = 0; r < n_lanes; ++r, C += width)
            {
              *Store(C)           = sums[r][0];
              *Store(C + n_lanes) = sums[r][1];
            }
        }
    }



    // K[i][A][k][B] = C[A][lane] for A <= B in a block on the diagonal, for
    // all A in another, and the mirror image.
    void
    store_columns(const Columns      columns,
                  const unsigned int n,
                  const double      *C,
                  double            *K)
    {
      const unsigned int size      = 3 * n,
                         n_columns = std::min(n_lanes, n - columns.B);
      for (unsigned int lane = 0; lane < n_columns; ++lane)
        {
          const unsigned int B        = columns.B + lane;
          const unsigned int n_rows   = columns.i == columns.k ? B + 1 : n;
          const unsigned int column   = columns.k * n + B;
          double            *at       = K + columns.i * n * size + column;
          double            *mirrored = K + column * size + columns.i * n;
          for (unsigned int A = 0; A < n_rows; ++A)
            at[A * size] = mirrored[A] = C[A * width + lane];
        }
    }



    // K[i][A][k][B] = sum_q G[q][J][A] A[q][iJ][kL] G[q][L][B].
    void
    compute_stiffness(const CellGradients &cell,
                      const double        *tangents,
                      std::vector<double> &scratch,
                      double              *K)
    {
      scratch.resize((3 * cell.n_points + cell.stride) * width);
      double *T = scratch.data(), *C = T + 3 * cell.n_points * width;

      Columns      columns[n_together];
      unsigned int n_columns = 0, n_rows = 0;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int k = i; k < 3; ++k)
          for (unsigned int B = 0; B < cell.stride; B += n_lanes)
            {
              columns[n_columns] = {i, k, B};
              apply_tangents(columns[n_columns],
                             cell,
                             tangents,
                             T + n_columns * n_lanes);
              n_rows = std::max(n_rows, i == k ? B + n_lanes : cell.stride);
              // Their number, of all six blocks, is even.
              if (++n_columns < n_together)
                continue;
              apply_gradients(n_rows, cell, T, C);
              for (unsigned int c = 0; c < n_together; ++c)
                store_columns(columns[c], cell.n_functions, C + c * n_lanes, K);
              n_columns = n_rows = 0;
            }
    }



    // F = 1 + w_A (x) Grad N_A at all points; F[q][iJ]. Instead of 1 stands
    // what the natural state says.
    NPT_SIMD_CLONES void
    compute_gradients(const CellGradients &cell, const double *w, double *F)
    {
      const unsigned int stride      = cell.stride;
      const double      *g           = cell.gradients.data();
      const double       identity[9] = {1., 0., 0., 0., 1., 0., 0., 0., 1.};
      const bool         is_natural  = cell.at_rest.empty();
      const double      *at_rest = is_natural ? identity : cell.at_rest.data();
      for (unsigned int q = 0; q < cell.n_points;
           ++q, F += 9, at_rest += is_natural ? 0 : 9)
        for (unsigned int J = 0; J < 3; ++J, g += stride)
          {
            Lanes sums[3] = {};
            for (unsigned int A = 0; A < stride; A += n_lanes)
              for (unsigned int i = 0; i < 3; ++i)
                sums[i] += *Load(w + i * stride + A) * *Load(g + A);
            for (unsigned int i = 0; i < 3; ++i)
              F[3 * i + J] = at_rest[3 * i + J] + ((sums[i][0] + sums[i][1]) +
                                                   (sums[i][2] + sums[i][3]));
          }
    }



    // f[i][A] = G[q][J][A] P[q][iJ].
    NPT_SIMD_CLONES void
    compute_force(const CellGradients &cell, const double *P, double *f)
    {
      const unsigned int stride = cell.stride;
      for (unsigned int A = 0; A < stride; A += n_lanes)
        {
          // Nine sums, of which none has to wait for another.
          Lanes         sums[3][3] = {};
          const double *g = cell.gradients.data() + A, *p = P;
          for (unsigned int q = 0; q < cell.n_points; ++q, p += 9)
            for (unsigned int J = 0; J < 3; ++J, g += stride)
              for (unsigned int i = 0; i < 3; ++i)
                sums[i][J] += p[3 * i + J] * *Load(g);
          for (unsigned int i = 0; i < 3; ++i)
            *Store(f + i * stride + A) = sums[i][0] + sums[i][1] + sums[i][2];
        }
    }
  } // namespace



  void
  CellGradients::reinit(const unsigned int new_n_functions,
                        const unsigned int new_n_points)
  {
    n_functions = new_n_functions;
    n_points    = new_n_points;
    stride      = (n_functions + n_lanes - 1) / n_lanes * n_lanes;
    gradients.assign(3 * n_points * stride, 0.);
  }



  const double *
  SolidKernel::deformation_gradients(const CellGradients       &cell,
                                     const std::vector<double> &displacement)
  {
    AssertDimension(displacement.size(), 3 * cell.n_functions);
    deformation_gradients_.resize(9 * cell.n_points);
    // With zeros at the end of each component, as in the gradients.
    padded_.assign(3 * cell.stride, 0.);
    for (unsigned int i = 0; i < 3; ++i)
      std::copy_n(displacement.data() + i * cell.n_functions,
                  cell.n_functions,
                  padded_.data() + i * cell.stride);
    compute_gradients(cell, padded_.data(), deformation_gradients_.data());
    return deformation_gradients_.data();
  }



  void
  SolidKernel::evaluate(const HyperelasticLaw<3>  &law,
                        const CellGradients       &cell,
                        const std::vector<double> &displacement,
                        std::vector<double>       &force,
                        std::vector<double>       *stiffness)
  {
    const unsigned int n = cell.n_functions, n_q = cell.n_points;
    const double      *F = deformation_gradients(cell, displacement);
    stresses_.resize(9 * n_q);
    double *P = stresses_.data();
    if (stiffness == nullptr)
      for (unsigned int q = 0; q < n_q; ++q)
        law.stress(F + 9 * q, P + 9 * q);
    else
      {
        tangents_.resize(81 * n_q);
        for (unsigned int q = 0; q < n_q; ++q)
          {
            double *A = tangents_.data() + 81 * q;
            law.stress_and_tangent(F + 9 * q, P + 9 * q, A);
            for (unsigned int k = 0; k < 81; ++k)
              A[k] *= cell.jxw[q];
          }
      }
    for (unsigned int q = 0; q < n_q; ++q)
      for (unsigned int k = 0; k < 9; ++k)
        P[9 * q + k] *= cell.jxw[q];

    compute_force(cell, P, padded_.data());
    force.resize(3 * n);
    for (unsigned int i = 0; i < 3; ++i)
      std::copy_n(padded_.data() + i * cell.stride, n, force.data() + i * n);

    if (stiffness != nullptr)
      {
        stiffness->resize(9 * n * n);
        compute_stiffness(cell, tangents_.data(), scratch_, stiffness->data());
      }
  }



  double
  SolidKernel::energy(const HyperelasticLaw<3>  &law,
                      const CellGradients       &cell,
                      const std::vector<double> &displacement)
  {
    const double *F   = deformation_gradients(cell, displacement);
    double        sum = 0;
    for (unsigned int q = 0; q < cell.n_points; ++q)
      sum += law.energy(F + 9 * q) * cell.jxw[q];
    return sum;
  }
} // namespace NPT
