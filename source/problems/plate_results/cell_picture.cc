// SPDX-License-Identifier: LGPL-2.1-or-later
// The faces of bundles on grids of points, and the script that draws them.

#include <npt_dealii/homogenization/fabric_image.h>
#include <npt_dealii/io/gnuplot.h>
#include <npt_dealii/io/replace_file.h>
#include <npt_dealii/problems/plate_results/cell_picture.h>

#include <deal.II/base/polynomials_bernstein.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <ostream>

namespace NPT
{
  using dealii::Point;

  namespace
  {
    // Quadrilaterals of a crossing in each direction of a wide face, if the
    // mesh has not more cells.
    const unsigned int n_per_crossing = 9;

    // A point of the base cell: position, place of reference, value.
    using FacePoint = std::array<double, 7>;

    struct FaceGrid
    {
      unsigned int           n_columns;
      std::vector<FacePoint> points;
    };

    // The part of a patch that lies in a box of knot spans.
    using SpanBox = std::array<std::array<unsigned int, 2>, 3>;

    class FaceSampler
    {
    public:
      FaceSampler(const IGASpace<3>                      &space,
                  const std::vector<std::vector<double>> &coefficients)
        : space_(space)
        , coefficients_(coefficients)
      {
        for (unsigned int c = 0; c < space.cells().size(); ++c)
          cell_number_[{space.cells()[c].patch, space.cells()[c].span}] = c;
      }

      /**
       * Points on one face of a box of spans.
       *
       * @param direction, side The face: parametric direction that is fixed,
       *   0 begin or 1 end of the box.
       * @param parts Into how many parts a span is divided, by direction.
       */
      FaceGrid
      sample(const unsigned int                 patch,
             const SpanBox                     &box,
             const unsigned int                 direction,
             const unsigned int                 side,
             const std::array<unsigned int, 3> &parts) const
      {
        const unsigned int row    = direction == 0 ? 1 : 0,
                           column = 3 - direction - row;
        const unsigned int p      = space_.degree(patch);
        const unsigned int n_rows =
          parts[row] * (box[row][1] - box[row][0]) + 1;
        const unsigned int n_columns =
          parts[column] * (box[column][1] - box[column][0]) + 1;
        FaceGrid grid{n_columns,
                      std::vector<FacePoint>(n_rows * n_columns, FacePoint{})};

        std::array<unsigned int, 3> span;
        span[direction] = side == 0 ? box[direction][0] : box[direction][1] - 1;
        std::array<double, 3> xi;
        xi[direction] = side;
        for (span[row] = box[row][0]; span[row] < box[row][1]; ++span[row])
          for (span[column] = box[column][0]; span[column] < box[column][1];
               ++span[column])
            {
              std::vector<double> weights;
              const auto          bezier = bezier_of(patch, span, weights);
              for (unsigned int r = 0; r <= parts[row]; ++r)
                for (unsigned int s = 0; s <= parts[column]; ++s)
                  {
                    xi[row]    = static_cast<double>(r) / parts[row];
                    xi[column] = static_cast<double>(s) / parts[column];
                    const unsigned int i =
                      (span[row] - box[row][0]) * parts[row] + r;
                    const unsigned int j =
                      (span[column] - box[column][0]) * parts[column] + s;
                    grid.points[i * n_columns + j] =
                      evaluate(p, bezier, weights, xi);
                  }
            }
        return grid;
      }

    private:
      std::vector<std::vector<double>>
      bezier_of(const unsigned int                 patch,
                const std::array<unsigned int, 3> &span,
                std::vector<double>               &weights) const
      {
        const unsigned int               c = cell_number_.at({patch, span});
        std::vector<std::vector<double>> coefficients;
        for (const unsigned int A : space_.control_points_of_cell(c))
          coefficients.push_back(coefficients_[A]);
        return space_.bezier_coefficients(c, coefficients, weights);
      }

      static FacePoint
      evaluate(const unsigned int                      p,
               const std::vector<std::vector<double>> &bezier,
               const std::vector<double>              &weights,
               const std::array<double, 3>            &xi)
      {
        std::array<std::vector<double>, 3> B;
        for (unsigned int d = 0; d < 3; ++d)
          for (unsigned int a = 0; a <= p; ++a)
            B[d].push_back(
              dealii::PolynomialsBernstein<double>(a, p).value(xi[d]));
        FacePoint    sum{};
        double       total = 0;
        unsigned int b     = 0; // the first direction runs fastest
        for (unsigned int k = 0; k <= p; ++k)
          for (unsigned int j = 0; j <= p; ++j)
            for (unsigned int i = 0; i <= p; ++i, ++b)
              {
                const double R = B[0][i] * B[1][j] * B[2][k] * weights[b];
                total += R;
                for (unsigned int m = 0; m < sum.size(); ++m)
                  sum[m] += R * bezier[b][m];
              }
        for (double &value : sum)
          value /= total;
        return sum;
      }

