// SPDX-License-Identifier: LGPL-2.1-or-later
// Nodes of faces, volume and Jacobians of meshes of hexahedra.

#include <npt_dealii/mesh_files/hexahedral_mesh.h>

#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <limits>

namespace NPT
{
  using dealii::Point;
  using dealii::Tensor;

  std::vector<unsigned int>
  HexahedralMesh::nodes_of_face(const unsigned int direction,
                                const unsigned int side) const
  {
    const unsigned int        n = degree + 1;
    std::vector<unsigned int> result;
    for (unsigned int a = 0; a < n * n * n; ++a)
      {
        const std::array<unsigned int, 3> place = {
          {a % n, a / n % n, a / (n * n)}};
        if (place[direction] == side * degree)
          result.push_back(a);
      }
    return result;
  }



  std::vector<bool>
  HexahedralMesh::used_nodes(const Nodes which) const
  {
    std::vector<bool>  used(nodes.size(), false);
    const unsigned int n = degree + 1;
    for (const Element &element : elements)
      for (unsigned int a = 0; a < element.nodes.size(); ++a)
        {
          const unsigned int n_middle =
            degree == 1 ? 0 : a % n % 2 + a / n % n % 2 + a / (n * n) % 2;
          if (which == Nodes::all || n_middle < 2)
            used[element.nodes[a]] = true;
        }
    return used;
  }



  namespace
  {
    /*
     * Serendipity functions are Lagrange functions with the nodes in faces and
     * inside at the combinations of corners and edges that they stand for.
     */
    void
    move_to_serendipity(std::vector<Point<3>> &x)
    {
      const auto place = [](const std::array<unsigned int, 3> &i) {
        return i[0] + 3 * (i[1] + 3 * i[2]);
      };
      for (unsigned int a = 0; a < 27; ++a)
        {
          const std::array<unsigned int, 3> here = {{a % 3, a / 3 % 3, a / 9}};
          std::vector<unsigned int>         middle;
          for (unsigned int d = 0; d < 3; ++d)
            if (here[d] == 1)
              middle.push_back(d);
          if (middle.size() < 2)
            continue;
          const double on_edge = middle.size() == 2 ? 0.5 : 0.25;
          Tensor<1, 3> sum;
          for (unsigned int b = 0; b < 27; ++b)
            {
              const std::array<unsigned int, 3> there = {
                {b % 3, b / 3 % 3, b / 9}};
              unsigned int n_middle = 0;
              bool         belongs  = true;
              for (unsigned int d = 0; d < 3; ++d)
                {
                  n_middle += there[d] == 1 ? 1 : 0;
                  if (here[d] != 1)
                    belongs = belongs && there[d] == here[d];
                }
              if (belongs && n_middle == 0)
                sum -= 0.25 * x[place(there)];
              else if (belongs && n_middle == 1)
                sum += on_edge * x[place(there)];
            }
          x[a] = Point<3>(sum);
        }
    }



    // Values and derivatives of the one-dimensional functions at points.
    struct LineFunctions
    {
      std::vector<std::vector<double>> value, slope;

      LineFunctions(const unsigned int degree, const std::vector<double> &at)
      {
        const auto polynomials =
          dealii::Polynomials::LagrangeEquidistant::generate_complete_basis(
            degree);
        std::vector<double> values(2);
        for (const double x : at)
          {
            value.emplace_back();
            slope.emplace_back();
            for (const auto &polynomial : polynomials)
              {
                polynomial.value(x, values);
                value.back().push_back(values[0]);
                slope.back().push_back(values[1]);
              }
          }
      }
    };
  } // namespace



  MeshQuality
  quality_of(const HexahedralMesh &mesh, const HexahedralMesh::Nodes which)
  {
    const dealii::QGauss<1> rule(4);
    std::vector<double>     at = {0., 1.}, weights = {0., 0.};
    for (unsigned int q = 0; q < rule.size(); ++q)
      {
        at.push_back(rule.point(q)[0]);
        weights.push_back(rule.weight(q));
      }
    const LineFunctions functions(mesh.degree, at);
    const unsigned int  n = mesh.degree + 1, n_at = at.size();

    MeshQuality result;
    result.smallest_jacobian = std::numeric_limits<double>::max();
    std::vector<Point<3>> x;
    for (const HexahedralMesh::Element &element : mesh.elements)
      {
        x.clear();
        for (const unsigned int node : element.nodes)
          x.push_back(mesh.nodes[node]);
        if (mesh.degree == 2 && which == HexahedralMesh::Nodes::serendipity)
          move_to_serendipity(x);
        double volume = 0, smallest = std::numeric_limits<double>::max();
        for (unsigned int q = 0; q < n_at * n_at * n_at; ++q)
          {
            const std::array<unsigned int, 3> p = {
              {q % n_at, q / n_at % n_at, q / (n_at * n_at)}};
            Tensor<2, 3> J;
            for (unsigned int a = 0; a < x.size(); ++a)
              {
                const std::array<unsigned int, 3> i = {
                  {a % n, a / n % n, a / (n * n)}};
                for (unsigned int d = 0; d < 3; ++d)
                  {
                    double factor = 1.;
                    for (unsigned int e = 0; e < 3; ++e)
                      factor *= e == d ? functions.slope[p[e]][i[e]] :
                                         functions.value[p[e]][i[e]];
                    for (unsigned int c = 0; c < 3; ++c)
                      J[c][d] += factor * x[a][c];
                  }
              }
            const double det = determinant(J);
            volume += weights[p[0]] * weights[p[1]] * weights[p[2]] * det;
            // Of the boundary only corners: faces have no Gauss points.
            const unsigned int n_ends = (p[0] < 2) + (p[1] < 2) + (p[2] < 2);
            if (n_ends == 0 || n_ends == 3)
              smallest = std::min(smallest, det);
          }
        result.volume += volume;
        result.smallest_jacobian =
          std::min(result.smallest_jacobian, smallest / std::abs(volume));
      }
    return result;
  }
} // namespace NPT
