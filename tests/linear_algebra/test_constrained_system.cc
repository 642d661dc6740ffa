// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about the system in the independent unknowns: it is C^T K C, entry by
// entry, whatever the constraints are.

#include <npt_dealii/linear_algebra/constrained_system.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/lac/full_matrix.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <random>

using namespace NPT;
using dealii::AffineConstraints;
using dealii::FullMatrix;
using dealii::Vector;

namespace
{
  constexpr unsigned int n_unknowns = 60;

  class Random
  {
  public:
    double
    number()
    {
      return std::uniform_real_distribution<double>(-1, 1)(engine_);
    }
    unsigned int
    below(const unsigned int n)
    {
      return engine_() % n;
    }
    std::vector<unsigned int>
    distinct(const unsigned int count, const unsigned int below_this)
    {
      std::vector<unsigned int> all(below_this);
      std::iota(all.begin(), all.end(), 0u);
      std::shuffle(all.begin(), all.end(), engine_);
      all.resize(count);
      return all;
    }

  private:
    std::mt19937 engine_{20240117};
  };

  /**
   * Lines of every kind that a cell makes: nothing (fixed), one entry with
   * sign +1 or -1 (image), several entries (jumps, pins), and chains, which
   * close() resolves. Two of three unknowns stay independent.
   */
  void
  make_constraints(Random &random, AffineConstraints<double> &constraints)
  {
    for (unsigned int i = 0; i < n_unknowns; i += 3)
      {
        constraints.add_line(i);
        switch (i / 3 % 4)
          {
            case 0:
              break;
            case 1:
              constraints.add_entry(i, i + 1, random.below(2) ? 1. : -1.);
              break;
            case 2:
              for (const unsigned int j : random.distinct(4, n_unknowns / 3))
                constraints.add_entry(i, 3 * j + 2, random.number());
              break;
            case 3: // a chain: refers to a constrained unknown
              constraints.add_entry(i, i - 3, -1.);
              constraints.add_entry(i, i + 1, random.number());
              break;
          }
      }
    constraints.close();
  }

  /// C, column by column from what deal.II makes of a unit value.
  FullMatrix<double>
  dense_C(const ConstrainedSystem         &system,
          const AffineConstraints<double> &constraints)
  {
    FullMatrix<double> C(n_unknowns, system.n_independent());
    for (unsigned int k = 0; k < system.n_independent(); ++k)
      {
        Vector<double> u(n_unknowns);
        u[system.unknown(k)] = 1.;
        constraints.distribute(u);
        for (unsigned int i = 0; i < n_unknowns; ++i)
          C(i, k) = u[i];
      }
    return C;
  }

  FullMatrix<double>
  condensed(const FullMatrix<double> &C, const FullMatrix<double> &K)
  {
    FullMatrix<double> KC(C.m(), C.n()), result(C.n(), C.n());
    K.mmult(KC, C);
    C.Tmmult(result, KC);
    return result;
  }

  FullMatrix<double>
  dense(const CSRMatrix &A)
  {
    FullMatrix<double> result(A.n(), A.n());
    for (unsigned int i = 0; i < A.n(); ++i)
      for (int k = A.row_start[i]; k < A.row_start[i + 1]; ++k)
        result(i, A.columns[k]) += A.values[k];
    return result;
  }

  double
  distance(FullMatrix<double> A, const FullMatrix<double> &B)
  {
    A.add(-1., B);
    return A.linfty_norm();
  }

  std::vector<double>
  random_element(Random &random, const unsigned int n)
  {
    std::vector<double> K(n * n);
    for (double &value : K)
      value = random.number();
    return K;
  }

  void
  add_dense(FullMatrix<double>              &K_full,
            const std::vector<unsigned int> &unknowns,
            const std::vector<double>       &K,
            const double                     factor = 1.)
  {
    const unsigned int n = unknowns.size();
    for (unsigned int a = 0; a < n; ++a)
      for (unsigned int b = 0; b < n; ++b)
        K_full(unknowns[a], unknowns[b]) += factor * K[a * n + b];
  }

