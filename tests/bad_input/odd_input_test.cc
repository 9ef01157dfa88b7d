// SPDX-License-Identifier: LGPL-2.1-or-later

// What nobody would write on purpose.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "slipstep_process.h"
#include "tests/rows_header.h"

namespace
{
  void expect_short_refusal(const SlipstepProcess::Result &result,
                            const std::string             &words)
  {
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_EQ(result.n_error_lines(), 1u) << result.err;
    EXPECT_LE(result.err.size(), 1200u) << result.err;
    EXPECT_TRUE(contains(result.err, words))
      << "  \"" << words << "\" is not in: " << result.err;
  }
} // namespace



TEST(OddInput, NamesThatAreTooLong)
{
  const SlipstepProcess process;
  const std::string     name(5000, 'x');
  const std::string     too_long = "File name too long";
  process.write("case.prm", right);
  for (const std::string command : {"check", "point", "calibrate", "diagnose"})
    expect_short_refusal(process.run({command, name + ".prm"}), too_long);
  expect_short_refusal(process.run({"check", name + ".csv"}), too_long);
  expect_short_refusal(process.run({"plant", name}), too_long);
  expect_short_refusal(process.run({"point", "case.prm", "--output", name}),
                       too_long);
  expect_short_refusal(process.run({"point", "case.prm", "--variant", name}),
                       "no such variant; it has none");
  process.write("include.prm", "include " + name + ".prm\n");
  expect_short_refusal(process.run({"check", "include.prm"}),
                       "include.prm:1: include xxx");
  process.write("variant.prm",
                "subsection Variants\nsubsection " + std::string(300, 'v') +
                  "\nend\nend\n");
  expect_short_refusal(process.run({"check", "variant.prm"}),
                       "variant.prm:2: the variant");
  EXPECT_FALSE(std::filesystem::exists(process.folder() / "output"));
}



TEST(OddInput, APushBeyondFrictionIsNoWrongInput)
{
  const SlipstepProcess process;
  process.write("push.prm",
                "set Loading/Programme = press 1 MPa in 1 s; push 0.01 MPa in "
                "1 s; push between 0 MPa and 0.01 MPa 2 times, 1 s each\n"
                "set Output/Quantities = peak coefficient\n"
                "set Block/Subdivisions = 1, 1, 1\n"
                "set Block/Degree = 1\n");
  for (const std::string command : {"check", "point", "run"})
    EXPECT_EQ(process.run({command, "push.prm", "--quiet"}).exit_code, 0);
  // A run that failed.
  for (const std::string command : {"point", "run"})
    {
      const auto beyond = process.run(
        {command,
         "push.prm",
         "--set",
         "Loading/Programme=press 1 MPa in 1 s; push 9 MPa in 1 s"});
      EXPECT_EQ(beyond.exit_code, 1);
      EXPECT_TRUE(contains(beyond.err, "friction cannot hold the push"));
    }
}



