// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/utilities.h>

#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/parameters.h>
#include <slipstep/utilities/pattern_words.h>
#include <slipstep/utilities/text.h>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/file_text.h"
#include "tests/utilities/declared_parameters.h"

using namespace SlipStep;
using namespace SlipStep::Testing;



TEST_F(ParametersTest, ReadsValuesCommentsAndContinuedLines)
{
  const Parameters p = read("# a comment\n"
                            "set Title = one \\\n"
                            "   # in between\n"
                            "   two = three   # behind\n"
                            "subsection Friction\n"
                            "  subsection softening\n"
                            "    set Rate=0.1 1/m\n"
                            "  end\n"
                            "end\n"
                            "set Loading/Speed = 60 mm/min\n"
                            "set Block/Degree = 2\n"
                            "set Block/Curved = true\r\n");
  EXPECT_EQ(p.text("Title"), "one two = three");
  EXPECT_DOUBLE_EQ(p.number("Friction/softening/Rate"), 1e-4);
  EXPECT_EQ(p.number("Loading/Speed"), 1.);
  EXPECT_EQ(p.integer("Block/Degree"), 2);
  EXPECT_EQ(p.number("Block/Degree"), 2.);
  EXPECT_TRUE(p.boolean("Block/Curved"));
  EXPECT_EQ(p.list("Friction/Effects"),
            (std::vector<std::string>{"subloading", "softening"}));
  EXPECT_TRUE(p.is_set("Title"));
  EXPECT_FALSE(p.is_set("Block/Form"));
  EXPECT_EQ(p.layer("Block/Form"), 0u);
  EXPECT_EQ(p.layer("Title"), 1u);
  EXPECT_EQ(p.resolve("measured/a.csv"), folder / "measured/a.csv");
}



TEST_F(ParametersTest, AFileOverridesWhatItIncludes)
{
  std::filesystem::create_directories(folder / "common");
  write("common/inner.prm", "set Title = inner\nset Block/Degree = 2\n");
  write("common/base.prm", "include inner.prm\nset Title = base\n");
  const Parameters p =
    read("include common/base.prm\nset Loading/Speed = 2 mm/s\n");
  EXPECT_EQ(p.text("Title"), "base");
  EXPECT_EQ(p.integer("Block/Degree"), 2);
  EXPECT_LT(p.layer("Block/Degree"), p.layer("Title"));
  EXPECT_LT(p.layer("Title"), p.layer("Loading/Speed"));
  EXPECT_TRUE(contains(p.origin("Block/Degree"), "inner.prm:2: Block/Degree"));
}



TEST_F(ParametersTest, UnknownNamesComeWithTheNearest)
{
  EXPECT_EQ(error_of("set Titel = x\n"),
            "case.prm:1: unknown key Titel; did you mean Title?");
  EXPECT_EQ(error_of("subsection Friction\n  subsection softening\n"
                     "    set rte = 1\n  end\nend\n"),
            "case.prm:3: unknown key Friction/softening/rte; did you mean "
            "Friction/softening/Rate?");
  EXPECT_EQ(error_of("subsection Block\n  set Speed = 1\nend\n"),
            "case.prm:2: unknown key Block/Speed; did you mean "
            "Loading/Speed?");
  EXPECT_EQ(error_of("\nsubsection Frction\nend\n"),
            "case.prm:2: unknown section Frction; did you mean Friction?");
  EXPECT_TRUE(
    contains(error_of("set Xyzzyplugh = 1\n"), "slipstep parameters"));
  EXPECT_TRUE(contains(error_of("set Friction/softening = 1\n"),
                       "is a section, not a key"));
}



TEST_F(ParametersTest, TheSameNameInOtherCapitalsIsNearest)
{
  for (const std::string written : {"Friction/Softening/Rate",
                                    "friction/softening/rate",
                                    "Softening/rate",
                                    "Friction/softning/Rate",
                                    "Title/Friction/softening/Rate",
                                    "Friction/SOFTENING/Rates"})
    EXPECT_TRUE(contains(error_of("set " + written + " = 1\n"),
                         "; did you mean Friction/softening/Rate?"));
  EXPECT_TRUE(contains(error_of("subsection Friction\nsubsection Softening\n"
                                "set Rate = 1\nend\nend\n"),
                       "; did you mean Friction/softening?"));
  // Nothing tells which.
  EXPECT_TRUE(contains(error_of("set rate = 1\n"),
                       "; did you mean Friction/softening/Rate or "
                       "Friction/healing/Rate?"));
}



