// SPDX-License-Identifier: LGPL-2.1-or-later
// Sizes and pictures of a cell of straight bundles.

#include <npt_dealii/homogenization/cell_modes.h>
#include <npt_dealii/io/vtu_file.h>
#include <npt_dealii/problems/plate_test/cell_preview.h>
#include <npt_dealii/solid/solid_fields.h>

#include <utility>

namespace NPT
{
  using dealii::Tensor;
  using dealii::Vector;

  namespace
  {
    // Straight bundles that just touch, warp above.
    double
    lift(const FabricCell &fabric, const FiberBundle &bundle)
    {
      const double half = 0.5 * fabric.weaving_offset();
      return bundle.family == FiberBundle::Family::warp ? half :
             bundle.family == FiberBundle::Family::weft ? -half :
                                                          0.;
    }

    void
    write_bundles(const PlateCell &cell, const std::string &filename)
    {
      const IGASpace<3> &space = cell.bodies().space();
      Vector<double>     u(cell.macro().n_unknowns());
      for (unsigned int b = 0; b < cell.fabric().bundles().size(); ++b)
        for (unsigned int l = 0; l < space.patch(b).n_control_points(); ++l)
          u[3 * space.control_point(b, l) + 2] =
            lift(cell.fabric(), cell.fabric().bundles()[b]);
      write_vtu(filename,
                make_bundle_fields(
                  space, cell.bodies().laws(), cell.bodies().gradients(), u));
    }

    // Pieces of neighboring cells whose surfaces are candidates for contact,
    // each once; false if there are none. A glide maps a straight bundle onto
    // its translate.
    bool
    write_images(const FabricCell          &fabric,
                 const PlateTestParameters &parameters,
                 const std::string         &filename)
    {
      std::vector<DeformablePart>                        parts;
      std::vector<double>                                lifts;
      std::vector<std::pair<unsigned int, Tensor<1, 3>>> known;
      for (const ContactCandidates &pair : fabric.contacts())
        for (const SurfaceImage &image : pair.primaries)
          {
            const Tensor<1, 3> &a      = image.operation.a;
            bool                is_new = a.norm() > 0;
            for (const auto &[bundle, shift] : known)
              is_new = is_new && (bundle != image.bundle ||
                                  (shift - a).norm() >
                                    1e-9 * length_unit(fabric.parameters()));
            if (!is_new)
              continue;
            known.emplace_back(image.bundle, a);
            const FiberBundle &bundle = fabric.bundles()[image.bundle];
            NURBSPatch<3>      patch  = bundle.patch;
            patch.transform([&](const dealii::Point<3> &P) { return P + a; });
            parts.push_back(
              {patch,
               make_material<3>(parameters.material, bundle.direction),
               static_cast<unsigned int>(parts.size()),
               "image"});
            lifts.push_back(lift(fabric, bundle));
          }
      if (parts.empty())
        return false;
      const DeformableBodies images(std::move(parts), parameters.mesh.basis);
      const IGASpace<3>     &space = images.space();
      Vector<double>         w(images.n_displacements());
      for (unsigned int b = 0; b < lifts.size(); ++b)
        for (unsigned int l = 0; l < space.patch(b).n_control_points(); ++l)
          w[3 * space.control_point(b, l) + 2] = lifts[b];
      write_vtu(
        filename,
        make_bundle_fields(space, images.laws(), images.gradients(), w));
      return true;
    }
  } // namespace



  void
  preview_cell(const PlateCell           &cell,
               const PlateTestParameters &parameters,
               const std::string         &directory,
               RunLog                    &log)
  {
    log.line("Geometry only.");
    if (!directory.empty())
      {
        write_bundles(cell, directory + "/geometry.vtu");
        const bool have_images =
          write_images(cell.fabric(), parameters, directory + "/images.vtu");
        log.line("Written: " + directory + "/geometry.vtu" +
                 (have_images ?
                    ", and images.vtu with the pieces of neighboring cells "
                    "that its bundles may touch." :
                    "."));
      }
    log.finish();
  }
} // namespace NPT
