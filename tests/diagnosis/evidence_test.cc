// SPDX-License-Identifier: LGPL-2.1-or-later

// What an effect has to show before it is named, kept as a rival, or added as a
// correction.

#include <slipstep/diagnosis/search.h>

#include <gtest/gtest.h>

#include <limits>

using namespace SlipStep;

namespace
{
  Workspace workspace_for(const unsigned int most_effects)
  {
    return {Parameters(),
            {},
            Comparison({}),
            {},
            {},
            {},
            RowMatrix(),
            0.04,
            most_effects,
            0,
            {}};
  }

  CandidateView seen(const double p, const double minimum_detectable)
  {
    CandidateView result;
    result.ways.emplace_back();
    result.score.value        = 5.;
    result.p                  = p;
    result.minimum_detectable = minimum_detectable;
    return result;
  }
} // namespace



// And never less on an earlier one.
TEST(Evidence, RoundsSpendNoMoreThanTheLevel)
{
  const Workspace workspace = workspace_for(4);
  double          sum = 0., before = 1.;
  for (unsigned int round = 0; round < workspace.most_effects; ++round)
    {
      const double level = level_of_round(workspace, round);
      EXPECT_LE(level, before);
      before = level;
      sum += level;
    }
  EXPECT_NEAR(sum, 0.03, 1e-15);
  // One alarm in four.
  EXPECT_DOUBLE_EQ(level_of_round(workspace, 0), 0.01);
  EXPECT_DOUBLE_EQ(level_of_round(workspace, 3), 0.005);
}



TEST(Evidence, IsSignificantAndTestable)
{
  EXPECT_TRUE(is_evident(seen(0.01, 0.05), 0.02));
  // An anisotropy on a record of one axis.
  EXPECT_FALSE(is_evident(seen(0.84, 2.42), 0.02));
  EXPECT_FALSE(is_evident(seen(0.01, 2.42), 0.02));
  EXPECT_FALSE(is_evident(seen(0.03, 0.05), 0.02));
  CandidateView nothing = seen(0.01, 0.05);
  nothing.ways.clear();
  EXPECT_FALSE(is_evident(nothing, 0.02));
}



TEST(Evidence, LowersFittedAndLeftOutDifferences)
{
  const double none      = std::numeric_limits<double>::quiet_NaN();
  const auto   is_enough = [](const Evidence &evidence) {
    return evidence.is_enough();
  };
  EXPECT_TRUE(is_enough({16., 0.1}));
  EXPECT_FALSE(is_enough({14., 20.}));
  EXPECT_FALSE(is_enough({1000., -1.}));
  EXPECT_FALSE(is_enough({1000., 0.}));
  // One condition: nothing can be left out.
  EXPECT_TRUE(is_enough({31., none}));
  EXPECT_FALSE(is_enough({29., none}));
  // One of several conditions alone tells of it.
  EXPECT_TRUE(is_enough({16., none, {2}}));
  EXPECT_FALSE(is_enough({14., none, {2}}));
  EXPECT_FALSE(is_enough({29., none, {0, 2}}));
}



namespace
{
  SearchResult result_of(const std::string &name, const double objective)
  {
    SearchResult result;
    result.model.parts     = {{name, {}}};
    result.model.objective = objective;
    return result;
  }
} // namespace



// Of two ways: what is better by far, what predicts better, else the better one
// with the other as its rival.
TEST(Evidence, OfTwoWaysTheBetterOneIsTaken)
{
  const double no_lead = std::numeric_limits<double>::quiet_NaN();
  const auto   taken   = [](const double distance, const double lead) {
    const SearchResult result =
      better_of(result_of("a", 100.), result_of("b", 100. + distance), lead);
    EXPECT_LE(result.rivals.size(), 1u);
    for (const Rival &rival : result.rivals)
      {
        EXPECT_GE(rival.distance, 0.);
        EXPECT_NE(rival.name, result.model.parts[0].name);
        EXPECT_EQ(rival.instead_of, result.model.parts[0].name);
      }
    return result.model.parts[0].name + (result.rivals.empty() ? "" : "?");
  };
  for (const double lead : {-100., -10., 0., 10., 100., no_lead})
    {
      EXPECT_EQ(taken(10., lead), "a");
      EXPECT_EQ(taken(-10., lead), "b");
    }
  for (const double distance : {-5., 5.})
    {
      EXPECT_EQ(taken(distance, -40.), "a");
      EXPECT_EQ(taken(distance, 40.), "b");
      for (const double lead : {-20., 20., no_lead})
        EXPECT_EQ(taken(distance, lead), distance < 0. ? "b?" : "a?");
    }
}
