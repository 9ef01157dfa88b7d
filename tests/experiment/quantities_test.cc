// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/experiment/point_driver.h>
#include <slipstep/experiment/quantities.h>
#include <slipstep/utilities/exceptions.h>

#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "tests/file_text.h"
#include "tests/message_of.h"

using namespace SlipStep;

namespace
{
  // 0.1 mm forward at 1 mm/s from t = 2 s on, then 0.05 mm back.
  const char *const there_and_back =
    "press 5 MPa in 1 s; hold 1 s; slide 1 mm/s for 0.1 mm; slide -1 mm/s for "
    "0.05 mm";

  Parameters with_quantities(const std::string &quantities,
                             const std::string &programme = there_and_back)
  {
    Parameters parameters;
    declare_loading_parameters(parameters);
    declare_quantities(parameters);
    parameters.set("Loading/Programme", programme, "test");
    parameters.set("Output/Quantities", quantities, "test");
    return parameters;
  }

  std::vector<QuantityOfInterest> quantities_of(const std::string &quantities)
  {
    const Parameters parameters = with_quantities(quantities);
    return parse_quantities(parameters, parse_programme(parameters));
  }

  // Friction rises to a peak at 0.04 mm; force, probe and energy are smooth
  // functions of the path, too.
  double friction(const double path)
  {
    return 0.1 * std::exp(-std::pow((path - 0.04) / 0.05, 2));
  }

  double force(const double path)
  {
    return 500. * (1. - std::exp(-path / 0.02));
  }

  // Steps of the given length while the drive moves, displaced a little.
  std::vector<HistoryRow> history(const double step)
  {
    std::vector<HistoryRow> rows;
    const auto              add = [&](const double time, const double path) {
      HistoryRow row;
      row.time        = time;
      row.friction    = friction(path);
      row.normal_load = 500.;
      row.tangential_load = (time <= 2.1 + 1e-9 ? 1. : -1.) * force(path);
      row.dissipated_energy = path * path;
      row.probes            = {std::cos(10. * path)};
      rows.push_back(row);
    };
    add(1., 0.);
    add(2., 0.);
    for (double path = 0.3 * step; path < 0.1 - 1e-9; path += step)
      add(2. + path, path);
    add(2.1, 0.1);
    for (double path = 0.1 + step; path < 0.15 - 1e-9; path += step)
      add(2. + path, path);
    add(2.15, 0.15);
    return rows;
  }

  std::vector<QuantityValue> evaluate(const std::string &quantities,
                                      const double       step)
  {
    const Parameters parameters = with_quantities(quantities);
    const Programme  programme  = parse_programme(parameters);
    return evaluate_quantities(parse_quantities(parameters, programme),
                               programme,
                               history(step),
                               3);
  }

  std::string message_about(const std::string &quantities)
  {
    return message_of([&] { quantities_of(quantities); });
  }
} // namespace



TEST(Quantities, are_read)
{
  const auto quantities = quantities_of(
    "friction force at 5 um, 0.02 mm; peak coefficient;"
    "displacement at  peak; pressure at (9.5 mm, 5 mm);"
    "pressure at 1 mm after 0.01 mm; slip front;"
    "slip front at r = 0.9 after 0.02 mm; dissipated energy;"
    "displacement y at (1 mm, 2 mm, 3 mm); force x on left after 0.01 mm;"
    "moment z on top; largest pressure; smallest pressure after 5 um");
  ASSERT_EQ(quantities.size(), 14u);
  EXPECT_EQ(quantities[9].component, 1u);
  EXPECT_EQ(quantities[9].position, (std::vector<double>{1., 2., 3.}));
  EXPECT_EQ(quantities[10].face, "left");
  EXPECT_EQ(quantities[10].component, 0u);
  EXPECT_DOUBLE_EQ(quantities[10].displacement, 0.01);
  EXPECT_EQ(quantities[11].face, "top");
  EXPECT_EQ(quantities[11].component, 2u);
  EXPECT_DOUBLE_EQ(quantities[13].displacement, 0.005);
  EXPECT_EQ(quantities[0].name, "friction force at 5 um");
  EXPECT_DOUBLE_EQ(quantities[0].displacement, 0.005);
  EXPECT_EQ(quantities[1].name, "friction force at 0.02 mm");
  EXPECT_EQ(quantities[3].name, "displacement at peak");
  EXPECT_EQ(quantities[4].position, (std::vector<double>{9.5, 5.}));
  EXPECT_TRUE(std::isnan(quantities[4].displacement));
  EXPECT_EQ(quantities[5].position, (std::vector<double>{1.}));
  EXPECT_DOUBLE_EQ(quantities[5].displacement, 0.01);
  EXPECT_DOUBLE_EQ(quantities[6].loading_ratio, 0.99);
  EXPECT_DOUBLE_EQ(quantities[7].loading_ratio, 0.9);
  EXPECT_EQ(probes_among(quantities).size(), 9u);
  EXPECT_TRUE(quantities_of("").empty());
}



