// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about the smooth closure of bundles over the periodic faces.

#include <npt_dealii/problems/plate_test/numerical_plate_testing.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <random>
#include <sstream>

#include "plate_run.h"

namespace
{
  using namespace NPT;
  using dealii::Point;
  using dealii::Tensor;
  using dealii::Vector;
  using PlateTestTools::PlateRun;

  // Positions of the control points of a bundle, seen through an operation.
  std::vector<Point<3>>
  image(const PlateRun          &test,
        const unsigned int       bundle,
        const SymmetryOperation &g)
  {
    const FabricCell     &cell  = test.cell.fabric();
    const IGASpace<3>    &space = test.cell.bodies().space();
    const Vector<double> &u     = test.state.u;
    std::vector<Point<3>> points;
    for (unsigned int l = 0; l < space.patch(bundle).n_control_points(); ++l)
      {
        const unsigned int A = space.control_point(bundle, l);
        const Point<3>     X = space.control_points()[A];
        const Point<3>     Y = test.woven.empty() ? X : test.woven[A];
        Point<3>           x = g(X);
        for (unsigned int i = 0; i < 3; ++i)
          {
            x[i] += g.Q[i] * u[3 * A + i];
            for (unsigned int n = 0; n < MacroUnknowns::n_modes; ++n)
              if (represents_mode(cell, n))
                x[i] += u[test.cell.macro().mode(n)] *
                        (macroscopic_displacement(n, g(Y))[i] -
                         g.Q[i] * macroscopic_displacement(n, Y)[i]);
          }
        points.push_back(x);
      }
    return points;
  }

  // Derivative of the position along a bundle at (xi, eta, zeta), evaluated
  // on a span that ends or begins at xi. Weights do not change along.
  Tensor<1, 3>
  tangent(const NURBSPatch<3>         &patch,
          const std::vector<Point<3>> &x,
          const unsigned int           span,
          const Point<3>              &xi)
  {
    std::array<std::vector<std::vector<double>>, 3> N;
    std::array<unsigned int, 3>                     first;
    for (unsigned int d = 0; d < 3; ++d)
      {
        const KnotVector  &knots = patch.knot_vector(d);
        const unsigned int e     = d == 0 ? span : knots.find_span(xi[d]);
        N[d]                     = knots.values(e, xi[d], 1);
        first[d]                 = knots.first_function(e);
      }
    Tensor<1, 3> sum;
    double       W = 0;
    for (unsigned int k = 0; k < N[2][0].size(); ++k)
      for (unsigned int j = 0; j < N[1][0].size(); ++j)
        for (unsigned int i = 0; i < N[0][0].size(); ++i)
          {
            const unsigned int l =
              patch.index({{first[0] + i, first[1] + j, first[2] + k}});
            const double N_23 = N[1][0][j] * N[2][0][k] * patch.weights()[l];
            W += N[0][0][i] * N_23;
            sum += N[0][1][i] * N_23 * x[l];
          }
    return sum / W;
  }

  // The largest jump of the tangent over a seam, at periodic faces and between
  // crossings, relative to its length (the angle of a kink [rad], if it is
  // small), and how many seams there are.
  std::pair<double, unsigned int>
  largest_kink(const PlateRun &test)
  {
    const FabricCell       &cell  = test.cell.fabric();
    const IGASpace<3>      &space = test.cell.bodies().space();
    const SymmetryOperation identity{"",
                                     Tensor<1, 3>({1., 1., 1.}),
                                     Tensor<1, 3>()};
    double                  largest = 0;
    unsigned int            n_seams = 0;
    const auto compare = [&](const Tensor<1, 3> &a, const Tensor<1, 3> &b) {
      // Relative lengths too: the parametrization is C1, not only the shape.
      largest = std::max(largest, (a - b).norm() / a.norm());
    };
    for (unsigned int b = 0; b < space.n_patches(); ++b)
      {
        const NURBSPatch<3> &patch = space.patch(b);
        const KnotVector    &along = patch.knot_vector(0);
        const auto           x     = image(test, b, identity);
        for (unsigned int k = 1; k < along.n_spans(); ++k)
          if (along.multiplicity(along.breaks()[k]) >= along.degree())
            {
              ++n_seams;
              for (const double eta : {0., 0.3, 0.5, 0.9, 1.})
                for (const double zeta : {0., 0.5, 0.8, 1.})
                  {
                    const Point<3> xi(along.breaks()[k], eta, zeta);
                    compare(tangent(patch, x, k - 1, xi),
                            tangent(patch, x, k, xi));
                  }
            }
        for (unsigned int c = 0; c < space.n_patches(); ++c)
          for (const SymmetryOperation &g : cell.operations())
            {
              if (cell.bundles()[b].family != cell.bundles()[c].family ||
                  g.Q[0] < 0 || g.Q[1] < 0)
                continue;
              // End of b's image at the begin of c?
              const NURBSPatch<3> &next = space.patch(c);
              if (g(patch.value(Point<3>(1., 0.5, 0.5)))
                    .distance(next.value(Point<3>(0., 0.5, 0.5))) > 1e-9)
                continue;
              ++n_seams;
              const auto x_b = image(test, b, g),
                         x_c = image(test, c, identity);
              for (const double eta : {0., 0.3, 0.5, 0.9, 1.})
                for (const double zeta : {0., 0.5, 0.8, 1.})
                  compare(
                    tangent(
                      patch, x_b, along.n_spans() - 1, Point<3>(1., eta, zeta)),
                    tangent(next,
                            x_c,
                            0,
                            Point<3>(0., eta, g.Q[2] > 0 ? zeta : 1. - zeta)));
            }
      }
    return {largest, n_seams};
  }

