// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the list of stages that a run goes through and their targets.

#ifndef npt_dealii_problems_load_programme_load_programme_h
#define npt_dealii_problems_load_programme_load_programme_h

#include <npt_dealii/base/parameter_binding.h>
#include <npt_dealii/load_step/step_control.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/tensor.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace NPT
{
  /// One stage: from the state before it to its targets, in load steps.
  struct LoadStage
  {
    enum class Type
    {
      weave,   ///< bring straight bundles into their interlaced state
      release, ///< drop the auxiliary conditions of weaving
      relax,   ///< let stress and contact pressure relax
      load,    ///< drive the macroscopic components to the targets
      // As testers do; see tester_targets.h.
      trellis,        ///< turn yarns of constant length
      picture_frame,  ///< turn yarns that are clamped or under tension
      bias_extension, ///< pull along the bias, edges free
      compression     ///< press between two plates
    };

    std::string name;
    Type        type = Type::load;

    /// Name of the earlier stage at whose end this one begins, so that several
    /// stages are independent tests of one woven cell; empty: the stage before.
    std::string start;

    /// Mode (row of MacroModes::table) -> its gradient H at the end of the
    /// stage. Modes in neither map keep what is prescribed for them.
    std::map<unsigned int, double> H_targets;

    /// Mode -> conjugate resultant n prescribed instead of H. Zero frees the
    /// mode.
    std::map<unsigned int, double> n_targets;

    /// Name (of tester_targets.h) -> value at the end of the stage.
    std::map<std::string, double> tester_targets;

    bool           friction = true;
    StepParameters steps;
    /// Relax: fraction of the stress that is gone at the end [-].
    double relaxed_fraction = 0;

    /// With objective jumps, from the first bending on: see
    /// set_bending_directions().
    std::optional<dealii::Tensor<1, 2>> bends_along;

    /// What the file says of type and friction; where it says `automatic`,
    /// nothing, complete() goes by the name and the type.
    std::optional<Type> given_type;
    std::optional<bool> given_friction;

    LoadStage() = default;

    /**
     * A stage with the defaults that its name has: "weave" and "release" have
     * steps of at most 0.1 and 1 of the stage, others of 0.05;
     * "shear" has the target H3 = 0.2, "tension" H1 = 0.2.
     */
    explicit LoadStage(const std::string &name);

    /// Bind the members to the entries of subsection "Stage NAME".
    void
    add_parameters(dealii::ParameterHandler &prm);

    /// Set type and friction, and throw InputError for what is impossible.
    void
    complete();

    /// "H3: 0.2, n1: 0".
    std::string
    targets() const;

    /// Throws InputError if a component is prescribed twice.
    void
    set_targets(const std::string &text);

    /// A test of the fabric, not a part of its making.
    bool
    is_test() const
    {
      return type != Type::weave && type != Type::release &&
             type != Type::relax;
    }
    /// Whether the yarns are led, so that H1, H2 and H3 follow together.
    bool
    leads_yarns() const
    {
      return type == Type::trellis || type == Type::picture_frame ||
             type == Type::bias_extension;
    }
    std::optional<double>
    tester_target(const std::string &target) const;
    /// Modes of which gradient or resultant changes or is prescribed.
    std::vector<unsigned int>
    driven_modes() const;
  };

  template <>
  const EnumNames<LoadStage::Type> &
  enum_names<LoadStage::Type>();

  /// Number of the stage at whose end a stage begins; nothing for the first.
  /// Requires that all entries Start have been checked.
  std::optional<unsigned int>
  stage_before(const std::vector<LoadStage> &stages, const unsigned int index);

  /// Numbers of the stages that lead from the undeformed cell to the end of a
  /// stage, that one included, in their order.
  std::vector<unsigned int>
  path_to(const std::vector<LoadStage> &stages, const unsigned int index);

  /**
   * Subsection "Load programme". The stages are named by the user, so their
   * names have to be known before their entries can be declared.
   */
  class LoadProgramme
  {
  public:
    std::vector<LoadStage> stages;

    /// @param names Entry Stages, the names separated by commas; empty for the
    ///   default.
    explicit LoadProgramme(const std::string &names = "");

    /// Bind all stages to their entries.
    void
    add_parameters(dealii::ParameterHandler &prm);

    /**
     * Complete the stages. Throws InputError if they make no programme: names
     * twice, a Start that is no earlier stage, an order other than weave,
     * release, load on the way to a stage, a load stage without target, steps
     * that contradict each other.
     */
    void
    check();

    /// The name of a stage as a part of file names: letters, digits, '-' and
    /// '_', different for every stage, also where upper and lower case are the
    /// same.
    std::string
    file_name(const std::string &stage) const;

    /// Stages that do not begin at the end of the one before them, with the
    /// name of that at whose end they do.
    std::map<std::string, std::string>
    branches() const;

  private:
    std::string names_; ///< as the file writes them
  };
} // namespace NPT

#endif
