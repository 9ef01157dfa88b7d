// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/report/run_figures.h>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>

#include "tests/report/page_text.h"

using namespace SlipStep;

namespace
{
  const double length = 10., height = 0.25;

  // Two cells side by side in two dimensions, sheared by 1 um.
  void write_moment(const std::filesystem::path &folder,
                    const unsigned int           number,
                    const double                 stress)
  {
    std::ofstream out(folder /
                      ("surface_000" + std::to_string(number) + ".csv"));
    for (const std::string kind : {"", "u"})
      for (const std::string corner : {"0", "1", "2", "3"})
        for (const std::string axis : {"x", "y", "z"})
          out << kind << axis << corner << "_mm,";
    out << "von_mises_MPa,contact,pressure_MPa,slip_mm,r\n";
    for (const double left : {0., length / 2.})
      {
        const double right = left + length / 2.;
        out << left << ",0,0," << right << ",0,0," << right << "," << height
            << ",0," << left << "," << height << ",0,"
            << "0,0,0,0,0,0,0.001,0,0,0.001,0,0," << stress + left
            << ",0,0,0,0\n";
      }
  }

  RunResults finished_run()
  {
    RunResults run;
    run.folder = test_folder();
    std::ofstream list(run.folder / "fields.pvd");
    for (unsigned int n = 0; n < 3; ++n)
      {
        write_moment(run.folder, n, 100. * n);
        list << "<DataSet timestep=\"" << 0.5 * n
             << "\" group=\"\" part=\"0\" file=\"fields_000" << n
             << ".pvtu\"/>\n";
      }
    return run;
  }

  nlohmann::json data_of(const std::string &picture)
  {
    const std::string begin = "<script type='application/json'>";
    const std::size_t from  = picture.find(begin) + begin.size();
    return nlohmann::json::parse(
      picture.substr(from, picture.find("</script>", from) - from));
  }
} // namespace



TEST(BlockView, ShowsAllMoments)
{
  std::vector<std::string> warnings;
  const std::string        picture = block_picture(finished_run(), warnings);
  EXPECT_TRUE(warnings.empty());
  const auto data = data_of(picture);
  EXPECT_TRUE(data["flat"]);
  ASSERT_EQ(data["states"].size(), 3u);
  const auto &last = data["states"][2];
  EXPECT_EQ(last["t"], 1.);
  // Corners that two cells share are there once.
  EXPECT_EQ(last["v"].size(), 6u * 6u);
  EXPECT_EQ(last["q"].size(), 8u);
  EXPECT_EQ(last["von_mises_MPa"], nlohmann::json({200., 205.}));
  EXPECT_EQ(data["fields"][0]["from"], 0.);
  EXPECT_EQ(data["fields"][0]["to"], 205.);
  // Small displacements are in micrometres: the mean of 0, 0, 1 and 1.
  EXPECT_EQ(data["fields"][1]["label"], "displacement  [µm]");
  EXPECT_EQ(last["displacement_mm"], nlohmann::json({0.5, 0.5}));
}



TEST(BlockView, ThinBlocksAreDrawnThicker)
{
  std::vector<std::string> warnings;
  const std::string        picture = block_picture(finished_run(), warnings);
  EXPECT_EQ(data_of(picture)["extent"], nlohmann::json({10., 0.75}));
  EXPECT_TRUE(contains(picture, "Drawn 3 times as thick along y."));
  // Deformation is enlarged to a round number that is seen.
  EXPECT_EQ(data_of(picture)["scale"], 500.);
}



TEST(BlockView, NothingIsShownOfARunWithoutFields)
{
  RunResults run;
  run.folder = test_folder();
  std::vector<std::string> warnings;
  EXPECT_EQ(block_picture(run, warnings), "");
  EXPECT_TRUE(warnings.empty());

  run = finished_run();
  std::filesystem::remove(run.folder / "surface_0001.csv");
  EXPECT_EQ(data_of(block_picture(run, warnings))["states"].size(), 2u);
  std::ofstream(run.folder / "surface_0002.csv") << "x0_mm\nabc\n";
  EXPECT_EQ(block_picture(run, warnings), "");
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(contains(warnings[0], "surface_0002.csv"));
}



TEST(BlockView, MeshesStandSideBySide)
{
  // Of a run without fields the end alone is there.
  RunResults run = finished_run();
  std::filesystem::rename(run.folder / "surface_0002.csv",
                          run.folder / "surface.csv");
  std::filesystem::remove(run.folder / "fields.pvd");
  Summary summary;
  summary.dofs = 30;
  write_summary(run.folder / "summary.json", summary);
  std::filesystem::create_directory(run.folder / "empty");

  std::vector<std::string> warnings;
  const std::string        html =
    mesh_gallery({{"uniform 0", run.folder}, {"failed", run.folder / "empty"}},
                 warnings);
  EXPECT_TRUE(warnings.empty());
  has_all(html, {"uniform 0, 30 unknowns", "Drawn 3 times as thick along y."});
  EXPECT_FALSE(contains(html, "failed"));
  EXPECT_EQ(mesh_gallery({}, warnings), "");
  EXPECT_NE(block_picture(run, warnings), "");
}
