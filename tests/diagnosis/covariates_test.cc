// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/basis.h>
#include <slipstep/diagnosis/localisation.h>

#include <gtest/gtest.h>

#include <cmath>
#include <set>

using namespace SlipStep;

namespace
{
  /// Slide 1 mm at 0.1 mm/s, rest 20 s, slide 1 mm, slide back 1 mm.
  MeasuredTest slide_rest_return()
  {
    MeasuredTest test;
    test.name    = "slide, rest, return";
    double     u = 0., t = 0.;
    const auto add = [&](const double velocity, const int n) {
      for (int i = 0; i < n; ++i)
        {
          test.time.push_back(t);
          test.displacement.push_back(u);
          test.pressure.push_back(5.);
          t += 0.1;
          u += 0.1 * velocity;
        }
    };
    add(0.1, 100);
    add(0., 200);
    add(0.1, 100);
    add(-0.1, 100);
    // A peak at the beginning of every stroke, then a fall.
    double since = 0., sign = 1., before = 0.;
    for (std::size_t i = 0; i < test.time.size(); ++i)
      {
        const double moved =
          i == 0 ? 0. : test.displacement[i] - test.displacement[i - 1];
        if (moved != 0. && (before == 0. || moved * before < 0.))
          since = 0.;
        since += std::abs(moved);
        if (moved != 0.)
          sign = moved > 0. ? 1. : -1.;
        test.friction.push_back(sign * (1. - std::exp(-since / 0.01)) *
                                (0.1 + 0.03 * std::exp(-since / 0.2)));
        before = moved;
      }
    return test;
  }

  Covariates covariates_of(const MeasuredTest &test, Comparison &comparison)
  {
    return find_covariates(comparison,
                           {{test, {{1., 0., 0.001}}, true, Replay(test)}},
                           comparison.measured,
                           1e-3);
  }
} // namespace



TEST(Covariates, KnowTheHistoryOfEveryRow)
{
  const MeasuredTest test = slide_rest_return();
  Comparison comparison({{test, {{1., 0., 0.001}}, true, Replay(test)}}, 1000);
  const Covariates found = covariates_of(test, comparison);
  const auto       row   = [](const double time) {
    return static_cast<Eigen::Index>(std::lround(10. * time));
  };
  EXPECT_NEAR(found.speed(row(5.)), 0.1, 1e-9);
  EXPECT_EQ(found.speed(row(15.)), 0.);
  EXPECT_NEAR(found.path(row(35.)), 1.5, 0.02);
  EXPECT_NEAR(found.path(row(45.)), 2.5, 0.02);
  EXPECT_EQ(found.rest(row(5.)), 0.);
  EXPECT_NEAR(found.rest(row(35.)), 20., 0.2);
  EXPECT_NEAR(found.since_start(row(35.)), 0.5, 0.02);
  EXPECT_NEAR(found.since_start(row(45.)), 0.5, 0.02);
  EXPECT_EQ(found.is_reverse(row(35.)), 0.);
  EXPECT_EQ(found.is_reverse(row(45.)), 1.);
}



// There and back, also along another line, is no second line.
TEST(Covariates, TellLinesOfMotionApart)
{
  const auto range = [](const double of_first, const double of_second) {
    MeasuredTest      test = slide_rest_return();
    const std::size_t n    = test.time.size();
    test.displacement_y.resize(n);
    double x = 0., y = 0.;
    for (std::size_t i = 0; i < n; ++i)
      {
        const double moved = i == 0 ? 0. :
                                      slide_rest_return().displacement[i] -
                                        slide_rest_return().displacement[i - 1];
        const double angle = i < n / 2 ? of_first : of_second;
        x += moved * std::cos(angle);
        y += moved * std::sin(angle);
        test.displacement[i]   = x;
        test.displacement_y[i] = y;
      }
    test.friction_y.assign(n, 0.);
    Comparison       comparison({{test, {{1., 0., 0.001}}, true, Replay(test)}},
                          1000);
    const Covariates covariates = covariates_of(test, comparison);
    return tested_range(comparison,
                        {{test, {{1., 0., 0.001}}, true, Replay(test)}},
                        covariates);
  };
  EXPECT_NEAR(range(0., 0.).widest_angle, 0., 1e-6);
  EXPECT_NEAR(range(0.7, 0.7).widest_angle, 0., 1e-6);
  EXPECT_NEAR(range(0.2, 0.7).widest_angle, 0.5, 1e-6);
  // In whole degrees; the first axis where tests move along it.
  const auto main_line = [&](const double of_first, const double of_second) {
    return range(of_first, of_second).main_line * 180. / std::acos(-1.);
  };
  EXPECT_EQ(main_line(0., 0.), 0.);
  EXPECT_EQ(main_line(0., 0.7), 0.);
  EXPECT_EQ(main_line(0.7, 0.), 0.);
  EXPECT_NEAR(main_line(0.7, 0.7), 40., 1e-9);
  EXPECT_NEAR(main_line(-1., -1.), -57., 1e-9);
  EXPECT_NEAR(main_line(std::acos(-1.) / 2., std::acos(-1.) / 2.), 90., 1e-9);
}



