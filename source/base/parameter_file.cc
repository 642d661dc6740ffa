// SPDX-License-Identifier: LGPL-2.1-or-later
// Reading .prm files: lines to statements, statements against declarations,
// and the sentences that tell a user what to change.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/parameter_file.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <memory>
#include <ostream>
#include <sstream>
#include <utility>

namespace NPT
{
  namespace fs = std::filesystem;

  namespace
  {
    using Kind = ParameterText::Kind;

    std::string
    trim(const std::string &text)
    {
      return dealii::Utilities::trim(text);
    }

    std::string
    lower_case(std::string text)
    {
      std::transform(text.begin(), text.end(), text.begin(), [](const char c) {
        return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      });
      return text;
    }

    std::string
    in_quotes(const std::string &text)
    {
      return "'" + text + "'";
    }

    std::string
    joined(const std::vector<std::string> &words, const std::string &separator)
    {
      std::string result;
      for (std::size_t i = 0; i < words.size(); ++i)
        result += (i == 0 ? "" : separator) + words[i];
      return result;
    }

    /// All names in a message, unless that would bury the message.
    std::string
    listed(const std::vector<std::string> &names)
    {
      constexpr std::size_t    max_names = 12;
      std::vector<std::string> shown(names.begin(),
                                     names.begin() +
                                       std::min(names.size(), max_names));
      if (names.size() > max_names)
        shown.push_back("...");
      return joined(shown, ", ");
    }

    std::string
    at(const std::string &file, const unsigned int line)
    {
      // Statements without a line come from the command line.
      return file + (line > 0 ? ":" + std::to_string(line) : "") + ": ";
    }

    void
    replace_all(std::string       &text,
                const std::string &old_part,
                const std::string &new_part)
    {
      for (std::size_t pos = text.find(old_part); pos != std::string::npos;
           pos             = text.find(old_part, pos + new_part.size()))
        text.replace(pos, old_part.size(), new_part);
    }

    // What is pasted from a document often holds characters that look like
    // plain blanks or signs; two names that look equal need this explanation.
    std::string
    pasted_character_hint(const std::string &text)
    {
      static const std::vector<std::pair<std::string, std::string>> characters =
        {{"\xC2\xA0", "a non-breaking space"},
         {"\xE2\x80\xAF", "a narrow non-breaking space"},
         {"\xE2\x80\x8B", "a zero-width space"},
         {"\xE2\x88\x92", "a typographic minus sign"},
         {"\xE2\x80\x93", "a typographic dash"}};
      for (const auto &[bytes, name] : characters)
        if (text.find(bytes) != std::string::npos)
          return "; it contains " + name + ", type it anew on the keyboard";
      return "";
    }



    // ---- Files to statements ----------------------------------------------

    std::vector<std::string>
    parameter_files_in(const fs::path &folder)
    {
      std::vector<std::string> names;
      std::error_code          error;
      for (fs::directory_iterator entry(folder, error), end;
           !error && entry != end;
           entry.increment(error))
        if (entry->path().extension() == ".prm")
          names.push_back(entry->path().filename().string());
      std::sort(names.begin(), names.end());
      return names;
    }

    std::string
    read_file(const fs::path &path, const std::string &where)
    {
      const std::string name = in_quotes(path.string());
      std::error_code   error;

      if (fs::is_directory(path, error))
        {
          const auto names = parameter_files_in(path);
          throw InputError(where + name +
                           " is a directory, not a parameter file" +
                           (names.empty() ? "; it contains no .prm file" :
                                            "; it contains: " + listed(names)));
        }
      if (!fs::exists(path, error))
        {
          const fs::path folder =
            path.has_parent_path() ? path.parent_path() : fs::path(".");
          if (!fs::is_directory(folder, error))
            throw InputError(where + "file " + name +
                             " not found: there is no folder " +
                             in_quotes(folder.string()));

          const auto  names = parameter_files_in(folder);
          std::string hint  = did_you_mean(path.filename().string(), names);
          if (hint.empty())
            hint = names.empty() ? "; that folder contains no .prm file" :
                                   "; that folder contains: " + listed(names);
          throw InputError(where + "file " + name + " not found" + hint);
        }

      std::ifstream     in(path, std::ios::binary);
      std::stringstream content;
      if (in)
        content << in.rdbuf();
      if (!in || in.bad())
        throw InputError(where + "file " + name +
                         " cannot be read; check its permissions");
      return content.str();
    }

    struct OpenFile
    {
      std::string name;     // for messages
      fs::path    identity; // tells whether two names are the same file
    };

