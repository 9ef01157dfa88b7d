// SPDX-License-Identifier: LGPL-2.1-or-later

// Quantities of interest of the block on all ranks against one rank.

#include "../block_test_tools.h"

#include <slipstep/solid/block_probes.h>

#include <gtest/gtest.h>

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  std::vector<double> probes(const MPI_Comm &communicator)
  {
    const Parameters parameters = make_parameters(
      {{"Loading/Programme",
        "press 5.8 MPa in 1 s; slide 1 mm/s for 0.0001 mm"},
       {"Friction/Effects", ""},
       {"Friction/Normal stiffness", "1e6"},
       {"Friction/Tangential stiffness", "1e6"},
       {"Block/Size", "10 mm, 5 mm, 10 mm"},
       {"Block/Subdivisions", "4, 2, 3"},
       {"Time stepping/Tolerance", "0.01"},
       {"Time stepping/Least steps per statement", "3"},
       {"Output/Quantities",
        "pressure at (5 mm, 2.5 mm); pressure at (9.9 mm, 0.1 mm); slip front "
        "at r = 0.9; displacement x at (3.3 mm, 2.5 mm, 5 mm); displacement z at "
        "(10 mm, 5 mm, 10 mm); force x on top; force z on bottom; moment y on "
        "bottom; moment x on top; largest pressure; smallest pressure"}});
    const Programme     programme = parse_programme(parameters);
    std::vector<double> values;
    const auto          result =
      run_block_case<3>(parameters, communicator, [&](const Block<3> &block) {
        values = BlockProbes<3>(BlockParameters(parameters, programme),
                                programme,
                                parse_quantities(parameters, programme))
                   .values(block, communicator);
      });
    EXPECT_EQ(result.failure, "");
    return values;
  }
} // namespace



TEST(Probes, agree_on_any_number_of_ranks)
{
  const auto alone = probes(MPI_COMM_SELF), together = probes(MPI_COMM_WORLD);
  ASSERT_EQ(together.size(), 11u);
  for (unsigned int i = 0; i < together.size(); ++i)
    {
      EXPECT_TRUE(std::isfinite(alone[i])) << i;
      EXPECT_NEAR(together[i],
                  alone[i],
                  1e-7 * std::max(std::abs(alone[i]), i > 4 ? 1. : 0.))
        << i;
    }
}
