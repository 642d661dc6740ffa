// SPDX-License-Identifier: LGPL-2.1-or-later
// The gaps between plates and bundles, their energy and its derivatives.

#include <npt_dealii/iga/iga_surface.h>
#include <npt_dealii/problems/plate_test/press_plates.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>

namespace NPT
{
  using dealii::Vector;

  PressPlates::PressPlates(const PlateCell   &cell,
                           const double       penalty,
                           const unsigned int n_points)
    : penalty_(penalty)
    , distance_(cell.macro().plate_distance())
    , center_(cell.macro().plate_center())
  {
    const auto        &bundles = cell.fabric().bundles();
    const unsigned int top     = bundles.size() - 1;
    const bool is_stacked      = bundles[0].family == FiberBundle::Family::ply;
    for (unsigned int b = 0; b < bundles.size(); ++b)
      for (const unsigned int side : {0u, 1u})
        {
          // The plies of a laminate are joined, those of the outside are bare;
          // so are the outer faces of the outer layers.
          const bool is_bare =
            is_stacked ?
              b == (side == 0 ? 0 : top) :
              bundles[b].layer == (side == 0 ? 0 : bundles[top].layer);
          if (is_bare)
            add_face(cell, b, side, n_points);
        }
    is_centered_ = !cell.fabric().free_translations()[2];
    if (is_centered_)
      return;
    // Enough for a matrix without zero pivots, and too little to be felt.
    spring_stiffness_ = 1e-11 * penalty_ * cell.fabric().area();
    springs_.push_back({center_});
    for (unsigned int k = 1; k < cell.fabric().n_layers(); ++k)
      springs_.push_back(
        {3 * cell.bodies().space().control_point(cell.fabric().first_bundle(k),
                                                 0) +
         2});
  }



  void
  PressPlates::rest_springs(const Vector<double> &u)
  {
    for (Spring &spring : springs_)
      spring.rest = u[spring.unknown];
  }



  void
  PressPlates::add_face(const PlateCell   &cell,
                        const unsigned int bundle,
                        const unsigned int side,
                        const unsigned int n_points)
  {
    const unsigned int  through = 2;
    const IGASurface<3> surface(cell.bodies().space(), bundle, through, side);
    std::map<std::array<unsigned int, 2>, Patch> patches;
    for (const auto &point : surface.quadrature(n_points))
      {
        const unsigned int weight =
          cell.fabric().symmetry_weight(bundle, point.X);
        if (weight == 0)
          continue;
        Patch &patch = patches[point.span];
        if (patch.unknowns.empty())
          {
            patch.side = side == 1 ? 1. : -1.;
            for (const unsigned int l : point.shape.lattice)
              {
                patch.unknowns.push_back(3 * surface.control_point(l) + 2);
                patch.X3.push_back(surface.reference_position(l)[2]);
              }
            patch.unknowns.push_back(distance_);
            patch.unknowns.push_back(center_);
          }
        AssertDimension(point.shape.value.size(), patch.X3.size());
        patch.areas.push_back(weight * point.area);
        patch.values.insert(patch.values.end(),
                            point.shape.value.begin(),
                            point.shape.value.end());
      }
    for (const auto &[span, patch] : patches)
      patches_.push_back(patch);
  }



  double
  PressPlates::height(const Patch          &patch,
                      const unsigned int    q,
                      const Vector<double> &u) const
  {
    const unsigned int n   = patch.X3.size();
    double             sum = 0;
    for (unsigned int a = 0; a < n; ++a)
      sum += patch.values[q * n + a] * (patch.X3[a] + u[patch.unknowns[a]]);
    return sum;
  }



  double
  PressPlates::gap(const Patch          &patch,
                   const unsigned int    q,
                   const Vector<double> &u) const
  {
    return 0.5 * u[distance_] - patch.side * (height(patch, q, u) - u[center_]);
  }



