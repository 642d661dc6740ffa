// SPDX-License-Identifier: LGPL-2.1-or-later
// Finding the subsections that a shortened list leaves behind.

#include <npt_dealii/base/message_words.h>
#include <npt_dealii/base/parameter_binding.h>
#include <npt_dealii/base/parameter_file.h>
#include <npt_dealii/base/unused_sections.h>

#include <set>

namespace NPT
{
  namespace
  {
    // The items that were named once, but are no longer.
    std::set<std::string>
    dropped_items(const ParameterText            &text,
                  const std::vector<std::string> &overrides,
                  const std::string              &path)
    {
      std::set<std::string> items;
      visit_entries(text,
                    [&](const std::string              &place,
                        const ParameterText::Statement &statement) {
                      if (place == path)
                        for (const std::string &item :
                             split_list(statement.value))
                          items.insert(item);
                    });
      const auto last = get_entry(text, overrides, path);
      if (last)
        for (const std::string &item : split_list(*last))
          items.erase(item);
      return items;
    }
  } // namespace



  std::vector<ParameterText::Statement>
  take_out_subsections(ParameterText               &text,
                       const std::string           &section,
                       const std::set<std::string> &names)
  {
    using Kind = ParameterText::Kind;
    std::vector<std::string>              path; // of the present subsection
    std::size_t                           depth_of_unused = 0;
    std::vector<ParameterText::Statement> kept, taken_out;
    for (const ParameterText::Statement &statement : text.statements)
      {
        if (statement.kind == Kind::subsection)
          {
            if (depth_of_unused == 0 && path.size() == 1 &&
                path[0] == section && names.count(statement.name) > 0)
              {
                depth_of_unused = 2;
                taken_out.push_back(statement);
              }
            path.push_back(statement.name);
          }
        if (depth_of_unused == 0)
          kept.push_back(statement);
        if (statement.kind == Kind::end)
          {
            if (path.size() == depth_of_unused)
              depth_of_unused = 0;
            path.pop_back();
          }
      }
    text.statements = kept;
    return taken_out;
  }



  std::vector<std::string>
  remove_unused_sections(ParameterText                  &text,
                         const std::vector<std::string> &overrides,
                         const ListOfSections           &list)
  {
    auto items =
      dropped_items(text, overrides, list.section + "/" + list.entry);
    for (const std::string &item : list.always_there)
      items.erase(item);
    std::set<std::string> names;
    for (const std::string &item : items)
      names.insert(list.prefix + item);
    std::vector<std::string> remarks;
    for (const auto &begin : take_out_subsections(text, list.section, names))
      remarks.push_back(at_line(begin.file, begin.line) + "subsection " +
                        in_quotes(begin.name) + " is not used, because " +
                        list.entry + " no longer names it.");
    return remarks;
  }
} // namespace NPT