  // Constraints, a system, and its groups: one of independent unknowns only,
  // one of mere images, others of any mixture.
  struct Fixture
  {
    Fixture()
    {
      make_constraints(random, constraints);
      system.reinit(constraints, n_unknowns);
      groups = {{1, 2, 4, 5, 7, 8}, {3, 5, 8, 11}, {3, 4, 5}};
      for (unsigned int g = 0; g < 12; ++g)
        groups.push_back(random.distinct(8, n_unknowns));
      for (const auto &group : groups)
        system.add_group(group);
    }

    Random                                 random;
    AffineConstraints<double>              constraints;
    ConstrainedSystem                      system;
    std::vector<std::vector<unsigned int>> groups;
  };
} // namespace



TEST_CASE("Expanding and condensing are C and its transpose", "[solver]")
{
  Fixture                  f;
  const FullMatrix<double> C = dense_C(f.system, f.constraints);
  REQUIRE(f.system.n_independent() == 2 * n_unknowns / 3);

  Vector<double> m(C.n()), r(C.m()), u, u_dense(C.m()), c, c_dense(C.n());
  for (double &value : m)
    value = f.random.number();
  for (double &value : r)
    value = f.random.number();

  f.system.expand(m, u);
  C.vmult(u_dense, m);
  f.system.condense(r, c);
  C.Tvmult(c_dense, r);
  for (unsigned int i = 0; i < C.m(); ++i)
    CHECK(u[i] == Approx(u_dense[i]).margin(1e-14));
  for (unsigned int k = 0; k < C.n(); ++k)
    CHECK(c[k] == Approx(c_dense[k]).margin(1e-14));

  Vector<double> m_again;
  f.system.restrict_to_independent(u, m_again);
  CHECK(m_again == m);
  for (unsigned int k = 0; k < C.n(); ++k)
    CHECK(f.system.independent_index(f.system.unknown(k)) ==
          static_cast<int>(k));
}



TEST_CASE("The assembled matrix is the dense product C^T K C", "[solver]")
{
  Fixture                  f;
  const FullMatrix<double> C = dense_C(f.system, f.constraints);
  f.system.build_pattern({});

  FullMatrix<double> K_full(n_unknowns, n_unknowns);
  for (unsigned int g = 0; g < f.groups.size(); ++g)
    {
      const double factor = 1. + g % 2; // cells with an image count twice
      const auto   K      = random_element(f.random, f.groups[g].size());
      f.system.add(g, K, factor);
      add_dense(K_full, f.groups[g], K, factor);
    }
  // Round-off of sums of some ten numbers of order one.
  CHECK(distance(dense(f.system.matrix()), condensed(C, K_full)) < 1e-12);

  // Setting to zero keeps the pattern, and the positions remain valid.
  const std::size_t pattern = f.system.matrix().pattern_id();
  f.system.set_zero();
  K_full = 0;
  for (unsigned int g = 0; g < f.groups.size(); ++g)
    {
      const auto K = random_element(f.random, f.groups[g].size());
      f.system.add(g, K);
      add_dense(K_full, f.groups[g], K);
    }
  CHECK(distance(dense(f.system.matrix()), condensed(C, K_full)) < 1e-12);
  CHECK(f.system.matrix().pattern_id() == pattern);
}



TEST_CASE("An unknown that occurs twice in a group counts twice", "[solver]")
{
  // A contact point whose primary is an image of the secondary's own bundle.
  Fixture                         f;
  const FullMatrix<double>        C     = dense_C(f.system, f.constraints);
  const std::vector<unsigned int> group = {4, 5, 4, 3};
  const auto                      K     = random_element(f.random, 4);
  f.system.build_pattern({group});
  REQUIRE(f.system.add(group, K));
  FullMatrix<double> K_full(n_unknowns, n_unknowns);
  add_dense(K_full, group, K);
  CHECK(distance(dense(f.system.matrix()), condensed(C, K_full)) < 1e-13);
}



