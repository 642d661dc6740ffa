// SPDX-License-Identifier: LGPL-2.1-or-later
// The files of the project as they are copied and read for the fuzzer.

#include "seeds.h"

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/parameter_file.h>
#include <npt_dealii/base/program.h>
#include <npt_dealii/fabric_files/data_sheet.h>
#include <npt_dealii/fabric_files/texgen.h>
#include <npt_dealii/io/table_file.h>
#include <npt_dealii/problems/identification/material_curve.h>
#include <npt_dealii/problems/plate_test/plate_test_parameters.h>

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>

namespace Fuzz
{
  namespace fs = std::filesystem;

  namespace
  {
    // npt_dealii and verify in one.
    NPT::Program
    both_programs()
    {
      NPT::Program program;
      program.name            = "npt_dealii";
      program.default_problem = "plate test";
      program.from_texgen     = [](const std::string &file) {
        NPT::write_parameter_file(NPT::read_texgen(file), file, std::cout);
      };
      program.to_texgen = [](const NPT::ParameterText       &text,
                             const std::vector<std::string> &overrides) {
        NPT::write_texgen(NPT::PlateTestParameters::read(text, overrides).cell,
                          "weave",
                          std::cout);
      };
      program.from_data_sheet = [](const std::string              &file,
                                   const std::vector<std::string> &overrides) {
        NPT::write_parameter_file(
          NPT::DataSheet::read(NPT::read_parameter_text(file), overrides),
          file,
          std::cout);
      };
      return program;
    }

    void
    show_table(const std::string &name)
    {
      const NPT::Table table = NPT::read_table(name);
      for (const std::string &full : table.column_names)
        {
          std::cout << full << ':';
          // Texts stand beside numbers.
          try
            {
              for (const double value : table.column(full))
                std::cout << ' ' << value;
            }
          catch (const NPT::InputError &)
            {
              for (const std::string &text : table.text_column(full))
                std::cout << ' ' << text;
            }
          std::cout << '\n';
        }
    }

    void
    show_curves(const std::string &name)
    {
      for (const NPT::MaterialCurve &curve : NPT::read_material_curves(name))
        {
          std::cout << curve.name << ':';
          for (std::size_t i = 0; i < curve.H.size(); ++i)
            std::cout << ' ' << curve.H[i] << ' ' << curve.P[i];
          std::cout << '\n';
        }
    }

    // As run_program() answers.
    int
    answered(const std::function<void(const std::string &)> &read,
             const std::string                              &name)
    {
      try
        {
          read(name);
          return 0;
        }
      catch (const NPT::InputError &error)
        {
          std::cerr << "npt_dealii: " << error.what() << std::endl;
          return 2;
        }
      catch (const std::bad_alloc &)
        {
          return 1;
        }
      catch (const std::exception &error)
        {
          std::cerr << "unexpected error: " << error.what() << std::endl;
          return 3;
        }
    }

    std::string
    content_of(const fs::path &file)
    {
      std::ifstream     in(file, std::ios::binary);
      std::stringstream content;
      content << in.rdbuf();
      return content.str();
    }

    // Files that include one another twice: 2^20 files.
    void
    write_doubling_files(const fs::path &folder)
    {
      for (unsigned int i = 0; i <= 20; ++i)
        {
          std::ofstream out(folder /
                            ("doubling_" + std::to_string(i) + ".prm"));
          for (unsigned int twice = 0; twice < 2 && i > 0; ++twice)
            out << "include doubling_" << i - 1 << ".prm\n";
        }
    }

    std::vector<fs::path>
    files_in(const fs::path &folder)
    {
      std::vector<fs::path> files;
      for (const auto &entry : fs::directory_iterator(folder))
        if (const std::string extension = entry.path().extension();
            extension == ".csv" || extension == ".tg3" || extension == ".sheet")
          files.push_back(entry.path());
      std::sort(files.begin(), files.end());
      return files;
    }

    class SeedMaker
    {
    public:
      explicit SeedMaker(const fs::path &work)
        : work_(work)
      {}

      void
      add(const Kind kind, const fs::path &folder, const std::string &name)
      {
        const RunResult result = show(kind, folder, name);
        if (result.status != 0)
          throw std::runtime_error(name +
                                   " is not read as it stands: " + result.err);
        seeds_.push_back(
          {kind, folder, name, content_of(folder / name), result.out});
      }

