// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the view of what a ParameterHandler has declared: sections, entries
// and their texts, in the order of declaration.

#ifndef npt_dealii_base_declared_parameters_h
#define npt_dealii_base_declared_parameters_h

#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace NPT
{
  struct DeclaredEntry
  {
    std::string name;
    std::string value;
    std::string default_value;
    std::string documentation;
    std::string pattern;
    std::string alias_of; ///< empty for a proper entry
  };

  struct DeclaredSection
  {
    std::string                  name;
    std::vector<DeclaredEntry>   entries;
    std::vector<DeclaredSection> subsections;

    const DeclaredEntry *
    find_entry(const std::string &entry_name) const
    {
      for (const DeclaredEntry &entry : entries)
        if (entry.name == entry_name)
          return &entry;
      return nullptr;
    }

    const DeclaredSection *
    find_subsection(const std::string &subsection_name) const
    {
      for (const DeclaredSection &subsection : subsections)
        if (subsection.name == subsection_name)
          return &subsection;
      return nullptr;
    }

    std::vector<std::string>
    entry_names() const
    {
      std::vector<std::string> names;
      for (const DeclaredEntry &entry : entries)
        if (entry.alias_of.empty())
          names.push_back(entry.name);
      return names;
    }

    std::vector<std::string>
    subsection_names() const
    {
      std::vector<std::string> names;
      for (const DeclaredSection &subsection : subsections)
        names.push_back(subsection.name);
      return names;
    }
  };

  DeclaredSection
  declared_parameters(const dealii::ParameterHandler &prm);
} // namespace NPT

#endif
