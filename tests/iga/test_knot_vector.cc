// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the tests of knot vectors and of their extraction operators.

#include <npt_dealii/iga/bezier_extraction.h>
#include <npt_dealii/iga/element_table.h>

#include <deal.II/fe/fe_bernstein.h>

#include "iga_test_tools.h"

using namespace NPT;
using namespace IGATests;
using Catch::Matchers::Contains;

namespace
{
  // All functions (or derivatives of order d) with the polynomials of span e.
  std::vector<double>
  all_functions(const KnotVector  &k,
                const unsigned int e,
                const double       u,
                const unsigned int d = 0)
  {
    std::vector<double> result(k.n_functions(), 0.);
    const auto          table = k.values(e, u, d);
    for (unsigned int a = 0; a <= k.degree(); ++a)
      result[k.first_function(e) + a] = table[d][a];
    return result;
  }



  double
  binomial(const unsigned int n, const unsigned int k)
  {
    return k == 0 ? 1. : binomial(n - 1, k - 1) * n / k;
  }



  // Largest difference between the old functions and T^T times the new ones.
  double
  lost_by_operator(const KnotVector                 &before,
                   const KnotVector                 &after,
                   const dealii::FullMatrix<double> &T)
  {
    double difference = 0.;
    for (unsigned int e = 0; e < after.n_spans(); ++e)
      for (const double u : points_of_span(after, e))
        {
          const double middle =
            0.5 * (after.breaks()[e] + after.breaks()[e + 1]);
          const auto N = all_functions(before, before.find_span(middle), u);
          const auto M = all_functions(after, e, u);
          for (unsigned int j = 0; j < N.size(); ++j)
            {
              double sum = 0.;
              for (unsigned int i = 0; i < M.size(); ++i)
                sum += M[i] * T(i, j);
              difference = std::max(difference, std::abs(sum - N[j]));
            }
        }
    return difference;
  }
} // namespace



TEST_CASE("B-splines are nonnegative and sum to one", "[iga]")
{
  for (const KnotVector &k : uneven_knot_vectors())
    for (unsigned int e = 0; e < k.n_spans(); ++e)
      for (const double u : points_of_span(k, e))
        {
          const auto N   = k.values(e, u, 0)[0];
          double     sum = 0., smallest = 1.;
          for (const double value : N)
            {
              sum += value;
              smallest = std::min(smallest, value);
            }
          // Sums of at most five numbers below one.
          CHECK(std::abs(sum - 1.) < 1e-14);
          // At the end of a span rounding may leave -1e-17.
          CHECK(smallest > -1e-15);
        }
}



TEST_CASE("B-splines are exactly C^{p-m} at a knot of multiplicity m", "[iga]")
{
  for (unsigned int p = 1; p <= 4; ++p)
    for (unsigned int m = 1; m <= p; ++m)
      {
        std::vector<double> knots(p + 1, 0.);
        knots.insert(knots.end(), m, 0.4);
        knots.insert(knots.end(), p + 1, 1.);
        const KnotVector k(p, knots);
        CHECK(k.multiplicity(0.4) == m);
        CHECK(k.n_functions() == p + 1 + m);
        for (unsigned int d = 0; d <= p - m + 1; ++d)
          {
            const auto left  = all_functions(k, 0, 0.4, d);
            const auto right = all_functions(k, 1, 0.4, d);
            double     jump  = 0.;
            for (unsigned int i = 0; i < left.size(); ++i)
              jump = std::max(jump, std::abs(left[i] - right[i]));
            INFO("p = " << p << ", m = " << m << ", derivative " << d);
            // The derivatives reach p!/0.4^p, about 1000: rounding 1e-12.
            if (d <= p - m)
              CHECK(jump < 1e-11);
            else
              CHECK(jump > 1.);
          }
      }
}



TEST_CASE("B-spline derivatives are the differences of lower ones", "[iga]")
{
  for (const KnotVector &k : uneven_knot_vectors())
    for (unsigned int e = 0; e < k.n_spans(); ++e)
      for (const double u : points_of_span(k, e))
        for (unsigned int d = 1; d <= k.degree() + 1; ++d)
          {
            const auto exact = k.values(e, u, d)[d];
            const auto lower = [&](const Point<1> &x) {
              return k.values(e, x[0], d - 1)[d - 1];
            };
            const auto approximate = difference<1>(lower, Point<1>(u), 0, 1e-3);
            // Rounding of the differences scales with the lower derivative.
            double size = 1., largest = 0., error = 0.;
            for (const double value : lower(Point<1>(u)))
              size = std::max(size, std::abs(value));
            for (unsigned int a = 0; a < exact.size(); ++a)
              {
                largest = std::max(largest, std::abs(exact[a]));
                error   = std::max(error, std::abs(exact[a] - approximate[a]));
              }
            // Polynomials of degree up to 4: the five-point formula is exact,
            // what remains is rounding 1e-16 / h.
            CHECK(error < 1e-11 * std::max(size, largest));
            CHECK((largest == 0.) == (d > k.degree()));
          }
}



