// SPDX-License-Identifier: LGPL-2.1-or-later
// Changes the files that a user can write in ways that people and machines
// change them, has the program read them, and looks for answers that are none:
//
//   fuzz_inputs [--cases N] [--seed S] [--only CASE] [--work DIR] [FILE ...]
//
// The same seed gives the same cases on every machine. Prints a table of what
// they met; what should not be is kept in DIR/findings, and makes the exit
// status 1.

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <map>
#include <sstream>
#include <stdexcept>

#include "mutation.h"
#include "seeds.h"

namespace Fuzz
{
  namespace fs = std::filesystem;

  namespace
  {
    struct Options
    {
      unsigned int             cases = 300, seed = 1;
      int                      only = -1;
      fs::path                 work = "fuzz_files";
      std::vector<std::string> more;
    };

    Options
    options_of(const std::vector<std::string> &arguments)
    {
      Options options;
      for (std::size_t i = 0; i < arguments.size(); ++i)
        {
          const std::string name  = arguments[i];
          const auto        value = [&]() {
            if (++i == arguments.size())
              throw std::runtime_error(name + " needs a value");
            return arguments[i];
          };
          if (name == "--cases")
            options.cases = std::stoul(value());
          else if (name == "--seed")
            options.seed = std::stoul(value());
          else if (name == "--only")
            options.only = std::stoi(value());
          else if (name == "--work")
            options.work = value();
          else if (name[0] == '-')
            throw std::runtime_error("unknown option " + name);
          else
            options.more.push_back(name);
        }
      return options;
    }

    // ------------------------------------------------------------- answers

    bool
    contains(const std::string &text, const std::string &part)
    {
      return text.find(part) != std::string::npos;
    }

    // What is wrong with the sentence of a refusal; empty: nothing.
    std::string
    fault_of_sentence(const std::string &text)
    {
      const std::string start = "npt_dealii: ";
      if (text.compare(0, start.size(), start) != 0 ||
          text.size() < start.size() + 10 || text.back() != '\n')
        return "no sentence";
      if (std::count(text.begin(), text.end(), '\n') != 1)
        return "more than a sentence";
      if (text.size() > 4000)
        return "sentence without an end";
      if (std::any_of(text.begin(), text.end() - 1, [](const char c) {
            return static_cast<unsigned char>(c) < ' ';
          }))
        return "control characters";
      return "";
    }

    // Finding, or "accepted" or "refused".
    std::string
    answer_of(const RunResult &result, const Expected expected)
    {
      if (result.signal == SIGALRM || result.signal == SIGXCPU ||
          result.signal == SIGKILL)
        return "hang";
      if (result.signal != 0)
        return "crash";
      for (const char *words :
           {"An error occurred in line", "violated condition", "Stacktrace"})
        if (contains(result.err, words))
          return "trace of deal.II";
      if (contains(result.err, "unexpected error") || result.status == 3)
        return "unexpected error";
      if (result.status == 1)
        return "huge allocation";
      if (result.status == 0)
        return expected == Expected::refusal ? "accepted, though wrong" :
                                               "accepted";
      if (result.status != 2)
        return "status that is not documented";
      std::string fault = fault_of_sentence(result.err);
      if (!fault.empty())
        return fault;
      return expected == Expected::same ? "refused, though the same" :
                                          "refused";
    }

    // -------------------------------------------------------------- a case

    struct Case
    {
      std::string              name; ///< kind and mutation
      fs::path                 folder;
      std::string              file;
      std::vector<std::string> arguments;
      std::string              answer, said;
      double                   cpu_seconds = 0;
    };

    const std::map<Kind, std::string> kind_names = {
      {Kind::parameters, "parameter file"},
      {Kind::table, "table"},
      {Kind::material_table, "test data"},
      {Kind::texgen, "TexGen"},
      {Kind::data_sheet, "data sheet"}};

    class Fuzzer
    {
    public:
      explicit Fuzzer(const Options &options)
        : options_(options)
        , seeds_(make_seeds(NPT_SOURCE_DIR, options.work, options.more))
      {
        for (const Seed &seed : seeds_)
          if (seed.kind == Kind::parameters)
            texts_.push_back(seed.text);
          else if (seed.kind == Kind::data_sheet)
            sheets_.push_back(seed.text);
      }

