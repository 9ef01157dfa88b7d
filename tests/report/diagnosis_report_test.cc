// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/report/diagnosis_report.h>

#include <slipstep/report/run_report.h>
#include <slipstep/report/text_table.h>
#include <slipstep/utilities/text.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>

#include "tests/report/synthetic_diagnosis.h"
#include "tests/report/page_text.h"

using namespace SlipStep;

namespace
{
  std::string page_of(const Diagnosis          &diagnosis,
                      std::vector<std::string> *warnings = nullptr)
  {
    Parameters parameters;
    declare_report_parameters(parameters);
    const auto said =
      write_diagnosis_report(test_folder(), parameters, diagnosis);
    if (warnings != nullptr)
      *warnings = said;
    return sound_page();
  }

  /// What is seen without scrolling: up to the first section.
  std::string first_screen_of(const Diagnosis &diagnosis)
  {
    const std::string page  = page_of(diagnosis);
    const std::size_t begin = page.find("<body>");
    const std::size_t cards = page.rfind("<div class='card'>");
    return page.substr(begin, page.find("\n<h2>", cards) - begin);
  }

  const std::string percent = "\u00a0%";
} // namespace



TEST(DiagnosisHeadline, ItNamesWhatIsMissingWithTheNumbers)
{
  Diagnosis diagnosis = SyntheticDiagnosis::named();
  EXPECT_EQ(headline(diagnosis),
            "Overstress is missing (friction that rises with sliding speed): "
            "with it the gap to the measurements falls from 4.91 % to 1.04 % "
            "of friction (noise alone: 1.01 %; beyond it 4.80 % → 0.25 %), "
            "under conditions left out of the fit from 5.13 % to 1.09 %.");
  diagnosis.effects.push_back("healing");
  EXPECT_TRUE(contains(headline(diagnosis),
                       "Overstress and healing are missing (overstress: "));
}



// A wave without a name was taken for noise.
TEST(DiagnosisHeadline, ItTellsANoiseThatWasTooLarge)
{
  Diagnosis diagnosis          = SyntheticDiagnosis::named();
  diagnosis.shrink.noise_floor = 0.0202;
  EXPECT_TRUE(contains(headline(diagnosis),
                       "(noise alone: less than the 2.02 % assumed; "))
    << headline(diagnosis);
  EXPECT_TRUE(contains(page_of(diagnosis), "Dashed: the assumed noise"));
  diagnosis.shrink.fitted_after = 0.019;
  EXPECT_TRUE(contains(headline(diagnosis), "(noise alone: 2.02 %; "));
}



TEST(DiagnosisHeadline, ANameThatExplainsLittleIsWorthLittle)
{
  Diagnosis diagnosis                = SyntheticDiagnosis::named();
  diagnosis.shrink.systematic_before = 0.0116;
  diagnosis.shrink.systematic_after  = 0.0103;
  for (const bool is_incomplete : {false, true})
    {
      diagnosis.is_incomplete = is_incomplete;
      EXPECT_TRUE(contains(headline(diagnosis), "the verdict is worth little"))
        << headline(diagnosis);
    }
  diagnosis.is_incomplete           = false;
  diagnosis.shrink.systematic_after = 0.001;
  EXPECT_FALSE(contains(headline(diagnosis), "worth little"));
}



// By what whole tests differ by, which weighs little.
TEST(DiagnosisHeadline, APlainGapThatGrowsDoesNotFall)
{
  Diagnosis diagnosis            = SyntheticDiagnosis::named();
  diagnosis.shrink.fitted_before = 0.0118;
  diagnosis.shrink.fitted_after  = 0.0125;
  const std::string text         = headline(diagnosis);
  EXPECT_TRUE(contains(text, "the plain gap grows from 1.18 % to 1.25 %"))
    << text;
  EXPECT_TRUE(contains(text, "of gain or zero, mask the improvement")) << text;
  EXPECT_FALSE(contains(text, "falls")) << text;
  EXPECT_TRUE(contains(page_of(diagnosis), "How the plain gap changed"));
}



