// SPDX-License-Identifier: LGPL-2.1-or-later

// Planted parameters are found again, with intervals that hold what they say.

#include <slipstep/calibration/advice.h>
#include <slipstep/calibration/fit.h>
#include <slipstep/calibration/profile_side.h>
#include <slipstep/calibration/uncertainty.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/process.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <map>

#include "tests/file_text.h"
#include "planted.h"

using namespace SlipStep;
using namespace SlipStep::Testing;
namespace fs = std::filesystem;

TEST_F(Planted, ParametersAreFoundToTheNoise)
{
  plant(
    folder.path(), calibration_case(paper), {1., 10., 50., 200.}, 500, 5e-4, 1);
  const Calibration found =
    calibrate(fitting({{"Calibration/Parameters", four}}));
  ASSERT_EQ(found.parameters.size(), 4u);
  for (const FittedParameter &fitted : found.parameters)
    {
      const double truth = truth_of(fitted.parameter.path);
      EXPECT_NEAR(fitted.value, truth, 0.02 * truth) << fitted.parameter.path;
      EXPECT_LT(fitted.lower, truth);
      EXPECT_GT(fitted.upper, truth);
      EXPECT_LT(fitted.lower, fitted.value);
      EXPECT_GT(fitted.upper, fitted.value);
      EXPECT_FALSE(fitted.is_lower_open || fitted.is_upper_open);
      EXPECT_LT(fitted.upper - fitted.lower, 0.06 * truth);
    }
  EXPECT_NEAR(found.inflation, 1., 0.15);
  for (const TestMisfit &test : found.tests)
    {
      EXPECT_NEAR(test.rms, 5e-4, 5e-5);
      EXPECT_NEAR(test.noise, 5e-4, 7e-5);
      EXPECT_GT(test.start_rms, 3e-3);
      EXPECT_NEAR(test.simulated_work,
                  test.measured_work,
                  1e-3 * test.measured_work);
    }
  for (const StartResult &start : found.starts)
    EXPECT_NEAR(start.misfit, found.misfit, 1e-2 * found.misfit);
  EXPECT_TRUE(found.weak.empty());
  // As many parameters as tests.
  ASSERT_EQ(found.warnings.size(), 1u) << found.warnings.front();
  EXPECT_EQ(found.warnings[0].find("4 tests for 4 parameters cannot show"), 0u);
}



// A search whose steps are cut at the bound left the others where they were,
// and tests of one law differed from one another.
TEST_F(Planted, AtABoundTheOthersAreAtTheirOptimum)
{
  const Settings truth = {{"Friction/Effects", "subloading, softening"},
                          {"Friction/Static coefficient", "0.12"},
                          {"Friction/softening/Kinetic coefficient", "0.1"},
                          {"Friction/softening/Rate", "0.02"},
                          {"Friction/softening/Steepness", "30"}};
  plant(
    folder.path(), calibration_case(truth), {1., 20., 200.}, 150, 5e-4, 1, 10.);
  const auto fitted_with = [&](const std::string &bound,
                               const std::string &parameters) {
    Settings settings  = truth;
    settings[1].second = bound;
    settings.emplace_back("Calibration/Tests", folder.path().string());
    settings.emplace_back("Calibration/Parameters",
                          parameters +
                            "Friction/softening/Kinetic coefficient from 0.02 "
                            "to 0.2 start 0.09; Friction/softening/Rate from "
                            "0.001 to 10 log start 0.1");
    return calibrate(calibration_case(settings));
  };
  for (const std::string bound : {"0.13", "0.15"})
    {
      const Calibration held = fitted_with(bound, "");
      const Calibration at_bound =
        fitted_with(bound,
                    "Friction/Static coefficient from " + bound +
                      " to 0.3 start 0.25; ");
      EXPECT_NEAR(at_bound.parameters[0].value, std::stod(bound), 1e-6);
      for (unsigned int i = 0; i < 2; ++i)
        EXPECT_NEAR(at_bound.parameters[i + 1].value,
                    held.parameters[i].value,
                    2e-3 * held.parameters[i].value);
      for (const std::string &warning : at_bound.warnings)
        EXPECT_EQ(warning.find("by more than their rows scatter"),
                  std::string::npos)
          << warning;
      EXPECT_LT(at_bound.parameters[0].upper, std::stod(bound) + 0.01);
    }
}



