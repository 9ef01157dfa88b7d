// SPDX-License-Identifier: LGPL-2.1-or-later

// Killed again and again, a run always goes on, and nobody sees it in the end.

#include <random>

#include "restart_tools.h"

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  class Kill : public RestartTest
  {
  protected:
    Kill()
    {
      fs::create_directories(path("cases"));
      fs::create_directories(path("elsewhere"));
      fs::create_directories(path("results"));
    }

    // The case, what goes into which folders of results/, and the launcher.
    struct Victim
    {
      std::string              text;
      std::vector<std::string> members;
      std::vector<std::string> launcher;
    };

    // From a folder that holds neither the case nor the results.
    std::vector<std::string>
    words_for(const std::string              &output,
              const std::vector<std::string> &more) const
    {
      std::vector<std::string> words = {"run",
                                        path("cases/case.prm").string(),
                                        "--output",
                                        path("results/" + output).string()};
      words.insert(words.end(), more.begin(), more.end());
      return words;
    }

    SlipstepProcess::Result finish(const Victim                   &victim,
                                   const std::string              &output,
                                   const std::vector<std::string> &more) const
    {
      return process.run(words_for(output, more),
                         joined(victim.launcher),
                         "cd elsewhere &&");
    }

    std::string histories(const Victim &victim, const std::string &output) const
    {
      std::string text;
      for (const std::string &member : victim.members)
        text += history("results/" + output + "/" + member);
      return text;
    }

    void expect_undisturbed(const Victim &victim) const
    {
      EXPECT_TRUE(histories(victim, "victim") ==
                  histories(victim, "undisturbed"))
        << "history.csv is another one";
      for (const std::string &member : victim.members)
        {
          const fs::path folder = path("results/victim") / member;
          EXPECT_EQ(read_summary(folder / "summary.json").status, "finished");
          for (const std::string name : {"", ".previous", ".new"})
            EXPECT_FALSE(fs::exists(folder / ("checkpoint" + name)));
        }
    }

    // Two of three are killed at work, the others at any moment, starting and
    // resuming included.
    void kill(const Victim &victim, const unsigned int n_kills)
    {
      process.write("cases/case.prm", victim.text);
      const auto undisturbed =
        finish(victim, "undisturbed", {"--quiet", "--set", never});
      ASSERT_EQ(undisturbed.exit_code, 0) << undisturbed.err;

      std::mt19937                           random(20261121);
      std::uniform_real_distribution<double> uniform(0., 1.);
      unsigned int                           n_killed = 0, n_going_on = 0;
      bool                                   is_first = true;
      // On a loaded machine many are killed before they can go on from
      // anything: then it takes more.
      while (n_killed < n_kills || n_going_on < n_kills / 3)
        {
          SCOPED_TRACE("after " + std::to_string(n_killed) + " kills");
          std::vector<std::string> more = {"--set", often};
          if (!is_first)
            more.emplace_back("--resume");
          is_first                 = false;
          const std::string before = histories(victim, "victim");
          BackgroundRun     run(path("elsewhere"),
                            words_for("victim", more),
                            victim.launcher);
          double            delay = 0.8 * uniform(random);
          if (uniform(random) < 0.67)
            {
              run.wait_until([&]() {
                const std::string now = histories(victim, "victim");
                return now.size() > 600 && now != before;
              });
              delay = 0.2 * uniform(random);
            }
          std::this_thread::sleep_for(std::chrono::duration<double>(delay));
          run.kill_all();
          run.wait();

          // No damage was met; which would be one line.
          ASSERT_EQ(run.err(), "");
          n_going_on += run.out().find("Resumed after") != std::string::npos;
          if (run.outcome() == -SIGKILL)
            {
              ++n_killed;
              for (const std::string &member : victim.members)
                if (lines("results/victim/" + member) > 3)
                  read_history(path("results/victim/" + member) /
                               "history.csv");
            }
          else
            {
              // It came to its end before: once more from the beginning.
              ASSERT_EQ(run.outcome(), 0);
              expect_undisturbed(victim);
              is_first = true;
            }
        }

      const auto last = finish(victim, "victim", {"--resume"});
      ASSERT_EQ(last.exit_code, 0) << last.err;
      EXPECT_EQ(last.err, "");
      expect_undisturbed(victim);
    }
  };
} // namespace



TEST_F(Kill, ThirtyTimesAndTheHistoryIsTheSameBitForBit)
{
  kill({small_case, {""}, {}}, 30);
  EXPECT_GE(read_summary(path("results/victim/summary.json")).sessions, 2u);
}



TEST_F(Kill, TwentyTimesInASweep)
{
  kill({small_case + "subsection Variants\n"
                     "  subsection slow\n"
                     "  end\n"
                     "  subsection fast\n"
                     "    set Loading/Programme = press 1 MPa in 1 s; "
                     "slide 2 mm/s for 0.5 mm\n"
                     "  end\n"
                     "end\n",
        {"slow", "fast"},
        {}},
       20);
}



TEST_F(Kill, TenTimesOnTwoRanks)
{
  if (!has_mpirun())
    GTEST_SKIP() << "mpirun is missing";
  kill({small_case, {""}, two_ranks}, 10);
}
