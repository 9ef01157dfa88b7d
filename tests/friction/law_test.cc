// SPDX-License-Identifier: LGPL-2.1-or-later

// Properties of the return mapping: tangent, admissibility, unloading,
// repeatability, order in time.

#include "law_test_tools.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace SlipStep;
using namespace SlipStep::Testing;
using dealii::Tensor;

namespace
{
  const std::string paper = "subloading, overstress, softening";

  // Laws that between them use every effect and form.
  std::vector<std::pair<std::string, Settings>> laws()
  {
    return {{"coulomb", {{"Effects", ""}}},
            {"rate_independent", {{"Effects", "subloading, softening"}}},
            {"logarithmic",
             {{"Effects", "subloading, overstress"},
              {"subloading/Form", "log"}}},
            {"paper", {{"Effects", paper}}},
            {"no_subloading", {{"Effects", "overstress, softening"}}},
            {"healing",
             {{"Effects", paper + ", healing"},
              {"healing/Rate", "1e-3"},
              {"healing/Steepness", "100"}}},
            {"probe", {{"Effects", paper + ", probe"}}},
            {"perzyna", {{"Effects", "subloading, perzyna, softening"}}},
            {"core",
             {{"Effects", paper + ", elastic_core"},
              {"subloading/Elastic range", "0.2"}}},
            {"core_without_rate",
             {{"Effects", "subloading, elastic_core, pressure"},
              {"pressure/Exponent", "0.1"},
              {"elastic_core/Rate", "300"}}},
            {"opposite",
             {{"Effects", paper + ", anisotropy"},
              {"anisotropy/Form", "opposite"},
              {"anisotropy/Ratio", "0.6"},
              {"anisotropy/Angle", "35 deg"}}},
            {"remembered_rate",
             {{"Effects", paper + ", memory_length"},
              {"memory_length/Form", "flow"},
              {"memory_length/Slip length", "0.01"}}}};
  }

  class EveryLaw
    : public ::testing::TestWithParam<std::pair<std::string, Settings>>,
      protected RandomLoads
  {
  protected:
    EveryLaw()
      : RandomLoads(42)
    {}

    std::unique_ptr<FrictionLaw> law = make_law(GetParam().second);
  };
} // namespace

INSTANTIATE_TEST_SUITE_P(Law,
                         EveryLaw,
                         ::testing::ValuesIn(laws()),
                         [](const auto &info) { return info.param.first; });



// What a mesh change relies on: the law's own states are within the bounds that
// it names, and complete as they are.
TEST_P(EveryLaw, states_are_complete_and_within_bounds)
{
  const auto range = law->coefficient_range();
  EXPECT_LE(range[0], law->initial_state().coefficient);
  EXPECT_GE(range[1], law->initial_state().coefficient);
  ContactState state = law->initial_state();
  for (unsigned int step = 0; step < 500; ++step)
    {
      const ContactState start    = state;
      const double       pressure = uniform(-1., 1.) * magnitude(-1, 2);
      law->update(start, random_slip(-6, 0), pressure, magnitude(-6, 2), state);
      EXPECT_GE(state.coefficient, range[0] - 1e-12);
      EXPECT_LE(state.coefficient, range[1] + 1e-12);
      EXPECT_LE(state.loading_ratio, law->maximum_ratio() * (1. + 1e-9));
      ContactState completed  = state;
      completed.loading_ratio = -1.;
      law->complete(completed);
      EXPECT_NEAR(completed.loading_ratio,
                  state.loading_ratio,
                  1e-9 * state.loading_ratio);
      EXPECT_NEAR(completed.normal_ratio, state.normal_ratio, 1e-9);
      EXPECT_EQ(completed.traction, state.traction);
    }
}



TEST_P(EveryLaw, random_loading_never_fails)
{
  const double r_m =
    GetParam().first == "perzyna" ?
      1e300 :
      (GetParam().second[0].second.find("overstress") == std::string::npos ?
         1. + 1e-9 :
         1.8 + (GetParam().first == "core" ? 0.9 : 0.));
  ContactPoint point(*law);
  double       last_path = 0., last_dissipation = 0.;
  for (unsigned int step = 0; step < 1000000 / laws().size(); ++step)
    {
      const Step made = make_any_step(*law, point);
      if (made.has_two_stages)
        {
          ASSERT_TRUE(point.error(*law).measure() >= 0.) << "step " << step;
          ASSERT_TRUE(std::isfinite(point.error(*law).measure()));
        }
      point.commit();

      const ContactState &state = point.committed();
      ASSERT_TRUE(is_finite(made.response)) << "step " << step;
      ASSERT_GE(state.loading_ratio, 0.);
      ASSERT_LT(state.loading_ratio, r_m) << "step " << step;
      ASSERT_GE(state.normal_ratio, 0.);
      ASSERT_LE(state.normal_ratio, 1.);
      // r >= r_s always, up to round-off.
      if (GetParam().first != "coulomb" &&
          GetParam().first != "no_subloading" &&
          GetParam().first.find("core") == std::string::npos &&
          made.pressure > 0.)
        {
          ASSERT_GE(state.loading_ratio, state.normal_ratio - 1e-9)
            << "step " << step;
        }
      ASSERT_GT(state.coefficient, 0.);
      ASSERT_LE(state.coefficient, law->static_coefficient() * (1. + 1e-12));
      ASSERT_GE(state.slip_path, last_path);
      ASSERT_GE(state.dissipation, last_dissipation);
      last_path        = state.slip_path;
      last_dissipation = state.dissipation;
    }
}



