// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the search for the lowest eigenvalue of the acoustic tensor.

#include <npt_dealii/material/ellipticity.h>
#include <npt_dealii/material/symmetric_eigenvectors.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/numbers.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace NPT
{
  namespace
  {
    // The form a(m, N) = A_iJkL m_i m_k N_J N_L. Only the part of A that is
    // symmetric in (i,k) and in (J,L) matters; stored by pairs it is a small
    // matrix, from which Q(N) and its counterpart for fixed m are one
    // matrix-vector product each.
    template <int dim>
    class BiquadraticForm
    {
    public:
      explicit BiquadraticForm(const double *A)
      {
        for (unsigned int p = 0; p < n_pairs; ++p)
          for (unsigned int q = 0; q < n_pairs; ++q)
            {
              const auto [i, k] = pair(p);
              const auto [J, L] = pair(q);

              const auto entry = [A](int i_, int J_, int k_, int L_) {
                return A[((i_ * dim + J_) * dim + k_) * dim + L_];
              };
              coefficients[p][q] =
                0.25 * (entry(i, J, k, L) + entry(i, L, k, J) +
                        entry(k, J, i, L) + entry(k, L, i, J));
              Assert(dealii::numbers::is_finite(coefficients[p][q]),
                     dealii::ExcNumberNotFinite(coefficients[p][q]));
            }
      }

      // A_iJkL N_J M_L, symmetrized; for M = N the acoustic tensor Q_ik(N)
      dealii::SymmetricTensor<2, dim>
      contract_with_normals(const dealii::Tensor<1, dim> &N,
                            const dealii::Tensor<1, dim> &M) const
      {
        const auto                      NN = weighted_dyad(N, M);
        dealii::SymmetricTensor<2, dim> Q;
        for (unsigned int p = 0; p < n_pairs; ++p)
          {
            double sum = 0.;
            for (unsigned int q = 0; q < n_pairs; ++q)
              sum += coefficients[p][q] * NN[q];
            Q[pair(p).first][pair(p).second] = sum;
          }
        return Q;
      }

      // A_iJkL m_i m_k
      dealii::SymmetricTensor<2, dim>
      contract_with_polarization(const dealii::Tensor<1, dim> &m) const
      {
        const auto                      mm = weighted_dyad(m, m);
        dealii::SymmetricTensor<2, dim> R;
        for (unsigned int q = 0; q < n_pairs; ++q)
          {
            double sum = 0.;
            for (unsigned int p = 0; p < n_pairs; ++p)
              sum += coefficients[p][q] * mm[p];
            R[pair(q).first][pair(q).second] = sum;
          }
        return R;
      }

      double
      norm() const
      {
        double sum = 0.;
        for (const auto &row : coefficients)
          for (const double value : row)
            sum += value * value;
        return std::sqrt(sum);
      }

    private:
      static constexpr unsigned int n_pairs = dim * (dim + 1) / 2;

      static constexpr std::pair<int, int>
      pair(const unsigned int p)
      {
        constexpr int second[3][2] = {{1, 2}, {0, 2}, {0, 1}};
        if (p < dim)
          return {p, p};
        return dim == 2 ?
                 std::pair<int, int>(0, 1) :
                 std::pair<int, int>(second[p - dim][0], second[p - dim][1]);
      }

      // v (x) w by pairs; a mixed pair has both its entries
      static std::array<double, n_pairs>
      weighted_dyad(const dealii::Tensor<1, dim> &v,
                    const dealii::Tensor<1, dim> &w)
      {
        std::array<double, n_pairs> vw;
        for (unsigned int p = 0; p < n_pairs; ++p)
          {
            const auto [J, L] = pair(p);
            vw[p] = (J == L ? v[J] * w[J] : v[J] * w[L] + v[L] * w[J]);
          }
        return vw;
      }

      double coefficients[n_pairs][n_pairs];
    };



    // Directions spread evenly over a half sphere (Fibonacci lattice) or half
    // circle; N and -N are the same direction here.
    template <int dim>
    std::vector<dealii::Tensor<1, dim>>
    make_directions()
    {
      const unsigned int n_directions = (dim == 2 ? 60 : 200);
      const double       pi           = dealii::numbers::PI;

      std::vector<dealii::Tensor<1, dim>> directions(n_directions);
      for (unsigned int n = 0; n < n_directions; ++n)
        if constexpr (dim == 2)
          {
            const double angle = pi * (n + 0.5) / n_directions;
            directions[n][0]   = std::cos(angle);
            directions[n][1]   = std::sin(angle);
          }
        else
          {
            const double height = (n + 0.5) / n_directions;
            const double radius = std::sqrt(1. - height * height);
            const double angle  = n * pi * (3. - std::sqrt(5.));
            directions[n][0]    = radius * std::cos(angle);
            directions[n][1]    = radius * std::sin(angle);
            directions[n][2]    = height;
          }
      return directions;
    }



    // The sampling directions, and which of them are next to each other.
    template <int dim>
    struct Sampling
    {
      Sampling()
        : directions(make_directions<dim>())
        , neighbors(directions.size())
      {
        // Points of the 3d lattice are about 0.18 rad apart, those of the 2d
        // one 0.05 rad.
        const double reach = (dim == 2 ? 0.06 : 0.3);
        for (unsigned int n = 0; n < directions.size(); ++n)
          for (unsigned int m = 0; m < directions.size(); ++m)
            if (m != n &&
                std::abs(directions[n] * directions[m]) > std::cos(reach))
              neighbors[n].push_back(m);
      }

      const std::vector<dealii::Tensor<1, dim>> directions;
      std::vector<std::vector<unsigned int>>    neighbors;
    };



    template <int dim>
    struct EigenSystem
    {
      explicit EigenSystem(const dealii::SymmetricTensor<2, dim> &T)
        : pairs(symmetric_eigenvectors(
            T,
            dealii::SymmetricTensorEigenvectorMethod::hybrid))
      {}

      // deal.II sorts in descending order.
      double
      lowest_value() const
      {
        return pairs[dim - 1].first;
      }

      const dealii::Tensor<1, dim> &
      lowest_vector() const
      {
        return pairs[dim - 1].second;
      }

      std::array<std::pair<double, dealii::Tensor<1, dim>>, dim> pairs;
    };



    // Newton's direction for lambda_min(Q(N)) on the unit sphere, from second
    // order perturbation of the eigenvalue,
    //   lambda(N + z) = lambda + 2 g.z + z.H z,  g = R N,
    //   H = R - lambda 1 - 4 sum_e K_e (x) K_e / (lambda_e - lambda),
    // with R_JL = A_iJkL m_i m_k and K_e.z = m_e.Q(z, N) m over the other
    // eigenvectors m_e of Q. Zero where H is not positive definite.
    template <int dim>
    dealii::Tensor<1, dim>
    newton_direction(const BiquadraticForm<dim>            &form,
                     const dealii::Tensor<1, dim>          &N,
                     const EigenSystem<dim>                &Q,
                     const dealii::SymmetricTensor<2, dim> &R,
                     const EigenSystem<dim>                &R_eigen,
                     const double                           zero)
    {
      const double lambda = Q.lowest_value();
      const auto  &m      = Q.lowest_vector();

      // Tangents: the eigenvectors of R but the one closest to N, without
      // their part along N. Near the minimum N is itself an eigenvector.
      std::array<dealii::Tensor<1, dim>, dim - 1> t;
      for (unsigned int a = 0; a < dim - 1; ++a)
        {
          t[a] = R_eigen.pairs[a].second;
          t[a] -= (t[a] * N) * N;
          for (unsigned int b = 0; b < a; ++b)
            t[a] -= (t[a] * t[b]) * t[b];
          const double length = t[a].norm();
          if (length < 0.1)
            return {};
          t[a] /= length;
        }

      dealii::Tensor<1, dim - 1>                  g;
      dealii::Tensor<2, dim - 1>                  H;
      std::array<dealii::Tensor<1, dim - 1>, dim> K;
      for (unsigned int a = 0; a < dim - 1; ++a)
        {
          g[a]            = t[a] * (R * N);
          const auto Qt_m = form.contract_with_normals(t[a], N) * m;
          for (unsigned int e = 0; e < dim - 1; ++e)
            K[e][a] = Q.pairs[e].second * Qt_m;
        }
      for (unsigned int a = 0; a < dim - 1; ++a)
        for (unsigned int b = 0; b < dim - 1; ++b)
          {
            H[a][b] = t[a] * (R * t[b]) - (a == b ? lambda : 0.);
            for (unsigned int e = 0; e < dim - 1; ++e)
              H[a][b] -= 4. * K[e][a] * K[e][b] /
                         std::max(Q.pairs[e].first - lambda, zero);
          }
      if (trace(H) <= zero || determinant(H) <= zero * trace(H))
        return {};

      const dealii::Tensor<1, dim - 1> z = invert(H) * g;
      dealii::Tensor<1, dim>           direction;
      for (unsigned int a = 0; a < dim - 1; ++a)
        direction -= z[a] * t[a];
      return direction;
    }



    // Alternately the best m for N and the best N for m, two small eigenvalue
    // problems by which the value can only fall, and a Newton step, taken if
    // it falls further. The first part alone is safe but sometimes needs
    // hundreds of sweeps. Saddle points repel it, and the starting points are
    // in general position.
    template <int dim>
    LowestAcousticEigenvalue<dim>
    descend(const BiquadraticForm<dim> &form, dealii::Tensor<1, dim> N)
    {
      const unsigned int max_sweeps = 100;
      const double       norm       = form.norm();

      EigenSystem<dim> Q(form.contract_with_normals(N, N));
      for (unsigned int sweep = 0; sweep < max_sweeps; ++sweep)
        {
          const double old_value = Q.lowest_value();

          const auto R = form.contract_with_polarization(Q.lowest_vector());
          const EigenSystem<dim> R_eigen(R);

          const auto newton =
            newton_direction(form, N, Q, R, R_eigen, 1e-8 * norm);
          const dealii::Tensor<1, dim> N_newton =
            (N + newton) / (N + newton).norm();
          const EigenSystem<dim> Q_newton(
            form.contract_with_normals(N_newton, N_newton));

          if (Q_newton.lowest_value() < R_eigen.lowest_value())
            {
              N = N_newton;
              Q = Q_newton;
            }
          else
            {
              N = R_eigen.lowest_vector();
              Q = EigenSystem<dim>(form.contract_with_normals(N, N));
            }
          if (old_value - Q.lowest_value() <= 1e-14 * norm)
            break;
        }
      return {Q.lowest_value(), N, Q.lowest_vector()};
    }
  } // namespace



  template <int dim>
  LowestAcousticEigenvalue<dim>
  lowest_acoustic_eigenvalue(const double *A)
  {
    static const Sampling<dim> sampling;
    const auto                &directions = sampling.directions;
    const BiquadraticForm<dim> form(A);

    std::vector<double> samples(directions.size());
    for (unsigned int n = 0; n < directions.size(); ++n)
      samples[n] = dealii::eigenvalues(
        form.contract_with_normals(directions[n], directions[n]))[dim - 1];

    // Descend from every valley of the samples: several of nearly equal depth
    // are the rule, and the lowest sample need not lie in the deepest one.
    // Ties go to the smaller index, so that there is at least one start.
    LowestAcousticEigenvalue<dim> lowest{
      std::numeric_limits<double>::infinity(), {}, {}};
    for (unsigned int n = 0; n < directions.size(); ++n)
      if (std::none_of(sampling.neighbors[n].begin(),
                       sampling.neighbors[n].end(),
                       [&](const unsigned int m) {
                         return samples[m] < samples[n] ||
                                (samples[m] == samples[n] && m < n);
                       }))
        {
          const auto candidate = descend(form, directions[n]);
          if (candidate.value < lowest.value)
            lowest = candidate;
        }
    return lowest;
  }



  template <int dim>
  LowestAcousticEigenvalue<dim>
  lowest_acoustic_eigenvalue(const dealii::Tensor<4, dim> &dP_dF)
  {
    std::array<double, dim * dim * dim * dim> A;

    double *value = A.data();
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int J = 0; J < dim; ++J)
        for (unsigned int k = 0; k < dim; ++k)
          for (unsigned int L = 0; L < dim; ++L)
            *value++ = dP_dF[i][J][k][L];
    return lowest_acoustic_eigenvalue<dim>(A.data());
  }



  template <int dim>
  LowestAcousticEigenvalue<dim>
  lowest_acoustic_eigenvalue(const HyperelasticLaw<dim>   &law,
                             const dealii::Tensor<2, dim> &F)
  {
    dealii::Tensor<2, dim> P;
    dealii::Tensor<4, dim> dP_dF;
    law.stress_and_tangent(F, P, dP_dF);
    return lowest_acoustic_eigenvalue(dP_dF);
  }



  namespace
  {
    // Whether a symmetric 9 x 9 matrix is positive definite, by Cholesky's
    // factorization; only the lower triangle is read.
    bool
    is_positive_definite(double *B)
    {
      constexpr int n = 9;
      for (int j = 0; j < n; ++j)
        {
          double pivot = B[j * n + j];
          for (int k = 0; k < j; ++k)
            pivot -= B[j * n + k] * B[j * n + k];
          if (!(pivot > 0.))
            return false;
          const double factor = 1. / std::sqrt(pivot);
          for (int i = j + 1; i < n; ++i)
            {
              double sum = B[i * n + j];
              for (int k = 0; k < j; ++k)
                sum -= B[i * n + k] * B[j * n + k];
              B[i * n + j] = sum * factor;
            }
        }
      return true;
    }
  } // namespace



  bool
  is_surely_elliptic(const double *A,
                     const double *F,
                     const double  shear_modulus)
  {
    // At rest tau between 0 and 2 G does; the order is that of success.
    static constexpr double factors[] = {1., 0.5, 1.5, 0.75, 0.25, 2.};
    // Even and odd permutations: d2J/dF2_iJkL = e_ikm e_JLM F_mM.
    static constexpr int permutations[6][3] = {
      {0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    for (const double factor : factors)
      {
        double B[81];
        std::copy(A, A + 81, B);
        for (int p = 0; p < 6; ++p)
          for (int q = 0; q < 6; ++q)
            {
              const int(&i)[3] = permutations[p], (&J)[3] = permutations[q];
              const double sign = (p < 3) == (q < 3) ? 1. : -1.;
              B[(3 * i[0] + J[0]) * 9 + 3 * i[1] + J[1]] +=
                sign * factor * shear_modulus * F[3 * i[2] + J[2]];
            }
        if (is_positive_definite(B))
          return true;
      }
    return false;
  }



  template LowestAcousticEigenvalue<2>
  lowest_acoustic_eigenvalue<2>(const double *);
  template LowestAcousticEigenvalue<3>
  lowest_acoustic_eigenvalue<3>(const double *);
  template LowestAcousticEigenvalue<2>
  lowest_acoustic_eigenvalue(const dealii::Tensor<4, 2> &);
  template LowestAcousticEigenvalue<3>
  lowest_acoustic_eigenvalue(const dealii::Tensor<4, 3> &);
  template LowestAcousticEigenvalue<2>
  lowest_acoustic_eigenvalue(const HyperelasticLaw<2> &,
                             const dealii::Tensor<2, 2> &);
  template LowestAcousticEigenvalue<3>
  lowest_acoustic_eigenvalue(const HyperelasticLaw<3> &,
                             const dealii::Tensor<2, 3> &);
} // namespace NPT
