// SPDX-License-Identifier: LGPL-2.1-or-later

// Trouble from outside while the program works: folders that go, disks that
// take nothing, pictures that nobody draws.

#include <gtest/gtest.h>

#include <sys/stat.h>

#include <filesystem>
#include <string>

#include "slipstep_process.h"
#include "tests/restart/background_run.h"

namespace
{
  // More work than anybody waits for.
  const char *const endless =
    "set Loading/Programme = press 1 MPa in 1 s; slide 1 mm/s for 1 mm\n"
    "set Block/Subdivisions = 1, 1, 1\n"
    "set Block/Degree = 1\n"
    "set Time stepping/Least steps per statement = 1000000\n"
    "set Output/Fields = none\n";

  // A gnuplot of the user's own.
  void write_gnuplot(const SlipstepProcess &process, const std::string &script)
  {
    std::filesystem::create_directory(process.folder() / "bin");
    process.write("bin/gnuplot", "#!/bin/sh\n" + script);
    chmod((process.folder() / "bin/gnuplot").c_str(), 0755);
  }

  const char *const own_gnuplot = "PATH=$PWD/bin:$PATH; export PATH;";
} // namespace



TEST(Disturbed, ALostFolderIsToldAtOnce)
{
  for (const std::string lost : {"output/case", "output"})
    {
      const SlipstepProcess process;
      process.write("case.prm", endless);
      BackgroundRun run(process.folder(), {"run", "case.prm"});
      const auto    history = process.folder() / "output/case/history.csv";
      ASSERT_TRUE(run.wait_until([&]() {
        return std::filesystem::exists(history) &&
               std::filesystem::file_size(history) > 1000;
      }))
        << run.err();
      std::filesystem::rename(process.folder() / lost,
                              process.folder() / "moved");
      run.wait();
      EXPECT_EQ(run.outcome(), 1);
      const std::string err = run.err();
      EXPECT_TRUE(contains(err, "cannot be written (its folder has gone)"));
      EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << err;
    }
}



TEST(Disturbed, AReadOnlyDiskIsRefusedBeforeAnyWork)
{
  const SlipstepProcess process;
  process.write("case.prm", right);
  // Root may write everywhere but on a file system that is read-only.
  const std::string mount =
    "unshare -rm sh -c 'mount -t tmpfs -o ro none output && exec \"$0\" "
    "\"$@\"'";
  std::filesystem::create_directory(process.folder() / "output");
  const bool  is_root  = geteuid() == 0;
  std::string launcher = is_root ? mount : "";
  if (is_root && std::system("unshare -rm sh -c 'mount -t tmpfs none /mnt' "
                             "> /dev/null 2>&1") != 0)
    GTEST_SKIP() << "nothing can be mounted here";
  if (!is_root)
    chmod((process.folder() / "output").c_str(), 0555);
  for (const std::string command : {"run", "point"})
    {
      const auto result = process.run({command, "case.prm"}, launcher);
      EXPECT_NE(result.exit_code, 0);
      EXPECT_EQ(result.n_error_lines(), 1u) << result.err;
      EXPECT_TRUE(contains(result.err, "output"));
      EXPECT_TRUE(contains(result.err, is_root ? "read-only" : "permission"));
    }
}



TEST(Disturbed, WithoutGnuplotThereAreNumbersButNoPictures)
{
  const SlipstepProcess process;
  process.write("case.prm", right);
  write_gnuplot(process, "exit 127\n");
  const auto result = process.run({"point", "case.prm"}, "", own_gnuplot);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_TRUE(contains(result.err, "warning: no picture"));
  EXPECT_TRUE(
    contains(process.read("output/case/point/summary.json"), "finished"));
  EXPECT_TRUE(std::filesystem::exists(process.folder() /
                                      "output/case/point/report.html"));
}



// That it gets a minute and no more is seen in
// RunProgram.OneThatHangsIsStopped.
TEST(Disturbed, AGnuplotThatHangsDoesNotHoldASignalUp)
{
  const SlipstepProcess process;
  process.write("case.prm", right);
  write_gnuplot(process, "touch hangs; exec sleep 3600\n");
  BackgroundRun run(
    process.folder(),
    {"point", "case.prm"},
    {"env", "PATH=" + (process.folder() / "bin").string() + ":/usr/bin:/bin"});
  const auto is_at_work = [&]() {
    for (const auto &entry :
         std::filesystem::recursive_directory_iterator(process.folder()))
      if (entry.path().filename() == "hangs")
        return true;
    return false;
  };
  ASSERT_TRUE(run.wait_until(is_at_work)) << run.err();
  run.send(SIGTERM);
  run.wait();
  EXPECT_EQ(run.outcome(), -SIGTERM);
  EXPECT_TRUE(contains(run.err(), "stopped by a signal"));
  EXPECT_TRUE(
    contains(process.read("output/case/point/summary.json"), "finished"));
}
