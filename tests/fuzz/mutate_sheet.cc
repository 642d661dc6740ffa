// SPDX-License-Identifier: LGPL-2.1-or-later
// Changes to data sheets: those of parameter files, and other units.

#include <algorithm>

#include "mutation.h"

namespace Fuzz
{
  namespace
  {
    // Behind the number of an entry, where there is one.
    Mutant
    change_unit(const std::string &text, Dice &dice)
    {
      std::vector<std::string> lines = lines_of(text);
      std::vector<std::size_t> values;
      for (std::size_t i = 0; i < lines.size(); ++i)
        if (lines[i].find("  set ") == 0 &&
            lines[i].find_first_of("0123456789") != std::string::npos)
          values.push_back(i);
      if (values.empty())
        return damage(text, dice);
      std::string      &line  = lines[dice.pick(values)];
      const std::size_t digit = line.find_last_of("0123456789");
      line.resize(std::max(digit, line.find('=')) + 1);
      line +=
        dice.pick<std::string>({" per cm",    "/inch",     " per 25 mm",
                                " per 0 mm",  " mm",       "um",
                                " \xC2\xB5m", " mil",      " inch",
                                "\"",         " %",        "%%",
                                " tex",       " dtex",     " denier",
                                " Denier",    " g/cm^3",   " g/cm\xC2\xB3",
                                " kg/m^3",    " GPa",      " MPa",
                                " g/m^2",     " oz/yd^2",  " oz",
                                ", 1e-3",     " mm, 2 mm", ", 0.5 inch",
                                ", ",         " ( mm )",   "e3",
                                "e-3 mm"});
      return {"unit changed", text_of(lines)};
    }
  } // namespace



  Mutant
  mutate_sheet(const std::string              &text,
               const std::vector<std::string> &others,
               Dice                           &dice)
  {
    if (dice.one_of(3))
      return change_unit(text, dice);
    Mutant mutant = mutate_parameters(text, others, dice);
    // "1 mm" is no number, but is understood here.
    if (mutant.mutation == "number changed")
      mutant.expected = Expected::anything;
    return mutant;
  }
} // namespace Fuzz
