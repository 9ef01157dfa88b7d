// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <sys/stat.h>

#include <string>
#include <vector>

#include "slipstep_process.h"



TEST(CommandLine, UnknownWordsComeWithTheNearest)
{
  const SlipstepProcess process;
  expect_refusal(process.run({"chek", "a.prm"}), {"\"chek\"", "mean check?"});
  expect_refusal(process.run({"run", "a.prm", "--ouput", "x"}),
                 {"--ouput", "mean --output?"});
  expect_refusal(process.run({}), {"command is missing"});
  expect_refusal(process.run({"run"}), {".prm file is missing"});
  expect_refusal(process.run({"run", "a.prm", "b.prm"}), {"b.prm", "usage"});
  expect_refusal(process.run({"parameters", "--format", "xml"}),
                 {"xml", "prm, html, md, keys, json, schema"});
  expect_refusal(process.run({"parameters", "--format="}), {"--format"});
  EXPECT_EQ(process.run({"effects", "Softening"}).exit_code, 0);
  expect_refusal(process.run({"parameters", "sweep"}),
                 {"section Sweep", "makes many runs", "running_a_case.md"});
  expect_refusal(process.run({"a.prm"}), {"mean slipstep run a.prm?"});
  expect_refusal(process.run({"effects", "--set", "Block/Degree=2"}),
                 {"effects has no option --set"});
  expect_refusal(process.run({"run", "a.prm", "--output"}), {"--output"});
  expect_refusal(process.run({"run", "a.prm", "--quiet", "--quiet"}),
                 {"--quiet"});
  EXPECT_TRUE(process.wrote_nothing());
}



TEST(CommandLine, OnlyPrmFilesAreAccepted)
{
  for (const std::string command : {"run", "point", "check"})
    {
      const SlipstepProcess process;
      expect_refusal(process.run({command, "nowhere.prm"}),
                     {"nowhere.prm: no such file"});
      EXPECT_TRUE(process.wrote_nothing());
      process.write("case.txt", right);
      expect_refusal(process.run({command, "case.txt"}),
                     {"case.txt: not a .prm file"});
      expect_refusal(process.run({command, "."}), {"is a folder"});
      EXPECT_FALSE(std::filesystem::exists(process.folder() / "output"));
    }
}



TEST(CommandLine, SettingsAreChecked)
{
  const SlipstepProcess process;
  process.write("case.prm", right);
  const auto with = [&](const std::string &setting) {
    return process.run({"point", "case.prm", "--set", setting});
  };
  expect_refusal(with("Friction/Normal stiffness"), {"--set", "= value"});
  expect_refusal(with("Friction/Normal stifness=1"),
                 {"--set", "mean Friction/Normal stiffness?"});
  // And no Test of another section.
  expect_refusal(with("Calibration/Test = a.csv"), {"mean Calibration/Tests?"});
  expect_refusal(with("Friction/Normal stiffness = -1"),
                 {"--set Friction/Normal stiffness = -1", "greater than 0"});
  expect_refusal(with("Friction/healing/Rate = 1"),
                 {"--set Friction/healing/Rate = 1", "'healing' is off"});
  expect_refusal(with(""), {"--set \"\""});
  expect_refusal(with("Block/Degree ="), {"value is missing"});
  expect_refusal(with("Block = 1"), {"a section, not a key"});
  expect_refusal(process.run({"point",
                              "case.prm",
                              "--set",
                              "Block/Degree=1",
                              "--set",
                              "Block/Degree = 2"}),
                 {"--set Block/Degree is given twice"});
  expect_refusal(process.run({"point", "case.prm", "--variant", ""}),
                 {"--variant"});
  expect_refusal(process.run({"point", "case.prm", "--variant", "fast"}),
                 {"--variant fast", "no such variant; it has none"});
  EXPECT_FALSE(std::filesystem::exists(process.folder() / "output"));
}



TEST(CommandLine, WhatOnlyAFileCanSayIsToldSo)
{
  const SlipstepProcess process;
  process.write("case.prm", right);
  const auto with = [&](const std::string &setting) {
    return process.run({"point", "case.prm", "--set", setting});
  };
  expect_refusal(with("Sweep/Key = Loading/Speed"),
                 {"changes one key for all members",
                  "--variant NAME",
                  "--sweep"});
  expect_refusal(with("variants/fast/Block/Degree = 1"),
                 {"changes one key for all members"});
  expect_refusal(with("include other.prm"), {"lines with 'include'"});
  expect_refusal(with("subsection Friction"), {"lines with 'subsection'"});
  expect_refusal(with("set Block/Degree = 1"), {"leave out the word 'set'"});
  EXPECT_FALSE(std::filesystem::exists(process.folder() / "output"));
}



