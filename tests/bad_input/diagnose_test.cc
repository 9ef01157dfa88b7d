// SPDX-License-Identifier: LGPL-2.1-or-later

// What slipstep diagnose refuses, and what it makes of poor tests.

#include <slipstep/friction/effect.h>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <iomanip>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "slipstep_process.h"

namespace
{
  namespace fs = std::filesystem;

  // A campaign in which nothing is missing: tests 1 and 3, 2 and 6, 9 and 10
  // are replicates; 1 and 3 go to and fro, 2 and 6 are made across.
  class Diagnose : public testing::Test
  {
  protected:
    void plant(const std::vector<std::string> &options = {}) const
    {
      std::vector<std::string> arguments = {
        "plant", "campaign", "--class", "none", "--seed", "3", "--quiet"};
      if (options.empty())
        arguments.insert(arguments.end(), {"--tests", "10"});
      arguments.insert(arguments.end(), options.begin(), options.end());
      const auto result = process.run(arguments);
      ASSERT_EQ(result.exit_code, 0) << result.err;
    }

    SlipstepProcess::Result
    diagnose(const std::vector<std::string> &settings = {},
             const std::vector<std::string> &options  = {},
             const std::string &case_file = "campaign/case.prm") const
    {
      std::vector<std::string> arguments = {"diagnose",
                                            case_file,
                                            "--output",
                                            "found"};
      std::string              all;
      for (const std::string &setting : settings)
        {
          all += setting;
          arguments.insert(arguments.end(), {"--set", setting});
        }
      for (const std::string setting :
           {"Diagnosis/Element tests=none", "Diagnosis/Draws=299"})
        if (all.find(setting.substr(0, setting.find('='))) == std::string::npos)
          arguments.insert(arguments.end(), {"--set", setting});
      arguments.insert(arguments.end(), options.begin(), options.end());
      return process.run(arguments);
    }

    std::set<fs::path> files() const
    {
      std::set<fs::path> result;
      for (const auto &entry :
           fs::recursive_directory_iterator(process.folder()))
        result.insert(entry.path());
      return result;
    }

    void
    expect_refusal(const std::vector<std::string> &settings,
                   const std::vector<std::string> &words,
                   const std::string &case_file = "campaign/case.prm") const
    {
      const std::set<fs::path> before = files();
      const auto               result = diagnose(settings, {}, case_file);
      EXPECT_EQ(result.exit_code, 2) << result.err;
      EXPECT_EQ(result.n_error_lines(), 1u) << result.err;
      for (const std::string &word : words)
        EXPECT_TRUE(contains(result.err, word));
      EXPECT_EQ(files(), before) << words[0];
    }

    // Runs to the end and leaves all its files.
    nlohmann::json verdict_of(const SlipstepProcess::Result &result) const
    {
      EXPECT_EQ(result.exit_code, 0) << result.err;
      for (const char *name : {"diagnosis.json", "report.html", "improved.prm"})
        EXPECT_TRUE(fs::exists(process.folder() / "found" / name)) << name;
      const auto json =
        nlohmann::json::parse(process.read("found/diagnosis.json"),
                              nullptr,
                              false);
      EXPECT_FALSE(json.is_discarded());
      return json;
    }

    // Nothing is named, nor is anything said to be as good as a name.
    void expect_no_name(const nlohmann::json &json) const
    {
      EXPECT_TRUE(json["verdict"]["effects"].empty()) << json["verdict"];
      EXPECT_TRUE(json["verdict"]["ambiguous_with"].empty()) << json["verdict"];
    }

    static std::string headline(const nlohmann::json &json)
    {
      return json["verdict"]["headline"];
    }

