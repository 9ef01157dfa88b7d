// SPDX-License-Identifier: LGPL-2.1-or-later

// Effects that remember slip rate or pressure over a slip length, against their
// closed forms after a step and a rest.

#include "law_test_tools.h"

#include <slipstep/utilities/lists.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  constexpr double p = 5., mu = 0.1, length = 0.1;

  std::unique_ptr<FrictionLaw> stiff_law(Settings settings)
  {
    settings.push_back({"Static coefficient", "0.1"});
    settings.push_back({"Tangential stiffness", "1e5"});
    return make_law(settings);
  }

  // One that slides, by steps of a slip.
  ContactState go_on(const FrictionLaw &law,
                     ContactState       state,
                     const double       pressure,
                     const double       speed,
                     const double       slip,
                     const unsigned int n)
  {
    for (unsigned int i = 0; i < n; ++i)
      {
        ContactState end;
        law.update(state, vector(slip / n), pressure, slip / n / speed, end);
        state = end;
      }
    return state;
  }

  // After a step from 0.2 to 2 mm/s, and back: at once, on the way and steady,
  // friction is steady_ratio(V) * factor(V_before, V, slip since), within 0.5 %
  // of the change that the memory makes.
  template <typename Factor>
  void expect_steps_of_speed(const FrictionLaw &law, const Factor &factor)
  {
    const double slow = 0.2, fast = 2.;
    ContactState state =
      go_on(law, law.initial_state(), p, slow, 30. * length, 600);
    for (const bool up : {true, false})
      {
        const double before = up ? slow : fast, now = up ? fast : slow;
        const double whole =
          std::abs(factor(before, now, 0.) - factor(before, now, 1e9));
        ASSERT_GT(whole, 0.005);
        const double start = state.slip_path;
        double       last  = 0.;
        for (const double where : {0.001, 0.01, 0.5, 1., 2., 30.})
          {
            state = go_on(law, state, p, now, (where - last) * length, 2000);
            last  = where;
            const double slip = state.slip_path - start;
            EXPECT_NEAR(slip, where * length, 2e-5);
            EXPECT_NEAR(state.traction[0] / (p * mu * law.steady_ratio(now)),
                        factor(before, now, slip),
                        0.005 * whole)
              << where << (up ? " up" : " down");
          }
      }
  }
} // namespace



TEST(RateAndState, ageing_law_after_a_step_of_speed)
{
  const auto law = stiff_law({{"Effects", "ageing, overstress"},
                              {"ageing/Growth", "0.05"},
                              {"ageing/Time", "0.001"},
                              {"ageing/Renewal length", "0.1"}});
  expect_steps_of_speed(*law, [](double before, double now, double slip) {
    const double theta = length / now + (length / before - length / now) *
                                          std::exp(-slip / length);
    return 1. + 0.05 * std::log1p(theta / 0.001);
  });
}



TEST(RateAndState, slip_law_after_a_step_of_speed)
{
  const auto law = stiff_law({{"Effects", "slip_law, overstress"},
                              {"slip_law/Growth", "0.05"},
                              {"slip_law/Time", "0.001"},
                              {"slip_law/Slip length", "0.1"}});
  expect_steps_of_speed(*law, [](double before, double now, double slip) {
    const double theta =
      length / now *
      std::exp(std::log(now / before) * std::exp(-slip / length));
    return 1. + 0.05 * std::log1p(theta / 0.001);
  });
}



TEST(RateAndState, memory_length_has_no_jump)
{
  const auto law = stiff_law({{"Effects", "memory_length"},
                              {"memory_length/Growth", "0.05"},
                              {"memory_length/Speed", "0.01"},
                              {"memory_length/Slip length", "0.1"}});
  expect_steps_of_speed(*law, [](double before, double now, double slip) {
    return 1. +
           0.05 * std::log1p((now + (before - now) * std::exp(-slip / length)) /
                             0.01);
  });
}



// In a rest without any slip the slip law heals nothing, the ageing law does.
TEST(RateAndState, only_the_ageing_law_heals_without_slip)
{
  const auto slip_law = stiff_law({{"Effects", "slip_law"},
                                   {"slip_law/Growth", "0.05"},
                                   {"slip_law/Slip length", "0.1"}});
  const auto ageing   = stiff_law({{"Effects", "ageing"},
                                   {"ageing/Growth", "0.05"},
                                   {"ageing/Renewal length", "0.1"}});
  for (const FrictionLaw *law : {slip_law.get(), ageing.get()})
    {
      const bool         ages = law == ageing.get();
      const ContactState before =
        go_on(*law, law->initial_state(), p, 0.5, 3., 300);
      for (const double rest : {1., 100., 1e4})
        {
          ContactState rested;
          law->update(before, vector(0.), p, rest, rested);
          const ContactState after = go_on(*law, rested, p, 0.5, 1e-4, 10);
          EXPECT_NEAR(after.traction[0] / (p * mu),
                      1. + 0.05 * std::log1p(0.2 + (ages ? rest : 0.)),
                      1e-4 * (1. + 0.05 * std::log1p(rest)));
        }
    }
  // Creep heals it: at a thousandth of the speed it approaches the new steady
  // state by slip.
  ContactState state =
    go_on(*slip_law, slip_law->initial_state(), p, 0.5, 3., 300);
  state = go_on(*slip_law, state, p, 0.5e-3, 0.1, 200);
  EXPECT_NEAR(state[contact_memory("slip_law_state_s")],
              200. * std::exp(-std::log(1000.) * std::exp(-1.)),
              1e-3 * 200.);
}



