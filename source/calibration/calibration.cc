// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/calibration/calibrate.h>
#include <slipstep/calibration/derived.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace SlipStep
{
  double noise_ratio(const TestMisfit &test)
  {
    return test.noise > 0. ? test.rms / test.noise :
                             std::numeric_limits<double>::quiet_NaN();
  }



  std::vector<StartComparison> compare_starts(const Calibration &calibration)
  {
    std::vector<StartComparison> comparisons;
    for (const StartResult &start : calibration.starts)
      {
        const StartResult &best = calibration.starts.front();
        StartComparison    comparison;
        comparison.has_end = !start.end.empty() && !best.end.empty();
        for (std::size_t i = 0; comparison.has_end && i < start.end.size(); ++i)
          {
            const FitParameter &parameter = calibration.parameters[i].parameter;
            const double distance = std::abs(parameter.to_scaled(start.end[i]) -
                                             parameter.to_scaled(best.end[i]));
            if (distance > comparison.distance)
              {
                comparison.distance = distance;
                comparison.farthest = i;
              }
          }
        comparison.excess = start.misfit - best.misfit;
        // Less than what moves a single parameter by a standard deviation.
        comparison.is_equal =
          comparison.has_end &&
          comparison.excess <= std::max(calibration.inflation, 1.);
        comparison.is_same = comparison.is_equal && comparison.distance < 0.01;
        comparisons.push_back(comparison);
      }
    return comparisons;
  }



  std::vector<std::string> constraint_sentences(const Calibration &calibration)
  {
    std::map<std::string, std::string> stopped;
    std::set<std::string>              wanted;
    for (const FittedParameter &fitted : calibration.parameters)
      if (!fitted.constraint.empty())
        {
          std::string &names = stopped[fitted.constraint];
          names += (names.empty() ? "" : " and ") + label_of(fitted.parameter);
          if (fitted.is_wanted_beyond)
            wanted.insert(fitted.constraint);
        }
    std::vector<std::string> sentences;
    for (const auto &[constraint, names] : stopped)
      sentences.push_back(
        names + " stopped at a condition of the law: " + constraint +
        (wanted.count(constraint) > 0 ?
           ". The tests favour the other side of it: choose effects that "
           "allow it ('slipstep effects' lists them)." :
           ". The tests favour the other side of it, or do not need the "
           "effect."));
    return sentences;
  }



  Parameters fitted_case(const Parameters  &parameters,
                         const Calibration &calibration)
  {
    Parameters                result = parameters;
    std::vector<FitParameter> listed;
    for (const FittedParameter &fitted : calibration.parameters)
      {
        result.set(fitted.parameter.path,
                   fitted.parameter.text(fitted.value),
                   "calibration");
        listed.push_back(fitted.parameter);
      }
    apply_ties(read_derived(result), result);
    // Without the starts: they are the values now.
    result.set("Calibration/Parameters",
               statements(listed, false),
               "calibration");
    return result;
  }
} // namespace SlipStep