TEST_CASE("B-splines reproduce polynomials up to their degree", "[iga]")
{
  // Marsden: the coefficients of x^k are the elementary symmetric polynomials
  // of the p interior knots of each function, divided by their number.
  for (const KnotVector &knots : uneven_knot_vectors())
    {
      const unsigned int p = knots.degree();
      for (unsigned int power = 0; power <= p; ++power)
        {
          std::vector<double> coefficients;
          for (unsigned int i = 0; i < knots.n_functions(); ++i)
            {
              std::vector<double> symmetric(p + 1, 0.);
              symmetric[0] = 1.;
              for (unsigned int j = 1; j <= p; ++j)
                for (unsigned int l = j; l >= 1; --l)
                  symmetric[l] += knots.knots()[i + j] * symmetric[l - 1];
              coefficients.push_back(symmetric[power] / binomial(p, power));
              if (power == 1)
                CHECK(coefficients.back() == Approx(knots.greville(i)));
            }
          for (unsigned int e = 0; e < knots.n_spans(); ++e)
            for (const double u : points_of_span(knots, e))
              {
                const auto N   = all_functions(knots, e, u);
                const auto N_1 = all_functions(knots, e, u, 1);
                double     f = 0., f_1 = 0.;
                for (unsigned int i = 0; i < N.size(); ++i)
                  {
                    f += coefficients[i] * N[i];
                    f_1 += coefficients[i] * N_1[i];
                  }
                // Values up to 5^3; derivatives with factors p / h = 40.
                CHECK(std::abs(f - std::pow(u, power)) < 1e-12);
                CHECK(
                  std::abs(
                    f_1 - (power == 0 ? 0. : power * std::pow(u, power - 1.))) <
                  1e-11);
              }
        }
    }
}



TEST_CASE("Spans count the nonempty intervals and contain their left end",
          "[iga]")
{
  const KnotVector k(2, {-1, -1, -1, -0.9, 0.2, 0.2, 2, 2, 2});
  CHECK(k.n_spans() == 3);
  CHECK(k.breaks() == std::vector<double>{-1, -0.9, 0.2, 2});
  CHECK(k.find_span(-7.) == 0);
  CHECK(k.find_span(-1.) == 0);
  CHECK(k.find_span(-0.9) == 1);
  CHECK(k.find_span(0.1999) == 1);
  CHECK(k.find_span(0.2) == 2);
  CHECK(k.find_span(2.) == 2);
  CHECK(k.find_span(7.) == 2);
  CHECK(k.first_function(0) == 0);
  CHECK(k.first_function(1) == 1);
  CHECK(k.first_function(2) == 3);
  CHECK(k.first_function(2) + k.degree() + 1 == k.n_functions());

  const KnotVector u = KnotVector::uniform(3, 5);
  CHECK(u.n_spans() == 5);
  CHECK(u.n_functions() == 8);
}



TEST_CASE("Extraction from FE_Bernstein gives the functions of Cox and de Boor",
          "[iga]")
{
  for (const KnotVector &k : uneven_knot_vectors())
    {
      const auto operators = bezier_extraction_operators(k);
      REQUIRE(operators.size() == k.n_spans());
      const unsigned int p = k.degree();
      for (unsigned int e = 0; e < k.n_spans(); ++e)
        {
          const auto           &C      = operators[e];
          const double          h      = k.breaks()[e + 1] - k.breaks()[e];
          const auto            points = points_of_span(k, e);
          std::vector<Point<1>> reference;
          for (const double u : points)
            reference.emplace_back((u - k.breaks()[e]) / h);
          const dealii::FE_Bernstein<1> element(p);
          const ElementTable<1> B(element, dealii::Quadrature<1>(reference));
          for (unsigned int q = 0; q < points.size(); ++q)
            {
              const auto N     = k.values(e, points[q], 1);
              double     error = 0.;
              for (unsigned int a = 0; a <= p; ++a)
                {
                  double value = 0., derivative = 0.;
                  for (unsigned int b = 0; b <= p; ++b)
                    {
                      value += C(a, b) * B.values(q, b);
                      derivative += C(a, b) * B.gradients(q, b)[0];
                    }
                  error = std::max(error, std::abs(value - N[0][a]));
                  error = std::max(error, std::abs(derivative - h * N[1][a]));
                }
              // Numbers of size one, p knots inserted.
              CHECK(error < 1e-13);
            }
          for (unsigned int b = 0; b <= p; ++b)
            {
              double sum = 0.;
              for (unsigned int a = 0; a <= p; ++a)
                {
                  CHECK(C(a, b) >= 0.);
                  sum += C(a, b);
                }
              CHECK(std::abs(sum - 1.) < 1e-14); // rounding
            }
        }
    }
}