TEST_F(ParametersTest, WrongValuesSayWhatIsAllowed)
{
  EXPECT_EQ(error_of("set Block/Degree = 7\n"),
            "case.prm:1: Block/Degree = 7: allowed is a whole number from 1 "
            "to 2");
  EXPECT_EQ(error_of("set Block/Ratio = much\n"),
            "case.prm:1: Block/Ratio = much: allowed is a number from 0 to "
            "0.5");
  EXPECT_EQ(error_of("set Block/Form = wege\n"),
            "case.prm:1: Block/Form = wege: \"wege\" is not known; did you "
            "mean wedge? Allowed is one of: box, wedge");
  EXPECT_EQ(error_of("set Block/Curved = perhaps\n"),
            "case.prm:1: Block/Curved = perhaps: allowed is true or false");
  EXPECT_TRUE(contains(error_of("set Friction/Effects = subloading, heling\n"),
                       "\"heling\" is not known; did you mean healing?"));
  EXPECT_TRUE(contains(error_of("set Loading/Speed = -1 mm/s\n"),
                       "out of range; allowed is a speed"));
  EXPECT_TRUE(
    contains(error_of("set Loading/Speed = 1 mm/sec\n"), "nearest is mm/s"));
  EXPECT_TRUE(contains(error_of("set Block/Size = 1, 2 kg\n"), "\"2 kg\": "));
  EXPECT_TRUE(contains(error_of("set Block/Size = 1\n"), "a list of 2 to 3"));
  EXPECT_TRUE(contains(error_of("set Block/Degree =\n"),
                       "Block/Degree =: the value is missing"));
}



TEST_F(ParametersTest, CapitalsOfWordsDoNotMatter)
{
  const Parameters p = read("Subsection Block\nSet Degree = 2\nEND\n"
                            "set Block/Form = Wedge\n"
                            "set Block/Curved = True\n"
                            "set Friction/Effects = Softening, HEALING\n");
  EXPECT_EQ(p.text("Block/Form"), "wedge");
  EXPECT_TRUE(p.boolean("Block/Curved"));
  EXPECT_EQ(p.text("Friction/Effects"), "softening, healing");
  // 1 MPa is not 1 mPa.
  EXPECT_TRUE(
    contains(error_of("set Loading/Speed = 1 MM/s\n"), "nearest is mm/s"));

  Parameters q = declared();
  q.declare("Noise", "none", AnythingWithWords({"none", "from"}), "Words.");
  q.set("Noise", "None of Friction/expression/From FROM 1 Nm", "--set");
  EXPECT_EQ(q.text("Noise"), "none of Friction/expression/From from 1 Nm");
}



TEST_F(ParametersTest, DecimalCommasAreToldAsSuch)
{
  const std::string hint = "decimals begin with a point: ";
  EXPECT_EQ(error_of("set Friction/healing/Rate = 0,05 1/s\n"),
            "case.prm:1: Friction/healing/Rate = 0,05 1/s: " + hint +
              "0.05 1/s; allowed is a rate per time (in 1/s if no unit is "
              "given) of at least 0 1/s");
  EXPECT_TRUE(contains(error_of("set Loading/Speed = 1.000,5 mm/s\n"),
                       "decimals begin with a point, and nothing separates"));
  // Two lengths or three?
  EXPECT_TRUE(
    contains(error_of("set Block/Size = 10,5 mm, 10 mm\n"), hint + "10.5 mm"));
  EXPECT_TRUE(
    contains(error_of("set Block/Size = 10,5 mm\n"), hint + "10.5 mm"));
  EXPECT_EQ(error_of("set Block/Size = 10,20,30\n"), "");
  EXPECT_EQ(decimal_comma_hint("(0,0) to (10 mm, 5 mm)"), "");
  EXPECT_EQ(decimal_comma_hint("(0,5 mm, 0 mm)"), hint + "0.5 mm");
  EXPECT_EQ(error_of("set Block/Size = 10 mm,20 mm\n"), "");
  EXPECT_TRUE(contains(error_of("subsection Sweep\n"
                                "set Key = Friction/healing/Rate\n"
                                "set Values = 0,1, 0,2\nend\n"),
                       "case.prm:3: Sweep/Values = 0,1, 0,2: " + hint + "0.1"));
}