TEST(Quantities, wrong_ones_are_refused_in_words)
{
  const std::vector<std::pair<std::string, std::string>> cases = {
    {"fricton force at 1 mm", "did you mean 'friction force'"},
    {"peak", "did you mean 'peak coefficient'"},
    {"temperature", "there are friction force, peak coefficient"},
    {"slip frond", "did you mean 'slip front'"},
    {"friction force", "write e.g. 'friction force at 0.005 mm'"},
    {"friction force at 0.01", "the unit is missing"},
    {"friction force at 0.01 MPa", "MPa"},
    {"friction force at 1 mm", "the drive moves by 0.15 mm"},
    {"friction force at 0 mm", "above 0 mm"},
    {"peak coefficient at 1 mm", "write e.g. 'peak coefficient'"},
    {"pressure", "write e.g. 'pressure at"},
    {"pressure at (1 mm, 2 mm, 3 mm)", "write e.g. 'pressure at"},
    {"slip front at 0.9", "write e.g. 'slip front at r = "},
    {"slip front at r = -1", "must be above 0"},
    {"slip front after 1 mm", "the drive moves by 0.15 mm"},
    {"displacement at (1 mm, 2 mm)", "write e.g. 'displacement x at"},
    {"displacement w at (1 mm, 2 mm)", "write e.g. 'displacement x at"},
    {"displacement x", "write e.g. 'displacement x at"},
    {"force x", "write e.g. 'force x on right"},
    {"force x on rigth", "did you mean right"},
    {"moment on left", "write e.g. 'moment z on right"},
    {"largest presure", "did you mean 'largest pressure'"},
    {"peak coefficient; peak coefficient", "listed twice"}};
  for (const auto &entry : cases)
    EXPECT_TRUE(contains(message_about(entry.first), entry.second))
      << entry.first << " -> " << message_about(entry.first);
}



// How far a push moves the drive is known after the run only.
TEST(Quantities, count_what_pushes_move)
{
  const std::string pushed = "press 5 MPa in 1 s; push 0.1 MPa in 1 s; slide 1 "
                             "mm/s for 0.1 mm";
  const Parameters  parameters =
    with_quantities("friction force at 0.01 mm", pushed);
  EXPECT_TRUE(contains(message_of([&] {
                         parse_quantities(parameters,
                                          parse_programme(parameters));
                       }),
                       "how far a push moves the drive"));

  const Parameters peak      = with_quantities("displacement at peak", pushed);
  const Programme  programme = parse_programme(peak);
  std::vector<HistoryRow> rows;
  for (const double time : {0., 1., 2., 2.05, 2.1})
    {
      HistoryRow row;
      row.time         = time;
      row.displacement = time < 2. ? 0. : 0.3 + (time - 2.);
      row.friction     = time > 2.01 && time < 2.09 ? 0.2 : 0.1;
      rows.push_back(row);
    }
  EXPECT_NEAR(
    evaluate_quantities(parse_quantities(peak, programme), programme, rows, 0)
      .at(0)
      .value,
    0.35,
    1e-12);
}



TEST(Quantities, do_not_depend_on_where_the_steps_fall)
{
  const std::string all =
    "friction force at 0.013 mm, 0.12 mm; peak coefficient; displacement at "
    "peak; pressure at (1 mm, 1 mm) after 0.033 mm; dissipated energy after "
    "0.07 mm; dissipated energy";
  const std::vector<double> exact = {
    force(0.013), force(0.12), 0.1, 0.04, std::cos(0.33), 0.0049, 0.0225};
  const std::vector<std::string> units = {
    "N", "N", "", "mm", "MPa", "N mm", "N mm"};
  for (const double step : {0.003, 0.0041, 0.0052})
    {
      const auto values = evaluate(all, step);
      ASSERT_EQ(values.size(), exact.size());
      for (unsigned int i = 0; i < exact.size(); ++i)
        {
          EXPECT_NEAR(values[i].value / exact[i], 1., 2e-3)
            << values[i].name << " " << step;
          EXPECT_EQ(values[i].unit, units[i]);
        }
    }
}



