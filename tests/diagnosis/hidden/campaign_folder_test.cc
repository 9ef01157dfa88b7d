// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/free_factor.h>
#include <slipstep/diagnosis/localisation.h>
#include <slipstep/diagnosis/look_alike.h>

#include <tests/diagnosis/hidden/changed_records.h>
#include <tests/diagnosis/hidden/trial.h>

#include <gtest/gtest.h>

#include <deal.II/base/utilities.h>

#include <fstream>
#include <functional>
#include <optional>
#include <random>
#include <regex>
#include <set>
#include <sstream>

using namespace SlipStep;
using Planting::CampaignClass;
using namespace SlipStep::Testing;

namespace
{
  /// The files of a campaign in a folder, to be spoilt.
  class CampaignFolder : public testing::Test
  {
  protected:
    void plant(const CampaignClass campaign_class,
               const unsigned int  seed,
               const std::string  &effect    = "",
               const double        amplitude = 0.)
    {
      Planting::CampaignOptions options;
      options.campaign_class = campaign_class;
      options.seed           = seed;
      if (!effect.empty())
        options.effects = {effect};
      options.amplitude = amplitude;
      campaign          = Planting::plant_campaign(options);
      parameters = Testing::planted_case(campaign, folder.path() / "campaign");
    }

    void add_noise_of_sensors()
    {
      std::mt19937_64            random(1);
      std::normal_distribution<> normal;
      rewrite([&](const std::string &text) {
        return with_noise_of_sensors(
          5e-4, 0.003, [&]() { return normal(random); }, text);
      });
    }

    template <class Change>
    void rewrite(const Change &change)
    {
      rewrite(
        [](const unsigned int i) {
          return "test_" + std::to_string(100 + i) + ".csv";
        },
        change);
    }

    std::optional<LookAlike> look_alike(const Judgement &judgement)
    {
      return find_look_alike(*ingested.workspace,
                             judgement.base,
                             judgement.found.model,
                             judgement.gap.excess);
    }

    // Calls change(text of the file) for every test and stores the result
    // under another name.
    template <class Change>
    void rewrite(const std::function<std::string(unsigned int)> &name,
                 const Change                                   &change)
    {
      const auto measured = folder.path() / "campaign" / "measured";
      std::vector<std::filesystem::path> files;
      for (const auto &entry : std::filesystem::directory_iterator(measured))
        files.push_back(entry.path());
      std::sort(files.begin(), files.end());
      std::vector<std::string> texts;
      for (const auto &file : files)
        {
          std::ifstream     in(file);
          std::stringstream text;
          text << in.rdbuf();
          texts.push_back(change(text.str()));
          std::filesystem::remove(file);
        }
      for (unsigned int i = 0; i < texts.size(); ++i)
        std::ofstream(measured / name(i)) << texts[i];
    }

    Judgement judged()
    {
      ingested = ingest(parameters, {});
      return judge(*ingested.workspace, ingested.base);
    }

    TemporaryFolder           folder;
    Planting::PlantedCampaign campaign;
    Parameters                parameters;
    Ingested                  ingested;
  };
} // namespace



// An effect is no zero of the sensor, and where it is felt there are the tests
// that are told with it.
TEST_F(CampaignFolder, KnowsWhereAnEffectIsFelt)
{
  plant(CampaignClass::one, 7);
  const Judgement judgement = judged();
  ASSERT_EQ(effect_names(judgement.found.model.parts),
            std::vector<std::string>{"overstress"});
  const Workspace &workspace = *ingested.workspace;
  EXPECT_FALSE(look_alike(judgement).has_value());
  unsigned int n_told = 0;
  for (const Localisation &place :
       localise(workspace, judgement.base, judgement.gap))
    if (place.covariate == "speed" || place.covariate == "path")
      for (const std::string &name : place.tests)
        {
          std::size_t t = 0;
          while (workspace.tests[t].rows.name != name)
            ++t;
          const ComparedTest    &test = workspace.comparison.tests[t];
          const Eigen::VectorXd &x =
            workspace.covariates.*covariate_called(place.covariate).values;
          bool is_there = false;
          for (Eigen::Index i = test.begin; i < test.begin + test.size; ++i)
            is_there = is_there || (x(i) >= place.from && x(i) <= place.to);
          EXPECT_TRUE(is_there) << place.covariate << ' ' << name;
          ++n_told;
        }
  EXPECT_GT(n_told, 0u);
}



