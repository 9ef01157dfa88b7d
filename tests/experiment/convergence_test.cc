// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/experiment/convergence.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

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



namespace
{
  const std::vector<double> halved = {1., 0.5, 0.25, 0.125, 0.0625};

  // Of many sequences with the limit 0: how often the reference is within its
  // uncertainty, and how large that is compared with the last value's error.
  struct Coverage
  {
    unsigned int n_sequences = 0, n_covered = 0, n_finite = 0, n_orders = 0;
    double       smallest_order = 1e300, largest_order = 0.;

    double share() const
    {
      return n_covered / static_cast<double>(n_sequences);
    }
  };

  using Deviation = std::function<double(const double h, const int i)>;

  Coverage coverage(const std::size_t n_values, const Deviation &deviation)
  {
    Coverage                  result;
    const std::vector<double> sizes(halved.begin(), halved.begin() + n_values);
    for (result.n_sequences = 0; result.n_sequences < 2000;
         ++result.n_sequences)
      {
        std::vector<double> sequence;
        for (std::size_t i = 0; i < n_values; ++i)
          sequence.push_back(deviation(sizes[i], i));
        for (const auto &reference : {extrapolated_reference(sizes, sequence),
                                      finest_reference(sizes, sequence)})
          EXPECT_GE(reference.uncertainty, 0.);
        const auto reference = extrapolated_reference(sizes, sequence);
        result.n_covered += std::abs(reference.value) <= reference.uncertainty;
        result.n_finite += std::isfinite(reference.uncertainty);
        const double order = shown_order(sizes, sequence);
        if (!std::isfinite(order))
          continue;
        ++result.n_orders;
        result.smallest_order = std::min(result.smallest_order, order);
        result.largest_order  = std::max(result.largest_order, order);
      }
    return result;
  }
} // namespace



TEST(ShownOrder, takes_three_monotone_differences)
{
  const auto of = [](const std::vector<double> &values) {
    return shown_order({halved.begin(), halved.begin() + values.size()},
                       values);
  };
  for (const double order : {0.5, 1., 2.})
    EXPECT_NEAR(of(values(halved, 7., -2., order)), order, 1e-6);
  // A peak between rough steps, which fine ones put at 12.468.
  const std::vector<double> rough = {8.866742, 12.24421, 12.52599, 12.55302};
  const std::vector<double> sizes(halved.begin(), halved.begin() + 4);
  EXPECT_NEAR(of(rough), 3.38, 0.01);
  EXPECT_TRUE(std::isnan(shown_order(sizes, rough, 2.)));
  for (const auto &reference : {extrapolated_reference(sizes, rough, 2.),
                                finest_reference(sizes, rough, 2.)})
    EXPECT_GT(reference.uncertainty, std::abs(reference.value - 12.468));
  EXPECT_NEAR(shown_order(sizes, values(sizes, 7., -2., 2.6), 2.), 2.6, 1e-6);
  // Two differences show an order, but nobody else has seen it.
  EXPECT_TRUE(std::isnan(of({1., 0.5, 0.25})));
  // The first difference goes the other way.
  EXPECT_TRUE(std::isnan(of({0.9, 1., 0.5, 0.25})));
  // Close to its neighbour by accident: the last two differences say 8.4.
  EXPECT_TRUE(std::isnan(of({1., 0.5, 0.375, 0.37463})));
  EXPECT_NEAR(richardson({1., 0.5, 0.25}, {0.5, 0.375, 0.37463}).order,
              8.4,
              0.1);
}



// Errors of known order with a term of the next order, whose size is random.
TEST(ReferenceUncertainty, covers_the_error_of_smooth_sequences)
{
  std::mt19937                     generator(3);
  std::uniform_real_distribution<> share(-1., 1.);
  for (const double order : {0.5, 1., 2.})
    {
      double     second = 0.;
      const auto found  = coverage(4, [&](const double h, const int i) {
        if (i == 0)
          second = share(generator);
        return std::pow(h, order) * (1. + second * std::pow(h, order));
      });
      EXPECT_GT(found.share(), 0.9) << order;
      EXPECT_GT(found.n_orders, 400u) << order;
      EXPECT_GT(found.smallest_order, 0.5 * order);
      EXPECT_LT(found.largest_order, 1.7 * order);
    }
}



