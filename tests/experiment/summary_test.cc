// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/experiment/quantities.h>
#include <slipstep/experiment/summary.h>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <random>
#include <string>

#include "point_run.h"
#include "tests/file_text.h"
#include "tests/temporary_folder.h"

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  constexpr double pi = 3.14159265358979323846;

  std::filesystem::path scratch_file()
  {
    return test_folder() / "summary.json";
  }

  /// The programme sampled @p n times per segment, with a friction which rises
  /// to 0.12 after a tenth of each slide and falls to 0.1 at its end.
  std::vector<HistoryRow> sampled(const Programme   &programme,
                                  const unsigned int n)
  {
    std::vector<HistoryRow> history;
    for (const Segment &segment : programme.segments())
      for (unsigned int i = 1; i <= n; ++i)
        {
          const double share = double(i) / n;
          HistoryRow   row;
          row.time = segment.start_time +
                     share * (segment.end_time - segment.start_time);
          const Loading loading = programme.at(row.time);
          const double  magnitude =
            share < 0.1 ? 1.2 * share : 0.12 - 0.02 * (share - 0.1) / 0.9;
          const double speed     = loading.velocity.norm();
          const auto   friction  = speed > 0. ?
                                     magnitude * loading.velocity / speed :
                                     loading.velocity;
          row.displacement       = loading.displacement[0];
          row.displacement_y     = loading.displacement[1];
          row.friction           = friction[0];
          row.friction_y         = friction[1];
          row.loading_ratio.mean = 1.25;
          row.coefficient.mean   = 0.08;
          row.external_work      = 10. * row.time;
          row.stored_energy      = 1.;
          row.dissipated_energy  = 10. * row.time - 1.1;
          history.push_back(row);
        }
    return history;
  }
} // namespace



// Scripts read these keys: a change here is a change for them.
TEST(Summary, TheKeysAreTheDocumentedOnes)
{
  Summary summary;
  summary.slides.resize(1);
  summary.stability.resize(1);
  summary.mesh_error.tolerance = 0.01;
  write_summary(scratch_file(), summary);
  std::ifstream in(scratch_file());
  const auto    object = nlohmann::json::parse(in);

  const auto has_exactly = [](const nlohmann::json          &object,
                              const std::vector<std::string> keys) {
    for (const auto &key : keys)
      EXPECT_TRUE(object.contains(key)) << key;
    EXPECT_EQ(object.size(), keys.size());
  };
  has_exactly(object, {"version",        "git_hash",       "case",
                       "label",          "command",        "status",
                       "reason",         "effects",        "dimension",
                       "cells",          "dofs",           "ranks",
                       "steps",          "rejected_steps", "newton_iterations",
                       "wall_s",         "cpu_s",          "linear_iterations",
                       "friction",       "energy",         "peak_memory_MB",
                       "slides",         "quantities",     "warnings",
                       "sessions",       "stability",      "mesh_error",
                       "opening",        "probes",         "pushed",
                       "programme_crc32"});
  has_exactly(object["friction"], {"peak", "at_displacement_mm", "final"});
  has_exactly(object["energy"],
              {"work", "stored", "kinetic", "dissipated", "balance_error"});
  has_exactly(
    object["mesh_error"],
    {"tolerance", "last", "largest", "at_s", "steps_checked", "steps_missed"});
  has_exactly(object["slides"][0],
              {"speed_mm_per_min",
               "pressure_MPa",
               "angle_deg",
               "length_mm",
               "peak",
               "peak_displacement_mm",
               "kinetic",
               "r",
               "mu",
               "complete",
               "statement",
               "rest_before_s",
               "friction_before",
               "dip",
               "slip_fraction",
               "slip_rate_over_speed",
               "r_growth_at_end",
               "friction_change_at_end",
               "swing_from",
               "swing_to"});
  has_exactly(object["stability"][0],
              {"speed_mm_per_min",
               "pressure_MPa",
               "friction",
               "stiffness_MPa_per_mm",
               "critical_stiffness_MPa_per_mm",
               "critical_frequency_Hz",
               "direction_deg",
               "stable"});
}



