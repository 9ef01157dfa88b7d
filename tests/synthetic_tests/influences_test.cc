// SPDX-License-Identifier: LGPL-2.1-or-later

// Every hidden effect: nothing at amplitude zero, and otherwise a change where
// it should show.

#include <slipstep/synthetic_tests/protocols.h>
#include <slipstep/synthetic_tests/start_model.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace SlipStep;
using namespace SlipStep::Planting;

namespace
{
  const TrueContact &base()
  {
    static const TrueContact contact = []() {
      Random random(11);
      return draw_base(random);
    }();
    return contact;
  }

  TrueContact with_effect(const std::string &name,
                          const Formula      formula,
                          const double       amplitude)
  {
    Random      random(5);
    TrueContact contact = base();
    hidden_effect(name, formula).add(contact, amplitude, random);
    return contact;
  }

  const double p = 5.8;

  Protocol slides(const std::vector<Leg> &legs,
                  const double            pressure = p,
                  double                  angle    = 0.)
  {
    return {"", pressure, angle, legs};
  }

  // Friction along the motion at the last row of every leg.
  std::vector<double> ends(const TrueContact &contact, const Protocol &protocol)
  {
    const MeasuredTest  motion   = motion_of(protocol);
    const TrueFriction  friction = simulate(contact, motion);
    std::vector<double> result;
    double              time = 0.;
    std::size_t         row  = 0;
    for (const Leg &leg : protocol.legs)
      {
        time += leg.duration;
        while (row + 1 < motion.time.size() &&
               motion.time[row] < time * (1. - 1e-12))
          ++row;
        result.push_back(protocol.angle == 90. ? friction.along_y[row] :
                                                 friction.along_x[row]);
      }
    return result;
  }

  // Relative changes of it by the effect.
  std::vector<double> changes(const std::string &name,
                              const Formula      formula,
                              const Protocol    &protocol,
                              const double       amplitude = 0.05)
  {
    const auto without = ends(base(), protocol);
    auto       with    = ends(with_effect(name, formula, amplitude), protocol);
    for (std::size_t i = 0; i < with.size(); ++i)
      with[i] = with[i] / without[i] - 1.;
    return with;
  }

  const std::vector<Formula> of_catalogue = {Formula::catalogue,
                                             Formula::alternative};

  const Leg slow{0.01, 1000., p}, middle{0.2, 60., p}, fast{8., 3., p};
} // namespace



TEST(HiddenEffects, NothingAtAmplitudeZero)
{
  Random                      random(2);
  const std::vector<Protocol> protocols = draw_protocols(8, 1, random);
  for (const Formula formula : {Formula::catalogue,
                                Formula::alternative,
                                Formula::third,
                                Formula::outside})
    for (const HiddenEffectKind &effect : hidden_effects(formula))
      {
        // Without these the base is another one.
        if (effect.name == "overstress" || effect.name == "softening")
          continue;
        const TrueContact contact = with_effect(effect.name, formula, 0.);
        for (const Protocol &protocol : protocols)
          {
            const MeasuredTest motion = motion_of(protocol);
            const TrueFriction a      = simulate(base(), motion),
                               b      = simulate(contact, motion);
            for (std::size_t i = 0; i < motion.time.size(); ++i)
              ASSERT_NEAR(std::hypot(a.along_x[i] - b.along_x[i],
                                     a.along_y[i] - b.along_y[i]),
                          0.,
                          1e-4)
                << effect.name << ' ' << to_string(formula) << ' '
                << protocol.name << " row " << i;
          }
      }
}



TEST(HiddenEffects, EveryEffectChangesSomething)
{
  Random                      random(2);
  const std::vector<Protocol> protocols = draw_protocols(14, 1, random);
  for (const Formula formula : {Formula::catalogue,
                                Formula::alternative,
                                Formula::third,
                                Formula::outside})
    for (const HiddenEffectKind &effect : hidden_effects(formula))
      {
        TrueContact contact = with_effect(effect.name, formula, 0.05);
        contact.progress    = 1.;
        double largest      = 0.;
        for (const Protocol &protocol : protocols)
          {
            const MeasuredTest motion = motion_of(protocol);
            const TrueFriction a      = simulate(base(), motion),
                               b      = simulate(contact, motion);
            for (std::size_t i = 0; i < motion.time.size(); ++i)
              {
                ASSERT_TRUE(std::isfinite(b.along_x[i]));
                largest = std::max(largest,
                                   std::hypot(a.along_x[i] - b.along_x[i],
                                              a.along_y[i] - b.along_y[i]));
              }
          }
        EXPECT_GT(largest, 5e-4) << effect.name << ' ' << to_string(formula);
      }
}



