// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about relations between unknowns: however they overlap, every one of
// them holds afterwards, and a contradiction is named.

#include <npt_dealii/homogenization/orbit_constraints.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>

using namespace NPT;
using dealii::AffineConstraints;
using dealii::Vector;

namespace
{
  struct Relation
  {
    unsigned int             i;
    double                   sign;
    unsigned int             j;
    OrbitConstraints::Affine affine;
  };

  std::string
  contradiction(OrbitConstraints &orbits, const Relation &r)
  {
    try
      {
        orbits.relate(r.i, r.sign, r.j, r.affine, "glide plane");
      }
    catch (const std::logic_error &error)
      {
        return error.what();
      }
    return "no contradiction";
  }

  /// Add relations, give the free unknowns arbitrary values, and check them.
  /// Returns how many unknowns remain free (macro unknowns excluded).
  unsigned int
  check_all_hold(const unsigned int           n,
                 const unsigned int           n_macro,
                 const std::vector<Relation> &relations)
  {
    OrbitConstraints orbits(n, OrbitConstraints::Affine(n_macro, 1.));
    for (const Relation &r : relations)
      orbits.relate(r.i, r.sign, r.j, r.affine, "test");
    AffineConstraints<double> constraints;
    orbits.write(constraints);
    constraints.close();

    Vector<double> x(n + n_macro);
    for (unsigned int i = 0; i < x.size(); ++i)
      x[i] = std::sin(1. + 2.3 * i);
    constraints.distribute(x);
    for (const Relation &r : relations)
      {
        double right = r.sign * x[r.j];
        for (unsigned int k = 0; k < n_macro; ++k)
          right += r.affine[k] * x[n + k];
        CHECK(x[r.i] == Approx(right).margin(1e-12));
      }

    unsigned int n_free = 0;
    for (unsigned int i = 0; i < n; ++i)
      n_free += constraints.is_constrained(i) ? 0 : 1;
    for (unsigned int k = 0; k < n_macro; ++k)
      CHECK_FALSE(constraints.is_constrained(n + k));
    return n_free;
  }
} // namespace



TEST_CASE("A chain of relations leaves one free unknown", "[homogenization]")
{
  std::vector<Relation> chain = {{0, -1., 1, {1., 0.}},
                                 {2, 1., 1, {0., 2.}},
                                 {2, -1., 3, {0.5, 0.}},
                                 {4, -1., 3, {0., 0.}}};
  CHECK(check_all_hold(5, 2, chain) == 1);

  // Whatever the order in which they are told.
  const auto less = [](const Relation &a, const Relation &b) {
    return std::tie(a.i, a.j) < std::tie(b.i, b.j);
  };
  std::sort(chain.begin(), chain.end(), less);
  do
    CHECK(check_all_hold(5, 2, chain) == 1);
  while (std::next_permutation(chain.begin(), chain.end(), less));
}



TEST_CASE("A long chain is followed to its end", "[homogenization]")
{
  std::vector<Relation> chain;
  for (unsigned int i = 0; i + 1 < 2000; ++i)
    chain.push_back({i, i % 3 == 0 ? -1. : 1., i + 1, {0.001 * i}});
  CHECK(check_all_hold(2000, 1, chain) == 1);
}



TEST_CASE("A cycle that closes consistently changes nothing",
          "[homogenization]")
{
  // The corner of a cell: two glides in either order give the same point.
  const double L1 = 5., L2 = 4.;
  CHECK(check_all_hold(4,
                       2,
                       {{1, 1., 0, {L1, 0.}},
                        {2, 1., 0, {0., L2}},
                        {3, 1., 1, {0., L2}},
                        {3, 1., 2, {L1, 0.}}}) == 1);
  // The same relation twice, and its inverse.
  CHECK(check_all_hold(
          2, 1, {{1, -1., 0, {3.}}, {1, -1., 0, {3.}}, {0, -1., 1, {3.}}}) ==
        1);
}



