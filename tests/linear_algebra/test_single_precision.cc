// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the claims on factors of single precision.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/linear_algebra/flexible_gmres.h>
#include <npt_dealii/linear_algebra/linear_solver.h>

#include <catch2/catch.hpp>

#include <cmath>

#include "elastic_block.h"

using namespace NPT;
using dealii::Vector;

namespace
{
  LinearSolverParameters
  with_factors(const std::string &name)
  {
    LinearSolverParameters parameters;
    parameters.type    = LinearSolverParameters::Type::MUMPS;
    parameters.factors = value_of<LinearSolverParameters::Precision>(name);
    return parameters;
  }

  Vector<double>
  load(const unsigned int n)
  {
    Vector<double> b(n);
    for (unsigned int i = 0; i < n; ++i)
      b[i] = std::sin(1. + i);
    return b;
  }

  Vector<double>
  solution(LinearSolver &solver, const CSRMatrix &A, const Vector<double> &b)
  {
    Vector<double> x;
    solver.factorize(A);
    solver.solve(b, x);
    return x;
  }

  double
  difference(const Vector<double> &a, const Vector<double> &b)
  {
    Vector<double> d(a);
    d -= b;
    return d.linfty_norm() / b.linfty_norm();
  }

  void
  shift_diagonal(CSRMatrix &A, const double shift)
  {
    for (unsigned int i = 0; i < A.n(); ++i)
      A.values[A.position(i, i)] += shift;
  }

  bool
  is_single(const LinearSolver &solver)
  {
    return solver.description().find("factors in single precision") !=
           std::string::npos;
  }
} // namespace

TEST_CASE("Factors of single precision give the solution of those of double "
          "precision",
          "[solver]")
{
  const std::string kind =
    GENERATE("positive definite", "unsymmetric", "indefinite");
  INFO(kind);
  CSRMatrix A =
    make_elastic_block({{8, 7, 3}}, 2, 1., kind == "unsymmetric" ? 0.3 : 0.)
      .matrix;
  if (kind == "indefinite")
    shift_diagonal(A, -0.02);
  const Vector<double> b = load(A.n());
  LinearSolver         full(with_factors("double"));
  LinearSolver         single(with_factors("single"));
  const Vector<double> expected = solution(full, A, b);
  const Vector<double> x        = solution(single, A, b);
  CHECK(difference(x, expected) < 1e-10);
  CHECK(single.relative_residual() <= 1e-12);
  CHECK(is_single(single));
  CHECK(single.n_numeric() == 1);
  CHECK(single.n_iterations() > 1);
  CHECK(single.n_iterations() < 10);
  CHECK(full.memory().is_indefinite == (kind == "indefinite"));
  CHECK(single.memory().is_indefinite == (kind == "indefinite"));
  CHECK_FALSE(single.memory().needs_double);

  // No load, no displacement.
  Vector<double> zero(A.n()), nothing;
  single.solve(zero, nothing);
  CHECK(nothing.linfty_norm() == 0.);
}

TEST_CASE("A power of two in the units changes no digit with factors of "
          "single precision",
          "[solver]")
{
  const double    friction = GENERATE(0., 0.3);
  const int       exponent = GENERATE(-250, -67, 67, 250);
  const CSRMatrix A = make_elastic_block({{4, 4, 2}}, 2, 1., friction).matrix;
  const Vector<double> b = load(A.n());
  CSRMatrix            scaled(A);
  for (double &value : scaled.values)
    value = std::ldexp(value, exponent);
  Vector<double> load(b);
  load *= std::ldexp(1., 30);
  LinearSolver         solver(with_factors("single"));
  const Vector<double> x = solution(solver, A, b);
  LinearSolver         other(with_factors("single"));
  Vector<double>       y = solution(other, scaled, load);
  y *= std::ldexp(1., exponent - 30);
  INFO(exponent << ' ' << friction);
  CHECK(is_single(other));
  y -= x;
  CHECK(y.linfty_norm() == 0.);
}

