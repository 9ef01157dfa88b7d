// SPDX-License-Identifier: LGPL-2.1-or-later

// The law against closed forms: steady sliding, first slip, softening, healing.

#include "law_test_tools.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace SlipStep;
using namespace SlipStep::Testing;
using dealii::numbers::PI;

namespace
{
  const double millimetre_per_minute = 1. / 60.;

  // Slide a point at constant pressure in equal steps; returns the last state.
  ContactState slide(const FrictionLaw &law,
                     const double       pressure,
                     const double       speed,
                     const double       length,
                     const unsigned int n_steps,
                     ContactState       state)
  {
    for (unsigned int step = 0; step < n_steps; ++step)
      {
        ContactState end;
        law.update(state,
                   vector(length / n_steps),
                   pressure,
                   length / speed / n_steps,
                   end);
        state = end;
      }
    return state;
  }
} // namespace



TEST(ClosedForms, steady_ratio_of_the_overstress)
{
  // Roots of eta_v V (r_m - r) = exp(n (r - 1)) - 1 with Table 3 of the source
  // paper, to the digits of the reference.
  const auto law = make_law({{"Effects", "overstress"}});
  EXPECT_NEAR(law->steady_ratio(1. * millimetre_per_minute), 1.2793, 5e-5);
  EXPECT_NEAR(law->steady_ratio(10. * millimetre_per_minute), 1.4019, 5e-5);
  EXPECT_NEAR(law->steady_ratio(50. * millimetre_per_minute), 1.4850, 5e-5);
  EXPECT_NEAR(law->steady_ratio(200. * millimetre_per_minute), 1.5540, 5e-5);

  const double V = 3.7, r = law->steady_ratio(V);
  EXPECT_NEAR(1.15e4 * V * (1.8 - r) / std::expm1(16.52 * (r - 1.)), 1., 1e-10);
}



TEST(ClosedForms, point_reaches_the_steady_ratio)
{
  const auto law = make_law(
    {{"Effects", "subloading, overstress"}, {"Static coefficient", "0.078"}});
  for (const double V : {1., 10., 50., 200.})
    {
      const double       speed = V * millimetre_per_minute;
      const ContactState end =
        slide(*law, 5.8, speed, 5., 200, law->initial_state());
      EXPECT_NEAR(end.loading_ratio, law->steady_ratio(speed), 1e-9);
      EXPECT_NEAR(end.normal_ratio, 1., 1e-12);
      EXPECT_NEAR(end.traction[0] / 5.8,
                  0.078 * law->steady_ratio(speed),
                  1e-10);
    }
}



TEST(ClosedForms, rate_independent_first_slip)
{
  // delta(r) = (mu f_n / alpha_t) r - 2/(pi u) ln cos(pi r / 2), exactly and
  // for any number of steps, because the cot form is integrated exactly.
  const double u = 200., mu = 0.115, f_n = 5.8, alpha_t = 1e4;
  const auto   law = make_law({{"Effects", "subloading"}});
  for (const unsigned int n_steps : {1, 7, 50})
    for (const double delta : {1e-5, 1e-4, 1e-3, 0.01})
      {
        const ContactState end =
          slide(*law, f_n, 1., delta, n_steps, law->initial_state());
        const double r = end.loading_ratio;
        EXPECT_NEAR(end.normal_ratio, r, 1e-12);
        EXPECT_NEAR(mu * f_n / alpha_t * r -
                      2. / (PI * u) * std::log(std::cos(PI * r / 2.)),
                    delta,
                    1e-11);
      }
}



TEST(ClosedForms, logarithmic_first_slip)
{
  // In the log form slip is an exponential integral: check its differential
  // equation, d r / d slip = -u ln r, and exactness over one step or many.
  const auto law =
    make_law({{"Effects", "subloading"}, {"subloading/Form", "log"}});
  const double       delta = 2e-3, h = 1e-6;
  const ContactState one = slide(*law, 5.8, 1., delta, 1, law->initial_state());
  const ContactState many =
    slide(*law, 5.8, 1., delta, 40, law->initial_state());
  EXPECT_NEAR(one.normal_ratio, many.normal_ratio, 1e-11);

  const ContactState next = slide(*law, 5.8, 1., h, 1, many);
  const double       r    = (many.normal_ratio + next.normal_ratio) / 2.;
  EXPECT_NEAR((next.normal_ratio - many.normal_ratio) /
                (next.slip_path - many.slip_path) / (-200. * std::log(r)),
              1.,
              1e-6);
}



