// SPDX-License-Identifier: LGPL-2.1-or-later
// Changes to parameter files by somebody who knows their grammar.

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <functional>
#include <set>
#include <utility>

#include "mutation.h"

namespace Fuzz
{
  namespace
  {
    using Lines = std::vector<std::string>;

    std::string
    without_blanks(const std::string &text)
    {
      const std::size_t begin = text.find_first_not_of(" \t\r");
      if (begin == std::string::npos)
        return "";
      return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
    }

    bool
    begins_with(const std::string &text, const std::string &start)
    {
      return text.compare(0, start.size(), start) == 0;
    }

    bool
    is_continued(const std::string &line)
    {
      const std::string plain = without_blanks(line);
      return !plain.empty() && plain.back() == '\\';
    }

    /// A parameter file by lines, which a change takes apart and joins again.
    struct File
    {
      Lines       lines;
      Dice       &dice;
      const Lines others; ///< lines of other files

      /// Numbers of the lines that begin with a word and are no part of the
      /// line before.
      std::vector<std::size_t>
      statements(const std::string &word) const
      {
        std::vector<std::size_t> result;
        for (std::size_t i = 0; i < lines.size(); ++i)
          if (begins_with(without_blanks(lines[i]) + " ", word + " ") &&
              (i == 0 || !is_continued(lines[i - 1])))
            result.push_back(i);
        return result;
      }

      /// One of them; the number of lines if there is none.
      std::size_t
      any(const std::string &word) const
      {
        const auto found = statements(word);
        return found.empty() ? lines.size() : dice.pick(found);
      }

      /// A place where a line may be inserted.
      std::size_t
      gap() const
      {
        std::size_t i = dice.below(lines.size() + 1);
        while (i > 0 && is_continued(lines[i - 1]))
          --i;
        return i;
      }

      void
      insert(const std::size_t i, const std::string &line)
      {
        lines.insert(lines.begin() + i, line);
      }
    };

    struct Setting
    {
      std::string head; ///< "  set Name = "
      std::string name, value;
    };

    Setting
    setting_of(const std::string &line)
    {
      const std::size_t equal = std::min(line.find('='), line.size() - 1);
      std::string       value = line.substr(equal + 1);
      value.erase(std::min(value.find('#'), value.size()));
      const std::string name =
        without_blanks(without_blanks(line.substr(0, equal)).substr(3));
      return {line.substr(0, equal + 1) + " ", name, without_blanks(value)};
    }

    bool
    is_number(const std::string &text)
    {
      char *end = nullptr;
      std::strtod(text.c_str(), &end);
      return !text.empty() && *end == '\0';
    }

    // Two neighboring letters change places, or one is lost.
    bool
    misspell(std::string &word, Dice &dice)
    {
      const std::string before = word;
      for (unsigned int trial = 0; trial < 10 && word == before; ++trial)
        {
          const std::size_t i = dice.below(word.size());
          if (std::isalpha(static_cast<unsigned char>(word[i])) == 0)
            continue;
          if (i + 1 < word.size() && dice.one_of(2) &&
              std::isalpha(static_cast<unsigned char>(word[i + 1])) != 0)
            std::swap(word[i], word[i + 1]);
          else if (word.size() > 4)
            word.erase(i, 1);
        }
      return word != before;
    }

    // What is changed, whether it could be, and what to expect.
    using Change  = std::function<bool(File &, Expected &)>;
    using Changes = std::vector<std::pair<std::string, Change>>;

    // -------------------------------------------------------------- lines

    bool
    misspell_name(File &file, Expected &expected)
    {
      const std::string word = file.dice.one_of(3) ? "subsection" : "set";
      const std::size_t i    = file.any(word);
      if (i == file.lines.size())
        return false;
      std::string  &line = file.lines[i];
      const Setting set  = setting_of(line + (word == "set" ? "" : " ="));
      std::string   name = word == "set" ?
                             set.name :
                             without_blanks(line.substr(line.find(word) + 10));
      name.erase(std::min(name.find('#'), name.size()));
      const std::size_t at = line.find(name);
      if (name.size() < 3 || at == std::string::npos)
        return false;
      std::string misspelt = name;
      if (!misspell(misspelt, file.dice))
        return false;
      line.replace(at, name.size(), misspelt);
      expected = Expected::refusal;
      return true;
    }

