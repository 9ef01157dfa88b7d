// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/synthetic_tests/answer.h>
#include <slipstep/synthetic_tests/planted_campaign.h>
#include <slipstep/utilities/exceptions.h>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <map>
#include <set>

#include "tests/temporary_folder.h"

using namespace SlipStep;
using namespace SlipStep::Planting;

namespace
{
  PlantedCampaign plant(const CampaignClass             campaign_class,
                        const std::uint64_t             seed,
                        const std::vector<std::string> &effects = {})
  {
    CampaignOptions options;
    options.campaign_class = campaign_class;
    options.seed           = seed;
    options.effects        = effects;
    return plant_campaign(options);
  }
} // namespace



TEST(PlantedCampaign, IsAFunctionOfItsOptions)
{
  const auto a = plant(CampaignClass::two, 5), b = plant(CampaignClass::two, 5),
             c = plant(CampaignClass::two, 6);
  ASSERT_EQ(a.tests.size(), 20u);
  EXPECT_EQ(a.start_model, b.start_model);
  EXPECT_EQ(answer_json(a), answer_json(b));
  for (std::size_t i = 0; i < a.tests.size(); ++i)
    EXPECT_EQ(a.tests[i].measured.friction, b.tests[i].measured.friction);
  EXPECT_NE(a.start_model, c.start_model);
  EXPECT_NE(a.tests[0].measured.friction, c.tests[0].measured.friction);
}



// Published seeds: what they hide stays, whatever effects are added.
TEST(PlantedCampaign, HidesTheSameForEver)
{
  const std::map<std::string, std::vector<std::string>> hidden = {
    {"one",
     {"stribeck",
      "softening",
      "compliance",
      "viscous",
      "direction",
      "direction"}},
    {"two",
     {"adhesion shear_cap",
      "softening compliance",
      "heating direction",
      "overstress run_in",
      "overstress adhesion",
      "pressure viscous"}},
    {"other_formula",
     {"stribeck", "viscous", "viscous", "compliance", "overstress", "heating"}},
    {"outside",
     {"load_memory",
      "memory_length",
      "memory_length",
      "damage",
      "run_order",
      "largest_pressure"}},
    {"ablated",
     {"softening",
      "overstress",
      "softening",
      "softening",
      "softening",
      "softening"}},
    {"narrow",
     {"viscous", "pressure", "shear_cap", "run_in", "viscous", "shear_cap"}}};
  for (const auto &[name, expected] : hidden)
    for (std::size_t i = 0; i < expected.size(); ++i)
      {
        CampaignOptions options;
        options.campaign_class = campaign_class(name);
        options.seed           = i + 1;
        options.n_tests        = 2;
        std::string found;
        for (const PlantedEffect &effect : plant_campaign(options).hidden)
          found += (found.empty() ? "" : " ") + effect.name;
        EXPECT_EQ(found, expected[i]) << name << " " << i + 1;
      }
}



// Neither do its tests and their noise change.
TEST(PlantedCampaign, IsTheSameForEver)
{
  const PlantedCampaign campaign = plant(CampaignClass::one, 3);
  double                friction = 0., pressure = 0.;
  for (const PlantedTest &test : campaign.tests)
    {
      for (const double value : test.measured.friction)
        friction += value;
      for (const double value : test.measured.pressure)
        pressure += value;
    }
  EXPECT_NEAR(friction, 355.77551, 1e-4);
  EXPECT_NEAR(pressure, 29884.9, 0.01);
}



TEST(PlantedCampaign, TakesAnAmplitudeThatIsGiven)
{
  CampaignOptions options;
  options.seed      = 4;
  options.n_tests   = 2;
  const auto drawn  = plant_campaign(options);
  options.amplitude = 0.05;
  const auto given  = plant_campaign(options);
  EXPECT_EQ(given.hidden[0].name, drawn.hidden[0].name);
  EXPECT_EQ(given.hidden[0].amplitude, 0.05);
  EXPECT_NE(given.start_model, "");
  options.campaign_class = CampaignClass::none;
  EXPECT_THROW(plant_campaign(options), InputError);
  options.amplitude = 0.;
  options.edition   = newest_edition() + 1;
  EXPECT_THROW(plant_campaign(options), InputError);
}



