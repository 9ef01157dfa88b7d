// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/commands/sweep.h>

#include <gtest/gtest.h>

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <string>
#include <vector>

#include "tests/file_text.h"

using namespace SlipStep;

namespace
{
  SweepJob shell(const std::string &label, const std::string &script)
  {
    return {label, {"/bin/sh", "-c", script}};
  }



  double seconds_since(const std::chrono::steady_clock::time_point start)
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() -
                                         start)
      .count();
  }
} // namespace



TEST(Sweep, OneFailureStopsNoOther)
{
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const std::vector<int> codes =
    run_side_by_side({shell("first", "exit 0"),
                      shell("second", "echo the block tips over >&2; exit 1"),
                      shell("third", "sleep 0.2; echo a note; exit 2"),
                      shell("fourth", "kill -SEGV $$"),
                      {"fifth", {"/nowhere/slipstep"}},
                      shell("sixth", "exit 0")},
                     "sweep",
                     false,
                     2);
  const std::string out = testing::internal::GetCapturedStdout();
  const std::string err = testing::internal::GetCapturedStderr();
  EXPECT_EQ(codes, (std::vector<int>{0, 1, 2, 1, 1, 0}));
  EXPECT_TRUE(contains(err, "second: the block tips over\n"));
  EXPECT_TRUE(contains(err, "fourth: stopped by signal 11"));
  EXPECT_TRUE(contains(err, "fifth: cannot be started"));
  EXPECT_TRUE(contains(out, "third: a note\n"));
}



TEST(Sweep, ShowsOneProgressForAll)
{
  testing::internal::CaptureStdout();
  run_side_by_side({shell("a", "echo '[ 50.0 %] a: half, 3 s left'; sleep 0.5"),
                    shell("b", "sleep 0.5")},
                   "case",
                   false,
                   2);
  const std::string out = testing::internal::GetCapturedStdout();
  EXPECT_TRUE(contains(out, "[ 25.0 %] case: 0 of 2 done; a 50 %; b 0 %"));
  EXPECT_FALSE(contains(out, "half"));
}



TEST(Sweep, RunsSideBySideUpToTheLimit)
{
  const std::vector<SweepJob> jobs(4, shell("job", "sleep 0.5"));
  auto                        start = std::chrono::steady_clock::now();
  run_side_by_side(jobs, "", true, 4);
  EXPECT_LT(seconds_since(start), 1.8);
  start = std::chrono::steady_clock::now();
  run_side_by_side(jobs, "", true, 2);
  EXPECT_GT(seconds_since(start), 0.99);
}



TEST(Sweep, GivesEachChildOneThreadAndNoInput)
{
  testing::internal::CaptureStdout();
  const std::vector<int> codes = run_side_by_side(
    {shell(
      "job",
      "test \"$DEAL_II_NUM_THREADS$OMP_NUM_THREADS\" = 11 && ! read line")},
    "",
    true);
  testing::internal::GetCapturedStdout();
  EXPECT_EQ(codes.front(), 0);
}



// A terminated parent must take its children with it and be seen to have been
// terminated.
TEST(Sweep, StopsTheChildrenWhenStopped)
{
  int alive[2];
  ASSERT_EQ(pipe(alive), 0);
  const pid_t parent = fork();
  if (parent == 0)
    {
      // The children inherit the writing end: it closes with the last of them.
      close(alive[0]);
      run_side_by_side({shell("a", "exec sleep 30"),
                        shell("b", "exec sleep 30")},
                       "",
                       true,
                       2);
      _exit(0);
    }
  close(alive[1]);
  usleep(500000);
  const auto start = std::chrono::steady_clock::now();
  kill(parent, SIGTERM);
  int status = 0;
  waitpid(parent, &status, 0);
  char nothing;
  EXPECT_EQ(read(alive[0], &nothing, 1), 0);
  close(alive[0]);
  EXPECT_LT(seconds_since(start), 10.);
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(WTERMSIG(status), SIGTERM);
}
