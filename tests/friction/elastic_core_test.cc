// SPDX-License-Identifier: LGPL-2.1-or-later

// The elastic core: closed forms, an integrator of its own, cycles that shake
// down, energy.

#include "law_test_tools.h"

#include <boost/numeric/odeint.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

using namespace SlipStep;
using namespace SlipStep::Testing;
using dealii::Tensor;

namespace
{
  const ContactMemory &core_1      = contact_memory("core_1");
  const ContactMemory &core_2      = contact_memory("core_2");
  const ContactMemory &core_energy = contact_memory("core_energy_MPa_mm");

  Tensor<1, 2> core_of(const ContactState &state)
  {
    return vector(state[core_1], state[core_2]);
  }

  // u = 1000 /mm, mu = 0.1, 10 MPa, so tau_y = 1 MPa.
  std::unique_ptr<FrictionLaw> cyclic_law(const std::string &rate,
                                          const std::string &range)
  {
    return make_law({{"Effects", "subloading, elastic_core"},
                     {"Static coefficient", "0.1"},
                     {"Tangential stiffness", "1000"},
                     {"subloading/Rate", "1000"},
                     {"subloading/Elastic range", range},
                     {"elastic_core/Rate", rate},
                     {"elastic_core/Limit", "0.95"}});
  }

  // Push a point to a load of one direction, in many steps.
  void push(const FrictionLaw &law,
            const double       load,
            const int          n_steps,
            ContactPoint      &point)
  {
    const double start = point.committed().traction[0];
    for (int step = 1; step <= n_steps; ++step)
      {
        const double target = start + (load - start) * step / n_steps;
        double       slip   = 0.;
        for (int iteration = 0; iteration < 50; ++iteration)
          {
            const ContactResponse response =
              point.update(law, vector(slip), 10., 1.);
            const double miss = target - response.traction[0];
            if (std::abs(miss) < 1e-13)
              break;
            slip += miss / response.d_slip[0][0];
          }
        ASSERT_NEAR(point.trial().traction[0], target, 1e-12);
        point.commit();
      }
  }

  // The same by the rate equations, of which the load is the time:
  // dx = lambda [(n - c) U + (1 - r) C (chi n - c)].
  struct ReferenceCycles
  {
    double u = 1000., C, chi = 0.95, range;
    double core = 0., ratio = 0., load = 0., path = 0.;

    double ratio_at(const double x) const
    {
      return x >= core ? (x - core) / (1. - core) : (core - x) / (1. + core);
    }

    void push(const double target)
    {
      const double n = target > load ? 1. : -1.;
      // Where the elastic path ends.
      const bool   turns = n * (core - load) > 0.;
      const double least =
        std::max(turns ? (n * (core - target) > 0. ? 2. : 0.) : ratio, range);
      const double onset = core + n * (1. - n * core) * least;
      if (least > 1. || n * (target - onset) <= 0.)
        {
          ratio = ratio_at(target);
          load  = target;
          return;
        }
      using Values = std::array<double, 3>; // r, c, path
      Values values{{least, core, path}};
      namespace odeint = boost::numeric::odeint;
      odeint::integrate_adaptive(
        odeint::make_controlled<odeint::runge_kutta_dopri5<Values>>(1e-12,
                                                                    1e-12),
        [&](const Values &y, Values &rate, double) {
          const double share = std::max((y[0] - range) / (1. - range), 0.);
          const double slow  = std::tan(M_PI_2 * share) / u; // 1/U
          const double slip =
            slow / (1. - n * y[1] + (1. - y[0]) * C * (chi - n * y[1]) * slow);
          rate = {{slow > 0. ? slip / slow : 1. / (1. - n * y[1]),
                   C * (chi * n - y[1]) * slip,
                   slip}};
        },
        values,
        0.,
        n * (target - onset),
        1e-3);
      ratio = values[0];
      core  = values[1];
      path  = values[2];
      load  = target;
    }
  };
} // namespace



// Between r_1 and r_2 there is a core from which both are as far.
TEST(ElasticCore, is_in_the_middle_of_two_loads)
{
  const auto law = cyclic_law("1000", "0");
  for (const std::array<double, 2> range :
       {std::array<double, 2>{{0.3, 0.9}}, {{0., 0.6}}, {{-0.5, 0.8}}})
    {
      ContactState state    = law->initial_state();
      state.normal_traction = 10.;
      state.strength        = 1.;
      state[core_1] = (range[0] + range[1]) / (2. + range[0] - range[1]);
      for (const double r : range)
        {
          state.traction[0]  = r;
          state.normal_ratio = 1.;
          law->complete(state);
          EXPECT_NEAR(state.normal_ratio, (range[1] - range[0]) / 2., 1e-14);
          EXPECT_NEAR(state.loading_ratio, std::abs(r), 1e-14);
        }
    }
}



