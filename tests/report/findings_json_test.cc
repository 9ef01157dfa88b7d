// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/report/calibration_report.h>
#include <slipstep/report/diagnosis_report.h>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "tests/report/synthetic_calibration.h"
#include "tests/report/synthetic_diagnosis.h"
#include "tests/temporary_folder.h"

using namespace SlipStep;

namespace
{
  template <typename Findings>
  nlohmann::json written(void (*write)(const std::filesystem::path &,
                                       const Parameters &,
                                       const Findings &),
                         const Findings &findings)
  {
    const auto file = test_folder() / "findings.json";
    write(file, Parameters(), findings);
    EXPECT_FALSE(std::filesystem::exists(file.string() + ".part"));
    std::ifstream in(file);
    return nlohmann::json::parse(in);
  }

  nlohmann::json written(const Calibration &calibration)
  {
    return written(write_calibration_json, calibration);
  }

  nlohmann::json written(const Diagnosis &diagnosis)
  {
    return written(write_diagnosis_json, diagnosis);
  }

  /// @param keys separated by blanks
  void has_exactly(const nlohmann::json &part, const std::string &keys)
  {
    std::istringstream in(keys);
    std::size_t        n = 0;
    for (std::string key; in >> key; ++n)
      EXPECT_TRUE(part.contains(key)) << key;
    EXPECT_EQ(part.size(), n) << part.dump(2).substr(0, 300);
  }
} // namespace