TEST(DiagnosisHeadline, WhatOnlyLooksLikeAnEffectComesFirst)
{
  Diagnosis diagnosis  = SyntheticDiagnosis::named();
  diagnosis.look_alike = LookAlike{LookAlike::Kind::load_zero, 0.1};
  EXPECT_EQ(headline(diagnosis).find(
              "A zero of the sensor, 0.1 MPa of load, explains these tests "
              "as well: "),
            0u)
    << headline(diagnosis);
  EXPECT_TRUE(
    contains(headline(diagnosis), " If it is not, overstress is missing"))
    << headline(diagnosis);
  EXPECT_TRUE(contains(page_of(diagnosis), "or a zero of the sensor"));
}



TEST(DiagnosisHeadline, AFormulaAndARestAreTold)
{
  const Diagnosis diagnosis = SyntheticDiagnosis::incomplete();
  EXPECT_TRUE(
    contains(headline(diagnosis),
             "; the formula of overstress is not quite right: a "
             "factor that depends on log10 speed completes it, and its "
             "parameters are valid with that factor only; not all of it is "
             "explained: the rest shows most under pressures of 12 "
             "… 20 MPa in high pressure."))
    << headline(diagnosis);
  EXPECT_EQ(short_verdict(diagnosis), "named, incomplete");
  has_all(diagnosis_table(diagnosis),
          {"verdict: named, incomplete – overstress",
           "0.99 + (0.02) * max(0, x - (-2))"});
  const std::string page = page_of(diagnosis);
  EXPECT_TRUE(contains(page, "The formula of overstress is not quite right"));
  EXPECT_TRUE(contains(page, "What overstress does not explain"));
  EXPECT_FALSE(
    contains(page_of(SyntheticDiagnosis::named()), "not quite right"));
}



TEST(DiagnosisHeadline, SeveralExplanationsMayLeaveARestToo)
{
  Diagnosis diagnosis     = SyntheticDiagnosis::ambiguous();
  diagnosis.is_incomplete = true;
  EXPECT_EQ(short_verdict(diagnosis), "several explanations, incomplete");
  EXPECT_TRUE(contains(headline(diagnosis), "; not all of it is explained"));
  EXPECT_TRUE(
    contains(diagnosis_table(diagnosis), "verdict: ambiguous, incomplete"));
}



TEST(DiagnosisHeadline, WithoutReplicatesItIsToned)
{
  for (Diagnosis diagnosis : {SyntheticDiagnosis::named(),
                              SyntheticDiagnosis::ambiguous(),
                              SyntheticDiagnosis::unnamed(),
                              SyntheticDiagnosis::no_gap(),
                              SyntheticDiagnosis::not_testable()})
    {
      diagnosis.n_replicate_pairs = 0;
      EXPECT_EQ(headline(diagnosis).find(diagnosis.has_gap ?
                                           "If the stated noise is right" :
                                           "Judged by the stated noise"),
                0u)
        << headline(diagnosis);
      diagnosis.n_replicate_pairs = 1;
      EXPECT_FALSE(contains(headline(diagnosis), "stated noise"));
      EXPECT_EQ(headline(diagnosis).back(), '.');
    }
}



// Seen, though not surely enough to be fitted: nobody knows whether they
// explain it.
TEST(DiagnosisHeadline, TellsWhatIsTooUnsureForAName)
{
  for (Diagnosis diagnosis :
       {SyntheticDiagnosis::unnamed(), SyntheticDiagnosis::no_gap()})
    {
      const bool        has_gap = diagnosis.has_gap;
      const std::string without = headline(diagnosis);
      EXPECT_FALSE(contains(without, "unsure")) << without;
      diagnosis.candidates = {CandidateResult(), CandidateResult()};
      for (CandidateResult &candidate : diagnosis.candidates)
        {
          candidate.standing    = Standing::not_enough;
          candidate.is_testable = true;
          candidate.p           = 0.033;
        }
      diagnosis.candidates[0].name = "viscous";
      diagnosis.candidates[1].name = "overstress";
      EXPECT_TRUE(contains(headline(diagnosis),
                           "; viscous and overstress come nearest, but not "
                           "surely enough to be named (p = 0.033 at best)"))
        << headline(diagnosis);
      EXPECT_EQ(contains(headline(diagnosis),
                         "no effect of the catalogue explains for certain"),
                has_gap);
      // Surely enough to be fitted, had there been time.
      diagnosis.is_cut_short = true;
      EXPECT_FALSE(contains(headline(diagnosis), "unsure"));
      diagnosis.is_cut_short = false;
      // What was fitted, and did not explain it, is surely not the name.
      diagnosis.candidates[0].gain = 100.;
      EXPECT_FALSE(contains(headline(diagnosis), "unsure"));
    }
}



