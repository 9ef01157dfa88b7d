// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tests_calibration_synthetic_calibration_h
#define tests_calibration_synthetic_calibration_h

#include <slipstep/calibration/calibration.h>

#include <cmath>
#include <random>
#include <string>

/// A calibration as if it had been done, made by hand: three parameters, of
/// which the tests leave one without an upper end and hardly tell two apart,
/// and four tests, two of them replicates and one that comes back.
namespace SyntheticCalibration
{
  using namespace SlipStep;

  inline FittedParameter parameter(const std::string &path,
                                   const Dimension    dimension,
                                   const bool         is_logarithmic,
                                   const double       value,
                                   const double       deviation)
  {
    FittedParameter fitted;
    fitted.parameter.path           = path;
    fitted.parameter.name           = path.substr(path.rfind('/') + 1);
    fitted.parameter.dimension      = dimension;
    fitted.parameter.is_logarithmic = is_logarithmic;
    fitted.parameter.lower          = is_logarithmic ? value / 30. : 0.;
    fitted.parameter.upper          = is_logarithmic ? value * 30. : 3. * value;
    fitted.parameter.start          = 0.5 * value;
    fitted.value                    = value;
    fitted.deviation                = deviation;

    const auto at = [&](const double n_deviations) {
      return is_logarithmic ? value * std::exp(n_deviations * deviation) :
                              value + n_deviations * deviation;
    };
    fitted.lower = at(-1.8);
    fitted.upper = at(2.2);
    for (int i = -12; i <= 12; ++i)
      {
        const double x = 0.25 * i;
        fitted.profile.emplace_back(at(x),
                                    x * x / (x < 0. ? 1.8 * 1.8 : 2.2 * 2.2));
      }
    return fitted;
  }

  /// A parameter that may be as large as it likes.
  inline FittedParameter open_parameter()
  {
    FittedParameter fitted = parameter(
      "Friction/overstress/Reference speed", Dimension::speed, true, 0.01, 1.5);
    fitted.profile.clear();
    for (int i = -20; i <= 20; ++i)
      {
        const double x = i / 20. * std::log(30.);
        fitted.profile.emplace_back(0.01 * std::exp(x),
                                    x < 0. ? x * x / 4. : 0.05 * x);
      }
    fitted.lower         = 0.01 * std::exp(-2.);
    fitted.upper         = fitted.parameter.upper;
    fitted.is_upper_open = true;
    return fitted;
  }

  /// Friction that rises, peaks and falls to its kinetic value, with noise; of
  /// reversals if it shall come back.
  inline TestMisfit test(const std::string &name,
                         const std::string &condition,
                         const std::size_t  n_rows,
                         const bool         comes_back = false)
  {
    TestMisfit                       test;
    std::mt19937                     generator(name.size() + n_rows);
    std::normal_distribution<double> noise(0., 0.002);
    test.name               = name;
    test.condition          = condition;
    test.file               = "measured/" + name + ".csv";
    test.n_rows             = n_rows;
    test.noise              = 0.002;
    test.rms                = 0.0025;
    test.start_rms          = 0.02;
    test.mean               = 0.0004;
    test.correlation_length = 3.;
    test.measured_work      = 12.3;
    test.simulated_work     = 12.2;
    for (std::size_t i = 0; i < n_rows; ++i)
      {
        const double share    = static_cast<double>(i) / n_rows;
        const bool   back     = comes_back && share > 0.5;
        const double path     = 20. * (back ? share - 0.5 : share);
        const double friction = (back ? -1. : 1.) *
                                (0.1 + 0.03 * std::exp(-path)) *
                                (1. - std::exp(-10. * path));
        test.time.push_back(60. * share);
        test.displacement.push_back(back ? 10. - path : path);
        test.simulated.push_back(friction);
        test.measured.push_back(friction + 0.001 * std::sin(2. * path) +
                                noise(generator));
      }
    return test;
  }

  inline Calibration make()
  {
    Calibration result;
    result.parameters = {
      parameter(
        "Friction/softening/Rate", Dimension::per_length, true, 0.8, 0.08),
      parameter(
        "Friction/Static friction", Dimension::number, false, 0.13, 0.001),
      open_parameter()};
    result.derived = {
      {"drop", "Static friction - Kinetic friction", 0.03, 0.002}};
    result.tests  = {test("slow <a> & \"b\"", "1 mm/min", 400),
                     test("slow again", "1 mm/min", 300),
                     test("fast", "200 mm/min", 5000),
                     test("reversal", "", 600, true)};
    result.starts = {
      {{0.4, 0.06, 0.005}, {0.8, 0.13, 0.01}, 6000., 12, "converged"},
      {{0.1, 0.2, 0.1}, {0.8, 0.13, 0.0101}, 6000.01, 17, "converged"},
      {{3., 0.2, 0.1}, {0.81, 0.13, 0.2}, 6000.05, 21, "converged"},
      {{5., 0.3, 0.1}, {9., 0.2, 0.2}, 9000., 50, "too many iterations"},
      {{6., 0.3, 0.1},
       {},
       std::numeric_limits<double>::infinity(),
       0,
       "cannot be simulated"}};
    WeakDirection weak;
    weak.change  = {-0.05, 0.0002, 1.48};
    weak.members = {2, 0};
    weak.words =
      "Reference speed and Rate cannot be told apart: a reference speed 4.4 "
      "times larger with a rate 5 % smaller fits these tests equally well. A "
      "slide at 0.01 mm/min would tell them apart best.";
    result.weak          = {weak};
    result.correlation   = {{1., 0.12, -0.93}, {0.12, 1., 0.}, {-0.93, 0., 1.}};
    result.misfit        = 6000.;
    result.start_misfit  = 400000.;
    result.n_rows        = 6300;
    result.n_effective   = 2100.;
    result.inflation     = 3.4;
    result.n_simulations = 412;
    result.n_steps       = 15000;
    result.wall_time     = 3.2;
    result.cpu_time      = 6.1;
    result.warnings      = {"the noise of 'fast' was estimated"};
    return result;
  }
} // namespace SyntheticCalibration

#endif
