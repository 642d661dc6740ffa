// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the way from parameter files to statements: lines, include
// files, balanced subsections.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/message_words.h>
#include <npt_dealii/base/nearest_name.h>
#include <npt_dealii/base/parameter_text.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace NPT
{
  namespace fs = std::filesystem;

  namespace
  {
    using Kind = ParameterText::Kind;

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

    /**
     * Reads the lines of one file into statements. deal.II's own reader sets
     * values at once, so that it could not tell which entries to declare, and
     * knows an include file by the folder that the program was started in.
     *
     * The rules are those of ParameterHandler::parse_input() and scan_line() in
     * deal.II 9.4.1, including the two surprising ones: a comment that ends in
     * a backslash goes on in the next line, and blanks before a backslash stay.
     * Other programs must read our files alike.
     */
    class StatementReader
    {
    public:
      StatementReader(std::vector<OpenFile> &open_files, ParameterText &text)
        : open_files_(open_files)
        , file_(open_files.back().name)
        , text_(text)
      {}

      void
      read(const std::string &content)
      {
        if (content.find('\0') != std::string::npos)
          throw InputError("file " + in_quotes(file_) +
                           " is not plain text, save it in UTF-8 encoding");

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
        check_all_closed(n_lines);
      }

    private:
      // One line, those that go on in the next one joined.
      void
      scan(std::string line, const unsigned int line_number)
      {
        line.erase(std::min(line.find('#'), line.size()));
        std::replace(line.begin(), line.end(), '\t', ' ');
        line = trim(line);

        const std::string where = at_line(file_, line_number);
        if (line.empty())
          return;
        if (starts_with_keyword(line, "subsection ", "SUBSECTION "))
          {
            const std::string name = trim(line.substr(11));
            open_subsections_.push_back({name, line_number});
            text_.statements.push_back(
              {Kind::subsection, name, "", file_, line_number});
          }
        else if (line == "subsection" || line == "SUBSECTION")
          throw InputError(where + "'subsection' without a name");
        else if (line == "end" || line == "END")
          close_subsection(where, line_number);
        else if (starts_with_keyword(line, "end ", "END "))
          throw InputError(where + "'end' must stand alone, found " +
                           in_quotes(line) + "; begin a comment with '#'");
        else if (starts_with_keyword(line, "set ", "SET ") || line == "set" ||
                 line == "SET")
          add_setting(where, line, line_number);
        else if (starts_with_keyword(line, "include ", "INCLUDE "))
          {
            const fs::path folder = fs::path(file_).parent_path();
            append_file(where,
                        (folder / trim(line.substr(8))).lexically_normal(),
                        open_files_,
                        text_);
          }
        else if (line == "include" || line == "INCLUDE")
          throw InputError(where + "'include' without the name of a file");
        else
          throw InputError(where + unrecognized_line(line) +
                           pasted_character_hint(line));
      }

      void
      add_setting(const std::string &where,
                  const std::string &line,
                  const unsigned int line_number)
      {
        const std::string            statement = line.substr(3);
        const std::string::size_type equal     = statement.find('=');
        if (equal == std::string::npos)
          throw InputError(where + "'set' without '=' in the line " +
                           in_quotes(line) + ", write 'set NAME = VALUE'");
        const std::string name = trim(statement.substr(0, equal));
        if (name.empty())
          throw InputError(where +
                           "'set' without the name of an entry in the line " +
                           in_quotes(line) + ", write 'set NAME = VALUE'");
        text_.statements.push_back({Kind::set,
                                    name,
                                    trim(statement.substr(equal + 1)),
                                    file_,
                                    line_number});
      }

      void
      close_subsection(const std::string &where, const unsigned int line_number)
      {
        if (open_subsections_.empty())
          throw InputError(where +
                           "'end' without a 'subsection' to be closed; "
                           "remove it or look for a missing 'subsection' "
                           "line above");
        open_subsections_.pop_back();
        text_.statements.push_back({Kind::end, "", "", file_, line_number});
      }

      void
      check_all_closed(const unsigned int n_lines) const
      {
        if (open_subsections_.empty())
          return;
        const Open &last = open_subsections_.back();
        throw InputError(at_line(file_, last.line) + "subsection " +
                         in_quotes(last.name) + " opened in line " +
                         std::to_string(last.line) +
                         " is still open at the end of the file (line " +
                         std::to_string(n_lines) + "), an 'end' is missing");
      }

      struct Open
      {
        std::string  name;
        unsigned int line;
      };

      std::vector<OpenFile> &open_files_;
      const std::string      file_;
      ParameterText         &text_;
      std::vector<Open>      open_subsections_;
    };

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
      StatementReader(open_files, text).read(content);
      open_files.pop_back();
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
    StatementReader(open_files, text).read(content);
    return text;
  }
} // namespace NPT