TEST(CommandLine, AnUnknownVariantNamesThoseThatExist)
{
  const SlipstepProcess process;
  process.write("empty.prm",
                std::string(right) + "subsection Sweep\nset Key =\nend\n");
  expect_refusal(process.run({"point", "empty.prm"}),
                 {"Sweep/Key is empty", "an empty subsection Variants"});
  std::string values;
  for (unsigned int i = 1; i < 30; ++i)
    values += (i > 1 ? ", " : "") + std::to_string(i) + " mm/s";
  process.write("sweep.prm",
                std::string(right) +
                  "subsection Sweep\nset Key = "
                  "Loading/Speed\nset Values = " +
                  values + "\nend\n");
  const auto with = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"point", "sweep.prm", "--variant"});
    return process.run(options);
  };
  expect_refusal(with({"fast"}),
                 {"no such variant; it has \"1 mm/s\", \"2 mm/s\"",
                  "\"12 mm/s\" and 17 more\n"});
  // Results of this name would be those of another speed.
  expect_refusal(with({"2 mm/s", "--set", "Loading/Speed=5 mm/s"}),
                 {"--variant 2 mm/s: --set gives Loading/Speed", "leave out"});
  EXPECT_FALSE(std::filesystem::exists(process.folder() / "output"));
}



TEST(CaseFile, MustBeText)
{
  const SlipstepProcess process;
  process.write("program.prm", std::string("\177ELF\0\0", 6));
  expect_refusal(process.run({"check", "program.prm"}),
                 {"program.prm:1: not a .prm file"});
  process.write("latin.prm", "set Report/Title = Fl\344che\n");
  expect_refusal(process.run({"check", "latin.prm"}),
                 {"latin.prm:1: ", "UTF-8"});
}



TEST(CaseFile, MayComeFromAnyEditor)
{
  const SlipstepProcess process;
  process.write("dos.prm",
                "\xEF\xBB\xBFset Block/Degree = 1\r\n"
                "subsection\tFriction\r\n"
                "\tset\tStatic coefficient\t=\t0.2\t# tabs\r\n"
                "end\r\nset Report/Title = Fl\303\244che");
  process.write("empty.prm", "");
  std::filesystem::create_directory(process.folder() / "a folder");
  process.write("a folder/a case.prm", right);
  EXPECT_EQ(
    process.run({"check", "dos.prm", "empty.prm", "a folder/a case.prm"}).out,
    "dos.prm: OK\nempty.prm: OK\na folder/a case.prm: OK\n");
}



TEST(CaseFile, ABlockMustFitIntoMemory)
{
  const SlipstepProcess process;
  process.write("huge.prm", "set Block/Subdivisions = 500, 500, 500\n");
  expect_refusal(process.run({"run", "huge.prm"}),
                 {"huge.prm:1: Block/Subdivisions", "GB of memory"});
  EXPECT_FALSE(std::filesystem::exists(process.folder() / "output"));
}



TEST(CaseFile, AMachineNeedsADrivenFace)
{
  const SlipstepProcess process;
  process.write("soft.prm",
                "set Loading/Machine stiffness = 50 MPa/mm\n"
                "set Loading/Programme = press 1 MPa in 1 s; hold 1 s\n"
                "set Block/Faces/top = pressure programme\n"
                "set Output/Quantities = peak coefficient\n");
  for (const std::string command : {"run", "refine"})
    expect_refusal(process.run({command, "soft.prm"}),
                   {"soft.prm:1: Loading/Machine stiffness",
                    "no face has 'drive'"});
  EXPECT_FALSE(std::filesystem::exists(process.folder() / "output"));
}



TEST(OutputFolder, MustHaveAName)
{
  const SlipstepProcess process;
  process.write("case.prm", right);
  expect_refusal(process.run({"point", "case.prm", "--output", ""}),
                 {"--output", "folder is needed"});
  process.write("empty.prm", std::string(right) + "set Output/Directory =\n");
  expect_refusal(process.run({"point", "empty.prm"}),
                 {"empty.prm:2: Output/Directory =", "folder is needed"});
}



TEST(OutputFolder, MustBeOneThatCanBeCreated)
{
  const SlipstepProcess process;
  process.write("case.prm", right);
  process.write("file", "not a folder\n");
  for (const std::string folder : {"file", "file/in/a/file"})
    expect_refusal(process.run({"point", "case.prm", "--output", folder}),
                   {"--output = " + folder, "is not a folder"});
  // Nobody, not even root, creates folders there.
  expect_refusal(process.run({"point", "case.prm", "--output", "/proc/x/y"}),
                 {"/proc/x/y", "cannot be created"});
}



TEST(OutputFolder, MustNotBeReadOnly)
{
  if (geteuid() == 0)
    GTEST_SKIP() << "root may write anywhere";
  const SlipstepProcess process;
  process.write("case.prm", right);
  std::filesystem::create_directory(process.folder() / "locked");
  chmod((process.folder() / "locked").c_str(), 0555);
  for (const std::string folder : {"locked", "locked/inside"})
    expect_refusal(process.run({"point", "case.prm", "--output", folder}),
                   {"read-only"});
  chmod((process.folder() / "locked").c_str(), 0755);
}



