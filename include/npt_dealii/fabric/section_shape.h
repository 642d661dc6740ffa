// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what a shape of bundle sections has to know: its faces, its area, its
// NURBS patch, and the numbers that it reads from a parameter file.

#ifndef npt_dealii_fabric_section_shape_h
#define npt_dealii_fabric_section_shape_h

#include <npt_dealii/base/own_numbers.h>
#include <npt_dealii/base/registry.h>
#include <npt_dealii/iga/nurbs_patch.h>

#include <functional>
#include <string>
#include <vector>

namespace NPT
{
  struct BundleSection;

  /**
   * A shape that a parameter file chooses by its name in
   * Registry<SectionShape>. All functions are required but check; what they
   * return is said at BundleSection, which calls them.
   */
  struct SectionShape
  {
    std::function<double(const BundleSection &, const double y)> half_height;
    std::function<double(const BundleSection &)>                 area;
    std::function<double(const BundleSection &)>                 edge_angle;
    std::function<NURBSPatch<2>(const BundleSection &,
                                const unsigned int degree,
                                const unsigned int n_across)>
      patch;

    /// Beyond width, thickness and blunt tip; entries of subsection "Cell".
    std::vector<OwnNumber> numbers = {};

    /// What makes these sizes impossible, without full stop; empty if nothing
    /// does. Sizes that no shape allows are refused before.
    std::function<std::string(const BundleSection &)> check = {};
  };



  /// Parts that shapes share.
  namespace SectionTools
  {
    /**
     * The patch between a wide face and its mirror image.
     *
     * @param across  Knots of the face.
     * @param y       Control points of the face along the width [mm].
     * @param h       Their heights above the mid-plane [mm].
     * @param weights Their weights [-].
     */
    NURBSPatch<2>
    between_faces(const KnotVector          &across,
                  const std::vector<double> &y,
                  const std::vector<double> &h,
                  const std::vector<double> &weights);

    /**
     * Knots that cut the spans of a section into parts of equal width.
     *
     * @param parts Number of parts of each span; a symmetric list.
     */
    std::vector<double>
    equally_wide(const NURBSPatch<2>             &section,
                 const std::vector<unsigned int> &parts);
  } // namespace SectionTools
} // namespace NPT

#endif