TEST(ElasticCore, follows_its_rate_equations_in_cycles)
{
  for (const auto &[rate, range] :
       {std::array<double, 2>{{2000., 0.}}, {{2000., 0.35}}, {{300., 0.1}}})
    {
      const auto law = cyclic_law(std::to_string(rate), std::to_string(range));
      ContactPoint point(*law);
      point.update(*law, vector(0.), 10., 1.);
      point.commit();
      ReferenceCycles reference;
      reference.C     = rate;
      reference.range = range;
      for (const double load : {0.9, 0.3, 0.95, -0.4, 0.2, 0.1, -0.8, 0.7})
        {
          push(*law, load, 2000, point);
          reference.push(load);
          const ContactState &state = point.committed();
          EXPECT_NEAR(state[core_1], reference.core, 1e-3) << load;
          EXPECT_NEAR(state.slip_path, reference.path, 1e-3 * reference.path)
            << load;
          EXPECT_NEAR(state.normal_ratio, reference.ratio, 1e-3) << load;
        }
    }
}



// From no load on, where a core moves farther in a step than r_s reaches. By
// the rate equations, of which ln(r_s) is the time.
TEST(ElasticCore, begins_as_its_rate_equations_say)
{
  constexpr double u = 50., C = 1000., chi = 0.9, stiffness = 9200.,
                   pressure = 5., length = pressure * 0.2 / stiffness;
  const auto law = make_law({{"Effects", "subloading, elastic_core"},
                             {"Static coefficient", "0.2"},
                             {"Tangential stiffness", "9200"},
                             {"subloading/Form", "log"},
                             {"subloading/Rate", "50"},
                             {"elastic_core/Rate", "1000"},
                             {"elastic_core/Limit", "0.9"}});

  using Values = std::array<double, 3>; // core, x, displacement
  Values values{};
  namespace odeint = boost::numeric::odeint;
  odeint::integrate_adaptive(
    odeint::make_controlled<odeint::runge_kutta_dopri5<Values>>(1e-12, 1e-12),
    [&](const Values &y, Values &rate, const double time) {
      const double r = std::exp(time), slip = -r / (u * time);
      const double core = C * (chi - y[0]) * slip;
      const double x    = (1. - y[0]) * r + (1. - r) * core;
      rate              = {{core, x, slip + x * length}};
    },
    values,
    -60.,
    -1.5,
    1e-3);

  const int    n_steps = 2. + values[2] / 2e-6;
  ContactPoint point(*law);
  point.update(*law, vector(0.), pressure, 1.);
  point.commit();
  for (int step = 0; step < n_steps; ++step)
    {
      const Tensor<1, 2> way  = vector(TwoStages::gamma * values[2] / n_steps);
      const double       time = TwoStages::gamma * 2e-5;
      point.update(*law, way, pressure, time);
      point.begin_second_stage(*law);
      point.update(*law, way, pressure, time);
      point.commit();
    }
  EXPECT_NEAR(point.committed().normal_ratio, std::exp(-1.5), 1e-4);
  EXPECT_NEAR(core_of(point.committed())[0], values[0], 1e-4);
  EXPECT_NEAR(point.committed().traction[0], values[1], 1e-4);
}



// A quick core and an elastic range as wide as the cycles: they end.
TEST(ElasticCore, cycles_shake_down)
{
  const auto   law = cyclic_law("10000", "0.35");
  ContactPoint point(*law);
  point.update(*law, vector(0.), 10., 1.);
  point.commit();
  std::array<double, 10> slip{}, net{};
  for (unsigned int cycle = 0; cycle < 10; ++cycle)
    {
      const double path = point.committed().slip_path;
      push(*law, 0.9, 200, point);
      const double forth = point.committed().slip_path - path;
      push(*law, 0.3, 200, point);
      slip[cycle] = point.committed().slip_path - path;
      net[cycle]  = 2. * forth - slip[cycle];
    }
  EXPECT_LT(slip[9], 0.01 * slip[0]);
  EXPECT_LT(std::abs(net[9]), 0.01 * net[0]);
  EXPECT_GT(slip[9], 0.);
  for (unsigned int cycle = 1; cycle < 10; ++cycle)
    EXPECT_LT(slip[cycle], slip[cycle - 1]);

  // Without a core each cycle slips as the one before.
  const auto   initial = cyclic_law("0", "0");
  ContactPoint other(*initial);
  other.update(*initial, vector(0.), 10., 1.);
  other.commit();
  push(*initial, 0.9, 200, other);
  for (unsigned int cycle = 0; cycle < 3; ++cycle)
    {
      const double path = other.committed().slip_path;
      push(*initial, 0.3, 20, other);
      push(*initial, 0.9, 200, other);
      EXPECT_NEAR(other.committed().slip_path - path,
                  2. / (M_PI * 1000.) *
                    std::log(std::cos(M_PI_2 * 0.3) / std::cos(M_PI_2 * 0.9)),
                  1e-8);
    }
}



