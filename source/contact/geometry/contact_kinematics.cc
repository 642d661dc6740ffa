// SPDX-License-Identifier: LGPL-2.1-or-later
// Variations of gap and closest point on the jets of a contact point.

#include <npt_dealii/contact/geometry/contact_kinematics.h>

#include <cmath>

namespace NPT
{
  using dealii::Tensor;

  namespace
  {
    // Offsets of the jets J_0, J_a, J_ab among the n numbers.
    template <int dim>
    constexpr unsigned int
    jet(const unsigned int a)
    {
      return dim * (1 + a);
    }
    template <int dim>
    constexpr unsigned int
    jet(const unsigned int a, const unsigned int b)
    {
      return dim * (1 + (dim - 1) + SymmetricIndices<dim - 1>::second(a, b));
    }

    template <int dim, typename Row>
    void
    add_dot(Row                  &row,
            const unsigned int    offset,
            const Tensor<1, dim> &v,
            const double          factor)
    {
      for (unsigned int i = 0; i < dim; ++i)
        row[offset + i] += factor * v[i];
    }

    // M += factor (u v^T + v u^T).
    template <typename Row, typename Matrix>
    void
    add_symmetric(Matrix &M, const Row &u, const Row &v, const double factor)
    {
      const unsigned int n = u.size();
      for (unsigned int i = 0; i < n; ++i)
        {
          const double fu = factor * u[i], fv = factor * v[i];
          if (fu == 0. && fv == 0.)
            continue;
          for (unsigned int j = 0; j < n; ++j)
            M[i * n + j] += fu * v[j] + fv * u[j];
        }
    }
  } // namespace



  // --------------------------------------------------------- first variations

  template <int dim>
  ContactKinematics<dim>::ContactKinematics(const ClosestPoint<dim> &c)
    : c_(c)
  {
    set_parameter_variation();
    set_total_variations();
    set_gap_variation();
    if (c.edge_radius > 0.)
      round_gap();
    set_metric_variation();
  }



  // (A8): H_ab dxi^b = a_a . J_0 + r . J_a in the free directions.
  template <int dim>
  void
  ContactKinematics<dim>::set_parameter_variation()
  {
    using Indices = SymmetricIndices<m>;

    // H on the free directions, inverted there; zero elsewhere.
    SurfaceMatrix<m> H;
    for (int a = 0; a < m; ++a)
      for (int b = 0; b < m; ++b)
        H[a][b] = c_.a[a] * c_.a[b] - c_.r * c_.x_second[Indices::second(a, b)];
    H_inverse_ = invert_symmetric<m>(H, c_.free);

    for (int b = 0; b < m; ++b)
      {
        parameter_[b].fill(0.);
        for (int a = 0; a < m; ++a)
          if (H_inverse_[b][a] != 0.)
            {
              add_dot(parameter_[b], 0, c_.a[a], H_inverse_[b][a]);
              add_dot(parameter_[b], jet<dim>(a), c_.r, H_inverse_[b][a]);
            }
      }
  }



  // Total variations at the moving closest point:
  // delta-hat a_a = J_a + x_,ab dxi^b and delta r = J_0 - a_b dxi^b.
  template <int dim>
  void
  ContactKinematics<dim>::set_total_variations()
  {
    using Indices = SymmetricIndices<m>;
    for (int a = 0; a < m; ++a)
      for (unsigned int i = 0; i < dim; ++i)
        {
          Row &row = tangent_[a][i];
          row.fill(0.);
          row[jet<dim>(a) + i] = 1.;
          for (int b = 0; b < m; ++b)
            {
              const double x_ab = c_.x_second[Indices::second(a, b)][i];
              for (unsigned int k = 0; k < n; ++k)
                row[k] += x_ab * parameter_[b][k];
            }
        }

    for (unsigned int i = 0; i < dim; ++i)
      {
        distance_[i].fill(0.);
        distance_[i][i] = 1.;
        for (int b = 0; b < m; ++b)
          for (unsigned int k = 0; k < n; ++k)
            distance_[i][k] -= c_.a[b][i] * parameter_[b][k];
      }
  }



