// SPDX-License-Identifier: LGPL-2.1-or-later

// Checkpoints that are damaged, of something else, or cannot be written.

#include <map>

#include "tests/file_text.h"
#include "restart_tools.h"

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  class Damage : public RestartTest
  {
  protected:
    /// A run that was killed and left two checkpoints.
    void make_victim()
    {
      // Between two renamings there is one only, for a moment; then again.
      for (unsigned int attempt = 0; attempt < 5; ++attempt)
        {
          fs::remove_all(path("victim"));
          run_and_kill("victim", 120, {"--set", often});
          if (fs::exists(path("victim/checkpoint")) &&
              fs::exists(path("victim/checkpoint.previous")))
            return;
        }
      FAIL() << "no two checkpoints were left";
    }

    void shorten(const std::string &file, const double share) const
    {
      fs::resize_file(path(file),
                      static_cast<std::uintmax_t>(share *
                                                  fs::file_size(path(file))));
    }

    void replace(const std::string &file,
                 const std::string &from,
                 const std::string &to) const
    {
      std::string       text = process.read(file);
      const std::size_t at   = text.find(from);
      ASSERT_NE(at, std::string::npos);
      process.write(file, text.replace(at, from.size(), to));
    }

    std::map<std::string, std::string> contents(const std::string &folder) const
    {
      std::map<std::string, std::string> files;
      for (const auto &entry : fs::recursive_directory_iterator(path(folder)))
        if (entry.is_regular_file() && entry.path().filename() != ".slipstep")
          files[entry.path().string()] = content(entry.path());
      return files;
    }

    /// Refused by name, with nothing changed.
    void expect_refused(const std::string              &output,
                        const std::vector<std::string> &more,
                        const std::vector<std::string> &words)
    {
      const auto before = contents(output);
      const auto result = run(output, more);
      EXPECT_EQ(result.exit_code, 2) << result.err;
      EXPECT_EQ(result.n_error_lines(), 1u) << result.err;
      for (const std::string &word : words)
        EXPECT_TRUE(contains(result.err, word))
          << "  \"" << word << "\" is not in: " << result.err;
      EXPECT_TRUE(contents(output) == before);
    }
  };
} // namespace



