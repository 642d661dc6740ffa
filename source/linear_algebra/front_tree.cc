// SPDX-License-Identifier: LGPL-2.1-or-later
// The tree of fronts, from the pattern of a matrix.

#include <npt_dealii/linear_algebra/front_tree.h>

#include <algorithm>
#include <limits>
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



  namespace
  {
    /// Children before parents, each child right before its parent's or the
    /// next child's family.
    std::vector<int>
    sequence_of(const std::vector<Group> &groups)
    {
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
      return sequence;
    }



    /// `changed` are places in the order; set those of a front in its parent.
    void
    set_places(Front &front, const Front &parent)
    {
      for (const int row : front.changed)
        front.places.push_back(row < parent.first + parent.n ?
                                 row - parent.first :
                                 parent.n +
                                   (std::lower_bound(parent.changed.begin(),
                                                     parent.changed.end(),
                                                     row) -
                                    parent.changed.begin()));
    }
  } // namespace



  double
  Front::operations() const
  {
    const double pivots = n, others = m - n;
    return pivots * (2. / 3. * pivots * pivots + 2 * pivots * others +
                     2 * others * others);
  }



  std::vector<int>
  FrontTree::front_of_place() const
  {
    std::vector<int> front_of(position.size());
    for (unsigned int f = 0; f < fronts.size(); ++f)
      std::fill_n(front_of.begin() + fronts[f].first, fronts[f].n, f);
    return front_of;
  }



  FrontTree
  make_front_tree(const CSRMatrix &A, const std::vector<int> &order)
  {
    FrontTree tree;
    tree.position.resize(A.n());
    if (order.empty())
      std::iota(tree.position.begin(), tree.position.end(), 0);
    else
      for (unsigned int i = 0; i < A.n(); ++i)
        tree.position[i] = order[i] - 1;

    std::vector<std::vector<int>> rows   = rows_of_factor(A, tree.position);
    std::vector<Group>            groups = equal_columns(rows);
    join(groups);
    const std::vector<int> sequence = sequence_of(groups);

    std::vector<Front> &fronts = tree.fronts;
    fronts.resize(sequence.size());
    std::vector<int> new_place(A.n()), front_of_group(groups.size(), -1);
    int              next = 0;
    for (unsigned int f = 0; f < fronts.size(); ++f)
      {
        const Group &group          = groups[sequence[f]];
        front_of_group[sequence[f]] = f;
        fronts[f].first             = next;
        fronts[f].n                 = group.pivots.size();
        fronts[f].m                 = fronts[f].n + group.changed.size();
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
    for (int &place : tree.position)
      place = new_place[place];

    for (int f = fronts.size() - 1; f >= 0; --f)
      {
        Front &front = fronts[f];
        for (const int row : groups[sequence[f]].changed)
          front.changed.push_back(new_place[row]);
        std::sort(front.changed.begin(), front.changed.end());
        if (front.parent < 0)
          continue;
        front.level = fronts[front.parent].level + 1;
        set_places(front, fronts[front.parent]);
      }
    return tree;
  }



  void
  deal_out(FrontTree &tree, const unsigned int n_processes)
  {
    std::vector<Front> &fronts   = tree.fronts;
    const int           n_fronts = fronts.size();
    // Of each front and all below.
    std::vector<double> work(n_fronts, 0.);
    std::vector<int>    subtrees; // that lie below no other one
    for (int f = 0; f < n_fronts; ++f)
      {
        work[f] += fronts[f].operations();
        if (fronts[f].parent >= 0)
          work[fronts[f].parent] += work[f];
        else
          subtrees.push_back(f);
      }

    double                    shortest = std::numeric_limits<double>::max();
    double                    above    = 0; // operations
    std::vector<unsigned int> owner(n_fronts, 0);
    while (!subtrees.empty())
      {
        // Largest first, each to the process that has least.
        std::sort(subtrees.begin(),
                  subtrees.end(),
                  [&](const int a, const int b) {
                    return work[a] > work[b] || (work[a] == work[b] && a < b);
                  });
        std::vector<double>       loads(n_processes, 0.);
        std::vector<unsigned int> taker(n_fronts, n_processes);
        for (const int f : subtrees)
          {
            const auto least = std::min_element(loads.begin(), loads.end());
            *least += work[f];
            taker[f] = least - loads.begin();
          }
        const double time =
          above + *std::max_element(loads.begin(), loads.end());
        if (time < shortest)
          {
            shortest = time;
            owner    = taker;
          }
        // More pieces, unless what is above them takes too long already.
        const int largest = subtrees.front();
        above += fronts[largest].operations();
        if (above >= shortest || fronts[largest].children.empty())
          break;
        subtrees.erase(subtrees.begin());
        subtrees.insert(subtrees.end(),
                        fronts[largest].children.begin(),
                        fronts[largest].children.end());
      }

    for (int f = n_fronts - 1; f >= 0; --f)
      fronts[f].owner = owner[f] < n_processes || fronts[f].parent < 0 ?
                          owner[f] :
                          fronts[fronts[f].parent].owner;
    for (int f = 0; f < n_fronts; ++f)
      if (fronts[f].owner == n_processes)
        fronts[f].owner =
          fronts[*std::max_element(fronts[f].children.begin(),
                                   fronts[f].children.end(),
                                   [&](const int a, const int b) {
                                     return work[a] < work[b];
                                   })]
            .owner;

    int n_messages = 0;
    for (Front &front : fronts)
      if (front.parent >= 0 && fronts[front.parent].owner != front.owner)
        front.message = n_messages++;
  }
} // namespace NPT
