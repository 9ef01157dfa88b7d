// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/effect.h>
#include <slipstep/friction/formula_variable.h>
#include <slipstep/friction/sampled_function.h>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  namespace
  {

    /// A formula of the user's own, of one variable x (formula_variable.h). It
    /// is sampled when it is read; the law uses a monotone cubic through 1001
    /// values or more.
    class Expression : public StrengthEffect
    {
    public:
      static EffectInfo info()
      {
        std::string names, words;
        for (const FormulaVariable &x : formula_variables())
          {
            names += (names.empty() ? "" : "|") + x.name;
            words += (words.empty() ? "what x is: '" : ", '") + x.name + "' " +
                     x.words;
          }
        EffectInfo info;
        info.name    = "expression";
        info.words   = "a correction by a formula, cause unknown";
        info.formula = "G = formula of one covariate x, From <= x <= To";
        info.latex   = R"(G = g\left(\min(\max(x, x_0), x_1)\right))";
        info.source  = "chosen; hold time as in Dieterich (1979), J. Geophys. "
                       "Res. 84, 2161";
        info.parameters = {
          {{"Covariate", "", "log10 speed", one_of(names)}, words},
          {{"Formula", "g", "1", dealii::Patterns::Anything()},
           "factor as a formula of x, as muParser reads it: + - * / ^ exp ln "
           "log10 sqrt tanh min max, a ? b : c; decimals begin with a point; "
           "between 1e-6 and 1e6 over the range"},
          {{"From", "x_0", "-3", Quantity(Dimension::number)},
           "least x of the formula, in the unit of the covariate; below, G "
           "stays"},
          {{"To", "x_1", "2", Quantity(Dimension::number)},
           "largest x of the formula, greater than From; above, G stays"},
          {{"Renewal length", "D_c", "0.01", positive(Dimension::length)},
           "slip after which the hold time is forgotten; for that covariate "
           "only"}};
        info.neutral_settings = {{"Formula", "1"}};
        info.typical_settings = {{"Covariate", "hold time"},
                                 {"Formula", "1 + 0.3 * tanh(x / 5)"},
                                 {"From", "0"},
                                 {"To", "100"},
                                 {"Renewal length", "0.002 mm"}};
        info.check            = SampledFunction::check_section;
        info.is_sudden        = true;
        info.heeds_position   = [](const EffectSection &section) {
          return section.text("Covariate") == "position";
        };
        info.search.why_not =
          "it is what describes a gap for which no effect has a name";
        return info;
      }

      Expression(const EffectSection &section, const CoefficientBasis &)
        : StrengthEffect(variable_called(section.text("Covariate")).memories)
        , x(variable_called(section.text("Covariate")))
        , D_c(section.number("Renewal length"))
        , g(SampledFunction::of_section(section))
      {
        const std::vector<std::string> effects =
          section.all.list("Friction/Effects");
        if (!x.of_effect.empty() &&
            std::find(effects.begin(), effects.end(), x.of_effect) ==
              effects.end())
          section.reject("Covariate",
                         "the " + x.name + " comes from effect '" +
                           x.of_effect + "': add it to Friction/Effects");
        // What was set has to have an effect.
        const std::string key = "Renewal length";
        if (x.name != "hold time" &&
            section.text(key) !=
              section.all.entry(section.path + key).default_value)
          section.reject(key, "it is used with Covariate = hold time only");
        if (x.name == "angle" &&
            std::abs(g(180.).value - g(-180.).value) > 1e-9)
          section.reject("Formula",
                         "at -180 and 180 deg, the same direction, it must "
                         "have the same value");
      }

      virtual bool depends_on_rate() const override
      {
        return x.name == "log10 speed";
      }

      virtual Strength strength_factor(const SlipStepData &step) const override
      {
        Strength   factor = x.value(step, D_c);
        const Rate rate   = g(factor.value);
        factor.value      = rate.value;
        for (double *derivative :
             {&factor.d_slip, &factor.d_normal, &factor.d_rate, &factor.d_path})
          *derivative *= rate.derivative;
        factor.d_direction *= rate.derivative;
        factor.d_way *= rate.derivative;
        return factor;
      }

      // Of what slip and load go through from one end of a step to the other.
      virtual double hidden_change(const ContactState &start,
                                   const ContactState &end) const override
      {
        return x.reached ? g.excursion(x.reached(start), x.reached(end)) : 0.;
      }

      virtual void remember(const SlipStepData &step,
                            ContactState       &end) const override
      {
        for (const ContactMemory &memory : memories())
          end[memory] = x.value(step, D_c).value;
      }

    private:
      static const FormulaVariable &variable_called(const std::string &name)
      {
        const auto &all = formula_variables();
        return *std::find_if(all.begin(), all.end(), [&](const auto &x) {
          return x.name == name;
        });
      }

      const FormulaVariable &x;
      const double           D_c;
      const SampledFunction  g;
    };

    const RegisterEffect expression_registration =
      register_effect<Expression>();
  } // namespace
} // namespace SlipStep
