// SPDX-License-Identifier: LGPL-2.1-or-later

// The numbers of prm/identify_flat_surface/README.md.

#include "../solid/block_test_tools.h"

#include <slipstep/calibration/calibrate.h>
#include <slipstep/measured_data/measured_test.h>

#include <gtest/gtest.h>

#include <cmath>
#include <map>

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  const std::string folder =
    std::string(SLIPSTEP_SOURCE_DIR) + "/prm/identify_flat_surface/";

  const char *const speeds[] = {"1", "10", "50", "200"}; // mm/min

  double eq_4(const double speed)
  {
    return 4.20e-3 * std::log(speed) + 0.100;
  }

  /// A file of the case; of its variants the one named.
  Parameters the_case(const std::string &file, const std::string &variant = "")
  {
    const Parameters parameters =
      make_parameters({}, "identify_flat_surface/" + file);
    for (const Variant &one : parameters.variants())
      if (one.label == variant)
        return parameters.with_variant(one);
    EXPECT_TRUE(parameters.variants().empty() && variant.empty()) << variant;
    return parameters;
  }

  std::map<std::string, FittedParameter> by_path(const Calibration &found)
  {
    std::map<std::string, FittedParameter> result;
    for (const FittedParameter &fitted : found.parameters)
      result[fitted.parameter.path] = fitted;
    return result;
  }

  const std::string viscosity = "Friction/overstress/Viscosity";
  const std::string exponent  = "Friction/overstress/Exponent";

  bool holds(const FittedParameter &fitted, const double value)
  {
    return fitted.lower <= value && value <= fitted.upper;
  }
} // namespace



// r within 1 % at the four speeds, from eq. 4 alone.
TEST(IdentifyFlatSurface, RatioOfThePaperFromEquation4)
{
  const Parameters  parameters = the_case("levels.prm", "mu_k0 held");
  const Calibration found      = calibrate(parameters);
  const FrictionLaw law(fitted_case(parameters, found));
  // Table 3.
  const FrictionLaw printed(parameters);
  const double      ratio[] = {1.2806, 1.4080, 1.4942, 1.5652};
  for (unsigned int i = 0; i < 4; ++i)
    {
      const double speed = std::stod(speeds[i]);
      const double r     = law.steady_ratio(speed / 60.);
      EXPECT_NEAR(r, ratio[i], 2e-4);
      EXPECT_NEAR(r / (eq_4(speed) / 0.078), 1., 2e-3);
      EXPECT_NEAR(r / printed.steady_ratio(speed / 60.), 1., 1e-2);
    }
  auto parameter = by_path(found);
  EXPECT_NEAR(parameter[viscosity].value, 9600., 50.);
  EXPECT_NEAR(parameter[exponent].value, 15.79, 0.02);
  EXPECT_TRUE(holds(parameter[viscosity], 1.15e4));
  // Table 3 lies below eq. 4, and its exponent just outside.
  EXPECT_FALSE(holds(parameter[exponent], 16.52));
  EXPECT_NEAR(parameter[exponent].upper, 16.34, 0.03);
  EXPECT_TRUE(found.weak.empty());
}



// mu_k0 and eta_v cannot both be found from these speeds.
TEST(IdentifyFlatSurface, TheThirdTrap)
{
  const Calibration found = calibrate(the_case("levels.prm", "mu_k0 fitted"));
  ASSERT_EQ(found.weak.size(), 1u);
  EXPECT_LT(found.correlation[0][1], -0.995);
  auto parameter = by_path(found);
  EXPECT_TRUE(holds(parameter["Friction/Static coefficient"], 0.078));
  EXPECT_TRUE(holds(parameter[viscosity], 1.15e4));
  EXPECT_TRUE(holds(parameter[exponent], 16.52));
  EXPECT_GT(parameter[viscosity].upper / parameter[viscosity].lower, 50.);
}



TEST(IdentifyFlatSurface, OnlyTheProductOfKappaAndA)
{
  const Calibration held = calibrate(the_case("softening.prm", "a held"));
  auto              rate = by_path(held)["Friction/softening/Rate"];
  EXPECT_TRUE(holds(rate, 0.045));
  EXPECT_NEAR(rate.value, 0.0450, 2e-4);
  EXPECT_LT(rate.upper - rate.lower, 0.003);
  EXPECT_TRUE(held.weak.empty());

  const Calibration both = calibrate(the_case("softening.prm", "a fitted"));
  auto              parameter = by_path(both);
  rate                        = parameter["Friction/softening/Rate"];
  EXPECT_GT(rate.upper / rate.lower, 1000.);
  EXPECT_TRUE(parameter["Friction/softening/Steepness"].is_lower_open);
  EXPECT_FALSE(both.weak.empty());
  ASSERT_EQ(both.derived.size(), 1u);
  EXPECT_NEAR(both.derived[0].value, 0.045, 2. * both.derived[0].deviation);
  EXPECT_LT(both.derived[0].deviation, 0.003);
}



TEST(IdentifyFlatSurface, PlantedConstantsAreInTheirIntervals)
{
  const Parameters  parameters = the_case("planted.prm");
  const Calibration found      = calibrate(parameters);
  ASSERT_EQ(found.parameters.size(), 5u);
  for (const FittedParameter &fitted : found.parameters)
    EXPECT_TRUE(holds(fitted, parameters.number(fitted.parameter.path)))
      << fitted.parameter.path;
  EXPECT_NEAR(found.inflation, 1., 0.1);
  // 447; 727 with derivatives at every point of a line search.
  EXPECT_LT(found.n_simulations, 600u);
  const FrictionLaw law(fitted_case(parameters, found)), printed(parameters);
  for (const char *speed : speeds)
    {
      const double v = std::stod(speed) / 60.;
      EXPECT_NEAR(law.steady_ratio(v) / printed.steady_ratio(v), 1., 2e-3);
    }
}



// The shipped records are those of the formulas they name.
TEST(IdentifyFlatSurface, RecordsAreWhatTheySay)
{
  for (const std::string speed : speeds)
    {
      const std::string file =
        std::string(3 - speed.size(), '0') + speed + "_mm-min.csv";
      for (const double friction :
           read_measured_test(folder + "levels/" + file).friction)
        EXPECT_NEAR(friction, eq_4(std::stod(speed)), 1e-8);
    }
  const MeasuredTest exact =
    read_measured_test(folder + "softening/noise_0.csv");
  const double r = 1.279251720308073, mu_s = 0.115 / r, mu_k = 0.098 / r;
  for (std::size_t i = 0; i < exact.time.size(); ++i)
    EXPECT_NEAR(exact.friction[i] / r,
                mu_k - std::log1p(std::expm1(mu_k - mu_s) *
                                  std::exp(-0.045 * exact.displacement[i])),
                2e-9);
}
