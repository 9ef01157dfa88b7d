// SPDX-License-Identifier: LGPL-2.1-or-later

// Sweeps of several keys, as a job array, and results put side by side.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/bad_input/slipstep_process.h"
#include "tests/file_text.h"

namespace fs = std::filesystem;

namespace
{
  const std::string grid_case =
    "set Loading/Programme = press 5 MPa in 1 s; slide for 1 mm\n"
    "set Friction/Effects = subloading, overstress\n";

  class Grid : public testing::Test
  {
  protected:
    Grid()
    {
      process.write("one.prm", grid_case);
      process.write("grid.prm",
                    "include one.prm\nsubsection Sweep\n"
                    "  set Key      = Friction/overstress/Exponent\n"
                    "  set Values   = 8, 16\n"
                    "  set Key 2    = Loading/Speed\n"
                    "  set Values 2 = 1 mm/min, 20 mm/min\nend\n");
    }

    SlipstepProcess::Result run(const std::vector<std::string> &arguments) const
    {
      const auto result = process.run(arguments);
      EXPECT_EQ(result.exit_code, 0) << result.err;
      return result;
    }

    bool are_same(const std::string &a, const std::string &b) const
    {
      return !process.read(a).empty() && process.read(a) == process.read(b);
    }

    const std::vector<std::string> folders = {"Exponent_8_Speed_1_mm-min",
                                              "Exponent_8_Speed_20_mm-min",
                                              "Exponent_16_Speed_1_mm-min",
                                              "Exponent_16_Speed_20_mm-min"};
    SlipstepProcess                process;
  };
} // namespace



// A member of the case has the name of a run then, which once swept on and on.
TEST_F(Grid, SweepsTheKeyOfTheCaseWithAValueOfTheCase)
{
  process.write("sweep.prm",
                "include one.prm\nsubsection Sweep\n"
                "  set Key    = Loading/Speed\n"
                "  set Values = 1 mm/min, 20 mm/min\nend\n");
  const auto options = [&](const std::string              &output,
                           const std::vector<std::string> &more) {
    std::vector<std::string> arguments = {"point",
                                          "sweep.prm",
                                          "--sweep",
                                          "Loading/Speed=1 mm/min|5 mm/min",
                                          "--output",
                                          output};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  };
  run(options("all", {"--quiet"}));
  run(options("member", {"--quiet", "--variant", "1 mm/min"}));
  run(options("jobs", {"--slurm", "jobs.sh", "--variant", "1 mm/min"}));
  for (const std::string number : {"1", "2"})
    EXPECT_EQ(std::system(("SLURM_ARRAY_TASK_ID=" + number + " bash '" +
                           (process.folder() / "jobs.sh").string() + "'")
                            .c_str()),
              0);
  run({"point", "sweep.prm", "--variant", "1 mm/min", "--output", "alone"});
  EXPECT_TRUE(
    are_same("alone/1_mm-min/history.csv", "all/1_mm-min/history.csv"));
  for (const std::string run : {"1_mm-min", "5_mm-min"})
    for (const std::string way : {"member", "jobs"})
      EXPECT_TRUE(are_same("all/" + run + "/history.csv",
                           way + "/" + run + "/history.csv"))
        << way << ' ' << run;
}



// Of a case that is a sweep, one member is swept on.
TEST_F(Grid, SweepsAMemberOfASweep)
{
  process.write("sweep.prm",
                "include one.prm\nsubsection Sweep\n"
                "  set Key    = Loading/Speed\n"
                "  set Values = 1 mm/min, 20 mm/min\nend\n");
  for (const std::string speed : {"1 mm/min", "20 mm/min"})
    run({"point",
         "sweep.prm",
         "--variant",
         speed,
         "--sweep",
         "Friction/overstress/Exponent=8|16",
         "--output",
         "at " + speed.substr(0, speed.find(' ')),
         "--quiet"});
  run({"point", "grid.prm", "--output", "all", "--quiet"});
  for (const std::string exponent : {"8", "16"})
    for (const std::string speed : {"1", "20"})
      EXPECT_TRUE(are_same("at " + speed + "/" + speed + "_mm-min_Exponent_" +
                             exponent + "/history.csv",
                           "all/Exponent_" + exponent + "_Speed_" + speed +
                             "_mm-min/history.csv"))
        << exponent << " " << speed;
  // What all have in common is no key of the sweep.
  run({"point",
       "sweep.prm",
       "--variant",
       "1 mm/min",
       "--sweep",
       "Friction/overstress/Exponent=8|16",
       "--sweep",
       "Friction/Static coefficient=0.1|0.2",
       "--output",
       "two",
       "--quiet"});
  EXPECT_FALSE(process.read("two/report/grid_kinetic.dat").empty());
}



