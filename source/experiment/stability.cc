// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/experiment/stability.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/roots.h>
#include <slipstep/utilities/text.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/lac/full_matrix.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace SlipStep
{
  using dealii::Tensor;

  namespace
  {
    using Complex = std::complex<double>;

    // What a point in steady sliding remembers: two components of the traction,
    // mu, and the memories of the effects. (r_s stays 1, the slip path is
    // beyond all that runs in.)
    constexpr unsigned int n_states = 3 + ContactState::most_memories;

    // Time step of the differences, times the angular frequency.
    constexpr double relative_step = 1e-3;

    double &component(ContactState &state, const unsigned int i)
    {
      if (i < 2)
        return state.traction[i];
      if (i == 2)
        return state.coefficient;
      return state.memories[i - 3];
    }

    std::array<double, n_states> components(ContactState state)
    {
      std::array<double, n_states> result;
      for (unsigned int i = 0; i < n_states; ++i)
        result[i] = component(state, i);
      return result;
    }
  } // namespace



  SteadySliding::SteadySliding(const FrictionLaw  &law,
                               const Tensor<1, 2> &velocity,
                               const double        pressure)
    : law(law)
    , speed(velocity.norm())
    , direction(velocity / speed)
    , pressure(pressure)
    , steady(law.initial_state())
  {
    Assert(speed > 0. && pressure > 0.,
           dealii::ExcMessage("Nothing slides here."));
    // Implicit steps may be as long as one likes: the last are longer than
    // anything that the law remembers.
    const double first_slip =
      pressure * law.static_coefficient() / law.tangential_stiffness();
    std::array<double, n_states> before = components(steady);
    for (double slip = first_slip; slip < 1e15 * first_slip; slip *= 2.)
      {
        before = components(steady);
        ContactState end;
        law.update(steady, slip * direction, pressure, slip / speed, end);
        steady = end;
      }
    const std::array<double, n_states> after = components(steady);
    is_steady = std::isfinite(steady.strength) && steady.strength > 0.;
    for (unsigned int i = 0; i < n_states; ++i)
      if (!(std::abs(after[i] - before[i]) <=
            1e-8 * std::max(std::abs(after[i]), i < 2 ? steady.strength : 0.)))
        is_steady = false;
  }



  double SteadySliding::friction() const
  {
    return steady.traction * direction / pressure;
  }



  double SteadySliding::shortest_step() const
  {
    return relative_step * law.static_coefficient() * pressure /
           (10. * law.tangential_stiffness() * speed);
  }



  // As small as keeps the contact slipping.
  double SteadySliding::disturbance(const double time_step) const
  {
    return std::min(1e-4,
                    1e-2 * law.tangential_stiffness() * speed * time_step /
                      steady.strength);
  }



  // Strength that falls with speed faster than the overstress rises, or with
  // slip faster than the contact holds, has no short steps that go on as
  // before: the contact stops or jumps, at once or after any disturbance.
  bool SteadySliding::is_kept() const
  {
    const double time_step = shortest_step();
    const double slip      = speed * time_step;
    const double change    = disturbance(time_step) * slip;
    const auto   traction  = [&](const double increment) {
      ContactState end;
      law.update(steady, increment * direction, pressure, time_step, end);
      return end.traction;
    };
    const auto end = traction(slip);
    return (end - steady.traction).norm() <= 1e-6 * steady.strength &&
           (traction(slip + change) + traction(slip - change) - 2. * end)
               .norm() <= 0.1 * elastic_stiffness() * change;
  }



  dealii::FullMatrix<double>
  SteadySliding::derivatives(const double time_step) const
  {
    const double slip = speed * time_step;
    const auto   step = [&](const ContactState &start, const double increment) {
      ContactState end;
      law.update(start, increment * direction, pressure, time_step, end);
      return components(end);
    };
    const double share = disturbance(time_step);

    dealii::FullMatrix<double> result(n_states, n_states + 1);
    for (unsigned int j = 0; j <= n_states; ++j)
      {
        const bool   is_slip = j == n_states;
        ContactState plus = steady, minus = steady;
        double       change = share * slip;
        if (!is_slip)
          {
            change = share * std::max(std::abs(component(plus, j)),
                                      j < 2 ? steady.strength : 0.);
            component(plus, j) += change;
            component(minus, j) -= change;
          }
        // What nobody remembers stays as it is.
        if (!(change > 0.))
          {
            result(j, j) = 1.;
            continue;
          }
        const auto upper = step(plus, is_slip ? slip + change : slip);
        const auto lower = step(minus, is_slip ? slip - change : slip);
        for (unsigned int i = 0; i < n_states; ++i)
          result(i, j) = (upper[i] - lower[i]) / (2. * change);
      }
    return result;
  }



  // A step of the law maps what it remembers and the slip increment, y_1 =
  // A y_0 + b (u_1 - u_0). With e^{st}, y_0 = (1 - s dt) y_1, for backward
  // Euler's steps at any s.
  Complex SteadySliding::stiffness_by_steps(const double omega,
                                            const double time_step) const
  {
    const dealii::FullMatrix<double> derivative = derivatives(time_step);
    const Complex                    shift(1., -omega * time_step);

    dealii::FullMatrix<Complex> matrix(n_states, n_states);
    for (unsigned int i = 0; i < n_states; ++i)
      for (unsigned int j = 0; j < n_states; ++j)
        matrix(i, j) = (i == j ? 1. : 0.) - derivative(i, j) * shift;
    matrix.gauss_jordan();
    Complex result = 0.;
    for (unsigned int i = 0; i < 2; ++i)
      for (unsigned int j = 0; j < n_states; ++j)
        result +=
          direction[i] * matrix(i, j) * derivative(j, n_states) * (1. - shift);
    return result;
  }



  // Memories that are integrated otherwise are off by O(omega dt), which
  // Richardson's extrapolation takes off: of the compliance, which hardly
  // varies where slip and contact are nearly as stiff.
  Complex SteadySliding::dynamic_stiffness(const double omega) const
  {
    constexpr double largest_phase = 0.1;

    const double  time_step = std::max(relative_step / omega, shortest_step());
    const Complex result    = stiffness_by_steps(omega, time_step);
    return omega * time_step > largest_phase ||
               std::abs(result) < resolution() ?
             result :
             1. /
               (2. / result - 1. / stiffness_by_steps(omega, 2. * time_step));
  }



  // How fast a memory fades while the contact slips on as before, whatever the
  // traction does: coupled ones fade little faster than the fastest alone.
  double SteadySliding::quickest() const
  {
    const double                     time_step  = shortest_step();
    const dealii::FullMatrix<double> derivative = derivatives(time_step);
    const auto                       along      = [&](const unsigned int j) {
      return direction[0] * derivative(0, j) + direction[1] * derivative(1, j);
    };
    const double slip_by_motion = 1. - along(n_states) / elastic_stiffness();
    double       fastest        = 0.;
    for (unsigned int i = 2; i < n_states; ++i)
      {
        const double motion = along(i) / elastic_stiffness() / slip_by_motion;
        const double kept = derivative(i, i) + derivative(i, n_states) * motion;
        fastest = std::max(fastest, std::min(1. - kept, 1.) / time_step);
      }
    return std::max(relative_step / time_step, 100. * fastest);
  }



  Complex SteadySliding::slip_stiffness(const double omega) const
  {
    return 1. / (1. / dynamic_stiffness(omega) - 1. / elastic_stiffness());
  }



  double SteadySliding::elastic_stiffness() const
  {
    return direction * (law.elastic_tangent() * direction);
  }



  double SteadySliding::resolution() const
  {
    return 1e-5 * elastic_stiffness();
  }



  // Round-off of one step's derivatives counts the more, the longer the step is
  // for the frequency.
  double SteadySliding::resolution_at(const double omega) const
  {
    return resolution() * std::max(1., omega * shortest_step());
  }



  // What feeds a disturbance does so in proportion to its speed where friction
  // falls with speed at once, and less and less where that takes a time or a
  // length.
  bool SteadySliding::grows_at_once() const
  {
    if (!is_kept())
      return true;
    const double quickest = this->quickest();
    const double quick    = slip_stiffness(quickest).imag();
    return quick < -resolution_at(quickest) &&
           quick < 2. * slip_stiffness(quickest / 4.).imag();
  }



  // Nothing holds against quick disturbances: springs have to be stiffer than
  // friction falls with slip, and with a mass what falls feeds every swing.
  StabilityLimit
  SteadySliding::limit_without_rate_effect(const double mass) const
  {
    const double quickest = this->quickest();
    // Slow enough to be no round-off.
    const double slow = 1e-2 * relative_step / shortest_step();
    if (slip_stiffness(quickest).real() < -elastic_stiffness())
      return {std::numeric_limits<double>::infinity(), 0.};
    const double quick_fall = -dynamic_stiffness(quickest).real();
    const double fall       = std::max(-dynamic_stiffness(slow).real(),
                                 quick_fall > resolution() ? quick_fall : 0.);
    if (fall <= 1e-4 * resolution())
      return {};
    return {mass > 0. ? std::numeric_limits<double>::infinity() : fall, 0.};
  }



  // Coming from stiff springs, the first frequency at which a disturbance
  // neither grows nor fades sets the limit. A law that feeds quick disturbances
  // the more is stable on no spring. The smaller a rate effect is, the quicker
  // is what it damps.
  StabilityLimit SteadySliding::limit(const double mass) const
  {
    if (grows_at_once())
      return {std::numeric_limits<double>::infinity(), 0.};
    const auto damps = [&](const double omega) {
      return dynamic_stiffness(omega).imag() >= resolution_at(omega);
    };
    const double quickest = this->quickest();
    double       first    = quickest;
    for (; !damps(first); first *= 10.)
      if (first > 1e6 * quickest)
        return limit_without_rate_effect(mass);

    StabilityLimit result;
    double         loss  = dynamic_stiffness(first).imag();
    const double   ratio = std::pow(10., 0.04);
    for (double omega = first; omega > 1e-14 * quickest; omega /= ratio)
      {
        const double next = dynamic_stiffness(omega / ratio).imag();
        if (loss * next < 0.)
          {
            const double critical = root_between(
              [&](const double w) { return dynamic_stiffness(w).imag(); },
              omega / ratio,
              omega,
              30);
            if (slip_stiffness(critical).real() < -elastic_stiffness())
              return {std::numeric_limits<double>::infinity(), 0.};
            const double stiffness =
              mass * critical * critical - dynamic_stiffness(critical).real();
            if (stiffness > result.stiffness)
              result = {stiffness, critical};
          }
        loss = next;
      }
    return result;
  }



  std::vector<Loading> steady_slides(const Programme  &programme,
                                     const std::size_t most)
  {
    const auto is_close = [](const double a, const double b) {
      return std::abs(a - b) <= 1e-9 * std::abs(b);
    };
    std::vector<Loading> result;
    for (const Segment &segment : programme.segments())
      {
        const Loading &now = segment.end;
        if (result.size() < most && now.velocity.norm() > 0. &&
            now.pressure > 0. && none_of(result, [&](const Loading &other) {
              return is_close(other.pressure, now.pressure) &&
                     (other.velocity - now.velocity).norm() <=
                       1e-9 * now.velocity.norm();
            }))
          result.push_back(now);
      }
    return result;
  }



  namespace
  {
    // The slowest and the fastest speed around one at which it is unstable.
    std::array<double, 2> unstable_speeds(const FrictionLaw &law,
                                          const Loading     &slide)
    {
      const double          speed = slide.velocity.norm();
      const double          ratio = std::pow(10., 0.1);
      std::array<double, 2> result{{speed, speed}};
      for (const bool faster : {false, true})
        for (unsigned int n = 1; n <= 60; ++n)
          {
            const double        factor = std::pow(ratio, faster ? n : -1. * n);
            const SteadySliding sliding(law,
                                        factor * slide.velocity,
                                        slide.pressure);
            if (!sliding.exists() || !sliding.grows_at_once())
              break;
            result[faster] = factor * speed;
          }
      return result;
    }
  } // namespace



  std::string why_no_branch(const FrictionLaw         &law,
                            const std::vector<double> &speeds,
                            const double               pressure)
  {
    for (const double speed : speeds)
      {
        const SteadySliding sliding(law, Tensor<1, 2>({speed, 0.}), pressure);
        if (sliding.exists() && sliding.grows_at_once())
          return "sliding at " + rounded_text(speed, 3) +
                 " mm/s has no stable branch: friction falls with speed, and "
                 "the model has no effect, such as overstress, that raises "
                 "friction at once by as much";
      }
    return "";
  }



  namespace
  {
    std::string words_of_instability(const FrictionLaw &law,
                                     const Loading     &slide,
                                     const double       limit,
                                     const Machine     &machine)
    {
      const SteadySliding sliding(law, slide.velocity, slide.pressure);
      const auto          number = [](const double value) {
        return rounded_text(value, 3);
      };
      const std::string begin = "sliding at " + number(slide.velocity.norm()) +
                                " mm/s under " + number(slide.pressure) +
                                " MPa has no stable branch";
      const std::string effects =
        boost::algorithm::join(law.weakening_effects(sliding.state()), ", ");
      const std::string by_which = effects.empty() ? "" : " (" + effects + ")";
      if (sliding.grows_at_once())
        {
          const auto speeds = unstable_speeds(law, slide);
          return begin + ": at least between " + number(speeds[0]) + " and " +
                 number(speeds[1]) + " mm/s, friction falls" + by_which +
                 ", with speed or with slip, by more than the contact's own "
                 "stiffness can balance, so that the contact sticks and jumps "
                 "and the time steps get very short. A memory length (effect "
                 "ageing), a viscosity (viscous, overstress), a stiffer "
                 "contact or other speeds may help";
        }
      if (std::isfinite(limit))
        return begin + ": the machine's stiffness of " +
               number(machine.stiffness()) + " MPa/mm is below the critical " +
               number(limit) +
               ", so that the contact sticks and slips. Sliding is steady on a "
               "stiffer machine";
      if (machine.mass() > 0.)
        return begin + " on a machine with a mass: friction falls" + by_which +
               " and nothing damps the motion, so that every oscillation "
               "grows. A viscosity (viscous, overstress) or a machine without "
               "mass helps";
      return begin + ": friction falls" + by_which +
             " faster than the contact's own tangential stiffness can balance. "
             "A larger tangential stiffness or a gentler fall helps";
    }
  } // namespace



  std::vector<std::string> instability_warnings(const FrictionLaw &law,
                                                const Programme   &programme,
                                                const Machine     &machine)
  {
    // A replayed test has too many.
    constexpr std::size_t most = 20;

    // Of those that nothing holds the one that wants the stiffest machine.
    std::optional<Loading> worst;
    double                 largest = 0.;
    for (const Loading &slide : steady_slides(programme, most))
      {
        const SteadySliding sliding(law, slide.velocity, slide.pressure);
        if (!sliding.exists())
          continue;
        const double limit = sliding.limit(machine.mass()).stiffness;
        const bool   is_held =
          std::isfinite(limit) && (machine.mass() > 0. || machine.is_rigid() ||
                                   machine.stiffness() >= limit);
        if (!is_held && limit > largest)
          {
            worst   = slide;
            largest = limit;
          }
      }
    if (!worst.has_value())
      return {};
    return {words_of_instability(law, *worst, largest, machine)};
  }
} // namespace SlipStep