TEST_P(EveryLaw, tangent_matches_finite_differences)
{
  unsigned int n_compared = 0, n_plastic = 0;
  ContactPoint point(*law);
  for (unsigned int step = 0; step < 4000; ++step)
    {
      const Load         load = begin_plain_step(*law, step % 2 == 1, point);
      const Tensor<1, 2> slip = load.slip;
      const double       f_n = load.pressure, dt = load.duration;

      const ContactResponse response = point.update(*law, slip, f_n, dt);
      const ContactState    start    = point.committed();

      // Fourth-order central differences with two step lengths; where they
      // disagree (next to a kink: yield, reversal) there is nothing to compare
      // with.
      const auto compare = [&](const Tensor<1, 2> &d_slip,
                               const double        d_normal,
                               const Tensor<1, 2> &derivative,
                               const double        scale) {
        const auto at = [&](const double t) {
          return point.update(*law, slip + t * d_slip, f_n + t * d_normal, dt)
            .traction;
        };
        const auto difference = [&](const double h) {
          return (8. * (at(h) - at(-h)) - (at(2. * h) - at(-2. * h))) /
                 (12. * h * scale);
        };
        const Tensor<1, 2> fd = difference(2e-4);
        if ((fd - difference(1e-4)).norm() > 2e-8)
          return;
        ++n_compared;
        for (unsigned int c = 0; c < 2; ++c)
          EXPECT_NEAR(derivative[c] / scale, fd[c], 1e-7) << "step " << step;
      };

      const double length = slip.norm(), alpha_t = law->tangential_stiffness();
      for (unsigned int d = 0; d < 2; ++d)
        {
          Tensor<1, 2> direction, derivative;
          direction[d] = length;
          for (unsigned int c = 0; c < 2; ++c)
            derivative[c] = response.d_slip[c][d] * length;
          compare(direction, 0., derivative, alpha_t * length);
        }
      compare(vector(0.), f_n, response.d_normal * f_n, f_n);

      point.update(*law, slip, f_n, dt);
      n_plastic += point.trial().slip_path > start.slip_path;
      point.commit();
    }
  // Of 12000 derivatives nearly all.
  EXPECT_GT(n_compared, 10000u);
  EXPECT_GT(n_plastic, 1000u);
}



TEST_P(EveryLaw, update_is_repeatable_and_leaves_the_committed_state)
{
  ContactPoint point(*law);
  point.update(*law, vector(1e-3, 2e-4), 5.8, 0.1);
  point.commit();
  const ContactState before = point.committed();

  const ContactResponse first = point.update(*law, vector(2e-3), 6., 0.1);
  point.update(*law, vector(-5., 3.), 0.1, 7.);
  const ContactResponse second = point.update(*law, vector(2e-3), 6., 0.1);
  EXPECT_EQ(first.traction, second.traction);
  EXPECT_EQ(first.d_slip, second.d_slip);

  EXPECT_EQ(point.committed().traction, before.traction);
  EXPECT_EQ(point.committed().coefficient, before.coefficient);
  EXPECT_EQ(point.committed().normal_ratio, before.normal_ratio);
  EXPECT_EQ(point.committed().slip_path, before.slip_path);
  point.revert();
  EXPECT_EQ(point.trial().traction, before.traction);
}



TEST_P(EveryLaw, contact_lost_and_found)
{
  ContactPoint point(*law);
  point.update(*law, vector(1e-3), 5.8, 0.1);
  point.commit();
  const double elastic_energy = law->stored_energy(point.committed());
  const double dissipated     = point.committed().dissipation;

  const ContactResponse open = point.update(*law, vector(3.), -0.1, 0.1);
  EXPECT_EQ(open.traction.norm(), 0.);
  EXPECT_EQ(open.d_slip.norm(), 0.);
  point.commit();
  EXPECT_DOUBLE_EQ(point.committed().dissipation, dissipated + elastic_energy);

  // Back in contact it starts from nothing, like a new point.
  const ContactState    lost  = point.committed();
  const ContactResponse back  = point.update(*law, vector(1e-5), 5.8, 0.1);
  ContactState          fresh = law->initial_state();
  fresh.coefficient           = lost.coefficient;
  fresh.slip_path             = lost.slip_path;
  ContactState          end;
  const ContactResponse virgin =
    law->update(fresh, vector(1e-5), 5.8, 0.1, end);
  EXPECT_EQ(back.traction, virgin.traction);
}