// Coulomb's friction holds at most its coefficient.
TEST(Quantities, have_no_peak_above_a_plateau)
{
  // The elastic slip is 0.2 um, a small part of a step, and 0.2 mm.
  for (const auto &[n, stiffness] : {std::make_pair("7", "1e4"),
                                     std::make_pair("20", "1e4"),
                                     std::make_pair("33", "1e4"),
                                     std::make_pair("7", "10"),
                                     std::make_pair("8", "10"),
                                     std::make_pair("11", "10"),
                                     std::make_pair("23", "10")})
    {
      Parameters parameters = point_parameters(
        {{"Friction/Effects", ""},
         {"Friction/Static coefficient", "0.2"},
         {"Friction/Tangential stiffness", stiffness},
         {"Loading/Programme", "press 10 MPa in 1 s; slide 1 mm/s for 0.5 mm"},
         {"Time stepping/Equal steps per statement", n}});
      declare_quantities(parameters);
      parameters.set("Output/Quantities",
                     "peak coefficient; displacement at peak",
                     "test");
      const Programme programme = parse_programme(parameters);
      const auto      values =
        evaluate_quantities(parse_quantities(parameters, programme),
                            programme,
                            point_history(parameters),
                            0);
      EXPECT_NEAR(values[0].value, 0.2, 1e-12) << n;
      EXPECT_LE(values[1].value,
                2. / std::stod(stiffness) + 0.5 / std::stod(n) + 1e-12)
        << n;
    }
}



TEST(Quantities, of_a_run_that_ends_early_are_undefined)
{
  const Parameters parameters = with_quantities(
    "friction force at 0.01 mm, 0.12 mm; dissipated energy; slip front");
  const Programme programme = parse_programme(parameters);
  auto            rows      = history(0.004);
  while (rows.back().time > 2.05)
    rows.pop_back();
  const auto values = evaluate_quantities(
    parse_quantities(parameters, programme), programme, rows, 2);
  EXPECT_NEAR(values[0].value, force(0.01), 0.5);
  EXPECT_EQ(values[0].unit, "N/mm");
  for (const unsigned int i : {1, 2, 3})
    EXPECT_TRUE(std::isnan(values[i].value)) << values[i].name;
}



TEST(MonotoneInterpolation, is_accurate_and_does_not_overshoot)
{
  // Straight lines are met exactly, smooth curves with more than second order.
  double last_error = 0.;
  for (const unsigned int n : {10, 20, 40})
    {
      std::vector<double> x, line, curve;
      for (unsigned int i = 0; i <= n; ++i)
        {
          // Uneven, as steps are.
          x.push_back((i + 0.2 * std::sin(3. * i)) / n);
          line.push_back(3. - 2. * x.back());
          curve.push_back(std::exp(x.back()));
        }
      double error = 0.;
      for (double t = 0.21; t < 0.8; t += 0.01)
        {
          EXPECT_NEAR(monotone_interpolation(x, line, t), 3. - 2. * t, 1e-12);
          error = std::max(error,
                           std::abs(monotone_interpolation(x, curve, t) -
                                    std::exp(t)));
        }
      if (last_error > 0.)
        {
          EXPECT_GT(std::log2(last_error / error), 2.7);
        }
      last_error = error;
    }

  const std::vector<double> x    = {0., 1., 2., 3., 4.},
                            kink = {0., 1., 2., 2., 2.};
  for (double t = 0.; t <= 4.; t += 0.05)
    EXPECT_LE(monotone_interpolation(x, kink, t), 2. + 1e-14);
  EXPECT_NEAR(monotone_interpolation(x, kink, 1.), 1., 1e-14);

  const double nan = QuantityOfInterest::undefined;
  EXPECT_NEAR(monotone_interpolation(x, {nan, nan, 1., 3., nan}, 2.5),
              2.,
              1e-14);
  EXPECT_TRUE(
    std::isnan(monotone_interpolation(x, {nan, nan, 1., 3., 4.}, 1.5)));
  EXPECT_TRUE(std::isnan(monotone_interpolation(x, kink, 4.1)));
}