    // Multiply friction; or, if the factor is 0, let it be 0.1 throughout.
    void change_friction(const std::string &name, const double factor) const
    {
      std::istringstream in(process.read("campaign/measured/" + name));
      std::ostringstream out;
      out << std::setprecision(9);
      for (std::string line; std::getline(in, line);)
        {
          if (std::isdigit(line[0]) == 0)
            {
              out << line << '\n';
              continue;
            }
          std::istringstream columns(line);
          unsigned int       column = 0;
          for (std::string text; std::getline(columns, text, ','); ++column)
            {
              out << (column == 0 ? "" : ",");
              if (column == 3 || column == 5)
                out << (factor == 0. ? 0.1 : factor * std::stod(text));
              else
                out << text;
            }
          out << '\n';
        }
      process.write("campaign/measured/" + name, out.str());
    }

    void remove_test(const std::string &name) const
    {
      fs::remove(process.folder() / "campaign/measured" / name);
    }

    const SlipstepProcess process;
  };
} // namespace



TEST_F(Diagnose, WhatIsWrongWithTheCaseIsSaid)
{
  plant();
  expect_refusal({"Diagnosis/Candidates=heeling"},
                 {"Diagnosis/Candidates", "'heeling'", "'healing'"});
  expect_refusal({"Diagnosis/Candidates=healing, all"}, {"'all' stands alone"});
  expect_refusal({"Diagnosis/Candidates=healing, healing"},
                 {"'healing' is given twice"});
  expect_refusal({"Diagnosis/Candidates="}, {"name effects, or 'all'"});
  expect_refusal({"Diagnosis/Level=0.5"}, {"Diagnosis/Level", "0.3"});
  expect_refusal({"Diagnosis/Level=3 mm"}, {"Diagnosis/Level"});
  expect_refusal({"Diagnosis/Levle=0.05"},
                 {"Diagnosis/Levle", "did you mean Diagnosis/Level?"});
  expect_refusal({"Diagnosis/Most effects=5"}, {"1 to 4"});
  expect_refusal({"Diagnosis/Draws=10"}, {"Diagnosis/Draws", "99"});
  expect_refusal({"Diagnosis/Level=0.001", "Diagnosis/Draws=999"},
                 {"Diagnosis/Draws", "0.001", "8999"});
  expect_refusal({"Diagnosis/Draws=223"}, {"Diagnosis/Draws", "0.04", "224"});
  // The starting model has a flow rule.
  expect_refusal({"Diagnosis/Candidates=overstress, softening"},
                 {"none of these can be tried",
                  "overstress: it is in the model already"});
  expect_refusal({"Diagnosis/Gain=0"}, {"Diagnosis/Gain", "greater than 0"});
  expect_refusal({"Calibration/Tests=nowhere"}, {"there is no", "nowhere"});
  // What is wrong is found by slipstep check, too.
  const auto check = process.run(
    {"check", "campaign/case.prm", "--set", "Diagnosis/Candidates=heeling"});
  EXPECT_EQ(check.exit_code, 2);
  EXPECT_TRUE(contains(check.err, "'healing'"));
}



TEST_F(Diagnose, AnElementTestThatDoesNotExist)
{
  plant();
  expect_refusal({"Diagnosis/Element tests=test_99.csv"},
                 {"Diagnosis/Element tests",
                  "there is no test 'test_99.csv'",
                  "did you mean test_09.csv?"});
  expect_refusal({"Diagnosis/Element tests=Worst"}, {"did you mean worst?"});
  expect_refusal({"Diagnosis/Element tests="}, {"'worst' or 'none'"});
  expect_refusal({"Diagnosis/Element tests=worst, worst"},
                 {"'worst' stands alone"});
}



TEST_F(Diagnose, ASweepIsNotDiagnosed)
{
  plant();
  process.write("sweep.prm",
                "include campaign/case.prm\n"
                "subsection Sweep\nset Key = Loading/Speed\n"
                "set Values = 1 mm/min, 2 mm/min\nend\n");
  expect_refusal({},
                 {"slipstep diagnose", "--variant \"1 mm/min\""},
                 "sweep.prm");
}