TEST(OutputFolder, WithOtherFilesIsLeftAlone)
{
  const SlipstepProcess process;
  process.write("case.prm", right);
  std::filesystem::create_directory(process.folder() / "thesis");
  process.write("thesis/chapter.tex", "text\n");
  expect_refusal(process.run({"point", "case.prm", "--output", "thesis"}),
                 {"thesis", "no slipstep results"});
  EXPECT_FALSE(
    std::filesystem::exists(process.folder() / "thesis/history.csv"));

  // A name that results have, too, is no reason to lose it.
  process.write("thesis/history.csv", "precious\n");
  expect_refusal(process.run({"point", "case.prm", "--output", "thesis"}),
                 {"thesis", "no slipstep results"});
  EXPECT_EQ(process.read("thesis/history.csv"), "precious\n");

  // The same folder with a result in it may be written again.
  process.write("thesis/summary.json", "");
  EXPECT_EQ(process.run({"point", "case.prm", "--output", "thesis"}).exit_code,
            0);
}



// Two exercises whose cases have one name.
TEST(OutputFolder, OfAnotherCaseIsTold)
{
  const SlipstepProcess process;
  for (const std::string folder : {"a", "b"})
    {
      std::filesystem::create_directory(process.folder() / folder);
      process.write(folder + "/case.prm", right);
    }
  EXPECT_EQ(process.run({"point", "a/case.prm", "--quiet"}).err, "");
  EXPECT_EQ(process.run({"point", "./a/case.prm", "--quiet"}).err, "");
  const auto other = process.run({"point", "b/case.prm", "--quiet"});
  EXPECT_EQ(other.exit_code, 0);
  EXPECT_NE(other.err.find("holds results of "), std::string::npos);
  EXPECT_NE(other.err.find(
              "a/case.prm, which the results of this case replace"),
            std::string::npos)
    << other.err;
  // Moved away, it cannot be meant.
  std::filesystem::rename(process.folder() / "b", process.folder() / "c");
  EXPECT_EQ(process.run({"point", "c/case.prm", "--quiet"}).err, "");
}



TEST(Help, GoesToStdoutForEachCommand)
{
  const SlipstepProcess process;
  for (const std::string command :
       {"run", "point", "check", "effects", "parameters"})
    {
      const auto result = process.run({command, "--help"});
      EXPECT_EQ(result.exit_code, 0);
      EXPECT_EQ(result.err, "");
      EXPECT_EQ(result.out.find("slipstep " + command + ": "), 0u);
      EXPECT_EQ(process.run({"help", command}).out, result.out);
    }
  EXPECT_EQ(process.run({"--version"}).out.find("slipstep "), 0u);
  EXPECT_TRUE(process.wrote_nothing());
}



TEST(Help, IsAskedForOneCommand)
{
  const SlipstepProcess process;
  const auto            effect = process.run({"help", "run_in"});
  EXPECT_EQ(effect.exit_code, 2);
  EXPECT_TRUE(contains(effect.err, "slipstep effects run_in")) << effect.err;
  const auto misspelt = process.run({"help", "calibrat"});
  EXPECT_TRUE(contains(misspelt.err, "did you mean calibrate")) << misspelt.err;
  const auto two = process.run({"help", "point", "check"});
  EXPECT_EQ(two.exit_code, 2);
  EXPECT_TRUE(contains(two.err, "\"check\" is one argument too many"))
    << two.err;
  EXPECT_EQ(process.run({"help", "--resume"}).exit_code, 2);
  EXPECT_EQ(process.run({"help"}).exit_code, 0);
}



TEST(Check, NamesEveryCaseAndWritesNothing)
{
  const SlipstepProcess process;
  process.write("right.prm", right);
  process.write("sweep.prm",
                std::string(right) + "subsection Sweep\n"
                                     "  set Key = Loading/Speed\n"
                                     "  set Values = 1 mm/s, 2 mm/s\n"
                                     "end\n");
  process.write("wrong.prm", "set Nothing = 1\n");
  const auto good = process.run({"check", "right.prm", "sweep.prm"});
  EXPECT_EQ(good.exit_code, 0) << good.err;
  EXPECT_EQ(good.out, "right.prm: OK\nsweep.prm: OK, 2 variants\n");

  const auto mixed =
    process.run({"check", "wrong.prm", "right.prm", "nowhere.prm"});
  EXPECT_EQ(mixed.exit_code, 2);
  EXPECT_EQ(mixed.out, "right.prm: OK\n");
  EXPECT_EQ(mixed.n_error_lines(), 2u) << mixed.err;
  EXPECT_FALSE(std::filesystem::exists(process.folder() / "output"));
}
