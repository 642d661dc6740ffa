// SPDX-License-Identifier: LGPL-2.1-or-later
// Counting the elements of an XML text that are open.

#include <npt_dealii/fabric_files/xml_depth.h>

#include <algorithm>

namespace NPT
{
  namespace
  {
    // Behind the end of what began at a place; the end of the text if there is
    // none.
    std::size_t
    behind(const std::string &text,
           const std::size_t  begin,
           const std::string &end)
    {
      const std::size_t found = text.find(end, begin);
      return found == std::string::npos ? text.size() : found + end.size();
    }

    // Behind the '>' of a tag; one within quotes does not end it.
    std::size_t
    behind_tag(const std::string &text, std::size_t at)
    {
      for (char quote = 0; at < text.size(); ++at)
        if (quote != 0)
          quote = text[at] == quote ? 0 : quote;
        else if (text[at] == '"' || text[at] == '\'')
          quote = text[at];
        else if (text[at] == '>')
          return at + 1;
      return text.size();
    }
  } // namespace



  unsigned int
  xml_depth(const std::string &text)
  {
    unsigned int depth = 0, deepest = 0;
    for (std::size_t at = text.find('<'); at != std::string::npos;
         at             = text.find('<', at))
      if (text.compare(at, 4, "<!--") == 0)
        at = behind(text, at + 4, "-->");
      else if (text.compare(at, 9, "<![CDATA[") == 0)
        at = behind(text, at + 9, "]]>");
      else if (text.compare(at, 2, "<?") == 0)
        at = behind(text, at + 2, "?>");
      else if (text.compare(at, 2, "<!") == 0)
        at = behind(text, at + 2, ">");
      else if (text.compare(at, 2, "</") == 0)
        {
                      depth -= depth > 0;
                      at = behind(text, at + 2, ">");
        }
      else
        {
                      at = behind_tag(text, at + 1);
                      if (text.compare(at - std::min<std::size_t>(at, 2), 2, "/>") != 0)
            deepest = std::max(deepest, ++depth);
        }
    return deepest;
  }
} // namespace NPT
