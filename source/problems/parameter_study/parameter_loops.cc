// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines how loops are found in values and replaced by them.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/message_words.h>
#include <npt_dealii/problems/parameter_study/parameter_loops.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

namespace NPT
{
  using StatementKind = ParameterText::Kind;

  namespace
  {
    // All cases are read before the first one runs.
    constexpr std::size_t most_cases = 10000;

    void
    check_number(const std::size_t n_cases)
    {
      if (n_cases > most_cases)
        throw InputError("The loops of this study make more than " +
                         std::to_string(most_cases) +
                         " cases; shorten them, or let them go along with "
                         "each other, {{a | b}}.");
    }

    bool
    ends_with(const std::string &text, const std::string &end)
    {
      return text.size() >= end.size() &&
             text.compare(text.size() - end.size(), end.size(), end) == 0;
    }
  } // namespace



  std::pair<std::vector<std::string>, bool>
  split_loop(const std::string &value, const std::string &where)
  {
    const std::string found = "'" + value + "'";
    const std::size_t begin = value.find('{'), end = value.rfind('}');
    if (begin == std::string::npos && end == std::string::npos)
      return {{value}, false};
    if (begin == std::string::npos || end == std::string::npos || end < begin)
      throw InputError(where + "the braces of " + found +
                       " do not match; write a loop as {a | b} or, to go "
                       "along with another loop, {{a | b}}");

    const std::string prefix = value.substr(0, begin),
                      suffix = value.substr(end + 1);
    std::string inner        = value.substr(begin + 1, end - begin - 1);
    const bool  is_array =
      inner.size() >= 2 && inner.front() == '{' && inner.back() == '}';
    if (is_array)
      inner = inner.substr(1, inner.size() - 2);
    if (inner.find_first_of("{}") != std::string::npos)
      throw InputError(where + found +
                       " contains more than one pair of braces; a value can "
                       "hold one loop only, {a | b} or {{a | b}}");

    std::vector<std::string> values;
    for (std::size_t start = 0; start <= inner.size();)
      {
        const std::size_t bar = std::min(inner.find('|', start), inner.size());
        const std::string choice = trim(inner.substr(start, bar - start));
        if (choice.empty())
          throw InputError(where + "a choice of the loop " + found +
                           " is empty; write {a | b}");
        values.push_back(trim(prefix + choice + suffix));
        start = bar + 1;
      }
    return {values, is_array};
  }



  ParameterLoops::ParameterLoops(const ParameterText &text)
    : text_(text)
  {
    const std::vector<std::string> places = find_loops();
    name_loops();

    std::size_t n_combinations = 1;
    for (ParameterLoop &loop : loops_)
      if (!loop.is_array)
        {
          loop.axis = axis_sizes_.size();
          axis_sizes_.push_back(loop.values.size());
          n_combinations *= loop.values.size();
          check_number(n_combinations);
        }
    if (axis_sizes_.empty())
      join_arrays(places);
    else
      for (unsigned int l = 0; l < loops_.size(); ++l)
        if (loops_[l].is_array)
          loops_[l].axis = axis_of_array(l, n_combinations, places[l]);
  }



  std::vector<std::string>
  ParameterLoops::find_loops()
  {
    // The last value of an entry counts, at the place where it stands.
    std::map<std::string, const ParameterText::Statement *> last;
    visit_entries(text_,
                  [&](const std::string              &path,
                      const ParameterText::Statement &statement) {
                    last[path] = &statement;
                  });
    std::vector<std::string> places;
    visit_entries(text_,
                  [&](const std::string              &path,
                      const ParameterText::Statement &statement) {
                    if (last[path] != &statement)
                      return;
                    const auto [values, is_array] =
                      split_loop(statement.value,
                                 at_line(statement.file, statement.line));
                    if (statement.value.find('{') == std::string::npos)
                      return;
                    ParameterLoop loop;
                    loop.path     = path;
                    loop.values   = values;
                    loop.is_array = is_array;
                    loops_.push_back(loop);
                    places.push_back(at_line(statement.file, statement.line));
                  });
    return places;
  }