TEST_CASE("Units of 1e-20 and 1e+20, of all unknowns and of one of them, are "
          "in the range of single precision",
          "[solver]")
{
  const double friction = GENERATE(0., 0.3);
  const double unit     = GENERATE(1e-20, 1e20);
  CSRMatrix    A = make_elastic_block({{4, 4, 2}}, 2, 1., friction).matrix;
  INFO(unit << ' ' << friction);

  SECTION("all")
  {
    for (double &value : A.values)
      value *= unit;
  }
  SECTION("one")
  {
    const double small = std::sqrt(std::sqrt(unit));
    for (int i = 0; i < static_cast<int>(A.n()); ++i)
      for (const int k : {A.position(i, 7), A.position(7, i)})
        if (k >= 0)
          A.values[k] *= small;
  }
  const Vector<double> b = load(A.n());
  LinearSolver         full(with_factors("double"));
  LinearSolver         single(with_factors("single"));
  const Vector<double> expected = solution(full, A, b);
  CHECK(difference(solution(single, A, b), expected) < 1e-10);
}

TEST_CASE("A body that nothing holds is found as with double precision, in the "
          "same words",
          "[solver]")
{
  CSRMatrix A = make_elastic_block({{4, 4, 2}}, 2, 1.).matrix;
  SECTION("free body")
  {
    A = make_elastic_block({{4, 4, 2}}, 2, 0.).matrix;
  }
  SECTION("an unknown without any stiffness")
  {
    for (int i = 0; i < static_cast<int>(A.n()); ++i)
      for (const int k : {A.position(i, 5), A.position(5, i)})
        if (k >= 0)
          A.values[k] = 0;
  }
  SECTION("values that are not finite")
  {
    A.values[A.position(3, 3)] = std::nan("");
  }
  SECTION("no stiffness at all")
  {
    A.set_zero();
  }
  const auto words = [&A](const std::string &factors) -> std::string {
    LinearSolver solver(with_factors(factors));
    try
      {
        solver.factorize(A);
      }
    catch (const LinearSolverFailed &failure)
      {
        return failure.what();
      }
    return "";
  };
  CHECK(!words("double").empty());
  CHECK(words("single") == words("double"));
}

TEST_CASE("A condition of 1e9 asks for double precision, which is remembered "
          "for the pattern and told to a run that goes on",
          "[solver]")
{
  const double    friction = GENERATE(0., 0.3);
  const CSRMatrix soft =
    make_elastic_block({{4, 4, 2}}, 2, 1e-9, friction).matrix;
  CSRMatrix            stiff = make_elastic_block({{4, 4, 2}}, 2, 1.).matrix;
  const Vector<double> b     = load(soft.n());
  LinearSolver         full(with_factors("double"));
  LinearSolver         single(with_factors("single"));
  const Vector<double> expected = solution(full, soft, b);
  CHECK(solution(single, soft, b) == expected);
  CHECK_THAT(single.description(),
             Catch::Contains("double precision, as the condition is at least"));
  CHECK(single.n_numeric() == 2);
  CHECK(single.n_symbolic() == 1);
  CHECK(single.memory().needs_double);
  CHECK_FALSE(single.memory().is_indefinite);

  // At once the next time, also where single precision would do.
  CSRMatrix same(soft);
  shift_diagonal(same, 0.1);
  const Vector<double> next = solution(single, same, b);
  CHECK(single.n_numeric() == 3);
  CHECK_FALSE(is_single(single));

  // A solver that was told so does the same; of another pattern it was not.
  LinearSolver told(with_factors("single"));
  told.remember(single.memory(), same.pattern_id());
  CHECK(solution(told, same, b) == next);
  CHECK(told.n_numeric() == 1);
  CHECK(told.memory().needs_double);
  solution(told, stiff, b);
  CHECK(is_single(told));
  CHECK_FALSE(told.memory().needs_double);
  LinearSolver not_told(with_factors("single"));
  not_told.remember(single.memory(), stiff.pattern_id());
  solution(not_told, same, b);
  CHECK(is_single(not_told));
}

