// SPDX-License-Identifier: LGPL-2.1-or-later

// What every effect of the catalogue has to keep, whoever wrote it: an effect
// that registers is tested.

#include "law_test_tools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

using namespace SlipStep;
using namespace SlipStep::Testing;
using dealii::Tensor;

namespace
{
  std::vector<std::string> catalogue()
  {
    std::vector<std::string> names;
    for (const auto &entry : effect_registry())
      names.push_back(entry.first);
    return names;
  }

  const EffectInfo &info_of(const std::string &name)
  {
    return effect_registry().at(name);
  }

  // An effect with its own settings beside others.
  Settings settings_of(const std::string    &name,
                       const EffectSettings &values,
                       std::string           others)
  {
    const bool is_listed = others.find(name) != std::string::npos;
    Settings   settings  = {
         {"Effects", is_listed ? others : others + ", " + name}};
    for (const auto &value : values)
      settings.push_back({name + "/" + value.first, value.second});
    return settings;
  }

  // A smooth law that leaves the slots of the effect free.
  std::string companions(const std::string &name)
  {
    const ExclusiveSlot slot   = info_of(name).slot;
    std::string         others = "softening";
    if (slot != ExclusiveSlot::overstress)
      others += ", overstress";
    if (slot != ExclusiveSlot::normal_ratio)
      others += ", subloading";
    return others;
  }

  struct Motion
  {
    Tensor<1, 2> slip;
    double       pressure;
    double       time;
  };

  // There, across and back under changing pressure, with a rest.
  Motion path_at(const double time)
  {
    const double s = std::min(time, 0.5) + std::max(time - 0.7, 0.);
    return {vector(0.02 * std::sin(4. * s), 0.01 * (1. - std::cos(3. * s))),
            4. + 2. * std::sin(5. * time),
            time};
  }

  struct Result
  {
    ContactState state;
    double       balance = 0.; // work - stored - dissipated
  };

  Result travel(const FrictionLaw &law,
                const unsigned int n_steps,
                const double       end_time = 1.)
  {
    Result result;
    result.state = law.initial_state();
    double work  = 0.;
    for (unsigned int i = 0; i < n_steps; ++i)
      {
        const Motion from = path_at(end_time * i / n_steps);
        const Motion to   = path_at(end_time * (i + 1) / n_steps);
        ContactState end;
        law.update(result.state,
                   to.slip - from.slip,
                   to.pressure,
                   to.time - from.time,
                   end);
        EXPECT_GE(end.dissipation, result.state.dissipation);
        work +=
          0.5 * (result.state.traction + end.traction) * (to.slip - from.slip);
        result.state = end;
      }
    result.balance =
      work - law.stored_energy(result.state) - result.state.dissipation;
    return result;
  }

  class EveryEffect : public ::testing::TestWithParam<std::string>
  {
  protected:
    const EffectInfo &info = info_of(GetParam());

    std::unique_ptr<FrictionLaw> typical_law() const
    {
      return make_law(
        settings_of(info.name, info.typical_settings, companions(info.name)));
    }
  };
} // namespace

INSTANTIATE_TEST_SUITE_P(Effect,
                         EveryEffect,
                         ::testing::ValuesIn(catalogue()),
                         [](const auto &info) { return info.param; });



TEST_P(EveryEffect, is_described)
{
  for (const std::string &text :
       {info.name, info.formula, info.source, info.neutral})
    EXPECT_FALSE(text.empty());
  Parameters parameters;
  FrictionLaw::declare_parameters(parameters);
  for (const std::string &path :
       parameters.paths("Friction/" + info.name + "/"))
    EXPECT_GT(parameters.entry(path).documentation.size(), 20u) << path;
}



