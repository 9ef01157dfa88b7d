// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/experiment/run_recorder.h>

#include <gtest/gtest.h>

#include "point_run.h"
#include "tests/temporary_folder.h"

using namespace SlipStep;

namespace
{
  /// What is printed of a slide of 1000 s in so many steps of a size each.
  std::string printed_of(const std::string &effects,
                         const unsigned int n_steps,
                         const double       step)
  {
    Parameters parameters = Testing::point_parameters(
      {{"Loading/Programme", "press 5 MPa in 1 s; slide 1 mm/s for 1000 mm"},
       {"Friction/Effects", effects}});
    declare_quantities(parameters);
    RunOptions options;
    options.output = test_folder();
    RunRecorder recorder(parameters,
                         options,
                         "point",
                         FrictionLaw(parameters),
                         parse_programme(parameters));
    HistoryRow  row;
    row.pressure = 5.;
    testing::internal::CaptureStdout();
    for (unsigned int i = 0; i < n_steps; ++i)
      {
        row.time += step;
        recorder.record(row);
      }
    return testing::internal::GetCapturedStdout();
  }

  bool is_in(const std::string &part, const std::string &text)
  {
    return text.find(part) != std::string::npos;
  }
} // namespace



// Vibrations that are resolved for ever: what else would do is told, once.
TEST(RunRecorder, TellsOfAPaceThatDoesNotEnd)
{
  const std::string text = printed_of("subloading, adhesion", 4100, 1e-6);
  const std::string pace = "note: the last 2000 steps advanced the time of "
                           "the programme by 1e-06 s each; at that pace it "
                           "takes 1e+09 more steps; a larger "
                           "Time stepping/Tolerance";
  ASSERT_TRUE(is_in(pace, text)) << text;
  EXPECT_FALSE(is_in(pace, text.substr(text.find(pace) + 1)));
  EXPECT_TRUE(is_in("Friction/adhesion/Largest coefficient of 1 or 2", text));
  EXPECT_FALSE(
    is_in("Largest coefficient", printed_of("subloading", 4100, 1e-6)));
  // In 20 times as many steps it is over.
  EXPECT_FALSE(is_in("pace", printed_of("subloading", 4100, 0.02)));
  EXPECT_FALSE(is_in("pace", printed_of("subloading", 2000, 1e-6)));
}
