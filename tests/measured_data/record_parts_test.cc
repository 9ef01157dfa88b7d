// SPDX-License-Identifier: LGPL-2.1-or-later

// Records that are cut where the motion says so.

#include <slipstep/measured_data/record_parts.h>

#include <gtest/gtest.h>

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
