// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the equations of a pulled bar, its parameters, and its name in a
// parameter file.

#include "pulled_bar.h"

#include <npt_dealii/base/parameter_binding.h>
#include <npt_dealii/base/problem.h>
#include <npt_dealii/base/problem_names.h>
#include <npt_dealii/io/replace_file.h>
#include <npt_dealii/io/table_file.h>

#include <iostream>

namespace NPT
{
  namespace
  {
    std::vector<DeformablePart>
    make_bar(const PulledBarParameters &parameters)
    {
      // A linear box, then quadratic with two spans along it.
      std::vector<dealii::Point<3>> corners;
      for (const double z : {0., parameters.width})
        for (const double y : {0., parameters.width})
          for (const double x : {0., parameters.length})
            corners.emplace_back(x, y, z);
      const KnotVector linear = KnotVector::uniform(1, 1);
      NURBSPatch<3>    patch({{linear, linear, linear}}, corners);
      for (unsigned int direction = 0; direction < 3; ++direction)
        patch.elevate_degree(direction, 1);
      patch.subdivide(0, 2);

      std::vector<DeformablePart> parts;
      parts.push_back({patch,
                       make_material<3>(parameters.material,
                                        dealii::Point<3>::unit_vector(0)),
                       0,
                       "the bar"});
      return parts;
    }
  } // namespace



  // ---------------------------------------------------------- the equations

  PulledBar::PulledBar(const PulledBarParameters &parameters)
    : parameters_(parameters)
    , body_(make_bar(parameters), Basis::NURBS)
    , elongation_(body_.n_displacements())
  {
    dealii::AffineConstraints<double> constraints;
    const auto                       &X = body_.space().control_points();
    for (unsigned int A = 0; A < X.size(); ++A)
      {
        for (unsigned int i = 0; i < 3; ++i)
          if (std::abs(X[A][i]) < 1e-12 * parameters.length)
            constraints.add_line(3 * A + i);
        if (std::abs(X[A][0] - parameters.length) < 1e-12 * parameters.length)
          {
            constraints.add_line(3 * A);
            constraints.add_entry(3 * A, elongation_, 1.);
          }
      }
    constraints.close();
    system_.reinit(constraints, elongation_ + 1);
    groups_ = body_.add_groups(system_);
    system_.build_pattern();

    std::vector<bool> prescribed(system_.n_independent(), false);
    prescribed[system_.independent_index(elongation_)] = true;
    system_.set_prescribed(prescribed);
  }



  Increment
  PulledBar::increment(const State &accepted, const double load_factor) const
  {
    Increment increment;
    increment.load_factor = load_factor;
    system_.restrict_to_independent(accepted.u, increment.target);
    increment.target[system_.independent_index(elongation_)] =
      load_factor * parameters_.elongation * parameters_.length;
    return increment;
  }



  void
  PulledBar::evaluate(const Increment &, Trial &trial) const
  {
    trial.residual.reinit(trial.u.size());
    trial.force_scale = body_.add_residual(trial.u, trial.residual);
  }



  bool
  PulledBar::add_tangent(const Increment &,
                         const Trial       &trial,
                         ConstrainedSystem &system) const
  {
    body_.add_tangent(trial.u, groups_, system);
    return true;
  }



  State
  PulledBar::accept(const State     &before,
                    const Increment &increment,
                    const Trial     &trial) const
  {
    State state     = EquilibriumProblem::accept(before, increment, trial);
    state.reactions = {trial.condensed[system_.independent_index(elongation_)]};
    return state;
  }



  // ---------------------------------------------------------- the load steps

  void
  PulledBar::run(const std::string &directory, std::ostream &screen)
  {
    RunLog log = RunLog::in_folder(directory, screen);
    log.header("Pulled bar", {{"unknowns", std::to_string(system_.n_free())}});
    replace_file(directory + "/used_parameters.prm",
                 [&](std::ostream &out) { out << parameters_.used_file; });
    TableWriter table(directory + "/bar.csv",
                      {"elongation", "force"},
                      {"Elongation over length [-], force [N]."});

    LinearSolver linear_solver(parameters_.linear_solver);
    LoadStepper  stepper(
      parameters_.newton, ContactParameters(), system_, linear_solver, log);
    State start;
    start.u.reinit(elongation_ + 1);
    stepper.run(*this,
                start,
                parameters_.steps,
                "pull",
                LoadStepper::Predictor::extrapolation,
                [&](const AcceptedStep &step) {
                  table.add_row({step.after.u[elongation_] / parameters_.length,
                                 step.after.reactions[0]});
                });
  }



  // ---------------------------------------------------------- the parameters

  void
  PulledBarParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    declare_problem(prm, "pulled bar");
    {
      const ParameterSubsection subsection(prm, "Bar");
      add_parameter(
        prm, "Length", length, "Length L of the bar [mm].", positive_number());
      add_parameter(prm,
                    "Width",
                    width,
                    "Width of its square section [mm].",
                    positive_number());
      add_parameter(prm,
                    "Elongation",
                    elongation,
                    "Elongation at the end over the length [-].",
                    dealii::Patterns::Double(-0.9));
      add_parameter(prm,
                    "Output directory",
                    directory,
                    "Folder of bar.csv; created if missing.");
      steps.add_parameters(prm);
    }
    material.add_parameters(prm, "Material");
    newton.add_parameters(prm);
    linear_solver.add_parameters(prm);
  }



  PulledBarParameters
  PulledBarParameters::read(const ParameterText            &text,
                            const std::vector<std::string> &overrides)
  {
    PulledBarParameters      parameters;
    dealii::ParameterHandler prm;
    parameters.add_parameters(prm);
    parse_parameter_text(prm, text, overrides);
    parameters.material.check("Material");
    parameters.steps.check("subsection Bar");
    parameters.used_file = documented_parameters(prm);
    return parameters;
  }



  namespace
  {
    void
    start(const ParameterText &text, const CommandLine &command)
    {
      const auto parameters =
        PulledBarParameters::read(text, command.overrides);
      if (done_with_parameters(command, parameters))
        return;
      const std::string directory =
        make_output_directory(command, parameters.directory);
      PulledBar(parameters).run(directory, std::cout);
    }

    const Registry<Problem>::Registration
      pulled_bar("pulled bar",
                 {100, "a bar that is pulled at its ends", start});
  } // namespace
} // namespace NPT