// Named by a wildcard.
TEST_F(Planted, WithoutNoiseTheTruth)
{
  plant(folder.path(), calibration_case(paper), {1., 20., 200.}, 300, 0., 1);
  const Calibration found = calibrate(
    fitting({{"Calibration/Tests", (folder.path() / "test_*").string()},
             {"Calibration/Parameters", four},
             {"Time stepping/Tolerance", "1e-6"}}));
  ASSERT_EQ(found.tests.size(), 3u);
  for (const FittedParameter &fitted : found.parameters)
    EXPECT_NEAR(fitted.value / truth_of(fitted.parameter.path), 1., 1e-4)
      << fitted.parameter.path;
}



TEST_F(Planted, AFitThatIsStoppedDoesNotGoOn)
{
  plant(folder.path(), calibration_case(paper), {1.}, 20, 0., 1);
  const Campaign campaign(fitting({{"Calibration/Parameters", four}}));
  Simulator      simulator(campaign);
  {
    const SignalGuard guard;
    std::raise(SIGTERM);
    EXPECT_THROW(fit(simulator,
                     campaign.scaled_start(),
                     all_parameters(campaign),
                     0,
                     deadline_after(60.)),
                 RunError);
  }
  const SignalGuard forgets_it;
}



// Friction that rises with slip, which softening cannot do.
TEST_F(Planted, AConditionOfTheLawIsABound)
{
  const Parameters risen =
    calibration_case({{"Friction/Effects", "subloading, run_in"},
                      {"Friction/Static coefficient", "0.08"},
                      {"Friction/run_in/Change", "0.3"},
                      {"Friction/run_in/Length", "3"}});
  plant(folder.path(), risen, {1., 1.}, 200, 2e-4, 1, 10.);
  const Calibration found = calibrate(
    fitting({{"Friction/Effects", "subloading, softening"},
             {"Calibration/Parameters",
              "Friction/Static coefficient from 0.05 to 0.2 start 0.1; "
              "Friction/softening/Kinetic coefficient from 0.03 to 0.2"}}));
  for (const FittedParameter &fitted : found.parameters)
    {
      EXPECT_TRUE(fitted.is_at_bound) << fitted.parameter.path;
      EXPECT_EQ(fitted.constraint.find("Friction/softening/Kinetic coefficient "
                                       "must not exceed the static "
                                       "coefficient"),
                0u)
        << fitted.constraint;
    }
  ASSERT_EQ(constraint_sentences(found).size(), 1u);
  EXPECT_TRUE(contains(constraint_sentences(found)[0],
                       "Static coefficient and "
                       "Kinetic coefficient stopped"));
  EXPECT_TRUE(
    contains(constraint_sentences(found)[0], "favour the other side"));
  EXPECT_EQ(found.warnings.front(), constraint_sentences(found)[0]);
  EXPECT_TRUE(found.weak.empty());
  for (const FittedParameter &fitted : found.parameters)
    EXPECT_TRUE(!fitted.constraint.empty() ||
                !(fitted.is_lower_open || fitted.is_upper_open))
      << fitted.parameter.path;
}



TEST_F(Planted, TiedParametersFollow)
{
  plant(folder.path(), calibration_case(paper), {1., 50.}, 300, 5e-4, 5);
  const Parameters parameters = fitting(
    {{"Calibration/Parameters",
      "Friction/softening/Rate from 0.005 to 1 start 0.1"},
     {"Calibration/Derived",
      "Friction/softening/Steepness = 0.045 / {Friction/softening/Rate}; "
      "slope = {Friction/softening/Rate} * {Friction/softening/Steepness}"}});
  const Calibration found = calibrate(parameters);
  // kappa a stays, and a alone has hardly any influence: by their own values
  // 10 % more or less are within the noise.
  const Parameters fitted = fitted_case(parameters, found);
  EXPECT_NEAR(fitted.number("Friction/softening/Rate") *
                fitted.number("Friction/softening/Steepness"),
              0.045,
              1e-8);
  ASSERT_EQ(found.derived.size(), 2u);
  EXPECT_NEAR(found.derived[1].value, 0.045, 1e-9);
  EXPECT_NEAR(found.derived[1].deviation, 0., 1e-6);
}



