// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the formulas of the law of dry bundles (A30)-(A32): energy, stress,
// tangent, and the entries in a parameter file.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/parameter_binding.h>
#include <npt_dealii/material/bundle_bending.h>
#include <npt_dealii/material/dry_bundle_law.h>
#include <npt_dealii/material/fiber_kinematics.h>

#include <deal.II/base/exceptions.h>

#include <cmath>
#include <sstream>

namespace NPT
{
  namespace
  {
    // A function of one variable with its first two derivatives.
    struct Curve
    {
      double value, first, second;
    };



    // W_f by e = lambda - 1, Eq. (A31).
    Curve
    fiber_energy(const DryBundleConstants &m, const double e)
    {
      if (e >= 0.)
        return {0.5 * m.E_L * e * e, m.E_L * e, m.E_L};
      const double r       = e / m.eps_b;
      const double w       = std::sqrt(1. + r * r);
      const double buckled = m.c * m.E_L, straight = m.E_L - buckled;
      // eps_b^2 (w - 1) without cancellation
      return {(0.5 * buckled + straight / (w + 1.)) * e * e,
              (buckled + straight / w) * e,
              buckled + straight / (w * w * w)};
    }



    // W_c for j <= 1 by x = sqrt(j), Eq. (A32) and its integral from j to 1.
    Curve
    gutowski_energy(const double K, const double alpha, const double x)
    {
      const double y0   = alpha - 1.;
      const double eta  = 1. - alpha / y0 * (1. - x);
      const double eta3 = eta * eta * eta, eta4 = eta3 * eta;
      const double s = 1. - x;
      return {2. / 3. * K * s * s * (eta + 2.) / eta3,
              -2. * K * s / (x * eta4),
              K / (x * x * x * eta4) +
                4. * K * alpha / y0 * s / (x * x * eta4 * eta)};
    }



    // W_c by j; continued with its tangent near the closest packing.
    Curve
    compaction_energy(const DryBundleConstants &m, const double j)
    {
      const double K = m.K_T();
      if (j >= 1.)
        return {0.5 * K * (j - 1.) * (j - 1.), K * (j - 1.), K};

      const double alpha    = std::sqrt(m.V_a / m.V_0);
      const double eta_last = 0.1;
      const double x_last   = 1. - (1. - eta_last) * (alpha - 1.) / alpha;
      const double x        = std::sqrt(j);
      if (x >= x_last)
        return gutowski_energy(K, alpha, x);

      const Curve  last = gutowski_energy(K, alpha, x_last);
      const double step = j - x_last * x_last;
      return {last.value + (last.first + 0.5 * last.second * step) * step,
              last.first + last.second * step,
              last.second};
    }



    // Psi by the invariants: its value, its first derivatives, and the second
    // ones that are not zero.
    template <int dim>
    struct DryBundleEnergy
    {
      DryBundleEnergy(const DryBundleConstants   &m,
                      const FiberKinematics<dim> &s)
      {
        const double I4 = 1. + s.I4_minus_1, I5 = 1. + s.I5_minus_1;
        const double one_over_I4 = 1. / I4;

        // Fibers, by I4.
        const double lambda  = std::sqrt(I4);
        const Curve  W_f     = fiber_energy(m, s.I4_minus_1 / (1. + lambda));
        const double fiber_4 = 0.5 * W_f.first / lambda;
        const double fiber_44 =
          0.25 * (W_f.second - W_f.first / lambda) * one_over_I4;

        // Area of the section, by q = ln j; change of its shape, by q and
        // T = I_1 - I_5/I_4. A suffix is a derivative by an invariant.
        const double q    = s.log_J - std::log(lambda);
        const double j    = std::exp(q);
        const double q_4  = -0.5 * one_over_I4;
        const double q_44 = 0.5 * one_over_I4 * one_over_I4;
        const Curve  W_c  = compaction_energy(m, j);
        const double T =
          2. + s.I1_minus_3 - (s.I5_minus_1 - s.I4_minus_1) * one_over_I4;
        const double T_4    = I5 * one_over_I4 * one_over_I4;
        const double T_5    = -one_over_I4;
        const double T_45   = one_over_I4 * one_over_I4;
        const double T_44   = -2. * T_4 * one_over_I4;
        const double by_T   = 0.5 * m.G_T() / j;
        const double by_q   = j * W_c.first - by_T * T;
        const double by_qq  = j * (j * W_c.second + W_c.first) + by_T * T;
        const double by_T_q = -by_T;

        // Sliding along the fibers, by I4 and I5.
        const double by_I5    = 0.5 * m.G_L * one_over_I4 * one_over_I4;
        const double by_I4    = -2. * by_I5 * I5 * one_over_I4;
        const double by_I4_I5 = -2. * by_I5 * one_over_I4;
        const double by_I4_I4 = -3. * by_I4 * one_over_I4;

        value = W_f.value + W_c.value + by_T * (T - 2.) +
                m.G_T() * std::expm1(-q) +
                by_I5 * (s.I5_minus_1 - s.I4_minus_1 * (I4 + 1.));
        first = {by_T,
                 by_q,
                 fiber_4 + by_T * T_4 + by_q * q_4 + by_I4,
                 by_T * T_5 + by_I5};
        d_1J  = by_T_q;
        d_14  = by_T_q * q_4;
        d_JJ  = by_qq;
        d_J4  = by_qq * q_4 + by_T_q * T_4;
        d_J5  = by_T_q * T_5;
        d_44  = fiber_44 + by_T * T_44 + 2. * by_T_q * T_4 * q_4 +
               by_qq * q_4 * q_4 + by_q * q_44 + by_I4_I4;
        d_45 = by_T * T_45 + by_T_q * T_5 * q_4 + by_I4_I5;
      }

