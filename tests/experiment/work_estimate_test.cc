// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/experiment/work_estimate.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "tests/temporary_folder.h"

using namespace SlipStep;



TEST(WorkEstimate, RisesFromZeroToOne)
{
  const Programme programme(
    "press 1 MPa in 1 s; slide 1 mm/s for 100 s; hold 9 s; slide -1 mm/s for 1 "
    "s",
    0.,
    ".");
  WorkEstimate estimate(programme);
  double       last = 0.;
  for (double time = 1e-3; time < 111.; time += std::max(1e-3, time / 50.))
    {
      const double share = estimate.share_done(time);
      EXPECT_GE(share, last);
      EXPECT_LT(share, 1.);
      last = share;
    }
  EXPECT_EQ(estimate.share_done(111.), 1.);
}



TEST(WorkEstimate, ASlideIsMostOfTheWorkAndBeginsSlowly)
{
  const Programme programme("hold 1 s; slide 1 mm/s for 100 s", 0., ".");
  WorkEstimate    estimate(programme);
  EXPECT_NEAR(estimate.share_done(0.5), 0.5 / 11., 1e-12);
  EXPECT_NEAR(estimate.share_done(1.), 1. / 11., 1e-12);
  // Steps that grow tenfold: as far in each.
  double last = estimate.share_done(1. + 1e-5);
  last        = estimate.share_done(1. + 1e-4);
  for (double since = 1e-3; since < 99.; since *= 10.)
    {
      const double share = estimate.share_done(1. + since);
      EXPECT_NEAR(share - last, 10. / 11. / 7., 0.01);
      last = share;
    }
}



namespace
{
  /// Steps of a run: how long each is in the programme and on the clock [s].
  struct Trace
  {
    struct Step
    {
      double length, cost;
    };
    std::string       programme;
    std::vector<Step> steps;
    bool              ends = true;

    /// Steps from one length to another until a time; the factor is that from
    /// step to step.
    void add(double       length,
             const double factor,
             const double limit,
             const double until)
    {
      double time = 0.;
      for (const Step &step : steps)
        time += step.length;
      while (time < until * (1. - 1e-12) && steps.size() < 100000)
        {
          const double made = std::min(length, until - time);
          // The clock of a shared machine.
          steps.push_back({made, 0.1 * (1. + scatter * noise(random))});
          time += made;
          length = factor > 1. ? std::min(length * factor, limit) :
                                 std::max(length * factor, limit);
        }
    }

    double                                 scatter = 0.3;
    std::mt19937                           random{7};
    std::uniform_real_distribution<double> noise{-1., 1.};
  };

  struct Told
  {
    double first_share = 1.; ///< of the whole time, at which one is told
    double worst       = 1.; ///< factor between what is told and the truth
    double share       = 0.; ///< of the rest of the time in which it is told
  };

  Told follow(const Trace &trace)
  {
    double total = 0.;
    for (const auto &step : trace.steps)
      total += step.cost;
    const Programme programme(trace.programme, 0., ".");
    WorkEstimate    estimate(programme);
    Told            told;
    double          time = 0., now = 0.;
    for (const auto &step : trace.steps)
      {
        time += step.length;
        now += step.cost;
        estimate.share_done(time);
        const double left = estimate.time_left(time, now);
        const double truth =
          trace.ends ? total - now : std::numeric_limits<double>::infinity();
        if (std::isnan(left) || now < 0.1 * total || total - now < step.cost)
          continue;
        told.first_share = std::min(told.first_share, now / total);
        told.worst       = std::max({told.worst, left / truth, truth / left});
        told.share += step.cost / total;
      }
    return told;
  }
} // namespace



TEST(TimeLeft, OfEqualStepsIsToldSoon)
{
  for (const double scatter : {0., 0.1, 0.3})
    {
      Trace trace{"slide 1 mm/s for 100 s", {}};
      trace.scatter = scatter;
      trace.add(0.1, 1., 0.1, 100.);
      const Told told = follow(trace);
      EXPECT_LT(told.first_share, 0.15 + scatter);
      EXPECT_LT(told.worst, 1.5);
      EXPECT_GT(told.share, 0.8 - scatter);
    }
}



