// SPDX-License-Identifier: LGPL-2.1-or-later

// The same physics as the catalogue's in other formulas: only to be planted,
// never fitted, so that they show what a slightly wrong formula does.

#include <slipstep/synthetic_tests/hidden_effects.h>

#include <algorithm>

namespace SlipStep
{
  namespace Planting
  {
    namespace
    {
      // Heat by its factor G(a, T) and its cooling. T is over that of fast
      // sliding for long.
      HiddenEffectKind heating(const std::string &formula,
                               const std::function<double(double, double)> &G,
                               const OfNumber &cooling)
      {
        return {"heating",
                formula,
                [=](TrueContact &contact, const double a, Random &random) {
                  const double t_c = log_uniform(random, 3., 20.);
                  const double power =
                    usual_friction(contact) * Reach::largest_speed;
                  contact.remember(
                    [=](const Instant &now, const double temperature) {
                      return (now.traction * now.slip_rate / power -
                              cooling(temperature)) /
                             t_c;
                    },
                    [=](const Instant &, const double temperature) {
                      return G(a, temperature);
                    });
                  return Truth{{"beta T_1", a, ""},
                               {"t_c", t_c, "s"},
                               {"power at T_1", power, "MPa mm/s"}};
                }};
      }



      // Running in by its factor G(w, D, D_w).
      HiddenEffectKind
      run_in(const std::string                                   &formula,
             const std::function<double(double, double, double)> &G)
      {
        return {"run_in",
                formula,
                [=](TrueContact &contact, const double a, Random &random) {
                  const double w      = either_sign(random) * a;
                  const double length = log_uniform(random, 8., 40.);
                  contact.multiply(
                    [=](const Instant &now) { return G(w, now.path, length); });
                  return Truth{{"w", w, ""}, {"D_w", length, "mm"}};
                }};
      }
    } // namespace