TEST_F(Grid, IsTheSameFromTheFileAndTheCommandLine)
{
  run({"point", "grid.prm", "--output", "file", "--quiet"});
  run({"point",
       "one.prm",
       "--sweep",
       "Friction/overstress/Exponent = 8 | 16",
       "--sweep",
       "Loading/Speed=1 mm/min|20 mm/min",
       "--output",
       "line",
       "--quiet"});
  run({"point",
       "one.prm",
       "--set",
       "Friction/overstress/Exponent=16",
       "--set",
       "Loading/Speed=20 mm/min",
       "--output",
       "alone",
       "--quiet"});
  EXPECT_TRUE(are_same("alone/history.csv",
                       "file/Exponent_16_Speed_20_mm-min/history.csv"));
  for (const std::string &folder : folders)
    EXPECT_TRUE(are_same("file/" + folder + "/history.csv",
                         "line/" + folder + "/history.csv"))
      << folder;
  const std::string page = process.read("line/report.html");
  EXPECT_TRUE(contains(page,
                       "--sweep &quot;Friction/overstress/Exponent=8|16&quot; "
                       "--sweep &quot;Loading/Speed=1 mm/min|20 mm/min&quot;"));
  if (has_gnuplot())
    {
      EXPECT_TRUE(contains(page, "aria-label=\"Kinetic friction\""));
    }
}



TEST_F(Grid, OfThreeKeysHasAllCombinations)
{
  const auto result = run({"check",
                           "grid.prm",
                           "--sweep",
                           "Friction/Static coefficient=0.1|0.2|0.3"});
  EXPECT_EQ(result.out, "grid.prm: OK, 12 variants\n");
}