  double
  PressPlates::gap_gradient(const Patch       &patch,
                            const unsigned int q,
                            const unsigned int k) const
  {
    const unsigned int n = patch.X3.size();
    return k < n  ? -patch.side * patch.values[q * n + k] :
           k == n ? 0.5 :
                    patch.side;
  }



  void
  PressPlates::let_touch(const double overlap, Vector<double> &u) const
  {
    double top    = std::numeric_limits<double>::lowest();
    double bottom = std::numeric_limits<double>::max();
    for (const Patch &patch : patches_)
      for (unsigned int q = 0; q < patch.areas.size(); ++q)
        {
          top    = std::max(top, height(patch, q, u));
          bottom = std::min(bottom, height(patch, q, u));
        }
    if (is_centered_) // one half of the fabric stands for both
      top = std::max(top, -bottom);
    else
      u[center_] = 0.5 * (top + bottom);
    u[distance_] = 2. * (top - u[center_]) - overlap;
  }



  void
  PressPlates::add_groups(ConstrainedSystem &system)
  {
    for (Patch &patch : patches_)
      patch.group = system.add_group(patch.unknowns);
    for (Spring &spring : springs_)
      spring.group = system.add_group({spring.unknown});
  }



  void
  PressPlates::add_residual(const Vector<double> &u,
                            Vector<double>       &residual) const
  {
    for (const Patch &patch : patches_)
      for (unsigned int q = 0; q < patch.areas.size(); ++q)
        {
          const double g = gap(patch, q, u);
          if (g >= 0.)
            continue;
          for (unsigned int k = 0; k < patch.unknowns.size(); ++k)
            residual[patch.unknowns[k]] +=
              patch.areas[q] * penalty_ * g * gap_gradient(patch, q, k);
        }
    for (const Spring &spring : springs_)
      residual[spring.unknown] +=
        spring_stiffness_ * (u[spring.unknown] - spring.rest);
  }



  void
  PressPlates::add_tangent(const Vector<double> &u,
                           ConstrainedSystem    &system) const
  {
    std::vector<double> K;
    for (const Patch &patch : patches_)
      {
        const unsigned int n = patch.unknowns.size();
        K.assign(n * n, 0.);
        bool is_active = false;
        for (unsigned int q = 0; q < patch.areas.size(); ++q)
          {
            if (gap(patch, q, u) >= 0.)
              continue;
            is_active = true;
            for (unsigned int k = 0; k < n; ++k)
              for (unsigned int l = 0; l < n; ++l)
                K[k * n + l] += patch.areas[q] * penalty_ *
                                gap_gradient(patch, q, k) *
                                gap_gradient(patch, q, l);
          }
        if (is_active)
          system.add(patch.group, K);
      }
    for (const Spring &spring : springs_)
      system.add(spring.group, {spring_stiffness_});
  }



  double
  PressPlates::energy(const Vector<double> &u) const
  {
    double sum = 0;
    for (const Spring &spring : springs_)
      {
        const double x = u[spring.unknown] - spring.rest;
        sum += 0.5 * spring_stiffness_ * x * x;
      }
    for (const Patch &patch : patches_)
      for (unsigned int q = 0; q < patch.areas.size(); ++q)
        {
          const double g = std::min(0., gap(patch, q, u));
          sum += 0.5 * penalty_ * patch.areas[q] * g * g;
        }
    return sum;
  }



  double
  PressPlates::force(const Vector<double> &u) const
  {
    double sum = 0;
    for (const Patch &patch : patches_)
      for (unsigned int q = 0; q < patch.areas.size(); ++q)
        sum -= 0.5 * penalty_ * patch.areas[q] * std::min(0., gap(patch, q, u));
    return sum;
  }



  double
  PressPlates::largest_penetration(const Vector<double> &u) const
  {
    double largest = 0;
    for (const Patch &patch : patches_)
      for (unsigned int q = 0; q < patch.areas.size(); ++q)
        largest = std::max(largest, -gap(patch, q, u));
    return largest;
  }
} // namespace NPT
