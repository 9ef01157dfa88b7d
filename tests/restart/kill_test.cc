// Killed again and again, a run always goes on, and nobody sees it in the end.

#include <random>

#include "restart_tools.h"

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  class Kill : public RestartTest
  {};
} // namespace



TEST_F(Kill, FiftyTimesAndTheHistoryIsTheSameBitForBit)
{
  std::mt19937                           random(20261121);
  std::uniform_real_distribution<double> uniform(0., 1.);
  unsigned int                           n_kills = 0, n_going_on = 0;
  bool                                   is_first = true;
  while (n_kills < 50)
    {
      SCOPED_TRACE("after " + std::to_string(n_kills) + " kills");
      std::vector<std::string> more = {"--set", often};
      if (!is_first)
        more.emplace_back("--resume");
      is_first                 = false;
      const std::string before = history("victim");
      BackgroundRun     run(process.folder(), arguments("victim", more));

      // Two of three are killed at work, the others at any moment, starting and
      // resuming included.
      double delay = 0.8 * uniform(random);
      if (uniform(random) < 0.67)
        {
          run.wait_until([&]() {
            const std::string now = history("victim");
            return now.size() > 600 && now != before;
          });
          delay = 0.2 * uniform(random);
        }
      std::this_thread::sleep_for(std::chrono::duration<double>(delay));
      run.send(SIGKILL);
      run.wait();

      // No damage was met; which would be one line.
      ASSERT_EQ(run.err(), "");
      n_going_on += run.out().find("Resumed after") != std::string::npos;
      if (run.outcome() == -SIGKILL)
        {
          ++n_kills;
          if (fs::exists(path("victim/history.csv")) && lines("victim") > 3)
            {
              read_history(path("victim/history.csv"));
            }
        }
      else
        {
          // It came to its end before: once more from the beginning.
          ASSERT_EQ(run.outcome(), 0);
          expect_finished("victim");
          is_first = true;
        }
    }
  EXPECT_GE(n_going_on, 20u);

  const auto last = run("victim", {"--resume"});
  ASSERT_EQ(last.exit_code, 0) << last.err;
  EXPECT_EQ(last.err, "");
  expect_finished("victim");
  EXPECT_GE(read_summary(path("victim/summary.json")).sessions, 2u);
}
