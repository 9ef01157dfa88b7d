// SPDX-License-Identifier: LGPL-2.1-or-later

// Campaigns of a few tests, each of its own condition.

#include <tests/diagnosis/hidden/own_records.h>

#include <slipstep/diagnosis/confounding.h>
#include <slipstep/diagnosis/look_alike.h>
#include <slipstep/utilities/lists.h>

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  class OwnRecordsOfFewTests : public OwnRecords
  {
  protected:
    static inline const std::string coulomb_contact =
      "set Calibration/Parameters = Friction/Static coefficient from 0.05 to "
      "0.6\n";

    // Friction that follows the speed at once, on the spring of the contact.
    Contact slider(const std::function<double(double)> &strength_at) const
    {
      return [this, strength_at](const double friction,
                                 const double speed,
                                 const double,
                                 const double step) {
        return std::min(strength_at(speed),
                        friction + stiffness * speed * step);
      };
    }

    struct Condition
    {
      double speed, pressure;
    };

    // Friction as log speed times a power of pressure.
    Judgement judged_two_effects(const std::vector<Condition> &conditions,
                                 const double                  power)
    {
      unsigned int number = 0;
      for (const Condition &condition : conditions)
        {
          pressure  = condition.pressure;
          stiffness = 100. / pressure;
          write(number,
                {{condition.speed, 4. / condition.speed}},
                slider([this, power](const double speed) {
                  return 0.2 * (1. + 0.02 * std::log1p(speed / 0.01)) *
                         std::pow(pressure / 2., power);
                }));
          number += 2;
        }
      return judged(
        "", "", coulomb_contact + "set Friction/Tangential stiffness = 100\n");
    }
  };
} // namespace



// One test of constant friction tells little of the rate of subloading: that a
// fit is far from where it starts is no gap.
TEST_F(OwnRecordsOfFewTests, WhatIsBelievedOfParametersIsNoGap)
{
  stiffness = 10.;
  noise     = 0.003;
  n_rows    = 300;
  write(0, {{0.02, 150.}}, slider([](double) { return 0.3; }));
  const Judgement judgement =
    judged("subloading",
           "",
           "set Friction/Tangential stiffness = 50\n"
           "set Calibration/Parameters = Friction/Static coefficient from 0.1 "
           "to 0.6; Friction/subloading/Rate from 3.8 to 3500 log");
  EXPECT_GT(judgement.gap.p, 0.1);
}



// What follows the tests most closely first may be a wrong name, beside which
// the right ones are not found: viscous and shear_cap were named for these.
TEST_F(OwnRecordsOfFewTests, TwoEffectsAreFoundFromAnotherBeginning)
{
  const Judgement judgement = judged_two_effects(
    {{0.1, 2.}, {10., 2.}, {1., 8.}, {1., 2.}, {1., 2. / 3.}}, -0.1);
  std::vector<std::string> names = effect_names(judgement.found.model.parts);
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"overstress", "pressure"}));
  EXPECT_TRUE(judgement.found.rivals.empty());
}



// The only test at the highest speed is the only one at the lowest pressure: an
// effect of one of them was named for both, though it left more than noise.
TEST_F(OwnRecordsOfFewTests, ConditionsThatChangeTogetherAreTold)
{
  random.seed(3);
  const Judgement judgement =
    judged_two_effects({{0.1, 8.}, {1., 8.}, {10., 2.}, {1., 4.}, {0.1, 4.}},
                       -0.1);
  ASSERT_EQ(judgement.found.model.parts.size(), 1u);
  ASSERT_FALSE(judgement.confounded.empty());
  EXPECT_TRUE(judgement.is_incomplete);
  EXPECT_EQ(judgement.verdict, Verdict::ambiguous);
  for (const Rival &other : judgement.confounded)
    EXPECT_TRUE(any_of(judgement.found.rivals, [&](const Rival &rival) {
      return rival.name == other.name;
    }));
  const std::string words =
    confounding_words(judgement.found.model.parts[0].name,
                      judgement.confounded);
  for (const std::string &name :
       {judgement.found.model.parts[0].name, judgement.confounded[0].name})
    EXPECT_NE(words.find(name), std::string::npos) << words;
}



