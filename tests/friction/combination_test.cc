// SPDX-License-Identifier: LGPL-2.1-or-later

// Effects in random company: nothing fails, and tangents stay exact.

#include "law_test_tools.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>

using namespace SlipStep;
using namespace SlipStep::Testing;
using dealii::Tensor;

namespace
{
  const unsigned int n_laws = 40;

  class Combination : public ::testing::TestWithParam<unsigned int>,
                      protected RandomLoads
  {
  protected:
    Combination()
      : RandomLoads(GetParam())
    {}

    std::unique_ptr<FrictionLaw> law = make_law(settings());

  private:
    // Every second effect, of two for a slot the first that comes.
    Settings settings()
    {
      Settings                      result = {{"Effects", ""}};
      std::map<ExclusiveSlot, bool> is_taken;
      for (const auto &entry : effect_registry())
        {
          const EffectInfo &info = entry.second;
          if (uniform(0., 1.) < 0.5 || is_taken[info.slot])
            continue;
          is_taken[info.slot] = info.slot != ExclusiveSlot::none;
          result[0].second +=
            (result[0].second.empty() ? "" : ", ") + info.name;
          for (const auto &value : info.typical_settings)
            result.push_back({info.name + "/" + value.first, value.second});
        }
      if (is_taken[ExclusiveSlot::elastic_core] &&
          !is_taken[ExclusiveSlot::normal_ratio])
        result[0].second += ", subloading";
      if (result[0].second.find("expression") != std::string::npos)
        vary_expression(result);
      return result;
    }

    void vary_expression(Settings &settings)
    {
      const std::array<std::array<std::string, 4>, 5> formulas = {
        {{{"log10 speed", "1.2 + 0.1 * tanh(x)", "-4", "3"}},
         {{"pressure", "1 - 0.3 * tanh(x / 5)", "0", "30"}},
         {{"path", "1 + 0.5 * exp(-x * 100)", "0", "0.1"}},
         {{"hold time", "1 + 0.3 * tanh(x / 5)", "0", "100"}},
         {{"angle", "1 + 0.2 * cos(x / 180 * pi)", "-180", "180"}}}};
      const auto &formula = formulas[GetParam() % formulas.size()];
      const std::array<std::string, 4> keys = {
        {"Covariate", "Formula", "From", "To"}};
      for (unsigned int i = 0; i < keys.size(); ++i)
        settings.push_back({"expression/" + keys[i], formula[i]});
      if (formula[0] != "hold time")
        settings.push_back({"expression/Renewal length", "0.01"});
    }
  };
} // namespace

INSTANTIATE_TEST_SUITE_P(Law, Combination, ::testing::Range(0u, n_laws));



TEST_P(Combination, random_loading_never_fails)
{
  ContactPoint point(*law);
  for (unsigned int step = 0; step < 1000000 / n_laws; ++step)
    {
      const ContactState last = point.committed();
      const Step         made = make_any_step(*law, point);
      if (made.has_two_stages)
        {
          ASSERT_TRUE(point.error(*law).measure() >= 0.) << "step " << step;
          ASSERT_TRUE(std::isfinite(point.error(*law).measure()));
        }
      point.commit();

      const ContactState &state = point.committed();
      ASSERT_TRUE(is_finite(made.response)) << "step " << step;
      ASSERT_TRUE(made.pressure < 0. || state.strength > 0.) << "step " << step;
      ASSERT_GE(state.loading_ratio, 0.);
      ASSERT_LE(state.loading_ratio, law->maximum_ratio() * (1. + 1e-9))
        << "step " << step;
      ASSERT_GE(state.normal_ratio, 0.);
      ASSERT_LE(state.normal_ratio, 1.);
      ASSERT_GT(state.coefficient, 0.);
      ASSERT_GE(state.slip_path, last.slip_path);
      ASSERT_GE(state.dissipation, last.dissipation);
      for (const ContactMemory &memory : contact_memories())
        ASSERT_TRUE(state[memory] >= memory.least &&
                    state[memory] <= memory.greatest &&
                    std::isfinite(state[memory]))
          << memory.name;
      ASSERT_NEAR(law->isotropic_traction(state.traction).norm(),
                  state.loading_ratio * state.strength,
                  1e-9 * state.strength * state.loading_ratio + 1e-300);
    }
}



TEST_P(Combination, tangent_matches_finite_differences)
{
  unsigned int n_compared = 0;
  ContactPoint point(*law);
  for (unsigned int step = 0; step < 500; ++step)
    {
      const Load            load = begin_plain_step(*law, step % 2 == 1, point);
      const Tensor<1, 2>    slip = load.slip;
      const double          f_n = load.pressure, dt = load.duration;
      const ContactResponse response = point.update(*law, slip, f_n, dt);
      const double length = slip.norm(), alpha_t = law->tangential_stiffness();
      for (unsigned int c = 0; c < 3; ++c)
        {
          const auto at = [&](const double t) {
            const Tensor<1, 2> du =
              c == 2 ? vector(0.) :
                       t * length * (c == 0 ? vector(1.) : vector(0., 1.));
            return point
              .update(*law, slip + du, f_n * (c == 2 ? 1. + t : 1.), dt)
              .traction;
          };
          const double scale      = c == 2 ? f_n : alpha_t * length;
          const auto   difference = [&](const double h) {
            return (8. * (at(h) - at(-h)) - (at(2. * h) - at(-2. * h))) /
                   (12. * h * scale);
          };
          const Tensor<1, 2> fd = difference(2e-4);
          // Next to a kink there is no derivative.
          if (!((fd - difference(1e-4)).norm() < 2e-8))
            continue;
          ++n_compared;
          for (unsigned int d = 0; d < 2; ++d)
            EXPECT_NEAR(c == 2 ? response.d_normal[d] :
                                 response.d_slip[d][c] / alpha_t,
                        fd[d],
                        1e-7)
              << "step " << step << ", derivative " << c;
        }
      point.update(*law, slip, f_n, dt);
      point.commit();
    }
  // Of 1500.
  EXPECT_GT(n_compared, 1000u);
}
