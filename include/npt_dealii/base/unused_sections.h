// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what becomes of the subsections of a list whose items were taken off
// the list again.

#ifndef npt_dealii_base_unused_sections_h
#define npt_dealii_base_unused_sections_h

#include <npt_dealii/base/parameter_text.h>

#include <set>
#include <string>
#include <vector>

namespace NPT
{
  /// An entry that names items, each of which has a subsection beside it.
  struct ListOfSections
  {
    std::string section; ///< "Load programme"
    std::string entry;   ///< "Stages"
    std::string prefix;  ///< "Stage ", in front of an item
    /// Items that have a subsection in any case.
    std::vector<std::string> always_there = {};
  };

  /**
   * Take subsections out of a text.
   *
   * @param text    Changed.
   * @param section Outermost subsection in which they stand.
   * @param names   Of them.
   * @return Where they began.
   */
  std::vector<ParameterText::Statement>
  take_out_subsections(ParameterText               &text,
                       const std::string           &section,
                       const std::set<std::string> &names);

  /**
   * Take the subsections out of a text whose items an earlier value of the list
   * names and the last one does not: a file that includes another one, or the
   * command line, has shortened the list.
   *
   * @param text      Changed.
   * @param overrides Of the command line; they count after the text.
   * @return A sentence for every subsection that was taken out, with its place.
   *
   * A subsection that no value of the list names stays, and is a mistake.
   */
  std::vector<std::string>
  remove_unused_sections(ParameterText                  &text,
                         const std::vector<std::string> &overrides,
                         const ListOfSections           &list);
} // namespace NPT

#endif