// Whatever was found until time was over.
TEST(DiagnosisHeadline, WhatWasCutShortIsNotDecided)
{
  Diagnosis         diagnosis = SyntheticDiagnosis::named();
  const std::string decided   = headline(diagnosis);
  diagnosis.is_cut_short      = true;
  EXPECT_TRUE(contains(decided, "is missing (")) << decided;
  EXPECT_EQ(capitalised(headline(diagnosis).substr(
              std::string("Not decided, the search was cut short "
                          "(Diagnosis/Most time). So far: ")
                .size())),
            decided);
  EXPECT_TRUE(contains(first_screen_of(diagnosis),
                       "not decided, the search was cut short"));
  diagnosis.was_stopped = true;
  EXPECT_EQ(headline(diagnosis).rfind("Not decided, the search was cut short "
                                      "(Ctrl-C). So far: ",
                                      0),
            0u);
}



// That nothing explains or nothing is missing is not known of what was not
// looked at.
TEST(DiagnosisHeadline, WhatWasNotLookedAtExplainsPerhaps)
{
  for (Diagnosis diagnosis : {SyntheticDiagnosis::unnamed(),
                              SyntheticDiagnosis::no_gap(),
                              SyntheticDiagnosis::not_testable()})
    {
      diagnosis.is_cut_short = true;
      diagnosis.candidates.resize(3);
      diagnosis.candidates[0].standing = Standing::undecided;
      diagnosis.candidates[1].standing = Standing::not_tried;
      diagnosis.candidates[2].standing = Standing::not_tried;
      const std::string text           = headline(diagnosis);
      for (const char *words : {"no effect of the catalogue",
                                "none of the effects",
                                "as far as these tests can tell",
                                "cannot tell"})
        EXPECT_FALSE(contains(text, words)) << text;
      EXPECT_TRUE(contains(text,
                           "; 1 effect may be what is missing, but was not "
                           "judged; 2 effects were not examined"))
        << text;
      EXPECT_TRUE(contains(first_screen_of(diagnosis),
                           "Not decided, since the search was cut short"));
    }
}



TEST(DiagnosisHeadline, WhatRisesOrStaysIsNotSaidToFall)
{
  Diagnosis diagnosis             = SyntheticDiagnosis::named();
  diagnosis.shrink.left_out_after = 0.0922;
  EXPECT_TRUE(contains(headline(diagnosis),
                       ", but rises under conditions left out of the fit from "
                       "5.13 % to 9.22 %."));
  diagnosis.shrink.left_out_after = 0.0445;
  EXPECT_TRUE(contains(headline(diagnosis),
                       ", but hardly under conditions left out of the fit, "
                       "from 5.13 % to 4.45 %."));
  diagnosis.shrink.fitted_after = diagnosis.shrink.fitted_before;
  EXPECT_TRUE(contains(headline(diagnosis),
                       "the gap to the measurements stays 4.91 % of friction"));

  diagnosis                    = SyntheticDiagnosis::unnamed();
  diagnosis.shrink.noise_floor = 2. * diagnosis.shrink.fitted_before;
  EXPECT_TRUE(contains(headline(diagnosis), "), but not at random (p"));
}



// What rests on one test.
TEST(DiagnosisHeadline, ItTellsWhatRestsOnOneTest)
{
  Diagnosis diagnosis  = SyntheticDiagnosis::named();
  diagnosis.lone_tests = {{"overstress", "t11"}};
  EXPECT_TRUE(contains(headline(diagnosis),
                       "; without 't11', which has no replicate, the other "
                       "tests would not require overstress."));
}