TEST(Summary, WhatIsStableOnNoSpringReadsBack)
{
  Summary summary;
  summary.stability.push_back(
    {1., 5., 0.3, 2., std::numeric_limits<double>::infinity(), 7.});
  write_summary(scratch_file(), summary);
  const Summary read = read_summary(scratch_file());
  ASSERT_EQ(read.stability.size(), 1u);
  EXPECT_EQ(read.stability[0].critical_stiffness,
            summary.stability[0].critical_stiffness);
  EXPECT_NEAR(read.stability[0].speed, 1., 1e-15);
  EXPECT_FALSE(read.stability[0].is_stable());

  SlideSummary slide;
  slide.speed    = 1.;
  slide.pressure = 5.;
  EXPECT_TRUE(read.is_unstable(slide));
  slide.pressure = 6.;
  EXPECT_FALSE(read.is_unstable(slide));
}



TEST(Summary, ItReadsBack)
{
  Summary summary;
  summary.case_name         = "flat \"surface\"";
  summary.label             = "10 mm/min";
  summary.command           = "run";
  summary.effects           = {"overstress", "softening"};
  summary.status            = "failed";
  summary.reason            = "the block tips over";
  summary.dimension         = 3;
  summary.cells             = 5000000000ull;
  summary.dofs              = 7;
  summary.ranks             = 4;
  summary.steps             = 8;
  summary.rejected_steps    = 9;
  summary.newton_iterations = 10;
  summary.linear_iterations = 11;
  summary.wall_time         = 1. / 3.;
  summary.cpu_time          = 2. / 3.;
  summary.peak_memory       = 12.5;
  summary.peak_friction     = 0.1 / 3.;
  summary.peak_displacement = 0.2 / 3.;
  summary.final_friction    = std::nan("");
  summary.work              = 3.;
  summary.stored            = 1.;
  summary.kinetic           = 0.5;
  summary.dissipated        = 2.;
  summary.balance_error     = 1e-9;
  summary.slides     = {{1. / 60., 5.8, pi, 60., 0.12, 0.3, 0.1, 1.3, 0.08}};
  summary.quantities = {{"peak coefficient", 0.1 / 3., ""},
                        {"slip front", std::nan(""), "mm"}};
  summary.warnings   = {"one", "two"};
  write_summary(scratch_file(), summary);

  // In the file is all of it.
  const std::string text = content(scratch_file());
  const Summary     back = read_summary(scratch_file());
  write_summary(scratch_file(), back);
  EXPECT_EQ(content(scratch_file()), text);
  EXPECT_EQ(back.case_name, summary.case_name);
  EXPECT_EQ(back.cells, summary.cells);
  EXPECT_EQ(back.wall_time, summary.wall_time);
  EXPECT_TRUE(std::isnan(back.final_friction));
  ASSERT_EQ(back.slides.size(), 1u);
  EXPECT_NEAR(back.slides[0].speed, 1. / 60., 1e-17);
  EXPECT_NEAR(back.slides[0].angle, pi, 1e-15);
  ASSERT_EQ(back.quantities.size(), 2u);
  EXPECT_TRUE(std::isnan(back.quantities[1].value));
}



TEST(Summary, OtherFilesAreRefused)
{
  EXPECT_THROW(read_summary("no_such_summary.json"), InputError);
  std::ofstream(scratch_file()) << "{\"case\": 3}";
  EXPECT_THROW(read_summary(scratch_file()), InputError);
  std::ofstream(scratch_file()) << "half a fil";
  EXPECT_THROW(read_summary(scratch_file()), InputError);
}



TEST(Summary, SlidesAreSeenAlongTheirOwnDirection)
{
  const Programme programme("press 1 MPa in 1 s; slide 1 mm/s for 10 mm; "
                            "hold 5 s; slide -2 mm/s for 4 mm; "
                            "slide 1 mm/s for 2 mm at 60 deg",
                            0.,
                            ".");
  Summary         summary;
  summarise_history(sampled(programme, 100), programme, summary);

  ASSERT_EQ(summary.slides.size(), 3u);
  const std::vector<double> speeds  = {1., 2., 1.};
  const std::vector<double> angles  = {0., pi, pi / 3.};
  const std::vector<double> lengths = {10., 4., 2.};
  for (unsigned int i = 0; i < 3; ++i)
    {
      const SlideSummary &slide = summary.slides[i];
      EXPECT_NEAR(slide.speed, speeds[i], 1e-12);
      EXPECT_NEAR(slide.angle, angles[i], 1e-12);
      EXPECT_NEAR(slide.length, lengths[i], 1e-10);
      EXPECT_NEAR(slide.peak, 0.12, 1e-12);
      EXPECT_NEAR(slide.peak_displacement, 0.1 * lengths[i], 1e-10);
      EXPECT_NEAR(slide.kinetic, 0.1, 1e-12);
      EXPECT_EQ(slide.dynamic_ratio, 1.25);
      EXPECT_EQ(slide.coefficient, 0.08);
      EXPECT_EQ(slide.statement, i == 0 ? 2u : i + 3);
      EXPECT_NEAR(slide.rest, i == 1 ? 5. : 0., 1e-12);
    }
  EXPECT_NEAR(summary.peak_friction, 0.12, 1e-12);
  EXPECT_NEAR(summary.final_friction, 0.1, 1e-12);
}



