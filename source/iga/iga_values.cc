// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the shape functions of a cell at its Gauss points.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/iga/iga_values.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/utilities.h>
#include <deal.II/fe/fe_bernstein.h>

namespace NPT
{
  using dealii::Point;
  using dealii::Tensor;

  template <int dim>
  IGAValues<dim>::IGAValues(const IGASpace<dim> &space,
                            const unsigned int   n_points)
    : space_(space)
    , n_points_(n_points)
  {
    for (unsigned int i = 0; i < space.n_patches(); ++i)
      {
        const unsigned int p   = space.degree(i);
        const unsigned int n_q = n_points > 0 ? n_points : p + 1;
        if (space.basis() == Basis::NURBS)
          {
            if (line_tables_.count(p) == 0)
              line_tables_.emplace(p,
                                   ElementTable<1>(dealii::FE_Bernstein<1>(p),
                                                   dealii::QGauss<1>(n_q)));
          }
        else if (element_tables_.count(p) == 0)
          element_tables_.emplace(p,
                                  ElementTable<dim>(space.reference_element(i),
                                                    dealii::QGauss<dim>(n_q)));
      }
  }



  template <int dim>
  void
  IGAValues<dim>::reinit(const CellIterator &cell)
  {
    Assert(&cell->get_triangulation() == &space_.triangulation(),
           dealii::ExcMessage("A cell of another space."));
    const unsigned int c = cell->active_cell_index();
    indices_             = space_.control_points_of_cell(c);
    if (space_.basis() == Basis::NURBS)
      evaluate_splines(c);
    else
      evaluate_element(c);

    // Splines are always divided by their sum; the twins are the functions of
    // the element where they have no weights.
    const bool divide = space_.basis() == Basis::NURBS ||
                        space_.patch(cell->material_id()).is_rational();
    const unsigned int n = indices_.size(), n_q = parametric_weight_.size();
    value_.reinit(n, n_q);
    gradient_.reinit(n, n_q);
    jxw_.resize(n_q);
    position_.resize(n_q);
    for (unsigned int q = 0; q < n_q; ++q)
      {
        if (divide)
          divide_by_weight_function(q);
        map_to_reference_configuration(c, q);
      }
  }



  template <int dim>
  void
  IGAValues<dim>::evaluate_splines(const unsigned int c)
  {
    const auto            &cell  = space_.cells()[c];
    const ElementTable<1> &table = line_tables_.at(space_.degree(cell.patch));
    const unsigned int     n_1   = space_.degree(cell.patch) + 1;
    const unsigned int     n_q_1 = table.weights.size();

    // B-splines of each direction and their parametric derivatives at its
    // Gauss points, N = C B: [point][derivative][function].
    std::array<std::vector<double>, dim> N_1;
    parametric_volume_ = 1;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const auto  &breaks = space_.patch(cell.patch).knot_vector(d).breaks();
        const double length = breaks[cell.span[d] + 1] - breaks[cell.span[d]];
        const auto &C = space_.extraction_operator(cell.patch, d, cell.span[d]);
        parametric_volume_ *= length;
        N_1[d].resize(n_q_1 * 2 * n_1);
        for (unsigned int q = 0; q < n_q_1; ++q)
          for (unsigned int i = 0; i < n_1; ++i)
            {
              double value = 0, derivative = 0;
              for (unsigned int b = 0; b < n_1; ++b)
                {
                  value += C(i, b) * table.values(q, b);
                  derivative += C(i, b) * table.gradients(q, b)[0];
                }
              N_1[d][(q * 2 + 0) * n_1 + i] = value;
              N_1[d][(q * 2 + 1) * n_1 + i] = 1. / length * derivative;
            }
      }

