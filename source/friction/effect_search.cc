// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/effect_search.h>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  bool Circumstances::has(const std::string &effect) const
  {
    const std::vector<std::string> list = parameters.list("Friction/Effects");
    return std::find(list.begin(), list.end(), effect) != list.end();
  }



  TrialFormula TrialFormula::none(const std::string &why_not)
  {
    TrialFormula formula;
    formula.why_not = why_not;
    return formula;
  }



  void TrialFormula::set_proportional(const std::string &path,
                                      const double       unit,
                                      const double       lower,
                                      const double       upper)
  {
    // A start within the bounds.
    const double margin = 0.03 * (upper - lower);
    const double least  = lower < 0. ? lower + margin : 0.;
    parameters          = {{path, lower, upper, false}};
    shapes              = {[=](const double strength) {
      return Values{
        {path,
         std::clamp(just_noticed * strength * unit, least, upper - margin)}};
    }};
  }



  std::vector<double>
  ladder(const double a, const double b, const unsigned int n)
  {
    std::vector<double> values;
    for (unsigned int i = 0; i < n; ++i)
      values.push_back(n == 1 ? std::sqrt(a * b) :
                                a * std::pow(b / a, i / (n - 1.)));
    return values;
  }
} // namespace SlipStep
