// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines one tensor-product NURBS body: knot vectors, control points, weights,
// evaluation and refinement.

#ifndef npt_dealii_iga_nurbs_patch_h
#define npt_dealii_iga_nurbs_patch_h

#include <npt_dealii/iga/knot_vector.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <functional>
#include <vector>

namespace NPT
{
  /**
   * A NURBS patch (28)-(29) of dim parametric directions in dim dimensions,
   *
   * @f[ X(\xi) = \sum_A R_A(\xi) P_A, \qquad
   *     R_A = N_A w_A / \sum_B N_B w_B . @f]
   *
   * Control points are numbered lexicographically, the first parametric
   * direction fastest: A = i + n_1 (j + n_2 k). Positions in mm, reference
   * configuration. All refinements leave the geometry unchanged.
   */
  template <int dim>
  class NURBSPatch
  {
  public:
    /**
     * @param control_points One point per function, lexicographic.
     * @param weights Positive; empty means all one (a B-spline patch).
     *
     * Throws InputError if the sizes do not fit or a weight is not positive.
     */
    NURBSPatch(const std::array<KnotVector, dim>     &knot_vectors,
               const std::vector<dealii::Point<dim>> &control_points,
               const std::vector<double>             &weights = {});

    const KnotVector &
    knot_vector(const unsigned int direction) const
    {
      return knot_vectors_[direction];
    }
    const std::array<KnotVector, dim> &
    knot_vectors() const
    {
      return knot_vectors_;
    }
    unsigned int
    n_control_points(const unsigned int direction) const
    {
      return knot_vectors_[direction].n_functions();
    }
    unsigned int
    n_control_points() const
    {
      return control_points_.size();
    }
    unsigned int
    index(const std::array<unsigned int, dim> &i) const;
    std::array<unsigned int, dim>
    multi_index(unsigned int A) const;

    const std::vector<dealii::Point<dim>> &
    control_points() const
    {
      return control_points_;
    }
    const std::vector<double> &
    weights() const
    {
      return weights_;
    }
    bool
    is_rational() const;

    /// Position at parameters u [mm].
    dealii::Point<dim>
    value(const dealii::Point<dim> &u) const;

    /// h-refinement: insert knots in one direction.
    void
    insert_knots(const unsigned int         direction,
                 const std::vector<double> &new_knots);

    /// h-refinement: split every span of a direction into equal parts.
    void
    subdivide(const unsigned int direction, const unsigned int parts);

    /// p-refinement: raise the degree of a direction, continuity unchanged.
    /// Before subdivide() it makes a k-refinement.
    void
    elevate_degree(const unsigned int direction, const unsigned int times);

    /// Raise the multiplicity of every knot to p: the C0 patch ("Model B").
    void
    reduce_to_c0();

    /// Raise all directions to the highest degree present in the patch.
    void
    make_isotropic();

    /// Move every control point (affine maps leave a NURBS a NURBS).
    void
    transform(
      const std::function<dealii::Point<dim>(const dealii::Point<dim> &)> &map);

  private:
    void
    apply(const unsigned int                direction,
          const dealii::FullMatrix<double> &T,
          const KnotVector                 &new_knot_vector);

    std::array<KnotVector, dim>     knot_vectors_;
    std::vector<dealii::Point<dim>> control_points_;
    std::vector<double>             weights_;
  };
} // namespace NPT

#endif