    void
    append_file(const std::string     &where,
                const fs::path        &path,
                std::vector<OpenFile> &open_files,
                ParameterText         &text);

    bool
    starts_with_keyword(const std::string &line,
                        const std::string &lower,
                        const std::string &upper)
    {
      return line.compare(0, lower.size(), lower) == 0 ||
             line.compare(0, upper.size(), upper) == 0;
    }

    std::string
    unrecognized_line(const std::string &line)
    {
      const std::string word = line.substr(0, line.find_first_of(" ="));
      std::string       hint =
        did_you_mean(word, {"set", "subsection", "end", "include"});
      if (hint.empty() && line.find('=') != std::string::npos)
        hint = "; did you forget 'set'?";
      return "cannot understand the line " + in_quotes(line) +
             ", a line begins with set, subsection, end or include" + hint;
    }

    // The rules below are those of ParameterHandler::parse_input() and
    // scan_line() in deal.II 9.4.1, including the two surprising ones: a
    // comment that ends in a backslash goes on in the next line, and blanks
    // before a backslash stay. Other programs must read our files alike.
    void
    append_content(const std::string     &content,
                   std::vector<OpenFile> &open_files,
                   ParameterText         &text)
    {
      const OpenFile this_file = open_files.back();
      if (content.find('\0') != std::string::npos)
        throw InputError("file " + in_quotes(this_file.name) +
                         " is not plain text, save it in UTF-8 encoding");

      struct Open
      {
        std::string  name;
        unsigned int line;
      };
      std::vector<Open> open_subsections;

      const auto scan = [&](std::string line, const unsigned int line_number) {
        const std::string where = at(this_file.name, line_number);

        line.erase(std::min(line.find('#'), line.size()));
        std::replace(line.begin(), line.end(), '\t', ' ');
        line = trim(line);

        if (line.empty())
          return;
        if (starts_with_keyword(line, "subsection ", "SUBSECTION "))
          {
            const std::string name = trim(line.substr(11));
            open_subsections.push_back({name, line_number});
            text.statements.push_back(
              {Kind::subsection, name, "", this_file.name, line_number});
          }
        else if (line == "subsection" || line == "SUBSECTION")
          throw InputError(where + "'subsection' without a name");
        else if (line == "end" || line == "END")
          {
            if (open_subsections.empty())
              throw InputError(where +
                               "'end' without a 'subsection' to be closed; "
                               "remove it or look for a missing 'subsection' "
                               "line above");
            open_subsections.pop_back();
            text.statements.push_back(
              {Kind::end, "", "", this_file.name, line_number});
          }
        else if (starts_with_keyword(line, "end ", "END "))
          throw InputError(where + "'end' must stand alone, found " +
                           in_quotes(line) + "; begin a comment with '#'");
        else if (starts_with_keyword(line, "set ", "SET ") || line == "set" ||
                 line == "SET")
          {
            const std::string            statement = line.substr(3);
            const std::string::size_type equal     = statement.find('=');
            if (equal == std::string::npos)
              throw InputError(where + "'set' without '=' in the line " +
                               in_quotes(line) + ", write 'set NAME = VALUE'");
            const std::string name = trim(statement.substr(0, equal));
            if (name.empty())
              throw InputError(where +
                               "'set' without the name of an entry in "
                               "the line " +
                               in_quotes(line) + ", write 'set NAME = VALUE'");
            text.statements.push_back({Kind::set,
                                       name,
                                       trim(statement.substr(equal + 1)),
                                       this_file.name,
                                       line_number});
          }
        else if (starts_with_keyword(line, "include ", "INCLUDE "))
          {
            const fs::path folder = fs::path(this_file.name).parent_path();
            append_file(where,
                        (folder / trim(line.substr(8))).lexically_normal(),
                        open_files,
                        text);
          }
        else if (line == "include" || line == "INCLUDE")
          throw InputError(where + "'include' without the name of a file");
        else
          throw InputError(where + unrecognized_line(line) +
                           pasted_character_hint(line));
      };

      // Some editors begin a UTF-8 file with a mark that nobody sees.
      const bool has_mark = content.compare(0, 3, "\xEF\xBB\xBF") == 0;

      std::istringstream in(has_mark ? content.substr(3) : content);
      std::string        physical_line, logical_line;
      unsigned int       n_lines = 0, first_line = 0;
      bool               continued = false;
      while (std::getline(in, physical_line))
        {
          ++n_lines;
          if (!continued)
            first_line = n_lines;
          physical_line = trim(physical_line);
          continued = !physical_line.empty() && physical_line.back() == '\\';
          if (continued)
            physical_line.pop_back();
          logical_line += physical_line;
          if (!continued)
            {
              scan(logical_line, first_line);
              logical_line.clear();
            }
        }
      if (continued)
        scan(logical_line, first_line);

      if (!open_subsections.empty())
        throw InputError(
          at(this_file.name, open_subsections.back().line) + "subsection " +
          in_quotes(open_subsections.back().name) + " opened in line " +
          std::to_string(open_subsections.back().line) +
          " is still open at the end of the file (line " +
          std::to_string(n_lines) + "), an 'end' is missing");
    }