TEST_CASE("An orbit that closes with reversed sign is fixed by the macro "
          "unknowns",
          "[homogenization]")
{
  SECTION("a point on the axis is its own image")
  {
    CHECK(check_all_hold(1, 1, {{0, -1., 0, {4.}}}) == 0);

    OrbitConstraints orbits(1, {1.});
    orbits.relate(0, -1., 0, {4.}, "2-fold axis");
    AffineConstraints<double> constraints;
    orbits.write(constraints);
    constraints.close();
    REQUIRE(constraints.get_constraint_entries(0)->size() == 1);
    CHECK((*constraints.get_constraint_entries(0))[0].first == 1);
    CHECK((*constraints.get_constraint_entries(0))[0].second == 2.);
  }
  SECTION("the whole orbit is fixed with it")
  {
    CHECK(check_all_hold(
            3, 1, {{0, 1., 1, {1.}}, {2, -1., 1, {0.}}, {2, 1., 0, {5.}}}) ==
          0);
  }
  SECTION("a fixed orbit fixes what is attached to it later")
  {
    CHECK(check_all_hold(
            3, 1, {{0, -1., 0, {2.}}, {0, -1., 1, {0.5}}, {2, 1., 1, {1.}}}) ==
          0);
    CHECK(check_all_hold(
            3, 1, {{0, -1., 0, {2.}}, {1, -1., 0, {0.5}}, {1, 1., 2, {1.}}}) ==
          0);
  }
  SECTION("two fixed orbits may be joined if they agree")
  {
    // x_0 = M, x_1 = 2 M, and x_1 = x_0 + M.
    CHECK(check_all_hold(
            2, 1, {{0, -1., 0, {2.}}, {1, -1., 1, {4.}}, {1, 1., 0, {1.}}}) ==
          0);
  }
}



TEST_CASE("A contradiction is named with the macro unknown it would prescribe",
          "[homogenization]")
{
  SECTION("a cycle that does not close")
  {
    // Bending under the glide plane: w(+) = w(-) + H and w(+) = w(-) - H.
    OrbitConstraints orbits(2, OrbitConstraints::Affine(6, 1.));
    orbits.relate(1, 1., 0, {0, 0, 0, 2.5, 0, 0}, "translation");
    CHECK(contradiction(orbits, {1, 1., 0, {0, 0, 0, -2.5, 0, 0}}) ==
          "The coupling 'glide plane' contradicts the others: it would "
          "prescribe macro unknown 3.");
  }
  SECTION("a point with two values")
  {
    OrbitConstraints orbits(1, {1.});
    orbits.relate(0, -1., 0, {2.}, "2-fold axis");
    CHECK(contradiction(orbits, {0, -1., 0, {2.}}) == "no contradiction");
    CHECK(contradiction(orbits, {0, -1., 0, {3.}}) ==
          "The coupling 'glide plane' contradicts the others: it would "
          "prescribe macro unknown 0.");
  }
  SECTION("two fixed orbits that disagree")
  {
    OrbitConstraints orbits(2, {1.});
    orbits.relate(0, -1., 0, {2.}, "2-fold axis");
    orbits.relate(1, -1., 1, {4.}, "2-fold axis");
    CHECK(contradiction(orbits, {1, 1., 0, {7.}}) ==
          "The coupling 'glide plane' contradicts the others: it would "
          "prescribe macro unknown 0.");
  }
}



TEST_CASE("Any consistent set of relations leaves one unknown per orbit",
          "[homogenization]")
{
  // Truth: unknown i belongs to orbit i % 7 and is s_i X + a_i; orbit 0 is
  // fixed. Relations that follow from it are told in random order, far more of
  // them than are needed.
  constexpr unsigned int n = 140, n_orbits = 7, n_macro = 3;
  std::mt19937           engine(7);
  const auto             number = [&]() {
    return std::uniform_real_distribution<double>(-1, 1)(engine);
  };

  std::vector<double>                   s(n);
  std::vector<OrbitConstraints::Affine> a(n);
  for (unsigned int i = 0; i < n; ++i)
    {
      s[i] = engine() % 2 ? 1. : -1.;
      a[i] = {number(), number(), number()};
    }
  std::vector<Relation> relations;
  const auto relate = [&](const unsigned int i, const unsigned int j) {
    const double             sign = s[i] * s[j];
    OrbitConstraints::Affine affine(n_macro);
    for (unsigned int k = 0; k < n_macro; ++k)
      affine[k] = a[i][k] - sign * a[j][k];
    relations.push_back({i, sign, j, affine});
  };
  for (unsigned int i = n_orbits; i < n; ++i)
    relate(i, i - n_orbits);
  for (unsigned int r = 0; r < 1000; ++r)
    {
      const unsigned int i = engine() % n;
      relate(i, i % n_orbits + n_orbits * (engine() % (n / n_orbits)));
    }
  // x = -x + 2 a holds where X = 0.
  for (unsigned int i = 0; i < n; i += 5 * n_orbits)
    relations.push_back({i, -1., i, {2 * a[i][0], 2 * a[i][1], 2 * a[i][2]}});
  std::shuffle(relations.begin(), relations.end(), engine);

  CHECK(check_all_hold(n, n_macro, relations) == n_orbits - 1);
}



