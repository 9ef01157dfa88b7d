// SPDX-License-Identifier: LGPL-2.1-or-later

// Reading and resampling a measured test of a million rows:
//   cmake --build build --target benchmark

#include <slipstep/measured_data/measured_test.h>
#include <slipstep/measured_data/resample.h>

#include <benchmark/benchmark.h>

#include <cmath>
#include <filesystem>
#include <random>

#include <unistd.h>

using namespace SlipStep;

namespace
{
  // Strokes at 1 kHz, with noise in every column.
  MeasuredTest strokes()
  {
    std::mt19937                     random(1);
    std::normal_distribution<double> noise;
    MeasuredTest                     test;
    for (int i = 0; i < 1000000; ++i)
      {
        test.time.push_back(1e-3 * i);
        test.displacement.push_back(std::sin(1e-4 * i) + 1e-4 * noise(random));
        test.pressure.push_back(5.8 + 0.01 * noise(random));
        test.friction.push_back(0.1 * std::tanh(9. * std::cos(1e-4 * i)) +
                                3e-4 * noise(random));
      }
    return test;
  }



  void read_million_rows(benchmark::State &state)
  {
    const auto file = std::filesystem::temp_directory_path() /
                      ("slipstep_" + std::to_string(getpid()) + ".csv");
    write_measured_test(file, strokes(), 7);
    for (auto _ : state)
      benchmark::DoNotOptimize(read_measured_test(file));
    state.SetBytesProcessed(state.iterations() *
                            std::filesystem::file_size(file));
    std::filesystem::remove(file);
  }



  void resample_million_rows(benchmark::State &state)
  {
    const MeasuredTest test = strokes();
    for (auto _ : state)
      benchmark::DoNotOptimize(resample(test));
  }
} // namespace

BENCHMARK(read_million_rows)->Unit(benchmark::kMillisecond);
BENCHMARK(resample_million_rows)->Unit(benchmark::kMillisecond);
