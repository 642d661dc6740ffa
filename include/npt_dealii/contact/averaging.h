// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the averaging operator that turns values at Gauss points into values
// at contact nodes: mortar or pointwise.

#ifndef npt_dealii_contact_averaging_h
#define npt_dealii_contact_averaging_h

#include <npt_dealii/contact/geometry/contact_surface.h>

namespace NPT
{
  /**
   * A contact node is where gap, pressure and slip live,
   *
   * @f[ g^I = \sum_q A_{Iq} g_q, \qquad \sum_q A_{Iq} = 1, @f]
   *
   * with the weight (area) W_I [mm^2] of the node in the virtual work (43).
   *
   * Mortar knot-to-surface (37): nodes are the control points of the secondary
   * face, A_{Iq} = R^I_q w_q / <R^I>, W_I = <R^I>, with the integral over
   * the whole secondary surface, so that weights never change during a run.
   * Standard knot-to-surface: nodes are the Gauss points, A = 1, W_q = w_q.
   */
  class Averaging
  {
  public:
    struct Entry
    {
      unsigned int point;
      double       weight; ///< A_{Iq}
    };
    struct Node
    {
      double             area = 0; ///< W_I
      std::vector<Entry> entries;
      /// Lattice position of the control point (mortar) or Gauss point.
      unsigned int label = 0;
    };

    template <int dim>
    static Averaging
    mortar(const IGASurface<dim> &surface,
           const std::vector<typename IGASurface<dim>::QuadraturePoint> &points)
    {
      Averaging          result;
      std::vector<Node> &nodes = result.nodes_;
      nodes.resize(surface.n_face_control_points());
      for (unsigned int q = 0; q < points.size(); ++q)
        for (unsigned int l = 0; l < points[q].averaging.lattice.size(); ++l)
          {
            const double w = points[q].averaging.value[l] * points[q].area;
            Node        &I = nodes[points[q].averaging.lattice[l]];
            I.area += w;
            I.entries.push_back({q, w});
          }
      for (unsigned int i = 0; i < nodes.size(); ++i)
        {
          nodes[i].label = i;
          for (Entry &entry : nodes[i].entries)
            entry.weight /= nodes[i].area;
        }
      return result;
    }

    template <int dim>
    static Averaging
    pointwise(
      const std::vector<typename IGASurface<dim>::QuadraturePoint> &points)
    {
      Averaging result;
      for (unsigned int q = 0; q < points.size(); ++q)
        result.nodes_.push_back({points[q].area, {{q, 1.}}, q});
      return result;
    }

    const std::vector<Node> &
    nodes() const
    {
      return nodes_;
    }

  private:
    std::vector<Node> nodes_;
  };
} // namespace NPT

#endif
