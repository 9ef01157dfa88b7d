// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/experiment/history.h>
#include <slipstep/friction/law.h>
#include <slipstep/experiment/point_driver.h>
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

#include "synthetic_runs.h"

using namespace SyntheticRuns;



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
  EXPECT_TRUE(contains(table, "(60 more)"));
  EXPECT_FALSE(contains(table, "pressure"));

  summary.slides.resize(2);
  summary.slides[0].pressure = 1.;
  summary.slides[1].pressure = 2.5;
  write_summary(run.folder / "summary.json", summary);
  table = result_table(parameters_with({}), {run});
  has_all(table, {"pressure [MPa]", "2.5"});
}



TEST(Report, WithoutAReferenceTheTableHasNoSuchColumns)
{
  const std::string table =
    result_table(parameters_with({}), {make_run(1., "rough")});
  EXPECT_TRUE(contains(table, "0.1122"));
  EXPECT_FALSE(contains(table, "difference"));
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
  has_all(table, {"tipped: failed: the block tips over", "'absent'"});

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
  has_none(page, {"src=", "<link", "@import"});

  if (!has_gnuplot())
    GTEST_SKIP() << "gnuplot is not installed";
  EXPECT_TRUE(warnings.empty()) << warnings[0];
  for (const std::string name : {"friction",
                                 "friction_start",
                                 "ratio_over_speed",
                                 "contact_face_1",
                                 "contact_face_2"})
    EXPECT_TRUE(contains(page, "id=\"" + name + "-")) << name;
}



// A followed test that is listed, too; another sample of the same name; the
// same test beside a second run.
TEST(Report, EveryMeasuredTestIsDrawnOnceUnderANameOfItsOwn)
{
  for (const std::string file : {"first", "second"})
    std::ofstream(test_folder() / (file + ".csv"))
      << "# name: sample\ntime_s,displacement_mm,pressure_MPa,friction\n"
         "0,0,1,0\n100,10,1,0.1\n200,20,1,0.1\n";
  const std::string first  = (test_folder() / "first.csv").string();
  const std::string second = (test_folder() / "second.csv").string();
  Parameters        parameters =
    parameters_with({{"Measured", first + ", " + second}});
  parameters.set("Loading/Programme", "follow " + first, "test");
  write_report(test_folder(),
               parameters,
               {make_run(1., "slow"), make_run(50., "fast")});
  const std::string script =
    content(test_folder() / "report" / "measured_over_displacement.gp");
  EXPECT_EQ(count(script, "sample (first), measured"), 1u) << script;
  EXPECT_EQ(count(script, "sample (second), measured"), 1u) << script;
  EXPECT_EQ(count(script, ", measured"), 2u) << script;
  const std::string page = content(test_folder() / "report.html");
  has_all(page, {"sample (first), slow: 0.0", "; sample (first), fast: 0.0"});
}



// The second pass was compared with nothing.
TEST(Report, WhatIsFollowedTwiceIsComparedTwice)
{
  const std::string file = (test_folder() / "there.csv").string();
  std::ofstream(file) << "# name: sample\n"
                         "time_s,displacement_mm,pressure_MPa,friction\n"
                         "0,0,1,0\n50,5,1,0.1\n100,10,1,0.1\n";
  Parameters parameters = parameters_with({});
  parameters.set("Loading/Programme",
                 "follow " + file + "; follow " + file,
                 "test");
  write_report(test_folder(), parameters, {make_run(1., "run")});
  const std::string script =
    content(test_folder() / "report" / "measured_over_displacement.gp");
  has_all(script, {"sample from 0 s, measured", "sample from 100 s, measured"});
  has_all(content(test_folder() / "report.html"),
          {"sample from 0 s: 0.0", "; sample from 100 s: 0.0"});
  parameters.set("Loading/Programme",
                 "repeat 7 times { follow " + file + " }",
                 "test");
  write_report(test_folder(), parameters, {make_run(1., "run")});
  const std::string many =
    content(test_folder() / "report" / "measured_over_displacement.gp");
  has_all(many,
          {"sample from 200 s, measured", "sample from 600 s, the last of 7"});
  has_none(many, {"from 300 s", "from 500 s"});
}



// Of a block on its side, and 2 m long.
TEST(Report, TheContactFaceHasTheAxesOfTheBlock)
{
  const ReportedRun run = make_run(1., "on its side");
  write_face(run, "y", "z", 500.);
  EXPECT_TRUE(none_of(write_report(test_folder(), parameters_with({}), {run}),
                      [](const std::string &warning) {
                        return contains(warning, "contact_face");
                      }));
  const std::string script =
    content(test_folder() / "report" / "contact_face_1.gp");
  has_all(script,
          {"set xlabel 'y  [mm]'",
           "set ylabel 'z  [mm]'",
           "set xrange [0:2000]",
           "set xtics 500\n",
           "set yrange [0:1500]"});
  EXPECT_TRUE(contains(content(test_folder() / "report" / "contact_face_1.dat"),
                       "half_size_z_mm"));
}