// Of 0.0756 that were drawn.
TEST(PlantedCampaign, TellsTheAmplitudeThatAnEffectReaches)
{
  CampaignOptions options;
  options.effects            = {"stribeck"};
  options.seed               = 57;
  options.n_tests            = 2;
  const PlantedEffect hidden = plant_campaign(options).hidden.at(0);
  EXPECT_NEAR(hidden.amplitude, 0.0638120, 1e-7);
  EXPECT_NEAR(hidden.amplitude, hidden.parameters[0].value, 1e-12);
}



TEST(PlantedCampaign, HidesWhatItsClassSays)
{
  const std::map<CampaignClass, unsigned int> sizes = {
    {CampaignClass::none, 0},
    {CampaignClass::one, 1},
    {CampaignClass::two, 2},
    {CampaignClass::other_formula, 1},
    {CampaignClass::outside, 1},
    {CampaignClass::ablated, 1},
    {CampaignClass::narrow, 1},
    {CampaignClass::third_formula, 1},
    {CampaignClass::joint, 2}};
  for (const auto &[campaign_class, size] : sizes)
    {
      const auto campaign = plant(campaign_class, 4);
      ASSERT_EQ(campaign.hidden.size(), size);
      for (const PlantedEffect &effect : campaign.hidden)
        EXPECT_EQ(campaign.start_model.find(", " + effect.name),
                  std::string::npos);
    }
  // Each of a pair has parameters of its own.
  for (const PlantedEffect &effect :
       plant(CampaignClass::joint, 4, {"overstress+ageing"}).hidden)
    {
      EXPECT_TRUE(effect.name == "overstress" || effect.name == "ageing");
      EXPECT_EQ(effect.parameters.size(), 3u);
      for (const TruthParameter &parameter : effect.parameters)
        EXPECT_EQ(parameter.name.rfind("Friction/" + effect.name + "/", 0), 0u);
    }
  EXPECT_EQ(plant(CampaignClass::one, 4, {"healing"}).hidden[0].name,
            "healing");
  EXPECT_THROW(plant(CampaignClass::one, 4, {"texture"}), InputError);
  EXPECT_THROW(plant(CampaignClass::none, 4, {"healing"}), InputError);
  EXPECT_THROW(plant(CampaignClass::ablated, 4, {"healing"}), InputError);
  EXPECT_THROW(plant(CampaignClass::two, 4, {"healing", "healing"}),
               InputError);
}



TEST(PlantedCampaign, NarrowTestsCoverLittle)
{
  const auto campaign = plant(CampaignClass::narrow, 3);
  double     slow = 1e30, fast = 0., low = 1e30, high = 0.;
  for (const PlantedTest &test : campaign.tests)
    {
      const MeasuredTest &rows = test.measured;
      EXPECT_TRUE(rows.displacement_y.empty());
      for (std::size_t i = 1; i < rows.time.size(); ++i)
        {
          const double speed =
            (rows.displacement[i] - rows.displacement[i - 1]) /
            (rows.time[i] - rows.time[i - 1]);
          slow = std::min(slow, speed);
          fast = std::max(fast, speed);
          low  = std::min(low, rows.pressure[i]);
          high = std::max(high, rows.pressure[i]);
        }
    }
  EXPECT_GT(slow, 0.);
  EXPECT_LT(fast / slow, 6.);
  EXPECT_LT(high / low, 2.);
}



