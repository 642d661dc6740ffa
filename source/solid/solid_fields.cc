// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the fields of deformable bodies for VTU files.

#include <npt_dealii/solid/solid_fields.h>

#include <deal.II/base/tensor.h>

#include <algorithm>
#include <cmath>

namespace NPT
{
  using dealii::Tensor;
  using dealii::Vector;

  namespace
  {
    // Weighted sums of states; those without a fiber have no part in the sums
    // of the fiber.
    struct StateSum
    {
      PointState sum    = {};
      double     weight = 0, fiber_weight = 0;

      void
      add(const double factor, const PointState &state)
      {
        weight += factor;
        sum.stress += factor * state.stress;
        sum.von_mises += factor * state.von_mises;
        sum.volume_ratio += factor * state.volume_ratio;
        if (state.stretch == 0.)
          return;
        fiber_weight += factor;
        sum.fiber += factor * state.fiber;
        sum.stretch += factor * state.stretch;
        sum.fiber_shear += factor * state.fiber_shear;
      }

      PointState
      mean() const
      {
        PointState result = sum;
        result.stress /= weight;
        result.von_mises /= weight;
        result.volume_ratio /= weight;
        if (fiber_weight == 0.)
          return result;
        result.fiber /= fiber_weight;
        result.stretch /= fiber_weight;
        result.fiber_shear /= fiber_weight;
        return result;
      }
    };
  } // namespace



  PointState
  point_state(const HyperelasticLaw<3> &law, const Tensor<2, 3> &F)
  {
    Tensor<2, 3> P;
    law.stress(F, P);
    PointState result   = {};
    result.volume_ratio = determinant(F);
    result.stress       = symmetrize(P * transpose(F)) / result.volume_ratio;
    result.von_mises    = std::sqrt(1.5) * deviator(result.stress).norm();
    if (const Tensor<1, 3> *A = law.fiber())
      {
        const Tensor<1, 3> along  = F * *A;
        const Tensor<1, 3> normal = transpose(invert(F)) * *A;
        result.stretch            = along.norm();
        result.fiber              = along / result.stretch;
        // Their product is A.A = 1.
        result.fiber_shear = cross_product_3d(along, normal).norm();
      }
    return result;
  }



  std::vector<PointState>
  states_at_control_points(
    const IGASpace<3>                                      &space,
    const std::vector<std::unique_ptr<HyperelasticLaw<3>>> &laws,
    const GradientsOfCells                                 &gradients,
    const Vector<double>                                   &u,
    const NaturalState                                     &natural)
  {
    std::vector<StateSum> sums(space.n_control_points());
    SolidKernel           kernel;
    CellGradients         scratch;
    std::vector<double>   w;
    const double         *inverse = natural.data();
    for (const auto &span : space.triangulation().active_cell_iterators())
      {
        const unsigned int   c         = span->active_cell_index();
        const CellGradients &reference = gradients[c];
        const auto           A         = space.control_points_of_cell(c);
        if (!natural.empty())
          {
            to_natural_state(reference, inverse, scratch);
            inverse += 9 * reference.n_points;
          }
        const CellGradients &cell = natural.empty() ? reference : scratch;
        w.resize(3 * A.size());
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int a = 0; a < A.size(); ++a)
            w[i * A.size() + a] = u[3 * A[a] + i];
        const double *raw = kernel.deformation_gradients(cell, w);
        for (unsigned int q = 0; q < cell.n_points; ++q, raw += 9)
          {
            Tensor<2, 3> F;
            for (unsigned int k = 0; k < 9; ++k)
              F[k / 3][k % 3] = raw[k];
            const PointState state = point_state(*laws[span->material_id()], F);
            for (unsigned int a = 0; a < A.size(); ++a)
              sums[A[a]].add(cell.values[q * cell.n_functions + a] *
                               cell.jxw[q],
                             state);
          }
      }
    std::vector<PointState> states;
    for (const StateSum &sum : sums)
      states.push_back(sum.mean());
    return states;
  }



  BezierMesh
  make_bundle_fields(
    const IGASpace<3>                                      &space,
    const std::vector<std::unique_ptr<HyperelasticLaw<3>>> &laws,
    const GradientsOfCells                                 &gradients,
    const Vector<double>                                   &u,
    const NaturalState                                     &natural)
  {
    const auto states =
      states_at_control_points(space, laws, gradients, u, natural);
    const bool have_fibers =
      std::any_of(laws.begin(), laws.end(), [](const auto &law) {
        return law->fiber() != nullptr;
      });
    BezierMesh mesh;
    mesh.dim        = 3;
    mesh.point_data = {{"displacement", 3, {}},
                       {"Cauchy_stress", 6, {}},
                       {"von_Mises_stress", 1, {}},
                       {"volume_ratio", 1, {}}};
    if (have_fibers)
      mesh.point_data.insert(mesh.point_data.end(),
                             {{"fiber_direction", 3, {}},
                              {"fiber_stretch", 1, {}},
                              {"fiber_shear", 1, {}}});
    mesh.cell_data.push_back({"bundle", 1, {}});
    for (const auto &span : space.triangulation().active_cell_iterators())
      {
        const unsigned int               c     = span->active_cell_index();
        const unsigned int               patch = span->material_id();
        const unsigned int               p     = space.degree(patch);
        const auto                       A = space.control_points_of_cell(c);
        std::vector<std::vector<double>> coefficients;
        std::vector<unsigned int>        all;
        for (unsigned int a = 0; a < A.size(); ++a)
          {
            all.push_back(a);
            const PointState   &state = states[A[a]];
            const auto         &s     = state.stress;
            std::vector<double> row;
            for (unsigned int i = 0; i < 3; ++i)
              row.push_back(space.control_points()[A[a]][i] + u[3 * A[a] + i]);
            for (unsigned int i = 0; i < 3; ++i)
              row.push_back(u[3 * A[a] + i]);
            row.insert(row.end(),
                       {s[0][0],
                        s[1][1],
                        s[2][2],
                        s[0][1],
                        s[1][2],
                        s[0][2],
                        state.von_mises,
                        state.volume_ratio});
            if (have_fibers)
              row.insert(row.end(),
                         {state.fiber[0],
                          state.fiber[1],
                          state.fiber[2],
                          state.stretch,
                          state.fiber_shear});
            coefficients.push_back(row);
          }
        std::vector<double> weights;
        const auto bezier = space.bezier_coefficients(c, coefficients, weights);
        mesh.append_points(bezier, weights, all);
        mesh.degrees.push_back({{p, p, p}});
        mesh.cell_data[0].values.push_back(space.body(patch));
      }
    return mesh;
  }
} // namespace NPT