// Contacts that rested before: what was never loaded begins so, what opens
// begins anew.
TEST(RateAndState, a_first_age_is_worn_off_by_slip)
{
  constexpr double old = 1000., speed = 0.5, steady = length / speed;
  const auto       slip_law = stiff_law({{"Effects", "slip_law"},
                                         {"slip_law/First state", "1000 s"},
                                         {"slip_law/Slip length", "0.1"}});
  const auto       ageing   = stiff_law({{"Effects", "ageing"},
                                         {"ageing/First age", "1000 s"},
                                         {"ageing/Renewal length", "0.1"}});
  const auto state_of = [](const FrictionLaw &law, const ContactState &state) {
    return state[contact_memory(
      holds(law.effects(), "ageing") ? "contact_age_s" : "slip_law_state_s")];
  };
  for (const FrictionLaw *law : {slip_law.get(), ageing.get()})
    {
      ContactState open;
      law->update(law->initial_state(), vector(0.), 0., 10., open);
      EXPECT_EQ(state_of(*law, open), old);
      const ContactState slid   = go_on(*law, open, p, speed, 0.2, 2000);
      const double       worn   = std::exp(-0.2 / length);
      const double       closed = law == ageing.get() ?
                                    steady + (old - steady) * worn :
                                    steady * std::exp(std::log(old / steady) * worn);
      EXPECT_NEAR(state_of(*law, slid), closed, 1e-2 * closed);
      law->update(slid, vector(0.), 0., 10., open);
      EXPECT_EQ(state_of(*law, open), 0.);
    }
}



// Friction of a step of pressure: at once less of it, then forgotten by slip.
TEST(RateAndState, pressure_memory_after_a_step_of_pressure)
{
  const auto   law   = stiff_law({{"Effects", "pressure_memory"},
                                  {"pressure_memory/Change", "0.3"},
                                  {"pressure_memory/Slip length", "0.1"}});
  ContactState state = go_on(*law, law->initial_state(), p, 0.5, 3., 300);
  EXPECT_NEAR(state.traction[0], p * mu, 1e-9);
  for (const double pressure : {10., 2.})
    {
      const double before = state.normal_traction, start = state.slip_path;
      double       last = 0.;
      for (const double where : {1e-3, 0.1, 1., 30.})
        {
          state =
            go_on(*law, state, pressure, 0.5, (where - last) * length, 200);
          last               = where;
          const double decay = std::exp(-(state.slip_path - start) / length);
          EXPECT_NEAR(state.traction[0] / (pressure * mu),
                      std::pow(before / pressure, 0.3 * decay),
                      1e-6)
            << where;
        }
    }
  // To first order the alpha of Linker and Dieterich is 0.3 mu.
  const double       small = 1.01 * state.normal_traction;
  const ContactState next  = go_on(*law, state, small, 0.5, 1e-4, 10);
  EXPECT_NEAR((next.traction[0] / small - mu) / std::log(1.01),
              -0.3 * mu,
              0.005 * 0.3 * mu);
  // A fresh contact has adapted to the pressure at which it slips, however it
  // was pressed.
  for (const unsigned int n : {1, 7, 300})
    {
      ContactState fresh = law->initial_state(), after;
      for (unsigned int i = 1; i <= n; ++i, fresh = after)
        law->update(fresh, vector(0.), i * p / n, 1. / n, after);
      fresh = go_on(*law, fresh, p, 0.5, 0.01 * length, 20);
      EXPECT_NEAR(fresh.traction[0], p * mu, 1e-9) << n;
    }
  // One that slips while the pressure grows like the slip: ln p_m is the mean
  // of ln p over the slip, the last of it counting most, of which it remembers
  // nothing at first.
  for (const double s : {1e-3, 0.02, 0.3, 2.}) // L
    {
      double sum = 0., weights = 0.;
      for (unsigned int i = 0; i < 100000; ++i)
        {
          const double x      = (i + 0.5) / 100000.;
          const double weight = std::exp(-s * (1. - x));
          sum += weight * std::log(x);
          weights += weight;
        }
      const double expected =
        std::exp(0.3 * (1. - std::exp(-20. * s)) * sum / weights);
      for (const unsigned int n : {400, 1600})
        {
          ContactState fresh = law->initial_state();
          for (unsigned int i = 1; i <= n; ++i)
            fresh = go_on(*law, fresh, i * p / n, 0.5, s * length / n, 1);
          EXPECT_NEAR(fresh.traction[0] / (p * mu), expected, 3. / n)
            << s << ' ' << n;
        }
    }
  // Open, it forgets.
  ContactState open, closed;
  law->update(next, vector(0.), -1., 1., open);
  EXPECT_EQ(open[contact_memory("adapted_pressure_MPa")], 0.);
  closed = go_on(*law, open, 3., 0.5, 1e-3, 5);
  EXPECT_NEAR(closed.traction[0], 3. * mu, 1e-9);
}