// A plateau is as high everywhere but for round-off: its peak is where it
// begins.
// Each looks at its own part of the history: were it all of it, this would take
// a minute.
TEST(Summary, ThereMayBeVeryManySlides)
{
  const Programme programme(
    "press 1 MPa in 1 s; repeat 20000 times { slide 1 mm/s for 0.02 mm; slide "
    "-1 mm/s for 0.02 mm }",
    0.,
    ".");
  Summary summary;
  summarise_history(sampled(programme, 20), programme, summary);
  ASSERT_EQ(summary.slides.size(), 40000u);
  for (const std::size_t i : {0, 20001, 39999})
    {
      EXPECT_NEAR(summary.slides[i].peak, 0.12, 1e-9);
      EXPECT_NEAR(summary.slides[i].kinetic, 0.1, 1e-9);
      EXPECT_NEAR(summary.slides[i].length, 0.02, 1e-9);
    }
}



TEST(Summary, APlateauHasItsPeakWhereItBegins)
{
  const Programme programme("press 1 MPa in 1 s; slide 1 mm/s for 10 mm",
                            0.,
                            ".");
  std::vector<HistoryRow> history = sampled(programme, 100);
  std::mt19937            random(5);
  for (HistoryRow &row : history)
    row.friction =
      std::min(row.friction, 0.09) * (1. + 1e-9 * (random() % 1000) / 1000.);
  Summary summary;
  summarise_history(history, programme, summary);
  EXPECT_NEAR(summary.slides.at(0).peak, 0.09, 1e-9);
  EXPECT_NEAR(summary.slides.at(0).peak_displacement, 0.8, 0.1);
  EXPECT_NEAR(summary.peak_displacement, 0.8, 0.1);
}



TEST(Summary, TheEnergyBalanceIsRelativeToTheWork)
{
  const Programme programme("slide 1 mm/s for 10 mm", 0., ".");
  Summary         summary;
  summarise_history(sampled(programme, 10), programme, summary);
  EXPECT_NEAR(summary.peak_displacement, 1., 1e-10);
  EXPECT_NEAR(summary.work, 100., 1e-12);
  EXPECT_NEAR(summary.balance_error, 0.1 / 100., 1e-12);
  EXPECT_EQ(summary.missing_energy(), "");
  summary.balance_error = 0.0234;
  EXPECT_EQ(summary.missing_energy().find("2.3 % of the work is neither"), 0u);
}



// What is left of a closed elastic cycle is round-off.
TEST(Summary, TheEnergyBalanceOfAClosedCycleIsRelativeToWhatWentIn)
{
  const Parameters parameters = point_parameters(
    {{"Loading/Programme", "press 5 MPa in 1 s; press 0 MPa in 1 s"}});
  Summary summary;
  summarise_history(point_history(parameters),
                    parse_programme(parameters),
                    summary);
  EXPECT_LT(summary.balance_error, 1e-12);
}



TEST(Summary, AnUnfinishedHistoryGivesTheSlidesItReached)
{
  const Programme programme("slide 1 mm/s for 10 mm; slide 2 mm/s for 10 mm; "
                            "slide 3 mm/s for 10 mm",
                            0.,
                            ".");
  auto            history = sampled(programme, 100);
  history.resize(150);
  Summary summary;
  summarise_history(history, programme, summary);
  ASSERT_EQ(summary.slides.size(), 2u);
  EXPECT_NEAR(summary.slides[1].length, 5., 1e-10);
  EXPECT_TRUE(summary.slides[0].is_complete);
  EXPECT_FALSE(summary.slides[1].is_complete);

  summarise_history({}, programme, summary);
  EXPECT_TRUE(summary.slides.empty());
}



