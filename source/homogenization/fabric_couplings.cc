// SPDX-License-Identifier: LGPL-2.1-or-later
// Couplings of a fabric cell.

#include <npt_dealii/homogenization/cell_modes.h>
#include <npt_dealii/homogenization/fabric_couplings.h>
#include <npt_dealii/homogenization/point_finder.h>
#include <npt_dealii/homogenization/smooth_closure.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace NPT
{
  using dealii::AffineConstraints;
  using dealii::Point;

  namespace
  {
    // The couplings in the order in which they are made; see make_couplings().
    class FabricCouplings
    {
    public:
      using Affine = OrbitConstraints::Affine;

      FabricCouplings(const FabricCell            &cell,
                      const IGASpace<3>           &space,
                      const MacroUnknowns         &macro,
                      const std::vector<Point<3>> &places,
                      const ObjectiveJumps        *jumps)
        : cell_(cell)
        , space_(space)
        , macro_(macro)
        , places_(places)
        , jumps_(jumps)
        , modes_(jumps == nullptr ? represented_modes(cell) :
                                    std::vector<unsigned int>())
        , finder_(cell, space)
        , units_(units_of_coefficients(cell))
        , orbits_(macro.first, units_)
      {}

      // Control points that an operation maps onto each other.
      void
      relate_by_operations()
      {
        for (unsigned int b = 0; b < space_.n_patches(); ++b)
          for (unsigned int l = 0; l < space_.patch(b).n_control_points(); ++l)
            for (const SymmetryOperation &g : cell_.operations())
              relate(b, space_.control_point(b, l), g);
      }

      void
      close_smoothly()
      {
        NPT::close_smoothly(
          cell_,
          space_,
          finder_,
          [this](const unsigned int       A,
                 const SymmetryOperation &g,
                 const unsigned int       i) { return jump(A, g, i); },
          orbits_);
      }

      // Vertical forces on the whole cell are in equilibrium, so this pin is
      // free of reactions: w3 = -w3.
      void
      pin_vertically(const unsigned int          b,
                     std::array<unsigned int, 3> at,
                     const bool                  smooth)
      {
        // (A18) has use for the ends of a bundle.
        for (unsigned int d = 0;
             smooth && d < n_closed_directions(cell_.bundles()[b]);
             ++d)
          at[d] = std::min(std::max(at[d], 1u),
                           space_.patch(b).n_control_points(d) - 2);
        const unsigned int A =
          space_.control_point(b, space_.patch(b).index(at));
        orbits_.relate(3 * A + 2,
                       -1.,
                       3 * A + 2,
                       Affine(MacroUnknowns::n_macro, 0.),
                       "vertical pin");
      }

      void
      write(AffineConstraints<double> &constraints) const
      {
        orbits_.write(constraints);
      }

      void
      add_image(const PeriodicImage       &periodic_image,
                AffineConstraints<double> &constraints) const
      {
        const SymmetryOperation &g = periodic_image.operation;
        for (unsigned int l = 0; l < periodic_image.control_points.size(); ++l)
          for (unsigned int i = 0; i < 3; ++i)
            {
              const unsigned int A = periodic_image.control_points[l];
              const unsigned int line =
                periodic_image.first_unknown + 3 * l + i;
              constraints.add_line(line);
              constraints.add_entry(line, 3 * A + i, g.Q[i]);
              const Affine affine = jump(A, g, i);
              for (const unsigned int n : modes_)
                if (std::abs(affine[n]) > 1e-14 * units_[n])
                  constraints.add_entry(line, macro_.mode(n), affine[n]);
              if (i == 2)
                constraints.add_entry(line,
                                      macro_.weaving_offset(),
                                      periodic_image.offset_sign);
            }
      }

      // Pins w = w_m in plane at one place of the first bundle, where a 2-fold
      // axis of the weave goes through it if one does: a mean over the
      // thickness, that is a weighted sum of control points, reduced to free
      // unknowns and solved for its largest term. All forces on the cell
      // together are in equilibrium, so these pins are free of reactions; a pin
      // in every bundle would bear what bundles exert on each other.
      void
      pin_in_plane(const unsigned int                          b,
                   const std::optional<std::array<double, 2>> &in_plane,
                   const std::array<bool, 3>                  &is_free,
                   AffineConstraints<double> &constraints) const
      {
        const std::array<double, 2> place = in_plane.value_or(
          std::array<double, 2>{{cell_.axis_parameter(b), 0.5}});
        const WeightedPoints points = fiber_through_thickness(b, place);
        Point<3>             center =
          space_.patch(b).value(Point<3>(place[0], place[1], 0.5));
        center[2] = 0.;
        for (const auto &[A, weight] : points)
          if (jumps_ == nullptr)
            // The axis keeps the woven height, which enters w_m.
            center[2] += weight * places_[A][2];
          else
            // The frames stretch with the plane; what is left is the distance
            // of the place from theirs.
            for (unsigned int i = 0; i < 2; ++i)
              center[i] -= weight * jumps_->frame(A)[i];
        for (unsigned int c = 0; c < 2; ++c)
          if (is_free[c])
            hold(points, center, c, constraints);
      }

    private:
      // Of the coefficients of the macro unknowns in the couplings.
      static Affine
      units_of_coefficients(const FabricCell &cell)
      {
        Affine units(MacroUnknowns::n_macro, 1.);
        for (unsigned int n = 0; n < MacroUnknowns::n_modes; ++n)
          units[n] = displacement_unit(cell.parameters(), n);
        return units;
      }

      using WeightedPoints = std::vector<std::pair<unsigned int, double>>;

      // w_m(gY) - Q w_m(Y) per unit of each macro unknown.
      Affine
      jump(const unsigned int       A,
           const SymmetryOperation &g,
           const unsigned int       i) const
      {
        Affine affine(MacroUnknowns::n_macro, 0.);
        for (const unsigned int n : modes_)
          affine[n] = macroscopic_jump(n, g, places_[A])[i];
        return affine;
      }

      void
      relate(const unsigned int       b,
             const unsigned int       A,
             const SymmetryOperation &g)
      {
        const FiberBundle::Family family = cell_.bundles()[b].family;
        const Point<3>            image  = g(space_.control_points()[A]);
        const int                 B      = finder_.find(family, image);
        if (B < 0)
          {
            // The image lies in a neighboring cell, or else the mesh lacks the
            // symmetry.
            if (finder_.inside_base_cell(family, image))
              throw std::logic_error(
                "The control points of bundle " + std::to_string(b) +
                " are not mapped onto control points by: " + g.name + ".");
            return;
          }
        for (unsigned int i = 0; i < 3; ++i)
          orbits_.relate(3 * B + i, g.Q[i], 3 * A + i, jump(A, g, i), g.name);
      }

      // Control points and their weights in the mean over the thickness.
      WeightedPoints
      fiber_through_thickness(const unsigned int           b,
                              const std::array<double, 2> &place) const
      {
        const NURBSPatch<3>               &patch = space_.patch(b);
        std::array<unsigned int, 2>        first;
        std::array<std::vector<double>, 2> N;
        for (unsigned int d = 0; d < 2; ++d)
          {
            const KnotVector  &knots = patch.knot_vector(d);
            const unsigned int span  = knots.find_span(place[d]);
            first[d]                 = knots.first_function(span);
            N[d]                     = knots.values(span, place[d], 0)[0];
          }
        WeightedPoints     points;
        const unsigned int n_3 = patch.n_control_points(2);
        for (unsigned int k = 0; k < n_3; ++k)
          for (unsigned int j = 0; j < N[1].size(); ++j)
            for (unsigned int i = 0; i < N[0].size(); ++i)
              points.emplace_back(
                space_.control_point(
                  b, patch.index({{first[0] + i, first[1] + j, k}})),
                N[0][i] * N[1][j] / n_3);
        return points;
      }

      // Make the weighted sum of component c that of the macroscopic field.
      void
      hold(const WeightedPoints      &points,
           const Point<3>            &center,
           const unsigned int         c,
           AffineConstraints<double> &constraints) const
      {
        // sum of factors times unknowns = 0
        std::map<unsigned int, double> sum;
        for (const auto &[A, weight] : points)
          if (constraints.is_constrained(3 * A + c))
            for (const auto &entry :
                 *constraints.get_constraint_entries(3 * A + c))
              sum[entry.first] += weight * entry.second;
          else
            sum[3 * A + c] += weight;
        for (const unsigned int n :
             jumps_ == nullptr ? modes_ : represented_modes(cell_))
          sum[macro_.mode(n)] -= macroscopic_displacement(n, center)[c];
        auto pivot = sum.begin();
        for (auto term = sum.begin(); term != sum.end(); ++term)
          if (term->first < macro_.first &&
              term->second > pivot->second + 1e-12)
            pivot = term;
        constraints.add_line(pivot->first);
        for (const auto &[unknown, factor] : sum)
          if (unknown != pivot->first &&
              std::abs(factor) > 1e-14 * unit_of_coefficient(unknown))
            constraints.add_entry(pivot->first,
                                  unknown,
                                  -factor / pivot->second);
      }

      double
      unit_of_coefficient(const unsigned int unknown) const
      {
        return unknown < macro_.first ? 1. : units_[unknown - macro_.first];
      }

      const FabricCell               &cell_;
      const IGASpace<3>              &space_;
      const MacroUnknowns            &macro_;
      const std::vector<Point<3>>    &places_; // to which jumps refer
      const ObjectiveJumps           *jumps_;
      const std::vector<unsigned int> modes_;
      const BundlePointFinder         finder_;
      const Affine                    units_;
      OrbitConstraints                orbits_;
    };
  } // namespace



  AffineConstraints<double>
  make_couplings(const FabricCell                 &cell,
                 const IGASpace<3>                &space,
                 const MacroUnknowns              &macro,
                 const std::vector<PeriodicImage> &images,
                 const std::vector<Point<3>>      &woven,
                 const Pins                       &pins,
                 const ObjectiveJumps             *jumps,
                 const UsedUnknowns               &used)
  {
    FabricCouplings couplings(cell,
                              space,
                              macro,
                              woven.empty() ? space.control_points() : woven,
                              jumps);
    const bool      smooth =
      cell.parameters().smooth_closure == CellParameters::SmoothClosure::yes;
    couplings.relate_by_operations();
    if (smooth)
      couplings.close_smoothly();
    const std::array<bool, 3> is_free = cell.free_translations();
    for (unsigned int k = 0; k < (used.plates ? 1 : cell.n_layers()); ++k)
      if (pins.used && is_free[2] && jumps == nullptr)
        couplings.pin_vertically(cell.first_bundle(k), pins.vertical, smooth);

    AffineConstraints<double> constraints;
    couplings.write(constraints);
    for (const PeriodicImage &periodic_image : images)
      couplings.add_image(periodic_image, constraints);
    for (unsigned int k = 0; pins.used && k < cell.n_layers(); ++k)
      couplings.pin_in_plane(cell.first_bundle(k),
                             pins.in_plane,
                             is_free,
                             constraints);
    if (jumps == nullptr && !used.support)
      constraints.add_line(macro.support());
    if (!used.plates)
      constraints.add_line(macro.plate_distance());
    if (!used.plates || !is_free[2])
      constraints.add_line(macro.plate_center());
    constraints.close();
    return constraints;
  }
} // namespace NPT
