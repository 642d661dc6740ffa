// SPDX-License-Identifier: LGPL-2.1-or-later
// Texts made of the table of macroscopic modes.

#include <npt_dealii/homogenization/macro_modes.h>

namespace NPT
{
  namespace MacroModes
  {
    std::string
    choices()
    {
      std::string gradients, conjugates;
      for (const MacroMode &mode : table)
        {
          gradients += (gradients.empty() ? "" : "|") + std::string(mode.name);
          conjugates += "|" + std::string(mode.conjugate);
        }
      return gradients + conjugates;
    }



    std::string
    list_of_names(const std::vector<unsigned int> &modes)
    {
      std::string text;
      for (unsigned int i = 0; i < modes.size(); ++i)
        text += (i == 0               ? "" :
                 i + 1 < modes.size() ? ", " :
                                        " and ") +
                std::string(table[modes[i]].name);
      return text;
    }



    std::string
    meaning_of_gradients()
    {
      std::string text;
      for (unsigned int k = 0; k < n; ++k)
        {
          text += (k == 0 ? "" : ", ") + std::string(table[k].name);
          const bool last = k + 1 == n || std::string_view(table[k].meaning) !=
                                            table[k + 1].meaning;
          if (last)
            text += std::string(" ") + table[k].meaning + " [" +
                    table[k].unit() + "]";
        }
      return text;
    }



    std::string
    units_of_conjugates()
    {
      std::string text;
      for (unsigned int k = 0; k < n; ++k)
        {
          text += (k == 0 ? "" : ", ") + std::string(table[k].conjugate);
          if (k + 1 == n || table[k].kind != table[k + 1].kind)
            text += std::string(" [") + table[k].conjugate_unit() + "]";
        }
      return text;
    }



    std::string
    with_unit(const std::string &number, const std::string &unit)
    {
      return unit == "-" ? number : number + " " + unit;
    }
  } // namespace MacroModes
} // namespace NPT
