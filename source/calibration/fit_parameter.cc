// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/utilities.h>

#include <slipstep/calibration/fit_parameter.h>
#include <slipstep/friction/law.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/text.h>

#include <boost/algorithm/string/predicate.hpp>
#include <boost/algorithm/string/trim.hpp>

#include <cmath>

namespace SlipStep
{
  namespace
  {
    const char *const list_key      = "Calibration/Parameters";
    const char *const stiffness_key = "Loading/Machine stiffness";

    std::string last_part(const std::string &path, const unsigned int n_parts)
    {
      std::size_t at = path.size();
      for (unsigned int n = 0; n < n_parts && at != std::string::npos; ++n)
        at = path.rfind('/', at - 1);
      return at == std::string::npos ? path : path.substr(at + 1);
    }

    /// "PATH from A to B [start C] [log|linear]"
    class Statement
    {
    public:
      Statement(const std::string &text, const Parameters &parameters);

      FitParameter read();

      /// Of a text that is but a path.
      FitParameter of(const double lower,
                      const double upper,
                      const double start,
                      const bool   is_logarithmic);

    private:
      [[noreturn]] void reject(const std::string &why) const;

      std::string take(const std::string &separator);

      void read_dimension();

      double quantity(const std::string &text, const std::string &role) const;

      const std::string text;
      const Parameters &parameters;
      std::string       rest;
      FitParameter      result;
      bool              unit_required = false;
    };



    Statement::Statement(const std::string &text, const Parameters &parameters)
      : text(text)
      , parameters(parameters)
      , rest(text)
    {}



    void Statement::reject(const std::string &why) const
    {
      throw InputError(parameters.origin(list_key) + ": \"" + text +
                       "\": " + why);
    }



    // What follows the last separator, taken off the rest; "" without one.
    std::string Statement::take(const std::string &separator)
    {
      const std::size_t at = rest.rfind(separator);
      if (at == std::string::npos)
        return "";
      const std::string taken =
        dealii::Utilities::trim(rest.substr(at + separator.size()));
      rest = dealii::Utilities::trim(rest.substr(0, at));
      return taken;
    }



    // A contact point knows the friction law and the machine only.
    void Statement::read_dimension()
    {
      parameters.check_path(result.path, parameters.origin(list_key));
      if (result.path == stiffness_key)
        {
          result.dimension = Dimension::stiffness;
          return;
        }
      if (result.path.compare(0, 9, "Friction/") != 0 &&
          result.path.compare(0, 16, "Loading/Machine ") != 0)
        reject("it has no meaning for a contact point; allowed are the keys of "
               "Friction and the machine of Loading");
      const auto *quantity = dynamic_cast<const Quantity *>(
        parameters.entry(result.path).pattern.get());
      if (quantity == nullptr)
        reject("it is not a number, and a fit can change numbers only");
      result.dimension = quantity->dimension;
      unit_required    = quantity->unit_required;
    }



    double Statement::quantity(const std::string &value,
                               const std::string &role) const
    {
      try
        {
          parameters.check(result.path, value, "");
          return parse_quantity(value, result.dimension, unit_required);
        }
      catch (const InputError &)
        {
          const std::string hint = decimal_comma_hint(value);
          reject(
            role + " = " + value + ": " + hint + (hint.empty() ? "" : "; ") +
            "allowed is " +
            parameters.entry(result.path)
              .pattern->description(dealii::Patterns::PatternBase::Machine));
        }
    }



    FitParameter Statement::read()
    {
      // At the end, or before the start.
      std::string scale;
      const auto  take_scale = [&](std::string &text) {
        for (const std::string word : {"log", "linear"})
          if (boost::algorithm::iends_with(text, " " + word))
            {
              if (!scale.empty())
                reject("one scale: log or linear");
              scale = word;
              text  = boost::algorithm::trim_copy(
                text.substr(0, text.size() - word.size()));
            }
      };
      take_scale(rest);
      const std::string start = take(" start ");
      std::string       upper = take(" to ");
      take_scale(upper);
      const std::string lower = take(" from ");
      if (lower.empty() || upper.empty())
        reject("write it as: path from A to B [start C] [log|linear]");
      result.path = rest;
      read_dimension();
      for (const std::string &section :
           FrictionLaw(parameters).inactive_sections())
        if (result.path.compare(0, section.size() + 1, section + "/") == 0)
          reject("this effect is off: add it to Friction/Effects");

      result.lower = quantity(lower, "from");
      result.upper = quantity(upper, "to");
      if (!(result.lower < result.upper))
        reject("the lower bound " + lower + " must be less than the upper one");
      result.is_logarithmic =
        scale == "log" || (scale.empty() && result.lower > 0. &&
                           result.upper >= 10. * result.lower);
      if (result.is_logarithmic && !(result.lower > 0.))
        reject("a logarithmic scale needs a lower bound greater than 0");

      const std::string start_text =
        start.empty() ? parameters.text(result.path) : start;
      if (start.empty() && result.path == stiffness_key &&
          start_text == "rigid")
        reject("the case says 'rigid': give a start, as in \"start 50 "
               "MPa/mm\"");
      result.start = quantity(start_text, "start");
      if (result.start < result.lower || result.start > result.upper)
        {
          const std::string outside = " is outside of the bounds";
          if (!start.empty())
            reject("the start " + start_text + outside);
          reject("the start " + start_text +
                 (parameters.is_set(result.path) ?
                    " (" + parameters.origin(result.path) + ")" :
                    " that this parameter has by default") +
                 outside + ": give one, as in \"start " +
                 result.text(0.5 * (result.lower + result.upper)) + "\"");
        }
      return result;
    }



