// SPDX-License-Identifier: LGPL-2.1-or-later

// Runs on one contact point against the rate equations integrated from event
// to event: how right friction and energy are at the default tolerance, and how
// fast they become better with a smaller one.

#include "../experiment/point_run.h"
#include "reference_contact.h"

#include "../temporary_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  constexpr double default_tolerance = 5e-4;

  struct Errors
  {
    std::size_t steps  = 0;
    double      row    = 0.; ///< over the peak friction
    double      line   = 0.; ///< between the rows, the same
    double      energy = 0.; ///< over the dissipated energy at the end
  };

  double
  distance(const std::array<double, 2> &a, const double x, const double y)
  {
    return std::hypot(a[0] - x, a[1] - y);
  }

  Errors errors_of(const std::vector<HistoryRow> &history,
                   const ReferenceContact        &reference)
  {
    constexpr unsigned int n_samples = 10;

    Errors     errors;
    HistoryRow before;
    double     peak = 0.;
    for (const HistoryRow &row : history)
      {
        const ReferenceContact::Answer answer = reference.at(row.time);
        peak =
          std::max(peak, std::hypot(answer.friction[0], answer.friction[1]));
        errors.row =
          std::max(errors.row,
                   distance(answer.friction, row.friction, row.friction_y));
        errors.energy =
          std::max(errors.energy,
                   std::abs(answer.dissipation - row.dissipated_energy));
        for (unsigned int i = 1; i < n_samples && before.pressure > 0.; ++i)
          {
            const double share   = double(i) / n_samples;
            const auto   between = [share](const double a, const double b) {
              return (1. - share) * a + share * b;
            };
            const auto there = reference.at(between(before.time, row.time));
            errors.line =
              std::max(errors.line,
                       distance(there.friction,
                                between(before.friction, row.friction),
                                between(before.friction_y, row.friction_y)));
          }
        before = row;
      }
    errors.steps = history.size();
    errors.row /= peak;
    errors.line /= peak;
    errors.energy /= reference.at(history.back().time).dissipation;
    return errors;
  }

  void print(const std::string         &name,
             const std::vector<Errors> &errors,
             const std::size_t          reference_steps)
  {
    static bool has_head = false;
    if (!has_head)
      std::printf("%-22s %7s %9s %9s %9s %8s %8s %9s\n",
                  "programme",
                  "steps",
                  "row",
                  "line",
                  "energy",
                  "factor",
                  "factor",
                  "reference");
    has_head = true;
    std::printf("%-22s %7zu %9.2e %9.2e %9.2e",
                name.c_str(),
                errors[0].steps,
                errors[0].row,
                errors[0].line,
                errors[0].energy);
    for (unsigned int i = 1; i < errors.size(); ++i)
      std::printf(" %8.2f", errors[i - 1].row / errors[i].row);
    std::printf(" %9zu\n", reference_steps);
  }

  // Of the programmes.
  const Settings paper = {{"Friction/Static coefficient", "0.0915"},
                          {"Friction/softening/Kinetic coefficient", "0.078"}};

  const Settings healing =
    paper +
    Settings{{"Friction/Effects", "subloading, overstress, softening, healing"},
             {"Friction/softening/Rate", "0.05"},
             {"Friction/softening/Steepness", "10"},
             {"Friction/healing/Rate", "8.3e-4"},
             {"Friction/healing/Steepness", "10"}};

  class ProgrammesInTime : public testing::Test
  {
  protected:
    /// Run with ever smaller tolerances, print and judge.
    void check(const Settings &settings)
    {
      const Parameters       parameters = point_parameters(settings);
      const Programme        programme  = parse_programme(parameters);
      const ReferenceContact reference(parameters, programme);
      std::vector<Errors>    errors;
      for (const double share : {1., 0.1, 0.01})
        errors.push_back(
          errors_of(point_history(parameters, share * default_tolerance),
                    reference));
      print(testing::UnitTest::GetInstance()->current_test_info()->name(),
            errors,
            reference.n_steps());

      EXPECT_LE(errors[0].row, 5e-4);
      EXPECT_LE(errors[0].line, 2e-3);
      EXPECT_LE(errors[0].energy, 5e-4);
      // The largest error is where the steps happen to fall, so that one tenth
      // may bring more than the next.
      for (unsigned int i = 1; i < errors.size(); ++i)
        if (errors[i].row > least_error)
          {
            EXPECT_GE(errors[i - 1].row / errors[i].row, 4.) << i;
          }
      if (errors[2].row > least_error)
        {
          EXPECT_GE(errors[0].row / errors[2].row, 4.5 * 4.5);
        }
    }

    /// Below, it is the reference that errs.
    double least_error = 1e-8;
  };
} // namespace