TEST(DiagnosisHeadline, ItBeginsWithANumberThatIsHeldInThePlaceOfAName)
{
  Diagnosis diagnosis  = SyntheticDiagnosis::named();
  diagnosis.look_alike = {
    LookAlike::Kind::held_parameter, 1e4, "subloading/Rate", "2000", "1e4"};
  diagnosis.look_alike->instead_of = "healing";
  EXPECT_EQ(headline(diagnosis).find(
              "Subloading/Rate = 1e4 instead of the 2000 that the case holds, "
              "in the place of healing, explains these tests as well: "),
            0u)
    << headline(diagnosis);
}



// The bounds of what was added are the diagnosis' own, and stand in no case.
TEST(DiagnosisReport, ItTellsTheBoundsWhereOneIsMet)
{
  Diagnosis           diagnosis = SyntheticDiagnosis::named();
  DiagnosedParameter &parameter = diagnosis.candidates[0].parameters[0];
  EXPECT_FALSE(contains(diagnosis_table(diagnosis), "at a bound"));
  parameter.is_at_bound = true;
  parameter.least       = 1e-4;
  parameter.most        = parameter.value;
  EXPECT_TRUE(contains(diagnosis_table(diagnosis),
                       "* at a bound of the diagnosis: overstress/Viscosity "
                       "0.0001 … 0.0123"));
  diagnosis.parameters.push_back(parameter);
  EXPECT_TRUE(contains(page_of(diagnosis), "(bound: 0.0001 … 0.0123)"));
  parameter.most = 1.;
  EXPECT_TRUE(contains(diagnosis_table(diagnosis),
                       "overstress/Viscosity beyond which the law takes no"));
}



// Intervals do not know what remains.
TEST(DiagnosisReport, ItTellsThatIntervalsAreThoseOfNoise)
{
  const std::string reservation = "The intervals account for noise alone";
  EXPECT_FALSE(contains(page_of(SyntheticDiagnosis::named()), reservation));
  const Diagnosis diagnosis = SyntheticDiagnosis::incomplete();
  EXPECT_TRUE(contains(page_of(diagnosis), reservation));
  EXPECT_TRUE(contains(diagnosis_table(diagnosis), reservation));
}



// Names and remainders that noise hides in size.
TEST(DiagnosisHeadline, WhatIsSmallerThanNoiseIsSaidToBe)
{
  Diagnosis diagnosis                = SyntheticDiagnosis::incomplete();
  diagnosis.shrink.systematic_before = 0.;
  diagnosis.shrink.systematic_after  = 0.;
  has_all(headline(diagnosis),
          {"so that the gap shows by its pattern, not by its size)",
           "; what remains is no larger than noise, but has a pattern"});
  EXPECT_FALSE(contains(headline(SyntheticDiagnosis::incomplete()),
                        "no larger than noise, but has a pattern"));
}



TEST(DiagnosisHeadline, RivalsStandBesideWhatTheyReplace)
{
  Diagnosis diagnosis = SyntheticDiagnosis::ambiguous();
  has_all(headline(diagnosis),
          {"These tests do not tell what is missing, overstress "
           "or stribeck",
           "; sliding at 0.01 mm/min would tell."});
  diagnosis.effects = {"healing", "overstress"};
  EXPECT_EQ(names_text(diagnosis), "healing, and overstress or stribeck");
  diagnosis.rivals[0].instead_of.clear();
  EXPECT_EQ(names_text(diagnosis), "healing or stribeck, and overstress");
}



TEST(DiagnosisHeadline, WhatHasNoNameHasItsPlace)
{
  Diagnosis         diagnosis = SyntheticDiagnosis::unnamed();
  const std::string text      = headline(diagnosis);
  EXPECT_TRUE(contains(text, "no effect of the catalogue explains"));
  EXPECT_TRUE(contains(text, "most at speeds of 0.5 … 1.7 mm/s"));
  EXPECT_TRUE(
    contains(text, "cause unknown, reduces the difference to 2.71 %"));
  diagnosis.correction.reset();
  diagnosis.where.clear();
  EXPECT_FALSE(contains(headline(diagnosis), "cause unknown"));
}