// Sliding is what goes on with the speed of the drive, on the level that r has
// come to.
TEST(Summary, HowASlideEndsIsToldApart)
{
  const Programme programme("slide 1 mm/s for 10 mm", 0., ".");
  const auto      slide = [&](const auto &change) {
    auto history = sampled(programme, 200);
    for (HistoryRow &row : history)
      {
        row.friction           = 0.2;
        row.slip               = row.displacement;
        row.loading_ratio.mean = 1.;
        change(row);
      }
    Summary summary;
    summarise_history(history, programme, summary);
    return summary.slides.at(0);
  };
  SlideSummary found = slide([](HistoryRow &) {});
  EXPECT_NEAR(found.relative_rate, 1., 1e-12);
  EXPECT_EQ(found.growth, 0.);
  EXPECT_TRUE(found.is_settled());
  // It peaks and recovers, once, and has settled then or has not.
  for (const double end : {8.9, 10.})
    {
      found = slide([&](HistoryRow &row) {
        row.friction += 0.1 * std::sin(0.9 * std::min(row.displacement, end));
      });
      EXPECT_EQ(found.is_settled(), end < 9.);
      EXPECT_FALSE(found.swings());
    }
  EXPECT_NEAR(found.change, 0.1 * (std::sin(8.1) - std::sin(9.)) / 0.3, 1e-3);

  // It goes through a valley, and on.
  found = slide([](HistoryRow &row) {
    row.friction -= 0.05 * std::cos(0.7 * (row.displacement - 7.));
  });
  EXPECT_FALSE(found.is_settled());
  EXPECT_FALSE(found.swings());
  // A saw behind the peak and the long rise with which sliding began.
  const auto saw = [&](const double end) {
    return slide([=](HistoryRow &row) {
      const double x = std::min(row.displacement, end);
      row.friction   = x < 6. ? 0.05 * x : 0.2 + 0.02 * (x - std::floor(x));
    });
  };
  found = saw(10.);
  EXPECT_FALSE(found.is_settled());
  EXPECT_NEAR(found.swing_from, 0.2, 1e-3);
  EXPECT_NEAR(found.swing_to, 0.22, 2e-3);
  EXPECT_FALSE(saw(6.5).swings());

  found = slide([](HistoryRow &row) { row.slip *= 0.5; });
  EXPECT_NEAR(found.relative_rate, 0.5, 1e-12);
  EXPECT_FALSE(found.is_settled());

  found = slide([](HistoryRow &row) {
    row.loading_ratio.mean = 1. - std::exp(-0.3 * row.displacement);
  });
  EXPECT_NEAR(found.growth,
              1. - (1. - std::exp(-2.7)) / (1. - std::exp(-3.)),
              1e-3);
  EXPECT_FALSE(found.is_settled());

  found = slide([](HistoryRow &row) {
    row.friction += 0.1 * std::sin(5. * row.displacement);
  });
  EXPECT_NEAR(found.swing_from, 0.1, 1e-3);
  EXPECT_NEAR(found.swing_to, 0.3, 1e-3);
  EXPECT_FALSE(found.is_settled());
  // Not noticed.
  found = slide([](HistoryRow &row) {
    row.friction += 0.001 * std::sin(5. * row.displacement);
  });
  EXPECT_TRUE(found.is_settled());
}



namespace
{
  Programme following(const std::string &rows)
  {
    const auto folder = test_folder();
    std::ofstream(folder / "followed.csv")
      << "time_s,displacement_mm,pressure_MPa,friction\n"
      << rows;
    return Programme("follow followed.csv", 0., folder);
  }
} // namespace



TEST(Summary, AFollowedTestIsOneSlideAtItsSpeed)
{
  const Programme programme =
    following("0,0,1,0\n5,0,1,0\n6,-3,1,0\n7,-6,1,0\n20,-6,1,0\n");
  Summary summary;
  summarise_history(sampled(programme, 10), programme, summary);
  ASSERT_EQ(summary.slides.size(), 1u);
  EXPECT_NEAR(summary.slides[0].speed, 3., 1e-12);
  EXPECT_NEAR(summary.slides[0].angle, pi, 1e-12);
  EXPECT_NEAR(summary.slides[0].length, 6., 1e-12);
}



// What it ends with is no friction at the speed that it mostly has.
TEST(Summary, AFollowedTestThatEndsSlowlyHasNoKineticLevel)
{
  const Programme programme = following("0,0,1,0\n1,10,1,0\n11,10.1,1,0\n");
  auto            history   = sampled(programme, 100);
  for (HistoryRow &row : history)
    row.slip = row.displacement;
  Summary summary;
  summarise_history(history, programme, summary);
  const double speed = (10. * 10. + 0.1 * 0.01) / 10.1;
  EXPECT_NEAR(summary.slides.at(0).speed, speed, 1e-12);
  EXPECT_NEAR(summary.slides[0].relative_rate, 0.2 / 10.01 / speed, 1e-9);
  EXPECT_FALSE(summary.slides[0].is_settled());
}



