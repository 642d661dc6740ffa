// SPDX-License-Identifier: LGPL-2.1-or-later
// The repeat as a mesh of hexahedra.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/problems/plate_exports/cell_mesh.h>

#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace NPT
{
  using dealii::FullMatrix;
  using dealii::Tensor;

  namespace
  {
    using Index = std::array<unsigned int, 3>;

    // Order 11, 22, 33, 23, 31, 12.
    unsigned int
    voigt(const unsigned int i, const unsigned int j)
    {
      return i == j ? i : 6 - i - j;
    }



    // Stiffness with the rows of R as axes.
    FullMatrix<double>
    turned_stiffness(const FullMatrix<double> &C, const Tensor<2, 3> &R)
    {
      static const std::array<std::array<unsigned int, 2>, 6> pairs = {
        {{{0, 0}}, {{1, 1}}, {{2, 2}}, {{1, 2}}, {{2, 0}}, {{0, 1}}}};
      FullMatrix<double> result(6, 6);
      for (unsigned int I = 0; I < 6; ++I)
        for (unsigned int J = 0; J < 6; ++J)
          for (unsigned int ij = 0; ij < 9; ++ij)
            for (unsigned int kl = 0; kl < 9; ++kl)
              result(I, J) += R[pairs[I][0]][ij / 3] * R[pairs[I][1]][ij % 3] *
                              R[pairs[J][0]][kl / 3] * R[pairs[J][1]][kl % 3] *
                              C(voigt(ij / 3, ij % 3), voigt(kl / 3, kl % 3));
      return result;
    }



    // The nodes of one strand in a grid.
    class StrandMesher
    {
    public:
      StrandMesher(const FabricStrand &strand,
                   const unsigned int  degree,
                   const unsigned int  subdivision,
                   HexahedralMesh     &mesh)
        : strand_(strand)
        , degree_(degree)
        , subdivision_(subdivision)
        , mesh_(mesh)
        , first_node_(mesh.nodes.size())
        , body_(mesh.bodies.size())
      {
        for (unsigned int d = 0; d < 3; ++d)
          {
            n_elements_[d] = strand.n_spans(d) * subdivision;
            n_nodes_[d]    = n_elements_[d] * degree + 1;
          }
      }

      void
      add()
      {
        for_each(n_nodes_, [&](const Index &i) {
          FabricStrand::Place place;
          const unsigned int  parts = degree_ * subdivision_;
          for (unsigned int d = 0; d < 3; ++d)
            {
              place.span[d] = std::min(i[d] / parts, strand_.n_spans(d) - 1);
              place.xi[d]   = static_cast<double>(i[d]) / parts - place.span[d];
            }
          mesh_.nodes.push_back(strand_.at(place).x);
        });
        mesh_.bodies.push_back({strand_.name(), 0, {}});
        for_each(n_elements_, [&](const Index &e) { add_element(e); });
      }

      // Nodes of both ends of a direction in the same order.
      void
      add_pairs(const unsigned int            direction,
                HexahedralMesh::PeriodicPair &pair) const
      {
        Index size      = n_nodes_;
        size[direction] = 1;
        for_each(size, [&](const Index &i) {
          Index end      = i;
          end[direction] = n_nodes_[direction] - 1;
          pair.nodes.push_back({{node(i), node(end)}});
        });
      }

    private:
      // The first direction runs fastest.
      static void
      for_each(const Index &size, const std::function<void(const Index &)> &use)
      {
        Index i;
        for (i[2] = 0; i[2] < size[2]; ++i[2])
          for (i[1] = 0; i[1] < size[1]; ++i[1])
            for (i[0] = 0; i[0] < size[0]; ++i[0])
              use(i);
      }

      unsigned int
      node(const Index &i) const
      {
        return first_node_ + i[0] + n_nodes_[0] * (i[1] + n_nodes_[1] * i[2]);
      }

      void
      add_element(const Index &e)
      {
        HexahedralMesh::Element element;
        element.body = body_;
        for_each({{degree_ + 1, degree_ + 1, degree_ + 1}},
                 [&](const Index &a) {
                   Index i;
                   for (unsigned int d = 0; d < 3; ++d)
                     i[d] = e[d] * degree_ + a[d];
                   element.nodes.push_back(node(i));
                 });
        FabricStrand::Place center;
        for (unsigned int d = 0; d < 3; ++d)
          {
            center.span[d] = e[d] / subdivision_;
            center.xi[d]   = (e[d] % subdivision_ + 0.5) / subdivision_;
          }
        const FabricStrand::Sample sample = strand_.at(center);
        element.fiber                     = sample.fiber;
        element.across = cross_product_3d(cross_product_3d(sample.tangent[0],
                                                           sample.tangent[1]),
                                          sample.fiber);
        element.across /= element.across.norm();
        const unsigned int number = mesh_.elements.size();
        mesh_.elements.push_back(element);
        for (unsigned int d = 0; d < 3; ++d)
          for (const unsigned int side : {0u, 1u})
            if (e[d] == side * (n_elements_[d] - 1))
              mesh_.bodies[body_].faces[2 * d + side].push_back(
                {number, d, side});
      }

      const FabricStrand &strand_;
      const unsigned int  degree_, subdivision_;
      HexahedralMesh     &mesh_;
      const unsigned int  first_node_, body_;
      Index               n_elements_, n_nodes_;
    };
  } // namespace



  OrthotropicConstants
  orthotropic_constants(const HyperelasticLaw<3> &law,
                        const Tensor<1, 3>       &along,
                        const Tensor<1, 3>       &through)
  {
    const Tensor<1, 3> across = cross_product_3d(through, along);
    Tensor<2, 3>       R;
    for (unsigned int c = 0; c < 3; ++c)
      {
        R[0][c] = along[c];
        R[1][c] = across[c];
        R[2][c] = through[c];
      }
    const FullMatrix<double> C =
      turned_stiffness(law.small_strain_stiffness(), R);
    FullMatrix<double> S(6, 6);
    S.invert(C);
    OrthotropicConstants result;
    for (unsigned int i = 0; i < 3; ++i)
      result.E[i] = 1. / S(i, i);
    result.nu = {{-S(0, 1) / S(0, 0), -S(0, 2) / S(0, 0), -S(1, 2) / S(1, 1)}};
    result.G  = {{1. / S(5, 5), 1. / S(4, 4), 1. / S(3, 3)}};
    for (const double value : {result.E[0],
                               result.E[1],
                               result.E[2],
                               result.G[0],
                               result.G[1],
                               result.G[2]})
      if (!(value > 0. && std::isfinite(value)))
        throw InputError(
          "The law " + law.name() +
          " has no positive engineering constants at F = 1, which the export "
          "needs (subsection Output, entry Export).");
    return result;
  }



  HexahedralMesh
  make_cell_mesh(const std::vector<FabricStrand> &strands,
                 const unsigned int               degree,
                 const unsigned int               subdivision)
  {
    using Family = FiberBundle::Family;
    Assert(degree == 1 || degree == 2, dealii::ExcNotImplemented());
    Assert(subdivision >= 1, dealii::ExcZero());
    HexahedralMesh               mesh;
    HexahedralMesh::PeriodicPair left_right{"left", "right", 0, {}},
      front_back{"front", "back", 0, {}};
    mesh.degree = degree;
    for (const FabricStrand &strand : strands)
      {
        StrandMesher mesher(strand, degree, subdivision, mesh);
        mesher.add();
        if (strand.family() == Family::weft)
          mesher.add_pairs(0, front_back);
        else
          mesher.add_pairs(0, left_right);
        if (strand.family() == Family::ply)
          {
            front_back.direction = 1;
            mesher.add_pairs(1, front_back);
          }
      }
    mesh.periodic = {left_right, front_back};
    return mesh;
  }



  void
  add_materials(const FabricCell                                       &cell,
                const std::vector<FabricStrand>                        &strands,
                const std::vector<std::unique_ptr<HyperelasticLaw<3>>> &laws,
                HexahedralMesh                                         &mesh)
  {
    AssertDimension(mesh.bodies.size(), strands.size());
    const Tensor<1, 3> through({0., 0., 1.});
    for (unsigned int b = 0; b < strands.size(); ++b)
      {
        const FabricStrand &strand = strands[b];
        const std::string   name =
          strand.family() == FiberBundle::Family::ply  ? strand.name() :
            strand.family() == FiberBundle::Family::warp ? "warp" :
                                                           "weft";
        auto known = std::find_if(mesh.materials.begin(),
                                  mesh.materials.end(),
                                  [&](const HexahedralMesh::Material &m) {
                                    return m.name == name + "_material";
                                  });
        if (known == mesh.materials.end())
          {
            const unsigned int bundle = strand.bundle();
            mesh.materials.push_back(
              {name + "_material",
               orthotropic_constants(*laws[bundle],
                                     cell.bundles()[bundle].direction,
                                     through)});
            known = mesh.materials.end() - 1;
          }
        mesh.bodies[b].material = known - mesh.materials.begin();
      }
  }
} // namespace NPT
