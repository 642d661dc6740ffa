// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what distinguishes the cases of solid benchmarks: body, exact
// solution, load.

#ifndef npt_dealii_verification_solids_solid_case_h
#define npt_dealii_verification_solids_solid_case_h

#include <npt_dealii/base/registry.h>
#include <npt_dealii/iga/nurbs_patch.h>
#include <npt_dealii/verification/solids/exact_solids.h>

#include <functional>
#include <memory>
#include <vector>

namespace NPT
{
  struct SolidBenchmarkParameters;

  /**
   * A value of the entry "Case". A new one is a file in
   * source/verification/solids that registers it, see cylinder.cc.
   */
  struct SolidCase
  {
    using Parameters = SolidBenchmarkParameters;

    /// Of linear elasticity. None: the case is one of homogeneous states at
    /// finite strain, which ignores all that follows.
    std::function<std::unique_ptr<ElasticSolution>(const Parameters &)>
      make_exact_solution;

    /// The coarsest patches with the exact geometry; direction 0 goes from the
    /// inner to the outer face, the symmetry planes are those of the axes.
    std::function<std::vector<NURBSPatch<3>>(const Parameters &,
                                             const double thickness)>
      make_patches;

    /// Else three-dimensional, with a degenerate edge at the end "begin" of
    /// direction 1.
    bool plane_strain = true;

    /// Pressure on the inner face, else the exact tractions on the outer one.
    bool inner_pressure = true;

    bool
    is_homogeneous() const
    {
      return !make_exact_solution;
    }
  };

  using SolidCases = Registry<SolidCase>;
} // namespace NPT

#endif
