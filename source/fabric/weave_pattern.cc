// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the over/under tables of weaves and their symmetries.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/message_words.h>
#include <npt_dealii/fabric/named_weave.h>
#include <npt_dealii/fabric/weave_pattern.h>

namespace NPT
{
  namespace
  {
    // Looking for symmetries takes the square of the number of crossings, and a
    // cell of so many bundles could not be computed.
    constexpr unsigned int most_bundles = 64;
  } // namespace



  WeavePattern::WeavePattern(const std::string &description)
  {
    const auto       &weaves = Registry<NamedWeave>::instance();
    const std::string table  = weaves.contains(description) ?
                                 weaves.get(description).table :
                                 description;

    n_warp_ = n_weft_   = 0;
    unsigned int in_row = 0;
    for (const char c : table + "/")
      if (c == 'o' || c == 'u')
        {
          over_.push_back(c == 'o');
          ++in_row;
        }
      else if (c == '/')
        {
          if (n_weft_ == 0)
            n_warp_ = in_row;
          if (in_row == 0 || in_row != n_warp_)
            throw InputError(
              "Weave is " + in_quotes(description) + "; row " +
              std::to_string(n_weft_ + 1) + " has " + std::to_string(in_row) +
              " letters where the first has " + std::to_string(n_warp_) +
              "; all rows need the same number, at least one "
              "(subsection Cell).");
          ++n_weft_;
          in_row = 0;
        }
      else if (c != ' ')
        throw InputError("Weave is " + in_quotes(description) +
                         "; it must be " + joined(weaves.names(), ", ") +
                         " or a table of the letters o and u with rows "
                         "separated by '/', such as ou/uo" +
                         did_you_mean(description, weaves.names()) +
                         " (subsection Cell).");

    if (n_warp_ > most_bundles || n_weft_ > most_bundles)
      throw InputError("Weave is a table of " + std::to_string(n_weft_) +
                       " rows with " + std::to_string(n_warp_) +
                       " letters; there may be at most " +
                       std::to_string(most_bundles) +
                       " of each (subsection "
                       "Cell).");
    // A bundle that never changes sides is not woven in: it would fall out.
    for (unsigned int i = 0; i < n_warp_; ++i)
      {
        unsigned int n_over = 0;
        for (unsigned int j = 0; j < n_weft_; ++j)
          n_over += warp_is_over(i, j);
        if (n_over == 0 || n_over == n_weft_)
          throw InputError("Weave is " + in_quotes(description) +
                           "; warp bundle " + std::to_string(i + 1) +
                           " never changes sides, so it is not woven in "
                           "(subsection Cell).");
      }
    for (unsigned int j = 0; j < n_weft_; ++j)
      {
        unsigned int n_over = 0;
        for (unsigned int i = 0; i < n_warp_; ++i)
          n_over += warp_is_over(i, j);
        if (n_over == 0 || n_over == n_warp_)
          throw InputError("Weave is " + in_quotes(description) +
                           "; weft bundle " + std::to_string(j + 1) +
                           " never changes sides, so it is not woven in "
                           "(subsection Cell).");
      }
  }



  bool
  WeavePattern::warp_is_over(const int warp, const int weft) const
  {
    const auto wrap = [](const int i, const int n) {
      return ((i % n) + n) % n;
    };
    return over_[wrap(weft, n_weft_) * n_warp_ + wrap(warp, n_warp_)];
  }



  bool
  WeavePattern::is_plain() const
  {
    for (unsigned int j = 0; j < n_weft_; ++j)
      for (unsigned int i = 0; i < n_warp_; ++i)
        if (warp_is_over(i, j) == warp_is_over(i + 1, j) ||
            warp_is_over(i, j) == warp_is_over(i, j + 1))
          return false;
    return true;
  }



