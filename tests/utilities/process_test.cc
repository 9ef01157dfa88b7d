// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/utilities/process.h>

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>

#include "tests/temporary_folder.h"

using namespace SlipStep;

namespace
{
  const std::chrono::seconds hour(3600);

  ProgramEnd run(const std::string         &command,
                 const std::chrono::seconds limit = hour)
  {
    return run_program({"sh", "-c", command}, test_folder(), "log", limit);
  }
} // namespace



TEST(RunProgram, TellsHowItEnded)
{
  EXPECT_EQ(run("exit 0"), ProgramEnd::success);
  EXPECT_EQ(run("exit 3"), ProgramEnd::failure);
  EXPECT_EQ(run("kill -9 $$"), ProgramEnd::failure);
  EXPECT_EQ(run_program({"no-such-program"}, test_folder(), "log", hour),
            ProgramEnd::not_found);
}



TEST(RunProgram, KeepsWhatItPrintsAndGivesNoInput)
{
  EXPECT_EQ(run("pwd; cat; echo wrong >&2"), ProgramEnd::success);
  std::ifstream in(test_folder() / "log");
  std::string   first, second;
  std::getline(in, first);
  std::getline(in, second);
  EXPECT_TRUE(std::filesystem::equivalent(first, test_folder())) << first;
  EXPECT_EQ(second, "wrong");
}



TEST(RunProgram, OneThatHangsIsStopped)
{
  EXPECT_EQ(run("exec sleep 3600", std::chrono::seconds(1)),
            ProgramEnd::too_slow);
}



TEST(RunProgram, ASignalStopsBoth)
{
  const SignalGuard guard;
  std::raise(SIGTERM);
  EXPECT_EQ(run("exec sleep 3600"), ProgramEnd::stopped);
}
