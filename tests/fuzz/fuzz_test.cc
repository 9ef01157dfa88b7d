// SPDX-License-Identifier: LGPL-2.1-or-later

// Inputs that somebody has damaged, at random: each is read right, warned of or
// refused, in words that name the place. More of them, or others:
//   SLIPSTEP_FUZZ_RUNS=3000 SLIPSTEP_FUZZ_SEED=7 build/tests/fuzz_test

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <regex>

#include "tests/restart/restart_tools.h"

using namespace SlipStep::Testing;

namespace
{
  unsigned int from_environment(const char *name, const unsigned int otherwise)
  {
    const char *text = std::getenv(name);
    return text != nullptr ? std::atoi(text) : otherwise;
  }

  // Of six kinds.
  const unsigned int n_runs = from_environment("SLIPSTEP_FUZZ_RUNS", 300) / 6;
  const unsigned int seed   = from_environment("SLIPSTEP_FUZZ_SEED", 1);



  // ------------------------------------------------------------- mutations

  class Mutator
  {
  public:
    explicit Mutator(const unsigned int seed)
      : random(seed)
    {}

    std::size_t below(const std::size_t n)
    {
      return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
    }

    // One to three things are wrong with it.
    std::string mutated(std::string text)
    {
      for (std::size_t n = 1 + below(3); n > 0; --n)
        text = changed(text);
      return text;
    }

  private:
    std::string changed(std::string text)
    {
      if (text.empty())
        return "x";
      const std::size_t place = below(text.size());
      switch (below(9))
        {
          case 0: // another character
            text[place] = static_cast<char>(below(256));
            return text;
          case 1: // cut off
            return text.substr(0, place);
          case 2: // something lost
            return text.erase(place, 1 + below(20));
          case 3: // something said twice
            return text.insert(place, text.substr(place, 1 + below(40)));
          case 4: // a line moved
            return moved_line(text);
          case 5:
            return other_number(text);
          case 6: // other capitals
            text[place] = std::isupper(text[place]) ?
                            std::tolower(text[place]) :
                            std::toupper(text[place]);
            return text;
          case 7:
            return text.insert(place, words[below(words.size())]);
          default: // line ends
            return std::regex_replace(text,
                                      std::regex("\n"),
                                      below(2) == 0 ? "\r\n" : "\r");
        }
    }

    std::string moved_line(const std::string &text)
    {
      std::istringstream       in(text);
      std::vector<std::string> lines;
      for (std::string line; std::getline(in, line);)
        lines.push_back(line);
      if (!lines.empty())
        std::swap(lines[below(lines.size())], lines[below(lines.size())]);
      std::string result;
      for (const std::string &line : lines)
        result += line + '\n';
      return result;
    }

    std::string other_number(const std::string &text)
    {
      const std::regex         number("[0-9]+(\\.[0-9]+)?(e-?[0-9]+)?");
      std::vector<std::smatch> all;
      for (std::sregex_iterator i(text.begin(), text.end(), number), end;
           i != end;
           ++i)
        all.push_back(*i);
      if (all.empty())
        return text;
      const std::smatch &one = all[below(all.size())];
      return one.prefix().str() + numbers[below(numbers.size())] +
             one.suffix().str();
    }

    std::mt19937                   random;
    const std::vector<std::string> numbers = {"0",
                                              "-1",
                                              "nan",
                                              "inf",
                                              "1e400",
                                              "1e-320",
                                              "1e300",
                                              "1e-12",
                                              "0,5",
                                              "99999999999999999999",
                                              "1.2.3",
                                              "0x10",
                                              "1e",
                                              "-0",
                                              "--1",
                                              ""};
    const std::vector<std::string> words   = {"end\n",
                                              "subsection ",
                                              "set ",
                                              "#",
                                              "\\\n",
                                              "{",
                                              "}",
                                              ";",
                                              ",",
                                              "=",
                                              "\"",
                                              "include no.prm\n",
                                              std::string(5000, 'x'),
                                              "mm",
                                              "\xc3",
                                              "\t",
                                              "%n%s",
                                              "../",
                                              "$(date)",
                                              "repeat 1000000000 times { "};
  };



