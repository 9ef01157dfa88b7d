// Updates of a contact point with tangent, per second and core:
//   cmake --build build --target benchmark

#include "../friction/law_test_tools.h"

#include <benchmark/benchmark.h>

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  // From the first touch through the transition into sliding, again and again.
  void slide(benchmark::State &state, const std::string &effects)
  {
    const auto   law = make_law({{"Effects", effects}});
    ContactPoint point(*law);
    unsigned int step = 0;
    for (auto _ : state)
      {
        if (step++ % 500 == 0)
          point = ContactPoint(*law);
        const double growth = 1. + 0.05 * (step % 7);
        benchmark::DoNotOptimize(point.update(
          *law, vector(2e-4 * growth, 1e-5), 5.8 + 0.01 * growth, 0.01));
        point.commit();
      }
    state.SetItemsProcessed(state.iterations());
  }
} // namespace

BENCHMARK_CAPTURE(slide, coulomb, "");
BENCHMARK_CAPTURE(slide, rate_independent, "subloading, softening");
BENCHMARK_CAPTURE(slide, source_paper, "subloading, overstress, softening");
BENCHMARK_CAPTURE(slide,
                  all_effects,
                  "subloading, overstress, softening, healing");