TEST(ClosedForms, large_rate_is_coulomb)
{
  const auto coulomb = make_law({{"Effects", ""}});
  const auto subloading =
    make_law({{"Effects", "subloading"}, {"subloading/Rate", "1e12"}});
  ContactState a = coulomb->initial_state(), b = subloading->initial_state();
  for (const double slip : {2e-5, 3e-5, 1e-4, -5e-5, -1e-3, 1e-5})
    {
      ContactState a_end, b_end;
      coulomb->update(a, vector(slip), 5.8, 1., a_end);
      subloading->update(b, vector(slip), 5.8, 1., b_end);
      a = a_end;
      b = b_end;
      EXPECT_NEAR(a.traction[0], b.traction[0], 1e-6);
      EXPECT_LE(std::abs(a.traction[0]), 0.115 * 5.8 * (1. + 1e-14));
    }
  // Elastic stick has the slope alpha_t.
  ContactState end;
  coulomb->update(coulomb->initial_state(), vector(1e-5), 5.8, 1., end);
  EXPECT_DOUBLE_EQ(end.traction[0], 0.1);
}



TEST(ClosedForms, softening_in_sliding)
{
  // mu(s), of which backward Euler is first-order accurate.
  const double a = 3., kappa = 0.045, mu_s = 0.115, mu_k = 0.098, s = 20.;
  const auto   law =
    make_law({{"Effects", "softening"}, {"softening/Steepness", "3"}});
  const double exact =
    mu_k - 1. / a *
             std::log(1. - (1. - std::exp(-a * (mu_s - mu_k))) *
                             std::exp(-a * kappa * s));
  double last_error = 0.;
  for (const unsigned int n_steps : {100, 200, 400})
    {
      // Start from full stress, so that all of s is viscoplastic slip.
      ContactState start     = law->initial_state();
      start.normal_traction  = 5.8;
      start.strength         = 5.8 * mu_s;
      start.traction         = vector(start.strength);
      start.loading_ratio    = 1.;
      const ContactState end = slide(*law, 5.8, 1., s, n_steps, start);
      // The relaxed traction turns a little elastic slip into plastic slip.
      const double error = std::abs(end.coefficient - exact);
      if (last_error > 0.)
        {
          EXPECT_NEAR(std::log2(last_error / error), 1., 0.1);
        }
      last_error = error;
    }
  EXPECT_LT(last_error, 2e-4 * (mu_s - mu_k) / 0.1);
}



TEST(ClosedForms, healing_at_rest)
{
  const double b = 200., xi = 1e-4, mu_s = 0.115, mu_0 = 0.098, t = 50.;
  const auto   law = make_law({{"Effects", "healing"},
                               {"healing/Rate", "1e-4"},
                               {"healing/Steepness", "200"},
                               {"Initial coefficient", "0.098"}});
  const double exact =
    mu_s + 1. / b *
             std::log(1. - (1. - std::exp(-b * (mu_s - mu_0))) *
                             std::exp(-b * xi * t));
  double last_error = 0.;
  for (const unsigned int n_steps : {200, 400, 800})
    {
      ContactState state = law->initial_state();
      EXPECT_DOUBLE_EQ(state.coefficient, mu_0);
      for (unsigned int step = 0; step < n_steps; ++step)
        {
          ContactState end;
          law->update(state, vector(0.), 5.8, t / n_steps, end);
          state = end;
        }
      const double error = std::abs(state.coefficient - exact);
      if (last_error > 0.)
        {
          EXPECT_NEAR(std::log2(last_error / error), 1., 0.1);
        }
      last_error = error;
    }
}



TEST(ClosedForms, steady_coefficient_of_softening_and_healing)
{
  // kappa (exp(a (mu - mu_k)) - 1) V = xi (exp(b (mu_s - mu)) - 1), met
  // exactly by backward Euler even in one huge step.
  const auto   law = make_law({{"Effects", "softening, healing"},
                               {"healing/Rate", "1e-4"},
                               {"healing/Steepness", "100"}});
  const double V   = 0.02;
  const double mu =
    slide(*law, 5.8, V, 1e6, 2, law->initial_state()).coefficient;
  EXPECT_NEAR(0.045 * std::expm1(mu - 0.098) * V /
                (1e-4 * std::expm1(100. * (0.115 - mu))),
              1.,
              1e-5);
}



