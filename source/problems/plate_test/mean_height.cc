// SPDX-License-Identifier: LGPL-2.1-or-later
// The mean height of a bent cell.

#include <npt_dealii/problems/plate_test/mean_height.h>

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



  MeanHeight::Circle
  MeanHeight::circle(const Vector<double> &u) const
  {
    const CylinderMotion::Circle of_H =
      motion_->circle(gradients_of(cell_->macro(), u));
    const auto as_number = [](const SecondOrder<MacroModes::n> &a) {
      Number result = Number::constant(a.value);
      for (unsigned int n = 0; n < MacroModes::n; ++n)
        {
          result.gradient[3 + n] = a.gradient[n];
          for (unsigned int m = 0; m < MacroModes::n; ++m)
            result.hessian[3 + n][3 + m] = a.hessian[n][m];
        }
      return result;
    };
    return {as_number(of_H.curvature),
            {as_number(of_H.direction[0]), as_number(of_H.direction[1])}};
  }



  MeanHeight::Number
  MeanHeight::height(const Circle &circle, const Tensor<1, 3> &x) const
  {
    const Number x3    = Number::variable(2, x[2]);
    const Number along = circle.direction[0] * Number::variable(0, x[0]) +
                         circle.direction[1] * Number::variable(1, x[1]);
    const Number &k   = circle.curvature;
    const Number  q   = 2. * x3 + k * (x3 * x3 + along * along);
    const Number  one = Number::constant(1.);
    return q * inverse(square_root(one + k * q) + one);
  }



  Tensor<1, 3>
  MeanHeight::position(const unsigned int    c,
                       const unsigned int    q,
                       const Vector<double> &u) const
  {
    const CellGradients &cell     = cell_->bodies().gradients()[c];
    const auto          &unknowns = cell_->bodies().cell_unknowns(c);
    const auto          &X        = cell_->bodies().space().control_points();
    Tensor<1, 3>         x;
    for (unsigned int a = 0; a < cell.n_functions; ++a)
      for (unsigned int i = 0; i < 3; ++i)
        {
          const unsigned int k = unknowns[i * cell.n_functions + a];
          x[i] += cell.values[q * cell.n_functions + a] * (X[k / 3][i] + u[k]);
        }
    return x;
  }



  double
  MeanHeight::force(const Vector<double> &u) const
  {
    return stiffness_ * u[cell_->macro().support()];
  }



  double
  MeanHeight::value(const Vector<double> &u) const
  {
    const DeformableBodies &bodies = cell_->bodies();
    const Circle            at     = circle(u);
    double                  sum    = 0;
    for (unsigned int c = 0; c < bodies.gradients().size(); ++c)
      if (bodies.symmetry_weight(c) > 0)
        {
          const CellGradients &cell = bodies.gradients()[c];
          for (unsigned int q = 0; q < cell.n_points; ++q)
            sum += bodies.symmetry_weight(c) * cell.jxw[q] *
                   height(at, position(c, q, u)).value;
        }
    return sum / volume_;
  }



  void
  MeanHeight::add_residual(const Vector<double> &u,
                           Vector<double>       &residual) const
  {
    if (cell_ == nullptr)
      return;
    const DeformableBodies &bodies = cell_->bodies();
    const MacroUnknowns    &macro  = cell_->macro();
    const Circle            at     = circle(u);
    for (unsigned int c = 0; c < bodies.gradients().size(); ++c)
      if (bodies.symmetry_weight(c) > 0)
        {
          const CellGradients &cell     = bodies.gradients()[c];
          const auto          &unknowns = bodies.cell_unknowns(c);
          for (unsigned int q = 0; q < cell.n_points; ++q)
            {
              const double share =
                bodies.symmetry_weight(c) * cell.jxw[q] / volume_;
              const Number d = height(at, position(c, q, u));
              residual[macro.support()] += stiffness_ * share * d.value;
              const double force = this->force(u) * share;
              for (unsigned int n = 0; n < MacroModes::n; ++n)
                residual[macro.mode(n)] += force * d.gradient[3 + n];
              for (unsigned int i = 0; i < 3; ++i)
                for (unsigned int a = 0; a < cell.n_functions; ++a)
                  residual[unknowns[i * cell.n_functions + a]] +=
                    force * d.gradient[i] *
                    cell.values[q * cell.n_functions + a];
            }
        }
  }



  void
  MeanHeight::add_tangent(const Vector<double> &u,
                          ConstrainedSystem    &system) const
  {
    if (cell_ == nullptr)
      return;
    const DeformableBodies &bodies = cell_->bodies();
    const Circle            at     = circle(u);
    std::vector<double>     K;
    for (unsigned int c = 0; c < groups_.size(); ++c)
      {
        if (groups_[c] == dealii::numbers::invalid_unsigned_int)
          continue;
        const CellGradients &cell = bodies.gradients()[c];
        const unsigned int   size = 3 * cell.n_functions + MacroModes::n + 1;
        K.assign(size * size, 0.);
        for (unsigned int q = 0; q < cell.n_points; ++q)
          add_point(height(at, position(c, q, u)),
                    bodies.symmetry_weight(c) * cell.jxw[q] / volume_,
                    force(u),
                    cell.n_functions,
                    &cell.values[q * cell.n_functions],
                    K);
        system.add(groups_[c], K);
      }
  }



  void
  MeanHeight::add_point(const Number        &d,
                        const double         share,
                        const double         force,
                        const unsigned int   n_functions,
                        const double        *R,
                        std::vector<double> &K) const
  {
    // The unknowns of a cell by the variable of d that they move, and by how
    // much they move it: three times all functions, then H1..H6.
    const double       one   = 1.;
    const unsigned int size  = 3 * n_functions + MacroModes::n + 1;
    const auto         first = [&](const unsigned int variable) {
      return variable < dim ? variable * n_functions :
                                      dim * n_functions + variable - dim;
    };
    const auto n_moving = [&](const unsigned int variable) {
      return variable < dim ? n_functions : 1;
    };
    for (unsigned int v = 0; v < n_variables; ++v)
      for (unsigned int a = 0; a < n_moving(v); ++a)
        {
          const double       weight = share * (v < dim ? R[a] : 1.);
          const unsigned int row    = first(v) + a;
          const double       edge   = stiffness_ * weight * d.gradient[v];
          K[row * size + size - 1] += edge;
          K[(size - 1) * size + row] += edge;
          for (unsigned int w = 0; w < n_variables; ++w)
            {
              const double  factor = force * weight * d.hessian[v][w];
              const double *move   = w < dim ? R : &one;
              double       *target = &K[row * size + first(w)];
              for (unsigned int b = 0; b < n_moving(w); ++b)
                target[b] += factor * move[b];
            }
        }
  }
} // namespace NPT
