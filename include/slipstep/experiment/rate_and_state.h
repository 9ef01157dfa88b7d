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
  /// \f$D_c\f$. Of this law, a and b depend on the speed: with friction f in
  /// steady sliding, the ratio r(V) of `overstress` or `perzyna`, and the
  /// factor \f$G = 1 + b_G \ln(1 + \theta/t_0)\f$ of `ageing` or `slip_law`,
  /// \f$\theta = D_c/V\f$,
  /// \f[ a = f\,\frac{d\ln r}{d\ln V}, \qquad
  ///     b = f\,\frac{d\ln G}{d\ln\theta} =
  ///         \frac{f}{G}\,\frac{b_G\,\theta}{t_0 + \theta}. \f]
  struct RateAndState
  {
    double speed    = 0.; ///< [mm/s]
    double pressure = 0.; ///< [MPa]
    double friction = 0.; ///< in steady sliding
    double a        = 0.;
    double b        = 0.;
    double length   = 0.; ///< D_c [mm]

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
