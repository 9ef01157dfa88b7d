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
        {
          EXPECT_GT(across, 1e-3 * f.norm()) << angle;
        }
    }
}



// After a step of speed the flow rule feels V_2 + (V_1 - V_2) exp(-s/L), and
// there is no jump.
TEST(Forms, a_step_of_speed_spreads_over_the_memory_length)
{
  const double V_1 = 0.01, V_2 = 1., L = 0.05;
  const auto   law = make_law({{"Effects", "overstress, memory_length"},
                               {"Static coefficient", "0.1"},
                               {"Tangential stiffness", "1e6"},
                               {"memory_length/Form", "flow"},
                               {"memory_length/Slip length", "0.05"}});
  for (const bool is_faster : {true, false})
    {
      const double from = is_faster ? V_1 : V_2, to = is_faster ? V_2 : V_1;
      ContactPoint point(*law);
      slide(*law, vector(from), 30. * L / from, 3000, point);
      EXPECT_NEAR(point.committed().loading_ratio,
                  law->steady_ratio(from),
                  1e-6);
      const double path = point.committed().slip_path;
      for (unsigned int i = 0; i < 80; ++i)
        {
          slide(*law, vector(to), 0.1 * L / to, 50, point);
          const double s = point.committed().slip_path - path;
          EXPECT_NEAR(point.committed().loading_ratio,
                      law->steady_ratio(to + (from - to) * std::exp(-s / L)),
                      2e-4)
            << s;
        }
      EXPECT_NEAR(point.committed().loading_ratio, law->steady_ratio(to), 2e-3);
    }
  // The rule without a memory has jumped after a hundredth of the length.
  const auto   sudden = make_law({{"Effects", "overstress"},
                                  {"Static coefficient", "0.1"},
                                  {"Tangential stiffness", "1e6"}});
  ContactPoint point(*sudden);
  slide(*sudden, vector(V_1), 1., 1000, point);
  slide(*sudden, vector(V_2), 0.01 * L / V_2, 50, point);
  EXPECT_NEAR(point.committed().loading_ratio, sudden->steady_ratio(V_2), 1e-6);
}



// Newtonian slow, a power of the speed when fast; and Newtonian at any speed
// with the exponent 1, to the last bit.
TEST(Forms, a_film_that_thins_with_shear)
{
  const Settings settings    = {{"Effects", "viscous"},
                                {"Static coefficient", "0.1"},
                                {"viscous/Drag", "0.2"}};
  const auto     strength_at = [&](const Settings &more, const double speed) {
    Settings all = settings;
    all.insert(all.end(), more.begin(), more.end());
    const auto   law = make_law(all);
    ContactPoint point(*law);
    slide(*law, vector(speed), 10., 100, point);
    return point.committed().traction[0];
  };
  const Settings thins = {{"viscous/Exponent", "0.5"},
                          {"viscous/Speed", "0.01 mm/s"}};
  for (const double speed : {1e-5, 0.01, 0.3, 10., 1000.})
    {
      EXPECT_NEAR(strength_at(thins, speed) - 0.4,
                  0.2 * speed / std::sqrt(1. + speed / 0.01),
                  1e-9)
        << speed;
      EXPECT_EQ(strength_at({{"viscous/Speed", "0.01 mm/s"}}, speed),
                strength_at({}, speed));
    }
  EXPECT_NEAR((strength_at(thins, 4000.) - 0.4) /
                (strength_at(thins, 1000.) - 0.4),
              2.,
              1e-4);
}



