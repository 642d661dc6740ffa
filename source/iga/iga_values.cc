// SPDX-License-Identifier: LGPL-2.1-or-later
// Shape functions of a cell at its Gauss points.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/iga/iga_values.h>

#include <deal.II/base/quadrature_lib.h>

namespace NPT
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    // Symmetric pairs (i,j) of second derivatives in a fixed order.
    template <int dim>
    std::vector<std::pair<unsigned int, unsigned int>>
    pairs()
    {
      std::vector<std::pair<unsigned int, unsigned int>> result;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = i; j < dim; ++j)
          result.emplace_back(i, j);
      return result;
    }
  } // namespace



  template <int dim>
  IGAValues<dim>::IGAValues(const IGASpace<dim> &space,
                            const unsigned int   n_points,
                            const bool           second_derivatives)
    : space_(space)
    , n_points_(n_points)
    , second_derivatives_(second_derivatives)
  {}



  template <int dim>
  const typename IGAValues<dim>::Tabulated &
  IGAValues<dim>::tabulate(const unsigned int patch)
  {
    const unsigned int p     = space_.degree(patch);
    const auto         known = tables_.find(p);
    if (known != tables_.end())
      return known->second;

    const dealii::QGauss<1> quadrature(n_points_ > 0 ? n_points_ : p + 1);
    const auto             &polynomials = space_.local_polynomials(patch);

    Tabulated table;
    table.weights = quadrature.get_weights();
    table.data.reinit(quadrature.size(), 3, p + 1);
    std::vector<double> derivatives(3);
    for (unsigned int q = 0; q < quadrature.size(); ++q)
      for (unsigned int b = 0; b <= p; ++b)
        {
          polynomials[b].value(quadrature.point(q)[0], derivatives);
          for (unsigned int k = 0; k < 3; ++k)
            table.data(q, k, b) = derivatives[k];
        }
    return tables_.emplace(p, table).first->second;
  }



  template <int dim>
  void
  IGAValues<dim>::reinit(const unsigned int c)
  {
    const auto            &cell   = space_.cells()[c];
    const NURBSPatch<dim> &patch  = space_.patch(cell.patch);
    const Tabulated       &table  = tabulate(cell.patch);
    const auto             second = pairs<dim>();
    const unsigned int     p      = space_.degree(cell.patch);
    const unsigned int     n_1    = p + 1;
    const unsigned int     n_q_1  = table.weights.size();
    const unsigned int     n_derivatives =
      second_derivatives_ ? 1 + dim + second.size() : 1 + dim;
    unsigned int n = 1, n_q = 1;
    for (unsigned int d = 0; d < dim; ++d)
      {
        n *= n_1;
        n_q *= n_q_1;
      }

    indices_ = space_.control_points_of_cell(c);
    value_.reinit(n, n_q);
    gradient_.reinit(n, n_q);
    if (second_derivatives_)
      hessian_.reinit(n, n_q);
    jxw_.resize(n_q);
    position_.resize(n_q);

    // B-splines of each direction and their parametric derivatives at its
    // Gauss points, N = C B: [point][derivative][function].
    std::array<std::vector<double>, dim> N_1;
    double                               volume = 1;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const auto  &breaks = patch.knot_vector(d).breaks();
        const double length = breaks[cell.span[d] + 1] - breaks[cell.span[d]];
        const auto &C = space_.extraction_operator(cell.patch, d, cell.span[d]);
        volume *= length;
        N_1[d].resize(n_q_1 * 3 * n_1);
        for (unsigned int q = 0; q < n_q_1; ++q)
          {
            double scale = 1;
            for (unsigned int k = 0; k < 3; ++k)
              {
                for (unsigned int i = 0; i < n_1; ++i)
                  {
                    double sum = 0;
                    for (unsigned int b = 0; b < n_1; ++b)
                      sum += C(i, b) * table.data(q, k, b);
                    N_1[d][(q * 3 + k) * n_1 + i] = scale * sum;
                  }
                scale /= length;
              }
          }
      }

    const std::vector<double>       &weights = space_.weights();
    std::vector<std::vector<double>> N(n_derivatives, std::vector<double>(n));
    for (unsigned int q = 0; q < n_q; ++q)
      {
        // Products of the directions; the first one runs fastest.
        double point_weight = 1;
        for (unsigned int k = 0; k < n_derivatives; ++k)
          {
            const double *factor[dim];
            unsigned int  rest = q;
            for (unsigned int d = 0; d < dim; ++d)
              {
                unsigned int order = k == 1 + d ? 1 : 0;
                if (k > dim)
                  order = (second[k - 1 - dim].first == d ? 1 : 0) +
                          (second[k - 1 - dim].second == d ? 1 : 0);
                factor[d] = &N_1[d][((rest % n_q_1) * 3 + order) * n_1];
                if (k == 0)
                  point_weight *= table.weights[rest % n_q_1];
                rest /= n_q_1;
              }
            for (unsigned int a = 0; a < n; ++a)
              {
                double       product = 1;
                unsigned int index   = a;
                for (unsigned int d = 0; d < dim; ++d)
                  {
                    product *= factor[d][index % n_1];
                    index /= n_1;
                  }
                N[k][a] = product;
              }
          }

        // Rational functions by the quotient rule.
        std::vector<double> W(n_derivatives, 0.);
        for (unsigned int k = 0; k < n_derivatives; ++k)
          for (unsigned int a = 0; a < n; ++a)
            {
              N[k][a] *= weights[indices_[a]];
              W[k] += N[k][a];
            }
        for (unsigned int a = 0; a < n; ++a)
          {
            const double R = N[0][a] / W[0];
            N[0][a]        = R;
            for (unsigned int d = 0; d < dim; ++d)
              N[1 + d][a] = (N[1 + d][a] - R * W[1 + d]) / W[0];
            for (unsigned int k = 1 + dim; k < n_derivatives; ++k)
              {
                const unsigned int i = second[k - 1 - dim].first;
                const unsigned int j = second[k - 1 - dim].second;
                N[k][a]              = (N[k][a] - N[1 + i][a] * W[1 + j] -
                           N[1 + j][a] * W[1 + i] - R * W[k]) /
                          W[0];
              }
          }

        // Reference geometry.
        Tensor<2, dim>              J;
        std::vector<Tensor<1, dim>> X_second(n_derivatives - 1 - dim);
        Point<dim>                  X;
        for (unsigned int a = 0; a < n; ++a)
          {
            const Point<dim> &P = space_.control_points()[indices_[a]];
            X += N[0][a] * P;
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int d = 0; d < dim; ++d)
                J[i][d] += N[1 + d][a] * P[i];
            for (unsigned int k = 0; k < X_second.size(); ++k)
              X_second[k] += N[1 + dim + k][a] * P;
          }
        const double det = determinant(J);
        if (!(det > 0))
          throw InvertedCell(
            "the reference geometry of cell " + std::to_string(c) +
            " is folded (det J = " + std::to_string(det) + ")");
        const Tensor<2, dim> J_inverse = invert(J);
        jxw_[q]                        = det * volume * point_weight;
        position_[q]                   = X;

        for (unsigned int a = 0; a < n; ++a)
          {
            value_(a, q) = N[0][a];
            Tensor<1, dim> gradient;
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int d = 0; d < dim; ++d)
                gradient[i] += J_inverse[d][i] * N[1 + d][a];
            gradient_(a, q) = gradient;

            if (second_derivatives_)
              {
                // d2R/dX2 = J^-T (d2R/dxi2 - dR/dX_k d2X_k/dxi2) J^-1.
                Tensor<2, dim> parametric;
                for (unsigned int k = 0; k < second.size(); ++k)
                  {
                    const double value =
                      N[1 + dim + k][a] - gradient * X_second[k];
                    parametric[second[k].first][second[k].second] = value;
                    parametric[second[k].second][second[k].first] = value;
                  }
                hessian_(a, q) = transpose(J_inverse) * parametric * J_inverse;
              }
          }
      }
  }

  template class IGAValues<2>;
  template class IGAValues<3>;
} // namespace NPT
