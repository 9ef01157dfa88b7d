// SPDX-License-Identifier: LGPL-2.1-or-later

// What is told of slides and of what is no slide.

#include <gtest/gtest.h>

#include <slipstep/report/figure.h>

#include <deal.II/base/numbers.h>

#include "synthetic_runs.h"

using namespace SyntheticRuns;



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
  has_none(text, {"0.1149", "1e-08", "rest before"});
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
  has_none(text, {"dip", "Kinetic friction is"});
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
  has_all(text, {"K" + trend, "<th>pressure [MPa]</th>"});
  has_none(text, {"rest before", "<th>peak</th>"});
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
  has_none(text, {"<th>kinetic</th>", "<th>r</th>"});
  EXPECT_TRUE(contains(text, "<th>slipping [%]</th>"));
  const std::string table =
    result_table(parameters_with({}), {{"front", test_folder() / "front"}});
  EXPECT_FALSE(contains(table, "kinetic"));
}



TEST(Report, WhatHasNotComeToSlidingHasNoKineticFriction)
{
  SlideSummary slide     = make_slide(2, 1., 0., 0.09, 0.09);
  slide.growth           = 0.03;
  const std::string text = told_of({make_slides("short", {slide})});
  EXPECT_TRUE(contains(text,
                       "The contact has not come to steady sliding at the end "
                       "of the slide, where friction is 0.0900: that is no "
                       "kinetic friction yet."))
    << text;
  EXPECT_FALSE(contains(text, "<th>kinetic</th>"));
  EXPECT_TRUE(contains(text, "<th>at the end</th>"));
  EXPECT_FALSE(contains(text, "<th>slipping [%]</th>"));
}



TEST(Report, FrictionThatSwingsIsNotKinetic)
{
  std::vector<SlideSummary> slides = {make_slide(2, 60., 0., 0.3, 0.21),
                                      make_slide(3, 6., 0., 0.3, 0.2),
                                      make_slide(4, 3., 0., 0.3, 0.1)};
  slides[0].swing_from             = 0.1;
  slides[0].swing_to               = 0.25;
  slides[2].slip_fraction          = 0.;
  const std::string text           = told_of({make_slides("soft", slides)});
  EXPECT_TRUE(contains(text,
                       "At 60 mm/min friction still swings between 0.1000 and "
                       "0.2500 when the slide ends: sliding is not steady "
                       "there. In 1 of the other 2 slides, only 0 % of the "
                       "contact slips"))
    << text;
}



TEST(Report, LoadsAndEnergiesHaveTheUnitsOfTheirRuns)
{
  const auto of = [](const std::string &label, const unsigned int dimension) {
    const ReportedRun run  = make_slides(label, {});
    Summary           read = read_summary(run.folder / "summary.json");
    read.dimension         = dimension;
    read.work              = 7.;
    read.quantities        = {{"force", 2., "N" + per_size(dimension)}};
    write_summary(run.folder / "summary.json", read);
    return run;
  };
  const auto page = [](const std::vector<ReportedRun> &runs) {
    write_report(test_folder(), parameters_with({}), runs);
    return content(test_folder() / "report.html");
  };
  std::string text = page({of("plane", 2), of("strip", 2)});
  has_all(text, {"<th>work put in [N mm/mm]</th>", "<th>force [N/mm]</th>"});
  text = page({of("plane", 2), of("block", 3)});
  EXPECT_TRUE(contains(text, "<th>work put in</th>"));
  EXPECT_TRUE(contains(text, "<td>7 N mm/mm</td>"));
  EXPECT_TRUE(contains(text, "<td>7 N mm</td>"));
  EXPECT_TRUE(contains(text, "<td>2 N/mm</td>"));
}



// What is a list in a label is not taken apart.
TEST(Report, LawsAreToldByAllOfTheirEffects)
{
  const std::vector<SlideSummary> slides = {make_slide(2, 1., 0., 0.2, 0.1)};
  const std::string               text =
    told_of({make_slides("subloading, softening", slides),
             make_slides("subloading, overstress, softening", slides)});
  EXPECT_TRUE(contains(text, "subloading, overstress, softening"));
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
  has_none(text, {"0.2100", "<th>kinetic</th>"});
  EXPECT_TRUE(contains(text, "<th>peak</th>"));
}



