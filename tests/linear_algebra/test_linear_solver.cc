// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the claims on linear solvers.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/linear_algebra/linear_solver.h>

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <iostream>
#include <sstream>

#include "elastic_block.h"

using namespace NPT;
using dealii::Vector;

namespace
{
  LinearSolverParameters
  type(const std::string &name)
  {
    LinearSolverParameters parameters;
    parameters.type = value_of<LinearSolverParameters::Type>(name);
    return parameters;
  }

  Vector<double>
  some_vector(const unsigned int n)
  {
    Vector<double> x(n);
    for (unsigned int i = 0; i < n; ++i)
      x[i] = std::sin(1. + i);
    return x;
  }

  double
  relative_residual(const CSRMatrix      &A,
                    const Vector<double> &x,
                    const Vector<double> &b)
  {
    Vector<double> r;
    A.vmult(r, x);
    r -= b;
    return r.l2_norm() / b.l2_norm();
  }
} // namespace

TEST_CASE("Every solver solves unsymmetric elasticity to its tolerance",
          "[solver]")
{
  const auto name =
    GENERATE(as<std::string>(), "automatic", "MUMPS", "UMFPACK", "ILU", "ML");
  const auto [A, modes]   = make_elastic_block({{6, 5, 2}}, 1, 1., 0.3);
  const Vector<double> x0 = some_vector(A.n());
  Vector<double>       b, x;
  A.vmult(b, x0);

  LinearSolver solver(type(name));
  solver.set_near_null_space(modes, 3);
  solver.factorize(A);
  solver.solve(b, x);
  INFO(name);
  CHECK(relative_residual(A, x, b) <= 1e-10);
  CHECK(solver.relative_residual() ==
        Approx(relative_residual(A, x, b)).margin(1e-14));
  // Room for a condition number of 1e4.
  x -= x0;
  CHECK(x.linfty_norm() < 1e-6);
  CHECK(solver.n_solves() == 1);
  CHECK(solver.seconds() > 0);
}

TEST_CASE("New values of the same pattern reuse the symbolic factorization, a "
          "new pattern does not",
          "[solver]")
{
  const auto name =
    GENERATE(as<std::string>(), "automatic", "MUMPS", "UMFPACK", "ILU", "ML");
  CSRMatrix    A = make_elastic_block({{4, 4, 2}}, 1, 1., 0.3).matrix;
  LinearSolver solver(type(name));
  INFO(name);

  const auto solves = [&](const CSRMatrix &matrix) {
    const Vector<double> b = some_vector(matrix.n());
    Vector<double>       x;
    solver.factorize(matrix);
    solver.solve(b, x);
    return relative_residual(matrix, x, b) < 1e-10;
  };

  CHECK(solves(A));
  for (unsigned int i = 0; i < A.n(); ++i)
    A.values[A.position(i, i)] += 0.1 * (1 + i % 3);
  CHECK(solves(A));
  CHECK(solver.n_symbolic() == 1);
  CHECK(solver.n_numeric() == 2);

  // Another size, a matrix that is structurally unsymmetric, the old again.
  CSRMatrix                     other;
  std::vector<std::vector<int>> columns(50);
  for (int i = 0; i < 50; ++i)
    columns[i] = {i, (i + 1) % 50, (i + 7) % 50};
  other.set_pattern(columns);
  for (int i = 0; i < 50; ++i)
    {
      other.values[other.position(i, i)]            = 4;
      other.values[other.position(i, (i + 1) % 50)] = -1;
      other.values[other.position(i, (i + 7) % 50)] = 0.5;
    }
  CHECK(solves(other));
  CHECK(solves(A));
  CHECK(solver.n_symbolic() == 3);
  CHECK(solver.n_numeric() == 4);
  CHECK(solver.n_solves() == 4);
}

