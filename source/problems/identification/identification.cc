// SPDX-License-Identifier: LGPL-2.1-or-later
// Identification of the fiber bundle law by constrained linear least squares.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/parameter_file.h>
#include <npt_dealii/base/short_number.h>
#include <npt_dealii/material/ellipticity.h>
#include <npt_dealii/problems/identification/constrained_least_squares.h>
#include <npt_dealii/problems/identification/identification.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>

namespace NPT
{
  using dealii::FullMatrix;
  using dealii::Tensor;

  namespace
  {
    constexpr unsigned int n_constants = IdentificationResult::n_constants;

    FiberBundleConstants
    to_struct(const std::vector<double> &t)
    {
      return {t[0], t[1], t[2], t[3], t[4], t[5]};
    }

    Tensor<1, 3>
    fiber_direction()
    {
      Tensor<1, 3> A;
      A[0] = 1.;
      return A;
    }

    // The laws whose only constant is theta_k = 1.
    FiberBundleLaw<3>
    unit_law(const unsigned int k)
    {
      std::vector<double> t(n_constants, 0.);
      t[k] = 1.;
      return FiberBundleLaw<3>(to_struct(t), fiber_direction());
    }

    Tensor<2, 3>
    deformation_gradient(const Tensor<2, 3> &H)
    {
      Tensor<2, 3> F = H;
      for (unsigned int i = 0; i < 3; ++i)
        F[i][i] += 1.;
      return F;
    }



    // The combination of constants that changes the stresses least, as text
    // "b_trn: 1, d_trn: 0.5".
    std::string
    undetermined_combination(const FullMatrix<double> &X)
    {
      const unsigned int               p = X.n();
      dealii::LAPACKFullMatrix<double> XtX(p, p);
      std::vector<double>              scale(p, 0.);
      for (unsigned int j = 0; j < p; ++j)
        {
          for (unsigned int i = 0; i < X.m(); ++i)
            scale[j] += X(i, j) * X(i, j);
          scale[j] = scale[j] > 0. ? std::sqrt(scale[j]) : 1.;
        }
      for (unsigned int j = 0; j < p; ++j)
        for (unsigned int k = 0; k < p; ++k)
          {
            double sum = 0;
            for (unsigned int i = 0; i < X.m(); ++i)
              sum += X(i, j) * X(i, k);
            XtX(j, k) = sum / (scale[j] * scale[k]);
          }
      XtX.compute_svd();
      std::vector<double> direction(p);
      double              largest = 0;
      for (unsigned int k = 0; k < p; ++k)
        {
          direction[k] = XtX.get_svd_vt()(p - 1, k) / scale[k];
          largest      = std::max(largest, std::abs(direction[k]));
        }
      std::string text;
      for (unsigned int k = 0; k < p; ++k)
        if (std::abs(direction[k]) > 1e-3 * largest)
          text += (text.empty() ? "" : ", ") + bundle_constant_names()[k] +
                  ": " + short_number(direction[k] / largest, 3);
      return text;
    }



    // A curve with what the fit takes from it.
    struct FittedCurve
    {
      const MaterialCurve *curve;
      std::array<bool, 9>  fitted;
      double               scale;  // largest fitted stress
      double               factor; // of the residuals
    };



    // Names in the parameters must be among the data.
    void
    check_names(const std::vector<MaterialCurve> &curves,
                const IdentificationParameters   &parameters)
    {
      std::vector<std::string> names;
      for (const MaterialCurve &curve : curves)
        names.push_back(curve.name);
      const auto check_name = [&](const std::string &name,
                                  const std::string &entry) {
        if (std::find(names.begin(), names.end(), name) == names.end())
          throw InputError(entry + " names the curve '" + name +
                           "', which is not among the data" +
                           did_you_mean(name, names) +
                           " (subsection Identification).");
      };
      for (const std::string &name : parameters.curves)
        check_name(name, "Curves");
      for (const auto &weight : parameters.weights)
        check_name(weight.first, "Weights");
    }



