// The refinement study: adaptive meshes get further with a tenth of the
// unknowns.

#include "../solid/block_test_tools.h"

#include <slipstep/solid/face_probes.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  struct Outcome
  {
    double n_unknowns = 0., edge_pressure = 0., dissipated = 0.;
  };

  Outcome run_study_case(const Settings &mesh)
  {
    const Parameters parameters =
      make_parameters(Settings{{"Output/Quantities", "pressure at 10 mm"}} +
                        mesh,
                      "refinement_study/refinement_study.prm");
    const Programme programme = parse_programme(parameters);
    Outcome         outcome;
    const auto      result =
      run_block_case<2>(parameters, MPI_COMM_SELF, [&](const Block<2> &block) {
        const FaceProbes<2> probes(BlockParameters(parameters, programme),
                                   programme,
                                   parse_quantities(parameters, programme));
        outcome.edge_pressure =
          probes.values(block.contact_face(), MPI_COMM_SELF)[0];
      });
    EXPECT_EQ(result.failure, "");
    outcome.n_unknowns = result.summary.dofs;
    outcome.dissipated = result.history.back().dissipated_energy;
    return outcome;
  }

  Outcome adaptive(const std::string &tolerance)
  {
    return run_study_case({{"Block/Refinement", "adaptive 10"},
                           {"Block/Adaptivity/Tolerance", tolerance}});
  }
} // namespace



TEST(RefinementStudy, adaptive_needs_a_tenth)
{
  const Outcome reference = adaptive("0.001");
  const Outcome uniform   = run_study_case({{"Block/Refinement", "uniform 4"}});
  const Outcome refined   = adaptive("0.01");
  const auto error = [&](const double Outcome::*value, const Outcome &outcome) {
    return std::abs(outcome.*value - reference.*value);
  };
  // The finest cells are as small, and there are few of them.
  EXPECT_LT(refined.n_unknowns, uniform.n_unknowns / 10.);
  EXPECT_LT(error(&Outcome::edge_pressure, refined),
            1.1 * error(&Outcome::edge_pressure, uniform));
  // No corner takes part in this one: it gains less.
  EXPECT_LT(error(&Outcome::dissipated, refined),
            4. * error(&Outcome::dissipated, uniform));
}
