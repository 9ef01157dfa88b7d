// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/law_library/slipstep_friction.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/file_text.h"
#include "tests/law_library/parsed_law.h"
#include "tests/temporary_folder.h"

namespace
{
  namespace fs = std::filesystem;

  const std::string program = SLIPSTEP_BINARY;
  const fs::path    cases   = fs::path(SLIPSTEP_SOURCE_DIR) / "prm";

  /// An increment of the motion of a point, with the traction at its end.
  struct Increment
  {
    double time_step, slip[2], pressure, traction[2];
  };

  int shell(const std::string &command)
  {
    return std::system((command + " > /dev/null").c_str());
  }

  /// What `slipstep point` makes of a case.
  std::vector<Increment> point_history(const std::string &name,
                                       const std::string &options)
  {
    const fs::path folder = test_folder() / "point";
    const fs::path prm    = cases / name / (name + ".prm");
    EXPECT_EQ(shell(program + " point " + prm.string() + " --output " +
                    folder.string() + " --quiet " + options),
              0);
    fs::path file;
    for (const auto &entry : fs::recursive_directory_iterator(folder))
      if (entry.path().filename() == "history.csv")
        file = entry.path();
    std::ifstream            in(file);
    std::string              line;
    std::vector<std::string> names;
    std::vector<Increment>   increments;
    double                   last[3] = {0., 0., 0.};
    while (std::getline(in, line))
      {
        if (line.empty() || line[0] == '#')
          continue;
        std::istringstream       cells(line);
        std::vector<std::string> row;
        for (std::string cell; std::getline(cells, cell, ',');)
          row.push_back(cell);
        if (names.empty())
          {
            names = row;
            continue;
          }
        const auto value = [&](const std::string &column) {
          for (std::size_t i = 0; i < names.size(); ++i)
            if (names[i] == column)
              return std::stod(row[i]);
          ADD_FAILURE() << column;
          return 0.;
        };
        const double now[3] = {value("time_s"),
                               value("displacement_mm"),
                               value("displacement_y_mm")};
        const double p      = value("pressure_MPa");
        increments.push_back(
          {now[0] - last[0],
           {now[1] - last[1], now[2] - last[2]},
           p,
           {p * value("friction"), p * value("friction_y")}});
        std::copy(now, now + 3, last);
      }
    EXPECT_GT(increments.size(), 20u) << file;
    return increments;
  }

  /// The law of a case, exported.
  fs::path exported(const std::string &name,
                    const std::string &options,
                    const std::string &format)
  {
    const fs::path prm = cases / name / (name + ".prm");
    EXPECT_EQ(shell(program + " export " + prm.string() + " --output " +
                    (test_folder() / format).string() + " --format " + format +
                    " " + options),
              0);
    fs::path file;
    for (const auto &entry :
         fs::recursive_directory_iterator(test_folder() / format))
      if (entry.path().extension() == ".prm")
        file = entry.path();
    return file;
  }

  struct ShippedCase
  {
    std::string name, options;
  };

  class LawLibrary : public testing::TestWithParam<ShippedCase>
  {
  protected:
    void SetUp() override
    {
      increments = point_history(GetParam().name, GetParam().options);
    }

    std::vector<Increment> increments;
  };
} // namespace



TEST_P(LawLibrary, ItRepeatsThePoint)
{
  const fs::path file = exported(GetParam().name, GetParam().options, "law");
  char           message[300] = "";
  slipstep_law *law = slipstep_law_read(file.c_str(), message, sizeof(message));
  ASSERT_NE(law, nullptr) << message;
  std::vector<double> state(slipstep_state_size(law));
  slipstep_initial_state(law, state.data());
  double largest = 0.;
  for (const Increment &increment : increments)
    {
      double traction[2];
      ASSERT_EQ(slipstep_step(law,
                              state.data(),
                              increment.slip,
                              increment.pressure,
                              increment.time_step,
                              state.data(),
                              traction,
                              nullptr,
                              nullptr,
                              message,
                              sizeof(message)),
                0)
        << message;
      EXPECT_EQ(traction[0], state[0]);
      for (unsigned int i = 0; i < 2; ++i)
        largest =
          std::max(largest, std::abs(traction[i] - increment.traction[i]));
    }
  slipstep_law_free(law);
  EXPECT_LT(largest, 1e-10);
  std::cout << "largest difference " << largest << " MPa" << std::endl;
}