TEST_F(Diagnose, ReplicatesThatWereMadeDifferently)
{
  plant();
  // Test 5 is made of slides and rests, test 4 is one slide.
  std::string       text  = process.read("campaign/measured/test_05.csv");
  const std::string slide = process.read("campaign/measured/test_04.csv");
  const auto        line  = [](const std::string &of) {
    const std::size_t begin = of.find("# condition:");
    return of.substr(begin, of.find('\n', begin) - begin);
  };
  text.replace(text.find(line(text)), line(text).size(), line(slide));
  process.write("campaign/measured/test_05.csv", text);
  expect_refusal({}, {"test_05.csv", "test_04.csv", "condition", "replicates"});
}



TEST_F(Diagnose, WhatItWritesCanBeUsed)
{
  plant();
  const auto json = verdict_of(diagnose({}, {"--quiet"}));
  EXPECT_EQ(json["verdict"]["status"], "no_gap");
  expect_no_name(json);
  EXPECT_EQ(json["data"]["replicate_pairs"], 3);
  const std::string first = process.read("found/diagnosis.json");
  const auto        point = process.run(
    {"point", "found/improved.prm", "--output", "point", "--quiet"});
  EXPECT_EQ(point.exit_code, 0) << point.err;
  // Its results may be replaced, other files not.
  const auto again = diagnose({}, {"--quiet"});
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(again.out, "");
  EXPECT_EQ(again.err, "");
  const auto of = [](const std::string &text) {
    return nlohmann::json::parse(text)["candidates"];
  };
  EXPECT_EQ(of(process.read("found/diagnosis.json")), of(first));
  const std::set<fs::path> before  = files();
  const auto               foreign = process.run({"diagnose",
                                                  "campaign/case.prm",
                                                  "--output",
                                                  "campaign/measured",
                                                  "--set",
                                                  "Diagnosis/Element tests=none",
                                                  "--set",
                                                  "Diagnosis/Draws=299"});
  EXPECT_EQ(foreign.exit_code, 2) << foreign.err;
  EXPECT_EQ(foreign.n_error_lines(), 1u) << foreign.err;
  EXPECT_EQ(files(), before);
}



TEST_F(Diagnose, OneTestOnly)
{
  plant();
  const auto result = diagnose({"Calibration/Tests=measured/test_04.csv"});
  const auto json   = verdict_of(result);
  expect_no_name(json);
  EXPECT_EQ(headline(json).find("Judged by the stated noise"), 0u)
    << headline(json);
  EXPECT_EQ(json["data"]["replicate_pairs"], 0);
  EXPECT_TRUE(
    contains(json["verdict"]["would_overturn"].dump(), "no replicates"));
  // Of one slide nothing can be told about pressure.
  for (const auto &candidate : json["candidates"])
    EXPECT_FALSE(candidate["effect"] == "pressure" &&
                 candidate["testable"].get<bool>());
}



TEST_F(Diagnose, NothingIsLeftOutOfOneCondition)
{
  plant();
  for (const char *name : {"02", "04", "05", "06", "07", "08", "09", "10"})
    remove_test(std::string("test_") + name + ".csv");
  const auto result = diagnose();
  const auto json   = verdict_of(result);
  expect_no_name(json);
  EXPECT_EQ(json["data"]["replicate_pairs"], 1);
  EXPECT_TRUE(contains(json["verdict"]["would_overturn"].dump(),
                       "All tests have one and the same condition"));
  // A model fitted to no test at all predicts nothing.
  EXPECT_FALSE(contains(result.out, "conditions left out of the fit"));
}



TEST_F(Diagnose, WithoutReplicates)
{
  plant({"--tests", "10", "--no-replicates"});
  const auto json = verdict_of(diagnose());
  expect_no_name(json);
  EXPECT_EQ(headline(json).find("Judged by the stated noise"), 0u)
    << headline(json);
  for (const auto &component : json["noise"])
    EXPECT_EQ(component["source"], "stated");
}