TEST(DiagnosisHeadline, NothingFoundIsToldApartFromNothingVisible)
{
  EXPECT_TRUE(contains(headline(SyntheticDiagnosis::no_gap()),
                       "Nothing is missing as far as these tests can tell: "
                       "simulation and measurements differ by 1.04 %"));
  EXPECT_TRUE(contains(headline(SyntheticDiagnosis::not_testable()),
                       "these tests cannot tell whether anything is missing"));
}



TEST(DiagnosisHeadline, OutliersAreMentioned)
{
  Diagnosis diagnosis = SyntheticDiagnosis::no_gap();
  EXPECT_FALSE(contains(headline(diagnosis), "look at"));
  diagnosis.outliers = {{"fast", ""}};
  EXPECT_TRUE(contains(headline(diagnosis),
                       "; look at 'fast' first, which does not behave like"));
  diagnosis.outliers = {{"a", ""}, {"b", ""}, {"c", ""}, {"d", ""}};
  EXPECT_TRUE(
    contains(headline(diagnosis), "look at 'a', 'b' and 2 more first"));
}



// A few bad numbers of a test are no bad test.
TEST(DiagnosisHeadline, RowsThatNothingExplainsAreNoOutlyingTests)
{
  Diagnosis diagnosis = SyntheticDiagnosis::no_gap();
  diagnosis.outliers  = {{"fast", "3 numbers of it", true}};
  EXPECT_FALSE(contains(headline(diagnosis), "behave like the other tests"));
  EXPECT_TRUE(contains(headline(diagnosis),
                       "; a few numbers of 'fast' that nothing explains"));
  const std::string page = page_of(diagnosis);
  has_all(page, {"Numbers that nothing explains", "fast: 3 numbers of it"});
  EXPECT_FALSE(contains(page, "out of line with the others"));

  diagnosis.outliers.push_back({"slow", "left out"});
  has_all(headline(diagnosis),
          {"look at 'slow' first, which does", "a few numbers of 'fast'"});
}



TEST(DiagnosisText, NumbersHaveTheDigitsWorthReading)
{
  EXPECT_EQ(percent_text(0.31234), "31.2 %");
  EXPECT_EQ(percent_text(0.012345), "1.23 %");
  EXPECT_EQ(percent_text(0.0001234), "0.012 %");
  EXPECT_EQ(percent_text(0.), "0.00 %");
  EXPECT_EQ(percent_text(12.), "1200 %");
  EXPECT_EQ(percent_text(std::numeric_limits<double>::infinity()), "–");
  EXPECT_EQ(chance_text(0.001, 999), "≤ 0.001");
  EXPECT_EQ(chance_text(0.0015, 999), "≤ 0.0015");
  EXPECT_EQ(chance_text(0.0015, 4999), "0.0015");
  EXPECT_EQ(chance_text(0.0234, 999), "0.023");
  EXPECT_EQ(chance_text(1., 999), "1");
}



TEST(DiagnosisTable, ItFitsTheTerminalAndHasAllThatMatters)
{
  for (const Diagnosis &diagnosis : {SyntheticDiagnosis::named(),
                                     SyntheticDiagnosis::ambiguous(),
                                     SyntheticDiagnosis::unnamed(),
                                     SyntheticDiagnosis::no_gap(),
                                     SyntheticDiagnosis::not_testable(),
                                     Diagnosis()})
    {
      const std::string  table = diagnosis_table(diagnosis);
      std::istringstream lines(table);
      for (std::string line; std::getline(lines, line);)
        EXPECT_LE(text_width(line), 100u) << line;
      EXPECT_TRUE(contains(table, "verdict: " + name_of(diagnosis.verdict)));
      for (const CandidateResult &candidate : diagnosis.candidates)
        EXPECT_TRUE(contains(table, "\n  " + candidate.name));
    }
  const std::string table = diagnosis_table(SyntheticDiagnosis::named());
  EXPECT_TRUE(contains(table, "overstress/Viscosity   0.01230"));
  EXPECT_TRUE(contains(table, "0.01122 … 0.01362"));
  EXPECT_TRUE(contains(table, "speed 0.5 … 1.7 mm/s"));
  EXPECT_FALSE(contains(table, "flank"));
  EXPECT_TRUE(contains(table, "next test: sliding at 0.01 mm/min"));
}



