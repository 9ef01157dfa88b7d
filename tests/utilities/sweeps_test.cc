// SPDX-License-Identifier: LGPL-2.1-or-later

// Sweeps and variants of a case.

#include "tests/file_text.h"
#include "tests/utilities/declared_parameters.h"

using namespace SlipStep;
using namespace SlipStep::Testing;



TEST_F(ParametersTest, ASweepHasAVariantPerValue)
{
  const Parameters p = read("subsection Sweep\n  set Key = Loading/Speed\n"
                            "  set Values = 1 mm/min, 10 mm/min\nend\n");
  ASSERT_EQ(p.variants().size(), 2u);
  EXPECT_EQ(p.variants()[1].label, "10 mm/min");
  EXPECT_EQ(p.variants()[1].folder, "10_mm-min");
  const Parameters variant = p.with_variant(p.variants()[1]);
  EXPECT_DOUBLE_EQ(variant.number("Loading/Speed"), 1. / 6.);
  EXPECT_TRUE(variant.variants().empty());
  EXPECT_TRUE(contains(variant.origin("Loading/Speed"), "case.prm:3: "));

  // A value with a comma needs semicolons; a bare number gets its key's name.
  const Parameters lists = read("subsection Sweep\n  set Key = Block/Size\n"
                                "  set Values = 1, 2; 3, 4\nend\n");
  ASSERT_EQ(lists.variants().size(), 2u);
  EXPECT_EQ(lists.variants()[0].overrides[0].value, "1, 2");
  const Parameters bare = read("subsection Sweep\n  set Key = Block/Degree\n"
                               "  set Values = 1, 2\nend\n");
  EXPECT_EQ(bare.variants()[0].folder, "Degree_1");
}



TEST_F(ParametersTest, VariantsNameTheirKeys)
{
  const std::string text = "subsection Variants\n"
                           "  subsection ../slow & soft\n"
                           "    set Loading/Speed = 1 mm/h\n"
                           "    subsection Friction\n"
                           "      set softening/Rate = 2\n"
                           "    end\n"
                           "  end\n"
                           "  subsection report\n"
                           "    set Block/Degree = 2\n"
                           "  end\n"
                           "end\n";
  const Parameters  p    = read(text);
  ASSERT_EQ(p.variants().size(), 2u);
  EXPECT_EQ(p.variants()[0].overrides[1].path, "Friction/softening/Rate");
  // Nothing leaves the output folder or hits the report's own.
  EXPECT_EQ(p.variants()[0].folder, "_..-slow_soft");
  EXPECT_NE(p.variants()[1].folder, "report");
  for (const std::string taken :
       {"report.html", "used_parameters.prm", "point"})
    EXPECT_EQ(read("subsection Variants\nsubsection " + taken +
                   "\nset Block/Degree = 2\nend\nend\n")
                .variants()[0]
                .folder,
              taken + "_");

  // An including file can undo the sweep.
  write("sweep.prm", text);
  EXPECT_EQ(read("include sweep.prm\n").variants().size(), 2u);
  EXPECT_TRUE(
    read("include sweep.prm\nsubsection Variants\nend\n").variants().empty());
  // Without one it does nothing.
  EXPECT_TRUE(
    contains(error_of("subsection Variants\nend\n"), "Variants is empty"));
}



TEST_F(ParametersTest, SettingTheSweptKeyEndsTheSweep)
{
  Parameters p = read("subsection Sweep\n  set Key = Loading/Speed\n"
                      "  set Values = 1 mm/min, 10 mm/min\nend\n");
  p.set("Title", "x", "--set");
  EXPECT_EQ(p.variants().size(), 2u);
  p.set("Loading/Speed", "5 mm/min", "--set");
  EXPECT_TRUE(p.variants().empty());
}



// Both would be passed over without a word.
TEST_F(ParametersTest, AnIncludedSweepIsNeitherExtendedNorFixed)
{
  write("sweep.prm",
        "subsection Sweep\nset Key = Loading/Speed\n"
        "set Values = 1 mm/min, 10 mm/min\nend\n");
  const std::string include = "include sweep.prm\n";
  EXPECT_TRUE(
    contains(error_of(include + "subsection Sweep\nset Key 2 = Block/Degree\n"
                                "set Values 2 = 1, 2\nend\n"),
             "case.prm:3: Sweep has a further key, but no Key"));
  EXPECT_TRUE(
    contains(error_of(include + "set Loading/Speed = 5 mm/min\n"),
             "case.prm:2: Loading/Speed is swept by an included file"));
  // Other values go with it, and a sweep of one's own takes its place.
  EXPECT_EQ(read(include + "set Block/Degree = 2\n").variants().size(), 2u);
  EXPECT_EQ(read(include + "set Loading/Speed = 5 mm/min\nsubsection Sweep\n"
                           "set Key = Block/Degree\nset Values = 1, 2\nend\n")
              .variants()[1]
              .label,
            "Degree 2");
  EXPECT_TRUE(read(include + "set Loading/Speed = 5 mm/min\n"
                             "subsection Variants\nend\n")
                .variants()
                .empty());
}



TEST_F(ParametersTest, KeysOfOneNameHaveTheirSectionsInLabels)
{
  const auto labels = [this](const std::string &second) {
    return read("subsection Sweep\nset Key = Friction/softening/Rate\n"
                "set Values = 1, 2\nset Key 2 = " +
                second + "\nset Values 2 = 1, 2\nend\n")
      .variants()[1]
      .label;
  };
  EXPECT_EQ(labels("Friction/healing/Rate"),
            "softening/Rate 1, healing/Rate 2");
  EXPECT_EQ(labels("Block/Degree"), "Rate 1, Degree 2");
}



TEST_F(ParametersTest, WrongSweepsAreRefused)
{
  const auto sweep = [this](const std::string &lines) {
    return error_of("subsection Sweep\n" + lines + "end\n");
  };
  EXPECT_TRUE(contains(sweep("set Key = Loading/Sped\nset Values = 1\n"),
                       "case.prm:2: unknown key Loading/Sped; did you mean "
                       "Loading/Speed?"));
  EXPECT_TRUE(contains(sweep("set Key = Block/Degree\nset Values = 1, 5\n"),
                       "case.prm:3: Block/Degree = 5: allowed is"));
  EXPECT_TRUE(contains(sweep("set Key = Block/Degree\n"), "needs both"));
  EXPECT_TRUE(contains(sweep("set Key = Block/Degree\nset Values = 1, 1\n"),
                       "case.prm:3: the variant \"Degree 1\" is given twice"));
  EXPECT_TRUE(contains(sweep("set Kay = Block/Degree\n"), "did you mean Key?"));
  EXPECT_TRUE(contains(error_of("subsection Variants\nsubsection a\nend\n"
                                "subsection a\nend\nend\n"),
                       "case.prm:4: the variant \"a\" is given twice"));
  EXPECT_TRUE(contains(error_of("subsection Variants\nsubsection a\n"
                                "set Block/Degre = 1\nend\nend\n"),
                       "case.prm:3: unknown key Block/Degre; did you mean"));
  EXPECT_TRUE(
    contains(error_of("subsection Variants\nend\nsubsection Sweep\nend\n"),
             "case.prm:3: both Variants and Sweep"));
}
