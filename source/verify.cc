// SPDX-License-Identifier: LGPL-2.1-or-later
// The program verify: computes the benchmarks with exact solutions, so that the
// product contains none. Same command line as npt_dealii.

#include <npt_dealii/base/program.h>
#include <npt_dealii/linear_algebra/blas_kernels.h>

int
main(int argc, char **argv)
{
  NPT::Program program;
  program.name = "verify";
  program.help =
    R"(verify - comparison of npt_dealii with exact solutions

Usage: verify FILE.prm [options]

  FILE.prm  a benchmark, `set Problem = solid benchmark` or `contact benchmark`;
            see prm/verification and doc/verification.md

The options are those of npt_dealii, which starts this program for benchmarks.

Exit status: 0 done, 1 a tolerance was missed or the run ended early (results so
far are complete), 2 the input cannot be used (nothing was computed), 3 an
unexpected error.
)";
  return NPT::run_program(program, argc, argv, NPT::prepare_blas);
}
