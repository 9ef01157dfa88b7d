// SPDX-License-Identifier: LGPL-2.1-or-later

// The list of parameters: what it says and what is wrong with it.

#include <gtest/gtest.h>

#include "tests/file_text.h"
#include "planted.h"

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  std::vector<FitParameter> read(const std::string &list)
  {
    return read_fit_parameters(calibration_case(
      {{"Friction/Effects", "subloading, overstress, softening, anisotropy"},
       {"Calibration/Parameters", list}}));
  }

  std::string refusal(const std::string &list)
  {
    try
      {
        read(list);
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "";
  }

  void expect_refusal(const std::string              &list,
                      const std::vector<std::string> &parts)
  {
    const std::string message = refusal(list);
    for (const std::string &part : parts)
      EXPECT_TRUE(contains(message, part)) << list << "\n  " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
} // namespace



TEST(FitParameter, BoundsStartAndScale)
{
  const auto all =
    read("Friction/overstress/Viscosity from 1e2 to 1e7 start 2e3; "
         "Friction/softening/Rate from 0.01 to 0.05; "
         "Friction/subloading/Rate from 10 1/mm to 1 1/um linear;");
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].path, "Friction/overstress/Viscosity");
  EXPECT_EQ(all[0].name, "Viscosity");
  EXPECT_TRUE(all[0].is_logarithmic);
  EXPECT_EQ(all[0].start, 2e3);
  EXPECT_NEAR(all[0].to_scaled(1e3), 0.2, 1e-12);
  EXPECT_NEAR(all[0].from_scaled(0.2), 1e3, 1e-9);
  EXPECT_EQ(all[1].name, "softening/Rate");
  EXPECT_FALSE(all[1].is_logarithmic);
  EXPECT_EQ(all[1].start, 0.045);
  EXPECT_EQ(all[1].from_scaled(1.), 0.05);
  EXPECT_FALSE(all[2].is_logarithmic);
  EXPECT_EQ(all[2].upper, 1000.);
  EXPECT_EQ(all[2].text(1000.), "1000 1/mm");
}



TEST(FitParameter, CapitalsDoNotMatterButInPaths)
{
  const auto one =
    read("Friction/softening/Rate From 0.01 TO 0.05 Start 0.02 Log").front();
  EXPECT_EQ(one.start, 0.02);
  EXPECT_TRUE(one.is_logarithmic);
  const auto other =
    read("Friction/softening/Rate from 0.01 to 0.05 log start 0.02").front();
  EXPECT_EQ(other.start, 0.02);
  EXPECT_EQ(other.upper, 0.05);
  EXPECT_TRUE(other.is_logarithmic);
}



TEST(FitParameter, AnglesAreInDegreesInText)
{
  const auto all = read("Friction/anisotropy/Angle from -30 deg to 60 deg");
  EXPECT_NEAR(all[0].upper, dealii::numbers::PI / 3., 1e-12);
  EXPECT_EQ(all[0].text(all[0].upper), "60 deg");
}



TEST(FitParameter, TheMachineCanBeFitted)
{
  const auto all = read("Loading/Machine stiffness from 1 to 1000 start 20 "
                        "MPa/mm");
  EXPECT_EQ(all[0].text(all[0].start), "20 MPa/mm");
}



TEST(FitParameter, WhatIsWrongIsSaid)
{
  expect_refusal("Friction/Softening/Rate from 0.1 to 1",
                 {"did you mean Friction/softening/Rate?"});
  // Not that its start is out of bounds.
  expect_refusal("Friction/healing/Rate from 0.1 to 0.3",
                 {"this effect is off: add it to Friction/Effects"});
  expect_refusal("Friction/softening/Rate from 0,1 to 1",
                 {"from = 0,1: decimals begin with a point: 0.1; allowed"});
  expect_refusal("", {"at least one parameter"});
  expect_refusal("Friction/softening/Rat from 0 to 1",
                 {"unknown key", "Friction/softening/Rate"});
  expect_refusal("Loading/Programme from 0 to 1", {"no meaning"});
  expect_refusal("Friction/Effects from 0 to 1", {"not a number"});
  expect_refusal("Friction/softening/Rate from 0.01", {"path from A to B"});
  expect_refusal("Friction/softening/Rate from 1 to 0.01",
                 {"less than the upper"});
  expect_refusal("Friction/softening/Rate from -1 to 1",
                 {"from = -1", "at least 0 1/mm"});
  expect_refusal("Friction/softening/Rate from 0.01 to 1 log linear",
                 {"one scale: log or linear"});
  expect_refusal("Friction/softening/Rate from 0 to 1 log",
                 {"lower bound greater than 0"});
  expect_refusal("Friction/softening/Rate from 0.1 to 1", {"0.045", "outside"});
  expect_refusal("Friction/softening/Rate from 0.01 to 1 start 2",
                 {"the start 2", "outside"});
  expect_refusal("Friction/softening/Rate from 0.01 to 1 MPa", {"to = 1 MPa"});
  expect_refusal("Friction/softening/Rate from 0.01 to 1; "
                 "Friction/softening/Rate from 0.01 to 2",
                 {"listed twice"});
  expect_refusal("Loading/Machine stiffness from 1 to 1000",
                 {"rigid", "give a start"});
}
