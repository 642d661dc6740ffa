// SPDX-License-Identifier: LGPL-2.1-or-later
// CSV tables: quoting, exact numbers, and messages with the line.

#include <npt_dealii/base/describe_pattern.h>
#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/message_words.h>
#include <npt_dealii/base/nearest_name.h>
#include <npt_dealii/base/text_file.h>
#include <npt_dealii/io/replace_file.h>
#include <npt_dealii/io/table_file.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <optional>
#include <sstream>
#include <system_error>

namespace NPT
{
  namespace
  {
    std::string
    to_cell(std::string text)
    {
      std::replace(text.begin(), text.end(), '\n', ' ');
      std::replace(text.begin(), text.end(), '\r', ' ');

      // An empty or commented first cell would make the row vanish.
      const bool needs_quotes =
        text.empty() || text.front() == '#' ||
        text.find_first_of(",\"") != std::string::npos ||
        text != dealii::Utilities::trim(text);
      if (!needs_quotes)
        return text;

      std::string quoted = "\"";
      for (const char c : text)
        quoted += (c == '"' ? std::string("\"\"") : std::string(1, c));
      return quoted + "\"";
    }

    std::string
    to_line(const std::vector<TableCell> &cells)
    {
      std::string line;
      for (std::size_t i = 0; i < cells.size(); ++i)
        line += (i == 0 ? "" : ",") + to_cell(cells[i].text());
      return line;
    }

    // What separates the cells of a line with names: what other programs write
    // where the comma is the decimal point, if there is no comma.
    char
    separator_of(const std::string &line)
    {
      bool        in_quotes = false;
      std::string separators;
      for (const char c : line)
        if (c == '"')
          in_quotes = !in_quotes;
        else if (!in_quotes && (c == ',' || c == ';' || c == '\t'))
          separators += c;
      for (const char c : {',', ';', '\t'})
        if (separators.find(c) != std::string::npos)
          return c;
      return ',';
    }

    // "MPa" of "P11 [MPa]"; the name is shortened.
    std::string
    take_unit(std::string &name)
    {
      const std::size_t begin = name.rfind('[');
      if (name.empty() || name.back() != ']' || begin == std::string::npos ||
          begin == 0)
        return "";
      const std::string unit = name.substr(begin + 1);
      name                   = dealii::Utilities::trim(name.substr(0, begin));
      return dealii::Utilities::trim(unit.substr(0, unit.size() - 1));
    }

    // A line of units below the names: cells in brackets, some of them empty.
    bool
    is_line_of_units(const std::vector<std::string> &cells)
    {
      bool has_unit = false;
      for (const std::string &cell : cells)
        {
          if (!cell.empty() && (cell.front() != '[' || cell.back() != ']'))
            return false;
          has_unit = has_unit || !cell.empty();
        }
      return has_unit;
    }

    std::vector<std::string>
    split_line(const std::string &line,
               const char         separator,
               const std::string &where)
    {
      const std::string blanks = separator == '\t' ? " " : " \t";

      std::vector<std::string> cells;
      std::size_t              pos = 0;
      while (true)
        {
          pos = std::min(line.find_first_not_of(blanks, pos), line.size());
          if (pos < line.size() && line[pos] == '"')
            {
              std::string cell;
              for (++pos; pos < line.size(); ++pos)
                if (line[pos] != '"')
                  cell += line[pos];
                else if (pos + 1 < line.size() && line[pos + 1] == '"')
                  cell += line[++pos];
                else
                  break;
              if (pos == line.size())
                throw InputError(where + "a double quote is not closed");
              pos =
                std::min(line.find_first_not_of(blanks, pos + 1), line.size());
              if (pos < line.size() && line[pos] != separator)
                throw InputError(where +
                                 "text follows a closing double quote, a comma "
                                 "is missing");
              cells.push_back(cell);
            }
          else
            {
              const std::size_t end =
                std::min(line.find(separator, pos), line.size());
              cells.push_back(
                dealii::Utilities::trim(line.substr(pos, end - pos)));
              pos = end;
            }
          if (pos == line.size())
            return cells;
          ++pos;
        }
    }

    void
    check_column_names(const std::vector<std::string> &names,
                       const std::string              &filename)
    {
      for (auto name = names.begin(); name != names.end(); ++name)
        if (std::find(names.begin(), name, *name) != name)
          throw InputError("table '" + filename + "': column '" + *name +
                           "' occurs twice");
    }