      const IGASpace<3>                      &space_;
      const std::vector<std::vector<double>> &coefficients_;
      std::map<std::pair<unsigned int, std::array<unsigned int, 3>>,
               unsigned int>
        cell_number_;
    };



    FaceGrid
    first_and_last_column(const FaceGrid &grid)
    {
      FaceGrid result{2, {}};
      for (unsigned int i = 0; i < grid.points.size(); i += grid.n_columns)
        {
          result.points.push_back(grid.points[i]);
          result.points.push_back(grid.points[i + grid.n_columns - 1]);
        }
      return result;
    }



    // The image of a point of the base cell.
    std::array<double, 4>
    image(const FacePoint         &point,
          const SymmetryOperation &g,
          const PictureState      &state)
    {
      const Point<3> x = image_in_fabric(g,
                                         Point<3>(point[0], point[1], point[2]),
                                         Point<3>(point[3], point[4], point[5]),
                                         state.H,
                                         state.bends_along);
      return {{x[0], x[1], x[2], point.back()}};
    }
  } // namespace



  std::vector<PictureSurface>
  make_picture_surfaces(const FabricCell   &cell,
                        const IGASpace<3>  &space,
                        const PictureState &state)
  {
    std::vector<std::vector<double>> coefficients;
    for (unsigned int A = 0; A < space.n_control_points(); ++A)
      {
        const Point<3> &x = state.positions[A];
        const Point<3> &Z =
          state.woven.empty() ? space.control_points()[A] : state.woven[A];
        coefficients.push_back(
          {x[0], x[1], x[2], Z[0], Z[1], Z[2], state.values[A]});
      }
    const FaceSampler sampler(space, coefficients);

    const bool laminate = cell.parameters().type == "laminate";
    // Images of the same crossing share their points.
    std::map<std::array<unsigned int, 4>, FaceGrid> grids;
    std::vector<PictureSurface>                     surfaces;
    for (const CrossingPiece &piece : cell.repeat())
      {
        const unsigned int n_crossings = cell.n_crossings(piece.bundle);
        SpanBox            box;
        for (unsigned int d = 0; d < 3; ++d)
          box[d] = {{0u, space.patch(piece.bundle).knot_vector(d).n_spans()}};
        const unsigned int n_along = box[0][1] / n_crossings;
        box[0] = {{piece.crossing * n_along, (piece.crossing + 1) * n_along}};
        const auto parts = [](const unsigned int n_spans) {
          return (n_per_crossing + n_spans - 1) / n_spans;
        };
        for (unsigned int direction = 0; direction < 3; ++direction)
          for (unsigned int side = 0; side < 2; ++side)
            {
              if (direction == 0 && !(side == 0 ? piece.first : piece.last))
                continue;
              const std::array<unsigned int, 4> key = {
                {piece.bundle, piece.crossing, direction, side}};
              auto found = grids.find(key);
              if (found == grids.end())
                {
                  FaceGrid grid =
                    sampler.sample(piece.bundle,
                                   box,
                                   direction,
                                   side,
                                   {{parts(n_along), parts(box[1][1]), 1u}});
                  // Narrow edges in one quadrilateral: the lower of several
                  // would be sorted behind the bundle below.
                  if (direction == 1 && !laminate)
                    grid = first_and_last_column(grid);
                  found = grids.emplace(key, grid).first;
                }
              PictureSurface surface;
              surface.n_columns = found->second.n_columns;
              for (const FacePoint &point : found->second.points)
                surface.points.push_back(image(point, piece.operation, state));
              // A glide plane turns bottom and top over. The direction across
              // is +y for the warp and -x for the weft.
              if (direction == 2 && (side == 0) == (piece.operation.Q[2] > 0.))
                surface.facing = PictureSurface::Facing::down;
              else if (direction == 1 && side == 0 && !laminate)
                surface.facing = PictureSurface::Facing::front;
              surfaces.push_back(surface);
            }
      }
    return surfaces;
  }



  namespace
  {
    using Facing = PictureSurface::Facing;