#ifdef SLIPSTEP_ABAQUS_DRIVER
TEST_P(LawLibrary, TheUserSubroutineRepeatsThePoint)
{
  const fs::path file = exported(GetParam().name, GetParam().options, "abaqus");
  const std::string lines = content(file.parent_path() / "interaction.inp");
  EXPECT_TRUE(
    contains(content(file.parent_path() / "fric.f"), "SUBROUTINE FRIC(LM,TAU"));
  const std::size_t at = lines.find("DEPVAR=");
  ASSERT_NE(at, std::string::npos) << lines;
  const int      depvar = std::stoi(lines.substr(at + 7));
  const fs::path input  = test_folder() / "increments";
  {
    std::ofstream out(input);
    out.precision(17);
    for (const Increment &increment : increments)
      out << increment.time_step << ' ' << increment.slip[0] << ' '
          << increment.slip[1] << ' ' << increment.pressure << " 0\n";
  }
  const std::string start = "cd " + test_folder().string() + " && " +
                            SLIPSTEP_ABAQUS_DRIVER + " " +
                            file.parent_path().string() + " SLIPSTEP ";
  const fs::path output = test_folder() / "stresses";
  ASSERT_EQ(std::system((start + std::to_string(depvar) + " 2 < " +
                         input.string() + " > " + output.string())
                          .c_str()),
            0);
  std::ifstream stresses(output);
  double        largest = 0.;
  for (const Increment &increment : increments)
    {
      double row[12];
      for (double &value : row)
        ASSERT_TRUE(stresses >> value);
      for (unsigned int i = 0; i < 2; ++i)
        largest = std::max(largest, std::abs(row[i] - increment.traction[i]));
      EXPECT_GE(row[8], 0.);
    }
  EXPECT_LT(largest, 1e-10);
  std::cout << "largest difference " << largest << " MPa" << std::endl;

  // Too little room for the state ends the job.
  EXPECT_NE(std::system((start + std::to_string(depvar - 1) + " 2 < " +
                         input.string() + " > " + output.string())
                          .c_str()),
            0);
  EXPECT_TRUE(contains(content(output), "the law needs DEPVAR="));
}
#endif

INSTANTIATE_TEST_SUITE_P(
  OfShippedCases,
  LawLibrary,
  testing::Values(ShippedCase{"velocity_step", ""},
                  ShippedCase{"anisotropic_path", ""},
                  ShippedCase{"slide_hold_slide", "--variant \"10 mm/min\""},
                  ShippedCase{"flat_surface_test", "--variant \"200 mm/min\""}),
  [](const auto &info) { return info.param.name; });



TEST(LawLibraryExport, ItWritesOverItsOwnFilesOnly)
{
  const fs::path    folder = test_folder() / "job";
  const std::string start =
    program + " export " +
    (cases / "velocity_step" / "velocity_step.prm").string() +
    " --format abaqus --output " + folder.string() + " 2> " +
    (test_folder() / "message").string();
  EXPECT_EQ(shell(start), 0);
  EXPECT_EQ(shell(start), 0);
  for (const std::string file : {"fric.f", "slipstep.prm", "interaction.inp"})
    {
      const std::string text = content(folder / file);
      std::ofstream(folder / file) << "C of mine\n" << text;
      EXPECT_NE(shell(start), 0) << file;
      EXPECT_TRUE(contains(content(test_folder() / "message"),
                           file + " is there and was not written"));
      EXPECT_TRUE(contains(content(folder / file), "C of mine"));
      std::ofstream(folder / file) << text;
    }
}



// Members that differ in speed have one law, those that differ in it have not.
TEST(LawLibraryExport, OneLawIsAskedFor)
{
  const fs::path    message = test_folder() / "message";
  const fs::path    laws    = test_folder() / "laws.prm";
  const std::string end =
    " --output " + (test_folder() / "law").string() + " 2> " + message.string();
  const std::string speeds =
    (cases / "slide_hold_slide" / "slide_hold_slide.prm").string();
  EXPECT_EQ(shell(program + " export " + speeds + end), 0) << content(message);
  std::ofstream(laws) << "include " << speeds
                      << "\nsubsection Sweep\n"
                         "  set Key = Friction/Static coefficient\n"
                         "  set Values = 0.11, 0.12\nend\n";
  EXPECT_NE(shell(program + " export " + laws.string() + end), 0);
  EXPECT_TRUE(contains(content(message), "choose one with --variant"));
  EXPECT_EQ(shell(program + " export " + laws.string() +
                  " --variant \"Static coefficient 0.12\"" + end),
            0)
    << content(message);
}