TEST_F(Diagnose, FrictionThatDoesNotChange)
{
  plant();
  // Of slides one way only; elsewhere the sign would have to change.
  for (const char *name : {"01", "02", "03", "06"})
    remove_test(std::string("test_") + name + ".csv");
  for (const char *name : {"04", "05", "07", "08", "09", "10"})
    change_friction(std::string("test_") + name + ".csv", 0.);
  const auto result = diagnose();
  const auto json   = verdict_of(result);
  expect_no_name(json);
  EXPECT_TRUE(contains(result.err, "hardly any noise is visible"));
  // What is "possible" makes it better.
  for (const auto &candidate : json["candidates"])
    EXPECT_FALSE(candidate["gain"].is_number() &&
                 candidate["gain"].get<double>() < 0.)
      << candidate;
}



// All effects that a law may have beside others, none of which does anything.
TEST_F(Diagnose, NothingIsLeftToAdd)
{
  plant();
  // Those that a law has alone in their place, and those that are fitted.
  std::string              effects  = "subloading, overstress, softening, "
                                      "anisotropy";
  std::vector<std::string> settings = {"Friction/anisotropy/Ratio=1"};
  for (const auto &[name, info] : SlipStep::effect_registry())
    if (info.slot == SlipStep::ExclusiveSlot::none && name != "softening")
      {
        effects += ", " + name;
        for (const auto &[key, value] : info.neutral_settings)
          settings.push_back("Friction/" + name + "/" + key + "=" +
                             (key == info.search.amplitude ? "1e-9" : value));
      }
  settings.insert(
    settings.end(),
    {"Friction/Effects=" + effects,
     "Calibration/Parameters=Friction/Static coefficient from "
     "0.02 to 0.5; Friction/Tangential stiffness from 100 to 1e4; "
     "Friction/softening/Kinetic coefficient from 0.02 to 0.5; "
     "Friction/subloading/Rate from 1 to 1e4 log; "
     "Friction/softening/Rate from 0.001 to 10 log; "
     "Friction/overstress/Viscosity from 1 to 1e6 log; "
     "Friction/overstress/Exponent from 4 to 80"});
  const auto json = verdict_of(diagnose(settings));
  expect_no_name(json);
  for (const auto &candidate : json["candidates"])
    EXPECT_FALSE(candidate["testable"].get<bool>()) << candidate;
  EXPECT_TRUE(json["verdict"]["status"] == "not_testable" ||
              json["verdict"]["status"] == "unnamed")
    << json["verdict"];
}



// Gains differ by some 0.6 % from test to test; this one's by 8 %.
TEST_F(Diagnose, ATestThatItsReplicateContradicts)
{
  plant({"--tests", "20"});
  // The other one is test 14.
  change_friction("test_12.csv", 1.08);
  const auto json = verdict_of(diagnose());
  expect_no_name(json);
  EXPECT_EQ(json["verdict"]["status"], "no_gap");
  ASSERT_EQ(json["data"]["outliers"].size(), 1u) << json["data"];
  EXPECT_EQ(json["data"]["outliers"][0]["test"], "test 12");
  EXPECT_TRUE(contains(headline(json), "look at 'test 12' first"));
}



TEST_F(Diagnose, ACopyIsNoRepetition)
{
  plant();
  process.write("campaign/measured/copy.csv",
                "# name: copy\n" +
                  process.read("campaign/measured/test_04.csv"));
  const auto json = verdict_of(diagnose());
  ASSERT_EQ(json["data"]["outliers"].size(), 1u) << json["data"];
  const std::string words = json["data"]["outliers"][0]["words"];
  EXPECT_TRUE(contains(words, "same rows"));
  expect_no_name(json);
}



