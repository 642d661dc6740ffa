// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the energies of a state, and the balance of work against energies and
// dissipation over steps and stages.

#ifndef npt_dealii_load_step_energy_balance_h
#define npt_dealii_load_step_energy_balance_h

#include <string>
#include <vector>

namespace NPT
{
  /// Energies of a state, and what has flowed since the start of the run, all
  /// in N mm. A problem that keeps no account leaves them zero.
  struct Energies
  {
    double stored     = 0; ///< of the bodies
    double contact    = 0; ///< of the normal penalty
    double friction   = 0; ///< of the tangential penalty
    double foundation = 0; ///< of springs that hold what floats

    /// Of all driving forces, by the trapezoidal rule.
    double work        = 0;
    double dissipation = 0;
    /// What contact loses at this state per fraction of relaxed stress; its
    /// integral is dissipated.
    double relaxation_rate = 0;
    /// Sum of |Delta n| |Delta H| / 2 over steps and driving forces n: by so
    /// much the work can be off if every n is monotone within its steps.
    double work_uncertainty = 0;
    /// The part of it that comes from the release of the foundation.
    double release_uncertainty = 0;

    double
    content() const
    {
      return stored + contact + friction + foundation;
    }
  };

  /**
   * What happened between two states,
   *
   * @f[ W = \Delta E + D + M , @f]
   *
   * with the work W, the energies E, the dissipation D of friction and of
   * relaxation, and a missing part M. On one equilibrium path M is the error of
   * the trapezoidal rule, which vanishes with the step squared. A step that
   * lands on another path (a snap, contact that is lost) leaves the energy that
   * a real fabric would turn into vibrations and heat: M does not vanish with
   * the step.
   */
  struct EnergyChange
  {
    double work        = 0; ///< W
    double growth      = 0; ///< Delta E
    double dissipation = 0; ///< D
    double uncertainty = 0; ///< of W
    double release     = 0; ///< uncertainty by the release of the foundation
    double content     = 0; ///< the larger one of the two states

    EnergyChange() = default;
    EnergyChange(const Energies &before, const Energies &after);

    double
    missing() const
    {
      return work - growth - dissipation;
    }

    /// Whether M exceeds what the trapezoidal rule can be wrong by and a
    /// fraction of the energy content.
    bool
    is_jump(const double tolerance) const;
  };

  /// The balance of every stage of a run.
  class EnergyBalance
  {
  public:
    struct Stage
    {
      std::string  name;
      EnergyChange total;
      /// Sum over the steps of the largest of |W|, |Delta E|, D.
      double throughput = 0;

      /// |M| without the uncertainty of the release, which may go in one step,
      /// over the throughput, or over 1 % of the energy content if less than
      /// that has flowed.
      double
      deviation() const;
    };

    void
    add_step(const std::string &stage,
             const Energies    &before,
             const Energies    &after);

    const std::vector<Stage> &
    stages() const
    {
      return stages_;
    }

    /// A table for the log, one line per stage below a line of titles.
    std::vector<std::string>
    table() const;

    /// One sentence for every stage whose deviation exceeds the tolerance.
    std::vector<std::string>
    warnings(const double tolerance) const;

    /// For Boost.Serialization; state_archive.h has the parts.
    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &stages_ &starts_;
    }

  private:
    std::vector<Stage>    stages_;
    std::vector<Energies> starts_; // by stage
  };
} // namespace NPT

#endif