TEST(ClosedForms, coefficients_read_at_a_speed)
{
  const auto law = make_law({{"Effects", "subloading, overstress, softening"},
                             {"Speed of the coefficients", "1 mm/min"}});
  EXPECT_NEAR(law->static_coefficient(), 0.0899, 5e-5);
  // Typed in as printed, the kinetic level at the same speed is what was read.
  const ContactState end = slide(
    *law, 5.8, 1. * millimetre_per_minute, 400., 2000, law->initial_state());
  EXPECT_NEAR(end.traction[0] / 5.8, 0.098, 1e-7);
  EXPECT_NEAR(end.coefficient, 0.0766, 5e-5);
}



TEST(ClosedForms, power_law_overstress)
{
  const auto   law = make_law({{"Effects", "perzyna"}});
  const double V   = 0.3;
  EXPECT_NEAR(std::pow(law->steady_ratio(V) - 1., 4.) / 100., V, 1e-12);
  const ContactState end = slide(*law, 5.8, V, 1., 50, law->initial_state());
  EXPECT_NEAR(end.loading_ratio, law->steady_ratio(V), 1e-10);
}



TEST(ClosedForms, elliptic_cone)
{
  // Traction in steady sliding along e: r tau_y P^2 e / |P e|, whose work is
  // dissipated; slip along the traction of the axes only.
  const double rho = 0.6, axis = 35. * PI / 180., mu = 0.1, V = 0.5, f_n = 4.;
  const auto   law = make_law({{"Effects", "anisotropy, overstress"},
                               {"Static coefficient", "0.1"},
                               {"anisotropy/Ratio", "0.6"},
                               {"anisotropy/Angle", "35 deg"}});
  for (const double angle : {0., 0.4, axis, 1.2, axis + PI / 2., -2.})
    {
      const double along   = std::cos(angle - axis);
      const double across  = std::sin(angle - axis);
      const double stretch = std::hypot(along, rho * across);
      const auto   e       = vector(std::cos(angle), std::sin(angle));
      const double strength =
        law->steady_ratio(V * stretch) * mu * f_n / stretch;
      const double first  = strength * along;
      const double second = strength * rho * rho * across;
      ContactState state  = law->initial_state(), before;
      for (unsigned int i = 0; i < 200; ++i)
        {
          before = state;
          law->update(before, V * 0.01 * e, f_n, 0.01, state);
        }
      EXPECT_NEAR(state.traction[0],
                  first * std::cos(axis) - second * std::sin(axis),
                  1e-9);
      EXPECT_NEAR(state.traction[1],
                  first * std::sin(axis) + second * std::cos(axis),
                  1e-9);
      EXPECT_NEAR(state.slip_rate, V * stretch, 1e-9);
      EXPECT_NEAR(state.slip_path - before.slip_path, 0.01 * V, 1e-9);
      EXPECT_NEAR(state.dissipation - before.dissipation,
                  0.01 * V * (state.traction * e),
                  1e-10);
    }
}



// One surface told in two ways, an ellipse from its one axis and from the
// other: the places that slip comes to are those on the plane.
TEST(ClosedForms, path_over_an_anisotropic_plane)
{
  const double f_n = 5., way = 3.;
  for (const bool from_the_other : {false, true})
    {
      const auto law = make_law(
        {{"Effects", "anisotropy, subloading, texture, wear, run_in"},
         {"Static coefficient", from_the_other ? "0.12" : "0.2"},
         {"anisotropy/Ratio", from_the_other ? "1.66666666666666667" : "0.6"},
         {"anisotropy/Angle", from_the_other ? "90 deg" : "0 deg"},
         {"texture/Angle", "90 deg"},
         {"texture/Wavelength", "2 mm"},
         {"texture/Amplitude", "0.1"},
         {"run_in/Length", "4 mm"},
         {"run_in/Change", "0.5"},
         {"wear/Specific rate", "1"}});
      ContactState state = law->initial_state(), end;
      for (unsigned int i = 0; i < 3000; ++i, state = end)
        law->update(state, vector(0., way / 3000), f_n, 1e-3, end);
      // Less what is elastic.
      EXPECT_NEAR(state.slip_path, way, 1e-3);
      EXPECT_NEAR(state[contact_memory("track_2_mm")], state.slip_path, 1e-12);
      EXPECT_NEAR(state[contact_memory("worn_depth_mm")],
                  1e-3 * f_n * state.slip_path,
                  1e-12);
      EXPECT_NEAR(state.traction[1],
                  0.12 * f_n * (1. + 0.1 * std::sin(PI * state.slip_path)) *
                    (1. - 0.5 * std::expm1(-state.slip_path / 4.)),
                  1e-9);
    }
}