TEST_F(Diagnose, TestsOfOneNameAreToldApart)
{
  plant();
  for (const char *name : {"test_04.csv", "test_05.csv"})
    {
      std::string text = process.read("campaign/measured/" + std::string(name));
      const std::size_t begin = text.find("# name:");
      text.replace(begin, text.find('\n', begin) - begin, "# name: slide");
      process.write("campaign/measured/" + std::string(name), text);
    }
  const auto            json = verdict_of(diagnose());
  std::set<std::string> names;
  for (const auto &test : json["shrink"]["per_test"])
    names.insert(test["name"]);
  EXPECT_EQ(names.size(), 10u) << json["shrink"]["per_test"];
  EXPECT_EQ(names.count("slide (measured/test_04.csv)"), 1u);
}



// One that is wrong and has no replicate is no outlier by itself; but it is
// said that everything hangs on it.
TEST_F(Diagnose, ATestThatMakesTheGapAlone)
{
  plant({"--tests", "20"});
  change_friction("test_05.csv", 1.2);
  const auto json = verdict_of(diagnose());
  expect_no_name(json);
  ASSERT_EQ(json["data"]["outliers"].size(), 1u) << json["data"];
  EXPECT_EQ(json["data"]["outliers"][0]["test"], "test 05");
  const std::string words = json["data"]["outliers"][0]["words"];
  EXPECT_TRUE(contains(words, "nothing is found to be missing"));
}



TEST_F(Diagnose, FrictionWithFewDigits)
{
  plant();
  for (const char *name : {"test_04.csv", "test_05.csv"})
    {
      std::istringstream in(
        process.read("campaign/measured/" + std::string(name)));
      std::ostringstream out;
      for (std::string line; std::getline(in, line);)
        {
          const std::size_t comma = line.rfind(',');
          if (std::isdigit(line[0]) == 0)
            out << line << '\n';
          else
            out << line.substr(0, comma + 1)
                << 0.01 * std::lround(100. * std::stod(line.substr(comma + 1)))
                << '\n';
        }
      process.write("campaign/measured/" + std::string(name), out.str());
    }
  const auto json = verdict_of(diagnose());
  EXPECT_TRUE(contains(json["warnings"].dump(), "rounded to steps of 0.01"))
    << json["warnings"];
}



// The range of a parameter may be a guess.
TEST_F(Diagnose, AParameterThatEndsAtItsBound)
{
  plant();
  const auto json =
    verdict_of(diagnose({"Calibration/Parameters=Friction/Static coefficient "
                         "from 0.02 to 0.06",
                         "Diagnosis/Most time=5",
                         "Friction/Static coefficient=0.05",
                         "Friction/softening/Kinetic coefficient=0.04"}));
  EXPECT_TRUE(contains(json["warnings"].dump(),
                       "Friction/Static coefficient of the starting model is "
                       "at its bound 0.06"))
    << json["warnings"];
}



// Half a fit shows a gap that may be none.
TEST_F(Diagnose, TimeThatIsOverBeforeTheFirstFit)
{
  plant();
  const auto result = diagnose({"Diagnosis/Most time=1e-3 s"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_TRUE(contains(result.err,
                       "Diagnosis/Most time = 1e-3 s was over before the "
                       "starting model was fitted"))
    << result.err;
  EXPECT_FALSE(fs::exists(process.folder() / "found" / "improved.prm"));
}



// Only healing was asked for, is named, and the improved case lacks no more.
TEST_F(Diagnose, AnImprovedCaseIsDiagnosedAgain)
{
  const auto planted = process.run({"plant",
                                    "campaign",
                                    "--effect",
                                    "healing",
                                    "--seed",
                                    "3",
                                    "--tests",
                                    "10",
                                    "--quiet"});
  ASSERT_EQ(planted.exit_code, 0) << planted.err;
  const auto named = verdict_of(diagnose({"Diagnosis/Candidates=healing"}));
  EXPECT_EQ(named["verdict"]["effects"][0], "healing");
  fs::rename(process.folder() / "found", process.folder() / "first");
  const auto again = verdict_of(diagnose({}, {}, "first/improved.prm"));
  EXPECT_EQ(again["verdict"]["status"], "no_gap");
}