    FitParameter Statement::of(const double lower,
                               const double upper,
                               const double start,
                               const bool   is_logarithmic)
    {
      result.path = text;
      read_dimension();
      result.lower          = quantity(result.text(lower), "from");
      result.upper          = quantity(result.text(upper), "to");
      result.start          = quantity(result.text(start), "start");
      result.is_logarithmic = is_logarithmic;
      if (!(result.lower < result.upper) || result.start < result.lower ||
          result.start > result.upper)
        reject("the start has to lie between the bounds");
      return result;
    }
  } // namespace



  double FitParameter::to_scaled(const double value) const
  {
    return is_logarithmic ? std::log(value / lower) / std::log(upper / lower) :
                            (value - lower) / (upper - lower);
  }



  double FitParameter::from_scaled(const double scaled) const
  {
    // The bounds themselves to the last bit: next to them a value may be
    // refused.
    if (scaled <= 0.)
      return lower;
    if (scaled >= 1.)
      return upper;
    return is_logarithmic ? lower * std::pow(upper / lower, scaled) :
                            lower + scaled * (upper - lower);
  }



  double FitParameter::value_in(const Parameters &parameters) const
  {
    return parse_quantity(parameters.text(path), dimension);
  }



  std::string FitParameter::unit() const
  {
    return base_unit(dimension);
  }



  double FitParameter::in_unit(const double value) const
  {
    return value / parse_quantity("1", dimension);
  }



  std::string FitParameter::text(const double value, const int n_digits) const
  {
    const std::string name_of_unit = unit();
    return short_text(in_unit(value), n_digits) +
           (name_of_unit.empty() ? "" : " ") + name_of_unit;
  }



  void name_apart(std::vector<FitParameter> &parameters)
  {
    for (FitParameter &parameter : parameters)
      for (unsigned int n_parts = 1; n_parts < 4; ++n_parts)
        {
          parameter.name = last_part(parameter.path, n_parts);
          if (count_if(parameters, [&](const FitParameter &other) {
                return last_part(other.path, n_parts) == parameter.name;
              }) == 1)
            break;
        }
  }



  FitParameter make_fit_parameter(const Parameters  &parameters,
                                  const std::string &path,
                                  const double       lower,
                                  const double       upper,
                                  const double       start,
                                  const bool         is_logarithmic)
  {
    return Statement(path, parameters).of(lower, upper, start, is_logarithmic);
  }



  std::vector<FitParameter> read_fit_parameters(const Parameters &parameters)
  {
    std::vector<FitParameter> result;
    for (const std::string &text :
         dealii::Utilities::split_string_list(parameters.text(list_key), ";"))
      {
        if (text.empty())
          continue;
        result.push_back(Statement(text, parameters).read());
        for (std::size_t i = 0; i + 1 < result.size(); ++i)
          if (result[i].path == result.back().path)
            throw InputError(parameters.origin(list_key) + ": " +
                             result.back().path + " is listed twice");
      }
    if (result.empty())
      parameters.reject(list_key,
                        "name at least one parameter, as in "
                        "\"Friction/softening/Rate from 0.01 to 1\"");
    name_apart(result);
    return result;
  }



  std::string statements(const std::vector<FitParameter> &parameters,
                         const bool                       with_starts)
  {
    std::string list;
    for (const FitParameter &parameter : parameters)
      list += (list.empty() ? "" : "; ") + parameter.path + " from " +
              parameter.text(parameter.lower) + " to " +
              parameter.text(parameter.upper) +
              (with_starts ? " start " + parameter.text(parameter.start) : "") +
              (parameter.is_logarithmic ? " log" : " linear");
    return list;
  }



  std::string quantity_text(const Parameters  &parameters,
                            const std::string &path,
                            const double       value,
                            const int          n_digits)
  {
    FitParameter parameter;
    if (const auto *quantity =
          dynamic_cast<const Quantity *>(parameters.entry(path).pattern.get()))
      parameter.dimension = quantity->dimension;
    else
      parameter.dimension = Dimension::stiffness;
    return parameter.text(value, n_digits);
  }



  std::string label_of(const FitParameter &parameter)
  {
    return parameter.name.empty() ? parameter.path : parameter.name;
  }
} // namespace SlipStep
