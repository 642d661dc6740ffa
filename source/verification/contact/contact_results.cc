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
        for (const auto &entry : node.entries) // times R^I at the point
          result[entry.point].pressure -= node.area * entry.weight /
                                          points[entry.point].area *
                                          state.pressure;
      }
    for (unsigned int J = 0; J < contact_.n_friction_nodes(); ++J)
      {
        const auto        &node = contact_.friction_averaging().nodes()[J];
        const Tensor<1, 3> traction =
          contact_.traction_of_friction_node(evaluation_, J);
        for (const auto &entry : node.entries)
          result[entry.point].traction +=
            node.area * entry.weight / points[entry.point].area * traction;
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
    // Between the outermost sticking and the innermost slipping friction node.
    double outermost = 0, innermost = std::numeric_limits<double>::max();
    for (unsigned int J = 0; J < contact_.n_friction_nodes(); ++J)
      {
        const auto &state = evaluation_.friction[J];
        if (!state.active())
          continue;
        Tensor<1, 3> x;
        for (const auto &entry :
             contact_.friction_averaging().nodes()[J].entries)
          x += entry.weight * contact_.quadrature_points()[entry.point].X;
        const double r = in_plane ? std::abs(x[0]) : std::hypot(x[0], x[1]);
        if (state.response.slipping)
          innermost = std::min(innermost, r);
        else
          outermost = std::max(outermost, r);
      }
    return 0.5 * (outermost + std::min(innermost, 1e3 * outermost));
  }
} // namespace NPT
