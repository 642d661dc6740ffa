// SPDX-License-Identifier: LGPL-2.1-or-later
// Changes to CSV tables: what spreadsheets and other countries make of them.

#include <algorithm>

#include "mutation.h"

namespace Fuzz
{
  namespace
  {
    using Cells = std::vector<std::string>;

    Cells
    cells_of(const std::string &line)
    {
      Cells cells(1);
      for (const char c : line)
        if (c == ',')
          cells.emplace_back();
        else
          cells.back() += c;
      return cells;
    }

    std::string
    line_of(const Cells &cells, const std::string &separator)
    {
      std::string line;
      for (std::size_t i = 0; i < cells.size(); ++i)
        line += (i == 0 ? "" : separator) + cells[i];
      return line;
    }

    bool
    is_data(const std::string &line)
    {
      return !line.empty() && line[0] != '#';
    }

    // The table as a spreadsheet of another country writes it.
    std::string
    with_separator(const std::vector<std::string> &lines,
                   const std::string              &separator,
                   const bool                      decimal_commas)
    {
      std::string text;
      for (const std::string &line : lines)
        if (!is_data(line))
          text += line + "\n";
        else
          {
            std::string row = line_of(cells_of(line), separator);
            if (decimal_commas)
              std::replace(row.begin(), row.end(), '.', ',');
            text += row + "\n";
          }
      return text;
    }

    Mutant
    harmless_table(const std::vector<std::string> &lines, Dice &dice)
    {
      Mutant     mutant{"harmless change", text_of(lines), Expected::same};
      const auto quotes = mutant.text.find('"');
      switch (quotes == std::string::npos ? dice.below(7) : 6)
        {
          case 0:
            mutant.text = with_separator(lines, ";", true);
            break;
          case 1:
            mutant.text = with_separator(lines, "\t", true);
            break;
          case 2:
            mutant.text = with_separator(lines, " ; ", false);
            break;
          case 3:
            std::replace(mutant.text.begin(), mutant.text.end(), '\n', '\r');
            break;
          case 4:
            {
              // A line of units below the names.
              std::string result;
              bool        is_first = true;
              for (const std::string &line : lines)
                {
                  result += line + "\n";
                  if (is_data(line) && is_first)
                    result +=
                      line_of(Cells(cells_of(line).size(), "[-]"), ",") + "\n";
                  is_first = is_first && !is_data(line);
                }
              mutant.text = result;
              // Stresses have another unit.
              mutant.expected = Expected::anything;
              break;
            }
          case 5:
            mutant.text = "\xEF\xBB\xBF# comment \xFF\n" + mutant.text;
            break;
          default:
            mutant.text += "\n\n# end\n\n";
        }
      return mutant;
    }

    Mutant
    change_cell(std::vector<std::string> lines,
                const std::size_t        row,
                Dice                    &dice)
    {
      Cells             cells = cells_of(lines[row]);
      const std::size_t i     = dice.below(cells.size());
      Mutant            mutant;
      if (dice.one_of(4))
        {
          mutant.mutation = "cell lost";
          cells.erase(cells.begin() + i);
          if (!cells.empty())
            mutant.expected = Expected::refusal;
        }
      else if (dice.one_of(4))
        {
          mutant.mutation = "odd cell";
          cells[i]        = dice.pick<std::string>({"\"",
                                                    "\"x\"y",
                                                    "a;b",
                                                    "#",
                                                    "",
                                                    "nan",
                                                    "[MPa]",
                                                    std::string(100000, '1'),
                                                    std::string(100000, 'x'),
                                                    "\x1B[2J"});
        }
      else
        {
          mutant.mutation = "number changed";
          bool is_number  = true;
          cells[i]        = odd_number(dice, is_number);
        }
      lines[row]  = line_of(cells, ",");
      mutant.text = text_of(lines);
      return mutant;
    }
  } // namespace



  Mutant
  mutate_table(const std::string &text, Dice &dice)
  {
    std::vector<std::string> lines = lines_of(text);
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < lines.size(); ++i)
      if (is_data(lines[i]))
        rows.push_back(i);
    if (rows.size() < 2 || dice.one_of(6))
      return damage(text, dice);
    const std::size_t row = dice.pick(rows);
    switch (dice.below(6))
      {
        case 0:
          return harmless_table(lines, dice);
        case 1:
          {
            Cells names                     = cells_of(lines[rows[0]]);
            names[dice.below(names.size())] = dice.pick(names);
            lines[rows[0]]                  = line_of(names, ",");
            return {"column renamed", text_of(lines)};
          }
        case 2:
          lines.erase(lines.begin() + row);
          return {"line deleted", text_of(lines)};
        case 3:
          std::swap(lines[row], lines[dice.pick(rows)]);
          return {"lines swapped", text_of(lines)};
        default:
          return change_cell(lines, row, dice);
      }
  }
} // namespace Fuzz