TEST_CASE("A coupling outside of the pattern is reported and adds nothing",
          "[solver]")
{
  Random                    random;
  AffineConstraints<double> constraints;
  make_constraints(random, constraints);
  ConstrainedSystem system;
  system.reinit(constraints, n_unknowns);
  system.add_group({1, 2, 4, 5});
  system.build_pattern({{7, 8}});

  const auto K2 = random_element(random, 2);
  CHECK(system.add({1, 5}, K2));
  CHECK(system.add({8, 7}, K2));

  const FullMatrix<double> before = dense(system.matrix());
  CHECK_FALSE(system.add({5, 7}, K2));
  CHECK_FALSE(system.add({1, 2, 8}, random_element(random, 3)));
  CHECK(distance(dense(system.matrix()), before) == 0.);

  // The wider pattern holds it, and says that it is another one.
  const std::size_t old_pattern = system.matrix().pattern_id();
  system.build_pattern({{7, 8}, {5, 7}});
  CHECK(system.matrix().pattern_id() != old_pattern);
  CHECK(dense(system.matrix()).linfty_norm() == 0.);
  CHECK(system.add({5, 7}, K2));
}



TEST_CASE("The free block is the matrix without prescribed rows and columns",
          "[solver]")
{
  Fixture f;
  f.system.build_pattern({});
  const auto fill = [&]() {
    f.system.set_zero();
    for (unsigned int g = 0; g < f.groups.size(); ++g)
      f.system.add(g, random_element(f.random, f.groups[g].size()));
  };
  const auto check = [&](const std::vector<bool> &prescribed) {
    const FullMatrix<double>  all  = dense(f.system.matrix());
    const FullMatrix<double>  free = dense(f.system.free_matrix());
    std::vector<unsigned int> index;
    for (unsigned int k = 0; k < prescribed.size(); ++k)
      if (!prescribed[k])
        index.push_back(k);
    REQUIRE(f.system.n_free() == index.size());
    REQUIRE(free.m() == index.size());
    for (unsigned int i = 0; i < index.size(); ++i)
      {
        CHECK(f.system.free_unknown(i) == index[i]);
        for (unsigned int j = 0; j < index.size(); ++j)
          CHECK(free(i, j) == all(index[i], index[j]));
      }
  };

  std::vector<bool> prescribed(f.system.n_independent(), false);
  fill();
  check(prescribed); // nothing prescribed

  for (const unsigned int k : f.random.distinct(7, prescribed.size()))
    prescribed[k] = true;
  f.system.set_prescribed(prescribed);
  check(prescribed);

  // New values in the same pattern: the solver may keep what depends on the
  // pattern only.
  const std::size_t pattern = f.system.free_matrix().pattern_id();
  fill();
  check(prescribed);
  CHECK(f.system.free_matrix().pattern_id() == pattern);

  f.system.build_pattern({{1, 59}});
  fill();
  check(prescribed);
  CHECK(f.system.free_matrix().pattern_id() != pattern);
}



TEST_CASE("Unknowns that no group touches have a diagonal entry", "[solver]")
{
  AffineConstraints<double> constraints;
  constraints.close();
  ConstrainedSystem system;
  system.reinit(constraints, 5);
  system.add_group({0, 1});
  system.build_pattern({});
  for (unsigned int k = 0; k < 5; ++k)
    CHECK(system.matrix().position(k, k) >= 0);
  CHECK(system.matrix().n_nonzeros() == 2 * 2 + 3);
}



namespace
{
  // Two unknowns turned by the third one.
  class Rotation : public UnknownMap
  {
  public:
    void
    apply(const Vector<double> &v, Vector<double> &u) const override
    {
      turn(v, v[2], u);
    }
    void
    invert(const Vector<double> &u, Vector<double> &v) const override
    {
      turn(u, -u[2], v);
    }
    std::vector<std::vector<unsigned int>>
    arguments() const override
    {
      return {{0, 1, 2}, {0, 1, 2}, {2}, {3}};
    }
    void
    gradients(const Vector<double> &v,
              std::vector<double>  &values) const override
    {
      const double c = std::cos(v[2]), s = std::sin(v[2]);
      values = {c, -s, -s * v[0] - c * v[1], s, c, c * v[0] - s * v[1], 1., 1.};
    }

