// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what the fuzzer does to the files of a user, and what the program is
// expected to say to it.

#ifndef npt_dealii_tests_fuzz_mutation_h
#define npt_dealii_tests_fuzz_mutation_h

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace Fuzz
{
  /// Numbers that are the same on every machine for the same seed; those of
  /// std::uniform_int_distribution are not.
  class Dice
  {
  public:
    explicit Dice(const std::uint32_t seed)
      : engine_(seed)
    {}

    /// A number below n > 0.
    std::size_t
    below(const std::size_t n)
    {
      return engine_() % n;
    }

    bool
    one_of(const std::size_t n)
    {
      return below(n) == 0;
    }

    template <typename T>
    const T &
    pick(const std::vector<T> &items)
    {
      return items[below(items.size())];
    }

  private:
    std::mt19937 engine_;
  };

  /// What is known of the answer before the program gives it.
  enum class Expected
  {
    anything, ///< accepted, or refused by a sentence
    refusal,  ///< the change makes the file wrong
    same      ///< the change means nothing
  };

  struct Mutant
  {
    std::string mutation; ///< what was done, in words
    std::string text;
    Expected    expected = Expected::anything;
  };

  /// A number as nobody should write it, or as somebody might. @p is_number:
  /// whether it still is one that can be stored.
  std::string
  odd_number(Dice &dice, bool &is_number);

  /// A parameter file after one change; @p others are texts to take lines from.
  Mutant
  mutate_parameters(const std::string              &text,
                    const std::vector<std::string> &others,
                    Dice                           &dice);

  /// A CSV table after one change.
  Mutant
  mutate_table(const std::string &text, Dice &dice);

  /// A data sheet after one change; @p others as for parameter files.
  Mutant
  mutate_sheet(const std::string              &text,
               const std::vector<std::string> &others,
               Dice                           &dice);

  /// A weave of TexGen after one change.
  Mutant
  mutate_texgen(const std::string &text, Dice &dice);

  /// What can happen to any file: bytes lost, changed, or repeated.
  Mutant
  damage(const std::string &text, Dice &dice);

  std::vector<std::string>
  lines_of(const std::string &text);
  std::string
  text_of(const std::vector<std::string> &lines);
} // namespace Fuzz

#endif
