// SPDX-License-Identifier: LGPL-2.1-or-later

// The limit of stability of steady sliding: closed form against the law's own
// steps, and against what a spring and a mass do.

#include <slipstep/experiment/point_driver.h>
#include <slipstep/experiment/stability.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "../friction/law_test_tools.h"

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  constexpr double pressure = 5.;
  // Of the law below.
  constexpr double mu_s = 0.3, mu_k = 0.1, kappa = 20., a = 2., xi = 0.02,
                   b = 5., eta = 100., n = 25., r_m = 1.8, alpha_t = 500.;

  const Settings core = {{"Effects",
                          "subloading, overstress, softening, healing"},
                         {"Static coefficient", "0.3"},
                         {"softening/Kinetic coefficient", "0.1"},
                         {"softening/Rate", "20"},
                         {"softening/Steepness", "2"},
                         {"healing/Rate", "0.02"},
                         {"healing/Steepness", "5"},
                         {"overstress/Viscosity", "100"},
                         {"overstress/Exponent", "25"},
                         {"Tangential stiffness", "500"}};

  /// Where a falling function is zero.
  template <typename Function>
  double root_of(const Function &function, double lower, double upper)
  {
    for (unsigned int i = 0; i < 100; ++i)
      {
        const double x                     = (lower + upper) / 2.;
        (function(x) > 0. ? lower : upper) = x;
      }
    return lower;
  }

  /// mu at which softening and healing balance at a speed.
  double steady_coefficient(const double V,
                            const double kappa = ::kappa,
                            const double xi    = ::xi)
  {
    return root_of(
      [&](const double mu) {
        return -kappa * std::expm1(a * (mu - mu_k)) * V +
               xi * std::expm1(b * (mu_s - mu));
      },
      mu_k,
      mu_s);
  }

  /// What a closed form takes beside the law above.
  struct Sliding
  {
    double V; // speed
    double mass           = 0.;
    double c              = 0.; // drag, tau_y = f_n mu + c V
    double f_n            = pressure;
    double alpha_t        = ::alpha_t;
    double kappa          = ::kappa;
    double xi             = ::xi;
    bool   has_overstress = true;
  };

  /// k_c, closed form.
  StabilityLimit closed_form(const Sliding &s)
  {
    const double mu = steady_coefficient(s.V, s.kappa, s.xi);
    double       r = 1., slope = 0.; // slope dr/dV
    if (s.has_overstress)
      {
        // eta V = (exp(n (r - 1)) - 1) / (r_m - r)
        r = root_of(
          [&](const double r) {
            return eta * s.V * (r_m - r) - std::expm1(n * (r - 1.));
          },
          1.,
          r_m);
        slope = eta * (r_m - r) / (n * std::exp(n * (r - 1.)) + eta * s.V);
      }
    const double C = s.kappa * std::expm1(a * (mu - mu_k));
    const double B = s.kappa * a * std::exp(a * (mu - mu_k)) * s.V +
                     s.xi * b * std::exp(b * (mu_s - mu));
    const double direct = slope * (s.f_n * mu + s.c * s.V) + r * s.c; // df/dV
    const double k_0    = s.f_n * r * C - direct * B;
    if (k_0 <= 0.)
      return {};
    if (k_0 >= s.alpha_t)
      return {std::numeric_limits<double>::infinity(), 0.};
    const double omega2 = k_0 * B / direct;
    return {k_0 / (1. - k_0 / s.alpha_t) + s.mass * omega2, std::sqrt(omega2)};
  }

  StabilityLimit closed_form(const double V, const double mass)
  {
    Sliding sliding{V};
    sliding.mass = mass;
    return closed_form(sliding);
  }

  StabilityLimit
  computed(const Settings &settings, const double V, const double mass)
  {
    const auto          law = make_law(settings);
    const SteadySliding sliding(*law, vector(V), pressure);
    EXPECT_TRUE(sliding.exists());
    return sliding.limit(mass);
  }

  Settings with(Settings settings, const Settings &more)
  {
    settings.insert(settings.end(), more.begin(), more.end());
    return settings;
  }

  /// Slide steadily at V on a spring, then let the load point jerk: the
  /// amplitude of the disturbance at the end over that in the middle.
  double growth(const double V, const double stiffness, const double mass)
  {
    const auto          law = make_law(core);
    const SteadySliding sliding(*law, vector(V), pressure);
    const double        period =
      2. * dealii::numbers::PI / sliding.limit(mass).frequency;

    Parameters parameters;
    Machine::declare_parameters(parameters);
    parameters.set("Loading/Machine stiffness",
                   std::to_string(stiffness),
                   "test");
    parameters.set("Loading/Machine mass", std::to_string(mass), "test");
    const Machine machine(parameters);

    ContactPoint point(sliding.state());
    Slider       slider;
    slider.load                   = sliding.state().traction;
    slider.velocity[0]            = V;
    const unsigned int per_period = 4000, n_periods = 12;
    double             early = 0., late = 0.;
    const double       dt = period / per_period;
    for (unsigned int i = 0; i < n_periods * per_period; ++i)
      {
        const double jerk = i == 0 ? 1e-4 * pressure / stiffness : 0.;
        slider =
          machine.step(*law, point, slider, vector(V * dt + jerk), pressure, dt)
            .slider;
        point.commit();
        const double deviation =
          (slider.load - sliding.state().traction).norm();
        if (i / per_period == 2)
          early = std::max(early, deviation);
        if (i / per_period == n_periods - 1)
          late = std::max(late, deviation);
      }
    return late / early;
  }
} // namespace



