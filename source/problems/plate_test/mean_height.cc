// SPDX-License-Identifier: LGPL-2.1-or-later
// The mean height of a bent cell.

#include <npt_dealii/problems/plate_test/mean_height.h>

#include <deal.II/lac/full_matrix.h>

#include <cmath>

namespace NPT
{
  using dealii::Tensor;
  using dealii::Vector;

  MeanHeight::MeanHeight(const PlateCell    &cell,
                         const Tensor<1, 2> &direction,
                         const double        stiffness)
    : cell_(&cell)
    , motion_(direction)
    , stiffness_(stiffness)
  {
    for (const double integral : cell.bodies().integrals_of_functions(true))
      volume_ += integral;
  }



  void
  MeanHeight::add_groups(const DeformableBodies::CellGroups &cells,
                         ConstrainedSystem                  &system)
  {
    const DeformableBodies &bodies = cell_->bodies();
    groups_                        = cells;
    for (unsigned int c = 0; c < groups_.size(); ++c)
      if (groups_[c] != dealii::numbers::invalid_unsigned_int)
        {
          std::vector<unsigned int> unknowns = bodies.cell_unknowns(c);
          for (unsigned int n = 0; n < MacroUnknowns::n_modes; ++n)
            unknowns.push_back(cell_->macro().mode(n));
          unknowns.push_back(cell_->macro().support());
          groups_[c] = system.add_group(unknowns);
        }
  }



  // With r = sqrt(1 + k q) = 1 + k d the derivatives of d(q, k) follow from
  // q = 2 d + k d^2, also at k = 0.
  MeanHeight::Height::Height(const std::array<double, n_circle> &circle,
                             const Tensor<1, dim>               &x,
                             const bool                          with_hessian)
  {
    const auto [k, b1, b2] = circle;
    const double along     = b1 * x[0] + b2 * x[1];
    const double square    = x[2] * x[2] + along * along;
    const double q         = 2. * x[2] + k * square;
    const double r         = std::sqrt(1. + k * q);
    const double d         = q / (r + 1.);
    const double d_q       = 0.5 / r;
    const double d_k       = -d_q * d * d;
    // q and its derivatives; the variables are x, k, b.
    constexpr unsigned int          at_k = dim, at_b = dim + 1;
    const double                    b[] = {b1, b2};
    std::array<double, n_variables> q_1{};
    q_1[2]    = 2. + 2. * k * x[2];
    q_1[at_k] = square;
    for (unsigned int i = 0; i < 2; ++i)
      {
        q_1[i]        = 2. * k * along * b[i];
        q_1[at_b + i] = 2. * k * along * x[i];
      }
    value = d;
    for (unsigned int v = 0; v < n_variables; ++v)
      gradient[v] = d_q * q_1[v] + (v == at_k ? d_k : 0.);
    if (!with_hessian)
      return;

    const double d_qq = -k * d_q * d_q / r;
    const double d_qk = -d * (1. + r) * d_q * d_q / r;
    const double d_kk = d * d * d * (3. * r + 1.) * d_q * d_q / r;
    hessian           = {};
    hessian[2][2]     = 2. * k;
    hessian[2][at_k]  = 2. * x[2];
    for (unsigned int i = 0; i < 2; ++i)
      {
        hessian[i][at_k]        = 2. * along * b[i];
        hessian[at_k][at_b + i] = 2. * along * x[i];
        for (unsigned int j = 0; j < 2; ++j)
          {
            hessian[i][j]               = 2. * k * b[i] * b[j];
            hessian[at_b + i][at_b + j] = 2. * k * x[i] * x[j];
            hessian[i][at_b + j] =
              2. * k * (x[j] * b[i] + (i == j ? along : 0.));
          }
      }

    // Above the diagonal first.
    for (unsigned int v = 0; v < n_variables; ++v)
      for (unsigned int w = v; w < n_variables; ++w)
        hessian[v][w] = d_q * hessian[v][w] + d_qq * q_1[v] * q_1[w] +
                        (w == at_k ? d_qk * q_1[v] : 0.) +
                        (v == at_k ? d_qk * q_1[w] : 0.) +
                        (v == at_k && w == at_k ? d_kk : 0.);
    for (unsigned int v = 0; v < n_variables; ++v)
      for (unsigned int w = 0; w < v; ++w)
        hessian[v][w] = hessian[w][v];
  }



