// SPDX-License-Identifier: LGPL-2.1-or-later

// The refinement study: adaptive meshes get further with a tenth of the
// unknowns, and with less if they know what they are for.

#include "../solid/block_test_tools.h"

#include <slipstep/solid/block_probes.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  struct OutcomeOfStudy
  {
    double n_unknowns = 0., edge_pressure = 0., dissipated = 0.;
  };

  OutcomeOfStudy run_study_case(const Settings &mesh)
  {
    const Parameters parameters =
      make_parameters(Settings{{"Output/Quantities", "pressure at 10 mm"}} +
                        mesh,
                      "refinement_study/refinement_study.prm");
    const Programme programme = parse_programme(parameters);
    OutcomeOfStudy  outcome;
    const auto      result =
      run_block_case<2>(parameters, MPI_COMM_SELF, [&](const Block<2> &block) {
        const BlockProbes<2> probes(BlockParameters(parameters, programme),
                                    programme,
                                    parse_quantities(parameters, programme));
        outcome.edge_pressure = probes.values(block, MPI_COMM_SELF)[0];
      });
    EXPECT_EQ(result.failure, "");
    outcome.n_unknowns = result.summary.dofs;
    outcome.dissipated = result.history.back().dissipated_energy;
    return outcome;
  }

  OutcomeOfStudy adaptive(const std::string &tolerance,
                          const std::string &goal = "energy")
  {
    return run_study_case({{"Block/Refinement", "adaptive 10"},
                           {"Block/Adaptivity/Goal", goal},
                           {"Block/Adaptivity/Tolerance", tolerance}});
  }
} // namespace



TEST(RefinementStudy, adaptive_needs_a_tenth)
{
  const OutcomeOfStudy reference = adaptive("0.001");
  const OutcomeOfStudy uniform =
    run_study_case({{"Block/Refinement", "uniform 4"}});
  const OutcomeOfStudy refined = adaptive("0.01");
  const auto           error   = [&](const double OutcomeOfStudy::*value,
                         const OutcomeOfStudy         &outcome) {
    return std::abs(outcome.*value - reference.*value);
  };
  // The finest cells are as small, and there are few of them.
  EXPECT_LT(refined.n_unknowns, uniform.n_unknowns / 10.);
  EXPECT_LT(error(&OutcomeOfStudy::edge_pressure, refined),
            1.1 * error(&OutcomeOfStudy::edge_pressure, uniform));
  // No corner takes part in this one: it gains less.
  EXPECT_LT(error(&OutcomeOfStudy::dissipated, refined),
            4. * error(&OutcomeOfStudy::dissipated, uniform));
}



// What counts is the contact face: no cells for the upper corners, nor for the
// interior.
TEST(RefinementStudy, contact_goal_needs_less)
{
  const OutcomeOfStudy reference = adaptive("0.001");
  const OutcomeOfStudy uniform =
    run_study_case({{"Block/Refinement", "uniform 4"}});
  const OutcomeOfStudy energy  = adaptive("0.005");
  const OutcomeOfStudy contact = adaptive("0.01", "contact");
  const auto           error   = [&](const OutcomeOfStudy &outcome) {
    return std::abs(outcome.edge_pressure - reference.edge_pressure);
  };
  EXPECT_LT(contact.n_unknowns, uniform.n_unknowns / 20.);
  EXPECT_LT(contact.n_unknowns, energy.n_unknowns / 3.);
  EXPECT_LT(error(contact), 0.6 * error(uniform));
  EXPECT_LT(error(contact), 1.1 * error(energy));
  // The tolerance is what it says.
  EXPECT_LT(error(contact), 0.015 * reference.edge_pressure);
}



// Along edges, too: the pressures there are those of the uniform mesh with
// cells as small.
TEST(RefinementStudy, edges_and_corners_in_space)
{
  const Settings space = {{"Block/Dimension", "3"},
                          {"Block/Size", "10 mm, 10 mm, 10 mm"},
                          {"Block/Subdivisions", "2, 2, 2"},
                          {"Time stepping/Equal steps per statement", "2"}};
  const auto     run   = [&](const Settings &mesh) {
    std::vector<double> result;
    const Parameters    parameters =
      make_parameters(space + mesh +
                        Settings{{"Output/Quantities",
                                  "pressure at (10 mm, 5 mm); pressure at (10 "
                                        "mm, 10 mm)"}},
                      "refinement_study/refinement_study.prm");
    const Programme programme = parse_programme(parameters);
    const auto      outcome =
      run_block_case<3>(parameters, MPI_COMM_SELF, [&](const Block<3> &block) {
        result = BlockProbes<3>(BlockParameters(parameters, programme),
                                programme,
                                parse_quantities(parameters, programme))
                   .values(block, MPI_COMM_SELF);
      });
    EXPECT_EQ(outcome.failure, "");
    result.push_back(outcome.summary.dofs);
    return result;
  };
  const auto uniform = run({{"Block/Refinement", "uniform 2"}});
  const auto contact = run({{"Block/Refinement", "adaptive 2"},
                            {"Block/Adaptivity/Goal", "contact"},
                            {"Block/Adaptivity/Tolerance", "0.03"}});
  for (const unsigned int place : {0, 1})
    EXPECT_NEAR(contact[place], uniform[place], 0.005 * uniform[place]);
  EXPECT_LT(contact[2], 0.5 * uniform[2]);
}