TEST_F(CampaignFolder, HasTheSameVerdictRenamedShuffledAndInOtherUnits)
{
  plant(CampaignClass::one, 7);
  const Judgement before = judged();
  ASSERT_EQ(before.verdict, Verdict::named);
  rewrite(
    [](const unsigned int i) {
      return "record_" + std::to_string((7 * i + 3) % 20 + 100) + ".csv";
    },
    [](const std::string &text) {
      return in_other_units(
        std::regex_replace(text, std::regex("# name: [^\n]*\n"), ""));
    });
  const Judgement after = judged();
  EXPECT_EQ(name_of(after.verdict), name_of(before.verdict));
  ASSERT_EQ(after.found.model.parts.size(), 1u);
  EXPECT_EQ(after.found.model.parts[0].name, before.found.model.parts[0].name);
  EXPECT_NEAR(after.gap.p, before.gap.p, 1e-12);
  EXPECT_NEAR(after.found.model.objective, before.found.model.objective, 0.2);
}



// A replicate that is off by itself is no missing effect, whichever of two it
// is and whichever way.
TEST_F(CampaignFolder, NamesAnOutlierAndNoEffect)
{
  plant(CampaignClass::none, 4);
  std::map<std::string, std::vector<std::string>> twins;
  for (const Planting::PlantedTest &test : campaign.tests)
    if (test.measured.friction_y.empty())
      twins[test.measured.condition].push_back(test.measured.name);
  std::vector<std::string> pair;
  for (const auto &one : twins)
    if (one.second.size() == 2)
      pair = one.second;
  ASSERT_EQ(pair.size(), 2u);
  unsigned int n = 0;
  for (const std::string &spoilt : pair)
    for (const double factor : {1.12, 0.9})
      {
        std::filesystem::remove_all(folder.path() / "campaign");
        plant(CampaignClass::none, 4);
        rewrite(
          [](const unsigned int i) {
            return "t" + std::to_string(i + 10) + ".csv";
          },
          [&](const std::string &text) {
            return text.find("# name: " + spoilt + "\n") == std::string::npos ?
                     text :
                     with_friction_times(factor, text);
          });
        // The whole verdict once.
        if (n++ == 0)
          EXPECT_EQ(name_of(judged().verdict), "no_gap");
        else
          ingested = ingest(parameters, {});
        ASSERT_EQ(ingested.outliers.size(), 1u) << spoilt << ' ' << factor;
        EXPECT_EQ(ingested.outliers[0].test, spoilt) << factor;
      }
}



// Rate and steepness of healing go together; neither is believed to be near the
// guess that the search begins with.
TEST(HiddenStrength, OfHealingIsInsideItsInterval)
{
  Planting::CampaignOptions options;
  options.campaign_class = CampaignClass::one;
  options.seed           = 62;
  const Trial trial      = Testing::run_trial(options, true);
  ASSERT_EQ(trial.named, std::vector<std::string>{"healing"});
  EXPECT_EQ(trial.n_intervals, 1u);
  EXPECT_EQ(trial.n_inside, 1u);
}



