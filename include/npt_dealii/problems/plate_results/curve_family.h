// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the pictures of a plain sweep: the curves of all cases in one
// picture, and the course of the Newton iterations.

#ifndef npt_dealii_problems_plate_results_curve_family_h
#define npt_dealii_problems_plate_results_curve_family_h

#include <npt_dealii/problems/plate_results/curve_writer.h>

#include <string>
#include <vector>

namespace NPT
{
  /// One case of a family of curves.
  struct FamilyMember
  {
    unsigned int          panel = 0;
    std::string           label;
    std::string           folder;
    std::vector<CurveRow> rows; ///< of one stage, and the state before it
  };

  /**
   * Write `curves.csv`, the given columns of all members, and draw `curves`:
   * one row of panels per y column.
   *
   * @param x_column  Column of curves.csv of a run on the abscissa.
   * @param y_columns Columns on the ordinates.
   * @return Warning of the plotting program, or empty.
   */
  std::string
  write_curve_family(const std::string               &directory,
                     const std::vector<std::string>  &panels,
                     const std::vector<FamilyMember> &members,
                     const std::string               &x_column,
                     const std::vector<std::string>  &y_columns,
                     const std::string               &title);

  /// Mean number of Newton iterations in consecutive load steps.
  struct MeanIterations
  {
    unsigned int first_step = 0, last_step = 0; ///< of the stage, from 1
    double       iterations = 0;
  };

  /**
   * Average the Newton iterations over every @p n_steps consecutive steps; the
   * last average may have fewer.
   *
   * @param rows The steps of a stage, without the state before it.
   */
  std::vector<MeanIterations>
  mean_iterations(const std::vector<CurveRow> &rows,
                  const unsigned int           n_steps);

  /// Write `iterations.csv` and draw `iterations`: mean_iterations() of all
  /// members over the load step.
  std::string
  write_iterations(const std::string               &directory,
                   const std::vector<std::string>  &panels,
                   const std::vector<FamilyMember> &members,
                   const unsigned int               n_steps,
                   const std::string               &title);
} // namespace NPT

#endif