  // --------------------------------------------------------------- verdicts

  std::string printable(const std::string &text)
  {
    return text.size() > 3000 ? text.substr(0, 3000) + " ..." : text;
  }

  // Neither a signal nor a hang, and a word where it fails.
  void expect_in_words(const SlipstepProcess::Result  &result,
                       const std::string              &input,
                       const std::vector<std::string> &places = {})
  {
    SCOPED_TRACE(printable(input));
    EXPECT_TRUE(result.exit_code >= 0 && result.exit_code <= 2)
      << "exit code " << result.exit_code << '\n'
      << printable(result.err);
    if (result.exit_code == 0)
      return;
    EXPECT_FALSE(result.err.empty());
    // Twenty errors of a file, and marks below some.
    EXPECT_LE(result.n_error_lines(), 70u) << printable(result.err);
    std::istringstream in(result.err);
    for (std::string line; std::getline(in, line);)
      EXPECT_LE(line.size(), 2000u) << printable(line);
    for (const char *raw :
         {"std::", "basic_string", "[json.exception", "dealii"})
      EXPECT_EQ(result.err.find(raw), std::string::npos)
        << printable(result.err);
    if (result.exit_code == 2 && !places.empty())
      {
        EXPECT_TRUE(std::any_of(places.begin(),
                                places.end(),
                                [&](const std::string &place) {
                                  return result.err.find(place) !=
                                         std::string::npos;
                                }))
          << printable(result.err);
      }
  }



  class Fuzz : public RestartTest
  {
  protected:
    // With time for a loaded machine; to be killed is no exit code from 0 to 2.
    SlipstepProcess::Result run_briefly(const std::vector<std::string> &words)
    {
      return process.run(words, "", "", 300);
    }

    Mutator random{seed};
  };

  const std::string point_case =
    "# A case with a little of everything.\n"
    "set Loading/Programme = press 5.8 MPa in 1 s; hold 0.5 s; \\\n"
    "  repeat 2 times { slide 10 mm/min for 0.01 mm; slide -0.1 mm/s for 5 um }\n"
    "subsection Friction\n"
    "  set Effects = subloading, overstress, softening, healing\n"
    "  set Static coefficient = 0.12\n"
    "  subsection softening\n"
    "    set Rate = 0.05\n"
    "    set Kinetic coefficient = 0.09\n"
    "  end\n"
    "  set Tangential stiffness = 1e5 MPa/mm\n"
    "end\n"
    "set Block/Size = 10 mm, 10 mm, 5 mm\n"
    "set Output/Quantities = friction force at 0.005 mm; peak coefficient\n"
    "subsection Time stepping\n"
    "  set Tolerance = 1e-3\n"
    "end\n"
    "subsection Sweep\n"
    "  set Key = Friction/overstress/Viscosity\n"
    "  set Values = 1e4, 2e4\n"
    "end\n";

  const std::string test_rows =
    "# name: a test\n# condition: 1 mm/min\n"
    "time_s,displacement_mm,pressure_MPa,friction\n"
    "0,0,0,0\n0.5,0,5.8,0.001\n1,0,5.8,0.002\n2,0.016,5.8,0.09\n"
    "3,0.033,5.8,0.11\n4,0.05,5.8,0.1\n5,0.066,5.8,0.1\n6,0.066,5.8,0.1\n";
} // namespace



TEST_F(Fuzz, Cases)
{
  for (unsigned int n = 0; n < n_runs; ++n)
    {
      const std::string text = random.mutated(point_case);
      process.write("fuzzed.prm", text);
      const auto result = run_briefly({"point",
                                       "fuzzed.prm",
                                       "--quiet",
                                       "--output",
                                       "output",
                                       "--set",
                                       "Time stepping/Most steps per "
                                       "statement=5000"});
      expect_in_words(result, text, {"fuzzed.prm", "--set", "output"});
    }
}



