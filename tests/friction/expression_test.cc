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



// A step over what is the same at both its ends sees what is between, by a
// formula of any covariate that it goes through, and by a texture.
TEST(Expression, does_not_hide_within_a_step)
{
  constexpr double gamma = TwoStages::gamma;
  const auto of_line = [&](Settings settings, const std::string &covariate) {
    if (!covariate.empty())
      settings.emplace_back("expression/Covariate", covariate);
    const auto   law = make_law(settings);
    ContactPoint point(*law);
    double       last = 0.;
    // Steps of 0.2 mm, between multiples of that.
    for (unsigned int i = 0; i < 10; ++i)
      {
        const auto   slip = gamma * vector(i == 0 ? 0.1 : 0.2, 0.);
        const double before =
          covariate == "pressure" && i > 0 ? 3. + 0.2 * i : 3.;
        const double now =
          covariate == "pressure" ? 3. + 0.2 * (i + 1) : before;
        point.update(*law, slip, before + gamma * (now - before), gamma);
        point.begin_second_stage(*law);
        point.update(*law, slip, now, gamma);
        last = std::max(last, i == 0 ? 0. : point.error(*law).of_line);
        point.commit();
      }
    return last;
  };
  const auto bump = [](const std::string &where,
                       const std::string &scale = "1") {
    return Settings{{"Effects", "expression"},
                    {"Static coefficient", "0.1"},
                    {"Tangential stiffness", "1e5"},
                    {"expression/Formula",
                     scale + " * (1 + 0.5 * exp(-((x - " + where +
                       ") / 0.01)^2))"},
                    {"expression/From", "0"},
                    {"expression/To", "6"}};
  };
  for (const std::string covariate : {"path", "position"})
    {
      EXPECT_NEAR(of_line(bump("0.95"), covariate), 0.5, 0.01) << covariate;
      EXPECT_LT(of_line(bump("5.95"), covariate), 1e-3) << covariate;
    }
  EXPECT_NEAR(of_line(bump("3.95"), "pressure"), 0.5, 0.01);
  EXPECT_NEAR(of_line(bump("0.95", "1e-3"), "path"), 0.5, 0.01);
  EXPECT_LT(of_line(bump("5.95"), "pressure"), 1e-3);
  // 41 waves in a step, very nearly 12 of them in its first stage.
  const Settings waves = {{"Effects", "texture"},
                          {"Static coefficient", "0.1"},
                          {"Tangential stiffness", "1e5"},
                          {"texture/Amplitude", "0.3"}};
  EXPECT_GE(of_line(waves + Settings{{"texture/Wavelength", "0.0048780488 mm"}},
                    ""),
            0.3);
  // By a harmonic that is larger than the wave.
  EXPECT_GE(of_line(waves + Settings{{"texture/Amplitude", "0.003"},
                                     {"texture/Second sine", "100"},
                                     {"texture/Wavelength", "0.0097560976 mm"}},
                    ""),
            0.3);
  EXPECT_LT(of_line(waves + Settings{{"texture/Wavelength", "200 mm"}}, ""),
            1e-3);
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



// Between two samples nobody sees it unless it is looked for.
TEST(Expression, is_refused_where_a_feature_is_narrow)
{
  const auto words = [](const std::string &formula,
                        const std::string &to,
                        const std::string &from = "0") {
    Parameters parameters;
    FrictionLaw::declare_parameters(parameters);
    parameters.set("Friction/Effects", "expression", "test");
    for (const auto &[key, value] : along_path(formula, to))
      if (key != "Effects")
        parameters.set("Friction/" + key, value, "test");
    parameters.set("Friction/expression/From", from, "test");
    try
      {
        const EffectInfo &info = effect_registry().at("expression");
        info.check(info.section_of(parameters));
      }
    catch (const InputError &refusal)
      {
        return std::string(refusal.what());
      }
    return std::string();
  };
  EXPECT_NE(words("1 + 0.5 * exp(-((x - 31.3) / 1)^2)", "1e5")
              .find("it changes within much less than From to To, near x = "),
            std::string::npos);
  EXPECT_NE(words("abs(x - 31.3) < 0.2 ? 1.2 : 1", "2e4").find("near x = 31."),
            std::string::npos);
  // Where samples are no nearer to a jump than the places looked at.
  for (int i = 0; i < 20; ++i)
    EXPECT_EQ(words("x < " + std::to_string(105. + 0.137 * i) + " ? 1 : 0.7",
                    "110",
                    "100"),
              "");
  // Wide ones, and jumps at many places.
  EXPECT_EQ(words("1 + 0.5 * exp(-((x - 31.3) / 1)^2)", "60"), "");
  for (int i = 0; i < 20; ++i)
    EXPECT_EQ(words("x < " + std::to_string(0.137 * (i + 1)) + " ? 1 : 0.7",
                    "3"),
              "");
}
