// SPDX-License-Identifier: LGPL-2.1-or-later
// The columns of curves.csv, stated once for writing, reading and plotting.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/io/replace_file.h>
#include <npt_dealii/problems/plate_results/curve_column.h>
#include <npt_dealii/problems/plate_results/curve_writer.h>

#include <deal.II/base/exceptions.h>

#include <charconv>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <type_traits>

namespace NPT
{
  using namespace dealii;

  namespace
  {
    double &
    further_value(CurveRow &row, const std::string &name)
    {
      return row.further.emplace(name, std::numeric_limits<double>::quiet_NaN())
        .first->second;
    }

    double
    further_value(const CurveRow &row, const std::string &name)
    {
      const auto found = row.further.find(name);
      return found == row.further.end() ?
               std::numeric_limits<double>::quiet_NaN() :
               found->second;
    }

    // Call visit(name, unit, entry) for each column in the order of the file.
    template <typename Row, typename Visitor>
    void
    visit_columns(Row &&row, Visitor visit)
    {
      visit("step", "-", row.step);
      visit("stage", "", row.stage);
      visit("load_factor", "-", row.load_factor);
      for (unsigned int k = 0; k < MacroModes::n; ++k)
        visit(MacroModes::table[k].name, MacroModes::table[k].unit(), row.H[k]);
      for (unsigned int k = 0; k < MacroModes::n; ++k)
        visit(MacroModes::table[k].conjugate,
              MacroModes::table[k].conjugate_unit(),
              row.n[k]);

      const auto ij = [](const unsigned int i, const unsigned int j) {
        return std::to_string(i + 1) + std::to_string(j + 1);
      };
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          visit("N" + ij(i, j), "N/mm", row.N[i][j]);
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          visit("M" + ij(i, j), "N", row.M[i][j]);

      visit("stored_energy", "N mm", row.stored_energy);
      visit("contact_energy", "N mm", row.contact_energy);
      visit("friction_energy", "N mm", row.friction_energy);
      visit("dissipation", "N mm", row.dissipation);
      visit("external_work", "N mm", row.external_work);
      visit("largest_penetration", "mm", row.largest_penetration);
      visit("n_active", "-", row.n_active);
      visit("n_stick", "-", row.n_stick);
      visit("n_slip", "-", row.n_slip);
      visit("newton_iterations", "-", row.newton_iterations);
      visit("cuts", "-", row.cuts);
      visit("newton_order", "-", row.newton_order);
      visit("cpu_seconds", "s", row.cpu_seconds);

      const auto &registered = Registry<CurveColumn>::instance();
      for (const std::string &name : registered.names())
        {
          auto &&value = further_value(row, name);
          visit(name, registered.get(name).unit, value);
        }
    }

    std::string
    to_text(const double value)
    {
      char       buffer[32];
      const auto end = std::to_chars(buffer, buffer + sizeof(buffer), value);
      return std::string(buffer, end.ptr);
    }

    std::string
    to_text(const unsigned int value)
    {
      return std::to_string(value);
    }

    // Quoted text would be possible, but gnuplot 5.4 cuts it at a comma.
    std::string
    to_text(const std::string &value)
    {
      if (value.find_first_of(",\"\n") != std::string::npos)
        throw InputError("The name of stage '" + value +
                         "' contains a comma, a quotation mark or a line "
                         "break; curve files cannot hold these.");
      return value;
    }

    bool
    from_text(const std::string &text, double &value)
    {
      char *end = nullptr;
      value     = std::strtod(text.c_str(), &end);
      return !text.empty() && *end == '\0';
    }

    bool
    from_text(const std::string &text, unsigned int &value)
    {
      const char *const last   = text.data() + text.size();
      const auto        result = std::from_chars(text.data(), last, value);
      return result.ec == std::errc() && result.ptr == last;
    }

    bool
    from_text(const std::string &text, std::string &value)
    {
      value = text;
      return true;
    }

    std::vector<std::string>
    split_line(const std::string &line)
    {
      std::vector<std::string> entries(1);
      for (const char c : line)
        if (c == ',')
          entries.emplace_back();
        else if (c != '\r')
          entries.back() += c;
      return entries;
    }

    // Columns with the same unit that follow one another share one bracket.
    std::string
    units_line()
    {
      std::string line = "# units:", last_unit;
      visit_columns(CurveRow(),
                    [&](const std::string &name,
                        const std::string &unit,
                        const auto &) {
                      if (unit.empty())
                        return;
                      if (!last_unit.empty() && unit != last_unit)
                        line += " [" + last_unit + "],";
                      line += " " + name;
                      last_unit = unit;
                    });
      return line + " [" + last_unit + "]";
    }

