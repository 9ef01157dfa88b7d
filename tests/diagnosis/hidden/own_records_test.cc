// SPDX-License-Identifier: LGPL-2.1-or-later

// Campaigns whose friction is a formula of the load point's speed, as a table
// of measurements is read: no law of the catalogue made them.

#include <tests/diagnosis/hidden/own_records.h>

using namespace SlipStep;
using namespace SlipStep::Testing;



// With subloading alone nothing holds friction that falls with speed; beside a
// direct effect it is seen, as the Stribeck curve or, without one, as a state
// that slip renews. Healing, which the rests do not show, was named for it.
TEST_F(OwnRecords, FrictionThatFallsWithSpeedIsFoundWhereTheModelCannotHoldIt)
{
  write(-0.03);
  const Judgement judgement = judged("subloading", "");
  EXPECT_FALSE(judgement.is_incomplete);
  std::vector<std::string> found = effect_names(judgement.found.model.parts);
  for (const std::string &name : found)
    EXPECT_TRUE(name == "overstress" || name == "stribeck" ||
                name == "slip_law")
      << name;
  for (const Rival &rival : judgement.found.rivals)
    found.push_back(rival.name);
  EXPECT_EQ(std::count(found.begin(), found.end(), "slip_law"), 1);
}



// One sensor, whatever it is resolved along, and another one across it that is
// quieter: what lacks noise says nothing of the other's.
TEST_F(OwnRecords, AlongOtherAxesTheyTellTheSame)
{
  std::vector<Noise> noises;
  for (const auto &[degrees, deviation] : {std::make_pair(0., 0.),
                                           std::make_pair(90., 0.),
                                           std::make_pair(30., 0.),
                                           std::make_pair(0., 2e-4)})
    {
      angle  = degrees * std::acos(-1.) / 180.;
      across = deviation;
      random.seed(1);
      normal.reset();
      write(0.);
      parameters = Parameters();
      read("subloading", usual_contact);
      Workspace &workspace = *ingested.workspace;
      EXPECT_GT(test_gap(workspace,
                         ingested.base,
                         score_candidates(workspace, ingested.base))
                  .p,
                workspace.level);
      noises.push_back(workspace.noise.noise);
    }
  for (const auto size : {&Noise::white, &Noise::drift, &Noise::gain})
    for (const std::size_t turned : {1, 2})
      EXPECT_NEAR(noises[turned].*size / noises[0].*size, 1., 0.01);
  for (const auto size : {&Noise::white, &Noise::gain})
    EXPECT_NEAR(noises[3].*size / noises[0].*size, 1., 0.1);
}



// The contact is softer along the second axis of an ellipse, whichever is the
// weak one: an ellipse turned by 90 degrees is none with a ratio above 1.
TEST_F(OwnRecords, AnEllipseHasItsWeakAxisAlongEitherOne)
{
  const std::string contact = "set Friction/Tangential stiffness = 10\n"
                              "set Friction/subloading/Rate = 500\n";
  for (const std::string turned : {"0", "90"})
    {
      std::filesystem::create_directories(folder.path() / "measured");
      unsigned int number = 0;
      for (const std::string way : {"0", "45", "90", "200", "0", "90"})
        {
          std::ofstream(folder.path() / "truth.prm")
            << "set Loading/Programme = press 5 MPa in 1 s; slide 0.2 mm/s for "
               "4 mm at "
            << way << " deg; slide -0.2 mm/s for 3 mm at " << way
            << " deg\nset Friction/Effects = subloading, anisotropy\n"
               "set Friction/Static coefficient = 0.2\n"
               "set Time stepping/Equal steps per statement = 60\n"
               "set Friction/anisotropy/Ratio = 0.85\n"
               "set Friction/anisotropy/Angle = "
            << turned << " deg\n"
            << contact;
          Parameters truth;
          declare_loading_parameters(truth);
          FrictionLaw::declare_parameters(truth);
          truth.read(folder.path() / "truth.prm");
          std::ofstream out(folder.path() / "measured" /
                            ("t" + std::to_string(++number) + ".csv"));
          out << "time_s,displacement_mm,displacement_y_mm,pressure_MPa,"
                 "friction,friction_y\n";
          for (const HistoryRow &row : point_history(truth))
            out << row.time << ',' << row.displacement << ','
                << row.displacement_y << ',' << row.pressure << ','
                << row.friction + 0.002 * normal(random) << ','
                << row.friction_y + 0.002 * normal(random) << '\n';
        }
      parameters = Parameters();
      const Judgement judgement =
        judged("subloading",
               "set Calibration/Parameters = Friction/Static coefficient from "
               "0.02 to 0.6",
               contact);
      EXPECT_EQ(effect_names(judgement.found.model.parts),
                std::vector<std::string>{"anisotropy"})
        << turned;
    }
}



