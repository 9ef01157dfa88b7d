// SPDX-License-Identifier: LGPL-2.1-or-later

// When fields are written.

#include "block_test_tools.h"

#include <slipstep/experiment/programme.h>
#include <slipstep/solid/field_schedule.h>
#include <slipstep/utilities/exceptions.h>

#include <gtest/gtest.h>

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  // Ten steps of 0.3 s and 0.3 mm; a statement ends with the fifth. Those that
  // are written.
  std::vector<unsigned int> written(const std::string &fields)
  {
    const FieldSchedule schedule(make_parameters({{"Output/Fields", fields}}));
    std::vector<unsigned int> result;
    for (unsigned int n = 1; n <= 10; ++n)
      if (schedule.is_due({0.3 * (n - 1),
                           0.3 * n,
                           0.3 * (n - 1),
                           0.3 * n,
                           n,
                           n == 5 || n == 10,
                           n == 10}))
        result.push_back(n);
    return result;
  }

  using Steps = std::vector<unsigned int>;
} // namespace



TEST(FieldSchedule, writes_what_is_due_and_the_end)
{
  EXPECT_EQ(written("none"), Steps());
  EXPECT_EQ(written("end"), Steps({10}));
  EXPECT_EQ(written("statements"), Steps({5, 10}));
  EXPECT_EQ(written("every 4 steps"), Steps({4, 8, 10}));
  EXPECT_EQ(written("every 1 step").size(), 10u);
  // At the end of the first step that gets there; exact multiples count.
  EXPECT_EQ(written("every 1 mm"), Steps({4, 7, 10}));
  EXPECT_EQ(written("every 600 um"), Steps({2, 4, 6, 8, 10}));
  EXPECT_EQ(written("every 0.9 s"), Steps({3, 6, 9, 10}));
  EXPECT_EQ(written("every 1 h"), Steps({10}));
  EXPECT_EQ(written("every 0.1 mm").size(), 10u);
}



TEST(FieldSchedule, refuses_what_it_does_not_know)
{
  for (const std::string bad : {"every",
                                "every 1",
                                "every 0 mm",
                                "every -1 s",
                                "every 2.5 steps",
                                "every 0 steps",
                                "every 1 MPa",
                                "every 5 steps or so",
                                "end now",
                                "sometimes",
                                ""})
    try
      {
        FieldSchedule schedule(make_parameters({{"Output/Fields", bad}}));
        ADD_FAILURE() << bad;
      }
    catch (const InputError &error)
      {
        EXPECT_NE(std::string(error.what()).find("'every 50 steps'"),
                  std::string::npos)
          << error.what();
      }
}



// To and fro counts as much as forward.
TEST(SlidingPath, is_the_distance_moved)
{
  const Parameters parameters = make_parameters(
    {{"Loading/Programme",
      "press 5 MPa in 1 s; slide 1 mm/s for 3 mm; hold 1 s; slide -2 mm/s for "
      "2 mm"}});
  const SlidingPath path(parse_programme(parameters));
  EXPECT_EQ(path.at(0.5), 0.);
  EXPECT_NEAR(path.at(2.5), 1.5, 1e-12);
  EXPECT_NEAR(path.at(4.7), 3., 1e-12);
  EXPECT_NEAR(path.at(5.5), 4., 1e-12);
  EXPECT_NEAR(path.whole(), 5., 1e-12);
  EXPECT_NEAR(path.at(100.), 5., 1e-12);
}
