// SPDX-License-Identifier: LGPL-2.1-or-later
#include "block_test_tools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  // A plane block that friction as large as the pressure holds, pushed from the
  // side three times as hard as pressed: it slips under the side.
  const Settings squeezed = {{"Friction/Effects", ""},
                             {"Friction/Static coefficient", "1"},
                             {"Block/Dimension", "2"},
                             {"Block/Size", "10 mm, 10 mm"},
                             {"Block/Subdivisions", "6, 6"},
                             {"Time stepping/Equal steps per statement", "20"},
                             {"Block/Faces/left", "displacement x 0 mm"},
                             {"Block/Faces/top", "pressure programme"},
                             {"Loading/Programme",
                              "press 5 MPa in 1 s; hold 1 s"}};

  Settings squeezed_by(const std::string &side)
  {
    return squeezed + Settings{{"Block/Faces/right", side}};
  }

  double largest_difference(const BlockResult &a, const BlockResult &b)
  {
    double result = 0.;
    for (std::size_t i = 0; i < a.history.size(); ++i)
      for (const auto value : {&HistoryRow::normal_load,
                               &HistoryRow::tangential_load,
                               &HistoryRow::dissipated_energy,
                               &HistoryRow::stored_energy,
                               &HistoryRow::external_work})
        result = std::max(result,
                          std::abs(a.history[i].*value - b.history[i].*value) /
                            std::abs(b.history.back().*value));
    return result;
  }
} // namespace



// Three spellings of one case.
TEST(Loads, GrowWithTheFirstStatement)
{
  const auto programme =
    run_block_case<2>(make_parameters(squeezed_by("pressure 3 x programme")));
  const auto constant =
    run_block_case<2>(make_parameters(squeezed_by("pressure 15 MPa")));
  const auto all_constant = run_block_case<2>(
    make_parameters(squeezed_by("traction -15 0 MPa") +
                    Settings{{"Block/Faces/top", "pressure 5 MPa"},
                             {"Loading/Programme", "hold 1 s; hold 1 s"}}));
  for (const BlockResult *result : {&programme, &constant, &all_constant})
    {
      ASSERT_EQ(result->failure, "");
      ASSERT_EQ(result->history.size(), programme.history.size());
      EXPECT_LT(result->summary.balance_error, 5e-3);
    }
  EXPECT_GT(programme.history.back().dissipated_energy, 0.);
  EXPECT_LT(largest_difference(constant, programme), 1e-9);
  EXPECT_LT(largest_difference(all_constant, programme), 1e-9);
}



// As in the limit of short steps.
TEST(Loads, TwentyStepsAreEnough)
{
  const auto squeeze = [](const std::string &steps) {
    return run_block_case<2>(make_parameters(
      squeezed_by("pressure 15 MPa") +
      Settings{{"Time stepping/Equal steps per statement", steps}}));
  };
  const HistoryRow coarse = squeeze("20").history.back();
  const HistoryRow fine   = squeeze("320").history.back();
  for (const auto value : {&HistoryRow::normal_load,
                           &HistoryRow::tangential_load,
                           &HistoryRow::dissipated_energy,
                           &HistoryRow::stored_energy,
                           &HistoryRow::external_work})
    EXPECT_NEAR(coarse.*value, fine.*value, 5e-3 * std::abs(fine.*value));
}



// While everything sticks the end does not ask how it was reached, and all work
// is stored.
TEST(Loads, AtOnceTheyActFromTheFirstStepOn)
{
  const auto sheared = [](const std::string &when) {
    return run_block_case<2>(make_parameters(
      squeezed + Settings{{"Friction/Static coefficient", "50"},
                          {"Block/Faces/left", "free"},
                          {"Block/Faces/top", "traction 0.5 -5 MPa" + when},
                          {"Loading/Programme", "hold 1 s; hold 1 s"}}));
  };
  const BlockResult gradual = sheared(""), at_once = sheared(" at once");
  for (const BlockResult *result : {&gradual, &at_once})
    {
      ASSERT_EQ(result->failure, "");
      EXPECT_EQ(result->history.back().dissipated_energy, 0.);
      EXPECT_LT(std::abs(result->summary.balance_error), 1e-9);
      EXPECT_NEAR(result->history.back().tangential_load, 5., 1e-8);
      EXPECT_NEAR(result->history.back().stored_energy,
                  gradual.history.back().stored_energy,
                  1e-9 * gradual.history.back().stored_energy);
    }
  EXPECT_NEAR(gradual.history.front().tangential_load, 5. / 20., 1e-8);
  EXPECT_NEAR(at_once.history.front().tangential_load, 5., 1e-8);
}



