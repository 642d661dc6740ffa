// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the relations by which handles hold and move the bodies of contact
// benchmarks.

#ifndef npt_dealii_verification_contact_handle_couplings_h
#define npt_dealii_verification_contact_handle_couplings_h

#include <npt_dealii/iga/iga_space.h>

#include <deal.II/lac/affine_constraints.h>

#include <utility>
#include <vector>

namespace NPT
{
  /**
   * Collects linear relations between the displacements of control points and
   * a few further unknowns, the handles, by which bodies are held and moved.
   * The first relation of an unknown counts; later ones are ignored, so that
   * edges belong to the condition that is named first.
   */
  class HandleCouplings
  {
  public:
    explicit HandleCouplings(const IGASpace<3> &space);

    using Terms = std::vector<std::pair<unsigned int, double>>;

    const IGASpace<3> &
    space() const
    {
      return space_;
    }
    /// Unknown of a handle.
    unsigned int
    handle(const unsigned int k) const
    {
      return 3 * space_.n_control_points() + k;
    }
    /// Unknown of a displacement component.
    static unsigned int
    displacement(const unsigned int control_point, const unsigned int component)
    {
      return 3 * control_point + component;
    }
    /// unknown = sum of coefficient * other unknown; no terms: zero.
    void
    tie(const unsigned int unknown, const Terms &terms = {});

    /// Control points of a face of a patch.
    std::vector<unsigned int>
    face(const unsigned int patch,
         const unsigned int direction,
         const unsigned int side) const;
    /// Control points of a patch.
    std::vector<unsigned int>
    all(const unsigned int patch) const;

    /// Close and return the relations.
    const dealii::AffineConstraints<double> &
    close();

  private:
    const IGASpace<3>                &space_;
    dealii::AffineConstraints<double> constraints_;
  };



  /// No displacement of these components.
  void
  hold(HandleCouplings                 &couplings,
       const std::vector<unsigned int> &points,
       const std::vector<unsigned int> &components);

  /// A displacement component that is the value of a handle.
  void
  attach(HandleCouplings                 &couplings,
         const std::vector<unsigned int> &points,
         const unsigned int               component,
         const unsigned int               handle);

  /// Rotation about the z axis by finite angles, linear in two handles:
  /// cos(angle) - 1 and sin(angle).
  void
  attach_rotation(HandleCouplings                 &couplings,
                  const std::vector<unsigned int> &points,
                  const unsigned int               cosine,
                  const unsigned int               sine);

  /// No displacement along y and none that changes with y.
  void
  plane_strain(HandleCouplings &couplings);
} // namespace NPT

#endif
