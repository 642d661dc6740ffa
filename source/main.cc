// SPDX-License-Identifier: LGPL-2.1-or-later
// The program npt_dealii: runs the problem that the parameter file names. The
// problems register themselves in their rooms; benchmarks are computed by the
// program verify, which is started for them.

#include <npt_dealii/base/command_line.h>
#include <npt_dealii/base/parameter_file.h>
#include <npt_dealii/base/problem_names.h>
#include <npt_dealii/base/program.h>
#include <npt_dealii/fabric_files/data_sheet.h>
#include <npt_dealii/fabric_files/texgen.h>
#include <npt_dealii/linear_algebra/blas_kernels.h>
#include <npt_dealii/problems/plate_test/plate_test_parameters.h>

#include <iostream>

int
main(int argc, char **argv)
{
  NPT::Program program;
  program.name            = "npt_dealii";
  program.help            = NPT::help_text();
  program.default_problem = "plate test";
  program.other_program   = "verify";
  program.other_problems  = NPT::benchmark_names();
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
    if (file.empty())
      std::cout << NPT::DataSheet::documented_form();
    else
      NPT::write_parameter_file(
        NPT::DataSheet::read(NPT::read_parameter_text(file), overrides),
        file,
        std::cout);
  };
  return NPT::run_program(program, argc, argv, NPT::prepare_blas);
}
