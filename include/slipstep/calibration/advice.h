// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_calibration_advice_h
#define slipstep_calibration_advice_h

#include <slipstep/calibration/uncertainty.h>

#include <chrono>
#include <string>
#include <vector>

namespace SlipStep
{
  /// A test that could be made.
  struct ProposedTest
  {
    std::string  words; ///< "slide at 0.01 mm/min"
    MeasuredTest motion;
    /// The same as "Loading/Programme" takes it.
    std::string programme;
    /// How far it is beyond what was tested: a factor of speed, pressure, or
    /// path.
    double reach = 1.;
  };

  /// Tests beside those of the campaign: slower, faster, longer, after a hold,
  /// under other pressures, with steps of speed and pressure, back, and in
  /// other directions.
  std::vector<ProposedTest> propose_tests(const Campaign &campaign);

  /// The combinations of parameters that the tests hardly determine (standard
  /// deviation above 0.3 in natural parameters), worst first, in words, each
  /// with the proposed test that would determine it best.
  /// @param deadline of the search for values that fit nearly as well
  std::vector<WeakDirection>
  find_weak_directions(Simulator                                  &simulator,
                       const Linearisation                        &optimum,
                       const std::chrono::steady_clock::time_point deadline);

  /// @throws InputError naming a parameter that changes nothing in the tests,
  /// wherever it is between its bounds
  void check_influence(const Campaign &campaign);
} // namespace SlipStep

#endif