TEST(PlantedCampaign, ReplicatesDifferByNoiseOnly)
{
  const auto campaign = plant(CampaignClass::one, 9);
  std::map<std::string, std::vector<const PlantedTest *>> conditions;
  for (const PlantedTest &test : campaign.tests)
    conditions[test.measured.condition].push_back(&test);
  EXPECT_EQ(conditions.size(), 14u);
  unsigned int n_pairs = 0;
  for (const auto &[condition, tests] : conditions)
    if (tests.size() > 1)
      {
        ++n_pairs;
        const PlantedTest &a = *tests[0], &b = *tests[1];
        EXPECT_EQ(a.measured.displacement, b.measured.displacement);
        EXPECT_EQ(a.measured.pressure, b.measured.pressure);
        EXPECT_EQ(a.truth.along_x, b.truth.along_x);
        EXPECT_NE(a.measured.friction, b.measured.friction);
        for (std::size_t i = 0; i < a.measured.time.size(); ++i)
          EXPECT_NEAR(a.measured.friction[i], b.measured.friction[i], 0.02);
      }
  EXPECT_EQ(n_pairs, 6u);

  CampaignOptions options;
  options.with_replicates = false;
  std::set<std::string> different;
  for (const PlantedTest &test : plant_campaign(options).tests)
    different.insert(test.measured.condition);
  EXPECT_EQ(different.size(), 20u);
}



// The noise has random numbers of its own.
TEST(PlantedCampaign, NoiseLeavesTheTruthAlone)
{
  CampaignOptions options;
  options.n_tests      = 10;
  const auto noisy     = plant_campaign(options);
  options.noise_factor = 0.;
  const auto exact     = plant_campaign(options);
  ASSERT_EQ(exact.tests.size(), 10u);
  for (std::size_t i = 0; i < 10; ++i)
    {
      EXPECT_EQ(noisy.tests[i].truth.along_x, exact.tests[i].truth.along_x);
      EXPECT_EQ(exact.tests[i].measured.friction, exact.tests[i].truth.along_x);
    }
}



TEST(PlantedCampaign, FolderAndSealedAnswer)
{
  const TemporaryFolder temporary;
  const auto            folder   = temporary.path() / "campaign";
  const auto            campaign = plant(CampaignClass::outside, 2);
  write_campaign(folder, campaign);
  EXPECT_THROW(write_campaign(folder, campaign), InputError);
  EXPECT_TRUE(std::filesystem::exists(folder / "case.prm"));
  for (const PlantedTest &test : campaign.tests)
    {
      const MeasuredTest read =
        read_measured_test(folder / "measured" / test.measured.file);
      EXPECT_EQ(read.condition, test.measured.condition);
      EXPECT_EQ(read.notes.at("order"), test.measured.notes.at("order"));
      EXPECT_TRUE(read.warnings.empty());
      ASSERT_EQ(read.friction.size(), test.measured.friction.size());
      ASSERT_EQ(read.friction_y.size(), test.measured.friction_y.size());
      EXPECT_NEAR(read.friction.back(), test.measured.friction.back(), 1e-7);
    }

  const std::string text = answer_json(campaign), code = sealed(text);
  EXPECT_EQ(code.find(campaign.hidden[0].name), std::string::npos);
  std::ofstream(folder / "answer.sealed") << code;
  EXPECT_EQ(open_sealed(folder / "answer.sealed"), text);
  const auto answer = nlohmann::json::parse(text);
  EXPECT_EQ(answer["class"], "outside");
  EXPECT_EQ(answer["hidden"][0]["effect"], campaign.hidden[0].name);
  std::ofstream(folder / "damaged") << code.substr(0, 100) << "?\n";
  EXPECT_THROW(open_sealed(folder / "damaged"), InputError);
  // One letter.
  std::string changed = code;
  char       &letter  = changed[code.size() / 2];
  letter              = letter == 'A' ? 'B' : 'A';
  std::ofstream(folder / "changed") << changed;
  EXPECT_THROW(open_sealed(folder / "changed"), InputError);
  EXPECT_THROW(open_sealed(folder / "case.prm"), InputError);
}