    void
    append_file(const std::string     &where,
                const fs::path        &path,
                std::vector<OpenFile> &open_files,
                ParameterText         &text)
    {
      const std::string content = read_file(path, where);
      OpenFile          file{path.string(), fs::weakly_canonical(path)};

      std::vector<std::string> chain;
      bool                     is_cycle = false;
      for (const OpenFile &open : open_files)
        {
          is_cycle = is_cycle || open.identity == file.identity;
          if (is_cycle)
            chain.push_back(open.name);
        }
      if (is_cycle)
        {
          chain.push_back(file.name);
          throw InputError(
            where + "a file cannot include itself: " + joined(chain, " -> "));
        }

      open_files.push_back(file);
      append_content(content, open_files, text);
      open_files.pop_back();
    }



    // ---- Declared entries --------------------------------------------------

    struct DeclaredEntry
    {
      std::string name;
      std::string value;
      std::string default_value;
      std::string documentation;
      std::string pattern;
      std::string alias_of; // empty for a proper entry
    };

    struct DeclaredSection
    {
      std::string                  name;
      std::vector<DeclaredEntry>   entries;
      std::vector<DeclaredSection> subsections;

      const DeclaredEntry *
      find_entry(const std::string &entry_name) const
      {
        for (const DeclaredEntry &entry : entries)
          if (entry.name == entry_name)
            return &entry;
        return nullptr;
      }

      const DeclaredSection *
      find_subsection(const std::string &subsection_name) const
      {
        for (const DeclaredSection &subsection : subsections)
          if (subsection.name == subsection_name)
            return &subsection;
        return nullptr;
      }

      std::vector<std::string>
      entry_names() const
      {
        std::vector<std::string> names;
        for (const DeclaredEntry &entry : entries)
          if (entry.alias_of.empty())
            names.push_back(entry.name);
        return names;
      }

      std::vector<std::string>
      subsection_names() const
      {
        std::vector<std::string> names;
        for (const DeclaredSection &subsection : subsections)
          names.push_back(subsection.name);
        return names;
      }
    };

    using Path = std::vector<std::string>;

    // ParameterHandler keeps names as letters and digits, everything else as
    // _XX (hexadecimal): "Friction_20coefficient".
    std::string
    demangle(const std::string &name)
    {
      std::string result;
      for (std::size_t i = 0; i < name.size(); ++i)
        if (name[i] == '_' && i + 2 < name.size())
          {
            result += static_cast<char>(
              std::strtol(name.substr(i + 1, 2).c_str(), nullptr, 16));
            i += 2;
          }
        else
          result += name[i];
      return result;
    }

    void
    fill_section(const boost::property_tree::ptree &tree,
                 DeclaredSection                   &section)
    {
      for (const auto &[mangled_name, node] : tree)
        {
          const std::string name  = demangle(mangled_name);
          const auto        alias = node.get_child_optional("alias");
          // An entry called "value" is mangled entirely, so that a child of
          // this name always marks an entry; "alias" needs the second look.
          if (node.get_child_optional("value"))
            section.entries.push_back({name,
                                       node.get<std::string>("value"),
                                       node.get("default_value", ""),
                                       node.get("documentation", ""),
                                       node.get("pattern_description", ""),
                                       ""});
          else if (alias && alias->empty())
            section.entries.push_back({name, "", "", "", "", alias->data()});
          else
            {
              section.subsections.push_back({name, {}, {}});
              fill_section(node, section.subsections.back());
            }
        }
    }

    // XML rather than JSON, because only there names stay mangled and the tree
    // therefore unambiguous.
    DeclaredSection
    declared_parameters(const dealii::ParameterHandler &prm)
    {
      std::stringstream xml;
      prm.print_parameters(xml,
                           dealii::ParameterHandler::XML |
                             dealii::ParameterHandler::KeepDeclarationOrder);
      boost::property_tree::ptree tree;
      boost::property_tree::read_xml(xml, tree);

      DeclaredSection top;
      fill_section(tree.get_child("ParameterHandler"), top);
      return top;
    }

