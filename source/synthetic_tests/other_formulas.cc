// SPDX-License-Identifier: LGPL-2.1-or-later

// The same physics as the catalogue's in other formulas: only to be planted,
// never fitted, so that it shows what a slightly wrong formula does.

#include <slipstep/synthetic_tests/hidden_effects.h>

#include <algorithm>

namespace SlipStep
{
  namespace Planting
  {
    // Named as those of the catalogue.
    namespace Alternative
    {
      using Truth = std::vector<TruthParameter>;

      // r_s + A asinh(lambda/V_0), from slow to fast by the amplitude.
      static Truth
      overstress(TrueContact &contact, const double a, Random &random)
      {
        FlowRule &flow  = contact.flow;
        flow.formula    = Formula::alternative;
        flow.base_speed = log_uniform(random, 0.005, 0.1);
        flow.exponent   = std::asinh(Reach::largest_speed / flow.base_speed) /
                        std::max(a, 1e-5);
        return {{"A", 1. / flow.exponent, ""},
                {"V_0", flow.base_speed, "mm/s"}};
      }



      static Truth
      softening(TrueContact &contact, const double a, Random &random)
      {
        CoefficientRule &rule    = contact.coefficient;
        rule.softening           = Formula::alternative;
        rule.kinetic_coefficient = rule.static_coefficient / (1. + a);
        rule.length              = log_uniform(random, 0.5, 3.);
        return {{"mu_k", rule.kinetic_coefficient, ""},
                {"L", rule.length, "mm"}};
      }



      // Asperities spread by creep with a power of the stress, which falls as
      // they spread: at rest as the fifth root of time; Brechet and Estrin
      // (1994), Scr. Metall. Mater. 30, 1449. What was won is lost in
      // proportion to slip.
      static Truth healing(TrueContact &contact, const double a, Random &random)
      {
        const double t_0    = log_uniform(random, 1., 10.);
        const double length = log_uniform(random, 0.02, 0.5);
        const double c      = std::max(a, 1e-12) /
                         (std::pow(1. + Reach::long_rest / t_0, 0.2) - 1.);
        contact.influences.push_back(
          {[](const Instant &, const double growth) {
             return 1. + std::max(growth, 0.);
           },
           {},
           [=](const Instant &now, const double growth) {
             return c / (5. * t_0) *
                      std::pow(1. + std::max(growth, 0.) / c, -4.) -
                    now.slip_rate * growth / length;
           },
           {}});
        return {{"c", c, ""}, {"t_0", t_0, "s"}, {"L", length, "mm"}};
      }



      static Truth pressure(TrueContact &contact, const double a, Random &)
      {
        const double p_0 = Reach::reference_pressure;
        const double m   = a / std::log(Reach::largest_pressure / p_0);
        contact.influences.push_back({[=](const Instant &now, double) {
                                        return 1. -
                                               m * std::log(now.pressure / p_0);
                                      },
                                      {},
                                      {},
                                      {}});
        return {{"m", m, ""}, {"p_0", p_0, "MPa"}};
      }



      // 1/sqrt(1 + x^2) is about 1 - x^2/2.
      static Truth shear_cap(TrueContact &contact, const double a, Random &)
      {
        const double limit = Reach::largest_pressure *
                             contact.coefficient.static_coefficient /
                             std::sqrt(2. * std::max(a, 1e-12));
        contact.influences.push_back(
          {[=](const Instant &now, double) {
             return 1. / std::hypot(1., now.pressure * now.coefficient / limit);
           },
           {},
           {},
           {}});
        return {{"tau_c", limit, "MPa"}};
      }



      // Bonds as many as the pressure makes, up to all of them.
      static Truth
      adhesion(TrueContact &contact, const double a, Random &random)
      {
        const double p_1 = uniform(random, 0.3, 1.);
        const double c   = a * Reach::least_pressure *
                         contact.coefficient.kinetic_coefficient /
                         (1. - std::exp(-Reach::least_pressure / p_1));
        contact.influences.push_back(
          {{},
           [=](const Instant &now, double) {
             return c * (1. - std::exp(-now.pressure / p_1));
           },
           {},
           {}});
        return {{"c", c, "MPa"}, {"p_1", p_1, "MPa"}};
      }



      // Weakening in proportion to the temperature, cooling by free convection
      // with its exponent 5/4.
      static Truth heating(TrueContact &contact, const double a, Random &random)
      {
        const double t_c   = log_uniform(random, 3., 20.);
        const double power = Reach::reference_pressure *
                             contact.coefficient.kinetic_coefficient *
                             Reach::largest_speed;
        // Of T over that of fast sliding for long.
        contact.influences.push_back(
          {[=](const Instant &, const double temperature) {
             return 1. - a * temperature;
           },
           {},
           [=](const Instant &now, const double temperature) {
             return (now.traction * now.slip_rate / power -
                     std::pow(std::max(temperature, 0.), 1.25)) /
                    t_c;
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
                                        return 1. + w * now.path /
                                                      (now.path + length);
                                      },
                                      {},
                                      {},
                                      {}});
        return {{"w", w, ""}, {"D_w", length, "mm"}};
      }



