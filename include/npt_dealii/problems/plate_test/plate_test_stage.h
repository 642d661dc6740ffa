// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines one stage of a plate test as an equilibrium problem: couplings,
// loads, virtual work of bundles and contact.

#ifndef npt_dealii_problems_plate_test_plate_test_stage_h
#define npt_dealii_problems_plate_test_plate_test_stage_h

#include <npt_dealii/homogenization/objective_jumps.h>
#include <npt_dealii/load_step/equilibrium_problem.h>
#include <npt_dealii/problems/plate_test/frame_drive.h>
#include <npt_dealii/problems/plate_test/mean_height.h>
#include <npt_dealii/problems/plate_test/plate_cell.h>
#include <npt_dealii/problems/plate_test/press_plates.h>
#include <npt_dealii/problems/plate_test/weaving_foundation.h>

#include <deal.II/base/timer.h>

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace NPT
{
  /// What supports bear that a fabric does not have, against what it has [N].
  struct SupportForces
  {
    double foundation = 0.; ///< largest on a bundle, sum over control points
    double pins       = 0.; ///< largest component
    /// With objective jumps: along the normal, spread over the volume. A plate
    /// under tension along its curvature needs it.
    double normal  = 0.;
    double contact = 0.; ///< largest of a secondary face, as foundation
  };

  /**
   * A stage drives the macro unknowns from their values at its start to their
   * targets, linearly in the load factor. Unknowns are u = (w of all control
   * points, H1..H6, weaving offset, images); the couplings of the cell leave
   * the independent ones m, u = C m, of which H1 to H6 and the offset are
   * prescribed, or loaded by resultants,
   *
   * @f[ C^T ( f_{int}(u) + f_{contact}(u) + f_{foundation}(u) )
   *     = f_{macro}. @f]
   *
   * With objective jumps C relates the displacements in the frames of
   * ObjectiveJumps, and a force along the normals, spread over the volume,
   * holds the mean height of the cell, which the motions of a cylinder do not
   * leave free. FrameDrive leads H1..H3 along the paths of testers; in a
   * compression PressPlates act on the faces, by their distance or pressure.
   */
  class PlateTestStage : public EquilibriumProblem
  {
  public:
    /**
     * @param index  Of the stage in the load programme; the stages that lead to
     *   it tell which components are controlled by resultants and whether
     *   friction has begun.
     * @param before The accepted state at the end of the stage before, or of
     *   that which the entry Start names.
     * @param woven  PlateCell::woven_positions(), empty until weaving ends.
     * @param system Receives couplings, cells and prescribed unknowns.
     * @param timer  Sections of the assembly, if given.
     */
    PlateTestStage(const PlateCell                     &cell,
                   const PlateTestParameters           &parameters,
                   const unsigned int                   index,
                   const State                         &before,
                   const std::vector<dealii::Point<3>> &woven,
                   ConstrainedSystem                   &system,
                   dealii::TimerOutput                 *timer = nullptr,
                   const Pins                          &pins  = {});

    /// The state from which the stage begins: load factor 0, friction on or
    /// off, and its couplings obeyed to the last digit.
    const State &
    start() const
    {
      return start_;
    }

    Increment
    increment(const State &accepted, const double load_factor) const override;
    void
    evaluate(const Increment &increment, Trial &trial) const override;
    bool
    add_tangent(const Increment   &increment,
                const Trial       &trial,
                ConstrainedSystem &system) const override;
    std::vector<std::vector<unsigned int>>
    couplings(const Increment &increment, const Trial &trial) const override;
    /// Whether the gradients leave something of the cell; ellipticity at all
    /// quadrature points; the balance of energy. A state without ellipticity is
    /// refused if the run is to stop there, or if it comes after an elliptic
    /// one by a long step.
    void
    check(const State &before, const State &after) const override;
    /// The state that check() passed last.
    bool
    checked_is_elliptic() const
    {
      return checked_is_elliptic_;
    }
    /// With reactions also of the weaving offset and of the distance of the
    /// plates [N] behind n1..n6, and with the energies.
    State
    accept(const State     &before,
           const Increment &increment,
           const Trial     &trial) const override;
    double
    force_unit() const override
    {
      return cell_.bodies().force_unit();
    }
    double
    lever_arm(const unsigned int unknown) const override;
    /// At a converged trial.
    SupportForces
    support_forces(const Increment &increment, const Trial &trial) const;
    const Ranks &
    ranks() const override
    {
      return cell_.bodies().ranks();
    }
    const ContactPairs &
    contacts() const override
    {
      return cell_.contacts();
    }

    /// The plates of a compression.
    const PressPlates &
    plates() const
    {
      return plates_;
    }

    /// Whether n_{i+1} is prescribed instead of H_{i+1}.
    bool
    resultant_controlled(const unsigned int i) const
    {
      return resultant_controlled_[i];
    }

  private:
    void
    set_loads(const std::vector<LoadStage> &stages, const State &before);
    // Whether H1..H3 are free under what the drive exerts, or prescribed.
    void
    lead_yarns(const bool by_forces);
    void
    set_prescribed(ConstrainedSystem &system) const;
    void
    add_groups_of_jumps(ConstrainedSystem &system);
    void
    add_tangent_of_jumps(const Trial &trial, ConstrainedSystem &system) const;
    State
    make_start(const State &before, const bool friction_was_on) const;
    // Place the plates, or take them away.
    void
    move_plates(State &start) const;
    // Let layers of fabric down until each touches the one below it.
    void
    lower_layers(const double overlap, State &start) const;
    // By interface, from bottom to top [mm].
    std::vector<double>
    gaps_between_layers(const State &start) const;
    std::optional<Gradients>
    work_of_turning(const Trial &trial) const;
    bool
    may_be_spurious(const State &before, const State &after) const;
    void
    set_plate_loads();
    void
    add_energies(const State &before, const Trial &trial, State &state) const;
    void
    add_work(const State &before, State &state) const;
    // Of a stage that relaxes.
    double
    relaxed_fraction(const double load_factor) const;
    double
    relaxation_rate(const std::vector<ContactEvaluation<3>> &contact) const;
    void
    add_relaxation(const State &before, const Trial &trial, State &state) const;
    void
    begin_relaxation();
    // What the release has left of the foundation.
    double
    foundation_share(const double load_factor) const;
    bool
    pressure_controlled() const;

    const PlateCell           &cell_;
    const PlateTestParameters &parameters_;
    const unsigned int         index_;
    const LoadStage           &stage_;
    const LoadStage           *stage_before_; // none before the first
    const ConstrainedSystem   &system_;
    dealii::TimerOutput       *timer_;
    std::vector<unsigned int>  cell_groups_; // of the bundles in the system

    // Of objective jumps; empty with linear ones.
    std::shared_ptr<const ObjectiveJumps> jumps_;
    std::vector<unsigned int>             jump_groups_;
    MeanHeight                            mean_height_;

    std::array<double, MacroUnknowns::n_macro> from_{}, to_{};
    std::array<double, MacroUnknowns::n_modes> force_from_{}, force_to_{};
    std::array<bool, MacroUnknowns::n_modes>   resultant_controlled_{};
    WeavingFoundation foundation_; // empty in a load stage
    FrameDrive        frame_;
    PressPlates       plates_;
    double            plate_distance_from_ = 0, plate_distance_to_ = 0; // [mm]
    double            pressure_from_ = 0, pressure_to_ = 0;             // [MPa]
    double            friction_let_go_ = 0; // at the start [N mm]
    State             start_;
    // Gaps of the contact nodes at the start of a relaxation, by pair.
    std::vector<std::vector<double>> gaps_at_start_;
    mutable bool                     checked_is_elliptic_ = true;
  };
} // namespace NPT

#endif
