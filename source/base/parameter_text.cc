// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the way from parameter files to statements: lines, include
// files, balanced subsections.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/message_words.h>
#include <npt_dealii/base/nearest_name.h>
#include <npt_dealii/base/parameter_text.h>
#include <npt_dealii/base/text_file.h>

#include <algorithm>
#include <filesystem>
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

    // Throws InputError if a file is not there or is a directory.
    void
    check_file(const fs::path &path, const std::string &where)
    {
      const std::string name = in_quotes(path.string());
      std::error_code   error;

      if (const std::string obstacle = obstacle_to_file(path.string());
          !obstacle.empty())
        throw InputError(where + "file " + name +
                         " cannot be read: " + obstacle);
      if (fs::is_directory(path, error))
        {
          const auto names = parameter_files_in(path);
          throw InputError(where + name +
                           " is a directory, not a parameter file" +
                           (names.empty() ? "; it contains no .prm file" :
                                            "; it contains: " + listed(names)));
        }
      if (fs::exists(path, error))
        return;
      if (const std::string hint = home_folder_hint(path.string());
          !hint.empty())
        throw InputError(where + "file " + name + " not found" + hint);
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

    struct OpenFile
    {
      std::string name;     // for messages
      fs::path    identity; // tells whether two names are the same file
      fs::path    folder;   // of the files that it includes
    };

    // The files that are being read, each included by the one before it.
    struct OpenFiles
    {
      std::vector<OpenFile> chain;
      // Of all files so far: ten that include each other's successors twice
      // are a thousand.
      unsigned int n_files = 0;
      std::size_t  size    = 0;
    };

    constexpr unsigned int max_files = 1000;
    constexpr std::size_t  max_depth = 50; // of subsections in a file

    OpenFile
    open_file(const fs::path &path)
    {
      std::error_code error;
      const fs::path  identity = fs::weakly_canonical(path, error);
      // A pipe lies in no folder.
      return {path.string(),
              error ? path : identity,
              is_stream(path.string()) ? fs::path() : path.parent_path()};
    }

    void
    append_file(const std::string &where,
                const fs::path    &path,
                OpenFiles         &open_files,
                ParameterText     &text);

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

    /// Whether a line, blanks at both ends gone, is a statement by itself.
    bool
    is_statement(std::string line)
    {
      line.erase(std::min(line.find('#'), line.size()));
      std::replace(line.begin(), line.end(), '\t', ' ');
      line = trim(line);
      return line == "end" || line == "END" ||
             starts_with_keyword(line, "subsection ", "SUBSECTION ") ||
             starts_with_keyword(line, "include ", "INCLUDE ") ||
             (starts_with_keyword(line, "set ", "SET ") &&
              line.find('=') != std::string::npos);
    }

    /**
     * Reads the lines of one file into statements. deal.II's own reader sets
     * values at once, so that it could not tell which entries to declare, and
     * knows an include file by the folder that the program was started in.
     *
     * The rules are those of ParameterHandler::parse_input() and scan_line() in
     * deal.II 9.4.1, including the two surprising ones: a comment that ends in
     * a backslash goes on in the next line, and blanks before a backslash stay.
     * Other programs must read our files alike. What would make a statement a
     * part of the line before it (a folder C:\results\) is refused.
     */
    class StatementReader
    {
    public:
      StatementReader(OpenFiles &open_files, ParameterText &text)
        : open_files_(open_files)
        , file_(open_files.chain.back().name)
        , folder_(open_files.chain.back().folder)
        , text_(text)
      {}

      void
      read(const std::string &content)
      {
        std::istringstream in(content);
        std::string        physical_line, logical_line;
        unsigned int       n_lines = 0, first_line = 0;
        bool               continued = false;
        while (std::getline(in, physical_line))
          {
            ++n_lines;
            if (!continued)
              first_line = n_lines;
            physical_line = trim(physical_line);
            if (continued && is_statement(physical_line))
              throw InputError(at_line(file_, n_lines - 1) +
                               "the backslash at the end of the line makes " +
                               in_quotes(physical_line) +
                               " in the next one a part of it; remove the "
                               "backslash");
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
            if (open_subsections_.size() == max_depth)
              throw InputError(where + "subsection " + in_quotes(name) +
                               " lies within " + std::to_string(max_depth) +
                               " others, an 'end' is missing");
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
          append_file(where,
                      included(trim(line.substr(8))),
                      open_files_,
                      text_);
        else if (line == "include" || line == "INCLUDE")
          throw InputError(where + "'include' without the name of a file");
        else
          throw InputError(where + unrecognized_line(line) +
                           pasted_character_hint(line));
      }

      fs::path
      included(const std::string &name) const
      {
        return home_folder_hint(name).empty() ?
                 (folder_ / name).lexically_normal() :
                 fs::path(name);
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

      OpenFiles        &open_files_;
      const std::string file_;
      const fs::path    folder_;
      ParameterText    &text_;
      std::vector<Open> open_subsections_;
    };

    void
    append_file(const std::string &where,
                const fs::path    &path,
                OpenFiles         &open_files,
                ParameterText     &text)
    {
      check_file(path, where);
      const OpenFile file = open_file(path);

      std::vector<std::string> chain;
      bool                     is_cycle = false;
      for (const OpenFile &open : open_files.chain)
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

      const std::string content =
        read_text_file(file.name, where + "file " + in_quotes(file.name));
      open_files.size += content.size();
      if (++open_files.n_files > max_files ||
          open_files.size > largest_text_file)
        throw InputError(where + "file " + in_quotes(file.name) +
                         " is too much: files are included " +
                         std::to_string(open_files.n_files) + " times, with " +
                         std::to_string(open_files.size >> 20) +
                         " MB; include each one once");
      open_files.chain.push_back(file);
      StatementReader(open_files, text).read(content);
      open_files.chain.pop_back();
    }
  } // namespace



  ParameterText
  read_parameter_text(const std::string &filename)
  {
    if (filename.empty())
      throw InputError("the name of the parameter file is empty");
    ParameterText text;
    OpenFiles     open_files;
    append_file("", filename, open_files, text);
    return text;
  }



  ParameterText
  make_parameter_text(const std::string &content, const std::string &filename)
  {
    ParameterText text;
    OpenFiles     open_files;
    open_files.chain.push_back(open_file(filename));
    StatementReader(open_files, text).read(with_plain_lines(content));
    return text;
  }
} // namespace NPT
