#include <slipstep/experiment/convergence.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace SlipStep;

namespace
{
  std::vector<double> values(const std::vector<double> &sizes,
                             const double               limit,
                             const double               factor,
                             const double               order)
  {
    std::vector<double> result;
    for (const double h : sizes)
      result.push_back(limit + factor * std::pow(h, order));
    return result;
  }
} // namespace



TEST(Richardson, finds_limit_and_order)
{
  for (const double order : {0.5, 1., 2., 3.7})
    for (const double factor : {-0.3, 2.})
      for (const std::vector<double> &sizes : std::vector<std::vector<double>>{
             {1., 0.5, 0.25}, {9., 3., 1.3, 1.}, {1. / 50, 1. / 75, 1. / 200}})
        {
          const auto found =
            richardson(sizes, values(sizes, 7., factor, order));
          EXPECT_NEAR(found.order, order, 1e-6);
          EXPECT_NEAR(found.limit, 7., 1e-8);
        }
}



TEST(Richardson, says_when_there_is_no_order)
{
  const std::vector<double> sizes = {1., 0.5, 0.25};
  for (const std::vector<double> &bad :
       std::vector<std::vector<double>>{{1., 2., 1.5}, // to and fro
                                        {1., 2., 4.},  // growing differences
                                        {1., 1., 1.},  // nothing happens
                                        {1., 2.},      // too few
                                        {1., 2., std::nan("")}})
    {
      const auto found =
        richardson({sizes.begin(), sizes.begin() + bad.size()}, bad);
      EXPECT_TRUE(std::isnan(found.limit));
      EXPECT_TRUE(std::isnan(found.order));
    }
  // Sizes have to fall.
  EXPECT_TRUE(std::isnan(richardson({1., 2., 4.}, {1., 2., 2.5}).limit));
}



TEST(ObservedOrder, is_that_of_the_errors)
{
  EXPECT_NEAR(observed_order(0.3, 0.3 / 8., 1., 0.5), 3., 1e-12);
  EXPECT_NEAR(observed_order(0.09, 0.01, 3., 1.), 2., 1e-12);
  EXPECT_TRUE(std::isnan(observed_order(0.1, 0., 1., 0.5)));
  EXPECT_TRUE(std::isnan(observed_order(std::nan(""), 1., 1., 0.5)));
}
