// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/experiment/programme.h>
#include <slipstep/utilities/exceptions.h>

#include <gtest/gtest.h>

#include <map>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "tests/file_text.h"
#include "tests/message_of.h"
#include "tests/temporary_folder.h"

using namespace SlipStep;

namespace
{
  constexpr double default_speed = 2. / 60.; // mm/s

  Programme programme_of(const std::string &text)
  {
    return Programme(text, default_speed, ".");
  }

  std::vector<std::string> warnings_of(const std::string &text)
  {
    return Programme(text, default_speed, test_folder()).warnings();
  }

  /// The message for a wrong programme, "" if it is accepted.
  std::string message_about_programme(const std::string &text)
  {
    return message_of([&] { programme_of(text); });
  }

  /// The text that begins right above the caret of a message.
  std::string under_caret(const std::string &text)
  {
    const auto caret_line = text.rfind('\n');
    const auto line       = text.rfind('\n', caret_line - 1);
    const auto offset     = text.find('^', caret_line) - caret_line;
    return text.substr(line + offset, caret_line - line - offset);
  }
} // namespace



TEST(Programme, TheExampleOfTheDesignIsRead)
{
  const Programme programme =
    programme_of("press 5.8 MPa in 1 s; hold 10 s; slide 1 mm/min for 60 mm; "
                 "hold 100 s; slide -1 mm/min for 5 mm; press 8 MPa in 1 s");
  ASSERT_EQ(programme.segments().size(), 6u);
  EXPECT_NEAR(programme.end_time(), 1 + 10 + 3600 + 100 + 300 + 1, 1e-9);
  EXPECT_DOUBLE_EQ(programme.at(0.25).pressure, 0.25 * 5.8);
  EXPECT_DOUBLE_EQ(programme.at(5.).pressure, 5.8);
  EXPECT_DOUBLE_EQ(programme.at(5.).velocity.norm(), 0.);
  EXPECT_NEAR(programme.at(11. + 60.).displacement[0], 1., 1e-12);
  EXPECT_NEAR(programme.at(11. + 60.).velocity[0], 1. / 60., 1e-15);
  EXPECT_NEAR(programme.at(3711. + 300.).displacement[0], 55., 1e-12);
  EXPECT_NEAR(programme.at(3711. + 300.).velocity[0], -1. / 60., 1e-15);
  EXPECT_NEAR(programme.at(programme.end_time() - 0.5).pressure, 6.9, 1e-9);
  EXPECT_DOUBLE_EQ(programme.largest_pressure(), 8.);
}



