// SPDX-License-Identifier: LGPL-2.1-or-later

// Commands and processes do not take each other's results away.

#include <gtest/gtest.h>

#include <fstream>

#include "tests/file_text.h"
#include "restart_tools.h"

using namespace SlipStep::Testing;

namespace
{
  class SharedFolder : public RestartTest
  {};
} // namespace



TEST_F(SharedFolder, ASecondRunIsTold)
{
  BackgroundRun first(process.folder(), arguments("output", {"--quiet"}));
  ASSERT_TRUE(first.wait_until([&]() { return lines("output") > 3; }));
  first.send(SIGSTOP);
  for (const auto &more : {std::vector<std::string>{},
                           std::vector<std::string>{"--resume"},
                           std::vector<std::string>{"--set", "Block/Degree=2"}})
    {
      const auto second = run("output", more);
      EXPECT_EQ(second.exit_code, 2);
      EXPECT_EQ(second.n_error_lines(), 1u) << second.err;
      EXPECT_TRUE(
        contains(second.err, "output is in use by slipstep run, process "));
    }
  first.send(SIGCONT);
  first.wait();
  EXPECT_EQ(first.outcome(), 0) << first.err();
  expect_finished("output");
}



TEST_F(SharedFolder, ASecondRunOnTwoRanksIsTold)
{
  BackgroundRun first(process.folder(), arguments("output", {"--quiet"}));
  ASSERT_TRUE(first.wait_until([&]() { return lines("output") > 3; }));
  first.send(SIGSTOP);
  const auto second =
    run("output", {}, "mpirun --oversubscribe --allow-run-as-root -q -np 2");
  EXPECT_EQ(second.exit_code, 2);
  EXPECT_TRUE(contains(second.err, "is in use by"));
  first.send(SIGCONT);
  first.wait();
  expect_finished("output");
}



TEST_F(SharedFolder, EveryCommandHasItsOwn)
{
  // What export leaves there is no foreign file.
  EXPECT_EQ(process.run({"export", "case.prm", "--quiet"}).exit_code, 0);
  for (const std::string command : {"point", "run", "refine"})
    {
      std::vector<std::string> words = {command, "case.prm", "--quiet"};
      if (command == "refine")
        words.insert(words.end(),
                     {"--set",
                      "Refinement study/Uniform meshes=3",
                      "--set",
                      "Output/Quantities=peak coefficient"});
      const auto result = process.run(words);
      EXPECT_EQ(result.exit_code, 0) << command << '\n' << result.err;
    }
  for (const std::string page :
       {"output/case", "output/case/point", "output/case/refine"})
    EXPECT_TRUE(fs::exists(path(page) / "report.html")) << page;
  // Again, each finds its own.
  EXPECT_EQ(process.run({"run", "case.prm", "--quiet"}).exit_code, 0);

  const std::string page = process.read("output/case/point/report.html");
  const auto        wrong =
    process.run({"run", "case.prm", "--output", "output/case/point"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_TRUE(contains(wrong.err, "holds results of slipstep point, not of"));
  EXPECT_TRUE(process.read("output/case/point/report.html") == page);
}



TEST_F(SharedFolder, ARefusedRunLeavesNoFolderBehind)
{
  process.write("follow.prm",
                "set Calibration/Tests = nowhere\n"
                "set Calibration/Parameters = Friction/Static "
                "coefficient from 0.05 to 0.5\n");
  EXPECT_EQ(process.run({"calibrate", "follow.prm"}).exit_code, 2);
  EXPECT_FALSE(fs::exists(path("output")));
}
