// SPDX-License-Identifier: LGPL-2.1-or-later
// The axis about which a stage bends the plate.

#include <npt_dealii/homogenization/macro_modes.h>
#include <npt_dealii/problems/load_programme/bending_directions.h>

#include <array>
#include <cmath>
#include <optional>

namespace NPT
{
  using dealii::Tensor;

  namespace
  {
    constexpr unsigned int first_curvature = MacroModes::number_of("H4");

    // H4, H5, H6; empty where a resultant decides.
    using Curvature = std::array<std::optional<double>, 3>;

    bool
    is_flat(const Curvature &K)
    {
      for (const auto &component : K)
        if (component != 0.)
          return false;
      return true;
    }

    // What is or may become different from zero, as n (x) n.
    struct Directions
    {
      std::vector<Tensor<1, 2>> all;
      std::string               obstacle;
    };

    void
    add_direction(const Curvature &K, Directions &directions)
    {
      Curvature known = K;
      for (unsigned int c = 0; c < 3; ++c)
        if (!K[c])
          {
            known[c] = 0.;
            if (c == 2)
              directions.obstacle = "n6 is prescribed, so that H6 is free";
            else
              directions.all.push_back(c == 0 ? Tensor<1, 2>({1., 0.}) :
                                                Tensor<1, 2>({0., 1.}));
          }
      if (is_flat(known))
        return;
      const double H4 = *known[0], H5 = *known[1], H6 = *known[2];
      const double size = std::max({std::abs(H4), std::abs(H5), std::abs(H6)});
      if (std::abs(H6 * H6 - 4. * H4 * H5) > 1e-9 * size * size)
        {
          directions.obstacle = "H6^2 is not 4 H4 H5";
          return;
        }
      // k n_1^2, k n_2^2 and 2 k n_1 n_2.
      Tensor<1, 2> n({std::sqrt(std::abs(H4)), std::sqrt(std::abs(H5))});
      if (H6 * (H4 + H5) < 0.)
        n[1] = -n[1];
      directions.all.push_back(n / n.norm());
    }
  } // namespace



  std::string
  set_bending_directions(std::vector<LoadStage> &stages)
  {
    // At the ends of the stages; K is what a stage begins with.
    std::vector<Curvature>                   ends;
    std::vector<std::optional<Tensor<1, 2>>> directions_of;
    for (unsigned int k = 0; k < stages.size(); ++k)
      {
        LoadStage                  &stage  = stages[k];
        const auto                  before = stage_before(stages, k);
        Curvature                   K = before ? ends[*before] : Curvature();
        std::optional<Tensor<1, 2>> direction;
        if (before)
          direction = directions_of[*before];
        else
          K.fill(0.);
        Directions directions;
        add_direction(K, directions);
        for (const auto &target : stage.n_targets)
          if (target.first >= first_curvature)
            K[target.first - first_curvature].reset();
        for (const auto &target : stage.H_targets)
          if (target.first >= first_curvature)
            K[target.first - first_curvature] = target.second;
        add_direction(K, directions);
        for (const Tensor<1, 2> &n : directions.all)
          if (std::abs(cross_product_2d(n) * directions.all.front()) > 1e-9)
            directions.obstacle = "it bends about two axes";
        if (!directions.all.empty())
          direction = directions.all.front();
        if (!stage.is_test() && direction)
          directions.obstacle = "it bends before weaving has ended";
        if (!directions.obstacle.empty())
          {
            for (LoadStage &any : stages)
              any.bends_along.reset();
            return "in stage " + stage.name + " " + directions.obstacle;
          }
        stage.bends_along = direction;
        ends.push_back(K);
        directions_of.push_back(direction);
      }
    return "";
  }
} // namespace NPT