// The tangent leads to where the step is, from wherever it is taken.
TEST(LawLibraryStep, TangentsPredictNearbySteps)
{
  char          message[300] = "";
  slipstep_law *law =
    slipstep_law_parse("subsection Friction\n"
                       "  set Effects = subloading, overstress, softening\n"
                       "end\n",
                       message,
                       sizeof(message));
  ASSERT_NE(law, nullptr) << message;
  const double elastic = 1. / slipstep_tangential_stiffness(law);
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> random(-1., 1.);
  std::vector<double>                    state(slipstep_state_size(law));
  slipstep_initial_state(law, state.data());
  for (unsigned int n = 0; n < 100; ++n)
    {
      const double slip[2]  = {elastic * random(generator),
                               elastic * random(generator)};
      const double pressure = 2. + random(generator);
      double       traction[2], d_slip[4], d_pressure[2];
      auto         end = state;
      ASSERT_EQ(slipstep_step(law,
                              state.data(),
                              slip,
                              pressure,
                              0.1,
                              end.data(),
                              traction,
                              d_slip,
                              d_pressure,
                              message,
                              300),
                0)
        << message;
      const double change[3] = {1e-4 * elastic * random(generator),
                                1e-4 * elastic * random(generator),
                                1e-4 * random(generator)};
      const double moved[2]  = {slip[0] + change[0], slip[1] + change[1]};
      double       nearby[2];
      auto         ignored = state;
      ASSERT_EQ(slipstep_step(law,
                              state.data(),
                              moved,
                              pressure + change[2],
                              0.1,
                              ignored.data(),
                              nearby,
                              nullptr,
                              nullptr,
                              message,
                              300),
                0);
      for (unsigned int i = 0; i < 2; ++i)
        EXPECT_NEAR(nearby[i],
                    traction[i] + d_slip[2 * i] * change[0] +
                      d_slip[2 * i + 1] * change[1] + d_pressure[i] * change[2],
                    2e-6);
      state = end;
    }
  slipstep_law_free(law);
}



namespace
{
  /// A point of the law of `flat_surface_test` that has slid 0.5 mm at 1 mm/min
  /// under 5.8 MPa.
  class SlidingPoint : public testing::Test
  {
  protected:
    void SetUp() override
    {
      law = slipstep_law_read(
        exported("flat_surface_test", "--variant \"1 mm/min\"", "law").c_str(),
        nullptr,
        0);
      ASSERT_NE(law, nullptr);
      state.resize(slipstep_state_size(law));
      slipstep_initial_state(law, state.data());
      for (unsigned int i = 0; i < 500; ++i)
        friction = step(state, 1e-3, 5.8, 0.06);
    }

    void TearDown() override
    {
      slipstep_law_free(law);
    }

    /// The coefficient at the end; minus what the step returns if it fails.
    double step(std::vector<double> &from,
                const double         slip,
                const double         pressure,
                const double         time_step)
    {
      const double slips[2] = {slip, 0.};
      double       traction[2];
      const int    failed = slipstep_step(law,
                                       from.data(),
                                       slips,
                                       pressure,
                                       time_step,
                                       from.data(),
                                       traction,
                                       nullptr,
                                       nullptr,
                                       message,
                                       300);
      return failed != 0 ? -failed : traction[0] / pressure;
    }

    /// At the end of a way that is made in n steps.
    double in_steps(const unsigned int n,
                    const double       slip,
                    const double       pressure,
                    const double       time)
    {
      std::vector<double> from = state;
      double              last = 0.;
      for (unsigned int i = 1; i <= n; ++i)
        last = step(from, slip / n, 5.8 + (pressure - 5.8) * i / n, time / n);
      return last;
    }

    slipstep_law       *law = nullptr;
    std::vector<double> state;
    double              friction     = 0.;
    char                message[300] = "";
  };
} // namespace



