// SPDX-License-Identifier: LGPL-2.1-or-later
// Assembly in the independent unknowns.

#include <npt_dealii/linear_algebra/constrained_system.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace NPT
{
  using dealii::Vector;

  void
  ConstrainedSystem::add_row(
    const dealii::AffineConstraints<double> &constraints,
    const unsigned int                       i)
  {
    if (index_[i] >= 0)
      {
        row_column_.push_back(index_[i]);
        row_value_.push_back(1.);
        return;
      }
    Assert(constraints.get_inhomogeneity(i) == 0.,
           dealii::ExcMessage("Loads enter through prescribed unknowns, not "
                              "inhomogeneities."));
    for (const auto &entry : *constraints.get_constraint_entries(i))
      if (entry.second != 0.)
        {
          AssertThrow(index_[entry.first] >= 0,
                      dealii::ExcMessage("Constraints must be closed first."));
          row_column_.push_back(index_[entry.first]);
          row_value_.push_back(entry.second);
        }
  }



  void
  ConstrainedSystem::reinit(
    const dealii::AffineConstraints<double> &constraints,
    const unsigned int                       n_unknowns,
    std::shared_ptr<const UnknownMap>        map)
  {
    has_pattern_ = false;
    map_         = std::move(map);
    independent_.clear();
    index_.assign(n_unknowns, -1);
    for (unsigned int i = 0; i < n_unknowns; ++i)
      if (!constraints.is_constrained(i))
        {
          index_[i] = independent_.size();
          independent_.push_back(i);
        }
    row_start_.assign(1, 0);
    row_column_.clear();
    row_value_.clear();
    map_factor_.clear();
    map_gradient_.clear();
    if (map_)
      {
        int gradient = 0;
        for (const auto &arguments : map_->arguments())
          {
            for (const unsigned int j : arguments)
              {
                add_row(constraints, j);
                map_gradient_.resize(row_value_.size(), gradient++);
              }
            row_start_.push_back(row_column_.size());
          }
        map_factor_ = row_value_;
      }
    for (unsigned int i = 0; i < n_unknowns; ++i)
      {
        add_row(constraints, i);
        row_start_.push_back(row_column_.size());
      }
    groups_.clear();
    couplings_.clear();
    matrix_          = CSRMatrix();
    free_pattern_of_ = 0;
    prescribed_.assign(independent_.size(), false);
    free_.resize(independent_.size());
    for (unsigned int k = 0; k < free_.size(); ++k)
      free_[k] = k;
  }



  void
  ConstrainedSystem::linearize(const Vector<double> &u)
  {
    if (!map_)
      return;
    Vector<double> v;
    map_->invert(u, v);
    map_->gradients(v, gradients_);
    for (std::size_t k = 0; k < map_factor_.size(); ++k)
      row_value_[k] = map_factor_[k] * gradients_[map_gradient_[k]];
    groups_lag_ = true;
  }



  void
  ConstrainedSystem::set_zero(const bool free_only)
  {
    matrix_.set_zero();
    free_only_ = free_only;
    if (groups_lag_)
      for (Group &group : groups_)
        for (std::size_t k = 0; k < group.entry.size(); ++k)
          group.coefficient[k] = row_value_[group.entry[k]];
    groups_lag_ = false;
  }



  void
  ConstrainedSystem::expand(const Vector<double> &m, Vector<double> &u) const
  {
    AssertDimension(m.size(), independent_.size());
    u.reinit(index_.size());
    for (unsigned int i = 0; i < index_.size(); ++i)
      for (int k = row_start_[row_of_v(i)]; k < row_start_[row_of_v(i) + 1];
           ++k)
        u[i] += row_value_[k] * m[row_column_[k]];
    if (map_)
      {
        const Vector<double> v(u);
        map_->apply(v, u);
      }
  }



  void
  ConstrainedSystem::condense(const Vector<double> &r,
                              Vector<double>       &condensed) const
  {
    AssertDimension(r.size(), index_.size());
    condensed.reinit(independent_.size());
    for (unsigned int i = 0; i < index_.size(); ++i)
      for (int k = row_start_[i]; k < row_start_[i + 1]; ++k)
        condensed[row_column_[k]] += row_value_[k] * r[i];
  }



  void
  ConstrainedSystem::restrict_to_independent(const Vector<double> &u,
                                             Vector<double>       &m) const
  {
    Vector<double> v(u);
    if (map_)
      map_->invert(u, v);
    m.reinit(independent_.size());
    for (unsigned int k = 0; k < independent_.size(); ++k)
      m[k] = v[independent_[k]];
  }



  void
  ConstrainedSystem::make_group(const std::vector<unsigned int> &unknowns,
                                Group                           &group) const
  {
    group.columns.clear();
    for (const unsigned int i : unknowns)
      group.columns.insert(group.columns.end(),
                           row_column_.begin() + row_start_[i],
                           row_column_.begin() + row_start_[i + 1]);
    std::sort(group.columns.begin(), group.columns.end());
    group.columns.erase(std::unique(group.columns.begin(), group.columns.end()),
                        group.columns.end());
    const int n_columns = group.columns.size();
    group.run_start.clear();
    place_.resize(independent_.size());
    for (int b = 0; b < n_columns; ++b)
      {
        place_[group.columns[b]] = b;
        if (b == 0 || group.columns[b] != group.columns[b - 1] + 1)
          group.run_start.push_back(b);
      }
    group.run_start.push_back(n_columns);

    group.n_unknowns = unknowns.size();
    group.unknown.clear();
    group.local.clear();
    group.coefficient.clear();
    group.entry.clear();
    for (unsigned int b = 0; b < unknowns.size(); ++b)
      for (int k = row_start_[unknowns[b]]; k < row_start_[unknowns[b] + 1];
           ++k)
        {
          group.unknown.push_back(b);
          group.local.push_back(place_[row_column_[k]]);
          group.coefficient.push_back(row_value_[k]);
          if (map_)
            group.entry.push_back(k);
        }
    // With a map entries change, and columns may come twice.
    group.is_permutation = !map_ && group.local.size() == unknowns.size() &&
                           group.columns.size() == unknowns.size();
    if (group.is_permutation)
      {
        // Sorted by column, which are all there.
        const std::vector<int>    local       = group.local;
        const std::vector<double> coefficient = group.coefficient;
        for (unsigned int b = 0; b < unknowns.size(); ++b)
          {
            group.unknown[local[b]]     = b;
            group.coefficient[local[b]] = coefficient[b];
          }
        std::iota(group.local.begin(), group.local.end(), 0);
      }
  }



  bool
  ConstrainedSystem::find_positions(Group &group) const
  {
    const int n_columns = group.columns.size();
    const int n_runs    = group.run_start.size() - 1;
    group.list.resize(n_columns);
    group.offsets.clear();
    int n_lists = 0;
    for (int a = 0; a < n_columns; ++a)
      {
        const int row = group.columns[a];
        if (a > 0 && group.columns[a - 1] == row - 1 &&
            row_group_[row] == row_group_[row - 1])
          {
            group.list[a] = n_lists - 1;
            continue;
          }
        const auto begin = matrix_.columns.begin() + matrix_.row_start[row];
        const auto end   = matrix_.columns.begin() + matrix_.row_start[row + 1];
        auto       at    = begin;
        for (int run = 0; run < n_runs; ++run)
          {
            const int first  = group.columns[group.run_start[run]];
            const int length = group.run_start[run + 1] - group.run_start[run];
            at               = std::lower_bound(at, end, first);
            if (end - at < length || *at != first ||
                *(at + length - 1) != first + length - 1)
              return false;
            group.offsets.push_back(at - begin);
            at += length;
          }
        group.list[a] = n_lists++;
      }
    return true;
  }



  unsigned int
  ConstrainedSystem::add_group(const std::vector<unsigned int> &unknowns)
  {
    has_pattern_ = false;
    groups_.emplace_back();
    make_group(unknowns, groups_.back());
    return groups_.size() - 1;
  }



  void
  ConstrainedSystem::build_pattern(
    const std::vector<std::vector<unsigned int>> &couplings)
  {
    // Which groups each independent unknown belongs to; then one row at a time
    // is gathered with a marker, so that nothing is sorted twice.
    couplings_.insert(couplings.begin(), couplings.end());
    std::vector<Group> extra;
    for (const auto &coupling : couplings_)
      {
        extra.emplace_back();
        make_group(coupling, extra.back());
      }
    std::vector<std::vector<const Group *>> member(independent_.size());
    for (const auto *list : {&groups_, &extra})
      for (const Group &group : *list)
        for (const int a : group.columns)
          member[a].push_back(&group);

    std::vector<std::vector<int>> rows(independent_.size());
    std::vector<int>              marker(independent_.size(), -1);
    for (int a = 0; a < static_cast<int>(rows.size()); ++a)
      {
        // The diagonal exists even for unknowns that no group touches.
        marker[a] = a;
        rows[a].push_back(a);
        for (const Group *group : member[a])
          for (const int b : group->columns)
            if (marker[b] != a)
              {
                marker[b] = a;
                rows[a].push_back(b);
              }
      }
    matrix_.set_pattern(rows);
    row_group_ = matrix_.group_of_rows();
    for (Group &group : groups_)
      {
        const bool found = find_positions(group);
        (void)found;
        Assert(found, dealii::ExcInternalError());
      }
    has_pattern_ = true;
  }



  namespace
  {
    void
    add_multiple(const double      factor,
                 const double     *from,
                 const std::size_t n,
                 double           *to)
    {
      DEAL_II_OPENMP_SIMD_PRAGMA
      for (std::size_t i = 0; i < n; ++i)
        to[i] += factor * from[i];
    }



    void
    set_multiple(const double      factor,
                 const double     *from,
                 const std::size_t n,
                 double           *to)
    {
      DEAL_II_OPENMP_SIMD_PRAGMA
      for (std::size_t i = 0; i < n; ++i)
        to[i] = factor * from[i];
    }



    // to[j][i] = from[i][j], block by block, so that neither is read or written
    // far apart.
    void
    transpose(const double     *from,
              const std::size_t n_rows,
              const std::size_t n_columns,
              double           *to)
    {
      constexpr std::size_t block = 8;
      for (std::size_t i = 0; i < n_rows; i += block)
        for (std::size_t j = 0; j < n_columns; j += block)
          for (std::size_t k = i; k < std::min(i + block, n_rows); ++k)
            for (std::size_t l = j; l < std::min(j + block, n_columns); ++l)
              to[l * n_rows + k] = from[k * n_columns + l];
    }
  } // namespace



  // sums = C^T rows, where C has the coefficients of the group.
  void
  ConstrainedSystem::sum_rows(const Group         &group,
                              const double        *rows,
                              const std::size_t    length,
                              std::vector<double> &sums) const
  {
    const std::size_t n_m = group.columns.size();
    sums.resize(n_m * length);
    std::vector<bool> has_sum(n_m, false);
    for (std::size_t k = 0; k < group.local.size(); ++k)
      {
        const int m = group.local[k];
        if (free_only_ && prescribed_[group.columns[m]])
          continue;
        double       *target = &sums[m * length];
        const double *row    = rows + group.unknown[k] * length;
        if (has_sum[m])
          add_multiple(group.coefficient[k], row, length, target);
        else
          set_multiple(group.coefficient[k], row, length, target);
        has_sum[m] = true;
      }
    for (std::size_t m = 0; m < n_m; ++m)
      if (!has_sum[m])
        std::fill_n(&sums[m * length], length, 0.);
  }



  void
  ConstrainedSystem::add(const Group               &group,
                         const std::vector<double> &K,
                         const double               factor)
  {
    const std::size_t n = group.n_unknowns, n_m = group.columns.size();
    AssertDimension(K.size(), n * n);
    if (!group.is_permutation)
      {
        // C^T K C in two sweeps over rows, the first over those of K^T.
        transposed_.resize(std::max(n_m, n) * n);
        transpose(K.data(), n, n, transposed_.data());
        sum_rows(group, transposed_.data(), n, rows_condensed_);
        transpose(rows_condensed_.data(), n_m, n, transposed_.data());
        sum_rows(group, transposed_.data(), n_m, condensed_);
      }

    const int    *source      = group.unknown.data();
    const double *coefficient = group.coefficient.data();
    for (std::size_t m = 0; m < n_m; ++m)
      {
        double *target =
          matrix_.values.data() + matrix_.row_start[group.columns[m]];
        const std::size_t n_runs  = group.run_start.size() - 1;
        const int        *offsets = &group.offsets[group.list[m] * n_runs];
        for (std::size_t run = 0; run < n_runs; ++run)
          {
            const int begin = group.run_start[run];
            const int end   = group.run_start[run + 1];
            if (!group.is_permutation)
              {
                add_multiple(factor,
                             &condensed_[m * n_m + begin],
                             end - begin,
                             target + offsets[run]);
                continue;
              }
            double       *first = target + (offsets[run] - begin);
            const double *row   = K.data() + source[m] * n;
            const double  c     = factor * coefficient[m];
            for (int b = begin; b < end; ++b)
              first[b] += c * coefficient[b] * row[source[b]];
          }
      }
  }



  void
  ConstrainedSystem::add(const unsigned int         group,
                         const std::vector<double> &K,
                         const double               factor)
  {
    AssertIndexRange(group, groups_.size());
    add(groups_[group], K, factor);
  }



  bool
  ConstrainedSystem::add(const std::vector<unsigned int> &unknowns,
                         const std::vector<double>       &K)
  {
    make_group(unknowns, group_);
    if (!find_positions(group_))
      return false;
    add(group_, K, 1.);
    return true;
  }



  void
  ConstrainedSystem::add_border(const unsigned int    unknown,
                                const Vector<double> &r)
  {
    Vector<double> condensed;
    condense(r, condensed);
    const int border = index_[unknown];
    AssertThrow(border >= 0, dealii::ExcInternalError());
    for (unsigned int k = 0; k < condensed.size(); ++k)
      if (condensed[k] != 0.)
        for (const int at :
             {matrix_.position(border, k), matrix_.position(k, border)})
          {
            AssertThrow(at >= 0, dealii::ExcInternalError());
            matrix_.values[at] += condensed[k];
          }
  }



  void
  ConstrainedSystem::set_prescribed(const std::vector<bool> &prescribed)
  {
    AssertDimension(prescribed.size(), independent_.size());
    prescribed_ = prescribed;
    free_.clear();
    for (unsigned int k = 0; k < prescribed.size(); ++k)
      if (!prescribed[k])
        free_.push_back(k);
    free_pattern_of_ = 0;
  }



  const CSRMatrix &
  ConstrainedSystem::free_matrix()
  {
    if (free_pattern_of_ != matrix_.pattern_id())
      {
        std::vector<int> free_number(independent_.size(), -1);
        for (unsigned int k = 0; k < free_.size(); ++k)
          free_number[free_[k]] = k;
        std::vector<std::vector<int>> rows(free_.size());
        free_runs_.clear();
        for (std::size_t g = 0; g + 1 < matrix_.row_groups.size(); ++g)
          {
            const int        first = matrix_.row_groups[g];
            const int        begin = matrix_.row_start[first];
            const int        end   = matrix_.row_start[first + 1];
            std::vector<int> columns;
            std::vector<Run> runs;
            for (int at = begin; at < end; ++at)
              if (const int k = free_number[matrix_.columns[at]]; k >= 0)
                {
                  columns.push_back(k);
                  if (runs.empty() || runs.back().end != at - begin)
                    runs.push_back({at - begin, at - begin});
                  ++runs.back().end;
                }
            for (int i = first; i < matrix_.row_groups[g + 1]; ++i)
              if (free_number[i] >= 0)
                rows[free_number[i]] = columns;
            free_runs_.push_back(std::move(runs));
          }
        free_matrix_.set_pattern(rows);
        free_pattern_of_ = matrix_.pattern_id();
      }
    // Both in the order of rows and columns.
    double *value = free_matrix_.values.data();
    for (const unsigned int i : free_)
      {
        const double *const row = matrix_.values.data() + matrix_.row_start[i];
        for (const Run &run : free_runs_[row_group_[i]])
          value = std::copy(row + run.begin, row + run.end, value);
      }
    return free_matrix_;
  }
} // namespace NPT
