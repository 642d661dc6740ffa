// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the entry "Problem" of a parameter file and its values.

#ifndef npt_dealii_base_problem_names_h
#define npt_dealii_base_problem_names_h

#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace NPT
{
  /// The problems of the program `verify`. The product does not contain them,
  /// but it knows their names, so that it can start `verify` for them.
  const std::vector<std::string> &
  benchmark_names();

  /// Values of the entry "Problem": the registered problems of this program by
  /// their rank, then the benchmarks.
  std::vector<std::string>
  problem_names();

  /// Declare the entry "Problem", which every parameter file has.
  void
  declare_problem(dealii::ParameterHandler &prm, const std::string &problem);
} // namespace NPT

#endif
