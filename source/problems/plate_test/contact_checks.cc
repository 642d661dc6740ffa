// SPDX-License-Identifier: LGPL-2.1-or-later
// Overlap of bundles and number of active contact nodes at the ends of stages.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/short_number.h>
#include <npt_dealii/homogenization/bundle_overlap.h>
#include <npt_dealii/problems/plate_test/contact_checks.h>
#include <npt_dealii/problems/plate_test/contact_resolution.h>

#include <algorithm>
#include <limits>
#include <string>

namespace NPT
{
  namespace
  {
    // With fewer active nodes per crossing pressure and friction are those of
    // a handful of numbers; see doc/studies.md.
    constexpr double enough_nodes = 10.;

    // Of the allowed overlap: worth a warning.
    constexpr double much = 0.25;

    bool
    is_woven_type(const PlateCell &cell)
    {
      return cell.fabric().parameters().type != "laminate";
    }

    [[noreturn]] void
    fail(const std::string           &account,
         const std::string           &reason,
         const std::string           &advice,
         const LoadStage             &stage,
         const std::vector<CurveRow> &curve)
    {
      unsigned int n_cuts = 0;
      for (const CurveRow &row : curve)
        n_cuts += row.stage == stage.name ? row.cuts : 0;
      throw StageFailed(account, reason, stage.name, 1., n_cuts, advice);
    }

    void
    check_overlap(const PlateCell                     &cell,
                  const PlateTestParameters           &parameters,
                  const LoadStage                     &stage,
                  const State                         &state,
                  const std::vector<dealii::Point<3>> &woven,
                  const std::vector<CurveRow>         &curve,
                  RunLog                              &log)
    {
      const BundleOverlap overlap = find_overlap(
        cell.fabric(), cell.bodies().space(), cell.macro(), state.u, woven);
      const double thickness = parameters.cell.bundle_thickness.smaller();
      const double allowed   = parameters.contact.maximum_overlap * thickness;
      // Where everything is allowed the usual limit tells what is much.
      if (overlap.depth <=
          much *
            std::min(allowed, ContactParameters().maximum_overlap * thickness))
        return;
      const std::string what =
        "Bundles lie in each other by " + short_number(overlap.depth, 2) +
        " mm, " + short_number(100. * overlap.depth / thickness, 2) +
        " % of their thickness and " + short_number(100. * overlap.share, 2) +
        " % of their volume, at the end of stage " + stage.name + ": " +
        describe(overlap, cell.fabric());
      const std::string advice =
        "a larger Normal penalty, Enforcement = augmented Lagrangian, a finer "
        "mesh if bundles are narrower than a few elements (or Method = KTS), "
        "Side contact = on if these are neighbors";
      if (overlap.depth > allowed && parameters.contact.maximum_overlap < 1.)
        fail(what + ". That is more than Maximum overlap, " +
               short_number(parameters.contact.maximum_overlap) +
               " of the thickness (subsection Contact), and describes no "
               "fabric.",
             "bundles overlap",
             advice,
             stage,
             curve);
      log.warning(what + ". What to try: " + advice + ".");
    }

    void
    check_active_nodes(const PlateCell             &cell,
                       const LoadStage             &stage,
                       const std::vector<CurveRow> &curve,
                       RunLog                      &log)
    {
      const CellParameters &parameters = cell.fabric().parameters();
      const double          crossings =
        cell.fabric().area() /
        (parameters.crossing_spacing.warp * parameters.crossing_spacing.weft);
      const double n        = curve.back().n_active / crossings;
      double       n_before = std::numeric_limits<double>::max();
      for (const CurveRow &row : curve)
        if (row.stage != stage.name)
          n_before = row.n_active / crossings;
      if (curve.back().n_active == 0)
        {
          const std::string what = "No contact node carries load at the end of "
                                   "stage " +
                                   stage.name +
                                   ": the bundles do not touch each other";
          if (stage.type == LoadStage::Type::weave)
            fail(what + ".",
                 "no contact",
                 "a finer mesh if bundles are narrower than a few elements, or "
                 "Method = KTS (subsection Contact)",
                 stage,
                 curve);
          log.warning(what + ".");
        }
      else if (n < enough_nodes && !(n_before < enough_nodes)) // once
        log.warning("Only " + short_number(n, 2) +
                    " contact nodes per crossing carry load at the end of "
                    "stage " +
                    stage.name +
                    "; below about ten, friction and torsion of a crossing are "
                    "coarse. What to try: more Elements along and across, or "
                    "Method = KTS (subsection Contact).");
    }
  } // namespace



  void
  warn_of_unwoven_bundles(const PlateCell           &cell,
                          const PlateTestParameters &parameters,
                          const unsigned int         stage,
                          RunLog                    &log)
  {
    const auto &stages = parameters.load_programme.stages;
    if (!is_woven_type(cell) || stage > 0 ||
        stages[0].type == LoadStage::Type::weave)
      return;
    log.warning(
      "Stage " + stages[0].name +
      " loads bundles that no stage has woven: straight bars of warp and weft "
      "that only touch where they cross, not a fabric. Begin with Stages = "
      "weave, release, ... (subsection Load programme) to test the fabric.");
  }



  void
  warn_of_coarse_averages(const PlateCell           &cell,
                          const PlateTestParameters &parameters,
                          RunLog                    &log)
  {
    if (!is_woven_type(cell) ||
        parameters.contact.method != ContactParameters::Method::mortar)
      return;
    double n = std::numeric_limits<double>::max();
    for (const ContactCandidates &pair : cell.fabric().contacts())
      if (pair.direction == 2)
        n = std::min(n,
                     n_spans_across_partner(cell.fabric(),
                                            cell.bodies().space(),
                                            pair.secondary_bundle));
    if (n < fewest_spans_for_mortar)
      log.warning(
        "A crossing bundle is only " + short_number(n, 2) +
        " elements wide; averages of mortar contact reach over three. "
        "Contact is posed at Gauss points there, as with Method = KTS "
        "(subsection Contact); more Elements along (subsection Mesh) "
        "would resolve it.");
  }



  void
  check_contact(const PlateCell                     &cell,
                const PlateTestParameters           &parameters,
                const LoadStage                     &stage,
                const State                         &state,
                const std::vector<dealii::Point<3>> &woven,
                const std::vector<CurveRow>         &curve,
                RunLog                              &log)
  {
    if (!is_woven_type(cell))
      return;
    check_overlap(cell, parameters, stage, state, woven, curve, log);
    check_active_nodes(cell, stage, curve, log);
  }
} // namespace NPT