    std::string
    in_subsection(const Path &path)
    {
      return path.empty() ? " outside all subsections" :
                            " in subsection " + in_quotes(joined(path, "/"));
    }

    std::string
    to_subsection(const Path &path)
    {
      return path.empty() ? "the top level" :
                            "subsection " + in_quotes(joined(path, "/"));
    }

    /// Call @p visit(path, section) for a section and all below it.
    template <typename Visitor>
    void
    visit_sections(const DeclaredSection &section,
                   Path                  &path,
                   const Visitor         &visit)
    {
      visit(path, section);
      for (const DeclaredSection &subsection : section.subsections)
        {
          path.push_back(subsection.name);
          visit_sections(subsection, path, visit);
          path.pop_back();
        }
    }

    /**
     * What to write instead of an unknown name: the place it belongs to, else
     * the nearest name here, else elsewhere, else all that would be valid here.
     *
     * @param names_of Gives the names of the wanted kind in a section.
     */
    template <typename NamesOf>
    std::string
    hint_for_unknown_name(const std::string     &name,
                          const DeclaredSection &top,
                          const DeclaredSection &here,
                          const std::string     &kind,
                          const NamesOf         &names_of)
    {
      std::vector<std::string> homes, names_elsewhere;
      Path                     path;
      visit_sections(top,
                     path,
                     [&](const Path &p, const DeclaredSection &section) {
                       for (const std::string &candidate : names_of(section))
                         {
                           names_elsewhere.push_back(candidate);
                           if (candidate == name)
                             homes.push_back(to_subsection(p));
                         }
                     });
      if (!homes.empty())
        {
          // More homes than a sentence can hold come from numbered sections
          // (Stage 1, Stage 2, ...); two of them make the point.
          if (homes.size() > 2)
            {
              homes.resize(2);
              homes.push_back("others");
            }
          return "; it belongs to " + joined(homes, " or ");
        }

      const std::vector<std::string> names_here = names_of(here);
      std::string                    hint = did_you_mean(name, names_here);
      if (!hint.empty())
        return hint;

      const auto nearest = nearest_names(name, names_elsewhere);
      if (!nearest.empty())
        {
          std::string home;
          path.clear();
          visit_sections(
            top, path, [&](const Path &p, const DeclaredSection &section) {
              const auto names = names_of(section);
              if (home.empty() &&
                  std::count(names.begin(), names.end(), nearest[0]) > 0)
                home = to_subsection(p);
            });
          return "; did you mean " + in_quotes(nearest[0]) + " of " + home +
                 "?";
        }
      return names_here.empty() ? "; there is no " + kind + " here" :
                                  "; valid here: " + listed(names_here);
    }

    std::string
    unknown_entry(const std::string     &name,
                  const Path            &path,
                  const DeclaredSection &top,
                  const DeclaredSection &here)
    {
      const std::string text =
        "unknown entry " + in_quotes(name) + in_subsection(path);
      if (here.find_subsection(name) != nullptr)
        return text + "; " + in_quotes(name) +
               " is a subsection and has no value itself";
      return text +
             hint_for_unknown_name(name,
                                   top,
                                   here,
                                   "entry",
                                   [](const DeclaredSection &s) {
                                     return s.entry_names();
                                   }) +
             pasted_character_hint(name);
    }

    std::string
    unknown_subsection(const std::string     &name,
                       const Path            &path,
                       const DeclaredSection &top,
                       const DeclaredSection &here)
    {
      const std::string text =
        "unknown subsection " + in_quotes(name) + in_subsection(path);
      if (here.find_entry(name) != nullptr)
        return text + "; " + in_quotes(name) + " is an entry, write 'set " +
               name + " = VALUE'";
      return text +
             hint_for_unknown_name(name,
                                   top,
                                   here,
                                   "subsection",
                                   [](const DeclaredSection &s) {
                                     return s.subsection_names();
                                   }) +
             pasted_character_hint(name);
    }



    // ---- Values ------------------------------------------------------------

    /// The names in "[Selection a|b ]" and "[MultipleSelection a|b ]".
    std::vector<std::string>
    choices_of(const std::string &pattern)
    {
      if (pattern == "[Bool]")
        return {"true", "false"};
      for (const std::string start : {"[Selection ", "[MultipleSelection "})
        if (pattern.compare(0, start.size(), start) == 0)
          return dealii::Utilities::split_string_list(
            pattern.substr(start.size(), pattern.size() - start.size() - 1),
            '|');
      return {};
    }