    const std::vector<HiddenEffectKind> other_formulas = {
      {"overstress",
       "r = r_s + A asinh(lambda / V_0)",
       // From slow to fast by the amplitude.
       [](TrueContact &contact, const double a, Random &random) -> Truth {
         FlowRule &flow  = contact.flow;
         flow.formula    = Formula::alternative;
         flow.base_speed = log_uniform(random, 0.005, 0.1);
         flow.exponent   = std::asinh(Reach::largest_speed / flow.base_speed) /
                         std::max(a, 1e-5);
         return {{"A", 1. / flow.exponent, ""},
                 {"V_0", flow.base_speed, "mm/s"}};
       }},

      {"softening",
       "d mu/d lambda = -(mu - mu_k)^2 / (L (mu_s - mu_k))",
       [](TrueContact &contact, const double a, Random &random) -> Truth {
         CoefficientRule &rule    = contact.coefficient;
         rule.softening           = Formula::alternative;
         rule.kinetic_coefficient = rule.static_coefficient / (1. + a);
         rule.length              = log_uniform(random, 0.5, 3.);
         return {{"mu_k", rule.kinetic_coefficient, ""},
                 {"L", rule.length, "mm"}};
       }},

      {"healing",
       "G = 1 + g, dg/dt = c/(5 t_0) (1 + g/c)^-4 - lambda g/L",
       // Asperities spread by creep with a power of the stress, which falls as
       // they spread: at rest as the fifth root of time; Brechet and Estrin
       // (1994), Scr. Metall. Mater. 30, 1449. What was won is lost in
       // proportion to slip.
       [](TrueContact &contact, const double a, Random &random) -> Truth {
         const double t_0    = log_uniform(random, 1., 10.);
         const double length = log_uniform(random, 0.02, 0.5);
         const double c      = std::max(a, 1e-12) /
                          (std::pow(1. + Reach::long_rest / t_0, 0.2) - 1.);
         contact.remember(
           [=](const Instant &now, const double growth) {
             return c / (5. * t_0) *
                      std::pow(1. + std::max(growth, 0.) / c, -4.) -
                    now.slip_rate * growth / length;
           },
           [](const Instant &, const double growth) {
             return 1. + std::max(growth, 0.);
           });
         return {{"c", c, ""}, {"t_0", t_0, "s"}, {"L", length, "mm"}};
       }},

      {"pressure",
       "G = 1 - m ln(p / p_0)",
       [](TrueContact &contact, const double a, Random &) -> Truth {
         const double p_0 = Reach::reference_pressure;
         const double m   = a / std::log(Reach::largest_pressure / p_0);
         contact.multiply([=](const Instant &now) {
           return 1. - m * std::log(now.pressure / p_0);
         });
         return {{"m", m, ""}, {"p_0", p_0, "MPa"}};
       }},

      {"shear_cap",
       "p mu -> p mu / sqrt(1 + (p mu / tau_c)^2)",
       // 1/sqrt(1 + x^2) is about 1 - x^2/2.
       [](TrueContact &contact, const double a, Random &) -> Truth {
         const double limit = Reach::largest_pressure *
                              contact.coefficient.static_coefficient /
                              std::sqrt(2. * std::max(a, 1e-12));
         contact.multiply([=](const Instant &now) {
           return 1. / std::hypot(1., now.pressure * now.coefficient / limit);
         });
         return {{"tau_c", limit, "MPa"}};
       }},

      {"adhesion",
       "tau_y = ... + c (1 - exp(-p / p_1))",
       // Bonds as many as the pressure makes, up to all of them.
       [](TrueContact &contact, const double a, Random &random) -> Truth {
         const double p_1 = uniform(random, 0.3, 1.);
         const double c   = a * Reach::least_pressure *
                          contact.coefficient.kinetic_coefficient /
                          (1. - std::exp(-Reach::least_pressure / p_1));
         contact.add([=](const Instant &now) {
           return c * (1. - std::exp(-now.pressure / p_1));
         });
         return {{"c", c, "MPa"}, {"p_1", p_1, "MPa"}};
       }},

      // Cooling by free convection, with its exponent 5/4.
      heating(
        "G = 1 - beta T, dT/dt = h |f_t| lambda - (T/T_1)^1.25 T_1/t_c",
        [](const double a, const double T) { return 1. - a * T; },
        [](const double T) { return std::pow(std::max(T, 0.), 1.25); }),

      run_in("G = 1 + w D / (D + D_w)",
             [](const double w, const double path, const double length) {
               return 1. + w * path / (path + length);
             }),

      {"anisotropy",
       "G = 1 + d (1 - cos(2 phi)) / 2, slip along the traction",
       [](TrueContact &contact, const double a, Random &random) -> Truth {
         const double d = either_sign(random) * a;
         contact.multiply([=](const Instant &now) {
           const double c = now.direction[0], s = now.direction[1];
           return 1. + d * (1. - (c * c - s * s)) / 2.;
         });
         return {{"d", d, ""}};
       }},

      {"direction",
       "tau_y = ... + c max(-cos(phi), 0)",
       // The same traction more at any pressure, on strokes that go back.
       [](TrueContact &contact, const double a, Random &random) -> Truth {
         const double c = usual_friction(contact, either_sign(random) * a);
         contact.add([=](const Instant &now) {
           return c * std::max(-now.direction[0], 0.);
         });
         return {{"c", c, "MPa"}};
       }},

      {"stribeck",
       "G = 1 + s / (1 + (lambda / V_s)^q)",
       // 1/(1 + x^q) is steepest over ln(x) at x = 1, where it falls by q/4.
       [](TrueContact &contact, const double a, Random &random) -> Truth {
         const double speed = log_uniform(random, 0.05, 1.);
         const double q     = uniform(random, 1., 2.);
         const double s     = std::min(a, largest_weakening(contact) * 4. / q);
         contact.multiply_at_speed([=](const double slip_rate) {
           return 1. + s / (1. + std::pow(slip_rate / speed, q));
         });
         return {{"s", s, ""}, {"V_s", speed, "mm/s"}, {"q", q, ""}};
       }},

      {"viscous",
       "tau_y = ... + c_v lambda^0.8",
       // A film that thins in shear.
       [](TrueContact &contact, const double a, Random &) -> Truth {
         const double drag =
           usual_friction(contact, a) / std::pow(Reach::largest_speed, 0.8);
         contact.add_at_speed([=](const double slip_rate) {
           return drag * std::pow(slip_rate, 0.8);
         });
         return {{"c_v", drag, "MPa (s/mm)^0.8"}};
       }},

      {"compliance",
       "spring that stiffens: k (1 + |f_t| / f_1)",
       // Twice as stiff at a usual traction.
       [](TrueContact &contact, const double a, Random &) -> Truth {
         contact.compliance          = a / 0.3;
         contact.stiffening_traction = usual_friction(contact);
         return {{"k without load",
                  1. / std::max(contact.compliance, 1e-12),
                  "MPa/mm"},
                 {"traction at twice k", contact.stiffening_traction, "MPa"}};
       }}};



