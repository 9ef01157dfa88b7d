// SPDX-License-Identifier: LGPL-2.1-or-later

// --resume goes by what a case says, not by where it is or where one stands.

#include <gtest/gtest.h>

#include "tests/file_text.h"
#include "restart_tools.h"

using namespace SlipStep::Testing;

namespace
{
  class ResumeAnywhere : public RestartTest
  {
  protected:
    /// A case that names tests beside it, and replays one of them.
    ResumeAnywhere()
    {
      fs::create_directories(path("cases/measured"));
      process.write("cases/measured/one.csv",
                    "time_s,displacement_mm,pressure_MPa,friction\n"
                    "0,0,0,0\n1,0,1,0\n2,0.2,1,0.1\n3,0.1,1,-0.1\n");
      process.write("cases/case.prm",
                    "set Loading/Programme = follow measured/one.csv\n"
                    "set Calibration/Tests = measured\n"
                    "set Time stepping/Tolerance = 1e-4\n"
                    "set Time stepping/Equal steps per statement = 7\n"
                    "set Block/Dimension = 2\n"
                    "set Block/Size = 10 mm, 5 mm\n"
                    "set Block/Subdivisions = 4, 2\n"
                    "set Block/Degree = 1\n");
    }

    SlipstepProcess::Result
    resume(const std::string              &command,
           const std::string              &from,
           const std::vector<std::string> &more = {}) const
    {
      std::vector<std::string> words = {command,
                                        path("cases/case.prm").string(),
                                        "--output",
                                        path("output").string(),
                                        "--resume"};
      words.insert(words.end(), more.begin(), more.end());
      return process.run(words, "", "cd '" + from + "' &&");
    }
  };
} // namespace



TEST_F(ResumeAnywhere, AFinishedRunIsKeptFromAnyFolder)
{
  process.write("case.prm",
                "include cases/case.prm\n"
                "set Loading/Programme = follow cases/measured/one.csv\n");
  // Equal steps make idle the tolerance of the file, which is no error if it
  // comes later.
  const std::vector<std::string> steps = {
    "--set", "Time stepping/Equal steps per statement=8"};
  for (const std::string command : {"point", "run"})
    {
      fs::remove_all(path("output"));
      const auto first = resume(command, path("cases").string(), steps);
      ASSERT_EQ(first.exit_code, 0) << first.err;
      const std::string finished = history("output");
      for (const std::string &from : {path("cases").string(),
                                      process.folder().string(),
                                      std::string("/")})
        {
          const auto again = resume(command, from, steps);
          EXPECT_EQ(again.exit_code, 0) << from << '\n' << again.err;
          EXPECT_TRUE(contains(again.out, "results are kept"));
        }
      // What the command does not use may change, in other words or in fact.
      for (const std::string setting :
           {"Calibration/Tests=elsewhere",
            "Calibration/Noise=0.01",
            "Report/Title=Another one",
            "Loading/Programme=follow   measured/../measured/one.csv",
            "Loading/Speed=0.0166666666666666667 mm/s",
            "Block/Young modulus=206000 MPa",
            "Friction/Static coefficient=0.1150"})
        {
          auto all = steps;
          all.insert(all.end(), {"--set", setting});
          const auto again = resume(command, "/", all);
          EXPECT_EQ(again.exit_code, 0) << setting << '\n' << again.err;
        }
      auto other = steps;
      other.insert(other.end(), {"--set", "Block/Poisson ratio=0.2"});
      const auto block = resume(command, "/", other);
      EXPECT_EQ(block.exit_code, command == "point" ? 0 : 2) << block.err;
      other.back()    = "Output/Lines=(0 mm, 5 mm) to (10 mm, 5 mm)";
      const auto line = resume(command, "/", other);
      EXPECT_EQ(line.exit_code, command == "point" ? 0 : 2) << line.err;
      EXPECT_EQ(history("output"), finished);
    }
}



// Old and new runs would stand in one table.
TEST_F(ResumeAnywhere, AFinishedRunOfAChangedTestIsNotKept)
{
  const std::string              cases = path("cases").string();
  const std::vector<std::string> steps = {
    "--set", "Time stepping/Equal steps per statement=8"};
  ASSERT_EQ(resume("point", cases, steps).exit_code, 0);
  const std::string finished = history("output");

  fs::remove(path("output") / "history.csv");
  const auto lost = resume("point", cases, steps);
  EXPECT_EQ(lost.exit_code, 0) << lost.err;
  EXPECT_FALSE(contains(lost.out, "results are kept"));
  EXPECT_EQ(history("output"), finished);

  process.write("cases/measured/one.csv",
                "time_s,displacement_mm,pressure_MPa,friction\n"
                "0,0,5,0\n1,0.02,5,0.1\n2,0.05,5,0.1\n");
  const auto changed = resume("point", cases, steps);
  EXPECT_EQ(changed.exit_code, 2);
  EXPECT_TRUE(contains(changed.err, "has changed since the finished run in"));
  EXPECT_EQ(history("output"), finished);
}



TEST_F(ResumeAnywhere, ADamagedSummaryDoesNotHideACheckpoint)
{
  for (const std::string text : {"", "{\"case\": ", "[]", "\xff\xfe"})
    {
      fs::remove_all(path("damaged"));
      run_and_kill("damaged", 100, {"--quiet", "--set", often});
      process.write("damaged/summary.json", text);
      const auto resumed = run("damaged", {"--resume"});
      EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
      EXPECT_TRUE(contains(resumed.err, "summary.json: this file is damaged"));
      EXPECT_EQ(resumed.n_error_lines(), 1u) << resumed.err;
      EXPECT_TRUE(contains(resumed.out, "Resumed after"));
      expect_finished("damaged");
    }
}



TEST_F(ResumeAnywhere, AFinishedRunOfUnknownParametersIsNotTouched)
{
  ASSERT_EQ(run("output", {"--quiet"}).exit_code, 0);
  const std::string finished = history("output");
  for (const std::string text : {"set Nonsense = 1\n", "\x01\x02"})
    {
      process.write("output/used_parameters.prm", text);
      const auto resumed = run("output", {"--resume"});
      EXPECT_EQ(resumed.exit_code, 2);
      EXPECT_TRUE(contains(resumed.err, "run without --resume"));
      EXPECT_EQ(history("output"), finished);
    }
}
