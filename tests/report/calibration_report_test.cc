// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/report/calibration_report.h>
#include <slipstep/report/figure.h>
#include <slipstep/report/run_report.h>
#include <slipstep/report/text_table.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>

#include "tests/report/synthetic_calibration.h"
#include "tests/report/page_text.h"

using namespace SlipStep;

namespace
{
  constexpr double infinity = std::numeric_limits<double>::infinity();

  std::string page_of(const Calibration        &calibration,
                      std::vector<std::string> *warnings = nullptr)
  {
    Parameters parameters;
    declare_report_parameters(parameters);
    const auto said =
      write_calibration_report(test_folder(), parameters, calibration);
    if (warnings != nullptr)
      *warnings = said;
    return sound_page();
  }
} // namespace



TEST(CalibrationReport, ThePageIsCompleteInItself)
{
  std::vector<std::string> warnings;
  const std::string page = page_of(SyntheticCalibration::make(), &warnings);
  EXPECT_TRUE(contains(page,
                       "3 parameters from 4 tests: rms difference of friction "
                       "0.0025, 0.98 times the noise; it was 0.02 with the "
                       "start values. 1 parameter has an open interval."));
  EXPECT_TRUE(contains(page, "the noise of 'fast' was estimated"));
  EXPECT_TRUE(contains(page, "cannot be told apart"));
  EXPECT_TRUE(contains(page, "Reference speed × 4.39, Rate ÷ 1.051"));
  EXPECT_TRUE(contains(page, "Reference speed (no upper end)"));
  EXPECT_TRUE(contains(page, "≥ 0.00135"));
  EXPECT_TRUE(contains(page, "0.693 … 0.954"));
  EXPECT_TRUE(contains(page, "×/÷ 1.083"));
  EXPECT_TRUE(contains(page, "± 0.001"));
  EXPECT_TRUE(contains(page, "slow &lt;a&gt; &amp; &quot;b&quot;"));
  EXPECT_TRUE(contains(page, "2 of 5 searches ended in the best optimum; 1 "));
  EXPECT_TRUE(contains(page, "slipstep calibrate"));
  EXPECT_FALSE(contains(page, "depend on each other"));
  // What matters most comes first.
  EXPECT_LT(page.find("do not determine"), page.find("Static friction"));
  // Nothing is fetched from elsewhere.
  has_none(page, {"src=", "<link"});

  for (const std::string name :
       {"curves_1", "curves_start_1", "residuals_3", "profile_3"})
    for (const std::string end : {".dat", ".gp"})
      EXPECT_TRUE(
        std::filesystem::exists(test_folder() / "report" / (name + end)))
        << name + end;
  if (!has_gnuplot())
    GTEST_SKIP() << "gnuplot is not installed";
  EXPECT_TRUE(warnings.empty()) << warnings[0];
  for (const std::string name :
       {"curves_1", "curves_start_1", "residuals_3", "profile_3"})
    EXPECT_TRUE(contains(page, "id=\"" + name + "-")) << name;
}



TEST(CalibrationReport, WhereNothingIsWeakItSaysSo)
{
  Calibration calibration = SyntheticCalibration::make();
  calibration.weak.clear();
  calibration.parameters.pop_back();
  calibration.starts.clear();
  calibration.correlation = {{1., -0.998}, {-0.998, 1.}};
  const std::string page  = page_of(calibration);
  EXPECT_TRUE(contains(page, "Rate and Static friction (-0.9980)"));
  EXPECT_TRUE(contains(page, "Every parameter has an interval"));
  EXPECT_FALSE(contains(page, "searches"));
}



TEST(CalibrationReport, ValuesHaveTheDigitsThatTheTestsGiveThem)
{
  const auto text = [](const double value, const double deviation) {
    const FittedParameter fitted = SyntheticCalibration::parameter(
      "a", Dimension::number, false, value, deviation);
    return digits_text(fitted, fitted.value);
  };
  EXPECT_EQ(text(0.0899612, 0.00053), "0.08996");
  EXPECT_EQ(text(11481.2, 1030.), "11500");
  EXPECT_EQ(text(11481.2, 10.3), "11481");
  EXPECT_EQ(text(3.14159265e-6, 1e-9), "3.1416e-06");
  EXPECT_EQ(text(0.4, infinity), "0.4");
}



