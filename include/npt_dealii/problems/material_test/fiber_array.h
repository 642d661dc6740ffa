// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the micro cells: periodic arrays of parallel round fibers in a matrix
// as conforming NURBS patches, and their entries in the parameter file.

#ifndef npt_dealii_problems_material_test_fiber_array_h
#define npt_dealii_problems_material_test_fiber_array_h

#include <npt_dealii/base/parameter_binding.h>
#include <npt_dealii/iga/iga_space.h>
#include <npt_dealii/iga/nurbs_patch.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <string>
#include <vector>

namespace NPT
{
  enum class Packing
  {
    square,
    hexagonal
  };

  template <>
  const EnumNames<Packing> &
  enum_names<Packing>();

  /// The volume fraction at which neighboring fibers touch: pi/4 (square) or
  /// pi/(2 sqrt 3) (hexagonal).
  double
  volume_fraction_limit(const Packing packing);

  /// Subsection "Micro cell". Lengths have no influence on the stresses.
  struct MicroCellParameters
  {
    Packing      packing         = Packing::square;
    double       volume_fraction = 0.77; ///< of the fibers [-]
    double       fiber_radius    = 0.;   ///< R [mm]; 0: by the fraction
    double       fiber_spacing   = 1.;   ///< s, between axes [mm]
    unsigned int n_fibers        = 1;    ///< in the cell: 1, 2 or 4

    /// Bind the members to the entries of the subsection.
    void
    add_parameters(dealii::ParameterHandler &prm);

    /// Make radius and fraction agree. Throws InputError if fibers touch or
    /// overlap.
    void
    check();
  };

  /// Subsection "Micro mesh".
  struct MicroMeshParameters
  {
    Basis        basis           = Basis::NURBS;
    unsigned int degree          = 2;
    unsigned int elements_around = 8; ///< per sector
    unsigned int elements_fiber  = 3; ///< radially, core to interface
    unsigned int elements_matrix = 3; ///< radially, interface to cell boundary
    unsigned int elements_along  = 1; ///< along the fiber
    /// Gauss points per direction beyond degree + 1: arcs are rational, and
    /// with too few points even a homogeneous cell is not in equilibrium.
    unsigned int additional_gauss_points = 1;

    /// Bind the members to the entries of the subsection.
    void
    add_parameters(dealii::ParameterHandler &prm);
  };

  /**
   * Parallel fibers along direction 1 on a square or a hexagonal lattice in
   * the plane of directions 2 and 3; neighbors along direction 2 are one
   * spacing s apart.
   *
   * The plane is tiled by the polygons of points nearest to each fiber (a
   * square or a regular hexagon), and a cell is one, two or four such polygons
   * with its lattice. A polygon of n corners is made of n matrix patches
   * between an exact arc and a side, n fiber patches between a straight-sided
   * core and the arc, and the core: one patch (square) or three (hexagon).
   * There is no degenerate corner.
   *
   * Between two fibers the matrix is a thin ligament: at 77 % in a square
   * array 1 % of the spacing. Its half thickness at the angle phi is about
   * g + R phi^2 / 2, so the knots around are spread by
   * phi = phi_c sinh(beta t), phi_c^2 = 2 g / R: as many spans in the ligament
   * as outside, whatever the volume fraction.
   */
  class FiberArray
  {
  public:
    FiberArray(const MicroCellParameters &cell,
               const MicroMeshParameters &mesh);

    const std::vector<NURBSPatch<3>> &
    patches() const
    {
      return patches_;
    }
    bool
    is_fiber(const unsigned int patch) const
    {
      return is_fiber_[patch];
    }
    /// Edges of the cell: along the fibers, and two in the plane [mm].
    const std::array<dealii::Tensor<1, 3>, 3> &
    periods() const
    {
      return periods_;
    }
    /// Of the cell [mm^3].
    double
    volume() const
    {
      return volume_;
    }
    const MicroCellParameters &
    parameters() const
    {
      return parameters_;
    }
    /// Least distance between two fibers [mm].
    double
    ligament() const
    {
      return parameters_.fiber_spacing - 2. * parameters_.fiber_radius;
    }

  private:
    void
    add_polygon(const dealii::Tensor<1, 3> &center,
                const MicroMeshParameters  &mesh);

    MicroCellParameters                 parameters_;
    std::vector<NURBSPatch<3>>          patches_;
    std::vector<bool>                   is_fiber_;
    std::array<dealii::Tensor<1, 3>, 3> periods_;
    double                              volume_;
  };
} // namespace NPT

#endif