// There and back along a line is two directions, as is a corner; jitter at rest
// is none.
TEST(Summary, AFollowedTestThatTurnsRoundIsNoSlide)
{
  const auto folder = test_folder();
  const auto write  = [&](const std::string &rows) {
    std::ofstream(folder / "followed.csv")
      << "time_s,displacement_mm,displacement_y_mm,pressure_MPa,friction\n"
      << rows;
    const Programme programme("follow followed.csv", 0., folder);
    Summary         summary;
    summarise_history(sampled(programme, 10), programme, summary);
    return summary;
  };
  const Summary back = write("0,0,0,1,0\n1,1,0,1,0\n2,0.2,0,1,0\n");
  EXPECT_TRUE(back.slides.empty());
  EXPECT_GT(back.final_friction, 0.);
  EXPECT_TRUE(write("0,0,0,1,0\n1,1,0,1,0\n2,1,1,1,0\n").slides.empty());
  EXPECT_TRUE(write("0,0,0,1,0\n1,1,0,1,0\n2,0,0,1,0\n").slides.empty());
  const Summary jitter =
    write("0,0,0,1,0\n1,1,0.01,1,0\n2,0.98,0,1,0\n3,2,0,1,0\n");
  ASSERT_EQ(jitter.slides.size(), 1u);
  EXPECT_NEAR(jitter.slides[0].length, 2., 1e-12);
}



// A load moves the drive by what the history alone knows.
TEST(Summary, WhatAPushMovedIsNoPartOfASlide)
{
  for (const char *order : {"push 0.4 MPa in 1 s; slide 1 mm/s for 0.5 mm",
                            "slide 1 mm/s for 0.5 mm; push -0.2 MPa in 1 s; "
                            "slide -1 mm/s for 0.5 mm",
                            "slide 1 mm/s for 0.5 mm at 90 deg"})
    {
      const Parameters parameters = point_parameters(
        {{"Loading/Programme", std::string("press 5 MPa in 1 s; ") + order},
         {"Loading/Machine stiffness", "1 MPa/mm"}});
      Summary summary;
      summarise_history(point_history(parameters),
                        parse_programme(parameters),
                        summary);
      ASSERT_FALSE(summary.slides.empty());
      for (const SlideSummary &slide : summary.slides)
        {
          EXPECT_NEAR(slide.length, 0.5, 1e-12) << order;
          EXPECT_GE(slide.peak_displacement, 0.) << order;
          EXPECT_LE(slide.peak_displacement, 0.5 + 1e-12) << order;
        }
      EXPECT_GT(std::abs(summary.peak_displacement), 0.1) << order;
    }
}



// Friction resists where a load points.
TEST(Summary, PushesHaveADirection)
{
  for (const char *angle : {"0", "45", "90", "180"})
    for (const char *before : {"", "slide 1 mm/s for 1 mm; "})
      {
        const Parameters parameters =
          point_parameters({{"Loading/Programme",
                             std::string("press 5.8 MPa in 1 s; ") + before +
                               "push 0.3 MPa in 1 s at " + angle + " deg"}});
        const auto history = point_history(parameters);
        Summary    summary;
        summarise_history(history, parse_programme(parameters), summary);
        EXPECT_NEAR(summary.final_friction, 0.3 / 5.8, 1e-9) << before << angle;
        if (*before == '\0')
          {
            EXPECT_NEAR(summary.peak_displacement,
                        std::hypot(history.back().displacement,
                                   history.back().displacement_y),
                        1e-12)
              << angle;
          }
      }
}



// The first step of a slide can be a thousand times shorter than what a clock
// after months of rest seems to resolve.
TEST(Summary, SlidesAfterALongRestAreToldApart)
{
  const Parameters parameters = point_parameters(
    {{"Loading/Programme",
      "press 5.8 MPa in 1 s; hold 1e5 s; slide 10 mm/s for 1 mm; "
      "slide -10 mm/s for 1 mm"}});
  Summary summary;
  summarise_history(point_history(parameters),
                    parse_programme(parameters),
                    summary);
  ASSERT_EQ(summary.slides.size(), 2u);
  EXPECT_GT(summary.slides[0].kinetic, 0.98 * summary.slides[0].peak);
  EXPECT_GT(summary.slides[1].kinetic, 0.98 * summary.slides[1].peak);
}
