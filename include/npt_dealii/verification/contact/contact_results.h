// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what the cases of contact benchmarks see of a finished stage: its
// load steps and the state at its end.

#ifndef npt_dealii_verification_contact_contact_results_h
#define npt_dealii_verification_contact_contact_results_h

#include <npt_dealii/contact/contact_pair.h>
#include <npt_dealii/solid/deformable_bodies.h>

#include <deal.II/base/point.h>
#include <deal.II/lac/vector.h>

#include <string>
#include <vector>

namespace NPT
{
  /// One accepted load step of a contact benchmark.
  struct ContactRow
  {
    unsigned int        step = 0;
    std::string         stage;
    double              load_factor = 0;
    std::vector<double> value;                   ///< of each handle
    std::vector<double> force;                   ///< on each handle, whole body
    double              dissipation         = 0; ///< cumulative, whole body
    double              largest_penetration = 0; ///< [mm]
    unsigned int        n_active = 0, n_stick = 0, n_slip = 0;
    /// Sum of all contact forces over the sum of their magnitudes [-].
    double force_imbalance = 0;
    /// Sum of the moments of all contact forces over the sum of the magnitudes
    /// of both [-].
    double       moment_imbalance = 0;
    unsigned int iterations       = 0;
  };

  /// State at a Gauss point of the secondary surface.
  struct ContactSample
  {
    dealii::Point<3>     x;            ///< current position [mm]
    double               area     = 0; ///< reference [mm^2]
    double               pressure = 0; ///< [MPa]
    dealii::Tensor<1, 3> traction;     ///< of friction, along the slip [MPa]
  };

  /// Read access to a benchmark; the objects must outlive it.
  class ContactResults
  {
  public:
    ContactResults(const std::vector<ContactRow> &rows,
                   const DeformableBodies        &bodies,
                   const ContactPair<3>          &contact,
                   const ContactEvaluation<3>    &evaluation,
                   const dealii::Vector<double>  &u);

    /// All accepted load steps, those of earlier stages too.
    const std::vector<ContactRow> &
    rows() const
    {
      return rows_;
    }
    /// The last load step.
    const ContactRow &
    row() const
    {
      return rows_.back();
    }

    std::vector<ContactSample>
    samples() const;

    /// Boundary of the sticking zone, |x| or the radius in the plane x, y [mm].
    double
    stick_radius(const bool in_plane) const;

    /// Visit the quadrature points of the bodies.
    void
    for_each_point(
      const std::function<void(const DeformableBodies::MaterialPoint &)> &visit)
      const
    {
      bodies_.for_each_point(u_, visit);
    }

  private:
    const std::vector<ContactRow> &rows_;
    const DeformableBodies        &bodies_;
    const ContactPair<3>          &contact_;
    const ContactEvaluation<3>    &evaluation_;
    const dealii::Vector<double>  &u_;
  };
} // namespace NPT

#endif
