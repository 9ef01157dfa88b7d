// SPDX-License-Identifier: LGPL-2.1-or-later

// Stop and resume: signals, other numbers of ranks, solvers, sweeps.

#include <csignal>
#include <regex>

#include "tests/file_text.h"
#include "restart_tools.h"

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  // Ranks may outnumber cores.
  const std::string few_steps =
    "set Loading/Programme = press 1 MPa in 1 s; slide 1 mm/s for 0.2 mm\n"
    "set Block/Subdivisions = 4, 3, 4\n"
    "set Block/Degree = 1\n"
    "set Time stepping/Tolerance = 1e-3\n"
    "set Output/Fields = none\n";

  std::string without_date(const std::string &xml)
  {
    return xml.substr(xml.find("<VTKFile"));
  }

  const std::string pushed =
    "set Friction/Effects = subloading\n"
    "set Block/Dimension = 2\n"
    "set Block/Size = 10 mm, 5 mm\n"
    "set Block/Subdivisions = 8, 4\n"
    "set Block/Degree = 1\n"
    "set Output/Fields = every 0.1 um\n"
    "set Time stepping/Least steps per statement = 100\n"
    "set Loading/Programme = press 1 MPa in 1 s; push 0.1 MPa in 1 s; push ";

  class Restart : public RestartTest
  {
  protected:
    void kill_and_resume(const std::string &text)
    {
      process.write("case.prm", text);
      for (const unsigned int n_lines : {150u, 250u})
        {
          const std::string output = "killed after " + std::to_string(n_lines);
          run_and_kill(output, n_lines, {"--set", often});
          EXPECT_EQ(run(output, {"--resume", "--quiet"}).exit_code, 0);
          expect_finished(output);
        }
    }
  };
} // namespace



TEST_F(Restart, AfterSigtermGoesOnBitForBit)
{
  // As a terminal that is closed sends it; nohup, by which this may have been
  // started, lets all ignore it.
  const auto on_hangup = std::signal(SIGHUP, SIG_DFL);
  for (const int signal : {SIGTERM, SIGINT, SIGHUP})
    {
      const std::string output = "stopped by " + std::to_string(signal);
      {
        BackgroundRun run(process.folder(),
                          arguments(output, {"--quiet", "--set", never}));
        run.wait_until([&]() { return lines(output) > 150; });
        run.send(signal);
        if (signal == SIGHUP) // by the shell and by the terminal
          run.send(signal);
        run.wait();
        ASSERT_EQ(run.outcome(), -signal);
        const std::string message = run.err();
        EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 1);
        for (const std::string part :
             {"stopped by a signal", " after step ", "--resume goes on"})
          EXPECT_TRUE(contains(message, part));
      }
      const auto resumed = run(output, {"--resume"});
      EXPECT_EQ(resumed.exit_code, 0);
      EXPECT_EQ(resumed.err, "");
      EXPECT_TRUE(contains(resumed.out, "Resumed after step "));
      expect_finished(output);
      EXPECT_EQ(read_summary(path(output) / "summary.json").sessions, 2u);
      for (const std::string collection : {"/fields.pvd", "/contact.pvd"})
        EXPECT_EQ(without_date(process.read(output + collection)),
                  without_date(process.read("undisturbed" + collection)));
      EXPECT_EQ(process.read(output + "/contact_face.csv"),
                process.read("undisturbed/contact_face.csv"));

      // A finished run is kept.
      const auto again = run(output, {"--resume"});
      EXPECT_EQ(again.exit_code, 0);
      EXPECT_TRUE(contains(again.out, "Finished earlier"));
      expect_finished(output);
    }
  std::signal(SIGHUP, on_hangup);
}



TEST_F(Restart, OfAPushGoesOnBitForBit)
{
  kill_and_resume(pushed + "0.05 MPa in 1 s\n");
  EXPECT_GT(process.read("undisturbed/fields.pvd").size(), 1000u);

  // Another load is another case.
  run_and_kill("victim", 150, {"--set", often});
  process.write("case.prm", pushed + "0.06 MPa in 1 s\n");
  const auto other = run("victim", {"--resume"});
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_TRUE(contains(other.err, "Loading/Programme"));
}



