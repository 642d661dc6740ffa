// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the cell and mesh entries of the parameter file, and which sizes of
// bundles are possible.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/message_words.h>
#include <npt_dealii/base/short_number.h>
#include <npt_dealii/fabric/cell_parameters.h>
#include <npt_dealii/fabric/named_weave.h>
#include <npt_dealii/fabric/section_shape.h>
#include <npt_dealii/fabric/woven_cell.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace NPT
{
  namespace Patterns = dealii::Patterns;

  std::string
  EntryValue<WarpWeft>::text(const WarpWeft &value)
  {
    const std::string warp = EntryValue<double>::text(value.warp);
    return value.warp == value.weft ?
             warp :
             warp + ", " + EntryValue<double>::text(value.weft);
  }



  WarpWeft
  EntryValue<WarpWeft>::value(const std::string &text)
  {
    const auto values = EntryValue<std::vector<double>>::value(text);
    return WarpWeft(values.front(), values.back());
  }



  std::unique_ptr<Patterns::PatternBase>
  EntryValue<WarpWeft>::pattern()
  {
    return std::make_unique<Patterns::List>(positive_number(), 1, 2);
  }



  template <>
  const EnumNames<CellParameters::SideContact> &
  enum_names<CellParameters::SideContact>()
  {
    using SideContact                         = CellParameters::SideContact;
    static const EnumNames<SideContact> names = {{SideContact::automatic,
                                                  "automatic"},
                                                 {SideContact::on, "on"},
                                                 {SideContact::off, "off"}};
    return names;
  }



  template <>
  const EnumNames<CellParameters::MirrorPlanes> &
  enum_names<CellParameters::MirrorPlanes>()
  {
    using MirrorPlanes                         = CellParameters::MirrorPlanes;
    static const EnumNames<MirrorPlanes> names = {{MirrorPlanes::automatic,
                                                   "automatic"},
                                                  {MirrorPlanes::yes, "true"},
                                                  {MirrorPlanes::no, "false"}};
    return names;
  }



  template <>
  const EnumNames<CellParameters::SmoothClosure> &
  enum_names<CellParameters::SmoothClosure>()
  {
    using SmoothClosure                         = CellParameters::SmoothClosure;
    static const EnumNames<SmoothClosure> names = {
      {SmoothClosure::automatic, "automatic"},
      {SmoothClosure::yes, "true"},
      {SmoothClosure::no, "false"}};
    return names;
  }



  void
  CellParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    const ParameterSubsection subsection(prm, "Cell");
    add_parameter(
      prm,
      "Type",
      type,
      "Which periodic piece is computed. The sub-unit cell is the piece of a "
      "weave between its glide planes, Eqs. (47)-(48), one crossing of a "
      "plain weave; it represents H1, H2 and H3 only. The primitive cell is "
      "the smallest piece coupled by translations and represents all six "
      "modes; for the plain weave it is the two-crossing cell. The unit cell "
      "is the whole repeat of the table. automatic takes the smallest one "
      "that is valid for the load programme. laminate is a stack of plies "
      "without contact, to check against classical plate theory.",
      Patterns::Selection("automatic|sub-unit cell|two-crossing cell|"
                          "primitive cell|unit cell|laminate"));
    add_parameter(prm,
                  "Weave",
                  weave,
                  joined(Registry<NamedWeave>::instance().names(), ", ") +
                    ", or a table with one row per weft bundle, rows separated "
                    "by '/', o where the warp is over and u where it is under: "
                    "ou/uo is the plain weave.");
    add_parameter(prm,
                  "Images",
                  images,
                  "Let bundles touch the continuation of bundles in "
                  "neighboring cells, Eq. (49); needed when large shear "
                  "carries the contact zone over the edge of the cell.");
    add_parameter(
      prm,
      "Side contact",
      side_contact,
      "Contact between the edges of parallel neighbors, which jam at large "
      "shear (locking). automatic: on if nothing crosses between neighbors on "
      "the same side (rib, basket), if the load programme brings their lines "
      "nearer than 1.1 widths, or if how near is not known in advance (n < 0, "
      "shear by a force, moments); the log says which.");
    add_parameter(
      prm,
      "Secondary bundles",
      warp_secondary ? "warp" : "weft",
      [this](const std::string &text) { warp_secondary = text == "warp"; },
      "Which bundles carry the contact nodes: the secondary "
      "side, which is projected onto the other one. The "
      "finer mesh should be the secondary one.",
      Patterns::Selection("warp|weft"));
    add_parameter(prm,
                  "Plies",
                  plies,
                  "Laminate only: fiber angles of the plies from bottom "
                  "to top [degrees]. The total thickness is the bundle "
                  "thickness.",
                  Patterns::List(Patterns::Double(-180., 180.), 1));
    add_parameter(prm,
                  "Layers",
                  n_layers,
                  "Layers of woven fabric on each other [-], for compression "
                  "between plates: each is the whole cell and is woven apart "
                  "from the others; they come into contact when a stage of "
                  "type compression presses them. More than one need a cell "
                  "without glide plane, and do not use the two-fold axis.",
                  Patterns::Integer(1, 20));
    add_parameter(prm,
                  "Layer shift",
                  layer_shift,
                  "Shift of each layer against the one below it, along Y1 and "
                  "along Y2 [mm]. Layers nest where the crests of one meet the "
                  "hollows of the other. The shift is held.",
                  Patterns::List(Patterns::Double(), 2, 2));
    add_section_parameters(prm);
    add_constraint_parameters(prm);
  }



  void
  CellParameters::add_section_parameters(dealii::ParameterHandler &prm)
  {
    add_parameter(prm,
                  "Crossing spacing",
                  crossing_spacing,
                  "Distance Lbar between neighboring parallel bundles "
                  "[mm]; two numbers: between warp bundles (along Y2), "
                  "between weft bundles (along Y1).");
    add_parameter(prm,
                  "Bundle width",
                  bundle_width,
                  "Width w of a bundle [mm], smaller than the crossing "
                  "spacing; two numbers: of warp, of weft.");
    add_parameter(prm,
                  "Bundle thickness",
                  bundle_thickness,
                  "Thickness t of a bundle at its center [mm]; two "
                  "numbers: of warp, of weft.");

    const auto &shapes = Registry<SectionShape>::instance();
    add_parameter(
      prm,
      "Section",
      section,
      "Cross section of the bundles. Lens, ellipse and power ellipse are arches "
      "h = t/2 (1 - c (2y/w)^2)^(n/2) that end in a blunt edge, with n = 2 "
      "for the lens, n = 1 for the ellipse; the rounded rectangle has flat "
      "faces, arcs of 60 degrees and side faces.",
      Patterns::Selection(shapes.selection()));
    add_own_numbers(prm, section_numbers, shapes);
    add_parameter(prm,
                  "Blunt tip",
                  blunt_tip,
                  "Half height of the blunt edge of a bundle as a "
                  "fraction e/t of its thickness [-]. The arcs of the "
                  "rounded rectangle have the radius t - 2e.",
                  Patterns::Double(0.001, 0.499));
  }



  void
  CellParameters::add_constraint_parameters(dealii::ParameterHandler &prm)
  {
    add_parameter(prm,
                  "Weaving depth",
                  weaving_depth,
                  "Fraction of the full weaving displacement [-]: at 1 "
                  "the ends of both bundles meet at the mid-plane, at 0 "
                  "the bundles stay straight and just touch.",
                  Patterns::Double(0., 1.));
    add_parameter(prm,
                  "Two-fold axis",
                  two_fold_axis,
                  "Use the two-fold axis of the weave through the "
                  "crossing as a constraint. It holds for all modes, "
                  "removes rigid motions without pins and makes the "
                  "centered state stable; false pins one point of the cell "
                  "instead.");
    add_parameter(
      prm,
      "Mirror planes",
      mirror_planes,
      "Use the mirror planes of the weave across its bundles as constraints: a "
      "quarter of the cell is integrated instead of a half. They forbid H3 and "
      "H6, whose resultants are zero then, and exclude states that break the "
      "symmetry. automatic: true where the weave has them, no stage prescribes "
      "H3, H6, n3 or n6 but as zero, and none compresses the fabric in its "
      "plane, where it may shear by itself. false also without the Two-fold "
      "axis.");
    add_parameter(
      prm,
      "Smooth closure",
      smooth_closure,
      "Join the end of a bundle to its continuation in the next cell, and "
      "the pieces between crossings, with a common tangent (C1), Eq. (A18), "
      "instead of continuously only (C0). Needs the NURBS basis. It takes "
      "away the kink at the seam and three unknowns per control point of "
      "it; mind that a bundle then has less freedom than with C0 seams, so "
      "that a coarse mesh is stiffer. automatic: true in all weaves but the "
      "plain one, because elsewhere bundles pass two crossings on the same "
      "side, so that their seams bend and their edges would fold there.");
  }



  namespace
  {
    // What is wrong with the sizes of one family of bundles, or nothing.
    std::string
    obstacle(const BundleSection &section,
             const double         spacing,
             const std::string   &whose)
    {
      const double       w = section.width, t = section.thickness;
      const std::string  of_whose = whose.empty() ? "" : "of " + whose;
      std::ostringstream message;
      const double       smallest = std::min({w, t, spacing}),
                   largest        = std::max({w, t, spacing});
      // Volumes and their derivatives are products of many lengths.
      if (smallest < 1e-20 || largest > 1e20)
        message
          << "A size of the cell " << of_whose << "is "
          << (smallest < 1e-20 ? smallest : largest)
          << " mm; widths, thicknesses and spacings must be between 1e-20 "
             "and 1e20 mm";
      else if (w >= spacing)
        message << "Bundle width " << of_whose << "is " << w
                << " mm; it must be smaller than the crossing spacing of "
                << spacing << " mm, or parallel bundles overlap";
      else if (t >= w)
        message << "Bundle thickness " << of_whose << "is " << t
                << " mm; it must be smaller than the bundle width of " << w
                << " mm";
      else if (!section.obstacle().empty())
        message << section.obstacle();
      else if (section.edge_angle() > 75.)
        {
          // Entries of the shape steer the angle besides the tip.
          std::string numbers, remedies;
          for (const OwnNumber &own :
               Registry<SectionShape>::instance().get(section.shape).numbers)
            {
              numbers += own.entry + " is " +
                         short_number(section.number(own.entry)) +
                         " with a Blunt tip of ";
              remedies += " or a larger " + own.entry;
            }
          message << (numbers.empty() ? "Blunt tip is " : numbers)
                  << section.tip / t << "; the wide face of a " << whose
                  << "bundle of " << w << " mm by " << t
                  << " mm would meet the edge at "
                  << std::round(section.edge_angle())
                  << " degrees, and beyond 75 cells degenerate; take a larger "
                  << "Blunt tip" << remedies;
        }
      return message.str();
    }
  } // namespace



  void
  CellParameters::check() const
  {
    // With one number for both, the sentence need not say whose it is.
    const bool equal = crossing_spacing.warp == crossing_spacing.weft &&
                       bundle_width.warp == bundle_width.weft &&
                       bundle_thickness.warp == bundle_thickness.weft;
    for (const bool warp : {true, false})
      {
        const std::string message =
          obstacle(warp ? warp_section() : weft_section(),
                   warp ? crossing_spacing.warp : crossing_spacing.weft,
                   equal ? "" :
                   warp  ? "warp " :
                           "weft ");
        if (!message.empty())
          throw InputError(message + " (subsection Cell).");
      }
    if (mirror_planes == MirrorPlanes::yes)
      {
        const std::string obstacle = obstacle_to_mirror_planes();
        if (!obstacle.empty())
          throw InputError("Mirror planes is true, but " + obstacle +
                           "; use automatic or false (subsection Cell).");
      }
    if (n_layers > 1 && (type == "sub-unit cell" || type == "laminate"))
      throw InputError("Layers is " + std::to_string(n_layers) +
                       " with Type = " + type +
                       "; layers of fabric need a cell without glide plane, as "
                       "Type = primitive cell or automatic (subsection Cell).");
  }



  std::string
  CellParameters::obstacle_to_mirror_planes() const
  {
    if (type == "laminate")
      return "a laminate is no weave";
    if (n_layers > 1)
      return "layers of fabric have no mirror planes in common";
    if (!two_fold_axis)
      return "Two-fold axis is false, which follows from two mirror planes";
    if (WovenLattice(*this).turns(false, true).empty())
      return "the weave '" + weave + "' has none across its bundles";
    return "";
  }



  BundleSection
  CellParameters::warp_section() const
  {
    return {section,
            bundle_width.warp,
            bundle_thickness.warp,
            blunt_tip * bundle_thickness.warp,
            section_numbers};
  }



  BundleSection
  CellParameters::weft_section() const
  {
    return {section,
            bundle_width.weft,
            bundle_thickness.weft,
            blunt_tip * bundle_thickness.weft,
            section_numbers};
  }



  template <>
  const EnumNames<MeshParameters::CoarserWeaving> &
  enum_names<MeshParameters::CoarserWeaving>()
  {
    using CoarserWeaving = MeshParameters::CoarserWeaving;
    static const EnumNames<CoarserWeaving> names = {
      {CoarserWeaving::automatic, "automatic"},
      {CoarserWeaving::yes, "true"},
      {CoarserWeaving::no, "false"}};
    return names;
  }



  void
  MeshParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    const ParameterSubsection subsection(prm, "Mesh");
    add_parameter(
      prm,
      "Basis",
      basis,
      "Functions of geometry and displacement: NURBS are smooth splines "
      "(Model A), Bernstein cuts the same patches to C0 (Model B), Lagrange "
      "uses deal.II's FE_Q on the same knot spans.");
    add_parameter(prm,
                  "Degree",
                  degree,
                  "Polynomial degree p in all directions [-].",
                  Patterns::Integer(2, 5));
    add_parameter(prm,
                  "Elements along",
                  elements_along,
                  "Knot spans n_A along a bundle [-].",
                  Patterns::Integer(1, 200));
    add_parameter(prm,
                  "Elements across",
                  elements_across,
                  "Knot spans n_B across a bundle [-].",
                  Patterns::Integer(1, 200));
    add_parameter(prm,
                  "Elements through",
                  elements_through,
                  "Knot spans through the thickness [-].",
                  Patterns::Integer(1, 50));
    add_parameter(
      prm,
      "Weave on coarser mesh",
      coarser_weaving,
      "Weave on half as many elements first (if those are many, on a quarter "
      "before) and carry the woven state over: the weave stage is then one "
      "load step, for a fraction of the time. Without friction the woven state "
      "does not depend on the way to it; with friction in the weave stage, and "
      "with Basis = Lagrange, the entry has no effect. automatic: from 10,000 "
      "unknowns and 13 elements along and across on. A state that does not serve is no failure: weaving then "
      "begins with straight bundles.");
  }
} // namespace NPT