      // What is made of a data sheet speaks of its name, so all have one.
      void
      add_sheet(const fs::path &folder, const std::string &name)
      {
        fs::copy_file(folder / name,
                      folder / "mutant.sheet",
                      fs::copy_options::overwrite_existing);
        add(Kind::data_sheet, folder, "mutant.sheet");
        seeds_.back().name = name;
      }

      void
      add_sheets()
      {
        const fs::path folder = work_ / "prm" / "fabrics" / "sheets";
        for (const fs::path &file : files_in(folder))
          add_sheet(folder, file.filename());
      }

      // With all entries of its problem.
      void
      add_documented(const Seed seed)
      {
        const std::string name = "all_of_" + seed.name;
        std::ofstream(seed.folder / name) << seed.shown;
        add(Kind::parameters, seed.folder, name);
      }

      void
      add_parameter_files()
      {
        std::vector<fs::path> files;
        for (const auto &entry :
             fs::recursive_directory_iterator(work_ / "prm"))
          if (entry.path().extension() == ".prm")
            files.push_back(entry.path());
          else if (entry.is_directory())
            write_later_.push_back(entry.path());
        std::sort(files.begin(), files.end());
        for (const fs::path &file : files)
          {
            add(Kind::parameters, file.parent_path(), file.filename());
            // Those of studies are long, and not documented.
            if (seeds_.back().shown.find("subsection Study") ==
                std::string::npos)
              add_documented(seeds_.back());
          }
        write_doubling_files(work_ / "prm");
        for (const fs::path &folder : write_later_)
          write_doubling_files(folder);
      }

      void
      add_weaves()
      {
        for (const std::string name : {"shear", "twill", "satin"})
          {
            const RunResult weave =
              run_program_in(work_ / "prm", {name + ".prm", "--to-texgen"});
            std::ofstream(work_ / "data" / (name + ".tg3")) << weave.out;
          }
      }

      void
      add_file(const fs::path &file)
      {
        const std::string extension = file.extension();
        const fs::path    folder    = work_ / "data";
        if (fs::absolute(file) != fs::absolute(folder / file.filename()))
          fs::copy_file(file,
                        folder / file.filename(),
                        fs::copy_options::overwrite_existing);
        if (extension == ".sheet")
          add_sheet(folder, file.filename());
        else
          add(extension == ".tg3"                     ? Kind::texgen :
              extension == ".prm"                     ? Kind::parameters :
              file.filename() == "material_tests.csv" ? Kind::material_table :
                                                        Kind::table,
              folder,
              file.filename());
      }

      std::vector<Seed> seeds_;

    private:
      const fs::path        work_;
      std::vector<fs::path> write_later_;
    };
  } // namespace



  RunResult
  run_program_in(const fs::path                 &folder,
                 const std::vector<std::string> &arguments)
  {
    static const NPT::Program program = both_programs();
    return run_isolated([&]() {
      if (chdir(folder.c_str()) != 0)
        return 3;
      std::vector<std::string> words = {"npt_dealii"};
      words.insert(words.end(), arguments.begin(), arguments.end());
      std::vector<char *> argv;
      for (std::string &word : words)
        argv.push_back(word.data());
      argv.push_back(nullptr);
      return NPT::run_program(program, words.size(), argv.data(), [](char **) {
      });
    });
  }



  RunResult
  show(const Kind kind, const fs::path &folder, const std::string &name)
  {
    if (kind == Kind::parameters)
      return run_program_in(folder, {name, "--print-defaults"});
    if (kind == Kind::texgen)
      return run_program_in(folder, {name, "--from-texgen"});
    if (kind == Kind::data_sheet)
      return run_program_in(folder, {name, "--from-data-sheet"});
    return run_isolated([&]() {
      if (chdir(folder.c_str()) != 0)
        return 3;
      return answered(kind == Kind::table ? show_table : show_curves, name);
    });
  }



  std::vector<Seed>
  make_seeds(const fs::path                 &source,
             const fs::path                 &work,
             const std::vector<std::string> &more)
  {
    fs::remove_all(work);
    fs::create_directories(work / "data");
    fs::copy(source / "prm", work / "prm", fs::copy_options::recursive);
    SeedMaker maker(work);
    maker.add_parameter_files();
    maker.add_sheets();
    for (const std::string folder : {"tests/peers/curves", "tests/data/fuzz"})
      for (const fs::path &file : files_in(source / folder))
        maker.add_file(file);
    maker.add_weaves();
    for (const std::string name : {"shear", "twill", "satin"})
      maker.add_file(work / "data" / (name + ".tg3"));
    for (const std::string &file : more)
      maker.add_file(file);
    return maker.seeds_;
  }
} // namespace Fuzz
