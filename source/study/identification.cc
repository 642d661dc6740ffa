// SPDX-License-Identifier: LGPL-2.1-or-later
// Identification of the fiber bundle law by constrained linear least squares.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/parameter_file.h>
#include <npt_dealii/base/short_number.h>
#include <npt_dealii/base/table_file.h>
#include <npt_dealii/material/ellipticity.h>
#include <npt_dealii/output/gnuplot.h>
#include <npt_dealii/output/replace_file.h>
#include <npt_dealii/study/identification.h>

#include <deal.II/base/utilities.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_multifit.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <memory>
#include <sstream>

namespace NPT
{
  using dealii::FullMatrix;
  using dealii::Tensor;
  namespace Patterns = dealii::Patterns;

  namespace
  {
    constexpr unsigned int n_constants = IdentificationResult::n_constants;
    using Constants                    = std::array<double, n_constants>;

    const char *const constant_names[n_constants] =
      {"mu_iso", "lambda_iso", "a_trn", "b_trn", "c_trn", "d_trn"};

    FiberBundleConstants
    to_struct(const Constants &t)
    {
      return {t[0], t[1], t[2], t[3], t[4], t[5]};
    }

    Constants
    to_array(const FiberBundleConstants &c)
    {
      return {{c.mu, c.lambda, c.a, c.b, c.c, c.d}};
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
      Constants t{};
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



    // GSL's linear least squares, min |X t - y|, as values. GSL's own handler
    // would abort the program.
    struct LeastSquares
    {
      LeastSquares(const FullMatrix<double> &X, const std::vector<double> &y)
        : inverse(X.n(), X.n())
      {
        const unsigned int n = X.m(), p = X.n();
        const auto         old_handler = gsl_set_error_handler_off();
        gsl_matrix        *matrix      = gsl_matrix_alloc(n, p);
        gsl_matrix        *covariance  = gsl_matrix_alloc(p, p);
        gsl_vector        *rhs         = gsl_vector_alloc(n);
        gsl_vector        *weights     = gsl_vector_alloc(n);
        gsl_vector        *t           = gsl_vector_alloc(p);
        auto              *work        = gsl_multifit_linear_alloc(n, p);

        // Equilibrate the columns, so that the condition tells of the data and
        // not of units.
        std::vector<double> scale(p, 0.);
        for (unsigned int j = 0; j < p; ++j)
          {
            for (unsigned int i = 0; i < n; ++i)
              scale[j] += X(i, j) * X(i, j);
            scale[j] = scale[j] > 0. ? std::sqrt(scale[j]) : 1.;
          }
        for (unsigned int i = 0; i < n; ++i)
          {
            gsl_vector_set(rhs, i, y[i]);
            for (unsigned int j = 0; j < p; ++j)
              gsl_matrix_set(matrix, i, j, X(i, j) / scale[j]);
          }
        // The variant with weights returns (X^T X)^{-1} itself, without an
        // estimated variance: constrained fits estimate theirs later.
        gsl_vector_set_all(weights, 1.);
        double    sum_of_squares;
        const int status = gsl_multifit_wlinear(
          matrix, weights, rhs, t, covariance, &sum_of_squares, work);
        const double rcond   = gsl_multifit_linear_rcond(work);
        reciprocal_condition = std::isfinite(rcond) ? rcond : 0.;
        for (unsigned int i = 0; i < p; ++i)
          {
            solution.push_back(gsl_vector_get(t, i) / scale[i]);
            for (unsigned int j = 0; j < p; ++j)
              inverse(i, j) =
                gsl_matrix_get(covariance, i, j) / (scale[i] * scale[j]);
          }
        gsl_multifit_linear_free(work);
        gsl_vector_free(t);
        gsl_vector_free(weights);
        gsl_vector_free(rhs);
        gsl_matrix_free(covariance);
        gsl_matrix_free(matrix);
        gsl_set_error_handler(old_handler);
        AssertThrow(status == 0,
                    dealii::ExcMessage("GSL: " +
                                       std::string(gsl_strerror(status))));
      }

      std::vector<double> solution;
      FullMatrix<double>  inverse; ///< (X^T X)^{-1}
      double              reciprocal_condition = 0;
    };



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
          text += (text.empty() ? "" : ", ") + std::string(constant_names[k]) +
                  ": " + short_number(direction[k] / largest, 3);
      return text;
    }



