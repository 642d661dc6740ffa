// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines reading the command line; every mistake ends in one sentence.

#include <npt_dealii/base/command_line.h>
#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/parameter_file.h>
#include <npt_dealii/base/text_file.h>

#include <deal.II/base/config.h>

#include <utility>

namespace NPT
{
  namespace
  {
    const std::vector<std::pair<std::string, CommandLine::Action>> actions = {
      {"--validate", CommandLine::Action::validate},
      {"--geometry-only", CommandLine::Action::geometry},
      {"--print-defaults", CommandLine::Action::print_defaults},
      {"--from-texgen", CommandLine::Action::from_texgen},
      {"--to-texgen", CommandLine::Action::to_texgen},
      {"--from-data-sheet", CommandLine::Action::from_data_sheet},
      {"--help", CommandLine::Action::help},
      {"--version", CommandLine::Action::version}};

    [[noreturn]] void
    fail(const std::string &sentence)
    {
      throw InputError(sentence + " (see npt_dealii --help)");
    }

    std::string
    unknown_option(const std::string &option)
    {
      std::vector<std::string> options = {"--output", "--set", "--continue"};
      for (const auto &item : actions)
        options.push_back(item.first);

      // "-output" and "--otput" alike: compare the words only.
      std::vector<std::string> words;
      for (const std::string &item : options)
        words.push_back(item.substr(2));
      const std::size_t first_letter = option.find_first_not_of('-');
      const auto nearest = nearest_names(first_letter == std::string::npos ?
                                           "" :
                                           option.substr(first_letter),
                                         words);
      return "unknown option '" + option + "'" +
             (nearest.empty() ? "" : "; did you mean '--" + nearest[0] + "'?");
    }

    void
    check_override(const std::string &text)
    {
      const std::string where = "--set '" + text + "': ";
      const std::string form  = "write --set 'Subsection/Entry=value'";
      const std::string::size_type equal  = text.find('=');
      const std::string            blanks = " \t\r\n";
      if (equal == std::string::npos)
        fail(where + "'=' is missing, " + form);
      if (text.substr(0, equal).find_first_not_of(blanks) == std::string::npos)
        fail(where + "the name of the entry is missing, " + form);
      if (text.find_first_not_of(blanks, equal + 1) == std::string::npos)
        fail(where + "the value is missing, " + form);
    }



    /// Takes the arguments one after the other. Boost.Program_options does the
    /// same with shorter messages; its library need not be there where deal.II
    /// is (Debian's libdeal.ii-dev does not depend on it).
    class ArgumentReader
    {
    public:
      explicit ArgumentReader(const std::vector<std::string> &arguments)
        : arguments_(arguments)
      {}

      CommandLine
      read()
      {
        for (next_ = 0; next_ < arguments_.size();)
          {
            const std::string &argument = arguments_[next_++];
            if (argument.empty())
              fail("an argument is empty; a shell variable may not be set");
            if (argument[0] != '-')
              set_file(argument);
            else
              read_option(argument);
          }
        if (result_.parameter_file.empty() &&
            result_.action != CommandLine::Action::print_defaults &&
            result_.action != CommandLine::Action::from_data_sheet)
          fail("the parameter file is missing, write npt_dealii FILE.prm");
        if (result_.continues && !action_option_.empty())
          fail("--continue and " + action_option_ +
               " exclude each other; choose one");
        return result_;
      }

    private:
      void
      set_file(const std::string &argument)
      {
        if (!result_.parameter_file.empty())
          fail("two parameter files, '" + result_.parameter_file + "' and '" +
               argument +
               "'; one run reads one file, and a value with blanks needs "
               "quotes");
        result_.parameter_file = argument;
      }

      void
      read_option(const std::string &argument)
      {
        const std::string option = argument.substr(0, argument.find('='));
        if (option == "--output")
          set_output(value_of_option(argument));
        else if (option == "--set")
          {
            const std::string value = value_of_option(argument);
            if (value.empty())
              fail("--set needs an entry and a value, write --set "
                   "'Subsection/Entry=value'");
            check_override(value);
            result_.overrides.push_back(value);
          }
        else if (argument == "--continue")
          result_.continues = true;
        else
          set_action(option, argument);
      }

