// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the exchange of weaves with TexGen: its .tg3 files in and out.

#ifndef npt_dealii_fabric_files_texgen_h
#define npt_dealii_fabric_files_texgen_h

#include <npt_dealii/fabric/cell_parameters.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <iosfwd>
#include <string>
#include <vector>

namespace NPT
{
  /// A weave as a file of another program describes it.
  struct ImportedWeave
  {
    std::string    name; ///< of the textile
    CellParameters cell; ///< lengths in mm
    /// What the file says and the cell does not, one sentence each.
    std::vector<std::string> notes;
  };

  /**
   * Read a TexGen file (.tg3, XML) of any save mode.
   *
   * A `CTextileWeave2D` gives the over/under table and width, height and
   * spacing of every yarn; where yarns are there as well (save modes Standard
   * and Full), their sections are the ones that count, and sizes of the weave
   * that disagree are named in a note. A `CTextile` is a weave if its yarns run
   * along x and y: the table follows from the heights of the yarns at the
   * crossings. X yarns are our warp. Polygons at the nodes of yarns are those
   * of a woven state: the straight bundles get their mean width, height and
   * area, as a lens, and a note says so. `GeometryScale` (m, cm, mm, um, in,
   * ...) is converted to mm.
   *
   * Sections: ellipse, power ellipse, lenticular without distortion, rectangle
   * (as a rounded rectangle). Bundles here have blunt edges, which TexGen's do
   * not have; edges are as thin as their cells can be: a lens gets the tip
   * that gives it the area of two circular arcs, an ellipse is larger, and a
   * note says by how much.
   *
   * Materials are never taken: newer versions of TexGen write those of an
   * impregnated tow into every file. A note says what stands there.
   *
   * Throws InputError with one sentence that names file, yarn and what was
   * found for: no such file, no XML, no textile; layers, 3D and sheared weaves;
   * yarns that are not equal or not equally spaced; yarns across the axes;
   * sections that are none of the above; units that are unknown.
   */
  ImportedWeave
  read_texgen(const std::string &filename);

  /// A parameter file with the cell, its notes as comments, and the standard
  /// load programme.
  void
  write_parameter_file(const ImportedWeave &weave,
                       const std::string   &source,
                       std::ostream        &out);

  /**
   * Write a cell as a TexGen weave (`CTextileWeave2D`, to be built when it is
   * opened). read_texgen() gives the same cell again, but for the blunt tip.
   *
   * Throws InputError for a laminate and for sections that TexGen does not
   * have.
   */
  void
  write_texgen(const CellParameters &cell,
               const std::string    &name,
               std::ostream         &out);

  /// A textile in space; lengths in mm.
  struct WovenTextile
  {
    /// The section of a yarn at one place along it.
    struct Station
    {
      dealii::Point<3>     position;
      dealii::Tensor<1, 3> tangent; ///< unit vector, normal to the section
      dealii::Tensor<1, 3> up;      ///< unit vector in the section
      /// Corners, counterclockwise, as components along tangent x up and up.
      std::vector<std::array<double, 2>> section;
    };

    std::string                         name;
    std::array<dealii::Tensor<1, 3>, 2> repeats;
    /// By yarn, from one end of the repeat to the other.
    std::vector<std::vector<Station>> yarns;
    std::array<dealii::Point<3>, 2>   box; ///< corners of one repeat
  };

  /**
   * Write a textile as a `CTextile` of TexGen: yarns by nodes with periodic
   * cubic interpolation, and a polygon at every node (CYarnSectionInterpNode of
   * CSectionPolygon), linear between them. Format: PopulateTiXmlElement() of
   * these classes in the sources of TexGen.
   */
  void
  write_texgen(const WovenTextile &textile, std::ostream &out);
} // namespace NPT

#endif
