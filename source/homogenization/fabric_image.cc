// SPDX-License-Identifier: LGPL-2.1-or-later
// Images of the cell in the fabric.

#include <npt_dealii/homogenization/cell_modes.h>
#include <npt_dealii/homogenization/fabric_image.h>

namespace NPT
{
  dealii::Point<3>
  image_in_fabric(const SymmetryOperation                   &g,
                  const dealii::Point<3>                    &x,
                  const dealii::Point<3>                    &Z,
                  const Gradients                           &H,
                  const std::optional<dealii::Tensor<1, 2>> &bends_along)
  {
    if (bends_along)
      return dealii::Point<3>(image_on_cylinder(*bends_along, H, g, x));
    dealii::Tensor<1, 3> jump;
    for (unsigned int n = 0; n < H.size(); ++n)
      if (H[n] != 0.)
        jump += H[n] * macroscopic_jump(n, g, Z);
    return g(x) + jump;
  }
} // namespace NPT
