// SPDX-License-Identifier: LGPL-2.1-or-later
// The problem "material test": its registration.

#include <npt_dealii/base/problem.h>
#include <npt_dealii/io/output_folder.h>
#include <npt_dealii/problems/material_test/material_test_parameters.h>
#include <npt_dealii/problems/material_test/numerical_material_testing.h>

#include <iostream>
#include <string>

namespace NPT
{
  namespace
  {
    void
    start(const ParameterText &text, const CommandLine &command)
    {
      const auto parameters =
        MaterialTestParameters::read(text, command.overrides);
      if (done_with_parameters(command, parameters, parameters.remarks))
        return;
      const std::string directory =
        make_output_directory(command, parameters.output.directory);
      const OutputFolder       folder(directory);
      NumericalMaterialTesting test(parameters, directory, std::cout);
      test.run();
    }

    const Registry<Problem>::Registration
      registration("material test",
                   {1,
                    "numerical material testing of a micro cell of fibers and "
                    "matrix",
                    start});
  } // namespace
} // namespace NPT
