// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the cell of a weave: which of its bundles are different, what relates
// them, and where they may touch.

#ifndef npt_dealii_fabric_woven_cell_h
#define npt_dealii_fabric_woven_cell_h

#include <npt_dealii/fabric/cell_layout.h>
#include <npt_dealii/fabric/cell_parameters.h>
#include <npt_dealii/fabric/weave_pattern.h>

#include <array>
#include <optional>
#include <vector>

namespace NPT
{
  /**
   * A bundle in its cell. Crossings are counted along it; those of the cell
   * begin with number `first`.
   */
  struct Strand
  {
    int          index;    ///< among the parallel bundles of the weave
    double       position; ///< of the axis, across [mm]
    int          first;
    unsigned int n_crossings;
    double       begin;  ///< along [mm]
    double       length; ///< along [mm]
  };

  /// The table, the spacings and the shifts that a type of cell admits.
  class WovenLattice
  {
  public:
    /// Throws InputError if the weave has no cell of the type.
    explicit WovenLattice(const CellParameters &cell);

    /// Renumbered so that the origin is on a 2-fold axis, if there is one.
    const WeavePattern &
    weave() const
    {
      return weave_;
    }
    /// Spacing of the crossings along direction 0 (Y1) or 1 (Y2) [mm].
    double
    spacing(const unsigned int direction) const
    {
      return spacing_[direction];
    }
    /// Twice the position (warp, weft) of the 2-fold axis, in bundles.
    const std::optional<std::array<int, 2>> &
    axis() const
    {
      return axis_;
    }
    /// +1: shifting by this many warp and weft bundles is a translation of this
    /// cell, -1: a glide plane, 0: neither.
    int
    shift_sign(const int warp, const int weft) const;

    /// All shifts within reach of the bundles, nearest first; the first one is
    /// the identity.
    std::vector<SymmetryOperation>
    shifts() const;

    /// The 2-fold axis, if asked for, and the mirror planes across warp and
    /// weft, as far as the weave has them; all others follow with shifts.
    std::vector<SymmetryOperation>
    turns(const bool with_axis, const bool with_mirrors) const;

  private:
    WeavePattern                      weave_;
    bool                              translations_of_repeat_only_;
    bool                              with_glides_;
    std::array<double, 2>             spacing_;
    std::optional<std::array<int, 2>> axis_;
  };

  /// Secondary and primary faces of bundles that cross, and the edges of
  /// parallel neighbors if the cell asks for them.
  std::vector<ContactCandidates>
  find_contacts(const CellParameters                 &cell,
                const WovenLattice                   &lattice,
                const std::vector<SymmetryOperation> &shifts,
                const std::vector<FiberBundle>       &bundles,
                const std::vector<Strand>            &strands);

  /// The cell of a weave; see FabricCell. Throws InputError if the weave has no
  /// cell of the type.
  CellLayout
  make_woven_cell(const CellParameters &cell, const MeshParameters &mesh);
} // namespace NPT

#endif