TEST(CalibrationReport, OpenEndsAreShownAsOpen)
{
  FittedParameter fitted = SyntheticCalibration::open_parameter();
  EXPECT_EQ(interval_text(fitted), "≥ 0.00135");
  fitted.is_lower_open = true;
  EXPECT_EQ(interval_text(fitted), "open");
  fitted.is_upper_open = false;
  EXPECT_EQ(interval_text(fitted), "≤ 0.3");
  fitted.deviation = infinity;
  EXPECT_EQ(deviation_text(fitted), "unknown");
  fitted.deviation = 20.;
  EXPECT_EQ(deviation_text(fitted), "×/÷ > 1000");
}



// Nothing known, nothing to compare with, next to no data.
TEST(CalibrationReport, DegenerateResultsDoNotBreakThePage)
{
  Calibration calibration;
  page_of(calibration);
  calibration_table(calibration);

  FittedParameter unknown = SyntheticCalibration::parameter(
    "Friction/softening/Rate", Dimension::per_length, false, 0., infinity);
  unknown.parameter.upper = 1.;
  unknown.lower           = 0.;
  unknown.upper           = 1.;
  unknown.is_lower_open = unknown.is_upper_open = unknown.is_at_bound = true;
  unknown.profile         = {{0., 0.}, {0.5, 0.}, {1., 0.}};
  calibration.parameters  = {unknown};
  calibration.correlation = {{0.}};
  calibration.tests       = {SyntheticCalibration::test("short", "", 2),
                             SyntheticCalibration::test("one", "", 1),
                             SyntheticCalibration::test("none", "", 0),
                             SyntheticCalibration::test("flat", "", 50)};
  TestMisfit &flat        = calibration.tests.back();
  flat.noise              = 0.;
  flat.measured_work      = 0.;
  flat.measured.assign(50, 0.1);
  flat.simulated.assign(50, 0.1);
  flat.displacement.assign(50, 3.);
  calibration.starts = {{{0.5}, {}, infinity, 0, "cannot be simulated"}};
  std::vector<std::string> warnings;
  const std::string        page = page_of(calibration, &warnings);
  has_all(page, {"at bound", ">open<", ">unknown<"});
  if (has_gnuplot())
    {
      EXPECT_TRUE(warnings.empty()) << warnings[0];
    }

  // Profiles that reach nowhere and a single one.
  calibration.parameters[0].profile = {{0.5, 0.}, {0.5, infinity}};
  page_of(calibration);
  calibration.parameters[0].profile.clear();
  page_of(calibration);
}



TEST(CalibrationReport, OfManyConditionsTheWorstAreShown)
{
  Calibration calibration = SyntheticCalibration::make();
  calibration.tests.clear();
  for (int i = 0; i < 20; ++i)
    {
      calibration.tests.push_back(
        SyntheticCalibration::test("test " + std::to_string(i), "", 100));
      calibration.tests.back().rms = 0.001 * (i + 1);
    }
  const std::string page = page_of(calibration);
  EXPECT_TRUE(contains(page, "8 of 20 pictures are left out"));
  const auto data = [](const int i) {
    return content(test_folder() / "report" /
                   ("curves_" + std::to_string(i) + ".dat"));
  };
  EXPECT_TRUE(contains(data(12), "# test 19, measured"));
  EXPECT_TRUE(contains(data(1), "# test 8, measured"));
  EXPECT_FALSE(
    std::filesystem::exists(test_folder() / "report" / "curves_13.dat"));
}



