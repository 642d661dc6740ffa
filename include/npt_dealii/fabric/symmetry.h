// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the isometries that map a woven structure onto itself.

#ifndef npt_dealii_fabric_symmetry_h
#define npt_dealii_fabric_symmetry_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <string>

namespace NPT
{
  /**
   * An isometry Y -> Q Y + a that maps the woven structure onto itself, Q
   * diagonal with entries +1, -1. Displacements of the structure obey
   *
   * @f[ w(QY + a) = Q\,w(Y) + [ w_m(QY + a) - Q\,w_m(Y) ] @f]
   *
   * with the macroscopic field w_m of theory, section 2; see
   * macroscopic_jump() in homogenization/cell_modes.h.
   */
  struct SymmetryOperation
  {
    std::string          name;
    dealii::Tensor<1, 3> Q; ///< diagonal
    dealii::Tensor<1, 3> a; ///< [mm]

    /// The operation that changes nothing; its name is empty.
    static SymmetryOperation
    identity();

    static SymmetryOperation
    translation(const std::string &name, const dealii::Tensor<1, 3> &a);

    /// A mirror at the mid-plane after a shift along it.
    static SymmetryOperation
    glide_plane(const std::string &name, const dealii::Tensor<1, 3> &a);

    /// A mirror that reverses direction 0 (Y1) or 1 (Y2), then a shift.
    static SymmetryOperation
    mirror_plane(const std::string          &name,
                 const unsigned int          direction,
                 const dealii::Tensor<1, 3> &a);

    /// By 180 degrees about the axis Y3 through the origin.
    static SymmetryOperation
    two_fold_axis();

    /// First this operation, then another.
    SymmetryOperation
    then(const SymmetryOperation &next) const;

    /// Whether it turns bottom and top over.
    bool
    turns_over() const
    {
      return Q[2] < 0;
    }

    dealii::Point<3>
    operator()(const dealii::Point<3> &Y) const
    {
      dealii::Point<3> result;
      for (unsigned int i = 0; i < 3; ++i)
        result[i] = Q[i] * Y[i] + a[i];
      return result;
    }
  };
} // namespace NPT

#endif
