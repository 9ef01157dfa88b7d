// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/rounding_noise.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace SlipStep;

namespace
{
  // Half a step is a little more than five rows.
  constexpr double row_step = 1e-3, q = 0.0101, slope = 5.;

  // A flank of 0.02 mm, sliding, and a rest.
  CampaignTest flank_and_rest(const double motion_step)
  {
    MeasuredTest test;
    for (unsigned int i = 0; i < 200; ++i)
      {
        const double place = row_step * std::min(i, 150u);
        test.time.push_back(0.1 * i);
        test.displacement.push_back(place);
        test.pressure.push_back(5.);
        test.friction.push_back(std::min(slope * place, 0.1));
      }
    CampaignTest result{test, {{1., 0., 0.001}}, true, Replay(test)};
    result.motion_step = motion_step;
    return result;
  }
} // namespace



// On the flank slope times q over sqrt(12), and as little for all eleven rows
// within q as for one; none in steady sliding and at rest, where a place more
// or less changes nothing.
TEST(RoundingNoise, IsThatOfTheFlanks)
{
  const std::vector<CampaignTest> tests = {flank_and_rest(q),
                                           flank_and_rest(0.)};
  const Comparison                comparison(tests);
  const Eigen::VectorXd           noise =
    rounding_noise(comparison, tests, comparison.measured);
  ASSERT_EQ(noise.size(), 400);
  const double on_flank = slope * q * std::sqrt(11. / 12.);
  for (unsigned int i = 7; i < 15; ++i)
    EXPECT_NEAR(noise(i), on_flank, 1e-12) << i;
  // At the end of the flank half of it.
  EXPECT_NEAR(noise(20), 0.5 * on_flank, 1e-12);
  EXPECT_EQ(noise.segment(27, 200 - 27).norm(), 0.);
  EXPECT_EQ(noise.tail(200).norm(), 0.);
}



// Rows twice as far from each other as a step: half a step to either side.
TEST(RoundingNoise, IsSeenBetweenRowsThatAreFarFromEachOther)
{
  const double                    step  = 0.5 * row_step;
  const std::vector<CampaignTest> tests = {flank_and_rest(step)};
  const Comparison                comparison(tests);
  const Eigen::VectorXd           noise =
    rounding_noise(comparison, tests, comparison.measured);
  for (unsigned int i = 1; i < 20; ++i)
    EXPECT_NEAR(noise(i), slope * step / std::sqrt(12.), 1e-12) << i;
  EXPECT_EQ(noise.tail(200 - 22).norm(), 0.);
}