// What the command line says of a key takes the place of what the case does.
TEST_F(Grid, OfAKeyThatTheCaseSweepsTakesItsPlace)
{
  const auto check = [&](const std::vector<std::string> &options) {
    std::vector<std::string> arguments = {"check", "grid.prm"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run(arguments).out;
  };
  EXPECT_EQ(check({"--sweep", "Loading/Speed=5 mm/s|6 mm/s|7 mm/s"}),
            "grid.prm: OK, 6 variants\n");
  EXPECT_EQ(check({"--set", "Loading/Speed=5 mm/s"}),
            "grid.prm: OK, 2 variants\n");
  run({"point",
       "grid.prm",
       "--quiet",
       "--output",
       "one",
       "--set",
       "Loading/Speed=5 mm/s"});
  EXPECT_FALSE(contains(process.read("one/report.html"), "20 mm/min"));
}



TEST_F(Grid, MistakesAreRefused)
{
  const auto refused = [&](const std::vector<std::string> &options,
                           const std::vector<std::string> &words) {
    std::vector<std::string> arguments = {"check", "grid.prm"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    expect_refusal(process.run(arguments), words);
  };
  refused({"--sweep",
           "Loading/Speed=5 mm/s|6 mm/s",
           "--sweep",
           "Loading/Speed=7 mm/s|8 mm/s"},
          {"Loading/Speed is swept twice"});
  refused({"--sweep", "Block/Degre=1|2"}, {"Block/Degre", "Block/Degree"});
  refused({"--sweep", "Block/Degree=1|"}, {"a value is missing"});
  refused({"--sweep", "Block/Degree=1|one"}, {"Block/Degree = one"});
  refused({"--sweep", "Block/Degree=1|1"}, {"given twice"});
  refused({"--sweep", "Block/Degree=1|2", "--set", "Block/Degree=1"},
          {"leave out one"});
  process.write("wrong.prm",
                grid_case + "subsection Sweep\n"
                            "  set Key = Loading/Speed\n"
                            "  set Values = 1 mm/s\n"
                            "  set Values 3 = 1, 2\nend\n");
  expect_refusal(process.run({"check", "wrong.prm"}),
                 {"wrong.prm:6", "Key 3", "Values 3"});
  process.write("wrong.prm",
                grid_case + "subsection Sweep\n  set Keys 2 = a\nend\n");
  expect_refusal(process.run({"check", "wrong.prm"}),
                 {"wrong.prm:4", "Sweep/Keys 2", "did you mean"});
}



// Jobs in any order, one of them twice; then the page of the whole.
TEST_F(Grid, IsComputedByAJobArray)
{
  run({"point", "grid.prm", "--output", "here", "--quiet"});
  run({"point", "grid.prm", "--output", "there's a", "--slurm", "jobs.sh"});
  EXPECT_FALSE(fs::exists(process.folder() / "there's a"));
  const std::string script =
    "bash '" + (process.folder() / "jobs.sh").string() + "'";
  for (const std::string number : {"3", "1", "4", "2", "1"})
    EXPECT_EQ(
      std::system(("SLURM_ARRAY_TASK_ID=" + number + " " + script).c_str()), 0);
  for (const std::string &folder : folders)
    EXPECT_TRUE(are_same("here/" + folder + "/history.csv",
                         "there's a/" + folder + "/history.csv"))
      << folder;
  run({"point", "grid.prm", "--output", "there's a", "--resume", "--quiet"});
  EXPECT_FALSE(process.read("there's a/report.html").empty());
  expect_refusal(process.run({"point", "grid.prm", "--slurm", "jobs.sh"}),
                 {"jobs.sh", "is there already"});
  expect_refusal(process.run({"point", "one.prm", "--slurm", "other.sh"}),
                 {"no sweep"});
}



TEST_F(Grid, IsComparedWithOtherResults)
{
  run({"point", "grid.prm", "--output", "grid", "--quiet"});
  run({"point",
       "one.prm",
       "--set",
       "Friction/Static coefficient=0.25",
       "--set",
       "Friction/Normal stiffness=100 GPa/mm",
       "--set",
       "Friction/Effects=subloading",
       "--output",
       "one",
       "--quiet"});
  process.write("test.csv",
                "# name: a test\n"
                "time_s,displacement_mm,pressure_MPa,friction\n"
                "0,0,5,0\n1,0.5,5,0.2\n2,1,5,0.2\n");
  const auto result =
    run({"compare", "grid/", "one", "test.csv", "--output", "both"});
  for (const std::string label :
       {"grid: Exponent 8, Speed 1 mm/min", "grid: Exponent 16", "\n  one"})
    EXPECT_TRUE(contains(result.out, label)) << label << result.out;
  const std::string page = process.read("both/report.html");
  EXPECT_TRUE(contains(page, "What differs"));
  EXPECT_TRUE(contains(page, "Friction/Static coefficient"));
  // The same in other words; what is off has no value.
  EXPECT_FALSE(contains(page, "Friction/Normal stiffness"));
  EXPECT_TRUE(contains(page, "Friction/overstress/Viscosity"));
  // Its values are those of no case.
  EXPECT_FALSE(contains(page, "<h2>Conditions</h2>"));
  if (has_gnuplot())
    {
      EXPECT_TRUE(contains(page, "a test, measured"));
    }
  const auto refused = [&](const std::vector<std::string> &names,
                           const std::vector<std::string> &words) {
    std::vector<std::string> arguments = {"compare"};
    arguments.insert(arguments.end(), names.begin(), names.end());
    expect_refusal(process.run(arguments), words);
  };
  // A history that lost rows is told of.
  const std::string history = process.read("one/history.csv");
  process.write("one/history.csv",
                history.substr(0, history.find('\n', history.size() / 2) + 1));
  EXPECT_TRUE(contains(process.run({"compare", "one", "--output", "cut"}).err,
                       "'one': history.csv has "));
  // One that was killed has no end.
  std::string summary = process.read("one/summary.json");
  summary.replace(summary.find("finished"), 8, "running");
  process.write("one/summary.json", summary);
  EXPECT_TRUE(
    contains(run({"compare", "one", "--output", "killed"}).out,
             "one: failed: it has not ended: killed, or still running, "
             "at t = "));
  fs::create_directory(process.folder() / "empty");
  refused({"empty"}, {"empty: it holds no results"});
  refused({"one", "./one/"}, {"named twice"});
  refused({"grid.prm"}, {"this is a case"});
  refused({"test.csv"}, {"no folder of results"});
  refused({"nowhere"}, {"there is no such folder"});
}



// Of a run without them the defaults would be another's.
// Files of one name with different motions, and the same file from elsewhere.
TEST_F(Grid, OfFollowedTestsTellsTheMotions)
{
  const std::string head = "time_s,displacement_mm,pressure_MPa,friction\n";
  for (const std::string folder : {"a", "b", "c"})
    {
      fs::create_directory(process.folder() / folder);
      process.write(folder + "/t.csv",
                    head + "0,0,5,0\n1," + (folder == "b" ? "0.5" : "1") +
                      ",5,0.1\n");
      process.write(
        folder + "/f.prm",
        "set Loading/Programme = press 5 MPa in 1 s; follow t.csv\n");
      run({"point", folder + "/f.prm", "--output", folder + "/out", "--quiet"});
    }
  const auto differing = [&](const std::string &one, const std::string &other) {
    run({"compare", one, other, "--output", "both", "--quiet"});
    const std::string page = process.read("both/report.html");
    return page.substr(page.find("What differs</h2>"), 600);
  };
  EXPECT_TRUE(contains(differing("a/out", "b/out"), "follow b/t.csv"));
  EXPECT_TRUE(contains(differing("a/out", "c/out"), "the cases say the same"));
  run({"point", "a/f.prm", "--output", "a/deep/er", "--quiet"});
  EXPECT_TRUE(
    contains(differing("a/out", "a/deep/er"), "the cases say the same"));
}



TEST_F(Grid, TellsThatParametersAreUnknown)
{
  for (const std::string name : {"1", "2", "3"})
    run({"point",
         "one.prm",
         "--set",
         "Friction/Static coefficient=0." + name,
         "--output",
         name,
         "--quiet"});
  fs::remove(process.folder() / "3" / "used_parameters.prm");
  const auto compared = [&](const std::vector<std::string> &names) {
    std::vector<std::string> arguments = {"compare", "--output", "page"};
    arguments.insert(arguments.end(), names.begin(), names.end());
    EXPECT_TRUE(contains(run(arguments).err,
                         "run '3': its parameters are unknown, since "
                         "3/used_parameters.prm is missing"));
    const std::string page = process.read("page/report.html");
    EXPECT_TRUE(contains(page, "its parameters are unknown"));
    return page.substr(page.find("What differs</h2>"), 400);
  };
  const std::string three = compared({"1", "2", "3"});
  EXPECT_TRUE(contains(three, "Friction/Static coefficient")) << three;
  EXPECT_FALSE(contains(three, "<td>3</td>")) << three;
  EXPECT_TRUE(contains(compared({"1", "3"}), "Unknown: fewer than two"));
  fs::copy(process.folder() / "1",
           process.folder() / "same",
           fs::copy_options::recursive);
  EXPECT_TRUE(contains(compared({"1", "same", "3"}),
                       "Nothing among the cases whose parameters are known"));
  fs::remove(process.folder() / "1" / "used_parameters.prm");
  EXPECT_TRUE(contains(compared({"1", "3"}), "Unknown: fewer than two"));
}



// What a folder had before is not taken for a part of the sweep.
TEST_F(Grid, TakesThePlaceOfEarlierRunsInItsFolder)
{
  const auto point = [&](const std::vector<std::string> &more) {
    std::vector<std::string> arguments = {
      "point", "one.prm", "--output", "here", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments).err;
  };
  const std::string others   = "of another sweep, which this one leaves there";
  const auto        compared = [&]() {
    return run({"compare", "here", "--output", "page"});
  };
  const auto shows = [](const std::string &table, const std::string &speed) {
    return contains(table, "\n  " + speed + " ");
  };
  point({});
  EXPECT_TRUE(shows(compared().out, "1"));
  EXPECT_FALSE(
    contains(point({"--sweep", "Loading/Speed=2 mm/min|3 mm/min"}), others));
  const std::string first = compared().out;
  EXPECT_FALSE(shows(first, "1")) << first;
  EXPECT_TRUE(shows(first, "2") && shows(first, "3")) << first;
  EXPECT_FALSE(fs::exists(process.folder() / "here" / "history.csv"));
  EXPECT_TRUE(contains(point({"--sweep", "Loading/Speed=3 mm/min|4 mm/min"}),
                       "here has 1 run " + others + " (2_mm-min)"));
  const auto last = compared();
  EXPECT_FALSE(shows(last.out, "2")) << last.out;
  EXPECT_TRUE(shows(last.out, "3") && shows(last.out, "4")) << last.out;
  EXPECT_TRUE(contains(last.err, "does not belong to the last sweep"));
}



// What --set gives is no difference between variants any more: their names
// would say otherwise, and a folder of results has none of a variant.
TEST_F(Grid, OfVariantsThatAreEqualIsTold)
{
  process.write("variants.prm",
                "include one.prm\nsubsection Variants\n"
                "  subsection slow\n    set Loading/Speed = 1 mm/min\n  end\n"
                "  subsection fast\n    set Loading/Speed = 9 mm/min\n  end\n"
                "  subsection stiff\n    set Loading/Speed = 1 mm/min\n"
                "    set Friction/Tangential stiffness = 500 MPa/mm\n"
                "  end\nend\n");
  const auto point = [&](const std::vector<std::string> &more) {
    std::vector<std::string> arguments = {
      "point", "variants.prm", "--output", "here", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments).err;
  };
  const std::string begin =
    "--set overrides the keys in which the 3 variants of the case differ";
  const std::string speed = "Loading/Speed=2 mm/min";
  EXPECT_FALSE(contains(point({}), begin));
  EXPECT_FALSE(
    contains(point({"--set", "Friction/Static coefficient=0.3"}), begin));
  EXPECT_TRUE(contains(point({"--set", speed}), "('slow', 'stiff')"));
  const std::string one = point(
    {"--set", speed, "--set", "Friction/Tangential stiffness=400 MPa/mm"});
  EXPECT_TRUE(
    contains(one, "the case is now one run, without a variant folder"));
  EXPECT_TRUE(contains(one, "here has 3 runs of another sweep"));
}