  std::vector<std::string>
  small(const std::vector<std::string> &more)
  {
    std::vector<std::string> overrides = {
      "Mesh/Elements along=4",
      "Mesh/Elements across=3",
      "Mesh/Elements through=1",
      "Load programme/Stage weave/Initial step=0.25",
      "Load programme/Stage weave/Maximum step=0.25"};
    overrides.insert(overrides.end(), more.begin(), more.end());
    return overrides;
  }

  std::string
  load(const std::string &targets)
  {
    return "Load programme/Stage shear/Targets=" + targets;
  }
} // namespace



TEST_CASE("A homogeneous deformation obeys the couplings of a smooth closure, "
          "which leave three unknowns less per seam",
          "[top]")
{
  for (const std::string cell : {"plain, sub-unit cell",
                                 "plain, two-crossing cell",
                                 "plain, unit cell",
                                 "2/2 twill, sub-unit cell",
                                 "2/2 twill, primitive cell",
                                 "5-harness satin, primitive cell"})
    for (const std::string axis : {"true", "false"})
      for (const std::string elements : {"1", "4"})
        {
          INFO(cell << ", axis " << axis << ", elements " << elements);
          const auto                comma = cell.find(',');
          const std::vector<double> H     = {0.07, -0.04, 0.15};
          unsigned int              n_free[2];
          for (const bool smooth : {false, true})
            {
              PlateRun       test({"Cell/Weave=" + cell.substr(0, comma),
                                   "Cell/Type=" + cell.substr(comma + 2),
                                   "Cell/Two-fold axis=" + axis,
                                   std::string("Cell/Smooth closure=") +
                                     (smooth ? "true" : "false"),
                                   "Mesh/Elements along=" + elements,
                                   "Mesh/Elements across=2",
                                   "Mesh/Elements through=1"});
              const auto     couplings = test.couplings();
              Vector<double> u(test.cell.macro().n_unknowns());
              for (unsigned int n = 0; n < 3; ++n)
                u[test.cell.macro().mode(n)] = H[n];
              const auto &X = test.cell.bodies().space().control_points();
              for (unsigned int A = 0; A < X.size(); ++A)
                for (unsigned int i = 0; i < 3; ++i)
                  for (unsigned int n = 0; n < 3; ++n)
                    u[3 * A + i] += H[n] * macroscopic_displacement(n, X[A])[i];
              for (const PeriodicImage &periodic_image : test.cell.images())
                for (unsigned int l = 0; l < periodic_image.reference.size();
                     ++l)
                  for (unsigned int i = 0; i < 3; ++i)
                    for (unsigned int n = 0; n < 3; ++n)
                      u[periodic_image.first_unknown + 3 * l + i] +=
                        H[n] * macroscopic_displacement(
                                 n, periodic_image.reference[l])[i];
              Vector<double> distributed(u);
              couplings.distribute(distributed);
              distributed -= u;
              CHECK(distributed.linfty_norm() < 1e-13);
              n_free[smooth] =
                test.cell.macro().n_unknowns() - couplings.n_constraints();

              // Any other state is C1, in H4 to H6 as well.
              if (!smooth)
                continue;
              std::mt19937                           generator(3);
              std::uniform_real_distribution<double> entry(-0.1, 0.1);
              for (double &value : u)
                value = entry(generator);
              couplings.distribute(u);
              test.state.u    = u;
              const auto kink = largest_kink(test);
              CHECK(kink.second >= test.cell.fabric().bundles().size());
              CHECK(kink.first < 1e-12);
            }
          if (axis == "false")
            {
              // One seam per crossing of each strand.
              PlateRun     test({"Cell/Weave=" + cell.substr(0, comma),
                                 "Cell/Type=" + cell.substr(comma + 2),
                                 "Cell/Two-fold axis=false",
                                 "Mesh/Elements along=" + elements,
                                 "Mesh/Elements across=2",
                                 "Mesh/Elements through=1"});
              const double n_crossings = test.cell.fabric().area() / 25.;
              const auto  &patch       = test.cell.bodies().space().patch(0);
              CHECK(n_free[0] - n_free[1] == 2 * 3 * n_crossings *
                                               patch.n_control_points(1) *
                                               patch.n_control_points(2));
            }
        }
}



