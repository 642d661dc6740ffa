// SPDX-License-Identifier: LGPL-2.1-or-later
// Pressure, friction and the sticking zone at the end of a stage.

#include <npt_dealii/verification/contact/contact_results.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace NPT
{
  using dealii::Point;
  using dealii::Tensor;

  ContactResults::ContactResults(const std::vector<ContactRow> &rows,
                                 const DeformableBodies        &bodies,
                                 const ContactPair<3>          &contact,
                                 const ContactEvaluation<3>    &evaluation,
                                 const dealii::Vector<double>  &u)
    : rows_(rows)
    , bodies_(bodies)
    , contact_(contact)
    , evaluation_(evaluation)
    , u_(u)
  {}



  std::vector<ContactSample>
  ContactResults::samples() const
  {
    // C_c = sum_I W_I p^I dg^I = int (sum_I p^I R^I) dg dA: the traction at a
    // Gauss point is what its area carries.
    const auto                &points = contact_.quadrature_points();
    std::vector<ContactSample> result(points.size());
    for (unsigned int I = 0; I < contact_.n_nodes(); ++I)
      {
        const auto &state = evaluation_.nodes[I];
        const auto &node  = contact_.averaging().nodes()[I];
        if (!state.active)
          continue;
        const Tensor<1, 3> traction =
          contact_.friction_traction(evaluation_, I);
        for (const auto &entry : node.entries)
          {
            // R^I at the point.
            const double value =
              node.area * entry.weight / points[entry.point].area;
            result[entry.point].pressure -= value * state.pressure;
            result[entry.point].traction += value * traction;
          }
      }
    for (unsigned int q = 0; q < points.size(); ++q)
      {
        ContactSample &sample = result[q];
        const auto    &shape  = points[q].shape;
        for (unsigned int l = 0; l < shape.lattice.size(); ++l)
          {
            const unsigned int A =
              contact_.secondary().surface().control_point(shape.lattice[l]);
            Point<3> x = bodies_.space().control_points()[A];
            for (unsigned int c = 0; c < 3; ++c)
              x[c] += u_[3 * A + c];
            sample.x += shape.value[l] * x;
          }
        sample.area = points[q].area;
      }
    return result;
  }



  double
  ContactResults::stick_radius(const bool in_plane) const
  {
    // Between the outermost sticking and the innermost slipping node.
    double outermost = 0, innermost = std::numeric_limits<double>::max();
    for (unsigned int I = 0; I < contact_.n_nodes(); ++I)
      {
        const auto &state = evaluation_.nodes[I];
        if (!state.active)
          continue;
        Tensor<1, 3> x;
        for (const auto &entry : contact_.averaging().nodes()[I].entries)
          x += entry.weight * contact_.quadrature_points()[entry.point].X;
        const double r = in_plane ? std::abs(x[0]) : std::hypot(x[0], x[1]);
        if (state.slipping)
          innermost = std::min(innermost, r);
        else
          outermost = std::max(outermost, r);
      }
    return 0.5 * (outermost + std::min(innermost, 1e3 * outermost));
  }
} // namespace NPT
