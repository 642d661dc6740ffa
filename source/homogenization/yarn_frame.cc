// SPDX-License-Identifier: LGPL-2.1-or-later
// Stretches of the yarns, their angle, and the forces conjugate to them.

#include <npt_dealii/homogenization/yarn_frame.h>

#include <deal.II/base/tensor.h>

#include <cmath>

namespace NPT
{
  namespace YarnFrames
  {
    namespace
    {
      // F_11, F_22 and F_12 as functions of H.
      struct Components
      {
        Number F11, F22, F12;

        explicit Components(const Membrane &H)
          : F11(Number::variable(0, H[0]))
          , F22(Number::variable(1, H[1]))
          , F12(0.5 * Number::variable(2, H[2]))
        {
          F11.value += 1.;
          F22.value += 1.;
        }
      };

      Number
      arc_sine(const Number &s)
      {
        const double c = std::sqrt(1. - s.value * s.value);
        return compose(s, std::asin(s.value), 1. / c, s.value / (c * c * c));
      }
    } // namespace



    Number
    warp_stretch(const Membrane &H)
    {
      const Components U(H);
      return square_root(U.F11 * U.F11 + U.F12 * U.F12);
    }



    Number
    weft_stretch(const Membrane &H)
    {
      const Components U(H);
      return square_root(U.F12 * U.F12 + U.F22 * U.F22);
    }



    Number
    shear_angle(const Membrane &H)
    {
      const Components U(H);
      return arc_sine((U.F11 + U.F22) * U.F12 *
                      inverse(warp_stretch(H) * weft_stretch(H)));
    }



    Number
    bias_stretch(const Membrane &H)
    {
      const Components U(H);
      const Number     along = U.F11 + U.F12, across = U.F12 + U.F22;
      return square_root(0.5 * (along * along + across * across));
    }



    YarnFrame
    of_gradients(const Membrane &H)
    {
      return {warp_stretch(H).value,
              weft_stretch(H).value,
              shear_angle(H).value};
    }



    Membrane
    gradients(const YarnFrame &frame)
    {
      const double a = frame.warp_stretch, b = frame.weft_stretch;
      const double d = a * b * std::cos(frame.shear_angle);
      const double t = std::sqrt(a * a + b * b + 2. * d);
      return {{(a * a + d) / t - 1.,
               (b * b + d) / t - 1.,
               2. * a * b * std::sin(frame.shear_angle) / t}};
    }



    Membrane
    conjugates(const Membrane &H, const Membrane &n)
    {
      const Number q[] = {warp_stretch(H), weft_stretch(H), shear_angle(H)};
      dealii::Tensor<2, 3> rates;
      for (unsigned int j = 0; j < 3; ++j)
        for (unsigned int k = 0; k < 3; ++k)
          rates[j][k] = q[j].gradient[k];
      const dealii::Tensor<1, 3> f =
        dealii::Tensor<1, 3>({n[0], n[1], n[2]}) * invert(rates);
      return {{f[0], f[1], f[2]}};
    }
  } // namespace YarnFrames
} // namespace NPT
