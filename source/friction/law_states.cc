// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/law.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace SlipStep
{
  using dealii::Tensor;

  // What a law tells of itself and of the states that it admits.

  ContactState FrictionLaw::initial_state() const
  {
    ContactState state;
    state.coefficient  = initial_coefficient;
    state.normal_ratio = normal_ratio->virgin_normal_ratio();
    for (const ContactMemory &memory : contact_memories())
      state[memory] = memory.initial;
    for (const StrengthEffect *effect : strength_effects)
      effect->begin(state);
    return state;
  }



  void FrictionLaw::complete(ContactState &state) const
  {
    if (state.normal_traction <= 0.)
      {
        state.traction        = Tensor<1, 2>();
        state.normal_traction = state.strength = 0.;
        state.loading_ratio = state.slip_rate = 0.;
        state.normal_ratio = normal_ratio->virgin_normal_ratio();
        core->remember_core({{}, std::min(core->core(state).energy, 0.)},
                            state);
        return;
      }
    if (has_core())
      return complete_with_core(state);
    state.loading_ratio =
      (state.strength > 0. ?
         isotropic_traction(state.traction).norm() / state.strength :
         0.);
    if (normal_ratio == &neutral)
      state.normal_ratio = 1.;
    else
      {
        const double largest = std::min(state.loading_ratio, 1.);
        state.normal_ratio =
          (flow == &neutral ?
             largest :
             std::min(std::max(state.normal_ratio, 0.), largest));
      }
  }



  // Slip and time each drive mu towards the value where their rate vanishes;
  // rates fall with mu.
  std::array<double, 2> FrictionLaw::find_coefficient_range() const
  {
    std::array<double, 2> range  = {{initial_coefficient, initial_coefficient}};
    const auto            extend = [&range](const auto &rate_at) {
      double lower = 0., upper = 1e3;
      if (rate_at(lower) == 0. && rate_at(upper) == 0.)
        return;
      for (unsigned int bisection = 0; bisection < 200; ++bisection)
        {
          const double middle = (lower + upper) / 2.;
          (rate_at(middle) > 0. ? lower : upper) = middle;
        }
      range[0] = std::min(range[0], lower);
      range[1] = std::max(range[1], upper);
    };
    extend(
      [&](const double mu) { return coefficient_rate_per_slip(mu).value; });
    extend(
      [&](const double mu) { return coefficient_rate_per_time(mu).value; });
    return range;
  }



  // The new speed takes a slip that is short for speed and long for memories
  // to act; both are tried.
  std::vector<std::string>
  FrictionLaw::weakening_effects(const ContactState &steady) const
  {
    const auto weakens = [&](const StrengthEffect &effect, const double slip) {
      const auto strength = [&](const double speed) {
        const SlipStepData step = step_data(steady, steady, slip, slip / speed);
        return effect.strength_factor(step).value +
               effect.additive_strength(step).value;
      };
      const double present = strength(steady.slip_rate);
      return strength(1.01 * steady.slip_rate) < present - 1e-9 * present;
    };
    std::vector<std::string> result;
    for (std::size_t i = 0; i < active.size(); ++i)
      {
        const auto *evolution =
          dynamic_cast<const CoefficientEffect *>(active[i].get());
        const auto *strength =
          dynamic_cast<const StrengthEffect *>(active[i].get());
        if ((evolution != nullptr &&
             evolution->coefficient_rate_per_slip(steady.coefficient).value <
               0.) ||
            (strength != nullptr &&
             (weakens(*strength, 1e-12) || weakens(*strength, 1e12))))
          result.push_back(names[i]);
      }
    return result;
  }
} // namespace SlipStep