    // By these no formula of the catalogue was chosen: what completes a formula
    // has to do for them.
    const std::vector<HiddenEffectKind> third_formulas = {
      {"overstress",
       "r = r_s + A ln(1 + lambda / V_0)",
       [](TrueContact &contact, const double a, Random &random) -> Truth {
         FlowRule &flow  = contact.flow;
         flow.formula    = Formula::third;
         flow.base_speed = log_uniform(random, 0.01, 1.);
         flow.exponent   = std::log1p(Reach::largest_speed / flow.base_speed) /
                         std::max(a, 1e-5);
         return {{"A", 1. / flow.exponent, ""},
                 {"V_0", flow.base_speed, "mm/s"}};
       }},

      {"healing",
       "G = 1 + g, dg/dt = c/t_0 exp(-g/c) - lambda g/L",
       // As the logarithm of the time at rest, from the first second on.
       [](TrueContact &contact, const double a, Random &random) -> Truth {
         const double t_0    = log_uniform(random, 1., 10.);
         const double length = log_uniform(random, 0.02, 0.5);
         const double c =
           std::max(a, 1e-12) / std::log1p(Reach::long_rest / t_0);
         contact.remember(
           [=](const Instant &now, const double growth) {
             return c / t_0 * std::exp(-std::max(growth, 0.) / c) -
                    now.slip_rate * growth / length;
           },
           [](const Instant &, const double growth) {
             return 1. + std::max(growth, 0.);
           });
         return {{"c", c, ""}, {"t_0", t_0, "s"}, {"L", length, "mm"}};
       }},

      {"pressure",
       "G = ((p_c + p) / (p_c + p_0))^-m",
       // A pressure from which on asperities touch each other.
       [](TrueContact &contact, const double a, Random &random) -> Truth {
         const double p_0 = Reach::reference_pressure;
         const double p_c = log_uniform(random, 2., 15.);
         const double m =
           a / std::log((p_c + Reach::largest_pressure) / (p_c + p_0));
         contact.multiply([=](const Instant &now) {
           return std::pow((p_c + now.pressure) / (p_c + p_0), -m);
         });
         return {{"m", m, ""}, {"p_c", p_c, "MPa"}};
       }},

      {"shear_cap",
       "p mu -> p mu / (1 + p mu / tau_c)",
       // 1/(p mu) and 1/tau_c add up.
       [](TrueContact &contact, const double a, Random &) -> Truth {
         const double limit = Reach::largest_pressure *
                              contact.coefficient.static_coefficient /
                              std::max(a, 1e-12);
         contact.multiply([=](const Instant &now) {
           return 1. / (1. + now.pressure * now.coefficient / limit);
         });
         return {{"tau_c", limit, "MPa"}};
       }},

      heating(
        "G = exp(-beta T), dT/dt = h |f_t| lambda - T/t_c",
        [](const double a, const double T) { return std::exp(-a * T); },
        [](const double T) { return T; }),

      run_in("G = 1 + w tanh(D / D_w)",
             [](const double w, const double path, const double length) {
               return 1. + w * std::tanh(path / length);
             }),

      {"direction",
       "G = 1 + d (1 - tanh(20 cos(phi))) / 2",
       // A share on strokes that go back, whatever their angle.
       [](TrueContact &contact, const double a, Random &random) -> Truth {
         const double d = either_sign(random) * a;
         contact.multiply([=](const Instant &now) {
           return 1. + d * (1. - std::tanh(20. * now.direction[0])) / 2.;
         });
         return {{"d", d, ""}};
       }},

      {"stribeck",
       "G = 1 + s / (1 + lambda / V_s)^2",
       // 1/(1 + x)^2 is steepest over ln(x) at x = 1/2, where it falls by 8/27.
       [](TrueContact &contact, const double a, Random &random) -> Truth {
         const double speed = log_uniform(random, 0.05, 1.);
         const double s = std::min(a, largest_weakening(contact) * 27. / 8.);
         contact.multiply_at_speed([=](const double slip_rate) {
           return 1. + s / std::pow(1. + slip_rate / speed, 2);
         });
         return {{"s", s, ""}, {"V_s", speed, "mm/s"}};
       }},

      {"viscous",
       "tau_y = ... + c_v lambda^0.5",
       // A film that grows with speed.
       [](TrueContact &contact, const double a, Random &) -> Truth {
         const double drag =
           usual_friction(contact, a) / std::sqrt(Reach::largest_speed);
         contact.add_at_speed(
           [=](const double slip_rate) { return drag * std::sqrt(slip_rate); });
         return {{"c_v", drag, "MPa (s/mm)^0.5"}};
       }}};
  } // namespace Planting
} // namespace SlipStep