  bool
  WeavePattern::is_translation(const int warp, const int weft) const
  {
    for (unsigned int j = 0; j < n_weft_; ++j)
      for (unsigned int i = 0; i < n_warp_; ++i)
        if (warp_is_over(warp + i, weft + j) != warp_is_over(i, j))
          return false;
    return true;
  }



  bool
  WeavePattern::is_glide(const int warp, const int weft) const
  {
    for (unsigned int j = 0; j < n_weft_; ++j)
      for (unsigned int i = 0; i < n_warp_; ++i)
        if (warp_is_over(warp + i, weft + j) == warp_is_over(i, j))
          return false;
    return true;
  }



  bool
  WeavePattern::has_glide() const
  {
    for (unsigned int j = 0; j < n_weft_; ++j)
      for (unsigned int i = 0; i < n_warp_; ++i)
        if (is_glide(i, j))
          return true;
    return false;
  }



  bool
  WeavePattern::has_equal_neighbors(const bool warp) const
  {
    const int n = warp ? n_warp_ : n_weft_, n_along = warp ? n_weft_ : n_warp_;
    for (int i = 0; i < n; ++i)
      {
        bool equal = true;
        for (int j = 0; j < n_along && equal; ++j)
          equal = warp ? warp_is_over(i, j) == warp_is_over(i + 1, j) :
                         warp_is_over(j, i) == warp_is_over(j, i + 1);
        if (equal)
          return true;
      }
    return false;
  }



  bool
  WeavePattern::has_mirror() const
  {
    const int n_warp = n_warp_, n_weft = n_weft_;
    for (int k = 0; k < n_warp; ++k)
      for (int l = 0; l < n_weft; ++l)
        {
          // How many crossings keep their side when the warps, or the wefts,
          // are counted backwards.
          int by_warp = 0, by_weft = 0;
          for (int j = 0; j < n_weft; ++j)
            for (int i = 0; i < n_warp; ++i)
              {
                by_warp += warp_is_over(i, j) == warp_is_over(k - i, l + j);
                by_weft += warp_is_over(i, j) == warp_is_over(k + i, l - j);
              }
          const int all = n_warp * n_weft;
          if (by_warp == 0 || by_warp == all || by_weft == 0 || by_weft == all)
            return true;
        }
    return false;
  }



  bool
  WeavePattern::is_mirror(const bool warp, const int n) const
  {
    for (int j = 0; j < static_cast<int>(n_weft_); ++j)
      for (int i = 0; i < static_cast<int>(n_warp_); ++i)
        if (warp_is_over(i, j) !=
            (warp ? warp_is_over(n - i, j) : warp_is_over(i, n - j)))
          return false;
    return true;
  }



  bool
  WeavePattern::has_two_fold_axis(const int twice_warp,
                                  const int twice_weft) const
  {
    for (int j = 0; j < static_cast<int>(n_weft_); ++j)
      for (int i = 0; i < static_cast<int>(n_warp_); ++i)
        if (warp_is_over(i, j) != warp_is_over(twice_warp - i, twice_weft - j))
          return false;
    return true;
  }



  std::optional<std::array<int, 2>>
  WeavePattern::center_on_two_fold_axis()
  {
    // Crossings with the warp over, other crossings, then points between.
    for (unsigned int choice = 0; choice < 5; ++choice)
      for (unsigned int j = 0; j < n_weft_; ++j)
        for (unsigned int i = 0; i < n_warp_; ++i)
          {
            const int half_warp = choice == 2 || choice == 4;
            const int half_weft = choice == 3 || choice == 4;
            if ((choice == 0 && !warp_is_over(i, j)) ||
                !has_two_fold_axis(2 * i + half_warp, 2 * j + half_weft))
              continue;
            std::vector<bool> moved;
            for (unsigned int l = 0; l < n_weft_; ++l)
              for (unsigned int k = 0; k < n_warp_; ++k)
                moved.push_back(warp_is_over(k + i, l + j));
            over_ = moved;
            return std::array<int, 2>{{half_warp, half_weft}};
          }
    return {};
  }
} // namespace NPT
