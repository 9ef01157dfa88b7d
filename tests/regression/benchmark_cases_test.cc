// SPDX-License-Identifier: LGPL-2.1-or-later

// The cases of the benchmarks make exactly the steps they promise; the timings
// themselves are no test.

#include "../solid/block_test_tools.h"

#include <gtest/gtest.h>

using namespace SlipStep;
using namespace SlipStep::Testing;

TEST(BenchmarkCases, cube_makes_one_step_per_increment)
{
  const auto result =
    run_block_case<3>(make_parameters({{"Block/Subdivisions", "3, 3, 3"}},
                                      "../tests/benchmark/calculix/cube.prm"));
  ASSERT_EQ(result.failure, "");
  EXPECT_EQ(result.summary.rejected_steps, 0u);
  ASSERT_EQ(result.history.size(), 21u);
  for (unsigned int i = 1; i <= 20; ++i)
    {
      EXPECT_NEAR(result.history[i].displacement, 0.05 * i, 1e-12);
      EXPECT_NEAR(result.history[i].friction, 0.1, 1e-6);
    }
}



TEST(BenchmarkCases, sliding_run_makes_200_steps)
{
  const auto result = run_block_case<3>(
    make_parameters({{"Loading/Speed", "1 mm/min"},
                     {"Block/Subdivisions", "4, 4, 1"},
                     {"Block/Degree", "1"}},
                    "../tests/benchmark/sliding_run/sliding_run.prm"));
  ASSERT_EQ(result.failure, "");
  EXPECT_EQ(result.summary.rejected_steps, 0u);
  EXPECT_EQ(result.summary.steps, 200u);
  // From the first slip to steady sliding and back.
  EXPECT_LT(result.history[10].friction, 0.05);
  EXPECT_GT(result.history[179].friction, 0.09);
  EXPECT_LT(result.history.back().friction, -0.09);
}
