// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what a plate test checks of its contact when a stage begins and ends.

#ifndef npt_dealii_problems_plate_test_contact_checks_h
#define npt_dealii_problems_plate_test_contact_checks_h

#include <npt_dealii/io/run_log.h>
#include <npt_dealii/problems/plate_results/curve_writer.h>
#include <npt_dealii/problems/plate_test/plate_cell.h>
#include <npt_dealii/problems/plate_test/plate_test_parameters.h>

#include <vector>

namespace NPT
{
  /**
   * What is said about the contact of a woven cell: before anything is
   * computed, when a stage begins, and when it ends. Other cells pass.
   */
  class ContactChecks
  {
  public:
    /// Both must live as long as this object.
    ContactChecks(const PlateTestParameters &parameters, RunLog &log);

    /// Says if the mesh is too coarse for the averages of mortar contact, and
    /// what is done instead.
    void
    warn_of_coarse_averages(const PlateCell &cell) const;

    /// A load stage before the bundles are woven: says what is tested instead.
    void
    warn_of_unwoven_bundles(const unsigned int stage) const;

    /**
     * When a stage ends: do bundles lie in each other anywhere
     * (find_overlap()), and do enough contact nodes carry load? Warns of an
     * overlap of more than a quarter of Contact / Maximum overlap, again only
     * when it has grown by a tenth, and once of fewer than ten active contact
     * nodes per crossing.
     *
     * @param curve With the last step of the stage.
     *
     * Throws StageFailed, "bundles overlap" or "no contact", if the overlap is
     * larger than Contact / Maximum overlap times the thickness of the thinner
     * bundle, or if the bundles do not touch at all.
     */
    void
    check(const PlateCell                     &cell,
          const LoadStage                     &stage,
          const State                         &state,
          const std::vector<dealii::Point<3>> &woven,
          const std::vector<CurveRow>         &curve);

    /// Depth of the overlap that was warned of last [mm], to be kept over a
    /// restart.
    double
    overlap_warned_of() const
    {
      return overlap_warned_of_;
    }
    void
    set_overlap_warned_of(const double depth)
    {
      overlap_warned_of_ = depth;
    }

  private:
    bool
    is_woven() const;
    void
    check_overlap(const PlateCell                     &cell,
                  const LoadStage                     &stage,
                  const State                         &state,
                  const std::vector<dealii::Point<3>> &woven,
                  const unsigned int                   n_cuts);
    void
    check_active_nodes(const PlateCell             &cell,
                       const LoadStage             &stage,
                       const std::vector<CurveRow> &curve,
                       const unsigned int           n_cuts) const;

    const PlateTestParameters &parameters_;
    RunLog                    &log_;
    double                     overlap_warned_of_ = 0; // depth [mm]
  };
} // namespace NPT

#endif