      double                 value;
      FiberEnergyDerivatives first;
      double                 d_1J, d_14, d_JJ, d_J4, d_J5, d_44, d_45;
    };
  } // namespace



  template <int dim>
  DryBundleLaw<dim>::DryBundleLaw(const DryBundleConstants     &constants,
                                  const dealii::Tensor<1, dim> &fiber_direction)
    : constants_(constants)
    , fiber_direction_(fiber_direction)
  {
    Assert(constants.V_0 < constants.V_a, dealii::ExcInternalError());
    AssertThrow(std::abs(fiber_direction.norm() - 1.) < 1e-8,
                dealii::ExcMessage("The fiber direction has the length " +
                                   std::to_string(fiber_direction.norm()) +
                                   "; it must be a unit vector."));
  }



  template <int dim>
  std::string
  DryBundleLaw<dim>::name() const
  {
    return "dry bundle";
  }



  template <int dim>
  double
  DryBundleLaw<dim>::energy(const double *F) const
  {
    return DryBundleEnergy<dim>(constants_,
                                FiberKinematics<dim>(F, fiber_direction_))
      .value;
  }



  template <int dim>
  void
  DryBundleLaw<dim>::stress(const double *F, double *P) const
  {
    const FiberKinematics<dim> s(F, fiber_direction_);
    const DryBundleEnergy<dim> Psi(constants_, s);
    compute_fiber_stress(F, fiber_direction_, s, Psi.first, P);
  }



  template <int dim>
  void
  DryBundleLaw<dim>::stress_and_tangent(const double *F,
                                        double       *P,
                                        double       *tangent) const
  {
    const dealii::Tensor<1, dim> A = fiber_direction_;
    const FiberKinematics<dim>   s(F, A);
    const DryBundleEnergy<dim>   Psi(constants_, s);
    compute_fiber_stress(F, A, s, Psi.first, P);

    double left[4][dim * dim], right[4][dim * dim];
    for (int i = 0; i < dim; ++i)
      for (int J = 0; J < dim; ++J)
        {
          const int    e  = i * dim + J;
          const double D1 = 2. * F[e];
          const double DJ = s.G[e];
          const double D4 = 2. * s.f[i] * A[J];
          const double D5 = 2. * (s.f[i] * s.h[J] + s.Fh[i] * A[J]);
          left[0][e]      = D1;
          left[1][e]      = DJ;
          left[2][e]      = D4;
          left[3][e]      = D5;
          right[0][e]     = Psi.d_1J * DJ + Psi.d_14 * D4;
          right[1][e] =
            Psi.d_1J * D1 + Psi.d_JJ * DJ + Psi.d_J4 * D4 + Psi.d_J5 * D5;
          right[2][e] =
            Psi.d_14 * D1 + Psi.d_J4 * DJ + Psi.d_44 * D4 + Psi.d_45 * D5;
          right[3][e] = Psi.d_J5 * DJ + Psi.d_45 * D4;
        }
    compute_fiber_tangent<dim, 4>(F, A, s, Psi.first, left, right, tangent);
  }



