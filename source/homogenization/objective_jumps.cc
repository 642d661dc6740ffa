// SPDX-License-Identifier: LGPL-2.1-or-later
// Displacements in the frames of a bent plate.

#include <npt_dealii/homogenization/objective_jumps.h>
#include <npt_dealii/homogenization/smooth_closure.h>

#include <map>

namespace NPT
{
  using dealii::Point;
  using dealii::Tensor;
  using dealii::Vector;

  namespace
  {
    Tensor<1, 2>
    plane_of(const Point<3> &Y)
    {
      return Tensor<1, 2>({Y[0], Y[1]});
    }

    Tensor<1, 3>
    entries_of(const Vector<double> &u, const unsigned int first)
    {
      return Tensor<1, 3>({u[first], u[first + 1], u[first + 2]});
    }

    // By control point; those next to a smooth seam have the frame of the seam.
    std::vector<Tensor<1, 2>>
    frames_of(const FabricCell &cell, const IGASpace<3> &space)
    {
      const auto               &X = space.control_points();
      std::vector<Tensor<1, 2>> frames;
      for (const Point<3> &Y : X)
        frames.push_back(plane_of(Y));
      if (cell.parameters().smooth_closure !=
          CellParameters::SmoothClosure::yes)
        return frames;
      for (unsigned int b = 0; b < space.n_patches(); ++b)
        for (unsigned int l = 0; l < space.patch(b).n_control_points(); ++l)
          frames[space.control_point(b, l)] = plane_of(X[space.control_point(
            b,
            nearest_seam(
              space.patch(b), n_closed_directions(cell.bundles()[b]), l))]);
      return frames;
    }
  } // namespace



  Gradients
  gradients_of(const MacroUnknowns &macro, const Vector<double> &u)
  {
    Gradients H;
    for (unsigned int n = 0; n < H.size(); ++n)
      H[n] = u[macro.mode(n)];
    return H;
  }



  ObjectiveJumps::ObjectiveJumps(const FabricCell                 &cell,
                                 const IGASpace<3>                &space,
                                 const MacroUnknowns              &macro,
                                 const std::vector<PeriodicImage> &images,
                                 const Tensor<1, 2>               &direction)
    : macro_(macro)
    , motion_(direction)
  {
    const auto frames = frames_of(cell, space);
    // Points above each other share a frame.
    std::map<std::pair<double, double>, unsigned int> number;
    const auto add = [&](const unsigned int  unknown,
                         const Point<3>     &X,
                         const Tensor<1, 2> &place) {
      const auto [entry, is_new] =
        number.try_emplace({place[0], place[1]}, places_.size());
      if (is_new)
        places_.push_back(place);
      points_.push_back({unknown, entry->second, X});
    };
    for (unsigned int A = 0; A < space.n_control_points(); ++A)
      add(3 * A, space.control_points()[A], frames[A]);
    for (const PeriodicImage &image : images)
      for (unsigned int l = 0; l < image.control_points.size(); ++l)
        {
          const Tensor<1, 2> &p = frames[image.control_points[l]];
          add(image.first_unknown + 3 * l,
              image.reference[l],
              plane_of(image.operation(Point<3>(p[0], p[1], 0.))));
        }
  }



  Tensor<1, 3>
  ObjectiveJumps::reference_in_frame(const FramedPoint &point) const
  {
    const Tensor<1, 2> &p = places_[point.place];
    return point.X - Tensor<1, 3>({p[0], p[1], 0.});
  }



  std::vector<RigidMotion>
  ObjectiveJumps::motions(const Vector<double> &u) const
  {
    const Gradients          H = gradients_of(macro_, u);
    std::vector<RigidMotion> result;
    for (const Tensor<1, 2> &p : places_)
      result.push_back(motion_.at(H, p));
    return result;
  }



  std::vector<CylinderMotion::Derivatives>
  ObjectiveJumps::derivatives(const Vector<double> &u) const
  {
    const Gradients                          H = gradients_of(macro_, u);
    std::vector<CylinderMotion::Derivatives> result;
    result.reserve(places_.size());
    for (const Tensor<1, 2> &p : places_)
      result.push_back(motion_.derivatives_at(H, p));
    return result;
  }



  void
  ObjectiveJumps::apply(const Vector<double> &v, Vector<double> &u) const
  {
    const auto S = motions(v);
    u            = v;
    for (const FramedPoint &point : points_)
      {
        const Tensor<1, 3> x = S[point.place](reference_in_frame(point) +
                                              entries_of(v, point.unknown));
        for (unsigned int i = 0; i < 3; ++i)
          u[point.unknown + i] = x[i] - point.X[i];
      }
  }



  void
  ObjectiveJumps::invert(const Vector<double> &u, Vector<double> &v) const
  {
    const auto S = motions(u);
    v            = u;
    for (const FramedPoint &point : points_)
      {
        const RigidMotion &motion = S[point.place];
        const Tensor<1, 3> z =
          transpose(motion.R) *
            (point.X + entries_of(u, point.unknown) - motion.t) -
          reference_in_frame(point);
        for (unsigned int i = 0; i < 3; ++i)
          v[point.unknown + i] = z[i];
      }
  }



