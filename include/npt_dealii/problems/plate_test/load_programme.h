// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the list of stages that a run goes through and their targets.

#ifndef npt_dealii_problems_plate_test_load_programme_h
#define npt_dealii_problems_plate_test_load_programme_h

#include <npt_dealii/load_step/step_control.h>

#include <deal.II/base/parameter_handler.h>

#include <map>
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
      load     ///< drive the macroscopic components to the targets
    };

    std::string name;
    Type        type = Type::load;

    /// Component 0..5 -> H1..H6 at the end of the stage: H1..H3 [-], H4..H6
    /// [1/mm]. Components in neither map keep what is prescribed for them.
    std::map<unsigned int, double> H_targets;

    /// Component 0..5 -> conjugate resultant n1..n6 prescribed instead of H:
    /// n1..n3 [N/mm], n4..n6 [N]. Zero frees the component.
    std::map<unsigned int, double> n_targets;

    bool           friction = true;
    StepParameters steps;
  };

  /**
   * Subsection "Load programme". The stages are named by the user, so reading
   * takes two passes: read_stage_names() finds the names in the text, then
   * declare_parameters() makes a subsection for each of them.
   */
  class LoadProgramme
  {
  public:
    std::vector<LoadStage> stages;

    /**
     * Return the entry Stages of subsection "Load programme" in the text of a
     * parameter file, or the default if it is not there.
     *
     * Understands what deal.II's ParameterHandler does: comments, lines
     * continued by a backslash, any white space; the last entry counts.
     */
    static std::vector<std::string>
    read_stage_names(const std::string &prm_text);

    /**
     * Declare the entries of all stages. Defaults depend on the name: "weave"
     * and "release" have steps of 0.1 and 1 of the stage, others of 0.05;
     * "shear" has the target H3 = 0.2, "tension" H1 = 0.2.
     */
    static void
    declare_parameters(dealii::ParameterHandler       &prm,
                       const std::vector<std::string> &stage_names);

    /**
     * Fill `stages`. Throws InputError if the stages make no programme: names
     * twice, an order other than weave, release, load, a load stage without
     * target, a component prescribed twice, steps that contradict each other.
     */
    void
    parse_parameters(dealii::ParameterHandler &prm);
  };
} // namespace NPT

#endif
