// SPDX-License-Identifier: LGPL-2.1-or-later
// The declared entries out of a ParameterHandler.

#include <npt_dealii/base/declared_parameters.h>

#include <deal.II/base/parameter_handler.h>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>

#include <cstdlib>
#include <sstream>

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
  } // namespace



  // XML rather than JSON, because only there names stay mangled and the tree
  // therefore unambiguous.
  DeclaredSection
  declared_parameters(const dealii::ParameterHandler &prm)
  {
    std::stringstream xml;
    prm.print_parameters(xml,
                         dealii::ParameterHandler::XML |
                           dealii::ParameterHandler::KeepDeclarationOrder);
    boost::property_tree::ptree tree;
    boost::property_tree::read_xml(xml, tree);

    DeclaredSection top;
    fill_section(tree.get_child("ParameterHandler"), top);
    return top;
  }
} // namespace NPT
