// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/utilities/exceptions.h>
#include <slipstep/report/figure.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "tests/report/page_text.h"

using namespace SlipStep;

namespace
{
  /// A folder whose name would trip up a careless call of the shell.
  std::filesystem::path scratch_folder()
  {
    const auto folder = test_folder() / "it's a figure";
    std::filesystem::create_directories(folder);
    return folder;
  }
} // namespace



TEST(Figure, DataAndScriptCanBeDrawnAgain)
{
  Figure            figure(scratch_folder(), "curve", "A curve", 300, 200);
  const std::string first  = figure.add_data("a", {"x", "y"}, {{0, 1}, {2, 3}});
  const std::string second = figure.add_data("b", {"x"}, {{0.1}});
  EXPECT_EQ(first, "'curve.dat' index 0");
  EXPECT_EQ(second, "'curve.dat' index 1");
  figure.script() << "plot " << first << " with lines\n";
  figure.write();
  EXPECT_EQ(content(scratch_folder() / "curve.dat"),
            "# a\n# x y\n0 1\n2 3\n\n\n# b\n# x\n0.1\n");
  const std::string script = content(scratch_folder() / "curve.gp");
  EXPECT_TRUE(contains(script, "set output 'curve.svg'"));
  EXPECT_TRUE(contains(script, "plot 'curve.dat' index 0 with lines"));
}



TEST(Figure, PicturesOnOnePageShareNoIds)
{
  if (!has_gnuplot())
    GTEST_SKIP() << "gnuplot is not installed";
  std::string page;
  for (const std::string name : {"one", "two"})
    {
      Figure figure(scratch_folder(), name, "x < y", 300, 200);
      figure.script() << "plot sin(x) with points title "
                      << gnuplot_text("a_b {c} \"d\" `e` \\f") << "\n";
      EXPECT_EQ(figure.write(), "");
      const std::string svg = figure.inline_svg();
      EXPECT_EQ(svg.find("<svg"), 0u);
      EXPECT_EQ(count(svg, "</svg>"), 1u);
      has_all(svg, {"<title>x &lt; y</title>", "a_b {c} \"d\" 'e' \\f<"});
      EXPECT_GT(count(svg, "id="), 0u);
      EXPECT_EQ(count(svg, "id="),
                count(svg, "id='" + name + "-") +
                  count(svg, "id=\"" + name + "-"));
      EXPECT_EQ(count(svg, "href="),
                count(svg, "href='#" + name + "-") +
                  count(svg, "href=\"#" + name + "-"));
    }
}



TEST(Figure, AnErrorInTheScriptIsAWarning)
{
  if (!has_gnuplot())
    GTEST_SKIP() << "gnuplot is not installed";
  Figure figure(scratch_folder(), "broken", "Broken", 300, 200);
  figure.script() << "plot 'no such file' with lines\n";
  const std::string warning = figure.write();
  has_all(warning, {"Broken", "broken.gp"});
  EXPECT_EQ(figure.inline_svg(), "");
}



TEST(Figure, AMissingGnuplotIsAWarning)
{
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nonexistent", 1);
  Figure figure(scratch_folder(), "absent", "Absent", 300, 200);
  figure.script() << "plot sin(x)\n";
  const std::string warning = figure.write();
  setenv("PATH", path.c_str(), 1);
  EXPECT_TRUE(contains(warning, "gnuplot-nox"));
  EXPECT_TRUE(std::filesystem::exists(scratch_folder() / "absent.gp"));
  EXPECT_FALSE(std::filesystem::exists(figure.svg_file()));
}



TEST(Figure, AFolderThatDoesNotExistIsAnError)
{
  EXPECT_THROW(Figure("/no/such/folder", "x", "x", 1, 1).write(), RunError);
}



TEST(Figure, HtmlTextIsEscaped)
{
  EXPECT_EQ(html_text("<E> & \"h\""), "&lt;E&gt; &amp; &quot;h&quot;");
}



// Cycles without end are drawn as two or three of them; what is elsewhere is
// drawn.
TEST(Figure, LinesOnLinesAreDrawnOnce)
{
  const auto circle = [](const double radius, const double turn) {
    return std::vector<double>{radius * std::cos(turn),
                               radius * std::sin(turn)};
  };
  Rows points;
  for (unsigned int i = 0; i <= 100000; ++i)
    points.push_back(circle(1., 0.063 * i));
  points.push_back(circle(0.5, 1.));
  const Rows drawn = thinned(points);
  EXPECT_LT(drawn.size(), 30000u);
  EXPECT_EQ(drawn.back(), points.back());
  EXPECT_TRUE(std::any_of(drawn.begin(), drawn.end(), [](const auto &point) {
    return std::isnan(point[0]) && std::isnan(point[1]);
  }));

  // Few points stay as they are.
  points.resize(300);
  EXPECT_EQ(thinned(points), points);
}



// A million noisy rows look the same with a few thousand: every column of
// pixels reaches as far up and down, and a single row that is off is there.
TEST(Figure, NoiseIsDrawnAsItsBand)
{
  std::mt19937                     random(1);
  std::normal_distribution<double> noise;
  Rows                             points;
  for (unsigned int i = 0; i < 200000; ++i)
    points.push_back({1e-4 * i, 0.2 + 0.01 * noise(random)});
  points[77777][1] = 0.5;
  const Rows drawn = thinned(points);
  EXPECT_LT(drawn.size(), 5000u);

  const auto columns = [](const Rows &rows) {
    std::vector<Range> ranges(300);
    for (const auto &row : rows)
      ranges[row[0] / 20. * 299.99].add(row[1]);
    return ranges;
  };
  const std::vector<Range> before = columns(points), after = columns(drawn);
  for (std::size_t i = 0; i < before.size(); ++i)
    {
      EXPECT_NEAR(after[i].lower, before[i].lower, 0.01);
      EXPECT_NEAR(after[i].upper, before[i].upper, 0.01);
    }
  EXPECT_TRUE(std::find(drawn.begin(), drawn.end(), points[77777]) !=
              drawn.end());
}



// Noise in both directions and many strokes on each other fill an area; it
// takes no more lines than it has pixels to fill.
TEST(Figure, NoisyStrokesAreDrawnAsTheirArea)
{
  std::mt19937                     random(2);
  std::normal_distribution<double> noise;
  Rows                             points;
  for (unsigned int i = 0; i < 200000; ++i)
    points.push_back({std::sin(1e-3 * i) + 0.02 * noise(random),
                      std::cos(1e-3 * i) + 0.05 * noise(random)});
  EXPECT_LT(thinned(points).size(), 40000u);
}