// Half a per cent of friction in waves of 1.04 mm, of which no other statistic
// sees enough for an alarm.
TEST_F(CampaignFolder, WaveAlongTheTrackIsTold)
{
  plant(CampaignClass::outside, 115);
  const Judgement judgement = judged();
  EXPECT_EQ(name_of(judgement.verdict), "named");
  EXPECT_EQ(effect_names(judgement.found.model.parts),
            std::vector<std::string>{"texture"});
  EXPECT_LE(judgement.gap.p_track, 0.002);
  // As seen without the candidate that has the length of the wave.
  Workspace &workspace       = *ingested.workspace;
  workspace.range.track_wave = 0.;
  const GapTest gap          = test_gap(workspace,
                               ingested.base,
                               score_candidates(workspace, ingested.base));
  EXPECT_GT(gap.p_smooth, 5. * gap.p_track);
  for (const double other : {gap.p_together, gap.p_replicates})
    EXPECT_GT(9. * other, workspace.level);
  const std::vector<Localisation> where =
    localise(*ingested.workspace, ingested.base, judgement.gap);
  ASSERT_FALSE(where.empty());
  EXPECT_EQ(where[0].covariate, "position");
  EXPECT_NEAR(where[0].wavelength, 1.0418, 0.005);
}



// An interval for which there is no time is that of the curvature, close to the
// profile's where the tests tell much.
TEST_F(CampaignFolder, IntervalsEndInTime)
{
  plant(CampaignClass::one, 9);
  const Judgement judgement = judged();
  ASSERT_EQ(judgement.verdict, Verdict::named);
  Workspace  hasty    = *ingested.workspace;
  const auto interval = [&](const Workspace &workspace) {
    for (const DiagnosedParameter &parameter :
         find_intervals(workspace, judgement.found.model, 0.95))
      if (parameter.path == "Friction/healing/Steepness")
        return parameter;
    return DiagnosedParameter();
  };
  const DiagnosedParameter followed = interval(*ingested.workspace);
  hasty.comparison.deadline         = std::chrono::steady_clock::now();
  const DiagnosedParameter hurried  = interval(hasty);
  EXPECT_GT(followed.profile.size(), 4u);
  EXPECT_TRUE(hurried.profile.empty());
  EXPECT_LT(hurried.lower, hurried.value);
  EXPECT_GT(hurried.upper, hurried.value);
  EXPECT_NEAR(hurried.upper - hurried.lower,
              followed.upper - followed.lower,
              0.5 * (followed.upper - followed.lower));
}



// Oblique waves that are not round are named with their harmonics; where the
// catalogue has no such effect, they are described by the place in the wave.
TEST(HiddenStrength, OfUnevenWavesHasAName)
{
  Planting::CampaignOptions options;
  options.campaign_class = CampaignClass::outside;
  options.seed           = 4;
  options.effects        = {"uneven_texture"};
  options.amplitude      = 0.03;
  const Trial trial      = Testing::run_trial(options, false);
  EXPECT_EQ(trial.named, std::vector<std::string>{"texture"});
  EXPECT_FALSE(trial.is_incomplete);
  EXPECT_LT(trial.error_after, 0.15 * trial.error_before);
}



TEST_F(CampaignFolder, WavesWithoutANameAreDescribed)
{
  plant(CampaignClass::outside, 1, "uneven_texture", 0.03);
  parameters.set("Diagnosis/Candidates", "pressure, healing", "test");
  const Judgement judgement = judged();
  ASSERT_EQ(name_of(judgement.verdict), "unnamed");
  // Of the starting model, as the correction is.
  Workspace &workspace = *ingested.workspace;
  workspace.range.track_wave =
    clear_track_wave(workspace, judgement.base).wavelength;
  const std::optional<FreeFactor> correction =
    find_correction(workspace,
                    judgement.base,
                    judgement,
                    localise(workspace, judgement.base, judgement.gap));
  ASSERT_TRUE(correction.has_value());
  EXPECT_EQ(correction->covariate, "position");
  EXPECT_GT(correction->share, 0.75);
  EXPECT_NEAR(workspace.range.track_wave, 4.1039, 0.02);
}



