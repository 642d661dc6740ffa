// SPDX-License-Identifier: LGPL-2.1-or-later
// What a stage of a plate test accepts: reactions, energies, forces of
// supports.

#include <npt_dealii/homogenization/cell_modes.h>
#include <npt_dealii/problems/plate_test/plate_test_stage.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace NPT
{
  using dealii::Tensor;
  using dealii::Vector;

  namespace
  {
    // The residual leaves out what the pins bear, so that it does work in a
    // rigid motion of the cell, in which images take part.
    double
    largest_pin_force(const PlateCell &cell, const Vector<double> &residual)
    {
      const auto is_free = cell.fabric().free_translations();
      double     largest = 0;
      for (unsigned int i = 0; i < 3; ++i)
        {
          double sum = 0;
          for (unsigned int k = i; k < cell.macro().first; k += 3)
            sum += residual[k];
          for (const PeriodicImage &image : cell.images())
            for (unsigned int l = 0; l < image.control_points.size(); ++l)
              sum += residual[image.first_unknown + 3 * l + i];
          if (is_free[i])
            largest = std::max(largest, std::abs(sum));
        }
      return largest;
    }

    // Of |force| on the control points [N].
    double
    sum_on_bundle(const IGASpace<3>    &space,
                  const unsigned int    bundle,
                  const Vector<double> &force)
    {
      double sum = 0;
      for (unsigned int l = 0; l < space.patch(bundle).n_control_points(); ++l)
        {
          const unsigned int A = space.control_point(bundle, l);
          sum +=
            Tensor<1, 3>({force[3 * A], force[3 * A + 1], force[3 * A + 2]})
              .norm();
        }
      return sum;
    }
  } // namespace



  SupportForces
  PlateTestStage::support_forces(const Increment &increment,
                                 const Trial     &trial) const
  {
    SupportForces forces;
    forces.foundation =
      foundation_.largest_force(trial.u,
                                foundation_share(increment.load_factor));
    if (jumps_ == nullptr)
      forces.pins = largest_pin_force(cell_, trial.residual);
    else
      {
        const Tensor<1, 3> sum = jumps_->sum_in_frames(trial.u, trial.residual);
        const auto         is_free = cell_.fabric().free_translations();
        for (unsigned int i = 0; i < 2; ++i)
          if (is_free[i])
            forces.pins = std::max(forces.pins, std::abs(sum[i]));
        forces.normal = mean_height_.force(trial.u);
      }
    for (unsigned int k = 0; k < contacts().size(); ++k)
      {
        Vector<double> force(cell_.macro().n_unknowns());
        contacts()[k]->add_residual(increment.contact[k],
                                    trial.contact[k],
                                    force);
        forces.contact =
          std::max(forces.contact,
                   sum_on_bundle(cell_.bodies().space(),
                                 cell_.fabric().contacts()[k].secondary_bundle,
                                 force));
      }
    return forces;
  }



  // Linear jumps that bend the cell are not the same for pieces that stand for
  // each other. In a flat state those that turn with the plate are, about the
  // mean height of the cell.
  std::optional<Gradients>
  PlateTestStage::work_of_turning(const Trial &trial) const
  {
    if (!cell_.fabric().integrates_pieces() || jumps_ != nullptr)
      return {};
    const Tensor<1, 2> any({1., 0.});
    const auto         jumps = cell_.objective_jumps(any);
    Vector<double>     u(trial.u);
    jumps->raise(-MeanHeight(cell_, any, 1.).value(u), u);
    return jumps->work_with_gradients(u, trial.residual);
  }



  State
  PlateTestStage::accept(const State     &before,
                         const Increment &increment,
                         const Trial     &trial) const
  {
    State state = EquilibriumProblem::accept(before, increment, trial);
    // Conjugates are the reactions of the macro unknowns over the area. The
    // residual excludes the applied load, so that they are the same for
    // prescribed H and prescribed n. Where the symmetry of the cell forbids a
    // mode its conjugate is zero; the part of the cell that is integrated does
    // not show it.
    const std::optional<Gradients> turning   = work_of_turning(trial);
    const auto                     conjugate = [&](const unsigned int n) {
      const bool bends = MacroModes::table[n].kind == MacroMode::Kind::bending;
      return (turning && bends ? (*turning)[n] :
                                                     trial.condensed[system_.independent_index(
                                   cell_.macro().mode(n))]) /
             cell_.fabric().area();
    };
    const Membrane led = frame_.resultants(increment.load_factor, trial.u);
    for (unsigned int n = 0; n < MacroUnknowns::n_modes; ++n)
      state.reactions.push_back(
        !represents_mode(cell_.fabric(), n) ?
          0. :
          conjugate(n) +
            (resultant_controlled_[n] ? increment.applied[n] : 0.) +
            (n < led.size() ? led[n] : 0.));
    state.reactions.push_back(
      trial
        .condensed[system_.independent_index(cell_.macro().weaving_offset())]);
    state.reactions.push_back(-plates_.force(trial.u));
    add_energies(before, trial, state);
    return state;
  }



  void
  PlateTestStage::add_energies(const State &before,
                               const Trial &trial,
                               State       &state) const
  {
    Energies &energies           = state.energies;
    energies.work                = before.energies.work;
    energies.work_uncertainty    = before.energies.work_uncertainty;
    energies.release_uncertainty = before.energies.release_uncertainty;
    energies.dissipation         = before.energies.dissipation;
    energies.stored = cell_.bodies().stored_energy(state.u, state.natural);
    for (unsigned int k = 0; k < contacts().size(); ++k)
      {
        const ContactSummary summary = contacts()[k]->summary(trial.contact[k]);
        energies.contact += summary.energy;
        energies.friction += summary.friction_energy;
        energies.dissipation += summary.dissipation;
      }
    energies.contact += plates_.energy(state.u);
    if (stage_.type == LoadStage::Type::relax)
      add_relaxation(before, trial, state);
    add_work(before, state);
  }



  // What bodies lose at the displacement before the step and at that behind it,
  // in the mean: exact where it does not change, as over all of a full
  // relaxation. Contact by the trapezoidal rule, which is exact then as well.
  void
  PlateTestStage::add_relaxation(const State &before,
                                 const Trial &trial,
                                 State       &state) const
  {
    const DeformableBodies &bodies   = cell_.bodies();
    Energies               &energies = state.energies;
    const double            loss_before =
      before.energies.stored - bodies.stored_energy(before.u, state.natural);
    const double loss =
      bodies.stored_energy(state.u, before.natural) - energies.stored;
    const double fraction = relaxed_fraction(state.load_factor) -
                            relaxed_fraction(before.load_factor);
    energies.relaxation_rate = relaxation_rate(trial.contact);
    const double rate_before = before.energies.relaxation_rate;
    energies.dissipation +=
      0.5 * (loss_before + loss +
             fraction * (rate_before + energies.relaxation_rate));
    energies.work_uncertainty +=
      0.5 * (std::abs(loss_before - loss) +
             fraction * std::abs(rate_before - energies.relaxation_rate));
  }



  // Of the forces on the macro unknowns, and of the release on the foundation,
  // whose springs it weakens.
  void
  PlateTestStage::add_work(const State &before, State &state) const
  {
    Energies  &energies = state.energies;
    const auto add      = [&](const double force_before,
                         const double force_after,
                         const double path) {
      energies.work += 0.5 * (force_before + force_after) * path;
      energies.work_uncertainty +=
        0.5 * std::abs((force_after - force_before) * path);
    };
    for (unsigned int k = 0; k < MacroUnknowns::n_macro; ++k)
      {
        const unsigned int unknown = cell_.macro().first + k;
        const double       area =
          k < MacroUnknowns::n_modes ? cell_.fabric().area() : 1.;
        add(area * before.reactions[k],
            area * state.reactions[k],
            state.u[unknown] - before.u[unknown]);
      }
    add(before.reactions[MacroUnknowns::n_macro],
        state.reactions[MacroUnknowns::n_macro],
        state.u[cell_.macro().plate_distance()] -
          before.u[cell_.macro().plate_distance()]);
    // What bodies lose while they relax after that is not known better.
    if (before.load_factor == 0.)
      energies.work_uncertainty += 2. * friction_let_go_;
    if (foundation_.is_empty())
      return;
    const double share        = foundation_share(state.load_factor);
    const double at_full      = foundation_.energy(state.u);
    const double share_before = foundation_share(before.load_factor);
    energies.foundation       = share * at_full;
    if (share != share_before)
      {
        const double work_before = energies.work_uncertainty;
        add(foundation_.energy(before.u), at_full, share - share_before);
        energies.release_uncertainty += energies.work_uncertainty - work_before;
      }
  }
} // namespace NPT