    // The components of H that a test drives.
    std::array<bool, 9>
    driven_components(const MaterialCurve &curve)
    {
      std::array<double, 9> amplitude{};
      for (const auto &H : curve.H)
        for (unsigned int e = 0; e < 9; ++e)
          amplitude[e] = std::max(amplitude[e], std::abs(H[e / 3][e % 3]));
      const double most = *std::max_element(amplitude.begin(), amplitude.end());
      std::array<bool, 9> driven;
      for (unsigned int e = 0; e < 9; ++e)
        driven[e] = amplitude[e] > 1e-6 * most;
      return driven;
    }



    std::vector<FittedCurve>
    select_curves(const std::vector<MaterialCurve> &curves,
                  const IdentificationParameters   &parameters)
    {
      check_names(curves, parameters);
      std::vector<FittedCurve> result;
      for (const MaterialCurve &curve : curves)
        {
          if (!parameters.curves.empty() &&
              std::find(parameters.curves.begin(),
                        parameters.curves.end(),
                        curve.name) == parameters.curves.end())
            continue;
          const auto   w      = parameters.weights.find(curve.name);
          const double weight = w == parameters.weights.end() ? 1. : w->second;
          if (weight == 0.)
            continue;

          FittedCurve fitted{&curve, curve.measured, 0., 0.};
          if (parameters.components ==
              IdentificationParameters::Components::driven)
            {
              const std::array<bool, 9> driven = driven_components(curve);
              for (unsigned int e = 0; e < 9; ++e)
                fitted.fitted[e] = fitted.fitted[e] && driven[e];
            }
          for (const auto &P : curve.P)
            for (unsigned int e = 0; e < 9; ++e)
              if (fitted.fitted[e])
                fitted.scale =
                  std::max(fitted.scale, std::abs(P[e / 3][e % 3]));
          if (fitted.scale == 0.)
            fitted.scale = 1.;
          fitted.factor = std::sqrt(weight) /
                          (parameters.relative_to_curve ? fitted.scale : 1.);
          result.push_back(fitted);
        }
      return result;
    }



    std::vector<IdentificationResult::CurveError>
    errors_of(const std::vector<FittedCurve> &curves,
              const FiberBundleConstants     &constants)
    {
      std::vector<IdentificationResult::CurveError> errors;
      for (const FittedCurve &c : curves)
        {
          double       sum = 0, largest = 0;
          unsigned int n = 0;
          for (unsigned int r = 0; r < c.curve->H.size(); ++r)
            {
              if (c.curve->H[r].norm() < 1e-12)
                continue; // as in the fit
              const Tensor<2, 3> difference =
                bundle_stress(constants, c.curve->H[r]) - c.curve->P[r];
              for (unsigned int e = 0; e < 9; ++e)
                if (c.fitted[e])
                  {
                    const double d = difference[e / 3][e % 3] / c.scale;
                    sum += d * d;
                    largest = std::max(largest, std::abs(d));
                    ++n;
                  }
            }
          errors.push_back(
            {c.curve->name, c.scale, n > 0 ? std::sqrt(sum / n) : 0., largest});
        }
      return errors;
    }
  } // namespace



  const std::vector<std::string> &
  bundle_constant_names()
  {
    static const std::vector<std::string> names = {
      "mu_iso", "lambda_iso", "a_trn", "b_trn", "c_trn", "d_trn"};
    return names;
  }



  std::vector<double>
  bundle_constant_values(const FiberBundleConstants &c)
  {
    return {c.mu, c.lambda, c.a, c.b, c.c, c.d};
  }



  Tensor<2, 3>
  bundle_stress(const FiberBundleConstants &constants, const Tensor<2, 3> &H)
  {
    Tensor<2, 3> P;
    FiberBundleLaw<3>(constants, fiber_direction())
      .stress(deformation_gradient(H), P);
    return P;
  }



  namespace
  {
    using UnitLaws = std::vector<FiberBundleLaw<3>>;

    // The fit as a linear problem X theta = y, one row per stress value.
    struct StressData
    {
      FullMatrix<double>  X;
      std::vector<double> y;
    };

