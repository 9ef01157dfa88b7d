// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tests_restart_restart_tools_h
#define tests_restart_restart_tools_h

#include <slipstep/experiment/history.h>
#include <slipstep/experiment/summary.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "background_run.h"
#include "tests/bad_input/slipstep_process.h"

namespace SlipStep::Testing
{
  namespace fs = std::filesystem;

  /// Some hundred quick steps of a small block in 2-D, with fields on the way.
  const std::string small_case =
    "set Loading/Programme = press 1 MPa in 1 s; slide 1 mm/s for 0.5 mm; \\\n"
    "  slide -1 mm/s for 0.2 mm\n"
    "set Block/Dimension = 2\n"
    "set Block/Size = 10 mm, 5 mm\n"
    "set Block/Subdivisions = 8, 4\n"
    "set Block/Degree = 1\n"
    "set Time stepping/Least steps per statement = 100\n";

  /// Writing takes most of the time then.
  const std::string often = "Checkpoint/Every=10 ms";
  const std::string never = "Checkpoint/Every=0 s";

  /// Every checkpoint waits for the disk, several times. A process that is
  /// killed shows the same in memory, which does not make it wait.
  struct FolderInMemory
  {
    FolderInMemory()
    {
      if (access("/dev/shm", W_OK | X_OK) == 0)
        setenv("TMPDIR", "/dev/shm", 1);
    }
  };

  inline bool has_mpirun()
  {
    return std::system("command -v mpirun > /dev/null") == 0;
  }

  inline const std::vector<std::string> two_ranks = {"mpirun",
                                                     "--oversubscribe",
                                                     "--allow-run-as-root",
                                                     "-np",
                                                     "2"};

  inline std::string joined(const std::vector<std::string> &words)
  {
    std::string text;
    for (const std::string &word : words)
      text += word + " ";
    return text;
  }

  /// A working directory with case.prm.
  class RestartTest : public testing::Test
  {
  protected:
    explicit RestartTest(const std::string &text = small_case)
    {
      process.write("case.prm", text);
    }

    /// Run the case to its end.
    SlipstepProcess::Result run(const std::string              &output,
                                const std::vector<std::string> &more     = {},
                                const std::string              &launcher = "",
                                const std::string              &set_up   = "")
    {
      return process.run(arguments(output, more), launcher, set_up);
    }

    /// Run the case until its history has so many lines, then kill it.
    void run_and_kill(const std::string              &output,
                      const std::size_t               n_lines,
                      const std::vector<std::string> &more = {})
    {
      BackgroundRun run(process.folder(), arguments(output, more));
      ASSERT_TRUE(run.wait_until([&]() { return lines(output) >= n_lines; }))
        << run.err();
      run.send(SIGKILL);
      run.wait();
      ASSERT_EQ(run.outcome(), -SIGKILL) << "it was too quick";
    }

    std::vector<std::string>
    arguments(const std::string              &output,
              const std::vector<std::string> &more) const
    {
      std::vector<std::string> words = {"run", "case.prm", "--output", output};
      words.insert(words.end(), more.begin(), more.end());
      return words;
    }

    fs::path path(const std::string &name) const
    {
      return process.folder() / name;
    }

    std::size_t lines(const std::string &output) const
    {
      const std::string text = history(output);
      return std::count(text.begin(), text.end(), '\n');
    }

    std::string history(const std::string &output) const
    {
      return process.read(output + "/history.csv");
    }

    void copy(const std::string &from, const std::string &to) const
    {
      fs::copy(path(from), path(to), fs::copy_options::recursive);
    }

    /// The history of the run that nobody disturbed.
    const std::string &expected()
    {
      if (undisturbed.empty())
        {
          const auto result = run("undisturbed", {"--quiet", "--set", never});
          EXPECT_EQ(result.exit_code, 0) << result.err;
          undisturbed = history("undisturbed");
        }
      return undisturbed;
    }

    void expect_finished(const std::string &output)
    {
      EXPECT_TRUE(history(output) == expected())
        << output << ": history.csv is another one";
      EXPECT_EQ(read_summary(path(output) / "summary.json").status, "finished");
      for (const std::string name : {"", ".previous", ".new"})
        EXPECT_FALSE(fs::exists(path(output) / ("checkpoint" + name)));
    }

  private:
    const FolderInMemory in_memory;

  protected:
    const SlipstepProcess process;

  private:
    std::string undisturbed;
  };
} // namespace SlipStep::Testing

#endif
