// SPDX-License-Identifier: LGPL-2.1-or-later
// Surfaces of bundles against those of all images that they may touch.

#include <npt_dealii/problems/plate_test/cell_contacts.h>
#include <npt_dealii/problems/plate_test/contact_resolution.h>

#include <map>
#include <tuple>

namespace NPT
{
  namespace
  {
    // Edges whose half height is more than this part of the thickness are
    // thick.
    const double thick_tip = 0.25;

    // The surfaces of the base bundles, each made once.
    class BundleSurfaces
    {
    public:
      BundleSurfaces(const FabricCell        &cell,
                     const IGASpace<3>       &space,
                     const ContactParameters &contact)
        : cell_(cell)
        , space_(space)
        , kink_rounding_(contact.kink_rounding)
        , round_edges_(has_round_edges(cell, contact))
      {}

      // Kinks matter on the primary side only, where closest points are sought.
      const IGASurface<3> &
      get(const unsigned int bundle,
          const unsigned int direction,
          const unsigned int side,
          const bool         primary)
      {
        const IGASurface<3> *&surface =
          faces_[std::make_tuple(bundle, direction, side, primary)];
        if (surface == nullptr)
          {
            surfaces.push_back(std::make_unique<IGASurface<3>>(
              space_,
              bundle,
              direction,
              side,
              primary ? kink_rounding_ : 0.,
              round_edges_ && direction == 2 ? end_rounding(bundle) : 0.));
            surface = surfaces.back().get();
          }
        return *surface;
      }

      std::vector<std::unique_ptr<IGASurface<3>>> surfaces;

    private:
      // Part of the parameter across over which an edge is rounded: as wide as
      // half of the height of the edge.
      double
      end_rounding(const unsigned int bundle) const
      {
        const CellParameters &parameters = cell_.parameters();
        const bool            warp =
          cell_.bundles()[bundle].family == FiberBundle::Family::warp;
        const BundleSection section =
          warp ? parameters.warp_section() : parameters.weft_section();
        const NURBSPatch<3> &patch = space_.patch(bundle);
        const auto          &knots = patch.knot_vector(1).breaks();
        const auto           at    = [&](const double v) {
          return patch.value({patch.knot_vector(0).breaks().front(),
                              v,
                              0.5 * (patch.knot_vector(2).breaks().front() +
                                     patch.knot_vector(2).breaks().back())});
        };
        // Some of the wide face must be left between both edges.
        const double width = std::min(section.tip, 0.45 * section.width);
        double       low = 0., high = 0.5 * (knots.back() - knots.front());
        for (unsigned int i = 0; i < 60; ++i)
          {
            const double middle = 0.5 * (low + high);
            (at(knots.front() + middle).distance(at(knots.front())) < width ?
               low :
               high)            = middle;
          }
        // A round edge has the functions of the body, with all kinks of a C0
        // basis; it must not begin within a kink that is rounded.
        if (space_.basis() != Basis::NURBS)
          low = std::min(low, (1. - kink_rounding_) * (knots[1] - knots[0]));
        return low;
      }

      const FabricCell  &cell_;
      const IGASpace<3> &space_;
      const double       kink_rounding_;
      const bool         round_edges_;
      std::map<std::tuple<unsigned int, unsigned int, unsigned int, bool>,
               const IGASurface<3> *>
        faces_;
    };



    // The image of a surface, with unknowns of its own from first_unknown on.
    PeriodicImage
    make_image(const SurfaceImage  &image,
               const IGASurface<3> &surface,
               const unsigned int   first_unknown)
    {
      PeriodicImage result;
      result.operation     = image.operation;
      result.offset_sign   = image.offset_sign;
      result.first_unknown = first_unknown;
      for (unsigned int l = 0; l < surface.n_control_points(); ++l)
        {
          result.control_points.push_back(surface.control_point(l));
          result.reference.push_back(
            image.operation(surface.reference_position(l)));
        }
      return result;
    }