    // Products of the directions; the first one runs fastest.
    const unsigned int n   = indices_.size();
    const unsigned int n_q = dealii::Utilities::fixed_power<dim>(n_q_1);
    functions_.reinit(n_q, 1 + dim, n);
    parametric_weight_.resize(n_q);
    for (unsigned int q = 0; q < n_q; ++q)
      {
        double                          weight = 1;
        unsigned int                    rest_q = q;
        std::array<const double *, dim> N_q;
        for (unsigned int d = 0; d < dim; ++d)
          {
            N_q[d] = &N_1[d][(rest_q % n_q_1) * 2 * n_1];
            weight *= table.weights[rest_q % n_q_1];
            rest_q /= n_q_1;
          }
        parametric_weight_[q] = weight;
        for (unsigned int k = 0; k < 1 + dim; ++k)
          {
            // Direction by direction, in place: the last factor first, so that
            // the products so far are overwritten last.
            double *const product = &functions_(q, k, 0);
            unsigned int  size    = 1;
            product[0]            = 1;
            for (unsigned int d = 0; d < dim; ++d, size *= n_1)
              {
                const double *const factor = N_q[d] + (k == 1 + d ? n_1 : 0);
                for (int j = n_1 - 1; j >= 0; --j)
                  for (unsigned int i = 0; i < size; ++i)
                    product[j * size + i] = product[i] * factor[j];
              }
          }
      }
  }



  template <int dim>
  void
  IGAValues<dim>::evaluate_element(const unsigned int c)
  {
    const auto              &cell = space_.cells()[c];
    const ElementTable<dim> &table =
      element_tables_.at(space_.degree(cell.patch));
    const unsigned int n = indices_.size(), n_q = table.weights.size();

    Tensor<1, dim> length;
    parametric_volume_ = 1;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const auto &breaks = space_.patch(cell.patch).knot_vector(d).breaks();
        length[d]          = breaks[cell.span[d] + 1] - breaks[cell.span[d]];
        parametric_volume_ *= length[d];
      }
    functions_.reinit(n_q, 1 + dim, n);
    parametric_weight_.resize(n_q);
    for (unsigned int q = 0; q < n_q; ++q)
      {
        parametric_weight_[q] = table.weights[q];
        for (unsigned int a = 0; a < n; ++a)
          {
            functions_(q, 0, a) = table.values(q, a);
            for (unsigned int d = 0; d < dim; ++d)
              functions_(q, 1 + d, a) = table.gradients(q, a)[d] / length[d];
          }
      }
  }



  template <int dim>
  void
  IGAValues<dim>::divide_by_weight_function(const unsigned int q)
  {
    const std::vector<double>  &weights = space_.weights();
    const unsigned int          n       = indices_.size();
    std::array<double, 1 + dim> W       = {};
    for (unsigned int k = 0; k < 1 + dim; ++k)
      for (unsigned int a = 0; a < n; ++a)
        W[k] += functions_(q, k, a) *= weights[indices_[a]];
    for (unsigned int a = 0; a < n; ++a)
      {
        const double R      = functions_(q, 0, a) / W[0];
        functions_(q, 0, a) = R;
        for (unsigned int d = 0; d < dim; ++d)
          functions_(q, 1 + d, a) =
            (functions_(q, 1 + d, a) - R * W[1 + d]) / W[0];
      }
  }



  template <int dim>
  void
  IGAValues<dim>::map_to_reference_configuration(const unsigned int c,
                                                 const unsigned int q)
  {
    const unsigned int n = indices_.size();
    Tensor<2, dim>     J;
    Point<dim>         X;
    for (unsigned int a = 0; a < n; ++a)
      {
        const Point<dim> &P = space_.control_points()[indices_[a]];
        X += functions_(q, 0, a) * P;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int d = 0; d < dim; ++d)
            J[i][d] += functions_(q, 1 + d, a) * P[i];
      }
    const double det = determinant(J);
    if (!(det > 0))
      throw InvertedCell("the reference geometry of cell " + std::to_string(c) +
                         " is folded (det J = " + std::to_string(det) + ")");
    const Tensor<2, dim> J_inverse = invert(J);
    jxw_[q]      = det * parametric_volume_ * parametric_weight_[q];
    position_[q] = X;

    for (unsigned int a = 0; a < n; ++a)
      {
        value_(a, q) = functions_(q, 0, a);
        Tensor<1, dim> gradient;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int d = 0; d < dim; ++d)
            gradient[i] += J_inverse[d][i] * functions_(q, 1 + d, a);
        gradient_(a, q) = gradient;
      }
  }

  template class IGAValues<2>;
  template class IGAValues<3>;
} // namespace NPT