    /// A value that the pattern accepts and that was probably meant.
    std::string
    suggestion_for_value(const std::string &value, const std::string &pattern)
    {
      const auto choices = choices_of(pattern);
      if (!choices.empty())
        {
          if (pattern == "[Bool]")
            for (const auto &[word, meaning] :
                 std::map<std::string, std::string>{{"yes", "true"},
                                                    {"on", "true"},
                                                    {"1", "true"},
                                                    {"no", "false"},
                                                    {"off", "false"},
                                                    {"0", "false"}})
              if (lower_case(value) == word)
                return "; did you mean " + in_quotes(meaning) + "?";
          return did_you_mean(value, choices);
        }

      const bool is_integer = pattern.compare(0, 8, "[Integer") == 0;
      const bool is_number  = pattern.compare(0, 7, "[Double") == 0;
      if (!is_integer && !is_number)
        return "";

      // A pasted minus sign, a decimal comma, Fortran's exponent, and for an
      // integer "3.0" or "1e3".
      std::string number = value;
      replace_all(number, "\xE2\x88\x92", "-");
      if (std::count(number.begin(), number.end(), ',') == 1)
        replace_all(number, ",", ".");
      std::replace(number.begin(), number.end(), 'd', 'e');
      std::replace(number.begin(), number.end(), 'D', 'e');
      if (is_integer)
        {
          char        *end = nullptr;
          const double x   = std::strtod(number.c_str(), &end);
          if (!number.empty() && *end == '\0' && std::abs(x) < 1e9 &&
              x == std::floor(x))
            number = std::to_string(static_cast<long>(x));
        }
      if (number != value &&
          dealii::Patterns::pattern_factory(pattern)->match(number))
        return "; did you mean " + in_quotes(number) + "?";

      // Words like nan and inf are read by other programs, so say it.
      std::string word = lower_case(value);
      word.erase(0, word.find_first_not_of("+-"));
      if (word == "nan" || word == "inf" || word == "infinity")
        return "; nan and inf are not accepted";
      return pasted_character_hint(value);
    }

    // deal.II sets the value or refuses it. Its own test decides, because the
    // description of a pattern has bounds rounded to six digits.
    void
    set_value(dealii::ParameterHandler &prm,
              const Path               &path,
              const DeclaredEntry      &entry,
              const std::string        &pattern,
              const std::string        &value,
              const std::string        &where)
    {
      for (const std::string &subsection : path)
        prm.enter_subsection(subsection);
      bool is_valid = true;
      try
        {
          prm.set(entry.name, value);
        }
      catch (const dealii::ParameterHandler::ExcValueDoesNotMatchPattern &)
        {
          is_valid = false;
        }
      for (std::size_t i = 0; i < path.size(); ++i)
        prm.leave_subsection();

      if (!is_valid)
        throw InputError(where + "entry " + in_quotes(entry.name) +
                         in_subsection(path) + " is " +
                         (value.empty() ? "empty" : in_quotes(value)) +
                         "; it must be " + describe_pattern(pattern) +
                         suggestion_for_value(value, pattern));
    }



    // ---- Overrides ---------------------------------------------------------

    struct Override
    {
      Path        components;
      std::string value;
      bool        has_equal_sign;
    };

    Override
    split_override(const std::string &text)
    {
      const std::string::size_type equal = text.find('=');
      Override                     result;
      result.has_equal_sign = equal != std::string::npos;
      if (result.has_equal_sign)
        result.value = trim(text.substr(equal + 1));

      std::istringstream in(text.substr(0, equal));
      std::string        component;
      while (std::getline(in, component, '/'))
        result.components.push_back(trim(component));
      return result;
    }
  } // namespace



  ParameterText
  read_parameter_text(const std::string &filename)
  {
    if (filename.empty())
      throw InputError("the name of the parameter file is empty");
    ParameterText         text;
    std::vector<OpenFile> open_files;
    append_file("", filename, open_files, text);
    return text;
  }



  ParameterText
  make_parameter_text(const std::string &content, const std::string &filename)
  {
    ParameterText         text;
    std::vector<OpenFile> open_files{
      {filename, fs::weakly_canonical(filename)}};
    append_content(content, open_files, text);
    return text;
  }



