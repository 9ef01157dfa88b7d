#include <slipstep/experiment/convergence.h>

#include <boost/math/tools/roots.hpp>

#include <cmath>
#include <limits>

namespace SlipStep
{
  namespace
  {
    constexpr double undefined   = std::numeric_limits<double>::quiet_NaN();
    constexpr double least_order = 0.1, largest_order = 20.;
  } // namespace



  Extrapolation richardson(const std::vector<double> &sizes,
                           const std::vector<double> &values)
  {
    const std::size_t   n    = values.size();
    const Extrapolation none = {undefined, undefined};
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
    std::uintmax_t n_iterations = 200;
    const auto     bracket      = boost::math::tools::toms748_solve(
      excess,
      least_order,
      largest_order,
      boost::math::tools::eps_tolerance<double>(45),
      n_iterations);
    const double p = (bracket.first + bracket.second) / 2.;
    return {values[n - 1] - d2 / (std::pow(x2, p) - 1.), p};
  }



  double observed_order(const double error_1,
                        const double error_2,
                        const double h_1,
                        const double h_2)
  {
    const double order =
      std::log(std::abs(error_1 / error_2)) / std::log(h_1 / h_2);
    return std::isfinite(order) ? order : undefined;
  }
} // namespace SlipStep
