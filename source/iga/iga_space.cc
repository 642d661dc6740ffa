// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the isogeometric space: cells, extraction, and joined numbering.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/iga/bezier_extraction.h>
#include <npt_dealii/iga/element_table.h>
#include <npt_dealii/iga/iga_space.h>

#include <deal.II/base/utilities.h>
#include <deal.II/fe/fe_bernstein.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/grid/grid_tools.h>

#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <set>

namespace NPT
{
  using dealii::FullMatrix;
  using dealii::Point;
  using dealii::numbers::invalid_unsigned_int;
  namespace bgi = boost::geometry::index;

  namespace
  {
    /**
     * FE_Bernstein on patches that are joined in any orientation. From degree 3
     * on a face has degrees of freedom whose order depends on how the neighbor
     * sees it. FE_Q has the tables for that; FE_Bernstein, which numbers its
     * functions alike, leaves them empty (deal.II 9.4).
     */
    template <int dim>
    class BernsteinElement : public dealii::FE_Bernstein<dim>
    {
    public:
      explicit BernsteinElement(const unsigned int p)
        : dealii::FE_Bernstein<dim>(p)
      {
        this->initialize_quad_dof_index_permutation();
      }

      std::unique_ptr<dealii::FiniteElement<dim>>
      clone() const override
      {
        return std::make_unique<BernsteinElement<dim>>(*this);
      }
    };



    /**
     * Numbers for the points of one patch after the other. Points on patch
     * boundaries that coincide get one number if their patches belong to one
     * body. Points of one patch are never joined with each other, not even by
     * way of a neighbor: a closed ring within one patch keeps its seam, a pole
     * its points. Where several points coincide the first free one is taken.
     */
    template <int dim>
    class PointJoiner
    {
    public:
      PointJoiner(const std::vector<unsigned int> &bodies,
                  const double                     tolerance)
        : bodies_(bodies)
        , tolerance_(tolerance)
        , trees_(*std::max_element(bodies.begin(), bodies.end()) + 1)
        , patches_of_body_(trees_.size(), 0)
      {
        for (const unsigned int b : bodies)
          ++patches_of_body_[b];
      }

      /**
       * @param points A lattice with n points per direction, lexicographic.
       * @return Their numbers; a number as large as points() was before is new.
       */
      std::vector<unsigned int>
      add(const unsigned int                   patch,
          const std::array<unsigned int, dim> &n,
          const std::vector<Point<dim>>       &points)
      {
        const unsigned int        body = bodies_[patch];
        std::vector<unsigned int> numbers;
        std::vector<Entry>        added;
        std::set<unsigned int>    taken;
        for (unsigned int l = 0; l < points.size(); ++l)
          {
            bool         on_boundary = false;
            unsigned int rest        = l;
            for (unsigned int d = 0; d < dim; ++d)
              {
                const unsigned int i = rest % n[d];
                on_boundary          = on_boundary || i == 0 || i + 1 == n[d];
                rest /= n[d];
              }
            const bool   may_join = patches_of_body_[body] > 1 && on_boundary;
            unsigned int known =
              may_join ? find(body, points[l], taken) : invalid_unsigned_int;
            if (known == invalid_unsigned_int)
              {
                known = points_.size();
                points_.push_back(points[l]);
                if (may_join)
                  added.emplace_back(at(points[l], 0.), known);
              }
            else
              taken.insert(known);
            numbers.push_back(known);
          }
        trees_[body].insert(added.begin(), added.end());
        return numbers;
      }

      /// By number; the first of those joined.
      const std::vector<Point<dim>> &
      points() const
      {
        return points_;
      }

    private:
      using BPoint = boost::geometry::model::
        point<double, 3, boost::geometry::cs::cartesian>;
      using Entry = std::pair<BPoint, unsigned int>;

      static BPoint
      at(const Point<dim> &P, const double shift)
      {
        return BPoint(P[0] + shift,
                      P[1] + shift,
                      (dim == 3 ? P[dim - 1] : 0.) + shift);
      }

