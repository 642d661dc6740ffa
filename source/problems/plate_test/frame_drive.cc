// SPDX-License-Identifier: LGPL-2.1-or-later
// Loads in the coordinates of the yarns.

#include <npt_dealii/problems/plate_test/frame_drive.h>

#include <deal.II/base/numbers.h>

#include <vector>

namespace NPT
{
  using dealii::Vector;

  namespace
  {
    constexpr unsigned int n_led = 3;

    double
    between(const double from, const double to, const double load_factor)
    {
      return from + load_factor * (to - from);
    }
  } // namespace



  FrameDrive::FrameDrive(const LoadStage     &stage,
                         const MacroUnknowns &macro,
                         const State         &before,
                         const double         area,
                         const double         stiffness)
    : is_bias_(stage.type == LoadStage::Type::bias_extension)
    , by_angle_(!stage.tester_target("bias_stretch"))
    , first_(macro.mode(0))
    , support_(macro.support())
    , area_(area)
    , stiffness_(stiffness)
  {
    if (!stage.leads_yarns())
      return;
    const auto number_or = [&](const char *name, const double otherwise) {
      return stage.tester_target(name).value_or(otherwise);
    };
    const double   degree = dealii::numbers::PI / 180.;
    const Membrane H      = gradients_of(before.u);
    const Membrane n      = {
           {before.reactions[0], before.reactions[1], before.reactions[2]}};
    loads_      = is_bias_ || stage.tester_target("warp_tension");
    prescribes_ = !loads_;

    from_ = to_ = YarnFrames::of_gradients(H);
    if (stage.type == LoadStage::Type::trellis)
      to_ = YarnFrame();
    to_.shear_angle =
      degree * number_or("shear_angle", from_.shear_angle / degree);
    to_.warp_stretch = number_or("warp_stretch", to_.warp_stretch);
    to_.weft_stretch = number_or("weft_stretch", to_.weft_stretch);

    const Membrane f = YarnFrames::conjugates(H, n);
    tension_from_    = {{f[0], f[1], 0.}};
    tension_to_      = {
           {number_or("warp_tension", f[0]), number_or("weft_tension", f[1]), 0.}};
    if (prescribes_)
      return;
    support_at_start_ = f[2] / stiffness_;
    if (!is_bias_)
      return;
    const Number stretch = YarnFrames::bias_stretch(H);
    bias_from_           = stretch.value;
    bias_to_             = number_or("bias_stretch", bias_from_);
    double product = 0, square = 0;
    for (unsigned int k = 0; k < n_led; ++k)
      {
        product += n[k] * stretch.gradient[k];
        square += stretch.gradient[k] * stretch.gradient[k];
      }
    const double p = product / square;
    for (unsigned int k = 0; k < n_led; ++k)
      rest_[k] = n[k] - p * stretch.gradient[k];
    support_at_start_ = p / stiffness_;
  }



  Membrane
  FrameDrive::gradients_of(const Vector<double> &u) const
  {
    return {{u[first_], u[first_ + 1], u[first_ + 2]}};
  }



  std::optional<Membrane>
  FrameDrive::gradients(const double load_factor) const
  {
    if (!prescribes_)
      return {};
    return YarnFrames::gradients(
      {between(from_.warp_stretch, to_.warp_stretch, load_factor),
       between(from_.weft_stretch, to_.weft_stretch, load_factor),
       between(from_.shear_angle, to_.shear_angle, load_factor)});
  }



  FrameDrive::Number
  FrameDrive::loaded(const Membrane &H) const
  {
    return is_bias_ ? YarnFrames::bias_stretch(H) : YarnFrames::shear_angle(H);
  }



  FrameDrive::Number
  FrameDrive::condition(const double load_factor, const Membrane &H) const
  {
    Number result =
      by_angle_ ? YarnFrames::shear_angle(H) : YarnFrames::bias_stretch(H);
    result.value -= by_angle_ ?
                      between(from_.shear_angle, to_.shear_angle, load_factor) :
                      between(bias_from_, bias_to_, load_factor);
    return result;
  }



  FrameDrive::Number
  FrameDrive::potential_of_tensions(const double    load_factor,
                                    const Membrane &H) const
  {
    Number sum;
    if (is_bias_)
      {
        for (unsigned int k = 0; k < n_led; ++k)
          sum = sum + (1. - load_factor) * rest_[k] * Number::variable(k, H[k]);
        return sum;
      }
    return between(tension_from_[0], tension_to_[0], load_factor) *
             YarnFrames::warp_stretch(H) +
           between(tension_from_[1], tension_to_[1], load_factor) *
             YarnFrames::weft_stretch(H);
  }



  Membrane
  FrameDrive::resultants(const double          load_factor,
                         const Vector<double> &u) const
  {
    Membrane n{};
    if (!loads_)
      return n;
    const Membrane H   = gradients_of(u);
    const Number   sum = potential_of_tensions(load_factor, H) +
                       stiffness_ * u[support_] * loaded(H);
    for (unsigned int k = 0; k < n_led; ++k)
      n[k] = sum.gradient[k];
    return n;
  }



  void
  FrameDrive::add_group(ConstrainedSystem &system)
  {
    if (loads_)
      group_ = system.add_group({first_, first_ + 1, first_ + 2, support_});
  }



  void
  FrameDrive::add_residual(const double          load_factor,
                           const Vector<double> &u,
                           Vector<double>       &residual) const
  {
    if (!loads_)
      return;
    const Membrane n = resultants(load_factor, u);
    for (unsigned int k = 0; k < n_led; ++k)
      residual[first_ + k] -= area_ * n[k];
    residual[support_] -=
      area_ * stiffness_ * condition(load_factor, gradients_of(u)).value;
  }



  void
  FrameDrive::add_tangent(const double          load_factor,
                          const Vector<double> &u,
                          ConstrainedSystem    &system) const
  {
    if (!loads_)
      return;
    const Membrane H   = gradients_of(u);
    const Number   led = loaded(H), held = condition(load_factor, H);
    const Number   sum =
      potential_of_tensions(load_factor, H) + stiffness_ * u[support_] * led;
    const unsigned int  size = n_led + 1;
    std::vector<double> K(size * size, 0.);
    for (unsigned int k = 0; k < n_led; ++k)
      {
        for (unsigned int l = 0; l < n_led; ++l)
          K[k * size + l] = -area_ * sum.hessian[k][l];
        K[k * size + n_led] = -area_ * stiffness_ * led.gradient[k];
        K[n_led * size + k] = -area_ * stiffness_ * held.gradient[k];
      }
    system.add(group_, K);
  }
} // namespace NPT
