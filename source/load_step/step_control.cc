// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the load factor of a stage: the next trial, growth, cuts, giving up.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/parameter_binding.h>
#include <npt_dealii/base/short_number.h>
#include <npt_dealii/load_step/step_control.h>

#include <deal.II/base/exceptions.h>

#include <cmath>
#include <sstream>

namespace NPT
{
  namespace
  {
    // 0.1 is not 1/10 in binary; comparisons of steps forgive that.
    constexpr double tolerance = 1e-9;
  } // namespace



  void
  StepParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    namespace Patterns = dealii::Patterns;
    add_parameter(prm,
                  "Initial step",
                  initial_step,
                  "First load step, as a fraction of the stage [-]. "
                  "Rounded down to 1/n.",
                  Patterns::Double(1e-6, 1));
    add_parameter(prm,
                  "Minimum step",
                  minimum_step,
                  "The stage is given up when a step would have to be "
                  "smaller than this fraction of it [-].",
                  Patterns::Double(1e-9, 1));
    add_parameter(prm,
                  "Maximum step",
                  maximum_step,
                  "Longest load step, as a fraction of the stage [-]. "
                  "Steps grow by doubling.",
                  Patterns::Double(1e-6, 1));
    add_parameter(prm,
                  "Target iterations",
                  target_iterations,
                  "The step may grow after a step of at most this many "
                  "Newton iterations [-].",
                  Patterns::Integer(1, 1000));
  }



  void
  StepParameters::check(const std::string &place) const
  {
    if (initial_step > maximum_step)
      throw InputError("Initial step is " + short_number(initial_step) +
                       "; it must not exceed the Maximum step " +
                       short_number(maximum_step) + " (" + place + ").");
    if (minimum_step > initial_step)
      throw InputError("Minimum step is " + short_number(minimum_step) +
                       "; it must not exceed the Initial step " +
                       short_number(initial_step) + " (" + place + ").");
  }



  StepControl::StepControl(const StepParameters &given,
                           const std::string    &stage_name)
    : parameters(given)
    , name(stage_name)
  {
    AssertThrow(0 < parameters.minimum_step &&
                  parameters.minimum_step <= parameters.initial_step &&
                  parameters.initial_step <= parameters.maximum_step &&
                  parameters.maximum_step <= 1,
                dealii::ExcMessage("Steps must satisfy 0 < minimum <= initial "
                                   "<= maximum <= 1."));
    n_ticks = std::ceil(1 / parameters.initial_step - tolerance);
    // Ticks are as fine as the minimum step lets cuts go.
    while (1. / (2 * n_ticks) >= parameters.minimum_step * (1 - tolerance))
      {
        n_ticks *= 2;
        ++step_level;
      }
  }



  void
  StepControl::go_to(const Place &place)
  {
    AssertThrow(0 <= place.position && place.position <= n_ticks &&
                  place.step_level < 63,
                dealii::ExcMessage("The place lies outside the stage."));
    position    = place.position;
    step_level  = place.step_level;
    n_accepted_ = place.n_accepted;
    n_cuts_     = place.n_cuts;
  }



  unsigned int
  StepControl::trial_level() const
  {
    unsigned int level = step_level;
    while (position + (std::int64_t(1) << level) > n_ticks)
      --level;
    return level;
  }



  double
  StepControl::trial() const
  {
    Assert(!finished(), dealii::ExcMessage("The stage is finished."));
    return static_cast<double>(position + (std::int64_t(1) << trial_level())) /
           n_ticks;
  }



  void
  StepControl::accept(const unsigned int newton_iterations)
  {
    Assert(!finished(), dealii::ExcMessage("The stage is finished."));
    position += std::int64_t(1) << trial_level();
    ++n_accepted_;

    const std::int64_t longer = std::int64_t(1) << (step_level + 1);
    if (newton_iterations <= parameters.target_iterations &&
        position % longer == 0 && position + longer <= n_ticks &&
        static_cast<double>(longer) / n_ticks <=
          parameters.maximum_step * (1 + tolerance))
      ++step_level;
  }



  void
  StepControl::reject(const LoadStepFailure &failure)
  {
    Assert(!finished(), dealii::ExcMessage("The stage is finished."));
    ++n_cuts_;
    const unsigned int level = trial_level();
    if (level == 0)
      {
        std::ostringstream account;
        account << "the step " << step() << " failed (" << failure.what()
                << ") and half of it is below the Minimum step "
                << parameters.minimum_step;
        give_up(account.str(), failure);
      }
    step_level = level - 1;
  }



  void
  StepControl::reject_for_good(const LoadStepFailure &failure)
  {
    ++n_cuts_;
    give_up(failure.what(), failure);
  }



  void
  StepControl::give_up(const std::string     &what_happened,
                       const LoadStepFailure &failure) const
  {
    std::ostringstream account;
    account << (name.empty() ? std::string("The stage") : "Stage " + name)
            << " was given up at load factor " << load_factor() << ": "
            << what_happened << "; " << n_cuts_
            << (n_cuts_ == 1 ? " failed step, " : " failed steps, ")
            << n_accepted_ << " accepted.";
    throw StageFailed(account.str(),
                      failure.reason(),
                      name,
                      load_factor(),
                      n_cuts_,
                      failure.advice());
  }



  bool
  StepControl::is_shortest() const
  {
    return trial_level() == 0;
  }



  bool
  StepControl::finished() const
  {
    return position == n_ticks;
  }



  double
  StepControl::load_factor() const
  {
    return static_cast<double>(position) / n_ticks;
  }



  double
  StepControl::step() const
  {
    return static_cast<double>(std::int64_t(1) << trial_level()) / n_ticks;
  }



  unsigned int
  StepControl::n_accepted() const
  {
    return n_accepted_;
  }



  unsigned int
  StepControl::n_cuts() const
  {
    return n_cuts_;
  }
} // namespace NPT
