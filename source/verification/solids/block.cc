// SPDX-License-Identifier: LGPL-2.1-or-later
// A block in homogeneous states at finite strain.

#include <npt_dealii/verification/solids/solid_case.h>

namespace NPT
{
  namespace
  {
    // Body and closed form depend on the state, see
    // SolidBenchmark::compare_homogeneous_states().
    const SolidCases::Registration registration("block", SolidCase());
  } // namespace
} // namespace NPT
