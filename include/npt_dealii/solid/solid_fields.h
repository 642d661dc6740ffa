// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the fields of deformable bodies for a VTU file.

#ifndef npt_dealii_solid_solid_fields_h
#define npt_dealii_solid_solid_fields_h

#include <npt_dealii/iga/iga_space.h>
#include <npt_dealii/io/vtu_file.h>
#include <npt_dealii/material/hyperelastic_law.h>
#include <npt_dealii/solid/cell_gradients.h>
#include <npt_dealii/solid/natural_state.h>
#include <npt_dealii/solid/solid_kernel.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/lac/vector.h>

#include <memory>
#include <vector>

namespace NPT
{
  /**
   * What is known at a point of a body. A is the unit fiber direction of the
   * law; for a law without a fiber, fiber, stretch and fiber_shear are zero.
   * Where stress has relaxed F is the elastic part F_e.
   */
  struct PointState
  {
    dealii::SymmetricTensor<2, 3> stress;       ///< Cauchy stress [MPa]
    double                        von_mises;    ///< [MPa]
    double                        volume_ratio; ///< J = det F [-]
    dealii::Tensor<1, 3>          fiber;        ///< F A / |F A| [-]
    double                        stretch;      ///< |F A| [-]
    /**
     * tan of the angle between the fiber and the normal F^{-T} A of its cross
     * section, (A.CA A.C^{-1}A - 1)^{1/2}: the amount of simple shear along
     * or across the fiber [-].
     */
    double fiber_shear;
  };

  /// State of a point with the deformation gradient F.
  PointState
  point_state(const HyperelasticLaw<3> &law, const dealii::Tensor<2, 3> &F);

  /**
   * Coefficients of the fields of PointState at the state u, one row per
   * control point. Gauss points know them; each control point gets the mean
   * weighted with its function,
   *
   * @f[ s_A = \int R_A s \, dV \Big/ \int R_A \, dV . @f]
   *
   * Means of the fiber are over the points that have one. A mean of unit
   * vectors is shorter than one where they turn.
   */
  std::vector<PointState>
  states_at_control_points(
    const IGASpace<3>                                      &space,
    const std::vector<std::unique_ptr<HyperelasticLaw<3>>> &laws,
    const GradientsOfCells                                 &gradients,
    const dealii::Vector<double>                           &u,
    const NaturalState                                     &natural = {});

  /**
   * Bundles in the current configuration as Bezier cells, with displacement
   * [mm], Cauchy stress (xx, yy, zz, xy, yz, xz) [MPa], von Mises stress [MPa],
   * volume ratio [-], and, if a law has a fiber, its direction, stretch and
   * shear [-], all from states_at_control_points(), and the number of the
   * bundle.
   */
  BezierMesh
  make_bundle_fields(
    const IGASpace<3>                                      &space,
    const std::vector<std::unique_ptr<HyperelasticLaw<3>>> &laws,
    const GradientsOfCells                                 &gradients,
    const dealii::Vector<double>                           &u,
    const NaturalState                                     &natural = {});
} // namespace NPT

#endif