// Signatures over speed.
TEST(HiddenEffects, Speed)
{
  const Protocol steps = slides({middle, slow, fast});
  for (const Formula formula : of_catalogue)
    {
      const auto stribeck = changes("stribeck", formula, steps, 0.03);
      EXPECT_GT(stribeck[1], 0.015) << "slow speeds are high";
      EXPECT_LT(stribeck[2], 0.5 * stribeck[1]);
      const auto viscous = changes("viscous", formula, steps);
      EXPECT_LT(std::abs(viscous[1]), 1e-3);
      EXPECT_GT(viscous[2], 0.02) << "grows with the speed";
      const auto levels = ends(with_effect("overstress", formula, 0.05), steps);
      EXPECT_NEAR(levels[2] / levels[1], 1.05, 0.01);
    }
}



// Of steady sliding, little of a direct effect of 5 % is left.
TEST(HiddenEffects, PairsNearlyHideEachOther)
{
  const Protocol steps = slides({middle, slow, fast});
  for (const char *const state : {"ageing", "slip_law"})
    {
      const auto levels = ends(with_effect(std::string("overstress+") + state,
                                           Formula::joint,
                                           0.05),
                               steps);
      EXPECT_NEAR(levels[2] / levels[1], 1.01, 0.015) << state;
    }
  // What the drag adds at the end of a fast slide, heat takes away.
  const auto heated =
    changes("viscous+heating", Formula::joint, slides({slow, fast}));
  EXPECT_NEAR(heated[1], 0., 0.025);
  const auto low = [&](const double pressure) {
    return changes("adhesion+pressure",
                   Formula::joint,
                   slides({{0.2, 60., pressure}}))[0];
  };
  EXPECT_NEAR(low(1.5), low(20.), 0.02);
  EXPECT_LT(low(5.8), low(1.5));
}



// Signatures over pressure.
TEST(HiddenEffects, Pressure)
{
  for (const Formula formula : of_catalogue)
    {
      const auto at = [&](const std::string &name, const double pressure) {
        return changes(name,
                       formula,
                       slides({{0.2, 60., pressure}}, pressure))[0];
      };
      EXPECT_NEAR(at("pressure", 5.8), 0., 1e-3);
      EXPECT_NEAR(at("pressure", 20.), -0.05, 5e-3);
      EXPECT_GT(at("pressure", 1.5), 0.03);
      EXPECT_LT(at("shear_cap", 20.), -0.02) << "only high pressure bends";
      EXPECT_GT(at("shear_cap", 1.5), -1e-3);
      EXPECT_NEAR(at("adhesion", 1.5), 0.05, 5e-3) << "low pressure rises";
      EXPECT_LT(at("adhesion", 20.), 0.01);
    }
}



// What goes with slip, time and heat.
TEST(HiddenEffects, MemoryOfRestsAndSlip)
{
  for (const Formula formula : of_catalogue)
    {
      // Right after the rest and long after it.
      const Protocol rest =
        slides({middle, {0., 1000., p}, {0.2, 0.1, p}, {0.2, 60., p}});
      const auto healing = changes("healing", formula, rest);
      EXPECT_GT(healing[2], 0.01);
      EXPECT_LT(std::abs(healing[3]), 0.3 * healing[2]) << "slip erases it";

      const auto heating =
        changes("heating",
                formula,
                slides({fast, {8., 10., p}, {0., 300., p}, {8., 0.01, p}}));
      EXPECT_LT(heating[1], heating[0]) << "falls inside a fast run";
      EXPECT_LT(heating[1], -0.01);
      EXPECT_GT(heating[3], 0.2 * heating[1]) << "recovers in a pause";

      const auto run_in =
        changes("run_in",
                formula,
                slides({{0.2, 20., p}, {0.2, 200., p}, {0., 300., p}, middle}));
      EXPECT_GT(std::abs(run_in[1]), 1.5 * std::abs(run_in[0]));
      EXPECT_GE(std::abs(run_in[3]), std::abs(run_in[1])) << "does not recover";

      const auto level = ends(with_effect("softening", formula, 0.05),
                              slides({{0.2, 0.5, p}, {0.2, 300., p}}));
      EXPECT_LT(level[1], level[0]);
    }
}



// Directions, and the flanks of a soft machine.
TEST(HiddenEffects, DirectionsAndFlanks)
{
  for (const Formula formula : of_catalogue)
    {
      const auto back =
        changes("direction", formula, slides({middle, {-0.2, 60., p}, middle}));
      EXPECT_NEAR(back[0], 0., 1e-4);
      EXPECT_NEAR(std::abs(back[1]), 0.05, 0.01);
      EXPECT_NEAR(back[2], 0., 1e-4);
      EXPECT_NEAR(changes("anisotropy", formula, slides({middle}))[0],
                  0.,
                  1e-4);
      EXPECT_NEAR(
        std::abs(changes("anisotropy", formula, slides({middle}, p, 90.))[0]),
        0.05,
        5e-3);
      const auto flank = changes("compliance",
                                 formula,
                                 slides({{0.2, 0.05, p}, {0.2, 100., p}}));
      EXPECT_LT(flank[0], -0.02);
      EXPECT_NEAR(flank[1], 0., 1e-3);
    }
}