// Of a rigid machine, flanks are far shorter than the distance of rows; so are
// those of a spring a little softer.
TEST_F(OwnRecords, ASoftSpringIsFoundBetweenDistantRows)
{
  stiffness = 2.;
  write(0.);
  const Judgement judgement = judged(
    "subloading",
    "",
    "set Friction/Tangential stiffness = 1e4\n"
    "set Friction/subloading/Rate = 2000\n"
    "set Calibration/Parameters = Friction/Static coefficient from 0.02 to 0.6");
  EXPECT_EQ(effect_names(judgement.found.model.parts),
            std::vector<std::string>{"compliance"});
  EXPECT_NEAR(judgement.found.model.values().at(
                "Friction/Tangential stiffness"),
              5. * stiffness,
              0.05 * 5. * stiffness);
}



// The overstress relaxes at rest, this friction does not: it follows the speed
// over any length that is too short to be seen, which is told.
TEST_F(OwnRecords, ALengthBelowThatBetweenRowsIsTold)
{
  write(0.03);
  const Judgement judgement =
    judged("subloading, overstress",
           "; Friction/overstress/Viscosity from 1 to 1e8 log; "
           "Friction/overstress/Exponent from 4 to 200");
  EXPECT_EQ(effect_names(judgement.found.model.parts),
            std::vector<std::string>{"memory_length"});
  Diagnosis diagnosis;
  describe_short_lengths(*ingested.workspace, judgement.found.model, diagnosis);
  ASSERT_EQ(diagnosis.warnings.size(), 1u);
  EXPECT_EQ(diagnosis.warnings[0].rfind("memory_length/Slip length = ", 0), 0u);
  // 6 mm in 180 rows.
  EXPECT_NE(diagnosis.warnings[0].find("between rows, 0.033 mm"),
            std::string::npos)
    << diagnosis.warnings[0];
}



// Contacts that had rested for an hour before the tests: their first state is
// found, and its fall is not taken for softening.
TEST_F(OwnRecords, ContactsMayBeOldAtFirst)
{
  write_slip_law(0.004, 0.008, 0.4, 3600.);
  const Judgement judgement =
    judged("subloading, overstress",
           "; Friction/overstress/Viscosity from 1 to 1e8 log; "
           "Friction/overstress/Exponent from 4 to 200");
  const Model &model = judgement.found.model;
  EXPECT_EQ(effect_names(model.parts), std::vector<std::string>{"slip_law"});
  const Values values = model.values();
  EXPECT_NEAR(values.at("Friction/slip_law/Slip length"), 0.4, 0.04);
  EXPECT_NEAR(std::log(values.at("Friction/slip_law/First state") / 3600.),
              0.,
              1.5);
}



// The same where the model has the slip law already, young at first.
TEST_F(OwnRecords, ContactsOfTheModelMayBeOldAtFirst)
{
  write_slip_law(0.004, 0.008, 0.4, 3600.);
  const Judgement judgement =
    judged("subloading, overstress, slip_law",
           "; Friction/overstress/Viscosity from 1 to 1e8 log; "
           "Friction/overstress/Exponent from 4 to 200; "
           "Friction/slip_law/Growth from 1e-3 to 0.2; "
           "Friction/slip_law/Slip length from 0.02 to 4 log\n"
           "set Friction/slip_law/Growth = 0.03\n"
           "set Friction/slip_law/Time = 0.001 s");
  const Model &model = judgement.found.model;
  EXPECT_EQ(effect_names(model.parts),
            std::vector<std::string>{"initial_state"});
  EXPECT_NEAR(std::log(model.values().at("Friction/slip_law/First state") /
                       3600.),
              0.,
              1.5);
}



// Records of a machine whose axis is the second one, or neither.
TEST_F(OwnRecords, BackAndForthIsAlongTheLineOfMotion)
{
  for (const double degrees : {90., -60.})
    {
      angle = degrees * std::acos(-1.) / 180.;
      write([this]() {
        return [this](const double friction,
                      const double speed,
                      const double,
                      const double step) {
          const double strength = speed < 0. ? 0.212 : 0.2;
          return std::clamp(friction + stiffness * speed * step,
                            speed == 0. ? -1. : -strength,
                            speed == 0. ? 1. : strength);
        };
      });
      parameters                = Parameters();
      const Judgement judgement = judged("subloading", "");
      EXPECT_EQ(effect_names(judgement.found.model.parts),
                std::vector<std::string>{"direction"})
        << degrees;
      EXPECT_EQ(judgement.found.model.simulator
                  ->with(judgement.found.model.scaled)
                  .text("Friction/direction/Forward angle"),
                std::to_string(int(degrees)) + " deg");
    }
}



TEST_F(OwnRecords, AWaveIsSeenAlongTheLineOfMotion)
{
  angle = std::acos(-1.) / 2.;
  write(0., [](const double y) { return 1. + 0.03 * std::sin(2. * y); });
  const Judgement judgement = judged("subloading", "");
  EXPECT_EQ(effect_names(judgement.found.model.parts),
            std::vector<std::string>{"texture"});
}



