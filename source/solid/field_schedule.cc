// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/solid/field_schedule.h>

#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/nearest_name.h>
#include <slipstep/utilities/pattern_words.h>
#include <slipstep/utilities/units.h>

#include <cmath>
#include <sstream>

namespace SlipStep
{
  namespace
  {
    const std::string fields_key = "Output/Fields";

    const char *const allowed =
      "allowed are 'none', 'end', 'statements', 'every 1 mm', 'every 0.1 s' and "
      "'every 50 steps'";

    /// Whether a multiple of the interval lies in (before, after]. Steps end at
    /// the borders of statements but for round-off.
    bool
    is_reached(const double before, const double after, const double interval)
    {
      const auto count = [interval](const double x) {
        return std::floor(x / interval * (1. + 1e-12) + 1e-9);
      };
      return count(after) > count(before);
    }

    /// NaN if the text is no quantity of this dimension, unit included.
    double read(const std::string &text, const Dimension dimension)
    {
      try
        {
          return parse_quantity(text, dimension, true);
        }
      catch (const InputError &)
        {
          return std::nan("");
        }
    }

    /// "50 steps" or "1 step"; NaN if it is not.
    double read_steps(const std::string &text)
    {
      std::istringstream in(text);
      std::string        number, word, rest;
      in >> number >> word >> rest;
      const bool is_count =
        !number.empty() && number.size() < 10 &&
        number.find_first_not_of("0123456789") == std::string::npos;
      return is_count && (word == "steps" || word == "step") && rest.empty() ?
               std::stod(number) :
               std::nan("");
    }
  } // namespace



  void FieldSchedule::declare_parameters(Parameters &parameters)
  {
    parameters.declare(
      fields_key,
      "statements",
      AnythingWithWords(
        {"none", "end", "statements", "every", "steps", "step"}),
      "When volume and contact-face fields are written for ParaView: 'none' "
      "(never), 'end', 'statements' (at the end of every statement of the "
      "programme), or 'every <length>' of the path of the drive, 'every "
      "<time>', 'every <number> steps', e.g. 'every 1 mm', 'every 0.1 s', "
      "'every 50 steps'. Steps are not shortened for this: fields that fall "
      "due are written at the end of the step that gets there. The last step "
      "is always written, except with 'none'.");
  }



  FieldSchedule::FieldSchedule(const Parameters &parameters)
  {
    const std::string  text = parameters.text(fields_key);
    std::istringstream words(text);
    std::string        first, rest;
    words >> first;
    std::getline(words >> std::ws, rest);
    if (rest.empty() && first == "none")
      kind = Kind::none;
    else if (rest.empty() && first == "end")
      kind = Kind::end;
    else if (rest.empty() && first == "statements")
      kind = Kind::statements;
    else if (first == "every")
      {
        for (const auto &form :
             {std::make_pair(Kind::distance, read(rest, Dimension::length)),
              std::make_pair(Kind::time, read(rest, Dimension::time)),
              std::make_pair(Kind::steps, read_steps(rest))})
          if (!std::isnan(form.second))
            {
              kind     = form.first;
              interval = form.second;
            }
        if (!(interval > 0.) || std::isinf(interval))
          parameters.reject(fields_key,
                            "after 'every' comes a length, a time or a number "
                            "of steps above 0, with its unit; " +
                              std::string(allowed));
      }
    else
      parameters.reject(fields_key,
                        std::string(allowed) +
                          did_you_mean(first,
                                       {"none", "end", "statements", "every"}));
  }



  bool FieldSchedule::is_due(const FinishedStep &step) const
  {
    if (kind == Kind::none || step.is_last)
      return kind != Kind::none;
    switch (kind)
      {
        case Kind::statements:
          return step.is_statement;
        case Kind::distance:
          return is_reached(step.start_path, step.path, interval);
        case Kind::time:
          return is_reached(step.start_time, step.time, interval);
        case Kind::steps:
          return is_reached(step.number - 1., step.number, interval);
        default:
          return false;
      }
  }
} // namespace SlipStep