  void
  parse_parameter_text(dealii::ParameterHandler       &prm,
                       const ParameterText            &text,
                       const std::vector<std::string> &overrides)
  {
    const DeclaredSection top = declared_parameters(prm);

    // An old name and its new one are the same entry.
    const auto proper_entry = [](const DeclaredSection &section,
                                 const DeclaredEntry   &entry) {
      const DeclaredEntry *proper =
        entry.alias_of.empty() ? &entry : section.find_entry(entry.alias_of);
      return proper == nullptr ? &entry : proper;
    };

    // Where an entry was set: (file, path) -> line.
    std::map<std::pair<std::string, Path>, unsigned int> lines_of_entries;

    Path                                 path;
    std::vector<const DeclaredSection *> sections{&top};
    for (const ParameterText::Statement &statement : text.statements)
      {
        const std::string      where = at(statement.file, statement.line);
        const DeclaredSection &here  = *sections.back();
        switch (statement.kind)
          {
            case Kind::subsection:
              {
                const DeclaredSection *section =
                  here.find_subsection(statement.name);
                if (section == nullptr)
                  throw InputError(
                    where +
                    unknown_subsection(statement.name, path, top, here));
                sections.push_back(section);
                path.push_back(statement.name);
                break;
              }
            case Kind::end:
              {
                AssertThrow(!path.empty(), dealii::ExcInternalError());
                sections.pop_back();
                path.pop_back();
                break;
              }
            case Kind::set:
              {
                const DeclaredEntry *entry = here.find_entry(statement.name);
                if (entry == nullptr)
                  throw InputError(
                    where + unknown_entry(statement.name, path, top, here));
                entry = proper_entry(here, *entry);

                Path full_path = path;
                full_path.push_back(entry->name);
                const auto [previous, is_new] = lines_of_entries.emplace(
                  std::make_pair(statement.file, full_path), statement.line);
                // The same line once more is a file included twice.
                if (!is_new && previous->second != statement.line)
                  throw InputError(where + "entry " + in_quotes(entry->name) +
                                   in_subsection(path) +
                                   " is already set in line " +
                                   std::to_string(previous->second) +
                                   " of this file; keep only one of the two");
                set_value(
                  prm, path, *entry, entry->pattern, statement.value, where);
                break;
              }
          }
      }

    std::map<Path, std::string> overrides_of_entries;
    for (const std::string &override_text : overrides)
      {
        const std::string where = "--set " + in_quotes(override_text) + ": ";
        const Override    split = split_override(override_text);
        if (!split.has_equal_sign)
          throw InputError(where +
                           "'=' is missing, write 'Subsection/Entry=value'");
        if (split.components.empty() || split.components.back().empty())
          throw InputError(where + "the name of the entry is missing, write "
                                   "'Subsection/Entry=value'");
        // It could be used, but not be written to a parameter file again.
        if (split.value.find('#') != std::string::npos)
          throw InputError(where + "the value contains '#', which begins a "
                                   "comment in a parameter file");

        // Names with a slash are found by the joined path as well.
        const std::string      wanted        = joined(split.components, "/");
        const DeclaredSection *section_found = nullptr;
        const DeclaredEntry   *entry_found   = nullptr;
        Path                   path_found;
        path.clear();
        visit_sections(top,
                       path,
                       [&](const Path &p, const DeclaredSection &section) {
                         for (const DeclaredEntry &entry : section.entries)
                           {
                             Path full_path = p;
                             full_path.push_back(entry.name);
                             if (joined(full_path, "/") == wanted)
                               {
                                 section_found = &section;
                                 entry_found   = &entry;
                                 path_found    = p;
                               }
                           }
                       });

        if (entry_found == nullptr)
          {
            const DeclaredSection *here = &top;
            for (std::size_t i = 0; i + 1 < split.components.size(); ++i)
              {
                const std::string     &name = split.components[i];
                const DeclaredSection *next = here->find_subsection(name);
                if (next == nullptr)
                  throw InputError(where +
                                   unknown_subsection(name, path, top, *here));
                here = next;
                path.push_back(name);
              }
            throw InputError(
              where + unknown_entry(split.components.back(), path, top, *here));
          }

        entry_found    = proper_entry(*section_found, *entry_found);
        Path full_path = path_found;
        full_path.push_back(entry_found->name);
        const auto [previous, is_new] =
          overrides_of_entries.emplace(full_path, override_text);
        if (!is_new)
          throw InputError(
            where + "entry " + in_quotes(entry_found->name) +
            in_subsection(path_found) + " is already set by --set " +
            in_quotes(previous->second) + "; keep only one of the two");
        set_value(prm,
                  path_found,
                  *entry_found,
                  entry_found->pattern,
                  split.value,
                  where);
      }
  }



