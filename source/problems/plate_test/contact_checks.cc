// SPDX-License-Identifier: LGPL-2.1-or-later
// Overlap of bundles and number of active contact nodes at the ends of stages.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/short_number.h>
#include <npt_dealii/homogenization/bundle_overlap.h>
#include <npt_dealii/problems/plate_test/cell_contacts.h>
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

    unsigned int
    cuts_of(const LoadStage &stage, const std::vector<CurveRow> &curve)
    {
      unsigned int n = 0;
      for (const CurveRow &row : curve)
        n += row.stage == stage.name ? row.cuts : 0;
      return n;
    }
  } // namespace



  ContactChecks::ContactChecks(const PlateTestParameters &parameters,
                               RunLog                    &log)
    : parameters_(parameters)
    , log_(log)
  {}



  bool
  ContactChecks::is_woven() const
  {
    return parameters_.cell.type != "laminate";
  }



  void
  ContactChecks::check_overlap(const PlateCell                     &cell,
                               const LoadStage                     &stage,
                               const State                         &state,
                               const std::vector<dealii::Point<3>> &woven,
                               const unsigned int                   n_cuts)
  {
    const BundleOverlap overlap =
      find_overlap(cell.fabric(),
                   cell.bodies().space(),
                   cell.macro(),
                   state.u,
                   woven,
                   stage.bends_along,
                   has_round_edges(cell.fabric(), parameters_.contact),
                   cell.bodies().ranks());
    const double thickness = parameters_.cell.bundle_thickness.smaller();
    const double allowed   = parameters_.contact.maximum_overlap * thickness;
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
    if (overlap.depth > allowed && parameters_.contact.maximum_overlap < 1.)
      throw StageFailed(
        what + ". That is more than Maximum overlap, " +
          short_number(parameters_.contact.maximum_overlap) +
          " of the thickness (subsection Contact), and describes no "
          "fabric.",
        "bundles overlap",
        stage.name,
        1.,
        n_cuts,
        advice);
    if (overlap.depth > 1.1 * overlap_warned_of_)
      log_.warning(what + ". What to try: " + advice + ".");
    overlap_warned_of_ = std::max(overlap_warned_of_, overlap.depth);
  }



  void
  ContactChecks::check_active_nodes(const PlateCell             &cell,
                                    const LoadStage             &stage,
                                    const std::vector<CurveRow> &curve,
                                    const unsigned int           n_cuts) const
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
          throw StageFailed(
            what + ".",
            "no contact",
            stage.name,
            1.,
            n_cuts,
            "a finer mesh if bundles are narrower than a few elements, or "
            "Method = KTS (subsection Contact)");
        log_.warning(what + ".");
      }
    else if (n < enough_nodes && !(n_before < enough_nodes)) // once
      log_.warning("Only " + short_number(n, 2) +
                   " contact nodes per crossing carry load at the end of "
                   "stage " +
                   stage.name +
                   "; below about ten, friction and torsion of a crossing are "
                   "coarse, and several states whose resultants differ by a "
                   "percent may be in equilibrium: other cells or steps may "
                   "lead to another one. What to try: more Elements along and "
                   "across, or Method = KTS (subsection Contact).");
  }



  void
  ContactChecks::warn_of_unwoven_bundles(const unsigned int stage) const
  {
    const auto &stages = parameters_.load_programme.stages;
    if (!is_woven() || stage > 0 || stages[0].type == LoadStage::Type::weave)
      return;
    log_.warning(
      "Stage " + stages[0].name +
      " loads bundles that no stage has woven: straight bars of warp and weft "
      "that only touch where they cross, not a fabric. Begin with Stages = "
      "weave, release, ... (subsection Load programme) to test the fabric.");
  }



  void
  ContactChecks::warn_of_coarse_averages(const PlateCell &cell) const
  {
    if (!is_woven() ||
        parameters_.contact.method != ContactParameters::Method::mortar)
      return;
    double n = std::numeric_limits<double>::max();
    for (const ContactCandidates &pair : cell.fabric().contacts())
      if (pair.direction == 2)
        n = std::min(n,
                     n_spans_across_partner(cell.fabric(),
                                            cell.bodies().space(),
                                            pair.secondary_bundle));
    if (n < fewest_spans_for_mortar)
      log_.warning(
        "A crossing bundle is only " + short_number(n, 2) +
        " elements wide; averages of mortar contact reach over three. "
        "Contact is posed at Gauss points there, as with Method = KTS "
        "(subsection Contact); more Elements along (subsection Mesh) "
        "would resolve it.");
  }



  void
  ContactChecks::check(const PlateCell                     &cell,
                       const LoadStage                     &stage,
                       const State                         &state,
                       const std::vector<dealii::Point<3>> &woven,
                       const std::vector<CurveRow>         &curve)
  {
    if (!is_woven())
      return;
    const unsigned int n_cuts = cuts_of(stage, curve);
    check_overlap(cell, stage, state, woven, n_cuts);
    check_active_nodes(cell, stage, curve, n_cuts);
  }
} // namespace NPT