TEST_F(ParametersTest, BrokenFilesAreRefused)
{
  EXPECT_EQ(error_of("set Title = a\n\nset Title = b\n"),
            "case.prm:3: Title is given twice, first in line 1");
  // Also when written in two ways.
  EXPECT_TRUE(
    contains(error_of("subsection Block\nset Degree = 1\nend\n"
                      "set Block/Degree = 2\n"),
             "case.prm:4: Block/Degree is given twice, first in line 2"));
  EXPECT_EQ(error_of("subsection Block\n"),
            "case.prm:1: subsection Block, begun here, is never closed by an "
            "\"end\"");
  EXPECT_TRUE(
    contains(error_of("subsection Block\nend\nend\n"), "case.prm:3: "));
  EXPECT_TRUE(
    contains(error_of("subsektion Block\n"), "did you mean subsection?"));
  EXPECT_TRUE(
    contains(error_of("set Title\n"), "case.prm:1: \"set Title\" is not"));
  EXPECT_TRUE(
    contains(error_of("set Title = a \\\n"), "the file ends after a \\"));
  EXPECT_TRUE(contains(error_of("include nowhere.prm\n"),
                       "case.prm:1: include nowhere.prm: no such file"));
  EXPECT_TRUE(contains(error_of("include case.prm\n"), "circle of includes"));
  write("other.prm", "set Title = other\n");
  EXPECT_TRUE(contains(error_of("set Title = own\ninclude other.prm\n"),
                       "move the include up"));
  EXPECT_TRUE(contains(error_of("subsection Block\ninclude other.prm\nend\n"),
                       "outside of subsections"));
}



TEST_F(ParametersTest, AllErrorsAreToldAtOnceInTheOrderOfTheFile)
{
  write("other.prm", "set Nothing = 1\n");
  EXPECT_EQ(error_of("include other.prm\n"
                     "set Block/Degree = x\n"
                     "subsection Frction\n"
                     "  set Rate = not told\n"
                     "  subsection neither\n"
                     "  end\n"
                     "end\n"
                     "sett Title = a\n"
                     "set Block/Form = box\n"
                     "set Loading/Sped = 1 mm/s\n"),
            "other.prm:1: unknown key Nothing; \"slipstep parameters\" lists "
            "the known ones\n"
            "case.prm:2: Block/Degree = x: allowed is a whole number from 1 to "
            "2\n"
            "case.prm:3: unknown section Frction; did you mean Friction?\n"
            "case.prm:8: \"sett Title = a\" is not understood; did you mean "
            "set? (a line is one of: set KEY = VALUE, subsection NAME, end, "
            "include FILE, # comment)\n"
            "case.prm:10: unknown key Loading/Sped; did you mean "
            "Loading/Speed?");

  std::string many;
  for (unsigned int i = 0; i < 23; ++i)
    many += "set Nothing = 1\n";
  const std::string message = error_of(many);
  EXPECT_TRUE(contains(message, "case.prm:20: unknown key"));
  EXPECT_EQ(message.substr(message.rfind('\n')), "\nand 3 more");
}



TEST_F(ParametersTest, AMissingEndNamesTheSectionThatIsOpen)
{
  EXPECT_EQ(error_of("subsection Friction\n  subsection softening\n"
                     "    set Rate = 1\n"
                     "subsection Loading\n  set Speed = 1 mm/s\nend\n"),
            "case.prm:4: an \"end\" is missing before subsection Loading: "
            "subsection softening is open since line 2");
  EXPECT_TRUE(
    contains(error_of("\nsubsection Friction\n"
                      "set Loading/Speed = 1 mm/s\nend\n"),
             "an \"end\" is missing: subsection Friction is open since "
             "line 2"));
  EXPECT_TRUE(
    contains(error_of("subsection Variants\nsubsection a\n"
                      "subsection b\nend\nend\n"),
             "case.prm:3: unknown section b; if it is a variant, an "
             "\"end\" is missing: subsection a is open since line 2"));
  EXPECT_TRUE(contains(error_of("subsection Sweep\nset Key = Block/Degree\n"
                                "subsection Block\nend\nend\n"),
                       "subsection Sweep is open since line 1"));
  write("other.prm", "set Title = a\nsubsection Block\n");
  EXPECT_EQ(error_of("include other.prm\nset Block/Degree = 1\n"),
            "other.prm:2: subsection Block, begun here, is never closed by an "
            "\"end\"");
}