    StressData
    collect_stresses(const std::vector<FittedCurve> &curves,
                     const UnitLaws                 &laws)
    {
      // Stresses at H = 0 vanish for any constants: they are no data and would
      // only flatter the variance.
      std::vector<std::vector<double>> rows;
      StressData                       data;
      for (const FittedCurve &c : curves)
        for (unsigned int r = 0; r < c.curve->H.size(); ++r)
          {
            if (c.curve->H[r].norm() < 1e-12)
              continue;
            std::array<Tensor<2, 3>, n_constants> B;
            for (unsigned int k = 0; k < n_constants; ++k)
              laws[k].stress(deformation_gradient(c.curve->H[r]), B[k]);
            for (unsigned int e = 0; e < 9; ++e)
              if (c.fitted[e])
                {
                  std::vector<double> row;
                  for (unsigned int k = 0; k < n_constants; ++k)
                    row.push_back(c.factor * B[k][e / 3][e % 3]);
                  rows.push_back(row);
                  data.y.push_back(c.factor * c.curve->P[r][e / 3][e % 3]);
                }
          }
      if (rows.size() < n_constants)
        throw InputError(
          "The selected curves have " + std::to_string(rows.size()) +
          " stress values, fewer than the six constants of the law; give more "
          "data or select more curves (entry Curves, subsection "
          "Identification).");
      data.X.reinit(rows.size(), n_constants);
      for (unsigned int i = 0; i < rows.size(); ++i)
        for (unsigned int k = 0; k < n_constants; ++k)
          data.X(i, k) = rows[i][k];
      return data;
    }



    // Looks where a law is not stable and cuts such constants off by planes.
    // Half the margin is enough to stop: the cuts ask for all of it, so that
    // the iteration ends.
    class StabilityCuts
    {
    public:
      StabilityCuts(const std::vector<FittedCurve> &curves,
                    const UnitLaws                 &laws,
                    const IdentificationParameters &parameters)
        : curves_(curves)
        , laws_(laws)
        , parameters_(parameters)
        , margin_(parameters.stability_margin)
      {}

      const std::vector<HalfSpace> &
      cuts() const
      {
        return cuts_;
      }

