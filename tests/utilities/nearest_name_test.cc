// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/utilities/nearest_name.h>

#include <gtest/gtest.h>

using namespace SlipStep;



TEST(NearestName, FindsWhatWasMeant)
{
  const std::vector<std::string> names = {"Rate",
                                          "Steepness",
                                          "Normal stiffness"};
  EXPECT_EQ(nearest_name("rate", names), "Rate");
  EXPECT_EQ(nearest_name("Raet", names), "Rate");
  EXPECT_EQ(nearest_name("Stepness", names), "Steepness");
  EXPECT_EQ(nearest_name("Normal", names), "Normal stiffness");
  EXPECT_EQ(nearest_name("heal", {"wear", "healing"}), "healing");
}



TEST(NearestName, KeepsSilentWhenNothingIsNear)
{
  EXPECT_EQ(nearest_name("Temperature", {"Rate", "Steepness"}), "");
  EXPECT_EQ(nearest_name("x", {"Rate"}), "");
  EXPECT_EQ(nearest_name("Rate", {}), "");
  EXPECT_EQ(did_you_mean("Temperature", {"Rate"}), "");
}