TEST_F(ParametersTest, LinesMayEndAsOnAnySystem)
{
  for (const std::string end : {"\n", "\r\n", "\r"})
    {
      EXPECT_EQ(read("# note" + end + "set Block/Degree = 2" + end)
                  .integer("Block/Degree"),
                2);
      EXPECT_TRUE(
        contains(error_of("set Title = a" + end + "set Titel = b" + end),
                 "case.prm:2: "));
    }
}



TEST_F(ParametersTest, OnlyPrmFilesAreRead)
{
  Parameters p = declared();
  for (const auto &file : {write("case.txt", "set Title = a\n"),
                           write("nul.prm", std::string("set\0x\n", 6)),
                           folder,
                           folder / "nowhere.prm"})
    EXPECT_THROW(p.read(file), InputError) << file;
}



TEST_F(ParametersTest, SetOverridesAndNamesItsOrigin)
{
  Parameters p = read("set Title = file\n");
  p.set("Title", " option ", "--set");
  EXPECT_EQ(p.text("Title"), "option");
  EXPECT_GT(p.layer("Title"), 1u);
  const auto message = [&p](const auto &action) -> std::string {
    try
      {
        action();
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "";
  };
  EXPECT_EQ(message([&] { p.set("Titel", "x", "--set"); }),
            "--set: unknown key Titel; did you mean Title?");
  EXPECT_TRUE(contains(message([&] { p.set("Block/Degree", "3", "--set"); }),
                       "--set Block/Degree = 3: allowed is"));
  EXPECT_EQ(message([&] { p.reject("Title", "too short"); }),
            "--set Title = option: too short");
  EXPECT_TRUE(contains(message([&] { p.reject("Block/Form", "no"); }),
                       "Block/Form = box (the default): no"));
}



TEST_F(ParametersTest, PrintedPrmReadsBackTheSame)
{
  const Parameters   p = read("set Title =\nset Loading/Speed = 3 mm/h\n"
                              "subsection Sweep\nset Key = Block/Size\n"
                              "set Values = 1, 2; 3, 4\nend\n");
  std::ostringstream first, second;
  p.print(first, Parameters::Format::prm);
  const Parameters again = read(first.str());
  again.print(second, Parameters::Format::prm);
  EXPECT_EQ(first.str(), second.str());
  for (const std::string &path : p.paths())
    EXPECT_EQ(p.text(path), again.text(path)) << path;
  EXPECT_EQ(again.variants().size(), 2u);

  std::ostringstream shorter;
  p.print(shorter, Parameters::Format::prm, {"Friction/healing"});
  EXPECT_FALSE(contains(shorter.str(), "subsection healing"));
  EXPECT_TRUE(contains(shorter.str(), "subsection softening"));
}



namespace
{
  // The sections of a path, and its key.
  std::pair<std::vector<std::string>, std::string>
  split(const std::string &path)
  {
    auto              names = dealii::Utilities::split_string_list(path, '/');
    const std::string key   = names.back();
    names.pop_back();
    return {names, key};
  }
} // namespace



// Values are shared until one of the two is changed.
TEST_F(ParametersTest, WhatIsSetInACopyIsOfTheCopy)
{
  Parameters first = read("set Title = a\n");
  Parameters copy  = first;
  copy.set("Title", "b", "test");
  Parameters second = copy;
  first.set("Title", "c", "test");
  second.set("Title", "d", "test");
  EXPECT_EQ(first.text("Title"), "c");
  EXPECT_EQ(copy.text("Title"), "b");
  EXPECT_EQ(second.text("Title"), "d");
  EXPECT_EQ(copy.handler().get("Title"), "b");
  EXPECT_EQ(first.handler().get("Title"), "c");
  copy.declare("More", "e", dealii::Patterns::Anything(), "");
  EXPECT_EQ(copy.text("More"), "e");
  EXPECT_EQ(copy.text("Title"), "b");
  EXPECT_TRUE(first.paths("More").empty());
  // The last owner sets in place again.
  {
    Parameters third = second;
    third.set("Title", "f", "test");
    second = third;
  }
  second.set("Title", "g", "test");
  EXPECT_EQ(second.text("Title"), "g");
}



TEST_F(ParametersTest, AParameterHandlerHoldsAndReadsTheSame)
{
  Parameters p = read("set Title = a, b\n"
                      "subsection Friction\n"
                      "  subsection softening\n"
                      "    set Rate = 0.06 1/mm\n"
                      "  end\n"
                      "end\n"
                      "subsection Block\n"
                      "  set Degree = 2\n"
                      "  set Curved = true\n"
                      "end\n");
  EXPECT_EQ(p.handler().get("Title"), "a, b");
  EXPECT_EQ(p.handler().get({"Friction", "softening"}, "Rate"), "0.06 1/mm");
  EXPECT_EQ(p.handler().get_integer({"Block"}, "Degree"), 2);
  EXPECT_TRUE(p.handler().get_bool({"Block"}, "Curved"));

  std::ostringstream printed;
  p.print(printed, Parameters::Format::prm);
  dealii::ParameterHandler reader;
  for (const std::string &path : p.paths())
    {
      const auto &[sections, key] = split(path);
      for (const std::string &section : sections)
        reader.enter_subsection(section);
      reader.declare_entry(key,
                           p.entry(path).default_value,
                           *p.entry(path).pattern);
      for (std::size_t i = 0; i < sections.size(); ++i)
        reader.leave_subsection();
    }
  reader.parse_input_from_string(printed.str());
  for (const std::string &path : p.paths())
    EXPECT_EQ(reader.get(split(path).first, split(path).second), p.text(path));
}



TEST_F(ParametersTest, CopiesGoTheirOwnWays)
{
  Parameters first = declared();
  first.set("Block/Degree", "2", "--set");
  Parameters second = first;
  second.set("Block/Degree", "1", "--set");
  EXPECT_EQ(first.integer("Block/Degree"), 2);
  EXPECT_EQ(second.integer("Block/Degree"), 1);
  first = second;
  EXPECT_EQ(first.integer("Block/Degree"), 1);
  second = std::move(first);
  EXPECT_EQ(second.text("Loading/Speed"), "1 mm/min");
}



TEST_F(ParametersTest, PrintsForProgramsAndPages)
{
  const Parameters   p = read("set Block/Degree = 2\n");
  std::ostringstream json_text, page;
  p.print(json_text, Parameters::Format::json);
  const auto json   = nlohmann::json::parse(json_text.str());
  const auto degree = json.at("Block").at("Degree");
  EXPECT_EQ(degree.at("value"), "2");
  EXPECT_EQ(degree.at("default"), "1");
  EXPECT_EQ(degree.at("allowed"), "a whole number from 1 to 2");
  EXPECT_EQ(degree.at("documentation"), "Of elements.");

  p.print(page, Parameters::Format::markdown);
  EXPECT_TRUE(contains(page.str(), "## Friction/softening\n\n| Key |"));
  EXPECT_TRUE(
    contains(page.str(), "| Degree | `1` | a whole number from 1 to 2 |"));
}


TEST_F(ParametersTest, FindsKeysAndSectionsByTheirLastNames)
{
  const Parameters p    = read("");
  const auto       find = [&](const std::string &name) {
    return p.find(name, "asked");
  };
  using Paths = std::vector<std::string>;
  EXPECT_EQ(find("Block/Degree"), Paths({"Block/Degree"}));
  EXPECT_EQ(find("degree"), Paths({"Block/Degree"}));
  EXPECT_EQ(find("softening"), p.paths("Friction/softening/"));
  EXPECT_EQ(find("Friction"), p.paths("Friction/"));
  for (const auto &[name, words] : std::map<std::string, std::string>(
         {{"sofetning", "did you mean softening?"},
          {"Friction/Degree", "did you mean Block/Degree?"},
          {"nothing like it", "there is no key or section"}}))
    try
      {
        find(name);
        ADD_FAILURE() << name;
      }
    catch (const InputError &error)
      {
        EXPECT_TRUE(contains(error.what(), words));
        EXPECT_TRUE(contains(error.what(), "asked"));
      }

  std::ostringstream out;
  p.print(out, Parameters::Format::keys, {}, {}, find("Block"));
  EXPECT_EQ(out.str().find("Block/"), 0u);
  EXPECT_FALSE(contains(out.str(), "Friction"));
}



TEST_F(ParametersTest, PrintsASchema)
{
  std::ostringstream out;
  read("set Block/Degree = 2\n").print(out, Parameters::Format::schema);
  const auto schema = nlohmann::json::parse(out.str());
  EXPECT_EQ(schema.at("type"), "object");
  const auto degree =
    schema.at("properties").at("Block").at("properties").at("Degree");
  EXPECT_EQ(degree.at("default"), "1");
  EXPECT_TRUE(contains(degree.at("description"), "a whole number from 1 to 2"));
}
