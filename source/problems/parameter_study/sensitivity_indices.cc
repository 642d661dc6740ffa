// SPDX-License-Identifier: LGPL-2.1-or-later
// Saltelli's design and the estimators of sensitivity indices.

#include <npt_dealii/problems/parameter_study/sensitivity_indices.h>

#include <deal.II/base/exceptions.h>

#include <gsl/gsl_qrng.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

namespace NPT
{
  namespace
  {
    constexpr unsigned int n_resamples = 1000;

    // The values of one row of the design.
    struct DesignRow
    {
      double              a, b;
      std::vector<double> c; // by input
    };

    std::vector<DesignRow>
    complete_rows(const std::vector<double> &values,
                  const unsigned int         n_inputs)
    {
      const unsigned int size = n_inputs + 2;
      AssertThrow(values.size() % size == 0,
                  dealii::ExcMessage("These are no whole rows of a design."));
      std::vector<DesignRow> rows;
      for (auto row = values.begin(); row != values.end(); row += size)
        if (std::all_of(row, row + size, [](const double value) {
              return std::isfinite(value);
            }))
          rows.push_back({row[0], row[1], {row + 2, row + size}});
      return rows;
    }

    // Of the rows with these numbers, which may repeat.
    SensitivityResult
    estimate(const std::vector<DesignRow>    &rows,
             const std::vector<unsigned int> &numbers)
    {
      SensitivityResult result;
      result.n_rows  = numbers.size();
      const double N = numbers.size();
      for (const unsigned int j : numbers)
        result.mean += (rows[j].a + rows[j].b) / (2. * N);
      const double m = result.mean;
      double       V = 0;
      for (const unsigned int j : numbers)
        V += ((rows[j].a - m) * (rows[j].a - m) +
              (rows[j].b - m) * (rows[j].b - m)) /
             (2. * N);
      result.deviation = std::sqrt(V);
      if (!(V > 0.))
        return result;
      for (unsigned int i = 0; i < rows[0].c.size(); ++i)
        {
          SensitivityIndex index;
          for (const unsigned int j : numbers)
            {
              const double change = rows[j].c[i] - rows[j].a;
              index.first += (rows[j].b - m) * change / (N * V);
              index.total += change * change / (2. * N * V);
            }
          result.indices.push_back(index);
        }
      return result;
    }

    void
    add_errors(const std::vector<DesignRow> &rows, SensitivityResult &result)
    {
      // Not by std::uniform_int_distribution, which every library has its own
      // way of.
      std::mt19937              generator(1);
      std::vector<unsigned int> numbers(rows.size());
      const unsigned int        n_inputs = result.indices.size();
      std::vector<double> first(n_inputs), first_2(n_inputs), total(n_inputs),
        total_2(n_inputs);
      unsigned int n = 0;
      for (unsigned int k = 0; k < n_resamples; ++k)
        {
          for (unsigned int &number : numbers)
            number = generator() % rows.size();
          const SensitivityResult sample = estimate(rows, numbers);
          if (sample.indices.empty()) // one row again and again
            continue;
          ++n;
          for (unsigned int i = 0; i < n_inputs; ++i)
            {
              const SensitivityIndex &index = sample.indices[i];
              first[i] += index.first;
              first_2[i] += index.first * index.first;
              total[i] += index.total;
              total_2[i] += index.total * index.total;
            }
        }
      const auto deviation = [n](const double sum, const double sum_2) {
        return std::sqrt(std::max(0., sum_2 / n - sum * sum / n / n));
      };
      for (unsigned int i = 0; n > 0 && i < n_inputs; ++i)
        {
          result.indices[i].first_error = deviation(first[i], first_2[i]);
          result.indices[i].total_error = deviation(total[i], total_2[i]);
        }
    }

    void
    add_quantiles(const std::vector<DesignRow> &rows, SensitivityResult &result)
    {
      std::vector<double> values;
      for (const DesignRow &row : rows)
        {
          values.push_back(row.a);
          values.push_back(row.b);
        }
      std::sort(values.begin(), values.end());
      const auto quantile = [&](const double share) {
        const double       place = share * (values.size() - 1.);
        const unsigned int k = std::min<unsigned int>(place, values.size() - 2);
        return values[k] + (place - k) * (values[k + 1] - values[k]);
      };
      result.lowest  = values.front();
      result.low     = quantile(0.05);
      result.median  = quantile(0.5);
      result.high    = quantile(0.95);
      result.highest = values.back();
    }
  } // namespace



  std::vector<std::vector<double>>
  sensitivity_points(const unsigned int n_inputs, const unsigned int n_rows)
  {
    AssertThrow(n_inputs > 0 && n_inputs <= 20,
                dealii::ExcMessage("There may be 1 to 20 inputs."));
    const std::unique_ptr<gsl_qrng, void (*)(gsl_qrng *)> sequence(
      gsl_qrng_alloc(gsl_qrng_sobol, 2 * n_inputs), gsl_qrng_free);
    std::vector<std::vector<double>> points;
    std::vector<double>              both(2 * n_inputs);
    for (unsigned int j = 0; j < n_rows; ++j)
      {
        gsl_qrng_get(sequence.get(), both.data());
        const std::vector<double> a(both.begin(), both.begin() + n_inputs),
          b(both.begin() + n_inputs, both.end());
        points.push_back(a);
        points.push_back(b);
        for (unsigned int i = 0; i < n_inputs; ++i)
          {
            points.push_back(a);
            points.back()[i] = b[i];
          }
      }
    return points;
  }



  SensitivityResult
  sensitivity_of(const std::vector<double> &values, const unsigned int n_inputs)
  {
    const std::vector<DesignRow> rows = complete_rows(values, n_inputs);
    std::vector<unsigned int>    numbers;
    for (unsigned int j = 0; j < rows.size(); ++j)
      numbers.push_back(j);
    if (rows.empty())
      return {};
    SensitivityResult result = estimate(rows, numbers);
    add_quantiles(rows, result);
    if (rows.size() < 2)
      result.indices.clear();
    add_errors(rows, result);
    return result;
  }
} // namespace NPT