      // At rest: the eigenvectors of the stiffness on symmetric tensors. The
      // plane of strains symmetric about the fiber, and the two shears, one by
      // one: each is an eigenspace.
      void
      check_stiffness(const std::vector<double> &theta,
                      IdentificationResult      &result)
      {
        result.stiffness = to_struct(theta).lowest_stiffness_eigenvalue();
        if (!parameters_.positive_definite ||
            result.stiffness.value >= 0.5 * margin_)
          return;
        UnitTangents A;
        for (unsigned int k = 0; k < n_constants; ++k)
          {
            double F[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, P[9];
            laws_[k].stress_and_tangent(F, P, A[k].data());
          }
        Tensor<2, 3> shear_along, shear_across;
        shear_along[0][1] = shear_along[1][0] = std::sqrt(0.5);
        shear_across[1][2] = shear_across[2][1] = std::sqrt(0.5);
        cut_strain(shear_along, A, theta);
        cut_strain(shear_across, A, theta);
        cut_strain(softest_axisymmetric_strain(A, theta), A, theta);
      }

      // Over the fitted range, the natural state included.
      void
      check_acoustic_tensor(const std::vector<double> &theta,
                            IdentificationResult      &result)
      {
        const FiberBundleLaw<3> law(to_struct(theta), fiber_direction());
        result.acoustic  = 1e300;
        const auto check = [&](const Tensor<2, 3> &F,
                               const std::string  &place) {
          const auto lowest = lowest_acoustic_eigenvalue<3>(law, F);
          if (lowest.value < result.acoustic)
            {
              result.acoustic       = lowest.value;
              result.acoustic_place = place;
            }
          if (parameters_.elliptic && lowest.value < 0.5 * margin_)
            cut_wave(F, lowest.polarization, lowest.normal);
        };
        check(deformation_gradient(Tensor<2, 3>()), "at rest");
        for (const FittedCurve &c : curves_)
          for (unsigned int r = 0; r < c.curve->H.size(); ++r)
            check(deformation_gradient(c.curve->H[r]),
                  "curve " + c.curve->name + ", point " +
                    std::to_string(r + 1));
      }

    private:
      using UnitTangents = std::array<std::array<double, 81>, n_constants>;

      void
      cut_strain(const Tensor<2, 3>        &e,
                 const UnitTangents        &A,
                 const std::vector<double> &theta)
      {
        HalfSpace half_space{std::vector<double>(n_constants, 0.), margin_};
        double    value = 0;
        for (unsigned int k = 0; k < n_constants; ++k)
          {
            for (unsigned int a = 0; a < 9; ++a)
              for (unsigned int b = 0; b < 9; ++b)
                half_space.g[k] +=
                  e[a / 3][a % 3] * A[k][9 * a + b] * e[b / 3][b % 3];
            value += half_space.g[k] * theta[k];
          }
        if (value < 0.5 * margin_)
          cuts_.push_back(half_space);
      }

      static Tensor<2, 3>
      softest_axisymmetric_strain(const UnitTangents        &A,
                                  const std::vector<double> &theta)
      {
        const auto axisymmetric = [](const double angle) {
          Tensor<2, 3> e;
          e[0][0] = std::cos(angle);
          e[1][1] = e[2][2] = std::sqrt(0.5) * std::sin(angle);
          return e;
        };
        double worst_angle = 0, worst = 1e300;
        for (unsigned int n = 0; n < 720; ++n)
          {
            const double       angle = dealii::numbers::PI * n / 720.;
            const Tensor<2, 3> e     = axisymmetric(angle);
            double             value = 0;
            for (unsigned int k = 0; k < n_constants; ++k)
              for (unsigned int a = 0; a < 9; a += 4)
                for (unsigned int b = 0; b < 9; b += 4)
                  value += theta[k] * e[a / 3][a % 3] * A[k][9 * a + b] *
                           e[b / 3][b % 3];
            if (value < worst)
              {
                worst       = value;
                worst_angle = angle;
              }
          }
        return axisymmetric(worst_angle);
      }

      void
      cut_wave(const Tensor<2, 3> &F,
               const Tensor<1, 3> &m,
               const Tensor<1, 3> &N)
      {
        HalfSpace half_space{std::vector<double>(n_constants, 0.), margin_};
        for (unsigned int k = 0; k < n_constants; ++k)
          {
            Tensor<2, 3> P;
            Tensor<4, 3> A;
            laws_[k].stress_and_tangent(F, P, A);
            for (unsigned int i = 0; i < 3; ++i)
              for (unsigned int J = 0; J < 3; ++J)
                for (unsigned int l = 0; l < 3; ++l)
                  for (unsigned int L = 0; L < 3; ++L)
                    half_space.g[k] +=
                      A[i][J][l][L] * m[i] * N[J] * m[l] * N[L];
          }
        cuts_.push_back(half_space);
      }

      const std::vector<FittedCurve> &curves_;
      const UnitLaws                 &laws_;
      const IdentificationParameters &parameters_;
      const double                    margin_;
      std::vector<HalfSpace>          cuts_;
    };



    // C - C g g^T C / (g^T C g): covariance with g^T theta known.
    void
    impose_on_covariance(const std::vector<double> &g, FullMatrix<double> &C)
    {
      std::vector<double> Cg(n_constants, 0.);
      double              gCg = 0;
      for (unsigned int i = 0; i < n_constants; ++i)
        {
          for (unsigned int j = 0; j < n_constants; ++j)
            Cg[i] += C(i, j) * g[j];
          gCg += g[i] * Cg[i];
        }
      if (gCg > 0.)
        for (unsigned int i = 0; i < n_constants; ++i)
          for (unsigned int j = 0; j < n_constants; ++j)
            C(i, j) -= Cg[i] * Cg[j] / gCg;
    }



