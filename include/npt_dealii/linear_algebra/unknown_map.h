// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines a change of unknowns that is not linear, between the unknowns of a
// problem and those that its constraints relate.

#ifndef npt_dealii_linear_algebra_unknown_map_h
#define npt_dealii_linear_algebra_unknown_map_h

#include <deal.II/lac/vector.h>

#include <vector>

namespace NPT
{
  /**
   * A one-to-one map u = u(v) between the unknowns u in which forces are
   * computed and as many unknowns v with the same numbers, which obey linear
   * constraints, v = C m. Every u_i depends on a few v_j, always the same.
   */
  class UnknownMap
  {
  public:
    virtual ~UnknownMap() = default;

    virtual void
    apply(const dealii::Vector<double> &v, dealii::Vector<double> &u) const = 0;

    virtual void
    invert(const dealii::Vector<double> &u,
           dealii::Vector<double>       &v) const = 0;

    /// Of each u_i: the numbers of the v_j on which it depends.
    virtual std::vector<std::vector<unsigned int>>
    arguments() const = 0;

    /// du_i/dv_j for all arguments of u_0, then those of u_1, ...
    virtual void
    gradients(const dealii::Vector<double> &v,
              std::vector<double>          &values) const = 0;
  };
} // namespace NPT

#endif
