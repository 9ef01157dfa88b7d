// SPDX-License-Identifier: LGPL-2.1-or-later

// Records that are cut where the motion says so.

#include <slipstep/measured_data/record_parts.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace SlipStep;



// A rest of 3 s at every turn belongs to the stroke that follows, however noisy
// the position is; without rests a turn is where the position is farthest.
TEST(RecordParts, RestsAtReversalsBelongToTheNextStroke)
{
  for (const double noise : {0., 2e-4, 1e-3})
    for (const double rest : {3., 0.})
      {
        std::mt19937                     random(5);
        std::normal_distribution<double> normal(0., noise);
        MeasuredTest                     record;
        double                           x = 0., way = 1.;
        for (int stroke = 0; stroke < 8; ++stroke, way = -way)
          for (int i = 0; i < 50. * (4. + rest); ++i)
            {
              if (i >= 50. * rest || stroke == 0)
                x += 0.02 * way;
              record.time.push_back(0.02 * record.time.size());
              record.displacement.push_back(x +
                                            (noise > 0. ? normal(random) : 0.));
              record.pressure.push_back(5.);
              record.friction.push_back(0.1 * way);
            }
        const auto parts = cut_record(record, "at reversals");
        ASSERT_EQ(parts.size(), 8u) << noise << ' ' << rest;
        for (std::size_t i = 1; i < parts.size(); ++i)
          EXPECT_NEAR(record.time[parts[i].begin],
                      (4. + rest) * i,
                      0.06 + 60. * noise)
            << noise << ' ' << rest;
      }
}



// A crank is slow where it turns, but does not rest there.
TEST(RecordParts, StrokesOfACrankAreCutWhereItTurns)
{
  std::mt19937                     random(6);
  std::normal_distribution<double> normal(0., 0.005);
  MeasuredTest                     record;
  for (int i = 0; i < 2000; ++i)
    {
      const double t = 0.01 * i;
      record.time.push_back(t);
      record.displacement.push_back(2.5 * (1. - std::cos(3.14159265 * t)) +
                                    normal(random));
      record.pressure.push_back(5.);
      record.friction.push_back(0.1);
    }
  const auto parts = cut_record(record, "at reversals");
  ASSERT_GE(parts.size(), 19u);
  for (std::size_t i = 1; i + 1 < parts.size(); ++i)
    EXPECT_NEAR(record.time[parts[i].begin], i, 0.025);
}