TEST(DiagnosisReport, TheFirstScreenTellsWhatWasWrongMissingAndGained)
{
  const std::string named = first_screen_of(SyntheticDiagnosis::named());
  for (const std::string &part :
       {std::string("missing effect named: overstress"),
        std::string("At speeds of 0.5 … 1.7 mm/s"),
        std::string("Measured friction is higher there than simulated"),
        std::string("friction that rises with sliding speed (overstress)"),
        "4.91" + percent + " → 1.04" + percent + " of friction",
        "5.13" + percent,
        "noise alone, 1.01" + percent})
    EXPECT_TRUE(contains(named, part)) << part;

  const std::string ambiguous =
    first_screen_of(SyntheticDiagnosis::ambiguous());
  EXPECT_TRUE(contains(ambiguous, "several explanations: overstress or "));
  EXPECT_TRUE(contains(ambiguous, "as with a lubricant (stribeck)"));

  const std::string unnamed = first_screen_of(SyntheticDiagnosis::unnamed());
  EXPECT_TRUE(contains(unnamed, "something unknown is missing"));
  EXPECT_TRUE(contains(unnamed, "too much remained unexplained: overstress"));

  const std::string no_gap = first_screen_of(SyntheticDiagnosis::no_gap());
  EXPECT_TRUE(contains(no_gap, "Nothing, as far as these tests can tell"));
  EXPECT_TRUE(contains(no_gap, "changed friction by 0.35"));
  EXPECT_TRUE(contains(no_gap, "2 of 10 effects cannot be tested here"));
  EXPECT_FALSE(contains(no_gap, "→"));

  const std::string blind = first_screen_of(SyntheticDiagnosis::not_testable());
  EXPECT_TRUE(contains(blind, "These tests cannot tell"));
  EXPECT_TRUE(contains(blind, "10 of 10 effects cannot be tested here"));
}



TEST(DiagnosisReport, ThePageIsCompleteInItself)
{
  std::vector<std::string> warnings;
  const Diagnosis          diagnosis = SyntheticDiagnosis::named();
  const std::string        page      = page_of(diagnosis, &warnings);
  for (const std::string word : {"src=", "<link", "@import", "fetch("})
    EXPECT_FALSE(contains(page, word)) << word;
  // Names of XML are no addresses.
  EXPECT_EQ(count(page, "http"), count(page, "=\"http://www.w3.org/"));
  for (const CandidateResult &candidate : diagnosis.candidates)
    EXPECT_TRUE(contains(page, "<b>" + candidate.name + "</b>"))
      << candidate.name;
  EXPECT_EQ(count(page, "<tr class='grey'>"), 3u);
  EXPECT_TRUE(contains(page, "would show in: a slide at 45 deg"));
  EXPECT_TRUE(contains(page, "slow &lt;a&gt; &amp; &quot;b&quot;"));
  EXPECT_FALSE(contains(page, "slow <a>"));
  EXPECT_TRUE(contains(page,
                       "<code>press 5.8 MPa in 1 s; slide 0.01 mm/min for 2 "
                       "mm</code>"));
  EXPECT_TRUE(contains(page, "What would overturn this verdict"));
  EXPECT_TRUE(contains(page, "≥ 35.8"));
  EXPECT_TRUE(contains(page, "0.0083 (0.0081 … 0.0086) of friction"));
  EXPECT_TRUE(contains(page, "slipstep diagnose"));
  if (!has_gnuplot())
    GTEST_SKIP() << "gnuplot is not installed";
  EXPECT_TRUE(warnings.empty()) << warnings[0];
  for (const std::string name :
       {"test_1", "test_6", "covariate_3", "profile_2", "block_1"})
    EXPECT_TRUE(contains(page, "id=\"" + name + "-")) << name;
}