    // min |E u - f| subject to u >= 0 (Lawson and Hanson 1974, algorithm NNLS).
    std::vector<double>
    nonnegative_least_squares(const FullMatrix<double>  &E,
                              const std::vector<double> &f)
    {
      const unsigned int  n = E.m(), m = E.n();
      std::vector<double> u(m, 0.);
      std::vector<bool>   passive(m, false);
      double              size = 0;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < m; ++j)
          size = std::max(size, std::abs(E(i, j)));

      for (unsigned int outer = 0; outer < 10 * (m + 1); ++outer)
        {
          // The gradient tells which variable would reduce the residual.
          std::vector<double> r = f;
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int j = 0; j < m; ++j)
              r[i] -= E(i, j) * u[j];
          int    best  = -1;
          double value = 1e-12 * size;
          for (unsigned int j = 0; j < m; ++j)
            if (!passive[j])
              {
                double g = 0;
                for (unsigned int i = 0; i < n; ++i)
                  g += E(i, j) * r[i];
                if (g > value)
                  {
                    value = g;
                    best  = j;
                  }
              }
          if (best < 0)
            return u;
          passive[best] = true;

          for (;;)
            {
              std::vector<unsigned int> set;
              for (unsigned int j = 0; j < m; ++j)
                if (passive[j])
                  set.push_back(j);
              if (set.empty() || set.size() > n)
                return u;
              FullMatrix<double> part(n, set.size());
              for (unsigned int i = 0; i < n; ++i)
                for (unsigned int k = 0; k < set.size(); ++k)
                  part(i, k) = E(i, set[k]);
              const std::vector<double> s    = LeastSquares(part, f).solution;
              double                    step = 1.;
              for (unsigned int k = 0; k < set.size(); ++k)
                if (s[k] <= 0.)
                  step = std::min(step, u[set[k]] / (u[set[k]] - s[k]));
              for (unsigned int k = 0; k < set.size(); ++k)
                u[set[k]] += step * (s[k] - u[set[k]]);
              if (step == 1.)
                break;
              for (const unsigned int j : set)
                if (u[j] <= 1e-14)
                  {
                    u[j]       = 0.;
                    passive[j] = false;
                  }
            }
        }
      return u;
    }



    // A half-space g.theta >= bound of the constants.
    struct HalfSpace
    {
      Constants g;
      double    bound;
    };



    // The theta nearest to `start` in the metric of the fit, |theta - start|^2
    // = z.z with theta = start + L z and inverse = L L^T, in all half-spaces.
    Constants
    nearest_admissible(const Constants              &start,
                       const FullMatrix<double>     &inverse,
                       const std::vector<HalfSpace> &cuts,
                       std::vector<bool>            &active)
    {
      FullMatrix<double> L(n_constants, n_constants);
      L.cholesky(inverse);

      // Rows of G L and what is missing; each row normalized.
      const unsigned int  m = cuts.size();
      FullMatrix<double>  E(n_constants + 1, m);
      std::vector<double> f(n_constants + 1, 0.);
      f[n_constants] = 1.;
      for (unsigned int c = 0; c < m; ++c)
        {
          double norm = 0, gap = cuts[c].bound;
          for (unsigned int j = 0; j < n_constants; ++j)
            {
              double sum = 0;
              for (unsigned int i = 0; i < n_constants; ++i)
                sum += cuts[c].g[i] * L(i, j);
              E(j, c) = sum;
              norm += sum * sum;
              gap -= cuts[c].g[j] * start[j];
            }
          norm = std::sqrt(norm);
          for (unsigned int j = 0; j < n_constants; ++j)
            E(j, c) /= norm;
          E(n_constants, c) = gap / norm;
        }
      // The dual problem is scaled by its largest gap.
      double largest = 0;
      for (unsigned int c = 0; c < m; ++c)
        largest = std::max(largest, std::abs(E(n_constants, c)));
      if (largest == 0.)
        largest = 1.;
      for (unsigned int c = 0; c < m; ++c)
        E(n_constants, c) /= largest;

      const std::vector<double> u = nonnegative_least_squares(E, f);
      std::vector<double>       r = f;
      for (unsigned int i = 0; i <= n_constants; ++i)
        {
          r[i] = -f[i];
          for (unsigned int c = 0; c < m; ++c)
            r[i] += E(i, c) * u[c];
        }
      AssertThrow(std::abs(r[n_constants]) > 1e-13,
                  dealii::ExcMessage("The stability conditions contradict each "
                                     "other."));
      active.assign(m, false);
      for (unsigned int c = 0; c < m; ++c)
        active[c] = u[c] > 0.;
      Constants theta = start;
      for (unsigned int i = 0; i < n_constants; ++i)
        for (unsigned int j = 0; j < n_constants; ++j)
          theta[i] -= L(i, j) * r[j] / r[n_constants] * largest;
      return theta;
    }



    // A curve with what the fit takes from it.
    struct FittedCurve
    {
      const MaterialCurve *curve;
      std::array<bool, 9>  fitted;
      double               scale;  // largest fitted stress
      double               factor; // of the residuals
    };



    std::vector<FittedCurve>
    select_curves(const std::vector<MaterialCurve> &curves,
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
              std::array<double, 9> amplitude{};
              for (const auto &H : curve.H)
                for (unsigned int e = 0; e < 9; ++e)
                  amplitude[e] =
                    std::max(amplitude[e], std::abs(H[e / 3][e % 3]));
              const double most =
                *std::max_element(amplitude.begin(), amplitude.end());
              for (unsigned int e = 0; e < 9; ++e)
                fitted.fitted[e] =
                  fitted.fitted[e] && amplitude[e] > 1e-6 * most;
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



  // ------------------------------------------------------------------ input

  std::vector<MaterialCurve>
  read_material_curves(const std::string &filename)
  {
    const Table                      table = read_table(filename);
    std::vector<std::vector<double>> H(9), P(9);
    std::array<bool, 9>              measured{};
    bool                             has_H = false, has_P = false;
    for (unsigned int e = 0; e < 9; ++e)
      {
        const std::string index =
          std::to_string(e / 3 + 1) + std::to_string(e % 3 + 1);
        if (table.has_column("H" + index))
          {
            H[e]  = table.column("H" + index);
            has_H = true;
          }
        else
          H[e].assign(table.n_rows(), 0.);
        if (table.has_column("P" + index))
          {
            P[e]        = table.column("P" + index);
            measured[e] = true;
            has_P       = true;
          }
        else
          P[e].assign(table.n_rows(), 0.);
      }
    if (!has_H || !has_P)
      throw InputError("The table " + filename + " has no column " +
                       (has_H ? "of stresses P11 ... P33" :
                                "of displacement gradients H11 ... H33") +
                       "; test data need at least one of each kind.");
    if (table.n_rows() == 0)
      throw InputError("The table " + filename + " has no rows.");

    const std::string stem  = std::filesystem::path(filename).stem().string();
    const auto        names = table.has_column("test") ?
                                table.text_column("test") :
                                std::vector<std::string>(table.n_rows(), stem);

    std::vector<MaterialCurve> curves;
    for (unsigned int r = 0; r < table.n_rows(); ++r)
      {
        if (curves.empty() || curves.back().name != names[r])
          {
            curves.emplace_back();
            curves.back().name     = names[r];
            curves.back().measured = measured;
          }
        Tensor<2, 3> h, p;
        for (unsigned int e = 0; e < 9; ++e)
          {
            h[e / 3][e % 3] = H[e][r];
            p[e / 3][e % 3] = P[e][r];
            if (!std::isfinite(H[e][r]) || !std::isfinite(P[e][r]))
              throw InputError(filename + ", line " +
                               std::to_string(table.lines[r]) +
                               ": a component of H or P is not finite.");
          }
        if (!(determinant(deformation_gradient(h)) > 0.))
          throw InputError(filename + ", line " +
                           std::to_string(table.lines[r]) +
                           ": the determinant of 1 + H is not positive.");
        curves.back().H.push_back(h);
        curves.back().P.push_back(p);
      }
    return curves;
  }



  void
  IdentificationParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Identification");
    {
      prm.declare_entry("Curves",
                        "all",
                        Patterns::Anything(),
                        "Names of the curves that are fitted, separated by "
                        "commas, or `all`.");
      prm.declare_entry("Weights",
                        "",
                        Patterns::Map(Patterns::Anything(),
                                      Patterns::Double(0.),
                                      0,
                                      Patterns::Map::max_int_value,
                                      ",",
                                      ":"),
                        "Weights w_c of curves, `tension 1: 2, shear 23: "
                        "0.5`; curves not named have the weight 1 [-].");
      prm.declare_entry("Components",
                        "all",
                        Patterns::Selection("all|driven"),
                        "Which stresses of a curve are fitted: all that were "
                        "measured, or only those whose component of H is "
                        "driven (the curves of Fig. 8).");
      prm.declare_entry("Relative to curve",
                        "true",
                        Patterns::Bool(),
                        "Divide the stresses of each curve by its largest, so "
                        "that stiff and soft directions count alike; otherwise "
                        "absolute stresses count.");
      prm.declare_entry("Positive definite",
                        "true",
                        Patterns::Bool(),
                        "Demand a positive definite small-strain stiffness. A "
                        "law without it is refused by other runs.");
      prm.declare_entry("Elliptic",
                        "true",
                        Patterns::Bool(),
                        "Demand that the law is elliptic at all points of the "
                        "fitted curves.");
      prm.declare_entry("Stability margin",
                        "0.01",
                        Patterns::Double(1e-8),
                        "The least eigenvalue of stiffness and acoustic tensor "
                        "that the last two entries demand [MPa].");
    }
    prm.leave_subsection();
  }



  void
  IdentificationParameters::parse_parameters(dealii::ParameterHandler &prm)
  {
    using dealii::Utilities::split_string_list;
    prm.enter_subsection("Identification");
    curves.clear();
    if (prm.get("Curves") != "all")
      curves = split_string_list(prm.get("Curves"), ',');
    weights.clear();
    for (const std::string &item : split_string_list(prm.get("Weights"), ','))
      {
        const auto pair = split_string_list(item, ':');
        AssertDimension(pair.size(), 2); // checked by the pattern
        weights[pair[0]] = dealii::Utilities::string_to_double(pair[1]);
      }
    components =
      prm.get("Components") == "all" ? Components::all : Components::driven;
    relative_to_curve = prm.get_bool("Relative to curve");
    positive_definite = prm.get_bool("Positive definite");
    elliptic          = prm.get_bool("Elliptic");
    stability_margin  = prm.get_double("Stability margin");
    prm.leave_subsection();
  }



  // -------------------------------------------------------------------- fit

  Tensor<2, 3>
  bundle_stress(const FiberBundleConstants &constants, const Tensor<2, 3> &H)
  {
    Tensor<2, 3> P;
    FiberBundleLaw<3>(constants, fiber_direction())
      .stress(deformation_gradient(H), P);
    return P;
  }



  IdentificationResult
  identify(const std::vector<MaterialCurve> &all_curves,
           const IdentificationParameters   &parameters)
  {
    const std::vector<FittedCurve> curves =
      select_curves(all_curves, parameters);
    std::vector<FiberBundleLaw<3>> laws;
    for (unsigned int k = 0; k < n_constants; ++k)
      laws.push_back(unit_law(k));

    // One row per stress value. Stresses at H = 0 vanish for any constants:
    // they are no data and would only flatter the variance.
    IdentificationResult             result;
    std::vector<std::vector<double>> rows;
    std::vector<double>              y;
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
                y.push_back(c.factor * c.curve->P[r][e / 3][e % 3]);
              }
        }
    result.n_data = rows.size();
    if (rows.size() < n_constants)
      throw InputError(
        "The selected curves have " + std::to_string(rows.size()) +
        " stress values, fewer than the six constants of the law; give more "
        "data or select more curves (entry Curves, subsection "
        "Identification).");
    FullMatrix<double> X(rows.size(), n_constants);
    for (unsigned int i = 0; i < rows.size(); ++i)
      for (unsigned int k = 0; k < n_constants; ++k)
        X(i, k) = rows[i][k];

    const LeastSquares fit(X, y);
    result.reciprocal_condition = fit.reciprocal_condition;
    if (fit.reciprocal_condition < 1e-10)
      {
        throw InputError("The selected curves do not determine all six "
                         "constants: a change in the ratio (" +
                         undetermined_combination(X) +
                         ") leaves their stresses as they are; select curves "
                         "of other modes too (entry Curves, subsection "
                         "Identification).");
      }
    Constants unconstrained;
    std::copy(fit.solution.begin(), fit.solution.end(), unconstrained.begin());

    // Cutting planes. Half the margin is enough to stop: the cuts ask for all
    // of it, so that the iteration ends.
    const double           margin = parameters.stability_margin;
    Constants              theta  = unconstrained;
    std::vector<HalfSpace> cuts;
    std::vector<bool>      active;
    for (unsigned int round = 0;; ++round)
      {
        AssertThrow(round < 200,
                    dealii::ExcMessage(
                      "No stable constants found in 200 cutting planes."));
        const unsigned int      n_before = cuts.size();
        const FiberBundleLaw<3> law(to_struct(theta), fiber_direction());

        // At rest: the eigenvector of the lowest eigenvalue of the stiffness
        // (on the orthonormal basis of symmetric tensors).
        result.stiffness = law.constants().lowest_stiffness_eigenvalue();
        if (parameters.positive_definite &&
            result.stiffness.value < 0.5 * margin)
          {
            // The plane of strains symmetric about the fiber, and the two
            // shears, one by one: each is an eigenspace.
            std::array<std::array<double, 81>, n_constants> A;
            for (unsigned int k = 0; k < n_constants; ++k)
              {
                double F[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, P[9];
                laws[k].stress_and_tangent(F, P, A[k].data());
              }
            const auto cut = [&](const Tensor<2, 3> &e) {
              HalfSpace half_space{{}, margin};
              double    value = 0;
              for (unsigned int k = 0; k < n_constants; ++k)
                {
                  for (unsigned int a = 0; a < 9; ++a)
                    for (unsigned int b = 0; b < 9; ++b)
                      half_space.g[k] +=
                        e[a / 3][a % 3] * A[k][9 * a + b] * e[b / 3][b % 3];
                  value += half_space.g[k] * theta[k];
                }
              if (value < 0.5 * margin)
                cuts.push_back(half_space);
            };
            Tensor<2, 3> shear_along, shear_across;
            shear_along[0][1] = shear_along[1][0] = std::sqrt(0.5);
            shear_across[1][2] = shear_across[2][1] = std::sqrt(0.5);
            cut(shear_along);
            cut(shear_across);
            double     worst_angle = 0, worst = 1e300;
            const auto axisymmetric = [](const double angle) {
              Tensor<2, 3> e;
              e[0][0] = std::cos(angle);
              e[1][1] = e[2][2] = std::sqrt(0.5) * std::sin(angle);
              return e;
            };
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
            cut(axisymmetric(worst_angle));
          }

        // Over the fitted range, the natural state included.
        result.acoustic  = 1e300;
        const auto check = [&](const Tensor<2, 3> &F,
                               const std::string  &place) {
          const auto lowest = lowest_acoustic_eigenvalue<3>(law, F);
          if (lowest.value < result.acoustic)
            {
              result.acoustic       = lowest.value;
              result.acoustic_place = place;
            }
          if (!parameters.elliptic || lowest.value >= 0.5 * margin)
            return;
          HalfSpace half_space{{}, margin};
          for (unsigned int k = 0; k < n_constants; ++k)
            {
              Tensor<2, 3> P;
              Tensor<4, 3> A;
              laws[k].stress_and_tangent(F, P, A);
              const auto &m = lowest.polarization;
              const auto &N = lowest.normal;
              for (unsigned int i = 0; i < 3; ++i)
                for (unsigned int J = 0; J < 3; ++J)
                  for (unsigned int l = 0; l < 3; ++l)
                    for (unsigned int L = 0; L < 3; ++L)
                      half_space.g[k] +=
                        A[i][J][l][L] * m[i] * N[J] * m[l] * N[L];
            }
          cuts.push_back(half_space);
        };
        check(deformation_gradient(Tensor<2, 3>()), "at rest");
        for (const FittedCurve &c : curves)
          for (unsigned int r = 0; r < c.curve->H.size(); ++r)
            check(deformation_gradient(c.curve->H[r]),
                  "curve " + c.curve->name + ", point " +
                    std::to_string(r + 1));

        if (cuts.size() == n_before)
          break;
        theta = nearest_admissible(unconstrained, fit.inverse, cuts, active);
      }
    result.constants = to_struct(theta);
    for (const bool a : active)
      result.n_active_constraints += a;

    // Variance of the weighted stresses, and the covariance of the constants
    // with active constraints as equations.
    double sum_of_squares = 0;
    for (unsigned int i = 0; i < rows.size(); ++i)
      {
        double residual = -y[i];
        for (unsigned int k = 0; k < n_constants; ++k)
          residual += X(i, k) * theta[k];
        sum_of_squares += residual * residual;
      }
    const unsigned int n_active =
      std::min(result.n_active_constraints, n_constants);
    const unsigned int freedom  = rows.size() - n_constants + n_active;
    const double       variance = freedom > 0 ? sum_of_squares / freedom : 0.;
    result.covariance           = fit.inverse;
    for (unsigned int c = 0; c < cuts.size(); ++c)
      if (active[c])
        {
          // C - C g g^T C / (g^T C g), one constraint after the other.
          std::vector<double> Cg(n_constants, 0.);
          double              gCg = 0;
          for (unsigned int i = 0; i < n_constants; ++i)
            {
              for (unsigned int j = 0; j < n_constants; ++j)
                Cg[i] += result.covariance(i, j) * cuts[c].g[j];
              gCg += cuts[c].g[i] * Cg[i];
            }
          if (gCg > 0.)
            for (unsigned int i = 0; i < n_constants; ++i)
              for (unsigned int j = 0; j < n_constants; ++j)
                result.covariance(i, j) -= Cg[i] * Cg[j] / gCg;
        }
    result.covariance *= variance;
    const double t = freedom > 0 ? gsl_cdf_tdist_Pinv(0.975, freedom) : 0.;
    for (unsigned int k = 0; k < n_constants; ++k)
      {
        result.standard_error[k] =
          std::sqrt(std::max(0., result.covariance(k, k)));
        result.confidence[k] = t * result.standard_error[k];
      }
    result.errors = errors_of(curves, result.constants);

    if (freedom == 0)
      result.notes.push_back("As many data as constants: there is no residual "
                             "from which a confidence could be told.");
    if (result.n_active_constraints > 0)
      result.notes.push_back(
        "The best fit without constraints is not stable; " +
        std::to_string(result.n_active_constraints) +
        " stability condition(s) hold the constants back.");
    if (result.stiffness.value <= 0.)
      result.notes.push_back("The small-strain stiffness is not positive "
                             "definite; other runs will refuse this law.");
    if (result.acoustic <= 0.)
      result.notes.push_back("The law is not elliptic over the fitted range (" +
                             result.acoustic_place + ").");
    if (fit.reciprocal_condition < 1e-5)
      result.notes.push_back(
        "The data hardly determine all constants (reciprocal condition " +
        short_number(fit.reciprocal_condition, 2) + ").");
    return result;
  }



  std::vector<IdentificationResult::CurveError>
  curve_errors(const std::vector<MaterialCurve> &curves,
               const IdentificationParameters   &parameters,
               const FiberBundleConstants       &constants)
  {
    return errors_of(select_curves(curves, parameters), constants);
  }



  // ----------------------------------------------------------------- output

  std::vector<std::string>
  describe(const IdentificationResult &result)
  {
    std::vector<std::string> lines;
    const auto               add = [&](const std::ostringstream &text) {
      lines.push_back(text.str());
    };
    std::ostringstream head;
    head << "constant      value [MPa]   standard error   95 % interval (+-)";
    add(head);
    const Constants theta = to_array(result.constants);
    for (unsigned int k = 0; k < n_constants; ++k)
      {
        std::ostringstream text;
        text << std::left << std::setw(12) << constant_names[k] << std::right
             << std::setprecision(6) << std::setw(13) << theta[k]
             << std::setprecision(3) << std::setw(17)
             << result.standard_error[k] << std::setw(20)
             << result.confidence[k];
        add(text);
      }
    std::ostringstream title;
    title << "curve             largest stress [MPa]   rms error [%]   "
             "largest error [%]";
    add(title);
    for (const auto &error : result.errors)
      {
        std::ostringstream text;
        text << std::left << std::setw(18) << error.name << std::right
             << std::setprecision(4) << std::setw(20) << error.scale
             << std::setprecision(3) << std::setw(16) << 100. * error.rms
             << std::setw(20) << 100. * error.largest;
        add(text);
      }
    const EngineeringConstants m = result.constants.engineering_constants();
    std::ostringstream         moduli;
    moduli << std::setprecision(4) << "small strain: E_L = " << m.E_L
           << ", E_T = " << m.E_T << ", G_L = " << m.G_L << ", G_T = " << m.G_T
           << " MPa, nu_LT = " << m.nu_LT;
    add(moduli);
    std::ostringstream stability;
    stability << std::setprecision(4)
              << "lowest eigenvalue of the stiffness at rest: "
              << result.stiffness.value << " MPa (" << result.stiffness.mode
              << ")";
    add(stability);
    std::ostringstream acoustic;
    acoustic << std::setprecision(4)
             << "lowest eigenvalue of the acoustic tensor over the fitted "
                "range: "
             << result.acoustic << " MPa (" << result.acoustic_place << ")";
    add(acoustic);
    std::ostringstream data;
    data << std::setprecision(2) << result.n_data
         << " stress values; reciprocal condition "
         << result.reciprocal_condition;
    add(data);
    for (const std::string &note : result.notes)
      lines.push_back("Note: " + note);
    return lines;
  }



  void
  write_material_file(const std::string          &filename,
                      const IdentificationResult &result)
  {
    replace_file(filename, [&](std::ostream &out) {
      out << "# Constants of the fiber bundle law (50)-(53), identified from\n"
             "# tests. Use: `include "
          << std::filesystem::path(filename).filename().string()
          << "` in another parameter file.\n#\n";
      for (const std::string &line : describe(result))
        out << "# " << line << '\n';
      out << "\nsubsection Fiber bundle material\n"
          << "  set Law        = fiber bundle\n"
          << std::setprecision(15);
      const Constants theta = to_array(result.constants);
      for (unsigned int k = 0; k < n_constants; ++k)
        out << "  set " << std::left << std::setw(10) << constant_names[k]
            << " = " << theta[k] << '\n';
      out << "end\n";
    });
  }



  std::string
  write_fit(const std::string                &directory,
            const std::vector<MaterialCurve> &curves,
            const FiberBundleConstants       &constants,
            const bool                        picture)
  {
    // Amplitude and stress of a curve as in Fig. 8: the component that is
    // driven most; a symmetric shear counts as engineering shear.
    const auto leading = [](const MaterialCurve &curve) {
      unsigned int best = 0;
      double       most = 0;
      for (const auto &H : curve.H)
        for (unsigned int e = 0; e < 9; ++e)
          if (std::abs(H[e / 3][e % 3]) > most + 1e-12)
            {
              most = std::abs(H[e / 3][e % 3]);
              best = e;
            }
      return best;
    };
    const auto amplitude = [](const Tensor<2, 3> &H, const unsigned int e) {
      const unsigned int i = e / 3, J = e % 3;
      return i == J ? H[i][i] : H[i][J] + H[J][i];
    };
    const auto stress = [](const Tensor<2, 3> &P, const unsigned int e) {
      return 0.5 * (P[e / 3][e % 3] + P[e % 3][e / 3]);
    };

    std::vector<std::string> columns{"test", "amplitude", "stress", "fit"};
    for (const std::string kind : {"H", "P", "fit P"})
      for (unsigned int e = 0; e < 9; ++e)
        columns.push_back(kind + std::to_string(e / 3 + 1) +
                          std::to_string(e % 3 + 1));
    {
      TableWriter table(directory + "/fit.csv",
                        columns,
                        {"Fit of the fiber bundle law to test data; stresses "
                         "in MPa, first Piola-Kirchhoff.",
                         "amplitude and stress: the component that is driven "
                         "most, engineering shear and mean of iJ and Ji."});
      for (const MaterialCurve &curve : curves)
        {
          const unsigned int e = leading(curve);
          for (unsigned int r = 0; r < curve.H.size(); ++r)
            {
              const Tensor<2, 3>     P = bundle_stress(constants, curve.H[r]);
              std::vector<TableCell> row{curve.name,
                                         amplitude(curve.H[r], e),
                                         stress(curve.P[r], e),
                                         stress(P, e)};
              for (const auto &T : {curve.H[r], curve.P[r], P})
                for (unsigned int k = 0; k < 9; ++k)
                  row.emplace_back(T[k / 3][k % 3]);
              table.add_row(row);
            }
        }
    }

    GnuplotPicture frame;
    frame.name               = "fit";
    frame.width              = 1040;
    frame.height             = 420;
    frame.n_columns          = 2;
    frame.settings           = "set key left top reverse Left samplen 2\n"
                               "set xlabel 'H (shear: H_{iJ} + H_{Ji}) [-]'\n"
                               "set ylabel 'first Piola-Kirchhoff stress [MPa]'\n";
    const std::string script = directory + "/fit.gp";
    write_gnuplot_script(script, frame, [&](std::ostream &out) {
      for (const bool shear : {false, true})
        {
          out << "  set title '" << (shear ? "shear" : "tension") << "'\n";
          std::string  separator = "  plot \\\n";
          unsigned int n         = 0;
          for (const MaterialCurve &curve : curves)
            {
              const unsigned int e = leading(curve);
              if ((e / 3 != e % 3) != shear)
                continue;
              const std::string color = gnuplot_color(n++);
              std::string       name  = curve.name;
              for (char &c : name)
                if (c == '\'')
                  c = ' ';
              for (const std::string kind : {"stress", "fit"})
                {
                  out << separator << "    'fit.csv' using (column('amplitude')"
                      << "):(strcol('test') eq '" << name << "' ? column('"
                      << kind << "') : NaN) "
                      << (kind == "fit" ?
                            "with lines lw 2 lc rgb '" + color + "' notitle" :
                            "with points pt 7 ps 0.6 lc rgb '" + color +
                              "' title '" + name + "'");
                  separator = ", \\\n";
                }
            }
          out << (n > 0 ? "\n" : "  set multiplot next\n");
        }
    });
    return picture ? run_gnuplot(script) : std::string();
  }
} // namespace NPT
