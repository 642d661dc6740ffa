// SPDX-License-Identifier: LGPL-2.1-or-later
// Assembly in the independent unknowns.

#include <npt_dealii/linear_algebra/constrained_system.h>

namespace NPT
{
  using dealii::Vector;

  void
  ConstrainedSystem::reinit(
    const dealii::AffineConstraints<double> &constraints,
    const unsigned int                       n_unknowns)
  {
    has_pattern_ = false;
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
    for (unsigned int i = 0; i < n_unknowns; ++i)
      {
        if (index_[i] >= 0)
          {
            row_column_.push_back(index_[i]);
            row_value_.push_back(1.);
          }
        else
          {
            Assert(constraints.get_inhomogeneity(i) == 0.,
                   dealii::ExcMessage("Loads enter through prescribed "
                                      "unknowns, not inhomogeneities."));
            for (const auto &entry : *constraints.get_constraint_entries(i))
              if (entry.second != 0.)
                {
                  AssertThrow(index_[entry.first] >= 0,
                              dealii::ExcMessage(
                                "Constraints must be closed first."));
                  row_column_.push_back(index_[entry.first]);
                  row_value_.push_back(entry.second);
                }
          }
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
  ConstrainedSystem::expand(const Vector<double> &m, Vector<double> &u) const
  {
    AssertDimension(m.size(), independent_.size());
    u.reinit(index_.size());
    for (unsigned int i = 0; i < index_.size(); ++i)
      for (int k = row_start_[i]; k < row_start_[i + 1]; ++k)
        u[i] += row_value_[k] * m[row_column_[k]];
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
    m.reinit(independent_.size());
    for (unsigned int k = 0; k < independent_.size(); ++k)
      m[k] = u[independent_[k]];
  }



  ConstrainedSystem::Group
  ConstrainedSystem::make_group(const std::vector<unsigned int> &unknowns) const
  {
    Group group;
    for (const unsigned int i : unknowns)
      for (int k = row_start_[i]; k < row_start_[i + 1]; ++k)
        group.columns.push_back(row_column_[k]);
    std::sort(group.columns.begin(), group.columns.end());
    group.columns.erase(std::unique(group.columns.begin(), group.columns.end()),
                        group.columns.end());

    group.start.push_back(0);
    group.simple = group.columns.size() == unknowns.size();
    for (const unsigned int i : unknowns)
      {
        for (int k = row_start_[i]; k < row_start_[i + 1]; ++k)
          {
            group.local.push_back(std::lower_bound(group.columns.begin(),
                                                   group.columns.end(),
                                                   row_column_[k]) -
                                  group.columns.begin());
            group.coefficient.push_back(row_value_[k]);
          }
        group.start.push_back(group.local.size());
        group.simple = group.simple && row_start_[i + 1] - row_start_[i] == 1;
      }
    return group;
  }



  bool
  ConstrainedSystem::find_positions(Group &group) const
  {
    const std::size_t n = group.columns.size();
    group.positions.resize(n * n);
    for (std::size_t a = 0; a < n; ++a)
      {
        // Both lists are sorted: one pass per row.
        int       at  = matrix_.row_start[group.columns[a]];
        const int end = matrix_.row_start[group.columns[a] + 1];
        for (std::size_t b = 0; b < n; ++b)
          {
            while (at < end && matrix_.columns[at] < group.columns[b])
              ++at;
            if (at == end || matrix_.columns[at] != group.columns[b])
              return false;
            group.positions[a * n + b] = at;
          }
      }
    return true;
  }



  unsigned int
  ConstrainedSystem::add_group(const std::vector<unsigned int> &unknowns)
  {
    has_pattern_ = false;
    groups_.push_back(make_group(unknowns));
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
      extra.push_back(make_group(coupling));
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
    for (Group &group : groups_)
      {
        const bool found = find_positions(group);
        (void)found;
        Assert(found, dealii::ExcInternalError());
      }
    has_pattern_ = true;
  }



  void
  ConstrainedSystem::add(const Group               &group,
                         const std::vector<double> &K,
                         const double               factor)
  {
    const std::size_t n = group.start.size() - 1, n_m = group.columns.size();
    AssertDimension(K.size(), n * n);
    double *values = matrix_.values.data();
    if (group.simple)
      {
        for (std::size_t a = 0; a < n; ++a)
          {
            const double  ca        = factor * group.coefficient[a];
            const int    *positions = &group.positions[group.local[a] * n_m];
            const double *row       = &K[a * n];
            for (std::size_t b = 0; b < n; ++b)
              values[positions[group.local[b]]] +=
                ca * group.coefficient[b] * row[b];
          }
        return;
      }

    // (C^T K) C in two sweeps.
    scratch_.assign(n_m * n, 0.);
    for (std::size_t a = 0; a < n; ++a)
      for (int k = group.start[a]; k < group.start[a + 1]; ++k)
        {
          const double  c      = factor * group.coefficient[k];
          double       *target = &scratch_[group.local[k] * n];
          const double *row    = &K[a * n];
          for (std::size_t b = 0; b < n; ++b)
            target[b] += c * row[b];
        }
    for (std::size_t m = 0; m < n_m; ++m)
      {
        const int    *positions = &group.positions[m * n_m];
        const double *row       = &scratch_[m * n];
        for (std::size_t b = 0; b < n; ++b)
          for (int k = group.start[b]; k < group.start[b + 1]; ++k)
            values[positions[group.local[k]]] += group.coefficient[k] * row[b];
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
    Group group = make_group(unknowns);
    if (!find_positions(group))
      return false;
    add(group, K, 1.);
    return true;
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
        std::vector<int> number(independent_.size(), -1);
        for (unsigned int k = 0; k < free_.size(); ++k)
          number[free_[k]] = k;
        std::vector<std::vector<int>> rows(free_.size());
        free_source_.clear();
        for (unsigned int k = 0; k < free_.size(); ++k)
          for (int at = matrix_.row_start[free_[k]];
               at < matrix_.row_start[free_[k] + 1];
               ++at)
            if (number[matrix_.columns[at]] >= 0)
              {
                rows[k].push_back(number[matrix_.columns[at]]);
                free_source_.push_back(at);
              }
        free_matrix_.set_pattern(rows);
        free_pattern_of_ = matrix_.pattern_id();
      }
    for (std::size_t at = 0; at < free_source_.size(); ++at)
      free_matrix_.values[at] = matrix_.values[free_source_[at]];
    return free_matrix_;
  }
} // namespace NPT