TEST(Programme, SegmentsJoinWithoutAJump)
{
  const auto programme = programme_of(
    "slide for 1 mm; press 3 MPa in 2 s; slide 1 mm/s for 2 s at 90 deg;"
    "press 1 MPa in 1 s; slide -1 mm/s at 45 deg for 1 mm;");
  const auto &segments = programme.segments();
  ASSERT_EQ(segments.size(), 5u);
  EXPECT_EQ(segments.front().start.pressure, 0.);
  for (std::size_t i = 1; i < segments.size(); ++i)
    {
      EXPECT_EQ(segments[i].start_time, segments[i - 1].end_time);
      EXPECT_EQ(segments[i].start.pressure, segments[i - 1].end.pressure);
      EXPECT_EQ((segments[i].start.displacement -
                 segments[i - 1].end.displacement)
                  .norm(),
                0.);
      EXPECT_EQ(segments[i].statement, i);
    }
  EXPECT_NEAR(segments[0].end_time, 1. / default_speed, 1e-9);
  EXPECT_NEAR(segments[2].end.displacement[1], 2., 1e-12);
  EXPECT_NEAR(segments[2].end.displacement[0], 1., 1e-12);
  EXPECT_NEAR(segments[4].end.displacement[0], 1. - std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(segments[4].end.displacement[1], 2. - std::sqrt(0.5), 1e-12);
}



TEST(Programme, AtTheBorderTheEarlierVelocityHolds)
{
  const Programme programme = programme_of("slide 1 mm/s for 2 mm; hold 3 s");
  EXPECT_DOUBLE_EQ(programme.at(2.).velocity[0], 1.);
  EXPECT_DOUBLE_EQ(programme.at(2.).displacement[0], 2.);
  EXPECT_DOUBLE_EQ(programme.at(2.0001).velocity[0], 0.);
}



TEST(Programme, UnitsAreConverted)
{
  EXPECT_NEAR(programme_of("slide 60 mm/min for 1 mm").end_time(), 1., 1e-12);
  EXPECT_NEAR(programme_of("hold 2 min").end_time(), 120., 1e-9);
  EXPECT_NEAR(programme_of("slide +1 mm/s for 1 min").at(60.).displacement[0],
              60.,
              1e-9);
}



TEST(Programme, AMissingSemicolonIsNamed)
{
  for (const std::string border : {",", ""})
    EXPECT_TRUE(contains(message_about_programme("press 5 MPa in 1 s" + border +
                                                 " slide 1 mm/s for 1 mm"),
                         "';': it is missing before 'slide'"));
}



TEST(Programme, CapitalsOfWordsDoNotMatter)
{
  const std::string text = "press 1 MPa in 1 s; repeat 2 times { slide 1 mm/s "
                           "for 1 mm at 30 deg }; hold 1 s";
  std::string       capitals = text;
  for (const auto &[word, other] :
       std::map<std::string, std::string>{{"press", "Press"},
                                          {"repeat", "REPEAT"},
                                          {"times", "Times"},
                                          {"slide", "Slide"},
                                          {"for", "For"},
                                          {" at ", " AT "},
                                          {" in ", " In "},
                                          {"hold", "Hold"}})
    capitals.replace(capitals.find(word), word.size(), other);
  const Programme expected = programme_of(text), found = programme_of(capitals);
  ASSERT_EQ(found.segments().size(), expected.segments().size());
  EXPECT_EQ(found.at(2.5).displacement, expected.at(2.5).displacement);
}



TEST(Programme, PushesHaveALoadAndNoMotion)
{
  const Programme programme =
    programme_of("press 5 MPa in 1 s; PUSH 0.5 MPa in 2 s at 90 deg; push "
                 "Between -0.1 MPa and 0.3 MPa 2 times, 4 s each; slide 1 mm/s "
                 "for 1 s");
  const auto &segments = programme.segments();
  ASSERT_EQ(segments.size(), 7u);
  EXPECT_FALSE(segments[0].pushes);
  EXPECT_NEAR(segments[1].push[0], 0., 1e-15);
  EXPECT_DOUBLE_EQ(segments[1].push[1], 0.5);
  for (unsigned int i = 2; i < 6; ++i)
    {
      EXPECT_TRUE(segments[i].pushes);
      EXPECT_DOUBLE_EQ(segments[i].push[0], i % 2 == 0 ? 0.3 : -0.1);
      EXPECT_DOUBLE_EQ(segments[i].end_time, 3. + 2. * (i - 1));
      EXPECT_EQ(segments[i].statement, i);
      EXPECT_DOUBLE_EQ(segments[i].end.pressure, 5.);
      EXPECT_DOUBLE_EQ(segments[i].end.velocity.norm(), 0.);
    }
  EXPECT_FALSE(segments[6].pushes);
  EXPECT_EQ(segments[6].statement, 6u);
}



TEST(Programme, TheCaretMarksTheFault)
{
  const std::string good = "press 5.8 MPa in 1 s; ";
  const std::vector<std::pair<std::string, std::string>> cases = {
    // what is wrong, what the caret has to point at
    {"sldie 1 mm/min for 60 mm", "sldie 1"},
    {"jump 1 mm", "jump 1"},
    {"slide 1 for 60 mm", " for 60"},
    {"slide 1 parsec/s for 60 mm", "parsec/s for"},
    {"slide 1 MPa for 60 mm", "MPa for"},
    {"slide fast for 60 mm", "fast for"},
    {"slide 0 mm/s for 60 mm", "0 mm/s for"},
    {"slide 1 mm/min for -60 mm", "-60 mm"},
    {"slide 1 mm/min for 0 mm", "0 mm"},
    {"slide 1 mm/min for 60", ""},
    {"slide 1 mm/min for 60 MPa", "MPa"},
    {"slide 1 mm/min", ""},
    {"slide 1 mm/min for 6 mm for 7 mm", "for 7"},
    {"slide 1 mm/min in 6 s", "in 6"},
    {"hold", ""},
    {"hold 0 s", "0 s"},
    {"hold 1 h at 20 deg", "at 20"},
    {"press -1 MPa in 1 s", "-1 MPa"},
    {"press 1 MPa within 1 s", "within 1"},
    {"press 1 MPa", ""},
    {"press 1 MPa in 0 s", "0 s"},
    {"repeat", ""},
    {"repeat 3 times", ""},
    {"repeat 3 times hold 1 s", ""},
    {"repeat { hold 1 s }", " { hold"},
    {"repeat 3 { hold 1 s }", " { hold"},
    {"repeat 0 times { hold 1 s }", "0 times"},
    {"repeat 1.5 times { hold 1 s }", "1.5 times"},
    {"repeat -2 times { hold 1 s }", "-2 times"},
    {"repeat often { hold 1 s }", "often {"},
    {"repeat 9999999999 times { hold 1 s }", "9999999999"},
    {"repeat 3 turns { hold 1 s }", "turns {"},
    {"repeat 3 times over { hold 1 s }", "times over"},
    {"repaet 3 times { hold 1 s }", "repaet"},
    {"repeat 3 times { hold 1 s", "{ hold"},
    {"repeat 3 times { hold 1 s; slide }", " }"},
    {"repeat 3 times { hold 1 }", " }"},
    {"repeat 3 times { }", "{ }"},
    {"repeat 3 times { repeat 2 times { } }", "{ } }"},
    {"repeat 3 times { hold 1 s } hold 1 s", "hold 1 s"},
    {"repeat 400 times { repeat 400 times { hold 1 s } }", "hold 1 s }"},
    {"hold 1 s { hold 1 s }", "{ hold"},
    {"{ hold 1 s }", "{ hold"},
    {"hold 1 s }", "}"},
    {"push", ""},
    {"push 1 MPa", ""},
    {"push 1 MPa in 0 s", "0 s"},
    {"push 1 mm in 1 s", "mm in"},
    {"push 1 MPa for 1 s", "for 1"},
    {"push 1e16 MPa in 1 s", "1e16"},
    {"push between 0 MPa and 1 MPa 3 times", ""},
    {"push between 0 MPa and 1 MPa, 1 s each", ""},
    {"push between 0 MPa 3 times, 1 s each", ""},
    {"push between 0 and 1 MPa 3 times, 1 s each", " and 1"},
    {"push between 1 MPa and 1 MPa 3 times, 1 s each", "and 1 MPa 3"},
    {"push between 0 MPa and 1 MPa 0 times, 1 s each", "0 times"},
    {"push between 0 MPa and 1 MPa -3 times, 1 s each", "-3 times"},
    {"push between 0 MPa and 1 MPa 90000 times, 1 s each", "90000"},
    {"push between 0 MPa and 1 MPa 3 times, 0 s each", "0 s"},
    {"push between 0 MPa and 1 MPa 3 times, 1 s each now", "between"},
    {"push between 0 MPa and 1 MPa 3 times in 1 s", "1 s"},
    {"push 3 times between 0 MPa and 1 MPa, 1 s each", "between 0 "},
    {"follow", ""},
    {"follow no such file.csv", "no such file.csv"}};
  for (const auto &[fault, expected] : cases)
    {
      const std::string text = message_about_programme(good + fault);
      ASSERT_NE(text, "") << fault << " is accepted";
      EXPECT_EQ(under_caret(text).substr(0, expected.size()), expected) << text;
      // Where nothing may follow, the caret stands behind the last word.
      if (expected.empty())
        {
          EXPECT_EQ(under_caret(text), "") << text;
        }
    }
}



TEST(Programme, ALengthWithoutForIsTold)
{
  for (const std::string extent : {"60 mm", "5 s"})
    EXPECT_TRUE(contains(message_about_programme("slide " + extent),
                         "slide for " + extent));
}



TEST(Programme, TheNearestVerbIsNamed)
{
  EXPECT_TRUE(
    contains(message_about_programme("sldie 1 mm/s for 1 mm"), "'slide'"));
  EXPECT_TRUE(
    contains(message_about_programme("pres 1 MPa in 1 s"), "'press'"));
}



TEST(Programme, LongProgrammesAreShownAroundTheFault)
{
  std::string text;
  for (int i = 0; i < 40; ++i)
    text += "hold 10 s; ";
  const std::string shown = message_about_programme(text + "hlod 1 s; " + text);
  EXPECT_EQ(under_caret(shown).substr(0, 8), "hlod 1 s");
  EXPECT_LT(shown.size(), 260u);
}



TEST(Programme, EmptyProgrammesAreRefused)
{
  EXPECT_NE(message_about_programme(""), "");
  EXPECT_NE(message_about_programme(" ; ; "), "");
}



TEST(Programme, ASlideWithoutAnySpeedIsRefused)
{
  EXPECT_THROW(Programme("slide for 1 mm", 0., "."), InputError);
}



TEST(Programme, WarningsOfAFollowedTestArePassedOn)
{
  const auto folder = test_folder();
  std::ofstream(folder / "gap.csv")
    << "time_s,displacement_mm,pressure_MPa,friction\n"
       "0,0,5,0\n1,,5,0\n2,2,5,0.1\n";
  const auto pressed = warnings_of("press 5 MPa in 1 s; follow gap.csv");
  ASSERT_EQ(pressed.size(), 1u);
  EXPECT_TRUE(contains(pressed[0], "left out: 1"));
  // The contact would slide all of the way under a part of the pressure.
  const auto late = warnings_of("follow gap.csv");
  ASSERT_EQ(late.size(), 2u);
  EXPECT_TRUE(contains(late[1],
                       "is only reached after 2 mm of motion; 'press' to this "
                       "pressure before"));
  // The same across.
  std::ofstream(folder / "across.csv")
    << "time_s,displacement_mm,displacement_y_mm,pressure_MPa,friction,"
       "friction_y\n0,0,0,5,0,0\n1,0,3,5,0,0.1\n2,0,5,5,0,0.1\n";
  const auto across = warnings_of("follow across.csv");
  ASSERT_EQ(across.size(), 1u);
  EXPECT_TRUE(contains(across[0], "is only reached after 3 mm of motion;"));
}



// A counter's stairs are no stick-slip: at half of the way it has gone on.
TEST(Programme, FollowsTheMotionThatACounterRounded)
{
  const auto    folder = test_folder();
  std::ofstream out(folder / "counted.csv");
  out << "time_s,displacement_mm,pressure_MPa,friction\n";
  for (unsigned int i = 0; i <= 400; ++i)
    out << 0.02 * i << ',' << 0.01 * std::round(0.2 * 0.02 * i / 0.01) << ",5,"
        << (i == 0 ? 0. : 0.2) << '\n';
  out.close();
  const Programme programme("press 5 MPa in 1 s; follow counted.csv",
                            default_speed,
                            folder);
  ASSERT_EQ(programme.warnings().size(), 1u);
  EXPECT_TRUE(contains(programme.warnings()[0], "rounded to 0.01 mm"));
  for (double t = 2.; t < 8.; t += 0.013)
    EXPECT_NEAR(programme.at(t).velocity[0], 0.2, 0.02) << t;
}



TEST(Programme, ARecordThatBeginsInMidSlideIsTold)
{
  const auto folder = test_folder();
  std::ofstream(folder / "sliding.csv")
    << "time_s,displacement_mm,pressure_MPa,friction\n"
       "0,7,5,0.2\n1,8,5,0.21\n2,9,5,0.2\n";
  const auto at_rest = warnings_of("press 5 MPa in 1 s; follow sliding.csv");
  ASSERT_EQ(at_rest.size(), 1u);
  EXPECT_TRUE(contains(at_rest[0], "begins at a friction of 0.2, as in"));
  EXPECT_TRUE(
    warnings_of("press 5 MPa in 1 s; slide 1 mm/s for 1 mm; follow sliding.csv")
      .empty());
}



// At a row the motion has the direction of the circle, not of the chord.
TEST(Programme, FollowsTheDirectionOfCircles)
{
  const auto         folder = test_folder();
  constexpr unsigned n      = 60;
  const double       turn   = 6.283185307179586 / n;
  {
    std::ofstream circle(folder / "circle.csv");
    circle.precision(12);
    circle << "time_s,displacement_mm,displacement_y_mm,pressure_MPa,friction,"
              "friction_y\n";
    for (unsigned int i = 0; i <= n; ++i)
      circle << i << ',' << std::cos(turn * i) << ',' << std::sin(turn * i)
             << ",5," << -0.2 * std::sin(turn * i) << ','
             << 0.2 * std::cos(turn * i) << '\n';
  }
  const Programme programme("press 5 MPa in 1 s; follow circle.csv",
                            default_speed,
                            folder);
  for (unsigned int i = 2; i < n; ++i)
    {
      const Loading end = programme.at(1. + i);
      EXPECT_NEAR(end.displacement[0], std::cos(turn * i) - 1., 1e-9);
      EXPECT_NEAR(end.displacement[1], std::sin(turn * i), 1e-9);
      const double angle = std::atan2(-end.velocity[0], end.velocity[1]);
      EXPECT_NEAR(std::remainder(angle - turn * i, 6.283185307179586),
                  0.,
                  0.05 * turn)
        << i;
    }
}



TEST(Programme, RepeatGoesOnFromWhereItEnded)
{
  const Programme programme = programme_of(
    "press 1 MPa in 1 s; repeat 2 times { slide 1 mm/s for 3 mm; "
    "repeat 3 times { hold 1 s; press 2 MPa in 1 s }; press 1 MPa in 2 s;"
    "slide -1 mm/s for 2 mm; }; hold 5 s");
  const Programme written = programme_of(
    "press 1 MPa in 1 s;"
    "slide 1 mm/s for 3 mm; hold 1 s; press 2 MPa in 1 s; hold 1 s;"
    "press 2 MPa in 1 s; hold 1 s; press 2 MPa in 1 s; press 1 MPa in 2 "
    "s; slide -1 mm/s for 2 mm;"
    "slide 1 mm/s for 3 mm; hold 1 s; press 2 MPa in 1 s; hold 1 s;"
    "press 2 MPa in 1 s; hold 1 s; press 2 MPa in 1 s; press 1 MPa in 2 "
    "s; slide -1 mm/s for 2 mm; hold 5 s");
  ASSERT_EQ(programme.segments().size(), written.segments().size());
  for (std::size_t i = 0; i < written.segments().size(); ++i)
    {
      const Segment &a = programme.segments()[i], &b = written.segments()[i];
      EXPECT_EQ(a.end_time, b.end_time);
      EXPECT_EQ(a.end.pressure, b.end.pressure);
      EXPECT_EQ(a.end.displacement, b.end.displacement);
      EXPECT_EQ(a.statement, b.statement);
      EXPECT_EQ(a.statement, i);
    }
  EXPECT_DOUBLE_EQ(programme.at(programme.end_time()).displacement[0], 2.);
}



TEST(Programme, ARepeatedTestIsReadAndWarnedOfOnce)
{
  const auto folder = test_folder();
  std::filesystem::create_directory(folder / "data");
  std::ofstream(folder / "data" / "gap.csv")
    << "time_s,displacement_mm,pressure_MPa,friction\n"
       "0,0,5,0\n1,,5,0\n2,2,5,0.1\n";
  const std::string text =
    "press 5 MPa in 1 s; repeat 3 times { follow gap.csv; hold 1 s }";
  const Programme programme(text, default_speed, folder / "data");
  EXPECT_EQ(programme.warnings().size(), 1u);
  EXPECT_DOUBLE_EQ(programme.at(programme.end_time()).displacement[0], 6.);
  EXPECT_EQ(
    relocated_programme(text, folder / "data", folder),
    "press 5 MPa in 1 s; repeat 3 times { follow data/gap.csv; hold 1 s }");
}



TEST(Programme, FollowReplaysMotionAcrossAndPressure)
{
  const auto folder = test_folder();
  std::ofstream(folder / "path.csv")
    << "time_s,displacement_mm,pressure_MPa,friction,displacement_y_mm\n"
       "0,1,5,0,3\n1,2,5,0.1,3\n2,2,7,0.1,5\n3,1,4,-0.1,5\n";
  const Programme programme("press 5 MPa in 1 s; follow path.csv",
                            default_speed,
                            folder);
  const Loading   after_two = programme.at(3.), end = programme.at(4.);
  EXPECT_DOUBLE_EQ(after_two.displacement[0], 1.);
  EXPECT_DOUBLE_EQ(after_two.displacement[1], 2.);
  EXPECT_DOUBLE_EQ(after_two.velocity[1], 2.);
  EXPECT_DOUBLE_EQ(after_two.pressure, 7.);
  EXPECT_DOUBLE_EQ(end.displacement[0], 0.);
  EXPECT_DOUBLE_EQ(end.displacement[1], 2.);
  EXPECT_DOUBLE_EQ(end.pressure, 4.);
}



TEST(Programme, FollowReplaysATest)
{
  const auto folder = test_folder();
  std::ofstream(folder / "my test for one.csv")
    << "# name: replay\ntime_s,displacement_mm,pressure_MPa,friction\n"
       "100,7,5,0\n101,7,5,0\n103,9,6,0.1\n";

  const Programme programme(
    "press 5 MPa in 1 s; slide 1 mm/s for 4 mm; follow my test for one.csv",
    default_speed,
    folder);
  ASSERT_EQ(programme.segments().size(), 4u);
  EXPECT_EQ(programme.segments()[3].statement, 2u);
  EXPECT_DOUBLE_EQ(programme.end_time(), 8.);
  EXPECT_DOUBLE_EQ(programme.at(6.).displacement[0], 4.);
  EXPECT_DOUBLE_EQ(programme.at(7.).displacement[0], 5.);
  EXPECT_DOUBLE_EQ(programme.at(7.).pressure, 5.5);
  EXPECT_DOUBLE_EQ(programme.at(8.).displacement[0], 6.);
  EXPECT_DOUBLE_EQ(programme.at(7.).velocity[0], 1.);
}
