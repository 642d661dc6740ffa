// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines how deep the elements of an XML text are nested.

#ifndef npt_dealii_fabric_files_xml_depth_h
#define npt_dealii_fabric_files_xml_depth_h

#include <string>

namespace NPT
{
  /**
   * The number of elements that lie within one another at the deepest place of
   * an XML text; comments, CDATA, and declarations do not count. Of a text that
   * is no XML some number.
   *
   * Readers of XML call themselves once per level, so that a text of nothing
   * but `<a>` a hundred thousand times ends them without a word.
   */
  unsigned int
  xml_depth(const std::string &text);
} // namespace NPT

#endif