      // Traction and slip stay parallel.
      static Truth
      anisotropy(TrueContact &contact, const double a, Random &random)
      {
        const double d = either_sign(random) * a;
        contact.influences.push_back(
          {[=](const Instant &now, double) {
             const double c = now.direction[0], s = now.direction[1];
             return 1. + d * (1. - (c * c - s * s)) / 2.;
           },
           {},
           {},
           {}});
        return {{"d", d, ""}};
      }



      // The same traction more at any pressure, on strokes that go back.
      static Truth
      direction(TrueContact &contact, const double a, Random &random)
      {
        const double c = either_sign(random) * a * Reach::reference_pressure *
                         contact.coefficient.kinetic_coefficient;
        contact.influences.push_back({{},
                                      [=](const Instant &now, double) {
                                        return c *
                                               std::max(-now.direction[0], 0.);
                                      },
                                      {},
                                      {}});
        return {{"c", c, "MPa"}};
      }



      // 1/(1 + x^q) is steepest over ln(x) at x = 1, where it falls by q/4.
      static Truth
      stribeck(TrueContact &contact, const double a, Random &random)
      {
        const double speed = log_uniform(random, 0.05, 1.);
        const double q     = uniform(random, 1., 2.);
        const double s     = std::min(a, largest_weakening(contact) * 4. / q);
        contact.influences.push_back(
          {[=](const Instant &now, double) {
             return 1. + s / (1. + std::pow(now.slip_rate / speed, q));
           },
           {},
           {},
           {},
           true});
        return {{"s", s, ""}, {"V_s", speed, "mm/s"}, {"q", q, ""}};
      }



      // A film that thins in shear.
      static Truth viscous(TrueContact &contact, const double a, Random &)
      {
        const double exponent = 0.8;
        const double drag     = a * Reach::reference_pressure *
                            contact.coefficient.kinetic_coefficient /
                            std::pow(Reach::largest_speed, exponent);
        contact.influences.push_back({{},
                                      [=](const Instant &now, double) {
                                        return drag * std::pow(now.slip_rate,
                                                               exponent);
                                      },
                                      {},
                                      {},
                                      true});
        return {{"c_v", drag, "MPa (s/mm)^0.8"}};
      }



      // Twice as stiff at a usual traction.
      static Truth compliance(TrueContact &contact, const double a, Random &)
      {
        contact.compliance = a / 0.3;
        contact.stiffening_traction =
          Reach::reference_pressure * contact.coefficient.kinetic_coefficient;
        return {{"k without load",
                 1. / std::max(contact.compliance, 1e-12),
                 "MPa/mm"},
                {"traction at twice k", contact.stiffening_traction, "MPa"}};
      }
    } // namespace Alternative



    std::vector<HiddenEffectKind> other_formulas()
    {
      return {{"overstress",
               "r = r_s + A asinh(lambda / V_0)",
               &Alternative::overstress},
              {"softening",
               "d mu/d lambda = -(mu - mu_k)^2 / (L (mu_s - mu_k))",
               &Alternative::softening},
              {"healing",
               "G = 1 + g, dg/dt = c/(5 t_0) (1 + g/c)^-4 - lambda g/L",
               &Alternative::healing},
              {"pressure", "G = 1 - m ln(p / p_0)", &Alternative::pressure},
              {"shear_cap",
               "p mu -> p mu / sqrt(1 + (p mu / tau_c)^2)",
               &Alternative::shear_cap},
              {"adhesion",
               "tau_y = ... + c (1 - exp(-p / p_1))",
               &Alternative::adhesion},
              {"heating",
               "G = 1 - beta T, dT/dt = h |f_t| lambda - (T/T_1)^1.25 T_1/t_c",
               &Alternative::heating},
              {"run_in", "G = 1 + w D / (D + D_w)", &Alternative::run_in},
              {"anisotropy",
               "G = 1 + d (1 - cos(2 phi)) / 2, slip along the traction",
               &Alternative::anisotropy},
              {"direction",
               "tau_y = ... + c max(-cos(phi), 0)",
               &Alternative::direction},
              {"stribeck",
               "G = 1 + s / (1 + (lambda / V_s)^q)",
               &Alternative::stribeck},
              {"viscous",
               "tau_y = ... + c_v lambda^0.8",
               &Alternative::viscous},
              {"compliance",
               "spring that stiffens: k (1 + |f_t| / f_1)",
               &Alternative::compliance}};
    }
  } // namespace Planting
} // namespace SlipStep
