// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about the memory that is foreseen for a plate test.

#include <npt_dealii/problems/plate_test/memory_need.h>

#include <catch2/catch.hpp>

#include "plate_run.h"

using namespace PlateTestTools;
using Catch::Contains;

TEST_CASE("The memory foreseen for a matrix is no more than it takes, and no "
          "less than a quarter of it",
          "[plate_test]")
{
  const std::vector<std::vector<std::string>> meshes = {
    {},
    {"Mesh/Elements along=4",
     "Mesh/Elements across=6",
     "Mesh/Elements through=1"},
    {"Mesh/Degree=3", "Mesh/Elements along=5", "Mesh/Elements across=5"},
    {"Cell/Weave=oou/uoo/ouo",
     "Cell/Type=unit cell",
     "Mesh/Elements along=5",
     "Mesh/Elements across=5"}};
  for (std::vector<std::string> overrides : meshes)
    {
      overrides.push_back("Load programme/Stages=weave");
      PlateRun             run(overrides);
      const PlateTestStage stage(
        run.cell, run.parameters, 0, run.state, run.woven, run.system);
      run.system.build_pattern();
      const double taken  = 24e-9 * run.system.matrix().values.size();
      const double needed = least_gigabytes(run.parameters);
      CAPTURE(overrides, taken, needed);
      CHECK(needed <= taken);
      CHECK(needed >= 0.25 * taken);
      CHECK(obstacle_of_memory(run.parameters, 1.01 * needed).empty());
      CHECK_THAT(obstacle_of_memory(run.parameters, 0.99 * needed),
                 Contains("GB are available"));
    }
}