    bool
    misspell_keyword(File &file, Expected &expected)
    {
      const std::string word =
        file.dice.pick<std::string>({"set", "subsection", "end", "include"});
      const std::size_t i = file.any(word);
      if (i == file.lines.size())
        return false;
      std::string &line = file.lines[i];
      line.replace(
        line.find(word),
        word.size(),
        file.dice.pick<std::string>(
          {"Set", "setting", "subsect", "en", "End", "#set =", "="}));
      // What begins with '#' is gone.
      expected = line.find('#') == std::string::npos ? Expected::refusal :
                                                       Expected::anything;
      return true;
    }

    bool
    delete_line(File &file, Expected &expected)
    {
      const std::string word =
        file.dice.pick<std::string>({"set", "subsection", "end", "include"});
      const std::size_t i = file.any(word);
      if (i == file.lines.size())
        return false;
      file.lines.erase(file.lines.begin() + i);
      if (word == "subsection" || word == "end")
        expected = Expected::refusal;
      return true;
    }

    bool
    repeat_line(File &file, Expected &expected)
    {
      const std::string word =
        file.dice.pick<std::string>({"set", "subsection", "end", "include"});
      const std::size_t i = file.any(word);
      if (i == file.lines.size() || is_continued(file.lines[i]))
        return false;
      file.insert(i, std::string(file.lines[i]));
      if (word != "include")
        expected = Expected::refusal;
      return true;
    }

    bool
    swap_lines(File &file, Expected &)
    {
      const std::size_t i = file.dice.below(file.lines.size()),
                        j = file.dice.below(file.lines.size());
      std::swap(file.lines[i], file.lines[j]);
      return i != j;
    }

    bool
    foreign_line(File &file, Expected &)
    {
      if (file.others.empty())
        return false;
      file.insert(file.gap(), file.dice.pick(file.others));
      return true;
    }

    // A whole subsection of the top level goes to the end.
    bool
    move_section(File &file, Expected &expected)
    {
      int         depth = 0;
      std::size_t begin = file.lines.size();
      std::vector<std::pair<std::size_t, std::size_t>> sections;
      for (std::size_t i = 0; i < file.lines.size(); ++i)
        {
          const std::string line = without_blanks(file.lines[i]);
          if (begins_with(line, "subsection ") && depth++ == 0)
            begin = i;
          if (line == "end" && --depth == 0)
            sections.emplace_back(begin, i);
        }
      if (sections.empty())
        return false;
      const auto [from, to] = file.dice.pick(sections);
      const Lines section(file.lines.begin() + from,
                          file.lines.begin() + to + 1);
      file.lines.erase(file.lines.begin() + from, file.lines.begin() + to + 1);
      file.lines.insert(file.lines.end(), section.begin(), section.end());
      // Behind an include the values of this file would be those of the other;
      // studies keep the order of their entries.
      const std::string text = text_of(file.lines);
      if (text.find("include") == std::string::npos &&
          text.find("Study") == std::string::npos)
        expected = Expected::same;
      return true;
    }

    // ------------------------------------------------------------- values

    bool
    change_number(File &file, Expected &expected)
    {
      // Entries that take any text, and lists of names.
      static const std::set<std::string> texts = {
        "Title", "Target", "Stages", "Tests", "Curve", "Files", "Directory"};
      for (unsigned int trial = 0; trial < 20; ++trial)
        {
          const std::size_t i = file.any("set");
          if (i == file.lines.size() || is_continued(file.lines[i]))
            return false;
          const Setting set   = setting_of(file.lines[i]);
          std::size_t   begin = 0, end = set.value.size();
          // One number of a list, or behind the colon of a target.
          const std::size_t colon = set.value.rfind(':');
          if (colon != std::string::npos)
            begin = colon + 1;
          else if (const auto comma = set.value.rfind(',');
                   comma != std::string::npos)
            begin = comma + 1;
          const std::string number =
            without_blanks(set.value.substr(begin, end - begin));
          if (texts.count(set.name) > 0 || !is_number(number))
            continue;
          bool              remains_number = true;
          const std::string other = odd_number(file.dice, remains_number);
          file.lines[i] = set.head + set.value.substr(0, begin) + " " + other;
          if (!remains_number)
            expected = Expected::refusal;
          return true;
        }
      return false;
    }

