// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines all parameters of a plate test: gathers the rooms' structs, declares,
// reads and cross-checks them.

#ifndef npt_dealii_problems_plate_test_plate_test_parameters_h
#define npt_dealii_problems_plate_test_plate_test_parameters_h

#include <npt_dealii/base/parameter_binding.h>
#include <npt_dealii/base/parameter_file.h>
#include <npt_dealii/contact/contact_parameters.h>
#include <npt_dealii/fabric/cell_parameters.h>
#include <npt_dealii/homogenization/homogenization_parameters.h>
#include <npt_dealii/linear_algebra/linear_solver.h>
#include <npt_dealii/load_step/newton.h>
#include <npt_dealii/material/make_material.h>
#include <npt_dealii/problems/load_programme/load_programme.h>
#include <npt_dealii/problems/plate_exports/export_parameters.h>
#include <npt_dealii/problems/plate_results/kes_values.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace NPT
{
  /// Subsection "Output".
  struct OutputParameters
  {
    /// When fields are written.
    enum class Fields
    {
      none,
      stages, ///< at the end of every stage
      steps   ///< after every accepted load step
    };

    std::string directory = "output";
    Fields      fields    = Fields::stages;
    bool        picture   = true;
    /// To other programs.
    ExportParameters exports;

    void
    add_parameters(dealii::ParameterHandler &prm);
  };

  template <>
  const EnumNames<OutputParameters::Fields> &
  enum_names<OutputParameters::Fields>();

  /// Subsection "Checkpoint": when it is written, besides at the end of every
  /// stage and when the run ends early.
  struct CheckpointParameters
  {
    unsigned int every_steps   = 0;  ///< accepted load steps; 0: never
    double       every_minutes = 10; ///< 0: never

    /// Whether there are checkpoints at all.
    bool
    is_wanted() const
    {
      return every_steps > 0 || every_minutes > 0;
    }

    void
    add_parameters(dealii::ParameterHandler &prm);
  };

  /// Subsection "Stability".
  struct StabilityParameters
  {
    /// What happens where a material has lost its ellipticity.
    enum class OnLoss
    {
      stop, ///< the step is refused and cut; the run ends there
      warn  ///< the run goes on
    };

    bool   check_ellipticity = false; ///< of older files: stop
    OnLoss on_loss           = OnLoss::warn;
    double energy_tolerance  = 0.05; ///< of balances [-]

    bool
    stops_at_loss() const
    {
      return check_ellipticity || on_loss == OnLoss::stop;
    }

    void
    add_parameters(dealii::ParameterHandler &prm);
  };

  template <>
  const EnumNames<StabilityParameters::OnLoss> &
  enum_names<StabilityParameters::OnLoss>();

  /// Subsection "Accuracy".
  struct AccuracyParameters
  {
    std::string wanted    = "off"; ///< "off", "1 %" or "0.01"
    double      cpu_limit = 600;   ///< of all runs [s]

    bool
    is_on() const
    {
      return wanted != "off";
    }

    /// The wanted relative accuracy [-]. Throws InputError if it is none.
    double
    target() const;

    void
    add_parameters(dealii::ParameterHandler &prm);
  };

  /**
   * Parameters of a numerical plate test. Origin stays visible:
   * parameters.friction.coefficient is the entry "Friction coefficient" of
   * subsection "Friction".
   */
  struct PlateTestParameters
  {
    CellParameters     cell;
    MeshParameters     mesh;
    MaterialParameters material;
    /// The same unless the file differs.
    MaterialParameters       weft_material = MaterialParameters("as warp");
    ContactParameters        contact;
    FrictionParameters       friction;
    HomogenizationParameters homogenization;
    LoadProgramme            load_programme;
    NewtonParameters         newton;
    LinearSolverParameters   linear_solver;
    StabilityParameters      stability;
    OutputParameters         output;
    CheckpointParameters     checkpoint;
    AccuracyParameters       accuracy;
    KesParameters            kes;

    /// The problem that a plate test with Accuracy / Target becomes.
    static constexpr const char *error_controlled =
      "error-controlled plate test";

    /// Why the program chose this cell type ("because ..."); empty if the file
    /// names the type.
    std::string reason_for_type;
    /// Whether the program uses mirror planes without being told to.
    bool chose_mirror_planes = false;
    /// What the jumps of a bent cell are, and why, where the program chose
    /// them; else empty.
    std::string reason_for_jumps;
    /// Why side contact is on, as a clause; empty if it is off or if the file
    /// decides.
    std::string reason_for_side_contact;

    /// What of the file is not used, in sentences.
    std::vector<std::string> remarks;

    /// The complete file with defaults, as it will be kept with the results.
    std::string used_file;

    /// Bind all members to their entries.
    void
    add_parameters(dealii::ParameterHandler &prm);

    /**
     * Read a parameter file (or its text) with overrides
     * 'Subsection/Entry=value', checking everything.
     *
     * Throws InputError with one sentence for the first mistake.
     */
    static PlateTestParameters
    read(const ParameterText            &text,
         const std::vector<std::string> &overrides = {});

    /// A documented parameter file with all defaults.
    static std::string
    documented_defaults();

  private:
    /// Cross-checks, and what the file leaves to the program.
    void
    complete();
    void
    check_exports() const;
  };
} // namespace NPT

#endif