// Scripts read these keys: a change here is a change for them.
TEST(CalibrationJson, TheKeysAreTheDocumentedOnes)
{
  const auto object = written(SyntheticCalibration::make());
  has_exactly(object,
              "version git_hash case confidence parameters derived tests "
              "correlation weak_directions starts misfit start_misfit "
              "rows effective_rows inflation simulations steps wall_s "
              "cpu_s warnings");
  has_exactly(object["parameters"][0],
              "path unit value start lower_bound upper_bound scale "
              "deviation interval at_bound constraint profile");
  has_exactly(object["parameters"][0]["interval"],
              "lower upper lower_open upper_open");
  has_exactly(object["derived"][0], "name formula value deviation");
  has_exactly(object["tests"][0],
              "name condition file rows noise noise_stated rms start_rms "
              "mean correlation_length measured_work simulated_work");
  has_exactly(object["weak_directions"][0], "parameters change words");
  has_exactly(object["starts"][0], "start end misfit iterations message");
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



TEST(DiagnosisJson, TheBlocksAreTheDocumentedOnes)
{
  const auto object = written(SyntheticDiagnosis::named());
  has_exactly(object,
              "schema version git_hash case seeds data start_model noise "
              "gap where verdict candidates not_testable new_model shrink "
              "next_test fe_check budget warnings");
  EXPECT_EQ(object["schema"], "slipstep/diagnosis/1");
  EXPECT_EQ(object["seeds"], (std::vector<int>{1}));
  has_exactly(object["data"],
              "tests conditions replicate_pairs samples hash outliers");
  has_exactly(object["data"]["tests"][0], "name condition file rows outlier");
  has_exactly(object["start_model"], "effects parameters");
  has_exactly(object["noise"][0], "name value unit source interval95");
  has_exactly(object["gap"],
              "status p p_smooth p_replicates p_together p_track excess "
              "rms_percent noise_floor_percent");
  has_exactly(object["where"][0],
              "covariate unit share range sign wavelength phases tests");
  has_exactly(object["budget"],
              "candidates refits draws cut_short level confidence wall_s "
              "cpu_s");
}



TEST(DiagnosisJson, WhatAFormulaLacksHasItsKeys)
{
  const auto object = written(SyntheticDiagnosis::incomplete());
  const auto lacks  = object["verdict"]["formulas_not_quite_right"];
  ASSERT_EQ(lacks.size(), 1u);
  has_exactly(lacks[0], "effect words covariate factor gain");
  EXPECT_EQ(lacks[0]["effect"], "overstress");
  EXPECT_TRUE(object["verdict"]["incomplete"]);
  EXPECT_EQ(object["verdict"]["remainder_where"][0]["covariate"], "pressure");
}



TEST(DiagnosisJson, TheKeysOfTheResultAreTheDocumentedOnes)
{
  const auto object = written(SyntheticDiagnosis::named());
  has_exactly(
    object["verdict"],
    "status decided headline effects ambiguous_with rival_of withdrawn "
    "look_alike incomplete worth_little remainder_where "
    "formulas_not_quite_right explained_share remainder_p "
    "would_overturn");
  has_exactly(object["candidates"][0],
              "effect status score p gain left_out_gain "
              "minimum_detectable_percent testable at_bound parameters");
  for (const auto &parameter : {object["candidates"][0]["parameters"][0],
                                object["start_model"]["parameters"][0]})
    has_exactly(parameter,
                "name path value interval95 unit before at_bound profile");
  has_exactly(object["not_testable"][0], "effect why cheapest_test");
  has_exactly(object["new_model"], "prm added parameters correction");
  has_exactly(object["shrink"],
              "unit fitted left_out systematic noise_floor per_test steps");
  has_exactly(object["shrink"]["per_test"][0], "name fitted left_out noise");
  has_exactly(object["shrink"]["steps"][0], "label rms objective");
  has_exactly(object["next_test"], "words programme separates distance");
  has_exactly(object["fe_check"][0],
              "test block_percent point_percent difference_percent remark");
}



TEST(DiagnosisJson, EveryVerdictHasItsName)
{
  const auto status = [](const Diagnosis &diagnosis) {
    return written(diagnosis)["verdict"]["status"];
  };
  EXPECT_EQ(status(SyntheticDiagnosis::named()), "named");
  EXPECT_EQ(status(SyntheticDiagnosis::ambiguous()), "ambiguous");
  EXPECT_EQ(status(SyntheticDiagnosis::unnamed()), "unnamed");
  EXPECT_EQ(status(SyntheticDiagnosis::no_gap()), "no_gap");
  EXPECT_EQ(status(SyntheticDiagnosis::not_testable()), "not_testable");
}



TEST(DiagnosisJson, NumbersComeBackToTheLastBit)
{
  Diagnosis diagnosis                         = SyntheticDiagnosis::named();
  diagnosis.candidates[0].parameters[0].value = 1. / 3.;
  diagnosis.candidates[0].parameters[0].profile[2] = {2. / 3., 1e300 / 3.};
  diagnosis.shrink.noise_floor                     = 0.0123;
  const auto object                                = written(diagnosis);
  const auto parameter = object["candidates"][0]["parameters"][0];
  EXPECT_EQ(parameter["value"], 1. / 3.);
  EXPECT_EQ(parameter["profile"][2][0], 2. / 3.);
  EXPECT_EQ(parameter["profile"][2][1], 1e300 / 3.);
  EXPECT_NEAR(object["shrink"]["noise_floor"], 1.23, 1e-12);
  EXPECT_EQ(object["data"]["tests"][0]["name"], "slow <a> & \"b\"");
  EXPECT_EQ(object["noise"][0]["interval95"],
            (std::vector<double>{0.0081, 0.0086}));
}



TEST(DiagnosisJson, WhatIsNotFiniteOrOpenOrAbsentIsNull)
{
  const auto object = written(SyntheticDiagnosis::named());
  const auto effect = object["candidates"][0];
  EXPECT_TRUE(effect["parameters"][0]["before"].is_null());
  EXPECT_TRUE(effect["parameters"][1]["interval95"][1].is_null());
  EXPECT_TRUE(effect["parameters"][1]["interval95"][0].is_number());
  EXPECT_TRUE(object["candidates"][2]["gain"].is_null());
  EXPECT_EQ(object["candidates"][8]["effect"], "anisotropy");
  EXPECT_TRUE(object["candidates"][8]["minimum_detectable_percent"].is_null());
  EXPECT_TRUE(object["new_model"]["correction"].is_null());
  EXPECT_EQ(object["not_testable"].size(), 2u);

  const auto nothing = written(Diagnosis());
  EXPECT_TRUE(nothing["next_test"].is_null());
  EXPECT_TRUE(nothing["candidates"].is_array());
  EXPECT_TRUE(nothing["where"].is_array());
}



TEST(DiagnosisJson, TheCorrectionOfAnUnknownCauseIsThere)
{
  const auto correction =
    written(SyntheticDiagnosis::unnamed())["new_model"]["correction"];
  has_exactly(correction, "covariate formula share");
  EXPECT_EQ(correction["covariate"], "speed");
  EXPECT_EQ(correction["share"], 0.62);
}
