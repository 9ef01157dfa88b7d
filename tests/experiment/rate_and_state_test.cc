// SPDX-License-Identifier: LGPL-2.1-or-later

// a, b and D_c as the law itself answers a step of speed.

#include <gtest/gtest.h>

#include <slipstep/experiment/rate_and_state.h>
#include <slipstep/experiment/stability.h>

#include <cmath>

#include "point_run.h"

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  // With an effect that neither a nor b has in the closed form of the others.
  Settings rate_and_state_law(const std::string &evolution,
                              const std::string &other = "")
  {
    const std::string section = "Friction/" + evolution + "/";
    const Settings    others  = {{"adhesion/Strength", "0.3 MPa"},
                                 {"expression/Formula", "1 - 0.03*x"},
                                 {"stribeck/Rise", "0.3"},
                                 {"anisotropy/Ratio", "2"},
                                 {"anisotropy/Angle", "90 deg"}};
    Settings          result  = {
                {"Friction/Effects",
                 "subloading, overstress, " + evolution +
                   (other.empty() ? "" : ", " + other)},
                {"Friction/Static coefficient", "0.1"},
                {"Friction/Tangential stiffness", "1e6 MPa/mm"},
                {section + "Growth", "0.1"},
                {section + "Time", "0.05 s"},
                {section + (evolution == "ageing" ? "Renewal length" : "Slip length"),
                 "0.02 mm"},
                {"Loading/Programme",
                 "press 5 MPa in 1 s; slide 0.3 mm/s for 1 mm; slide 0.3 mm/s for "
                           "1 mm; slide 30 mm/s for 1 mm"}};
    for (const auto &[key, value] : others)
      if (!other.empty() && key.rfind(other, 0) == 0)
        result.emplace_back("Friction/" + key, value);
    return result;
  }
} // namespace



TEST(RateAndState, IsWhatAStepOfSpeedShows)
{
  const double D_c = 0.02, up = 1.1;
  for (const auto &[evolution, other] :
       std::vector<std::pair<std::string, std::string>>{
         {"ageing", ""},
         {"slip_law", ""},
         {"ageing", "adhesion"},
         {"ageing", "stribeck"},
         {"ageing", "anisotropy"},
         {"slip_law", "expression"}})
    {
      const Parameters parameters =
        point_parameters(rate_and_state_law(evolution, other));
      const FrictionLaw law(parameters);
      const auto        readings =
        rate_and_state(parameters, law, parse_programme(parameters));
      ASSERT_EQ(readings.size(), 2u);
      for (const RateAndState &reading : readings)
        {
          EXPECT_EQ(reading.length, D_c);
          const double         p = reading.pressure;
          dealii::Tensor<1, 2> slow, fast;
          slow[0] = reading.speed / std::sqrt(up);
          fast[0] = reading.speed * std::sqrt(up);
          const SteadySliding before(law, slow, p), after(law, fast, p);
          EXPECT_NEAR((after.friction() - before.friction()) / std::log(up),
                      reading.a - reading.b,
                      5e-3 * reading.b);

          // The jump: after so little slip that the state is still the old one.
          ContactState       state = before.state();
          const unsigned int n     = 200;
          const double       slip  = 1e-3 * D_c / n;
          for (unsigned int i = 0; i < n; ++i)
            {
              ContactState         end;
              dealii::Tensor<1, 2> increment;
              increment[0] = slip;
              law.update(state, increment, p, slip / fast[0], end);
              state = end;
            }
          EXPECT_NEAR((state.traction[0] / p - before.friction()) /
                        std::log(up),
                      reading.a,
                      5e-3 * (std::abs(reading.a) + reading.b))
            << evolution << " " << other << " " << reading.in_words();
          fast *= 10. / std::sqrt(up);
          EXPECT_NEAR(reading.friction_faster,
                      SteadySliding(law, fast, p).friction(),
                      1e-6);
        }
    }
}



TEST(RateAndState, OtherLawsHaveNoReading)
{
  for (const std::string effects :
       {"subloading, overstress, softening", "overstress, ageing, slip_law"})
    {
      const Parameters parameters = point_parameters(
        {{"Friction/Effects", effects},
         {"Loading/Programme", "press 5 MPa in 1 s; slide 1 mm/s for 1 mm"}});
      EXPECT_TRUE(rate_and_state(parameters,
                                 FrictionLaw(parameters),
                                 parse_programme(parameters))
                    .empty());
    }
}
