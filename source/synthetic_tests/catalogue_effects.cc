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
      using Truth = std::vector<TruthParameter>;

      // The levels at the least and the largest speed differ by the amplitude.
      Truth overstress(TrueContact &contact, const double a, Random &random)
      {
        FlowRule &flow = contact.flow;
        flow.viscosity = log_uniform(random, 100., 1000.);
        flow.exponent  = std::log(Reach::largest_speed / Reach::least_speed) /
                        std::max(a, 1e-5);
        return {{"Friction/overstress/Viscosity", flow.viscosity, "s/mm"},
                {"Friction/overstress/Exponent", flow.exponent, ""},
                {"Friction/overstress/Maximum ratio", flow.maximum_ratio, ""}};
      }



      // Static and kinetic coefficient differ by the amplitude.
      Truth softening(TrueContact &contact, const double a, Random &random)
      {
        CoefficientRule &rule    = contact.coefficient;
        rule.kinetic_coefficient = rule.static_coefficient / (1. + a);
        rule.rate = 1. / (rule.steepness * log_uniform(random, 1., 6.));
        return {{"Friction/softening/Kinetic coefficient",
                 rule.kinetic_coefficient,
                 ""},
                {"Friction/softening/Rate", rule.rate, "1/mm"},
                {"Friction/softening/Steepness", rule.steepness, ""}};
      }



      // The kinetic coefficient recovers by the amplitude in a long rest.
      Truth healing(TrueContact &contact, const double a, Random &random)
      {
        CoefficientRule &rule = contact.coefficient;
        const double fall = rule.static_coefficient - rule.kinetic_coefficient;
        const double recovery =
          std::min(a * rule.kinetic_coefficient, 0.8 * fall);
        rule.healing_steepness = uniform(random, 2., 6.) / std::max(fall, 1e-6);
        const double b         = rule.healing_steepness;
        rule.healing_rate =
          -std::log(std::expm1(b * (recovery - fall)) / std::expm1(-b * fall)) /
          (b * Reach::long_rest);
        return {{"Friction/healing/Rate", rule.healing_rate, "1/s"},
                {"Friction/healing/Steepness", b, ""}};
      }



      // (p/p_0)^-m: friction falls by the amplitude towards high pressure.
      Truth pressure(TrueContact &contact, const double a, Random &)
      {
        const double p_0 = Reach::reference_pressure;
        const double m   = a / std::log(Reach::largest_pressure / p_0);
        contact.influences.push_back({[=](const Instant &now, double) {
                                        return std::pow(now.pressure / p_0, -m);
                                      },
                                      {},
                                      {},
                                      {}});
        return {{"Friction/pressure/Exponent", m, ""},
                {"Friction/pressure/Reference pressure", p_0, "MPa"}};
      }



      // tanh(x)/x is about 1 - x^2/3.
      Truth shear_cap(TrueContact &contact, const double a, Random &)
      {
        const double limit = Reach::largest_pressure *
                             contact.coefficient.static_coefficient /
                             std::sqrt(3. * std::max(a, 1e-12));
        contact.influences.push_back(
          {[=](const Instant &now, double) {
             const double x = now.pressure * now.coefficient / limit;
             return x < 1e-4 ? 1. : std::tanh(x) / x;
           },
           {},
           {},
           {}});
        return {{"Friction/shear_cap/Shear limit", limit, "MPa"}};
      }



      Truth adhesion(TrueContact &contact, const double a, Random &)
      {
        const double c =
          a * Reach::least_pressure * contact.coefficient.kinetic_coefficient;
        contact.influences.push_back(
          {{}, [=](const Instant &, double) { return c; }, {}, {}});
        return {{"Friction/adhesion/Strength", c, "MPa"}};
      }



      // G = 1/(1 + beta T), dT/dt = h |f_t| lambda - T/t_c. Fast sliding for
      // long weakens by the amplitude.
      Truth heating(TrueContact &contact, const double a, Random &random)
      {
        const double h = 10., t_c = log_uniform(random, 3., 20.);
        const double power = Reach::reference_pressure *
                             contact.coefficient.kinetic_coefficient *
                             Reach::largest_speed;
        const double beta = a / (h * t_c * power);
        contact.influences.push_back(
          {[=](const Instant &, const double temperature) {
             return 1. / (1. + beta * temperature);
           },
           {},
           [=](const Instant &now, const double temperature) {
             return h * now.traction * now.slip_rate - temperature / t_c;
           },
           {}});
        return {{"Friction/heating/Weakening", beta, "1/degC"},
                {"Friction/heating/Heating", h, "degC mm/N"},
                {"Friction/heating/Cooling time", t_c, "s"}};
      }



      Truth run_in(TrueContact &contact, const double a, Random &random)
      {
        const double w      = either_sign(random) * a;
        const double length = log_uniform(random, 8., 40.);
        contact.influences.push_back(
          {[=](const Instant &now, double) {
             return 1. + w * (1. - std::exp(-now.path / length));
           },
           {},
           {},
           {}});
        return {{"Friction/run_in/Change", w, ""},
                {"Friction/run_in/Length", length, "mm"}};
      }



      Truth anisotropy(TrueContact &contact, const double a, Random &random)
      {
        contact.anisotropy_ratio = 1. + either_sign(random) * a;
        contact.anisotropy_angle = 0.;
        return {{"Friction/anisotropy/Ratio", contact.anisotropy_ratio, ""},
                {"Friction/anisotropy/Angle", 0., "deg"}};
      }



      Truth direction(TrueContact &contact, const double a, Random &random)
      {
        const double d = either_sign(random) * a;
        contact.influences.push_back({[=](const Instant &now, double) {
                                        return 1. +
                                               d * (1. - now.direction[0]) / 2.;
                                      },
                                      {},
                                      {},
                                      {}});
        return {{"Friction/direction/Change", d, ""},
                {"Friction/direction/Forward angle", 0., "deg"}};
      }



      // exp(-x^q) is steepest over ln(x) at x = 1, where it falls by q/e.
      Truth stribeck(TrueContact &contact, const double a, Random &random)
      {
        const double speed = log_uniform(random, 0.05, 1.);
        const double q     = uniform(random, 1., 1.5);
        const double s =
          std::min(a, largest_weakening(contact) * std::exp(1.) / q);
        contact.influences.push_back(
          {[=](const Instant &now, double) {
             return 1. + s * std::exp(-std::pow(now.slip_rate / speed, q));
           },
           {},
           {},
           {},
           true});
        return {{"Friction/stribeck/Rise", s, ""},
                {"Friction/stribeck/Speed", speed, "mm/s"},
                {"Friction/stribeck/Exponent", q, ""}};
      }



      Truth viscous(TrueContact &contact, const double a, Random &)
      {
        const double drag = a * Reach::reference_pressure *
                            contact.coefficient.kinetic_coefficient /
                            Reach::largest_speed;
        contact.influences.push_back(
          {{},
           [=](const Instant &now, double) { return drag * now.slip_rate; },
           {},
           {},
           true});
        return {{"Friction/viscous/Drag", drag, "MPa s/mm"}};
      }



      // Flanks only: the amplitude stands for 5 to 130 MPa/mm.
      Truth compliance(TrueContact &contact, const double a, Random &)
      {
        contact.compliance = a / 0.4;
        return {{"Loading/Machine stiffness",
                 1. / std::max(contact.compliance, 1e-12),
                 "MPa/mm"}};
      }
    } // namespace



    namespace
    {
      // What an overstress adds at higher speeds, contacts that are younger
      // there take away again, after some slip: of steady sliding nearly
      // nothing is left. Their age, or its logarithm, follows that of steady
      // sliding.
      Truth rate_and_state(TrueContact &contact,
                           const double a,
                           const bool   ages_at_rest,
                           Random      &random)
      {
        Truth        truth  = overstress(contact, a, random);
        const double b      = uniform(random, 0.6, 1.) / contact.flow.exponent;
        const double length = log_uniform(random, 0.2, 1.5);
        const double t_0    = 0.1 * length / Reach::largest_speed;
        contact.influences.push_back(
          {[=](const Instant &, const double age) {
             return 1. + b * std::log1p(std::max(age, 0.) / t_0);
           },
           {},
           [=](const Instant &now, const double age) {
             const double x = now.slip_rate * age / length;
             return ages_at_rest ? 1. - x : x > 0. ? -x * std::log(x) : 0.;
           },
           [=](double) { return ages_at_rest ? 0. : t_0; }});
        const std::string section =
          ages_at_rest ? "Friction/ageing/" : "Friction/slip_law/";
        truth.push_back({section + "Growth", b, ""});
        truth.push_back({section + "Time", t_0, "s"});
        truth.push_back(
          {section + (ages_at_rest ? "Renewal length" : "Slip length"),
           length,
           "mm"});
        return truth;
      }



      Truth
      overstress_ageing(TrueContact &contact, const double a, Random &random)
      {
        return rate_and_state(contact, a, true, random);
      }



      Truth
      overstress_slip_law(TrueContact &contact, const double a, Random &random)
      {
        return rate_and_state(contact, a, false, random);
      }



      // Low pressures are raised by the one and lowered by the other.
      Truth
      adhesion_pressure(TrueContact &contact, const double a, Random &random)
      {
        Truth        truth = adhesion(contact, a, random);
        const double share =
          a * (1. - Reach::least_pressure / Reach::largest_pressure) *
          std::log(Reach::largest_pressure / Reach::reference_pressure) /
          std::log(Reach::largest_pressure / Reach::least_pressure);
        const Truth second =
          pressure(contact, -uniform(random, 0.7, 1.1) * share, random);
        truth.insert(truth.end(), second.begin(), second.end());
        return truth;
      }



      // The drag is there at once, the heat that outweighs it comes later.
      Truth
      viscous_heating(TrueContact &contact, const double a, Random &random)
      {
        Truth        truth = viscous(contact, a, random);
        const double t_c   = log_uniform(random, 0.5, 3.);
        const double beta  = 1e-3;
        const double h =
          uniform(random, 0.7, 1.1) * a /
          (beta * t_c * Reach::reference_pressure *
           contact.coefficient.kinetic_coefficient * Reach::largest_speed);
        contact.influences.push_back(
          {[=](const Instant &, const double temperature) {
             return 1. / (1. + beta * temperature);
           },
           {},
           [=](const Instant &now, const double temperature) {
             return h * now.traction * now.slip_rate - temperature / t_c;
           },
           {}});
        truth.push_back({"Friction/heating/Weakening", beta, "1/degC"});
        truth.push_back({"Friction/heating/Heating", h, "degC mm/N"});
        truth.push_back({"Friction/heating/Cooling time", t_c, "s"});
        return truth;
      }
    } // namespace



    std::vector<HiddenEffectKind> joint_effects()
    {
      return {{"overstress+ageing",
               "eq. 3 and G = 1 + b ln(1 + theta/t_0), d theta/dt = 1 - lambda "
               "theta/L",
               &overstress_ageing},
              {"overstress+slip_law",
               "eq. 3 and G = 1 + b ln(1 + theta/t_0), d theta/dt = -(lambda "
               "theta/L) ln(lambda theta/L)",
               &overstress_slip_law},
              {"adhesion+pressure",
               "tau_y = ... + c, G = (p / p_0)^-m, m < 0",
               &adhesion_pressure},
              {"viscous+heating",
               "tau_y = ... + c_v lambda, G = 1 / (1 + beta T)",
               &viscous_heating}};
    }



    std::vector<HiddenEffectKind> catalogue_effects()
    {
      return {{"overstress",
               "lambda = (exp(n (r - r_s)) - 1) / (eta_v (r_m - r))",
               &overstress},
              {"softening",
               "d mu/d lambda = -kappa (exp(a (mu - mu_k)) - 1)",
               &softening},
              {"healing", "d mu/dt = xi (exp(b (mu_s - mu)) - 1)", &healing},
              {"pressure", "G = (p / p_0)^-m", &pressure},
              {"shear_cap", "p mu -> tau_c tanh(p mu / tau_c)", &shear_cap},
              {"adhesion", "tau_y = ... + c", &adhesion},
              {"heating",
               "G = 1 / (1 + beta T), dT/dt = h |f_t| lambda - T / t_c",
               &heating},
              {"run_in", "G = 1 + w (1 - exp(-D / D_w))", &run_in},
              {"anisotropy", "elliptic cone, slip normal to it", &anisotropy},
              {"direction", "G = 1 + d (1 - cos(phi)) / 2", &direction},
              {"stribeck", "G = 1 + s exp(-(lambda / V_s)^q)", &stribeck},
              {"viscous", "tau_y = ... + c_v lambda", &viscous},
              {"compliance", "spring of stiffness k in series", &compliance}};
    }
  } // namespace Planting
} // namespace SlipStep