    // Comments, and the line with the names of the columns.
    std::string
    table_head(const std::string              &filename,
               const std::vector<std::string> &column_names,
               const std::vector<std::string> &comments)
    {
      Assert(!column_names.empty(),
             dealii::ExcMessage("A table needs a column."));
      check_column_names(column_names, filename);
      std::string text;
      for (const std::string &comment : comments)
        for (const std::string &line :
             dealii::Utilities::split_string_list(comment, '\n'))
          text += "# " + line + "\n";
      return text + to_line({column_names.begin(), column_names.end()}) + "\n";
    }

    constexpr std::size_t none = static_cast<std::size_t>(-1);

    // By the name as it stands, or without its unit; none: there is no such
    // column.
    std::size_t
    find_column(const Table &table, const std::string &name)
    {
      const auto &names = table.column_names;
      const auto  exact = std::find(names.begin(), names.end(), name);
      if (exact != names.end())
        return exact - names.begin();
      std::size_t found = none;
      for (std::size_t i = 0; i < names.size(); ++i)
        {
          std::string bare = names[i];
          take_unit(bare);
          if (bare != name)
            continue;
          if (found != none)
            throw InputError("table '" + table.filename +
                             "' has two columns '" + name + "', '" +
                             names[found] + "' and '" + names[i] + "'");
          found = i;
        }
      return found;
    }

    std::size_t
    column_index(const Table &table, const std::string &name)
    {
      const std::size_t found = find_column(table, name);
      if (found == none)
        {
          const auto &names = table.column_names;
          std::string hint  = did_you_mean(name, names);
          if (hint.empty())
            hint = "; its columns are: " + listed(names);
          throw InputError("table '" + table.filename + "' has no column '" +
                           name + "'" + hint);
        }
      return found;
    }

    std::optional<double>
    to_number(const std::string &cell)
    {
      const char *begin = cell.data(), *end = begin + cell.size();
      if (begin != end && *begin == '+') // from_chars knows no plus sign
        ++begin;
      double     value  = 0;
      const auto result = std::from_chars(begin, end, value);
      if (begin == end || result.ec != std::errc() || result.ptr != end)
        return {};
      return value;
    }

    // The cell with a point, if it is a number with a decimal comma.
    std::optional<double>
    to_number_with_comma(std::string cell)
    {
      if (std::count(cell.begin(), cell.end(), ',') != 1 ||
          cell.find('.') != std::string::npos)
        return {};
      std::replace(cell.begin(), cell.end(), ',', '.');
      return to_number(cell);
    }

    // Where one number has a decimal comma, points may part the thousands.
    void
    refuse_points(const Table &table)
    {
      for (std::size_t row = 0; row < table.n_rows(); ++row)
        for (const std::string &cell : table.rows[row])
          if (cell.find('.') != std::string::npos && to_number(cell))
            throw InputError(table.filename + ":" +
                             std::to_string(table.lines[row]) + ": '" + cell +
                             "' has a decimal point, other numbers of the "
                             "table have decimal commas; write all alike");
    }

    [[noreturn]] void
    refuse_cell(const Table       &table,
                const std::size_t  row,
                const std::string &name,
                const std::string &cell)
    {
      std::string hint = number_beyond_doubles(cell);
      if (!hint.empty())
        hint = "; " + hint;
      else if (row == 0 &&
               cell.find_first_of("0123456789") == std::string::npos &&
               !cell.empty())
        hint = "; a line of units needs brackets, as [MPa]";
      throw InputError(table.filename + ":" + std::to_string(table.lines[row]) +
                       ": column '" + name + "' is " +
                       (cell.empty() ? "empty" : in_quotes(cell)) +
                       "; it must be a number" + hint);
    }

    void
    refuse_row(const std::string &where,
               const std::size_t  n_cells,
               const Table       &table)
    {
      const std::size_t n = table.column_names.size();
      throw InputError(
        where + "the row has " + std::to_string(n_cells) +
        " cells, but the table has " + std::to_string(n) + " columns" +
        (table.separator == ',' && n_cells == 2 * n ?
           "; numbers with decimal commas need semicolons between them" :
           ""));
    }
  } // namespace



