// SPDX-License-Identifier: LGPL-2.1-or-later
// Bundles of one repeat from end to end.

#include <npt_dealii/homogenization/fabric_image.h>
#include <npt_dealii/problems/plate_exports/fabric_strand.h>

#include <deal.II/base/polynomial.h>
#include <deal.II/base/polynomials_bernstein.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace NPT
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    // Position, place of reference and reference position.
    constexpr unsigned int n_coordinates = 9;

    Tensor<1, 3>
    three_of(const std::array<double, n_coordinates> &all,
             const unsigned int                       first)
    {
      return Tensor<1, 3>({all[first], all[first + 1], all[first + 2]});
    }



    // A rational Bezier solid and its derivatives.
    struct BezierSample
    {
      std::array<double, n_coordinates>                value{};
      std::array<std::array<double, n_coordinates>, 3> slope{};
    };

    BezierSample
    evaluate_bezier(const unsigned int                      p,
                    const std::vector<std::vector<double>> &points,
                    const std::vector<double>              &weights,
                    const std::array<double, 3>            &xi)
    {
      std::array<std::vector<std::array<double, 2>>, 3> B;
      std::vector<double>                               values(2);
      for (unsigned int d = 0; d < 3; ++d)
        for (unsigned int a = 0; a <= p; ++a)
          {
            dealii::PolynomialsBernstein<double>(a, p).value(xi[d], values);
            B[d].push_back({{values[0], values[1]}});
          }
      // Sums of w B c and their derivatives; row 3 the values.
      std::array<std::array<double, n_coordinates>, 4> sums{};
      std::array<double, 4>                            W{};
      unsigned int b = 0; // the first direction runs fastest
      for (unsigned int k = 0; k <= p; ++k)
        for (unsigned int j = 0; j <= p; ++j)
          for (unsigned int i = 0; i <= p; ++i, ++b)
            {
              const std::array<unsigned int, 3> a = {{i, j, k}};
              for (unsigned int r = 0; r < 4; ++r)
                {
                  double factor = weights[b];
                  for (unsigned int d = 0; d < 3; ++d)
                    factor *= B[d][a[d]][d == r ? 1 : 0];
                  W[r] += factor;
                  for (unsigned int m = 0; m < n_coordinates; ++m)
                    sums[r][m] += factor * points[b][m];
                }
            }
      BezierSample result;
      for (unsigned int m = 0; m < n_coordinates; ++m)
        {
          result.value[m] = sums[3][m] / W[3];
          for (unsigned int d = 0; d < 3; ++d)
            result.slope[d][m] = (sums[d][m] - W[d] * result.value[m]) / W[3];
        }
      return result;
    }



    std::vector<std::vector<double>>
    coordinates_of(const DeformedCell &deformed)
    {
      std::vector<std::vector<double>> result;
      for (unsigned int A = 0; A < deformed.space.n_control_points(); ++A)
        {
          const Point<3> &x = deformed.positions[A];
          const Point<3> &X = deformed.space.control_points()[A];
          const Point<3> &Z = deformed.woven.empty() ? X : deformed.woven[A];
          result.push_back(
            {x[0], x[1], x[2], Z[0], Z[1], Z[2], X[0], X[1], X[2]});
        }
      return result;
    }



    // The middle of a crossing of a bundle in the reference fabric.
    Point<3>
    middle_of_piece(const DeformedCell &deformed, const CrossingPiece &piece)
    {
      const NURBSPatch<3> &patch = deformed.space.patch(piece.bundle);
      const double         n     = deformed.cell.n_crossings(piece.bundle);
      const auto          &along = patch.knot_vector(0).breaks();
      const double         xi    = (piece.crossing + 0.5) / n;
      return piece.operation(patch.value(
        Point<3>((1. - xi) * along.front() + xi * along.back(), 0.5, 0.5)));
    }
  } // namespace



  std::vector<FabricStrand>
  FabricStrand::of_repeat(const DeformedCell &deformed)
  {
    // Pieces of a layer with the same axis, to a millionth of the size of the
    // cell, are one strand; plies are strands of their own.
    const double size = std::sqrt(deformed.cell.area());
    std::map<std::tuple<FiberBundle::Family, unsigned int, long>,
             std::vector<Piece>>
      strands;
    for (const CrossingPiece &piece : deformed.cell.repeat())
      {
        const FiberBundle &bundle = deformed.cell.bundles()[piece.bundle];
        const Point<3>     middle = middle_of_piece(deformed, piece);
        const bool         is_ply = bundle.family == FiberBundle::Family::ply;
        const unsigned int along =
          bundle.family == FiberBundle::Family::weft ? 1 : 0;
        strands[{bundle.family,
                 is_ply ? piece.bundle : bundle.layer,
                 std::lround(1e6 * middle[1 - along] / size)}]
          .push_back({middle[along], piece});
      }

    static const std::map<FiberBundle::Family, std::string> names = {
      {FiberBundle::Family::warp, "warp_"},
      {FiberBundle::Family::weft, "weft_"},
      {FiberBundle::Family::ply, "ply_"}};
    std::map<FiberBundle::Family, unsigned int> number;
    std::vector<FabricStrand>                   result;
    for (auto &[key, pieces] : strands)
      {
        std::sort(pieces.begin(),
                  pieces.end(),
                  [](const Piece &a, const Piece &b) {
                    return a.along < b.along;
                  });
        const FiberBundle::Family family = std::get<0>(key);
        result.push_back(
          FabricStrand(deformed,
                       family,
                       names.at(family) + std::to_string(++number[family]),
                       pieces));
      }
    return result;
  }



  FabricStrand::FabricStrand(const DeformedCell       &deformed,
                             const FiberBundle::Family family,
                             const std::string        &name,
                             const std::vector<Piece> &pieces)
    : deformed_(&deformed)
    , family_(family)
    , name_(name)
    , pieces_(pieces)
  {
    const IGASpace<3> &space       = deformed.space;
    const auto         coordinates = coordinates_of(deformed);
    std::map<std::pair<unsigned int, std::array<unsigned int, 3>>, unsigned int>
      number;
    for (unsigned int c = 0; c < space.cells().size(); ++c)
      number[{space.cells()[c].patch, space.cells()[c].span}] = c;
    for (unsigned int d = 0; d < 3; ++d)
      n_spans_[d] = space.patch(bundle()).knot_vector(d).n_spans();
    n_along_ = n_spans_[0] / deformed.cell.n_crossings(bundle());

    std::vector<std::vector<double>> of_cell;
    for (const Piece &piece : pieces_)
      {
        cells_.emplace_back();
        for (unsigned int k = 0; k < n_spans_[2]; ++k)
          for (unsigned int j = 0; j < n_spans_[1]; ++j)
            for (unsigned int i = 0; i < n_along_; ++i)
              {
                const unsigned int c =
                  number.at({piece.piece.bundle,
                             {{piece.piece.crossing * n_along_ + i, j, k}}});
                of_cell.clear();
                for (const unsigned int A : space.control_points_of_cell(c))
                  of_cell.push_back(coordinates[A]);
                BezierCell bezier;
                bezier.points =
                  space.bezier_coefficients(c, of_cell, bezier.weights);
                cells_.back().push_back(bezier);
              }
      }
  }



  FabricStrand::Sample
  FabricStrand::at(const Place &place) const
  {
    const unsigned int       number = place.span[0] / n_along_;
    const CrossingPiece     &piece  = pieces_[number].piece;
    const SymmetryOperation &g      = piece.operation;
    const bool               over   = g.turns_over();
    const unsigned int       k =
      over ? n_spans_[2] - 1 - place.span[2] : place.span[2];
    std::array<double, 3> xi = place.xi;
    if (over)
      xi[2] = 1. - xi[2];
    const BezierCell &cell =
      cells_[number][place.span[0] % n_along_ +
                     n_along_ * (place.span[1] + n_spans_[1] * k)];
    const BezierSample here = evaluate_bezier(
      deformed_->space.degree(piece.bundle), cell.points, cell.weights, xi);

    const auto image = [&](const Tensor<1, 3> &x, const Tensor<1, 3> &Z) {
      return image_in_fabric(
        g, Point<3>(x), Point<3>(Z), deformed_->H, deformed_->bends_along);
    };
    const Tensor<1, 3> x = three_of(here.value, 0), Z = three_of(here.value, 3);
    Sample             result;
    result.x = image(x, Z);
    Tensor<2, 3> reference; // dX / d xi
    for (unsigned int d = 0; d < 3; ++d)
      {
        // Exact by central differences, because images are quadratic.
        const Tensor<1, 3> dx = three_of(here.slope[d], 0),
                           dZ = three_of(here.slope[d], 3),
                           dX = three_of(here.slope[d], 6);
        result.tangent[d] =
          0.5 * (image(x + dx, Z + dZ) - image(x - dx, Z - dZ));
        for (unsigned int c = 0; c < 3; ++c)
          reference[c][d] = dX[c];
      }
    const Tensor<1, 3> along =
      invert(reference) * deformed_->cell.bundles()[piece.bundle].direction;
    for (unsigned int d = 0; d < 3; ++d)
      result.fiber += along[d] * result.tangent[d];
    result.fiber /= result.fiber.norm();
    if (over)
      result.tangent[2] *= -1.;
    return result;
  }
} // namespace NPT
