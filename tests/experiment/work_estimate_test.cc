#include <slipstep/experiment/work_estimate.h>

#include <gtest/gtest.h>

#include <algorithm>

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
