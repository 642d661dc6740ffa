// SPDX-License-Identifier: LGPL-2.1-or-later
// Owns the over/under table of a weave.

#ifndef npt_dealii_cell_weave_pattern_h
#define npt_dealii_cell_weave_pattern_h

#include <string>
#include <vector>

namespace NPT
{
  /**
   * Which bundle is above at each crossing of a weave's repeat. Warp bundle i
   * lies at Y2 = i Lbar, weft bundle j at Y1 = j Lbar; the table continues
   * periodically.
   */
  class WeavePattern
  {
  public:
    /**
     * @param description plain, 2/2 twill, 5-harness satin, or a table with
     *   one row per weft bundle, separated by '/', one letter per warp bundle:
     *   o (warp over) or u (warp under).
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
    /// Whether a rotation by 180 degrees about the crossing of warp i and weft
    /// j maps the weave onto itself.
    bool
    has_two_fold_axis(const int warp, const int weft) const;
    /// Move the repeat so that a crossing with a two-fold axis and the warp
    /// over becomes (0,0); false if there is none (nothing is moved then).
    bool
    center_on_two_fold_axis();

  private:
    unsigned int      n_warp_, n_weft_;
    std::vector<bool> over_; // [weft][warp]
  };
} // namespace NPT

#endif
