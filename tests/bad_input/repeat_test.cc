// SPDX-License-Identifier: LGPL-2.1-or-later

// The parameters that a run leaves behind make the same run again, bit for bit.

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "slipstep_process.h"

namespace
{
  // Off for one variant: a section that the other one needs.
  const char *const text =
    "set Loading/Programme = press 1 MPa in 1 s; \\\n"
    "  slide for 0.01 mm at 30 deg; slide -1 mm/min for 3 um\n"
    "set Block/Size         = 1 cm, 5 mm, 7\n"
    "set Block/Subdivisions = 2, 1, 1\n"
    "subsection Variants\n"
    "  subsection smooth & slow\n"
    "    set Friction/Effects = subloading, softening, healing\n"
    "    set Friction/healing/Rate = 1e-5\n"
    "  end\n"
    "  subsection fast\n"
    "    set Loading/Speed = 200 mm/min\n"
    "  end\n"
    "end\n";



  void expect_same_table(const SlipstepProcess &process,
                         const std::string     &first,
                         const std::string     &second)
  {
    const std::string expected = process.read(first + "/history.csv");
    EXPECT_GT(expected.size(), 1000u);
    EXPECT_EQ(expected, process.read(second + "/history.csv"));
  }
} // namespace



TEST(Repeat, UsedParametersGiveTheSameHistory)
{
  for (const std::string command : {"point", "run"})
    {
      SCOPED_TRACE(command);
      const SlipstepProcess process;
      process.write("my case.prm", text);
      const auto run = [&](const std::string &file, const std::string &output) {
        const auto result =
          process.run({command, file, "--quiet", "--output", output});
        EXPECT_EQ(result.exit_code, 0) << result.err;
      };
      run("my case.prm", "first time");

      // The sweep as a whole, and each of its variants alone.
      const std::string used = "/used_parameters.prm";
      EXPECT_EQ(process
                  .run({"check",
                        "first time" + used,
                        "first time/fast" + used,
                        "first time/smooth_slow" + used})
                  .exit_code,
                0);
      run("first time" + used, "second");
      run("first time/fast" + used, "third/fast");
      run("first time/smooth_slow" + used, "third/smooth_slow");
      for (const std::string variant : {"fast", "smooth_slow"})
        for (const std::string again : {"second/", "third/"})
          expect_same_table(process, "first time/" + variant, again + variant);
    }
}



// The section of an effect that only some variants have.
TEST(Repeat, VariantsMayHaveTheirOwnEffects)
{
  const SlipstepProcess process;
  process.write("case.prm",
                "set Loading/Programme = press 1 MPa in 1 s; slide for 1 um\n"
                "set Friction/healing/Rate = 1e-5\n"
                "subsection Variants\n"
                "  subsection healed\n"
                "    set Friction/Effects = subloading, softening, healing\n"
                "  end\n"
                "  subsection plain\n"
                "    set Friction/Effects = subloading\n"
                "  end\n"
                "end\n");
  process.run({"point", "case.prm", "--quiet", "--output", "first"});
  const auto again = process.run(
    {"point", "first/used_parameters.prm", "--quiet", "--output", "second"});
  EXPECT_EQ(again.exit_code, 0) << again.err;
  for (const std::string variant : {"healed", "plain"})
    expect_same_table(process, "first/" + variant, "second/" + variant);
}



// Names of files in a case are relative to it.
TEST(Repeat, AFollowedTestIsFoundAgain)
{
  const SlipstepProcess process;
  std::filesystem::create_directories(process.folder() / "cases/measured");
  process.write("cases/measured/a test.csv",
                "time_s,displacement_mm,pressure_MPa,friction\n"
                "0,0,5,0\n1,0,5,0\n3,0.01,6,0.1\n");
  process.write("cases/case.prm",
                "set Loading/Programme = press 5 MPa in 1 s; "
                "follow measured/a test.csv; hold 1 s\n");
  process.run(
    {"point", "cases/case.prm", "--quiet", "--output", "results/first"});
  const auto again = process.run({"point",
                                  "results/first/used_parameters.prm",
                                  "--quiet",
                                  "--output",
                                  "second"});
  EXPECT_EQ(again.exit_code, 0) << again.err;
  expect_same_table(process, "results/first", "second");
}



TEST(Repeat, SettingsAreAmongTheUsedParameters)
{
  const SlipstepProcess process;
  process.write("case.prm", text);
  process.run({"point",
               "case.prm",
               "--quiet",
               "--output",
               "first",
               "--set",
               "Friction/Static coefficient = 0.3",
               "--variant",
               "fast"});
  process.run({"point",
               "first/fast/used_parameters.prm",
               "--quiet",
               "--output",
               "second"});
  expect_same_table(process, "first/fast", "second");
}



// The fields of the run before would be taken for those of this one.
TEST(Repeat, AShorterRunLeavesNoFieldsOfTheOneBefore)
{
  const SlipstepProcess process;
  process.write("case.prm", text);
  const auto run = [&](const std::string &fields) {
    const auto result = process.run({"run",
                                     "case.prm",
                                     "--quiet",
                                     "--variant",
                                     "fast",
                                     "--output",
                                     "results",
                                     "--set",
                                     "Output/Fields = " + fields});
    EXPECT_EQ(result.exit_code, 0) << result.err;
  };
  const auto has = [&](const std::string &name) {
    return std::filesystem::exists(process.folder() / "results/fast" / name);
  };
  run("statements");
  for (const std::string file :
       {"fields_0002.pvtu", "contact_0002.pvtu", "surface_0002.csv"})
    EXPECT_TRUE(has(file)) << file;
  process.write("results/fast/fields_of_mine.csv", "mine");
  run("end");
  EXPECT_TRUE(has("fields_0000.pvtu"));
  for (const std::string file : {"fields_0001.pvtu",
                                 "fields_0002.pvtu",
                                 "fields_0002.0.vtu",
                                 "contact_0002.pvtu",
                                 "surface_0002.csv"})
    EXPECT_FALSE(has(file)) << file;
  EXPECT_TRUE(has("fields_of_mine.csv"));
}



// A table of equal rows would look as if the key made no difference.
TEST(Repeat, MembersThatAreTheSameCaseAreTold)
{
  const SlipstepProcess process;
  process.write("case.prm",
                "set Loading/Programme = press 5 MPa in 1 s; slide 1 mm/s for "
                "0.01 mm\n");
  unsigned int n_runs  = 0;
  const auto   warning = [&](const std::string &sweep) {
    const std::string folder = "out_" + std::to_string(n_runs++);
    const auto        result = process.run(
      {"point", "case.prm", "--sweep", sweep, "--quiet", "--output", folder});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.err;
  };
  for (const std::string sweep : {"Block/Young modulus=206 GPa|70 GPa",
                                  "Friction/Static coefficient=0.2|0.20",
                                  "Output/Directory=a|b"})
    EXPECT_NE(warning(sweep).find("are the same case"), std::string::npos)
      << sweep;
  EXPECT_EQ(warning("Friction/Static coefficient=0.2|0.3"), "");
}



TEST(Repeat, ThePrintedParametersAreACase)
{
  const SlipstepProcess process;
  process.write("defaults.prm", process.run({"parameters"}).out);
  const auto result = process.run({"check", "defaults.prm"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
}