// Mirrored tests are looked at as the others are: where all go one way, none
// goes back.
TEST(Covariates, GoForwardWhereMostMotionGoes)
{
  const auto seen = [](const double sign, const std::size_t n_rows) {
    MeasuredTest test = slide_rest_return();
    for (std::vector<double> *column :
         {&test.time, &test.displacement, &test.pressure, &test.friction})
      column->resize(n_rows);
    for (std::vector<double> *column : {&test.displacement, &test.friction})
      for (double &value : *column)
        value *= sign;
    Comparison comparison({{test, {{1., 0., 0.001}}, true, Replay(test)}},
                          1000);
    return covariates_of(test, comparison);
  };
  for (const std::size_t n_rows : {400, 420, 500})
    {
      const Covariates one = seen(1., n_rows), other = seen(-1., n_rows);
      EXPECT_EQ(one.main_line, 0.);
      EXPECT_EQ(one.is_reverse, other.is_reverse) << n_rows;
      EXPECT_EQ(one.is_reverse.any(), n_rows > 400);
      EXPECT_NEAR((one.track - other.track).norm(), 0., 1e-9);
    }
  // As often back as forward: along the axis.
  MeasuredTest test = slide_rest_return();
  for (std::size_t i = 0; i < 100; ++i)
    test.displacement[i] = test.displacement[100];
  for (std::vector<double> *column : {&test.displacement, &test.friction})
    for (double &value : *column)
      value *= -1.;
  Comparison comparison({{test, {{1., 0., 0.001}}, true, Replay(test)}}, 1000);
  EXPECT_EQ(covariates_of(test, comparison).main_line, 0.);
}



// What is pressed at rest is no pressure under which friction was seen.
TEST(Covariates, RangeIsOfWhatSlides)
{
  MeasuredTest test = slide_rest_return();
  test.pressure[0]  = 0.001;
  for (std::size_t i = 150; i < 250; ++i)
    test.pressure[i] = 20.;
  for (std::size_t i = 400; i < test.time.size(); ++i)
    test.pressure[i] = 8.;
  // At rest before the first slide.
  for (std::size_t i = 1; i < test.time.size(); ++i)
    test.time[i] += 5.;
  Comparison comparison({{test, {{1., 0., 0.001}}, true, Replay(test)}}, 1000);
  const TestedRange range =
    tested_range(comparison,
                 {{test, {{1., 0., 0.001}}, true, Replay(test)}},
                 covariates_of(test, comparison));
  EXPECT_EQ(range.lowest, 5.);
  EXPECT_EQ(range.highest, 8.);
  EXPECT_EQ(range.largest_pressure, 20.);
}



// Few rows at one level have a bin of their own: those at 0 and at 180 deg were
// taken for some at 45.
TEST(CovariatePanel, DoesNotMixLevels)
{
  Workspace workspace{
    Parameters(), {}, Comparison({}), {}, {}, {}, RowMatrix()};
  workspace.comparison.tests.resize(1);
  ComparedTest &test               = workspace.comparison.tests[0];
  test.size                        = 100;
  Covariates &at                   = workspace.covariates;
  workspace.range.typical_friction = 0.2;
  at.speed = at.friction = Eigen::VectorXd::Constant(100, 0.2);
  at.angle               = Eigen::VectorXd::Zero(100);
  at.angle.tail(6).setConstant(std::acos(-1.));
  const CovariatePanel panel = covariate_panel(workspace,
                                               Eigen::VectorXd::Zero(100),
                                               {},
                                               covariate_called("angle"));
  ASSERT_EQ(panel.x.size(), 2u);
  EXPECT_NEAR(panel.x[0], 0., 1e-12);
  EXPECT_NEAR(panel.x[1], 180., 1e-9);
}