  std::vector<std::vector<unsigned int>>
  ObjectiveJumps::groups() const
  {
    std::vector<std::vector<unsigned int>> result;
    for (const FramedPoint &point : points_)
      {
        std::vector<unsigned int> unknowns;
        for (unsigned int i = 0; i < 3; ++i)
          unknowns.push_back(point.unknown + i);
        for (unsigned int n = 0; n < MacroUnknowns::n_modes; ++n)
          unknowns.push_back(macro_.mode(n));
        result.push_back(unknowns);
      }
    return result;
  }



  std::vector<std::vector<unsigned int>>
  ObjectiveJumps::arguments() const
  {
    std::vector<std::vector<unsigned int>> result(macro_.n_unknowns());
    for (unsigned int k = 0; k < result.size(); ++k)
      result[k] = {k};
    for (const std::vector<unsigned int> &group : groups())
      for (unsigned int i = 0; i < 3; ++i)
        result[group[i]] = group;
    return result;
  }



  void
  ObjectiveJumps::gradients(const Vector<double> &v,
                            std::vector<double>  &values) const
  {
    // In the order of arguments(): rows of one entry, rows of points.
    std::vector<int> point_of(macro_.n_unknowns(), -1);
    for (unsigned int k = 0; k < points_.size(); ++k)
      for (unsigned int i = 0; i < 3; ++i)
        point_of[points_[k].unknown + i] = k;
    const Gradients                               H = gradients_of(macro_, v);
    std::vector<CylinderMotion::FirstDerivatives> S;
    S.reserve(places_.size());
    for (const Tensor<1, 2> &p : places_)
      S.push_back(motion_.first_derivatives_at(H, p));
    values.clear();
    for (unsigned int row = 0; row < point_of.size(); ++row)
      {
        if (point_of[row] < 0)
          {
            values.push_back(1.);
            continue;
          }
        const FramedPoint &point = points_[point_of[row]];
        const unsigned int i     = row - point.unknown;
        const auto        &R     = S[point.place].R[i];
        const Tensor<1, 3> z =
          reference_in_frame(point) + entries_of(v, point.unknown);
        for (unsigned int j = 0; j < 3; ++j)
          values.push_back(R[j].value);
        for (unsigned int n = 0; n < MacroUnknowns::n_modes; ++n)
          {
            double sum = S[point.place].t[i].gradient[n];
            for (unsigned int j = 0; j < 3; ++j)
              sum += R[j].gradient[n] * z[j];
            values.push_back(sum);
          }
      }
  }



  void
  ObjectiveJumps::raise(const double height, Vector<double> &u) const
  {
    Vector<double> v;
    invert(u, v);
    for (const FramedPoint &point : points_)
      v[point.unknown + 2] += height;
    apply(v, u);
  }



  void
  ObjectiveJumps::second_derivatives(
    const Vector<double>                                         &v,
    const Vector<double>                                         &forces,
    const std::function<void(const unsigned int         group,
                             const std::vector<double> &matrix)> &visit) const
  {
    constexpr unsigned int n_H = MacroUnknowns::n_modes, size = 3 + n_H;
    const auto             S = derivatives(v);
    std::vector<double>    matrix;
    for (unsigned int k = 0; k < points_.size(); ++k)
      {
        const FramedPoint &point = points_[k];
        const Tensor<1, 3> f     = entries_of(forces, point.unknown);
        if (f.norm_square() == 0.)
          continue; // most images, and what symmetry leaves out
        const Tensor<1, 3> z =
          reference_in_frame(point) + entries_of(v, point.unknown);
        matrix.assign(size * size, 0.);
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int g = 0; g < n_H; ++g)
            {
              const auto &R = S[point.place].R[i];
              for (unsigned int j = 0; j < 3; ++j)
                {
                  const double mixed = f[i] * R[j].gradient[g];
                  matrix[j * size + 3 + g] += mixed;
                  matrix[(3 + g) * size + j] += mixed;
                }
              for (unsigned int h = 0; h < n_H; ++h)
                {
                  double sum = S[point.place].t[i].hessian[g][h];
                  for (unsigned int j = 0; j < 3; ++j)
                    sum += R[j].hessian[g][h] * z[j];
                  matrix[(3 + g) * size + 3 + h] += f[i] * sum;
                }
            }
        visit(k, matrix);
      }
  }



  Gradients
  ObjectiveJumps::work_with_gradients(const Vector<double> &u,
                                      const Vector<double> &forces) const
  {
    Vector<double>      v;
    std::vector<double> rows;
    invert(u, v);
    gradients(v, rows);
    // Rows of points have v_1..v_3 and H1..H6, all others one entry.
    std::vector<bool> is_of_point(macro_.n_unknowns(), false);
    for (const FramedPoint &point : points_)
      for (unsigned int i = 0; i < 3; ++i)
        is_of_point[point.unknown + i] = true;
    Gradients   work{};
    std::size_t at = 0;
    for (unsigned int k = 0; k < is_of_point.size(); ++k)
      {
        at += is_of_point[k] ? 3 : 1;
        for (unsigned int n = 0; is_of_point[k] && n < work.size(); ++n)
          work[n] += forces[k] * rows[at++];
      }
    return work;
  }



  Tensor<1, 3>
  ObjectiveJumps::sum_in_frames(const Vector<double> &u,
                                const Vector<double> &forces) const
  {
    const auto   S = motions(u);
    Tensor<1, 3> sum;
    for (const FramedPoint &point : points_)
      sum += transpose(S[point.place].R) * entries_of(forces, point.unknown);
    return sum;
  }
} // namespace NPT
