// SPDX-License-Identifier: LGPL-2.1-or-later
// The tree of fronts, from the pattern of a matrix.

#include <npt_dealii/linear_algebra/fronts.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace NPT
{
  namespace
  {
    /**
     * Return for each column of L, in the order of elimination, the rows below
     * the diagonal that are not zero, ascending: those of the matrix and those
     * of the columns whose first row this one is.
     */
    std::vector<std::vector<int>>
    rows_of_factor(const CSRMatrix &A, const std::vector<int> &position)
    {
      const int                     n = A.n();
      std::vector<std::vector<int>> rows(n), first_row_is(n);
      for (int i = 0; i < n; ++i)
        for (int k = A.row_start[i]; k < A.row_start[i + 1]; ++k)
          {
            const auto [a, b] =
              std::minmax(position[i], position[A.columns[k]]);
            if (a != b)
              rows[a].push_back(b);
          }
      std::vector<int> seen_by(n, -1);
      for (int j = 0; j < n; ++j)
        {
          std::vector<int> all;
          seen_by[j]     = j;
          const auto add = [&](const std::vector<int> &list) {
            for (const int row : list)
              if (seen_by[row] != j)
                {
                  seen_by[row] = j;
                  all.push_back(row);
                }
          };
          add(rows[j]);
          for (const int child : first_row_is[j])
            add(rows[child]);
          std::sort(all.begin(), all.end());
          rows[j] = std::move(all);
          if (!rows[j].empty())
            first_row_is[rows[j].front()].push_back(j);
        }
      return rows;
    }



    // Columns of L with (nearly) the same rows below them.
    struct Group
    {
      std::vector<int> pivots;  // in the order of elimination
      std::vector<int> changed; // rows below, ascending
      int              parent = -1;
      std::vector<int> children;
      double           n_zeros = 0;     // stored and not needed
      bool             is_part = false; // of its parent
    };

    /// Neighboring columns of which the second has the rows of the first.
    std::vector<Group>
    equal_columns(std::vector<std::vector<int>> &rows)
    {
      const int          n = rows.size();
      std::vector<Group> groups;
      std::vector<int>   group_of(n);
      for (int j = 0; j < n; ++j)
        {
          const bool goes_on = j > 0 && !rows[j - 1].empty() &&
                               rows[j - 1].front() == j &&
                               rows[j - 1].size() == rows[j].size() + 1;
          if (!goes_on)
            groups.emplace_back();
          groups.back().pivots.push_back(j);
          group_of[j] = groups.size() - 1;
        }
      for (unsigned int g = 0; g < groups.size(); ++g)
        {
          Group &group  = groups[g];
          group.changed = std::move(rows[group.pivots.back()]);
          if (!group.changed.empty())
            {
              group.parent = group_of[group.changed.front()];
              groups[group.parent].children.push_back(g);
            }
        }
      return groups;
    }



    /**
     * Join groups with their parents where that stores few zeros: small
     * products of matrices cost more than their operations. The limits are
     * those of the fastest factorization of woven cells of 500 and 1,316
     * unknowns; twice or half of them changes it by some per cent.
     */
    void
    join(std::vector<Group> &groups)
    {
      const auto size = [](const auto &list) {
        return static_cast<double>(list.size());
      };
      for (Group &parent : groups)
        for (bool joined = true; joined;)
          {
            joined = false;
            // The child that costs least.
            int    best  = -1;
            double least = 0;
            for (const int c : parent.children)
              {
                const double zeros =
                  size(groups[c].pivots) *
                    (size(parent.pivots) + size(parent.changed) -
                     size(groups[c].changed)) +
                  groups[c].n_zeros;
                if (best < 0 || zeros < least)
                  {
                    best  = c;
                    least = zeros;
                  }
              }
            if (best < 0)
              break;
            Group       &child    = groups[best];
            const double n_pivots = size(child.pivots) + size(parent.pivots);
            const double zeros    = least + parent.n_zeros;
            const double stored =
              n_pivots * (0.5 * n_pivots + size(parent.changed));
            const double share = zeros / stored;
            if (share <= 0.05 || (n_pivots <= 48 && share <= 0.2) ||
                (n_pivots <= 16 && share <= 0.5))
              {
                child.is_part = true;
                parent.pivots.insert(parent.pivots.begin(),
                                     child.pivots.begin(),
                                     child.pivots.end());
                parent.n_zeros = zeros;
                parent.children.erase(std::find(parent.children.begin(),
                                                parent.children.end(),
                                                best));
                parent.children.insert(parent.children.end(),
                                       child.children.begin(),
                                       child.children.end());
                joined = true;
              }
          }
    }
  } // namespace



  void
  Fronts::analyze(const CSRMatrix &A, const std::vector<int> &order)
  {
    n_unknowns = A.n();
    position.resize(n_unknowns);
    if (order.empty())
      std::iota(position.begin(), position.end(), 0);
    else
      for (int i = 0; i < n_unknowns; ++i)
        position[i] = order[i] - 1;
    make_tree(A, position);
    find_entries(A);
    exchanges.assign(n_unknowns, 0);
  }



  void
  Fronts::make_tree(const CSRMatrix &A, std::vector<int> &order)
  {
    std::vector<std::vector<int>> rows   = rows_of_factor(A, order);
    std::vector<Group>            groups = equal_columns(rows);
    join(groups);

    // Children before parents, each child right before its parent's or the next
    // child's family.
    std::vector<int> sequence, open;
    for (int g = groups.size() - 1; g >= 0; --g)
      if (groups[g].parent < 0)
        open.push_back(g);
    // Parents before children, from the last one to the first one.
    while (!open.empty())
      {
        const int g = open.back();
        open.pop_back();
        sequence.push_back(g);
        open.insert(open.end(),
                    groups[g].children.begin(),
                    groups[g].children.end());
      }
    std::reverse(sequence.begin(), sequence.end());

    fronts.assign(sequence.size(), Front());
    std::vector<int> new_place(n_unknowns), front_of_group(groups.size(), -1);
    int              next  = 0;
    std::size_t      begin = 0;
    for (unsigned int f = 0; f < fronts.size(); ++f)
      {
        const Group &group          = groups[sequence[f]];
        front_of_group[sequence[f]] = f;
        fronts[f].first             = next;
        fronts[f].n                 = group.pivots.size();
        fronts[f].m                 = fronts[f].n + group.changed.size();
        fronts[f].begin             = begin;
        begin += std::size_t(fronts[f].n) * (2 * fronts[f].m - fronts[f].n);
        for (const int pivot : group.pivots)
          new_place[pivot] = next++;
        for (const int child : group.children)
          {
            const int c = front_of_group[child];
            fronts[f].children.push_back(c);
            fronts[c].parent = f;
          }
        std::sort(fronts[f].children.begin(), fronts[f].children.end());
      }
    factors.resize(begin);
    for (int &place : order)
      place = new_place[place];

    for (int f = fronts.size() - 1; f >= 0; --f)
      {
        Front &front = fronts[f];
        for (const int row : groups[sequence[f]].changed)
          front.changed.push_back(new_place[row]);
        std::sort(front.changed.begin(), front.changed.end());
        if (front.parent < 0)
          continue;
        const Front &parent = fronts[front.parent];
        front.level         = parent.level + 1;
        for (const int row : front.changed)
          front.places.push_back(row < parent.first + parent.n ?
                                   row - parent.first :
                                   parent.n +
                                     (std::lower_bound(parent.changed.begin(),
                                                       parent.changed.end(),
                                                       row) -
                                      parent.changed.begin()));
      }

    // What a stack must hold at most.
    std::size_t tops[2] = {0, 0}, highest[2] = {0, 0};
    int         largest = 0;
    for (const Front &front : fronts)
      {
        for (const int c : front.children)
          tops[fronts[c].level % 2] -=
            fronts[c].changed.size() * fronts[c].changed.size();
        std::size_t &top = tops[front.level % 2];
        top += front.changed.size() * front.changed.size();
        highest[front.level % 2] = std::max(highest[front.level % 2], top);
        largest                  = std::max(largest, front.m);
      }
    for (const int parity : {0, 1})
      stacks[parity].values.resize(highest[parity]);
    permuted.resize(n_unknowns);
    changes.resize(largest);
  }



  void
  Fronts::find_entries(const CSRMatrix &A)
  {
    std::vector<int> front_of(n_unknowns);
    for (unsigned int f = 0; f < fronts.size(); ++f)
      std::fill_n(front_of.begin() + fronts[f].first, fronts[f].n, f);

    // Sorted by counting: lower and upper entries of each front.
    const auto group_of = [&](const int row, const int column) {
      return 2 * front_of[std::min(row, column)] + (row < column ? 1 : 0);
    };
    std::vector<int> next(2 * fronts.size() + 1, 0);
    for (int i = 0; i < n_unknowns; ++i)
      for (int k = A.row_start[i]; k < A.row_start[i + 1]; ++k)
        ++next[group_of(position[i], position[A.columns[k]]) + 1];
    std::partial_sum(next.begin(), next.end(), next.begin());
    for (unsigned int f = 0; f < fronts.size(); ++f)
      {
        fronts[f].first_entry    = next[2 * f];
        fronts[f].end_of_lower   = next[2 * f + 1];
        fronts[f].end_of_entries = next[2 * f + 2];
      }

    sources.resize(A.n_nonzeros());
    targets.resize(A.n_nonzeros());
    for (int i = 0; i < n_unknowns; ++i)
      for (int k = A.row_start[i]; k < A.row_start[i + 1]; ++k)
        {
          const int    row = position[i], column = position[A.columns[k]];
          const int    group = group_of(row, column);
          const Front &front = fronts[group / 2];
          const auto   local = [&](const int place) {
            return place < front.first + front.n ?
                       place - front.first :
                       front.n +
                       static_cast<int>(std::lower_bound(front.changed.begin(),
                                                         front.changed.end(),
                                                         place) -
                                        front.changed.begin());
          };
          const int r = local(row), c = local(column), at = next[group]++;
          sources[at] = k;
          targets[at] = c < front.n ?
                          c * front.m + r :
                          front.n * front.m + (c - front.n) * front.n + r;
        }
  }



  double
  Fronts::gigabytes() const
  {
    return 1e-9 * sizeof(double) *
           (factors.size() + stacks[0].values.size() + stacks[1].values.size());
  }
} // namespace NPT
