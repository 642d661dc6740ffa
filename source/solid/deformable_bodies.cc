// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the set-up and assembly of deformable bodies.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/solid/deformable_bodies.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace NPT
{
  using dealii::Tensor;
  using dealii::Vector;

  DeformableBodies::DeformableBodies(std::vector<DeformablePart> parts,
                                     const Basis                 basis,
                                     const unsigned int          n_gauss_points,
                                     const SymmetryWeight &symmetry_weight,
                                     const Ranks          &ranks)
    : ranks_(ranks)
  {
    std::vector<NURBSPatch<3>> patches;
    std::vector<unsigned int>  bodies;
    for (DeformablePart &part : parts)
      {
        patches.push_back(part.patch);
        bodies.push_back(part.body);
        laws_.push_back(std::move(part.law));
        names_.push_back(part.name);
      }
    space_ = std::make_unique<IGASpace<3>>(patches, bodies, basis);

    gradients_ = std::make_unique<GradientsOfCells>(*space_, n_gauss_points);
    unsigned int n_points = 0;
    for (const auto &span : space_->triangulation().active_cell_iterators())
      {
        const unsigned int        c = span->active_cell_index();
        std::vector<unsigned int> unknowns;
        for (unsigned int i = 0; i < 3; ++i)
          for (const unsigned int A : space_->control_points_of_cell(c))
            unknowns.push_back(3 * A + i);
        cell_unknowns_.push_back(unknowns);
        first_point_.push_back(n_points);
        n_points += (*gradients_)[c].n_points;
        symmetry_weight_.push_back(
          symmetry_weight ? symmetry_weight(span->material_id(), center(c)) :
                            1);
      }
    if (!ranks_.is_alone())
      space_->partition(ranks_.n(), symmetry_weight_);
    look_at_rest();
  }



  dealii::Point<3>
  DeformableBodies::center(const unsigned int cell) const
  {
    const CellGradients &gradients = (*gradients_)[cell];
    dealii::Point<3>     sum;
    double               volume = 0;
    for (unsigned int q = 0; q < gradients.n_points; ++q)
      {
        const double *values = &gradients.values[q * gradients.n_functions];
        for (unsigned int a = 0; a < gradients.n_functions; ++a)
          sum += gradients.jxw[q] * values[a] *
                 space_->control_points()[cell_unknowns_[cell][a] / 3];
        volume += gradients.jxw[q];
      }
    return dealii::Point<3>(sum / volume);
  }



  bool
  DeformableBodies::is_mine(
    const dealii::Triangulation<3>::active_cell_iterator &cell) const
  {
    return symmetry_weight_[cell->active_cell_index()] > 0 &&
           (ranks_.is_alone() || cell->subdomain_id() == ranks_.rank());
  }



  void
  DeformableBodies::look_at_rest()
  {
    double stiffest = 0, volume = 0;
    for (const auto &law : laws_)
      {
        const dealii::FullMatrix<double> C = law->small_strain_stiffness();
        shear_moduli_.push_back(std::min(C(3, 3), std::min(C(4, 4), C(5, 5))));
        stiffest = std::max(stiffest, C.linfty_norm());
      }
    for (unsigned int c = 0; c < gradients_->size(); ++c)
      for (const double jxw : (*gradients_)[c].jxw)
        volume += jxw;
    force_unit_ = stiffest * std::pow(volume, 2. / 3.);
  }



  void
  DeformableBodies::cell_displacement(const unsigned int    cell,
                                      const Vector<double> &u,
                                      std::vector<double>  &w) const
  {
    w.resize(cell_unknowns_[cell].size());
    for (unsigned int a = 0; a < w.size(); ++a)
      w[a] = u[cell_unknowns_[cell][a]];
  }



  DeformableBodies::CellGroups
  DeformableBodies::add_groups(ConstrainedSystem &system) const
  {
    CellGroups groups(gradients_->size(),
                      dealii::numbers::invalid_unsigned_int);
    for (const auto &span : space_->triangulation().active_cell_iterators())
      if (const unsigned int c = span->active_cell_index(); is_mine(span))
        groups[c] = system.add_group(cell_unknowns_[c]);
    return groups;
  }



  void
  DeformableBodies::report_inverted_cell(const unsigned int cell) const
  {
    const unsigned int first = ranks_.min(cell);
    if (first != dealii::numbers::invalid_unsigned_int)
      throw InvertedCell("cell " + std::to_string(first) + " of " +
                         names_[space_->cells()[first].patch]);
  }



  double
  DeformableBodies::add_residual(const Vector<double> &u,
                                 Vector<double>       &residual,
                                 const NaturalState   &natural) const
  {
    SolidKernel         kernel;
    CellGradients       scratch;
    std::vector<double> w, f;
    Vector<double>      forces(residual.size());
    double              square_of_forces = 0;
    unsigned int        inverted = dealii::numbers::invalid_unsigned_int;
    for (const auto &span : space_->triangulation().active_cell_iterators())
      {
        if (!is_mine(span))
          continue;
        const unsigned int c = span->active_cell_index();
        cell_displacement(c, u, w);
        try
          {
            kernel.evaluate(*laws_[span->material_id()],
                            cell_from(natural, c, scratch),
                            w,
                            f,
                            nullptr);
          }
        catch (const InvertedCell &)
          {
            inverted = c;
            break;
          }
        for (unsigned int a = 0; a < f.size(); ++a)
          {
            forces[cell_unknowns_[c][a]] += symmetry_weight_[c] * f[a];
            square_of_forces += symmetry_weight_[c] * f[a] * f[a];
          }
      }
    report_inverted_cell(inverted);
    ranks_.sum(forces);
    residual += forces;
    return std::sqrt(ranks_.sum(square_of_forces));
  }



  void
  DeformableBodies::add_tangent(const Vector<double> &u,
                                const CellGroups     &groups,
                                ConstrainedSystem    &system,
                                const NaturalState   &natural) const
  {
    AssertDimension(groups.size(), gradients_->size());
    SolidKernel         kernel;
    CellGradients       scratch;
    std::vector<double> w, f, K;
    unsigned int        inverted = dealii::numbers::invalid_unsigned_int;
    for (const auto &span : space_->triangulation().active_cell_iterators())
      {
        if (!is_mine(span))
          continue;
        const unsigned int c = span->active_cell_index();
        cell_displacement(c, u, w);
        try
          {
            kernel.evaluate(*laws_[span->material_id()],
                            cell_from(natural, c, scratch),
                            w,
                            f,
                            &K);
          }
        catch (const InvertedCell &)
          {
            inverted = c;
            break;
          }
        system.add(groups[c], K, symmetry_weight_[c]);
      }
    report_inverted_cell(inverted);
  }



  double
  DeformableBodies::stored_energy(const Vector<double> &u,
                                  const NaturalState   &natural) const
  {
    SolidKernel         kernel;
    CellGradients       scratch;
    double              sum = 0;
    std::vector<double> w;
    for (const auto &span : space_->triangulation().active_cell_iterators())
      if (is_mine(span))
        {
          const unsigned int c = span->active_cell_index();
          cell_displacement(c, u, w);
          sum +=
            symmetry_weight_[c] * kernel.energy(*laws_[span->material_id()],
                                                cell_from(natural, c, scratch),
                                                w);
        }
    return ranks_.sum(sum);
  }



  const CellGradients &
  DeformableBodies::cell_from(const NaturalState &natural,
                              const unsigned int  cell,
                              CellGradients      &scratch) const
  {
    const CellGradients &reference = (*gradients_)[cell];
    if (natural.empty())
      return reference;
    to_natural_state(reference, &natural[9 * first_point_[cell]], scratch);
    return scratch;
  }



  NaturalState
  DeformableBodies::relax(const Vector<double> &u,
                          const NaturalState   &natural,
                          const double          fraction) const
  {
    const Tensor<2, 3>  identity = dealii::unit_symmetric_tensor<3>();
    NaturalState        result;
    SolidKernel         kernel;
    CellGradients       scratch;
    std::vector<double> w;
    for (unsigned int c = 0; c < gradients_->size(); ++c)
      {
        cell_displacement(c, u, w);
        const CellGradients &cell = cell_from(natural, c, scratch);
        const double        *raw  = kernel.deformation_gradients(cell, w);
        // Without a fiber any direction serves.
        const Tensor<1, 3> *of_law = laws_[space_->cells()[c].patch]->fiber();
        const Tensor<1, 3>  fiber =
          of_law != nullptr ? *of_law : Tensor<1, 3>({1., 0., 0.});
        for (unsigned int q = 0; q < cell.n_points; ++q, raw += 9)
          {
            Tensor<2, 3> F_e, inverse = identity;
            for (unsigned int e = 0; e < 9; ++e)
              F_e[e / 3][e % 3] = raw[e];
            if (!natural.empty())
              for (unsigned int e = 0; e < 9; ++e)
                inverse[e / 3][e % 3] = cell.at_rest[9 * q + e];
            const Tensor<2, 3> relaxed =
              relaxed_inverse(F_e, inverse, fiber, fraction);
            for (unsigned int e = 0; e < 9; ++e)
              result.push_back(relaxed[e / 3][e % 3]);
          }
      }
    return result;
  }



  void
  DeformableBodies::for_each_gradient(const Vector<double> &u,
                                      const NaturalState   &natural,
                                      const PointVisitor   &visit) const
  {
    SolidKernel         kernel;
    CellGradients       scratch;
    std::vector<double> w;
    for (const auto &span : space_->triangulation().active_cell_iterators())
      {
        if (!is_mine(span))
          continue;
        const unsigned int c = span->active_cell_index();
        cell_displacement(c, u, w);
        const CellGradients &cell = cell_from(natural, c, scratch);
        const double        *F    = kernel.deformation_gradients(cell, w);
        for (unsigned int q = 0; q < cell.n_points; ++q)
          visit(c, q, F + 9 * q);
      }
  }



  void
  DeformableBodies::for_each_point(
    const Vector<double>                             &u,
    const std::function<void(const MaterialPoint &)> &visit,
    const NaturalState                               &natural) const
  {
    for_each_gradient(
      u,
      natural,
      [&](const unsigned int c, const unsigned int q, const double *F) {
        double        P[9];
        MaterialPoint point;
        laws_[space_->cells()[c].patch]->stress(F, P);
        point.cell = c;
        point.q    = q;
        point.dV   = symmetry_weight_[c] * (*gradients_)[c].jxw[q];
        for (unsigned int e = 0; e < 9; ++e)
          {
            point.F[e / 3][e % 3] = F[e];
            point.P[e / 3][e % 3] = P[e];
          }
        if (!natural.empty())
          {
            Tensor<2, 3> inverse; // of F_w
            for (unsigned int e = 0; e < 9; ++e)
              inverse[e / 3][e % 3] = natural[9 * (first_point_[c] + q) + e];
            point.F = point.F * invert(inverse);
            point.P = point.P * transpose(inverse) / determinant(inverse);
          }
        visit(point);
      });
  }



  DeformableBodies::Ellipticity
  DeformableBodies::search_ellipticity(const Vector<double> &u,
                                       const NaturalState   &natural,
                                       const bool            losses_only) const
  {
    Ellipticity  result;
    unsigned int cell = 0, q = 0;
    result.lowest.value = std::numeric_limits<double>::max();
    for_each_gradient(
      u,
      natural,
      [&](const unsigned int c, const unsigned int point, const double *F) {
        const unsigned int patch = space_->cells()[c].patch;
        double             P[9], A[81];
        laws_[patch]->stress_and_tangent(F, P, A);
        if (losses_only && is_surely_elliptic(A, F, shear_moduli_[patch]))
          return;
        const auto lowest = NPT::lowest_acoustic_eigenvalue<3>(A);
        if (lowest.value < result.lowest.value)
          {
            result.lowest = lowest;
            result.patch  = patch;
            cell          = c;
            q             = point;
          }
      });
    const auto           A         = space_->control_points_of_cell(cell);
    const CellGradients &gradients = (*gradients_)[cell];
    for (unsigned int a = 0; a < gradients.n_functions; ++a)
      result.position += gradients.values[q * gradients.n_functions + a] *
                         space_->control_points()[A[a]];
    if (ranks_.is_alone())
      return result;

    std::vector<double> numbers = {result.lowest.value,
                                   static_cast<double>(result.patch)};
    for (unsigned int i = 0; i < 3; ++i)
      for (const double x : {result.lowest.normal[i],
                             result.lowest.polarization[i],
                             result.position[i]})
        numbers.push_back(x);
    numbers             = ranks_.of_lowest(numbers);
    result.lowest.value = numbers[0];
    result.patch        = static_cast<unsigned int>(numbers[1]);
    for (unsigned int i = 0; i < 3; ++i)
      {
        result.lowest.normal[i]       = numbers[2 + 3 * i];
        result.lowest.polarization[i] = numbers[3 + 3 * i];
        result.position[i]            = numbers[4 + 3 * i];
      }
    return result;
  }



  DeformableBodies::Ellipticity
  DeformableBodies::lowest_acoustic_eigenvalue(
    const Vector<double> &u,
    const NaturalState   &natural) const
  {
    return search_ellipticity(u, natural, false);
  }



  std::optional<DeformableBodies::Ellipticity>
  DeformableBodies::loss_of_ellipticity(const Vector<double> &u,
                                        const NaturalState   &natural) const
  {
    const Ellipticity found = search_ellipticity(u, natural, true);
    if (found.lowest.value > 0.)
      return {};
    return found;
  }



  std::string
  DeformableBodies::describe(const Ellipticity &e) const
  {
    std::ostringstream text;
    text.precision(3);
    const auto write = [&text](const auto &v) {
      text << '(' << v[0] << ", " << v[1] << ", " << v[2] << ')';
    };
    text << names_[e.patch] << " at ";
    write(e.position);
    text << " mm, lowest acoustic eigenvalue " << e.lowest.value
         << " MPa for the plane with normal ";
    write(e.lowest.normal);
    text << " and motion along ";
    write(e.lowest.polarization);
    return text.str();
  }



  double
  DeformableBodies::interpolate(const MaterialPoint       &point,
                                const std::vector<double> &coefficients) const
  {
    const CellGradients &cell = (*gradients_)[point.cell];
    double               sum  = 0;
    // The first third of the unknowns, those of component 0, are 3 A.
    for (unsigned int a = 0; a < cell.n_functions; ++a)
      sum += cell.values[point.q * cell.n_functions + a] *
             coefficients[cell_unknowns_[point.cell][a] / 3];
    return sum;
  }



  std::vector<double>
  DeformableBodies::integrals_of_functions(const bool by_symmetry_weight) const
  {
    std::vector<double> integrals(space_->n_control_points(), 0.);
    for (const auto &span : space_->triangulation().active_cell_iterators())
      {
        const unsigned int   c    = span->active_cell_index();
        const CellGradients &cell = (*gradients_)[c];
        const double factor = by_symmetry_weight ? symmetry_weight_[c] : 1.;
        for (unsigned int q = 0; q < cell.n_points; ++q)
          for (unsigned int a = 0; a < cell.n_functions; ++a)
            integrals[cell_unknowns_[c][a] / 3] +=
              factor * cell.values[q * cell.n_functions + a] * cell.jxw[q];
      }
    return integrals;
  }
} // namespace NPT
