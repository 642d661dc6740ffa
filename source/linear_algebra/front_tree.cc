// SPDX-License-Identifier: LGPL-2.1-or-later
// The tree of fronts, from the pattern of a matrix.

#include <npt_dealii/linear_algebra/front_tree.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

namespace NPT
{
  namespace
  {
    /// Blocks in the order of elimination.
    struct Sequence
    {
      std::vector<int> block; // at each place

      const BlockPattern &pattern;

      int
      n() const
      {
        return block.size();
      }
      int
      size(const int place) const
      {
        return pattern.size(block[place]);
      }
    };



    /**
     * Return for each column of blocks of L, in the order of elimination, the
     * rows below it that are not zero, ascending: those of the matrix and
     * those of the columns whose first row this one is.
     */
    std::vector<std::vector<int>>
    rows_of_factor(const Sequence &sequence)
    {
      const BlockPattern           &pattern = sequence.pattern;
      const int                     n       = sequence.n();
      std::vector<std::vector<int>> rows(n), first_row_is(n);
      std::vector<int>              place(n);
      for (int j = 0; j < n; ++j)
        place[sequence.block[j]] = j;
      for (int j = 0; j < n; ++j)
        for (int k = pattern.row_start[sequence.block[j]];
             k < pattern.row_start[sequence.block[j] + 1];
             ++k)
          if (place[pattern.neighbors[k]] > j)
            rows[j].push_back(place[pattern.neighbors[k]]);
      std::vector<int> all;
      for (int j = 0; j < n; ++j)
        {
          std::sort(rows[j].begin(), rows[j].end());
          for (const int child : first_row_is[j])
            {
              all.clear();
              // The first row of a child is j itself.
              std::set_union(rows[j].begin(),
                             rows[j].end(),
                             rows[child].begin() + 1,
                             rows[child].end(),
                             std::back_inserter(all));
              rows[j].assign(all.begin(), all.end());
            }
          if (!rows[j].empty())
            first_row_is[rows[j].front()].push_back(j);
        }
      return rows;
    }



    // Columns of blocks of L with (nearly) the same rows below them.
    struct Group
    {
      std::vector<int> pivots;  // places in the sequence, ascending
      std::vector<int> changed; // rows below, ascending
      // Unknowns in them.
      double           n_pivots  = 0;
      double           n_changed = 0;
      int              parent    = -1;
      std::vector<int> children;
      double           n_zeros = 0;     // stored and not needed
      bool             is_part = false; // of its parent
    };

    /// Neighboring columns of which the second has the rows of the first.
    std::vector<Group>
    equal_columns(std::vector<std::vector<int>> &rows, const Sequence &blocks)
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
          groups.back().n_pivots += blocks.size(j);
          group_of[j] = groups.size() - 1;
        }
      for (unsigned int g = 0; g < groups.size(); ++g)
        {
          Group &group  = groups[g];
          group.changed = std::move(rows[group.pivots.back()]);
          for (const int row : group.changed)
            group.n_changed += blocks.size(row);
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
                  groups[c].n_pivots *
                    (parent.n_pivots + parent.n_changed - groups[c].n_changed) +
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
            const double n_pivots = child.n_pivots + parent.n_pivots;
            const double zeros    = least + parent.n_zeros;
            const double stored =
              n_pivots * (0.5 * n_pivots + parent.n_changed);
            const double share = zeros / stored;
            if (share <= 0.05 || (n_pivots <= 48 && share <= 0.2) ||
                (n_pivots <= 16 && share <= 0.5))
              {
                child.is_part = true;
                parent.pivots.insert(parent.pivots.begin(),
                                     child.pivots.begin(),
                                     child.pivots.end());
                parent.n_pivots = n_pivots;
                parent.n_zeros  = zeros;
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
      for (const int place : front.changed)
        front.places.push_back(parent.local(place));
    }
  } // namespace



  int
  Front::local(const int place) const
  {
    if (place < first + n)
      return place - first;
    return n + (std::lower_bound(changed.begin(), changed.end(), place) -
                changed.begin());
  }



