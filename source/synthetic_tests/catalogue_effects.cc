// SPDX-License-Identifier: LGPL-2.1-or-later

// The formulas of the catalogue, written anew. Amplitudes are turned into
// parameters of the formulas, which are named as in a case file.

#include <slipstep/synthetic_tests/hidden_effects.h>

#include <algorithm>

namespace SlipStep
{
  namespace Planting
  {
    namespace
    {
      Truth heat(TrueContact &contact,
                 const double beta,
                 const double h,
                 const double t_c)
      {
        contact.remember(
          [=](const Instant &now, const double temperature) {
            return h * now.traction * now.slip_rate - temperature / t_c;
          },
          [=](const Instant &, const double temperature) {
            return 1. / (1. + beta * temperature);
          });
        return {{"Friction/heating/Weakening", beta, "1/degC"},
                {"Friction/heating/Heating", h, "degC mm/N"},
                {"Friction/heating/Cooling time", t_c, "s"}};
      }
    } // namespace



    const std::vector<HiddenEffectKind> catalogue_effects = {
      {"overstress",
       "lambda = (exp(n (r - r_s)) - 1) / (eta_v (r_m - r))",
       // The levels at the least and the largest speed differ by the amplitude.
       [](TrueContact &contact, const double a, Random &random) -> Truth {
         FlowRule &flow = contact.flow;
         flow.viscosity = log_uniform(random, 100., 1000.);
         flow.exponent  = std::log(Reach::largest_speed / Reach::least_speed) /
                         std::max(a, 1e-5);
         return {{"Friction/overstress/Viscosity", flow.viscosity, "s/mm"},
                 {"Friction/overstress/Exponent", flow.exponent, ""},
                 {"Friction/overstress/Maximum ratio", flow.maximum_ratio, ""}};
       }},

      {"softening",
       "d mu/d lambda = -kappa (exp(a (mu - mu_k)) - 1)",
       // Static and kinetic coefficient differ by the amplitude.
       [](TrueContact &contact, const double a, Random &random) -> Truth {
         CoefficientRule &rule    = contact.coefficient;
         rule.kinetic_coefficient = rule.static_coefficient / (1. + a);
         rule.rate = 1. / (rule.steepness * log_uniform(random, 1., 6.));
         return {{"Friction/softening/Kinetic coefficient",
                  rule.kinetic_coefficient,
                  ""},
                 {"Friction/softening/Rate", rule.rate, "1/mm"},
                 {"Friction/softening/Steepness", rule.steepness, ""}};
       }},

      {"healing",
       "d mu/dt = xi (exp(b (mu_s - mu)) - 1)",
       // The kinetic coefficient recovers by the amplitude in a long rest.
       [](TrueContact &contact, const double a, Random &random) -> Truth {
         CoefficientRule &rule = contact.coefficient;
         const double fall = rule.static_coefficient - rule.kinetic_coefficient;
         const double recovery =
           std::min(a * rule.kinetic_coefficient, 0.8 * fall);
         rule.healing_steepness =
           uniform(random, 2., 6.) / std::max(fall, 1e-6);
         const double b    = rule.healing_steepness;
         rule.healing_rate = -std::log(std::expm1(b * (recovery - fall)) /
                                       std::expm1(-b * fall)) /
                             (b * Reach::long_rest);
         return {{"Friction/healing/Rate", rule.healing_rate, "1/s"},
                 {"Friction/healing/Steepness", b, ""}};
       }},

      {"pressure",
       "G = (p / p_0)^-m",
       // Friction falls by the amplitude towards high pressure.
       [](TrueContact &contact, const double a, Random &) -> Truth {
         const double p_0 = Reach::reference_pressure;
         const double m   = a / std::log(Reach::largest_pressure / p_0);
         contact.multiply([=](const Instant &now) {
           return std::pow(now.pressure / p_0, -m);
         });
         return {{"Friction/pressure/Exponent", m, ""},
                 {"Friction/pressure/Reference pressure", p_0, "MPa"}};
       }},

      {"shear_cap",
       "p mu -> tau_c tanh(p mu / tau_c)",
       // tanh(x)/x is about 1 - x^2/3.
       [](TrueContact &contact, const double a, Random &) -> Truth {
         const double limit = Reach::largest_pressure *
                              contact.coefficient.static_coefficient /
                              std::sqrt(3. * std::max(a, 1e-12));
         contact.multiply([=](const Instant &now) {
           const double x = now.pressure * now.coefficient / limit;
           return x < 1e-4 ? 1. : std::tanh(x) / x;
         });
         return {{"Friction/shear_cap/Shear limit", limit, "MPa"}};
       }},

      {"adhesion",
       "tau_y = ... + c",
       [](TrueContact &contact, const double a, Random &) -> Truth {
         const double c =
           a * Reach::least_pressure * contact.coefficient.kinetic_coefficient;
         contact.add([=](const Instant &) { return c; });
         return {{"Friction/adhesion/Strength", c, "MPa"}};
       }},

      {"heating",
       "G = 1 / (1 + beta T), dT/dt = h |f_t| lambda - T / t_c",
       // Fast sliding for long weakens by the amplitude.
       [](TrueContact &contact, const double a, Random &random) {
         const double h = 10., t_c = log_uniform(random, 3., 20.);
         const double power = usual_friction(contact) * Reach::largest_speed;
         return heat(contact, a / (h * t_c * power), h, t_c);
       }},

      {"run_in",
       "G = 1 + w (1 - exp(-D / D_w))",
       [](TrueContact &contact, const double a, Random &random) -> Truth {
         const double w      = either_sign(random) * a;
         const double length = log_uniform(random, 8., 40.);
         contact.multiply([=](const Instant &now) {
           return 1. + w * (1. - std::exp(-now.path / length));
         });
         return {{"Friction/run_in/Change", w, ""},
                 {"Friction/run_in/Length", length, "mm"}};
       }},

      {"anisotropy",
       "elliptic cone, slip normal to it",
       [](TrueContact &contact, const double a, Random &random) -> Truth {
         contact.anisotropy_ratio = 1. + either_sign(random) * a;
         contact.anisotropy_angle = 0.;
         return {{"Friction/anisotropy/Ratio", contact.anisotropy_ratio, ""},
                 {"Friction/anisotropy/Angle", 0., "deg"}};
       }},

      {"direction",
       "G = 1 + d (1 - cos(phi)) / 2",
       [](TrueContact &contact, const double a, Random &random) -> Truth {
         const double d = either_sign(random) * a;
         contact.multiply([=](const Instant &now) {
           return 1. + d * (1. - now.direction[0]) / 2.;
         });
         return {{"Friction/direction/Change", d, ""},
                 {"Friction/direction/Forward angle", 0., "deg"}};
       }},

      {"stribeck",
       "G = 1 + s exp(-(lambda / V_s)^q)",
       // exp(-x^q) is steepest over ln(x) at x = 1, where it falls by q/e.
       [](TrueContact &contact, const double a, Random &random) -> Truth {
         const double speed = log_uniform(random, 0.05, 1.);
         const double q     = uniform(random, 1., 1.5);
         const double s =
           std::min(a, largest_weakening(contact) * std::exp(1.) / q);
         contact.multiply_at_speed([=](const double slip_rate) {
           return 1. + s * std::exp(-std::pow(slip_rate / speed, q));
         });
         return {{"Friction/stribeck/Rise", s, ""},
                 {"Friction/stribeck/Speed", speed, "mm/s"},
                 {"Friction/stribeck/Exponent", q, ""}};
       }},

      {"viscous",
       "tau_y = ... + c_v lambda",
       [](TrueContact &contact, const double a, Random &) -> Truth {
         const double drag = usual_friction(contact, a) / Reach::largest_speed;
         contact.add_at_speed(
           [=](const double slip_rate) { return drag * slip_rate; });
         return {{"Friction/viscous/Drag", drag, "MPa s/mm"}};
       }},

      {"compliance",
       "spring of stiffness k in series",
       // Flanks only: the amplitude stands for 5 to 130 MPa/mm.
       [](TrueContact &contact, const double a, Random &) -> Truth {
         contact.compliance = a / 0.4;
         return {{"Loading/Machine stiffness",
                  1. / std::max(contact.compliance, 1e-12),
                  "MPa/mm"}};
       }}};