TEST_CASE("Factors that serve no solution are replaced by those of double "
          "precision",
          "[solver]")
{
  CSRMatrix            A = make_elastic_block({{6, 6, 2}}, 1, 1.).matrix;
  const Vector<double> b = load(A.n());
  LinearSolver         single(with_factors("single"));
  single.factorize(A);
  CHECK(is_single(single));
  // As bad as can be: those of another matrix.
  for (unsigned int i = 0; i < A.n(); ++i)
    A.values[A.position(i, i)] *= 1. + i * i;
  Vector<double> x;
  single.solve(b, x);
  CHECK_THAT(single.description(),
             Catch::Contains("double precision, as a solution did not reach"));
  CHECK(single.n_numeric() == 2);
  CHECK(single.n_iterations() >= 30);
  CHECK(single.memory().needs_double);

  LinearSolver         full(with_factors("double"));
  const Vector<double> expected = solution(full, A, b);
  CHECK(x == expected);
  single.solve(b, x);
  CHECK(x == expected);
  CHECK(single.n_numeric() == 2);
}

TEST_CASE("A unit beyond the range of single precision asks for double "
          "precision",
          "[solver]")
{
  // One unknown apart from the others.
  CSRMatrix A = make_elastic_block({{3, 3, 2}}, 1, 1.).matrix;
  for (int i = 0; i < static_cast<int>(A.n()); ++i)
    for (const int k : {A.position(i, 7), A.position(7, i)})
      if (k >= 0)
        A.values[k] = i == 7 ? 1e-60 : 0.;
  const Vector<double> b = load(A.n());
  LinearSolver         full(with_factors("double"));
  LinearSolver         single(with_factors("single"));
  const Vector<double> x = solution(single, A, b);
  CHECK(x == solution(full, A, b));
  CHECK(x[7] == Approx(1e60 * b[7]));
  CHECK(single.memory().needs_double);
}

TEST_CASE("The program takes factors of single precision for large systems",
          "[solver]")
{
  const unsigned int n_spans = GENERATE(9, 16);
  const CSRMatrix A = make_elastic_block({{n_spans, 16, 4}}, 1, 1., 0.3).matrix;
  LinearSolver    solver(with_factors("automatic"));
  solver.factorize(A);
  INFO(A.n());
  CHECK(is_single(solver) == (A.n() >= 5000));
}

TEST_CASE("GMRES with the inverse needs one iteration, without any "
          "preconditioner as many as there are unknowns",
          "[solver]")
{
  const unsigned int n   = 6;
  const auto         map = [](const bool inverse) {
    return [inverse](const Vector<double> &x, Vector<double> &y) {
      y.reinit(n);
      for (unsigned int i = 0; i < n; ++i)
        y[i] = inverse ? x[i] / (1. + i) : (1. + i) * x[i];
    };
  };
  const auto identity = [](const Vector<double> &x, Vector<double> &y) {
    y = x;
  };
  const Vector<double> b = load(n);
  Vector<double>       x, expected;
  map(true)(b, expected);
  CHECK(flexible_gmres(map(false), map(true), b, 1e-12, 30, x) == 1);
  CHECK(difference(x, expected) < 1e-14);
  CHECK(flexible_gmres(map(false), identity, b, 1e-12, 30, x) == n);
  CHECK(difference(x, expected) < 1e-12);

  // The best so far after fewer, nothing without directions.
  Vector<double> r;
  double         last = b.l2_norm();
  for (unsigned int k = 1; k < n; ++k)
    {
      CHECK(flexible_gmres(map(false), identity, b, 1e-12, k, x) == k);
      map(false)(x, r);
      r -= b;
      CHECK(r.l2_norm() < last);
      last = r.l2_norm();
    }
  const auto nothing = [](const Vector<double> &, Vector<double> &y) {
    y.reinit(n);
  };
  const auto not_a_number = [](const Vector<double> &, Vector<double> &y) {
    y.reinit(n);
    y[2] = std::nan("");
  };
  CHECK(flexible_gmres(map(false), nothing, b, 1e-12, 30, x) == 0);
  CHECK(x.linfty_norm() == 0.);
  CHECK(flexible_gmres(map(false), not_a_number, b, 1e-12, 30, x) == 0);
  CHECK(flexible_gmres(map(false), map(true), r = 0., 1e-12, 30, x) == 0);
}