TEST_CASE("Direct solvers take matrices of one pattern that are positive "
          "definite, indefinite and unsymmetric in any order",
          "[solver]")
{
  const auto name =
    GENERATE(as<std::string>(), "automatic", "MUMPS", "UMFPACK");
  INFO(name);
  // Two springs per unknown and one to the ground, a load that follows.
  const unsigned int            n = 60;
  CSRMatrix                     A;
  std::vector<std::vector<int>> columns(n);
  for (int i = 0; i < static_cast<int>(n); ++i)
    columns[i] = {i, (i + 1) % static_cast<int>(n), (i + 59) % 60};
  A.set_pattern(columns);
  const auto set = [&](const double ground, const double follower) {
    for (unsigned int i = 0; i < n; ++i)
      {
        A.values[A.position(i, i)]            = 2. + ground;
        A.values[A.position(i, (i + 1) % n)]  = -1. + follower;
        A.values[A.position(i, (i + 59) % n)] = -1.;
      }
  };
  LinearSolver solver(type(name));
  const auto   solves = [&]() {
    const Vector<double> b = some_vector(n);
    Vector<double>       x;
    solver.factorize(A);
    solver.solve(b, x);
    return relative_residual(A, x, b) < 1e-12;
  };
  set(0.3, 0.);
  CHECK(solves());
  set(0.3, 0.4);
  CHECK(solves());
  set(-0.77, 0.);
  CHECK(solves());
  set(0.3, 0.);
  CHECK(solves());
  CHECK(solver.n_symbolic() == 1);
}

TEST_CASE("Direct solvers find a body that nothing holds, also if the load is "
          "in balance",
          "[solver]")
{
  const auto name =
    GENERATE(as<std::string>(), "automatic", "MUMPS", "UMFPACK");
  INFO(name);
  std::ostringstream noise;
  auto *const        screen = std::cerr.rdbuf(noise.rdbuf());

  SECTION("free body")
  {
    const CSRMatrix A = make_elastic_block({{4, 4, 2}}, 2, 0.).matrix;
    LinearSolver    solver(type(name));
    CHECK_THROWS_AS(solver.factorize(A), LinearSolverFailed);
    CHECK_THROWS_WITH(solver.factorize(A), Catch::Contains("nothing holds"));
  }
  SECTION("an unknown without any stiffness, then mended")
  {
    CSRMatrix       A    = make_elastic_block({{2, 2, 2}}, 1, 1.).matrix;
    const CSRMatrix good = A;
    for (int i = 0; i < static_cast<int>(A.n()); ++i)
      for (const int k : {A.position(i, 5), A.position(5, i)})
        if (k >= 0)
          A.values[k] = 0;
    LinearSolver   solver(type(name));
    Vector<double> x;
    CHECK_THROWS_AS(solver.factorize(A), LinearSolverFailed);
    solver.factorize(good);
    solver.solve(some_vector(A.n()), x);
    CHECK(solver.relative_residual() < 1e-12);
    CHECK(solver.n_symbolic() == 1);
  }
  SECTION("values that are not finite")
  {
    CSRMatrix A                = make_elastic_block({{2, 2, 2}}, 1, 1.).matrix;
    A.values[A.position(3, 3)] = std::nan("");
    LinearSolver solver(type(name));
    CHECK_THROWS_AS(solver.factorize(A), LinearSolverFailed);
  }
  std::cerr.rdbuf(screen);
  CHECK(noise.str().empty());
}

TEST_CASE("A right-hand side that is not finite fails the step", "[solver]")
{
  const auto name =
    GENERATE(as<std::string>(), "automatic", "MUMPS", "UMFPACK", "ILU", "ML");
  const CSRMatrix A = make_elastic_block({{2, 2, 2}}, 1, 1.).matrix;
  LinearSolver    solver(type(name));
  Vector<double>  x, b = some_vector(A.n());
  b[3] = std::nan("");
  solver.factorize(A);
  CHECK_THROWS_AS(solver.solve(b, x), LinearSolverFailed);
}

