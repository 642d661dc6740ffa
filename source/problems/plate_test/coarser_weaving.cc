// SPDX-License-Identifier: LGPL-2.1-or-later
// Weaving on a coarser mesh first.

#include <npt_dealii/iga/interpolate_field.h>
#include <npt_dealii/problems/plate_test/coarser_weaving.h>

#include <algorithm>

namespace NPT
{
  using dealii::Vector;

  namespace
  {
    constexpr unsigned int n_unknowns_that_pay = 10000;
    // Bundles that touch need some elements to bend, and with few contact nodes
    // per crossing several states are in equilibrium: the program goes no
    // further down by itself than to meshes that have the one of the fine mesh.
    constexpr unsigned int fewest_elements = 4, fewest_by_itself = 7;

    unsigned int
    half(const unsigned int n_elements, const unsigned int fewest)
    {
      return std::max((n_elements + 1) / 2, std::min(n_elements, fewest));
    }
  } // namespace



  std::optional<PlateTestParameters>
  coarser_weaving(const PlateTestParameters &parameters, const PlateCell &cell)
  {
    using CoarserWeaving             = MeshParameters::CoarserWeaving;
    const MeshParameters &mesh       = parameters.mesh;
    const LoadStage      &first      = parameters.load_programme.stages.front();
    const auto            stays_fine = [](const MeshParameters &fine) {
      return half(std::min(fine.elements_along, fine.elements_across), 1) >=
             fewest_by_itself;
    };
    const bool is_wanted =
      mesh.coarser_weaving == CoarserWeaving::yes ||
      (mesh.coarser_weaving == CoarserWeaving::automatic && stays_fine(mesh) &&
       cell.macro().n_unknowns() >= n_unknowns_that_pay);
    if (!is_wanted || first.type != LoadStage::Type::weave || first.friction ||
        mesh.basis == Basis::Lagrange)
      return {};

    PlateTestParameters coarser = parameters;
    coarser.load_programme.stages.resize(1);
    coarser.mesh.elements_along   = half(mesh.elements_along, fewest_elements);
    coarser.mesh.elements_across  = half(mesh.elements_across, fewest_elements);
    coarser.mesh.elements_through = half(mesh.elements_through, 1);
    if (coarser.mesh.elements_along == mesh.elements_along &&
        coarser.mesh.elements_across == mesh.elements_across)
      return {};
    coarser.mesh.coarser_weaving =
      stays_fine(coarser.mesh) ? CoarserWeaving::yes : CoarserWeaving::no;
    return coarser;
  }



  State
  carry_over(const PlateCell &coarse, const State &woven, const PlateCell &fine)
  {
    State       state = fine.initial_state();
    const auto &pairs = fine.contacts();
    for (unsigned int k = 0; k < pairs.size(); ++k)
      {
        const ContactStep<3> step =
          pairs[k]->begin_step(state.contact[k], state.u);
        ContactEvaluation<3> evaluation;
        pairs[k]->evaluate(step, state.u, evaluation);
        state.contact[k] = pairs[k]->accept(step, evaluation);
      }

    const Vector<double> w = interpolate_field(coarse.bodies().space(),
                                               woven.u,
                                               fine.bodies().space());
    std::copy(w.begin(), w.end(), state.u.begin());
    for (unsigned int k = 0; k < MacroUnknowns::n_macro; ++k)
      state.u[fine.macro().first + k] = woven.u[coarse.macro().first + k];
    ConstrainedSystem system;
    system.reinit(make_couplings(fine.fabric(),
                                 fine.bodies().space(),
                                 fine.macro(),
                                 fine.images()),
                  fine.macro().n_unknowns());
    Vector<double> independent;
    system.restrict_to_independent(state.u, independent);
    system.expand(independent, state.u);

    state.applied   = woven.applied;
    state.reactions = woven.reactions;
    state.energies  = woven.energies;
    return state;
  }
} // namespace NPT
