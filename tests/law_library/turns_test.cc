// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include "tests/law_library/parsed_law.h"

namespace
{
  using Vector = std::array<double, 2>;

  constexpr double pressure = 5., coefficient = 0.2, stiffness = 1e4;
  constexpr double strength = coefficient * pressure;

  /// In n equal steps.
  Vector move(const ParsedLaw     &point,
              std::vector<double> &state,
              const Vector        &slip,
              const double         time,
              const unsigned int   n = 1)
  {
    const double part[2] = {slip[0] / n, slip[1] / n};
    char         message[300];
    Vector       traction = {};
    for (unsigned int i = 0; i < n; ++i)
      EXPECT_EQ(slipstep_step(point.law,
                              state.data(),
                              part,
                              pressure,
                              time / n,
                              state.data(),
                              traction.data(),
                              nullptr,
                              nullptr,
                              message,
                              sizeof(message)),
                0)
        << message;
    return traction;
  }

  double distance(const Vector &one, const Vector &other)
  {
    return std::hypot(one[0] - other[0], one[1] - other[1]) / strength;
  }

  /// Coulomb's law, from sliding along x: the elastic chord across the circle,
  /// if the turn is a right angle or more; then the angle to the slip obeys
  /// d angle / d slip = -alpha_t sin(angle) / (mu p).
  Vector exact(const double turn, double slip)
  {
    double angle = turn;
    if (std::cos(turn) < 0.)
      {
        const double chord = -2. * strength * std::cos(turn) / stiffness;
        if (slip <= chord)
          return {strength + stiffness * slip * std::cos(turn),
                  stiffness * slip * std::sin(turn)};
        slip -= chord;
        angle = M_PI - turn;
      }
    const double left = 2. * std::atan(std::tan(angle / 2.) *
                                       std::exp(-stiffness * slip / strength));
    return {strength * std::cos(turn - left), strength * std::sin(turn - left)};
  }

  struct TurningLaw
  {
    std::string name, text;
    bool        is_coulomb;
  };

  class LawLibraryTurns : public testing::TestWithParam<TurningLaw>
  {};
} // namespace



// One step that turns a sliding contact, as short as its elastic slip or a
// hundred times as long.
TEST_P(LawLibraryTurns, OneStepTurnsAsManyDo)
{
  ParsedLaw point("set Static coefficient = 0.2\n"
                  "set Tangential stiffness = 1e4\n" +
                  GetParam().text);
  move(point, point.state, {0.01, 0.}, 0.1, 100);

  std::mt19937                     engine(11);
  std::uniform_real_distribution<> share(0., 1.);
  double                           largest = 0.;
  for (unsigned int i = 0; i < 2500; ++i)
    {
      const double        turn = M_PI * share(engine);
      const double        slip = std::pow(10., -5. + 3. * share(engine));
      const Vector        way  = {slip * std::cos(turn), slip * std::sin(turn)};
      std::vector<double> whole = point.state, parts = point.state;
      const Vector        one   = move(point, whole, way, 0.1);
      const Vector        truth = GetParam().is_coulomb ?
                                    exact(turn, slip) :
                                    move(point, parts, way, 0.1, 100);
      largest                   = std::max(largest, distance(one, truth));
      ASSERT_LT(distance(one, truth), 2e-3)
        << i << ": " << slip << " mm at " << turn / M_PI * 180. << " deg";
    }
  std::cout << "largest difference " << largest << " of the strength"
            << std::endl;
}

INSTANTIATE_TEST_SUITE_P(
  OfLaws,
  LawLibraryTurns,
  testing::Values(
    TurningLaw{"coulomb", "set Effects =\n", true},
    TurningLaw{"softening_of_rate_zero",
               "set Effects = softening\n"
               "subsection softening\nset Rate = 0\n"
               "set Kinetic coefficient = 0.1\nend\n",
               true},
    TurningLaw{"softening",
               "set Effects = softening\n"
               "subsection softening\nset Rate = 100\n"
               "set Kinetic coefficient = 0.15\nend\n",
               false},
    TurningLaw{"stiff_overstress",
               "set Effects = overstress\n"
               "subsection overstress\nset Viscosity = 1e-3\n"
               "set Exponent = 100\nend\n",
               false},
    TurningLaw{"anisotropy",
               "set Effects = anisotropy\n"
               "subsection anisotropy\nset Ratio = 0.7\nset Angle = 30\nend\n",
               false},
    TurningLaw{"subloading", "set Effects = subloading\n", false},
    TurningLaw{"subloading_overstress",
               "set Effects = subloading, overstress\n",
               false}),
  [](const auto &info) { return info.param.name; });