TEST(Report, NamesOfRunsSayWhatDiffersAndFindRoom)
{
  const auto page_and_script = [](const std::vector<std::string> &labels) {
    std::vector<ReportedRun> runs;
    for (const std::string &label : labels)
      runs.push_back(make_run(1., label));
    write_report(test_folder(), parameters_with({}), runs);
    return std::make_pair(content(test_folder() / "report.html"),
                          content(test_folder() / "report" / "friction.gp"));
  };
  const auto [page, script] =
    page_and_script({"10 mm, Exponent 8", "10 mm, Exponent 16"});
  EXPECT_TRUE(contains(page, ">Exponent 16<"));
  EXPECT_FALSE(contains(script, "outside below"));

  std::vector<std::string> labels;
  for (unsigned int i = 0; i < 12; ++i)
    labels.push_back("Exponent " + std::to_string(i) +
                     ", Static coefficient 0.1" + std::to_string(i));
  EXPECT_TRUE(contains(page_and_script(labels).second, "outside below"));
  labels.resize(2);
  EXPECT_TRUE(contains(page_and_script(labels).second, "outside below"));
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
    result.end                     = kinetic;
    result.has_peak                = peak > kinetic;
    result.drop                    = 100. * (1. - kinetic / peak);
    return result;
  };
  EXPECT_EQ(headline({}, none), "No slide has been reached.");
  EXPECT_EQ(headline({row(0, 1., 0.2, 0.1)}, none),
            "At 1 mm/min, friction peaks at 0.2000 after 0.02 mm and is 0.1000 "
            "in the end, 50.0 % lower.");
  EXPECT_EQ(headline({row(0, 1., 0.2, 0.2)}, none),
            "At 1 mm/min, friction comes to 0.2000 without a peak.");
  // One run, forth and back.
  EXPECT_EQ(headline({row(0, 1., 0.2, 0.16), row(0, 1., 0.16, 0.15)}, none),
            "Kinetic friction is 0.1500 to 0.1600 in 2 slides; it is 6.2 to "
            "20.0 % lower than its peak.");
  // Runs that differ in something else than speed, or in nothing.
  EXPECT_EQ(headline({row(0, 1., 0.2, 0.16), row(1, 1., 0.2, 0.1)}, none),
            "Kinetic friction ranges from 0.1000 (run 1) to 0.1600 (run 0); it "
            "is 20.0 to 50.0 % lower than its peak.");
  EXPECT_EQ(headline({row(0, 1., 0.2, 0.2), row(1, 10., 0.2, 0.2)}, none),
            "Kinetic friction is 0.2000 at 1 mm/min as at 10 mm/min; there is "
            "no drop from a peak.");
  // A difference in speed says nothing where the laws differ, too.
  EXPECT_EQ(headline({row(0, 1., 0.2, 0.16), row(1, 10., 0.2, 0.1)},
                     none,
                     false),
            "Kinetic friction ranges from 0.1000 (run 1) to 0.1600 (run 0); it "
            "is 20.0 to 50.0 % lower than its peak.");

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



TEST(Report, ThePageWorksWithoutItsScript)
{
  write_report(test_folder(), parameters_with({}), {make_run(1., "rough")});
  const std::string page   = content(test_folder() / "report.html");
  const auto        script = page.find("<script>");
  ASSERT_NE(script, std::string::npos);
  // Nothing is left to be put in by the script, and it fetches nothing.
  EXPECT_TRUE(contains(page.substr(script), "</script>\n</body>"));
  for (const std::string word : {"fetch(", "XMLHttp", "import ", "http"})
    EXPECT_FALSE(contains(page.substr(script), word)) << word;
  has_all(page, {"prefers-color-scheme: dark", "@media print"});
  if (!has_gnuplot())
    GTEST_SKIP() << "gnuplot is not installed";
  EXPECT_TRUE(contains(page, "aria-label=\"Friction against displacement\""));
  // Pixels of left, right, bottom and top, then the ranges.
  EXPECT_TRUE(contains(page, "data-axes='"));
}



TEST(Report, TheCallIsTheUsersOwn)
{
  setenv("SLIPSTEP_CALLED_AS", "./run", 1);
  Parameters parameters = parameters_with({});
  parameters.set("Report/Title", "a b", "--set");
  write_report(test_folder(), parameters, {make_run(1., "rough")});
  unsetenv("SLIPSTEP_CALLED_AS");
  has_all(content(test_folder() / "report.html"),
          {"--set &quot;Report/Title=a b&quot;", "<pre>./run run"});
}



