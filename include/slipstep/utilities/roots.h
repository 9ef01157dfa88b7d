// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_utilities_roots_h
#define slipstep_utilities_roots_h

#include <boost/math/tools/roots.hpp>

namespace SlipStep
{
  /// The root of a function that has different signs at a and b, to so many
  /// binary digits.
  template <typename Function>
  double root_between(const Function    &function,
                      const double       a,
                      const double       b,
                      const unsigned int digits = 50)
  {
    boost::uintmax_t most_iterations = 200;
    const auto       bracket         = boost::math::tools::toms748_solve(
      function,
      a,
      b,
      boost::math::tools::eps_tolerance<double>(digits),
      most_iterations);
    return (bracket.first + bracket.second) / 2.;
  }
} // namespace SlipStep

#endif
