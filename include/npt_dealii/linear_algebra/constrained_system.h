// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the linear system in the independent unknowns: what AffineConstraints
// leave free, with fast assembly and prescribed values.

#ifndef npt_dealii_linear_algebra_constrained_system_h
#define npt_dealii_linear_algebra_constrained_system_h

#include <npt_dealii/linear_algebra/csr_matrix.h>
#include <npt_dealii/linear_algebra/unknown_map.h>

#include <deal.II/lac/affine_constraints.h>

#include <memory>
#include <set>
#include <vector>

namespace NPT
{
  /**
   * With homogeneous AffineConstraints every unknown is a linear combination
   * of independent ones, u = C m. This class numbers the m, keeps C, and
   * assembles C^T K C and C^T r from element contributions.
   *
   * Loads enter through independent unknowns with prescribed values (macro
   * unknowns, weaving offset), never through inhomogeneities, so C stays
   * fixed within a stage and reactions are entries of C^T r.
   *
   * With an UnknownMap the constraints hold for other unknowns v, and
   *
   * @f[ u = u(v), \quad v = C m, \qquad
   *     C^T G^T K G C, \quad C^T G^T r, \qquad G = du/dv @f]
   *
   * take their places, with G at the state of the last linearize(). Groups may
   * then contain the v as well, by row_of_v(), for the second derivatives of
   * the map.
   *
   * Groups of unknowns that recur (cells) are registered once; their positions
   * in the matrix are computed with the pattern.
   */
  class ConstrainedSystem
  {
  public:
    /// Number the independent unknowns. Forgets groups, couplings and pattern.
    /// @param map If given, what the constraints relate is v of u = u(v).
    void
    reinit(const dealii::AffineConstraints<double> &constraints,
           const unsigned int                       n_unknowns,
           std::shared_ptr<const UnknownMap>        map = nullptr);

    unsigned int
    n_independent() const
    {
      return independent_.size();
    }
    /// Full index of independent unknown k.
    unsigned int
    unknown(const unsigned int k) const
    {
      return independent_[k];
    }
    /// Number of an unknown among the independent ones, or -1.
    int
    independent_index(const unsigned int unknown) const
    {
      return index_[unknown];
    }

    /// What stands for v_k in a group; k itself if u is v.
    unsigned int
    row_of_v(const unsigned int k) const
    {
      return map_ ? index_.size() + k : k;
    }
    /// Take G at a state from now on; nothing to do where u is v.
    void
    linearize(const dealii::Vector<double> &u);

    /// u = C m, or u(C m).
    void
    expand(const dealii::Vector<double> &m, dealii::Vector<double> &u) const;
    /// C^T r, or C^T G^T r.
    void
    condense(const dealii::Vector<double> &r,
             dealii::Vector<double>       &condensed) const;
    /// Pick the independent entries of a full vector, or of v(u).
    void
    restrict_to_independent(const dealii::Vector<double> &u,
                            dealii::Vector<double>       &m) const;

    /// Register a recurring group; returns its number.
    unsigned int
    add_group(const std::vector<unsigned int> &unknowns);

    /**
     * Build the pattern of all groups and of further couplings (contact).
     * Those given before stay, so that contact points that move to and fro do
     * not change the pattern each time. Sets the matrix to zero.
     */
    void
    build_pattern(const std::vector<std::vector<unsigned int>> &couplings = {});

    /// All couplings that the pattern has by now. A pattern built from them
    /// again is the same.
    const std::set<std::vector<unsigned int>> &
    couplings() const
    {
      return couplings_;
    }

    /// Whether there is a pattern for the present groups and couplings.
    bool
    has_pattern() const
    {
      return has_pattern_;
    }
    /// Let the pattern be built again before the next assembly, with all
    /// couplings given so far.
    void
    forget_pattern()
    {
      has_pattern_ = false;
    }

