// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/experiment/history.h>
#include <slipstep/report/run_report.h>
#include <slipstep/report/run_results.h>
#include <slipstep/experiment/summary.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/file_text.h"
#include "tests/temporary_folder.h"

using namespace SlipStep;

namespace
{
  Parameters parameters_with(
    const std::vector<std::pair<std::string, std::string>> &values)
  {
    Parameters parameters;
    declare_report_parameters(parameters);
    for (const auto &[key, value] : values)
      parameters.set("Report/" + key, value, "test");
    return parameters;
  }

  Parameters parameters_of_the_paper()
  {
    return parameters_with(
      {{"Title", "Flat <surface> test"},
       {"Reference kinetic coefficient", "0.00420*log(V) + 0.100"},
       {"Reference name", "eq. 4"},
       {"Reference quasi-static coefficient", "0.078"},
       {"Reference speeds", "1, 10, 50, 200"}});
  }

  /// A run whose friction peaks at 0.5 mm and ends 1 % above eq. 4.
  ReportedRun make_run(const double speed, const std::string &label)
  {
    const auto folder = test_folder() / label;
    std::filesystem::create_directories(folder);

    SlideSummary slide;
    slide.speed             = speed / 60.;
    slide.length            = 20.;
    slide.kinetic           = 1.01 * (0.0042 * std::log(speed) + 0.1);
    slide.peak              = slide.kinetic / 0.9;
    slide.peak_displacement = 0.5;
    slide.dynamic_ratio     = slide.kinetic / 0.078;
    slide.coefficient       = 0.078;

    HistoryWriter writer(folder / "history.csv");
    for (int i = 0; i <= 200; ++i)
      {
        HistoryRow row;
        row.time         = i;
        row.displacement = 0.1 * i;
        row.friction =
          i < 5 ? slide.peak * i / 5. :
                  slide.peak + (slide.kinetic - slide.peak) * (i - 5) / 195.;
        writer.write(row);
      }

    Summary summary;
    summary.case_name      = "flat";
    summary.label          = label;
    summary.command        = "run";
    summary.slides         = {slide};
    summary.status         = "finished";
    summary.final_friction = slide.kinetic;
    write_summary(folder / "summary.json", summary);
    return {label, folder};
  }

  void write_face(const ReportedRun &run)
  {
    std::ofstream out(run.folder / "contact_face.csv");
    out << "x_mm,y_mm,cell_size_x_mm,cell_size_y_mm,area_mm2,pressure_MPa,"
           "traction_x_MPa,traction_y_MPa,slip_mm,r,r_s,mu\n";
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 3; ++j)
        out << i + 0.5 << "," << j + 0.5 << ",1,1,1," << 5.8 + 0.1 * i
            << ",0,0," << 20 - 0.001 * j << ",1,1,0.078\n";
  }
} // namespace



TEST(Report, TheTableComparesWithTheReference)
{
  const std::string table =
    result_table(parameters_of_the_paper(),
                 {make_run(1., "1 mm/min"), make_run(50., "50 mm/min")});
  EXPECT_EQ(table,
            "  speed [mm/min]     peak   kinetic    eq. 4   difference [%]\n"
            "  -----------------------------------------------------------\n"
            "  1                0.1122    0.1010   0.1000            +1.00\n"
            "  50               0.1307    0.1176   0.1164            +1.00\n");
}



TEST(Report, ManySlidesAreShortenedAndPressuresShown)
{
  const ReportedRun run     = make_run(1., "cycles");
  Summary           summary = read_summary(run.folder / "summary.json");
  summary.slides.assign(100, summary.slides[0]);
  write_summary(run.folder / "summary.json", summary);
  std::string table = result_table(parameters_with({}), {run});
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 2 + 20 + 1 + 20);
  EXPECT_TRUE(contains(table, "(60 more)")) << table;
  EXPECT_FALSE(contains(table, "pressure"));

  summary.slides.resize(2);
  summary.slides[0].pressure = 1.;
  summary.slides[1].pressure = 2.5;
  write_summary(run.folder / "summary.json", summary);
  table = result_table(parameters_with({}), {run});
  EXPECT_TRUE(contains(table, "pressure [MPa]")) << table;
  EXPECT_TRUE(contains(table, "2.5")) << table;
}