// Fronts that move through cells make errors irregular.
TEST(ReferenceUncertainty, covers_the_error_of_irregular_sequences)
{
  std::mt19937 generator(4);
  for (const double irregularity : {0.05, 0.2})
    for (const double order : {0.5, 1., 2.})
      for (const std::size_t n : {3, 4, 5})
        {
          std::uniform_real_distribution<> factor(1. - irregularity,
                                                  1. + irregularity);
          const auto found = coverage(n, [&](const double h, const int) {
            return std::pow(h, order) * factor(generator);
          });
          // Three values do not tell an order 1/2 from a larger one.
          EXPECT_GT(found.share(),
                    order >= 1. ? 0.9 :
                    n > 3       ? 0.83 :
                                  0.7)
            << irregularity << ' ' << order << ' ' << n;
          EXPECT_GT(found.n_finite, 800u);
        }
}



TEST(ReferenceUncertainty, covers_oscillation_and_noise)
{
  const auto oscillating = coverage(5, [](const double h, const int i) {
    return (i % 2 == 0 ? 1. : -1.) * h;
  });
  EXPECT_EQ(oscillating.share(), 1.);
  EXPECT_EQ(oscillating.n_orders, 0u);

  std::mt19937               generator(5);
  std::normal_distribution<> noise;
  const auto                 nothing_else =
    coverage(5, [&](const double, const int) { return noise(generator); });
  EXPECT_GT(nothing_else.share(), 0.9);
  EXPECT_LT(nothing_else.n_orders, 40u);
  const auto floor = coverage(5, [&](const double h, const int) {
    return h * h + 0.03 * noise(generator);
  });
  EXPECT_GT(floor.share(), 0.9);
}



TEST(ReferenceUncertainty, follows_its_formulas)
{
  // Order 1 exactly: half of what was extrapolated; the last value is off by
  // that, too.
  const auto limit = extrapolated_reference(halved, values(halved, 7., 1., 1.));
  EXPECT_TRUE(limit.is_extrapolated);
  EXPECT_NEAR(limit.value, 7., 1e-9);
  EXPECT_NEAR(limit.uncertainty, 0.0625 / 2., 1e-9);
  const auto last = finest_reference(halved, values(halved, 7., 1., 1.));
  EXPECT_FALSE(last.is_extrapolated);
  EXPECT_EQ(last.value, 7.0625);
  EXPECT_NEAR(last.uncertainty, 0.0625 * 1.5, 1e-9);

  // Two values: order 1/2 is assumed.
  const auto two = finest_reference({1., 0.25}, {3., 2.});
  EXPECT_EQ(two.uncertainty, 1.);
  // One value, or a sequence that runs away: nothing is known.
  EXPECT_TRUE(std::isinf(finest_reference({1.}, {3.}).uncertainty));
  EXPECT_TRUE(std::isinf(
    extrapolated_reference({1., 0.5, 0.25}, {1., 2., 4.}).uncertainty));
  EXPECT_TRUE(std::isnan(finest_reference({}, {}).value));
  // One that hardly moves is known, wherever it goes.
  const auto slow =
    finest_reference({1., 0.5, 0.25}, {5.79454, 5.794541, 5.794542});
  EXPECT_NEAR(slow.uncertainty, 5e-5, 1e-8);
  // All the same: round-off is left.
  const auto same = extrapolated_reference({1., 0.5, 0.25}, {2., 2., 2.});
  EXPECT_EQ(same.value, 2.);
  EXPECT_GT(same.uncertainty, 0.);
  EXPECT_LT(same.uncertainty, 1e-14);
}
