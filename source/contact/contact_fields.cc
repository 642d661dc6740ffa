// SPDX-License-Identifier: LGPL-2.1-or-later
// Fields of contact surfaces for VTU files.

#include <npt_dealii/contact/contact_fields.h>

namespace NPT
{
  using dealii::Vector;

  namespace
  {
    // Gap, pressure, traction vector, slip and state of each node or control
    // point: the data of the mesh below.
    constexpr unsigned int n_values = 7;
    using Values                    = std::vector<std::vector<double>>;



    Values
    values_at_nodes(const ContactPair<3>       &contact,
                    const ContactEvaluation<3> &evaluation)
    {
      const auto &nodes = evaluation.nodes;
      Values      at_node(nodes.size(), std::vector<double>(n_values, 0.));
      for (unsigned int I = 0; I < nodes.size(); ++I)
        {
          auto &value = at_node[I];
          value[0]    = nodes[I].gap;
          value[1]    = -nodes[I].pressure;
          if (!nodes[I].active)
            continue;
          value[6]            = contact.slips(evaluation, I) ? 2. : 1.;
          const auto traction = contact.friction_traction(evaluation, I);
          for (unsigned int i = 0; i < 3; ++i)
            value[2 + i] = traction[i];
          value[5] = contact.slip_increment(evaluation, I).norm();
        }
      return at_node;
    }



    // At the control points of the surface: the same ones for mortar, weighted
    // means of the Gauss points for KTS.
    Values
    values_at_control_points(const ContactPair<3>       &contact,
                             const ContactEvaluation<3> &evaluation)
    {
      const auto  &surface = contact.secondary().surface();
      const Values at_node = values_at_nodes(contact, evaluation);
      if (at_node.size() == surface.n_face_control_points())
        return at_node;
      Values     result(surface.n_face_control_points(),
                    std::vector<double>(n_values, 0.));
      const auto mortar =
        Averaging::mortar<3>(surface, contact.quadrature_points());
      for (unsigned int l = 0; l < result.size(); ++l)
        for (const auto &entry : mortar.nodes()[l].entries)
          for (unsigned int k = 0; k < n_values; ++k)
            result[l][k] += entry.weight * at_node[entry.point][k];
      return result;
    }



    // Bezier points of a cell of degree p on one of its faces; the first
    // coordinate runs fastest.
    std::vector<unsigned int>
    points_of_face(const unsigned int p,
                   const unsigned int direction,
                   const unsigned int side)
    {
      std::vector<unsigned int> face;
      const unsigned int        fixed = side == 0 ? 0 : p;
      for (unsigned int k = 0; k <= (direction == 2 ? 0 : p); ++k)
        for (unsigned int j = 0; j <= (direction == 1 ? 0 : p); ++j)
          for (unsigned int i = 0; i <= (direction == 0 ? 0 : p); ++i)
            {
              std::array<unsigned int, 3> index = {{i, j, k}};
              index[direction]                  = fixed;
              face.push_back(index[0] +
                             (p + 1) * (index[1] + (p + 1) * index[2]));
            }
      return face;
    }
  } // namespace



  BezierMesh
  make_contact_fields(const IGASpace<3>          &space,
                      const unsigned int          patch,
                      const unsigned int          direction,
                      const unsigned int          side,
                      const ContactPair<3>       &contact,
                      const ContactEvaluation<3> &evaluation,
                      const Vector<double>       &u)
  {
    const Values at_control_point =
      values_at_control_points(contact, evaluation);
    const auto      &surface = contact.secondary().surface();
    std::vector<int> lattice_of(space.n_control_points(), -1);
    for (unsigned int l = 0; l < surface.n_face_control_points(); ++l)
      lattice_of[surface.control_point(l)] = l;

    BezierMesh mesh;
    mesh.dim        = 2;
    mesh.point_data = {{"gap", 1, {}},
                       {"contact_pressure", 1, {}},
                       {"friction_traction", 3, {}},
                       {"slip_increment", 1, {}},
                       {"contact_state", 1, {}}};
    const unsigned int n_layers =
      space.patch(patch).knot_vector(direction).n_spans();
    const unsigned int p    = space.degree(patch);
    const auto         face = points_of_face(p, direction, side);
    for (unsigned int c = 0; c < space.cells().size(); ++c)
      {
        const auto &cell = space.cells()[c];
        if (cell.patch != patch ||
            cell.span[direction] != (side == 0 ? 0 : n_layers - 1))
          continue;
        const auto A = space.control_points_of_cell(c);
        Values     coefficients;
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
        mesh.append_points(bezier, weights, face);
        mesh.degrees.push_back({{p, p, 1}});
      }
    return mesh;
  }
} // namespace NPT
