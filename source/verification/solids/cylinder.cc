// SPDX-License-Identifier: LGPL-2.1-or-later
// A quarter of a thick-walled cylinder under inner pressure (Lame).

#include <npt_dealii/verification/solids/benchmark_bodies.h>
#include <npt_dealii/verification/solids/solid_benchmark_parameters.h>
#include <npt_dealii/verification/solids/solid_case.h>

namespace NPT
{
  namespace
  {
    std::unique_ptr<ElasticSolution>
    make_exact_solution(const SolidBenchmarkParameters &p)
    {
      const auto &law = p.material.constants<NeoHookeanParameters>();
      return std::make_unique<PressurizedCylinder>(p.load,
                                                   p.inner_radius,
                                                   p.outer_size,
                                                   law.young_modulus,
                                                   law.poisson_ratio);
    }

    std::vector<NURBSPatch<3>>
    make_patches(const SolidBenchmarkParameters &p, const double thickness)
    {
      return {quarter_tube(p.inner_radius, p.outer_size, thickness)};
    }

    const SolidCases::Registration
      registration("cylinder", {make_exact_solution, make_patches, true, true});
  } // namespace
} // namespace NPT
