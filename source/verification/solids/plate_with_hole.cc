// SPDX-License-Identifier: LGPL-2.1-or-later
// A quarter of a plate with a circular hole under tension (Kirsch).

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
      return std::make_unique<HoleUnderTension>(p.load,
                                                p.inner_radius,
                                                law.young_modulus,
                                                law.poisson_ratio);
    }

    std::vector<NURBSPatch<3>>
    make_patches(const SolidBenchmarkParameters &p, const double thickness)
    {
      return quarter_plate_with_hole(p.inner_radius, p.outer_size, thickness);
    }

    const SolidCases::Registration
      registration("plate with hole",
                   {make_exact_solution, make_patches, true, false});
  } // namespace
} // namespace NPT