  std::optional<std::string>
  get_entry(const ParameterText            &text,
            const std::vector<std::string> &overrides,
            const std::string              &path)
  {
    const std::string wanted = joined(split_override(path).components, "/");

    std::optional<std::string> value;
    Path                       current_path;
    for (const ParameterText::Statement &statement : text.statements)
      switch (statement.kind)
        {
          case Kind::subsection:
            current_path.push_back(statement.name);
            break;
          case Kind::end:
            current_path.pop_back();
            break;
          case Kind::set:
            current_path.push_back(statement.name);
            if (joined(current_path, "/") == wanted)
              value = statement.value;
            current_path.pop_back();
            break;
        }

    for (const std::string &override_text : overrides)
      {
        const Override split = split_override(override_text);
        if (split.has_equal_sign && joined(split.components, "/") == wanted)
          value = split.value;
      }
    return value;
  }



  namespace
  {
    void
    print_section(const DeclaredSection &section,
                  const unsigned int     depth,
                  std::ostream          &out)
    {
      const std::string indent(2 * depth, ' ');
      const auto        print_comment = [&](const std::string &text) {
        const int width = 80 - static_cast<int>(indent.size()) - 2;
        for (const std::string &line :
             dealii::Utilities::break_text_into_lines(text, width))
          {
            // A blank paragraph line would otherwise end in a blank.
            const std::string comment = trim(line);
            out << indent << (comment.empty() ? "#" : "# ") << comment << '\n';
          }
      };

      std::size_t name_width = 0;
      for (const std::string &name : section.entry_names())
        name_width = std::max(name_width, name.size());

      bool is_first = true;
      for (const DeclaredEntry &entry : section.entries)
        {
          if (!entry.alias_of.empty())
            continue;
          if (!is_first)
            out << '\n';
          is_first = false;

          if (!trim(entry.documentation).empty())
            print_comment(trim(entry.documentation));
          std::string allowed;
          if (entry.pattern != "[Anything]")
            allowed = "Allowed: " + describe_pattern(entry.pattern) + ". ";
          if (entry.value != entry.default_value)
            allowed +=
              "Default: " +
              (entry.default_value.empty() ? "empty" : entry.default_value) +
              ".";
          if (!allowed.empty())
            print_comment(trim(allowed));
          out << indent << "set " << entry.name
              << std::string(name_width - entry.name.size(), ' ') << " ="
              << (entry.value.empty() ? "" : " ") << entry.value << '\n';
        }

      for (const DeclaredSection &subsection : section.subsections)
        {
          if (!is_first)
            out << '\n';
          is_first = false;
          out << indent << "subsection " << subsection.name << '\n';
          print_section(subsection, depth + 1, out);
          out << indent << "end\n";
        }
    }
  } // namespace



  void
  print_documented_parameters(const dealii::ParameterHandler &prm,
                              std::ostream                   &out)
  {
    print_section(declared_parameters(prm), 0, out);
  }



  namespace
  {
    /**
     * The text between the first "<" behind @p start and its closing ">",
     * descriptions within descriptions skipped; @p start moves behind it.
     * Brackets tell the depth: a separator such as <;> has none.
     */
    std::string
    text_in_angles(const std::string &text, std::size_t &start)
    {
      const std::size_t begin = text.find('<', start);
      if (begin == std::string::npos)
        return "";
      int depth = 0;
      for (std::size_t i = begin + 1; i < text.size(); ++i)
        {
          if (text[i] == '[')
            ++depth;
          else if (text[i] == ']')
            --depth;
          else if (text[i] == '>' && depth == 0)
            {
              start = i + 1;
              return text.substr(begin + 1, i - begin - 1);
            }
        }
      return "";
    }

    std::string
    separator_of(const std::string &text,
                 std::size_t        start,
                 const std::string &default_separator)
    {
      const std::string words = "separated by ";
      const std::size_t pos   = text.find(words, start);
      if (pos == std::string::npos)
        return in_quotes(default_separator);
      start = pos + words.size();
      return in_quotes(text_in_angles(text, start));
    }

