// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/experiment/convergence.h>

#include <slipstep/utilities/roots.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace SlipStep
{
  namespace
  {
    constexpr double no_value    = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinite    = std::numeric_limits<double>::infinity();
    constexpr double least_order = 0.1, largest_order = 20.;

    std::vector<double> without_last(std::vector<double> values)
    {
      values.pop_back();
      return values;
    }

    // U_n of the documentation.
    double uncertainty_of_last(const std::vector<double> &sizes,
                               const std::vector<double> &values)
    {
      const std::size_t n = values.size();
      if (n < 2)
        return infinite;
      const bool is_one_sided =
        n > 2 &&
        (values[n - 3] - values[n - 2]) * (values[n - 2] - values[n - 1]) > 0.;
      const double order = richardson(sizes, values).order;
      if (is_one_sided && std::isnan(order))
        {
          // They go on, but at a pace that no mesh or step lasts for.
          constexpr double pace = 1e-4, lasts = 50.;
          const double last = std::max(std::abs(values[n - 3] - values[n - 2]),
                                       std::abs(values[n - 2] - values[n - 1]));
          return last <= pace * std::abs(values[n - 1]) ? lasts * last :
                                                          infinite;
        }
      // More values than three would show the order, if there is one.
      const double q =
        n == 3 && is_one_sided ? std::min(std::max(order / 2., 0.5), 1.) : 0.5;
      double result = 0.;
      for (std::size_t j = n < 3 ? 0 : n - 3; j + 1 < n; ++j)
        {
          if (!(sizes[j] > sizes[n - 1]))
            return infinite;
          result = std::max(result,
                            std::abs(values[j] - values[n - 1]) /
                              (std::pow(sizes[j] / sizes[n - 1], q) - 1.));
        }
      return result;
    }

    // Digits that a value has at all.
    ReferenceValue with_round_off(ReferenceValue reference)
    {
      reference.uncertainty =
        std::max(reference.uncertainty,
                 16. * std::numeric_limits<double>::epsilon() *
                   std::abs(reference.value));
      return reference;
    }
  } // namespace



  Extrapolation richardson(const std::vector<double> &sizes,
                           const std::vector<double> &values)
  {
    const std::size_t   n    = values.size();
    const Extrapolation none = {no_value, no_value};
    if (n < 3 || sizes.size() != n)
      return none;
    const double h1 = sizes[n - 3], h2 = sizes[n - 2], h3 = sizes[n - 1];
    const double d1 = values[n - 3] - values[n - 2];
    const double d2 = values[n - 2] - values[n - 1];
    if (!(h1 > h2 && h2 > h3 && h3 > 0.) || !(d1 * d2 > 0.))
      return none;

    // In units of h3 the ratio of the differences grows with the order.
    const double x1 = h1 / h3, x2 = h2 / h3;
    const auto   excess = [&](const double p) {
      return (std::pow(x1, p) - std::pow(x2, p)) / (std::pow(x2, p) - 1.) -
             d1 / d2;
    };
    if (!(excess(least_order) < 0. && excess(largest_order) > 0.))
      return none;
    const double p = root_between(excess, least_order, largest_order, 45);
    return {values[n - 1] - d2 / (std::pow(x2, p) - 1.), p};
  }



  double shown_order(const std::vector<double> &sizes,
                     const std::vector<double> &values,
                     const double               highest)
  {
    constexpr double tolerance = 0.15;
    if (values.size() < 4 || sizes.size() != values.size())
      return no_value;
    const double order = richardson(sizes, values).order;
    const double order_before =
      richardson(without_last(sizes), without_last(values)).order;
    return std::abs(order - order_before) <=
                 tolerance * std::max(order, order_before) &&
               order <= highest + 1. ?
             order :
             no_value;
  }



  ReferenceValue extrapolated_reference(const std::vector<double> &sizes,
                                        const std::vector<double> &values,
                                        const double               highest)
  {
    const Extrapolation found = richardson(sizes, values);
    if (!std::isfinite(found.limit))
      return finest_reference(sizes, values, highest);
    const double correction = std::abs(found.limit - values.back());
    if (std::isnan(shown_order(sizes, values, highest)))
      return with_round_off(
        {found.limit, uncertainty_of_last(sizes, values) + correction, true});
    const double limit_before =
      richardson(without_last(sizes), without_last(values)).limit;
    return with_round_off(
      {found.limit,
       std::max(std::abs(found.limit - limit_before), correction / 2.),
       true});
  }



  ReferenceValue finest_reference(const std::vector<double> &sizes,
                                  const std::vector<double> &values,
                                  const double               highest)
  {
    if (values.empty() || sizes.size() != values.size())
      return {no_value, infinite, false};
    double uncertainty = uncertainty_of_last(sizes, values);
    if (std::isfinite(shown_order(sizes, values, highest)))
      {
        const ReferenceValue limit =
          extrapolated_reference(sizes, values, highest);
        uncertainty = std::abs(limit.value - values.back()) + limit.uncertainty;
      }
    return with_round_off({values.back(), uncertainty, false});
  }
} // namespace SlipStep
