// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/effect.h>

#include <algorithm>

namespace SlipStep
{
  namespace
  {
    /// As which the measured test was made that leads the contact; 0 where none
    /// does, or none that says so.
    const ContactMemory test_number = register_memory({"test_number"});

    /// What changes from test to test, and not within one: a tool that wears, a
    /// machine that warms up, air that dries. G is constant before n_1 and
    /// after n_2. Measured tests say n in a comment "# order: 7".
    class RunOrder : public StrengthEffect
    {
    public:
      static EffectInfo info()
      {
        const Quantity number(Dimension::number);
        EffectInfo     info;
        info.name  = "run_order";
        info.words = "a drift from test to test, in the order in which they "
                     "were made";
        info.formula =
          "G = 1 + w (n - n_1) / (n_2 - n_1), n_1 <= n <= n_2: the test's number";
        info.latex =
          R"(G = 1 + w \frac{n - n_1}{n_2 - n_1},\quad n_1 \le n \le n_2)";
        info.source     = "chosen";
        info.parameters = {
          {{"Change", "w", "0.1", Quantity(Dimension::number, -0.99, 100.)},
           "share by which the strength has changed in the last test"},
          {{"First test", "n_1", "1", number}, "number of the first test"},
          {{"Last test", "n_2", "20", number}, "number of the last test"},
          {{"Test", "n", "20", number},
           "number of this test; measured tests that are fitted have their own "
           "if a comment '# order: 7' says so"}};
        info.test_number      = "Test";
        info.first_test       = "First test";
        info.last_test        = "Last test";
        info.neutral_settings = {{"Change", "0"}};
        info.typical_settings = {{"Change", "0.3"}, {"Test", "11"}};
        info.search = {"differs from test to test, never within one", search};
        return info;
      }

      RunOrder(const EffectSection &section, const CoefficientBasis &)
        : w(section.number("Change"))
        , first(section.number("First test"))
        , last(section.number("Last test"))
        , otherwise(section.number("Test"))
      {
        if (!(last > first))
          section.reject("Last test", "must be more than First test");
      }

      virtual Strength strength_factor(const SlipStepData &step) const override
      {
        const double known = step.start[test_number];
        const double n     = known == 0. ? otherwise : known;
        Strength     factor;
        factor.value =
          1. + w * std::clamp((n - first) / (last - first), 0., 1.);
        return factor;
      }

    private:
      static TrialFormula search(const Circumstances &now)
      {
        const TestedRange &range = now.range;
        if (range.n_orders < 3)
          return TrialFormula::none("the tests do not say in which order they "
                                    "were made ('# order: 7'), or there are "
                                    "fewer than three");
        TrialFormula formula;
        formula.set_proportional("Change", 1., -0.9, 3.);
        formula.settings = {{"First test", range.first_order},
                            {"Last test", range.last_order},
                            {"Test", range.last_order}};
        return formula;
      }

      const double w, first, last, otherwise;
    };

    const RegisterEffect run_order_registration = register_effect<RunOrder>();
  } // namespace
} // namespace SlipStep