// Rest, unloading, reversal and slower sliding, in one step of a host program
// or in many: friction relaxes to the strength and not below, and does not turn
// round.
TEST_F(SlidingPoint, AStepMayBeOfAnyLength)
{
  for (const auto &[slip, pressure, time] :
       std::vector<std::array<double, 3>>{{{0., 5.8, 10.}},
                                          {{0., 5.8, 1e6}},
                                          {{0., 0.05, 1.}},
                                          {{0., 1e-6, 1.}},
                                          {{-0.01, 5.8, 1.}},
                                          {{-1e-6, 5.8, 100.}},
                                          {{1e-3, 5.8, 600.}},
                                          {{5., 40., 1e-3}}})
    {
      const double exact = in_steps(20000, slip, pressure, time);
      for (const unsigned int n : {1u, 7u, 100u})
        EXPECT_NEAR(in_steps(n, slip, pressure, time), exact, 3e-3 * friction)
          << n << " steps of " << slip << " mm, " << pressure << " MPa, "
          << time << " s";
    }
  EXPECT_GT(in_steps(1, 0., 0.05, 1.), 0.);
}



// Slip turns while pressure falls, and a contact lags behind the pressure: of
// one long step neither is seen at its end. Random steps of laws that were far
// off, against a thousand parts.
TEST(LawLibraryStep, TurnsAndLagsAreSeen)
{
  std::mt19937                     engine(3);
  std::uniform_real_distribution<> share(0., 1.);
  for (
    const std::string law_text :
    {"set Effects =\n",
     "set Effects = pressure\nsubsection pressure\nset Exponent = 0.26\nend\n",
     "set Effects = subloading, overstress, pressure_memory\n"
     "subsection pressure_memory\nset Change = 0.5\n"
     "set Slip length = 0.002 mm\nend\n"})
    {
      ParsedLaw  point("set Static coefficient = 0.2\n"
                       "set Tangential stiffness = 1e4\n" +
                      law_text);
      const auto in_parts = [&](const unsigned int   n,
                                std::vector<double> &from,
                                const double         angle,
                                const double         length,
                                const double         pressure) {
        const double          first   = from[2];
        const double          slip[2] = {length / n * std::cos(angle),
                                         length / n * std::sin(angle)};
        std::array<double, 2> traction;
        for (unsigned int i = 1; i <= n; ++i)
          EXPECT_EQ(slipstep_step(point.law,
                                  from.data(),
                                  slip,
                                  first + (pressure - first) * i / n,
                                  1. / n,
                                  from.data(),
                                  traction.data(),
                                  nullptr,
                                  nullptr,
                                  point.message,
                                  300),
                    0)
            << point.message;
        return traction;
      };
      for (unsigned int i = 0; i < 300; ++i)
        {
          const double angle        = 6.3 * share(engine),
                       length       = std::pow(10., -4. + 3.5 * share(engine)),
                       pressure     = std::pow(10., -1. + 2.5 * share(engine));
          std::vector<double> whole = point.state;
          const auto          one = in_parts(1, whole, angle, length, pressure);
          const auto          exact =
            in_parts(1000, point.state, angle, length, pressure);
          ASSERT_LT(std::hypot(one[0] - exact[0], one[1] - exact[1]),
                    0.02 * std::hypot(exact[0], exact[1]))
            << law_text << i << ": " << length << " mm, " << pressure << " MPa";
        }
    }
}



// Friction that falls with speed and that nothing lets rise at once: told, and
// in time, instead of a number. With a direct effect it slides.
TEST(LawLibraryStep, JumpsAreNoSolution)
{
  for (const bool is_stable : {false, true})
    {
      ParsedLaw    point(std::string("set Effects = subloading, ") +
                      (is_stable ? "overstress, " : "") +
                      "stribeck\nset Static coefficient = 0.2\n"
                         "subsection stribeck\nset Rise = " +
                      (is_stable ? "0.05" : "1") +
                      "\nset Speed = 0.5 mm/s\nend\n");
      double       traction[2] = {0., 0.};
      unsigned int n_failed    = 0;
      for (unsigned int i = 0; i < 100; ++i)
        {
          const double slip[2] = {5e-3, 0.};
          n_failed += slipstep_step(point.law,
                                    point.state.data(),
                                    slip,
                                    5.,
                                    0.01,
                                    point.state.data(),
                                    traction,
                                    nullptr,
                                    nullptr,
                                    point.message,
                                    300);
        }
      if (is_stable)
        {
          EXPECT_EQ(n_failed, 0u) << point.message;
          EXPECT_GT(traction[0], 5. * 0.19);
        }
      else
        {
          EXPECT_GT(n_failed, 50u);
          EXPECT_TRUE(contains(point.message, "friction jumps again and again"))
            << point.message;
        }
    }
}



