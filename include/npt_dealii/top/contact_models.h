// SPDX-License-Identifier: LGPL-2.1-or-later
// Owns the set-up of the contact benchmarks: bodies as exact NURBS patches,
// what holds and moves them, and the stages of loading.

#ifndef npt_dealii_top_contact_models_h
#define npt_dealii_top_contact_models_h

#include <npt_dealii/iga/iga_space.h>
#include <npt_dealii/top/contact_benchmark_parameters.h>

#include <deal.II/lac/affine_constraints.h>

#include <functional>
#include <string>
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



  /// What a handle does in a stage: its value, or the force on it (on the whole
  /// body, see ContactModel::force_factor), from t = 0, where it is what it was
  /// before, to the end of the stage at t = 1.
  struct HandleDrive
  {
    unsigned int handle;
    bool         force; ///< else value
    std::function<double(const double start, const double t)> value;
  };

  struct ContactStage
  {
    std::string              name;
    bool                     friction = false;
    unsigned int             n_steps  = 1;
    std::vector<HandleDrive> drives; ///< handles not named stay as they are
  };

  /**
   * A contact problem: two bodies of one patch each, patch 0 the upper one with
   * the secondary surface, patch 1 the lower one with the primary surface.
   *
   * Bodies are patches over x, y (or angle and y) with the third direction
   * upward; they touch at z = 0, which is the lower side of the upper body and
   * the upper side of the lower one.
   */
  struct ContactModel
  {
    std::vector<NURBSPatch<3>>             patches;
    std::vector<std::string>               handles;
    std::function<void(HandleCouplings &)> couple;
    std::vector<ContactStage>              stages;
    /// Forces on the whole body over those on the part that is modeled: 2 or 4
    /// by symmetry, and 1/width for forces per length in plane strain.
    double force_factor = 1;
    /// Deeper closest points belong to the far side [mm].
    double body_height = 1;
  };

  /// Throws InputError if the case cannot be built from the parameters.
  ContactModel
  make_contact_model(const ContactBenchmarkParameters &parameters);
} // namespace NPT

#endif
