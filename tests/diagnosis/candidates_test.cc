// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tests/diagnosis/hidden/trial.h>

#include <slipstep/friction/effect.h>
#include <slipstep/utilities/text.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace SlipStep;

namespace
{
  Parameters coulomb_case()
  {
    Parameters parameters;
    declare_loading_parameters(parameters);
    FrictionLaw::declare_parameters(parameters);
    declare_calibration_parameters(parameters);
    declare_diagnosis_parameters(parameters);
    parameters.set("Friction/Effects", "", "test");
    parameters.set("Friction/Static coefficient", "0.1", "test");
    parameters.set("Calibration/Parameters",
                   "Friction/Static coefficient from 0.01 to 1",
                   "test");
    return parameters;
  }

  TestedRange usual_range()
  {
    TestedRange range;
    range.slowest          = 0.01;
    range.fastest          = 5.;
    range.lowest           = 1.;
    range.highest          = 20.;
    range.largest_pressure = 20.;
    range.longest_path     = 40.;
    range.longest_rest     = 1000.;
    range.longest_test     = 2000.;
    range.typical_friction = 0.1;
    range.widest_angle     = 1.5;
    range.track_wave       = 2.;
    range.n_orders         = 12;
    range.first_order      = 3.;
    range.last_order       = 17.;
    return range;
  }
} // namespace



// Every shape of every formula makes a case that the law takes, at any
// strength, with all its parameters listed between their bounds.
TEST(Candidates, MakeCasesThatTheLawTakes)
{
  const Parameters start = coulomb_case();
  for (const Candidate &candidate : make_candidates(start, usual_range()))
    for (const TrialFormula &formula : candidate.formulas)
      for (const TrialFormula::Shape &shape : formula.shapes)
        for (const double strength : {0.01, 1., 30., 1000.})
          {
            SCOPED_TRACE(candidate.name + " " + std::to_string(strength));
            const CaseToFit with =
              assemble(start, {{candidate.name, formula}}, shape(strength));
            EXPECT_NO_THROW(FrictionLaw{with.parameters});
            const std::vector<FitParameter> &fitted = with.fitted;
            for (const CandidateParameter &parameter : formula.parameters)
              EXPECT_TRUE(std::any_of(fitted.begin(),
                                      fitted.end(),
                                      [&](const FitParameter &one) {
                                        return one.path == parameter.path;
                                      }));
          }
}



// Whatever the tests cover: the ranges of a formula follow them, but not beyond
// what the law allows.
TEST(Candidates, MakeCasesThatTheLawTakesOfAnyTests)
{
  std::mt19937_64 random(3);
  const auto      some = [&](const double least, const double most) {
    return std::exp(std::uniform_real_distribution<>(std::log(least),
                                                     std::log(most))(random));
  };
  for (unsigned int n = 0; n < 24; ++n)
    {
      TestedRange range;
      range.slowest          = some(1e-6, 1e3);
      range.fastest          = range.slowest * some(1., 1e6);
      range.lowest           = some(1e-4, 1e3);
      range.highest          = range.lowest * some(1., 1e4);
      range.largest_pressure = range.highest * some(1., 10.);
      range.longest_path     = some(1e-5, 1e6);
      range.longest_rest     = n % 3 == 0 ? 0. : some(1e-2, 1e7);
      range.longest_test =
        range.longest_rest + range.longest_path / range.slowest;
      range.typical_friction = some(1e-3, 2.);
      range.widest_angle     = n % 2 == 0 ? 0. : 1.5;
      range.track_wave       = some(1e-3, 1.) * range.longest_path;
      range.n_orders         = 12;
      range.first_order      = 3.;
      range.last_order       = 17.;

      Parameters start = coulomb_case();
      start.set("Calibration/Parameters",
                "Friction/Static coefficient from 1e-4 to 10",
                "test");
      start.set("Friction/Static coefficient",
                exact_text(range.typical_friction),
                "test");
      if (n % 2 == 1)
        {
          start.set("Friction/Effects", "subloading, softening", "test");
          start.set("Friction/softening/Kinetic coefficient",
                    exact_text(range.typical_friction * (1. - some(1e-3, 0.9))),
                    "test");
        }
      for (const Candidate &candidate : make_candidates(start, range))
        for (const TrialFormula &formula : candidate.formulas)
          for (const TrialFormula::Shape &shape : formula.shapes)
            for (const double strength : {0.01, 1., 1000.})
              {
                SCOPED_TRACE(candidate.name + " " + std::to_string(strength) +
                             " of circumstances " + std::to_string(n));
                EXPECT_NO_THROW(FrictionLaw(
                  assemble(start, {{candidate.name, formula}}, shape(strength))
                    .parameters));
              }
    }
}



