// SPDX-License-Identifier: LGPL-2.1-or-later
// The problems and their text for the user.

#include <npt_dealii/base/problem.h>
#include <npt_dealii/base/problem_names.h>

#include <deal.II/base/parameter_handler.h>

#include <algorithm>

namespace NPT
{
  namespace Patterns = dealii::Patterns;

  namespace
  {
    bool
    is_benchmark(const std::string &name)
    {
      const auto &names = benchmark_names();
      return std::find(names.begin(), names.end(), name) != names.end();
    }

    /// The registered problems that are not benchmarks, by rank.
    std::vector<std::string>
    own_names()
    {
      const auto              &registry = Registry<Problem>::instance();
      std::vector<std::string> names;
      for (const std::string &name : registry.names())
        if (!is_benchmark(name) && registry.get(name).is_listed)
          names.push_back(name);
      std::stable_sort(names.begin(),
                       names.end(),
                       [&](const std::string &a, const std::string &b) {
                         return registry.get(a).rank < registry.get(b).rank;
                       });
      return names;
    }
  } // namespace



  const std::vector<std::string> &
  benchmark_names()
  {
    static const std::vector<std::string> names = {"solid benchmark",
                                                   "contact benchmark"};
    return names;
  }



  std::vector<std::string>
  problem_names()
  {
    std::vector<std::string> names = own_names();
    names.insert(names.end(),
                 benchmark_names().begin(),
                 benchmark_names().end());
    return names;
  }



  void
  declare_problem(dealii::ParameterHandler &prm, const std::string &problem)
  {
    std::string selection, text;
    for (const std::string &name : problem_names())
      selection += (selection.empty() ? "" : "|") + name;
    for (const std::string &name : own_names())
      text += Registry<Problem>::instance().get(name).text + ", ";
    prm.declare_entry("Problem",
                      problem,
                      Patterns::Selection(selection),
                      "What the program does: " + text +
                        (text.empty() ? "" : "or ") +
                        "a comparison of solids or of contact with exact "
                        "solutions.");
  }
} // namespace NPT