TEST_F(SlidingPoint, WhatNoStepLeavesBehindIsRefused)
{
  const auto before = state;
  EXPECT_EQ(step(state, 1e200, 5.8, 1.), -1.);
  EXPECT_EQ(state, before);

  std::vector<double> none(state.size(), 0.);
  EXPECT_EQ(step(none, 0.1, 5.8, 1.), -1.);
  EXPECT_TRUE(contains(message, "slipstep_initial_state"));
  for (int i = 0; i < slipstep_state_size(law); ++i)
    {
      const std::string name = slipstep_state_name(law, i);
      auto              bad  = state;
      if (name != "traction_1_MPa" && name != "traction_2_MPa" && name != "r" &&
          name != "dissipation_MPa_mm")
        {
          bad[i] = -1.;
          EXPECT_EQ(step(bad, 0.1, 5.8, 1.), -1.) << name;
          EXPECT_TRUE(contains(message, name)) << message;
        }
      if (name == "mu" || name == "r_s")
        {
          bad[i] = 1e30;
          EXPECT_EQ(step(bad, 0.1, 5.8, 1.), -1.) << name;
        }
      if (name == "normal_traction_MPa")
        {
          bad[i] = 0.;
          EXPECT_EQ(step(bad, 0.1, 5.8, 1.), -1.);
          EXPECT_TRUE(contains(message, "without pressure"));
        }
    }
}



TEST(LawLibraryStep, WhatIsWrongIsToldAndChangesNothing)
{
  char message[300] = "";
  EXPECT_EQ(slipstep_law_read("/nowhere/law.prm", message, 300), nullptr);
  EXPECT_TRUE(contains(message, "no such file"));
  EXPECT_EQ(slipstep_law_parse("subsection Friction\n set Efects = x\nend\n",
                               message,
                               300),
            nullptr);
  EXPECT_TRUE(contains(message, "did you mean Friction/Effects"));
  EXPECT_EQ(slipstep_law_parse("subsection Loading\nend\n", message, 10),
            nullptr);
  EXPECT_EQ(std::string(message).size(), 9u);
  EXPECT_EQ(slipstep_law_named(test_folder().c_str(), "NONE   ", message, 300),
            nullptr);
  EXPECT_TRUE(contains(message, "none.prm: no such file"));

  slipstep_law *law = slipstep_law_parse("", nullptr, 0);
  ASSERT_NE(law, nullptr);
  std::vector<double> state(slipstep_state_size(law));
  slipstep_initial_state(law, state.data());
  EXPECT_STREQ(slipstep_state_name(law, 0), "traction_1_MPa");
  EXPECT_STREQ(slipstep_state_name(law, -1), "");
  EXPECT_STREQ(slipstep_state_name(law, slipstep_state_size(law)), "");
  const auto   before      = state;
  double       traction[2] = {7., 7.};
  const double nan         = std::nan("");
  for (const auto &[slip, pressure, time_step] :
       std::vector<std::array<double, 3>>{{{0., 1., 0.}},
                                          {{0., 1., -1.}},
                                          {{0., 1., nan}},
                                          {{nan, 1., 1.}},
                                          {{0., nan, 1.}}})
    {
      const double slips[2] = {slip, 0.};
      EXPECT_EQ(slipstep_step(law,
                              state.data(),
                              slips,
                              pressure,
                              time_step,
                              state.data(),
                              traction,
                              nullptr,
                              nullptr,
                              nullptr,
                              0),
                1);
      EXPECT_EQ(state, before);
      EXPECT_EQ(traction[0], 7.);
    }
  // Open: no traction, no tangent.
  const double slips[2]  = {1., 0.};
  double       d_slip[4] = {7., 7., 7., 7.};
  EXPECT_EQ(slipstep_step(law,
                          state.data(),
                          slips,
                          -1.,
                          1.,
                          state.data(),
                          traction,
                          d_slip,
                          nullptr,
                          nullptr,
                          0),
            0);
  EXPECT_EQ(traction[0], 0.);
  EXPECT_EQ(d_slip[0], 0.);
  slipstep_law_free(law);
}