TEST_F(Planted, TheRateOfADerivedQuantityHasItsDeviation)
{
  plant(folder.path(), calibration_case(paper), {1., 50.}, 300, 5e-4, 5);
  const Calibration      found = calibrate(fitting(
    {{"Calibration/Parameters",
           "Friction/softening/Rate from 0.005 to 1 start 0.1"},
          {"Calibration/Derived", "length = 1 / {Friction/softening/Rate}"}}));
  const FittedParameter &rate  = found.parameters.front();
  EXPECT_NEAR(found.derived[0].value, 1. / rate.value, 1e-9);
  EXPECT_NEAR(found.derived[0].deviation,
              rate.deviation / rate.value,
              1e-2 * found.derived[0].deviation);
}



TEST_F(Planted, AParameterWithoutInfluenceIsNamed)
{
  plant(folder.path(), calibration_case(paper), {1.}, 100, 5e-4, 5);
  const Parameters parameters =
    fitting({{"Calibration/Parameters",
              "Friction/softening/Rate from 0.005 to 1; "
              "Friction/Normal stiffness from 1e4 to 1e6"}});
  try
    {
      calibrate(parameters);
      FAIL();
    }
  catch (const InputError &error)
    {
      const std::string message = error.what();
      EXPECT_TRUE(
        contains(message, "Friction/Normal stiffness has no influence"));
    }
}



// No coefficient may be changed to the side where friction would rise with
// slip.
TEST_F(Planted, AStartAtTheBorderOfTheLawLeadsAway)
{
  plant(folder.path(), calibration_case(paper), {1., 50.}, 200, 5e-4, 9);
  const Calibration found = calibrate(
    fitting({{"Calibration/Starts", "1"},
             {"Calibration/Parameters",
              "Friction/Static coefficient from 0.05 to 0.2 start 0.1; "
              "Friction/softening/Kinetic coefficient from 0.05 to 0.2 start "
              "0.1"}}));
  for (const FittedParameter &fitted : found.parameters)
    EXPECT_NEAR(fitted.value, truth_of(fitted.parameter.path), 2e-4);
}



// Each of its rows would need steps as short as there are: a fit would take
// hours.
TEST_F(Planted, ALawThatJumpsInEveryRowIsRefused)
{
  plant(folder.path(), calibration_case(paper), {1., 50.}, 200, 5e-4, 9, 5.);
  try
    {
      calibrate(
        fitting({{"Friction/Effects", "subloading, overstress, stribeck"},
                 {"Friction/Tangential stiffness", "100"},
                 {"Friction/overstress/Viscosity", "1"},
                 {"Friction/overstress/Exponent", "20"},
                 {"Friction/stribeck/Rise", "0.1"},
                 {"Friction/stribeck/Speed", "0.1 mm/s"},
                 {"Calibration/Starts", "1"},
                 {"Calibration/Parameters",
                  "Friction/Static coefficient from 0.05 to 0.2 start 0.1"}}));
      ADD_FAILURE() << "it was fitted";
    }
  catch (const RunError &error)
    {
      const std::string text = error.what();
      EXPECT_NE(text.find("time steps are needed"), std::string::npos) << text;
      EXPECT_NE(text.find("no stable branch"), std::string::npos) << text;
    }
}



TEST_F(Planted, FewerRowsThanParametersAreRefused)
{
  plant(folder.path(), calibration_case(paper), {1.}, 4, 5e-4, 5);
  EXPECT_THROW(Campaign(fitting({{"Calibration/Parameters", four}})),
               InputError);
}



TEST_F(Planted, ATieMustNotFollowItselfOrALaterOne)
{
  plant(folder.path(), calibration_case(paper), {1.}, 20, 1e-3, 5);
  for (const std::string ties :
       {"Friction/softening/Rate = 0.9 * {Friction/softening/Rate}",
        "Friction/softening/Rate = 0.9 / {Friction/softening/Steepness}; "
        "Friction/softening/Steepness = 2 * {Friction/Static coefficient}"})
    EXPECT_THROW(Campaign(
                   fitting({{"Calibration/Parameters",
                             "Friction/Static coefficient from 0.05 to 0.2"},
                            {"Calibration/Derived", ties}})),
                 InputError)
      << ties;
}



