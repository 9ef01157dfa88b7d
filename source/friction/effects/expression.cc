// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/numbers.h>

#include <slipstep/friction/contact_age.h>
#include <slipstep/friction/effect.h>
#include <slipstep/friction/sampled_function.h>
#include <slipstep/utilities/formula.h>
#include <slipstep/utilities/text.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace SlipStep
{
  namespace
  {
    const char *const section = "Friction/expression/";

    /// The age of what now touches, with the renewal length of this effect.
    const ContactMemory hold_memory = register_memory({"hold_time_s"});

    /// Where the contact has got to over the plane, along the first axis.
    const ContactMemory position_memory = register_memory(
      {"position_mm", 0., -std::numeric_limits<double>::infinity()});

    /// A formula of the user's own, of one covariate x:
    /// \f[ G = g\left(\min(\max(x, x_0), x_1)\right). \f]
    /// x is the logarithm log10 of the slip rate [mm/s], the pressure [MPa],
    /// the slip path [mm], the position along the first axis, where the contact
    /// has got to over the plane, or its block while it is off it [mm], the
    /// hold time as the
    /// age of the contact with renewal length \f$D_c\f$ [s], the temperature
    /// rise at the beginning of the step [degC] or the angle of slip [deg]. The
    /// formula is sampled when it is read; the law uses a monotone cubic
    /// through 1001 values or more.
    class Expression : public StrengthEffect
    {
    public:
      Expression(const Parameters &parameters, const CoefficientBasis &)
        : covariate(parameters.text(key("Covariate")))
        , x(covariate_called(covariate))
        , D_c(parameters.number(key("Renewal length")))
        , temperature_memory(contact_memory("temperature_rise_degC"))
        , g(sampled_formula(parameters))
      {
        const std::vector<std::string> effects =
          parameters.list("Friction/Effects");
        if (covariate == "temperature" &&
            std::find(effects.begin(), effects.end(), "heating") ==
              effects.end())
          parameters.reject(key("Covariate"),
                            "the temperature comes from effect 'heating': add "
                            "it to Friction/Effects");
        // What was set has to have an effect.
        if (covariate != "hold time" &&
            parameters.text(key("Renewal length")) !=
              parameters.entry(key("Renewal length")).default_value)
          parameters.reject(key("Renewal length"),
                            "it is used with Covariate = hold time only");
        if (covariate == "angle" &&
            std::abs(g(180.).value - g(-180.).value) > 1e-9)
          parameters.reject(key("Formula"),
                            "at -180 and 180 deg, the same direction, it must "
                            "have the same value");
      }

      virtual bool depends_on_rate() const override
      {
        return covariate == "log10 speed";
      }

      virtual Strength strength_factor(const SlipStepData &step) const override
      {
        Strength   factor = (this->*x)(step);
        const Rate rate   = g(factor.value);
        factor.value      = rate.value;
        for (double *derivative :
             {&factor.d_slip, &factor.d_normal, &factor.d_rate, &factor.d_path})
          *derivative *= rate.derivative;
        factor.d_direction *= rate.derivative;
        return factor;
      }

      // Of what slip and load go through from one end of a step to the other.
      virtual double hidden_change(const ContactState &start,
                                   const ContactState &end) const override
      {
        return covariate == "path" ?
                 g.excursion(start.slip_path, end.slip_path) :
               covariate == "position" ?
                 g.excursion(start[position_memory], end[position_memory]) :
               covariate == "pressure" ?
                 g.excursion(start.normal_traction, end.normal_traction) :
                 0.;
      }

      virtual void remember(const SlipStepData &step,
                            ContactState       &end) const override
      {
        if (covariate == "hold time")
          end[hold_memory] =
            step.normal_traction > 0. ? hold_time(step).value : 0.;
        if (covariate == "position")
          end[position_memory] = step.start[position_memory] + step.way()[0];
      }

      virtual std::vector<ContactMemory> memories() const override
      {
        if (covariate == "hold time")
          return {hold_memory};
        if (covariate == "position")
          return {position_memory};
        return {};
      }

      static EffectInfo info()
      {
        EffectInfo info;
        info.name    = "expression";
        info.words   = "a correction by a formula, cause unknown";
        info.formula = "G = formula of one covariate x, From <= x <= To";
        info.latex   = "G = g\\left(\\min(\\max(x, x_0), x_1)\\right)";
        info.source  = "chosen; hold time as in Dieterich (1979), J. Geophys. "
                       "Res. 84, 2161";
        info.neutral = "Formula = 1";
        info.parameters = {
          {"Covariate",
           "",
           "log10 speed",
           dealii::Patterns::Selection(
             "log10 speed|pressure|path|position|hold time|temperature|angle"),
           "what x is: 'log10 speed' of the slip rate in mm/s, 'pressure' in "
           "MPa, slip 'path' in mm, 'position' along the first axis in mm, from "
           "where the contact was first loaded, 'hold time' in s, 'temperature' rise in "
           "degC (needs effect heating) or 'angle' of slip in deg"},
          {"Formula",
           "g",
           "1",
           dealii::Patterns::Anything(),
           "factor as a formula of x, as muParser reads it: + - * / ^ exp ln "
           "log10 sqrt tanh min max, a ? b : c; decimals begin with a point; "
           "between 1e-6 and 1e6 over the range"},
          {"From",
           "x_0",
           "-3",
           Quantity(Dimension::number),
           "least x of the formula, in the unit of the covariate; below, G "
           "stays"},
          {"To",
           "x_1",
           "2",
           Quantity(Dimension::number),
           "largest x of the formula, greater than From; above, G stays"},
          {"Renewal length",
           "D_c",
           "0.01",
           Quantity(Dimension::length, 0., 1e30, true),
           "slip after which the hold time is forgotten; for that covariate "
           "only"}};
        info.neutral_settings = {{"Formula", "1"}};
        info.typical_settings = {{"Covariate", "hold time"},
                                 {"Formula", "1 + 0.3 * tanh(x / 5)"},
                                 {"From", "0"},
                                 {"To", "100"},
                                 {"Renewal length", "0.002 mm"}};
        info.check            = check;
        info.search           = {};
        info.search.why_not =
          "it is what describes a gap for which no effect has a name";
        return info;
      }

    private:
      static std::string key(const std::string &name)
      {
        return section + name;
      }

      static ParsedFormula read_formula(const Parameters &parameters)
      {
        try
          {
            return ParsedFormula(parameters.text(key("Formula")), "x");
          }
        catch (const InputError &error)
          {
            parameters.reject(key("Formula"), error.what());
          }
      }

      // The value at x, if it is allowed.
      static std::function<double(double)>
      checked_formula(const Parameters &parameters)
      {
        const ParsedFormula formula = read_formula(parameters);
        return [&parameters, formula](const double x) {
          const double result = formula(x);
          if (result >= 1e-6 && result <= 1e6)
            return result;
          std::ostringstream why;
          why << "its value " << result << " at x = " << x
              << " is not between 1e-6 and 1e6";
          parameters.reject(key("Formula"), why.str());
        };
      }

      // What is narrower than the distance of samples.
      static void check(const Parameters &parameters)
      {
        const std::optional<double> missed =
          sampled_formula(parameters).missed(checked_formula(parameters));
        if (missed.has_value())
          parameters.reject(key("Formula"),
                            "it changes within much less than From to To, near "
                            "x = " +
                              rounded_text(*missed, 6) +
                              "; state the range that the tests or the "
                              "programme reach");
      }

      static SampledFunction sampled_formula(const Parameters &parameters)
      {
        const double from = parameters.number(key("From"));
        const double to   = parameters.number(key("To"));
        if (!(from < to))
          parameters.reject(key("To"), "must be greater than From");
        const auto sampled =
          SampledFunction::of(checked_formula(parameters), from, to);
        if (!sampled.has_value())
          parameters.reject(key("Formula"),
                            "it varies too quickly between From and To: more "
                            "than 64000 samples would be needed; state the "
                            "range that the tests or the programme reach");
        return *sampled;
      }

      // The covariates and their derivatives.

      Strength log_speed(const SlipStepData &step) const
      {
        const double speed = std::max(step.slip_rate(), 1e-300);
        Strength     x;
        x.value  = std::log10(speed);
        x.d_rate = 1. / (dealii::numbers::LN10 * speed);
        return x;
      }

      Strength pressure(const SlipStepData &step) const
      {
        return {step.normal_traction, 0., 1., {}};
      }

      Strength path(const SlipStepData &step) const
      {
        Strength x;
        x.value  = step.start.slip_path + step.path;
        x.d_path = 1.;
        return x;
      }

      Strength position(const SlipStepData &step) const
      {
        Strength x;
        x.value          = step.start[position_memory] + step.way()[0];
        x.d_path         = step.direction[0];
        x.d_direction[0] = step.path;
        return x;
      }

      Strength hold_time(const SlipStepData &step) const
      {
        const Rate age = contact_age_after(step.start[hold_memory], step, D_c);
        return {age.value, age.derivative, 0., {}};
      }

      // At the beginning of the step.
      Strength temperature(const SlipStepData &step) const
      {
        return {step.start[temperature_memory], 0., 0., {}};
      }

      Strength angle(const SlipStepData &step) const
      {
        constexpr double            degrees = 180. / dealii::numbers::PI;
        const dealii::Tensor<1, 2> &e       = step.direction;
        Strength                    x;
        x.value          = degrees * std::atan2(e[1], e[0]);
        x.d_direction[0] = -degrees * e[1];
        x.d_direction[1] = degrees * e[0];
        return x;
      }

      using Covariate = Strength (Expression::*)(const SlipStepData &) const;

      static Covariate covariate_called(const std::string &name)
      {
        return name == "log10 speed" ? &Expression::log_speed :
               name == "pressure"    ? &Expression::pressure :
               name == "path"        ? &Expression::path :
               name == "position"    ? &Expression::position :
               name == "hold time"   ? &Expression::hold_time :
               name == "temperature" ? &Expression::temperature :
                                       &Expression::angle;
      }

      const std::string covariate;
      const Covariate   x;
      const double      D_c;
      // Of effect heating.
      const ContactMemory   temperature_memory;
      const SampledFunction g;
    };

    const RegisterEffect expression_registration =
      register_effect<Expression>();
  } // namespace
} // namespace SlipStep
