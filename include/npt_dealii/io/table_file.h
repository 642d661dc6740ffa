// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines small tables with named columns in CSV files: written row by row
// during a run, read back for tests, studies and published curves.

#ifndef npt_dealii_io_table_file_h
#define npt_dealii_io_table_file_h

#include <npt_dealii/io/output_file.h>

#include <string>
#include <type_traits>
#include <vector>

namespace NPT
{
  /**
   * One cell to be written: a number or a text.
   *
   * Numbers are written with as few digits as give the same double when read
   * again: 0.1 stays "0.1", 1/3 becomes "0.3333333333333333".
   */
  class TableCell
  {
  public:
    template <typename Number,
              typename = std::enable_if_t<std::is_arithmetic<Number>::value>>
    TableCell(const Number value)
      : text_(number_to_text(value))
    {}

    TableCell(const std::string &text)
      : text_(text)
    {}

    TableCell(const char *text)
      : text_(text)
    {}

    const std::string &
    text() const
    {
      return text_;
    }

  private:
    template <typename Number>
    static std::string
    number_to_text(const Number value)
    {
      if constexpr (std::is_same<Number, bool>::value)
        return value ? "true" : "false";
      else if constexpr (std::is_integral<Number>::value)
        return std::to_string(value);
      else
        return double_to_text(value);
    }

    static std::string
    double_to_text(const double value);

    std::string text_;
  };



  /**
   * Write a table one row at a time. Every row reaches the file before
   * add_row() returns, so that the table of an interrupted run is complete up
   * to its last step.
   *
   * The file: comment lines beginning with "# ", one line with the names of the
   * columns, then the rows, cells separated by commas. In a parallel run only
   * one process may own a writer.
   */
  class TableWriter
  {
  public:
    /**
     * Replace @p filename by a table without rows.
     *
     * @param column_names Each name once; a unit may be part of it, "N11
     * [N/mm]".
     * @param comments     Lines for a person to read: what, when, which units.
     *
     * Throws OutputError if the file cannot be written, InputError if a name
     * occurs twice.
     */
    TableWriter(const std::string              &filename,
                const std::vector<std::string> &column_names,
                const std::vector<std::string> &comments = {});

    /**
     * Write a row, `add_row({step, load, "weave"})`. The number of cells must
     * be the number of columns. A line break in a text becomes a blank. Throws
     * OutputError if the disk does not take the row.
     */
    void
    add_row(const std::vector<TableCell> &cells);

    /// The same for numbers already in a vector.
    template <typename Number>
    void
    add_row(const std::vector<Number> &numbers)
    {
      add_row(std::vector<TableCell>(numbers.begin(), numbers.end()));
    }

  private:
    const std::string filename_;
    const std::size_t n_columns_;
    OutputFile        file_;
  };



  /// Write a table as a whole: the file appears complete or not at all.
  void
  write_table(const std::string                         &filename,
              const std::vector<std::string>            &column_names,
              const std::vector<std::vector<TableCell>> &rows,
              const std::vector<std::string>            &comments = {});



  /**
   * A table as it was read: texts, which column() turns into numbers on demand,
   * so that columns of texts may stand beside columns of numbers.
   */
  struct Table
  {
    std::string              filename;
    std::vector<std::string> comments;     ///< Without "#" and blanks around.
    std::vector<std::string> column_names; ///< As they stand, with units.
    /// Of a line of units below the names, without brackets; or none.
    std::vector<std::string>              units;
    std::vector<std::vector<std::string>> rows;
    std::vector<unsigned int> lines; ///< Line of each row in the file, from 1.
    /// Comma, semicolon or tab.
    char separator = ',';

    std::size_t
    n_rows() const
    {
      return rows.size();
    }

    /// Names are those of the file, or these without a unit in brackets behind
    /// them: the column "P11 [MPa]" is also found as "P11".
    bool
    has_column(const std::string &name) const;

    /// The unit behind the name of a column, or below it; empty: none.
    std::string
    unit(const std::string &name) const;

    /**
     * The numbers of a column, bit by bit what was written ("nan" and "inf"
     * included). Where semicolons or tabs separate the cells, a number may have
     * a decimal comma, if none of the table has a decimal point.
     *
     * Throws InputError if there is no such column (with the nearest name) or a
     * cell is not a number (with its line).
     */
    std::vector<double>
    column(const std::string &name) const;

    std::vector<std::string>
    text_column(const std::string &name) const;
  };

  /**
   * Read a table: lines beginning with "#" are comments wherever they stand,
   * empty lines are skipped, the first other line has the names of the columns.
   * Blanks around cells do not count; a cell in double quotes may contain
   * commas. Semicolons or tabs separate the cells if the line of names has
   * them and no commas; a line of units in brackets may follow it.
   *
   * Throws InputError if the file cannot be read, has no header, a column name
   * twice, or a row with too few or too many cells (with its line).
   */
  Table
  read_table(const std::string &filename);
} // namespace NPT

#endif