// Over the step that was tried first: cut into halves it still takes that long.
TEST(Loads, AtOnceShorterStepsAreSmallerOnes)
{
  const auto parameters = make_parameters(
    squeezed_by("pressure 2 MPa at once") +
    Settings{{"Loading/Programme", "press 0.01 MPa in 1 s; hold 1 s"}});
  const FrictionLaw law(parameters);
  const Programme   programme = parse_programme(parameters);
  StepControl       control(parameters, programme, law);
  const double      whole = control.step_size();
  control.cut("test");
  ASSERT_LT(control.step_size(), 0.8 * whole);
  const auto at = [&](const double time) {
    return load_factors_at(programme, whole, time);
  };
  EXPECT_DOUBLE_EQ(at(control.step_size())[at_once],
                   control.step_size() / whole);
  EXPECT_EQ(at(1.5 * whole)[at_once], 1.);
  EXPECT_EQ(at(0.25)[gradual], 0.25);
  EXPECT_EQ(at(0.25)[programme_pressure], programme.at(0.25).pressure);
}



// A prescribed displacement squeezes block and contact as springs in series,
// and its work is what they store.
TEST(Loads, DisplacementsGrowToo)
{
  const double stiffness = 1. / (10. / 206e3 + 1. / 1e5);
  for (const std::string when : {"", " at once"})
    {
      const auto result = run_block_case<2>(
        make_parameters({{"Friction/Static coefficient", "1e-8"},
                         {"Friction/Effects", ""},
                         {"Block/Dimension", "2"},
                         {"Block/Size", "10 mm, 10 mm"},
                         {"Block/Subdivisions", "2, 2"},
                         {"Block/Poisson ratio", "0"},
                         {"Block/Faces/left", "displacement x 0 mm"},
                         {"Time stepping/Equal steps per statement", "8"},
                         {"Block/Faces/top", "displacement y -0.001 mm" + when},
                         {"Loading/Programme", "hold 1 s; hold 1 s"}}));
      ASSERT_EQ(result.failure, "");
      EXPECT_NEAR(result.history.front().pressure,
                  0.001 * stiffness / (when.empty() ? 8. : 1.),
                  1e-7);
      EXPECT_NEAR(result.history.back().pressure, 0.001 * stiffness, 1e-7);
      EXPECT_NEAR(result.history.back().external_work,
                  10. * stiffness * 0.001 * 0.001 / 2.,
                  1e-7);
      EXPECT_LT(std::abs(result.summary.balance_error), 1e-8);
    }
}



TEST(Loads, ThatGrowWhileItSlidesAreWarnedOf)
{
  const Settings settings = {{"Block/Dimension", "2"},
                             {"Block/Size", "10 mm, 10 mm"},
                             {"Block/Subdivisions", "2, 2"},
                             {"Loading/Programme", "slide 1 mm/s for 0.1 mm"}};
  for (const std::string when : {"", " at once"})
    {
      const auto result = run_block_case<2>(make_parameters(
        settings +
        Settings{{"Block/Faces/top", "pressure 5 MPa" + when + "; drive"}}));
      ASSERT_EQ(result.failure, "");
      EXPECT_EQ(result.summary.warnings.size(), when.empty() ? 1u : 0u);
    }
}



TEST(Loads, APressThatActsNowhereIsWarnedOf)
{
  const auto warned = [](const std::string &top, const std::string &programme) {
    const auto result = run_block_case<2>(make_parameters(
      squeezed_by("pressure  1 MPa at  once") +
      Settings{{"Block/Faces/top", top}, {"Loading/Programme", programme}}));
    EXPECT_EQ(result.failure, "");
    return std::any_of(result.summary.warnings.begin(),
                       result.summary.warnings.end(),
                       [](const std::string &warning) {
                         return warning.find("the programme presses, but") == 0;
                       });
  };
  EXPECT_TRUE(warned("pressure 5 MPa", "press 9 MPa in 1 s"));
  EXPECT_FALSE(warned("pressure 5 MPa", "hold 1 s"));
  EXPECT_FALSE(warned("pressure 0.1 x programme", "press 50 MPa in 1 s"));
}



// Increments at rest are round-off and slip nowhere, whoever solves.
TEST(Loads, NothingSlipsAtRest)
{
  for (const std::string solver : {"direct", "multigrid", "amg"})
    {
      const auto result = run_block_case<2>(make_parameters(
        squeezed_by("free") +
        Settings{{"Block/Solver", solver},
                 {"Loading/Programme", "press 5 MPa in 1 s; hold 1 s"}}));
      ASSERT_EQ(result.history.size(), 40u);
      for (std::size_t i = 20; i < 40; ++i)
        EXPECT_EQ(result.history[i].slip_fraction, 0.) << solver << ' ' << i;
    }
}
