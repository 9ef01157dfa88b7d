// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/report/calibration_report.h>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <limits>

#include "tests/report/synthetic_calibration.h"
#include "tests/temporary_folder.h"

using namespace SlipStep;

namespace
{
  nlohmann::json written(const Calibration &calibration)
  {
    const auto file = test_folder() / "calibration.json";
    write_calibration_json(file, Parameters(), calibration);
    EXPECT_FALSE(std::filesystem::exists(file.string() + ".part"));
    std::ifstream in(file);
    return nlohmann::json::parse(in);
  }
} // namespace



// Scripts read these keys: a change here is a change for them.
TEST(CalibrationJson, TheKeysAreTheDocumentedOnes)
{
  const auto object      = written(SyntheticCalibration::make());
  const auto has_exactly = [](const nlohmann::json          &part,
                              const std::vector<std::string> keys) {
    for (const auto &key : keys)
      EXPECT_TRUE(part.contains(key)) << key;
    EXPECT_EQ(part.size(), keys.size());
  };
  has_exactly(object, {"version",     "git_hash",       "case",
                       "confidence",  "parameters",     "derived",
                       "tests",       "correlation",    "weak_directions",
                       "starts",      "misfit",         "start_misfit",
                       "rows",        "effective_rows", "inflation",
                       "simulations", "steps",          "wall_s",
                       "cpu_s",       "warnings"});
  has_exactly(object["parameters"][0],
              {"path",
               "unit",
               "value",
               "start",
               "lower_bound",
               "upper_bound",
               "scale",
               "deviation",
               "interval",
               "at_bound",
               "constraint",
               "profile"});
  has_exactly(object["parameters"][0]["interval"],
              {"lower", "upper", "lower_open", "upper_open"});
  has_exactly(object["derived"][0], {"name", "formula", "value", "deviation"});
  has_exactly(object["tests"][0],
              {"name",
               "condition",
               "file",
               "rows",
               "noise",
               "noise_stated",
               "rms",
               "start_rms",
               "mean",
               "correlation_length",
               "measured_work",
               "simulated_work"});
  has_exactly(object["weak_directions"][0], {"parameters", "change", "words"});
  has_exactly(object["starts"][0],
              {"start", "end", "misfit", "iterations", "message"});
}



TEST(CalibrationJson, NumbersComeBackToTheLastBit)
{
  Calibration calibration                     = SyntheticCalibration::make();
  calibration.parameters[0].value             = 1. / 3.;
  calibration.tests[0].measured_work          = 1e300 / 3.;
  calibration.parameters[1].profile[2].second = 2. / 3.;

  const auto object = written(calibration);
  EXPECT_EQ(object["parameters"][0]["value"], 1. / 3.);
  EXPECT_EQ(object["tests"][0]["measured_work"], 1e300 / 3.);
  EXPECT_EQ(object["parameters"][1]["profile"][2][1], 2. / 3.);
  EXPECT_EQ(object["parameters"][0]["profile"].size(),
            calibration.parameters[0].profile.size());
  EXPECT_EQ(object["correlation"][0][2], -0.93);
  EXPECT_EQ(object["tests"][0]["name"], "slow <a> & \"b\"");
  EXPECT_EQ(object["parameters"][0]["scale"], "logarithmic");
  EXPECT_EQ(object["parameters"][1]["scale"], "linear");
  EXPECT_TRUE(object["parameters"][2]["interval"]["upper_open"]);
  EXPECT_FALSE(object["parameters"][2]["interval"]["lower_open"]);
}



TEST(CalibrationJson, AWeakDirectionNamesItsMembersWithTheirChanges)
{
  const auto weak = written(SyntheticCalibration::make())["weak_directions"][0];
  EXPECT_EQ(weak["parameters"],
            (std::vector<std::string>{"Friction/overstress/Reference speed",
                                      "Friction/softening/Rate"}));
  EXPECT_EQ(weak["change"], (std::vector<double>{1.48, -0.05}));
}



TEST(CalibrationJson, AnglesAreInDegrees)
{
  constexpr double pi = 3.14159265358979323846;
  Calibration      calibration;
  calibration.parameters = {SyntheticCalibration::parameter(
    "Friction/anisotropy/Angle", Dimension::angle, false, pi / 6., pi / 180.)};
  calibration.weak       = {{{pi / 4.}, {0}, "any angle"}};
  const auto object      = written(calibration);
  const auto parameter   = object["parameters"][0];
  EXPECT_EQ(parameter["unit"], "deg");
  EXPECT_NEAR(parameter["value"], 30., 1e-12);
  EXPECT_NEAR(parameter["deviation"], 1., 1e-12);
  EXPECT_NEAR(parameter["interval"]["lower"], 28.2, 1e-12);
  EXPECT_NEAR(parameter["upper_bound"], 90., 1e-12);
  EXPECT_NEAR(parameter["profile"][12][0], 30., 1e-12);
  EXPECT_NEAR(object["weak_directions"][0]["change"][0], 45., 1e-12);
}



TEST(CalibrationJson, WhatIsNotFiniteIsNull)
{
  Calibration calibration             = SyntheticCalibration::make();
  calibration.parameters[2].deviation = std::numeric_limits<double>::infinity();
  calibration.misfit                  = std::nan("");
  const auto object                   = written(calibration);
  EXPECT_TRUE(object["parameters"][2]["deviation"].is_null());
  EXPECT_TRUE(object["misfit"].is_null());
  EXPECT_TRUE(object["starts"][4]["misfit"].is_null());
  EXPECT_TRUE(object["starts"][4]["end"].empty());
}
