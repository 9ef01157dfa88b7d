// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/report/diagnosis_report.h>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <limits>

#include "tests/report/synthetic_diagnosis.h"
#include "tests/temporary_folder.h"

using namespace SlipStep;

namespace
{
  nlohmann::json written(const Diagnosis &diagnosis)
  {
    const auto file = test_folder() / "diagnosis.json";
    write_diagnosis_json(file, Parameters(), diagnosis);
    EXPECT_FALSE(std::filesystem::exists(file.string() + ".part"));
    std::ifstream in(file);
    return nlohmann::json::parse(in);
  }

  void has_exactly(const nlohmann::json           &part,
                   const std::vector<std::string> &keys)
  {
    for (const auto &key : keys)
      EXPECT_TRUE(part.contains(key)) << key;
    EXPECT_EQ(part.size(), keys.size()) << part.dump(2).substr(0, 300);
  }
} // namespace



// Scripts read these keys: a change here is a change for them.
TEST(DiagnosisJson, TheBlocksAreTheDocumentedOnes)
{
  const auto object = written(SyntheticDiagnosis::named());
  has_exactly(object,
              {"schema",
               "version",
               "git_hash",
               "case",
               "seeds",
               "data",
               "start_model",
               "noise",
               "gap",
               "where",
               "verdict",
               "candidates",
               "not_testable",
               "new_model",
               "shrink",
               "next_test",
               "fe_check",
               "budget",
               "warnings"});
  EXPECT_EQ(object["schema"], "slipstep/diagnosis/1");
  EXPECT_EQ(object["seeds"], (std::vector<int>{1}));
  has_exactly(
    object["data"],
    {"tests", "conditions", "replicate_pairs", "samples", "hash", "outliers"});
  has_exactly(object["data"]["tests"][0],
              {"name", "condition", "file", "rows", "outlier"});
  has_exactly(object["start_model"], {"effects", "parameters"});
  has_exactly(object["noise"][0],
              {"name", "value", "unit", "source", "interval95"});
  has_exactly(object["gap"],
              {"status",
               "p",
               "p_smooth",
               "p_replicates",
               "p_together",
               "p_track",
               "excess",
               "rms_percent",
               "noise_floor_percent"});
  has_exactly(object["where"][0],
              {"covariate",
               "unit",
               "share",
               "range",
               "sign",
               "wavelength",
               "phases",
               "tests"});
  has_exactly(object["budget"],
              {"candidates",
               "refits",
               "draws",
               "cut_short",
               "level",
               "confidence",
               "wall_s",
               "cpu_s"});
}



TEST(DiagnosisJson, WhatAFormulaLacksHasItsKeys)
{
  const auto object = written(SyntheticDiagnosis::incomplete());
  const auto lacks  = object["verdict"]["formulas_not_quite_right"];
  ASSERT_EQ(lacks.size(), 1u);
  has_exactly(lacks[0], {"effect", "words", "covariate", "factor", "gain"});
  EXPECT_EQ(lacks[0]["effect"], "overstress");
  EXPECT_TRUE(object["verdict"]["incomplete"]);
  EXPECT_EQ(object["verdict"]["remainder_where"][0]["covariate"], "pressure");
}



TEST(DiagnosisJson, TheKeysOfTheResultAreTheDocumentedOnes)
{
  const auto object = written(SyntheticDiagnosis::named());
  has_exactly(object["verdict"],
              {"status",
               "headline",
               "effects",
               "ambiguous_with",
               "rival_of",
               "withdrawn",
               "look_alike",
               "incomplete",
               "worth_little",
               "remainder_where",
               "formulas_not_quite_right",
               "explained_share",
               "remainder_p",
               "would_overturn"});
  has_exactly(object["candidates"][0],
              {"effect",
               "status",
               "score",
               "p",
               "gain",
               "left_out_gain",
               "minimum_detectable_percent",
               "testable",
               "at_bound",
               "parameters"});
  for (const auto &parameter : {object["candidates"][0]["parameters"][0],
                                object["start_model"]["parameters"][0]})
    has_exactly(parameter,
                {"name",
                 "path",
                 "value",
                 "interval95",
                 "unit",
                 "before",
                 "at_bound",
                 "profile"});
  has_exactly(object["not_testable"][0], {"effect", "why", "cheapest_test"});
  has_exactly(object["new_model"], {"prm", "added", "correction"});
  has_exactly(object["shrink"],
              {"unit",
               "fitted",
               "left_out",
               "systematic",
               "noise_floor",
               "per_test",
               "steps"});
  has_exactly(object["shrink"]["per_test"][0],
              {"name", "fitted", "left_out", "noise"});
  has_exactly(object["shrink"]["steps"][0], {"label", "rms", "objective"});
  has_exactly(object["next_test"],
              {"words", "programme", "separates", "distance"});
  has_exactly(
    object["fe_check"][0],
    {"test", "block_percent", "point_percent", "difference_percent", "remark"});
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
  has_exactly(correction, {"covariate", "formula", "share"});
  EXPECT_EQ(correction["covariate"], "speed");
  EXPECT_EQ(correction["share"], 0.62);
}
