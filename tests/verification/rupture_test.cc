// SPDX-License-Identifier: LGPL-2.1-or-later

// The rupture of the shipped case, coarser in space and time: on which side of
// the speed of shear waves it is.

#include "../solid/block_test_tools.h"

#include <slipstep/solid/block_probes.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  // G = 30 GPa, Poisson's ratio 1/4, 2700 kg/m^3 [mm/s].
  const double shear_wave       = std::sqrt(3e4 / 2.7e-9);
  const double compression_wave = std::sqrt(3.) * shear_wave;
  const double rayleigh_wave    = 0.9194 * shear_wave;

  struct Rupture
  {
    double early = 0., late = 0.; ///< speeds of the front [mm/s]
    double missing          = 0.; ///< energy, of that dissipated
    double pressure_changes = 0.; ///< largest, of the pressure
  };

  /// When a front that is seen at times passes a place.
  class Passage
  {
  public:
    explicit Passage(const double place)
      : place(place)
    {}

    void see(const double front, const double now)
    {
      if (front >= place && last_front < place)
        time = last_time +
               (place - last_front) / (front - last_front) * (now - last_time);
      last_front = front;
      last_time  = now;
    }

    double time = std::nan("");

  private:
    double place, last_front = 0., last_time = 0.;
  };

  /// @param patch its half-length [mm]
  Rupture rupture(const std::string &label, const double patch)
  {
    const Settings   coarse  = {{"Block/Refinement", "adaptive 1"},
                                {"Block/Adaptivity/Tolerance", "0.04"},
                                {"Time stepping/Tolerance", "0.01"}};
    const Parameters shipped = make_parameters({}, "rupture/rupture.prm");
    Parameters       parameters;
    for (const Variant &variant : shipped.variants())
      if (variant.label == label)
        parameters = shipped.with_variant(variant);
    set_all(coarse, parameters);

    const FrictionLaw     law(parameters);
    const Programme       programme = parse_programme(parameters);
    const BlockParameters block_parameters(parameters, programme);
    Block<2>              block(block_parameters,
                   law,
                   programme,
                   StepControl(parameters, programme, law),
                   MPI_COMM_SELF);
    const BlockProbes<2>  probes(block_parameters,
                                programme,
                                parse_quantities(parameters, programme));

    Rupture    result;
    Passage    a(patch + 4.), b(patch + 14.), c(120.), d(160.);
    double     missing_before = 0.;
    HistoryRow last;
    block.run(nullptr, [&](const HistoryRow &row) {
      const double front =
        block_parameters.size[0] / 2. - probes.values(block, MPI_COMM_SELF)[0];
      if (std::isfinite(front))
        for (Passage *passage : {&a, &b, &c, &d})
          passage->see(front, row.time);
      const double missing =
        row.external_work - row.stored_energy - row.dissipated_energy;
      if (row.dissipated_energy < 1e-3)
        missing_before = missing;
      else
        result.missing =
          std::abs(missing - missing_before) / row.dissipated_energy;
      result.pressure_changes =
        std::max(result.pressure_changes, std::abs(row.pressure / 10. - 1.));
    });
    result.early = 10. / (b.time - a.time);
    result.late  = 40. / (d.time - c.time);
    return result;
  }
} // namespace



// Below S = 1.77 it gets faster than shear waves, above never as fast as
// Rayleigh's.
TEST(Rupture, passes_the_barrier_at_a_high_load_only)
{
  const Rupture high = rupture("S 0.8", 16.);
  EXPECT_LT(high.early, shear_wave);
  EXPECT_GT(high.late, std::sqrt(2.) * shear_wave);
  EXPECT_LT(high.late, compression_wave);
  const Rupture low = rupture("S 3", 24.);
  EXPECT_LT(low.early, low.late);
  EXPECT_GT(low.late, 0.7 * shear_wave);
  EXPECT_LT(low.late, rayleigh_wave);
  for (const Rupture &one : {high, low})
    {
      EXPECT_LT(one.missing, 0.01);
      EXPECT_LT(one.pressure_changes, 1e-4);
    }
}
