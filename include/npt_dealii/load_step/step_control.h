// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the load factor of a stage: the next trial, growth, cuts, giving up.

#ifndef npt_dealii_load_step_step_control_h
#define npt_dealii_load_step_step_control_h

#include <deal.II/base/parameter_handler.h>

#include <cstdint>
#include <string>

namespace NPT
{
  class LoadStepFailure;

  /// Steps of one stage, in the subsection of that stage.
  struct StepParameters
  {
    double       initial_step      = 0.05; ///< fraction of the stage [-]
    double       minimum_step      = 1e-4; ///< fraction of the stage [-]
    double       maximum_step      = 0.05; ///< fraction of the stage [-]
    unsigned int target_iterations = 8;

    /// Bind the members to entries of the present subsection.
    void
    add_parameters(dealii::ParameterHandler &prm);

    /**
     * Throws InputError unless minimum <= initial <= maximum.
     *
     * @param place Named in error messages, e.g. "subsection Stage shear".
     */
    void
    check(const std::string &place) const;
  };

  /**
   * Lead a load factor from 0 to 1.
   *
   * The factor lives on a grid of n 2^k ticks with n = 1/initial step (rounded
   * up if it is not an integer: a first step of 0.3 becomes 0.25). A cut
   * halves the step, growth doubles it, and it doubles only where the longer
   * step starts at a multiple of itself. So every factor that a run without
   * cuts visits is visited exactly (k/n, as the nearest floating-point number)
   * by a run with cuts as well, curves of both have common abscissae, the last
   * factor is exactly 1, and no sliver of a step is ever left.
   *
   * A function of its own calls only: the same sequence of accept() and
   * reject() gives the same factors.
   */
  class StepControl
  {
  public:
    /// @param name Stage, for messages.
    StepControl(const StepParameters &parameters, const std::string &name = "");

    /// How far a stage has come, for one that is continued.
    struct Place
    {
      std::int64_t position   = 0; ///< ticks
      unsigned int step_level = 0; ///< step = 2^step_level ticks
      unsigned int n_accepted = 0;
      unsigned int n_cuts     = 0;
    };

    Place
    place() const
    {
      return {position, step_level, n_accepted_, n_cuts_};
    }
    /// Go on from a place of a stage with the same initial and minimum step.
    void
    go_to(const Place &place);

    /// Next load factor to try, at most 1. Must not be finished.
    double
    trial() const;

    /// The trial converged. The step doubles if it took at most the target
    /// iterations, up to the maximum step.
    void
    accept(const unsigned int newton_iterations);

    /**
     * The trial failed: halve the step. Throws StageFailed if it would become
     * smaller than the minimum.
     *
     * @param failure Its reason and advice become those of StageFailed.
     */
    void
    reject(const LoadStepFailure &failure);

    /// The trial failed in a way that no shorter step mends: throw StageFailed.
    [[noreturn]] void
    reject_for_good(const LoadStepFailure &failure);

    /// Whether the next step cannot be cut.
    bool
    is_shortest() const;

    bool
    finished() const;

    /// Last accepted load factor.
    double
    load_factor() const;

    /// Length of the next step [-].
    double
    step() const;

    unsigned int
    n_accepted() const;

    unsigned int
    n_cuts() const;

  private:
    /// Exponent of the next step in ticks: step_level unless that would
    /// overshoot 1.
    unsigned int
    trial_level() const;

    [[noreturn]] void
    give_up(const std::string     &what_happened,
            const LoadStepFailure &failure) const;

    const StepParameters parameters;
    const std::string    name;

    std::int64_t n_ticks     = 1; ///< of the stage
    std::int64_t position    = 0; ///< ticks
    unsigned int step_level  = 0; ///< step = 2^step_level ticks
    unsigned int n_accepted_ = 0;
    unsigned int n_cuts_     = 0;
  };
} // namespace NPT

#endif
