// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what several cases of Hertzian contact share: meshes that are graded
// towards the contact, loads that aim at its size, and the comparison of the
// elliptic pressure.

#ifndef npt_dealii_verification_contact_cases_hertz_bodies_h
#define npt_dealii_verification_contact_cases_hertz_bodies_h

#include <npt_dealii/iga/nurbs_patch.h>
#include <npt_dealii/verification/contact/contact_benchmark_parameters.h>
#include <npt_dealii/verification/contact/contact_comparisons.h>
#include <npt_dealii/verification/contact/contact_results.h>
#include <npt_dealii/verification/contact/exact_contact.h>

#include <vector>

namespace NPT
{
  /// Knots of a body in x, from its symmetry plane outward, and in depth.
  struct HertzMesh
  {
    double              width; ///< [mm]
    std::vector<double> lateral, depth;

    HertzMesh(const ContactCaseParameters       &p,
              const ContactCaseParameters::Body &body,
              const double                       half_width);
  };

  /// E* of both bodies [MPa].
  double
  contact_modulus(const ContactCaseParameters &p);

  /// E* of the upper body on a rigid one [MPa].
  double
  contact_modulus_on_rigid(const ContactCaseParameters &p);

  /// Load [N/mm] of two cylinders that gives the half width of the parameters.
  double
  aimed_load_line(const ContactCaseParameters &p);

  /// Load [N] of a sphere on a rigid plane that gives the half width of the
  /// parameters.
  double
  aimed_load_sphere(const ContactCaseParameters &p);

  /// A quarter of the lower cap of the upper sphere.
  NURBSPatch<3>
  sphere_segment(const ContactCaseParameters &p);

  /// One span is enough: where the cells of a rigid plane end does not matter.
  NURBSPatch<3>
  rigid_plane(const double half_size, const unsigned int degree);

  /// Throws InputError if the body would end beyond 0.9 of its radius.
  void
  check_body_size(const ContactCaseParameters       &p,
                  const ContactCaseParameters::Body &body,
                  const std::string                 &subsection);

  /// What compare_point_contact() names.
  std::vector<ComparedQuantity>
  point_contact_quantities();

  /**
   * Compare peak, half axes and profile of the pressure with Hertz' ellipse.
   *
   * @param hertz The exact solution under the computed load.
   */
  void
  compare_point_contact(const HertzPoint     &hertz,
                        const ContactResults &results,
                        ContactComparisons   &comparisons);

  /// Torque [N mm] from the forces on the handles 0 and 1, cos - 1 and sin of
  /// a rotation.
  double
  torque(const ContactRow &row);
} // namespace NPT

#endif