// Many directions together may see no more than noise where a few do.
TEST_F(CampaignFolder, PlacesAreThereThoughNothingIsSeenOfAll)
{
  plant(CampaignClass::one, 9);
  const Judgement judgement = judged();
  GapTest         none      = judgement.gap;
  none.excess               = 0.;
  const std::vector<Localisation> where =
    localise(*ingested.workspace, judgement.base, none);
  ASSERT_FALSE(where.empty());
  for (const Localisation &place : where)
    EXPECT_EQ(place.share, 1.);
}



// What a verdict rests on is stated where it is not measured.
TEST_F(CampaignFolder, StatesTheNoiseWithoutReplicates)
{
  Planting::CampaignOptions options;
  options.campaign_class  = CampaignClass::none;
  options.seed            = 2;
  options.with_replicates = false;
  campaign                = Planting::plant_campaign(options);
  parameters = Testing::planted_case(campaign, folder.path() / "campaign");
  const Judgement judgement = judged();
  EXPECT_EQ(name_of(judgement.verdict), "no_gap");
  EXPECT_EQ(ingested.workspace->noise.n_contrasts, 0u);
  EXPECT_NEAR(ingested.workspace->noise.noise.gain,
              parameters.number("Diagnosis/Gain"),
              1e-12);
}



// Three rows in a test or two that nothing explains: the name stays, and the
// rows are told.
TEST_F(CampaignFolder, KeepsItsNameBesideAFewBadRows)
{
  plant(CampaignClass::one, 7);
  const Judgement before = judged();
  ASSERT_EQ(before.verdict, Verdict::named);
  EXPECT_TRUE(before.outlying.empty());
  unsigned int n_spoilt = 0;
  rewrite([&](const std::string &text) {
    return text.find("friction_y") == std::string::npos && n_spoilt++ < 2 ?
             with_bad_rows(text) :
             text;
  });
  const Judgement after = judged();
  EXPECT_EQ(name_of(after.verdict), name_of(Verdict::named));
  EXPECT_EQ(effect_names(after.found.model.parts),
            effect_names(before.found.model.parts));
  EXPECT_GE(after.outlying.size(), 4u);
  EXPECT_LE(after.outlying.size(), 12u);
}



// Rows that alone make a gap, whether that has got a name or not: without them
// there is none, and that is told.
TEST_F(CampaignFolder, HasNoGapThatAFewBadRowsMake)
{
  plant(CampaignClass::none, 2);
  parameters.set("Diagnosis/Most effects", "1", "test");
  rewrite([](const std::string &text) {
    return text.find("friction_y") == std::string::npos ?
             with_rows_that_go_with_pressure(text) :
             text;
  });
  const Judgement judgement = judged();
  EXPECT_EQ(name_of(judgement.verdict), name_of(Verdict::no_gap));
  EXPECT_FALSE(judgement.outlying.empty());
  EXPECT_TRUE(judgement.found.model.parts.empty());
  Diagnosis told;
  describe_shrink(ingested, judgement.base, told);
  // Rows, drift, gain and offset of the planted noise, bad rows aside.
  EXPECT_NEAR(told.shrink.noise_floor, 0.0128, 0.005);
}



// It looks like an effect; whatever is named, or not, it is told.
TEST_F(CampaignFolder, TellsAZeroOfTheSensorThatExplainsAsMuch)
{
  constexpr double zero = 0.006;
  plant(CampaignClass::none, 4);
  rewrite([](const std::string &text) { return with_zero(zero, text); });
  const Judgement spoilt = judged();
  EXPECT_LE(spoilt.gap.p, ingested.workspace->level);
  const std::optional<LookAlike> found = look_alike(spoilt);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->kind, LookAlike::Kind::friction_zero);
  EXPECT_NEAR(found->value, zero, 0.1 * zero);
}