// A disc that wobbles, with a pattern on it: one is a texture, what the other
// leaves is no damage and no running in.
TEST_F(OwnRecords, ASecondWaveAlongTheTrackIsNotDamage)
{
  write(0., [](const double x) {
    return 1. + 0.03 * std::sin(2. * x + 0.7) + 0.02 * std::sin(7.3 * x);
  });
  const Judgement judgement = judged("subloading", "");
  EXPECT_GT(judgement.gap.excess, 0.);
  for (const std::string &name : effect_names(judgement.found.model.parts))
    EXPECT_EQ(name, "texture");
  EXPECT_TRUE(judgement.verdict != Verdict::named || judgement.is_incomplete);
}



// Waves, and a flank that the case holds too round: beside the texture it is no
// softening but that number.
TEST_F(OwnRecords, AHeldNumberIsTriedInThePlaceOfASecondName)
{
  write(0., [](const double x) { return 1. + 0.03 * std::sin(2. * x); });
  read("subloading",
       "set Friction/Tangential stiffness = 100\n"
       "set Friction/subloading/Rate = 15\n"
       "set Calibration/Parameters = Friction/Static coefficient from 0.02 to "
       "0.6");
  Workspace  &workspace = *ingested.workspace;
  const Model base      = ingested.base;
  const auto  view      = score_candidates(workspace, base);
  const auto  with      = [&](const Model &model, const std::string &name) {
    const auto tried = score_candidates(workspace, model);
    return *refit_with(workspace,
                       model,
                       *std::find_if(tried.candidates.begin(),
                                     tried.candidates.end(),
                                     [&](const CandidateView &one) {
                                       return one.candidate.name == name;
                                     }));
  };
  const Model found = with(with(base, "texture"), "softening");
  ASSERT_EQ(found.parts.size(), 2u);
  const std::optional<LookAlike> other = find_look_alike(
    workspace, base, found, test_gap(workspace, base, view).excess);
  ASSERT_TRUE(other.has_value());
  EXPECT_EQ(other->instead_of, "softening");
  EXPECT_EQ(other->path.rfind("Friction/subloading/", 0), 0u) << other->path;
}



// A peak after rests: without the tests that rest, the others do not ask for
// it.
TEST_F(OwnRecords, TheConditionThatTellsOfANameIsKnown)
{
  write([this]() {
    return [this, rest = 0., slip = 1.](const double friction,
                                        const double speed,
                                        const double,
                                        const double step) mutable {
      if (speed == 0.)
        {
          rest += step;
          slip = 0.;
          return friction;
        }
      slip += std::abs(speed) * step;
      if (slip > 1.)
        rest = 0.;
      const double strength =
        0.2 * (1. + 0.04 * std::log10(1. + rest) * std::exp(-slip / 0.2));
      return std::clamp(friction + stiffness * speed * step,
                        -strength,
                        strength);
    };
  });
  const Judgement judgement = judged("subloading", "");
  ASSERT_FALSE(judgement.found.evidence.empty());
  const std::vector<std::size_t> told_by = judgement.found.evidence[0].told_by;
  ASSERT_EQ(told_by.size(), 1u);
  EXPECT_EQ(ingested.workspace->comparison.conditions[told_by[0]], "6");
}



// The name that is proven when Ctrl-C comes stays; before, and by other
// signals, nothing does.
TEST_F(OwnRecords, CtrlCLeavesWhatIsProven)
{
  write(0.03, [](const double x) { return 1. + 0.03 * std::sin(2. * x); });
  read("subloading", usual_contact);
  Workspace &workspace = *ingested.workspace;
  for (const auto &[signal, last] :
       {std::pair(SIGINT, 1u), std::pair(SIGTERM, 2u), std::pair(SIGINT, 2u)})
    {
      const SignalGuard guard;
      unsigned int      n_added = 0;
      const bool        is_told = signal == SIGINT && last == 2;
      workspace.progress =
        [&, which = signal, when = last](const std::string &text) {
          if (text.rfind("added ", 0) == 0 && ++n_added == when)
            std::raise(which);
        };
      if (!is_told)
        EXPECT_THROW(judge(workspace, ingested.base), RunError);
      else
        {
          const Judgement judgement = judge(workspace, ingested.base);
          EXPECT_EQ(effect_names(judgement.found.model.parts).size(), 1u);
          EXPECT_EQ(SignalGuard::caught(), 0);
          SignalGuard::recall();
          EXPECT_EQ(SignalGuard::caught(), SIGINT);
        }
      EXPECT_EQ(workspace.was_stopped, is_told);
    }
  const SignalGuard forgets_it;
}



// Where friction never falls, a starting model that may let it fall is fitted
// as well as one that may not.
TEST_F(OwnRecords, AFallThatIsNoneIsFittedAsNone)
{
  write(0., [](const double position) { return 1. + 0.005 * position; });
  read("subloading", usual_contact);
  const double without = ingested.base.objective;
  read("subloading, softening",
       usual_contact + "; Friction/softening/Kinetic coefficient from 0.02 to "
                       "0.6\nset Friction/softening/Kinetic coefficient = "
                       "0.1\nset Friction/softening/Rate = 0.5");
  EXPECT_NEAR(ingested.base.objective, without, 0.01 * without);
  Values values = ingested.base.values();
  EXPECT_NEAR(values.at("Friction/softening/Kinetic coefficient"),
              values.at("Friction/Static coefficient"),
              1e-4);
}
