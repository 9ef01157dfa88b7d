// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/utilities.h>

#include <slipstep/calibration/derived.h>
#include <slipstep/calibration/fit_parameter.h>
#include <slipstep/utilities/formula.h>
#include <slipstep/utilities/text.h>

#include <cmath>
#include <limits>

namespace SlipStep
{
  namespace
  {
    const char *const key = "Calibration/Derived";

    [[noreturn]] void reject(const Derived     &derived,
                             const Parameters  &parameters,
                             const std::string &why)
    {
      throw InputError(parameters.origin(key) + ": \"" + derived.name + " = " +
                       derived.formula + "\": " + why);
    }



    void check_number(const std::string &path,
                      const Derived     &derived,
                      const Parameters  &parameters)
    {
      parameters.check_path(path, parameters.origin(key));
      if (dynamic_cast<const Quantity *>(
            parameters.entry(path).pattern.get()) == nullptr)
        reject(derived, parameters, path + " is not a number");
    }



    // With numbers in place of {paths}.
    std::string with_numbers(const Derived    &derived,
                             const Parameters &parameters)
    {
      std::string text;
      for (std::size_t at = 0; at < derived.formula.size();)
        {
          const std::size_t open = derived.formula.find('{', at);
          text += derived.formula.substr(at, open - at);
          if (open == std::string::npos)
            break;
          const std::size_t close = derived.formula.find('}', open);
          if (close == std::string::npos)
            reject(derived, parameters, "a } is missing");
          const std::string path = dealii::Utilities::trim(
            derived.formula.substr(open + 1, close - open - 1));
          check_number(path, derived, parameters);
          text += '(' + short_text(parameters.number(path), 17) + ')';
          at = close + 1;
        }
      return text;
    }
  } // namespace



  double evaluate(const Derived &derived, const Parameters &parameters)
  {
    const std::string text  = with_numbers(derived, parameters);
    double            value = std::numeric_limits<double>::quiet_NaN();
    try
      {
        // First as it is written, for a mark at the right place.
        check_formula(derived.formula);
        value = ParsedFormula(text)();
      }
    catch (const InputError &error)
      {
        reject(derived, parameters, error.what());
      }
    if (!std::isfinite(value))
      reject(derived, parameters, "the value is not finite");
    return value;
  }



  std::vector<Derived> read_derived(const Parameters &parameters)
  {
    std::vector<Derived> result;
    for (const std::string &text :
         dealii::Utilities::split_string_list(parameters.text(key), ";"))
      {
        if (text.empty())
          continue;
        const std::size_t sign = text.find('=');
        if (sign == std::string::npos ||
            dealii::Utilities::trim(text.substr(0, sign)).empty())
          throw InputError(parameters.origin(key) + ": \"" + text +
                           "\": write it as: name = formula");
        Derived derived;
        derived.name    = dealii::Utilities::trim(text.substr(0, sign));
        derived.formula = dealii::Utilities::trim(text.substr(sign + 1));
        derived.is_tie  = derived.name.find('/') != std::string::npos;
        if (derived.is_tie)
          check_number(derived.name, derived, parameters);
        for (const Derived &other : result)
          if (other.name == derived.name)
            reject(derived, parameters, "this name is given twice");
        evaluate(derived, parameters);
        result.push_back(derived);
      }
    // Ties are applied one after the other.
    for (std::size_t i = 0; i < result.size(); ++i)
      for (std::size_t j = i; j < result.size() && result[i].is_tie; ++j)
        if (result[j].is_tie &&
            result[i].formula.find(result[j].name + "}") != std::string::npos)
          reject(result[i],
                 parameters,
                 i == j ? "a key cannot be tied to itself" :
                          result[j].name + " is tied only later in the list");
    return result;
  }



  void apply_ties(const std::vector<Derived> &derived, Parameters &parameters)
  {
    for (const Derived &tie : derived)
      if (tie.is_tie)
        parameters.set(
          tie.name,
          quantity_text(parameters, tie.name, evaluate(tie, parameters), 17),
          parameters.origin(key));
  }
} // namespace SlipStep
