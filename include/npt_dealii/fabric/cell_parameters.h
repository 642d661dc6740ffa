// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the cell and mesh entries of the parameter file.

#ifndef npt_dealii_fabric_cell_parameters_h
#define npt_dealii_fabric_cell_parameters_h

#include <npt_dealii/base/parameter_binding.h>
#include <npt_dealii/fabric/bundle_section.h>
#include <npt_dealii/iga/iga_space.h>

#include <deal.II/base/parameter_handler.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace NPT
{
  /// A quantity of the warp bundles and of the weft bundles.
  struct WarpWeft
  {
    double warp, weft;

    /// The same for both.
    WarpWeft(const double both)
      : warp(both)
      , weft(both)
    {}
    WarpWeft(const double of_warp, const double of_weft)
      : warp(of_warp)
      , weft(of_weft)
    {}
    double
    smaller() const
    {
      return std::min(warp, weft);
    }
    double
    mean() const
    {
      return 0.5 * (warp + weft);
    }
  };

  /// One number for warp and weft, or one for each.
  template <>
  struct EntryValue<WarpWeft>
  {
    static std::string
    text(const WarpWeft &value);
    static WarpWeft
    value(const std::string &text);
    /// Both > 0.
    static std::unique_ptr<dealii::Patterns::PatternBase>
    pattern();
  };

  /// Subsection "Cell": geometry of the weave.
  struct CellParameters
  {
    WarpWeft crossing_spacing = 5.0; ///< of parallel bundles [mm]
    WarpWeft bundle_width     = 4.0; ///< w [mm]
    WarpWeft bundle_thickness = 1.2; ///< t [mm]

    std::string section   = "lens"; ///< a name of Registry<SectionShape>
    double      blunt_tip = 0.1;    ///< e / t [-]
    /// Numbers of all shapes by entry, see BundleSection::numbers.
    std::map<std::string, double> section_numbers;

    double weaving_depth = 1.0; ///< [-]
    /// "automatic" is the smallest that represents modes 1 to 3, unless the
    /// load programme asks for more.
    std::string type          = "automatic";
    std::string weave         = "plain"; ///< name or table
    bool        two_fold_axis = true;
    /// Mirror planes across the bundles as constraints.
    enum class MirrorPlanes
    {
      automatic, ///< no, unless the load programme is known and allows them
      yes,
      no
    };
    MirrorPlanes mirror_planes = MirrorPlanes::automatic;
    /// Whether a piece of a bundle may stand for others, also for those to
    /// which only a shift of the cell leads. No entry: linear jumps that bend
    /// the cell are not the same for both, so the load programme decides.
    bool integrate_pieces = false;
    /// C1 over the periodic faces and between crossings.
    enum class SmoothClosure
    {
      automatic,
      yes,
      no
    };
    SmoothClosure smooth_closure = SmoothClosure::automatic;
    bool          images         = true;
    enum class SideContact
    {
      automatic,
      on,
      off
    };
    SideContact         side_contact   = SideContact::automatic;
    bool                warp_secondary = false; ///< which side carries nodes
    std::vector<double> plies          = {0.};  ///< laminate: angles [degrees]
    /// Layers of the woven cell, each shifted in plane against the one below.
    unsigned int        n_layers    = 1;
    std::vector<double> layer_shift = {0., 0.}; ///< along Y1, Y2 [mm]

    BundleSection
    warp_section() const;
    BundleSection
    weft_section() const;

    /// Why there can be no mirror planes; empty if there can.
    std::string
    obstacle_to_mirror_planes() const;

    /// Bind the members to the entries of the subsection.
    void
    add_parameters(dealii::ParameterHandler &prm);
    /// Throws InputError for impossible combinations.
    void
    check() const;

  private:
    void
    add_section_parameters(dealii::ParameterHandler &prm);

    void
    add_constraint_parameters(dealii::ParameterHandler &prm);
  };

  template <>
  const EnumNames<CellParameters::SideContact> &
  enum_names<CellParameters::SideContact>();

  template <>
  const EnumNames<CellParameters::MirrorPlanes> &
  enum_names<CellParameters::MirrorPlanes>();

  template <>
  const EnumNames<CellParameters::SmoothClosure> &
  enum_names<CellParameters::SmoothClosure>();

  /// Subsection "Mesh": discretization of each bundle.
  struct MeshParameters
  {
    Basis        basis            = Basis::NURBS;
    unsigned int degree           = 2;
    unsigned int elements_along   = 9;
    unsigned int elements_across  = 9;
    unsigned int elements_through = 2;
    /// Weave on half as many elements first.
    enum class CoarserWeaving
    {
      automatic,
      yes,
      no
    };
    CoarserWeaving coarser_weaving = CoarserWeaving::automatic;

    /// Bind the members to the entries of the subsection.
    void
    add_parameters(dealii::ParameterHandler &prm);
  };

  template <>
  const EnumNames<MeshParameters::CoarserWeaving> &
  enum_names<MeshParameters::CoarserWeaving>();
} // namespace NPT

#endif
