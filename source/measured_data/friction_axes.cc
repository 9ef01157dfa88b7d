// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/measured_data/friction_axes.h>
#include <slipstep/measured_data/test_rows.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace SlipStep
{
  std::vector<double> FrictionAxis::of(const std::vector<double> &x,
                                       const std::vector<double> &y) const
  {
    std::vector<double> result(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
      result[i] = of(x[i], y.empty() ? 0. : y[i]);
    return result;
  }



  namespace
  {
    // Less than this share of friction is no more than digits.
    constexpr double digits = 1e-4;

    double sum_of_products(const std::vector<double> &a,
                           const std::vector<double> &b)
    {
      return std::inner_product(a.begin(), a.end(), b.begin(), 0.);
    }



    FrictionAxis axis_at(const double angle)
    {
      // Else the cosine of a right angle is not quite 0.
      if (std::abs(std::sin(angle)) < digits)
        return {1., 0., 0.};
      if (std::abs(std::cos(angle)) < digits)
        return {0., 1., 0.};
      return {std::cos(angle), std::sin(angle), 0.};
    }



    FrictionAxis across(const FrictionAxis &axis)
    {
      return {-axis.sine, axis.cosine, 0.};
    }



    /// The direction of the friction, which may turn about.
    struct Principal
    {
      FrictionAxis axis;
      double       share_across = 0.; ///< of the friction, root mean square
    };

    Principal principal_direction(const MeasuredTest &test)
    {
      const std::vector<double> &x = test.friction, &y = test.friction_y;
      const double xx = sum_of_products(x, x), yy = sum_of_products(y, y);
      const double angle =
        0.5 * std::atan2(2. * sum_of_products(x, y), xx - yy);
      Principal                 result{axis_at(angle), 0.};
      const std::vector<double> left = across(result.axis).of(x, y);
      if (xx + yy > 0.)
        result.share_across =
          std::sqrt(sum_of_products(left, left) / (xx + yy));
      return result;
    }



    double noise_along(const FrictionAxis &axis, const MeasuredTest &test)
    {
      return noise_of_friction(axis.of(test.friction, test.friction_y), test);
    }



    // Where the noise along x and y clearly hangs together, the axes along
    // which it does not (R. Gnanadesikan and J. R. Kettenring, Biometrics 28,
    // 1972: variances of sums and differences, by a robust estimate).
    FrictionAxis independent_axis(const MeasuredTest &test,
                                  const Principal    &principal)
    {
      constexpr double clearly = 0.5, many_deviations = 6., alike = 0.01,
                       near = 0.1;

      const FrictionAxis x;
      const double       of_x = noise_along(x, test);
      const double       of_y = noise_along(across(x), test);
      if (std::min(of_x, of_y) <= digits * typical_friction(test))
        return x;
      const auto of_sum = [&](const double sign) {
        std::vector<double> sum;
        for (std::size_t i = 0; i < test.friction.size(); ++i)
          sum.push_back(test.friction[i] / of_x +
                        sign * test.friction_y[i] / of_y);
        return std::pow(noise_level(sum), 2);
      };
      const double sum = of_sum(1.), difference = of_sum(-1.);
      const double correlation = (sum - difference) / (sum + difference);
      if (!(std::abs(correlation) >
            std::max(clearly,
                     many_deviations /
                       std::sqrt(static_cast<double>(test.friction.size())))))
        return x;
      const FrictionAxis found =
        axis_at(0.5 * std::atan2(2. * correlation * of_x * of_y,
                                 of_x * of_x - of_y * of_y));
      // Of one sensor friction itself tells the direction better.
      return principal.share_across < alike &&
                 std::abs(across(found).of(principal.axis.cosine,
                                           principal.axis.sine)) < near ?
               principal.axis :
               found;
    }
  } // namespace



  std::vector<FrictionAxis> friction_axes(const MeasuredTest &test)
  {
    std::vector<FrictionAxis> axes;
    if (test.friction_y.empty())
      axes = {{}};
    else
      {
        const Principal principal = principal_direction(test);
        if (principal.share_across < digits)
          axes = {principal.axis};
        else
          {
            axes.push_back(independent_axis(test, principal));
            axes.push_back(across(axes[0]));
          }
      }
    for (FrictionAxis &axis : axes)
      axis.noise = noise_along(axis, test);
    return axes;
  }



  double typical_friction(const MeasuredTest &rows)
  {
    double sum = 0.;
    for (std::size_t i = 0; i < rows.friction.size(); ++i)
      sum += std::pow(rows.friction[i], 2) +
             (rows.friction_y.empty() ? 0. : std::pow(rows.friction_y[i], 2));
    return std::sqrt(sum / rows.friction.size());
  }



  double mean_noise(const std::vector<FrictionAxis> &axes)
  {
    double sum = 0.;
    for (const FrictionAxis &axis : axes)
      sum += axis.noise * axis.noise;
    return std::sqrt(sum / axes.size());
  }
} // namespace SlipStep