// An amplifier so slow that steps of friction become ramps: a zero that halves
// the weighted squares, with plain differences twice as large, is none.
TEST_F(CampaignFolder, TellsNoZeroThatLeavesTheTestsFarther)
{
  plant(CampaignClass::none, 4);
  rewrite([](const std::string &text) { return slowed(0.2, text); });
  ingested                = ingest(parameters, {});
  Workspace    &workspace = *ingested.workspace;
  const Model  &base      = ingested.base;
  const GapTest gap =
    test_gap(workspace, base, score_candidates(workspace, base));
  EXPECT_LE(gap.p, workspace.level);
  EXPECT_FALSE(find_look_alike(workspace, base, base, gap.excess).has_value());
}



// The contact is led by where it was, not by what sensors made of that.
TEST_F(CampaignFolder, IsNotLedByNoiseOfSensors)
{
  plant(CampaignClass::none, 3);
  add_noise_of_sensors();
  const Judgement judgement = judged();
  EXPECT_EQ(name_of(judgement.verdict), name_of(Verdict::no_gap));
}



// Friction rounded to five times its noise: means of rows are as wrong as each
// of them, in all replicates alike.
TEST_F(CampaignFolder, HasNoGapThatRoundingMakes)
{
  plant(CampaignClass::none, 3);
  rewrite([](const std::string &text) {
    return with_friction(
      [](const double friction) {
        return 0.007 * std::round(friction / 0.007);
      },
      text);
  });
  EXPECT_EQ(name_of(judged().verdict), name_of(Verdict::no_gap));
}



TEST_F(CampaignFolder, FindsAnEffectInNoiseOfSensors)
{
  plant(CampaignClass::one, 9, "pressure");
  add_noise_of_sensors();
  EXPECT_EQ(effect_names(judged().found.model.parts),
            std::vector<std::string>{"pressure"});
}



// Replicates, which are led alike, each have a number of their own.
TEST_F(CampaignFolder, NamesADriftOverTheCampaign)
{
  plant(CampaignClass::outside, 4, "run_order", 0.05);
  const double    change    = campaign.hidden[0].parameters[0].value;
  const Judgement judgement = judged();
  EXPECT_EQ(name_of(judgement.verdict), name_of(Verdict::named));
  EXPECT_EQ(effect_names(judgement.found.model.parts),
            std::vector<std::string>{"run_order"});
  EXPECT_NEAR(judgement.found.model.values().at("Friction/run_order/Change"),
              change,
              0.1 * std::abs(change));
}



// Friction that falls with speed, in a model in which nothing rises with it at
// once, has no stable sliding to be compared; with a direct effect it has, in
// the model or tried beside it.
TEST_F(CampaignFolder, EffectsThatMakeSlidingJumpAreNotScoredAlone)
{
  plant(CampaignClass::none, 3);
  std::set<std::string> held;
  const auto            unstable = [&](const std::string &effects,
                            const std::string &candidates) {
    held.clear();
    parameters.set("Friction/Effects", effects, "test");
    parameters.set("Diagnosis/Candidates", candidates, "test");
    parameters.set("Calibration/Parameters",
                   "Friction/Static coefficient from 0.03 to 0.5",
                   "test");
    ingested = ingest(parameters, {});
    std::set<std::string> names;
    for (const CandidateView &seen :
         score_candidates(*ingested.workspace, ingested.base).candidates)
      if (seen.is_unstable)
        {
          EXPECT_NE(seen.failure.find("no stable branch"), std::string::npos);
          EXPECT_EQ(seen.ways.empty(), seen.candidate.only_beside.empty());
          (seen.ways.empty() ? names : held).insert(seen.candidate.name);
        }
    return names;
  };
  const std::set<std::string> falling = {"resonance", "stribeck"};
  EXPECT_EQ(unstable("subloading", "resonance, stribeck, pressure"), falling);
  EXPECT_TRUE(held.empty());
  EXPECT_TRUE(unstable("subloading", "all").empty());
  EXPECT_EQ(held, falling);
  EXPECT_TRUE(unstable("subloading, overstress", "all").empty());
  EXPECT_TRUE(held.empty());
}