TEST_P(EveryEffect, is_neutral_where_it_says_so)
{
  if (info.neutral_settings.empty())
    GTEST_SKIP() << "It is never neutral.";
  const std::string others = companions(info.name);
  const auto        with =
    make_law(settings_of(info.name, info.neutral_settings, others));
  // Softening is among the companions.
  std::string without_it = others;
  if (others.find(info.name + ", ") == 0)
    without_it = others.substr(info.name.size() + 2);
  const auto without = make_law({{"Effects", without_it}});

  const ContactState a = travel(*with, 300).state;
  const ContactState b = travel(*without, 300).state;
  EXPECT_NEAR((a.traction - b.traction).norm(), 0., 1e-6 * b.strength);
  EXPECT_NEAR(a.slip_path, b.slip_path, 1e-6 * b.slip_path);
}



TEST_P(EveryEffect, tells_the_derivatives_of_its_strength)
{
  const auto law = typical_law();
  Parameters parameters;
  FrictionLaw::declare_parameters(parameters);
  for (const auto &setting :
       settings_of(info.name, info.typical_settings, companions(info.name)))
    parameters.set("Friction/" + setting.first, setting.second, "test");
  const auto effect   = info.create(info.section_of(parameters), {0.1, 1.});
  const auto strength = dynamic_cast<const StrengthEffect *>(effect.get());
  if (strength == nullptr)
    GTEST_SKIP() << "It leaves the strength alone.";

  ContactState start = travel(*law, 20, 0.4).state;
  for (const ContactMemory &memory : contact_memories())
    start[memory] = std::min(2., 0.5 * memory.greatest);
  start[contact_memory("temperature_rise_degC")] = 3.;
  const double angle                             = 0.8;
  // slip, normal traction, angle, rate, coefficient, work, path
  using Arguments              = std::array<double, 7>;
  const Arguments base         = {{3e-3, 5., angle, 0.4, 0.1, 2e-2, 4e-3}};
  const auto      strengths_at = [&](const Arguments &x) {
    // The rate is varied by the time step, so time enters as such: it belongs
    // to the rate only where the effect says that it depends on it.
    const SlipStepData step{start,
                            x[0] / x[3],
                            x[1],
                            x[0],
                            vector(std::cos(x[2]), std::sin(x[2])),
                            x[4],
                            x[5],
                            x[6]};
    return std::array<Strength, 2>{
      {strength->strength_factor(step), strength->additive_strength(step)}};
  };
  for (unsigned int kind = 0; kind < 2; ++kind)
    {
      const Strength     s       = strengths_at(base)[kind];
      const Tensor<1, 2> forward = vector(std::cos(angle), std::sin(angle));
      const Tensor<1, 2> turn    = vector(-std::sin(angle), std::cos(angle));
      const Arguments    stated  = {
            {s.d_slip + s.d_rate / (base[0] / base[3]),
             s.d_normal,
             s.d_direction * turn + base[6] * (s.d_way * turn),
             0.,
             s.d_coefficient,
             s.d_work,
             s.d_path + s.d_way * forward}};
      for (const unsigned int i : {0, 1, 2, 4, 5, 6})
        {
          const double h  = 1e-3 * base[i];
          const auto   at = [&](const double t) {
            Arguments x = base;
            x[i] += t * h;
            // With the time step kept.
            if (i == 0)
              x[3] = base[3] * x[0] / base[0];
            return strengths_at(x)[kind].value;
          };
          const double difference =
            (8. * (at(1.) - at(-1.)) - (at(2.) - at(-2.))) / (12. * h);
          EXPECT_NEAR(difference * base[i],
                      stated[i] * base[i],
                      1e-7 * (1. + std::abs(s.value)))
            << "derivative " << i;
        }
    }
}



