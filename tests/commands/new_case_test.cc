// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/commands/case.h>
#include <slipstep/commands/new_case.h>
#include <slipstep/experiment/point_driver.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/file_text.h"
#include "tests/temporary_folder.h"

using namespace SlipStep;
namespace fs = std::filesystem;

namespace
{
  // A case in a folder with a test that it names, and another that includes it.
  class NewCase : public testing::Test
  {
  protected:
    NewCase()
    {
      fs::create_directories(folder() / "cases/tests");
      write("cases/tests/a.csv",
            "time_s,displacement_mm,pressure_MPa,friction\n"
            "0,0,5,0\n1,1,5,0.2\n2,2,5,0.2\n");
      write("cases/case.prm",
            "set Loading/Programme = follow tests/a.csv\n"
            "set Calibration/Tests = tests\n"
            "subsection Variants\n  subsection slow\n"
            "    set Loading/Speed = 1 mm/s\n  end\n"
            "  subsection fast\n    set Loading/Speed = 9 mm/s\n  end\nend\n");
    }

    fs::path folder() const
    {
      return temporary.path();
    }

    void write(const std::string &name, const std::string &text) const
    {
      std::ofstream(folder() / name) << text;
    }

    // The case's variant "fast", with something changed.
    Parameters found(const std::string &key, const std::string &value) const
    {
      Parameters sweep = declared_parameters();
      sweep.read(folder() / "cases/case.prm");
      Parameters result = sweep.with_variant(sweep.variants().at(1));
      result.set(key, value, "here");
      return result;
    }

    // What a file says, as written for its own folder.
    static Parameters says(const fs::path &file)
    {
      Parameters result = declared_parameters();
      result.read(file);
      return result;
    }

    static bool includes(const fs::path &file)
    {
      return contains("\n" + content(file), "\ninclude ");
    }

    TemporaryFolder temporary;
  };
} // namespace



TEST_F(NewCase, IncludesTheOldOneAndSaysWhatHasChanged)
{
  const Parameters the_case = found("Friction/softening/Rate", "0.123 1/mm");
  const fs::path   file     = folder() / "out/found/new.prm";
  fs::create_directories(file.parent_path());
  write_new_case(file, the_case, {}, {}, {"Found."});
  const std::string text = content(file);
  EXPECT_EQ(text,
            "# Found.\n\n"
            "include ../../cases/case.prm\n\n"
            "subsection Variants\nend\n"
            "subsection Loading\n"
            "  set Programme = follow ../../cases/tests/a.csv\n"
            "  set Speed = 9 mm/s\n"
            "end\n"
            "subsection Friction\n"
            "  subsection softening\n"
            "    set Rate = 0.123 1/mm\n"
            "  end\n"
            "end\n"
            "subsection Calibration\n"
            "  set Tests = ../../cases/tests\n"
            "end\n");
  EXPECT_TRUE(
    says(file).has_values_of(relocated_case(the_case, file.parent_path())));
  EXPECT_TRUE(says(file).variants().empty());
  // Both moved together.
  fs::create_directory(folder() / "moved");
  fs::rename(folder() / "cases", folder() / "moved/cases");
  fs::rename(folder() / "out", folder() / "moved/out");
  const Parameters moved = says(folder() / "moved/out/found/new.prm");
  EXPECT_EQ(moved.text("Friction/softening/Rate"), "0.123 1/mm");
  EXPECT_TRUE(fs::exists(moved.resolve(moved.text("Calibration/Tests"))));
}



TEST_F(NewCase, IsCompleteOnRequest)
{
  Parameters the_case = found("Output/New cases", "complete");
  write_new_case(folder() / "new.prm", the_case, {});
  EXPECT_FALSE(includes(folder() / "new.prm"));
  EXPECT_TRUE(says(folder() / "new.prm")
                .has_values_of(relocated_case(the_case, folder())));
}



// It would include itself, or what it stands in place of is a part of it.
TEST_F(NewCase, IsCompleteWhereAnIncludeWouldBeACircle)
{
  const fs::path   file     = folder() / "cases/case.prm";
  const Parameters the_case = found("Friction/softening/Rate", "0.123 1/mm");
  write("cases/including.prm", "include case.prm\n");
  Parameters including = says(folder() / "cases/including.prm");
  including            = including.with_variant(including.variants().at(0));
  for (const Parameters &before : {the_case, including})
    {
      write_new_case(file, before, {});
      EXPECT_FALSE(includes(file));
      EXPECT_TRUE(
        says(file).has_values_of(relocated_case(before, file.parent_path())));
    }
}
