// SPDX-License-Identifier: LGPL-2.1-or-later

// A campaign of 20 tests, simulated once and calibrated:
//   cmake --build build --target benchmark
// With DEAL_II_NUM_THREADS=1 on one core.

#include "../calibration/planted.h"
#include "../temporary_folder.h"

#include <benchmark/benchmark.h>

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  // The constants of the source paper, its coefficients as read at 1 mm/min.
  const Settings truth = {{"Friction/Static coefficient", "0.115"},
                          {"Friction/softening/Kinetic coefficient", "0.098"},
                          {"Friction/Speed of the coefficients", "1 mm/min"}};

  const char *const six =
    "Friction/Static coefficient from 0.05 to 0.2 start 0.12; "
    "Friction/softening/Kinetic coefficient from 0.05 to 0.2 start 0.1; "
    "Friction/softening/Rate from 0.005 to 1 start 0.1; "
    "Friction/overstress/Viscosity from 10 to 1e7 start 1000; "
    "Friction/overstress/Exponent from 5 to 50 start 10; "
    "Friction/subloading/Rate from 10 to 5000 start 100";

  /// 20 slides of 100 mm at speeds from 1 to 200 mm/min, 1000 rows each, dense
  /// where stick ends, with noise of 0.5 % of the friction.
  class Campaign20
  {
  public:
    Campaign20()
    {
      std::vector<double> speeds;
      for (unsigned int i = 0; i < 20; ++i)
        speeds.push_back(std::pow(200., i / 19.));
      plant(folder.path(),
            calibration_case(truth),
            speeds,
            1000,
            5e-4,
            1,
            100.,
            3.);
    }

    Parameters fitting() const
    {
      Settings settings = truth;
      settings.emplace_back("Calibration/Tests", folder.path().string());
      settings.emplace_back("Calibration/Parameters", six);
      return calibration_case(settings);
    }

  private:
    TemporaryFolder folder;
  };



  // As often as a fit does it: law, steps, comparison with all rows.
  void simulate_campaign(benchmark::State &state)
  {
    const Campaign20    tests;
    const Campaign      campaign(tests.fitting());
    Simulator           simulator(campaign);
    std::vector<double> scaled = campaign.scaled_start();
    simulator.plan(scaled);
    std::vector<double> residuals(campaign.n_residuals());
    for (auto _ : state)
      {
        scaled[0] += 1e-6;
        simulator.residuals(scaled, residuals.data());
        benchmark::DoNotOptimize(residuals.data());
      }
    state.counters["rows"]  = campaign.n_residuals();
    state.counters["steps"] = simulator.n_steps();
  }



  void calibrate_six_parameters(benchmark::State &state)
  {
    const Campaign20 tests;
    const Parameters parameters = tests.fitting();
    for (auto _ : state)
      {
        const Calibration found       = calibrate(parameters);
        state.counters["simulations"] = found.n_simulations;
        state.counters["wall_s"]      = found.wall_time;
      }
  }
} // namespace

BENCHMARK(simulate_campaign)
  ->Unit(benchmark::kMillisecond)
  ->MeasureProcessCPUTime();
BENCHMARK(calibrate_six_parameters)
  ->Unit(benchmark::kMillisecond)
  ->MeasureProcessCPUTime();