TEST(CalibrationReport, LongTestsAreThinnedWithoutLosingTheirExtremes)
{
  Calibration calibration = SyntheticCalibration::make();
  calibration.tests       = {SyntheticCalibration::test("long", "", 200000)};
  TestMisfit &test        = calibration.tests[0];
  // Displacement is measured, too.
  for (std::size_t i = 0; i < test.displacement.size(); ++i)
    test.displacement[i] += 1e-3 * std::sin(1e3 * i);
  test.measured[123457] = 0.5;
  test.measured[77777]  = -0.5;
  const auto begin      = std::chrono::steady_clock::now();
  page_of(calibration);
  calibration_table(calibration);
  const std::chrono::duration<double> time =
    std::chrono::steady_clock::now() - begin;
  EXPECT_LT(time.count(), 10.);

  const std::string  text = content(test_folder() / "report" / "curves_1.dat");
  std::istringstream data(text.substr(text.find("# long, measured")));
  std::size_t        n_rows = 0;
  double             lowest = 0., highest = 0.;
  for (std::string line; std::getline(data, line) && !line.empty();)
    if (line[0] != '#')
      {
        ++n_rows;
        const double friction = std::stod(line.substr(line.find(' ')));
        lowest                = std::min(lowest, friction);
        highest               = std::max(highest, friction);
      }
  EXPECT_GT(n_rows, 500u);
  EXPECT_LE(n_rows, 2000u);
  EXPECT_EQ(lowest, -0.5);
  EXPECT_EQ(highest, 0.5);
}



// A line across parts without rows showed means that nothing has.
TEST(CalibrationReport, LocalMeansAreLeftOpenWhereRowsAreFew)
{
  Calibration calibration = SyntheticCalibration::make();
  calibration.tests       = {SyntheticCalibration::test("gap", "", 400)};
  auto &displacement      = calibration.tests[0].displacement;
  for (std::size_t i = 0; i < displacement.size(); ++i)
    displacement[i] = i < 200 ? 1e-3 * i : 10. + 1e-3 * i;
  page_of(calibration);
  const std::string text =
    content(test_folder() / "report" / "residuals_1.dat");
  const auto means = text.find("local means");
  ASSERT_NE(means, std::string::npos);
  EXPECT_NE(text.find(" NaN", means), std::string::npos);

  // A row of each part: none to be drawn, or to be in the legend.
  calibration.tests = {SyntheticCalibration::test("few", "", 40)};
  EXPECT_FALSE(contains(page_of(calibration), "></i>local mean"));
}



TEST(CalibrationReport, WhatComesBackIsShownOverTime)
{
  Calibration calibration = SyntheticCalibration::make();
  page_of(calibration);
  const auto script = [](const int i) {
    return content(test_folder() / "report" /
                   ("curves_" + std::to_string(i) + ".gp"));
  };
  // Of three conditions the last one comes back.
  EXPECT_TRUE(contains(script(2), "Displacement"));
  EXPECT_TRUE(contains(script(3), "Time"));
  // A motion that only goes back does not.
  calibration.tests = {SyntheticCalibration::test("back", "", 100)};
  for (double &displacement : calibration.tests[0].displacement)
    displacement = -displacement;
  page_of(calibration);
  EXPECT_FALSE(contains(script(1), "Time"));
}



TEST(CalibrationTable, ItFitsTheTerminalAndIsAligned)
{
  Calibration calibration               = SyntheticCalibration::make();
  calibration.tests[0].name             = std::string(120, 'x') + " µm, end";
  calibration.parameters[1].is_at_bound = true;
  const std::string  table              = calibration_table(calibration);
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);)
    EXPECT_LE(text_width(line), 100u) << line;
  has_all(table,
          {"  parameter            value   unit     95 % interval   "
           "start\n",
           "  Rate                 0.800   1/mm     0.693 … 0.954   "
           "  0.4\n",
           "* 0.1300",
           "\n  drop       0.03              ± 0.002\n",
           "µm, end   ",
           "\n  - Reference speed and Rate cannot be told"});
}



TEST(CalibrationReport, TextsOfALogarithmicAxisAreShort)
{
  EXPECT_EQ(few_tics('x', 1e-5, 0.1, true),
            "set xtics (\"1e-05\" 1e-05, \"0.0001\" 0.0001, \"0.001\" 0.001, "
            "\"0.01\" 0.01, \"0.1\" 0.1)\n");
}