TEST(Report, WithoutAReferenceTheTableHasNoSuchColumns)
{
  const std::string table =
    result_table(parameters_with({}), {make_run(1., "rough")});
  EXPECT_TRUE(contains(table, "rough")) << table;
  EXPECT_FALSE(contains(table, "difference")) << table;
}



TEST(Report, FailedAndMissingRunsAreNamed)
{
  const ReportedRun run     = make_run(1., "tipped");
  Summary           summary = read_summary(run.folder / "summary.json");
  summary.status            = "failed";
  summary.reason            = "the block tips over";
  write_summary(run.folder / "summary.json", summary);

  const std::vector<ReportedRun> runs = {run, {"absent", "no/such/folder"}};
  const std::string table             = result_table(parameters_with({}), runs);
  EXPECT_TRUE(contains(table, "tipped: failed: the block tips over")) << table;
  EXPECT_TRUE(contains(table, "'absent'")) << table;

  const auto warnings = write_report(test_folder(), parameters_with({}), runs);
  ASSERT_GE(warnings.size(), 1u);
  EXPECT_TRUE(contains(warnings[0], "'absent'"));
  EXPECT_TRUE(
    contains(content(test_folder() / "report.html"), "the block tips over"));
}



TEST(Report, ThePageIsCompleteInItself)
{
  const std::vector<ReportedRun> runs = {make_run(1., "1 mm/min"),
                                         make_run(200., "200 mm/min")};
  write_face(runs[0]);
  write_face(runs[1]);
  const auto warnings =
    write_report(test_folder(), parameters_of_the_paper(), runs);
  for (const std::string name : {"friction",
                                 "friction_start",
                                 "ratio_over_speed",
                                 "contact_face_1",
                                 "contact_face_2"})
    for (const std::string end : {".dat", ".gp"})
      EXPECT_TRUE(
        std::filesystem::exists(test_folder() / "report" / (name + end)))
        << name + end;

  const std::string page = content(test_folder() / "report.html");
  EXPECT_TRUE(contains(page, "Flat &lt;surface&gt; test"));
  EXPECT_TRUE(contains(page,
                       "Kinetic friction rises from 0.1010 at 1 mm/min to "
                       "0.1235 at 200 mm/min, 1.0 % above eq. 4; it is "
                       "10.0 % lower than its peak."));
  EXPECT_TRUE(contains(page, "slipstep run"));
  // Nothing is fetched from elsewhere.
  EXPECT_FALSE(contains(page, "src="));
  EXPECT_FALSE(contains(page, "<link"));
  EXPECT_FALSE(contains(page, "@import"));

  if (std::system("gnuplot --version > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "gnuplot is not installed";
  EXPECT_TRUE(warnings.empty()) << warnings[0];
  for (const std::string name : {"friction",
                                 "friction_start",
                                 "ratio_over_speed",
                                 "contact_face_1",
                                 "contact_face_2"})
    EXPECT_TRUE(contains(page, "id=\"" + name + "-")) << name;
}



TEST(Report, TheHeadlineClaimsNoMoreThanThereIs)
{
  const Reference none(parameters_with({}));
  const auto      row = [](const std::size_t run,
                      const double      speed,
                      const double      peak,
                      const double      kinetic) {
    ResultRow result;
    result.run                     = run;
    result.label                   = "run " + std::to_string(run);
    result.slide.speed             = speed / 60.;
    result.slide.peak              = peak;
    result.slide.peak_displacement = 0.02;
    result.slide.kinetic           = kinetic;
    result.drop                    = 100. * (1. - kinetic / peak);
    return result;
  };
  EXPECT_EQ(headline({}, none), "No slide has been reached.");
  EXPECT_EQ(headline({row(0, 1., 0.2, 0.1)}, none),
            "At 1 mm/min, friction peaks at 0.2000 after 0.02 mm and is 0.1000 "
            "in the end, 50.0 % lower.");
  EXPECT_EQ(headline({row(0, 1., 0.2, 0.2)}, none),
            "At 1 mm/min, friction rises to 0.2000 without a peak.");
  // One run, forth and back.
  EXPECT_EQ(headline({row(0, 1., 0.2, 0.16), row(0, 1., 0.16, 0.15)}, none),
            "Kinetic friction is 0.1500 to 0.1600 in 2 slides; it is 6.2 to "
            "20.0 % lower than its peak.");
  // Runs that differ in something else than speed, or in nothing.
  EXPECT_EQ(headline({row(0, 1., 0.2, 0.16), row(1, 1., 0.2, 0.1)}, none),
            "Kinetic friction ranges from 0.1000 (run 1) to 0.1600 (run 0); it "
            "is 20.0 to 50.0 % lower than its peak.");
  EXPECT_EQ(headline({row(0, 1., 0.2, 0.2), row(1, 10., 0.2, 0.2)}, none),
            "Kinetic friction is 0.2000 in 2 slides; there is no drop from a "
            "peak.");

  ResultRow cut_short         = row(0, 1., 0.2, 0.2);
  cut_short.slide.is_complete = false;
  EXPECT_EQ(headline({cut_short}, none), "No slide has been completed.");
  // What a slide that sticks and slips ends with is no kinetic friction.
  ResultRow jerky = row(1, 10., 0.3, 0.1);
  jerky.is_steady = false;
  EXPECT_EQ(headline({jerky}, none),
            "The machine is too soft for steady sliding at 10 mm/min: "
            "stick-slip.");
  EXPECT_EQ(headline({row(0, 1., 0.2, 0.1), jerky}, none),
            headline({row(0, 1., 0.2, 0.1)}, none) + " " +
              headline({jerky}, none));
}



TEST(Report, ASlideThatIsCutShortHasNoKineticFriction)
{
  const ReportedRun run     = make_run(1., "tipped");
  Summary           summary = read_summary(run.folder / "summary.json");
  summary.slides.front().is_complete = false;
  write_summary(run.folder / "summary.json", summary);
  const std::string table = result_table(parameters_with({}), {run});
  EXPECT_TRUE(contains(table, "0.1122         –")) << table;
}



TEST(Report, TheCallIsTheUsersOwn)
{
  setenv("SLIPSTEP_CALLED_AS", "./run", 1);
  Parameters parameters = parameters_with({});
  parameters.set("Report/Title", "a b", "--set");
  write_report(test_folder(), parameters, {make_run(1., "rough")});
  unsetenv("SLIPSTEP_CALLED_AS");
  EXPECT_TRUE(contains(content(test_folder() / "report.html"),
                       "--set &quot;Report/Title=a b&quot;"));
  EXPECT_TRUE(
    contains(content(test_folder() / "report.html"), "<pre>./run run"));
}



TEST(Report, NoRunAtAllGivesAPageThatSaysSo)
{
  write_report(test_folder(), parameters_of_the_paper(), {});
  EXPECT_TRUE(contains(content(test_folder() / "report.html"),
                       "No slide has been reached"));
}



TEST(Report, WrongReferencesAreRefused)
{
  EXPECT_NO_THROW(check_report_parameters(parameters_with({})));
  EXPECT_NO_THROW(check_report_parameters(parameters_of_the_paper()));
  EXPECT_NO_THROW(check_report_parameters(
    parameters_with({{"Reference speeds", "1 mm/min, 0.5 mm/s"}})));
  for (const std::string formula :
       {"0.1 +", "0.1*W", "log(V", "1/0", "log(V-2)"})
    EXPECT_THROW(check_report_parameters(parameters_with(
                   {{"Reference kinetic coefficient", formula}})),
                 InputError)
      << formula;
  try
    {
      check_report_parameters(
        parameters_with({{"Reference kinetic coefficient", "0.1*W"}}));
    }
  catch (const InputError &error)
    {
      EXPECT_TRUE(contains(error.what(), "\"W\"")) << error.what();
    }
  for (const std::string speeds : {"fast", "1, 0", "-3", "1 MPa/mm"})
    EXPECT_THROW(check_report_parameters(
                   parameters_with({{"Reference speeds", speeds}})),
                 InputError)
      << speeds;
}
