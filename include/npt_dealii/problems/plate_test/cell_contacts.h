// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the contact of a fabric cell: the surfaces that may touch, the images
// they meet in neighboring cells, and the contact pairs.

#ifndef npt_dealii_problems_plate_test_cell_contacts_h
#define npt_dealii_problems_plate_test_cell_contacts_h

#include <npt_dealii/contact/contact_pair.h>
#include <npt_dealii/fabric/fabric_cell.h>
#include <npt_dealii/homogenization/fabric_couplings.h>
#include <npt_dealii/homogenization/macro_unknowns.h>

#include <memory>
#include <vector>

namespace NPT
{
  struct CellContacts
  {
    std::vector<std::unique_ptr<IGASurface<3>>> surfaces; ///< of base bundles
    /// One for each entry of FabricCell::contacts(); they refer to surfaces.
    std::vector<std::unique_ptr<ContactPair<3>>> pairs;
    /// The images, whose control points have unknowns of their own.
    std::vector<PeriodicImage> images;
  };

  /// Whether the wide faces of bundles end in round edges, (A47) of
  /// doc/theory.md: as said, or if their blunt edges are thick.
  bool
  has_round_edges(const FabricCell &cell, const ContactParameters &contact);

  /**
   * Make the contact of a cell.
   *
   * @param cell      Must live as long as the result.
   * @param space     The same.
   * @param thickness Of the thinner bundles [mm], unit of the edge radius and
   *   of the largest penetration.
   * @param macro     The unknowns of the images are added to its images.
   */
  CellContacts
  make_cell_contacts(const FabricCell         &cell,
                     const IGASpace<3>        &space,
                     const ContactParameters  &contact,
                     const FrictionParameters &friction,
                     const double              thickness,
                     MacroUnknowns            &macro);
} // namespace NPT

#endif
