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
        return;
      }
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
    const Tensor<1, 2> traction  = isotropic_traction(steady.traction);
    const Tensor<1, 2> direction = traction / traction.norm();
    const auto         after     = [&](const double speed, const double slip) {
      return SlipStepData{steady,
                          slip / speed,
                          steady.normal_traction,
                          slip,
                          is_anisotropic ? slip_direction(direction) :
                                                       direction,
                          steady.coefficient,
                          traction.norm() * slip};
    };
    std::vector<std::string> result;
    for (unsigned int i = 0; i < strength_effects.size(); ++i)
      for (const double slip : {1e-12, 1e12})
        {
          const auto strength = [&](const double speed) {
            const SlipStepData step = after(speed, slip);
            return strength_effects[i]->strength_factor(step).value +
                   strength_effects[i]->additive_strength(step).value;
          };
          const double present = strength(steady.slip_rate);
          if (strength(1.01 * steady.slip_rate) < present - 1e-9 * present)
            {
              result.push_back(strength_names[i]);
              break;
            }
        }
    if (coefficient_rate_per_slip(steady.coefficient).value < 0.)
      result.push_back("softening");
    return result;
  }
} // namespace SlipStep
