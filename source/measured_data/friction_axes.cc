// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/measured_data/friction_axes.h>
#include <slipstep/measured_data/test_rows.h>
#include <slipstep/utilities/lists.h>

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



    /// Of second differences along x and y, which are noise for the most part.
    struct Covariance
    {
      double xx = 0., xy = 0., yy = 0.;

      double correlation() const
      {
        return xy / std::sqrt(xx * yy);
      }

      double angle() const
      {
        return 0.5 * std::atan2(2. * xy, xx - yy);
      }
    };

    // Without the largest, in which friction itself bends. No medians: of few
    // digits they are as coarse as these.
    Covariance covariance_of_bends(const MeasuredTest &test)
    {
      constexpr double share_left_out = 0.05;

      const std::vector<double> x = bends_of(test.friction);
      const std::vector<double> y = bends_of(test.friction_y);
      const double xx = sum_of_products(x, x), yy = sum_of_products(y, y);
      std::vector<std::size_t> rows(x.size());
      std::iota(rows.begin(), rows.end(), 0);
      const auto size = [&](const std::size_t i) {
        return x[i] * x[i] / xx + y[i] * y[i] / yy;
      };
      stable_sort(rows, [&](auto a, auto b) { return size(a) < size(b); });
      rows.resize(rows.size() - std::lround(share_left_out * rows.size()));
      Covariance result;
      for (const std::size_t i : rows)
        {
          result.xx += x[i] * x[i];
          result.xy += x[i] * y[i];
          result.yy += y[i] * y[i];
        }
      return result;
    }



    // Where the noise along x and y clearly hangs together, the axis along
    // which most of it is.
    FrictionAxis independent_axis(const MeasuredTest &test,
                                  const Principal    &principal)
    {
      constexpr double clearly = 0.5, many_deviations = 6., alike = 0.01,
                       near = 0.25;

      const FrictionAxis x;
      if (std::min(noise_along(x, test), noise_along(across(x), test)) <=
          digits * typical_friction(test))
        return x;
      const Covariance covariance = covariance_of_bends(test);
      const double     n          = test.friction.size();
      if (!(std::abs(covariance.correlation()) >
            std::max(clearly, many_deviations / std::sqrt(n))))
        return x;
      const FrictionAxis found = axis_at(covariance.angle());
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



  MeasuredTest along(const FrictionAxis &axis, const MeasuredTest &test)
  {
    MeasuredTest result = test;
    result.friction     = axis.of(test.friction, test.friction_y);
    result.displacement = axis.of(test.displacement, test.displacement_y);
    return result;
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