TEST(Report, NoRunAtAllGivesAPageThatSaysSo)
{
  write_report(test_folder(), parameters_of_the_paper(), {});
  EXPECT_TRUE(contains(content(test_folder() / "report.html"),
                       "No slide has been reached"));
}



TEST(Report, PicturesThatACaseNamesAreDrawn)
{
  std::vector<SlideSummary> slides;
  for (unsigned int i = 0; i < 4; ++i)
    {
      slides.push_back(make_slide(2 * i + 2, 1., 0.05, 0.11 + 0.01 * i, 0.1));
      slides.back().rest  = i == 0 ? 0. : std::pow(10., i);
      slides.back().angle = 0.5 * i;
    }
  const auto runs = {make_slides("thin", slides), make_slides("thick", slides)};
  const auto parameters = parameters_with(
    {{"Pictures", "peak over rest, kinetic over direction, force over time"}});
  const auto warnings = write_report(test_folder(), parameters, runs);
  const auto picture  = [](const std::string &file) {
    return content(test_folder() / "report" / file);
  };
  // Both runs; the first slide follows no rest.
  has_all(picture("picture_1.dat"),
          {"# thin\n# rest peak\n10 0.12\n", "# thick"});
  EXPECT_TRUE(contains(picture("picture_1.gp"), "set logscale x"));
  EXPECT_TRUE(contains(picture("picture_1.gp"), "Time at rest before  [s]"));
  EXPECT_TRUE(contains(picture("picture_2.dat"), "\n0.1 0\n"));
  EXPECT_TRUE(contains(picture("picture_2.gp"), "set size ratio -1"));
  EXPECT_TRUE(contains(picture("picture_3.gp"), "Tangential load  [N]"));
  if (!has_gnuplot())
    GTEST_SKIP() << "gnuplot is not installed";
  EXPECT_TRUE(warnings.empty()) << warnings[0];
  const std::string page = content(test_folder() / "report.html");
  EXPECT_LT(page.find("<h2>Peak over rest"), page.find("Friction against"));
}



TEST(Report, WhatAPictureHasNoValuesOfIsSaid)
{
  const auto warnings =
    write_report(test_folder(),
                 parameters_with({{"Pictures", "peak over rest"}}),
                 {make_run(1., "rough")});
  ASSERT_FALSE(warnings.empty());
  EXPECT_TRUE(contains(warnings[0], "no picture 'peak over rest'"));
}



TEST(Report, WrongPicturesAreRefused)
{
  for (const std::string good : {"peak over rest",
                                 "critical stiffness over speed",
                                 "friction y over friction, r_s over slip"})
    EXPECT_NO_THROW(
      check_report_parameters(parameters_with({{"Pictures", good}})))
      << good;
  for (const std::string bad : {"peak",
                                "peak over",
                                "peak over moon",
                                "peak over time",
                                "peak over peak",
                                "Peak over rest",
                                "peak over rest, peak over rest"})
    try
      {
        check_report_parameters(parameters_with({{"Pictures", bad}}));
        ADD_FAILURE() << bad;
      }
    catch (const InputError &error)
      {
        EXPECT_TRUE(contains(error.what(), "Report/Pictures"));
      }
}



TEST(Report, TheLawIsShownAtWorkAndItsEffectsByFormula)
{
  const ReportedRun run     = make_run(1., "rough");
  Summary           summary = read_summary(run.folder / "summary.json");
  summary.effects           = {"softening"};
  write_summary(run.folder / "summary.json", summary);
  Parameters parameters;
  declare_loading_parameters(parameters);
  declare_report_parameters(parameters);
  FrictionLaw::declare_parameters(parameters);
  parameters.set("Friction/softening/Rate", "50 1/m", "test");
  write_report(test_folder(), parameters, {run});
  const std::string page = content(test_folder() / "report.html");
  has_all(page,
          {"<td>d mu/d lambda = -kappa (exp(a (mu - mu_k)) - 1)",
           "<td>kappa</td><td>0.05</td><td>1/mm</td>"});
  EXPECT_TRUE(contains(content(test_folder() / "report/law_friction.gp"),
                       "Path of the drive  [mm]"));
  // Nothing of it changes, so there is no curve.
  EXPECT_FALSE(std::filesystem::exists(test_folder() / "report/law_mu.gp"));
  if (!has_gnuplot())
    GTEST_SKIP() << "gnuplot is not installed";
  has_all(page, {"The law at work", "μ = 0"});
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
      EXPECT_TRUE(contains(error.what(), "\"W\""));
    }
  for (const std::string speeds : {"fast", "1, 0", "-3", "1 MPa/mm"})
    EXPECT_THROW(check_report_parameters(
                   parameters_with({{"Reference speeds", speeds}})),
                 InputError)
      << speeds;
}