    // Variance of the weighted stresses, and the covariance of the constants
    // with active constraints as equations. Returns the degrees of freedom.
    unsigned int
    estimate_confidence(const StressData             &data,
                        const FullMatrix<double>     &inverse,
                        const std::vector<double>    &theta,
                        const std::vector<HalfSpace> &cuts,
                        const std::vector<bool>      &active,
                        IdentificationResult         &result)
    {
      double sum_of_squares = 0;
      for (unsigned int i = 0; i < data.y.size(); ++i)
        {
          double residual = -data.y[i];
          for (unsigned int k = 0; k < n_constants; ++k)
            residual += data.X(i, k) * theta[k];
          sum_of_squares += residual * residual;
        }
      const unsigned int n_active =
        std::min(result.n_active_constraints, n_constants);
      const unsigned int freedom  = data.y.size() - n_constants + n_active;
      const double       variance = freedom > 0 ? sum_of_squares / freedom : 0.;
      result.covariance           = inverse;
      for (unsigned int c = 0; c < cuts.size(); ++c)
        if (active[c])
          impose_on_covariance(cuts[c].g, result.covariance);
      result.covariance *= variance;
      const double t = freedom > 0 ? gsl_cdf_tdist_Pinv(0.975, freedom) : 0.;
      for (unsigned int k = 0; k < n_constants; ++k)
        {
          result.standard_error[k] =
            std::sqrt(std::max(0., result.covariance(k, k)));
          result.confidence[k] = t * result.standard_error[k];
        }
      return freedom;
    }



    std::vector<std::string>
    notes_on(const IdentificationResult &result, const unsigned int freedom)
    {
      std::vector<std::string> notes;
      if (freedom == 0)
        notes.push_back("As many data as constants: there is no residual "
                        "from which a confidence could be told.");
      if (result.n_active_constraints > 0)
        notes.push_back("The best fit without constraints is not stable; " +
                        std::to_string(result.n_active_constraints) +
                        " stability condition(s) hold the constants back.");
      if (result.stiffness.value <= 0.)
        notes.push_back("The small-strain stiffness is not positive "
                        "definite; other runs will refuse this law.");
      if (result.acoustic <= 0.)
        notes.push_back("The law is not elliptic over the fitted range (" +
                        result.acoustic_place + ").");
      if (result.reciprocal_condition < 1e-5)
        notes.push_back(
          "The data hardly determine all constants (reciprocal condition " +
          short_number(result.reciprocal_condition, 2) + ").");
      return notes;
    }
  } // namespace



  IdentificationResult
  identify(const std::vector<MaterialCurve> &all_curves,
           const IdentificationParameters   &parameters)
  {
    const std::vector<FittedCurve> curves =
      select_curves(all_curves, parameters);
    UnitLaws laws;
    for (unsigned int k = 0; k < n_constants; ++k)
      laws.push_back(unit_law(k));

    const StressData     data = collect_stresses(curves, laws);
    const LeastSquares   fit(data.X, data.y);
    IdentificationResult result;
    result.n_data               = data.y.size();
    result.reciprocal_condition = fit.reciprocal_condition;
    if (fit.reciprocal_condition < 1e-10)
      throw InputError("The selected curves do not determine all six "
                       "constants: a change in the ratio (" +
                       undetermined_combination(data.X) +
                       ") leaves their stresses as they are; select curves "
                       "of other modes too (entry Curves, subsection "
                       "Identification).");

    std::vector<double> theta = fit.solution;
    StabilityCuts       stability(curves, laws, parameters);
    std::vector<bool>   active;
    for (unsigned int round = 0;; ++round)
      {
        AssertThrow(round < 200,
                    dealii::ExcMessage(
                      "No stable constants found in 200 cutting planes."));
        const std::size_t n_before = stability.cuts().size();
        stability.check_stiffness(theta, result);
        stability.check_acoustic_tensor(theta, result);
        if (stability.cuts().size() == n_before)
          break;
        theta = nearest_admissible(fit.solution,
                                   fit.inverse,
                                   stability.cuts(),
                                   active);
      }
    result.constants = to_struct(theta);
    for (const bool a : active)
      result.n_active_constraints += a;
    const unsigned int freedom = estimate_confidence(
      data, fit.inverse, theta, stability.cuts(), active, result);
    result.errors = errors_of(curves, result.constants);
    result.notes  = notes_on(result, freedom);
    return result;
  }



  std::vector<IdentificationResult::CurveError>
  curve_errors(const std::vector<MaterialCurve> &curves,
               const IdentificationParameters   &parameters,
               const FiberBundleConstants       &constants)
  {
    return errors_of(select_curves(curves, parameters), constants);
  }
} // namespace NPT