TEST_CASE("Inserting knots keeps every old function in the space", "[iga]")
{
  for (const KnotVector &k : uneven_knot_vectors())
    {
      KnotVector refined = k;
      const auto T = k.insertion_operator(k.subdividing_knots(3), refined);
      CHECK(refined.n_spans() == 3 * k.n_spans());
      CHECK(lost_by_operator(k, refined, T) < 1e-14); // convex combinations

      KnotVector bezier = k;
      const auto S      = k.insertion_operator(k.bezier_knots(), bezier);
      CHECK(bezier.n_functions() == k.degree() * k.n_spans() + 1);
      CHECK(lost_by_operator(k, bezier, S) < 1e-14); // convex combinations
    }

  // Unordered and repeated values; the order in which they come is no matter.
  const KnotVector k = KnotVector::uniform(3, 2);
  KnotVector       a = k, b = k;
  auto             T = k.insertion_operator({0.7, 0.1, 0.5, 0.7}, a);
  const auto       S = k.insertion_operator({0.1, 0.5, 0.7, 0.7}, b);
  CHECK(a.knots() == b.knots());
  CHECK(a.multiplicity(0.7) == 2);
  CHECK(lost_by_operator(k, a, T) < 1e-14); // convex combinations
  T.add(-1., S);
  CHECK(T.linfty_norm() < 1e-14); // rounding
}



TEST_CASE("Elevating the degree keeps every function and its continuity",
          "[iga]")
{
  for (const KnotVector &k : uneven_knot_vectors())
    for (unsigned int times = 1; times <= 2; ++times)
      {
        KnotVector elevated = k;
        const auto T        = k.elevation_operator(times, elevated);
        CHECK(elevated.degree() == k.degree() + times);
        CHECK(elevated.breaks() == k.breaks());
        for (const double u : k.breaks())
          CHECK(elevated.degree() - elevated.multiplicity(u) ==
                k.degree() - k.multiplicity(u));
        // A collocation matrix of degree 6 loses about two digits.
        CHECK(lost_by_operator(k, elevated, T) < 1e-13);
      }
}



TEST_CASE("Unusable knots are refused with the reason", "[iga]")
{
  const auto refuse = [](const unsigned int         p,
                         const std::vector<double> &knots) {
    return input_error([&]() { KnotVector(p, knots); });
  };
  CHECK_THAT(refuse(2, {0, 0, 0, 0.6, 0.5, 1, 1, 1}),
             Contains("must not decrease") && Contains("0.5") &&
               Contains("0.6"));
  CHECK_THAT(refuse(2, {0, 0, 0, NAN, 1, 1, 1}), Contains("must not decrease"));
  CHECK_THAT(refuse(0, {0, 1}), Contains("degree of at least 1"));
  CHECK_THAT(refuse(2, {0, 0, 1, 1}), Contains("6") && Contains("found 4"));
  CHECK_THAT(refuse(2, {0, 0, 0.5, 1, 1, 1}), Contains("open"));
  CHECK_THAT(refuse(2, {0, 0, 0, 0, 0, 0}), Contains("open"));
  // One more than p+1 at an end would make a function that is zero.
  CHECK_THAT(refuse(2, {0, 0, 0, 0, 1, 1, 1}), Contains("degree + 1"));
  CHECK_THAT(refuse(2, {0, 0, 0, 1, 1, 1, 1}), Contains("degree + 1"));
  CHECK_THAT(refuse(2, {0, 0, 0, .5, .5, .5, 1, 1, 1}),
             Contains("0.5") && Contains("more than degree = 2"));
  CHECK(refuse(2, {0, 0, 0, .5, .5, 1, 1, 1}) == "(accepted)");

  const KnotVector k       = KnotVector::uniform(2, 2);
  KnotVector       refined = k;
  for (const double u : {0., 1., 1.5, -0.1, double(NAN)})
    CHECK_THAT(input_error([&]() { k.insertion_operator({u}, refined); }),
               Contains("strictly inside"));
  CHECK_THAT(input_error([&]() {
               k.insertion_operator({.5, .5}, refined);
             }),
             Contains("more than degree = 2"));
}
