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



  TrialFormula::Form TrialFormula::in_form(const std::string &name,
                                           const Form        &formula)
  {
    return [name, formula](const Circumstances &now) {
      TrialFormula result = formula(now);
      if (result.why_not.empty())
        result.texts = {{"Form", name}};
      return result;
    };
  }



  namespace
  {
    TrialFormula state_of_contacts_in(const TestedRange &range,
                                      const std::string &length,
                                      const std::string &first)
    {
      const double path    = range.longest_path;
      const double fastest = range.fastest, slowest = range.slowest;
      if (!(fastest > 1.5 * slowest) || !(path > 0.))
        return TrialFormula::none("the speed hardly varies");
      const double ages = std::log(fastest / slowest);
      TrialFormula formula;
      formula.is_one_sided = true;
      // With an old state that falls to one which hardly depends on the speed
      // it would be softening: at the slowest the state is always felt.
      const bool   is_young = first.empty();
      const double shortest = (is_young ? 1e-5 : 3e-4) * path;
      formula.parameters    = {{"Growth", 0., 1., false},
                               {"Time",
                                1e-6 * path / fastest,
                                (is_young ? path : shortest) / slowest,
                                true,
                                true,
                                is_young},
                               {length, shortest, 0.3 * path, true}};
      if (!is_young)
        {
          formula.n_assumed = 2;
          formula.parameters.push_back(
            {first,
             1e-6 * path / fastest,
             std::max(1e9, 10. * path / slowest), // [s], 30 years
             true,
             true,
             false});
        }
      // Younger than contacts are at the fastest: its share of the age is felt
      // everywhere.
      for (const double L : ladder(3e-3 * path, 0.1 * path, 4))
        {
          Values others = {{"Time", 0.1 * L / fastest}, {length, L}};
          if (!is_young)
            others[first] = 1e3 * L / slowest;
          formula.add_shape("Growth", 1e-6, 0.9, others, ages);
        }
      return formula;
    }
  } // namespace



  TrialFormula::Form TrialFormula::state_of_contacts(const std::string &length,
                                                     const std::string &first)
  {
    return [=](const Circumstances &now) {
      return !first.empty() && now.number("Calibration/Lead-in") > 0. ?
               none("the contacts slide before the tests begin") :
               state_of_contacts_in(now.range, length, first);
    };
  }



  void TrialFormula::add_shape(const std::string &path,
                               const double       lower,
                               const double       upper,
                               const Values      &others,
                               const double       felt)
  {
    shapes.push_back([=](const double strength) {
      Values values = others;
      values[path]  = std::clamp(just_noticed * strength / felt, lower, upper);
      return values;
    });
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



  void EffectSearch::complete_paths(const std::string &section)
  {
    const auto whole = [section](const std::string &path) {
      return path.find('/') == std::string::npos ? section + path : path;
    };
    const auto all_whole = [whole](const auto &of_keys) {
      auto of_paths = of_keys;
      of_paths.clear();
      for (const auto &[key, value] : of_keys)
        of_paths[whole(key)] = value;
      return of_paths;
    };
    const auto complete = [=](Form &form) {
      if (form)
        form = [=, relative = form](const Circumstances &now) {
          TrialFormula result = relative(now);
          for (CandidateParameter &parameter : result.parameters)
            parameter.path = whole(parameter.path);
          result.settings = all_whole(result.settings);
          result.texts    = all_whole(result.texts);
          for (TrialFormula::Shape &shape : result.shapes)
            shape = [=, of_keys = shape](const double strength) {
              return all_whole(of_keys(strength));
            };
          return result;
        };
    };
    complete(formula);
    complete(first_state);
    std::for_each(beside_formulas.begin(), beside_formulas.end(), complete);
    std::for_each(other_forms.begin(), other_forms.end(), complete);
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