// Forth and back are the same places, along a slide at an angle those of its
// component.
TEST(ClosedForms, expression_of_position)
{
  for (const char *anisotropy : {"", ", anisotropy"})
    for (const double angle : {0., 0.7})
      {
        const auto law =
          make_law({{"Effects", std::string("expression") + anisotropy},
                    {"Static coefficient", "0.1"},
                    {"expression/Covariate", "position"},
                    {"expression/Formula", "1 + 0.2 * x + 0.1 * sin(3 * x)"},
                    {"expression/From", "-2"},
                    {"expression/To", "3"}});
        ContactState state = law->initial_state(), end;
        double       place = 0.;
        for (const double way : {2., -1.5, 0.8})
          {
            const auto e = vector(std::cos(angle), std::sin(angle));
            for (unsigned int i = 0; i < 400; ++i, state = end)
              law->update(state, way / 400. * e, 5., 0.1, end);
            place              = state[contact_memory("position_mm")];
            const double along = state.traction * e;
            ContactState there;
            law->update(state, 1e-3 * way * e, 5., 0.1, there);
            const double next = there[contact_memory("position_mm")];
            const auto   g    = [](const double x) {
              return 1. + 0.2 * x + 0.1 * std::sin(3. * x);
            };
            EXPECT_NEAR(there.traction * e / along, g(next) / g(place), 1e-5);
            if (std::string(anisotropy).empty())
              {
                EXPECT_NEAR(std::abs(along), 0.5 * g(place), 1e-4);
              }
          }
        // Less what is elastic.
        EXPECT_NEAR(place, 1.3 * std::cos(angle), 2e-3);
      }
}



TEST(ClosedForms, memories_at_rest_and_off_the_plane)
{
  const auto   law   = make_law({{"Effects", "heating, expression, ageing"},
                                 {"expression/Covariate", "hold time"},
                                 {"heating/Cooling time", "3 s"},
                                 {"ageing/Renewal length", "0.2"}});
  ContactState state = slide(*law, 5., 10., 100., 50, law->initial_state());
  const double hot   = state[contact_memory("temperature_rise_degC")],
               held  = state[contact_memory("hold_time_s")],
               young = state[contact_memory("contact_age_s")];
  EXPECT_GT(hot, 1.);
  EXPECT_NEAR(held, 0.01 / 10., 1e-10); // D_c / V
  EXPECT_NEAR(young, 0.2 / 10., 1e-9);  // L / V
  ContactState end;
  law->update(state, vector(0.), 5., 2., end);
  EXPECT_NEAR(end[contact_memory("temperature_rise_degC")],
              hot * std::exp(-2. / 3.),
              1e-10 * hot);
  EXPECT_NEAR(end[contact_memory("hold_time_s")], held + 2., 1e-6);
  EXPECT_NEAR(end[contact_memory("contact_age_s")], young + 2., 1e-6);
  law->update(state, vector(1.), -1., 2., end);
  EXPECT_NEAR(end[contact_memory("temperature_rise_degC")],
              hot * std::exp(-2. / 3.),
              1e-10 * hot);
  EXPECT_EQ(end[contact_memory("hold_time_s")], 0.);
  EXPECT_EQ(end[contact_memory("contact_age_s")], 0.);
}



