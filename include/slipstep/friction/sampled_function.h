// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_friction_sampled_function_h
#define slipstep_friction_sampled_function_h

#include <slipstep/friction/effect.h>

#include <math.h> // for the next, which forgets it

#include <boost/math/interpolators/pchip.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace SlipStep
{
  /// A function of one variable as samples with a monotone cubic in between:
  /// smooth, and never outside its samples. Constant beyond its range.
  class SampledFunction
  {
  public:
    /// Samples at equal distances, more where a straight line between two of
    /// them is off.
    /// @return nothing if the function varies too quickly for 64000 of them
    static std::optional<SampledFunction>
    of(const std::function<double(double)> &function,
       const double                         from,
       const double                         to);

    /// A place where the function is not what its samples make of it, if it
    /// changes between two of them; looked for at many more.
    std::optional<double>
    missed(const std::function<double(double)> &function) const;

    /// Value and derivative.
    Rate operator()(const double x) const
    {
      if (!(x > places.front()))
        return {values.front(), 0.};
      if (x >= places.back())
        return {values.back(), 0.};
      return {curve(x), curve.prime(x)};
    }

    /// By how much the function, which is positive, leaves between two places
    /// what it is at both, as a share of that.
    double excursion(const double a, const double b) const;

    /// The key Formula of a section, of x between its keys From and To, with
    /// values between 1e-6 and 1e6.
    /// @throws InputError
    static SampledFunction of_section(const EffectSection &section);

    /// Whether the samples of that have missed something narrow.
    /// @throws InputError
    static void check_section(const EffectSection &section);

  private:
    SampledFunction(std::vector<double> x, std::vector<double> samples);

    std::vector<double>                                    places, values;
    boost::math::interpolators::pchip<std::vector<double>> curve;
  };
} // namespace SlipStep

#endif
