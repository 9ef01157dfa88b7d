// SPDX-License-Identifier: LGPL-2.1-or-later

// The same physics once more in other formulas, by which no formula of the
// catalogue was chosen: what completes a formula has to do for these.

#include <slipstep/synthetic_tests/hidden_effects.h>

#include <algorithm>

namespace SlipStep
{
  namespace Planting
  {
    // Named as those of the catalogue.
    namespace Third
    {
      using Truth = std::vector<TruthParameter>;

      // r_s + A ln(1 + lambda/V_0)
      static Truth
      overstress(TrueContact &contact, const double a, Random &random)
      {
        FlowRule &flow  = contact.flow;
        flow.formula    = Formula::third;
        flow.base_speed = log_uniform(random, 0.01, 1.);
        flow.exponent   = std::log1p(Reach::largest_speed / flow.base_speed) /
                        std::max(a, 1e-5);
        return {{"A", 1. / flow.exponent, ""},
                {"V_0", flow.base_speed, "mm/s"}};
      }



      // As the logarithm of the time at rest, from the first second on.
      static Truth healing(TrueContact &contact, const double a, Random &random)
      {
        const double t_0    = log_uniform(random, 1., 10.);
        const double length = log_uniform(random, 0.02, 0.5);
        const double c =
          std::max(a, 1e-12) / std::log1p(Reach::long_rest / t_0);
        contact.influences.push_back(
          {[](const Instant &, const double growth) {
             return 1. + std::max(growth, 0.);
           },
           {},
           [=](const Instant &now, const double growth) {
             return c / t_0 * std::exp(-std::max(growth, 0.) / c) -
                    now.slip_rate * growth / length;
           },
           {}});
        return {{"c", c, ""}, {"t_0", t_0, "s"}, {"L", length, "mm"}};
      }



      // A pressure from which on asperities touch each other.
      static Truth
      pressure(TrueContact &contact, const double a, Random &random)
      {
        const double p_0 = Reach::reference_pressure;
        const double p_c = log_uniform(random, 2., 15.);
        const double m =
          a / std::log((p_c + Reach::largest_pressure) / (p_c + p_0));
        contact.influences.push_back(
          {[=](const Instant &now, double) {
             return std::pow((p_c + now.pressure) / (p_c + p_0), -m);
           },
           {},
           {},
           {}});
        return {{"m", m, ""}, {"p_c", p_c, "MPa"}};
      }



      // 1/(p mu) and 1/tau_c add up.
      static Truth shear_cap(TrueContact &contact, const double a, Random &)
      {
        const double limit = Reach::largest_pressure *
                             contact.coefficient.static_coefficient /
                             std::max(a, 1e-12);
        contact.influences.push_back(
          {[=](const Instant &now, double) {
             return 1. / (1. + now.pressure * now.coefficient / limit);
           },
           {},
           {},
           {}});
        return {{"tau_c", limit, "MPa"}};
      }



      // Exponential in the temperature.
      static Truth heating(TrueContact &contact, const double a, Random &random)
      {
        const double t_c   = log_uniform(random, 3., 20.);
        const double power = Reach::reference_pressure *
                             contact.coefficient.kinetic_coefficient *
                             Reach::largest_speed;
        contact.influences.push_back(
          {[=](const Instant &, const double temperature) {
             return std::exp(-a * temperature);
           },
           {},
           [=](const Instant &now, const double temperature) {
             return (now.traction * now.slip_rate / power - temperature) / t_c;
           },
           {}});
        return {{"beta T_1", a, ""},
                {"t_c", t_c, "s"},
                {"power at T_1", power, "MPa mm/s"}};
      }



      static Truth run_in(TrueContact &contact, const double a, Random &random)
      {
        const double w      = either_sign(random) * a;
        const double length = log_uniform(random, 8., 40.);
        contact.influences.push_back({[=](const Instant &now, double) {
                                        return 1. +
                                               w * std::tanh(now.path / length);
                                      },
                                      {},
                                      {},
                                      {}});
        return {{"w", w, ""}, {"D_w", length, "mm"}};
      }



      // A share on strokes that go back, whatever their angle.
      static Truth
      direction(TrueContact &contact, const double a, Random &random)
      {
        const double d = either_sign(random) * a;
        contact.influences.push_back(
          {[=](const Instant &now, double) {
             return 1. + d * (1. - std::tanh(20. * now.direction[0])) / 2.;
           },
           {},
           {},
           {}});
        return {{"d", d, ""}};
      }



      // 1/(1 + x)^2 is steepest over ln(x) at x = 1/2, where it falls by 8/27.
      static Truth
      stribeck(TrueContact &contact, const double a, Random &random)
      {
        const double speed = log_uniform(random, 0.05, 1.);
        const double s     = std::min(a, largest_weakening(contact) * 27. / 8.);
        contact.influences.push_back(
          {[=](const Instant &now, double) {
             return 1. + s / std::pow(1. + now.slip_rate / speed, 2);
           },
           {},
           {},
           {},
           true});
        return {{"s", s, ""}, {"V_s", speed, "mm/s"}};
      }



      // A film that grows with speed.
      static Truth viscous(TrueContact &contact, const double a, Random &)
      {
        const double drag = a * Reach::reference_pressure *
                            contact.coefficient.kinetic_coefficient /
                            std::sqrt(Reach::largest_speed);
        contact.influences.push_back({{},
                                      [=](const Instant &now, double) {
                                        return drag * std::sqrt(now.slip_rate);
                                      },
                                      {},
                                      {},
                                      true});
        return {{"c_v", drag, "MPa (s/mm)^0.5"}};
      }
    } // namespace Third



    std::vector<HiddenEffectKind> third_formulas()
    {
      return {
        {"overstress", "r = r_s + A ln(1 + lambda / V_0)", &Third::overstress},
        {"healing",
         "G = 1 + g, dg/dt = c/t_0 exp(-g/c) - lambda g/L",
         &Third::healing},
        {"pressure", "G = ((p_c + p) / (p_c + p_0))^-m", &Third::pressure},
        {"shear_cap", "p mu -> p mu / (1 + p mu / tau_c)", &Third::shear_cap},
        {"heating",
         "G = exp(-beta T), dT/dt = h |f_t| lambda - T/t_c",
         &Third::heating},
        {"run_in", "G = 1 + w tanh(D / D_w)", &Third::run_in},
        {"direction",
         "G = 1 + d (1 - tanh(20 cos(phi))) / 2",
         &Third::direction},
        {"stribeck", "G = 1 + s / (1 + lambda / V_s)^2", &Third::stribeck},
        {"viscous", "tau_y = ... + c_v lambda^0.5", &Third::viscous}};
    }
  } // namespace Planting
} // namespace SlipStep
