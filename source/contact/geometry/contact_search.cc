// SPDX-License-Identifier: LGPL-2.1-or-later
// R-tree search for projection start values.

#include <npt_dealii/contact/geometry/contact_search.h>

#include <algorithm>

namespace NPT
{
  using dealii::Point;

  template <int dim>
  ContactSearch<dim>::ContactSearch(
    const std::vector<ContactSurface<dim>>     &surfaces,
    const std::vector<std::vector<Point<dim>>> &positions)
  {
    constexpr int m = dim - 1;
    // Two samples per span and direction keep every point of the surface
    // within half a span of a start value.
    constexpr unsigned int n_samples = 2;

    std::vector<Entry> entries;
    SurfaceShape<m>    shape;
    for (unsigned int s = 0; s < surfaces.size(); ++s)
      {
        const IGASurface<dim> &face  = surfaces[s].surface();
        unsigned int           total = 1;
        for (int k = 0; k < m; ++k)
          total *= n_samples * face.knot_vector(k).n_spans();
        for (unsigned int i = 0; i < total; ++i)
          {
            ProjectionStart<dim> start;
            start.known       = true;
            start.surface     = s;
            unsigned int rest = i;
            for (int k = 0; k < m; ++k)
              {
                const auto        &breaks = face.knot_vector(k).breaks();
                const unsigned int n      = n_samples * (breaks.size() - 1);
                const unsigned int e      = (rest % n) / n_samples;
                const double t = ((rest % n) % n_samples + 0.5) / n_samples;
                start.u[k]     = breaks[e] + t * (breaks[e + 1] - breaks[e]);
                rest /= n;
              }
            face.evaluate(start.u, 0, shape);
            Point<dim> x;
            for (unsigned int l = 0; l < shape.lattice.size(); ++l)
              x += shape.value[l] * positions[s][shape.lattice[l]];
            entries.emplace_back(x, samples_.size());
            samples_.push_back(start);
          }
      }
    tree_ = dealii::pack_rtree(entries);
  }



  template <int dim>
  std::vector<ProjectionStart<dim>>
  ContactSearch<dim>::nearest(const Point<dim>  &point,
                              const unsigned int n) const
  {
    std::vector<Entry> found;
    tree_.query(boost::geometry::index::nearest(point, n),
                std::back_inserter(found));
    std::sort(found.begin(), found.end(), [&](const Entry &a, const Entry &b) {
      const double da = point.distance_square(a.first);
      const double db = point.distance_square(b.first);
      // Ties are broken by the number, so that the result is deterministic.
      return da != db ? da < db : a.second < b.second;
    });
    std::vector<ProjectionStart<dim>> result;
    for (const Entry &entry : found)
      result.push_back(samples_[entry.second]);
    return result;
  }

  template class ContactSearch<2>;
  template class ContactSearch<3>;
} // namespace NPT