TEST(Stability, the_law_steps_agree_with_the_closed_form)
{
  for (const double V : {0.003, 0.01, 0.03})
    for (const double mass : {0., 1e-4, 1.})
      {
        const StabilityLimit expected = closed_form(V, mass);
        const StabilityLimit found    = computed(core, V, mass);
        ASSERT_GT(expected.stiffness, 0.);
        EXPECT_NEAR(found.stiffness,
                    expected.stiffness,
                    2e-3 * expected.stiffness)
          << V << " " << mass;
        EXPECT_NEAR(found.frequency,
                    expected.frequency,
                    2e-3 * expected.frequency)
          << V << " " << mass;
      }
}



// Of all magnitudes: contacts that are stiff or hardly stiffer than friction
// falls, rate effects that are large or next to nothing.
TEST(Stability, random_laws_agree_with_the_closed_form)
{
  RandomLoads  random(1);
  unsigned int n_finite = 0;
  for (unsigned int i = 0; i < 250; ++i)
    {
      Sliding sliding{random.magnitude(-4., 1.)};
      sliding.has_overstress = i % 2;
      sliding.mass           = i % 3 == 0 ? 0. : random.magnitude(-6., 0.);
      sliding.c              = random.magnitude(-6., 0.);
      sliding.f_n            = random.magnitude(-1., 3.);
      sliding.alpha_t        = random.magnitude(1., 5.);
      sliding.kappa          = random.magnitude(0., 3.);
      sliding.xi             = random.magnitude(-3., 1.);
      const auto law         = make_law(
        with(core,
             {{"Effects",
               sliding.has_overstress ?
                         "subloading, overstress, softening, healing, viscous" :
                         "softening, healing, viscous"},
                      {"Tangential stiffness", exact_text(sliding.alpha_t)},
                      {"softening/Rate", exact_text(sliding.kappa)},
                      {"healing/Rate", exact_text(sliding.xi)},
                      {"viscous/Drag", exact_text(sliding.c)}}));
      const SteadySliding steady(*law, vector(sliding.V), sliding.f_n);
      ASSERT_TRUE(steady.exists()) << i;
      const StabilityLimit expected = closed_form(sliding);
      const StabilityLimit found    = steady.limit(sliding.mass);
      // Nearly balanced, nearly as steep as the contact is stiff, or a rate
      // effect that is lost in round-off.
      if (std::isfinite(expected.stiffness) &&
          (expected.stiffness < 1e-4 * sliding.alpha_t ||
           expected.stiffness > 1e2 * sliding.alpha_t ||
           (!sliding.has_overstress &&
            sliding.c * expected.frequency < 2e-5 * sliding.alpha_t)))
        continue;
      n_finite += std::isfinite(expected.stiffness);
      if (!std::isfinite(expected.stiffness))
        EXPECT_EQ(found.stiffness, expected.stiffness) << i;
      else
        EXPECT_NEAR(found.stiffness,
                    expected.stiffness,
                    1e-2 * expected.stiffness)
          << i;
      EXPECT_NEAR(found.frequency,
                  expected.frequency,
                  1e-2 * expected.frequency)
        << i;
    }
  EXPECT_GT(n_finite, 50u);
}