// Masing: to and fro between opposite loads, one branch of the loop is the
// other one, turned round.
TEST(ElasticCore, closes_its_loops)
{
  const auto   law = cyclic_law("2000", "0");
  ContactPoint point(*law);
  point.update(*law, vector(0.), 10., 1.);
  point.commit();
  for (unsigned int cycle = 0; cycle < 8; ++cycle)
    {
      push(*law, 0.9, 300, point);
      push(*law, -0.9, 300, point);
    }
  std::array<std::vector<double>, 2> branches;
  for (unsigned int branch = 0; branch < 2; ++branch)
    {
      const double sign = branch == 0 ? 1. : -1.;
      const double path = point.committed().slip_path;
      for (const double load : {-0.5, 0., 0.4, 0.7, 0.9})
        {
          push(*law, sign * load, 100, point);
          branches[branch].push_back(point.committed().slip_path - path);
        }
    }
  for (unsigned int i = 0; i < branches[0].size(); ++i)
    EXPECT_NEAR(branches[0][i], branches[1][i], 1e-4 * branches[0][4]) << i;
  EXPECT_GT(branches[0][1], 0.);
}



// With a rate effect and in the plane: x' = alpha_t (V - lambda n)/tau_y.
TEST(ElasticCore, follows_its_rate_equations_round_a_corner)
{
  const auto law =
    make_law({{"Effects", "subloading, overstress, elastic_core"},
              {"elastic_core/Rate", "300"},
              {"elastic_core/Limit", "0.8"}});
  const double C = 300., chi = 0.8, u = 200., eta = 1.15e4, n = 16.52,
               r_m = 1.8, alpha_t = 1e4, strength = 0.115 * 5.8;
  using Values           = std::array<double, 6>; // x, c, r_s, path
  const auto slope_along = [&](const Tensor<1, 2> &velocity) {
    return [&, velocity](const Values &y, Values &rate, double) {
      Tensor<1, 2>       normal = vector(y[0], y[1]);
      const Tensor<1, 2> c      = vector(y[2], y[3]);
      normal -= (1. - y[4]) * c;
      const double r = normal.norm();
      normal /= r;
      const double slip =
        r > y[4] ? std::expm1(n * (r - y[4])) / (r_m - r) / eta : 0.;
      const Tensor<1, 2> x   = alpha_t / strength * (velocity - slip * normal);
      const Tensor<1, 2> d_c = C * slip * (chi * normal - c);
      rate                   = {
                          {x[0], x[1], d_c[0], d_c[1], slip * u / std::tan(M_PI_2 * y[4]), slip}};
    };
  };

  ContactState start    = law->initial_state();
  start.normal_traction = 5.8;
  start.strength        = strength;
  start.normal_ratio    = 0.4;
  start[core_1]         = 0.3;
  start[core_2]         = -0.2;
  start.traction =
    strength * (0.6 * vector(0.3, -0.2) + 0.4 * vector(0.6, 0.8));
  law->complete(start);
  EXPECT_NEAR(start.normal_ratio, 0.4, 1e-12);
  const std::array<Tensor<1, 2>, 2> velocities{
    {vector(0.4, 0.3), vector(-0.1, 0.5)}};
  const double duration = 4e-4;

  Values values{{start.traction[0] / strength,
                 start.traction[1] / strength,
                 0.3,
                 -0.2,
                 0.4,
                 0.}};
  namespace odeint = boost::numeric::odeint;
  for (const auto &velocity : velocities)
    odeint::integrate_adaptive(
      odeint::make_controlled<odeint::runge_kutta_dopri5<Values>>(1e-11, 1e-11),
      slope_along(velocity),
      values,
      0.,
      duration,
      1e-9);

  std::array<double, 2> errors{};
  for (unsigned int level = 0; level < 2; ++level)
    {
      ContactPoint       point(start);
      const unsigned int n_steps = 400 << level;
      for (const auto &velocity : velocities)
        for (unsigned int step = 0; step < n_steps; ++step)
          {
            const double time = TwoStages::gamma * duration / n_steps;
            point.update(*law, time * velocity, 5.8, time);
            point.begin_second_stage(*law);
            point.update(*law, time * velocity, 5.8, time);
            point.commit();
          }
      const ContactState &end = point.committed();
      const Tensor<1, 2>  x   = vector(values[0], values[1]);
      errors[level]           = (end.traction / strength - x).norm();
      EXPECT_LT(errors[level], 1e-4);
      EXPECT_NEAR(end.slip_path, values[5], 1e-3 * values[5]);
      EXPECT_LT((core_of(end) - vector(values[2], values[3])).norm(), 1e-3);
      EXPECT_NEAR(end.normal_ratio, values[4], 1e-3);
    }
  EXPECT_GT(std::log2(errors[0] / errors[1]), 1.75);
}