// One list of effects: whoever adds one either says how it is looked for or why
// it is not.
TEST(Candidates, EveryEffectIsOneOrSaysWhyNot)
{
  std::set<std::string> tried;
  for (const std::string &name : candidate_names())
    tried.insert(name);
  for (const auto &[name, info] : effect_registry())
    {
      EXPECT_NE(bool(info.search.formula), !info.search.why_not.empty())
        << name;
      const std::string candidate =
        info.search.candidate.empty() ? name : info.search.candidate;
      EXPECT_EQ(tried.count(candidate),
                info.search.formula || !info.search.beside_formulas.empty() ?
                  1u :
                  0u)
        << name;
      EXPECT_EQ(info.search.beside_formulas.empty(), info.search.beside.empty())
        << name;
      EXPECT_EQ(info.search.beside_formulas.empty(),
                info.search.beside_signature.empty())
        << name;
      EXPECT_EQ(info.search.signature.empty(),
                candidate != name || !info.search.formula)
        << name;
      EXPECT_NE(plain_words(name), name);
    }
  for (const std::string &name : candidate_names())
    EXPECT_NE(plain_words(name), name);
  EXPECT_EQ(plain_words("my own"), "my own");
}



TEST(Candidates, AreAllOfTheCatalogueUnlessSomeAreAskedFor)
{
  Parameters start = coulomb_case();
  EXPECT_EQ(make_candidates(start, usual_range()).size(),
            candidate_names().size());
  start.set("Diagnosis/Candidates", "healing, pressure", "test");
  const std::vector<Candidate> some = make_candidates(start, usual_range());
  ASSERT_EQ(some.size(), 2u);
  EXPECT_EQ(some[0].name, "healing");
  EXPECT_FALSE(some[1].formulas.empty());
}



// Slip normal to the ellipse, and friction opposite to slip; half of a change
// across, or none of it; a film that is Newtonian or thins.
TEST(Candidates, HaveOtherForms)
{
  const auto forms = [](const std::string &name, const std::string &key) {
    Parameters start = coulomb_case();
    start.set("Diagnosis/Candidates", name, "test");
    const Candidate found = make_candidates(start, usual_range()).at(0);
    std::vector<std::string> result;
    for (const TrialFormula &formula : found.formulas)
      result.push_back(
        assemble(start, {{found.name, formula}}, formula.shapes[0](30.))
          .parameters.text("Friction/" + name + "/" + key));
    return result;
  };
  using Forms = std::vector<std::string>;
  EXPECT_EQ(forms("anisotropy", "Form"),
            (Forms{"associated", "associated", "opposite"}));
  // Along the line of motion, and along any other.
  EXPECT_EQ(forms("direction", "Form"),
            (Forms{"cosine", "reversed", "cosine", "reversed"}));
  EXPECT_EQ(forms("direction", "Forward angle"),
            (Forms{"0", "0", "45 deg", "45 deg"}));
  EXPECT_EQ(forms("viscous", "Exponent"), (Forms{"1", "0.5"}));
  // Alone, with harmonics, and as the second of those.
  EXPECT_EQ(forms("texture", "Wavelength"),
            (Forms{"2 mm",
                   "1.4142135623730951 mm",
                   "2 mm",
                   "1.4142135623730951 mm",
                   "4 mm",
                   "2.8284271247461903 mm"}));
}