    // Write the grids, those of one facing after those of another; returns how
    // many there are of each.
    std::map<Facing, unsigned int>
    write_surfaces(std::ostream                      &out,
                   const std::string                 &quantity,
                   const std::vector<PictureSurface> &surfaces)
    {
      std::map<Facing, unsigned int> number;
      // A blank line ends a row of a grid, two end the grid.
      out << "# x [mm], y [mm], z [mm], " << quantity << '\n';
      char line[128];
      for (const Facing facing : {Facing::up, Facing::front, Facing::down})
        for (const PictureSurface &surface : surfaces)
          {
            if (surface.facing != facing)
              continue;
            ++number[facing];
            for (unsigned int i = 0; i < surface.points.size(); ++i)
              {
                const auto &point = surface.points[i];
                std::snprintf(line,
                              sizeof(line),
                              "%.4f %.4f %.4f %.4g\n",
                              point[0],
                              point[1],
                              point[2],
                              point[3]);
                out << line;
                if ((i + 1) % surface.n_columns == 0)
                  out << '\n';
              }
            out << '\n';
          }
      return number;
    }



    // Half a quadrilateral of a wide face.
    double
    half_quadrilateral(const std::vector<PictureSurface> &surfaces)
    {
      for (const PictureSurface &surface : surfaces)
        if (surface.facing == Facing::down)
          {
            const auto &a = surface.points[0],
                       &b = surface.points[surface.n_columns];
            return 0.5 * std::hypot(a[0] - b[0], a[1] - b[1]);
          }
      return 0.;
    }



    // The view, the colors and the axes.
    std::string
    picture_settings(const double nearer, const std::string &quantity)
    {
      return "set datafile separator whitespace\n"
             "unset datafile columnheaders\n"
             "# Angles [degrees]: from the view from above, about z.\n"
             "tilt = 50; turn = 30\n"
             "set view tilt, turn, 1.75\n"
             "# By how much edges are sorted nearer [mm], along the line of "
             "sight.\n"
             "nearer = " +
             std::to_string(nearer) +
             "\n"
             "dx = nearer * sin(tilt * pi / 180) * sin(turn * pi / 180)\n"
             "dy = -nearer * sin(tilt * pi / 180) * cos(turn * pi / 180)\n"
             "dz = nearer * cos(tilt * pi / 180)\n"
             "set view equal xyz\n"
             "set pm3d depthorder\n"
             "set pm3d lighting primary 0.3 specular 0.05\n"
             "set palette defined (0 '#fff7cf', 1 '#fdd480', 2 '#f8964a', 3 "
             "'#dd4b3a', 4 '#97155b', 5 '#3b0f52')\n"
             "set cbrange [0:*]\n"
             "unset border; unset tics; unset grid; unset key\n"
             "set cbtics\n"
             "set colorbox user origin 0.88, 0.2 size 0.022, 0.6\n"
             "set cblabel " +
             gnuplot_text(quantity) +
             "\n"
             "set arrow 1 from graph -0.12, -0.12, 0 to graph 0.1, -0.12, 0\n"
             "set arrow 2 from graph -0.12, -0.12, 0 to graph -0.12, 0.1, 0\n"
             "set label 1 'x_1' at graph 0.14, -0.12, 0 center\n"
             "set label 2 'x_2' at graph -0.12, 0.14, 0 center\n";
    }
  } // namespace



  void
  write_cell_picture(const std::string                 &folder,
                     const std::string                 &name,
                     const std::string                 &title,
                     const std::string                 &quantity,
                     const std::vector<PictureSurface> &surfaces)
  {
    std::map<Facing, unsigned int> number;
    replace_file(folder + "/" + name + ".dat", [&](std::ostream &out) {
      number = write_surfaces(out, quantity, surfaces);
    });

    GnuplotPicture picture;
    picture.name     = name;
    picture.width    = 760;
    picture.height   = 480;
    picture.title    = title;
    picture.settings = picture_settings(half_quadrilateral(surfaces), quantity);
    write_gnuplot_script(
      folder + "/" + name + ".gp", picture, [&](std::ostream &out) {
        const std::string  file    = gnuplot_text(name + ".dat");
        const unsigned int n_up    = number[Facing::up];
        const unsigned int n_front = number[Facing::front];
        out
          << "\n  # The faces behind these face down; plot the whole table to "
             "look from below.\n  splot "
          << file << " index 0:" << n_up - 1 << " using 1:2:3:4 with pm3d";
        if (n_front > 0)
          out << ", \\\n    " << file << " index " << n_up << ':'
              << n_up + n_front - 1
              << " using ($1+dx):($2+dy):($3+dz):4 with pm3d";
      });
  }
} // namespace NPT