    bool
    decimal_comma(File &file, Expected &)
    {
      for (unsigned int trial = 0; trial < 20; ++trial)
        {
          const std::size_t i = file.any("set");
          if (i == file.lines.size())
            return false;
          const std::size_t equal = file.lines[i].find('=');
          const std::size_t point = file.lines[i].find('.', equal);
          if (point == std::string::npos)
            continue;
          file.lines[i][point] = ',';
          return true;
        }
      return false;
    }

    bool
    misspell_value(File &file, Expected &)
    {
      const std::size_t i = file.any("set");
      if (i == file.lines.size())
        return false;
      const Setting set   = setting_of(file.lines[i]);
      std::string   value = set.value;
      if (value.size() < 2 || !misspell(value, file.dice))
        return false;
      file.lines[i] = set.head + value;
      return true;
    }

    bool
    odd_value(File &file, Expected &)
    {
      const std::size_t i = file.any("set");
      if (i == file.lines.size())
        return false;
      const Setting     set = setting_of(file.lines[i]);
      const std::string letter =
        file.dice.pick<std::string>({"",
                                     ",",
                                     ":",
                                     ",,",
                                     "::",
                                     "|",
                                     "{|}",
                                     "{{a|b}}",
                                     "{1|2|",
                                     "/",
                                     "~/x",
                                     "~",
                                     "..",
                                     "/dev/full",
                                     "a/../..",
                                     "true",
                                     "automatic",
                                     "none",
                                     "all",
                                     "H1",
                                     "H1:",
                                     "H1: 0.1, H1: 0.2",
                                     "n1: 0, H2: 1e300",
                                     "\"",
                                     "'",
                                     "\\",
                                     "\xE2\x80\x8B",
                                     "\xFF\xFE",
                                     "\x1B[31m",
                                     "%s%s%n",
                                     "$(id)",
                                     "value",
                                     "weave",
                                     "release, weave",
                                     "ou/uo",
                                     "o/u",
                                     "ou",
                                     "uuuu/oooo",
                                     "\xC3\xBC"});
      file.lines[i] =
        set.head + (file.dice.one_of(3) ? set.value + letter : letter);
      return true;
    }

    bool
    foreign_value(File &file, Expected &)
    {
      const std::size_t i = file.any("set");
      if (i == file.lines.size() || file.others.empty())
        return false;
      for (unsigned int trial = 0; trial < 50; ++trial)
        if (const std::string &line = file.dice.pick(file.others);
            begins_with(without_blanks(line), "set ") &&
            line.find('=') != std::string::npos)
          {
            file.lines[i] =
              setting_of(file.lines[i]).head + setting_of(line).value;
            return true;
          }
      return false;
    }

    bool
    long_line(File &file, Expected &expected)
    {
      const std::size_t i = file.any("set");
      if (i == file.lines.size())
        return false;
      const std::string piece = file.dice.pick<std::string>({"a",
                                                             "o",
                                                             "ou/",
                                                             "1",
                                                             "1,",
                                                             "a:",
                                                             "{",
                                                             " ",
                                                             "H1: 0.1, ",
                                                             "weave, ",
                                                             "\xC3\xBC"});
      std::string       long_text;
      while (long_text.size() < 200000)
        long_text += piece;
      if (file.dice.one_of(3))
        {
          file.insert(i, "set " + long_text + " = 1");
          expected = Expected::refusal;
        }
      else
        file.lines[i] = setting_of(file.lines[i]).head + long_text;
      return true;
    }

    // ---------------------------------------------------------- structure

    bool
    swap_section_names(File &file, Expected &)
    {
      const std::size_t i = file.any("subsection"), j = file.any("subsection");
      if (i == file.lines.size() ||
          without_blanks(file.lines[i]) == without_blanks(file.lines[j]))
        return false;
      std::swap(file.lines[i], file.lines[j]);
      return true;
    }