      Case
      run(const unsigned int number)
      {
        Dice              dice(options_.seed * 1000003u + number);
        const std::size_t chance = dice.below(100);
        const Kind        kind   = chance < 74 ? Kind::parameters :
                                   chance < 80 ? Kind::table :
                                   chance < 85 ? Kind::material_table :
                                   chance < 93 ? Kind::texgen :
                                                 Kind::data_sheet;
        const Seed       *seed   = &dice.pick(seeds_);
        while (seed->kind != kind)
          seed = &dice.pick(seeds_);
        if ((kind == Kind::parameters || kind == Kind::data_sheet) &&
            dice.one_of(8))
          return run_override(*seed, dice);
        return run_file(*seed, dice);
      }

    private:
      // An entry gets another value by --set: one of the documented file, or
      // one of a data sheet.
      Case
      run_override(const Seed &seed, Dice &dice)
      {
        const bool is_sheet = seed.kind == Kind::data_sheet;
        Case       c{is_sheet ? "data sheet: --set" : "--set",
               seed.folder,
               seed.name,
               {},
               "",
               "",
               0};
        std::vector<std::string> paths;
        std::string              path;
        for (const std::string &line :
             lines_of(is_sheet ? seed.text : seed.shown))
          {
            const std::size_t start = line.find_first_not_of(' ');
            if (start == std::string::npos)
              continue;
            const std::string word = line.substr(start);
            if (word.compare(0, 11, "subsection ") == 0)
              path += word.substr(11) + "/";
            else if (word == "end" && path.find('/') != std::string::npos)
              path.resize(path.rfind('/', path.size() - 2) + 1);
            else if (word.compare(0, 4, "set ") == 0)
              paths.push_back(path + word.substr(4, word.find('=') - 4));
          }
        bool              is_number = true;
        const std::string value =
          dice.one_of(3) ?
            dice.pick(lines_of(dice.pick(is_sheet ? sheets_ : texts_))) :
            odd_number(dice, is_number);
        c.arguments            = {c.file,
                       is_sheet ? "--from-data-sheet" : "--validate",
                                  "--set",
                                  dice.pick(paths) + "=" + value};
        const RunResult result = run_program_in(c.folder, c.arguments);
        judge(c, result, Expected::anything);
        if (is_sheet && c.answer == "accepted")
          check_what_was_printed(c, seed.kind, result.out);
        return c;
      }

      Case
      run_file(const Seed &seed, Dice &dice)
      {
        const Mutant mutant = seed.kind == Kind::parameters ?
                                mutate_parameters(seed.text, texts_, dice) :
                              seed.kind == Kind::texgen ?
                                mutate_texgen(seed.text, dice) :
                              seed.kind == Kind::data_sheet ?
                                mutate_sheet(seed.text, sheets_, dice) :
                                mutate_table(seed.text, dice);
        Case         c{kind_names.at(seed.kind) + ": " + mutant.mutation,
               seed.folder,
               "mutant" + fs::path(seed.name).extension().string(),
               {},
               "",
               "",
               0};
        std::ofstream(c.folder / c.file, std::ios::binary) << mutant.text;
        if (seed.kind == Kind::parameters &&
            mutant.expected != Expected::same && dice.one_of(2))
          {
            c.arguments = {c.file,
                           dice.one_of(10) ? "--to-texgen" : "--validate"};
            judge(c, run_program_in(c.folder, c.arguments), mutant.expected);
            return c;
          }
        const RunResult result = show(seed.kind, c.folder, c.file);
        judge(c, result, mutant.expected);
        if (c.answer != "accepted")
          return c;
        if (mutant.expected == Expected::same && result.out != seed.shown &&
            seed.kind != Kind::texgen)
          c.answer = "other meaning, though the same";
        else if (seed.kind == Kind::texgen || seed.kind == Kind::data_sheet ||
                 (seed.kind == Kind::parameters && dice.one_of(3)))
          check_what_was_printed(c, seed.kind, result.out);
        return c;
      }

      // What the program prints it reads, and prints again.
      static void
      check_what_was_printed(Case              &c,
                             const Kind         kind,
                             const std::string &printed)
      {
        std::ofstream(c.folder / "again.prm") << printed;
        // Of what follows from a data sheet all is checked.
        const RunResult again =
          kind == Kind::data_sheet ?
            run_program_in(c.folder, {"again.prm", "--validate"}) :
            show(Kind::parameters, c.folder, "again.prm");
        if (again.status != 0 ||
            (kind == Kind::parameters && again.out != printed))
          {
            c.answer = "what it prints it does not read";
            c.said   = again.err;
          }
      }