TEST_P(EveryLaw, falling_pressure_makes_slip)
{
  // With no motion at all, less pressure must still let the traction go down.
  ContactPoint point(*law);
  point.update(*law, vector(1e-2), 10., 1.);
  point.commit();
  const double before = point.committed().traction[0];
  point.update(*law, vector(0.), 0.01, 1.);
  EXPECT_LT(point.trial().traction[0], 1e-2 * before);
  EXPECT_GT(point.trial().slip_path, point.committed().slip_path);
}



TEST(Law, unloading_and_reloading_in_one_step)
{
  // A step that turns round inside must end where two steps end. Without rate
  // and softening the law is integrated exactly, so they agree to round-off.
  const auto   law = make_law({{"Effects", "subloading"}});
  ContactState loaded;
  law->update(law->initial_state(), vector(2e-3), 5.8, 1., loaded);

  // -2 f_t/alpha_t of elastic travel ends at the opposite traction.
  const double travel = loaded.traction[0] / 1e4;
  ContactState half, full_in_two, full_in_one;
  law->update(loaded, vector(-travel), 5.8, 1., half);
  EXPECT_NEAR(half.traction[0], 0., 1e-12);
  EXPECT_NEAR(half.normal_ratio, 0., 1e-12);
  law->update(half, vector(-travel), 5.8, 1., full_in_two);
  law->update(loaded, vector(-2. * travel), 5.8, 1., full_in_one);
  EXPECT_NEAR(full_in_one.traction[0], full_in_two.traction[0], 1e-10);
  EXPECT_LT(full_in_one.loading_ratio, 0.9 * loaded.loading_ratio);
}



TEST(Law, smallest_ratio_on_a_path_with_changing_pressure)
{
  // Compare one step with many along the same straight path in traction and
  // pressure; only the elastic part matters for where slip starts again.
  const auto law = make_law(
    {{"Effects", "subloading"}, {"subloading/Rate", "1e-3"}}); // nearly no slip
  ContactState loaded;
  law->update(law->initial_state(), vector(2e-5, 1e-5), 5., 1., loaded);
  // Slow u lets the traction stay almost zero; set a definite state instead.
  loaded.traction        = vector(0.2, 0.1);
  loaded.normal_traction = 5.;
  loaded.strength        = 0.115 * 5.;
  loaded.loading_ratio   = loaded.normal_ratio =
    loaded.traction.norm() / loaded.strength;

  const Tensor<1, 2> slip     = vector(-2.6e-5, 1e-5);
  const double       pressure = 4.;
  double             smallest = 1e300;
  for (unsigned int i = 0; i <= 100000; ++i)
    {
      const double s = i / 100000.;
      smallest =
        std::min(smallest,
                 (loaded.traction + s * 1e4 * slip).norm() /
                   (0.115 * (loaded.normal_traction +
                             s * (pressure - loaded.normal_traction))));
    }
  ContactState end;
  law->update(loaded, slip, pressure, 1., end);
  // u is so small that r_s hardly leaves the smallest ratio.
  EXPECT_NEAR(end.normal_ratio, smallest, 1e-6);
}



TEST(Law, order_of_effects_changes_nothing)
{
  const auto a =
    make_law({{"Effects", "subloading, overstress, softening, healing"},
              {"healing/Rate", "1e-3"}});
  const auto b =
    make_law({{"Effects", "healing, softening, overstress, subloading"},
              {"healing/Rate", "1e-3"}});
  ContactState p = a->initial_state(), q = b->initial_state();
  for (unsigned int step = 0; step < 100; ++step)
    {
      const Tensor<1, 2> slip = vector(1e-3 * std::sin(step), 5e-4);
      ContactState       p_end, q_end;
      const auto         first  = a->update(p, slip, 5.8, 0.1, p_end);
      const auto         second = b->update(q, slip, 5.8, 0.1, q_end);
      ASSERT_EQ(first.traction, second.traction);
      ASSERT_EQ(first.d_slip, second.d_slip);
      ASSERT_EQ(p_end.coefficient, q_end.coefficient);
      p = p_end;
      q = q_end;
    }
}



TEST(Law, backward_euler_is_of_first_order_in_time)
{
  // The rate-dependent transition at 50 mm/min, halved steps against a fine
  // one.
  const auto law    = make_law({{"Effects", paper}});
  const auto result = [&](const unsigned int n_steps) {
    ContactState state = law->initial_state();
    for (unsigned int step = 0; step < n_steps; ++step)
      {
        ContactState end;
        law->update(state,
                    vector(2e-3 / n_steps),
                    5.8,
                    2e-3 / (50. / 60.) / n_steps,
                    end);
        state = end;
      }
    return state.traction[0];
  };
  const double exact  = 2. * result(64000) - result(32000);
  const double coarse = std::abs(result(100) - exact);
  const double fine   = std::abs(result(200) - exact);
  EXPECT_NEAR(std::log2(coarse / fine), 1., 0.1);
}
