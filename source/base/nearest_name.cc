// SPDX-License-Identifier: LGPL-2.1-or-later
// Distances between words, and the guess that follows from them.

#include <npt_dealii/base/message_words.h>
#include <npt_dealii/base/nearest_name.h>

#include <algorithm>
#include <utility>

namespace NPT
{
  unsigned int
  edit_distance(const std::string &word_a, const std::string &word_b)
  {
    const std::string a = lower_case(word_a), b = lower_case(word_b);

    // distance[i][j] belongs to the first i and j characters.
    std::vector<std::vector<unsigned int>> distance(
      a.size() + 1, std::vector<unsigned int>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i)
      for (std::size_t j = 0; j <= b.size(); ++j)
        if (i == 0 || j == 0)
          distance[i][j] = i + j;
        else
          {
            distance[i][j] =
              std::min({distance[i - 1][j] + 1,
                        distance[i][j - 1] + 1,
                        distance[i - 1][j - 1] + (a[i - 1] != b[j - 1])});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
              distance[i][j] =
                std::min(distance[i][j], distance[i - 2][j - 2] + 1);
          }
    return distance[a.size()][b.size()];
  }



  std::vector<std::string>
  nearest_names(const std::string              &name,
                const std::vector<std::string> &candidates,
                const unsigned int              max_names)
  {
    // What is so long is no misspelt name, and takes long to compare.
    if (name.empty() || name.size() > 200)
      return {};

    const std::size_t max_distance = 1 + name.size() / 4;
    // Three letters are part of too many names.
    const bool use_parts = name.size() >= 4;

    std::vector<std::pair<unsigned int, std::string>> near;
    for (const std::string &candidate : candidates)
      {
        const unsigned int distance = edit_distance(name, candidate);
        // One letter may be replaced, but not all of them.
        if (distance <= max_distance && distance < name.size())
          near.emplace_back(distance, candidate);
        else if (use_parts && lower_case(candidate).find(lower_case(name)) !=
                                std::string::npos)
          near.emplace_back(max_distance + 1, candidate);
      }
    std::stable_sort(near.begin(),
                     near.end(),
                     [](const auto &x, const auto &y) {
                       return x.first < y.first;
                     });

    std::vector<std::string> result;
    for (const auto &item : near)
      if (result.size() < max_names &&
          std::find(result.begin(), result.end(), item.second) == result.end())
        result.push_back(item.second);
    return result;
  }



  std::string
  did_you_mean(const std::string              &name,
               const std::vector<std::string> &candidates)
  {
    auto nearest = nearest_names(name, candidates);
    // "twill 2/2" for "2/2 twill".
    if (const auto blank = name.find(' ');
        nearest.empty() && blank != std::string::npos)
      nearest =
        nearest_names(name.substr(blank + 1) + " " + name.substr(0, blank),
                      candidates);
    return nearest.empty() ? "" :
                             "; did you mean " + in_quotes(nearest[0]) + "?";
  }
} // namespace NPT