TEST_F(Fuzz, MeasuredTests)
{
  process.write("follow.prm",
                "set Loading/Programme = follow fuzzed.csv\n"
                "set Time stepping/Most steps per statement = 5000\n");
  for (unsigned int n = 0; n < n_runs; ++n)
    {
      const std::string text = random.mutated(test_rows);
      process.write("fuzzed.csv", text);
      expect_in_words(run_briefly({"check", "fuzzed.csv"}),
                      text,
                      {"fuzzed.csv"});
      if (n % 2 == 0)
        expect_in_words(
          run_briefly({"point", "follow.prm", "--quiet", "--output", "output"}),
          text,
          {"fuzzed.csv", "follow.prm"});
    }
}



TEST_F(Fuzz, ImportMaps)
{
  const std::string map = content(std::string(SLIPSTEP_SOURCE_DIR) +
                                  "/prm/reciprocating_tribometer/import.prm");
  ASSERT_FALSE(map.empty());
  process.write("raw.csv", test_rows);
  for (unsigned int n = 0; n < n_runs; ++n)
    {
      const std::string text = random.mutated(map);
      process.write("import.prm", text);
      expect_in_words(run_briefly({"check", "import.prm"}),
                      text,
                      {"import.prm", "raw.csv", ".csv"});
    }
}



TEST_F(Fuzz, CommandLines)
{
  process.write("case.prm", point_case);
  process.write("test.csv", test_rows);
  const std::vector<std::vector<std::string>> lines = {
    {"point", "case.prm", "--set", "Friction/softening/Rate=0.06", "--quiet"},
    {"point", "case.prm", "--variant", "1e4", "--output", "elsewhere"},
    {"check", "case.prm", "test.csv", "--set", "Block/Degree=1"},
    {"effects", "--format", "md"},
    {"parameters", "import", "--format", "json"},
    {"refine", "case.prm", "--help"},
    {"point", "case.prm", "--resume", "--set", "Loading/Speed=1 mm/s"}};
  for (unsigned int n = 0; n < n_runs; ++n)
    {
      auto         words = lines[random.below(lines.size())];
      std::string &word  = words[random.below(words.size())];
      word               = random.mutated(word);
      // No argument holds a zero.
      word.erase(std::remove(word.begin(), word.end(), '\0'), word.end());
      std::string all;
      for (const std::string &one : words)
        all += one + '\n';
      expect_in_words(run_briefly(words), all);
    }
}



TEST_F(Fuzz, SealedAnswers)
{
  ASSERT_EQ(
    process
      .run({"plant", "campaign", "--class", "one", "--tests", "4", "--quiet"})
      .exit_code,
    0);
  const std::string answer = process.read("campaign/answer.sealed");
  const auto        opened =
    process.run({"plant", "--open", "campaign/answer.sealed"}).out;
  for (unsigned int n = 0; n < n_runs; ++n)
    {
      const std::string text = random.mutated(answer);
      process.write("fuzzed.sealed", text);
      const auto result = run_briefly({"plant", "--open", "fuzzed.sealed"});
      expect_in_words(result, text, {"fuzzed.sealed"});
      if (result.exit_code == 0)
        {
          EXPECT_EQ(result.out, opened) << printable(text);
        }
    }
}



TEST_F(Fuzz, Checkpoints)
{
  run_and_kill("victim", 150, {"--quiet", "--set", often});
  std::vector<std::string> files;
  for (const auto &entry : fs::recursive_directory_iterator(path("victim")))
    if (entry.is_regular_file() && entry.path().extension() != ".vtu" &&
        entry.path().filename() != ".slipstep")
      files.push_back(fs::relative(entry.path(), path("victim")).string());
  std::sort(files.begin(), files.end());
  for (unsigned int n = 0; n < n_runs; ++n)
    {
      fs::remove_all(path("fuzzed"));
      copy("victim", "fuzzed");
      const std::string file = "fuzzed/" + files[random.below(files.size())];
      process.write(file, random.mutated(process.read(file)));
      const auto result =
        run("fuzzed", {"--resume", "--quiet"}, "timeout -k 10 300");
      expect_in_words(result, file, {"fuzzed"});
      if (result.exit_code == 0)
        {
          EXPECT_TRUE(history("fuzzed") == expected()) << file;
        }
    }
}
