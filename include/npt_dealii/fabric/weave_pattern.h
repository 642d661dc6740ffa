// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the over/under table of a weave.

#ifndef npt_dealii_fabric_weave_pattern_h
#define npt_dealii_fabric_weave_pattern_h

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace NPT
{
  /**
   * Which bundle is above at each crossing of a weave's repeat. Warp bundle i
   * lies at Y2 = i Lbar_2, weft bundle j at Y1 = j Lbar_1; the table continues
   * periodically.
   */
  class WeavePattern
  {
  public:
    /**
     * @param description A name of Registry<NamedWeave>, or a table with one
     *   row per weft bundle, separated by '/', one letter per warp bundle: o
     *   (warp over) or u (warp under).
     *
     * Throws InputError for anything else, naming what is wrong.
     */
    explicit WeavePattern(const std::string &description);

    unsigned int
    n_warp() const
    {
      return n_warp_;
    }
    unsigned int
    n_weft() const
    {
      return n_weft_;
    }
    /// Whether warp i is over weft j; any integers.
    bool
    warp_is_over(const int warp, const int weft) const;
    bool
    is_plain() const;
    /// Whether shifting the weave by this many warp and weft bundles maps it
    /// onto itself.
    bool
    is_translation(const int warp, const int weft) const;
    /// Whether the same shift exchanges over and under everywhere: with a
    /// mirror at the mid-plane it is a glide plane.
    bool
    is_glide(const int warp, const int weft) const;
    /// Whether there is a glide plane at all.
    bool
    has_glide() const;
    /// Whether two neighboring warp bundles (or weft bundles) are on the same
    /// sides everywhere: nothing crosses between them that keeps them apart.
    bool
    has_equal_neighbors(const bool warp) const;
    /// Whether a mirror across one family of bundles, after any shift and with
    /// or without exchange of over and under, maps the weave onto itself. Such
    /// a weave does not shear by itself.
    bool
    has_mirror() const;
    /// Whether a mirror across the warp bundles (`warp` true) or the weft
    /// bundles maps the weave onto itself, sides included: warp i goes to warp
    /// n - i, or weft j to weft n - j.
    bool
    is_mirror(const bool warp, const int n) const;
    /// Whether a rotation by 180 degrees about the point (warp / 2, weft / 2)
    /// maps the weave onto itself.
    bool
    has_two_fold_axis(const int twice_warp, const int twice_weft) const;
    /**
     * Renumber the bundles so that a 2-fold axis lies at a crossing (0, 0), if
     * possible with the warp over, or else between bundles 0 and 1.
     *
     * @return Twice the position (warp, weft) of the axis, 0 or 1 each; nothing
     *   if there is no axis (nothing is renumbered then).
     */
    std::optional<std::array<int, 2>>
    center_on_two_fold_axis();

  private:
    unsigned int      n_warp_, n_weft_;
    std::vector<bool> over_; // [weft][warp]
  };
} // namespace NPT

#endif