    /// "exactly 2 values" from "... of length 2...2 (inclusive)".
    std::string
    count_of(const std::string &text, const std::size_t start)
    {
      const std::string words = " of length ";
      const std::size_t pos   = text.find(words, start);
      if (pos == std::string::npos)
        return "values";
      std::istringstream in(text.substr(pos + words.size()));
      unsigned long      min = 0, max = 0;
      in >> min;
      in.ignore(3);
      in >> max;

      const bool has_max = max < std::numeric_limits<unsigned int>::max();
      const auto values  = [](const unsigned long n) {
        return std::to_string(n) + (n == 1 ? " value" : " values");
      };
      if (has_max && min == max)
        return "exactly " + values(min);
      if (has_max && min > 0)
        return std::to_string(min) + " to " + values(max);
      if (has_max)
        return "at most " + values(max);
      if (min > 0)
        return "at least " + values(min);
      return "any number of values";
    }

    /// "a number in [0, 1]" from the bounds as deal.II writes them.
    std::string
    describe_range(const std::string &noun,
                   const std::string &lower,
                   const std::string &upper)
    {
      const auto is_unlimited = [](const std::string &bound) {
        return bound.find("MAX_DOUBLE") != std::string::npos ||
               bound == std::to_string(std::numeric_limits<int>::max()) ||
               bound == std::to_string(std::numeric_limits<int>::min());
      };
      const bool has_lower = !is_unlimited(lower),
                 has_upper = !is_unlimited(upper);

      // The smallest positive double as lower bound is the usual way to
      // exclude zero.
      const double lower_value = std::strtod(lower.c_str(), nullptr);
      const bool   is_positive = lower_value > 0 && lower_value < 1e-300;
      if (has_lower && has_upper)
        return noun + " in " + (is_positive ? "(0" : "[" + lower) + ", " +
               upper + "]";
      if (has_lower)
        return noun + (is_positive ? " > 0" : " >= " + lower);
      if (has_upper)
        return noun + " <= " + upper;
      return noun;
    }
  } // namespace



  std::string
  describe_pattern(const std::string &description)
  {
    const auto begins_with = [&](const std::string &start) {
      return description.compare(0, start.size(), start) == 0;
    };

    for (const auto &[start, noun] :
         {std::pair<std::string, std::string>{"[Double", "a number"},
          std::pair<std::string, std::string>{"[Integer", "an integer"}})
      if (begins_with(start))
        {
          // "[Double LOWER...UPPER (inclusive)]", integers with " range"
          const std::size_t dots = description.find("...");
          const std::size_t end  = description.find(" (inclusive)");
          if (dots == std::string::npos || end == std::string::npos)
            return noun;
          const std::size_t begin = description.rfind(' ', dots) + 1;
          return describe_range(noun,
                                description.substr(begin, dots - begin),
                                description.substr(dots + 3, end - dots - 3));
        }

    if (begins_with("[Bool"))
      return "true or false";
    if (begins_with("[Selection"))
      return "one of: " + joined(choices_of(description), ", ");
    if (begins_with("[MultipleSelection"))
      return "any of: " + joined(choices_of(description), ", ") +
             " (separated by ',')";
    if (begins_with("[List"))
      {
        std::size_t       pos   = 0;
        const std::string inner = text_in_angles(description, pos);
        return count_of(description, pos) + " separated by " +
               separator_of(description, pos, ",") + ", each " +
               describe_pattern(inner);
      }
    if (begins_with("[Map"))
      {
        std::size_t       pos   = 0;
        const std::string key   = text_in_angles(description, pos);
        const std::string value = text_in_angles(description, pos);
        return "pairs 'key:value' separated by " +
               separator_of(description, pos, ",") +
               " (key: " + describe_pattern(key) +
               "; value: " + describe_pattern(value) + ")";
      }
    if (begins_with("[Tuple"))
      {
        std::size_t        pos = 0;
        const unsigned int n =
          std::strtoul(text_in_angles(description, pos).c_str(), nullptr, 10);
        std::vector<std::string> parts;
        for (unsigned int i = 0; i < n; ++i)
          parts.push_back(describe_pattern(text_in_angles(description, pos)));
        return std::to_string(n) + " values separated by " +
               separator_of(description, pos, ":") + " (" +
               joined(parts, "; ") + ")";
      }
    if (begins_with("[FileName"))
      return "the name of a file";
    if (begins_with("[DirectoryName"))
      return "the name of a directory";
    if (begins_with("[Anything"))
      return "any text";
    return description;
  }



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
    if (name.empty())
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
    const auto nearest = nearest_names(name, candidates);
    return nearest.empty() ? "" :
                             "; did you mean " + in_quotes(nearest[0]) + "?";
  }
} // namespace NPT