TEST_F(Planted, ADerivedQuantityWithoutValueLosesNothingElse)
{
  plant(folder.path(), calibration_case(paper), {1.}, 100, 1e-3, 5);
  const Calibration found = calibrate(fitting(
    {{"Friction/Static coefficient", "0.13"},
     {"Calibration/Parameters", "Friction/Static coefficient from 0.08 to 0.3"},
     {"Calibration/Derived",
      "x = sqrt({Friction/Static coefficient} - 0.12)"}}));
  EXPECT_TRUE(std::isnan(found.derived.front().value));
  EXPECT_FALSE(found.warnings.empty());
  EXPECT_NEAR(found.parameters.front().value, 0.0899, 2e-3);
}



// Friction along x is nothing but zeros then, and no measurement: one sensor
// resolved along x and y is one, whatever the angle.
TEST_F(Planted, AlongOtherAxesTheFitIsTheSame)
{
  plant(folder.path(), calibration_case(paper), {1., 20., 200.}, 200, 5e-4, 7);
  std::map<fs::path, MeasuredTest> along_x;
  for (const fs::path &file : Campaign::test_files(fitting({})))
    for (const auto &entry : fs::directory_iterator(file))
      along_x[entry.path()] = read_measured_test(entry.path());
  std::vector<Calibration> found;
  for (const double angle : {0., 90., 30., -135.})
    {
      const double c = std::cos(angle * std::acos(-1.) / 180.);
      const double s = std::sin(angle * std::acos(-1.) / 180.);
      for (const auto &[file, measured] : along_x)
        {
          MeasuredTest test   = measured;
          test.displacement_y = test.displacement;
          test.friction_y     = test.friction;
          for (std::size_t i = 0; i < test.time.size(); ++i)
            {
              test.displacement[i] *= c;
              test.friction[i] *= c;
              test.displacement_y[i] *= s;
              test.friction_y[i] *= s;
            }
          write_measured_test(file, test);
        }
      found.push_back(calibrate(fitting({{"Calibration/Parameters", four}})));
    }
  for (const Calibration &turned : found)
    for (std::size_t i = 0; i < 4; ++i)
      {
        const FittedParameter &one = found[0].parameters[i];
        const FittedParameter &two = turned.parameters[i];
        EXPECT_NEAR(two.value / one.value, 1., 2e-3) << one.parameter.path;
        EXPECT_NEAR((two.upper - two.lower) / (one.upper - one.lower), 1., 0.02)
          << one.parameter.path;
        EXPECT_NEAR(turned.tests[0].rms / found[0].tests[0].rms, 1., 1e-3);
      }
}



// A record without noise does not take over the whole fit, and it is told.
TEST_F(Planted, ARecordWithoutNoiseIsWarnedOf)
{
  plant(folder.path(), calibration_case(paper), {1., 20., 200.}, 100, 1e-3, 5);
  MeasuredTest constant;
  for (unsigned int i = 0; i < 100; ++i)
    {
      constant.time.push_back(i);
      constant.displacement.push_back(i);
      constant.pressure.push_back(5.8);
      constant.friction.push_back(0.13);
    }
  write_measured_test(folder.path() / "constant.csv", constant);
  const Campaign campaign(
    fitting({{"Calibration/Parameters",
              "Friction/Static coefficient from 0.05 to 0.2"}}));
  EXPECT_NEAR(campaign.tests.front().axes[0].noise, 1e-4, 3e-5);
  ASSERT_EQ(campaign.warnings().size(), 1u);
  EXPECT_TRUE(contains(campaign.warnings().front(), "constant.csv"));

  constant.friction.assign(100, 0.);
  write_measured_test(folder.path() / "constant.csv", constant);
  EXPECT_THROW(Campaign(campaign.parameters), InputError);
}



