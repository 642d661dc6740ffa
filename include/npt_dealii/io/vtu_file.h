// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the VTU files, rational Bezier cells with their fields, and the PVD
// record that lists them over a run.

#ifndef npt_dealii_io_vtu_file_h
#define npt_dealii_io_vtu_file_h

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace NPT
{
  /**
   * A named field on the control points or on the cells of a mesh.
   *
   * `values` holds `n_components` numbers per control point (or cell), control
   * point by control point. Components: 1 scalar, 3 vector, 9 tensor row by
   * row, 6 symmetric tensor in ParaView's order xx, yy, zz, xy, yz, xz.
   *
   * On Bezier control points the values are coefficients of the same rational
   * basis as the geometry, f = sum_a R_a f_a, and not nodal values.
   */
  struct BezierField
  {
    std::string         name;
    unsigned int        n_components = 1;
    std::vector<double> values;
  };

  /**
   * Rational Bezier cells as extraction delivers them.
   *
   * Each cell owns its control points; they follow one another cell by cell,
   * within a cell lexicographically (first direction fastest), (p_1+1)(p_2+1)
   * (p_3+1) per cell. For dim = 2 (surfaces in space) p_3 is ignored.
   */
  struct BezierMesh
  {
    /// 3 hexahedra, 2 quadrilaterals in space.
    unsigned int dim = 3;

    /// Degrees of each cell, one per direction, each at least 1.
    std::vector<std::array<unsigned int, 3>> degrees;

    /// Three coordinates per control point [mm], projected: x, not w x.
    std::vector<double> points;

    /// One positive weight per control point.
    std::vector<double> weights;

    std::vector<BezierField> point_data;
    std::vector<BezierField> cell_data;

    /// Number of control points of cell @p cell.
    unsigned int
    n_points_of_cell(const unsigned int cell) const;

    /**
     * Append control points of a cell and their fields.
     *
     * @param values  By control point: the position (3), then the components of
     *   all fields of point_data, in order.
     * @param all_weights By control point.
     * @param which   Which of them, in the order of the cell.
     */
    void
    append_points(const std::vector<std::vector<double>> &values,
                  const std::vector<double>              &all_weights,
                  const std::vector<unsigned int>        &which);
  };

  /**
   * How the numbers of a VTU file are stored.
   */
  enum class Encoding
  {
    ascii,     ///< 17 digits, for people and tests
    binary,    ///< base64
    compressed ///< zlib, then base64; plain base64 if deal.II has no zlib
  };

  /**
   * Return where VTK expects each control point of a higher-order cell:
   * corners, edges, faces, interior. Entry a is the position of lexicographic
   * control point a.
   *
   * The hexahedron's edges along the third direction go around the cell,
   * (0,0), (1,0), (1,1), (0,1). That is the numbering of VTU files of version
   * 2.1 and later; older files exchange the last two (deal.II 9.4 writes
   * those), and readers convert by the version number.
   */
  std::vector<unsigned int>
  lexicographic_to_vtk(const unsigned int                 dim,
                       const std::array<unsigned int, 3> &degrees);

  /**
   * Write rational Bezier cells (VTK types 79 and 77, VTU version 2.2), with
   * point data "RationalWeights" and cell data "HigherOrderDegrees".
   *
   * The file appears under its name only when complete. ParaView needs a
   * higher "nonlinear subdivision level" to draw the cells curved.
   */
  void
  write_vtu(const std::string &filename,
            const BezierMesh  &mesh,
            const Encoding     encoding = Encoding::compressed);

  /**
   * Write the record of a run: load times and the VTU files that belong to
   * them, named relative to the record. Call it with the grown list after each
   * output; the record on disk is valid at any time.
   */
  void
  write_pvd(const std::string                                 &filename,
            const std::vector<std::pair<double, std::string>> &times_and_names);
} // namespace NPT

#endif