TEST_F(ProgrammesInTime, plain)
{
  check(paper + Settings{{"Loading/Programme",
                          "press 5.8 MPa in 1 s; hold 10 s; slide 10 mm/min "
                          "for 60 mm"}});
}



TEST_F(ProgrammesInTime, speed_jumps)
{
  check(
    healing +
    Settings{
      {"Friction/subloading/Rate", "1000"},
      {"Loading/Programme",
       "press 5.8 MPa in 1 s; slide 0.1 mm/min for 2 mm; slide 1 mm/min for 5 "
       "mm; slide 10 mm/min for 10 mm; slide 100 mm/min for 10 mm; slide 1000 "
       "mm/min for 10 mm; slide 100 mm/min for 10 mm; slide 10 mm/min for 10 "
       "mm; slide 1 mm/min for 5 mm; slide 0.1 mm/min for 2 mm"}});
}



TEST_F(ProgrammesInTime, reversals)
{
  check(paper +
        Settings{{"Loading/Programme",
                  "press 5.8 MPa in 1 s; repeat 3 times { slide 10 mm/min for "
                  "2 mm; slide -10 mm/min for 1 mm }; slide -50 mm/min for 3 "
                  "mm; slide 50 mm/min for 3 mm"}});
}



namespace
{
  /// A test in which the pressure changes while the contact slides at 10
  /// mm/min.
  void write_ramp(const std::string &file,
                  const unsigned int n_rows,
                  const double       from,
                  const double       to)
  {
    std::ofstream out(test_folder() / file);
    out.precision(17);
    out << "time_s,displacement_mm,pressure_MPa,friction\n";
    for (unsigned int i = 0; i < n_rows; ++i)
      {
        const double share = i / (n_rows - 1.);
        out << 6. * share << ',' << share << ',' << from + share * (to - from)
            << ",0\n";
      }
  }

  Settings pressure_ramps(const unsigned int n_rows)
  {
    write_ramp("up.csv", n_rows, 5., 50.);
    write_ramp("down.csv", n_rows, 50., 5.);
    const std::string folder = test_folder().string();
    return paper +
           Settings{{"Friction/Effects",
                     "subloading, overstress, softening, pressure"},
                    {"Friction/pressure/Exponent", "0.1"},
                    {"Loading/Programme",
                     "press 5 MPa in 1 s; slide 10 mm/min for 1 mm; follow " +
                       folder + "/up.csv; slide 10 mm/min for 1 mm; follow " +
                       folder + "/down.csv; slide 10 mm/min for 1 mm"}};
  }
} // namespace



TEST_F(ProgrammesInTime, ramps_of_2_rows)
{
  check(pressure_ramps(2));
}



TEST_F(ProgrammesInTime, ramps_of_5_rows)
{
  check(pressure_ramps(5));
}



TEST_F(ProgrammesInTime, ramps_of_100_rows)
{
  check(pressure_ramps(100));
}



TEST_F(ProgrammesInTime, holds_with_healing)
{
  check(healing +
        Settings{
          {"Friction/healing/Rate", "5e-7"},
          {"Friction/healing/Steepness", "600"},
          {"Friction/subloading/Rate", "1000"},
          {"Loading/Speed", "10 mm/min"},
          {"Loading/Programme",
           "press 5.8 MPa in 1 s; slide for 10 mm; hold 1 s; slide for 10 mm; "
           "hold 100 s; slide for 10 mm; hold 10000 s; slide for 10 mm"}});
}



TEST_F(ProgrammesInTime, ageing_and_long_holds)
{
  check({{"Friction/Effects", "subloading, overstress, ageing"},
         {"Friction/Static coefficient", "0.078"},
         {"Friction/ageing/Growth", "0.01"},
         {"Friction/ageing/Time", "1 s"},
         {"Friction/ageing/Renewal length", "0.05 mm"},
         {"Loading/Speed", "10 mm/min"},
         {"Loading/Programme",
          "press 5.8 MPa in 1 s; slide for 2 mm; repeat 2 times { hold 1000 s; "
          "slide for 2 mm }"}});
}



