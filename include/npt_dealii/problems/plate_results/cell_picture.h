// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the picture of a deformed cell: the faces of its bundles as grids of
// points, their images that make it a fabric, and the script that draws them.

#ifndef npt_dealii_problems_plate_results_cell_picture_h
#define npt_dealii_problems_plate_results_cell_picture_h

#include <npt_dealii/fabric/fabric_cell.h>
#include <npt_dealii/homogenization/macro_modes.h>
#include <npt_dealii/iga/iga_space.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace NPT
{
  /// A part of a surface in space: quadrilaterals between the points of a grid.
  struct PictureSurface
  {
    unsigned int                       n_columns = 0;
    std::vector<std::array<double, 4>> points; ///< x, y, z [mm], value; by rows
    enum class Facing
    {
      up,    ///< and all that is nothing else
      front, ///< edges that face +x or -y
      down   ///< hidden from above
    };
    Facing facing = Facing::up;
  };

  /// The state of a cell that is drawn; one entry of each per control point.
  struct PictureState
  {
    std::vector<dealii::Point<3>> positions; ///< x of the base cell [mm]
    std::vector<double>           values;    ///< those of the color
    /// Places to which bending and torsion refer [mm], see make_couplings();
    /// empty: the reference ones.
    std::vector<dealii::Point<3>>     woven;
    std::array<double, MacroModes::n> H; ///< gradients, by mode
    /// With objective jumps: the direction of curvature.
    std::optional<dealii::Tensor<1, 2>> bends_along;
  };

  /**
   * The outer faces of the bundles of one repeat of the weave, see
   * FabricCell::repeat(): bottom, top and edges, and the sections where a
   * strand ends. An image of the base cell is
   *
   * @f[ x(QX + a) = Q\,x(X) + a + \sum_n H_n
   *       \left( w_m^n(QZ + a) - Q\,w_m^n(Z) \right), @f]
   *
   * Z = X or the woven place, or with objective jumps S_a Q x, see
   * CylinderMotion. Every cell of the mesh gives at least one
   * quadrilateral, and every crossing about nine by nine on each wide face.
   * Points lie on the surfaces of the VTU files.
   */
  std::vector<PictureSurface>
  make_picture_surfaces(const FabricCell   &cell,
                        const IGASpace<3>  &space,
                        const PictureState &state);

  /**
   * Write NAME.dat with the surfaces and NAME.gp, which draws them as NAME.svg
   * and NAME.png: seen obliquely from above, the nearer faces over the farther
   * ones. Faces that face down come last in the table and are not drawn: half
   * of the work, and gnuplot, which sorts whole quadrilaterals by distance,
   * would show corners of them where bundles touch. For the same reason the
   * edges in front are sorted a little nearer than they are.
   *
   * @param folder Existing folder.
   * @param title Above the picture.
   * @param quantity What the colors mean, with its unit.
   */
  void
  write_cell_picture(const std::string                 &folder,
                     const std::string                 &name,
                     const std::string                 &title,
                     const std::string                 &quantity,
                     const std::vector<PictureSurface> &surfaces);
} // namespace NPT

#endif
