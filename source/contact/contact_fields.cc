// SPDX-License-Identifier: LGPL-2.1-or-later
// Fields of contact surfaces for VTU files.

#include <npt_dealii/contact/contact_fields.h>

namespace NPT
{
  using dealii::Vector;

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

    BezierMesh mesh;
    mesh.dim        = 2;
    mesh.point_data = {{"gap", 1, {}},
                       {"contact_pressure", 1, {}},
                       {"friction_traction", 3, {}},
                       {"slip_increment", 1, {}},
                       {"contact_state", 1, {}}};
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
        mesh.append_points(bezier, weights, face);
        mesh.degrees.push_back({{p, p, 1}});
      }
    return mesh;
  }
} // namespace NPT
