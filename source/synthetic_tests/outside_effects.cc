// SPDX-License-Identifier: LGPL-2.1-or-later

// Physics that no effect of the catalogue has: the right verdict is that
// something unknown is missing.

#include <slipstep/synthetic_tests/hidden_effects.h>

#include <boost/math/constants/constants.hpp>

#include <algorithm>

namespace SlipStep
{
  namespace Planting
  {
    namespace
    {
      constexpr double two_pi = boost::math::constants::two_pi<double>();
    }



    const std::vector<HiddenEffectKind> outside_effects = {
      {"texture",
       "G = 1 + a sin(2 pi (x + y) / wavelength)",
       // A pattern of the surface; also across.
       [](TrueContact &contact, const double a, Random &random) -> Truth {
         const double length = log_uniform(random, 1., 4.);
         const double phase  = uniform(random, 0., two_pi);
         contact.multiply([=](const Instant &now) {
           const double place = now.position[0] + now.position[1];
           return 1. + a * std::sin(two_pi * place / length + phase);
         });
         return {{"a", a, ""}, {"wavelength", length, "mm"}};
       }},

      {"memory_length",
       "G = 1 - b psi, d psi/d lambda = (ln(1 + lambda/V_0) - psi) / L",
       // Friction answers a change of speed at once by the overstress, and goes
       // back on a slip length: the slip law of rate and state, Ruina (1983),
       // J. Geophys. Res. 88, 10359.
       [](TrueContact &contact, const double a, Random &random) -> Truth {
         const double length = log_uniform(random, 0.2, 2.);
         const double speed  = log_uniform(random, 0.02, 0.1);
         const double b = std::min(a / std::log1p(Reach::largest_speed / speed),
                                   largest_weakening(contact));
         contact.remember(
           [=](const Instant &now, const double psi) {
             return now.slip_rate * (std::log1p(now.slip_rate / speed) - psi) /
                    length;
           },
           [=](const Instant &, const double psi) { return 1. - b * psi; });
         return {{"b", b, ""}, {"L", length, "mm"}, {"V_0", speed, "mm/s"}};
       }},

      {"load_memory",
       "G = (q / p)^exponent, dq/d lambda = (p - q) / L",
       // Contacts adapt to a new pressure with slip; Linker and Dieterich
       // (1992), J. Geophys. Res. 97, 4923.
       [](TrueContact &contact, const double a, Random &random) -> Truth {
         const double length   = log_uniform(random, 0.5, 3.);
         const double exponent = either_sign(random) * a / std::log(2.);
         contact.remember(
           [=](const Instant &now, const double adapted) {
             return now.slip_rate * (now.pressure - adapted) / length;
           },
           [=](const Instant &now, const double adapted) {
             return std::pow(std::max(adapted, 1e-3) / now.pressure, exponent);
           },
           [](const double pressure) { return pressure; });
         return {{"exponent", exponent, ""}, {"L", length, "mm"}};
       }},

      {"largest_pressure",
       "G = 1 + a (1 - p / largest p so far)",
       // Asperities that were flattened stay so; within a hundredth of a second
       // they are.
       [](TrueContact &contact, const double a, Random &) -> Truth {
         const double strength = 2. * a;
         contact.remember(
           [](const Instant &now, const double largest) {
             return 100. * std::max(now.pressure - largest, 0.);
           },
           [=](const Instant &now, const double largest) {
             return 1. +
                    strength * (1. - now.pressure / std::max(largest, 1e-3));
           },
           [](const double pressure) { return pressure; });
         return {{"a", strength, ""}};
       }},

      {"damage",
       "G = 1 + jump after a slip path",
       // A coating that breaks through.
       [](TrueContact &contact, const double a, Random &random) -> Truth {
         const double place = uniform(random, 4., 9.);
         const double width = 0.2;
         const double jump  = either_sign(random) * a;
         contact.multiply([=](const Instant &now) {
           return 1. +
                  jump /
                    (1. + std::exp(std::min((place - now.path) / width, 100.)));
         });
         return {{"jump", jump, ""}, {"after", place, "mm"}};
       }},

      {"resonance",
       "G = 1 + rise exp(-ln(lambda/V)^2 / (2 w^2))",
       // A bell over ln(lambda) is steepest one width away, by exp(-1/2)/w.
       [](TrueContact &contact, const double a, Random &random) -> Truth {
         const double speed = log_uniform(random, 0.1, 1.);
         const double width = uniform(random, 0.5, 0.9);
         const double rise =
           std::min(a, largest_weakening(contact) * width * std::exp(0.5));
         contact.multiply_at_speed([=](const double slip_rate) {
           const double x =
             std::log(std::max(slip_rate, 1e-30) / speed) / width;
           return 1. + rise * std::exp(-x * x / 2.);
         });
         return {{"rise", rise, ""},
                 {"speed", speed, "mm/s"},
                 {"width in ln(speed)", width, ""}};
       }},

      {"run_order",
       "G = 1 + change * (place in the campaign, 0 to 1)",
       // The machine, the air or the oil changes from test to test.
       [](TrueContact &contact, const double a, Random &random) -> Truth {
         const double change = either_sign(random) * a;
         contact.multiply(
           [=](const Instant &now) { return 1. + change * now.progress; });
         return {{"change from first to last test", change, ""}};
       }},

      {"pressure_rate",
       "G = 1 - a tanh((dp/dt) / rate)",
       // Squeezed oil bears part of the load while the pressure grows.
       [](TrueContact &contact, const double a, Random &random) -> Truth {
         const double rate = log_uniform(random, 0.5, 2.);
         contact.multiply([=](const Instant &now) {
           return 1. - a * std::tanh(now.pressure_rate / rate);
         });
         return {{"a", a, ""}, {"rate", rate, "MPa/s"}};
       }},

      {"uneven_texture",
       "G = 1 + a (sin w + sin(2 w + phase) / 2 + sin(3 w + phase) / 4), "
       "w = 2 pi (x + y) / wavelength",
       // A pattern that is not round.
       [](TrueContact &contact, const double a, Random &random) -> Truth {
         const double length = log_uniform(random, 2., 6.);
         const double begin  = uniform(random, 0., two_pi);
         const double phase  = uniform(random, 0., two_pi);
         contact.multiply([=](const Instant &now) {
           const double place = now.position[0] + now.position[1];
           const double w     = two_pi * place / length + begin;
           return 1. + a * (std::sin(w) + std::sin(2. * w + phase) / 2. +
                            std::sin(3. * w + phase) / 4.);
         });
         return {{"a", a, ""}, {"wavelength", length, "mm"}};
       },
       2}};
  } // namespace Planting
} // namespace SlipStep
