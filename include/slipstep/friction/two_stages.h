// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_friction_two_stages_h
#define slipstep_friction_two_stages_h

namespace SlipStep
{
  /// The scheme that integrates everything in time: the diagonally implicit
  /// Runge-Kutta method with two stages that is L-stable and of second order,
  /// Alexander (1977), SIAM J. Numer. Anal. 14, 1006; for inelastic finite
  /// elements Ellsiepen and Hartmann (2001), Int. J. Numer. Meth. Engng 51,
  /// 679.
  ///
  /// Of \f$\dot y = g(y, t)\f$ a step of length h makes two steps of backward
  /// Euler of length \f$\gamma h\f$, \f$\gamma = 1 - 1/\sqrt 2\f$,
  /// \f[ Y_1 = y_0 + \gamma h\,g(Y_1, t_0 + \gamma h), \quad
  ///     \hat y = y_0 + \frac{1-\gamma}{\gamma}(Y_1 - y_0), \quad
  ///     y_1 = \hat y + \gamma h\,g(y_1, t_0 + h). \f]
  /// The end of the step is that of an implicit stage, so flow rule, bounds and
  /// equilibrium hold there exactly. Where a rule can be integrated exactly for
  /// a constant slip rate, \f$\hat y\f$ is what it gives after
  /// \f$(1-\gamma)h\f$ with the rates of the first stage.
  ///
  /// The rates of the second stage alone, over the whole step, make the method
  /// of first order with which it is compared for its error; the difference is
  /// of the order of h^2, that of the result less.
  struct TwoStages
  {
    /// Where the first stage ends, of the step; also the length of both.
    static constexpr double gamma = 0.29289321881345247560;

    /// (1 - gamma) / gamma: where the second starts, in changes made by the
    /// first.
    static constexpr double carry = (1. - gamma) / gamma;

    /// What changes evenly, where the second stage starts.
    /// @param start of the step
    /// @param first where its first stage ended
    template <typename Value>
    static Value carried(const Value &start, const Value &first)
    {
      return start + carry * (first - start);
    }
  };
} // namespace SlipStep

#endif
