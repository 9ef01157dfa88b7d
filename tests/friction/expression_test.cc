// SPDX-License-Identifier: LGPL-2.1-or-later

// A formula of the user's own is what the law uses, however wide its range is.

#include <slipstep/friction/contact_point.h>
#include <slipstep/utilities/exceptions.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "law_test_tools.h"

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  Settings along_path(const std::string &formula, const std::string &to)
  {
    return {{"Effects", "expression"},
            {"Static coefficient", "0.1"},
            {"expression/Covariate", "path"},
            {"expression/Formula", formula},
            {"expression/From", "0"},
            {"expression/To", to}};
  }

  // Largest relative difference over some paths.
  double error(const Settings                            &settings,
               const std::function<double(const double)> &formula)
  {
    const auto   law = make_law(settings);
    ContactPoint point(*law);
    double       worst = 0.;
    for (unsigned int i = 0; i < 400; ++i)
      {
        point.update(*law, vector(i < 200 ? 0.0137 : 0.371, 0.), 5., 1.);
        point.commit();
        const ContactState &state = point.committed();
        const double        right = formula(state.slip_path);
        worst =
          std::max(worst, std::abs(state.traction[0] / 0.5 - right) / right);
      }
    return worst;
  }
} // namespace



TEST(Expression, is_its_formula_whatever_its_range)
{
  for (const std::string to : {"100", "1e3", "1e5", "1e8"})
    {
      EXPECT_LT(error(along_path("1 + 0.05 * ln(1 + x)", to),
                      [](const double x) { return 1. + 0.05 * std::log1p(x); }),
                1e-3)
        << to;
      EXPECT_LT(error(along_path("1 + 0.3 * exp(-x / 0.5)", to),
                      [](const double x) {
                        return 1. + 0.3 * std::exp(-x / 0.5);
                      }),
                1e-3)
        << to;
    }
  const auto wave = [](const double x) {
    return 1. + 0.3 * std::sin(6.283185307179586 * x);
  };
  for (const std::string to : {"100", "500"})
    EXPECT_LT(error(along_path("1 + 0.3 * sin(6.283185307179586 * x)", to),
                    wave),
              1e-3)
      << to;
}



TEST(Expression, has_its_jumps_where_they_are)
{
  EXPECT_LT(error(along_path("x < 50.04 ? 1 : 1.2", "1e3"),
                  [](const double x) { return x < 50.04 ? 1. : 1.2; }),
            1e-12);
}



// Samples at multiples of the period see a constant.
TEST(Expression, is_refused_where_no_table_follows_it)
{
  try
    {
      make_law(along_path("1 + 0.3 * sin(6.283185307179586 * x)", "1e4"));
      FAIL();
    }
  catch (const InputError &refusal)
    {
      EXPECT_NE(std::string(refusal.what()).find("varies too quickly"),
                std::string::npos)
        << refusal.what();
    }
}
