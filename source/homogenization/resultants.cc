// SPDX-License-Identifier: LGPL-2.1-or-later
// Volume averages and the contact dipole.

#include <npt_dealii/homogenization/resultants.h>

namespace NPT
{
  using dealii::Tensor;

  Resultants
  complete_by_symmetry(const FabricCell &cell, const Resultants &sum)
  {
    Resultants result;
    result.N = sum.N / cell.area();
    result.M = sum.M / cell.area();
    for (const SymmetryOperation &g : cell.operations())
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          {
            if (g.Q[i] * g.Q[j] < 0)
              result.N[i][j] = 0;
            if (g.Q[i] * g.Q[j] * g.Q[2] < 0)
              result.M[i][j] = 0;
          }
    return result;
  }



  Tensor<2, 3>
  contact_dipole(const FabricCell                 &cell,
                 const IGASpace<3>                &space,
                 const std::vector<PeriodicImage> &images,
                 const dealii::Vector<double>     &contact_force)
  {
    Resultants sum;
    const auto add = [&](const unsigned int first, const dealii::Point<3> &X) {
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          sum.N[i][j] += contact_force[first + i] * X[j];
    };
    for (unsigned int A = 0; A < space.n_control_points(); ++A)
      add(3 * A, space.control_points()[A]);
    for (const PeriodicImage &periodic_image : images)
      for (unsigned int l = 0; l < periodic_image.reference.size(); ++l)
        add(periodic_image.first_unknown + 3 * l, periodic_image.reference[l]);
    return complete_by_symmetry(cell, sum).N;
  }
} // namespace NPT
