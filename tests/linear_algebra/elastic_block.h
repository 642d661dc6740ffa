// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines a test matrix: a linear elastic box of B-splines whose lower face may
// be held and carries an unsymmetric term like that of a frictional contact.

#ifndef npt_dealii_tests_elastic_block_h
#define npt_dealii_tests_elastic_block_h

#include <npt_dealii/linear_algebra/csr_matrix.h>

#include <array>
#include <vector>

namespace NPT
{
  /// Integrals of products of the B-splines of one direction, unit spans:
  /// entry [i][j] of values x values, derivative x values, both derivatives.
  struct LineMatrices
  {
    LineMatrices(const unsigned int n_spans, const unsigned int degree)
      : n(n_spans + degree)
      , NN(n, std::vector<double>(n))
      , DN(NN)
      , DD(NN)
    {
      std::vector<double> knots(degree, 0.);
      for (unsigned int i = 0; i <= n_spans; ++i)
        knots.push_back(i);
      knots.insert(knots.end(), degree, n_spans);

      const std::array<double, 3> points{{-std::sqrt(0.6), 0, std::sqrt(0.6)}};
      const std::array<double, 3> weights{{5. / 18, 8. / 18, 5. / 18}};
      for (unsigned int span = 0; span < n_spans; ++span)
        for (unsigned int q = 0; q < 3; ++q)
          {
            const double        x = span + 0.5 + 0.5 * points[q];
            std::vector<double> N, dN;
            evaluate(knots, degree, x, N, dN);
            for (unsigned int i = 0; i < n; ++i)
              for (unsigned int j = 0; j < n; ++j)
                {
                  NN[i][j] += weights[q] * N[i] * N[j];
                  DN[i][j] += weights[q] * dN[i] * N[j];
                  DD[i][j] += weights[q] * dN[i] * dN[j];
                }
          }
    }

    const unsigned int               n;
    std::vector<std::vector<double>> NN, DN, DD;

  private:
    void
    evaluate(const std::vector<double> &knots,
             const unsigned int         degree,
             const double               x,
             std::vector<double>       &N,
             std::vector<double>       &dN) const
    {
      N.assign(knots.size() - 1, 0.);
      for (unsigned int i = 0; i + 1 < knots.size(); ++i)
        N[i] = knots[i] <= x && x < knots[i + 1];
      dN.assign(n, 0.);
      for (unsigned int p = 1; p <= degree; ++p)
        {
          const std::vector<double> old = N;
          for (unsigned int i = 0; i + p + 1 < knots.size(); ++i)
            {
              const double left  = knots[i + p] - knots[i];
              const double right = knots[i + p + 1] - knots[i + 1];
              N[i] =
                (left > 0 ? (x - knots[i]) / left * old[i] : 0.) +
                (right > 0 ? (knots[i + p + 1] - x) / right * old[i + 1] : 0.);
              if (p == degree)
                dN[i] = (left > 0 ? p / left * old[i] : 0.) -
                        (right > 0 ? p / right * old[i + 1] : 0.);
            }
        }
      N.resize(n);
    }
  };

  struct ElasticBlock
  {
    CSRMatrix                           matrix;
    std::vector<dealii::Vector<double>> rigid_body_modes; // if degree is 1
  };

  /**
   * Three unknowns per control point, numbered point by point; E = 1,
   * nu = 0.3.
   *
   * @param foundation Normal stiffness per control point of the lower face;
   *   zero leaves the box free.
   * @param friction   Ratio of tangential to normal force there; makes the
   *   matrix unsymmetric.
   */
  inline ElasticBlock
  make_elastic_block(const std::array<unsigned int, 3> n_spans,
                     const unsigned int                degree,
                     const double                      foundation,
                     const double                      friction = 0)
  {
    const double lambda = 0.3 / (1.3 * 0.4), mu = 0.5 / 1.3;

    const std::array<LineMatrices, 3> line{
      {{n_spans[0], degree}, {n_spans[1], degree}, {n_spans[2], degree}}};

    const int  nx = line[0].n, ny = line[1].n, nz = line[2].n;
    const int  n_points = nx * ny * nz;
    const auto point    = [&](const std::array<int, 3> &i) {
      return (i[2] * ny + i[1]) * nx + i[0];
    };

    std::vector<std::array<int, 3>> index(n_points);
    for (int z = 0; z < nz; ++z)
      for (int y = 0; y < ny; ++y)
        for (int x = 0; x < nx; ++x)
          index[point({{x, y, z}})] = {{x, y, z}};

    ElasticBlock                  block;
    std::vector<std::vector<int>> columns(3 * n_points);
    std::vector<std::vector<int>> neighbors(n_points);
    const int                     p = degree;
    for (int a = 0; a < n_points; ++a)
      for (int z = -p; z <= p; ++z)
        for (int y = -p; y <= p; ++y)
          for (int x = -p; x <= p; ++x)
            {
              const std::array<int, 3> i{
                {index[a][0] + x, index[a][1] + y, index[a][2] + z}};
              if (std::min({i[0], i[1], i[2]}) < 0 || i[0] >= nx ||
                  i[1] >= ny || i[2] >= nz)
                continue;
              neighbors[a].push_back(point(i));
              for (int c = 0; c < 3; ++c)
                for (int d = 0; d < 3; ++d)
                  columns[3 * a + c].push_back(3 * point(i) + d);
            }
    block.matrix.set_pattern(columns);

    for (int a = 0; a < n_points; ++a)
      for (const int b : neighbors[a])
        {
          // G[c][d] = integral of N_a,c N_b,d
          double G[3][3];
          for (int c = 0; c < 3; ++c)
            for (int d = 0; d < 3; ++d)
              {
                G[c][d] = 1;
                for (int e = 0; e < 3; ++e)
                  {
                    const int i = index[a][e], j = index[b][e];
                    G[c][d] *= (e == c && e == d) ? line[e].DD[i][j] :
                               e == c             ? line[e].DN[i][j] :
                               e == d             ? line[e].DN[j][i] :
                                                    line[e].NN[i][j];
                  }
              }
          const double trace = G[0][0] + G[1][1] + G[2][2];
          for (int c = 0; c < 3; ++c)
            for (int d = 0; d < 3; ++d)
              block.matrix
                .values[block.matrix.position(3 * a + c, 3 * b + d)] +=
                lambda * G[c][d] + mu * G[d][c] + (c == d ? mu * trace : 0.);
        }
    for (int a = 0; a < n_points; ++a)
      if (index[a][2] == 0)
        {
          for (int c = 0; c < 3; ++c)
            block.matrix.values[block.matrix.position(3 * a + c, 3 * a + c)] +=
              foundation;
          block.matrix.values[block.matrix.position(3 * a, 3 * a + 2)] +=
            friction * foundation;
        }

    if (degree == 1) // then control points sit at their indices
      {
        block.rigid_body_modes.assign(6, dealii::Vector<double>(3 * n_points));
        for (int a = 0; a < n_points; ++a)
          for (int c = 0; c < 3; ++c)
            {
              const int d = (c + 1) % 3, e = (c + 2) % 3;
              block.rigid_body_modes[c][3 * a + c]     = 1;
              block.rigid_body_modes[3 + c][3 * a + d] = -index[a][e];
              block.rigid_body_modes[3 + c][3 * a + e] = index[a][d];
            }
      }
    return block;
  }
} // namespace NPT

#endif