    bool
    deep_sections(File &file, Expected &expected)
    {
      const std::size_t i = file.gap();
      const std::string line =
        "subsection " + file.dice.pick<std::string>({"x", "Cell", "Mesh"});
      for (unsigned int k = 0; k < 3000; ++k)
        file.insert(i, line);
      if (file.dice.one_of(2))
        file.lines.insert(file.lines.end(), 3000, "end");
      expected = Expected::refusal;
      return true;
    }

    bool
    include_something(File &file, Expected &expected)
    {
      static const std::vector<std::pair<std::string, Expected>> files = {
        {"/dev/null", Expected::same},
        {"/dev/zero", Expected::refusal},
        {".", Expected::refusal},
        {"no_such_file.prm", Expected::refusal},
        {"~/x.prm", Expected::refusal},
        {"mutant.prm", Expected::refusal}, // itself
        {"/proc/self/exe", Expected::refusal},
        {"doubling_20.prm", Expected::refusal},
        {std::string(5000, 'x'), Expected::refusal}};
      const auto &[name, answer] = file.dice.pick(files);
      file.insert(file.gap(), "include " + name);
      expected = answer;
      return true;
    }

    bool
    backslash(File &file, Expected &expected)
    {
      const auto  sets = file.statements("set");
      std::size_t i    = file.any("set");
      if (i == file.lines.size() || is_continued(file.lines[i]))
        return false;
      file.lines[i] += file.dice.one_of(2) ? "\\" : " # C:\\results\\";
      if (std::count(sets.begin(), sets.end(), i + 1) > 0)
        expected = Expected::refusal;
      return true;
    }

    // --------------------------------------------- what must not matter

    void
    replace_line_ends(Lines &lines, const std::string &end)
    {
      std::string text;
      for (const std::string &line : lines)
        text += line + end;
      lines = {text};
    }

    bool
    harmless(File &file, Expected &expected)
    {
      expected = Expected::same;
      switch (file.dice.below(6))
        {
          case 0:
            replace_line_ends(file.lines, "\r\n");
            break;
          case 1:
            replace_line_ends(file.lines, "\r");
            break;
          case 2:
            file.lines[0] = "\xEF\xBB\xBF" + file.lines[0];
            break;
          case 3:
            for (std::string &line : file.lines)
              if (!is_continued(line))
                line = "\t " + line + " \t";
            break;
          case 4:
            for (unsigned int i = 0; i < 5; ++i)
              file.insert(file.gap(), "# set Nothing = \xFF 1e999");
            break;
          default:
            for (const std::string word : {"set", "subsection", "end"})
              for (const std::size_t i : file.statements(word))
                std::transform(word.begin(),
                               word.end(),
                               file.lines[i].begin() + file.lines[i].find(word),
                               [](const char c) {
                                 return static_cast<char>(c - 'a' + 'A');
                               });
        }
      return true;
    }

    const Changes &
    changes()
    {
      static const Changes all = {{"name misspelt", misspell_name},
                                  {"keyword misspelt", misspell_keyword},
                                  {"line deleted", delete_line},
                                  {"line repeated", repeat_line},
                                  {"lines swapped", swap_lines},
                                  {"line of another file", foreign_line},
                                  {"subsection moved", move_section},
                                  {"number changed", change_number},
                                  {"number changed", change_number},
                                  {"number changed", change_number},
                                  {"decimal comma", decimal_comma},
                                  {"value misspelt", misspell_value},
                                  {"odd value", odd_value},
                                  {"odd value", odd_value},
                                  {"value of another entry", foreign_value},
                                  {"long line", long_line},
                                  {"subsections renamed", swap_section_names},
                                  {"deep subsections", deep_sections},
                                  {"odd include", include_something},
                                  {"backslash", backslash},
                                  {"harmless change", harmless}};
      return all;
    }
  } // namespace



  Mutant
  mutate_parameters(const std::string              &text,
                    const std::vector<std::string> &others,
                    Dice                           &dice)
  {
    if (dice.one_of(12))
      return damage(text, dice);
    for (unsigned int trial = 0; trial < 100; ++trial)
      {
        File file{lines_of(text), dice, lines_of(dice.pick(others))};
        const auto &[name, change] = dice.pick(changes());
        Expected expected          = Expected::anything;
        if (!file.lines.empty() && change(file, expected))
          return {name, text_of(file.lines), expected};
      }
    return damage(text, dice);
  }
} // namespace Fuzz
