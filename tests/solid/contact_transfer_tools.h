// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tests_solid_contact_transfer_tools_h
#define tests_solid_contact_transfer_tools_h

#include <slipstep/friction/law.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace SlipStep::Testing
{
  /// A state that any law with the default coefficients allows; a polynomial of
  /// degree p in each of two coordinates in [0,1].
  inline ContactState polynomial_state(const FrictionLaw &law,
                                       const unsigned int degree,
                                       const double       x,
                                       const double       y)
  {
    const double a = std::pow(x, degree), b = std::pow(y, degree);
    const auto   mu = law.coefficient_range();
    ContactState state;
    state.normal_traction = 3. + a - 0.5 * x + 0.7 * b + 0.3 * a * b;
    state.strength        = 0.4 + 0.1 * a - 0.05 * y;
    state.traction[0]     = 0.2 + 0.02 * a * b - 0.03 * x;
    state.traction[1]     = 0.05 * b - 0.01 * x;
    state.normal_ratio    = 0.1 + 0.05 * a;
    state.coefficient = mu[0] + (mu[1] - mu[0]) * (0.5 + 0.3 * a - 0.2 * b * x);
    state.slip_path   = 0.01 + a * b;
    state.slip_rate   = 0.2 + 0.1 * b;
    state.dissipation = 0.3 + 0.2 * x - 0.1 * y * a;
    state[contact_memory("temperature_rise_degC")] = 0.2 + 0.3 * x - 0.1 * b;
    state[contact_memory("contact_age_s")]         = 0.5 + y * a;
    state[contact_memory("hold_time_s")]           = 0.7 + x * b;
    state.loading_ratio =
      law.isotropic_traction(state.traction).norm() / state.strength;
    return state;
  }

  /// A state that the law allows, next to nothing else: open or closed,
  /// sticking or slipping in any direction.
  inline ContactState random_state(const FrictionLaw &law, std::mt19937 &random)
  {
    std::uniform_real_distribution<double> number(0., 1.);
    const auto                             mu = law.coefficient_range();
    const bool   is_rate_dependent            = law.maximum_ratio() > 1.;
    ContactState state;
    state.coefficient = mu[0] + (mu[1] - mu[0]) * number(random);
    state.slip_path   = number(random) < 0.3 ? 0. : 10. * number(random);
    state.dissipation = number(random) < 0.3 ? 0. : number(random);
    for (const ContactMemory &memory : contact_memories())
      state[memory] = number(random) < 0.3 ? 0. : number(random);
    if (number(random) < 0.7)
      {
        state.normal_traction = std::exp(10. * (number(random) - 0.5));
        state.strength        = state.normal_traction * state.coefficient;
        const double ratio    = number(random) < 0.3 ?
                                  (is_rate_dependent ? 1.79 : 1.) :
                                  number(random);
        const double angle    = 7. * number(random);
        state.traction[0]     = std::cos(angle);
        state.traction[1]     = std::sin(angle);
        state.traction *= ratio * state.strength /
                          law.isotropic_traction(state.traction).norm();
        state.normal_ratio = number(random);
        state.slip_rate    = number(random) < 0.5 ? 0. : number(random);
      }
    law.complete(state);
    return state;
  }

  /// What a transfer conserves.
  inline auto conserved(const ContactState &state)
  {
    return std::array<double, 12>{
      {state.traction[0],
       state.traction[1],
       state.normal_traction,
       state.strength,
       state.slip_path,
       state.dissipation,
       state[contact_memory("temperature_rise_degC")],
       state[contact_memory("contact_age_s")],
       state[contact_memory("hold_time_s")],
       state[contact_memory("core_1")],
       state[contact_memory("core_2")],
       state[contact_memory("core_energy_MPa_mm")]}};
  }

  inline void expect_admissible(const FrictionLaw &law, const ContactState &s)
  {
    const double limit = law.maximum_ratio();
    if (s.normal_traction > 0.)
      {
        const double norm = law.isotropic_traction(s.traction).norm();
        if (limit > 1.)
          EXPECT_LT(norm, limit * s.strength + 1e-300);
        else
          EXPECT_LE(norm, (1. + 1e-11) * s.strength);
        EXPECT_GE(s.strength, 0.);
        EXPECT_DOUBLE_EQ(s.loading_ratio,
                         s.strength > 0. ? norm / s.strength : 0.);
        EXPECT_GE(s.normal_ratio, 0.);
        EXPECT_LE(s.normal_ratio, 1.);
      }
    else
      {
        EXPECT_EQ(s.normal_traction, 0.);
        EXPECT_EQ(s.traction.norm(), 0.);
        EXPECT_EQ(s.strength, 0.);
      }
    EXPECT_GE(s.coefficient, law.coefficient_range()[0]);
    EXPECT_LE(s.coefficient, law.coefficient_range()[1]);
    EXPECT_GE(s.slip_path, 0.);
    EXPECT_GE(s.slip_rate, 0.);
    EXPECT_GE(s.dissipation, 0.);
    for (const ContactMemory &memory : contact_memories())
      {
        EXPECT_GE(s[memory], memory.least);
        EXPECT_LE(s[memory], memory.greatest);
      }
    EXPECT_TRUE(law.admits_core(s));
  }

  inline void expect_equal(const ContactState &a,
                           const ContactState &b,
                           const double        tolerance)
  {
    for (unsigned int i = 0; i < 2; ++i)
      EXPECT_NEAR(a.traction[i], b.traction[i], tolerance);
    EXPECT_NEAR(a.normal_traction, b.normal_traction, tolerance);
    EXPECT_NEAR(a.strength, b.strength, tolerance);
    EXPECT_NEAR(a.loading_ratio, b.loading_ratio, tolerance);
    EXPECT_NEAR(a.normal_ratio, b.normal_ratio, tolerance);
    EXPECT_NEAR(a.coefficient, b.coefficient, tolerance);
    EXPECT_NEAR(a.slip_path, b.slip_path, tolerance);
    EXPECT_NEAR(a.slip_rate, b.slip_rate, tolerance);
    EXPECT_NEAR(a.dissipation, b.dissipation, tolerance);
    for (const ContactMemory &memory : contact_memories())
      EXPECT_NEAR(a[memory], b[memory], tolerance);
  }
} // namespace SlipStep::Testing

#endif
