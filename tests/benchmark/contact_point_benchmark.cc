// SPDX-License-Identifier: LGPL-2.1-or-later

// Updates of a contact point with tangent, per second and core:
//   cmake --build build --target benchmark

#include <slipstep/friction/contact_point.h>

#include "../friction/law_test_tools.h"

#include <benchmark/benchmark.h>

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  // From the first touch through the transition into sliding, again and again.
  // `make_step` gets the point, the law, slip, pressure and time step.
  template <typename MakeStep>
  void slide(benchmark::State  &state,
             const std::string &effects,
             const MakeStep    &make_step)
  {
    const auto   law = make_law({{"Effects", effects}});
    ContactPoint point(*law);
    unsigned int step = 0;
    for (auto _ : state)
      {
        if (step++ % 500 == 0)
          point = ContactPoint(*law);
        const double growth = 1. + 0.05 * (step % 7);
        benchmark::DoNotOptimize(make_step(
          point, *law, vector(2e-4 * growth, 1e-5), 5.8 + 0.01 * growth, 0.01));
        point.commit();
      }
    state.SetItemsProcessed(state.iterations());
  }

  // A stage with its tangent: what each Newton iteration asks for.
  void update(benchmark::State &state, const std::string &effects)
  {
    slide(state,
          effects,
          [](ContactPoint               &point,
             const FrictionLaw          &law,
             const dealii::Tensor<1, 2> &slip,
             const double                pressure,
             const double                time_step) {
            return point.update(law, slip, pressure, time_step);
          });
  }

  // A step: two stages and the estimated error.
  void step(benchmark::State &state, const std::string &effects)
  {
    slide(state,
          effects,
          [](ContactPoint               &point,
             const FrictionLaw          &law,
             const dealii::Tensor<1, 2> &slip,
             const double                pressure,
             const double                time_step) {
            constexpr double gamma = TwoStages::gamma;
            point.update(law, gamma * slip, pressure, gamma * time_step);
            point.begin_second_stage(law);
            point.update(law, gamma * slip, pressure, gamma * time_step);
            return point.error(law);
          });
  }
} // namespace

#define LAWS(measured)                                                         \
  BENCHMARK_CAPTURE(measured, coulomb, "");                                    \
  BENCHMARK_CAPTURE(measured, rate_independent, "subloading, softening");      \
  BENCHMARK_CAPTURE(measured,                                                  \
                    source_paper,                                              \
                    "subloading, overstress, softening");                      \
  BENCHMARK_CAPTURE(measured,                                                  \
                    all_effects,                                               \
                    "subloading, overstress, softening, healing")

LAWS(update);
LAWS(step);
