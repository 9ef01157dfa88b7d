// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_experiment_rate_and_state_h
#define slipstep_experiment_rate_and_state_h

#include <slipstep/experiment/programme.h>
#include <slipstep/friction/law.h>

#include <string>
#include <vector>

namespace SlipStep
{
  /// A law as those who use rate and state read it: friction jumps by
  /// \f$a \ln(V_2/V_1)\f$ and then goes by \f$-b \ln(V_2/V_1)\f$ over slips of
  /// \f$D_c\f$. Of this law, a and b depend on the speed. The factor
  /// \f$G = 1 + b_G \ln(1 + \theta/t_0)\f$ of `ageing` or `slip_law` has the
  /// age in units of \f$t_0\f$ only, so that with friction f in steady sliding
  /// \f[ b = \frac{\partial f}{\partial \ln\theta} =
  ///         -\frac{\partial f}{\partial \ln t_0}, \qquad
  ///     a = \frac{d f}{d\ln V} + b. \f]
  /// Of a law of `overstress` and `ageing` alone, with the ratio r(V), these
  /// are \f$f\,d\ln r/d\ln V\f$ and \f$(f/G)\,b_G\,\theta / (t_0 + \theta)\f$.
  /// What other effects change with speed is in a, whether at once or not. By
  /// differences of steady states.
  struct RateAndState
  {
    double speed    = 0.; ///< [mm/s]
    double pressure = 0.; ///< [MPa]
    double friction = 0.; ///< in steady sliding
    /// The same at ten times the speed; NaN if there is none.
    double friction_faster = 0.;
    double a               = 0.;
    double b               = 0.;
    double length          = 0.; ///< D_c [mm]

    /// "rate and state at 1 mm/s, 5 MPa: a = 0.0023, b = 0.0042, ..."
    std::string in_words() const;
  };

  /// At the speeds and pressures to which a programme slides, the first few of
  /// them; none for a law that has neither `ageing` nor `slip_law`, or both.
  std::vector<RateAndState> rate_and_state(const Parameters  &parameters,
                                           const FrictionLaw &law,
                                           const Programme   &programme);
} // namespace SlipStep

#endif
