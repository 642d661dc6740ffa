// SPDX-License-Identifier: LGPL-2.1-or-later
// Gathering, reading and cross-checking of all parameters.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/problem_names.h>
#include <npt_dealii/fabric/fabric_cell.h>
#include <npt_dealii/problems/plate_test/plate_test_parameters.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <tuple>

namespace NPT
{
  namespace Patterns = dealii::Patterns;

  void
  OutputParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Output");
    {
      prm.declare_entry("Directory",
                        "output",
                        Patterns::DirectoryName(),
                        "Where all results go; created if missing. The option "
                        "--output of the program overrides it.");
      prm.declare_entry("Fields",
                        "stages",
                        Patterns::Selection("none|stages|steps"),
                        "When fields (VTU) are written: never, at the end of "
                        "every stage, or after every accepted load step.");
      prm.declare_entry(
        "Picture",
        "true",
        Patterns::Bool(),
        "Draw with gnuplot: at the end of every stage the deformed "
        "cell, colored by von Mises stress (cell_STAGE.svg), "
        "and at the end of the run the curves (curves.svg).");
    }
    prm.leave_subsection();
  }



  void
  OutputParameters::parse_parameters(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Output");
    directory = prm.get("Directory");
    fields    = prm.get("Fields");
    picture   = prm.get_bool("Picture");
    prm.leave_subsection();
  }



  void
  StabilityParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii;
    prm.enter_subsection("Stability");
    {
      prm.declare_entry(
        "Check ellipticity",
        "false",
        Patterns::Bool(),
        "Search all quadrature points for the lowest eigenvalue of the "
        "acoustic tensor after each load step. A step at which it is not "
        "positive is refused and cut, so that the run ends at the loss of "
        "ellipticity and names bundle, place and direction. Takes two to four "
        "times the CPU time of a run without it. If a stage fails for another "
        "reason, its last accepted state is checked in any case.");
    }
    prm.leave_subsection();
  }



  void
  StabilityParameters::parse_parameters(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Stability");
    check_ellipticity = prm.get_bool("Check ellipticity");
    prm.leave_subsection();
  }



  namespace
  {
    void
    declare_all(dealii::ParameterHandler       &prm,
                const std::vector<std::string> &stages)
    {
      declare_problem(prm, "plate test");
      CellParameters::declare_parameters(prm);
      MeshParameters::declare_parameters(prm);
      MaterialParameters::declare_parameters(prm);
      MaterialParameters::declare_parameters(prm, "Weft material", "warp");
      ContactParameters::declare_parameters(prm);
      FrictionParameters::declare_parameters(prm);
      LoadProgramme::declare_parameters(prm, stages);
      NewtonParameters::declare_parameters(prm);
      LinearSolverParameters::declare_parameters(prm);
      StabilityParameters::declare_parameters(prm);
      OutputParameters::declare_parameters(prm);
    }

    // Whether the programme shears so far that the edges of parallel
    // neighbors come near each other. In shear H3 the lines of a family turn by
    // H3/2, and their distance falls to spacing (1 - H3^2/4) / (1 +
    // H3^2/4)^1/2.
    bool
    neighbors_may_touch(const PlateTestParameters &parameters)
    {
      double shear = 0;
      for (const LoadStage &stage : parameters.load_programme.stages)
        {
          for (const auto &target : stage.H_targets)
            if (target.first == 2)
              shear = std::max(shear, std::abs(target.second));
          // How far a force shears is not known in advance.
          for (const auto &target : stage.n_targets)
            if (target.first == 2 && target.second != 0.)
              shear = 2.;
        }
      const double h      = 0.25 * shear * shear;
      const double factor = (1. - h) / std::sqrt(1. + h);
      const auto  &cell   = parameters.cell;
      // The width of a family against the spacing of its bundles.
      return factor * cell.crossing_spacing.warp <
               1.1 * cell.bundle_width.warp ||
             factor * cell.crossing_spacing.weft < 1.1 * cell.bundle_width.weft;
    }

    // A mode that the cell's symmetry forbids would give wrong numbers without
    // any sign of error, so it is refused here.
    void
    check_modes(const PlateTestParameters &parameters)
    {
      const FabricCell cell(parameters.cell, parameters.mesh);
      for (const LoadStage &stage : parameters.load_programme.stages)
        {
          const auto check = [&](const unsigned int n,
                                 const std::string &letter) {
            if (!cell.represents_mode(n))
              throw InputError(
                "Stage " + stage.name + " prescribes " + letter +
                std::to_string(n + 1) + ", which the " + parameters.cell.type +
                " cannot represent: its " + cell.obstacle(n) +
                " turns this mode into its opposite, so that the cell would "
                "rotate instead of deforming; only H1, H2 and H3 are allowed "
                "(subsection Stage " +
                stage.name + ").");
          };
          for (const auto &target : stage.H_targets)
            check(target.first, "H");
          for (const auto &target : stage.n_targets)
            check(target.first, "n");
        }
    }

    // Where a smooth closure would gain nothing or could not be kept.
    void
    check_smooth_closure(const PlateTestParameters &parameters)
    {
      if (!parameters.cell.smooth_closure)
        return;
      if (parameters.mesh.basis != Basis::NURBS)
        throw InputError(
          std::string("Smooth closure is true with the Basis ") +
          (parameters.mesh.basis == Basis::Bernstein ? "Bernstein" :
                                                       "Lagrange") +
          ", whose functions are only C0 between all elements, so that a "
          "smooth seam would gain nothing; use Basis = NURBS or Smooth "
          "closure = false (subsections Cell and Mesh).");
      for (const LoadStage &stage : parameters.load_programme.stages)
        if (stage.type != LoadStage::Type::load)
          for (unsigned int n = 3; n < 6; ++n)
            if (stage.H_targets.count(n) + stage.n_targets.count(n) > 0)
              throw InputError(
                "Smooth closure is true and stage " + stage.name +
                " prescribes mode " + std::to_string(n + 1) +
                ", but the woven state, to which bending and torsion refer, "
                "must then be reached without them; prescribe it in a load "
                "stage (subsections Cell and Stage " +
                stage.name + ").");
    }
  } // namespace



  PlateTestParameters
  PlateTestParameters::read(const ParameterText            &text,
                            const std::vector<std::string> &overrides)
  {
    // First pass: the names of the stages, which decide what else there is to
    // declare. An unusable list is reported by the second pass.
    std::vector<std::string> stages = LoadProgramme::read_stage_names("");
    if (const auto entry = get_entry(text, overrides, "Load programme/Stages"))
      {
        const auto names = dealii::Utilities::split_string_list(*entry, ',');
        if (!names.empty())
          stages = names;
      }

    dealii::ParameterHandler prm;
    declare_all(prm, stages);
    parse_parameter_text(prm, text, overrides);

    PlateTestParameters parameters;
    parameters.cell.parse_parameters(prm);
    parameters.mesh.parse_parameters(prm);
    parameters.material.parse_parameters(prm);
    parameters.weft_material.parse_parameters(prm,
                                              "Weft material",
                                              &parameters.material);
    parameters.contact.parse_parameters(prm);
    parameters.friction.parse_parameters(prm);
    parameters.load_programme.parse_parameters(prm);
    parameters.newton.parse_parameters(prm);
    parameters.linear_solver.parse_parameters(prm);
    parameters.stability.parse_parameters(prm);
    parameters.output.parse_parameters(prm);
    if (parameters.cell.type == "automatic")
      {
        std::vector<unsigned int> modes;
        for (const LoadStage &stage : parameters.load_programme.stages)
          {
            for (const auto &target : stage.H_targets)
              modes.push_back(target.first);
            for (const auto &target : stage.n_targets)
              modes.push_back(target.first);
          }
        std::tie(parameters.cell.type, parameters.reason_for_type) =
          FabricCell::smallest_type(parameters.cell, modes);
      }
    if (parameters.cell.side_contact == CellParameters::SideContact::automatic)
      parameters.cell.side_contact = neighbors_may_touch(parameters) ?
                                       CellParameters::SideContact::on :
                                       CellParameters::SideContact::off;
    check_modes(parameters);
    check_smooth_closure(parameters);

    std::ostringstream used;
    print_documented_parameters(prm, used);
    parameters.used_file = used.str();
    return parameters;
  }



  std::string
  PlateTestParameters::documented_defaults()
  {
    dealii::ParameterHandler prm;
    declare_all(prm, LoadProgramme::read_stage_names(""));
    std::ostringstream out;
    print_documented_parameters(prm, out);
    return out.str();
  }
} // namespace NPT