// The only test at low pressure, left out, told its own size of an effect of
// pressure, which was proof of that, and against a second effect.
TEST_F(OwnRecordsOfFewTests, OneConditionDoesNotPredictItself)
{
  random.seed(2);
  const Judgement judgement =
    judged_two_effects({{0.1, 8.}, {0.3, 8.}, {1., 8.}, {3., 8.}, {10., 2.}},
                       -0.2);
  unsigned int n_found = 0;
  for (const Model &first : judgement.found.first_fits.models)
    if (first.has("pressure") || first.has("largest_pressure"))
      {
        ++n_found;
        Diagnosis told;
        describe_tests(ingested, first, told);
        for (const DiagnosedTest &test : told.tests)
          {
            EXPECT_LT(test.rms_after, 0.05);
            EXPECT_EQ(test.left_out_after > 0.15, test.condition == "4")
              << test.left_out_after;
          }
      }
  EXPECT_GT(n_found, 0u);
}



// Friction of speed and pressure by the formula of speed alone that fits best.
TEST_F(OwnRecordsOfFewTests, ANameThatHardlyPredictsIsDoubted)
{
  for (const double exponent : {-0.1, 0.})
    {
      random.seed(1);
      const Judgement judgement = judged_two_effects(
        {{0.1, 8.}, {0.3, 8.}, {1., 8.}, {3., 8.}, {10., 2.}}, exponent);
      ASSERT_EQ(judgement.verdict, Verdict::named);
      const SearchResult &found = judgement.found;
      Diagnosis           told;
      told.effects = effect_names(found.model.parts);
      describe_tests(ingested, found.model, told);
      describe_shrink(ingested, found.model, told);
      EXPECT_EQ(told.shrink.hardly_predicts(), exponent < 0.);
    }
}



// Of three speeds overstress and resonance fit anything: both were named beside
// adhesion for friction of speed and pressure.
TEST_F(OwnRecordsOfFewTests, NoMoreNumbersThanLevelsAreAdded)
{
  const Judgement judgement =
    judged_two_effects({{0.1, 8.}, {1., 8.}, {10., 2.}, {1., 4.}, {0.1, 4.}},
                       -0.1);
  const std::vector<std::string> names =
    effect_names(judgement.found.model.parts);
  EXPECT_FALSE(names.empty());
  EXPECT_LE(names.size(), 2u);
  EXPECT_FALSE(holds(names, "resonance"));
}



// Where they change one by one, formulas do not have to tell them apart.
TEST_F(OwnRecordsOfFewTests, ConditionsThatChangeOneByOneAreNotDoubted)
{
  const Judgement judgement = judged_two_effects(
    {{0.1, 2.}, {10., 2.}, {1., 8.}, {1., 2.}, {1., 2. / 3.}}, 0.);
  EXPECT_EQ(effect_names(judgement.found.model.parts),
            std::vector<std::string>{"overstress"});
  EXPECT_EQ(judgement.verdict, Verdict::named);
  EXPECT_TRUE(judgement.confounded.empty());
}



// In a model without a rate effect friction that falls with speed at once
// cannot be tried. A state that slip renews stands for it, and is not told as
// if nothing else could.
TEST_F(OwnRecordsOfFewTests, WhatNothingHoldsIsNotForgotten)
{
  random.seed(5);
  stiffness           = 50.;
  unsigned int number = 0;
  for (const double speed : {0.05, 0.5, 2., 5.})
    {
      write(number, {{speed, 4. / speed}}, slider([](const double speed) {
              return 0.2 * (1. + 0.2 * std::exp(-speed / 0.5));
            }));
      number += 2;
    }
  const Judgement judgement =
    judged("",
           "",
           coulomb_contact + "set Friction/Tangential stiffness = 250\n");
  Diagnosis told;
  told.effects = effect_names(judgement.found.model.parts);
  describe_what_nothing_holds(*ingested.workspace,
                              judgement.view,
                              judgement.found.model,
                              told);
  ASSERT_EQ(told.effects.size(), 1u);
  ASSERT_EQ(told.warnings.size(), 1u);
  EXPECT_NE(told.warnings[0].find(told.effects[0] + " may stand for stribeck"),
            std::string::npos)
    << told.warnings[0];
  const std::vector<CandidateResult> results =
    candidate_results(*ingested.workspace, judgement, {}, judgement.base);
  const auto stribeck =
    std::find_if(results.begin(), results.end(), [](const auto &result) {
      return result.name == "stribeck";
    });
  ASSERT_NE(stribeck, results.end());
  EXPECT_EQ(stribeck->standing, Standing::not_simulated);
}



