// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/numbers.h>

#include <slipstep/friction/contact_age.h>
#include <slipstep/friction/effect.h>
#include <slipstep/utilities/formula.h>

#include <math.h> // for the next, which forgets it

#include <boost/math/interpolators/pchip.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace SlipStep
{
  namespace
  {
    /// A function of one variable, sampled at equal distances, with a monotone
    /// cubic in between: smooth, and never outside its samples. Constant beyond
    /// its range.
    class Table
    {
    public:
      Table(std::vector<double> x, std::vector<double> samples)
        : from(x.front())
        , to(x.back())
        , first(samples.front())
        , last(samples.back())
        , curve(std::move(x), std::move(samples))
      {}

      /// Value and derivative.
      Rate operator()(const double x) const
      {
        if (!(x > from))
          return {first, 0.};
        if (x >= to)
          return {last, 0.};
        return {curve(x), curve.prime(x)};
      }

    private:
      double                                                 from, to;
      double                                                 first, last;
      boost::math::interpolators::pchip<std::vector<double>> curve;
    };



    const char *const section = "Friction/expression/";

    /// The age of what now touches, with the renewal length of this effect.
    const ContactMemory hold_memory = register_memory({"hold_time_s"});

    /// Where slip has brought the contact to, along the first axis.
    const ContactMemory position_memory = register_memory(
      {"position_mm", 0., -std::numeric_limits<double>::infinity()});

    /// A formula of the user's own, of one covariate x:
    /// \f[ G = g\left(\min(\max(x, x_0), x_1)\right). \f]
    /// x is the logarithm log10 of the slip rate [mm/s], the pressure [MPa],
    /// the slip path [mm], the position along the first axis, where slip has
    /// brought the contact since it was first loaded [mm], the hold time as the
    /// age of the contact with renewal length \f$D_c\f$ [s], the temperature
    /// rise at the beginning of the step [degC] or the angle of slip [deg]. The
    /// formula is sampled when it is read; the law uses a monotone cubic
    /// through 1001 values.
    class Expression : public StrengthEffect
    {
    public:
      Expression(const Parameters &parameters, const CoefficientBasis &)
        : covariate(parameters.text(key("Covariate")))
        , D_c(parameters.number(key("Renewal length")))
        , temperature(contact_memory("temperature_rise_degC"))
        , table(read_table(parameters))
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
            std::abs(table(180.).value - table(-180.).value) > 1e-9)
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
        Strength factor;
        if (covariate == "log10 speed")
          {
            const double speed = std::max(step.slip_rate(), 1e-300);
            const Rate   rate  = table(std::log10(speed));
            factor.value       = rate.value;
            factor.d_rate = rate.derivative / (dealii::numbers::LN10 * speed);
          }
        else if (covariate == "angle")
          {
            const dealii::Tensor<1, 2> &m     = step.direction;
            const double                scale = 180. / dealii::numbers::PI;
            const Rate rate       = table(scale * std::atan2(m[1], m[0]));
            factor.value          = rate.value;
            factor.d_direction[0] = -scale * rate.derivative * m[1];
            factor.d_direction[1] = scale * rate.derivative * m[0];
          }
        else if (covariate == "pressure")
          {
            const Rate rate = table(step.normal_traction);
            factor.value    = rate.value;
            factor.d_normal = rate.derivative;
          }
        else if (covariate == "path")
          {
            const Rate rate = table(step.start.slip_path + step.path);
            factor.value    = rate.value;
            factor.d_path   = rate.derivative;
          }
        else if (covariate == "position")
          {
            const Rate rate       = table(position(step));
            factor.value          = rate.value;
            factor.d_path         = rate.derivative * step.direction[0];
            factor.d_direction[0] = rate.derivative * step.path;
          }
        else if (covariate == "temperature")
          factor.value = table(step.start[temperature]).value;
        else
          {
            const Rate x    = hold_time(step);
            const Rate rate = table(x.value);
            factor.value    = rate.value;
            factor.d_slip   = rate.derivative * x.derivative;
          }
        return factor;
      }

      virtual void remember(const SlipStepData &step,
                            ContactState       &end) const override
      {
        if (covariate == "hold time")
          end[hold_memory] =
            step.normal_traction > 0. ? hold_time(step).value : 0.;
        if (covariate == "position")
          end[position_memory] = position(step);
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

      static Table read_table(const Parameters &parameters)
      {
        const double from = parameters.number(key("From"));
        const double to   = parameters.number(key("To"));
        if (!(from < to))
          parameters.reject(key("To"), "must be greater than From");
        std::vector<double> xs(1001), samples(xs.size());
        const ParsedFormula formula = read_formula(parameters);
        for (unsigned int i = 0; i < samples.size(); ++i)
          {
            const double share = i / (samples.size() - 1.);
            const double x     = (1. - share) * from + share * to;
            xs[i]              = x;
            samples[i]         = formula(x);
            if (samples[i] >= 1e-6 && samples[i] <= 1e6)
              continue;
            std::ostringstream why;
            why << "its value " << samples[i] << " at x = " << x
                << " is not between 1e-6 and 1e6";
            parameters.reject(key("Formula"), why.str());
          }
        return Table(xs, samples);
      }

      static double position(const SlipStepData &step)
      {
        return step.start[position_memory] + step.path * step.direction[0];
      }

      Rate hold_time(const SlipStepData &step) const
      {
        return contact_age_after(step.start[hold_memory], step, D_c);
      }

      const std::string covariate;
      const double      D_c;
      // Of effect heating.
      const ContactMemory temperature;
      const Table         table;
    };

    const RegisterEffect expression_registration =
      register_effect<Expression>();
  } // namespace
} // namespace SlipStep
