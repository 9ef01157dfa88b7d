// SPDX-License-Identifier: LGPL-2.1-or-later

// The sheet between the tools: steady level and stretch.

#include "../solid/block_test_tools.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  /// The shipped case at 1 mm/min, coarse in space and time.
  Parameters sheet(const Settings &settings = {})
  {
    return make_parameters(Settings{{"Loading/Speed", "1 mm/min"},
                                    {"Block/Subdivisions", "8, 2, 1"},
                                    {"Time stepping/Tolerance", "1e-3"}} +
                             settings,
                           "sheet_between_tools/sheet_between_tools.prm");
  }
} // namespace



TEST(SheetBetweenTools, steady_level_is_that_of_a_point)
{
  const Parameters parameters = sheet();
  const auto       result     = run_block_case<3>(parameters);
  ASSERT_EQ(result.failure, "");
  const double point = point_history(parameters).back().friction;
  EXPECT_NEAR(result.history.back().friction / point, 1., 1e-3);
  EXPECT_EQ(result.history.back().slip_fraction, 1.);
  EXPECT_LT(result.force_imbalance, 1e-8);
}



// Friction distributed evenly stretches a bar: E h du/dx = tau x.
TEST(SheetBetweenTools, stretch)
{
  const Parameters parameters = sheet({{"Block/Poisson ratio", "0"}});
  run_block_case<3>(parameters, MPI_COMM_SELF, [&](const Block<3> &block) {
    double x_left = 1e300, x_right = 0.;
    double slip_left = 0., slip_right = 0., load = 0., area = 0.;
    for (const auto &face : block.state().contact_face.cell_faces())
      for (const auto &point : face.points)
        {
          const double x = point.position[0];
          if (x < x_left)
            {
              x_left    = x;
              slip_left = point.point.committed().slip_path;
            }
          if (x > x_right)
            {
              x_right    = x;
              slip_right = point.point.committed().slip_path;
            }
          load += point.JxW * point.point.committed().traction[0];
          area += point.JxW;
        }
    const double stretch =
      load / area * (x_right * x_right - x_left * x_left) / (2. * 206e3 * 0.35);
    EXPECT_NEAR((slip_right - slip_left) / stretch, 1., 0.01);
  });
}