      /// The value is behind '=' or in the next argument; a next argument that
      /// is an option itself means that the value was forgotten.
      std::string
      value_of_option(const std::string &argument)
      {
        const std::string::size_type equal = argument.find('=');
        if (equal != std::string::npos)
          return argument.substr(equal + 1);
        if (next_ < arguments_.size() &&
            arguments_[next_].compare(0, 2, "--") != 0)
          return arguments_[next_++];
        return "";
      }

      void
      set_output(const std::string &directory)
      {
        if (directory.empty())
          fail("--output needs the name of a directory");
        if (const std::string hint = home_folder_hint(directory); !hint.empty())
          fail("--output is '" + directory + "'" + hint);
        if (!result_.output_directory.empty())
          fail("--output is given twice, '" + result_.output_directory +
               "' and '" + directory + "'");
        result_.output_directory = directory;
      }

      void
      set_action(const std::string &option, const std::string &argument)
      {
        for (const auto &[name, action] : actions)
          if (option == name)
            {
              if (option != argument)
                fail(name + " takes no value, found '" + argument + "'");
              if (!action_option_.empty() && action_option_ != name)
                fail(action_option_ + " and " + name +
                     " exclude each other; choose one");
              action_option_ = name;
              result_.action = action;
              return;
            }
        fail(unknown_option(option));
      }

      const std::vector<std::string> &arguments_;
      std::size_t                     next_ = 0;
      std::string                     action_option_;
      CommandLine                     result_;
    };
  } // namespace



  CommandLine
  parse_command_line(const int argc, const char *const *argv)
  {
    const std::vector<std::string> arguments(argv + (argc > 0 ? 1 : 0),
                                             argv + argc);
    CommandLine                    result;
    for (const std::string &argument : arguments)
      if (argument == "--help" || argument == "-h")
        {
          result.action = CommandLine::Action::help;
          return result;
        }
    for (const std::string &argument : arguments)
      if (argument == "--version")
        {
          result.action = CommandLine::Action::version;
          return result;
        }
    return ArgumentReader(arguments).read();
  }



  std::string
  help_text()
  {
    return R"(npt_dealii - numerical plate testing of woven fabrics

Usage: npt_dealii FILE.prm [options]

  FILE.prm                the experiment: cell, materials, contact, stages

  --output DIR            write results to DIR instead of the directory named in
                          the file
  --set 'Sub/Entry=value' replace one entry of the file; may be repeated, and
                          subsections within subsections are joined by '/'
  --continue              go on where the run in the same directory was stopped;
                          what is finished there is not computed again
  --validate              read and check the file, compute nothing
  --geometry-only         write the geometry of the cell (VTU) and its sizes,
                          compute nothing
  --print-defaults        write a documented parameter file to the screen
  --from-texgen           FILE is a weave of TexGen (.tg3): write a parameter
                          file with its cell to the screen
  --to-texgen             write the cell of the file as a TexGen weave to the
                          screen
  --from-data-sheet       FILE is a data sheet (yarns per cm, tex, ...): check
                          it and write a parameter file to the screen; without
                          FILE write a form to fill in
  --help                  this text
  --version               versions of this program and of deal.II

Examples:
  npt_dealii shear.prm
  npt_dealii shear.prm --output mu02 --set 'Friction/Friction coefficient=0.2'
  npt_dealii shear.prm --continue
  npt_dealii --print-defaults > my_test.prm
  npt_dealii --from-texgen weave.tg3 > weave.prm
  npt_dealii --from-data-sheet fabric.sheet > fabric.prm

Exit status: 0 done; 1 a stage could not be finished or a tolerance was missed,
the results so far are complete; 2 the input cannot be used, nothing was
computed; 3 an error of the program; 4 a file could not be written. Ctrl-C ends
a plate test after its load step, with its results (130); a second one ends it
at once.
)";
  }



  std::string
  version_text(const std::string &program_version)
  {
    return "npt_dealii " + program_version + " (deal.II " +
           DEAL_II_PACKAGE_VERSION + ")\n";
  }
} // namespace NPT
