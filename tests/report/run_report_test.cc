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

#include "tests/file_text.h"
#include "tests/temporary_folder.h"

using namespace SlipStep;

namespace
{
  Parameters parameters_with(
    const std::vector<std::pair<std::string, std::string>> &values)
  {
    Parameters parameters;
    declare_loading_parameters(parameters);
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
  EXPECT_TRUE(contains(table, "(60 more)"));
  EXPECT_FALSE(contains(table, "pressure"));

  summary.slides.resize(2);
  summary.slides[0].pressure = 1.;
  summary.slides[1].pressure = 2.5;
  write_summary(run.folder / "summary.json", summary);
  table = result_table(parameters_with({}), {run});
  EXPECT_TRUE(contains(table, "pressure [MPa]"));
  EXPECT_TRUE(contains(table, "2.5"));
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
  EXPECT_TRUE(contains(table, "tipped: failed: the block tips over"));
  EXPECT_TRUE(contains(table, "'absent'"));

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



namespace
{
  /// A run that has slid so.
  ReportedRun make_slides(const std::string               &label,
                          const std::vector<SlideSummary> &slides)
  {
    const ReportedRun run     = make_run(1., label);
    Summary           summary = read_summary(run.folder / "summary.json");
    summary.slides            = slides;
    write_summary(run.folder / "summary.json", summary);
    return run;
  }

  SlideSummary make_slide(const unsigned int statement,
                          const double       speed,
                          const double       before,
                          const double       peak,
                          const double       kinetic)
  {
    SlideSummary slide;
    slide.statement         = statement;
    slide.speed             = speed / 60.;
    slide.pressure          = 5.;
    slide.length            = 10.;
    slide.before            = before;
    slide.peak              = peak;
    slide.dip               = std::min(before, kinetic);
    slide.kinetic           = kinetic;
    slide.peak_displacement = 0.1;
    return slide;
  }

  /// Headline and table of the page.
  std::string told_of(const std::vector<ReportedRun> &runs,
                      const Parameters &parameters = parameters_with({}))
  {
    write_report(test_folder(), parameters, runs);
    const std::string page  = content(test_folder() / "report.html");
    const auto        begin = page.find("<p class='headline'>");
    return page.substr(begin, page.find("<h2>", begin) - begin);
  }
} // namespace



TEST(Report, AStepOfSpeedHasADipOrAPeakAndIsNoStaticPeak)
{
  std::vector<SlideSummary> slides = {make_slide(2, 1., 0., 0.12, 0.11),
                                      make_slide(3, 10., 0.11, 0.13, 0.115),
                                      make_slide(4, 1., 0.115, 0.1149, 0.11)};
  slides[2].dip                    = 0.1;
  slides[2].peak_displacement      = 1e-8;
  const std::string text           = told_of({make_slides("steps", slides)});
  EXPECT_TRUE(contains(text,
                       "Kinetic friction rises from 0.1100 at 1 mm/min to "
                       "0.1150 at 10 mm/min.<"));
  EXPECT_TRUE(contains(text, "<th>statement</th>"));
  EXPECT_TRUE(contains(text, "<th>dip</th>"));
  EXPECT_TRUE(contains(text, "<td>–</td><td>0.1000</td><td>0.1100</td>"));
  EXPECT_FALSE(contains(text, "0.1149"));
  EXPECT_FALSE(contains(text, "1e-08"));
  EXPECT_FALSE(contains(text, "rest before"));
}



TEST(Report, SlidesAfterRestsAreToldByTheRests)
{
  std::vector<SlideSummary> slides = {make_slide(2, 1., 0., 0.12, 0.11),
                                      make_slide(4, 1., 0.1, 0.112, 0.11),
                                      make_slide(6, 1., 0.1, 0.125, 0.11)};
  slides[1].rest                   = 10.;
  slides[2].rest                   = 1000.;
  const std::string text           = told_of({make_slides("rests", slides)});
  EXPECT_TRUE(contains(text,
                       "The peak after a rest rises from 0.1120 after 10 s to "
                       "0.1250 after 1000 s.<"));
  EXPECT_TRUE(contains(text, "<th>rest before [s]</th>"));
  EXPECT_FALSE(contains(text, "dip"));
  EXPECT_FALSE(contains(text, "Kinetic friction is"));
}



TEST(Report, PressuresAndLawsAreToldByWhatVaries)
{
  std::vector<SlideSummary> slides = {make_slide(2, 1., 0., 0.12, 0.12),
                                      make_slide(4, 1., 0., 0.1, 0.1)};
  slides[1].pressure               = 50.;
  slides[1].rest                   = 1.;
  const std::string trend = "inetic friction falls from 0.1200 at 5 MPa to "
                            "0.1000 at 50 MPa.";
  std::string       text  = told_of({make_slides("thin", slides)});
  EXPECT_TRUE(contains(text, "K" + trend));
  EXPECT_TRUE(contains(text, "<th>pressure [MPa]</th>"));
  EXPECT_FALSE(contains(text, "rest before"));
  EXPECT_FALSE(contains(text, "<th>peak</th>"));
  // Two laws in one report.
  text = told_of({make_slides("thin", slides), make_slides("thick", slides)});
  EXPECT_TRUE(contains(text, "thin: k" + trend.substr(0, trend.size() - 1)));
  EXPECT_TRUE(contains(text, "thick: k" + trend));
}



TEST(Report, AFrontThatDoesNotGetThroughHasNoKineticFriction)
{
  SlideSummary slide     = make_slide(2, 1., 0., 0.09, 0.09);
  slide.slip_fraction    = 0.4;
  const std::string text = told_of({make_slides("front", {slide})});
  EXPECT_TRUE(contains(text,
                       "Only 40 % of the contact slips at the end of the "
                       "slide, where friction is 0.0900"));
  EXPECT_FALSE(contains(text, "<th>kinetic</th>"));
  EXPECT_FALSE(contains(text, "<th>r</th>"));
  EXPECT_TRUE(contains(text, "<th>slipping [%]</th>"));
  const std::string table =
    result_table(parameters_with({}), {{"front", test_folder() / "front"}});
  EXPECT_FALSE(contains(table, "kinetic"));
}



TEST(Report, StickSlipHasAPeakAndNoKineticFriction)
{
  const ReportedRun run =
    make_slides("soft", {make_slide(2, 60., 0., 0.3, 0.21)});
  Summary summary = read_summary(run.folder / "summary.json");
  summary.stability.push_back({1., 5., 0.2, 1., 2., 7.});
  write_summary(run.folder / "summary.json", summary);
  const std::string text = told_of({run});
  EXPECT_TRUE(contains(text, "too soft for steady sliding at 60 mm/min"));
  EXPECT_FALSE(contains(text, "0.2100"));
  EXPECT_FALSE(contains(text, "<th>kinetic</th>"));
  EXPECT_TRUE(contains(text, "<th>peak</th>"));
}



TEST(Report, WhatIsPushedIsNotSlid)
{
  const ReportedRun run = make_slides("pushed", {});
  std::ofstream(run.folder / "history.csv").close();
  {
    HistoryWriter writer(run.folder / "history.csv");
    for (int i = 0; i < 5; ++i)
      {
        HistoryRow row;
        row.time = i;
        row.slip = 0.001 * i;
        writer.write(row);
      }
  }
  const std::string text = told_of({run});
  EXPECT_TRUE(
    contains(text,
             "pushed by a load, not slid; in the end it has slipped 0.004 mm."))
    << text;
  EXPECT_FALSE(contains(text, "No slide"));
  EXPECT_FALSE(contains(text, "<table"));
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
  EXPECT_TRUE(contains(page, "prefers-color-scheme: dark"));
  EXPECT_TRUE(contains(page, "@media print"));
  if (std::system("gnuplot --version > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "gnuplot is not installed";
  EXPECT_TRUE(contains(page, "aria-label=\"Friction against displacement\""));
  // Pixels of left, right, bottom and top, then the ranges.
  EXPECT_TRUE(contains(page, "data-axes='"));
}



TEST(Report, SlidesToAndFroAreNoTrend)
{
  SlideSummary back = make_slide(3, 1., -0.11, 0.12, 0.11);
  back.angle        = 3.14159265358979323846;
  const std::string text =
    told_of({make_slides("cycle", {make_slide(2, 1., 0., 0.13, 0.11), back})});
  EXPECT_TRUE(contains(
    text, "Kinetic friction is 0.1100 in 2 slides; it is 8.3 to 15.4 % lower"));
  EXPECT_TRUE(contains(text, "<td>-1</td>"));
  EXPECT_FALSE(contains(text, "rises"));
}



TEST(Report, ASlideThatIsCutShortHasNoKineticFriction)
{
  const ReportedRun run     = make_run(1., "tipped");
  Summary           summary = read_summary(run.folder / "summary.json");
  summary.slides.front().is_complete = false;
  write_summary(run.folder / "summary.json", summary);
  const std::string table = result_table(parameters_with({}), {run});
  EXPECT_TRUE(contains(table, "0.1122"));
  EXPECT_FALSE(contains(table, "kinetic"));
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
  EXPECT_TRUE(
    contains(picture("picture_1.dat"), "# thin\n# rest peak\n10 0.12\n"));
  EXPECT_TRUE(contains(picture("picture_1.dat"), "# thick"));
  EXPECT_TRUE(contains(picture("picture_1.gp"), "set logscale x"));
  EXPECT_TRUE(contains(picture("picture_1.gp"), "Time at rest before  [s]"));
  EXPECT_TRUE(contains(picture("picture_2.dat"), "\n0.1 0\n"));
  EXPECT_TRUE(contains(picture("picture_2.gp"), "set size ratio -1"));
  EXPECT_TRUE(contains(picture("picture_3.gp"), "Tangential load  [N]"));
  if (std::system("gnuplot --version > /dev/null 2>&1") != 0)
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
  EXPECT_TRUE(
    contains(page, "<td>d mu/d lambda = -kappa (exp(a (mu - mu_k)) - 1)"))
    << page;
  EXPECT_TRUE(contains(page, "<td>kappa</td><td>0.05</td><td>1/mm</td>"));
  EXPECT_TRUE(contains(content(test_folder() / "report/law_friction.gp"),
                       "Path of the drive  [mm]"));
  // Nothing of it changes, so there is no curve.
  EXPECT_FALSE(std::filesystem::exists(test_folder() / "report/law_mu.gp"));
  if (std::system("gnuplot --version > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "gnuplot is not installed";
  EXPECT_TRUE(contains(page, "The law at work"));
  EXPECT_TRUE(contains(page, "μ = 0"));
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