    /// @param free_only Columns of prescribed unknowns are not needed this
    /// time,
    ///   and need not be computed.
    void
    set_zero(const bool free_only = false);
    /// Add factor * C^T K C of a registered group.
    void
    add(const unsigned int         group,
        const std::vector<double> &K,
        const double               factor = 1.);
    /// Add for arbitrary unknowns; false if the pattern lacks an entry (then
    /// the caller must rebuild the pattern and assemble again).
    bool
    add(const std::vector<unsigned int> &unknowns,
        const std::vector<double>       &K);

    /// Add to the row and the column of an independent unknown r_k for all
    /// unknowns k; where r_k is not zero, a group must have both.
    void
    add_border(const unsigned int unknown, const dealii::Vector<double> &r);

    /// C^T K C over all independent unknowns.
    const CSRMatrix &
    matrix() const
    {
      return matrix_;
    }

    /**
     * Declare which independent unknowns have prescribed values. The others
     * are free.
     */
    void
    set_prescribed(const std::vector<bool> &prescribed);
    unsigned int
    n_free() const
    {
      return free_.size();
    }
    /// Independent number of free unknown k.
    unsigned int
    free_unknown(const unsigned int k) const
    {
      return free_[k];
    }
    /// The block of the free unknowns, with the present values.
    const CSRMatrix &
    free_matrix();

  private:
    // The unknowns of one element matrix and where it goes. Rows with the same
    // columns, such as those of the components of a control point, share what
    // is stored of positions; and neighboring columns are neighbors in every
    // row that has both.
    struct Group
    {
      unsigned int        n_unknowns;
      std::vector<int>    columns;        // sorted independent numbers
      std::vector<int>    unknown;        // entries of C: unknown of the group,
      std::vector<int>    local;          // position in columns,
      std::vector<double> coefficient;    // and value
      std::vector<int>    entry;          // with a map: where that stands
      bool                is_permutation; // entry k is all of column local[k]
      std::vector<int>    run_start; // runs of neighbors in columns, and end
      std::vector<int>    list;      // per column as row: which list
      std::vector<int>    offsets;   // list by run: start of a run in the row
    };
    void
    make_group(const std::vector<unsigned int> &unknowns, Group &group) const;
    bool
    find_positions(Group &group) const;
    void
    sum_rows(const Group         &group,
             const double        *rows,
             const std::size_t    length,
             std::vector<double> &sums) const;
    void
    add(const Group &group, const std::vector<double> &K, const double factor);

    void
    add_row(const dealii::AffineConstraints<double> &constraints,
            const unsigned int                       i);

    // C in compressed rows over all unknowns; with a map the rows of G C, then
    // those of C.
    std::vector<int>          row_start_;
    std::vector<int>          row_column_;
    std::vector<double>       row_value_;
    std::vector<unsigned int> independent_;
    std::vector<int>          index_;

    // Values of G C are products of an entry of C and one of G.
    std::shared_ptr<const UnknownMap> map_;
    std::vector<double>               map_factor_, gradients_;
    std::vector<int>                  map_gradient_;
    bool                              groups_lag_ = false;

    std::vector<Group>                  groups_;
    std::set<std::vector<unsigned int>> couplings_;
    CSRMatrix                           matrix_;
    bool                                has_pattern_ = false;
    std::vector<int>                    row_group_; // of equal columns
    Group                               group_; // of add() without registration
    mutable std::vector<int>            place_; // per independent unknown
    std::vector<double> transposed_, rows_condensed_, condensed_;

    std::vector<bool> prescribed_;
    bool free_only_ = false; // columns of prescribed unknowns are left out
    std::vector<unsigned int> free_;
    CSRMatrix                 free_matrix_;
    struct Run
    {
      int begin, end; // in a row of the matrix
    };
    std::vector<std::vector<Run>> free_runs_; // of columns, by group of rows
    std::size_t                   free_pattern_of_ = 0;
  };
} // namespace NPT

#endif