TEST(Report, WhatIsPushedIsNotSlid)
{
  const ReportedRun run     = make_slides("pushed", {});
  const auto        move_by = [&](const double displacement) {
    std::ofstream(run.folder / "history.csv").close();
    HistoryWriter writer(run.folder / "history.csv");
    for (int i = 0; i < 5; ++i)
      {
        HistoryRow row;
        row.time         = i;
        row.slip         = 0.001 * i;
        row.displacement = displacement * i;
        writer.write(row);
      }
  };
  move_by(0.);
  const std::string at_rest = told_of({run});
  EXPECT_TRUE(contains(at_rest,
                       "The programme moves no drive; under the loads on the "
                       "faces the contact has slipped by 0.004 mm."));
  const auto shows = [](const std::string &picture) {
    return content(test_folder() / "report.html")
             .find("aria-label=\"" + picture + "\"") != std::string::npos;
  };
  EXPECT_TRUE(shows("Friction over time"));
  move_by(0.001);
  const std::string moved = told_of({run});
  EXPECT_TRUE(contains(moved,
                       "The programme has no straight slide; in the end the "
                       "contact has slipped 0.004 mm."));
  EXPECT_TRUE(shows("Friction against displacement"));
  Summary summary   = read_summary(run.folder / "summary.json");
  summary.is_pushed = true;
  write_summary(run.folder / "summary.json", summary);
  const std::string text = told_of({run});
  EXPECT_TRUE(
    contains(text,
             "pushed by a load, not slid; in the end it has slipped 0.004 mm."))
    << text;
  has_none(text, {"No slide", "<table"});
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



// The peak was marked on the curve of what was followed before the first slide.
TEST(Report, ThePeakIsDrawnWhereItsSlideStarts)
{
  const ReportedRun run =
    make_slides("late", {make_slide(3, 6., 0.1, 0.12, 0.11)});
  Parameters parameters = parameters_with({});
  parameters.set("Loading/Programme",
                 "press 5 MPa in 1 s; slide 0.1 mm/s for 1 mm; slide 0.1 mm/s "
                 "for 10 mm",
                 "test");
  write_report(test_folder(), parameters, {run});
  const std::string data =
    content(test_folder() / "report" / "friction_start.dat");
  // From 11 s on.
  EXPECT_TRUE(contains(data, "\n0 0.1118769")) << data;
  // A record that is gone ends no report.
  parameters.set("Loading/Programme", "follow gone.csv", "test");
  write_report(test_folder(), parameters, {run});
  EXPECT_TRUE(contains(content(test_folder() / "report" / "friction_start.dat"),
                       "\n0 0\n"));
}



TEST(Report, WithoutAPeakNoDotMarksOne)
{
  write_report(test_folder(),
               parameters_with({}),
               {make_slides("flat", {make_slide(1, 6., 0.1, 0.11, 0.11)})});
  std::string page = content(test_folder() / "report.html");
  EXPECT_FALSE(contains(page, "dots mark"));
  write_report(test_folder(),
               parameters_with({}),
               {make_slides("peak", {make_slide(1, 6., 0.1, 0.12, 0.11)})});
  EXPECT_FALSE(has_gnuplot() &&
               !contains(content(test_folder() / "report.html"), "dots mark"));
}



// It is counted from the slide before, which the first one has not.
TEST(Report, TheFirstSlideHasNoRestBefore)
{
  std::vector<SlideSummary> slides = {make_slide(2, 1., 0.05, 0.11, 0.1),
                                      make_slide(4, 1., 0.05, 0.12, 0.1)};
  slides[1].rest                   = 30.;
  write_report(test_folder(),
               parameters_with({}),
               {make_slides("rest", slides)});
  const std::string page = content(test_folder() / "report.html");
  EXPECT_TRUE(contains(page, "<td>2</td><td>1</td><td>–</td>"));
  EXPECT_TRUE(contains(page, "<td>4</td><td>1</td><td>30</td>"));
}



// What differs by round-off was drawn from the bottom to the top.
TEST(Report, RoundOffIsNoChange)
{
  const Range constant = without_round_off({0.1 - 1e-17, 0.1});
  EXPECT_LT(constant.lower, 0.099);
  EXPECT_GT(constant.upper, 0.101);
  const Range rising = {0.1, 0.1001};
  EXPECT_EQ(without_round_off(rising).width(), rising.width());
  EXPECT_GT(without_round_off({0., 0.}).width(), 0.);

  std::vector<SlideSummary> slides = {make_slide(2, 1., 0.1, 0.1, 0.1),
                                      make_slide(3, 9., 0.1, 0.1, 0.1)};
  slides[0].kinetic                = std::nextafter(0.1, 0.);
  slides[1].angle                  = dealii::numbers::PI;
  write_report(test_folder(),
               parameters_with(
                 {{"Pictures", "kinetic over speed, kinetic over direction"}}),
               {make_slides("same", slides)});
  const auto script = [](const std::string &name) {
    return content(test_folder() / "report" / name);
  };
  EXPECT_TRUE(contains(script("picture_1.gp"), "set yrange [0.09"));
  EXPECT_TRUE(contains(script("picture_2.dat"), "\n-0.1 0\n"));
}



// One direction is one point: gnuplot takes no empty range.
TEST(Report, OneDirectionHasARange)
{
  for (const double angle : {0., dealii::numbers::PI / 2.})
    {
      std::vector<SlideSummary> slides = {make_slide(2, 1., 0.1, 0.1, 0.1)};
      slides[0].angle                  = angle;
      const std::vector<std::string> warnings =
        write_report(test_folder(),
                     parameters_with({{"Pictures", "kinetic over direction"}}),
                     {make_slides("one", slides)});
      EXPECT_TRUE(warnings.empty()) << warnings.front();
    }
}
