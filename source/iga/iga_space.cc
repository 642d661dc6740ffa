// SPDX-License-Identifier: LGPL-2.1-or-later
// The isogeometric space: cells, extraction, and joined numbering.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/iga/bezier_extraction.h>
#include <npt_dealii/iga/iga_space.h>

#include <deal.II/base/polynomials_bernstein.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_bernstein.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_tools.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace NPT
{
  using dealii::FullMatrix;
  using dealii::Point;
  namespace bgi = boost::geometry::index;

  template <>
  const EnumNames<Basis> &
  enum_names<Basis>()
  {
    static const EnumNames<Basis> names = {{Basis::NURBS, "NURBS"},
                                           {Basis::Bernstein, "Bernstein"},
                                           {Basis::Lagrange, "Lagrange"}};
    return names;
  }



  template <int dim>
  IGASpace<dim>::IGASpace(const std::vector<NURBSPatch<dim>> &patches,
                          const std::vector<unsigned int>    &bodies,
                          const Basis                         basis)
    : basis_(basis)
    , patches_(patches)
    , bodies_(bodies)
  {
    AssertThrow(!patches.empty(), dealii::ExcMessage("At least one patch."));
    if (bodies_.empty())
      for (unsigned int i = 0; i < patches.size(); ++i)
        bodies_.push_back(i);
    AssertDimension(bodies_.size(), patches.size());

    for (unsigned int i = 0; i < patches_.size(); ++i)
      {
        patches_[i].make_isotropic();
        if (basis != Basis::NURBS)
          patches_[i].reduce_to_c0();
        const unsigned int p = degree(i);

        if (basis == Basis::Lagrange)
          elements_.push_back(std::make_unique<dealii::FE_Q<dim>>(p));
        else
          elements_.push_back(std::make_unique<dealii::FE_Bernstein<dim>>(p));
        lexicographic_.push_back(
          dealii::FETools::lexicographic_to_hierarchic_numbering<dim>(p));

        if (basis == Basis::Lagrange)
          {
            const auto nodes = dealii::QGaussLobatto<1>(p + 1).get_points();
            polynomials_.push_back(
              dealii::Polynomials::generate_complete_Lagrange_basis(nodes));
            // Nodes on the geometry instead of control points beside it.
            NURBSPatch<dim>        &patch = patches_[i];
            std::vector<Point<dim>> positions;
            for (unsigned int A = 0; A < patch.n_control_points(); ++A)
              {
                const auto index = patch.multi_index(A);
                Point<dim> u;
                for (unsigned int d = 0; d < dim; ++d)
                  {
                    const auto        &breaks = patch.knot_vector(d).breaks();
                    const unsigned int e =
                      std::min(index[d] / p,
                               patch.knot_vector(d).n_spans() - 1);
                    u[d] = breaks[e] + (breaks[e + 1] - breaks[e]) *
                                         nodes[index[d] - e * p][0];
                  }
                positions.push_back(patch.value(u));
              }
            patch = NURBSPatch<dim>(patch.knot_vectors(), positions);
          }
        else
          {
            std::vector<dealii::Polynomials::Polynomial<double>> bernstein;
            for (unsigned int b = 0; b <= p; ++b)
              bernstein.push_back(dealii::PolynomialsBernstein<double>(b, p));
            polynomials_.push_back(bernstein);
          }

        std::array<std::vector<FullMatrix<double>>, dim> operators;
        std::array<unsigned int, dim>                    n_spans;
        unsigned int                                     n_cells = 1;
        for (unsigned int d = 0; d < dim; ++d)
          {
            operators[d] =
              bezier_extraction_operators(patches_[i].knot_vector(d));
            n_spans[d] = patches_[i].knot_vector(d).n_spans();
            n_cells *= n_spans[d];
          }
        extraction_.push_back(operators);

        for (unsigned int c = 0; c < n_cells; ++c)
          {
            Cell         cell;
            unsigned int rest = c;
            cell.patch        = i;
            for (unsigned int d = 0; d < dim; ++d)
              {
                cell.span[d] = rest % n_spans[d];
                rest /= n_spans[d];
              }
            cells_.push_back(cell);
          }
      }
    merge_control_points();
    check_interfaces();
    make_triangulation();
  }



  template <int dim>
  void
  IGASpace<dim>::merge_control_points()
  {
    using BPoint =
      boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;
    using Box = boost::geometry::model::box<BPoint>;

    double size = 0;
    for (const auto &patch : patches_)
      for (const Point<dim> &P : patch.control_points())
        size = std::max(size, P.distance(patches_[0].control_points()[0]));
    const double tolerance = 1e-9 * size;

    // One tree per body; only control points on patch boundaries can join.
    std::vector<bgi::rtree<std::pair<BPoint, unsigned int>, bgi::rstar<16>>>
      trees(*std::max_element(bodies_.begin(), bodies_.end()) + 1);
    std::vector<unsigned int> patches_of_body(trees.size(), 0);
    for (const unsigned int b : bodies_)
      ++patches_of_body[b];

    for (unsigned int i = 0; i < patches_.size(); ++i)
      {
        auto                                        &tree = trees[bodies_[i]];
        std::vector<unsigned int>                    numbers;
        std::vector<std::pair<BPoint, unsigned int>> added;
        for (unsigned int A = 0; A < patches_[i].n_control_points(); ++A)
          {
            const Point<dim> &P           = patches_[i].control_points()[A];
            const auto        index       = patches_[i].multi_index(A);
            bool              on_boundary = false;
            for (unsigned int d = 0; d < dim; ++d)
              on_boundary = on_boundary || index[d] == 0 ||
                            index[d] + 1 == patches_[i].n_control_points(d);

            int known = -1;
            if (patches_of_body[bodies_[i]] > 1 && on_boundary)
              {
                const double z = dim == 3 ? P[dim - 1] : 0.;
                const BPoint low(P[0] - tolerance,
                                 P[1] - tolerance,
                                 z - tolerance);
                const BPoint high(P[0] + tolerance,
                                  P[1] + tolerance,
                                  z + tolerance);
                std::vector<std::pair<BPoint, unsigned int>> found;
                tree.query(bgi::intersects(Box(low, high)),
                           std::back_inserter(found));
                if (!found.empty())
                  known = found[0].second;
                else
                  added.emplace_back(BPoint(P[0], P[1], z),
                                     control_points_.size());
              }
            if (known >= 0)
              {
                if (!(std::abs(weights_[known] - patches_[i].weights()[A]) <
                      1e-9 * weights_[known]))
                  throw InputError(
                    "Joined patches must have equal weights where they meet; "
                    "patch " +
                    std::to_string(i) + " has " +
                    std::to_string(patches_[i].weights()[A]) +
                    " where the weight is " + std::to_string(weights_[known]) +
                    ".");
                numbers.push_back(known);
              }
            else
              {
                numbers.push_back(control_points_.size());
                control_points_.push_back(P);
                weights_.push_back(patches_[i].weights()[A]);
              }
          }
        // Inserted only now: points of one patch are never joined with each
        // other (a closed ring within one patch keeps its seam).
        tree.insert(added.begin(), added.end());
        local_to_global_.push_back(numbers);
      }
  }



  template <int dim>
  void
  IGASpace<dim>::check_interfaces() const
  {
    // Faces of one body with common corners and a common middle are the same
    // piece of surface, so they must have the same control points: otherwise
    // the patches would be sewn together at the corners only.
    struct Face
    {
      unsigned int              patch;
      Point<dim>                middle;
      std::vector<unsigned int> control_points;
    };
    std::map<std::vector<unsigned int>, std::vector<Face>> faces;
    for (unsigned int i = 0; i < patches_.size(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int side = 0; side < 2; ++side)
          {
            const NURBSPatch<dim>    &patch = patches_[i];
            Face                      face;
            std::vector<unsigned int> corners;
            face.patch = i;
            for (unsigned int A = 0; A < patch.n_control_points(); ++A)
              {
                const auto index = patch.multi_index(A);
                if (index[d] != side * (patch.n_control_points(d) - 1))
                  continue;
                face.control_points.push_back(local_to_global_[i][A]);
                bool is_corner = true;
                for (unsigned int e = 0; e < dim; ++e)
                  is_corner =
                    is_corner && (index[e] == 0 ||
                                  index[e] + 1 == patch.n_control_points(e));
                if (is_corner)
                  corners.push_back(local_to_global_[i][A]);
              }
            std::sort(face.control_points.begin(), face.control_points.end());
            std::sort(corners.begin(), corners.end());

            Point<dim> u;
            for (unsigned int e = 0; e < dim; ++e)
              {
                const auto &breaks = patch.knot_vector(e).breaks();
                u[e] = e != d    ? 0.5 * (breaks.front() + breaks.back()) :
                       side == 0 ? breaks.front() :
                                   breaks.back();
              }
            face.middle = patch.value(u);

            auto &known = faces[corners];
            for (const Face &other : known)
              if (other.patch != i &&
                  other.control_points != face.control_points &&
                  other.middle.distance(face.middle) <
                    1e-2 * control_points_[corners.front()].distance(
                             control_points_[corners.back()]))
                throw InputError(
                  "Patches " + std::to_string(other.patch) + " and " +
                  std::to_string(i) + " of one body meet in a face with " +
                  std::to_string(other.control_points.size()) + " and " +
                  std::to_string(face.control_points.size()) +
                  " control points that do not coincide; refine both alike, "
                  "with the same degree, knots and weights on the face.");
            known.push_back(face);
          }
  }



  template <int dim>
  void
  IGASpace<dim>::make_triangulation()
  {
    std::vector<dealii::Triangulation<dim>>         pieces(patches_.size());
    std::vector<const dealii::Triangulation<dim> *> pointers;
    double                                          offset = 0;
    for (unsigned int i = 0; i < patches_.size(); ++i)
      {
        std::vector<std::vector<double>> steps(dim);
        Point<dim>                       low, high;
        for (unsigned int d = 0; d < dim; ++d)
          {
            const auto &breaks = patches_[i].knot_vector(d).breaks();
            for (unsigned int e = 0; e + 1 < breaks.size(); ++e)
              steps[d].push_back(breaks[e + 1] - breaks[e]);
            low[d]  = breaks.front();
            high[d] = breaks.back();
          }
        dealii::GridGenerator::subdivided_hyper_rectangle(pieces[i],
                                                          steps,
                                                          low,
                                                          high);
        // Patches share the parameter interval: set side by side they cannot
        // be merged by accident.
        dealii::Tensor<1, dim> shift;
        shift[0] = offset - low[0];
        dealii::GridTools::shift(shift, pieces[i]);
        offset += 2. * (high[0] - low[0]);
        for (const auto &cell : pieces[i].active_cell_iterators())
          cell->set_material_id(i);
        pointers.push_back(&pieces[i]);
      }
    if (pieces.size() == 1)
      triangulation_.copy_triangulation(pieces[0]);
    else
      dealii::GridGenerator::merge_triangulations(pointers,
                                                  triangulation_,
                                                  1e-12);
    AssertDimension(triangulation_.n_active_cells(), cells_.size());
  }



  template <int dim>
  std::vector<unsigned int>
  IGASpace<dim>::control_points_of_cell(const unsigned int c) const
  {
    const Cell            &cell  = cells_[c];
    const NURBSPatch<dim> &patch = patches_[cell.patch];
    const unsigned int     p     = degree(cell.patch);

    std::vector<unsigned int> result;
    const unsigned int        n_local = std::pow(p + 1, dim) + 0.5;
    result.reserve(n_local);
    for (unsigned int l = 0; l < n_local; ++l)
      {
        std::array<unsigned int, dim> i;
        unsigned int                  rest = l;
        for (unsigned int d = 0; d < dim; ++d)
          {
            i[d] = patch.knot_vector(d).first_function(cell.span[d]) +
                   rest % (p + 1);
            rest /= p + 1;
          }
        result.push_back(local_to_global_[cell.patch][patch.index(i)]);
      }
    return result;
  }



  template <int dim>
  std::vector<std::vector<double>>
  IGASpace<dim>::bezier_coefficients(
    const unsigned int                      c,
    const std::vector<std::vector<double>> &coefficients,
    std::vector<double>                    &bezier_weights) const
  {
    const Cell        &cell    = cells_[c];
    const unsigned int p       = degree(cell.patch);
    const auto         indices = control_points_of_cell(c);
    const unsigned int n       = indices.size();
    AssertDimension(coefficients.size(), n);
    const unsigned int n_components = coefficients[0].size();

    // Bernstein coefficients per direction: N = C B for splines; Lagrange
    // polynomials are interpolated by Bernstein polynomials at p+1 points.
    std::array<FullMatrix<double>, dim> C;
    for (unsigned int d = 0; d < dim; ++d)
      if (basis_ == Basis::Lagrange)
        {
          FullMatrix<double> V(p + 1, p + 1), L(p + 1, p + 1), X(p + 1, p + 1);
          for (unsigned int i = 0; i <= p; ++i)
            for (unsigned int a = 0; a <= p; ++a)
              {
                const double x = static_cast<double>(i) / p;
                V(a, i) = dealii::PolynomialsBernstein<double>(a, p).value(x);
                L(a, i) = polynomials_[cell.patch][a].value(x);
              }
          V.gauss_jordan();
          L.mmult(X, V);
          C[d] = X;
        }
      else
        C[d] = extraction_[cell.patch][d][cell.span[d]];

    std::vector<std::vector<double>> bezier(n,
                                            std::vector<double>(n_components,
                                                                0.));
    bezier_weights.assign(n, 0.);
    for (unsigned int a = 0; a < n; ++a)
      {
        const double w = weights_[indices[a]];
        for (unsigned int b = 0; b < n; ++b)
          {
            double       factor = 1;
            unsigned int ra = a, rb = b;
            for (unsigned int d = 0; d < dim && factor != 0.; ++d)
              {
                factor *= C[d](ra % (p + 1), rb % (p + 1));
                ra /= p + 1;
                rb /= p + 1;
              }
            if (factor == 0.)
              continue;
            bezier_weights[b] += factor * w;
            for (unsigned int k = 0; k < n_components; ++k)
              bezier[b][k] += factor * w * coefficients[a][k];
          }
      }
    for (unsigned int b = 0; b < n; ++b)
      for (double &value : bezier[b])
        value /= bezier_weights[b];
    return bezier;
  }

  template class IGASpace<2>;
  template class IGASpace<3>;
} // namespace NPT