      unsigned int
      find(const unsigned int            body,
           const Point<dim>             &P,
           const std::set<unsigned int> &taken) const
      {
        const boost::geometry::model::box<BPoint> box(at(P, -tolerance_),
                                                      at(P, tolerance_));
        std::vector<Entry>                        found;
        trees_[body].query(bgi::intersects(box), std::back_inserter(found));
        unsigned int first = invalid_unsigned_int;
        for (const Entry &entry : found)
          if (taken.count(entry.second) == 0)
            first = std::min(first, entry.second);
        return first;
      }

      const std::vector<unsigned int>               &bodies_;
      const double                                   tolerance_;
      std::vector<bgi::rtree<Entry, bgi::rstar<16>>> trees_; // by body
      std::vector<unsigned int>                      patches_of_body_;
      std::vector<Point<dim>>                        points_;
    };
  } // namespace



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
    , tolerance_(0.)
  {
    AssertThrow(!patches.empty(), dealii::ExcMessage("At least one patch."));
    if (bodies_.empty())
      for (unsigned int i = 0; i < patches.size(); ++i)
        bodies_.push_back(i);
    AssertDimension(bodies_.size(), patches.size());

    for (unsigned int i = 0; i < patches_.size(); ++i)
      {
        prepare_patch(i);
        add_cells(i);
      }
    double size = 0;
    for (const auto &patch : patches_)
      for (const Point<dim> &P : patch.control_points())
        size = std::max(size, P.distance(patches_[0].control_points()[0]));
    tolerance_ = 1e-9 * size;

    make_triangulation();
    if (basis == Basis::NURBS)
      number_splines();
    else
      number_elements();
    check_weights();
    check_interfaces();
    check_positions();
  }



  template <int dim>
  void
  IGASpace<dim>::prepare_patch(const unsigned int i)
  {
    patches_[i].make_isotropic();
    if (basis_ != Basis::NURBS)
      patches_[i].reduce_to_c0();

    const unsigned int p = degree(i);
    if (element_of_degree_.emplace(p, elements_.size()).second)
      {
        if (basis_ == Basis::Lagrange)
          elements_.push_back(dealii::FE_Q<dim>(p));
        else
          elements_.push_back(BernsteinElement<dim>(p));
        polynomials_.push_back(polynomials_of(elements_[elements_.size() - 1]));
      }
    if (basis_ == Basis::Lagrange)
      place_nodes(i);
  }