  private:
    static void
    turn(const Vector<double> &from, const double angle, Vector<double> &to)
    {
      to    = from;
      to[0] = std::cos(angle) * from[0] - std::sin(angle) * from[1];
      to[1] = std::sin(angle) * from[0] + std::cos(angle) * from[1];
    }
  };
} // namespace



TEST_CASE(
  "With a map of the unknowns forces and stiffnesses are pulled back to "
  "what is independent",
  "[solver]")
{
  // v_1 = 2 v_0 + 3 v_3.
  AffineConstraints<double> constraints;
  constraints.add_line(1);
  constraints.add_entry(1, 0, 2.);
  constraints.add_entry(1, 3, 3.);
  constraints.close();
  ConstrainedSystem system;
  system.reinit(constraints, 4, std::make_shared<Rotation>());
  const unsigned int turned = system.add_group({0, 1});
  // The angle alone, by its own row and by that of v.
  const unsigned int angle = system.add_group({2}),
                     of_v  = system.add_group({system.row_of_v(2)});

  Vector<double> m(3), u, m_again;
  m[0] = 0.3;
  m[1] = 0.7;
  m[2] = -0.2;
  system.expand(m, u);
  const double c = std::cos(0.7), s = std::sin(0.7);
  CHECK(u[0] == Approx(c * 0.3 - s * 0.));
  CHECK(u[1] == Approx(s * 0.3 + c * 0.));
  system.restrict_to_independent(u, m_again);
  m_again -= m;
  CHECK(m_again.l2_norm() < 1e-15);

  // r = u is the gradient of |u|^2 / 2, K = 1 its tangent but for the
  // curvature of the map.
  system.linearize(u);
  Vector<double> r(u), condensed;
  system.condense(r, condensed);
  const double h = 1e-6;
  for (unsigned int k = 0; k < 3; ++k)
    {
      double energy[2];
      for (const int sign : {1, -1})
        {
          Vector<double> moved(m), u_moved;
          moved[k] += sign * h;
          system.expand(moved, u_moved);
          energy[sign > 0] = 0.5 * u_moved.norm_sqr();
        }
      CHECK(condensed[k] ==
            Approx((energy[1] - energy[0]) / (2. * h)).margin(1e-9));
    }
  system.build_pattern();
  system.set_zero();
  system.add(turned, {1., 0., 0., 1.});
  // |v|^2: 5 and 9 on the diagonal, 6 between; turning does not show but for
  // (du/dangle)^2 = |v|^2 = 0.09 and (du/dv . du/dangle) = v_0 2 - v_1.
  const auto entry = [&](const int i, const int j) {
    return system.matrix().values[system.matrix().position(i, j)];
  };
  CHECK(entry(0, 0) == Approx(5.));
  CHECK(entry(2, 2) == Approx(9.));
  CHECK(entry(0, 2) == Approx(6.));
  CHECK(entry(1, 1) == Approx(0.09));
  CHECK(entry(0, 1) == Approx(0.6));
  CHECK(entry(1, 2) == Approx(0.9));
  system.add(angle, {1.});
  system.add(of_v, {1.});
  CHECK(entry(1, 1) == Approx(2.09));
}


#ifdef DEBUG
TEST_CASE("Loads must not enter through inhomogeneities", "[solver]")
{
  AffineConstraints<double> constraints;
  constraints.add_line(0);
  constraints.set_inhomogeneity(0, 1.);
  constraints.close();
  ConstrainedSystem system;
  CHECK_THROWS_AS(system.reinit(constraints, 3), dealii::ExceptionBase);
}
#endif
