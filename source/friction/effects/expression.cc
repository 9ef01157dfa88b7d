// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/numbers.h>

#include <slipstep/friction/contact_age.h>
#include <slipstep/friction/effect.h>
#include <slipstep/utilities/formula.h>

#include <math.h> // for the next, which forgets it

#include <boost/math/interpolators/pchip.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
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



    /// Samples of a formula for a Table: at equal distances, more where a
    /// straight line between two of them is off.
    class Sampler
    {
    public:
      Sampler(std::function<double(double)> formula,
              const double                  from,
              const double                  to)
        : formula(std::move(formula))
        , from(from)
        , to(to)
      {}

      /// @return false if the formula varies too quickly for any table
      bool sample()
      {
        // Corners and jumps, not waves.
        constexpr std::size_t most_places = 20, most_intervals = 64000;
        for (std::size_t n = 1000; n <= most_intervals; n *= 4)
          if (sample(n) <= most_places)
            return true;
        return false;
      }

      std::vector<double> x, values;

    private:
      // Returns how many intervals between n + 1 samples are not straight.
      std::size_t sample(const std::size_t n)
      {
        x                  = {from};
        values             = {formula(from)};
        std::size_t n_bent = 0;
        for (std::size_t i = 1; i <= n; ++i)
          {
            const double      share = i / static_cast<double>(n);
            const double      end   = (1. - share) * from + share * to;
            const std::size_t size  = x.size();
            append(end, formula(end), 0);
            n_bent += x.size() > size + 1;
          }
        return n_bent;
      }

      // Add a sample, and others before it if need be.
      void
      append(const double end, const double value, const unsigned int depth)
      {
        constexpr double       tolerance = 3e-4, sharpest = 1e-6;
        constexpr unsigned int deepest = 60;

        // Never at the same place of a wave.
        place              = std::fmod(place + dealii::numbers::PI_2, 1.);
        const double share = 0.2 + 0.6 * place;
        const double begin = x.back(), before = values.back();
        const double middle = (1. - share) * begin + share * end;
        const double there  = formula(middle);
        const double line   = (1. - share) * before + share * value;
        const double width =
          sharpest * std::max(std::abs(begin), std::abs(end));
        if (depth < deepest && end - begin > width &&
            !(std::abs(there - line) <= tolerance * std::abs(there)))
          {
            append(middle, there, depth + 1);
            append(end, value, depth + 1);
            return;
          }
        x.push_back(end);
        values.push_back(value);
      }

      const std::function<double(double)> formula;
      const double                        from, to;
      double                              place = 0.;
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
    /// through 1001 values or more.
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
        const ParsedFormula formula = read_formula(parameters);
        const auto          value   = [&](const double x) {
          const double result = formula(x);
          if (result >= 1e-6 && result <= 1e6)
            return result;
          std::ostringstream why;
          why << "its value " << result << " at x = " << x
              << " is not between 1e-6 and 1e6";
          parameters.reject(key("Formula"), why.str());
        };
        Sampler sampler(value, from, to);
        if (!sampler.sample())
          parameters.reject(key("Formula"),
                            "it varies too quickly between From and To: more "
                            "than 64000 samples would be needed; state the "
                            "range that the tests or the programme reach");
        return Table(sampler.x, sampler.values);
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
