// SPDX-License-Identifier: LGPL-2.1-or-later
// CSV tables: quoting, exact numbers, and messages with the line.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/parameter_file.h>
#include <npt_dealii/io/replace_file.h>
#include <npt_dealii/io/table_file.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
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

    std::vector<std::string>
    split_line(const std::string &line, const std::string &where)
    {
      std::vector<std::string> cells;
      std::size_t              pos = 0;
      while (true)
        {
          pos = std::min(line.find_first_not_of(" \t", pos), line.size());
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
                std::min(line.find_first_not_of(" \t", pos + 1), line.size());
              if (pos < line.size() && line[pos] != ',')
                throw InputError(where +
                                 "text follows a closing double quote, a comma "
                                 "is missing");
              cells.push_back(cell);
            }
          else
            {
              const std::size_t comma =
                std::min(line.find(',', pos), line.size());
              cells.push_back(
                dealii::Utilities::trim(line.substr(pos, comma - pos)));
              pos = comma;
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

    std::size_t
    column_index(const Table &table, const std::string &name)
    {
      const auto &names = table.column_names;
      const auto  found = std::find(names.begin(), names.end(), name);
      if (found == names.end())
        {
          std::string hint = did_you_mean(name, names);
          if (hint.empty())
            {
              hint = "; its columns are: ";
              for (std::size_t i = 0; i < names.size(); ++i)
                hint += (i == 0 ? "" : ", ") + names[i];
            }
          throw InputError("table '" + table.filename + "' has no column '" +
                           name + "'" + hint);
        }
      return found - names.begin();
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
    return std::find(column_names.begin(), column_names.end(), name) !=
           column_names.end();
  }



  std::vector<double>
  Table::column(const std::string &name) const
  {
    const std::size_t   index = column_index(*this, name);
    std::vector<double> values;
    for (std::size_t row = 0; row < rows.size(); ++row)
      {
        const std::string &cell  = rows[row][index];
        const char        *begin = cell.data(), *end = begin + cell.size();
        if (begin != end && *begin == '+') // from_chars knows no plus sign
          ++begin;

        double     value  = 0;
        const auto result = std::from_chars(begin, end, value);
        if (begin == end || result.ec != std::errc() || result.ptr != end)
          throw InputError(filename + ":" + std::to_string(lines[row]) +
                           ": column '" + name + "' is " +
                           (cell.empty() ? "empty" : "'" + cell + "'") +
                           "; it must be a number");
        values.push_back(value);
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
    std::error_code error;
    if (std::filesystem::is_directory(filename, error))
      throw InputError("table '" + filename + "' is a directory");
    if (!std::filesystem::exists(filename, error))
      throw InputError("table '" + filename + "' not found");
    std::ifstream in(filename, std::ios::binary);
    if (!in)
      throw InputError("table '" + filename +
                       "' cannot be read; check its permissions");

    Table table;
    table.filename = filename;
    std::string  line;
    unsigned int line_number = 0;
    while (std::getline(in, line))
      {
        ++line_number;
        if (line_number == 1 && line.compare(0, 3, "\xEF\xBB\xBF") == 0)
          line.erase(0, 3);
        line = dealii::Utilities::trim(line);
        if (line.empty())
          continue;
        if (line.front() == '#')
          {
            table.comments.push_back(dealii::Utilities::trim(line.substr(1)));
            continue;
          }

        const std::string where =
          filename + ":" + std::to_string(line_number) + ": ";
        const auto cells = split_line(line, where);
        if (table.column_names.empty())
          {
            table.column_names = cells;
            check_column_names(cells, filename);
            continue;
          }
        if (cells.size() != table.column_names.size())
          throw InputError(
            where + "the row has " + std::to_string(cells.size()) +
            " cells, but the table has " +
            std::to_string(table.column_names.size()) + " columns");
        table.rows.push_back(cells);
        table.lines.push_back(line_number);
      }
    if (table.column_names.empty())
      throw InputError("table '" + filename +
                       "' is empty; it needs a line with column names");
    return table;
  }
} // namespace NPT