  std::array<SecondOrder<MacroModes::n>, MeanHeight::n_circle>
  MeanHeight::circle(const Vector<double> &u) const
  {
    const CylinderMotion::Circle of_H =
      motion_->circle(gradients_of(cell_->macro(), u));
    return {{of_H.curvature, of_H.direction[0], of_H.direction[1]}};
  }



  void
  MeanHeight::positions(const unsigned int    c,
                        const Vector<double> &u,
                        std::vector<double>  &x) const
  {
    const unsigned int n        = cell_->bodies().gradients()[c].n_functions;
    const auto        &unknowns = cell_->bodies().cell_unknowns(c);
    const auto        &X        = cell_->bodies().space().control_points();
    x.resize(dim * n);
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int a = 0; a < n; ++a)
        {
          const unsigned int k = unknowns[i * n + a];
          x[i * n + a]         = X[k / dim][i] + u[k];
        }
  }



  namespace
  {
    std::array<double, MeanHeight::n_circle>
    values_of(const std::array<SecondOrder<MacroModes::n>, MeanHeight::n_circle>
                &circle)
    {
      return {{circle[0].value, circle[1].value, circle[2].value}};
    }

    // sum_A R_A x_A, by component.
    Tensor<1, 3>
    interpolate(const double              *R,
                const unsigned int         n,
                const std::vector<double> &x)
    {
      Tensor<1, 3> sum;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int a = 0; a < n; ++a)
          sum[i] += R[a] * x[i * n + a];
      return sum;
    }
  } // namespace



  double
  MeanHeight::force(const Vector<double> &u) const
  {
    return stiffness_ * u[cell_->macro().support()];
  }



  double
  MeanHeight::differentiate(const Vector<double> &u,
                            const IsCounted      &is_counted,
                            Vector<double>       &gradient) const
  {
    const DeformableBodies &bodies = cell_->bodies();
    const auto              of_H   = circle(u);
    const auto              at     = values_of(of_H);
    std::vector<double>     x;
    double                  height = 0, on_circle[n_circle] = {};
    gradient.reinit(u.size());
    for (unsigned int c = 0; c < bodies.gradients().size(); ++c)
      if (is_counted(c))
        {
          const CellGradients &cell     = bodies.gradients()[c];
          const unsigned int   n        = cell.n_functions;
          const auto          &unknowns = bodies.cell_unknowns(c);
          positions(c, u, x);
          for (unsigned int q = 0; q < cell.n_points; ++q)
            {
              const double *R = &cell.values[q * n];
              const double  share =
                bodies.symmetry_weight(c) * cell.jxw[q] / volume_;
              const Height d(at, interpolate(R, n, x), false);
              height += share * d.value;
              for (unsigned int m = 0; m < n_circle; ++m)
                on_circle[m] += share * d.gradient[dim + m];
              for (unsigned int i = 0; i < dim; ++i)
                for (unsigned int a = 0; a < n; ++a)
                  gradient[unknowns[i * n + a]] += share * d.gradient[i] * R[a];
            }
        }
    for (unsigned int k = 0; k < MacroModes::n; ++k)
      for (unsigned int m = 0; m < n_circle; ++m)
        gradient[cell_->macro().mode(k)] += on_circle[m] * of_H[m].gradient[k];
    return height;
  }



  double
  MeanHeight::value(const Vector<double> &u) const
  {
    Vector<double> gradient;
    return differentiate(
      u,
      [this](const unsigned int c) {
        return cell_->bodies().symmetry_weight(c) > 0;
      },
      gradient);
  }



  void
  MeanHeight::add_residual(const Vector<double> &u,
                           Vector<double>       &residual) const
  {
    if (cell_ == nullptr)
      return;
    Vector<double> gradient;
    const double   height = differentiate(
      u,
      [this](const unsigned int c) {
        return cell_->bodies().symmetry_weight(c) > 0;
      },
      gradient);
    residual.add(force(u), gradient);
    residual[cell_->macro().support()] += stiffness_ * height;
  }



  // c s d^2 d / dx^2 is left out where it is this small against the forces of
  // the bundles: without tension, s is zero, and Newton's method does not
  // notice 1e-7 of the stiffness.
  constexpr double negligible_force = 1e-4;

  void
  MeanHeight::add_tangent(const Vector<double> &u,
                          const double          force_scale,
                          ConstrainedSystem    &system) const
  {
    if (cell_ == nullptr)
      return;
    const auto is_mine = [this](const unsigned int c) {
      return groups_[c] != dealii::numbers::invalid_unsigned_int;
    };
    Vector<double> gradient;
    differentiate(u, is_mine, gradient);
    gradient *= stiffness_;
    system.add_border(cell_->macro().support(), gradient);
    if (std::abs(force(u)) <= negligible_force * force_scale)
      return;

    const DeformableBodies &bodies = cell_->bodies();
    const auto              of_H   = circle(u);
    const auto              at     = values_of(of_H);
    const double            force  = this->force(u);
    std::vector<double>     x, K;
    for (unsigned int c = 0; c < groups_.size(); ++c)
      {
        if (!is_mine(c))
          continue;
        const CellGradients &cell = bodies.gradients()[c];
        const unsigned int   n = cell.n_functions, n_q = cell.n_points;
        positions(c, u, x);
        std::vector<Height> d;
        Vector<double>      share(n_q);
        for (unsigned int q = 0; q < n_q; ++q)
          {
            d.emplace_back(at, interpolate(&cell.values[q * n], n, x), true);
            share[q] = bodies.symmetry_weight(c) * cell.jxw[q] / volume_;
          }

        // Unknowns in this order: positions by component, H1..H6, s, whose
        // row is there already.
        const unsigned int first_H = dim * n,
                           size    = first_H + MacroModes::n + 1;
        K.assign(size * size, 0.);
        const auto set = [&](const unsigned int row,
                             const unsigned int column,
                             const double       value) {
          K[row * size + column] = K[column * size + row] = value;
        };

        // int F_A F_B w and int F_A w, for functions F and a weight w.
        const dealii::FullMatrix<double> F(n_q, n, cell.values.data());
        dealii::FullMatrix<double>       weighted(n_q, n), matrix(n, n);
        Vector<double>                   weight(n_q), integrals(n);
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = i; j < dim; ++j)
            {
              for (unsigned int q = 0; q < n_q; ++q)
                for (unsigned int a = 0; a < n; ++a)
                  weighted(q, a) =
                    force * share[q] * d[q].hessian[i][j] * F(q, a);
              F.Tmmult(matrix, weighted);
              for (unsigned int a = 0; a < n; ++a)
                for (unsigned int b = 0; b < n; ++b)
                  set(i * n + a, j * n + b, matrix(a, b));
            }
        for (unsigned int i = 0; i < dim; ++i)
          {
            for (unsigned int m = 0; m < n_circle; ++m)
              {
                for (unsigned int q = 0; q < n_q; ++q)
                  weight[q] = force * share[q] * d[q].hessian[i][dim + m];
                F.Tvmult(integrals, weight);
                for (unsigned int a = 0; a < n; ++a)
                  for (unsigned int k = 0; k < MacroModes::n; ++k)
                    set(i * n + a,
                        first_H + k,
                        K[(i * n + a) * size + first_H + k] +
                          integrals[a] * of_H[m].gradient[k]);
              }
          }

        // The sums of all points as a function of H, by the chain rule.
        double slope[n_circle] = {}, curvature[n_circle][n_circle] = {};
        for (unsigned int q = 0; q < n_q; ++q)
          for (unsigned int m = 0; m < n_circle; ++m)
            {
              slope[m] += share[q] * d[q].gradient[dim + m];
              for (unsigned int o = 0; o < n_circle; ++o)
                curvature[m][o] += share[q] * d[q].hessian[dim + m][dim + o];
            }
        for (unsigned int k = 0; k < MacroModes::n; ++k)
          for (unsigned int l = 0; l < MacroModes::n; ++l)
            {
              double sum = 0;
              for (unsigned int m = 0; m < n_circle; ++m)
                {
                  sum += slope[m] * of_H[m].hessian[k][l];
                  for (unsigned int o = 0; o < n_circle; ++o)
                    sum += curvature[m][o] * of_H[m].gradient[k] *
                           of_H[o].gradient[l];
                }
              K[(first_H + k) * size + first_H + l] = force * sum;
            }
        system.add(groups_[c], K);
      }
  }
} // namespace NPT
