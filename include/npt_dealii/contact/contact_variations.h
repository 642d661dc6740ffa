// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines how the variations of one contact point reach the unknowns.

#ifndef npt_dealii_contact_contact_variations_h
#define npt_dealii_contact_contact_variations_h

#include <npt_dealii/contact/geometry/contact_kinematics.h>

namespace NPT
{
  /**
   * Unknowns and jet values at one Gauss point: functions of the secondary
   * surface, of the primary one at the closest point, and, where these are
   * others, at the reference point of slip.
   */
  template <int dim>
  struct PointFunctions
  {
    std::vector<unsigned int> dofs;      ///< first unknown of each function
    std::vector<unsigned int> reference; ///< functions of the reference point
    /// jet[f] holds the value of functional f for each function.
    std::array<std::vector<double>, ContactKinematics<dim>::n_jets> jet;
  };

  /**
   * First variations of a point, or their averages at a node, on the control
   * points: row 0 of the gap, then of the components of the slip, then, if it
   * varies, of the metric.
   */
  template <int dim>
  struct Variations
  {
    using Rows = std::array<std::vector<double>,
                            1 + (dim - 1) + ContactKinematics<dim>::n_metric>;

    std::vector<unsigned int> dofs; ///< first unknown of each function
    Rows                      rows;
  };

  /// Carry a linear form of the jets to the functions of a point.
  template <int dim>
  void
  jets_to_functions(const typename ContactKinematics<dim>::Row &jets,
                    const PointFunctions<dim>                  &functions,
                    std::vector<double>                        &row)
  {
    const unsigned int n_functions = functions.dofs.size();
    row.assign(dim * n_functions, 0.);
    for (unsigned int f = 0; f < ContactKinematics<dim>::n_jets; ++f)
      for (unsigned int A = 0; A < n_functions; ++A)
        if (functions.jet[f][A] != 0.)
          for (unsigned int i = 0; i < dim; ++i)
            row[A * dim + i] += functions.jet[f][A] * jets[f * dim + i];
  }
} // namespace NPT

#endif