// Contacts that age or that slip renews are looked for beside a direct effect
// of speed: with it where the model has none, alone where it has.
TEST(Candidates, StatesAreTriedBesideADirectEffect)
{
  Parameters start = coulomb_case();
  start.set("Diagnosis/Candidates", "ageing, slip_law", "test");
  TestedRange range = usual_range();
  range.slowest     = 0.01;
  range.fastest     = 1.;
  const auto found  = [&](const std::string &effects, const double rest) {
    range.longest_rest = rest;
    start.set("Friction/Effects", effects, "test");
    std::string text;
    for (const Candidate &candidate : make_candidates(start, range))
      text +=
        candidate.name + "(" +
        (candidate.formulas.empty() ? "-" : candidate.formulas[0].effect) +
        (candidate.only_beside.empty() ? "" :
                                          " beside " + candidate.only_beside) +
        ")";
    return text;
  };
  EXPECT_EQ(found("", 0.),
            "ageing(ageing beside overstress)slip_law(slip_law beside "
            "overstress)");
  EXPECT_EQ(found("", 100.),
            "ageing(ageing beside overstress)slip_law(slip_law beside "
            "overstress)");
  EXPECT_EQ(found("overstress", 0.), "ageing(ageing)slip_law(slip_law)");
  EXPECT_EQ(found("perzyna", 0.), "ageing(ageing)slip_law(slip_law)");
  // Where something rested, ageing is a formula of healing.
  EXPECT_EQ(found("overstress", 100.), "ageing(-)slip_law(slip_law)");
  EXPECT_EQ(found("overstress, ageing", 0.), "ageing(-)slip_law(slip_law)");
  // The same form has one name.
  start.set("Diagnosis/Candidates", "healing, ageing", "test");
  EXPECT_EQ(found("overstress", 0.), "ageing(ageing)healing(-)");
  EXPECT_EQ(found("overstress", 100.), "ageing(-)healing(ageing)");
  start.set("Diagnosis/Candidates", "ageing, slip_law", "test");
  range.fastest = range.slowest;
  EXPECT_EQ(found("overstress", 0.), "ageing(-)slip_law(-)");
}



// An effect of the model whose contacts begin young may lack what they remember
// of before the tests.
TEST(Candidates, ContactsOfTheModelMayHaveAnInitialState)
{
  Parameters start = coulomb_case();
  start.set("Diagnosis/Candidates", "initial_state", "test");
  start.set("Friction/Effects", "overstress, ageing", "test");
  const auto found = [&]() {
    const Candidate candidate = make_candidates(start, usual_range()).at(0);
    return candidate.formulas.empty() ?
             candidate.why_not :
             candidate.formulas[0].effect + "+" +
               candidate.formulas[0].parameters.at(0).path;
  };
  EXPECT_EQ(found(), "no effect of the model gives the contacts a memory");
  start.set("Friction/ageing/Growth", "0.1", "test");
  EXPECT_EQ(found(), "+Friction/ageing/First age");
  // One per cent more at first than at the slowest.
  const TrialFormula formula =
    make_candidates(start, usual_range())[0].formulas.at(0);
  const double age = formula.shapes.back()(1.).at("Friction/ageing/First age");
  EXPECT_NEAR(0.1 * std::log(age / (1. + 0.1 / usual_range().slowest)),
              just_noticed,
              1e-9);
  // What is fitted of the effect may be elsewhere then.
  EXPECT_EQ(formula.parameters.size(), 1u);
  EXPECT_EQ(formula.shapes.at(0)(1.).size(), 1u);
  start.set("Calibration/Parameters",
            "Friction/ageing/Growth from 0.01 to 1",
            "test");
  const TrialFormula both =
    make_candidates(start, usual_range())[0].formulas.at(0);
  EXPECT_EQ(both.parameters.size(), 2u);
  EXPECT_EQ(both.shapes.at(0)(1.).size(), 2u);
  start.set("Calibration/Lead-in", "1 mm", "test");
  EXPECT_EQ(found(), "the contacts slide before the tests begin");
  start.set("Calibration/Lead-in", "0 mm", "test");
  start.set("Friction/ageing/First age", "5 s", "test");
  EXPECT_EQ(found(), "the model has Friction/ageing/First age");
  start.set("Friction/Effects", "overstress, slip_law", "test");
  start.set("Friction/slip_law/Growth", "0.1", "test");
  EXPECT_EQ(found(), "+Friction/slip_law/First state");
}



