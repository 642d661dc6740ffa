// SPDX-License-Identifier: LGPL-2.1-or-later
// The problems and their text for the user.

#include <npt_dealii/base/problem_names.h>

#include <deal.II/base/parameter_handler.h>

namespace NPT
{
  namespace Patterns = dealii::Patterns;

  const std::vector<std::string> &
  problem_names()
  {
    static const std::vector<std::string> names = {"plate test",
                                                   "material test",
                                                   "identification",
                                                   "parameter study",
                                                   "solid benchmark",
                                                   "contact benchmark"};
    return names;
  }



  void
  declare_problem(dealii::ParameterHandler &prm, const std::string &problem)
  {
    std::string names;
    for (const std::string &name : problem_names())
      names += (names.empty() ? "" : "|") + name;
    prm.declare_entry("Problem",
                      problem,
                      Patterns::Selection(names),
                      "What the program does: numerical plate testing of a "
                      "woven cell, numerical material testing of a micro cell "
                      "of fibers and matrix, identification of a bundle law "
                      "from test data, a study of many plate tests, or a "
                      "comparison of solids or of contact with exact "
                      "solutions.");
  }
} // namespace NPT