TEST_CASE("A soft foundation is not taken for none", "[solver]")
{
  const auto name =
    GENERATE(as<std::string>(), "automatic", "MUMPS", "UMFPACK");
  const CSRMatrix A = make_elastic_block({{4, 4, 2}}, 2, 1e-6, 0.3).matrix;
  LinearSolver    solver(type(name));
  Vector<double>  x;
  solver.factorize(A);
  solver.solve(some_vector(A.n()), x);
  CHECK(solver.relative_residual() < 1e-8);
}

TEST_CASE("An iteration that does not converge says so", "[solver]")
{
  const auto      name = GENERATE(as<std::string>(), "ILU", "ML");
  const CSRMatrix A    = make_elastic_block({{8, 8, 2}}, 1, 1e-4, 0.3).matrix;
  LinearSolverParameters parameters = type(name);
  parameters.max_iterations         = 2;
  LinearSolver   solver(parameters);
  Vector<double> x;
  solver.factorize(A);
  CHECK_THROWS_AS(solver.solve(some_vector(A.n()), x), LinearSolverFailed);
  CHECK_THROWS_WITH(solver.solve(some_vector(A.n()), x),
                    Catch::Contains("2 iterations"));
}

TEST_CASE("Rigid-body modes halve the iterations of ML on a soft foundation",
          "[solver]")
{
  const auto [A, modes] = make_elastic_block({{12, 12, 4}}, 1, 1e-4);
  unsigned int n_iterations[2];
  for (const bool with_modes : {false, true})
    {
      LinearSolver   solver(type("ML"));
      Vector<double> x;
      if (with_modes)
        solver.set_near_null_space(modes, 3);
      solver.factorize(A);
      solver.solve(some_vector(A.n()), x);
      n_iterations[with_modes] = solver.n_iterations();
    }
  CAPTURE(n_iterations[0], n_iterations[1]);
  CHECK(2 * n_iterations[1] <= n_iterations[0]);
}

TEST_CASE("Linear solver parameters are read from their subsection", "[solver]")
{
  LinearSolverParameters   parameters;
  dealii::ParameterHandler prm;
  parameters.add_parameters(prm);
  prm.parse_input_from_string("subsection Linear solver\n"
                              "  set Type = ILU\n"
                              "  set Tolerance = 1e-8\n"
                              "end\n");
  CHECK(parameters.type == LinearSolverParameters::Type::ILU);
  CHECK(parameters.tolerance == 1e-8);
  CHECK(parameters.max_iterations == 500);
  CHECK_THROWS_AS(type("KLU"), InputError);
}



TEST_CASE("The program takes ILU where the factors of MUMPS do not fit, and "
          "says so",
          "[solver]")
{
  const auto [A, modes]  = make_elastic_block({{6, 5, 2}}, 1, 1., 0.3);
  const Vector<double> b = some_vector(A.n());
  Vector<double>       x;

  LinearSolver free_choice(type("automatic"));
  free_choice.factorize(A);
  CHECK_THAT(free_choice.description(),
             Catch::Contains("fronts") && !Catch::Contains("disk"));

  LinearSolverParameters little_memory = type("automatic");
  little_memory.maximum_memory         = 1e-6;
  LinearSolver solver(little_memory);
  solver.factorize(A);
  solver.solve(b, x);
  CHECK_THAT(solver.description(),
             Catch::Contains("ILU") && Catch::Contains("1e-06 GB are allowed"));
  CHECK(relative_residual(A, x, b) <= 1e-10);

  // What the user chose is not replaced.
  little_memory.type = LinearSolverParameters::Type::MUMPS;
  LinearSolver mumps(little_memory);
  CHECK_THROWS_WITH(mumps.factorize(A), Catch::Contains("GB are allowed"));
}