// Pressure doubles within a second, and comes back.
TEST(Covariates, RememberThePressure)
{
  MeasuredTest test;
  test.name = "pressure steps";
  for (int i = 0; i < 301; ++i)
    {
      const double t = 0.1 * i;
      test.time.push_back(t);
      test.displacement.push_back(0.1 * t);
      test.pressure.push_back(t <= 10. ? 5. :
                              t <= 11. ? 5. + 5. * (t - 10.) :
                              t <= 20. ? 10. :
                              t <= 21. ? 10. - 5. * (t - 20.) :
                                         5.);
      test.friction.push_back(0.1);
    }
  Comparison comparison({{test, {{1., 0., 0.001}}, true, Replay(test)}}, 1000);
  const Covariates found = covariates_of(test, comparison);
  EXPECT_EQ(found.unloading(50), 0.);
  EXPECT_EQ(found.unloading(150), 0.);
  EXPECT_NEAR(found.unloading(250), 0.5, 1e-12);
  EXPECT_NEAR(found.pressure_rate(105), 5., 1e-9);
  EXPECT_NEAR(found.pressure_rate(150), 0., 1e-9);
  EXPECT_NEAR(found.pressure_rate(205), -5., 1e-9);
  // A tenth of 3 mm is forgotten by exp(-1) in 3 s.
  EXPECT_EQ(found.pressure_change(90), 0.);
  EXPECT_GT(found.pressure_change(110), 0.5);
  EXPECT_NEAR(found.pressure_change(160) / found.pressure_change(130),
              std::exp(-1.),
              1e-6);
  EXPECT_LT(found.pressure_change(210), -0.5);
  EXPECT_NEAR(found.speed_change.cwiseAbs().maxCoeff(), 0., 1e-9);

  std::set<std::string> names;
  for (const Direction &column : smooth_basis(comparison, found))
    {
      names.insert(column.covariate);
      EXPECT_TRUE(column.friction.allFinite()) << column.covariate;
    }
  for (const std::string name :
       {"unloading", "rate of pressure", "change of pressure"})
    EXPECT_EQ(names.count(name), 1u) << name;
  EXPECT_EQ(names.count("change of speed"), 0u);
}



TEST(Covariates, TellPhasesApart)
{
  const MeasuredTest test = slide_rest_return();
  Comparison comparison({{test, {{1., 0., 0.001}}, true, Replay(test)}}, 1000);
  const Covariates found = covariates_of(test, comparison);
  const auto       phase = [&](const double time) {
    return name_of(found.phase[std::lround(10. * time)]);
  };
  EXPECT_EQ(phase(0.1), "presliding");
  EXPECT_EQ(phase(0.5), "peak");
  EXPECT_EQ(phase(3.), "softening");
  EXPECT_EQ(phase(9.8), "steady");
  EXPECT_EQ(phase(20.), "hold");
  EXPECT_EQ(phase(30.1), "restart");
  EXPECT_EQ(phase(40.2), "reversal");
  EXPECT_EQ(phase(49.), "steady");
}



// Rows beyond the most are averaged in equal parts.
TEST(Comparison, AveragesNeighbours)
{
  const MeasuredTest test = slide_rest_return();
  const Comparison   all({{test, {{1., 0., 0.001}}, true, Replay(test)}}, 1000);
  const Comparison   few({{test, {{1., 0., 0.001}}, true, Replay(test)}}, 100);
  ASSERT_EQ(all.n_rows(), 500);
  ASSERT_EQ(few.n_rows(), 100);
  for (Eigen::Index i = 0; i < 100; ++i)
    EXPECT_NEAR(few.measured(i), all.measured.segment(5 * i, 5).mean(), 1e-15);
  EXPECT_NEAR(few.tests[0].series[0].row_noise[0],
              0.001 / std::sqrt(5.),
              1e-15);
}



// Only what varies is in the basis.
TEST(SmoothBasis, HasWhatVaries)
{
  const MeasuredTest test = slide_rest_return();
  Comparison comparison({{test, {{1., 0., 0.001}}, true, Replay(test)}}, 1000);
  std::set<std::string> names;
  for (const Direction &column :
       smooth_basis(comparison, covariates_of(test, comparison)))
    {
      names.insert(column.covariate);
      EXPECT_TRUE(column.friction.allFinite());
    }
  EXPECT_EQ(names.count("pressure"), 0u);
  EXPECT_EQ(names.count("angle"), 0u);
  EXPECT_EQ(names.count("order of the tests"), 0u);
  for (const std::string name :
       {"path", "rest", "direction", "slip since start", "heat"})
    EXPECT_EQ(names.count(name), 1u) << name;
}