TEST_F(Restart, OfAMachineGoesOnBitForBit)
{
  kill_and_resume("set Loading/Machine stiffness = 20 MPa/mm\n"
                  "set Loading/Machine mass = 1e3 kg/m^2\n" +
                  pushed + "0.05 MPa in 1 s; slide 1 mm/s for 0.01 mm\n");
}



namespace
{
  const std::string in_motion = "set Loading/Machine stiffness = 20 MPa/mm\n"
                                "set Block/Density = 1e8 kg/m^3\n"
                                "set Block/Damping time = 1 ms\n" +
                                pushed +
                                "0.05 MPa in 1 s; slide 1 mm/s for 0.01 mm\n";
} // namespace



TEST_F(Restart, OfABlockInMotionGoesOnBitForBit)
{
  kill_and_resume(in_motion);
}



TEST_F(Restart, OfABlockInMotionOnAnAdaptiveMeshGoesOnBitForBit)
{
  kill_and_resume("set Block/Refinement = adaptive 1\n" + in_motion);
}



// Its centre is part of the state of every point.
TEST_F(Restart, OfALawWithAnElasticCoreGoesOnBitForBit)
{
  kill_and_resume("set Block/Refinement = adaptive 1\n" +
                  std::regex_replace(pushed,
                                     std::regex("subloading"),
                                     "subloading, elastic_core") +
                  "0.05 MPa in 1 s; push 0.1 MPa in 1 s\n");
}



TEST_F(Restart, OfACurvedFaceWithAWeakPatchGoesOnBitForBit)
{
  kill_and_resume("set Contact/Gap = (x - 5)^2/(2*200)\n"
                  "set Contact/Strength = 1 + 0.4*(abs(x - 5) > 0.5)\n"
                  "set Block/Young modulus = 1e3 MPa\n"
                  "set Friction/Static coefficient = 0.3\n" +
                  pushed + "0.05 MPa in 1 s; slide 1 mm/s for 0.004 mm\n");
}



TEST_F(Restart, Sigusr1WritesACheckpointAndTheRunGoesOn)
{
  {
    BackgroundRun run(process.folder(), arguments("victim", {"--set", never}));
    run.wait_until([&]() { return lines("victim") > 100; });
    EXPECT_FALSE(fs::exists(path("victim/checkpoint")));
    run.send(SIGUSR1);
    run.wait_until([&]() { return fs::exists(path("victim/checkpoint")); });
    const std::size_t n_lines = lines("victim");
    run.wait_until([&]() { return lines("victim") > n_lines; });
    run.send(SIGKILL);
    run.wait();
    ASSERT_EQ(run.outcome(), -SIGKILL);
    EXPECT_TRUE(contains(run.out(), "Checkpoint written after step"));
  }
  EXPECT_EQ(run("victim", {"--resume", "--quiet"}).exit_code, 0);
  expect_finished("victim");
}



