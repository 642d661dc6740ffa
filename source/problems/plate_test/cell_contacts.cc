// SPDX-License-Identifier: LGPL-2.1-or-later
// Surfaces of bundles against those of all images that they may touch.

#include <npt_dealii/problems/plate_test/cell_contacts.h>

#include <map>
#include <tuple>

namespace NPT
{
  CellContacts
  make_cell_contacts(const FabricCell         &cell,
                     const IGASpace<3>        &space,
                     const ContactParameters  &contact,
                     const FrictionParameters &friction,
                     const double              thickness,
                     MacroUnknowns            &macro)
  {
    CellContacts result;

    // Surfaces that may touch: faces of base bundles against images.
    // Kinks matter on the primary side only, where closest points are sought.
    std::map<std::tuple<unsigned int, unsigned int, unsigned int, bool>,
             const IGASurface<3> *>
      faces;

    const auto face = [&](const unsigned int bundle,
                          const unsigned int direction,
                          const unsigned int side,
                          const bool         primary) {
      const IGASurface<3> *&surface =
        faces[std::make_tuple(bundle, direction, side, primary)];
      if (surface == nullptr)
        {
          result.surfaces.push_back(
            std::make_unique<IGASurface<3>>(space,
                                            bundle,
                                            direction,
                                            side,
                                            primary ? contact.kink_rounding :
                                                      0.));
          surface = result.surfaces.back().get();
        }
      return surface;
    };
    for (const ContactCandidates &pair : cell.contacts())
      {
        std::vector<ContactSurface<3>> primaries;
        for (const SurfaceImage &image : pair.primaries)
          {
            const IGASurface<3> &surface =
              *face(image.bundle, image.direction, image.side, true);
            PeriodicImage periodic_image;
            periodic_image.operation     = image.operation;
            periodic_image.offset_sign   = image.offset_sign;
            periodic_image.first_unknown = macro.n_unknowns();
            std::vector<unsigned int> first_dof;
            for (unsigned int l = 0; l < surface.n_control_points(); ++l)
              {
                periodic_image.control_points.push_back(
                  surface.control_point(l));
                periodic_image.reference.push_back(
                  image.operation(surface.reference_position(l)));
                first_dof.push_back(periodic_image.first_unknown + 3 * l);
              }
            macro.n_image_unknowns += 3 * surface.n_control_points();
            const bool mirrored = image.operation.Q[0] * image.operation.Q[1] *
                                    image.operation.Q[2] <
                                  0;
            primaries.emplace_back(surface,
                                   periodic_image.reference,
                                   first_dof,
                                   mirrored);
            primaries.back().set_edge_radius(contact.edge_radius * thickness);
            result.images.push_back(periodic_image);
          }
        // Pieces of one strand continue each other.
        for (unsigned int i = 0; i < primaries.size(); ++i)
          {
            const SurfaceImage &image        = pair.primaries[i];
            int                 neighbors[2] = {-1, -1};
            for (unsigned int j = 0; j < primaries.size(); ++j)
              if (pair.primaries[j].strand == image.strand)
                {
                  if (pair.primaries[j].period == image.period - 1)
                    neighbors[0] = j;
                  if (pair.primaries[j].period == image.period + 1)
                    neighbors[1] = j;
                }
            primaries[i].set_strand(image.strand,
                                    image.period,
                                    neighbors[0],
                                    neighbors[1],
                                    image.direction == 2 ? 0 : 1);
          }
        // The edges of crimped neighbors cross like scissors and touch over a
        // fraction of an element: averages over control points would see that
        // only when they are deep in each other, Gauss points see it at once.
        ContactParameters contact_parameters = contact;
        if (pair.direction != 2)
          contact_parameters.method = "KTS";
        result.assemblers.push_back(std::make_unique<ContactAssembler<3>>(
          ContactSurface<3>(*face(
            pair.secondary_bundle, pair.direction, pair.secondary_side, false)),
          primaries,
          contact_parameters,
          friction,
          contact.maximum_penetration * thickness,
          // Side contact is counted once per bundle, see FabricCell.
          pair.direction == 2 ?
            [&cell, &pair](const dealii::Point<3> &X) {
              return cell.symmetry_weight(pair.secondary_bundle, X);
            } :
            ContactAssembler<3>::SymmetryWeight()));
      }
    return result;
  }
} // namespace NPT