  template class DryBundleLaw<2>;
  template class DryBundleLaw<3>;



  DryBundleConstants
  DryBundleParameters::constants() const
  {
    DryBundleConstants m;
    m.V_0  = tex > 0. ? NPT::fiber_fraction(tex, fiber_density, bundle_area) :
                        fiber_fraction;
    m.V_a  = fiber_limit;
    m.E_L  = m.V_0 * fiber_modulus;
    m.E_T  = transverse_modulus;
    m.nu_T = transverse_poisson;
    m.G_L =
      bending_ratio > 0. ?
        shear_modulus_for_bending(m.E_L, bending_ratio, bending_slenderness) :
        shear_modulus;
    m.c = compression_ratio;
    if (buckling_strain > 0.)
      m.eps_b = buckling_strain;
    else if (m.c < 1.)
      m.eps_b = 0.5 * m.G_L / ((1. - m.c) * m.E_L);
    return m;
  }



  std::unique_ptr<LawParameters>
  DryBundleParameters::clone() const
  {
    return std::make_unique<DryBundleParameters>(*this);
  }



  void
  DryBundleParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    add_fiber_fraction(prm);
    add_moduli(prm);
    add_buckling(prm);
  }



  void
  DryBundleParameters::add_fiber_fraction(dealii::ParameterHandler &prm)
  {
    add_parameter(prm,
                  "Fiber modulus",
                  fiber_modulus,
                  "Dry bundle: Young's modulus E_f > 0 of the fibers [MPa]. "
                  "The bundle has E_L = V_0 E_f, Eq. (A31).");
    add_parameter(prm,
                  "Fiber fraction",
                  fiber_fraction,
                  "Dry bundle: volume fraction V_0 of the fibers in the "
                  "bundle at rest [-], below Fiber fraction limit. Not used "
                  "if Bundle tex is given.");
    add_parameter(prm,
                  "Fiber fraction limit",
                  fiber_limit,
                  "Dry bundle: fiber fraction V_a < 1 at which the pressure "
                  "on the fibers grows without limit [-], Eq. (A32).");
    add_parameter(prm,
                  "Bundle tex",
                  tex,
                  "Dry bundle: linear density T of a bundle [g/km], from "
                  "which V_0 = T / (1000 density area) follows with the next "
                  "two entries. 0: not given.");
    add_parameter(prm,
                  "Fiber density",
                  fiber_density,
                  "Dry bundle: density of the fibers [g/cm^3], for Bundle "
                  "tex.");
    add_parameter(prm,
                  "Bundle area",
                  bundle_area,
                  "Dry bundle: area of the section of a bundle [mm^2], for "
                  "Bundle tex. Its place is in the cell; the law needs it for "
                  "V_0 only.");
  }



  void
  DryBundleParameters::add_moduli(dealii::ParameterHandler &prm)
  {
    add_parameter(prm,
                  "Transverse modulus",
                  transverse_modulus,
                  "Dry bundle: modulus E_T > 0 across the fibers at rest "
                  "[MPa], Eq. (A32).");
    add_parameter(prm,
                  "Transverse Poisson ratio",
                  transverse_poisson,
                  "Dry bundle: contraction across the fibers per extension "
                  "across, -1 < nu_T < 1 [-]; G_T = E_T / (2 (1 + nu_T)).");
    add_parameter(prm,
                  "Longitudinal shear modulus",
                  shear_modulus,
                  "Dry bundle: elastic modulus G_L > 0 against sliding along "
                  "the fibers [MPa], Eq. (A30). Not used if Bending ratio is "
                  "given.");
    add_parameter(prm,
                  "Bending ratio",
                  bending_ratio,
                  "Dry bundle: bending stiffness of a bundle over that of a "
                  "solid, 0 < r < 1 [-], from which G_L follows by Eq. (A33). "
                  "0: not given.");
    add_parameter(prm,
                  "Bending slenderness",
                  bending_slenderness,
                  "Dry bundle: thickness over half wave of the bundle whose "
                  "Bending ratio is given [-]; the half wave of a cantilever "
                  "under its weight is pi/2 times its length.");
  }



  void
  DryBundleParameters::add_buckling(dealii::ParameterHandler &prm)
  {
    add_parameter(prm,
                  "Compression ratio",
                  compression_ratio,
                  "Dry bundle: modulus of buckled fibers over E_L, "
                  "0 < c <= 1 [-], Eq. (A31). 1: fibers do not buckle.");
    add_parameter(prm,
                  "Buckling strain",
                  buckling_strain,
                  "Dry bundle: compression along the fibers at which they "
                  "buckle, e_b [-], Eq. (A31). 0: at half of the shear "
                  "stiffness, (1 - c) E_L e_b = G_L / 2, so that no kink bands "
                  "arise up to a compression of c E_L |e| = G_L / 2.");
  }



  namespace
  {
    // A number of the file that is not in its range.
    void
    require(const bool         is_good,
            const std::string &entry,
            const double       value,
            const std::string &range,
            const std::string &subsection)
    {
      if (is_good)
        return;
      std::ostringstream text;
      text << entry << " is " << value << "; it must be " << range
           << " (subsection " << subsection << ").";
      throw InputError(text.str());
    }
  } // namespace



  void
  DryBundleParameters::check(const std::string &subsection) const
  {
    const auto check_positive = [&](const std::string &entry,
                                    const double       value) {
      require(value > 0., entry, value, "> 0", subsection);
    };
    check_positive("Fiber modulus", fiber_modulus);
    check_positive("Transverse modulus", transverse_modulus);
    check_positive("Longitudinal shear modulus", shear_modulus);
    check_positive("Fiber density", fiber_density);
    require(transverse_poisson > -1. && transverse_poisson < 1.,
            "Transverse Poisson ratio",
            transverse_poisson,
            "> -1 and < 1, both exclusive",
            subsection);
    require(compression_ratio > 0. && compression_ratio <= 1.,
            "Compression ratio",
            compression_ratio,
            "> 0 and <= 1",
            subsection);
    require(buckling_strain >= 0.,
            "Buckling strain",
            buckling_strain,
            ">= 0",
            subsection);
    require(bending_ratio >= 0. && bending_ratio < 1.,
            "Bending ratio",
            bending_ratio,
            ">= 0 and < 1, that of a solid",
            subsection);
    if (bending_ratio > 0.)
      require(bending_slenderness > 0.,
              "Bending slenderness",
              bending_slenderness,
              "> 0 where Bending ratio is given",
              subsection);
    require(tex >= 0., "Bundle tex", tex, ">= 0", subsection);
    if (tex > 0.)
      require(bundle_area > 0.,
              "Bundle area",
              bundle_area,
              "> 0 where Bundle tex is given",
              subsection);
    require(fiber_limit > 0. && fiber_limit < 1.,
            "Fiber fraction limit",
            fiber_limit,
            "> 0 and < 1, both exclusive",
            subsection);

    std::ostringstream below_limit;
    below_limit << "> 0 and less than Fiber fraction limit, " << fiber_limit;
    if (tex > 0.)
      below_limit << "; enlarge Bundle area or lower Bundle tex";
    const double V_0 = tex > 0. ?
                         NPT::fiber_fraction(tex, fiber_density, bundle_area) :
                         fiber_fraction;
    require(V_0 > 0. && V_0<fiber_limit, tex> 0. ?
              "The fiber fraction of Bundle tex, Fiber density and "
              "Bundle area" :
              "Fiber fraction",
            V_0,
            below_limit.str(),
            subsection);
  }



  std::unique_ptr<HyperelasticLaw<2>>
  DryBundleParameters::make_law(
    const dealii::Tensor<1, 2> &fiber_direction) const
  {
    return std::make_unique<DryBundleLaw<2>>(constants(), fiber_direction);
  }



  std::unique_ptr<HyperelasticLaw<3>>
  DryBundleParameters::make_law(
    const dealii::Tensor<1, 3> &fiber_direction) const
  {
    return std::make_unique<DryBundleLaw<3>>(constants(), fiber_direction);
  }



  namespace
  {
    const Registry<RegisteredLaw>::Registration
      dry_bundle("dry bundle",
                 {"the bundle of dry fibers, Eqs. (A30)-(A33)",
                  []() { return std::make_unique<DryBundleParameters>(); }});
  } // namespace
} // namespace NPT
