// SPDX-License-Identifier: LGPL-2.1-or-later

// Steps of two stages: their order in time, their error estimate, and which of
// several roots they take.

#include "law_test_tools.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace SlipStep;
using namespace SlipStep::Testing;
using dealii::Tensor;

namespace
{
  // Even motion and pressure.
  struct Move
  {
    Tensor<1, 2> velocity;
    double       pressure; ///< at the end
    double       duration;
  };

  // One step of two stages; not committed.
  void make_step(const FrictionLaw &law,
                 const Move        &move,
                 const double       start_pressure,
                 const double       share,
                 ContactPoint      &point)
  {
    constexpr double gamma = TwoStages::gamma;
    const double     time = share * move.duration, old = start_pressure;
    const double     now  = old + share * (move.pressure - old);
    const auto       slip = gamma * time * move.velocity;
    point.revert();
    point.update(law, slip, old + gamma * (now - old), gamma * time);
    point.begin_second_stage(law);
    point.update(law, slip, now, gamma * time);
  }

  void advance(const FrictionLaw &law,
               const Move        &move,
               const unsigned int n_steps,
               ContactPoint      &point)
  {
    const double start = point.committed().normal_traction;
    for (unsigned int step = 0; step < n_steps; ++step)
      {
        const double pressure =
          start + (move.pressure - start) * step / n_steps;
        make_step(law,
                  {move.velocity,
                   start + (move.pressure - start) * (step + 1) / n_steps,
                   move.duration / n_steps},
                  pressure,
                  1.,
                  point);
        point.commit();
      }
  }

  // A point that is pressed in one step, then moved in many.
  ContactPoint moved_point(const FrictionLaw &law,
                           const Move        &move,
                           const unsigned int n_steps,
                           const double       pressure = 5.8)
  {
    ContactPoint point(law);
    advance(law, {vector(0.), pressure, 1.}, 1, point);
    advance(law, move, n_steps, point);
    return point;
  }

  const std::string paper_effects = "subloading, overstress, softening";

  struct SmoothCase
  {
    const char *name;
    Settings    settings;
    Move        before, move;
  };

  // After a first motion a second one, along which everything changes evenly.
  std::vector<SmoothCase> smooth_cases()
  {
    const double       V       = 50. / 60.;
    const Tensor<1, 2> forward = vector(V), faster = vector(3. * V),
                       turned = V * vector(0.8, 0.6);
    return {{"paper",
             {{"Effects", paper_effects}},
             {forward, 5.8, 1e-3},
             {forward, 5.8, 1e-2}},
            {"pressure_ramp",
             {{"Effects", paper_effects + ", pressure"}},
             {forward, 20., 0.1},
             {forward, 34.2, 0.1}},
            {"turn",
             {{"Effects", "softening"}},
             {forward, 5.8, 0.1},
             {turned, 5.8, 1e-4}},
            {"anisotropy",
             {{"Effects", paper_effects + ", anisotropy"},
              {"anisotropy/Ratio", "0.6"}},
             {forward, 5.8, 0.1},
             {turned, 5.8, 1e-4}},
            {"elastic_core",
             {{"Effects", paper_effects + ", elastic_core, heating"},
              {"elastic_core/Rate", "300"},
              {"heating/Weakening", "0.02"}},
             {forward, 5.8, 1e-3},
             {turned, 5.8, 1e-3}},
            {"healing_and_ageing",
             {{"Effects", paper_effects + ", healing, ageing"},
              {"healing/Rate", "0.01"},
              {"healing/Steepness", "100"},
              {"softening/Rate", "20"},
              {"ageing/Growth", "0.05"},
              {"ageing/Time", "0.01 s"},
              {"ageing/Renewal length", "0.02"}},
             {forward, 5.8, 0.01},
             {forward, 5.8, 0.1}},
            {"heating",
             {{"Effects", paper_effects + ", heating"},
              {"heating/Weakening", "0.02"},
              {"heating/Cooling time", "0.5 s"}},
             {forward, 5.8, 0.1},
             {forward, 5.8, 1.}},
            {"viscous",
             {{"Effects", "subloading, viscous, run_in"},
              {"run_in/Length", "0.05"}},
             {faster, 7., 0.01},
             {faster, 19., 0.1}}};
  }
} // namespace



