// SPDX-License-Identifier: LGPL-2.1-or-later

// The workshop that plants effects and the law were written apart: with the
// formulas of the catalogue they must agree in every protocol.

#include <slipstep/experiment/machine.h>
#include <slipstep/experiment/replay.h>
#include <slipstep/friction/law.h>
#include <slipstep/synthetic_tests/protocols.h>
#include <slipstep/synthetic_tests/start_model.h>
#include <slipstep/utilities/text.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "../experiment/point_run.h"

using namespace SlipStep;
using namespace SlipStep::Planting;
using namespace SlipStep::Testing;

namespace
{
  /// A base with an effect, and the same as parameters of the law.
  struct Twin
  {
    TrueContact contact;
    Parameters  parameters;
  };

  Twin make_twin(const std::string &effect, const double amplitude)
  {
    Random random(7);
    Twin   twin;
    twin.contact = draw_base(random);
    const std::vector<TruthParameter> added =
      hidden_effect(effect, Formula::catalogue)
        .add(twin.contact, amplitude, random);
    std::string effects = "subloading, overstress, softening";
    if (effects.find(effect) == std::string::npos && effect != "compliance")
      effects += ", " + effect;
    twin.parameters = point_parameters({{"Friction/Effects", effects}});
    for (const auto &parameters : {base_parameters(twin.contact), added})
      for (const TruthParameter &parameter : parameters)
        twin.parameters.set(parameter.name,
                            exact_text(parameter.value) +
                              (parameter.unit.empty() ? "" : " ") +
                              parameter.unit,
                            "test");
    return twin;
  }

  /// The law's friction at the rows, without its error of first order.
  TrueFriction friction_of_law(const Parameters   &parameters,
                               const MeasuredTest &motion)
  {
    const FrictionLaw law(parameters);
    const Machine     machine(parameters);
    Replay            replay(motion);
    replay.plan(law, machine, 3e-6);
    const Replay  halved = replay.halved();
    Replay::Curve coarse, fine;
    replay.simulate(law, machine, coarse);
    halved.simulate(law, machine, fine);
    const auto extrapolated = [&](const std::vector<double> &coarse,
                                  const std::vector<double> &fine) {
      const std::vector<double> a = replay.at(coarse, motion.time);
      std::vector<double>       b = halved.at(fine, motion.time);
      for (std::size_t i = 0; i < a.size(); ++i)
        b[i] += b[i] - a[i];
      return b;
    };
    return {extrapolated(coarse.friction, fine.friction),
            extrapolated(coarse.friction_y, fine.friction_y)};
  }

  double largest_difference(const TrueFriction &a, const TrueFriction &b)
  {
    double largest = 0.;
    for (std::size_t i = 0; i < a.along_x.size(); ++i)
      largest = std::max(largest,
                         std::hypot(a.along_x[i] - b.along_x[i],
                                    a.along_y[i] - b.along_y[i]));
    return largest;
  }
} // namespace



TEST(Planting, AgreesWithTheLaw)
{
  Random                random(3);
  std::vector<Protocol> protocols = draw_protocols(n_protocols, 1, random);
  // A jump and a ramp of pressure, and a slide at 45 degrees.
  const std::vector<Protocol> later = draw_protocols(n_protocols, 2, random);
  for (const std::size_t i : {4, 10, 11})
    protocols.push_back(later[i]);
  for (const HiddenEffectKind &effect : hidden_effects(Formula::catalogue))
    {
      const Twin twin = make_twin(effect.name, 0.05);
      for (const Protocol &protocol : protocols)
        {
          const MeasuredTest motion = motion_of(protocol);
          const TrueFriction law    = friction_of_law(twin.parameters, motion);
          const double scale = twin.contact.coefficient.static_coefficient;
          EXPECT_LT(largest_difference(simulate(twin.contact, motion, 1e-7),
                                       law),
                    2e-4 * scale)
            << effect.name << ", " << protocol.name;
          // As campaigns are made: a twentieth of the white noise.
          EXPECT_LT(largest_difference(simulate(twin.contact, motion), law),
                    5e-4 * scale)
            << effect.name << ", " << protocol.name;
        }
    }
}