// Largest at its speed, half of it where Q |x - 1/x| = 1, and the same at x and
// 1/x.
TEST(Forms, a_resonance_is_a_bump_over_the_logarithm_of_speed)
{
  const auto law     = make_law({{"Effects", "resonance"},
                                 {"Static coefficient", "0.1"},
                                 {"resonance/Rise", "0.3"},
                                 {"resonance/Speed", "0.2 mm/s"},
                                 {"resonance/Quality", "2"}});
  const auto rise_at = [&](const double x) {
    ContactPoint point(*law);
    slide(*law, vector(0.2 * x), 10. / x, 100, point);
    return point.committed().traction[0] / 0.4 - 1.;
  };
  const double half = std::sqrt(1. + 1. / 16.) + 0.25;
  EXPECT_NEAR(half - 1. / half, 0.5, 1e-12);
  EXPECT_NEAR(rise_at(1.), 0.3, 1e-9);
  EXPECT_NEAR(rise_at(half), 0.15, 1e-9);
  EXPECT_NEAR(rise_at(1. / half), 0.15, 1e-9);
  EXPECT_NEAR(rise_at(1e-3), 0., 1e-6);
  EXPECT_NEAR(rise_at(1e6), 0., 1e-9);
}



// At the same place friction is the same, whichever way it is passed.
TEST(Forms, a_texture_belongs_to_places)
{
  const double       pi = dealii::numbers::PI, alpha = 1e4;
  const auto         law = make_law({{"Effects", "texture"},
                                     {"Static coefficient", "0.1"},
                                     {"Tangential stiffness", "1e4"},
                                     {"texture/Amplitude", "0.3"},
                                     {"texture/Wavelength", "0.5 mm"},
                                     {"texture/Phase", "40 deg"},
                                     {"texture/Angle", "30 deg"},
                                     {"texture/Second cosine", "-0.3"},
                                     {"texture/Third sine", "0.2"}});
  const Tensor<1, 2> e   = vector(std::cos(pi / 6.), std::sin(pi / 6.));
  ContactPoint       point(*law);
  Tensor<1, 2>       load_point;
  for (const Tensor<1, 2> &way :
       {vector(0.8, 0.), vector(-0.3, 0.), vector(0., 0.6), vector(-1., -1.)})
    for (unsigned int step = 0; step < 400; ++step)
      {
        slide(*law, way / 400., 1., 1, point);
        load_point += way / 400.;
        // Turning takes some elastic slip.
        if (step < 100)
          continue;
        const Tensor<1, 2> place =
          load_point - point.committed().traction / alpha;
        const double theta = 2. * pi * (e * place) / 0.5 + 40. * pi / 180.;
        EXPECT_NEAR(point.committed().traction.norm(),
                    0.4 * (1. +
                           0.3 * (std::sin(theta) - 0.3 * std::cos(2. * theta) +
                                  0.2 * std::sin(3. * theta))),
                    3e-4)
          << place;
      }
}



// Not even where its waves add up.
TEST(Forms, a_texture_leaves_some_friction)
{
  EXPECT_THROW(make_law({{"Effects", "texture"},
                         {"texture/Amplitude", "0.6"},
                         {"texture/Second sine", "0.5"},
                         {"texture/Third cosine", "-0.2"}}),
               InputError);
}



// As without it until the pressure falls below what it was.
TEST(Forms, the_largest_pressure_is_remembered)
{
  const auto   law = make_law({{"Effects", "largest_pressure"},
                               {"Static coefficient", "0.1"},
                               {"largest_pressure/Change", "0.5"}});
  ContactPoint point(*law);
  double       largest = 0.;
  for (const double pressure : {2., 3., 8., 4., 6., 8., 10., 5.})
    {
      largest = std::max(largest, pressure);
      for (unsigned int step = 0; step < 20; ++step)
        {
          point.update(*law, vector(0.05), pressure, 0.1);
          point.commit();
        }
      EXPECT_NEAR(point.committed().traction[0],
                  0.1 * pressure * (1. + 0.5 * (1. - pressure / largest)),
                  1e-9);
    }
  // Off the plane it is not forgotten.
  point.update(*law, vector(0.), 0., 0.1);
  point.commit();
  EXPECT_EQ(point.committed()[contact_memory("largest_pressure_MPa")], 10.);
}



TEST(Forms, refuse_what_has_no_meaning)
{
  EXPECT_THROW(make_law({{"Effects", "memory_length"},
                         {"memory_length/Form", "flow"}}),
               InputError);
  EXPECT_THROW(make_law({{"Effects", "overstress, memory_length"},
                         {"memory_length/Form", "flow"},
                         {"memory_length/Growth", "0.1"}}),
               InputError);
}
