// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/synthetic_tests/hidden_effects.h>
#include <slipstep/synthetic_tests/start_model.h>

#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/text.h>

namespace SlipStep
{
  namespace Planting
  {
    namespace
    {
      double to_three_digits(const double value)
      {
        return std::stod(rounded_text(value, 3));
      }

      /// 10 to 40 % more or less.
      double error_factor(Random &random)
      {
        const double share = uniform(random, 0.1, 0.4);
        return either_sign(random) > 0. ? 1. + share : 1. - share;
      }
    } // namespace



    TrueContact draw_base(Random &random)
    {
      TrueContact contact;
      contact.stiffness = to_three_digits(log_uniform(random, 500., 3000.));
      contact.subloading_rate = to_three_digits(log_uniform(random, 50., 500.));
      contact.flow.viscosity =
        to_three_digits(log_uniform(random, 100., 2000.));
      contact.flow.exponent   = to_three_digits(uniform(random, 13., 22.));
      CoefficientRule &rule   = contact.coefficient;
      rule.static_coefficient = to_three_digits(uniform(random, 0.115, 0.145));
      rule.kinetic_coefficient =
        to_three_digits(rule.static_coefficient * uniform(random, 0.72, 0.85));
      rule.steepness = to_three_digits(log_uniform(random, 1., 20.));
      // 95 % of the fall take three times this length [mm].
      rule.rate =
        to_three_digits(1. / (rule.steepness * log_uniform(random, 0.5, 6.)));
      return contact;
    }



    std::vector<TruthParameter> base_parameters(const TrueContact &contact)
    {
      const CoefficientRule      &rule   = contact.coefficient;
      std::vector<TruthParameter> result = {
        {"Friction/Static coefficient", rule.static_coefficient, ""},
        {"Friction/Tangential stiffness", contact.stiffness, "MPa/mm"},
        {"Friction/subloading/Rate", contact.subloading_rate, "1/mm"}};
      if (rule.softening == Formula::catalogue)
        result.insert(result.end(),
                      {{"Friction/softening/Kinetic coefficient",
                        rule.kinetic_coefficient,
                        ""},
                       {"Friction/softening/Rate", rule.rate, "1/mm"},
                       {"Friction/softening/Steepness", rule.steepness, ""}});
      const FlowRule &flow = contact.flow;
      if (flow.formula == Formula::catalogue)
        result.insert(
          result.end(),
          {{"Friction/overstress/Viscosity", flow.viscosity, "s/mm"},
           {"Friction/overstress/Exponent", flow.exponent, ""},
           {"Friction/overstress/Maximum ratio", flow.maximum_ratio, ""}});
      return result;
    }



    namespace
    {
      /// A key that is to be fitted or held.
      struct Key
      {
        std::string path;
        double      value;
        std::string bounds; ///< "" = held
      };

      std::string bounds_around(const double value, const double factor)
      {
        return "from " + rounded_text(value / factor, 2) + " to " +
               rounded_text(value * factor, 2) + " log";
      }

      // Static and kinetic coefficient are wrong by the same share.
      std::vector<Key> wrong_keys(const TrueContact &contact,
                                  const bool         has_overstress,
                                  const bool         has_softening,
                                  Random            &random)
      {
        constexpr double middle_speed = 0.2; // [mm/s]

        const CoefficientRule &rule = contact.coefficient;
        const FlowRule        &flow = contact.flow;
        const double           level =
          error_factor(random) *
          (has_overstress ? 1. : flow.steady_ratio(middle_speed));
        const std::string coefficient_bounds = "from 0.02 to 0.5";
        const double      u    = error_factor(random) * contact.subloading_rate;
        std::vector<Key>  keys = {
           {"Friction/Static coefficient",
            level * (has_softening ? rule.static_coefficient :
                                     rule.kinetic_coefficient),
            coefficient_bounds},
           {"Friction/Tangential stiffness", contact.stiffness, ""},
           {"Friction/subloading/Rate", u, bounds_around(u, 30.)}};
        if (has_softening)
          {
            const double rate = error_factor(random) * rule.rate;
            keys.insert(
              keys.end(),
              {{"Friction/softening/Kinetic coefficient",
                level * rule.kinetic_coefficient,
                coefficient_bounds},
               {"Friction/softening/Rate", rate, bounds_around(rate, 30.)},
               {"Friction/softening/Steepness", rule.steepness, ""}});
          }
        if (has_overstress)
          keys.insert(
            keys.end(),
            {{"Friction/overstress/Viscosity",
              error_factor(random) * flow.viscosity,
              "from 1 to 1e6 log"},
             {"Friction/overstress/Exponent",
              error_factor(random) * flow.exponent,
              "from 4 to 80"},
             {"Friction/overstress/Maximum ratio", flow.maximum_ratio, ""}});
        return keys;
      }
    } // namespace



    std::string start_model(const TrueContact              &contact,
                            const std::vector<std::string> &hidden,
                            Random                         &random)
    {
      const bool has_overstress = !holds(hidden, "overstress");
      const bool has_softening  = !holds(hidden, "softening");

      std::string text =
        "# The model to start from: parameters that are not well set, and "
        "perhaps an\n# effect missing. 'slipstep plant' made the tests.\n"
        "set Loading/Programme = press 5.8 MPa in 1 s; slide 0.2 mm/s for 20 "
        "mm\n\nset Friction/Effects = subloading";
      text += std::string(has_overstress ? ", overstress" : "") +
              (has_softening ? ", softening" : "") + '\n';
      std::string list;
      for (const Key &key :
           wrong_keys(contact, has_overstress, has_softening, random))
        {
          text += "set " + key.path + " = " + rounded_text(key.value, 3) + '\n';
          if (!key.bounds.empty())
            list += (list.empty() ? "" : "; \\\n                 ") + key.path +
                    ' ' + key.bounds;
        }
      return text +
             "\nsubsection Calibration\n  set Tests      = measured\n"
             "  set Parameters = " +
             list + "\nend\n";
    }
  } // namespace Planting
} // namespace SlipStep