  // As much of the path as it takes to tell loops apart.
  void
  ParameterLoops::name_loops()
  {
    for (ParameterLoop &loop : loops_)
      {
        const auto parts = dealii::Utilities::split_string_list(loop.path, '/');
        for (std::size_t n = 1; n <= parts.size(); ++n)
          {
            loop.name = joined({parts.end() - n, parts.end()}, "/");
            if (std::count_if(loops_.begin(),
                              loops_.end(),
                              [&](const ParameterLoop &other) {
                                return ends_with("/" + other.path,
                                                 "/" + loop.name);
                              }) == 1)
              break;
          }
      }
  }



  // Arrays alone make one axis.
  void
  ParameterLoops::join_arrays(const std::vector<std::string> &places)
  {
    for (unsigned int l = 0; l < loops_.size(); ++l)
      {
        const unsigned int n = loops_[l].values.size();
        check_number(n);
        if (axis_sizes_.empty())
          axis_sizes_.push_back(n);
        if (n != axis_sizes_[0])
          throw InputError(
            places[l] + "the array of '" + loops_[l].path + "' has " +
            std::to_string(n) + " values, another array of this file has " +
            std::to_string(axis_sizes_[0]) +
            "; arrays go along with each other and need equal lengths");
        loops_[l].axis = 0;
      }
  }



  unsigned int
  ParameterLoops::axis_of_array(const unsigned int l,
                                const unsigned int n_combinations,
                                const std::string &where) const
  {
    const unsigned int n       = loops_[l].values.size();
    int                partner = -1;
    for (unsigned int k = 0; k < loops_.size(); ++k)
      if (!loops_[k].is_array && loops_[k].values.size() == n &&
          (partner < 0 || k < l))
        partner = k;
    if (partner >= 0)
      return loops_[partner].axis;
    if (n == n_combinations)
      return by_number;

    std::string lengths;
    for (const ParameterLoop &other : loops_)
      if (!other.is_array)
        lengths += (lengths.empty() ? "" : ", ") + other.name + ": " +
                   std::to_string(other.values.size());
    throw InputError(
      where + "the array of '" + loops_[l].path + "' has " + std::to_string(n) +
      " values; it needs as many as a loop that it can go along with (" +
      lengths + ") or as there are cases (" + std::to_string(n_combinations) +
      ")");
  }



  unsigned int
  ParameterLoops::n_cases() const
  {
    unsigned int n = 1;
    for (const unsigned int size : axis_sizes_)
      n *= size;
    return n;
  }



  const std::vector<ParameterLoop> &
  ParameterLoops::loops() const
  {
    return loops_;
  }



  const std::vector<unsigned int> &
  ParameterLoops::axis_sizes() const
  {
    return axis_sizes_;
  }



  std::vector<unsigned int>
  ParameterLoops::position(const unsigned int c) const
  {
    std::vector<unsigned int> result;
    unsigned int              rest = c;
    for (const unsigned int size : axis_sizes_)
      {
        result.push_back(rest % size);
        rest /= size;
      }
    return result;
  }



  const std::string &
  ParameterLoops::value(const unsigned int loop, const unsigned int c) const
  {
    const ParameterLoop &l = loops_[loop];
    return l.values[l.axis == by_number ? c : position(c)[l.axis]];
  }



  ParameterText
  ParameterLoops::text_of_case(const unsigned int c) const
  {
    std::map<std::string, std::string> values;
    for (unsigned int l = 0; l < loops_.size(); ++l)
      values[loops_[l].path] = value(l, c);

    ParameterText result = text_;
    visit_entries(result,
                  [&](const std::string        &path,
                      ParameterText::Statement &statement) {
                    const auto found = values.find(path);
                    if (found != values.end())
                      statement.value = found->second;
                    else if (statement.value.find('{') != std::string::npos)
                      {
                        // An earlier loop that a later plain value replaces.
                        statement.value =
                          split_loop(statement.value, "").first[0];
                      }
                  });
    return result;
  }