// In full sliding the core is of no importance.
TEST(ElasticCore, leaves_sliding_alone)
{
  const Settings settings = {{"Effects", "subloading, overstress, softening"}};
  Settings       more     = settings;
  more[0].second += ", elastic_core";
  const auto   with = make_law(more), without = make_law(settings);
  ContactPoint a(*with), b(*without);
  for (unsigned int step = 0; step < 200; ++step)
    {
      a.update(*with, vector(0.008, 0.006), 5.8, 0.01);
      b.update(*without, vector(0.008, 0.006), 5.8, 0.01);
      a.commit();
      b.commit();
    }
  EXPECT_LT((a.committed().traction - b.committed().traction).norm(), 1e-10);
  EXPECT_LT((core_of(a.committed()) - 0.9 * vector(0.8, 0.6)).norm(), 1e-10);
}



// What the core takes it gives back, and the rest is heat.
// Where the contact is: what is not elastic of the motion, whichever way it
// goes. With an elliptic cone f_t = P f', and elastic is P^-1 f'/alpha_t.
TEST(ElasticCore, knows_where_the_contact_is)
{
  const ContactMemory &track_1  = contact_memory("track_1_mm");
  const ContactMemory &track_2  = contact_memory("track_2_mm");
  const ContactMemory &position = contact_memory("position_mm");
  for (const std::string more : {"", ", anisotropy", ", overstress, run_in"})
    {
      const auto                       law = make_law({{"Effects",
                                                        "subloading, elastic_core, "
                                                                              "texture, expression" +
                                                          more},
                                                       {"Tangential stiffness", "1000"},
                                                       {"texture/Amplitude", "0.3"},
                                                       {"texture/Wavelength", "0.02"},
                                                       {"expression/Covariate", "position"},
                                                       {"expression/Formula", "1 + 0.1*sin(300*x)"},
                                                       {"expression/From", "-1"},
                                                       {"expression/To", "1"}});
      std::mt19937                     random(1);
      std::uniform_real_distribution<> between(-1., 1.);
      ContactPoint                     point(*law);
      Tensor<1, 2>                     moved, backward;
      for (unsigned int step = 0; step < 500; ++step)
        {
          // Back and forth along two directions.
          Tensor<1, 2> increment =
            4e-4 * (0.6 + std::sin(0.1 * step)) *
            vector(1. + 0.3 * between(random), 0.5 * between(random));
          moved += increment;
          const Tensor<1, 2> was =
            vector(point.committed()[track_1], point.committed()[track_2]);
          const double f_n = 10. + between(random);
          point.update(*law, TwoStages::gamma * increment, f_n, 0.01);
          point.begin_second_stage(*law);
          point.update(*law, TwoStages::gamma * increment, f_n, 0.01);
          point.commit();
          const ContactState &end = point.committed();
          const Tensor<1, 2>  at  = vector(end[track_1], end[track_2]);
          Tensor<1, 2> elastic = law->isotropic_traction(end.traction) / 1000.;
          if (law->has("anisotropy"))
            elastic = law->isotropic_traction(elastic);
          EXPECT_LT((at - (moved - elastic)).norm(), 1e-12) << "step " << step;
          EXPECT_NEAR(end[position], at[0], 1e-12);
          if ((at - was) * end.traction < 0.)
            backward += at - was;
        }
      // Against the traction that is still there.
      EXPECT_GT(backward.norm(), 1e-4);
    }
}



TEST(ElasticCore, holds_energy)
{
  const auto   law = cyclic_law("2000", "0");
  ContactPoint point(*law);
  point.update(*law, vector(0.), 10., 1.);
  point.commit();
  double work = 0., given_back = 0.;
  for (unsigned int step = 0; step < 4000; ++step)
    {
      const double       t     = 1e-3 * step;
      const ContactState start = point.committed();
      const Tensor<1, 2> slip =
        1e-5 * vector(std::cos(5. * t), 0.5 * std::cos(9. * t));
      point.update(*law, slip, 10. + 5. * std::sin(t), 1.);
      point.commit();
      const ContactState &end = point.committed();
      work += 0.5 * (start.traction + end.traction) * slip;
      EXPECT_GE(end.dissipation, start.dissipation);
      given_back += std::max(start[core_energy] - end[core_energy], 0.);
    }
  EXPECT_NEAR(law->stored_energy(point.committed()) +
                point.committed().dissipation,
              work,
              0.01 * work);
  EXPECT_GT(given_back, 0.01 * work);
}



TEST(ElasticCore, needs_subloading)
{
  EXPECT_THROW(make_law({{"Effects", "elastic_core, overstress"}}), InputError);
}
