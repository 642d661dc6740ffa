// SPDX-License-Identifier: LGPL-2.1-or-later
// The declared entries out of a ParameterHandler.

#include <npt_dealii/base/declared_parameters.h>

#include <deal.II/base/parameter_handler.h>

#include <boost/property_tree/ptree.hpp>

#include <cstdlib>

namespace NPT
{
  namespace
  {
    // ParameterHandler keeps names as letters and digits, everything else as
    // _XX (hexadecimal): "Friction_20coefficient".
    std::string
    demangle(const std::string &name)
    {
      std::string result;
      for (std::size_t i = 0; i < name.size(); ++i)
        if (name[i] == '_' && i + 2 < name.size())
          {
            result += static_cast<char>(
              std::strtol(name.substr(i + 1, 2).c_str(), nullptr, 16));
            i += 2;
          }
        else
          result += name[i];
      return result;
    }

    void
    fill_section(const boost::property_tree::ptree &tree,
                 DeclaredSection                   &section)
    {
      for (const auto &[mangled_name, node] : tree)
        {
          const std::string name  = demangle(mangled_name);
          const auto        alias = node.get_child_optional("alias");
          // An entry called "value" is mangled entirely, so that a child of
          // this name always marks an entry; "alias" needs the second look.
          if (node.get_child_optional("value"))
            section.entries.push_back({name,
                                       node.get<std::string>("value"),
                                       node.get("default_value", ""),
                                       node.get("documentation", ""),
                                       node.get("pattern_description", ""),
                                       ""});
          else if (alias && alias->empty())
            section.entries.push_back({name, "", "", "", "", alias->data()});
          else
            {
              section.subsections.push_back({name, {}, {}});
              fill_section(node, section.subsections.back());
            }
        }
    }

    // An archive of Boost's serialization that keeps nothing of what it is
    // handed but looks at the tree of entries.
    class TreeReader
    {
    public:
      template <typename T>
      TreeReader &
      operator&(const T &)
      {
        return *this;
      }

      TreeReader &
      operator&(const boost::property_tree::ptree &tree)
      {
        fill_section(tree, top);
        return *this;
      }

      DeclaredSection top;
    };
  } // namespace



  // ParameterHandler hands its tree to nobody but an archive. Printed as XML
  // and read again it is the same and takes ten times as long, which was more
  // than half of the time to read a parameter file.
  DeclaredSection
  declared_parameters(const dealii::ParameterHandler &prm)
  {
    TreeReader reader;
    prm.save(reader, 0);
    return reader.top;
  }
} // namespace NPT