  // (A7): dg = n . J_0.
  template <int dim>
  void
  ContactKinematics<dim>::set_gap_variation()
  {
    gap_.fill(0.);
    add_dot(gap_, 0, c_.normal, 1.);
    edge_traction_.fill(0.);
    distance_slope_ = 1.;
    depth_slope_    = 0.;
  }



  // (A15): g is a function of rho = |r| and c = n . r, and
  // delta c = n . J_0 - (r . a^a) n . delta-hat a_a.
  template <int dim>
  void
  ContactKinematics<dim>::round_gap()
  {
    using Indices                = SymmetricIndices<m>;
    const Tensor<1, dim> &normal = c_.surface_normal;
    const RoundedEdge     edge(c_.edge_radius, c_.r.norm(), normal * c_.r);
    distance_slope_ = edge.by_distance;
    depth_slope_    = edge.by_height;

    SurfaceMatrix<m> metric;
    for (int a = 0; a < m; ++a)
      for (int b = 0; b < m; ++b)
        metric[a][b] = c_.a[a] * c_.a[b];
    inverse_metric_ = invert_symmetric<m>(metric);
    depth_.fill(0.);
    add_dot(depth_, 0, normal, 1.);
    for (int a = 0; a < m; ++a)
      {
        turn_[a].fill(0.);
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int k = 0; k < n; ++k)
            turn_[a][k] += normal[i] * tangent_[a][i][k];
      }
    for (int a = 0; a < m; ++a)
      for (int b = 0; b < m; ++b)
        for (unsigned int k = 0; k < n; ++k)
          depth_[k] -= inverse_metric_[a][b] * (c_.r * c_.a[a]) * turn_[b][k];
    for (int a = 0; a < m; ++a)
      {
        rho_raised_[a] = 0;
        for (int b = 0; b < m; ++b)
          rho_raised_[a] += inverse_metric_[a][b] * (c_.r * c_.a[b]);
      }
    for (int a = 0; a < m; ++a)
      for (int b = 0; b < m; ++b)
        edge_traction_[a] -= depth_slope_ * rho_raised_[b] *
                             (normal * c_.x_second[Indices::second(a, b)]);
    rho_ = gap_;
    for (unsigned int k = 0; k < n; ++k)
      gap_[k] = distance_slope_ * rho_[k] + depth_slope_ * depth_[k];
  }



  template <int dim>
  void
  ContactKinematics<dim>::set_metric_variation()
  {
    for (int a = 0; a < m; ++a)
      for (int b = a; b < m; ++b)
        {
          Row &row = metric_[SymmetricIndices<m>::second(a, b)];
          row.fill(0.);
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int k = 0; k < n; ++k)
              row[k] +=
                c_.a[a][i] * tangent_[b][i][k] + c_.a[b][i] * tangent_[a][i][k];
        }
  }



  // -------------------------------------------------------- second variations

  template <int dim>
  void
  ContactKinematics<dim>::add_second_variation(
    const double                 pressure,
    const std::array<double, m> &traction,
    std::array<double, n * n>   &M) const
  {
    // tau^a = H^{ab} t_b turns H_ab D(delta xi^b) = S_a, the variation of (A8),
    // into the wanted term.
    std::array<double, m> tau;
    for (int a = 0; a < m; ++a)
      {
        tau[a] = 0;
        for (int b = 0; b < m; ++b)
          tau[a] +=
            H_inverse_[a][b] * (traction[b] + pressure * edge_traction_[b]);
      }

    add_moving_point(pressure, tau, M);
    // S_a: delta r . D-hat a_a + D r . delta-hat a_a.
    for (int a = 0; a < m; ++a)
      if (tau[a] != 0.)
        for (unsigned int i = 0; i < dim; ++i)
          add_symmetric(M, distance_[i], tangent_[a][i], tau[a]);

    if (pressure == 0.)
      return;
    add_turning_normal(pressure, M);
    add_held_directions(pressure, M);
    if (c_.edge_radius > 0.)
      {
        add_edge_products(pressure, M);
        add_edge_turning(pressure, M);
      }
  }



  template <int dim>
  double
  ContactKinematics<dim>::distance() const
  {
    return c_.edge_radius > 0. ? c_.r.norm() : c_.gap;
  }



  // Both D(delta g), the variation of (A7), and S_a, that of (A8), contain,
  // with v = n and v = a_a,
  //   - v . [ J_c Dxi^c + DJ_c dxi^c + x_,bc dxi^b Dxi^c ],
  // so the vectors are added up first. Beside a rounded edge (A15) the gap is a
  // function of distance and height, each with a second variation of its own.
  template <int dim>
  void
  ContactKinematics<dim>::add_moving_point(const double pressure,
                                           const std::array<double, m> &tau,
                                           Matrix                      &M) const
  {
    using Indices          = SymmetricIndices<m>;
    bool           any_tau = false;
    Tensor<1, dim> v       = pressure * distance_slope_ * c_.normal;
    if (c_.edge_radius > 0.)
      v += pressure * depth_slope_ * c_.surface_normal;
    for (int a = 0; a < m; ++a)
      {
        v += tau[a] * c_.a[a];
        any_tau = any_tau || tau[a] != 0.;
      }
    for (int b = 0; b < m; ++b)
      {
        if (!c_.free[b])
          continue;
        Row row{};
        add_dot(row, jet<dim>(b), v, -1.);
        for (int a = 0; a < m; ++a)
          if (tau[a] != 0.)
            add_dot(row, jet<dim>(a, b), c_.r, tau[a]);
        // Half of the quadratic term in (dxi^b, Dxi^c), because
        // add_symmetric() counts it twice.
        for (int c = 0; c < m; ++c)
          {
            double factor = -(v * c_.x_second[Indices::second(b, c)]);
            if (any_tau)
              for (int a = 0; a < m; ++a)
                factor += tau[a] * (c_.r * c_.x_third[Indices::third(a, b, c)]);
            for (unsigned int k = 0; k < n; ++k)
              row[k] += 0.5 * factor * parameter_[c][k];
          }
        add_symmetric(M, row, parameter_[b], 1.);
      }
  }



  // D(delta g) of (A7): turning of the normal, D n . delta r. In the free
  // directions a_b . delta r = - g n . delta-hat a_b, so that no division by
  // a small gap appears.
  template <int dim>
  void
  ContactKinematics<dim>::add_turning_normal(const double pressure,
                                             Matrix      &M) const
  {
    const double       distance_pressure = pressure * distance_slope_;
    const double       r                 = distance();
    std::array<Row, m> w; // n . delta-hat a_a
    for (int a = 0; a < m; ++a)
      {
        w[a].fill(0.);
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int k = 0; k < n; ++k)
            w[a][k] += c_.normal[i] * tangent_[a][i][k];
      }
    // Metric of the free directions only.
    SurfaceMatrix<m> metric;
    for (int a = 0; a < m; ++a)
      for (int b = 0; b < m; ++b)
        metric[a][b] = c_.a[a] * c_.a[b];
    const auto inverse = invert_symmetric<m>(metric, c_.free);
    for (int a = 0; a < m; ++a)
      for (int b = 0; b < m; ++b)
        if (inverse[a][b] != 0.)
          add_symmetric(M,
                        w[a],
                        w[b],
                        0.5 * distance_pressure * r * inverse[a][b]);
  }



  // D(delta g) in held directions (edge, corner), where the gap is |r|: with e
  // the unit vectors orthogonal to n and to the free tangents,
  //   sum_e (e . delta r) (e . D r) / |r|.
  template <int dim>
  void
  ContactKinematics<dim>::add_held_directions(const double pressure,
                                              Matrix      &M) const
  {
    const double distance_pressure = pressure * distance_slope_;
    const double r                 = distance();
    bool         all_free          = true;
    for (int a = 0; a < m; ++a)
      all_free = all_free && c_.free[a];
    if (all_free || !(std::abs(r) > 1e-12 * c_.a[0].norm()))
      return;

    std::vector<Tensor<1, dim>> basis = {c_.normal};
    for (int a = 0; a < m; ++a)
      if (c_.free[a])
        basis.push_back(c_.a[a] / c_.a[a].norm());
    const unsigned int n_known = basis.size();
    for (unsigned int i = 0; i < dim && basis.size() < dim; ++i)
      {
        Tensor<1, dim> e;
        e[i] = 1.;
        for (const auto &known : basis)
          e -= (e * known) * known;
        if (e.norm() > 0.4)
          basis.push_back(e / e.norm());
      }
    for (unsigned int k = n_known; k < basis.size(); ++k)
      {
        Row row{};
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < n; ++j)
            row[j] += basis[k][i] * distance_[i][j];
        add_symmetric(M, row, row, 0.5 * distance_pressure / r);
      }
  }



  // (A15): products of the first variations of rho and c.
  template <int dim>
  void
  ContactKinematics<dim>::add_edge_products(const double pressure,
                                            Matrix      &M) const
  {
    const RoundedEdge edge(c_.edge_radius,
                           distance(),
                           c_.surface_normal * c_.r);
    add_symmetric(M, rho_, rho_, 0.5 * pressure * edge.by_distance_distance);
    add_symmetric(M, rho_, depth_, pressure * edge.by_distance_height);
    add_symmetric(M, depth_, depth_, 0.5 * pressure * edge.by_height_height);
  }



  // (A15): D(delta c) beyond n . D(delta r), the turning normal. With
  // rho^b = r . a^b and delta n = - w^b a_b,
  //   r . D(delta n) = - c w^b w_b + w^d (rho^b a_d . delta-hat a_b)
  //                    (both ways) - rho^b n . D(delta-hat a_b),
  // the last one's D(delta xi) being in tau already.
  template <int dim>
  void
  ContactKinematics<dim>::add_edge_turning(const double pressure,
                                           Matrix      &M) const
  {
    const double depth = c_.surface_normal * c_.r;
    for (int a = 0; a < m; ++a)
      {
        Row along{};
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int k = 0; k < n; ++k)
            along[k] += c_.a[a][i] * distance_[i][k];
        for (int b = 0; b < m; ++b)
          {
            const double factor =
              pressure * depth_slope_ * inverse_metric_[a][b];
            add_symmetric(M, turn_[b], along, -factor);
            add_symmetric(M, turn_[a], turn_[b], -0.5 * factor * depth);
            Row bend{};
            for (int e = 0; e < m; ++e)
              for (unsigned int i = 0; i < dim; ++i)
                for (unsigned int k = 0; k < n; ++k)
                  bend[k] += rho_raised_[e] * c_.a[a][i] * tangent_[e][i][k];
            add_symmetric(M, turn_[b], bend, factor);
          }
        add_edge_bending(a, pressure, M);
      }
  }



  // (A15): - rho^a n . D(delta-hat a_a) along the free directions.
  template <int dim>
  void
  ContactKinematics<dim>::add_edge_bending(const int    a,
                                           const double pressure,
                                           Matrix      &M) const
  {
    const double along_edge = -pressure * depth_slope_ * rho_raised_[a];
    for (int e = 0; e < m; ++e)
      if (c_.free[e])
        {
          Row row{};
          add_dot(row, jet<dim>(a, e), c_.surface_normal, along_edge);
          for (int f = 0; f < m; ++f)
            for (unsigned int k = 0; k < n; ++k)
              row[k] += 0.5 * along_edge *
                        (c_.surface_normal *
                         c_.x_third[SymmetricIndices<m>::third(a, e, f)]) *
                        parameter_[f][k];
          add_symmetric(M, row, parameter_[e], 1.);
        }
  }

  template class ContactKinematics<2>;
  template class ContactKinematics<3>;
} // namespace NPT