TEST_F(Planted, ALawThatDoesNotDescribeTheTestsIsTold)
{
  plant(folder.path(), calibration_case(paper), {1., 20., 200.}, 100, 1e-4, 5);
  const Calibration found =
    calibrate(fitting({{"Friction/softening/Kinetic coefficient", "0.03"},
                       {"Calibration/Starts", "1"},
                       {"Calibration/Parameters",
                        "Friction/Static coefficient from 0.05 to 0.2"}}));
  EXPECT_TRUE(std::any_of(found.warnings.begin(),
                          found.warnings.end(),
                          [](const std::string &warning) {
                            return warning.find("does not describe these "
                                                "tests") != std::string::npos;
                          }));
}



// Which axis is which does not matter for how much a record knows.
TEST_F(Planted, NoiseThatHangsTogetherCountsOnBothAxes)
{
  std::mt19937                     random(1);
  std::normal_distribution<double> normal;
  MeasuredTest                     along, across;
  double                           red = 0.;
  for (unsigned int i = 0; i < 400; ++i)
    {
      red = 0.9 * red + normal(random);
      along.time.push_back(i);
      along.displacement.push_back(0.1 * i);
      along.displacement_y.push_back(0.1 * i);
      along.pressure.push_back(5.8);
      along.friction.push_back(0.06 + 1e-3 * red);
      along.friction_y.push_back(0.06 + 1e-3 * normal(random));
    }
  across = along;
  std::swap(across.friction, across.friction_y);
  double inflation[2];
  for (unsigned int i = 0; i < 2; ++i)
    {
      write_measured_test(folder.path() / "test.csv", i == 0 ? along : across);
      const Campaign campaign(
        fitting({{"Friction/Effects", "subloading"},
                 {"Calibration/Noise", "0.001"},
                 {"Calibration/Lead-in", "1 mm"},
                 {"Calibration/Parameters",
                  "Friction/Static coefficient from 0.05 to 0.2"}}));
      Simulator simulator(campaign);
      simulator.plan(campaign.scaled_start());
      std::vector<TestMisfit> tests;
      const FitResult best = fit(simulator, campaign.scaled_start(), {0});
      inflation[i]         = linearise(simulator, best.scaled, tests).inflation;
    }
  EXPECT_GT(inflation[0], 3.);
  EXPECT_NEAR(inflation[1] / inflation[0], 1., 0.01);
}



// Positions that tremble by a small part of the elastic slip: before it slips a
// contact makes as large a part of its friction of that.
TEST_F(Planted, TremblingPositionsAreNotFeltInTheFlank)
{
  const Parameters                 truth = calibration_case(paper);
  std::mt19937                     random(3);
  std::normal_distribution<double> normal(0., 1.);
  const double elastic_slip = truth.number("Friction/Static coefficient") *
                              5.8 /
                              truth.number("Friction/Tangential stiffness");
  MeasuredTest test =
    planted_test(truth, 1. / 60., 20. * elastic_slip, 200, 2e-4, random);
  for (double &displacement : test.displacement)
    displacement += 0.08 * elastic_slip * normal(random);
  write_measured_test(folder.path() / "test.csv", test);
  const Campaign campaign(
    fitting({{"Calibration/Parameters",
              "Friction/Static coefficient from 0.05 to 0.2 start 0.0899"}}));
  Simulator simulator(campaign);
  simulator.plan(campaign.scaled_start());
  EXPECT_LT(simulator.misfit(campaign.scaled_start()),
            5. * campaign.n_residuals());
}



TEST_F(Planted, TestsThatAreLeftOutAreNotSimulated)
{
  plant(folder.path(), calibration_case(paper), {1., 20., 200.}, 200, 1e-3, 7);
  const Campaign campaign(fitting({{"Calibration/Parameters", four}}));
  Simulator      simulator(campaign);
  simulator.plan(campaign.scaled_start());
  std::vector<double> all(campaign.n_residuals()), some(all.size(), 7.);
  simulator.residuals(campaign.scaled_start(), all.data());
  simulator.is_left_out = {false, true, false};
  simulator.residuals(campaign.scaled_start(), some.data());
  std::size_t row = 0;
  for (const CampaignTest &test : campaign.tests)
    for (std::size_t i = 0; i < test.n_residuals(); ++i, ++row)
      EXPECT_EQ(some[row], &test == &campaign.tests[1] ? 0. : all[row]);
  simulator.is_left_out = {};
  simulator.residuals(campaign.scaled_start(), some.data());
  EXPECT_EQ(some, all);
}