// After a rest the peak is the logarithm of its time, and fades with
// exp(-slip/L).
TEST(ClosedForms, ageing_grows_with_the_logarithm_of_a_rest)
{
  const auto   law = make_law({{"Effects", "ageing"},
                               {"Static coefficient", "0.1"},
                               {"ageing/Growth", "0.02"},
                               {"ageing/Time", "3 s"},
                               {"ageing/Renewal length", "0.5 mm"}});
  const double p   = 5.;
  for (const double rest : {1., 10., 1000.})
    {
      ContactState state =
        slide(*law, p, 10., 100., 2000, law->initial_state());
      const double young = state[contact_memory("contact_age_s")];
      ContactState end;
      law->update(state, vector(0.), p, rest, end);
      EXPECT_NEAR(end[contact_memory("contact_age_s")],
                  young + rest,
                  1e-9 * rest);
      // So fast that nothing ages meanwhile, in one step and in many.
      const double slip = 0.3, age = (young + rest) * std::exp(-slip / 0.5);
      for (const unsigned int n : {1, 50})
        EXPECT_NEAR(slide(*law, p, 1e6, slip, n, end).traction[0] / (p * 0.1),
                    1. + 0.02 * std::log1p(age / 3.),
                    1e-5);
    }
}



TEST(ClosedForms, formulas_are_clamped_and_smooth)
{
  // x^3 is no polynomial of the table, but 1001 values come near.
  const auto law = make_law({{"Effects", "expression"},
                             {"Static coefficient", "0.1"},
                             {"expression/Covariate", "pressure"},
                             {"expression/Formula", "0.5 + (x / 10)^3"},
                             {"expression/From", "2"},
                             {"expression/To", "10"}});
  for (const double pressure : {1., 2., 3.333, 7.1234, 10., 20.})
    {
      const double       x = std::min(std::max(pressure, 2.), 10.);
      const ContactState end =
        slide(*law, pressure, 1., 1., 1, law->initial_state());
      EXPECT_NEAR(end.traction[0] / pressure,
                  0.1 * (0.5 + std::pow(x / 10., 3)),
                  1e-7);
    }
}



// Forward and across as without the effect, against it 1 + d.
TEST(ClosedForms, direction_that_acts_on_reversed_slip_only)
{
  const auto   law     = make_law({{"Effects", "direction"},
                                   {"Static coefficient", "0.1"},
                                   {"direction/Change", "0.5"},
                                   {"direction/Forward angle", "20 deg"},
                                   {"direction/Form", "reversed"}});
  const double forward = PI / 9., p = 5.;
  for (const double angle : {0., 1., PI / 2., 2., 2.5, PI, 4., 5.})
    {
      ContactState state = law->initial_state();
      for (unsigned int i = 0; i < 20; ++i)
        {
          ContactState end;
          const auto   slip = [&](const double turn) {
            return 0.05 * vector(std::cos(forward + angle + turn),
                                 std::sin(forward + angle + turn));
          };
          const ContactResponse response =
            law->update(state, slip(0.), p, 0.1, end);
          const auto at = [&](const double turn) {
            return law->update(state, slip(turn), p, 0.1, end).traction;
          };
          const auto difference = (at(1e-5) - at(-1e-5)) / 2e-5;
          const auto stated =
            response.d_slip * ((slip(1e-5) - slip(-1e-5)) / 2e-5);
          // Across, the second derivative jumps.
          EXPECT_NEAR((difference - stated).norm(), 0., 2e-6);
          law->update(state, slip(0.), p, 0.1, end);
          state = end;
        }
      const double c = std::max(0., -std::cos(angle));
      EXPECT_NEAR(state.traction.norm(), p * 0.1 * (1. + 0.5 * c * c), 1e-9);
    }
}



// Lives of a coating after Weibull: half of it is gone after D_d ln(2)^(1/k).
TEST(ClosedForms, coating_that_fails)
{
  const auto   law         = make_law({{"Effects", "damage"},
                                       {"damage/Change", "-0.4"},
                                       {"damage/Length", "20"},
                                       {"damage/Sharpness", "6"},
                                       {"Static coefficient", "0.2"}});
  const double half        = 20. * std::pow(std::log(2.), 1. / 6.);
  const double levels[][2] = {{2., 1.}, {half, 0.8}, {40., 0.6}};
  for (const auto &level : levels)
    EXPECT_NEAR(
      slide(*law, 5., 1., level[0], 400, law->initial_state()).traction.norm() /
        5.,
      0.2 * level[1],
      1e-6)
      << level[0];
}