    namespace
    {
      Truth catalogue_effect(const std::string &name,
                             TrueContact       &contact,
                             const double       a,
                             Random            &random)
      {
        return hidden_effect(name, Formula::catalogue).add(contact, a, random);
      }



      Truth both(Truth first, const Truth &second)
      {
        first.insert(first.end(), second.begin(), second.end());
        return first;
      }



      // What an overstress adds at higher speeds, contacts that are younger
      // there take away again, after some slip: of steady sliding nearly
      // nothing is left. Their age, or its logarithm, follows that of steady
      // sliding.
      Truth rate_and_state(TrueContact &contact,
                           const double a,
                           const bool   ages_at_rest,
                           Random      &random)
      {
        const Truth  truth = catalogue_effect("overstress", contact, a, random);
        const double b     = uniform(random, 0.6, 1.) / contact.flow.exponent;
        const double length = log_uniform(random, 0.2, 1.5);
        const double t_0    = 0.1 * length / Reach::largest_speed;
        contact.remember(
          [=](const Instant &now, const double age) {
            const double x = now.slip_rate * age / length;
            return ages_at_rest ? 1. - x : x > 0. ? -x * std::log(x) : 0.;
          },
          [=](const Instant &, const double age) {
            return 1. + b * std::log1p(std::max(age, 0.) / t_0);
          },
          [=](double) { return ages_at_rest ? 0. : t_0; });
        const std::string section =
          ages_at_rest ? "Friction/ageing/" : "Friction/slip_law/";
        return both(truth,
                    {{section + "Growth", b, ""},
                     {section + "Time", t_0, "s"},
                     {section +
                        (ages_at_rest ? "Renewal length" : "Slip length"),
                      length,
                      "mm"}});
      }
    } // namespace