  double
  Front::operations() const
  {
    const double pivots = n, others = m - n;
    return pivots * (2. / 3. * pivots * pivots + 2 * pivots * others +
                     2 * others * others);
  }



  double
  Front::work() const
  {
    const double pivots = n, rows = m;
    return operations() + 80 * rows * rows + 300 * pivots * rows;
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
  make_front_tree(const BlockPattern &pattern, const std::vector<int> &order)
  {
    Sequence blocks{std::vector<int>(pattern.n()), pattern};
    for (int b = 0; b < pattern.n(); ++b)
      blocks.block[order.empty() ? b : order[b]] = b;
    std::vector<std::vector<int>> rows   = rows_of_factor(blocks);
    std::vector<Group>            groups = equal_columns(rows, blocks);
    join(groups);
    const std::vector<int> sequence = sequence_of(groups);

    FrontTree           tree;
    std::vector<Front> &fronts = tree.fronts;
    fronts.resize(sequence.size());
    tree.position.resize(pattern.unknowns.size());
    std::vector<int> begin(blocks.n()); // place of the first unknown
    std::vector<int> front_of_group(groups.size(), -1);
    int              next = 0;
    for (unsigned int f = 0; f < fronts.size(); ++f)
      {
        const Group &group          = groups[sequence[f]];
        front_of_group[sequence[f]] = f;
        fronts[f].first             = next;
        fronts[f].n                 = group.n_pivots;
        fronts[f].m                 = fronts[f].n + group.n_changed;
        for (const int column : group.pivots)
          {
            begin[column]   = next;
            const int block = blocks.block[column];
            for (int k = pattern.first[block]; k < pattern.first[block + 1];
                 ++k)
              tree.position[pattern.unknowns[k]] = next++;
          }
        for (const int child : group.children)
          {
            const int c = front_of_group[child];
            fronts[f].children.push_back(c);
            fronts[c].parent = f;
          }
        std::sort(fronts[f].children.begin(), fronts[f].children.end());
      }

    for (int f = fronts.size() - 1; f >= 0; --f)
      {
        Front &front = fronts[f];
        for (const int row : groups[sequence[f]].changed)
          for (int k = 0; k < blocks.size(row); ++k)
            front.changed.push_back(begin[row] + k);
        std::sort(front.changed.begin(), front.changed.end());
        if (front.parent < 0)
          continue;
        front.level = fronts[front.parent].level + 1;
        set_places(front, fronts[front.parent]);
      }
    return tree;
  }



  // Time of a front on n processes, in parts of an n-th of that on one, about.
  constexpr double price_of_sharing = 1.3;



  void
  deal_out(FrontTree &tree, const unsigned int n_processes)
  {
    if (n_processes == 1)
      return;
    std::vector<Front> &fronts   = tree.fronts;
    const int           n_fronts = fronts.size();
    // Of each front and all below.
    std::vector<double> work(n_fronts, 0.);
    std::vector<int>    subtrees; // that lie below no other one
    for (int f = 0; f < n_fronts; ++f)
      {
        work[f] += fronts[f].work();
        if (fronts[f].parent >= 0)
          work[fronts[f].parent] += work[f];
        else
          subtrees.push_back(f);
      }

    double                    shortest = std::numeric_limits<double>::max();
    double                    above    = 0; // work
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
        const double time = price_of_sharing * above / n_processes +
                            *std::max_element(loads.begin(), loads.end());
        if (time < shortest)
          {
            shortest = time;
            owner    = taker;
          }
        const int largest = subtrees.front();
        if (fronts[largest].children.empty())
          break;
        above += fronts[largest].work();
        subtrees.erase(subtrees.begin());
        subtrees.insert(subtrees.end(),
                        fronts[largest].children.begin(),
                        fronts[largest].children.end());
      }

    for (int f = n_fronts - 1; f >= 0; --f)
      {
        const bool is_below =
          fronts[f].parent >= 0 && !fronts[fronts[f].parent].is_shared;
        fronts[f].owner = is_below ? fronts[fronts[f].parent].owner : owner[f];
        fronts[f].is_shared = fronts[f].owner == n_processes;
      }
  }
} // namespace NPT