TEST_CASE("A combination holds for every member of its orbit",
          "[homogenization]")
{
  // Unknowns 0 and 4 are the ends of a strand, 1 and 3 their inner neighbors;
  // 4 = -0 + M. The condition of one end is the image of that of the other.
  for (const unsigned int first : {0, 1})
    {
      OrbitConstraints orbits(5, {1.});
      orbits.relate(4, -1., 0, {1.}, "glide plane");
      const auto tell = [&](const unsigned int end) {
        if (end == 0) // x_0 = (x_1 + (-x_3 + M)) / 2
          orbits.combine(0, {{0.5, 1}, {-0.5, 3}}, {0.5}, "seam");
        else // x_4 = (x_3 + (-x_1 + M)) / 2
          orbits.combine(4, {{0.5, 3}, {-0.5, 1}}, {0.5}, "seam");
      };
      tell(first);
      tell(1 - first);
      AffineConstraints<double> constraints;
      orbits.write(constraints);
      constraints.close();
      CHECK(constraints.n_constraints() == 2);
      Vector<double> x({0., 1.3, -0.4, 2.1, 0., 0.7});
      constraints.distribute(x);
      CHECK(x[0] == Approx(0.5 * (1.3 - 2.1 + 0.7)).epsilon(1e-14));
      CHECK(x[4] == Approx(-x[0] + 0.7).epsilon(1e-14));
    }
}



TEST_CASE("Combinations follow each other into a corner, and either way around "
          "it is the same",
          "[homogenization]")
{
  // 0 is the corner of a cell, 1 and 2 lie on its edges, 3 and 4 inside.
  OrbitConstraints orbits(5, {1., 1.});
  orbits.combine(0, {{0.5, 1}, {0.5, 2}}, {1., 0.}, "edge");
  orbits.combine(1, {{0.25, 3}, {0.75, 4}}, {0., 2.}, "inside");
  orbits.combine(2, {{1., 3}}, {0., 0.}, "inside");
  orbits.combine(0, {{0.625, 3}, {0.375, 4}}, {1., 1.}, "both");
  AffineConstraints<double> constraints;
  orbits.write(constraints);
  constraints.close();
  Vector<double> x({0., 0., 0., 1., 2., 3., 4.});
  constraints.distribute(x);
  CHECK(x[1] == Approx(0.25 * 1. + 0.75 * 2. + 2. * 4.));
  CHECK(x[0] == Approx(0.625 * 1. + 0.375 * 2. + 3. + 4.));
}



TEST_CASE("A combination that contradicts the rest is named",
          "[homogenization]")
{
  AffineConstraints<double> constraints;
  const auto                message = [&](const OrbitConstraints &orbits) {
    try
      {
        orbits.write(constraints);
      }
    catch (const std::logic_error &error)
      {
        return std::string(error.what());
      }
    return std::string("no contradiction");
  };
  SECTION("a fixed unknown would restrict its neighbors")
  {
    OrbitConstraints orbits(2, {1.});
    orbits.relate(0, -1., 0, {2.}, "pin");
    orbits.combine(0, {{1., 1}}, {0.}, "seam");
    CHECK(message(orbits) ==
          "The condition 'seam' contradicts the others: it would restrict "
          "unknown 1.");
  }
  SECTION("a fixed unknown has another value")
  {
    OrbitConstraints orbits(2, {1.});
    orbits.relate(0, -1., 0, {2.}, "pin");
    orbits.relate(1, -1., 1, {4.}, "pin");
    orbits.combine(0, {{1., 1}}, {0.}, "seam");
    CHECK(message(orbits) ==
          "The condition 'seam' contradicts the others: it would prescribe "
          "macro unknown 0.");
  }
  SECTION("a circle")
  {
    OrbitConstraints orbits(3, {1.});
    orbits.relate(2, 1., 0, {2.}, "translation");
    orbits.combine(0, {{0.5, 1}, {0.5, 1}}, {0.}, "seam");
    orbits.combine(1, {{1., 2}}, {0.}, "seam");
    CHECK(message(orbits) == "The condition 'seam' defines an unknown by "
                             "itself.");
  }
}
