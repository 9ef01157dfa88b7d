// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include "tests/law_library/parsed_law.h"
#include "tests/temporary_folder.h"

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



// Steps as long as the waves of the surface end at the same place in one: what
// they pass over is dissipated all the same, mu p L over whole waves.
TEST(LawLibraryStep, DissipationHasWhatPassesInBetween)
{
  const double length = 10.;
  for (const unsigned int n_steps : {1u, 5u, 10u, 1000u})
    {
      ParsedLaw point("set Static coefficient = 0.2\n"
                      "set Tangential stiffness = 1e4\n"
                      "set Effects = texture\n"
                      "subsection texture\n"
                      "set Amplitude = 0.5\n"
                      "set Wavelength = 2 mm\n"
                      "end\n");
      move(point, point.state, {0., 0.}, 1.);
      move(point, point.state, {length, 0.}, 10., n_steps);
      for (int i = 0; i < slipstep_state_size(point.law); ++i)
        if (slipstep_state_name(point.law, i) ==
            std::string("dissipation_MPa_mm"))
          EXPECT_NEAR(point.state[i], strength * length, 0.005 * length)
            << n_steps << " steps";
    }
}



#ifdef SLIPSTEP_ABAQUS_DRIVER
namespace
{
  /// Components after a turn of what has these before.
  Vector turned(const Vector &vector, const double angle)
  {
    const double c = std::cos(angle), s = std::sin(angle);
    return {c * vector[0] - s * vector[1], s * vector[0] + c * vector[1]};
  }

  /// Traction, both columns of its derivative by slip, that by pressure.
  using Answer = std::array<Vector, 4>;

  /// In directions that are turned from those of an answer.
  Answer turned(const Answer &answer, const double angle)
  {
    const Vector x = turned(answer[1], angle), y = turned(answer[2], angle);
    const double c = std::cos(angle), s = std::sin(angle);
    return {turned(answer[0], angle),
            Vector{c * x[0] - s * y[0], c * x[1] - s * y[1]},
            Vector{s * x[0] + c * y[0], s * x[1] + c * y[1]},
            turned(answer[3], angle)};
  }

  /// A random path of a point in directions that stay, written as it is seen in
  /// directions that do not.
  std::vector<Answer> random_path(const ParsedLaw &point, std::ostream &seen)
  {
    std::mt19937                     engine(5);
    std::uniform_real_distribution<> random(-1., 1.);
    std::vector<double>              state = point.state;
    std::vector<Answer>              answers;
    double                           angle = 0.;
    seen.precision(17);
    for (unsigned int i = 0; i < 200; ++i)
      {
        // Small cycles and large ones, where the point is open at times. Angles
        // count from when it first touches.
        const double size     = i % 20 < 10 ? 1e-4 : 2e-3;
        const Vector slip     = {size * (random(engine) + 0.3),
                                 size * random(engine)};
        const double pressure = i % 50 == 49 ? 0. : 5. + random(engine);
        const double turn     = i == 0 ? 0. : random(engine);
        double       d_slip[4];
        char         message[300];
        Answer       answer;
        EXPECT_EQ(slipstep_step(point.law,
                                state.data(),
                                slip.data(),
                                pressure,
                                0.1,
                                state.data(),
                                answer[0].data(),
                                d_slip,
                                answer[3].data(),
                                message,
                                sizeof(message)),
                  0)
          << message;
        answer[1] = {d_slip[0], d_slip[2]};
        answer[2] = {d_slip[1], d_slip[3]};
        angle += turn;
        answers.push_back(turned(answer, angle));
        const Vector way = turned(slip, angle);
        seen << 0.1 << ' ' << way[0] << ' ' << way[1] << ' ' << pressure << ' '
             << turn << '\n';
      }
    return answers;
  }



  // From the increments of the test's folder to its stresses.
  int drive(const std::size_t depvar)
  {
    return std::system(("cd " + test_folder().string() + " && " +
                        SLIPSTEP_ABAQUS_DRIVER + " . SLIPSTEP " +
                        std::to_string(depvar) + " 2 < increments > stresses")
                         .c_str());
  }
} // namespace