TEST_P(EveryEffect, tangent_matches_finite_differences)
{
  const auto         law        = typical_law();
  ContactState       state      = law->initial_state();
  const double       alpha_t    = law->tangential_stiffness();
  const unsigned int n_steps    = 60;
  unsigned int       n_compared = 0;
  for (unsigned int i = 0; i < n_steps; ++i)
    {
      const Motion       from = path_at(1. * i / n_steps);
      const Motion       to   = path_at((i + 1.) / n_steps);
      const Tensor<1, 2> slip = to.slip - from.slip;
      const double       f_n = to.pressure, dt = 1. / n_steps;
      ContactState       end;
      const auto         at = [&](const Tensor<1, 2> &du, const double df_n) {
        return law->update(state, slip + du, f_n + df_n, dt, end).traction;
      };
      const ContactResponse response = law->update(state, slip, f_n, dt, end);
      const ContactState    next     = end;
      for (unsigned int c = 0; c < 3; ++c)
        {
          const double length     = std::max(slip.norm(), 1e-6);
          const auto   difference = [&](const double h) {
            const auto along = [&](const double t) {
              return c == 2 ? at(vector(0.), t * h * f_n) :
                                at(t * h * length *
                                   (c == 0 ? vector(1.) : vector(0., 1.)),
                                 0.);
            };
            return (8. * (along(1.) - along(-1.)) - (along(2.) - along(-2.))) /
                   (12. * h * (c == 2 ? f_n : alpha_t * length));
          };
          const Tensor<1, 2> fd = difference(2e-4);
          // Next to a kink there is no derivative.
          if ((fd - difference(1e-4)).norm() > 2e-8)
            continue;
          ++n_compared;
          for (unsigned int d = 0; d < 2; ++d)
            EXPECT_NEAR(c == 2 ? response.d_normal[d] :
                                 response.d_slip[d][c] / alpha_t,
                        fd[d],
                        1e-7)
              << "step " << i;
        }
      state = next;
    }
  EXPECT_GT(n_compared, 5 * 3 * n_steps / 6);
}



TEST_P(EveryEffect, balances_energy_and_is_of_first_order_in_time)
{
  const auto   law    = typical_law();
  const Result coarse = travel(*law, 1500), fine = travel(*law, 3000);
  const double work = fine.state.dissipation;
  EXPECT_LT(std::abs(fine.balance), 0.02 * work);
  EXPECT_NEAR(std::log2(coarse.balance / fine.balance), 1., 0.25);

  const Result finer = travel(*law, 24000), finest = travel(*law, 48000);
  const auto   error = [&](const Result &result) {
    const Tensor<1, 2> exact =
      2. * finest.state.traction - finer.state.traction;
    return (result.state.traction - exact).norm();
  };
  EXPECT_NEAR(std::log2(error(coarse) / error(fine)), 1., 0.25);
}



TEST_P(EveryEffect, is_repeatable)
{
  const auto   law = typical_law();
  ContactPoint point(*law);
  point.update(*law, vector(1e-3, 2e-4), 5.8, 0.1);
  point.commit();
  const ContactResponse first = point.update(*law, vector(2e-3), 6., 0.1);
  const ContactState    state = point.trial();
  point.update(*law, vector(-5., 3.), 0.1, 7.);
  point.update(*law, vector(-5., 3.), -0.1, 7.);
  const ContactResponse second = point.update(*law, vector(2e-3), 6., 0.1);
  EXPECT_EQ(first.traction, second.traction);
  EXPECT_EQ(first.d_slip, second.d_slip);
  EXPECT_EQ(point.trial().dissipation, state.dissipation);
  for (const ContactMemory &memory : contact_memories())
    EXPECT_EQ(point.trial()[memory], state[memory]);
}



// Otherwise it would be missing in the files of results.
TEST_P(EveryEffect, names_what_it_remembers)
{
  const auto   law = typical_law();
  ContactPoint point(*law);
  const auto   used = law->memories();
  for (const double slip : {2e-3, 3e-3, -1e-2})
    {
      point.update(*law, vector(slip, slip / 3.), 5.8, 0.1);
      point.commit();
    }
  for (const ContactMemory &memory : contact_memories())
    EXPECT_EQ(point.committed()[memory] != memory.initial,
              std::any_of(used.begin(),
                          used.end(),
                          [&](const ContactMemory &other) {
                            return other.slot == memory.slot;
                          }))
      << memory.name;
}