// Each is compared with its own rows, as if it were alone.
TEST_F(Planted, TestsOfTheSameMotionAreSimulatedOnce)
{
  const auto values_of_files = [&](const std::vector<bool> &left_out,
                                   std::size_t             &n_steps) {
    const Campaign campaign(fitting(
      {{"Calibration/Parameters", four}, {"Calibration/Noise", "0.001"}}));
    Simulator      simulator(campaign);
    simulator.plan(campaign.scaled_start());
    simulator.correct(campaign.scaled_start());
    simulator.is_left_out = left_out;
    n_steps               = simulator.n_steps();
    std::vector<double> result(campaign.n_residuals());
    simulator.residuals(campaign.scaled_start(), result.data());
    for (std::size_t i = 0; i < campaign.tests.size() && left_out.empty(); ++i)
      EXPECT_NEAR(simulator.simulate(campaign.scaled_start(), i).friction[99],
                  campaign.tests[i].rows.friction[99] +
                    1e-3 * result[200 * i + 99],
                  1e-14);
    return result;
  };
  const auto values = [&](const std::vector<double> &speeds,
                          const std::vector<bool>   &left_out,
                          std::size_t               &n_steps) {
    std::filesystem::remove_all(folder.path());
    plant(folder.path(), calibration_case(paper), speeds, 200, 1e-3, 7);
    return values_of_files(left_out, n_steps);
  };
  std::size_t once, with_copies, with_other;
  // 20.001 draws the same noise as 20 and moves on its own.
  const auto other  = values({20., 200., 20.001}, {}, with_other);
  const auto copies = values({20., 200., 20.}, {}, with_copies);
  const auto single = values({20., 200.}, {}, once);
  EXPECT_EQ(with_copies, once);
  EXPECT_GT(with_other, 1.2 * once);
  for (std::size_t i = 0; i < 600; ++i)
    EXPECT_NEAR(copies[i], other[i], 0.01);
  for (std::size_t i = 0; i < 400; ++i)
    EXPECT_NEAR(copies[i], single[i], 0.01);
  const auto third = values({20., 200., 20.}, {true, true, false}, once);
  for (std::size_t i = 0; i < 600; ++i)
    EXPECT_EQ(third[i], i < 400 ? 0. : copies[i]);
  // In another order.
  std::filesystem::rename(folder.path() / "test_0.csv",
                          folder.path() / "test_3.csv");
  const auto swapped = values_of_files({}, once);
  for (std::size_t i = 0; i < 600; ++i)
    EXPECT_EQ(swapped[i], copies[(i + 200) % 600]);
}



// Tests that were led alike are one simulation, unless their order matters.
TEST_F(Planted, ADriftFromTestToTestIsFound)
{
  const Settings drift = {{"Friction/Effects",
                           "subloading, overstress, softening, run_order"},
                          {"Friction/run_order/Last test", "6"}};
  std::mt19937   random(3);
  for (const int order : {1, 6, 4, 2})
    {
      Settings settings = paper;
      settings.insert(settings.end(), drift.begin(), drift.end());
      settings.emplace_back("Friction/run_order/Change", "-0.2");
      settings.emplace_back("Friction/run_order/Test", std::to_string(order));
      MeasuredTest test = planted_test(
        calibration_case(settings), 1. / 60., 50., 300, 5e-4, random);
      test.notes["order"] = std::to_string(order);
      write_measured_test(folder.path() / (std::to_string(order) + ".csv"),
                          test);
    }
  Settings settings = drift;
  settings.emplace_back("Calibration/Parameters",
                        "Friction/run_order/Change from -0.5 to 0.5 start 0");
  const Calibration found = calibrate(fitting(settings));
  ASSERT_EQ(found.parameters.size(), 1u);
  EXPECT_NEAR(found.parameters[0].value, -0.2, 0.002);
}
