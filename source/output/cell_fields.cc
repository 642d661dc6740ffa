// SPDX-License-Identifier: LGPL-2.1-or-later
// Fields of bundles and contact surfaces for VTU files.

#include <npt_dealii/material/fiber_bundle_law.h>
#include <npt_dealii/output/cell_fields.h>

#include <deal.II/base/tensor.h>

#include <algorithm>
#include <cmath>

namespace NPT
{
  using dealii::Tensor;
  using dealii::Vector;

  namespace
  {
    // Columns of the control point table from which Bezier fields are made.
    struct Column
    {
      std::string  name;
      unsigned int n_components;
    };

    // Carry coefficients of control points to the Bezier points of a cell and
    // append them to the mesh. The first three numbers are the position.
    void
    append_points(const std::vector<std::vector<double>> &bezier,
                  const std::vector<double>              &weights,
                  const std::vector<Column>              &columns,
                  const std::vector<unsigned int>        &which,
                  BezierMesh                             &mesh)
    {
      for (const unsigned int b : which)
        {
          for (unsigned int i = 0; i < 3; ++i)
            mesh.points.push_back(bezier[b][i]);
          mesh.weights.push_back(weights[b]);
          unsigned int at = 3;
          for (unsigned int f = 0; f < columns.size(); ++f)
            for (unsigned int k = 0; k < columns[f].n_components; ++k)
              mesh.point_data[f].values.push_back(bezier[b][at++]);
        }
    }