TEST(TwoStages, second_order_in_time)
{
  for (const SmoothCase &one : smooth_cases())
    {
      const auto         law    = make_law(one.settings);
      const ContactPoint start  = moved_point(*law, one.before, 1000);
      const auto         result = [&](const unsigned int n_steps) {
        ContactPoint point = start;
        advance(*law, one.move, n_steps, point);
        return point.committed();
      };
      const ContactState exact = result(20000), coarse = result(500),
                         fine = result(1000);
      // At least of second order, or no error left to speak of.
      const auto falls = [](const double before, const double after) {
        return after < std::max(std::exp2(-1.75) * before, 1e-8);
      };
      EXPECT_PRED2(falls,
                   (coarse.traction - exact.traction).norm(),
                   (fine.traction - exact.traction).norm())
        << one.name;
      EXPECT_PRED2(falls,
                   std::abs(coarse.dissipation - exact.dissipation),
                   std::abs(fine.dissipation - exact.dissipation))
        << one.name;
    }
}



// The estimate is that of the first order: it grows with the square of the step
// and lies above the error of the second.
TEST(TwoStages, estimate_bounds_the_error_of_a_step)
{
  for (const SmoothCase &one : smooth_cases())
    {
      const auto         law   = make_law(one.settings);
      const ContactPoint start = moved_point(*law, one.before, 1000);
      for (const double share : {1e-3, 1e-2, 0.1})
        {
          const double old   = start.committed().normal_traction;
          ContactPoint point = start, exact = start;
          make_step(*law, one.move, old, share, point);
          const double estimate = point.error(*law).measure();
          advance(*law,
                  {one.move.velocity,
                   old + share * (one.move.pressure - old),
                   share * one.move.duration},
                  2000,
                  exact);
          const double error =
            (point.trial().traction - exact.committed().traction).norm() /
            point.trial().strength;
          EXPECT_GT(1.5 * estimate, error) << one.name << " " << share;
          EXPECT_GE(estimate, 0.) << one.name;
        }
    }
}



// What two stages or a comparison at the end alone could miss.
TEST(TwoStages, estimate_sees_what_hides)
{
  const double V        = 1.;
  const auto   estimate = [&](const Settings &settings,
                            const Move     &move,
                            const double    pressure = 5.8) {
    const auto   law = make_law(settings);
    ContactPoint point =
      moved_point(*law, {vector(V), pressure, 1.}, 1000, pressure);
    make_step(*law, move, pressure, 1., point);
    return point.error(*law);
  };
  const Settings rate = {{"Effects", "subloading, overstress"}};
  // A reversal of which both stages end unloaded.
  EXPECT_GT(estimate(rate, {vector(-V), 5.8, 4e-5}).at_end, 1e-2);
  // Pressure that changes while the contact slides.
  EXPECT_GT(estimate({{"Effects", "subloading, pressure"},
                      {"pressure/Exponent", "0.3"}},
                     {vector(V), 50., 1.},
                     5.)
              .measure(),
            1e-3);
  // A turn.
  EXPECT_GT(
    estimate({{"Effects", "subloading"}}, {vector(0., V), 5.8, 1e-4}).at_end,
    1e-2);
  // The contact opens in the step.
  EXPECT_GT(estimate({{"Effects", ""}}, {vector(V), -5.8, 1.}).at_end, 1e-2);
  // A memory at rest, while no traction changes.
  EXPECT_GT(estimate({{"Effects", "heating"},
                      {"heating/Weakening", "0.02"},
                      {"heating/Cooling time", "2 s"}},
                     {vector(V), 5.8, 2.})
              .at_end,
            1e-3);
  // Steady sliding has no error, however long the step.
  EXPECT_LT(estimate(rate, {vector(V), 5.8, 100.}).measure(), 1e-9);
}



