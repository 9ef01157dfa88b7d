// SPDX-License-Identifier: LGPL-2.1-or-later

// Replicates that contradict each other.

#include <slipstep/diagnosis/outlier.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace SlipStep;

namespace
{
  const Noise noise = {1., 0.005, 0.1, 0.006, 0.002, 0.001};

  // Of nine conditions with two tests each.
  std::vector<Contrast> contrasts_of(std::mt19937_64 &random)
  {
    Series series;
    for (std::size_t i = 0; i < 60; ++i)
      {
        series.time.push_back(i / 59.);
        series.row_noise.push_back(1e-3);
        series.friction.push_back(0.1);
      }
    std::vector<Contrast> result;
    for (std::size_t c = 0; c < 9; ++c)
      result.push_back({{series},
                        0.1,
                        sample_noise({series}, 0.1, noise, random),
                        {2 * c, 2 * c + 1}});
    return result;
  }

  std::optional<Contradiction>
  contradiction(const std::vector<Contrast> &contrasts)
  {
    const Noise present = estimate_noise(contrasts, noise).noise;
    return find_contradiction(contrasts, present, noise, 1);
  }
} // namespace



// Chance alone makes one in a hundred campaigns contradict itself.
TEST(Outlier, NoiseIsNoContradiction)
{
  std::mt19937_64 random(3);
  unsigned int    n = 0;
  for (unsigned int campaign = 0; campaign < 40; ++campaign)
    n += contradiction(contrasts_of(random)).has_value();
  EXPECT_LE(n, 3u);
}



// One test off by a third, and two under different conditions, each of which
// makes the noise seem so large that the other is nothing.
TEST(Outlier, OneAndTwoWrongTestsAreFound)
{
  std::mt19937_64 random(4);
  for (const std::vector<std::size_t> &wrong :
       {std::vector<std::size_t>{5}, std::vector<std::size_t>{2, 7}})
    for (unsigned int campaign = 0; campaign < 5; ++campaign)
      {
        std::vector<Contrast> contrasts = contrasts_of(random);
        for (const std::size_t c : wrong)
          contrasts[c].values.array() += 0.3 * 0.1 / std::sqrt(2.);
        const auto found = contradiction(contrasts);
        ASSERT_TRUE(found.has_value()) << wrong.size();
        EXPECT_EQ(std::count(wrong.begin(), wrong.end(), found->tests[0] / 2),
                  1);
      }
}
