#ifndef slipstep_experiment_convergence_h
#define slipstep_experiment_convergence_h

#include <vector>

namespace SlipStep
{
  /// What a sequence of values tends to.
  struct Extrapolation
  {
    double limit = 0.; ///< NaN if the values do not tend to anything
    double order = 0.; ///< p of the error C h^p, NaN then
  };

  /// Richardson extrapolation: limit, C and order p of value = limit + C h^p
  /// from the last three pairs (h, value), whatever the ratios of the sizes h.
  ///
  /// The values must approach the limit from one side, with differences that
  /// fall as fast as orders above 0.1 make them; other triples tell nothing.
  /// @param sizes of mesh or step, falling, in any unit
  Extrapolation richardson(const std::vector<double> &sizes,
                           const std::vector<double> &values);

  /// Order p of errors C h^p between two members of a sequence; NaN if
  /// undefined.
  double observed_order(const double error_1,
                        const double error_2,
                        const double h_1,
                        const double h_2);
} // namespace SlipStep

#endif