    const std::vector<HiddenEffectKind> joint_effects = {
      {"overstress+ageing",
       "eq. 3 and G = 1 + b ln(1 + theta/t_0), d theta/dt = 1 - lambda theta/L",
       [](TrueContact &contact, const double a, Random &random) {
         return rate_and_state(contact, a, true, random);
       }},

      {"overstress+slip_law",
       "eq. 3 and G = 1 + b ln(1 + theta/t_0), d theta/dt = -(lambda "
       "theta/L) ln(lambda theta/L)",
       [](TrueContact &contact, const double a, Random &random) {
         return rate_and_state(contact, a, false, random);
       }},

      {"adhesion+pressure",
       "tau_y = ... + c, G = (p / p_0)^-m, m < 0",
       // Low pressures are raised by the one and lowered by the other.
       [](TrueContact &contact, const double a, Random &random) {
         const Truth  truth = catalogue_effect("adhesion", contact, a, random);
         const double share =
           a * (1. - Reach::least_pressure / Reach::largest_pressure) *
           std::log(Reach::largest_pressure / Reach::reference_pressure) /
           std::log(Reach::largest_pressure / Reach::least_pressure);
         const double opposite = -uniform(random, 0.7, 1.1) * share;
         return both(truth,
                     catalogue_effect("pressure", contact, opposite, random));
       }},

      {"viscous+heating",
       "tau_y = ... + c_v lambda, G = 1 / (1 + beta T)",
       // The drag is there at once, the heat that outweighs it comes later.
       [](TrueContact &contact, const double a, Random &random) {
         const Truth  truth = catalogue_effect("viscous", contact, a, random);
         const double t_c   = log_uniform(random, 0.5, 3.);
         const double beta  = 1e-3;
         const double h =
           uniform(random, 0.7, 1.1) * a /
           (beta * t_c * Reach::reference_pressure *
            contact.coefficient.kinetic_coefficient * Reach::largest_speed);
         return both(truth, heat(contact, beta, h, t_c));
       }}};
  } // namespace Planting
} // namespace SlipStep
