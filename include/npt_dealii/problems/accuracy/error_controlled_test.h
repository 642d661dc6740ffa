// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the plate test to a wanted accuracy: the program chooses mesh,
// contact, penalties and steps, estimates its errors and refines.

#ifndef npt_dealii_problems_accuracy_error_controlled_test_h
#define npt_dealii_problems_accuracy_error_controlled_test_h

#include <npt_dealii/base/parameter_text.h>
#include <npt_dealii/problems/accuracy/error_bars.h>
#include <npt_dealii/problems/parameter_study/sweep.h>
#include <npt_dealii/problems/plate_test/plate_test_parameters.h>

#include <iosfwd>
#include <set>
#include <string>
#include <vector>

namespace NPT
{
  /// What the program chooses.
  struct AccuracySetting
  {
    unsigned int n_elements = 5;    ///< along and across, between two crossings
    unsigned int n_layers   = 2;    ///< elements through a bundle
    double       penalty    = 0;    ///< normal and tangential [N/mm^3]
    double       step       = 0.05; ///< largest step of load stages [-]

    /// The next coarser mesh, with elements about 1.4 times larger.
    unsigned int
    coarser_mesh() const;

    /// Halve the error of one source, at least about; false at its limit.
    bool
    refine(const ErrorSource source);

    /// "5 x 5 x 2 elements, penalties 1000 N/mm^3, load steps of 0.05".
    std::string
    describe() const;
  };

  /// The setting to begin with, from what the errors of the ready cells were
  /// (doc/studies.md): coarse meshes for coarse targets, penalties of 145 times
  /// the stiffness of the bundles.
  AccuracySetting
  first_setting(const PlateTestParameters &parameters);

  /**
   * Runs a plate test until the error bars of all driven components are below
   * Accuracy / Target.
   *
   * The main run and its probes (Probes) are cases of one folder, side by side,
   * each in a process of its own, and kept: an interrupted run goes on with
   * those that are finished. If the bars are too long, the largest part is
   * refined, and every other part above half of the target with it.
   *
   * Results: `accuracy.csv`, every answer with its bar and their parts;
   * `accuracy.svg`, curves with bands; `accuracy.txt`, what was chosen, why,
   * and what it cost; `curves.csv` and `summary.csv` of the main run, whose
   * other files are in its folder below `cases`.
   */
  class ErrorControlledTest
  {
  public:
    /// @param text The file of a plate test with Accuracy / Target set.
    ErrorControlledTest(const ParameterText            &text,
                        const std::vector<std::string> &overrides,
                        const std::string              &directory,
                        const SweepOptions             &options,
                        std::ostream                   &screen);

    /// Throws StageFailed if a run ends early, or if the target is missed;
    /// results so far are complete.
    void
    run();

  private:
    SweepCase
    make_case(const AccuracySetting &setting, const std::string &name) const;
    Probes<SweepCase>
    make_cases(const AccuracySetting &setting) const;
    void
    run_all(Probes<SweepCase> &cases);
    std::vector<ErrorBars>
    estimate(const Probes<SweepCase> &cases) const;
    void
    report(const AccuracySetting &setting, const std::vector<ErrorBars> &bars);
    // After a probe has failed; false as refine().
    bool
    make_probes_finer(AccuracySetting &setting, const bool coarse_mesh_failed);
    // False if nothing can be refined, or not within the limit of CPU time.
    bool
    refine(AccuracySetting &setting, const std::vector<ErrorBars> &bars) const;
    void
    write(const Probes<SweepCase>      &cases,
          const std::vector<ErrorBars> &bars) const;
    void
    draw(const std::vector<ErrorBars> &bars) const;

    const ParameterText            text_;
    const std::vector<std::string> overrides_;
    const PlateTestParameters      parameters_;
    const std::string              directory_;
    const SweepOptions             options_;
    std::ostream                  &screen_;
    double                         cpu_seconds_      = 0;
    double                         last_cpu_seconds_ = 0; // of the last round
    double                         last_main_cpu_seconds_ = 0;
    unsigned int                   base_mesh_             = 0;
    std::set<std::string>          counted_; // folders of runs
    std::vector<std::string>       history_;
  };
} // namespace NPT

#endif