TEST(Stability, the_steady_state_is_that_of_the_rates)
{
  for (const double V : {1e-5, 0.03, 10.})
    {
      const auto          law = make_law(core);
      const SteadySliding sliding(*law, vector(0., -V), pressure);
      const double        mu = steady_coefficient(V);
      EXPECT_NEAR(sliding.state().coefficient, mu, 1e-9 * mu);
      EXPECT_NEAR(sliding.friction(), mu * law->steady_ratio(V), 1e-9);
    }
}



TEST(Stability, a_disturbance_grows_on_softer_springs_only)
{
  for (const double V : {0.01, 0.1})
    for (const double mass : {0., 0.02})
      {
        const double k = computed(core, V, mass).stiffness;
        EXPECT_LT(growth(V, 1.03 * k, mass), 0.9) << V << " " << mass;
        EXPECT_GT(growth(V, 0.97 * k, mass), 1.1) << V << " " << mass;
      }
}



TEST(Stability, laws_without_weakening_are_stable_on_any_spring)
{
  // Too fast to heal: the rate effect is stronger.
  EXPECT_EQ(closed_form(0.3, 0.).stiffness, 0.);
  EXPECT_EQ(computed(core, 0.3, 0.).stiffness, 0.);
  EXPECT_EQ(computed({{"Effects", "subloading, overstress"}}, 1., 0.).stiffness,
            0.);
  // Softening that has ended weakens no more.
  EXPECT_EQ(computed({{"Effects", "subloading, overstress, softening"}}, 1., 1.)
              .stiffness,
            0.);
}



TEST(Stability, without_rate_effect_any_mass_is_too_much)
{
  const Settings law = with(core, {{"Effects", "softening, healing"}});
  const double   V   = 0.03;
  const double   C   = kappa * std::expm1(a * (steady_coefficient(V) - mu_k));
  const double   k_0 = pressure * C;
  const double   k   = k_0 / (1. - k_0 / alpha_t);
  EXPECT_NEAR(computed(law, V, 0.).stiffness, k, 1e-2 * k);
  EXPECT_EQ(computed(law, V, 1e-6).stiffness,
            std::numeric_limits<double>::infinity());
}



// Whatever the speed: round-off of the steps is no rate effect.
TEST(Stability, round_off_damps_nothing)
{
  const Settings law = with(core,
                            {{"Effects", "subloading, softening, healing"},
                             {"Tangential stiffness", "1e6"}});
  for (const double V : {0.001, 0.1, 10.})
    {
      EXPECT_EQ(computed(law, V, 1e-3).stiffness,
                std::numeric_limits<double>::infinity())
        << V;
      const double k =
        pressure * kappa * std::expm1(a * (steady_coefficient(V) - mu_k));
      const StabilityLimit without = computed(law, V, 0.);
      EXPECT_NEAR(without.stiffness, k, 2e-3 * k) << V;
      EXPECT_EQ(without.frequency, 0.) << V;
    }
}



// What does not depend on speed does not fall with it, whatever the numbers.
TEST(Stability, round_off_feeds_nothing)
{
  for (const char *effects : {"subloading", "elastic_core, subloading"})
    for (unsigned int percent = 3; percent < 51; ++percent)
      for (const double p : {1., 5.8, 7.})
        {
          const std::string mu = std::to_string(0.01 * percent);
          const auto        law =
            make_law({{"Effects", effects}, {"Static coefficient", mu}});
          const SteadySliding sliding(*law, Tensor<1, 2>({0.1, 0.}), p);
          EXPECT_FALSE(sliding.grows_at_once())
            << effects << " " << mu << " " << p;
          EXPECT_EQ(sliding.limit(0.).stiffness, 0.)
            << effects << " " << mu << " " << p;
        }
}



