// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines factors of a matrix by MUMPS, of double or of single precision.

#ifndef npt_dealii_linear_algebra_mumps_factors_h
#define npt_dealii_linear_algebra_mumps_factors_h

#include <npt_dealii/base/large_pages.h>
#include <npt_dealii/base/ranks.h>
#include <npt_dealii/linear_algebra/csr_matrix.h>

#include <deal.II/lac/vector.h>

#include <dmumps_c.h>
#include <smumps_c.h>

#include <string>
#include <vector>

namespace NPT
{
  /// MUMPS in the precision of Number.
  template <typename Number>
  struct MUMPSLibrary;

  template <>
  struct MUMPSLibrary<double>
  {
    using Data                      = DMUMPS_STRUC_C;
    static constexpr auto *function = &dmumps_c;
  };

  template <>
  struct MUMPSLibrary<float>
  {
    using Data                      = SMUMPS_STRUC_C;
    static constexpr auto *function = &smumps_c;
  };



  /// Factors of a matrix, whatever their precision.
  class MUMPSFactors
  {
  public:
    virtual ~MUMPSFactors() = default;

    /// x = A^{-1} b within the precision of the factors.
    virtual void
    solve(const dealii::Vector<double> &b, dealii::Vector<double> &x) = 0;

    /// Of the factors and the workspace, on all processes, as the analysis
    /// foresees.
    virtual double
    gigabytes() const = 0;

    /// Whether the factors are files (in $MUMPS_OOC_TMPDIR, /tmp), because
    /// they do not fit in the memory.
    virtual bool
    are_on_disk() const = 0;
  };



  /**
   * One instance of MUMPS: L U for a general matrix, or L D L^T without
   * pivoting for a positive definite one.
   *
   * Values of double precision are read where they stand, except the lower
   * triangle. Those of single precision are multiplied by a power of two, so
   * that the largest one is between 1 and 2: whatever the units, what is lost
   * is below 1e-38 of the largest entry. Right-hand sides likewise.
   */
  template <typename Number>
  class MUMPSInstance : public MUMPSFactors
  {
  public:
    enum class Kind
    {
      general,
      positive_definite
    };

    /// @param maximum_gigabytes Memory on one machine; 0: what is available.
    MUMPSInstance(const Kind   kind,
                  const double maximum_gigabytes,
                  const Ranks &ranks);
    // Collective: of several processes, one that an error ends alone would
    // wait here for the others, and say nothing.
    ~MUMPSInstance() override;

    MUMPSInstance(const MUMPSInstance &) = delete;
    MUMPSInstance &
    operator=(const MUMPSInstance &) = delete;

    /**
     * The symbolic factorization.
     *
     * @param A     Of several processes each has a part of the entries.
     * @param order Positions of the unknowns, see order_of_unknowns(). Must
     *   stay where it is.
     *
     * Throws OutOfMemory.
     */
    void
    analyze(const CSRMatrix &A, std::vector<int> &order);

    /// Return whether a matrix of that pattern was factorized; a singular one,
    /// and one that is not positive definite for that kind, is not. It is not
    /// needed afterwards.
    bool
    factorize(const CSRMatrix &A);

    void
    solve(const dealii::Vector<double> &b, dealii::Vector<double> &x) override;
    double
    gigabytes() const override;
    bool
    are_on_disk() const override;

  private:
    template <typename Visitor>
    void
    for_each_entry(const CSRMatrix &A, const Visitor &visit) const;
    void
    set_indices(const CSRMatrix &A);
    void
    set_values(const CSRMatrix &A);
    void
    analyze();
    void
    provide_workspace();
    int &
    control(const int number);
    void
    call(const int job);
    void
    check(const std::string &phase) const;

    const Kind                          kind;
    const double                        maximum_memory; // GB
    const Ranks                         ranks;
    int                                 extra_memory; // per cent
    bool                                is_on_disk = false;
    typename MUMPSLibrary<Number>::Data data       = {};
    std::vector<int>                    rows, columns; // from 1
    std::vector<Number>                 values; // unless those of the matrix
    int                                 exponent = 0; // of the power of two
    std::vector<Number>                 solution;     // single precision
    LargePages<Number>                  workspace;    // and factors
  };
} // namespace NPT

#endif