  std::string
  TableCell::double_to_text(const double value)
  {
    // The shortest text that gives this double again.
    char       buffer[64];
    const auto result = std::to_chars(buffer, buffer + sizeof(buffer), value);
    Assert(result.ec == std::errc(), dealii::ExcInternalError());
    return std::string(buffer, result.ptr);
  }



  TableWriter::TableWriter(const std::string              &filename,
                           const std::vector<std::string> &column_names,
                           const std::vector<std::string> &comments)
    : filename_(filename)
    , n_columns_(column_names.size())
    , file_(filename)
  {
    file_.write(table_head(filename, column_names, comments));
  }



  void
  TableWriter::add_row(const std::vector<TableCell> &cells)
  {
    AssertDimension(cells.size(), n_columns_);
    file_.write(to_line(cells) + "\n");
  }



  void
  write_table(const std::string                         &filename,
              const std::vector<std::string>            &column_names,
              const std::vector<std::vector<TableCell>> &rows,
              const std::vector<std::string>            &comments)
  {
    replace_file(filename, [&](std::ostream &out) {
      out << table_head(filename, column_names, comments);
      for (const std::vector<TableCell> &row : rows)
        {
          AssertDimension(row.size(), column_names.size());
          out << to_line(row) << '\n';
        }
    });
  }



  bool
  Table::has_column(const std::string &name) const
  {
    return find_column(*this, name) != none;
  }



  std::string
  Table::unit(const std::string &name) const
  {
    const std::size_t index = column_index(*this, name);
    std::string       full  = column_names[index];
    const std::string unit  = take_unit(full);
    return unit.empty() && index < units.size() ? units[index] : unit;
  }



  std::vector<double>
  Table::column(const std::string &name) const
  {
    const std::size_t   index     = column_index(*this, name);
    bool                has_comma = false;
    std::vector<double> values;
    for (std::size_t row = 0; row < rows.size(); ++row)
      {
        const std::string    &cell   = rows[row][index];
        std::optional<double> number = to_number(cell);
        if (!number && separator != ',')
          {
            number = to_number_with_comma(cell);
            if (number && !has_comma)
              refuse_points(*this);
            has_comma = has_comma || number;
          }
        if (!number)
          refuse_cell(*this, row, name, cell);
        values.push_back(*number);
      }
    return values;
  }



  std::vector<std::string>
  Table::text_column(const std::string &name) const
  {
    const std::size_t        index = column_index(*this, name);
    std::vector<std::string> values;
    for (const auto &row : rows)
      values.push_back(row[index]);
    return values;
  }



  Table
  read_table(const std::string &filename)
  {
    const std::string what = "table '" + filename + "'";
    std::error_code   error;
    if (std::filesystem::is_directory(filename, error))
      throw InputError(what + " is a directory");
    if (const std::string obstacle = obstacle_to_file(filename);
        !obstacle.empty())
      throw InputError(what + " cannot be read: " + obstacle);
    if (!std::filesystem::exists(filename, error))
      throw InputError(what + " not found" + home_folder_hint(filename));
    std::istringstream in(read_text_file(filename, what));

    Table table;
    table.filename = filename;
    std::string  line;
    unsigned int line_number = 0;
    while (std::getline(in, line))
      {
        ++line_number;
        // A tab at the end may be what separates the last cell, an empty one.
        const std::string plain = dealii::Utilities::trim(line);
        if (plain.empty())
          continue;
        if (plain.front() == '#')
          {
            table.comments.push_back(dealii::Utilities::trim(plain.substr(1)));
            continue;
          }
        if (table.separator != '\t')
          line = plain;

        const std::string where =
          filename + ":" + std::to_string(line_number) + ": ";
        if (table.column_names.empty())
          {
            table.separator    = separator_of(plain);
            table.column_names = split_line(plain, table.separator, where);
            check_column_names(table.column_names, filename);
            continue;
          }
        const auto cells = split_line(line, table.separator, where);
        if (cells.size() != table.column_names.size())
          refuse_row(where, cells.size(), table);
        if (table.rows.empty() && table.units.empty() &&
            is_line_of_units(cells))
          {
            for (const std::string &cell : cells)
              table.units.push_back(
                cell.empty() ? "" : cell.substr(1, cell.size() - 2));
            continue;
          }
        table.rows.push_back(cells);
        table.lines.push_back(line_number);
      }
    if (table.column_names.empty())
      throw InputError(what + " is empty; it needs a line with column names");
    return table;
  }
} // namespace NPT
