// SPDX-License-Identifier: LGPL-2.1-or-later

// Runs that end badly: the reason is told in words, and what was computed
// before is kept and can be read.

#include <slipstep/experiment/history.h>
#include <slipstep/experiment/summary.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "slipstep_process.h"
#include "tests/restart/background_run.h"

using namespace SlipStep;

namespace
{
  // More work than anybody waits for.
  const char *const slow =
    "set Loading/Programme = press 1 MPa in 1 s; slide 1 mm/s for 1 mm\n"
    "set Block/Subdivisions = 2, 2, 2\n"
    "set Block/Degree = 1\n"
    "set Time stepping/Least steps per statement = 1000000\n"
    "set Output/Fields = none\n";

  // Nothing holds a block as slender as this one.
  const char *const slender =
    "set Loading/Programme = press 1 MPa in 1 s; slide 1 mm/s for 10 mm\n"
    "set Block/Size = 2 mm, 10 mm, 40 mm\n"
    "set Block/Subdivisions = 2, 2, 2\n"
    "set Block/Degree = 1\n";

  const char *const sweep = "subsection Sweep\n"
                            "  set Key    = Loading/Speed\n"
                            "  set Values = 1 mm/s, 2 mm/s\n"
                            "end\n";

  const char *const sliding_as_swept =
    "set Loading/Programme = press 1 MPa in 1 s; slide for 10 mm\n"
    "set Block/Size = 2 mm, 10 mm, 40 mm\n"
    "set Block/Subdivisions = 2, 2, 2\n"
    "set Block/Degree = 1\n";



  void expect_kept(const SlipstepProcess &process,
                   const std::string     &folder,
                   const std::string     &reason)
  {
    const auto path = process.folder() / folder;
    EXPECT_GE(read_history(path / "history.csv").size(), 2u);
    const Summary summary = read_summary(path / "summary.json");
    EXPECT_EQ(summary.status, "failed");
    EXPECT_TRUE(contains(summary.reason, reason));
    EXPECT_FALSE(std::filesystem::exists(path / "summary.json.part"));
  }



  // 0 for a file that has just been created.
  std::size_t n_rows(const std::filesystem::path &history)
  {
    return std::filesystem::file_size(history) == 0 ?
             0 :
             read_history(history).size();
  }



  // Interrupts runs that have rows to keep; returns what is said.
  std::string interrupted(const SlipstepProcess &process,
                          const int              signal,
                          const int              n_runs)
  {
    const auto has_rows = [&]() {
      int        n      = 0;
      const auto output = process.folder() / "output";
      if (std::filesystem::exists(output))
        for (const auto &entry :
             std::filesystem::recursive_directory_iterator(output))
          n += entry.path().filename() == "history.csv" &&
               n_rows(entry.path()) > 2;
      return n == n_runs;
    };
    BackgroundRun run(process.folder(), {"run", "case.prm"});
    EXPECT_TRUE(run.wait_until(has_rows)) << run.err();
    run.send(signal);
    run.wait();
    EXPECT_EQ(run.outcome(), -signal);
    const std::string err = run.err();
    EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << err;
    return err;
  }
} // namespace



// What round-off leaves of a load that was taken off has no friction.
TEST(FailedRun, ABlockThatComesOffHasNoFrictionThere)
{
  const SlipstepProcess process;
  process.write("case.prm",
                "set Loading/Programme = press 5 MPa in 1 s; slide 1 mm/s for "
                "0.1 mm; press 0 MPa in 1 s; slide 1 mm/s for 0.1 mm\n"
                "set Friction/Effects =\n"
                "set Friction/Static coefficient = 0.3\n"
                "set Friction/Normal stiffness = 1e5\n"
                "set Friction/Tangential stiffness = 1e4\n"
                "set Block/Dimension = 2\n"
                "set Block/Size = 10 mm, 10 mm\n"
                "set Block/Subdivisions = 8, 4\n"
                "set Block/Degree = 2\n"
                "set Block/Young modulus = 2 GPa\n"
                "set Block/Poisson ratio = 0.3\n"
                "set Output/Fields = none\n");
  EXPECT_EQ(process.run({"run", "case.prm"}).exit_code, 1);
  expect_kept(process, "output/case", "come off the plane");
  EXPECT_LT(
    read_summary(process.folder() / "output/case/summary.json").peak_friction,
    0.3 + 1e-6);
}



