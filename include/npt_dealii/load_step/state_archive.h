// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines how the accepted state and its parts are put into archives of
// Boost.Serialization: all members, bit by bit in a binary archive.

#ifndef npt_dealii_load_step_state_archive_h
#define npt_dealii_load_step_state_archive_h

#include <npt_dealii/load_step/energy_balance.h>
#include <npt_dealii/load_step/load_stepper.h>
#include <npt_dealii/load_step/state.h>
#include <npt_dealii/load_step/step_control.h>

#include <boost/serialization/array.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

namespace NPT
{
  template <typename Archive, int dim>
  void
  serialize(Archive &archive, ProjectionStart<dim> &start, const unsigned int)
  {
    archive &start.known &start.surface;
    for (double &u : start.u)
      archive &u;
  }

  template <typename Archive, int dim>
  void
  serialize(Archive &archive, ContactState<dim> &contact, const unsigned int)
  {
    archive &contact.friction_on &contact.traction &contact.multiplier;
    archive &contact.penalty_scale &contact.closest &contact.behind;
    archive &contact.gap_shift &contact.slip_path &contact.law_pressure;
  }

  template <typename Archive>
  void
  serialize(Archive &archive, Energies &energies, const unsigned int)
  {
    archive &energies.stored &energies.contact &energies.friction;
    archive &energies.foundation &energies.work &energies.dissipation;
    archive &energies.work_uncertainty &energies.release_uncertainty;
    archive                            &energies.relaxation_rate;
  }

  template <typename Archive>
  void
  serialize(Archive &archive, EnergyChange &change, const unsigned int)
  {
    archive &change.work &change.growth &change.dissipation;
    archive &change.uncertainty &change.release &change.content;
  }

  template <typename Archive>
  void
  serialize(Archive &archive, EnergyBalance::Stage &stage, const unsigned int)
  {
    archive &stage.name &stage.total &stage.throughput;
  }

  template <typename Archive>
  void
  serialize(Archive &archive, State &state, const unsigned int)
  {
    archive &state.u &state.load_factor &state.applied &state.reactions;
    archive &state.contact &state.natural &state.energies;
  }

  template <typename Archive>
  void
  serialize(Archive &archive, StepControl::Place &place, const unsigned int)
  {
    archive &place.position &place.step_level &place.n_accepted &place.n_cuts;
  }

  template <typename Archive>
  void
  serialize(Archive &archive, StageMemory &memory, const unsigned int)
  {
    bool     has_previous = memory.previous.has_value();
    archive &memory.state &has_previous &memory.place;
    if (has_previous && !memory.previous)
      memory.previous.emplace();
    if (has_previous)
      archive &*memory.previous;
  }
} // namespace NPT

#endif