TEST_F(Damage, GivesWayToThePreviousCheckpoint)
{
  make_victim();
  const std::map<std::string, std::string> harms = {
    {"cells.0", "cells.0 has "},
    {"manifest.json", "manifest.json is incomplete"},
    {"block", "block has "}};
  for (const auto &harm : harms)
    {
      SCOPED_TRACE(harm.first);
      const std::string output = "without " + harm.first;
      copy("victim", output);
      shorten(output + "/checkpoint/" + harm.first, 0.5);
      const auto result = run(output, {"--resume", "--quiet"});
      EXPECT_EQ(result.exit_code, 0) << result.err;
      EXPECT_EQ(result.n_error_lines(), 1u) << result.err;
      for (const std::string &word :
           std::vector<std::string>{"warning: ", harm.second, ".previous"})
        EXPECT_TRUE(contains(result.err, word));
      expect_finished(output);
      EXPECT_EQ(read_summary(path(output) / "summary.json").warnings.size(),
                1u);
    }

  // A bit that has flipped.
  copy("victim", "flipped");
  std::string cells = process.read("flipped/checkpoint/cells.0");
  cells[cells.size() / 2] ^= 1;
  process.write("flipped/checkpoint/cells.0", cells);
  const auto result = run("flipped", {"--resume", "--quiet"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_TRUE(contains(result.err, "cells.0 has changed"));
  expect_finished("flipped");
}



// The damaged one must not push the good one out.
TEST_F(Damage, IsSurvivedByTheGoodCheckpoint)
{
  make_victim();
  shorten("victim/checkpoint/block", 0.3);
  for (unsigned int i = 0; i < 3; ++i)
    {
      const std::size_t before = lines("victim");
      BackgroundRun     run(process.folder(),
                        arguments("victim", {"--set", often, "--resume"}));
      run.wait_until([&]() { return lines("victim") > before + 5; });
      run.send(SIGKILL);
      run.wait();
      EXPECT_EQ(run.outcome(), -SIGKILL);
    }
  EXPECT_EQ(run("victim", {"--resume"}).err, "");
  expect_finished("victim");
}



TEST_F(Damage, OfAllCheckpointsIsTold)
{
  make_victim();
  shorten("victim/checkpoint/cells.0", 0.5);
  shorten("victim/checkpoint.previous/manifest.json", 0.5);
  expect_refused("victim",
                 {"--resume"},
                 {"no checkpoint can be used", "cells.0", "manifest.json"});
}



TEST_F(Damage, OfTheHistoryIsTold)
{
  make_victim();
  shorten("victim/history.csv", 0.1);
  expect_refused("victim", {"--resume"}, {"history.csv has "});
}



TEST_F(Damage, NoneButAnotherCaseIsRefusedByName)
{
  make_victim();
  const auto with = [](const std::string &setting) {
    return std::vector<std::string>{"--resume", "--set", setting};
  };
  expect_refused("victim",
                 with("Block/Subdivisions=4, 4"),
                 {"--set Block/Subdivisions = 4, 4", "checkpoint", "'8, 4'"});
  expect_refused("victim",
                 with("Friction/Static coefficient=0.3"),
                 {"Friction/Static coefficient"});
  expect_refused("victim",
                 with("Loading/Programme=press 2 MPa in 1 s"),
                 {"Loading/Programme", "press 1 MPa"});
  expect_refused("victim", with("Block/Solver=amg"), {"Block/Solver"});

  // The same in other words is the same, and so is what results do not see.
  copy("victim", "reworded");
  EXPECT_EQ(run("reworded",
                {"--resume",
                 "--quiet",
                 "--set",
                 "Block/Young modulus = 206000 MPa",
                 "--set",
                 "Report/Title = Another"})
              .err,
            "");
  expect_finished("reworded");
  expect_refused("reworded",
                 with("Block/Degree=2"),
                 {"Block/Degree = 2", "finished run"});
  expect_refused("reworded",
                 with("Contact/Strength=1 - 0.1*(x > 5)"),
                 {"Contact/Strength", "finished run"});

  const auto result =
    process.run({"point", "case.prm", "--output", "victim", "--resume"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_TRUE(contains(result.err, "results of slipstep run"));
}



TEST_F(Damage, NoneButAnotherProgramIsRefusedByName)
{
  make_victim();
  copy("victim", "format");
  replace("format/checkpoint/manifest.json", "\"format\": ", "\"format\": 9");
  expect_refused("format", {"--resume"}, {"has format 9", "reads format"});
  copy("victim", "version");
  replace("version/checkpoint/manifest.json",
          "\"version\": \"",
          "\"version\": \"9.");
  expect_refused("version", {"--resume"}, {"written by slipstep 9."});
}



TEST_F(Damage, AFullDiskIsToldAndTheRunGoesOn)
{
  // Few rows and many unknowns, so that the checkpoint is the larger file.
  process.write("case.prm",
                "set Loading/Programme = press 1 MPa in 1 s\n"
                "set Block/Dimension = 2\n"
                "set Block/Size = 10 mm, 5 mm\n"
                "set Block/Subdivisions = 64, 32\n"
                "set Block/Degree = 1\n"
                "set Output/Fields = none\n");
  for (const bool is_killed : {false, true})
    {
      const std::string output = is_killed ? "killed" : "finished";
      BackgroundRun     run(process.folder(),
                        arguments(output, {"--quiet", "--set", often}));
      ASSERT_TRUE(run.wait_until(
        [&]() { return fs::exists(path(output) / "checkpoint"); }));
      // Enough for the history, not for the checkpoint.
      run.limit_file_size(32000);
      ASSERT_TRUE(run.wait_until([&]() {
        return run.err().find("the last one is of step ") != std::string::npos;
      }));
      if (is_killed)
        run.send(SIGKILL);
      else
        // Somebody has made room.
        run.limit_file_size(RLIM_INFINITY);
      run.wait();
      ASSERT_EQ(run.outcome(), is_killed ? -SIGKILL : 0);
      const std::string message = run.err();
      EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 1);
      for (const std::string part : {"warning: no checkpoint could be written",
                                     "see ulimit -f",
                                     "the last one is of step "})
        EXPECT_TRUE(contains(message, part));
      if (is_killed)
        {
          const auto resumed = RestartTest::run(output, {"--resume"});
          EXPECT_EQ(resumed.exit_code, 0);
          EXPECT_EQ(resumed.err, "");
          EXPECT_TRUE(contains(resumed.out, "Resumed after"));
        }
      expect_finished(output);
    }
}
