// SPDX-License-Identifier: LGPL-2.1-or-later

// An end to every run, warnings before those that no stiffness holds, and the
// same rows by a replay as by a programme.

#include <slipstep/experiment/replay.h>
#include <slipstep/measured_data/resample.h>
#include <slipstep/experiment/stability.h>
#include <slipstep/utilities/exceptions.h>

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "tests/file_text.h"
#include "tests/message_of.h"
#include "../temporary_folder.h"
#include "point_run.h"

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  std::vector<std::string> warnings(const Parameters &parameters)
  {
    return instability_warnings(FrictionLaw(parameters),
                                parse_programme(parameters),
                                Machine(parameters));
  }

  // Friction that falls with speed, at 1 mm/s by more than any stiffness holds.
  const Settings falling = {{"Friction/Effects", "overstress, stribeck"},
                            {"Friction/Static coefficient", "0.1"},
                            {"Friction/stribeck/Rise", "0.3"},
                            {"Loading/Programme",
                             "press 5 MPa in 1 s; slide 1 mm/s for 10 mm"},
                            {"Time stepping/Most steps per statement", "3000"}};

  std::string why_it_ends(const Settings &settings)
  {
    const std::string reason =
      message_of<RunError>([&] { point_history(point_parameters(settings)); });
    EXPECT_NE(reason, "") << "it ended by itself";
    return reason;
  }
} // namespace



TEST(StepControl, EndsARunThatWouldHaveNone)
{
  const std::string text = why_it_ends(falling);
  EXPECT_TRUE(contains(text,
                       "Statement 2 of the programme takes more than 3000 "
                       "time steps (Time stepping/Most steps per "
                       "statement), rejected ones included"));
  EXPECT_TRUE(contains(text, "stick-slip"));
}



// Of two segments.
TEST(StepControl, AllowsMoreStepsToATestOfManyRows)
{
  const auto file = test_folder() / "followed.csv";
  std::ofstream(file) << "time_s,displacement_mm,pressure_MPa,friction\n"
                         "0,0,5,0\n1,1,5,0\n2,0,5,0\n";
  const std::string text = why_it_ends(
    falling + Settings{{"Loading/Programme", "follow " + file.string()}});
  EXPECT_TRUE(contains(text,
                       "Statement 1 of the programme takes more than 3001 "
                       "time steps (Time stepping/Most steps per statement "
                       "and one for each row)"));
  EXPECT_FALSE(contains(text, "stick-slip"));
}



// Of equal steps a test has so many from row to row, however far rows are from
// each other: with one to a row every study would repeat the same run.
TEST(StepControl, HasEqualStepsFromRowToRow)
{
  const auto file = test_folder() / "followed.csv";
  std::ofstream(file) << "time_s,displacement_mm,pressure_MPa,friction\n"
                         "0,0,5,0\n1,1,5,0\n3,0,5,0\n";
  std::vector<double> times;
  for (const HistoryRow &row : point_history(
         point_parameters({{"Loading/Programme", "follow " + file.string()},
                           {"Time stepping/Equal steps per statement", "4"}})))
    times.push_back(row.time);
  const std::vector<double> expected = {0.25, 0.5, 0.75, 1., 1.5, 2., 2.5, 3.};
  ASSERT_EQ(times.size(), expected.size());
  for (std::size_t i = 0; i < times.size(); ++i)
    EXPECT_NEAR(times[i], expected[i], 1e-12);
}



// A rest that relaxes in one of few equal steps ends far below the strength.
TEST(StepControl, WarnsOfStepsThatAreFarTooLong)
{
  const auto after = [](const Settings &more) {
    const Parameters parameters = point_parameters(
      Settings{{"Loading/Programme",
                "press 5 MPa in 1 s; slide 1 mm/min for 0.5 mm; hold 10 s"},
               {"Friction/Effects", "subloading, overstress, softening"}} +
      more);
    std::vector<HistoryRow> rows;
    const std::string       warning = run_point(parameters, rows).warning();
    return std::pair(rows.back().friction, warning);
  };
  const auto [friction, none] = after({});
  EXPECT_EQ(none, "");
  for (const Settings &coarse :
       {Settings{{"Time stepping/Equal steps per statement", "10"}},
        Settings{{"Time stepping/Tolerance", "1"},
                 {"Time stepping/Least steps per statement", "1"}}})
    {
      const auto [wrong, warning] = after(coarse);
      EXPECT_LT(wrong, 0.9 * friction);
      EXPECT_TRUE(contains(warning, "the steps are too long (Time stepping/"))
        << warning;
    }
  EXPECT_EQ(after({{"Time stepping/Equal steps per statement", "2000"}}).second,
            "");
  // A flank within one step is a coarse line between rows, but no error.
  EXPECT_EQ(after({{"Time stepping/Equal steps per statement", "200"},
                   {"Loading/Programme",
                    "press 5 MPa in 1 s; slide 1 mm/min for 1 mm; "
                    "slide -1 mm/min for 1 mm"}})
              .second,
            "");
}