// A host may turn the slip directions from increment to increment: stress,
// tangent and all that is remembered are those of the same path in directions
// that stay, seen from where they are.
TEST(UserSubroutine, ItFollowsTheAxesOfTheSurface)
{
  const std::string text =
    "set Static coefficient = 0.2\nset Tangential stiffness = 1e4\n"
    "set Effects = subloading, overstress, elastic_core, anisotropy, "
    "direction, texture, expression\n"
    "subsection elastic_core\nset Rate = 300\nset Limit = 0.7\nend\n"
    "subsection anisotropy\nset Ratio = 0.6\nset Angle = 30\nend\n"
    "subsection direction\nset Change = 0.3\nset Forward angle = 70\nend\n"
    "subsection texture\nset Amplitude = 0.2\nset Wavelength = 0.01\n"
    "set Angle = 20\nend\n"
    "subsection expression\nset Covariate = position\n"
    "set Formula = 1 + 10*x\nset From = -0.05\nset To = 0.1\nend\n";
  ParsedLaw point(text);
  std::ofstream(test_folder() / "slipstep.prm") << "subsection Friction\n"
                                                << text << "end\n";

  std::ofstream             seen(test_folder() / "increments");
  const std::vector<Answer> exact = random_path(point, seen);
  seen.close();
  ASSERT_EQ(drive(point.state.size() + 1), 0);
  std::ifstream stresses(test_folder() / "stresses");
  double        largest = 0.;
  for (const Answer &answer : exact)
    for (unsigned int part = 0; part < 6; ++part)
      {
        Vector told = {};
        ASSERT_TRUE(stresses >> told[0] >> told[1]);
        if (part > 3)
          continue; // the energies and the slip
        const double error = distance(told, answer[part]) * strength;
        // Derivatives are differences over a millionth of what matters.
        ASSERT_LT(error,
                  part == 0 ? 1e-9 :
                  part == 3 ? 1e-3 :
                              1e-3 * stiffness)
          << &answer - exact.data() << ' ' << part;
        if (part == 0)
          largest = std::max(largest, error);
      }
  std::cout << "largest difference " << largest << " MPa" << std::endl;
}



// What goes in is stored or dissipated, and what is no slip goes back: with a
// stiffness of alpha_t rho^2 along the weak axis, and a core that stores, too.
TEST(UserSubroutine, ItBalancesEnergyAndSlip)
{
  constexpr double ratio = 0.5, tangential_stiffness = 100.;
  for (const std::string effect : {"anisotropy", "elastic_core"})
    {
      const bool        is_core = effect == "elastic_core";
      const std::string text =
        "set Static coefficient = 0.2\nset Tangential stiffness = 100\n"
        "set Effects = subloading, overstress, " +
        effect + "\nsubsection " + effect +
        (is_core ? "\nset Rate = 300\nset Limit = 0.7\nend\n" :
                   "\nset Ratio = 0.5\nend\n");
      ParsedLaw point(text);
      std::ofstream(test_folder() / "slipstep.prm") << "subsection Friction\n"
                                                    << text << "end\n";
      // A circle, and back a little without slip.
      std::ofstream       increments(test_folder() / "increments");
      constexpr int       n_turning = 8000, n_back = 200;
      Vector              all = {};
      std::vector<Vector> motions;
      for (int i = 0; i < n_turning + n_back; ++i)
        {
          const double angle = 4. * std::acos(0.) * i / n_turning;
          const double size  = i < n_turning ? 1e-4 : -1e-6;
          motions.push_back({size * std::cos(angle), size * std::sin(angle)});
          increments << "1e-3 " << motions.back()[0] << ' ' << motions.back()[1]
                     << " 5 0\n";
        }
      increments.close();
      ASSERT_EQ(drive(point.state.size() + 1), 0);
      std::ifstream stresses(test_folder() / "stresses");
      double        work = 0., dissipated = 0., stored = 0.;
      Vector        before = {}, slip = {};
      for (const Vector &motion : motions)
        {
          double row[12];
          for (double &value : row)
            ASSERT_TRUE(stresses >> value);
          for (unsigned int i = 0; i < 2; ++i)
            {
              work += 0.5 * (row[i] + before[i]) * motion[i];
              before[i] = row[i];
              all[i] += motion[i];
              slip[i] += row[10 + i];
            }
          dissipated += row[8];
          stored = row[9];
        }
      EXPECT_GT(stored, 0.005) << effect;
      EXPECT_NEAR(work, dissipated + stored, 2e-4) << effect;
      for (unsigned int i = 0; i < 2; ++i)
        EXPECT_NEAR(all[i] - slip[i],
                    before[i] / (tangential_stiffness *
                                 (i == 1 && !is_core ? ratio * ratio : 1.)),
                    1e-6)
          << effect;
    }
}
#endif
