// SPDX-License-Identifier: LGPL-2.1-or-later

// Closed forms of effects that have a second form.

#include "law_test_tools.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace SlipStep;
using namespace SlipStep::Testing;
using dealii::Tensor;

namespace
{
  void slide(const FrictionLaw  &law,
             const Tensor<1, 2> &velocity,
             const double        duration,
             const unsigned int  n_steps,
             ContactPoint       &point)
  {
    for (unsigned int step = 0; step < n_steps; ++step)
      {
        point.update(law,
                     duration / n_steps * velocity,
                     4.,
                     duration / n_steps);
        point.commit();
      }
  }
} // namespace



// Opposite to the velocity at every angle, and on the ellipse; where slip is
// normal to the ellipse, neither but along the axes.
TEST(Forms, friction_opposite_to_slip)
{
  const double   rho = 0.6, turn = dealii::numbers::PI * 35. / 180., V = 0.5;
  const Settings settings = {{"Effects", "subloading, overstress, anisotropy"},
                             {"Static coefficient", "0.1"},
                             {"anisotropy/Ratio", "0.6"},
                             {"anisotropy/Angle", "35 deg"}};
  Settings       second   = settings;
  second.push_back({"anisotropy/Form", "opposite"});
  const auto associated = make_law(settings), opposite = make_law(second);
  for (double angle = 0.; angle < 360.; angle += 15.)
    {
      const double       phi = dealii::numbers::PI * angle / 180.;
      const Tensor<1, 2> e   = vector(std::cos(phi), std::sin(phi));
      ContactPoint       point(*opposite);
      slide(*opposite, V * e, 20., 400, point);
      const double radius =
        1. / std::hypot(std::cos(phi - turn), std::sin(phi - turn) / rho);
      const double expected = opposite->steady_ratio(V) * 4. * 0.1 * radius;
      EXPECT_LT((point.committed().traction - expected * e).norm(), 1e-8)
        << angle;
      EXPECT_NEAR(point.committed().slip_rate, V, 1e-8);

      ContactPoint other(*associated);
      slide(*associated, V * e, 20., 400, other);
      const Tensor<1, 2> f      = other.committed().traction;
      const double       across = std::abs(f[0] * e[1] - f[1] * e[0]);
      if (std::abs(std::sin(2. * (phi - turn))) > 0.1)
        EXPECT_GT(across, 1e-3 * f.norm()) << angle;
    }
}