TEST(StepControl, WarnsBeforeSlidingThatNothingHolds)
{
  const auto text = warnings(point_parameters(falling));
  ASSERT_EQ(text.size(), 1u);
  EXPECT_TRUE(contains(text[0], "mm/s, friction falls (stribeck)"));
  EXPECT_TRUE(contains(text[0], "1 mm/s under 5 MPa"));

  // Slower than the fall and faster than it there is nothing to warn of.
  for (const char *speed : {"0.001", "100"})
    {
      Parameters other = point_parameters(falling);
      other.set("Loading/Programme",
                std::string("press 5 MPa in 1 s; slide ") + speed +
                  " mm/s for 10 mm",
                "test");
      EXPECT_TRUE(warnings(other).empty()) << speed;
    }
  // Nor of the paper's law, on any spring or none.
  EXPECT_TRUE(warnings(point_parameters({})).empty());
  EXPECT_TRUE(
    warnings(point_parameters({{"Loading/Machine stiffness", "50"}})).empty());
}



// A slide that goes on in a second statement is the slide in one.
// A strength that is not proportional to the pressure, to the end.
TEST(StepControl, UnloadsToZero)
{
  for (const char *effects : {"subloading, pressure",
                              "subloading, adhesion",
                              "overstress, pressure",
                              "overstress, adhesion, healing"})
    {
      const auto history = point_history(point_parameters(
        {{"Loading/Programme",
          "press 5 MPa in 1 s; slide 1 mm/s for 0.05 mm; press 0 MPa in 1 s"},
         {"Friction/Effects", effects}}));
      EXPECT_EQ(history.back().time, 2.05) << effects;
      EXPECT_EQ(history.back().friction, 0.) << effects;
      EXPECT_LT(history.size(), 500u) << effects;
    }
}



TEST(StepControl, TwoStatementsAreAsGoodAsOne)
{
  Settings settings = {{"Friction/Effects", "subloading, overstress, stribeck"},
                       {"Friction/stribeck/Rise", "0.7"},
                       {"Friction/stribeck/Speed", "0.1 mm/s"}};
  const auto end    = [&](const std::string &slides) {
    Parameters parameters = point_parameters(settings);
    parameters.set("Loading/Programme", "press 5.8 MPa in 1 s; " + slides, "");
    return point_history(parameters);
  };
  const auto one = end("slide 10 mm/s for 10.01 mm");
  const auto ten =
    end("slide 10 mm/s for 10 mm; repeat 10 times { slide 10 mm/s for 0.001 "
        "mm }");
  EXPECT_NEAR(one.back().friction, ten.back().friction, 1e-6);
  EXPECT_NEAR(one.back().dissipated_energy,
              ten.back().dissipated_energy,
              1e-4 * one.back().dissipated_energy);
  EXPECT_LT(ten.size(), 10 * one.size());
}



// Planned steps meet the rows where the pressure jumps.
TEST(StepControl, ReplayAndProgrammeAgreeAtEveryRow)
{
  MeasuredTest test;
  for (unsigned int i = 0; i <= 200; ++i)
    {
      test.time.push_back(0.1 * i);
      test.displacement.push_back(0.05 * i);
      test.pressure.push_back(i < 60 || i > 140 ? 5. :
                              i < 100           ? 10. :
                                                  10. - 0.125 * (i - 100));
      test.friction.push_back(0.1);
    }
  const TemporaryFolder folder;
  const auto            file = folder.path() / "jump.csv";
  {
    std::ofstream out(file);
    out.precision(17);
    out << "# name: jump\n# condition: jump\n"
        << "time_s,displacement_mm,pressure_MPa,friction\n";
    for (std::size_t i = 0; i < test.time.size(); ++i)
      out << test.time[i] << ',' << test.displacement[i] << ','
          << test.pressure[i] << ',' << test.friction[i] << '\n';
  }
  const Parameters parameters = point_parameters(
    {{"Friction/Effects", "subloading, overstress, softening, pressure"},
     {"Friction/pressure/Exponent", "0.3"},
     {"Friction/softening/Rate", "1"},
     {"Loading/Programme", "press 5 MPa in 1 s; follow " + file.string()}});
  const auto history = point_history(parameters);

  const FrictionLaw law(parameters);
  Replay            replay(resample(test).test, 0., 0.1);
  replay.plan(law, Machine(), 5e-4);
  Replay::Curve curve;
  replay.simulate(law, Machine(), curve);
  const auto found = replay.at(curve.friction, test.time);

  double peak = 0., largest = 0.;
  for (std::size_t i = 0, row = 0; i < test.time.size(); ++i)
    {
      while (row + 1 < history.size() &&
             history[row].time < 1. + test.time[i] - 1e-9)
        ++row;
      ASSERT_NEAR(history[row].time, 1. + test.time[i], 1e-9);
      peak    = std::max(peak, history[row].friction);
      largest = std::max(largest, std::abs(history[row].friction - found[i]));
    }
  EXPECT_LT(largest, 2e-3 * peak);
}
