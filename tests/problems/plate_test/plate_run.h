// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines a plate test that is driven by its parts, with all of them open.

#ifndef npt_dealii_tests_problems_plate_test_plate_run_h
#define npt_dealii_tests_problems_plate_test_plate_run_h

#include <npt_dealii/load_step/load_stepper.h>
#include <npt_dealii/problems/plate_test/plate_cell.h>
#include <npt_dealii/problems/plate_test/plate_test_stage.h>

#include <cmath>
#include <sstream>

namespace PlateTestTools
{
  using namespace NPT;

  /// A cell and its accepted state, taken through the load program without
  /// files.
  struct PlateRun
  {
    explicit PlateRun(const std::vector<std::string> &overrides)
      : parameters(PlateTestParameters::read(make_parameter_text("", "run.prm"),
                                             overrides))
      , cell(parameters)
      , linear_solver(parameters.linear_solver)
      , log("", screen, false, true)
      , state(cell.initial_state())
    {}

    /// All stages. With woven positions given before, those stay.
    void
    run(const bool keep_woven = false)
    {
      const auto &stages = parameters.load_programme.stages;
      for (unsigned int i = 0; i < stages.size(); ++i)
        {
          const PlateTestStage problem(
            cell, parameters, i, state, woven, system, nullptr, pins);
          LoadStepper stepper(
            parameters.newton, parameters.contact, system, linear_solver, log);
          state = stepper.run(problem,
                              problem.start(),
                              stages[i].steps,
                              stages[i].name,
                              LoadStepper::Predictor::extrapolation,
                              [&](const AcceptedStep &step) {
                                trial     = step.trial;
                                increment = step.increment;
                              });
          if (stages[i].type != LoadStage::Type::load && !keep_woven)
            woven = cell.woven_positions(state.u);
        }
    }

    /// Contact forces of the accepted state on all unknowns [N].
    dealii::Vector<double>
    contact_force() const
    {
      dealii::Vector<double> force(cell.macro().n_unknowns());
      for (unsigned int k = 0; k < cell.contacts().size(); ++k)
        cell.contacts()[k]->add_residual(increment.contact[k],
                                         trial.contact[k],
                                         force);
      return force;
    }

    dealii::AffineConstraints<double>
    couplings(const Pins &with_pins = {}) const
    {
      return make_couplings(cell.fabric(),
                            cell.bodies().space(),
                            cell.macro(),
                            cell.images(),
                            woven,
                            with_pins);
    }

    const PlateTestParameters     parameters;
    const PlateCell               cell;
    Pins                          pins;
    ConstrainedSystem             system;
    LinearSolver                  linear_solver;
    std::ostringstream            screen;
    RunLog                        log;
    State                         state;
    std::vector<dealii::Point<3>> woven;
    Trial                         trial;     // of the last accepted step
    Increment                     increment; // the same
  };
} // namespace PlateTestTools

#endif