TEST_CASE("Woven and loaded bundles have no kink at a smooth seam", "[top]")
{
  const std::vector<std::string> cases[] = {
    {"Cell/Type=sub-unit cell", load("H3: 0.1")},
    {"Cell/Type=sub-unit cell", load("H3: 0.1"), "Cell/Two-fold axis=false"},
    {"Cell/Type=two-crossing cell", load("H1: 0.02, H4: 0.02")},
    {"Cell/Type=two-crossing cell",
     load("H6: 0.02, H3: 0.05"),
     "Cell/Two-fold axis=false"},
    {"Cell/Weave=2/2 twill",
     "Cell/Type=primitive cell",
     load("H3: 0.05, H5: 0.01")},
    {"Cell/Weave=2/2 twill", "Cell/Type=sub-unit cell", load("H3: 0.05")},
    {"Cell/Type=sub-unit cell",
     load("H3: 0.05"),
     "Mesh/Degree=3",
     "Cell/Crossing spacing=5, 6"}};
  for (auto overrides : cases)
    {
      INFO(overrides[0] << ", " << overrides[1]);
      // The images that are compared are those of linear jumps.
      overrides.push_back("Homogenization/Jumps=linear");
      overrides.push_back("Load programme/Stage shear/Initial step=0.5");
      overrides.push_back("Load programme/Stage shear/Maximum step=0.5");
      // That there is a kink otherwise is shown by the smaller cells.
      const bool is_small = overrides[1] != "Cell/Type=primitive cell";
      for (const bool smooth : {true, false})
        {
          if (!smooth && !is_small)
            continue;
          auto all = overrides;
          all.push_back(std::string("Cell/Smooth closure=") +
                        (smooth ? "true" : "false"));
          PlateRun test(small(all));
          test.run();
          const auto kink = largest_kink(test);
          CHECK(kink.second >= test.cell.fabric().bundles().size());
          if (smooth)
            CHECK(kink.first < 1e-12);
          else
            CHECK(kink.first > 5e-3); // 0.01 to 0.06 rad
        }
    }
}



TEST_CASE("With and without a smooth closure the curve of shear tends to the "
          "same",
          "[top]")
{
  const auto difference = [](const std::string &elements) {
    std::vector<std::vector<CurveRow>> curves;
    for (const std::string smooth : {"false", "true"})
      {
        std::ostringstream    screen;
        NumericalPlateTesting test(
          PlateTestParameters::read(
            make_parameter_text("", "seam.prm"),
            {"Mesh/Elements along=" + elements,
             "Mesh/Elements across=" + elements,
             "Load programme/Stage weave/Initial step=0.25",
             "Load programme/Stage weave/Maximum step=0.25",
             "Load programme/Stage shear/Initial step=0.25",
             "Load programme/Stage shear/Maximum step=0.25",
             "Cell/Smooth closure=" + smooth}),
          "",
          screen);
        test.run();
        curves.push_back(test.curve());
      }
    REQUIRE(curves[0].size() == curves[1].size());
    double largest = 0;
    for (unsigned int k = 0; k < curves[0].size(); ++k)
      largest = std::max(largest,
                         std::abs(curves[1][k].n[2] - curves[0][k].n[2]) /
                           curves[0].back().n[2]);
    return largest;
  };
  const double coarse = difference("3"), fine = difference("7");
  INFO(coarse << ", " << fine);
  CHECK(coarse < 0.1);
  CHECK(fine < 1e-3);
  CHECK(fine < 0.1 * coarse);
}
