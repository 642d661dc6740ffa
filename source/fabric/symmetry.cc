// SPDX-License-Identifier: LGPL-2.1-or-later
// Isometries of a woven structure.

#include <npt_dealii/fabric/symmetry.h>

namespace NPT
{
  using dealii::Tensor;

  SymmetryOperation
  SymmetryOperation::identity()
  {
    return translation("", Tensor<1, 3>());
  }



  SymmetryOperation
  SymmetryOperation::translation(const std::string &name, const Tensor<1, 3> &a)
  {
    return {name, Tensor<1, 3>({1., 1., 1.}), a};
  }



  SymmetryOperation
  SymmetryOperation::glide_plane(const std::string &name, const Tensor<1, 3> &a)
  {
    return {name, Tensor<1, 3>({1., 1., -1.}), a};
  }



  SymmetryOperation
  SymmetryOperation::mirror_plane(const std::string  &name,
                                  const unsigned int  direction,
                                  const Tensor<1, 3> &a)
  {
    AssertIndexRange(direction, 2);
    SymmetryOperation result = translation(name, a);
    result.Q[direction]      = -1.;
    return result;
  }



  SymmetryOperation
  SymmetryOperation::two_fold_axis()
  {
    return {"2-fold axis along Y3",
            Tensor<1, 3>({-1., -1., 1.}),
            Tensor<1, 3>()};
  }



  SymmetryOperation
  SymmetryOperation::then(const SymmetryOperation &next) const
  {
    SymmetryOperation result;
    result.name = name.empty()      ? next.name :
                  next.name.empty() ? name :
                                      name + ", then " + next.name;
    for (unsigned int i = 0; i < 3; ++i)
      {
        result.Q[i] = next.Q[i] * Q[i];
        result.a[i] = next.Q[i] * a[i] + next.a[i];
      }
    return result;
  }
} // namespace NPT
