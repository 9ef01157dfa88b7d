// SPDX-License-Identifier: LGPL-2.1-or-later

// Numbers of the shipped case as they were when they were last looked at. They
// may change only in a commit that says why.

#include "../solid/block_test_tools.h"

#include <gtest/gtest.h>

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  const std::string case_file = "flat_surface_test/flat_surface_test.prm";

  struct Golden
  {
    std::string speed;
    double      peak, kinetic;
  };
} // namespace



TEST(FlatSurface, contact_point)
{
  for (const Golden &golden :
       std::vector<Golden>{{"1 mm/min", 0.114968971, 0.098018734},
                           {"200 mm/min", 0.139662597, 0.119069281}})
    {
      const Parameters parameters =
        make_parameters({{"Loading/Speed", golden.speed}}, case_file);
      const auto history = point_history(parameters);
      Summary    summary;
      summarise_history(history, parse_programme(parameters), summary);
      EXPECT_NEAR(summary.slides[0].peak, golden.peak, 1e-7) << golden.speed;
      EXPECT_NEAR(summary.slides[0].kinetic, golden.kinetic, 1e-7)
        << golden.speed;
    }
}



TEST(FlatSurface, block)
{
  for (const Golden &golden :
       std::vector<Golden>{{"1 mm/min", 0.114969160, 0.098018734},
                           {"200 mm/min", 0.139665773, 0.119069333}})
    {
      const auto result =
        run_block_case<3>(make_parameters({{"Loading/Speed", golden.speed},
                                           {"Block/Subdivisions", "3, 3, 3"}},
                                          case_file));
      EXPECT_NEAR(result.summary.slides[0].peak, golden.peak, 1e-7)
        << golden.speed;
      EXPECT_NEAR(result.summary.slides[0].kinetic, golden.kinetic, 1e-7)
        << golden.speed;
    }
}
