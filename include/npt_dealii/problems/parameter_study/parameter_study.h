// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines parameter studies: many plate tests from one parameter file with
// loops, and what is made of them.

#ifndef npt_dealii_problems_parameter_study_parameter_study_h
#define npt_dealii_problems_parameter_study_parameter_study_h

#include <npt_dealii/problems/parameter_study/study_parameters.h>

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace NPT
{
  /**
   * Run a study: all cases that are not finished, then tables and pictures.
   * Collective if started by mpirun.
   *
   * @param run Runs the program with other arguments, for the cases; see
   *   SweepOptions. Without it the program is started anew for each case.
   *
   * @param continues Cases that were stopped go on where they were; else they
   *   begin anew.
   *
   * Throws StageFailed if the reference of a work-precision study failed
   * (other cases may fail, the tables say how), or if the study is interrupted:
   * its cases then have ended as plate tests do, and the tables are missing.
   */
  void
  run_parameter_study(
    const StudyParameters                              &parameters,
    const std::string                                  &directory,
    std::ostream                                       &screen,
    const std::function<int(std::vector<std::string>)> &run       = {},
    const bool                                          continues = false);
} // namespace NPT

#endif