TEST_CASE("Factors of MUMPS that do not fit in the memory go to the disk",
          "[solver]")
{
  const auto [A, modes]  = make_elastic_block({{12, 10, 6}}, 1, 1., 0.3);
  const Vector<double> b = some_vector(A.n());
  Vector<double>       x, expected;
  LinearSolver         in_memory(type("MUMPS"));
  in_memory.factorize(A);
  in_memory.solve(b, expected);

  // Somewhere between all factors and the largest front.
  bool                   was_on_disk = false;
  LinearSolverParameters parameters  = type("MUMPS");
  for (parameters.maximum_memory = 0.04; !was_on_disk;
       parameters.maximum_memory -= 0.001)
    {
      REQUIRE(parameters.maximum_memory > 0.001);
      LinearSolver solver(parameters);
      solver.factorize(A);
      solver.solve(b, x);
      was_on_disk =
        solver.description().find("factors on disk") != std::string::npos;
    }
  x -= expected;
  CHECK(x.linfty_norm() <= 1e-10 * expected.linfty_norm());

  // Where the disk does not take them either, the memory is what lacks.
  parameters.maximum_memory += 0.001; // as in the last solver above
  setenv("MUMPS_OOC_TMPDIR", "/nonexistent/folder", 1);
  LinearSolver nowhere(parameters);
  CHECK_THROWS_AS(nowhere.factorize(A), OutOfMemory);
  CHECK_THROWS_WITH(nowhere.factorize(A), Catch::Contains("on the disk"));
  unsetenv("MUMPS_OOC_TMPDIR");
}



TEST_CASE("A matrix whose first pivots are zero is left to MUMPS, the next one "
          "is not",
          "[solver]")
{
  // A constraint that is eliminated first: [[0, 1], [1, 0]] in many places.
  const unsigned int            n = 40;
  CSRMatrix                     A;
  std::vector<std::vector<int>> columns(2 * n);
  for (unsigned int i = 0; i < n; ++i)
    {
      const int a = 2 * i, b = a + 1, c = (a + 3) % (2 * n);
      for (const auto &[row, column] :
           {std::pair(a, a), {a, b}, {b, a}, {b, b}, {b, c}, {c, b}})
        columns[row].push_back(column);
    }
  A.set_pattern(columns);
  const auto fill = [&](const double first) {
    A.set_zero();
    for (unsigned int i = 0; i < n; ++i)
      {
        const int a = 2 * i, b = a + 1, c = (a + 3) % (2 * n);
        A.values[A.position(a, a)] = first;
        A.values[A.position(a, b)] = A.values[A.position(b, a)] = 1;
        A.values[A.position(b, b)]                              = 5;
        A.values[A.position(b, c)] += 0.5;
        A.values[A.position(c, b)] += 0.5;
      }
  };
  LinearSolver         solver(type("automatic"));
  const Vector<double> b = some_vector(2 * n);
  for (const double first : {2., 1e-14, 2.})
    {
      INFO(first);
      Vector<double> x;
      fill(first);
      solver.factorize(A);
      solver.solve(b, x);
      CHECK(relative_residual(A, x, b) < 1e-12);
    }
  CHECK(solver.n_symbolic() == 1);
}



TEST_CASE(
  "Fronts and MUMPS agree to round-off, and fronts repeat themselves to "
  "the last bit",
  "[solver]")
{
  for (const double unsymmetric : {0., 0.3})
    for (const unsigned int size : {2u, 5u, 9u})
      {
        const CSRMatrix A =
          make_elastic_block({{size, size, 2}}, 2, 1., unsymmetric).matrix;
        const Vector<double>          b = some_vector(A.n());
        std::array<Vector<double>, 3> x;
        unsigned int                  k = 0;
        for (const std::string name : {"MUMPS", "automatic", "automatic"})
          {
            LinearSolver solver(type(name));
            solver.factorize(A);
            CHECK_THAT(solver.description(),
                       Catch::Contains(name == "MUMPS" ? "MUMPS" : "fronts"));
            solver.solve(b, x[k++]);
            CHECK(solver.relative_residual() < 1e-12);
          }
        CHECK(x[1] == x[2]);
        x[0] -= x[1];
        CHECK(x[0].linfty_norm() < 1e-9 * x[1].linfty_norm());
      }
}
