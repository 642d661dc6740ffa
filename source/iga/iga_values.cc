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

    const dealii::QGauss<dim> quadrature(n_points_ > 0 ? n_points_ : p + 1);
    const auto               &element = space_.reference_element(patch);
    const auto               &order   = space_.lexicographic_numbering(patch);
    const auto                second  = pairs<dim>();
    const unsigned int        n       = element.n_dofs_per_cell();

    Tabulated table;
    table.weights = quadrature.get_weights();
    table.data.reinit(1 + dim + second.size(), quadrature.size(), n);
    for (unsigned int q = 0; q < quadrature.size(); ++q)
      for (unsigned int a = 0; a < n; ++a)
        {
          const Point<dim> &x = quadrature.point(q);
          table.data(0, q, a) = element.shape_value(order[a], x);
          const auto gradient = element.shape_grad(order[a], x);
          for (unsigned int d = 0; d < dim; ++d)
            table.data(1 + d, q, a) = gradient[d];
          const auto hessian = element.shape_grad_grad(order[a], x);
          for (unsigned int k = 0; k < second.size(); ++k)
            table.data(1 + dim + k, q, a) =
              hessian[second[k].first][second[k].second];
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
    const unsigned int     n      = table.data.size(2);
    const unsigned int     n_q    = table.data.size(1);
    const unsigned int     n_derivatives =
      second_derivatives_ ? table.data.size(0) : 1 + dim;

    indices_ = space_.control_points_of_cell(c);
    value_.reinit(n, n_q);
    gradient_.reinit(n, n_q);
    if (second_derivatives_)
      hessian_.reinit(n, n_q);
    jxw_.resize(n_q);
    position_.resize(n_q);

    std::array<double, dim> length;
    double                  volume = 1;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const auto &breaks = patch.knot_vector(d).breaks();
        length[d]          = breaks[cell.span[d] + 1] - breaks[cell.span[d]];
        volume *= length[d];
      }
    std::vector<double> scale(table.data.size(0), 1.);
    for (unsigned int d = 0; d < dim; ++d)
      scale[1 + d] = 1. / length[d];
    for (unsigned int k = 0; k < second.size(); ++k)
      scale[1 + dim + k] =
        1. / (length[second[k].first] * length[second[k].second]);

    const std::vector<double>       &weights = space_.weights();
    std::vector<std::vector<double>> N(n_derivatives);
    std::vector<double>              scratch(n);
    for (unsigned int q = 0; q < n_q; ++q)
      {
        // B-splines and their parametric derivatives: N = (C x C x C) B,
        // one direction after the other.
        for (unsigned int k = 0; k < n_derivatives; ++k)
          {
            N[k].resize(n);
            for (unsigned int a = 0; a < n; ++a)
              N[k][a] = scale[k] * table.data(k, q, a);
            unsigned int stride = 1;
            for (unsigned int d = 0; d < dim; ++d)
              {
                const auto &C =
                  space_.extraction_operator(cell.patch, d, cell.span[d]);
                for (unsigned int a = 0; a < n; ++a)
                  {
                    const unsigned int i    = (a / stride) % (p + 1);
                    const unsigned int base = a - i * stride;
                    double             sum  = 0;
                    for (unsigned int b = 0; b <= p; ++b)
                      sum += C(i, b) * N[k][base + b * stride];
                    scratch[a] = sum;
                  }
                N[k].swap(scratch);
                scratch.resize(n);
                stride *= p + 1;
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
        jxw_[q]                        = det * volume * table.weights[q];
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