// What a jump of speed spreads over shows beside an effect that jumps; a
// texture where there are waves.
TEST(Candidates, NeedWhatTheyShowIn)
{
  Parameters start = coulomb_case();
  start.set("Diagnosis/Candidates", "memory_length, texture", "test");
  TestedRange range  = usual_range();
  const auto  reason = [&](const std::string &effects, const unsigned int i) {
    start.set("Friction/Effects", effects, "test");
    return make_candidates(start, range).at(i).why_not;
  };
  EXPECT_EQ(reason("", 0), "there is no effect of speed that could spread");
  for (const char *effects : {"overstress", "perzyna"})
    {
      EXPECT_EQ(reason(effects, 0), "");
      const TrialFormula formula =
        make_candidates(start, range).at(0).formulas.at(0);
      EXPECT_EQ(formula.texts.at("Friction/memory_length/Form"), "flow");
    }
  EXPECT_EQ(reason("", 1), "");
  // Along one line nobody can tell an angle.
  EXPECT_EQ(make_candidates(start, range).at(1).formulas.size(), 6u);
  range.widest_angle = 0.;
  EXPECT_EQ(make_candidates(start, range).at(1).formulas.size(), 3u);
  range.track_wave = 0.;
  EXPECT_EQ(reason("", 1), "there is no clear wave along the track");
}



// What has not softened cannot recover, but it can age.
TEST(Candidates, HealingIsRecoveryOrAgeing)
{
  Parameters start = coulomb_case();
  start.set("Diagnosis/Candidates", "healing", "test");
  TestedRange range    = usual_range();
  const auto  formulas = [&](const std::string &effects) {
    start.set("Friction/Effects", effects, "test");
    const std::vector<Candidate> found = make_candidates(start, range);
    std::vector<std::string>     names;
    for (const TrialFormula &formula : found[0].formulas)
      names.push_back(formula.effect);
    return names;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(formulas(""), (Names{"ageing"}));
  EXPECT_EQ(formulas("softening"), (Names{"healing", "ageing"}));
  EXPECT_EQ(formulas("softening, healing"), (Names{"", "ageing"}));
  start.set("Friction/healing/Rate", "1e-3 1/s", "test");
  EXPECT_EQ(formulas("softening, healing"), Names());

  // Without rests there is no age.
  range.longest_rest = 0.;
  start.set("Friction/healing/Rate", "0 1/s", "test");
  EXPECT_EQ(formulas(""), Names());
  EXPECT_EQ(formulas("softening"), Names{"healing"});
}



TEST(Candidates, LeaveOutWhatTheModelHas)
{
  Parameters start = coulomb_case();
  start.set("Friction/Effects", "overstress, pressure", "test");
  for (const Candidate &candidate : make_candidates(start, usual_range()))
    {
      // Where something rests, ageing is a formula of healing.
      const bool is_out =
        candidate.name == "overstress" || candidate.name == "pressure" ||
        candidate.name == "ageing" || candidate.name == "initial_state";
      EXPECT_EQ(candidate.formulas.empty(), is_out) << candidate.name;
      EXPECT_EQ(candidate.why_not.empty(), !is_out) << candidate.name;
    }
}



TEST(Candidates, LeaveOutWhatTheModelHasByAnotherFormula)
{
  Parameters start = coulomb_case();
  start.set("Friction/Effects", "perzyna", "test");
  start.set("Diagnosis/Candidates", "overstress", "test");
  const std::vector<Candidate> found = make_candidates(start, usual_range());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].formulas.empty());
  EXPECT_EQ(found[0].why_not,
            "perzyna, another formula of it, is in the model already");
}



TEST(DiagnosisParameters, ListWhatActiveEffectsHave)
{
  Parameters start = coulomb_case();
  start.set("Calibration/Parameters", "", "test");
  start.set("Friction/Effects", "softening, overstress", "test");
  std::set<std::string> paths;
  for (const FitParameter &parameter :
       read_fit_parameters(with_parameters_listed(start)))
    paths.insert(parameter.path);
  EXPECT_EQ(paths,
            (std::set<std::string>{"Friction/Static coefficient",
                                   "Friction/softening/Rate",
                                   "Friction/softening/Steepness",
                                   "Friction/softening/Kinetic coefficient",
                                   "Friction/overstress/Viscosity",
                                   "Friction/overstress/Exponent"}));
}