// What the case holds wrong looks like what changes friction alike.
TEST_F(CampaignFolder, TellsAHeldParameterThatExplainsAsMuch)
{
  plant(CampaignClass::one, 9, "pressure", 0.05);
  const double truth = [&]() {
    for (const auto &parameter : campaign.hidden[0].parameters)
      if (parameter.name == "Friction/pressure/Exponent")
        return parameter.value;
    return 0.;
  }();
  parameters.set("Friction/Effects",
                 parameters.text("Friction/Effects") + ", pressure",
                 "test");
  parameters.set("Friction/pressure/Exponent",
                 std::to_string(0.5 * truth),
                 "test");
  const Judgement judgement = judged();
  EXPECT_LE(judgement.gap.p, ingested.workspace->level);
  const std::optional<LookAlike> found = look_alike(judgement);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->path, "Friction/pressure/Exponent");
  EXPECT_NEAR(found->value, truth, 0.2 * std::abs(truth));
}



// Out of time before anything is tried, and when a name is added but not proven
// yet: no name is given, and the search tells why.
TEST_F(CampaignFolder, HasNoNameBeforeItIsProven)
{
  plant(CampaignClass::one, 7);
  ingested               = ingest(parameters, {});
  Workspace   &workspace = *ingested.workspace;
  const auto   past      = std::chrono::steady_clock::now();
  unsigned int n_added   = 0;

  workspace.deadline      = past;
  const Judgement at_once = judge(workspace, ingested.base);
  EXPECT_EQ(name_of(at_once.verdict), name_of(Verdict::unnamed));
  EXPECT_TRUE(workspace.was_late);
  EXPECT_TRUE(at_once.found.first_fits.gains.empty());
  for (const CandidateView &seen : at_once.view.candidates)
    EXPECT_TRUE(seen.is_late && seen.ways.empty());

  workspace.deadline = std::chrono::steady_clock::time_point::max();
  workspace.was_late = false;
  workspace.scored.clear();
  workspace.progress = [&](const std::string &text) {
    if (text.rfind("added ", 0) != 0)
      return;
    ++n_added;
    workspace.deadline = past;
  };
  const Judgement half_way = judge(workspace, ingested.base);
  EXPECT_EQ(n_added, 1u);
  EXPECT_EQ(name_of(half_way.verdict), name_of(Verdict::unnamed));
  EXPECT_TRUE(workspace.was_late);
  EXPECT_FALSE(half_way.found.first_fits.gains.empty());
}



// Where no gap is seen, either.
TEST_F(CampaignFolder, SaysThatTimeIsOverWithoutAGap)
{
  plant(CampaignClass::none, 3);
  ingested                     = ingest(parameters, {});
  ingested.workspace->deadline = std::chrono::steady_clock::now();
  const Judgement judgement    = judge(*ingested.workspace, ingested.base);
  EXPECT_NE(name_of(judgement.verdict), name_of(Verdict::unnamed));
  EXPECT_TRUE(ingested.workspace->was_late);
}



// What candidates change is not simulated anew for a model that simulates the
// same but for less than noise, and is for another one.
TEST_F(CampaignFolder, KnowsWhatCandidatesChangeFromAModelAlike)
{
  plant(CampaignClass::one, 7);
  ingested                   = ingest(parameters, {});
  const Workspace &workspace = *ingested.workspace;
  const auto change_in = [&](const double shift, const double difference) {
    Model model = ingested.base.copy();
    model.scaled[0] += shift;
    model.objective += shift;
    model.residual(0) += difference;
    return score_candidates(workspace, model).set.directions.front().friction;
  };
  const Eigen::VectorXd first = change_in(0., 0.);
  EXPECT_EQ(change_in(0.01, -0.9), first);
  EXPECT_NE(change_in(0.02, 1.1), first);
}