TEST_P(EveryEffect, does_not_care_for_the_order_of_the_list)
{
  std::vector<std::string> names = {
    "softening", "overstress", "subloading", "anisotropy", "viscous"};
  if (info.slot == ExclusiveSlot::overstress)
    names[1] = "healing";
  if (std::find(names.begin(), names.end(), info.name) == names.end())
    names.push_back(info.name);
  const auto law = [&] {
    std::string list;
    for (const std::string &name : names)
      list += (list.empty() ? "" : ", ") + name;
    return make_law(settings_of(info.name, info.typical_settings, list));
  };
  const ContactState a = travel(*law(), 100).state;
  std::reverse(names.begin(), names.end());
  const ContactState b = travel(*law(), 100).state;
  EXPECT_EQ(a.traction, b.traction);
  EXPECT_EQ(a.strength, b.strength);
}



namespace
{
  // Steady sliding along the first axis.
  struct Steady
  {
    double speed = 0.5, pressure = 4., mu = 0.1;
    double ratio = 1.; // r at the speed

    double expected(const std::string &name) const
    {
      const double f = ratio * pressure * mu;
      if (name == "pressure")
        return f * std::pow(pressure / 3., -0.3);
      if (name == "shear_cap")
        return ratio * 0.7 * std::tanh(pressure * mu / 0.7);
      if (name == "adhesion")
        return f + ratio * 0.05 * pressure;
      if (name == "viscous")
        return f + ratio * 0.2 * speed * std::pow(1. + speed / 0.1, -0.4);
      if (name == "resonance")
        return f * (1. + 0.3 / (1. + std::pow(1.5 * (speed / 0.2 - 0.2 / speed),
                                              2)));
      if (name == "run_in")
        return f * 0.6;
      if (name == "damage")
        return f * 1.3;
      if (name == "run_order")
        return f * (1. + 0.3 * 10. / 19.);
      if (name == "direction")
        return f * (1. + 0.25 * (1. - std::cos(dealii::numbers::PI / 9.)));
      if (name == "stribeck")
        return f * (1. + 0.1 * std::exp(-std::pow(speed / 2., 1.5)));
      if (name == "expression")
        return f * (1. + 0.3 * std::tanh(0.002 / speed / 5.));
      if (name == "ageing")
        return f * (1. + 0.1 * std::log1p(0.02 / speed / 0.05));
      if (name == "slip_law")
        return f * (1. + 0.1 * std::log1p(0.02 / speed / 0.05));
      if (name == "memory_length")
        return f * (1. + 0.3 * std::log1p(speed / 0.1));
      if (name == "heating")
        {
          // t (1 + b t) = f, since T = h t_c t lambda.
          const double b = 0.02 * 50. * 2. * speed;
          return (std::sqrt(1. + 4. * b * f) - 1.) / (2. * b);
        }
      if (name == "softening")
        return ratio * pressure * 0.098;
      if (name == "healing" || name == "overstress" || name == "perzyna" ||
          name == "subloading" || name == "pressure_memory" ||
          name == "elastic_core")
        return f;
      return -1.;
    }
  };
} // namespace



TEST_P(EveryEffect, has_its_closed_form_in_steady_sliding)
{
  Steady steady;
  if (steady.expected(info.name) < 0.)
    GTEST_SKIP() << "None, or tested on its own.";
  if (info.name == "softening")
    steady.mu = 0.115;
  Settings settings = settings_of(info.name,
                                  info.typical_settings,
                                  info.slot == ExclusiveSlot::overstress ?
                                    "subloading" :
                                  info.slot == ExclusiveSlot::elastic_core ?
                                    "subloading, overstress" :
                                    "overstress");
  settings.push_back({"Static coefficient", std::to_string(steady.mu)});
  const auto law = make_law(settings);
  steady.ratio   = law->steady_ratio(steady.speed);

  ContactState state = law->initial_state();
  for (unsigned int i = 0; i < 2000; ++i)
    {
      ContactState end;
      law->update(state, vector(0.05), steady.pressure, 0.1, end);
      state = end;
    }
  EXPECT_NEAR(state.slip_rate, steady.speed, 1e-8);
  EXPECT_NEAR(state.traction[0] / steady.expected(info.name), 1., 1e-7);
}