    void
    write_header(std::ostream &out)
    {
      out << "# Curve of a numerical plate test, one row per accepted load "
             "step: generalized displacement gradients H, conjugates n, "
             "volume averages N and M, energies per unit cell.\n"
          << units_line() << '\n';
      const char *separator = "";
      for (const std::string &name : curve_columns())
        {
          out << separator << name;
          separator = ",";
        }
      out << '\n';
    }

    void
    write_row(std::ostream &out, const CurveRow &row)
    {
      std::string line;
      visit_columns(row,
                    [&](const std::string &,
                        const std::string &,
                        const auto &value) { line += to_text(value) + ","; });
      line.back() = '\n';
      out << line;
    }

    [[noreturn]] void
    throw_unknown_column(const std::string &column)
    {
      std::string message = "There is no curve column '" + column +
                            "' with numbers; the columns are";
      for (const std::string &name : curve_columns())
        message += " " + name;
      throw InputError(message + ".");
    }
  } // namespace



  std::vector<std::string>
  curve_columns()
  {
    std::vector<std::string> names;
    visit_columns(CurveRow(),
                  [&](const std::string &name,
                      const std::string &,
                      const auto &) { names.push_back(name); });
    return names;
  }



  std::string
  curve_column_unit(const std::string &column)
  {
    std::string result;
    bool        found = false;
    visit_columns(CurveRow(),
                  [&](const std::string &name,
                      const std::string &unit,
                      const auto &) {
                    if (name == column)
                      {
                        result = unit;
                        found  = true;
                      }
                  });
    if (!found)
      throw_unknown_column(column);
    return result;
  }



  double
  curve_value(const CurveRow &row, const std::string &column)
  {
    double result = 0.;
    bool   found  = false;
    visit_columns(row,
                  [&](const std::string &name,
                      const std::string &,
                      const auto &value) {
                    using Entry = std::decay_t<decltype(value)>;
                    if constexpr (!std::is_same_v<Entry, std::string>)
                      if (name == column)
                        {
                          result = value;
                          found  = true;
                        }
                  });
    if (!found)
      throw_unknown_column(column);
    return result;
  }



  CurveWriter::CurveWriter(const std::string           &filename,
                           const std::vector<CurveRow> &rows)
  {
    const auto write_all = [&](std::ostream &out) {
      write_header(out);
      for (const CurveRow &row : rows)
        write_row(out, row);
    };
    // Rows of a run that is continued are never missing, not even in between.
    if (!rows.empty())
      replace_file(filename, write_all);
    file_ =
      std::make_unique<OutputFile>(filename,
                                   rows.empty() ? OutputFile::Start::empty :
                                                  OutputFile::Start::end);
    if (!rows.empty())
      return;
    std::ostringstream text;
    write_all(text);
    file_->write(text.str());
  }



  void
  CurveWriter::write(const CurveRow &row)
  {
    std::ostringstream text;
    write_row(text, row);
    file_->write(text.str());
  }



  std::vector<CurveRow>
  read_curves(const std::string &filename)
  {
    std::ifstream in(filename, std::ios::binary);
    AssertThrow(in, ExcFileNotOpen(filename));

    std::map<std::string, std::size_t> position;
    std::vector<CurveRow>              rows;
    std::string                        line;
    unsigned int                       line_number = 0;
    while (std::getline(in, line))
      {
        ++line_number;
        const bool unfinished = in.eof();
        if (unfinished || line.empty() || line[0] == '#')
          continue;

        const std::vector<std::string> entries = split_line(line);
        if (position.empty())
          {
            for (std::size_t i = 0; i < entries.size(); ++i)
              position[entries[i]] = i;
            for (const std::string &name : curve_columns())
              if (position.count(name) == 0 &&
                  !Registry<CurveColumn>::instance().contains(name))
                throw InputError("Column '" + name + "' is missing in " +
                                 filename + ".");
            continue;
          }

        CurveRow row;
        visit_columns(
          row, [&](const std::string &name, const std::string &, auto &value) {
            if (position.count(name) == 0) // of another program
              return;
            const std::size_t i = position[name];
            if (i >= entries.size() || !from_text(entries[i], value))
              throw InputError(
                "Line " + std::to_string(line_number) + " of " + filename +
                ": column '" + name + "' has " +
                (i < entries.size() ? "'" + entries[i] + "'" : "no entry") +
                "; a number is expected.");
          });
        rows.push_back(row);
      }
    return rows;
  }
} // namespace NPT