    ContactSurface<3>
    make_primary(const PeriodicImage        &image,
                 const IGASurface<3>        &surface,
                 const dealii::Tensor<1, 3> &fiber,
                 const double                edge_radius)
    {
      std::vector<unsigned int> first_dof;
      for (unsigned int l = 0; l < surface.n_control_points(); ++l)
        first_dof.push_back(image.first_unknown + 3 * l);
      const auto       &Q        = image.operation.Q;
      const bool        mirrored = Q[0] * Q[1] * Q[2] < 0;
      ContactSurface<3> result(surface, image.reference, first_dof, mirrored);
      result.set_edge_radius(edge_radius);
      dealii::Tensor<1, 3> fiber_of_image;
      for (unsigned int c = 0; c < 3; ++c)
        fiber_of_image[c] = Q[c] * fiber[c];
      result.set_fiber(fiber_of_image);
      return result;
    }



    // Pieces of one strand continue each other.
    void
    join_strands(const std::vector<SurfaceImage> &images,
                 std::vector<ContactSurface<3>>  &primaries)
    {
      for (unsigned int i = 0; i < primaries.size(); ++i)
        {
          const SurfaceImage &image        = images[i];
          int                 neighbors[2] = {-1, -1};
          for (unsigned int j = 0; j < primaries.size(); ++j)
            if (images[j].strand == image.strand)
              {
                if (images[j].period == image.period - 1)
                  neighbors[0] = j;
                if (images[j].period == image.period + 1)
                  neighbors[1] = j;
              }
          primaries[i].set_strand(image.strand,
                                  image.period,
                                  neighbors[0],
                                  neighbors[1],
                                  image.direction == 2 ? 0 : 1);
        }
    }
  } // namespace



  bool
  has_round_edges(const FabricCell &cell, const ContactParameters &contact)
  {
    using RoundEdges = ContactParameters::RoundEdges;
    if (cell.parameters().type == "laminate")
      return false;
    return contact.round_edges == RoundEdges::automatic ?
             cell.parameters().blunt_tip > thick_tip :
             contact.round_edges == RoundEdges::yes;
  }



  CellContacts
  make_cell_contacts(const FabricCell         &cell,
                     const IGASpace<3>        &space,
                     const ContactParameters  &contact,
                     const FrictionParameters &friction,
                     const double              thickness,
                     MacroUnknowns            &macro)
  {
    CellContacts   result;
    BundleSurfaces surfaces(cell, space, contact);
    const auto    &bundles = cell.bundles();
    for (const ContactCandidates &pair : cell.contacts())
      {
        std::vector<ContactSurface<3>> primaries;
        for (const SurfaceImage &image : pair.primaries)
          {
            const IGASurface<3> &surface =
              surfaces.get(image.bundle, image.direction, image.side, true);
            result.images.push_back(
              make_image(image, surface, macro.n_unknowns()));
            macro.n_image_unknowns += 3 * surface.n_control_points();
            primaries.push_back(make_primary(result.images.back(),
                                             surface,
                                             bundles[image.bundle].direction,
                                             contact.edge_radius * thickness));
          }
        join_strands(pair.primaries, primaries);

        // The edges of crimped neighbors cross like scissors and touch over a
        // fraction of an element: averages over control points would see that
        // only when they are deep in each other, Gauss points see it at once.
        // The same holds where a crossing bundle is narrower than a few
        // elements, and where layers touch anywhere.
        ContactParameters contact_parameters = contact;
        if (pair.direction != 2 || pair.between_layers ||
            (cell.parameters().type != "laminate" &&
             n_spans_across_partner(cell, space, pair.secondary_bundle) <
               fewest_spans_for_mortar))
          contact_parameters.method = ContactParameters::Method::KTS;
        ContactSurface<3> secondary(surfaces.get(
          pair.secondary_bundle, pair.direction, pair.secondary_side, false));
        secondary.set_fiber(bundles[pair.secondary_bundle].direction);
        result.pairs.push_back(std::make_unique<ContactPair<3>>(
          secondary,
          primaries,
          contact_parameters,
          friction,
          thickness,
          // Side contact is counted once per bundle, see FabricCell.
          pair.direction == 2 ?
            [&cell, &pair](const dealii::Point<3> &X) {
              return cell.symmetry_weight(pair.secondary_bundle, X);
            } :
            ContactPair<3>::SymmetryWeight()));
      }
    result.surfaces = std::move(surfaces.surfaces);
    return result;
  }
} // namespace NPT
