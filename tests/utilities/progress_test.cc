// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/utilities/progress.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "tests/file_text.h"

using namespace SlipStep;



TEST(Progress, AFileGetsFewPlainLines)
{
  std::ostringstream out;
  {
    Progress progress(false, "10 mm/min", out, false);
    for (int i = 0; i <= 1000; ++i)
      progress.update(i / 1000., "step " + std::to_string(i));
    progress.finish();
    progress.finish();
  }
  const std::string text = out.str();
  const auto        n    = std::count(text.begin(), text.end(), '\n');
  EXPECT_GE(n, 19);
  EXPECT_LE(n, 23);
  EXPECT_EQ(text.find('\r'), std::string::npos);
  EXPECT_EQ(text.find("[  0.0 %] 10 mm/min: step 0\n"), 0u);
  EXPECT_TRUE(contains(text, "[100.0 %] 10 mm/min: done in "));
}



TEST(Progress, ATerminalGetsOneLiveLine)
{
  std::ostringstream out;
  {
    Progress progress(false, "", out, true);
    for (int i = 0; i <= 1000; ++i)
      progress.update(i / 1000., "step");
  }
  const std::string text = out.str();
  EXPECT_EQ(text.find("\r\033[K[  0.0 %] step"), 0u);
  // Left open, it is ended, so that a message starts on its own line.
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
  EXPECT_EQ(text.back(), '\n');
  // A thousand updates within an instant must not flood the terminal.
  EXPECT_LE(std::count(text.begin(), text.end(), '\r'), 3);
}



TEST(Progress, TheTimeLeftIsNotCutOff)
{
  std::ostringstream out;
  Progress           progress(false, "", out, true);
  progress.update(0.2, std::string(300, 'x'), 7.);
  const std::string text = out.str();
  const std::string last = text.substr(text.rfind('\r'));
  EXPECT_TRUE(contains(last, "x ..., about "));
  EXPECT_TRUE(contains(last, "7.0 s left"));
}



TEST(Progress, ATimeLeftThatIsNotKnownIsNotTold)
{
  std::ostringstream out;
  {
    Progress progress(false, "", out, false);
    progress.update(0.5, "half");
  }
  EXPECT_EQ(out.str(), "[ 50.0 %] half\n");
}



TEST(Progress, QuietPrintsNothing)
{
  std::ostringstream out;
  {
    Progress progress(true, "x", out, true);
    progress.update(0.5, "half");
    progress.finish();
  }
  EXPECT_EQ(out.str(), "");
}



TEST(Progress, LinesAreReadBack)
{
  ProgressLine line;
  ASSERT_TRUE(parse_progress_line(
    "[ 42.5 %] 10 mm/min: 12.3 mm, step 240, about 1 min 12 s left", line));
  EXPECT_DOUBLE_EQ(line.fraction, 0.425);
  EXPECT_EQ(line.text, "12.3 mm, step 240");
  EXPECT_EQ(line.time_left, 72.);
  ASSERT_TRUE(parse_progress_line("[  4.0 %] 12.3 mm, step 240", line));
  EXPECT_EQ(line.text, "12.3 mm, step 240");
  EXPECT_TRUE(std::isnan(line.time_left));
  ASSERT_TRUE(parse_progress_line("[100.0 %] done in 3.0 s", line));
  EXPECT_EQ(line.fraction, 1.);
  EXPECT_EQ(line.text, "done in 3.0 s");
  EXPECT_FALSE(parse_progress_line("warning: 42 % of nothing", line));
  EXPECT_FALSE(parse_progress_line("[note] something", line));
  EXPECT_FALSE(parse_progress_line("", line));
}



TEST(Progress, DurationsAreWords)
{
  EXPECT_EQ(duration_in_words(0.25), "0.2 s");
  EXPECT_EQ(duration_in_words(59.4), "59 s");
  EXPECT_EQ(duration_in_words(59.6), "1 min 0 s");
  EXPECT_EQ(duration_in_words(200.), "3 min 20 s");
  EXPECT_EQ(duration_in_words(7500.), "2 h 5 min");
  for (const double seconds : {0.2, 59., 60., 200., 7500.})
    EXPECT_EQ(parse_duration(duration_in_words(seconds)), seconds);
  EXPECT_TRUE(std::isnan(parse_duration("long")));
}