TEST(TimeLeft, IsNotToldWhileStepsGrow)
{
  // From the same growth to all plateaus: a few of its steps to most of them.
  for (const double plateau : {0.003, 0.02, 0.1, 0.5, 2., 10.})
    for (const double factor : {1.02, 1.1, 1.26})
      {
        Trace trace{"slide 1 mm/s for 100 s", {}};
        trace.random.seed(100. * plateau + 1e4 * factor);
        trace.add(1e-6, factor, plateau, 100.);
        const Told told = follow(trace);
        EXPECT_LT(told.worst, 1.5) << plateau << ' ' << factor;
        const double growth = std::log(plateau / 1e-6) / std::log(factor);
        if (growth < 0.2 * trace.steps.size())
          {
            EXPECT_GT(told.share, 0.4) << plateau << ' ' << factor;
          }
      }
}



TEST(TimeLeft, IsNotToldOfARunThatNeverEnds)
{
  for (const double shrink : {0.7, 0.9, 0.97})
    for (const double peak : {1e-3, 0.1, 1.})
      {
        Trace trace{"slide 1 mm/s for 100 s", {}};
        trace.ends = false;
        // No plateau: it could not be told from that of a run that ends.
        trace.add(1e-6, 1.2, peak, 5.5 * peak);
        trace.add(peak, shrink, 1e-12, 99.);
        trace.steps.resize(std::min<std::size_t>(trace.steps.size(), 20000));
        const Told told = follow(trace);
        EXPECT_EQ(told.worst, 1.) << shrink << ' ' << peak;
      }
}



TEST(TimeLeft, OfStickSlipIsThatOfManyCycles)
{
  Trace trace{"slide 1 mm/s for 100 s", {}};
  for (int cycle = 1; cycle <= 100; ++cycle)
    trace.add(1e-4, 1.4, 0.1, cycle);
  const Told told = follow(trace);
  EXPECT_LT(told.worst, 1.5);
  EXPECT_GT(told.share, 0.2);
}



TEST(TimeLeft, OfAReplayGoesByItsRows)
{
  const auto    file = test_folder() / "rows.csv";
  std::ofstream out(file);
  out << "time_s,displacement_mm,pressure_MPa,friction\n";
  Trace  trace{"press 5 MPa in 1 s; follow " + file.string(), {}};
  double time = 0.;
  trace.add(0.1, 1., 0.1, 1.);
  // Rows first far from each other, then close.
  for (int i = 0; i <= 600; ++i)
    {
      const double step = i < 200 ? 1. : 0.05;
      out << time << ',' << 0.1 * i << ",5,0.1\n";
      time += step;
      if (i < 600)
        trace.steps.push_back({step, 0.1});
    }
  out.close();
  const Told told = follow(trace);
  EXPECT_LT(told.first_share, 0.2);
  EXPECT_LT(told.worst, 1.5);
  EXPECT_GT(told.share, 0.6);
}



TEST(TimeLeft, OfCyclesIsKnownFromTheFirst)
{
  Trace trace{"press 5 MPa in 1 s; repeat 20 times { slide 1 mm/s for 10 s; "
              "slide -1 mm/s for 10 s; hold 1 s}",
              {}};
  trace.add(0.1, 1., 0.1, 1.);
  for (int cycle = 0; cycle < 20; ++cycle)
    {
      const double begin = 1. + 21. * cycle;
      trace.add(1e-4, 1.2, 0.3, begin + 10.);
      trace.add(1e-4, 1.2, 0.3, begin + 20.);
      trace.add(0.1, 1., 0.1, begin + 21.);
    }
  const Told told = follow(trace);
  EXPECT_LT(told.first_share, 0.2);
  EXPECT_LT(told.worst, 1.5);
  EXPECT_GT(told.share, 0.6);
}



TEST(TimeLeft, IsNotToldBeforeASlideThatHasNoLike)
{
  Trace trace{"press 5 MPa in 1 s; slide 1 mm/s for 10 s; slide 100 mm/s for "
              "1000 s",
              {}};
  trace.add(0.1, 1., 0.1, 1.);
  trace.add(0.01, 1., 0.01, 11.);
  trace.add(1., 1., 1., 1011.);
  const Told told = follow(trace);
  EXPECT_LT(told.worst, 1.5);
  EXPECT_GT(told.first_share, 0.5);
}



TEST(TimeLeft, OfAResumedRunCountsFromThere)
{
  const Programme programme("slide 1 mm/s for 100 s", 0., ".");
  WorkEstimate    estimate(programme);
  estimate.share_done(50.);
  estimate.resume();
  double left = 0.;
  for (int i = 1; i <= 250; ++i)
    {
      estimate.share_done(50. + 0.1 * i);
      left = estimate.time_left(50. + 0.1 * i, 0.2 * i);
    }
  EXPECT_NEAR(left, 50., 2.);
}
