// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_calibration_fit_h
#define slipstep_calibration_fit_h

#include <slipstep/calibration/simulator.h>

#include <chrono>
#include <limits>
#include <string>
#include <vector>

namespace SlipStep
{
  /// Where a search for the least misfit ended.
  struct FitResult
  {
    std::vector<double> scaled; ///< of all parameters, also those not searched
    double              misfit     = std::numeric_limits<double>::infinity();
    unsigned int        iterations = 0;
    bool                converged  = false;
    std::string         message; ///< why it ended
  };

  /// Find the least misfit by the method of Levenberg and Marquardt (Ceres
  /// Solver), within the bounds.
  /// @param free the parameters to be changed; the others stay
  /// @param replans how often the time steps are chosen anew at the optimum
  ///   found; with 0 they stay as planned
  /// @param deadline when the best found so far has to do, unless the search
  ///   has only just begun
  /// @throws InputError, RunError if the start cannot be simulated
  FitResult fit(Simulator                                  &simulator,
                const std::vector<double>                  &scaled_start,
                const std::vector<unsigned int>            &free,
                const unsigned int                          replans = 2,
                const std::chrono::steady_clock::time_point deadline =
                  std::chrono::steady_clock::time_point::max());

  /// All parameters, to be passed to fit().
  std::vector<unsigned int> all_parameters(const Campaign &campaign);

  /// Fit all parameters, and once more without the error of the time steps: the
  /// misfits from several starts can be compared. What could not be simulated
  /// is told in the message.
  FitResult fit_exactly(Simulator                 &simulator,
                        const Campaign            &campaign,
                        const std::vector<double> &scaled_start,
                        const std::chrono::steady_clock::time_point deadline);

  /// The start of the case, then points spread between the bounds (a Sobol
  /// sequence); of those that the law refuses others are taken instead.
  std::vector<std::vector<double>> spread_starts(const Campaign    &campaign,
                                                 const unsigned int n_starts);
} // namespace SlipStep

#endif
