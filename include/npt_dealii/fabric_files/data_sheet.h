// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the data sheet of a fabric in the units of its users, and the cell
// and the stiffness that follow from it.

#ifndef npt_dealii_fabric_files_data_sheet_h
#define npt_dealii_fabric_files_data_sheet_h

#include <npt_dealii/base/own_numbers.h>
#include <npt_dealii/base/parameter_text.h>
#include <npt_dealii/fabric/cell_parameters.h>
#include <npt_dealii/material/fiber_bundle_law.h>

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace NPT
{
  /**
   * What a data sheet says of a fabric. Each quantity is there or not; a number
   * for warp and weft each, or one for both. In a file the values may carry a
   * unit, as in `34 per inch` or `600 denier`.
   */
  struct DataSheet
  {
    using Pair = std::optional<WarpWeft>;

    std::string name;
    std::string weave     = "plain"; ///< name or table, as in subsection Cell
    std::string section   = "lens";  ///< a name of Registry<SectionShape>
    double      blunt_tip = 0.1;     ///< e / t [-]
    /// Numbers of all shapes by entry.
    OwnValues section_numbers;

    Pair count;            ///< bundles per length across them [1/cm]
    Pair spacing;          ///< instead of the count [mm]
    Pair linear_density;   ///< of a bundle [tex]
    Pair fiber_density;    ///< [g/cm^3]
    Pair fiber_fraction;   ///< of the section of a bundle [-]
    Pair bundle_width;     ///< [mm]
    Pair bundle_thickness; ///< [mm]
    Pair crimp;            ///< length of a bundle over that of the fabric - 1
    Pair fabric_thickness; ///< warp == weft [mm]
    Pair areal_density;    ///< warp == weft [g/m^2]
    Pair fiber_modulus;    ///< [GPa]

    double shear_modulus_along  = 10.; ///< G_L of a bundle [MPa]
    double shear_modulus_across = 5.;  ///< G_T [MPa]
    double friction             = 0.3; ///< coefficient [-]
    double tension              = 0.1; ///< n1 = n2 under which is tested [N/mm]

    /// Bind the members to the entries of the subsection.
    void
    add_parameters(dealii::ParameterHandler &prm);

    /**
     * Read a file with the subsection "Data sheet" and nothing else.
     *
     * Throws InputError with file and line for what is no data sheet, a value
     * that is no number in its range, and a unit that is not known.
     */
    static DataSheet
    read(const ParameterText            &text,
         const std::vector<std::string> &overrides = {});

    /// A documented data sheet in which all is missing, to be filled in.
    static std::string
    documented_form();
  };

  /// What follows from a data sheet.
  struct FabricDesign
  {
    CellParameters cell;                  ///< numbers rounded to five digits
    WarpWeft       linear_density   = 0.; ///< [tex]
    WarpWeft       fiber_density    = 0.; ///< [g/cm^3]
    WarpWeft       fiber_fraction   = 0.; ///< in the section of the cell [-]
    WarpWeft       wave_height      = 0.; ///< amplitude of the middle line [mm]
    WarpWeft       crimp            = 0.; ///< [-]
    double         areal_density    = 0.; ///< [g/m^2]
    double         fabric_thickness = 0.; ///< from face to face [mm]
    double         cover_factor     = 0.; ///< part of the area with bundles [-]
    /// Shear angle at which parallel bundles touch [rad].
    double locking_angle = 0.;
    /// Warp and weft, if they have their modulus.
    std::vector<FiberBundleConstants> material;
    /// How each number was found and checked, one sentence each.
    std::vector<std::string> notes;
  };

  /// How far what a sheet says may be from what follows from its other numbers.
  namespace SheetTolerance
  {
    constexpr double count            = 0.02; ///< against the spacing
    constexpr double areal_density    = 0.05;
    constexpr double fiber_fraction   = 0.1;
    constexpr double wave_height      = 0.3; ///< .3 is .6 in crimp
    constexpr double fabric_thickness = 0.15;
    /// Fibers side by side and in gaps, pi / (2 sqrt 3).
    constexpr double packing = 0.9069;
  } // namespace SheetTolerance

  /**
   * Derive a cell and its materials from a data sheet.
   *
   * With the tex number T, the fiber density rho and the section A of a bundle
   * the fiber fraction is (A39)
   *
   * @f[ v = \frac{T}{\rho A} , @f]
   *
   * which gives any one of T, rho, v, width and thickness from the others. A
   * thickness that is not given otherwise is half of that of the fabric, or
   * what the crimp needs: bundles that touch have (A41)
   *
   * @f[ h_{warp} + h_{weft} = \frac12 (t_{warp} + t_{weft}), \quad
   *     m = \sum_i n_i T_i (1 + c_i), \quad
   *     k = d_1 + d_2 - d_1 d_2, \quad d_i = w_i / \bar L_i @f]
   *
   * with the areal density m and the cover factor k. Parallel bundles that turn
   * at a constant length touch at the shear angle g with cos g = max d_i. The
   * modulus along a bundle is v times that of its fibers.
   *
   * Throws InputError with one sentence: which number is missing and what it
   * may follow from; which numbers disagree, with both values and the
   * tolerance; and what CellParameters::check() refuses.
   */
  FabricDesign
  design_fabric(const DataSheet &sheet);

  /// A parameter file with the cell, the materials and a load programme, and
  /// the notes as comments.
  void
  write_parameter_file(const DataSheet   &sheet,
                       const std::string &source,
                       std::ostream      &out);
} // namespace NPT

#endif