// Words that a reader can go by.
TEST(OddInput, APushBackIsToldAsItIs)
{
  const SlipstepProcess process;
  process.write("back.prm",
                "set Friction/Effects =\n"
                "set Friction/Static coefficient = 0.2\n"
                "set Loading/Programme = press 5 MPa in 1 s; push -0.5 MPa in "
                "1 s; push -2.5 MPa in 1 s\n");
  const auto result = process.run({"point", "back.prm", "--quiet"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_TRUE(contains(result.err,
                       "friction cannot hold the push of -2.5 MPa; it held up "
                       "to -1 MPa, at a pressure of 5 MPa"))
    << result.err;
}



// A spring without mass lets a contact jump whose friction falls with slip
// alone: no step is short enough.
TEST(OddInput, AJumpIsNotBlamedOnTheSteps)
{
  const SlipstepProcess process;
  process.write("jump.prm",
                "set Friction/Effects = subloading, softening\n"
                "set Friction/Static coefficient = 0.3\n"
                "set Friction/softening/Kinetic coefficient = 0.2\n"
                "set Friction/softening/Rate = 5\n"
                "set Loading/Machine stiffness = 0.5 MPa/mm\n"
                "set Loading/Programme = press 5 MPa in 1 s; slide 1 mm/s for "
                "3.5 mm\n"
                "set Output/Quantities = largest pressure\n");
  const auto result = process.run({"point", "jump.prm", "--quiet"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(contains(result.err, "s the contact jumps by")) << result.err;
  EXPECT_FALSE(contains(result.err, "may help")) << result.err;
  EXPECT_TRUE(
    contains(result.err, "'largest pressure' has no value on a contact point"));
}



// Many jumps, none of which makes most of what is lost.
TEST(OddInput, ManyJumpsAreNotBlamedOnTheSteps)
{
  const SlipstepProcess process;
  process.write(
    "jump.prm",
    "set Friction/Effects = subloading, softening, healing\n"
    "set Friction/Static coefficient = 0.3\n"
    "set Friction/softening/Kinetic coefficient = 0.2\n"
    "set Friction/softening/Rate = 20\n"
    "set Friction/healing/Rate = 0.5\n"
    "set Loading/Machine stiffness = 1 MPa/mm\n"
    "set Loading/Programme = press 5 MPa in 1 s; slide 0.1 mm/s for "
    "5 mm\n");
  const auto result = process.run({"point", "jump.prm", "--quiet"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(contains(result.err, "s the contact jumps by")) << result.err;
  EXPECT_FALSE(contains(result.err, "may help")) << result.err;
}



TEST(OddInput, WhatIsNoEffectButCalledSoIsTold)
{
  const SlipstepProcess process;
  expect_short_refusal(process.run({"effects", "compliance"}),
                       "Loading/Machine stiffness");
  expect_short_refusal(process.run({"effects", "heal"}),
                       "did you mean healing?");
}



// A run has the number of a test that the case says, whichever it follows.
TEST(OddInput, AnotherOrderThanThatOfTheFollowedTestIsTold)
{
  const SlipstepProcess process;
  process.write("test.csv",
                "# order: 7\ntime_s,displacement_mm,pressure_MPa,friction\n"
                "0,0,5,0\n1,1,5,0.1\n2,2,5,0.1\n");
  process.write("follow.prm",
                "set Friction/Effects = run_order\n"
                "set Loading/Programme = follow test.csv\n");
  EXPECT_TRUE(contains(process.run({"check", "follow.prm"}).err,
                       "was made as test number 7, but "
                       "Friction/run_order/Test is 20"));
  EXPECT_FALSE(contains(
    process.run({"point", "follow.prm", "--set", "Friction/run_order/Test=7"})
      .err,
    "test number"));
}



// A value that a program would find as null is told of to the reader, too.
TEST(OddInput, AFrontThatIsNowhereIsTold)
{
  const SlipstepProcess process;
  process.write("front.prm",
                std::string("include " SLIPSTEP_SOURCE_DIR
                            "/prm/slip_front/slip_front.prm\n") +
                  "set Loading/Programme = press 5.8 MPa in 1 s; slide for "
                  "0.00001 mm\n"
                  "set Output/Quantities = slip front at r = 0.9999\n"
                  "set Block/Refinement = uniform 0\n");
  const auto result =
    process.run({"run", "front.prm", "--quiet", "--output", "o"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(contains(result.err, "'slip front at r = 0.9999' has no value"));
}



TEST(OddInput, TheHomeFolderIsKnown)
{
  const SlipstepProcess process;
  process.write("case.prm", right);
  process.write("outer.prm", "include ~/case.prm\n");
  const std::string home = "export HOME=" + process.folder().string() + " &&";
  const auto        run  = [&](const std::vector<std::string> &arguments,
                       const std::string              &set_up) {
    return process.run(arguments, "", set_up);
  };
  EXPECT_EQ(run({"point", "outer.prm", "--output=~/out"}, home).exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(process.folder() / "out/summary.json"));
  expect_short_refusal(run({"point", "case.prm", "--output=~/out"},
                           "unset HOME &&"),
                       "HOME is not set");
  process.write("other.prm", "include ~other/case.prm\n");
  expect_short_refusal(run({"check", "other.prm"}, home),
                       "other.prm:1: include ~other/case.prm: only your own "
                       "home folder");
  EXPECT_FALSE(std::filesystem::exists(process.folder() / "~"));
}



TEST(OddInput, CellsThatAreNoNumbersAreNamed)
{
  const SlipstepProcess process;
  const auto            check = [&](const std::string &rows) {
    process.write("test.csv", header + rows);
    return process.run({"check", "test.csv"});
  };
  expect_short_refusal(check("0,0,5,0.1\n1,1,5,inf\n2,2,5,0.1\n"),
                       "test.csv:3:7: friction is not finite");
  expect_short_refusal(check("0,0,0,0.1\n1,1,-inf,0.1\n2,2,0,0.1\n"),
                       "test.csv:3:5: pressure is not finite");
  expect_short_refusal(
    check("0,0,5,nan\n1,1,5,nan\n2,2,5,0.1\n"),
    "test.csv:2:7: friction has no value; a value is missing in 2 of 3 "
    "rows");
  // Old Macintoshes.
  process.write("cr.csv",
                "time_s,displacement_mm,pressure_MPa,friction\r0,0,5,0.1\r"
                "1,1,5,x\r");
  expect_short_refusal(process.run({"check", "cr.csv"}), "cr.csv:3:7: 'x'");
}



TEST(OddInput, ClosedDescriptorsGetNoFileOfResults)
{
  const SlipstepProcess process;
  process.write("case.prm", right);
  const auto open = process.run({"point", "case.prm", "--output", "open"});
  ASSERT_EQ(open.exit_code, 0) << open.err;
  const auto closed = process.run({"point", "case.prm", "--output", "closed"},
                                  "",
                                  "exec <&- >&- 2>&- &&");
  EXPECT_EQ(closed.exit_code, 0);
  EXPECT_EQ(process.read("closed/history.csv"),
            process.read("open/history.csv"));
  EXPECT_EQ(
    process.run({"point", "nowhere.prm"}, "", "exec <&- >&- 2>&- &&").exit_code,
    2);
}



// A speed that no slide takes changes nothing. In a file with all keys the
// default was not meant.
TEST(OddInput, ASpeedThatIsNotTakenIsTold)
{
  const SlipstepProcess process;
  const std::string     press = "set Loading/Programme = press 1 MPa in 1 s; ";
  const std::string     speed = "set Loading/Speed = ";
  process.write("stated.prm", right);
  process.write("written.prm", right + speed + "2 mm/s\n");
  process.write("default.prm", right + speed + "1 mm/min\n");
  process.write("open.prm",
                press + "slide for 1 mm; slide 1 mm/s for 1 mm\n" + speed +
                  "2 mm/s\n");
  const auto expect = [&](const std::vector<std::string> &arguments,
                          const std::string              &told) {
    const auto result = process.run(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err,
              told.empty() ? "" :
                             "warning: " + told +
                               "Loading/Speed is not used: Loading/Programme "
                               "has no 'slide' without a speed of its own\n");
  };
  expect({"check", "stated.prm"}, "");
  expect({"check", "default.prm"}, "");
  expect({"check", "open.prm"}, "");
  expect({"check", "written.prm"}, "written.prm:2: ");
  const std::string set = "Loading/Speed=1 mm/min";
  expect({"check", "open.prm", "--set", set}, "");
  expect({"check", "stated.prm", "--set", set}, "--set ");
  expect({"check", "stated.prm", "--sweep", set}, "--sweep ");
  expect({"point", "stated.prm", "--set", set, "--output", "a"}, "--set ");
  expect({"run",
          "written.prm",
          "--set",
          "Block/Subdivisions=1, 1, 1",
          "--output",
          "b"},
         "written.prm:2: ");
}



// As most are by default; where a fit or a sweep moves it, it is meant.
TEST(OddInput, AnEffectThatDoesNothingIsTold)
{
  const SlipstepProcess process;
  const auto            errors = [&](const std::string              &more,
                          const std::vector<std::string> &options = {}) {
    process.write("case.prm", right + more);
    std::vector<std::string> arguments = {"check", "case.prm"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const auto result = process.run(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.err;
  };
  const std::string healing = "set Friction/Effects = subloading, healing\n";
  const std::string rate    = "Friction/healing/Rate";
  EXPECT_EQ(errors(healing),
            "warning: effect healing is on but does nothing: " + rate +
              " is 0\n");
  EXPECT_EQ(errors(healing + "set " + rate + " = 0.1 1/s\n"), "");
  EXPECT_EQ(errors(healing, {"--sweep", rate + "=0|0.1"}), "");
  process.write("test.csv",
                "time_s,displacement_mm,pressure_MPa,friction\n0,0,1,0\n"
                "1,1,1,0.1\n2,2,1,0.11\n3,3,1,0.1\n4,4,1,0.11\n");
  EXPECT_EQ(errors(healing + "set Calibration/Parameters = " + rate +
                   " from 0 to 1\nset Calibration/Tests = test.csv\n"),
            "");
  // Its temperature is asked for by another one.
  EXPECT_EQ(errors("set Friction/Effects = subloading, heating, expression\n"
                   "set Friction/heating/Weakening = 0 1/degC\n"
                   "set Friction/expression/Covariate = temperature\n"
                   "set Friction/expression/Formula = 1 - x/1000\n"),
            "");
  const std::string length = "set Friction/Effects = subloading, overstress, "
                             "memory_length\n";
  EXPECT_NE(errors(length), "");
  EXPECT_EQ(errors(length + "set Friction/memory_length/Form = flow\n"), "");
  for (const auto &[effect, is_idle] :
       {std::pair("viscous", true), std::pair("overstress", false)})
    EXPECT_EQ(
      bool(contains(errors("set Friction/Effects = " + std::string(effect) +
                           "\nset Friction/Speed of the coefficients = "
                           "1 mm/min\n"),
                    "is not used: coefficients are divided by the loading "
                    "ratio")),
      is_idle);
}



// What a block slides with half of is not what points were fitted to.
TEST(OddInput, AStrengthOfTheFaceIsToldWherePointsStandForTheBlock)
{
  const SlipstepProcess process;
  std::string           rows = "time_s,displacement_mm,pressure_MPa,friction\n";
  for (unsigned int i = 0; i < 40; ++i)
    rows += std::to_string(0.1 * i) + "," + std::to_string(0.1 * i) + ",1," +
            (i == 0    ? "0\n" :
             i % 2 > 0 ? "0.151\n" :
                         "0.149\n");
  process.write("test.csv", rows);
  const std::string fit =
    "set Friction/Effects =\nset Calibration/Tests = test.csv\nset "
    "Calibration/Parameters = Friction/Static coefficient from 0.05 to 0.5\n";
  const std::string map = "set Contact/Strength = ";
  process.write("block.prm", right + map + "0.5\n");
  process.write("whole.prm", right + fit + map + "1\n");
  process.write("half.prm", right + fit + map + "1 - 0.5*(x < 0.005)\n");
  const auto is_told = [&](const std::vector<std::string> &arguments) {
    const auto result = process.run(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return contains(result.err,
                    "Contact/Strength acts only on the face of a block");
  };
  for (const char *command : {"point", "export", "calibrate"})
    {
      EXPECT_TRUE(is_told({command, "half.prm", "--output", command}))
        << command;
      EXPECT_FALSE(is_told(
        {command, "whole.prm", "--output", std::string(command) + "_whole"}))
        << command;
    }
  EXPECT_TRUE(is_told({"diagnose", "half.prm", "--output", "diagnose"}));
  EXPECT_TRUE(is_told({"check", "half.prm"}));
  EXPECT_FALSE(is_told({"check", "block.prm"}));
  EXPECT_FALSE(is_told({"run",
                        "block.prm",
                        "--set",
                        "Block/Subdivisions=1, 1, 1",
                        "--output",
                        "run"}));
}



TEST(OddInput, AnEmptyEnvironmentIsEnough)
{
  const SlipstepProcess process;
  process.write("case.prm", right);
  // Sanitizers are not to look for leaks in libraries.
  const char *const sanitizer = std::getenv("ASAN_OPTIONS");
  const std::string empty_environment =
    "env -i" +
    (sanitizer != nullptr ? " ASAN_OPTIONS=" + std::string(sanitizer) : "");
  for (const std::string command : {"run", "point"})
    {
      const auto result = process.run({command,
                                       "case.prm",
                                       "--set",
                                       "Block/Subdivisions=1, 1, 1",
                                       "--output",
                                       command},
                                      empty_environment);
      EXPECT_EQ(result.exit_code, 0) << result.err;
    }
}



// Runs at the same time must not meet in a directory of MPI's.
TEST(OddInput, ARunNeedsNoTemporaryDirectory)
{
  const SlipstepProcess process;
  process.write("case.prm", right);
  const auto result =
    process.run({"run", "case.prm", "--set", "Block/Subdivisions=1, 1, 1"},
                "env TMPDIR=/proc/none");
  EXPECT_EQ(result.exit_code, 0) << result.err;
}