      static void
      judge(Case &c, const RunResult &result, const Expected expected)
      {
        c.answer      = answer_of(result, expected);
        c.said        = result.err;
        c.cpu_seconds = result.cpu_seconds;
        // Some of what is accepted may be slow.
        if (c.cpu_seconds > 0.5 * Limits().cpu_seconds &&
            (c.answer == "accepted" || c.answer == "refused"))
          c.answer = "slow";
      }

      const Options            options_;
      const std::vector<Seed>  seeds_;
      std::vector<std::string> texts_, sheets_; ///< to take lines from
    };

    // ------------------------------------------------------------- results

    bool
    is_finding(const std::string &answer)
    {
      return answer != "accepted" && answer != "refused";
    }

    void
    keep(const Options &options, const unsigned int number, const Case &c)
    {
      const fs::path folder = options.work / "findings";
      fs::create_directories(folder);
      const std::string name =
        std::to_string(options.seed) + "_" + std::to_string(number);
      fs::copy_file(c.folder / c.file,
                    folder / (name + fs::path(c.file).extension().string()),
                    fs::copy_options::overwrite_existing);
      std::ofstream out(folder / (name + ".txt"));
      out << c.answer << "\n" << c.name << "\nin " << c.folder.string() << ":";
      for (const std::string &argument : c.arguments)
        out << " '" << argument << "'";
      out << "\n" << c.said;
      std::cout << "case " << number << ": " << c.answer << " (" << c.name
                << "): " << c.said.substr(0, 300) << std::endl;
    }

    void
    print_table(
      const std::map<std::string, std::map<std::string, unsigned int>> &counts)
    {
      std::cout << "| change | cases | accepted | refused | findings |\n"
                << "| --- | --- | --- | --- | --- |\n";
      std::map<std::string, unsigned int> sum;
      const auto                          row = [](const std::string                         &name,
                          const std::map<std::string, unsigned int> &answers) {
        unsigned int all = 0, findings = 0;
        for (const auto &[answer, n] : answers)
          {
            all += n;
            findings += is_finding(answer) ? n : 0;
          }
        const auto number = [&](const std::string &answer) {
          const auto found = answers.find(answer);
          return found == answers.end() ? 0 : found->second;
        };
        std::cout << "| " << name << " | " << all << " | " << number("accepted")
                  << " | " << number("refused") << " | " << findings << " |\n";
      };
      for (const auto &[name, answers] : counts)
        {
          row(name, answers);
          for (const auto &[answer, n] : answers)
            sum[answer] += n;
        }
      row("all", sum);
    }

    int
    main_of_fuzzer(const std::vector<std::string> &arguments)
    {
      const Options options = options_of(arguments);
      Fuzzer        fuzzer(options);
      std::map<std::string, std::map<std::string, unsigned int>> counts;
      unsigned int                                               n_findings = 0;
      double             cpu = 0, longest = 0;
      const unsigned int begin = options.only < 0 ? 0 : options.only;
      const unsigned int end   = options.only < 0 ? options.cases : begin + 1;
      for (unsigned int number = begin; number < end; ++number)
        {
          const Case c = fuzzer.run(number);
          // One row for all kinds of damage.
          ++counts[c.name.substr(0, c.name.find(','))][c.answer];
          cpu += c.cpu_seconds;
          longest = std::max(longest, c.cpu_seconds);
          if (is_finding(c.answer))
            {
              ++n_findings;
              keep(options, number, c);
            }
          else if (options.only >= 0)
            std::cout << c.answer << ": " << c.said;
        }
      print_table(counts);
      std::cout << "\n"
                << end - begin << " cases, " << n_findings << " findings, "
                << std::setprecision(3) << cpu << " s of CPU time, at most "
                << longest << " s for one.\n";
      return n_findings == 0 ? 0 : 1;
    }
  } // namespace
} // namespace Fuzz

int
main(int argc, char **argv)
{
  try
    {
      return Fuzz::main_of_fuzzer({argv + 1, argv + argc});
    }
  catch (const std::exception &error)
    {
      std::cerr << "fuzz_inputs: " << error.what() << std::endl;
      return 2;
    }
}