// The pressure falls evenly through zero at a share of a step: until then all
// motion is slip, and what was elastic becomes slip with it.
TEST(TwoStages, slip_counts_until_the_contact_opens)
{
  for (const Settings &settings :
       {Settings{{"Effects", ""}},
        Settings{{"Effects", paper_effects + ", run_in"}},
        Settings{{"Effects", "anisotropy, wear"},
                 {"anisotropy/Ratio", "2"},
                 {"wear/Specific rate", "1"}}})
    {
      const auto         law    = make_law(settings);
      const ContactPoint start  = moved_point(*law, {vector(1.), 5., 1.}, 100);
      const ContactState before = start.committed();
      const double elastic  = before.traction[0] / law->tangential_stiffness();
      const double duration = 0.1;
      for (const double share : {0.05, 0.2, 0.29, 0.4, 0.6, 0.71, 0.9, 1.})
        {
          ContactPoint point = start;
          make_step(
            *law, {vector(1.), 5. - 5. / share, duration}, 5., 1., point);
          const double slip      = point.trial().slip_path - before.slip_path;
          const double true_slip = share * duration;
          // Where only the second stage is open, and the place to which the
          // first is carried on as well, that place counts.
          const bool carried =
            share > TwoStages::gamma && share < 1. - TwoStages::gamma;
          EXPECT_NEAR(slip,
                      carried ? (1. - TwoStages::gamma) * duration : true_slip,
                      2. * elastic)
            << settings.front().second << " " << share;
          EXPECT_EQ(point.trial().traction.norm(), 0.);
        }
    }
}



// Whatever a point goes through, on the plane and off it, it is where it was
// moved to, less the slip that is elastic.
TEST(TwoStages, place_is_where_the_point_was_moved_to)
{
  Testing::RandomLoads loads(7);
  for (const Settings &more : {Settings{{"Effects", "texture"}},
                               Settings{{"Effects", "texture, subloading"}},
                               Settings{{"Effects", "texture, anisotropy"},
                                        {"anisotropy/Ratio", "2"},
                                        {"anisotropy/Angle", "30 deg"}}})
    {
      const auto           law = make_law(more);
      ContactPoint         point(*law);
      dealii::Tensor<1, 2> place;
      for (unsigned int step = 0; step < 300; ++step)
        {
          const Move move{loads.random_slip(-5., 0.),
                          loads.uniform(-5., 10.),
                          loads.uniform(0.5, 1.5)};
          make_step(*law, move, point.committed().normal_traction, 1., point);
          point.commit();
          place += move.duration * move.velocity;
          const ContactState &state = point.committed();
          const auto elastic = invert(law->elastic_tangent()) * state.traction;
          EXPECT_NEAR(state[contact_memory("track_1_mm")] + elastic[0],
                      place[0],
                      1e-9)
            << more.front().second << ' ' << step;
          EXPECT_NEAR(state[contact_memory("track_2_mm")] + elastic[1],
                      place[1],
                      1e-9);
        }
    }
}



// A law with two stable answers to the same traction: one that slides goes on,
// whatever the steps, and one that sticks does not.
TEST(TwoStages, sliding_goes_on_where_it_can)
{
  const auto law = make_law({{"Effects", "subloading, overstress, stribeck"},
                             {"stribeck/Rise", "0.7"},
                             {"stribeck/Speed", "0.1 mm/s"}});
  const ContactPoint start    = moved_point(*law, {vector(10.), 5.8, 1.}, 2000);
  const double       friction = start.committed().traction[0];
  for (const double duration : {1e-9, 1e-7, 1e-5, 1e-3, 1.})
    {
      ContactPoint point = start;
      advance(*law, {vector(10.), 5.8, duration}, 5, point);
      EXPECT_NEAR(point.committed().traction[0], friction, 1e-8 * friction)
        << duration;
      EXPECT_NEAR(point.committed().slip_rate, 10., 1e-4) << duration;
    }

  // The same traction on a contact at rest: it sticks, but for a creep.
  ContactState rest = start.committed();
  rest.slip_rate    = 0.;
  ContactPoint point(rest);
  advance(*law, {vector(10.), 5.8, 1e-9}, 1, point);
  EXPECT_LT(point.committed().slip_rate, 1e-3);

  // A reversal ends the branch.
  point = start;
  advance(*law, {vector(-10.), 5.8, 6e-6}, 1, point);
  EXPECT_EQ(point.committed().slip_rate, 0.);
}



TEST(TwoStages, names_the_effect_that_weakens)
{
  const auto law =
    make_law({{"Effects", "subloading, overstress, stribeck, viscous"}});
  const ContactPoint point = moved_point(*law, {vector(0.5), 5.8, 10.}, 1000);
  EXPECT_EQ(law->weakening_effects(point.committed()),
            std::vector<std::string>{"stribeck"});
}