TEST(FailedRun, ATippingBlockIsToldAndKept)
{
  const SlipstepProcess process;
  process.write("case.prm", slender);
  const auto result = process.run({"run", "case.prm"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.n_error_lines(), 1u) << result.err;
  EXPECT_TRUE(contains(result.err, "tips over"));
  expect_kept(process, "output/case", "tips over");
  EXPECT_TRUE(contains(process.read("output/case/report.html"), "tips over"));
}



// Three times the pressure from the side turns it over at once.
TEST(FailedRun, LoadsThatNothingHoldsAreTold)
{
  const SlipstepProcess process;
  process.write("case.prm",
                "set Loading/Programme = press 5 MPa in 1 s\n"
                "set Friction/Effects =\n"
                "set Friction/Static coefficient = 0.1\n"
                "set Block/Subdivisions = 2, 2, 2\n"
                "set Block/Degree = 1\n"
                "set Block/Faces/right = pressure 3 x programme\n");
  const auto result = process.run({"run", "case.prm"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.n_error_lines(), 1u) << result.err;
  EXPECT_TRUE(contains(result.err, "tip it over"));
  EXPECT_TRUE(contains(process.read("output/case/report.html"), "tip it over"));
}



// Contacts that give way by 5 m, and friction that no digit holds.
TEST(FailedRun, TheCauseIsToldThatItHas)
{
  struct Case
  {
    std::string settings, told, not_told;
  };
  for (
    const Case &one : std::vector<Case>{
      {"set Loading/Programme = press 5 MPa in 1 s; slide 1 mm/s for 3 um\n"
       "set Friction/Normal stiffness = 1e-3\n",
       "the block sinks 5000 mm into the plane",
       "tip it over"},
      {"set Loading/Programme = press 5 MPa in 1 s; slide 1 mm/min for 5 um\n"
       "set Friction/Effects = subloading, overstress\n"
       "set Friction/Static coefficient = 1e-12\n",
       "lost in the round-off of the pressure",
       "soft may jump"}})
    {
      const SlipstepProcess process;
      process.write("case.prm",
                    one.settings + "set Block/Dimension = 2\n"
                                   "set Block/Size = 8 mm, 4 mm\n"
                                   "set Block/Subdivisions = 4, 2\n"
                                   "set Block/Degree = 2\n");
      const auto result = process.run({"run", "case.prm"});
      EXPECT_EQ(result.exit_code, 1);
      EXPECT_TRUE(contains(result.err, one.told)) << result.err;
      EXPECT_FALSE(contains(result.err, one.not_told)) << result.err;
    }
}



// What opens loses friction that needs no pressure.
TEST(FailedRun, AdhesionOfAnOpenFaceHasARemedy)
{
  const SlipstepProcess process;
  const auto            result = process.run(
    {"run",
                SLIPSTEP_SOURCE_DIR "/prm/pressure_sweep/pressure_sweep.prm",
                "--variant",
                "adhesion",
                "--quiet",
                "--set",
                "Loading/Programme=press 0.5 MPa in 1 s; slide for 1 mm; press 0.01 "
                           "MPa in 1 s; slide for 1 mm"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_TRUE(contains(result.err,
                       "Friction/adhesion/Largest coefficient = 2 bounds it"));
}



TEST(FailedRun, LossOfPressureIsToldAndKept)
{
  const SlipstepProcess process;
  process.write("case.prm",
                "set Loading/Programme = press 1 MPa in 1 s; press 0 MPa in 1 "
                "s; slide 1 mm/s for 1 mm\n"
                "set Block/Subdivisions = 2, 2, 2\n"
                "set Block/Degree = 1\n");
  const auto result = process.run({"run", "case.prm"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.n_error_lines(), 1u) << result.err;
  expect_kept(process, "output/case", "pressure");
}



TEST(FailedRun, EveryVariantIsReported)
{
  const SlipstepProcess process;
  process.write("case.prm", std::string(sliding_as_swept) + sweep);
  const auto result = process.run({"run", "case.prm"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.n_error_lines(), 2u) << result.err;
  for (const std::string variant : {"1 mm/s: ", "2 mm/s: "})
    EXPECT_TRUE(contains(result.err, variant));
  EXPECT_TRUE(contains(result.out, "2 of 2 failed"));
  expect_kept(process, "output/case/1_mm-s", "tips over");
  expect_kept(process, "output/case/2_mm-s", "tips over");
  EXPECT_TRUE(
    std::filesystem::exists(process.folder() / "output/case/report.html"));
}



TEST(FailedRun, AFullDiskIsToldAndTheRowsBeforeAreKept)
{
  const SlipstepProcess process;
  // More of a history than of anything that is written before it.
  process.write("case.prm",
                "set Loading/Speed = 2 mm/s\n"
                "set Time stepping/Tolerance = 1e-6\n");
  const auto result =
    process.run({"point", "case.prm", "--quiet"}, "", "ulimit -f 100 &&");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_TRUE(contains(result.err, "see ulimit -f"));
  expect_kept(process, "output/case/point", "see ulimit -f");
}



TEST(FailedRun, WhatCannotBePrintedIsNoSuccess)
{
  const SlipstepProcess process;
  if (!std::filesystem::exists("/dev/full"))
    GTEST_SKIP() << "there is no /dev/full";
  process.write("script.sh", "\"$@\" > /dev/full\n");
  const auto redirected = process.run({"parameters"}, "sh script.sh");
  EXPECT_EQ(redirected.exit_code, 1);
  EXPECT_TRUE(contains(redirected.err, "the disk is full"));
}



TEST(StoppedRun, LeavesReadableFiles)
{
  const SlipstepProcess process;
  process.write("case.prm", slow);
  EXPECT_TRUE(contains(interrupted(process, SIGINT, 1),
                       "stopped by a signal (Interrupt)"));
  expect_kept(process, "output/case", "stopped by a signal");
}



TEST(StoppedRun, StopsTheVariants)
{
  const SlipstepProcess process;
  const std::string     at_one_speed = "slide 1 mm/s for";
  std::string           at_all       = slow;
  at_all.replace(at_all.find(at_one_speed), at_one_speed.size(), "slide for");
  process.write("case.prm", at_all + sweep);
  // Only the parent gets the signal.
  interrupted(process, SIGTERM, 2);
  for (const auto &entry :
       std::filesystem::directory_iterator(process.folder() / "output/case"))
    if (entry.is_directory() &&
        std::filesystem::exists(entry.path() / "history.csv"))
      expect_kept(process,
                  "output/case/" + entry.path().filename().string(),
                  "stopped by a signal");
}



TEST(ManyRanks, SpeakOnce)
{
  if (std::system("command -v mpirun > /dev/null") != 0)
    GTEST_SKIP() << "mpirun is missing";
  const SlipstepProcess process;
  const std::string     mpirun = "mpirun --oversubscribe -np 2";
  process.write("case.prm", std::string(sliding_as_swept) + sweep);

  const auto check = process.run({"check", "case.prm"}, mpirun);
  EXPECT_EQ(check.exit_code, 0);
  EXPECT_EQ(count(check.out, "OK"), 1u) << check.out;

  const auto wrong =
    process.run({"run", "case.prm", "--set", "Block/Degree=9"}, mpirun);
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_EQ(count(wrong.err, "Block/Degree"), 1u) << wrong.err;
  EXPECT_FALSE(std::filesystem::exists(process.folder() / "output"));

  const auto failing = process.run({"run", "case.prm"}, mpirun);
  EXPECT_EQ(failing.exit_code, 1);
  EXPECT_EQ(count(failing.err, "tips over"), 2u) << failing.err;
  EXPECT_EQ(failing.out.find('\r'), std::string::npos);
  expect_kept(process, "output/case/1_mm-s", "tips over");
  expect_kept(process, "output/case/2_mm-s", "tips over");
}



TEST(Point, TellsWhatTheFacesOfTheBlockDoToThePressure)
{
  const SlipstepProcess process;
  process.write(
    "case.prm",
    "set Loading/Programme = press 1 MPa in 1 s; slide 1 mm/s for 1 um\n");
  const auto warned = [&](const std::string &top) {
    const auto result = process.run(
      {"point", "case.prm", "--quiet", "--set", "Block/Faces/top=" + top});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.err;
  };
  EXPECT_TRUE(
    contains(warned("pressure 3 x programme; drive"), "take 3 x the pressure"));
  EXPECT_TRUE(
    contains(warned("pressure 5 MPa; drive"), "take 0 x the pressure"));
  EXPECT_EQ(warned("pressure programme; drive"), "");
}