TEST_F(Restart, WithoutCheckpointStartsAnewAndSaysSo)
{
  run_and_kill("victim", 20, {"--set", never});
  const auto result = run("victim", {"--resume"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(contains(result.out, "starts anew"));
  expect_finished("victim");

  const auto point = [&]() {
    return process.run({"point", "case.prm", "--output", "point", "--resume"});
  };
  EXPECT_TRUE(contains(point().out, "starts anew"));
  EXPECT_TRUE(contains(point().out, "Finished earlier"));
}



TEST_F(Restart, OnAnotherNumberOfRanksAgreesToRoundOff)
{
  if (!has_mpirun())
    GTEST_SKIP() << "mpirun is missing";
  process.write("case.prm", few_steps);
  run_and_kill("victim", 30, {"--set", often});
  const auto result = run("victim", {"--resume"}, joined(two_ranks));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(contains(result.out, "on 2 instead of 1 ranks"));
  expected();
  const auto a = read_history(path("victim/history.csv"));
  const auto b = read_history(path("undisturbed/history.csv"));
  ASSERT_EQ(a.size(), b.size());
  for (unsigned int i = 0; i < a.size(); ++i)
    {
      ASSERT_EQ(a[i].time, b[i].time);
      ASSERT_NEAR(a[i].friction, b[i].friction, 1e-9);
      ASSERT_NEAR(a[i].normal_load, b[i].normal_load, 1e-9 * b[i].normal_load);
      ASSERT_NEAR(a[i].dissipated_energy,
                  b[i].dissipated_energy,
                  1e-9 * b[i].external_work);
      ASSERT_NEAR(a[i].coefficient.mean, b[i].coefficient.mean, 1e-9);
    }
}



TEST_F(Restart, OnTwoRanksGoesOnBitForBit)
{
  if (!has_mpirun())
    GTEST_SKIP() << "mpirun is missing";
  // Long enough for two signals in a row.
  std::string       text  = small_case;
  const std::string cells = "Subdivisions = 8, 4";
  process.write("case.prm",
                text.replace(text.find(cells),
                             cells.size(),
                             "Subdivisions = 48, 24"));
  EXPECT_EQ(run("undisturbed", {"--quiet", "--set", never}, joined(two_ranks))
              .exit_code,
            0);
  // Every rank decides alone whether it has got the signal: all must do the
  // same nevertheless.
  {
    BackgroundRun run(process.folder(),
                      arguments("victim", {"--set", never}),
                      two_ranks);
    run.wait_until([&]() { return lines("victim") > 20; });
    run.send(SIGUSR1);
    run.wait_until([&]() { return fs::exists(path("victim/checkpoint")); });
    run.send(SIGTERM);
    run.wait();
    EXPECT_NE(run.outcome(), 0);
  }
  const auto result = run("victim", {"--resume"}, joined(two_ranks));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(contains(result.out, "Resumed after step "));
  EXPECT_TRUE(history("victim") == history("undisturbed"));
}



TEST_F(Restart, KeepsFinishedVariantsOfASweep)
{
  process.write("case.prm",
                small_case + "subsection Variants\n"
                             "  subsection quick\n"
                             "    set Loading/Programme = press 1 MPa in 1 s\n"
                             "  end\n"
                             "  subsection slow\n"
                             "    set Time stepping/Least steps per statement "
                             "= 500\n"
                             "  end\n"
                             "end\n");
  {
    BackgroundRun run(process.folder(),
                      arguments("sweep", {"--quiet", "--set", never}));
    run.wait_until([&]() {
      return lines("sweep/slow") > 150 &&
             process.read("sweep/quick/summary.json").find("finished") !=
               std::string::npos;
    });
    run.send(SIGTERM);
    run.wait();
    EXPECT_EQ(run.outcome(), -SIGTERM);
    EXPECT_TRUE(contains(run.err(), "--resume"));
  }
  ASSERT_TRUE(fs::exists(path("sweep/slow/checkpoint")));
  const auto kept   = fs::last_write_time(path("sweep/quick/history.csv"));
  const auto result = run("sweep", {"--resume"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const std::string part :
       {"quick: Finished earlier", "slow: Resumed after step", "Report: "})
    EXPECT_TRUE(contains(result.out, part));
  EXPECT_EQ(fs::last_write_time(path("sweep/quick/history.csv")), kept);
  EXPECT_EQ(run("undisturbed", {"--variant", "slow", "--quiet"}).exit_code, 0);
  EXPECT_TRUE(history("sweep/slow") == history("undisturbed/slow"));
}



TEST_F(Restart, KeepsFinishedRunsOfARefinementStudy)
{
  process.write("case.prm",
                small_case +
                  "set Output/Quantities = friction force at 0.5 mm\n"
                  "set Output/Fields = none\n"
                  "set Refinement study/Uniform meshes = 3\n");
  // The finest mesh has to be under way still when the signal comes.
  const std::string steps  = "Time stepping/Least steps per statement=400";
  const auto        refine = [&](std::vector<std::string> more) {
    more.insert(more.begin(),
                {"refine",
                 "case.prm",
                 "--output",
                 "study",
                 "--set",
                 "Block/Adaptivity/Merging share=0.1",
                 "--set",
                 steps});
    return more;
  };
  const auto is_finished = [&](const std::string &folder) {
    return process.read("study/" + folder + "/summary.json").find("finished") !=
           std::string::npos;
  };
  {
    BackgroundRun run(process.folder(), refine({"--quiet", "--set", never}));
    run.wait_until([&]() {
      return is_finished("uniform_1") && lines("study/uniform_2") > 50;
    });
    run.send(SIGTERM);
    run.wait();
    EXPECT_EQ(run.outcome(), -SIGTERM);
    EXPECT_TRUE(contains(run.err(), "--resume"));
  }
  ASSERT_TRUE(fs::exists(path("study/uniform_2/checkpoint")));
  const auto kept = fs::last_write_time(path("study/uniform_1/history.csv"));
  const auto other =
    process.run(refine({"--resume", "--set", "Block/Degree=2"}));
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_TRUE(contains(other.err, "Block/Degree"));

  const auto result = process.run(refine({"--resume"}));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const std::string part : {"uniform 1: Finished earlier",
                                 "uniform 2: Resumed after step",
                                 "Report: "})
    EXPECT_TRUE(contains(result.out, part));
  EXPECT_EQ(fs::last_write_time(path("study/uniform_1/history.csv")), kept);
  for (const std::string folder : {"uniform_0", "uniform_1", "uniform_2"})
    EXPECT_TRUE(is_finished(folder)) << folder;

  const std::string fine = "Block/Refinement=uniform 2";
  EXPECT_EQ(
    run("undisturbed", {"--quiet", "--set", fine, "--set", steps}).exit_code,
    0);
  EXPECT_TRUE(history("study/uniform_2") == history("undisturbed"));
}



// Every preconditioner is made again as it was.
TEST_F(Restart, DoesNotDependOnTheSolver)
{
  process.write("case.prm",
                "set Loading/Programme = press 1 MPa in 1 s; \\\n"
                "  slide 1 mm/s for 0.2 mm at 20 deg\n"
                "set Block/Subdivisions = 6, 6, 3\n"
                "set Block/Degree = 1\n"
                "set Time stepping/Tolerance = 1e-3\n"
                "set Output/Fields = none\n");
  for (const std::string solver : {"direct", "amg", "automatic"})
    {
      SCOPED_TRACE(solver);
      const std::string setting = "Block/Solver=" + solver;
      const std::string whole = solver + " whole", parts = solver + " parts";
      ASSERT_EQ(run(whole, {"--quiet", "--set", setting}).exit_code, 0);
      for (const std::size_t n_lines : {10, 30})
        {
          std::vector<std::string> more = {
            "--set", setting, "--set", often, "--resume"};
          run_and_kill(parts, n_lines, more);
        }
      const auto result = run(parts, {"--set", setting, "--resume", "--quiet"});
      EXPECT_EQ(result.exit_code, 0) << result.err;
      EXPECT_TRUE(history(parts) == history(whole));
    }
}



// The mesh, its history and all that decides about its next change.
TEST_F(Restart, OnAnAdaptiveMeshGoesOnBitForBit)
{
  process.write("case.prm",
                "set Loading/Programme = press 1 MPa in 1 s; \\\n"
                "  slide 1 mm/s for 0.05 mm; slide -1 mm/s for 0.05 mm\n"
                "set Block/Dimension = 2\n"
                "set Block/Size = 10 mm, 5 mm\n"
                "set Block/Subdivisions = 8, 4\n"
                "set Block/Degree = 2\n"
                "set Block/Solver = multigrid\n"
                "set Block/Refinement = adaptive 2\n"
                "set Time stepping/Tolerance = 1e-3\n"
                "set Output/Fields = none\n");
  ASSERT_EQ(run("whole", {"--quiet"}).exit_code, 0);
  const auto changes = [&](const std::string &output) {
    return process.read(output + "/refinement.csv");
  };
  const std::string expected_changes = changes("whole");
  EXPECT_GT(std::count(expected_changes.begin(), expected_changes.end(), '\n'),
            2);
  for (const std::size_t n_lines : {10, 30, 50})
    run_and_kill("parts", n_lines, {"--set", often, "--resume"});
  const auto result = run("parts", {"--resume", "--quiet"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(history("parts") == history("whole"));
  EXPECT_EQ(changes("parts"), expected_changes);
}



// Fields are written at the same steps, and all of them are listed.
TEST_F(Restart, OfFieldsEverySoOftenGoesOnWithTheSameCadence)
{
  for (const std::string every :
       {"every 0.05 mm", "every 30 ms", "every 7 steps"})
    {
      SCOPED_TRACE(every);
      const std::string folder  = every.substr(every.rfind(' ') + 1);
      const std::string setting = "Output/Fields=" + every;
      const auto        listed  = [&](const std::string &output) {
        const std::string list = process.read(output + "/fields.pvd");
        return list.substr(list.find("<VTKFile")); // a date goes before
      };
      ASSERT_EQ(run("whole" + folder, {"--quiet", "--set", setting}).exit_code,
                0);
      for (const std::size_t n_lines : {120, 220})
        run_and_kill("parts" + folder,
                     n_lines,
                     {"--set", setting, "--set", often, "--resume"});
      const auto result =
        run("parts" + folder, {"--set", setting, "--resume", "--quiet"});
      EXPECT_EQ(result.exit_code, 0) << result.err;
      const std::string list = listed("whole" + folder);
      EXPECT_EQ(listed("parts" + folder), list);
      EXPECT_GT(std::count(list.begin(), list.end(), '\n'), 15);
      // What is listed is there.
      const std::regex name("file=\"([^\"]+)\"");
      for (std::sregex_iterator it(list.begin(), list.end(), name), end;
           it != end;
           ++it)
        EXPECT_TRUE(fs::exists(path("parts" + folder + "/" + (*it)[1].str())))
          << (*it)[1];
    }
}



TEST(Stop, ACalibrationEndsAtOnceAndWritesNothing)
{
  const SlipstepProcess process;
  std::string           rows = "time_s,displacement_mm,pressure_MPa,friction\n";
  for (int i = 0; i < 2000; ++i)
    rows += std::to_string(i) + "," + std::to_string(0.01 * i) + ",5.8," +
            std::to_string(0.1 + 0.001 * (i % 7)) + "\n";
  process.write("test.csv", rows);
  process.write("case.prm",
                "set Calibration/Tests = test.csv\n"
                "set Calibration/Starts = 1000\n"
                "set Calibration/Parameters = Friction/Static coefficient from "
                "0.099 to 1; Friction/overstress/Viscosity from 1 to 1e9\n");
  BackgroundRun run(process.folder(), {"calibrate", "case.prm"});
  ASSERT_TRUE(run.wait_until(
    [&]() { return run.out().find("starts searched") != std::string::npos; }))
    << run.err();
  const auto begin = std::chrono::steady_clock::now();
  run.send(SIGTERM);
  run.wait();
  EXPECT_LT(std::chrono::steady_clock::now() - begin,
            std::chrono::seconds(100));
  EXPECT_EQ(run.outcome(), -SIGTERM);
  EXPECT_TRUE(contains(run.err(), "nothing was written"));
  EXPECT_FALSE(fs::exists(process.folder() / "output"));
}



// Values that were found are not lost with their intervals.
TEST(Calibrate, KeepsTheValuesThatAreFound)
{
  const SlipstepProcess process;
  std::string           rows = "time_s,displacement_mm,pressure_MPa,friction\n";
  for (int i = 0; i < 30000; ++i)
    rows +=
      std::to_string(0.01 * i) + "," + std::to_string(1e-4 * i) + ",5.8," +
      std::to_string((i < 9 ? 0.01 * i : 0.1) + 1e-4 * (i * i % 7)) + "\n";
  process.write("test.csv", rows);
  process.write("case.prm",
                "set Calibration/Tests = test.csv\n"
                "set Calibration/Starts = 1\n"
                "set Calibration/Parameters = Friction/Static coefficient from "
                "0.05 to 1; Friction/overstress/Viscosity from 1 to 1e9; "
                "Friction/overstress/Exponent from 5 to 50; "
                "Friction/subloading/Rate from 1 to 1e5\n");
  BackgroundRun run(process.folder(), {"calibrate", "case.prm"});
  ASSERT_TRUE(run.wait_until(
    [&]() { return run.out().find("interval 1 of 4") != std::string::npos; }))
    << run.err();
  run.send(SIGINT);
  run.wait();
  EXPECT_EQ(run.outcome(), -SIGINT);
  const std::string words = run.out() + run.err();
  EXPECT_TRUE(contains(words, "the curvature at the optimum alone is used"));
  EXPECT_TRUE(
    fs::exists(process.folder() / "output/case/calibrate/fitted.prm"));
}