    const Tensor<1, 3> *
    fiber_of(const HyperelasticLaw<3> &law)
    {
      const auto *bundle = dynamic_cast<const FiberBundleLaw<3> *>(&law);
      return bundle == nullptr ? nullptr : &bundle->fiber_direction();
    }

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
    if (const Tensor<1, 3> *A = fiber_of(law))
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
    const std::vector<CellGradients>                       &gradients,
    const Vector<double>                                   &u)
  {
    std::vector<StateSum> sums(space.n_control_points());
    std::vector<double>   w;
    for (unsigned int c = 0; c < space.cells().size(); ++c)
      {
        const CellGradients &cell = gradients[c];
        const auto           A    = space.control_points_of_cell(c);
        w.resize(3 * A.size());
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int a = 0; a < A.size(); ++a)
            w[i * A.size() + a] = u[3 * A[a] + i];
        for (unsigned int q = 0; q < cell.n_points; ++q)
          {
            Tensor<2, 3> F;
            double       raw[9];
            SolidKernel::deformation_gradient(cell, w, q, raw);
            for (unsigned int k = 0; k < 9; ++k)
              F[k / 3][k % 3] = raw[k];
            const PointState state =
              point_state(*laws[space.cells()[c].patch], F);
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
    const std::vector<CellGradients>                       &gradients,
    const Vector<double>                                   &u)
  {
    const auto states = states_at_control_points(space, laws, gradients, u);
    const bool have_fibers =
      std::any_of(laws.begin(), laws.end(), [](const auto &law) {
        return fiber_of(*law) != nullptr;
      });
    std::vector<Column> columns = {{"displacement", 3},
                                   {"Cauchy_stress", 6},
                                   {"von_Mises_stress", 1},
                                   {"volume_ratio", 1}};
    if (have_fibers)
      columns.insert(columns.end(),
                     {{"fiber_direction", 3},
                      {"fiber_stretch", 1},
                      {"fiber_shear", 1}});
    BezierMesh mesh;
    mesh.dim = 3;
    for (const Column &column : columns)
      mesh.point_data.push_back({column.name, column.n_components, {}});
    mesh.cell_data.push_back({"bundle", 1, {}});
    for (unsigned int c = 0; c < space.cells().size(); ++c)
      {
        const unsigned int               patch = space.cells()[c].patch;
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
        append_points(bezier, weights, columns, all, mesh);
        mesh.degrees.push_back({{p, p, p}});
        mesh.cell_data[0].values.push_back(space.body(patch));
      }
    return mesh;
  }



  BezierMesh
  make_contact_fields(const IGASpace<3>         &space,
                      const unsigned int         patch,
                      const unsigned int         direction,
                      const unsigned int         side,
                      const ContactAssembler<3> &contact,
                      const Vector<double>      &u)
  {
    // Values at the contact nodes, then at the control points of the surface:
    // the same ones for mortar, weighted means of the Gauss points for KTS.
    constexpr unsigned int           n_values = 7;
    const auto                      &nodes    = contact.nodes();
    std::vector<std::vector<double>> at_node(nodes.size(),
                                             std::vector<double>(n_values, 0.));
    for (unsigned int I = 0; I < nodes.size(); ++I)
      {
        auto &value = at_node[I];
        value[0]    = nodes[I].gap;
        value[1]    = -nodes[I].pressure;
        if (!nodes[I].active)
          continue;
        value[6]            = nodes[I].slipping ? 2. : 1.;
        const auto traction = contact.friction_traction(I);
        for (unsigned int i = 0; i < 3; ++i)
          value[2 + i] = traction[i];
        value[5] = contact.slip_increment(I).norm();
      }

    const auto                      &surface = contact.secondary().surface();
    std::vector<std::vector<double>> at_control_point(
      surface.n_control_points(), std::vector<double>(n_values, 0.));
    if (contact.averaging().nodes().size() == surface.n_control_points())
      at_control_point = at_node;
    else
      {
        const auto mortar =
          Averaging::mortar<3>(surface, contact.quadrature_points());
        for (unsigned int l = 0; l < at_control_point.size(); ++l)
          for (const auto &entry : mortar.nodes()[l].entries)
            for (unsigned int k = 0; k < n_values; ++k)
              at_control_point[l][k] += entry.weight * at_node[entry.point][k];
      }
    std::vector<int> lattice_of(space.n_control_points(), -1);
    for (unsigned int l = 0; l < surface.n_control_points(); ++l)
      lattice_of[surface.control_point(l)] = l;

    const std::vector<Column> columns = {{"gap", 1},
                                         {"contact_pressure", 1},
                                         {"friction_traction", 3},
                                         {"slip_increment", 1},
                                         {"contact_state", 1}};
    BezierMesh                mesh;
    mesh.dim = 2;
    for (const Column &column : columns)
      mesh.point_data.push_back({column.name, column.n_components, {}});
    const unsigned int n_layers =
      space.patch(patch).knot_vector(direction).n_spans();
    for (unsigned int c = 0; c < space.cells().size(); ++c)
      {
        const auto &cell = space.cells()[c];
        if (cell.patch != patch ||
            cell.span[direction] != (side == 0 ? 0 : n_layers - 1))
          continue;
        const unsigned int               p = space.degree(patch);
        const auto                       A = space.control_points_of_cell(c);
        std::vector<std::vector<double>> coefficients;
        for (unsigned int a = 0; a < A.size(); ++a)
          {
            std::vector<double> row;
            for (unsigned int i = 0; i < 3; ++i)
              row.push_back(space.control_points()[A[a]][i] + u[3 * A[a] + i]);
            // Knots are open, so the face depends on its own control points
            // only; the values of the others do not matter.
            const int l = lattice_of[A[a]];
            for (unsigned int k = 0; k < n_values; ++k)
              row.push_back(l < 0 ? 0. : at_control_point[l][k]);
            coefficients.push_back(row);
          }
        std::vector<double> weights;
        const auto bezier = space.bezier_coefficients(c, coefficients, weights);
        std::vector<unsigned int> face;
        const unsigned int        fixed = side == 0 ? 0 : p;
        // The first coordinate runs fastest.
        for (unsigned int k = 0; k <= (direction == 2 ? 0 : p); ++k)
          for (unsigned int j = 0; j <= (direction == 1 ? 0 : p); ++j)
            for (unsigned int i = 0; i <= (direction == 0 ? 0 : p); ++i)
              {
                std::array<unsigned int, 3> index = {{i, j, k}};
                index[direction]                  = fixed;
                face.push_back(index[0] +
                               (p + 1) * (index[1] + (p + 1) * index[2]));
              }
        append_points(bezier, weights, columns, face, mesh);
        mesh.degrees.push_back({{p, p, 1}});
      }
    return mesh;
  }
} // namespace NPT