  template <int dim>
  void
  IGASpace<dim>::place_nodes(const unsigned int i)
  {
    // Along the first direction the support points of the element have the
    // coordinates of its one-dimensional nodes.
    const unsigned int p     = degree(i);
    const auto        &nodes = reference_element(i).get_unit_support_points();
    const auto         order = lexicographic_numbering(reference_element(i));

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
              std::min(index[d] / p, patch.knot_vector(d).n_spans() - 1);
            u[d] = breaks[e] + (breaks[e + 1] - breaks[e]) *
                                 nodes[order[index[d] - e * p]][0];
          }
        positions.push_back(patch.value(u));
      }
    patch = NURBSPatch<dim>(patch.knot_vectors(), positions);
  }



  template <int dim>
  void
  IGASpace<dim>::add_cells(const unsigned int i)
  {
    std::array<std::vector<FullMatrix<double>>, dim> operators;
    std::array<unsigned int, dim>                    n_spans;
    unsigned int                                     n_cells = 1;
    for (unsigned int d = 0; d < dim; ++d)
      {
        operators[d] = bezier_extraction_operators(patches_[i].knot_vector(d));
        n_spans[d]   = patches_[i].knot_vector(d).n_spans();
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



  template <int dim>
  void
  IGASpace<dim>::partition(const unsigned int               n,
                           const std::vector<unsigned int> &work)
  {
    AssertDimension(work.size(), triangulation_.n_active_cells());
#ifdef DEAL_II_WITH_METIS
    dealii::GridTools::partition_triangulation(
      n, work, triangulation_, dealii::SparsityTools::Partitioner::metis);
#else
    (void)work;
    dealii::GridTools::partition_triangulation_zorder(n, triangulation_);
#endif
  }



  template <int dim>
  void
  IGASpace<dim>::make_triangulation()
  {
    // Corners of the spans, joined like the control points.
    PointJoiner<dim>                           joiner(bodies_, tolerance_);
    std::vector<std::vector<unsigned int>>     numbers;
    std::vector<std::array<unsigned int, dim>> n_corners(patches_.size());
    for (unsigned int i = 0; i < patches_.size(); ++i)
      {
        unsigned int n = 1;
        for (unsigned int d = 0; d < dim; ++d)
          {
            n_corners[i][d] = patches_[i].knot_vector(d).n_spans() + 1;
            n *= n_corners[i][d];
          }
        std::vector<Point<dim>> corners;
        for (unsigned int l = 0; l < n; ++l)
          {
            Point<dim>   u;
            unsigned int rest = l;
            for (unsigned int d = 0; d < dim; ++d)
              {
                u[d] =
                  patches_[i].knot_vector(d).breaks()[rest % n_corners[i][d]];
                rest /= n_corners[i][d];
              }
            corners.push_back(patches_[i].value(u));
          }
        numbers.push_back(joiner.add(i, n_corners[i], corners));
      }

    std::vector<dealii::CellData<dim>> cell_data;
    for (const Cell &cell : cells_)
      {
        const auto           &n = n_corners[cell.patch];
        dealii::CellData<dim> data;
        data.material_id = cell.patch;
        for (unsigned int v = 0; v < data.vertices.size(); ++v)
          {
            unsigned int l = 0;
            for (unsigned int d = dim; d-- > 0;)
              l = l * n[d] + cell.span[d] + ((v >> d) & 1);
            data.vertices[v] = numbers[cell.patch][l];
          }
        cell_data.push_back(data);
      }
    triangulation_.create_triangulation(joiner.points(),
                                        cell_data,
                                        dealii::SubCellData());
    AssertDimension(triangulation_.n_active_cells(), cells_.size());
  }



  template <int dim>
  void
  IGASpace<dim>::number_splines()
  {
    PointJoiner<dim> joiner(bodies_, tolerance_);
    for (unsigned int i = 0; i < patches_.size(); ++i)
      {
        std::array<unsigned int, dim> n;
        for (unsigned int d = 0; d < dim; ++d)
          n[d] = patches_[i].n_control_points(d);
        local_to_global_.push_back(
          joiner.add(i, n, patches_[i].control_points()));
        for (unsigned int A = 0; A < patches_[i].n_control_points(); ++A)
          if (local_to_global_[i][A] == weights_.size())
            weights_.push_back(patches_[i].weights()[A]);
      }
    control_points_ = joiner.points();

    for (const Cell &cell : cells_)
      {
        const unsigned int n =
          dealii::Utilities::fixed_power<dim>(degree(cell.patch) + 1);
        std::vector<unsigned int> indices;
        indices.reserve(n);
        for (unsigned int l = 0; l < n; ++l)
          indices.push_back(
            local_to_global_[cell.patch][lattice_position(cell, l)]);
        control_points_of_cell_.push_back(indices);
      }
  }



  template <int dim>
  void
  IGASpace<dim>::number_elements()
  {
    dof_handler_.reinit(triangulation_);
    for (const auto &cell : dof_handler_.active_cell_iterators())
      cell->set_active_fe_index(
        element_of_degree_.at(degree(cell->material_id())));
    dof_handler_.distribute_dofs(elements_);

    for (const auto &patch : patches_)
      local_to_global_.emplace_back(patch.n_control_points());
    for (const auto &cell : dof_handler_.active_cell_iterators())
      {
        const auto order = lexicographic_numbering(cell->get_fe());
        std::vector<dealii::types::global_dof_index> dofs(order.size());
        cell->get_dof_indices(dofs);
        std::vector<unsigned int> indices;
        for (unsigned int l = 0; l < order.size(); ++l)
          {
            indices.push_back(dofs[order[l]]);
            local_to_global_[cell->material_id()][lattice_position(
              cells_[cell->active_cell_index()], l)] = indices.back();
          }
        control_points_of_cell_.push_back(indices);
      }

    // The order of the patches' control points, so that runs with the C0 bases
    // and with splines number alike.
    std::vector<dealii::types::global_dof_index> new_numbers(
      dof_handler_.n_dofs(), dealii::numbers::invalid_dof_index);
    for (unsigned int i = 0; i < patches_.size(); ++i)
      for (unsigned int A = 0; A < patches_[i].n_control_points(); ++A)
        {
          unsigned int &number = local_to_global_[i][A];
          if (new_numbers[number] == dealii::numbers::invalid_dof_index)
            {
              new_numbers[number] = control_points_.size();
              control_points_.push_back(patches_[i].control_points()[A]);
              weights_.push_back(patches_[i].weights()[A]);
            }
          number = new_numbers[number];
        }
    AssertDimension(control_points_.size(), dof_handler_.n_dofs());
    dof_handler_.renumber_dofs(new_numbers);
    for (auto &indices : control_points_of_cell_)
      for (unsigned int &index : indices)
        index = new_numbers[index];
  }



  template <int dim>
  unsigned int
  IGASpace<dim>::lattice_position(const Cell &cell, unsigned int l) const
  {
    const NURBSPatch<dim>        &patch = patches_[cell.patch];
    const unsigned int            n     = degree(cell.patch) + 1;
    std::array<unsigned int, dim> i;
    for (unsigned int d = 0; d < dim; ++d)
      {
        i[d] = patch.knot_vector(d).first_function(cell.span[d]) + l % n;
        l /= n;
      }
    return patch.index(i);
  }



  template <int dim>
  void
  IGASpace<dim>::check_weights() const
  {
    for (unsigned int i = 0; i < patches_.size(); ++i)
      for (unsigned int A = 0; A < patches_[i].n_control_points(); ++A)
        {
          const double weight = weights_[local_to_global_[i][A]];
          if (!(std::abs(weight - patches_[i].weights()[A]) < 1e-9 * weight))
            throw InputError(
              "Joined patches must have equal weights where they meet; patch " +
              std::to_string(i) + " has " +
              std::to_string(patches_[i].weights()[A]) +
              " where the weight is " + std::to_string(weight) + ".");
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
  IGASpace<dim>::check_positions() const
  {
    // Splines are joined by position (in boxes, hence the factor), elements by
    // the corners of cells.
    for (unsigned int i = 0; i < patches_.size(); ++i)
      for (unsigned int A = 0; A < patches_[i].n_control_points(); ++A)
        {
          const double distance =
            control_points_[local_to_global_[i][A]].distance(
              patches_[i].control_points()[A]);
          if (!(distance < 2. * tolerance_))
            throw InputError(
              "Cells of one body with common corners must have common control "
              "points between them; patch " +
              std::to_string(i) + " has one " + std::to_string(distance) +
              " mm beside that of its neighbor. Split its spans there.");
        }
  }



  template <int dim>
  FullMatrix<double>
  IGASpace<dim>::bernstein_operator(const Cell        &cell,
                                    const unsigned int direction) const
  {
    if (basis_ != Basis::Lagrange)
      return extraction_[cell.patch][direction][cell.span[direction]];

    // Lagrange polynomials are interpolated by Bernstein polynomials at p+1
    // points.
    const unsigned int p         = degree(cell.patch);
    const auto        &lagrange  = local_polynomials(cell.patch);
    const auto         bernstein = polynomials_of(dealii::FE_Bernstein<1>(p));
    FullMatrix<double> V(p + 1, p + 1), L(p + 1, p + 1), X(p + 1, p + 1);
    for (unsigned int i = 0; i <= p; ++i)
      for (unsigned int a = 0; a <= p; ++a)
        {
          const double x = static_cast<double>(i) / p;
          V(a, i)        = bernstein[a].value(x);
          L(a, i)        = lagrange[a].value(x);
        }
    V.gauss_jordan();
    L.mmult(X, V);
    return X;
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

    std::array<FullMatrix<double>, dim> C;
    for (unsigned int d = 0; d < dim; ++d)
      C[d] = bernstein_operator(cell, d);

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