TEST_F(ProgrammesInTime, turns)
{
  check(paper +
        Settings{{"Loading/Speed", "10 mm/min"},
                 {"Loading/Programme",
                  "press 5.8 MPa in 1 s; slide for 2 mm at 0 deg; slide for 2 "
                  "mm at 90 deg; slide for 2 mm at 180 deg; slide for 2 mm at "
                  "225 deg"}});
}



TEST_F(ProgrammesInTime, spring_with_healing)
{
  check(healing +
        Settings{
          {"Loading/Machine stiffness", "20"},
          {"Loading/Programme",
           "press 5.8 MPa in 1 s; slide 1 mm/min for 5 mm; slide 20 mm/min for "
           "10 mm; hold 100 s; slide 1 mm/min for 5 mm"}});
}



TEST_F(ProgrammesInTime, oblique_on_an_ellipse)
{
  check(paper +
        Settings{
          {"Friction/Effects", "subloading, overstress, softening, anisotropy"},
          {"Friction/anisotropy/Ratio", "0.6"},
          {"Friction/anisotropy/Angle", "30 deg"},
          {"Loading/Speed", "10 mm/min"},
          {"Loading/Programme",
           "press 5.8 MPa in 1 s; slide for 2 mm; slide for 2 mm at 75 deg; "
           "slide for 2 mm at 215 deg"}});
}



TEST_F(ProgrammesInTime, viscous)
{
  check(
    paper +
    Settings{
      {"Friction/Effects", "subloading, softening, viscous"},
      {"Friction/viscous/Drag", "0.2"},
      {"Loading/Programme",
       "press 5.8 MPa in 1 s; slide 1 mm/min for 5 mm; slide 50 mm/min for 5 "
       "mm; hold 10 s; slide -10 mm/min for 5 mm"}});
}



TEST_F(ProgrammesInTime, heating_with_rests)
{
  check({{"Friction/Effects", "subloading, overstress, heating"},
         {"Friction/Static coefficient", "0.078"},
         {"Friction/heating/Weakening", "5e-3"},
         {"Friction/heating/Heating", "50"},
         {"Friction/heating/Cooling time", "2 s"},
         {"Loading/Programme",
          "press 5.8 MPa in 1 s; repeat 4 times { slide 1 mm/s for 5 s; hold 3 "
          "s }"}});
}



TEST_F(ProgrammesInTime, eleven_effects)
{
  check(
    paper +
    Settings{
      {"Friction/Effects",
       "subloading, overstress, softening, healing, ageing, pressure, "
       "shear_cap, adhesion, run_in, heating, viscous"},
      {"Friction/healing/Rate", "1e-3"},
      {"Friction/healing/Steepness", "10"},
      {"Friction/ageing/Growth", "0.01"},
      {"Friction/pressure/Exponent", "0.1"},
      {"Friction/shear_cap/Shear limit", "6"},
      {"Friction/adhesion/Strength", "0.05"},
      {"Friction/run_in/Change", "0.2"},
      {"Friction/run_in/Length", "5 mm"},
      {"Friction/heating/Weakening", "2e-3"},
      {"Friction/heating/Heating", "50"},
      {"Friction/heating/Cooling time", "5 s"},
      {"Friction/viscous/Drag", "0.01"},
      {"Loading/Programme",
       "press 5.8 MPa in 1 s; slide 10 mm/min for 5 mm; hold 20 s; slide 100 "
       "mm/min for 10 mm; slide -10 mm/min for 3 mm; press 12 MPa in 2 s; "
       "slide 10 mm/min for 5 mm"}});
}



TEST_F(ProgrammesInTime, pressure_cycles_at_rest)
{
  check(paper + Settings{{"Loading/Programme",
                          "press 5.8 MPa in 1 s; slide 10 mm/min for 2 mm; "
                          "repeat 5 times { press 3 MPa in 1 s; press 6 MPa in "
                          "1 s }; slide 10 mm/min for 1 mm; repeat 3 times { "
                          "press 5 MPa in 1 s; press 8 MPa in 1 s }; slide 10 "
                          "mm/min for 1 mm"}});
}



TEST_F(ProgrammesInTime, unloads_and_reloads)
{
  // Each time back by less than the elastic slip, and on.
  check(paper +
        Settings{{"Loading/Programme",
                  "press 5.8 MPa in 1 s; slide 10 mm/min for 1 mm; "
                  "repeat 20 times { slide -1 mm/min for 30 nm; slide 1 "
                  "mm/min for 100 nm }; slide 10 mm/min for 1 mm"}});
}