// By the formula of ageing it is the same law: healing was a rival of ageing,
// and a rest was proposed that would tell them apart by 0.04 deviations.
TEST_F(OwnRecordsOfFewTests, HealingByTheFormulaOfAgeingIsNoRival)
{
  const std::vector<std::vector<Slide>> conditions = {
    {{0.1, 20.}, {0., 100.}, {0.1, 20.}},
    {{1., 2.}, {0., 100.}, {1., 2.}},
    {{10., 0.2}, {0., 1000.}, {10., 0.2}},
    {{1., 2.}, {0., 10.}, {1., 2.}}};
  random.seed(2);
  stiffness = 50.;
  for (unsigned int i = 0; i < conditions.size(); ++i)
    write(2 * i,
          conditions[i],
          [this, rest = 0., peak = 0.](const double friction,
                                       const double speed,
                                       const double,
                                       const double step) mutable {
            const double trial    = friction + stiffness * speed * step;
            const auto   strength = [&](const double slip) {
              return 0.2 * (1. + 0.03 * std::log1p(slip / step / 0.01)) *
                     (1. + peak);
            };
            double lower = 0., upper = std::max(0., trial / stiffness);
            for (unsigned int n = 0; n < 40; ++n)
              {
                const double slip = (lower + upper) / 2.;
                (trial - stiffness * slip > strength(slip) ? lower : upper) =
                  slip;
              }
            if (speed == 0.)
              peak = 0.03 * std::log1p(rest += step);
            else
              peak *= std::exp(-lower / 0.1);
            return trial - stiffness * lower;
          });
  const Judgement judgement =
    judged("",
           "",
           coulomb_contact + "set Friction/Tangential stiffness = 250\n");
  std::vector<std::string> names = effect_names(judgement.found.model.parts);
  EXPECT_TRUE(holds(names, "overstress"));
  for (const Rival &rival : judgement.found.rivals)
    names.push_back(rival.name);
  EXPECT_EQ(std::count(names.begin(), names.end(), "ageing") +
              std::count(names.begin(), names.end(), "healing"),
            1);
}



// The larger a spike was, the more rows after it were taken for as far off, so
// that something was missing in one of 0.15 and nothing in one of 0.1; and one
// in each replicate made 2.8 % of friction noise, of which 1.2 % is.
TEST_F(OwnRecordsOfFewTests, SpikesOfAnySizeAreNoGap)
{
  for (const double size : {0.1, -0.3, 0.5})
    {
      spike = size;
      for (unsigned int number = 0; number < 6; ++number)
        write(number, {{0.2, 20.}}, slider([](double) { return 0.2; }));
      const Judgement judgement =
        judged("",
               "",
               coulomb_contact + "set Friction/Tangential stiffness = 100\n");
      EXPECT_EQ(judgement.verdict, Verdict::no_gap) << size;
      // And of a thousand rows some by chance.
      EXPECT_GE(judgement.outlying.size(), 3u * 6u) << size;
      EXPECT_LE(judgement.outlying.size(), 3u * 6u + 3u) << size;
      // Replicates tell the noise of the other rows.
      const Noise &found = ingested.workspace->noise.noise;
      EXPECT_LT(std::hypot(found.drift, found.gain), 0.02) << size;
    }
}



// A truth of nothing has no place in a range of positive values: it was not
// found, and the gap had no name.
TEST_F(OwnRecordsOfFewTests, AHeldNumberThatShouldBeNothingIsTold)
{
  unsigned int number = 0;
  for (const double of_test : {1., 2., 4., 8.})
    {
      pressure  = of_test;
      stiffness = 100. / pressure;
      write(number, {{1., 4.}}, slider([](double) { return 0.2; }));
      number += 2;
    }
  const Judgement judgement =
    judged("pressure",
           "set Friction/pressure/Exponent = 0.2\n",
           coulomb_contact + "set Friction/Tangential stiffness = 100\n");
  EXPECT_LE(judgement.gap.p, ingested.workspace->level);
  const std::optional<LookAlike> found = find_look_alike(*ingested.workspace,
                                                         judgement.base,
                                                         judgement.found.model,
                                                         judgement.gap.excess);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->path, "Friction/pressure/Exponent");
  EXPECT_NEAR(found->value, 0., 0.02);
}