// Rate and state, k_0 = f_n (b - a)/D_c of friction, on a contact that is
// hardly stiffer.
TEST(Stability, memories_on_a_contact_hardly_stiffer_than_their_fall)
{
  Settings     law = {{"Effects", "subloading, overstress, ageing"},
                      {"Static coefficient", "0.3"},
                      {"ageing/Growth", "0.05"},
                      {"ageing/Renewal length", "0.02"},
                      {"overstress/Viscosity", "1e6"},
                      {"overstress/Exponent", "100"},
                      {"Tangential stiffness", "1e5"}};
  const double V   = 0.01;
  const double k_0 = computed(law, V, 0.).stiffness;
  ASSERT_GT(k_0, 0.);
  for (const double times : {1.003, 1.03, 1.3, 10.})
    {
      const double alpha_t = times * k_0;
      law.back().second    = exact_text(alpha_t);
      const double k       = k_0 / (1. - k_0 / alpha_t);
      EXPECT_NEAR(computed(law, V, 0.).stiffness, k, 0.02 * k) << times;
    }
}



// Weakening that takes a slip or a time is held by every contact stiffer than
// that; what has run in weakens no more.
TEST(Stability, what_weakens_by_memory_does_not_grow_at_once)
{
  const double   V      = 0.03;
  const Settings ageing = {{"Effects", "subloading, ageing"},
                           {"ageing/Growth", "0.05"},
                           {"ageing/Renewal length", "0.5"}};
  const Settings run_in = {{"Effects", "subloading, run_in"},
                           {"run_in/Change", "-0.5"},
                           {"run_in/Length", "3"}};
  for (const Settings &settings : {ageing,
                                   run_in,
                                   Settings{{"Effects", "subloading, heating"}},
                                   Settings{{"Effects", "softening, healing"}},
                                   Settings{{"Effects", "subloading"}}})
    {
      const std::string   effects = settings[0].second;
      const auto          law     = make_law(settings);
      const SteadySliding sliding(*law, vector(V), pressure);
      ASSERT_TRUE(sliding.exists()) << effects;
      EXPECT_FALSE(sliding.grows_at_once()) << effects;
      EXPECT_TRUE(std::isfinite(sliding.limit(0.).stiffness)) << effects;
      if (effects == "subloading, ageing")
        {
          // tau = f_n mu (1 + g ln(1 + theta/t_0)), theta = L/V at the steady
          // state, of which quick slip takes d ln theta = -dx/L.
          const double theta = 0.5 / V, t_0 = 1.;
          const double fall = pressure * law->static_coefficient() * 0.05 *
                              theta / (theta + t_0) / 0.5;
          EXPECT_NEAR(sliding.limit(0.).stiffness, fall, 0.01 * fall);
        }
    }
  const auto law = make_law({{"Effects", "subloading, run_in"}});
  EXPECT_EQ(SteadySliding(*law, vector(V), pressure).limit(1e-3).stiffness, 0.);
}



TEST(Stability, friction_that_falls_with_speed_is_stable_on_no_spring)
{
  const Settings law      = {{"Effects", "stribeck"},
                             {"stribeck/Rise", "0.5"},
                             {"stribeck/Speed", "1 mm/s"}};
  const double   infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(computed(law, 0.5, 0.).stiffness, infinity);
  EXPECT_EQ(computed(law, 0.5, 1e-3).stiffness, infinity);
}



TEST(Stability, other_effects_take_part)
{
  const double V = 0.03;
  Sliding      dragged{V, 1e-3, 0.5};
  const auto   expected = closed_form(dragged);
  const auto   found    = computed(
    with(core,
         {{"Effects", "subloading, overstress, softening, healing, viscous"},
               {"viscous/Drag", "0.5"}}),
    V,
    1e-3);
  EXPECT_NEAR(found.stiffness, expected.stiffness, 2e-3 * expected.stiffness);
  EXPECT_LT(found.stiffness, 0.9 * closed_form(V, 1e-3).stiffness);
}



TEST(Stability, nothing_is_said_of_what_never_becomes_steady)
{
  const auto law =
    make_law({{"Effects", "heating"}, {"heating/Cooling time", "1e30"}});
  EXPECT_FALSE(SteadySliding(*law, vector(1.), pressure).exists());
  const auto cooled = make_law({{"Effects", "heating"}});
  EXPECT_TRUE(SteadySliding(*cooled, vector(1.), pressure).exists());
}
