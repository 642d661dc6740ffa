// SPDX-License-Identifier: LGPL-2.1-or-later
// Building a fabric cell, and what can be said of its states.

#include <npt_dealii/problems/plate_test/plate_cell.h>

#include <deal.II/base/tensor.h>

#include <string>
#include <utility>

namespace NPT
{
  using dealii::Point;
  using dealii::Tensor;
  using dealii::Vector;

  namespace
  {
    DeformableBodies
    make_bundles(const FabricCell          &cell,
                 const PlateTestParameters &parameters,
                 const Ranks               &ranks)
    {
      std::vector<DeformablePart> parts;
      for (const FiberBundle &bundle : cell.bundles())
        parts.push_back(
          {bundle.patch,
           make_material<3>(bundle.family == FiberBundle::Family::weft ?
                              parameters.weft_material :
                              parameters.material,
                            bundle.direction),
           bundle.body,
           "bundle " + std::to_string(parts.size())});
      // A cell and its image under the 2-fold axis do the same work: one of
      // them is integrated, twice.
      return DeformableBodies(
        std::move(parts),
        parameters.mesh.basis,
        0,
        [&](const unsigned int bundle, const Point<3> &center) {
          return cell.symmetry_weight(bundle, center);
        },
        ranks);
    }
  } // namespace



  PlateCell::PlateCell(const PlateTestParameters &parameters,
                       const Ranks               &ranks)
    : fabric_(parameters.cell, parameters.mesh)
    , bodies_(make_bundles(fabric_, parameters, ranks))
    , macro_(bodies_.space().n_control_points())
    , contacts_(make_cell_contacts(fabric_,
                                   bodies_.space(),
                                   parameters.contact,
                                   parameters.friction,
                                   parameters.cell.bundle_thickness.smaller(),
                                   macro_))
  {}



  unsigned int
  PlateCell::n_contact_nodes() const
  {
    unsigned int n = 0;
    for (const auto &pair : contacts())
      n += pair->averaging().nodes().size();
    return n;
  }



  State
  PlateCell::initial_state() const
  {
    State state;
    state.applied.assign(MacroUnknowns::n_modes, 0.);
    state.reactions.assign(MacroUnknowns::n_driven, 0.);
    state.u.reinit(macro_.n_unknowns());
    state.u[macro_.weaving_offset()] = fabric_.weaving_offset();
    for (const PeriodicImage &image : images())
      for (unsigned int l = 0; l < image.control_points.size(); ++l)
        state.u[image.first_unknown + 3 * l + 2] =
          image.offset_sign * fabric_.weaving_offset();
    for (const auto &pair : contacts())
      state.contact.push_back(pair->initial_state());
    return state;
  }



  std::vector<Point<3>>
  PlateCell::woven_positions(const Vector<double> &u) const
  {
    const auto            weight = bodies_.integrals_of_functions(true);
    const auto           &X      = bodies_.space().control_points();
    std::vector<Point<3>> woven  = X;
    double                mean = 0, volume = 0;
    for (unsigned int A = 0; A < woven.size(); ++A)
      {
        Tensor<1, 3> w;
        for (unsigned int i = 0; i < 3; ++i)
          w[i] = u[3 * A + i];
        for (unsigned int n = 0; n < MacroUnknowns::n_modes; ++n)
          w -= u[macro_.mode(n)] * macroscopic_displacement(n, X[A]);
        woven[A] += w;
        mean += weight[A] * woven[A][2];
        volume += weight[A];
      }
    for (Point<3> &Z : woven)
      Z[2] -= mean / volume;
    return woven;
  }



  std::shared_ptr<const ObjectiveJumps>
  PlateCell::objective_jumps(const Tensor<1, 2> &direction) const
  {
    return std::make_shared<ObjectiveJumps>(
      fabric_, bodies_.space(), macro_, images(), direction);
  }



  Resultants
  PlateCell::averages(const Vector<double>              &u,
                      const std::vector<Point<3>>       &woven,
                      const std::optional<Tensor<1, 2>> &bends_along,
                      const NaturalState                &natural) const
  {
    const Gradients     H = gradients_of(macro_, u);
    std::vector<double> Y1, Y2;
    for (const Point<3> &Y : bodies_.space().control_points())
      {
        Y1.push_back(Y[0]);
        Y2.push_back(Y[1]);
      }
    const auto turned_back = [&](const DeformableBodies::MaterialPoint &point) {
      if (!bends_along)
        return point.P;
      const Tensor<1, 2> place(
        {bodies_.interpolate(point, Y1), bodies_.interpolate(point, Y2)});
      return transpose(CylinderMotion(*bends_along).at(H, place).R) * point.P;
    };
    std::vector<double> Z3;
    for (const Point<3> &Z :
         woven.empty() ? bodies_.space().control_points() : woven)
      Z3.push_back(Z[2]);
    Resultants sum;
    bodies_.for_each_point(
      u,
      [&](const auto &point) {
        const Tensor<2, 3> P = turned_back(point);
        sum.N += P * point.dV;
        sum.M += bodies_.interpolate(point, Z3) * P * point.dV;
      },
      natural);
    for (dealii::Tensor<2, 3> *average : {&sum.N, &sum.M})
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          (*average)[i][j] = bodies_.ranks().sum((*average)[i][j]);
    return complete_by_symmetry(fabric_, sum);
  }
} // namespace NPT