  unsigned int
  ParameterLoops::find(const std::string &name, const std::string &where) const
  {
    std::vector<unsigned int> found;
    std::vector<std::string>  names;
    for (unsigned int l = 0; l < loops_.size(); ++l)
      {
        const std::string &path = loops_[l].path;
        names.push_back(loops_[l].name);
        if (path == name || loops_[l].name == name ||
            path.substr(path.rfind('/') + 1) == name)
          found.push_back(l);
      }
    if (found.size() == 1)
      return found[0];
    std::string all;
    for (const std::string &n : names)
      all += (all.empty() ? "" : ", ") + n;
    if (found.empty())
      throw InputError("'" + name +
                       "' is not an entry with a loop; the loops of this "
                       "study are: " +
                       (all.empty() ? "none" : all) +
                       did_you_mean(name, names) + where);
    throw InputError("'" + name +
                     "' means more than one loop; take one of: " + all + where);
  }



  ParameterText
  with_overrides(const ParameterText            &text,
                 const std::vector<std::string> &overrides)
  {
    ParameterText result = text;
    for (const std::string &item : overrides)
      {
        const std::string where = "--set '" + item + "'";
        const std::size_t equal = item.find('=');
        if (equal == std::string::npos)
          throw InputError(where +
                           ": '=' is missing, write 'Subsection/Entry=value'");
        const auto path =
          dealii::Utilities::split_string_list(item.substr(0, equal), '/');
        if (path.empty() || path.back().empty())
          throw InputError(where + ": the name of the entry is missing, write "
                                   "'Subsection/Entry=value'");
        for (std::size_t i = 0; i + 1 < path.size(); ++i)
          result.statements.push_back(
            {StatementKind::subsection, path[i], "", where, 0});
        result.statements.push_back({StatementKind::set,
                                     path.back(),
                                     trim(item.substr(equal + 1)),
                                     where,
                                     0});
        for (std::size_t i = 0; i + 1 < path.size(); ++i)
          result.statements.push_back({StatementKind::end, "", "", where, 0});
      }
    return result;
  }



  std::pair<ParameterText, ParameterText>
  extract_subsection(const ParameterText &text, const std::string &wanted)
  {
    std::pair<ParameterText, ParameterText> result;
    std::vector<std::string>                path;
    // Depth at which the wanted subsection was entered, 0: outside.
    std::size_t inside = 0;
    for (const ParameterText::Statement &statement : text.statements)
      {
        if (statement.kind == StatementKind::subsection)
          {
            path.push_back(statement.name);
            if (inside == 0 && joined(path, "/") == wanted)
              {
                inside = path.size();
                continue;
              }
          }
        else if (statement.kind == StatementKind::end)
          {
            const bool closes = inside == path.size();
            path.pop_back();
            if (inside > 0 && closes)
              {
                inside = 0;
                continue;
              }
          }
        (inside > 0 ? result.first : result.second)
          .statements.push_back(statement);
      }
    return result;
  }



  std::string
  print_parameter_text(const ParameterText &text)
  {
    std::ostringstream out;
    unsigned int       depth = 0;
    for (const ParameterText::Statement &statement : text.statements)
      {
        if (statement.kind == StatementKind::end)
          --depth;
        out << std::string(2 * depth, ' ');
        switch (statement.kind)
          {
            case StatementKind::subsection:
              out << "subsection " << statement.name << '\n';
              ++depth;
              break;
            case StatementKind::set:
              out << "set " << statement.name << " = " << statement.value
                  << '\n';
              break;
            case StatementKind::end:
              out << "end\n";
              break;
          }
      }
    return out.str();
  }
} // namespace NPT
