// SPDX-License-Identifier: LGPL-2.1-or-later

// Maps proposed for files as instruments, spreadsheets and people write them.

#include <slipstep/measured_data/import_proposal.h>
#include <slipstep/measured_data/import_record.h>
#include <slipstep/utilities/lists.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "import_examples.h"
#include "tests/temporary_folder.h"

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  namespace fs = std::filesystem;

  std::vector<std::string> lines_of(const ImportProposal &proposal)
  {
    std::vector<std::string> lines;
    for (const ImportGuess &guess : proposal.guesses)
      lines.push_back((guess.is_open ? "? " : "") + guess.path + " = " +
                      guess.value);
    return lines;
  }

  std::string all_lines_of(const ImportProposal &proposal)
  {
    std::string text;
    for (const std::string &line : lines_of(proposal))
      text += "\n    " + line;
    return text;
  }

  ImportProposal proposal_for(const std::string &name, const std::string &text)
  {
    const fs::path file = test_folder() / name;
    std::ofstream(file, std::ios::binary) << text;
    return propose_import(file);
  }
} // namespace



// A comment behind the first row does not make it less of a row.
TEST(ImportProposal, RowsWithCommentsAreCounted)
{
  const ImportProposal proposal =
    proposal_for("commented.lvm",
                 "X_Value\tPosition\tForce\tComment\n"
                 "0.0\t0.1\t0.2\tstart\n0.1\t0.2\t0.3\n0.2\t0.3\t0.4\n");
  EXPECT_EQ(proposal.layout.n_rows, 3u);
  EXPECT_EQ(proposal.layout.first_row, 2u);
  EXPECT_EQ(proposal.layout.header_line, 1u);
}



TEST(ImportProposal, RealLookingFilesAreUnderstood)
{
  for (const Example &example : import_examples)
    {
      const ImportProposal proposal = proposal_for(example.name, example.text);
      const auto           lines    = lines_of(proposal);
      for (const std::string &line : example.expected)
        EXPECT_NE(std::find(lines.begin(), lines.end(), line), lines.end())
          << example.name << ": " << line << " is not in"
          << all_lines_of(proposal);
      for (const std::string &path : example.absent)
        for (const ImportGuess &guess : proposal.guesses)
          EXPECT_NE(guess.path, path) << example.name << all_lines_of(proposal);
    }
}



// A number says nothing to whom reads it.
TEST(ImportProposal, NamesStandBesideNumbers)
{
  // The second is in Latin-1.
  for (const std::string heading : {"x [\xC2\xB5m]", "x [\xB5m]"})
    for (const ImportGuess &guess :
         proposal_for("a.csv",
                      "Time [s]," + heading +
                        ",p [MPa],mu\n"
                        "0,0,5,0\n1,1,5,0.1\n2,2,5,0.1\n")
           .guesses)
      if (guess.value == "column 2 in um")
        EXPECT_EQ(guess.reason, "'x [\xC2\xB5m]' from 0 to 2");
      else
        EXPECT_EQ(guess.reason.find("'"), std::string::npos) << guess.reason;
}



TEST(ImportProposal, WeightsInUnitsOfMassAreAskedFor)
{
  const auto guesses =
    proposal_for("a.csv", "Time [s],x [mm],mu,Load [lb]\n0,0,0,1\n1,1,0,2\n")
      .guesses;
  EXPECT_TRUE(any_of(guesses, [](const auto &guess) {
    return guess.value == "Load [lb] in lbf" && guess.is_open &&
           guess.reason == "from 1 to 2; lb is a mass: does it mean lbf?";
  }));
}



// What it is sure of converts as it is.
TEST(ImportProposal, CompleteMapsConvert)
{
  unsigned int n_complete = 0;
  for (const Example &example : import_examples)
    {
      const ImportProposal proposal = proposal_for(example.name, example.text);
      if (!proposal.is_complete())
        continue;
      ++n_complete;
      const auto tests =
        import_record(proposal.map(), {proposal.file, {}}, "a");
      ASSERT_EQ(tests.size(), 1u) << example.name;
      EXPECT_GE(tests[0].time.size(), 3u) << example.name;
      EXPECT_GE(tests[0].friction.back(), 0.) << example.name;
    }
  EXPECT_GE(n_complete, 7u);
}



// The file of a map says the same, and why.
TEST(ImportProposal, MapsAreWrittenWithReasons)
{
  for (const Example &example : import_examples)
    {
      const ImportProposal proposal = proposal_for(example.name, example.text);
      const fs::path       file     = test_folder() / "map.prm";
      std::ofstream(file) << proposal.text();
      Parameters map = proposal.map(), read = proposal.map();
      read.read(file);
      EXPECT_TRUE(read.has_values_of(map)) << proposal.text();
      for (const ImportGuess &guess : proposal.guesses)
        EXPECT_FALSE(guess.reason.empty()) << guess.path;
    }
}



TEST(ImportProposal, WhatIsNoTableIsRefused)
{
  for (const std::string text : {"",
                                 "\n\n",
                                 "once upon a time\nthere was a rig\n",
                                 "t,x\n1,2\n",
                                 "\xFF\xFE"
                                 "a\n"})
    EXPECT_THROW(proposal_for("a.txt", text), InputError) << text;
  EXPECT_THROW(proposal_for("a.bin", std::string("1 2\n\0 3\n", 8)),
               InputError);
  EXPECT_THROW(propose_import(test_folder() / "nowhere.txt"), InputError);
}
