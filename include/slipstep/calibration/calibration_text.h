#ifndef slipstep_calibration_calibration_text_h
#define slipstep_calibration_calibration_text_h

#include <slipstep/calibration/calibration.h>

#include <string>
#include <vector>

namespace SlipStep
{
  /// @name What a calibration found, in the words of screen and page.
  ///@{

  /// "6 parameters from 4 tests: rms difference of friction 0.0021 ..."
  std::string calibration_headline(const Calibration &calibration);

  /// Those parameters whose interval is open, "" if there are none.
  std::string open_intervals(const Calibration &calibration);

  /// Which parameters stopped at which condition of the law, and what to do.
  std::vector<std::string> constraint_sentences(const Calibration &calibration);

  /// Pairs that the tests determine only together, apart from those that a weak
  /// direction names; "" if there are none.
  std::string close_pairs(const Calibration &calibration);

  std::string correlation_text(const double correlation);

  /// What one standard deviation along a weak direction changes:
  /// "Rate × 1.5, Amount -0.03".
  std::string change_text(const Calibration   &calibration,
                          const WeakDirection &direction);

  /// "95 % interval"
  std::string interval_name(const Calibration &calibration);

  /// Without an exponent where the number is not longer for it; "–" if it is
  /// none.
  std::string plain_text(const double value, const unsigned int n_digits);

  /// How the tables call a parameter.
  std::string label_of(const FitParameter &parameter);

  /// A value with as many digits as its uncertainty leaves meaning, without
  /// unit. @p value in base units.
  std::string digits_text(const FittedParameter &fitted, const double value);

  /// "0.041 … 0.049"; "≥ 0.041", "≤ 0.049" or "open" where it reaches a bound,
  /// "–" at a constraint.
  std::string interval_text(const FittedParameter &fitted);

  /// "± 0.002", or "×/÷ 1.05" on a logarithmic scale.
  std::string deviation_text(const FittedParameter &fitted);
  std::string deviation_text(const DerivedQuantity &quantity);
  ///@}

  /// Difference over noise, NaN without noise.
  double noise_ratio(const TestMisfit &test);

  /// Where a start of the search ended, seen from where the best one did.
  struct StartComparison
  {
    double      excess   = 0.; ///< of chi^2
    double      distance = 0.; ///< largest, of the range between the bounds
    std::size_t farthest = 0;  ///< the parameter with this distance
    bool        has_end  = false;
    bool        is_same  = false; ///< the same optimum
    bool        is_equal = false; ///< as good, in the same place or not
  };

  /// For every start, the best one first.
  std::vector<StartComparison> compare_starts(const Calibration &calibration);
} // namespace SlipStep

#endif
