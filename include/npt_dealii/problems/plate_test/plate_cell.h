// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines a fabric cell with its discretization: what stays the same during a
// plate test.

#ifndef npt_dealii_problems_plate_test_plate_cell_h
#define npt_dealii_problems_plate_test_plate_cell_h

#include <npt_dealii/fabric/fabric_cell.h>
#include <npt_dealii/homogenization/fabric_couplings.h>
#include <npt_dealii/homogenization/macro_unknowns.h>
#include <npt_dealii/homogenization/resultants.h>
#include <npt_dealii/load_step/equilibrium_problem.h>
#include <npt_dealii/problems/plate_test/cell_contacts.h>
#include <npt_dealii/problems/plate_test/plate_test_parameters.h>
#include <npt_dealii/solid/deformable_bodies.h>

#include <deal.II/base/point.h>
#include <deal.II/lac/vector.h>

#include <memory>
#include <optional>
#include <vector>

namespace NPT
{
  /**
   * A fabric cell, its bundles as deformable bodies, the pairs of surfaces that
   * may touch, and the numbering of all unknowns u = (w of all control points,
   * H1..H6, weaving offset, w of periodic images). Constant after construction.
   */
  class PlateCell
  {
  public:
    /// Weave pattern -> fiber bundles -> NURBS patches -> knot spans, contact
    /// pairs and their periodic images.
    /// @param ranks The processes that share the cells of the bundles.
    explicit PlateCell(const PlateTestParameters &parameters,
                       const Ranks               &ranks = {});

    const FabricCell &
    fabric() const
    {
      return fabric_;
    }
    const DeformableBodies &
    bodies() const
    {
      return bodies_;
    }
    const MacroUnknowns &
    macro() const
    {
      return macro_;
    }
    /// One for each entry of FabricCell::contacts().
    const ContactPairs &
    contacts() const
    {
      return contacts_.pairs;
    }
    const std::vector<PeriodicImage> &
    images() const
    {
      return contacts_.images;
    }
    unsigned int
    n_contact_nodes() const;

    /// Straight bundles whose contact partners are held one (mean) thickness
    /// apart, so that they just touch.
    State
    initial_state() const;

    /**
     * Positions of the control points in the woven state u [mm], to which
     * bending and torsion refer: without what H has stretched or sheared, and
     * with the mid-plane at their mean height so that they are cell-centered
     * wherever the pin has put the cell.
     */
    std::vector<dealii::Point<3>>
    woven_positions(const dealii::Vector<double> &u) const;

    /// The frames of bending with a direction of curvature.
    std::shared_ptr<const ObjectiveJumps>
    objective_jumps(const dealii::Tensor<1, 2> &direction) const;

    /// N and M as volume averages (7), (8), at the state u. `woven` gives the
    /// lever arms Z3; empty: reference positions. With objective jumps P is
    /// turned back by the rotation of its place, and bends_along the direction
    /// of the curvature.
    Resultants
    averages(const dealii::Vector<double>              &u,
             const std::vector<dealii::Point<3>>       &woven,
             const std::optional<dealii::Tensor<1, 2>> &bends_along = {},
             const NaturalState                        &natural     = {}) const;

  private:
    FabricCell       fabric_;
    DeformableBodies bodies_; // the bundles
    MacroUnknowns    macro_;
    CellContacts     contacts_;
  };
} // namespace NPT

#endif
