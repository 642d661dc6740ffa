// SPDX-License-Identifier: LGPL-2.1-or-later
// The stretch of the layer at its mid-plane and its faces.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/message_words.h>
#include <npt_dealii/base/short_number.h>
#include <npt_dealii/problems/load_programme/macro_limits.h>

#include <cmath>

namespace NPT
{
  namespace
  {
    constexpr unsigned int H1 = MacroModes::number_of("H1"),
                           H2 = MacroModes::number_of("H2"),
                           H3 = MacroModes::number_of("H3"),
                           H4 = MacroModes::number_of("H4"),
                           H5 = MacroModes::number_of("H5"),
                           H6 = MacroModes::number_of("H6");

    // "H1 = -1.5 and H4 = 2 1/mm", without those that are zero.
    std::string
    values(const KnownGradients &H, const std::vector<unsigned int> &modes)
    {
      std::vector<std::string> texts;
      for (const unsigned int n : modes)
        if (*H[n] != 0.)
          texts.push_back(std::string(MacroModes::table[n].name) + " = " +
                          MacroModes::with_unit(short_number(*H[n]),
                                                MacroModes::table[n].unit()));
      return joined(texts, " and ");
    }



    // The mid-plane, of which membrane and nothing else is needed.
    std::string
    obstacle_of_mid_plane(const KnownGradients &H)
    {
      for (const unsigned int n : {H1, H2})
        if (H[n] && !(1. + *H[n] > 0.))
          return "with " + values(H, {n}) + " the cell has no length: 1 + " +
                 MacroModes::table[n].name +
                 " is its length along this direction over that at rest, so " +
                 MacroModes::table[n].name + " must be above -1";
      if (!H[H1] || !H[H2] || !H[H3])
        return "";
      const double product = (1. + *H[H1]) * (1. + *H[H2]);
      if (product > 0.25 * *H[H3] * *H[H3])
        return "";
      return "with " + values(H, {H1, H2, H3}) +
             " the sides of the cell lie on one line or beyond it: "
             "(1 + H1)(1 + H2) must be above H3^2/4, so |H3| must be below " +
             short_number(2. * std::sqrt(product));
    }



    // A face of the layer, at the height Z3 = z.
    std::string
    obstacle_of_face(const KnownGradients &H, const double z)
    {
      const auto sum = [&](const unsigned int n,
                           const unsigned int m) -> std::optional<double> {
        if (!H[n] || !H[m])
          return {};
        return *H[n] + z * *H[m];
      };
      const auto        E1 = sum(H1, H4), E2 = sum(H2, H5), G = sum(H3, H6);
      const std::string place =
        " at the height Z3 = " + short_number(z) + " mm, a face of the layer";
      for (const unsigned int n : {H1, H2})
        {
          const unsigned int m = n == H1 ? H4 : H5;
          const auto        &E = n == H1 ? E1 : E2;
          if (E && !(1. + *E > 0.))
            return "with " + values(H, {n, m}) + " the cell has no length" +
                   place + ": 1 + " + MacroModes::table[n].name + " + Z3 " +
                   MacroModes::table[m].name + " must be positive, so |" +
                   MacroModes::table[m].name + "| must be below " +
                   short_number((1. + *H[n]) / std::abs(z)) + " 1/mm";
        }
      if (!E1 || !E2 || !G || (1. + *E1) * (1. + *E2) > 0.25 * *G * *G)
        return "";
      return "with " + values(H, {H1, H2, H3, H4, H5, H6}) +
             " the sides of the cell lie on one line or beyond it" + place +
             ": (1 + H1 + Z3 H4)(1 + H2 + Z3 H5) is " +
             short_number((1. + *E1) * (1. + *E2)) +
             " and must be above (H3 + Z3 H6)^2/4, which is " +
             short_number(0.25 * *G * *G);
    }
  } // namespace



  std::string
  obstacle_of_gradients(const KnownGradients &H, const double half_thickness)
  {
    std::string obstacle = obstacle_of_mid_plane(H);
    for (const double side : {1., -1.})
      if (obstacle.empty())
        obstacle = obstacle_of_face(H, side * half_thickness);
    return obstacle;
  }



  void
  check_targets(const std::vector<LoadStage> &stages,
                const double                  half_thickness)
  {
    std::vector<KnownGradients> ends;
    for (unsigned int k = 0; k < stages.size(); ++k)
      {
        const LoadStage &stage = stages[k];
        KnownGradients   H;
        H.fill(0.); // held until a stage says otherwise
        if (const auto before = stage_before(stages, k))
          H = ends[*before];
        for (const auto &target : stage.n_targets)
          H[target.first].reset();
        if (stage.leads_yarns()) // unless all of them follow
          for (const unsigned int n : {H1, H2, H3})
            H[n].reset();
        for (const auto &target : stage.H_targets)
          H[target.first] = target.second;
        const std::string obstacle = obstacle_of_gradients(H, half_thickness);
        if (!obstacle.empty())
          throw InputError("Targets: " + obstacle + " (subsection Stage " +
                           stage.name + ").");
        ends.push_back(H);
      }
  }
} // namespace NPT