TEST(DiagnosisReport, WhatThereIsNotIsLeftOut)
{
  const std::string no_gap = page_of(SyntheticDiagnosis::no_gap());
  for (const std::string part : {"The next test",
                                 "finite elements",
                                 "cause unknown",
                                 "new parameters",
                                 ">after<",
                                 "Warnings"})
    EXPECT_FALSE(contains(no_gap, part)) << part;
  const std::string unnamed = page_of(SyntheticDiagnosis::unnamed());
  EXPECT_TRUE(contains(unnamed, "A correction, cause unknown"));
  EXPECT_TRUE(contains(unnamed, "max(log(v/0.01), 0)"));
  EXPECT_TRUE(contains(unnamed, "no cells stated"));
  const std::string blind = page_of(SyntheticDiagnosis::not_testable());
  EXPECT_TRUE(contains(blind, "the size of the noise is stated, not measured"));
  EXPECT_TRUE(contains(blind, "1 test out of line with the others"));
  EXPECT_TRUE(contains(blind, "fast (outlier)"));
}



// Nothing known, next to no data.
TEST(DiagnosisReport, DegenerateResultsDoNotBreakThePage)
{
  page_of(Diagnosis());
  Diagnosis diagnosis = SyntheticDiagnosis::named();
  for (DiagnosedTest &test : diagnosis.tests)
    {
      test.after.clear();
      test.phase.clear();
      test.level = test.noise = 0.;
    }
  diagnosis.tests[1].measured.clear();
  diagnosis.tests[2].displacement.assign(diagnosis.tests[2].time.size(), 0.);
  diagnosis.panels[0].signatures[0].second.clear();
  diagnosis.panels[1].x.assign(9, 4.);
  diagnosis.panels[2].error.clear();
  DiagnosedParameter &parameter = diagnosis.candidates[0].parameters[0];
  parameter.profile             = {{0.5, 0.},
                                   {0.5, std::numeric_limits<double>::infinity()}};
  parameter.lower = parameter.upper = parameter.value = 0.5;
  diagnosis.shrink                                    = Shrink();
  std::vector<std::string> warnings;
  page_of(diagnosis, &warnings);
  if (has_gnuplot())
    {
      EXPECT_TRUE(warnings.empty()) << warnings[0];
    }
}



TEST(DiagnosisReport, TestsWithTwoAxesShowBoth)
{
  Diagnosis      diagnosis = SyntheticDiagnosis::named();
  DiagnosedTest &test      = diagnosis.tests[2];
  test.measured_y          = test.measured;
  test.before_y            = test.before;
  test.after_y             = test.after;
  page_of(diagnosis);
  EXPECT_TRUE(
    contains(content(test_folder() / "report" / "test_3.gp"), "second axis"));
}



TEST(DiagnosisReport, WithoutGnuplotTheNumbersStillCome)
{
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nonexistent", 1);
  std::vector<std::string> warnings;
  const std::string page = page_of(SyntheticDiagnosis::named(), &warnings);
  setenv("PATH", path.c_str(), 1);
  // One for each kind of picture.
  ASSERT_EQ(warnings.size(), 4u);
  EXPECT_TRUE(contains(warnings[0], "gnuplot is not installed"));
  EXPECT_FALSE(contains(page, "<svg"));
  EXPECT_TRUE(contains(page, "4.91" + percent + " → 1.04" + percent));
  EXPECT_TRUE(contains(page, "Tests and phases"));
  EXPECT_TRUE(contains(page, "6.20" + percent));
}



// improved.prm has the parameters of the model in the end, not of the start.
TEST(DiagnosisReport, ParametersAreThoseOfTheImprovedCase)
{
  const std::string page  = page_of(SyntheticDiagnosis::named());
  const std::size_t begin = page.find(">Parameters<");
  ASSERT_NE(begin, std::string::npos);
  EXPECT_TRUE(contains(page.substr(begin), "0.3377"));
  EXPECT_FALSE(contains(page.substr(begin), "0.3612"));
}



// As the table does.
TEST(DiagnosisReport, EffectsThatAreNotTestableWouldNotHaveBeenSeen)
{
  Diagnosis diagnosis                        = SyntheticDiagnosis::no_gap();
  diagnosis.candidates                       = {CandidateResult()};
  diagnosis.candidates[0].name               = "pressure";
  diagnosis.candidates[0].minimum_detectable = 0.5;
  diagnosis.candidates[0].standing           = Standing::not_testable;
  EXPECT_TRUE(contains(first_screen_of(diagnosis),
                       "1 of 1 effects cannot be tested here."));
}
