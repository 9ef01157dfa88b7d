// SPDX-License-Identifier: LGPL-2.1-or-later

// Load point and contact: a spring in series with the friction law.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>

#include "../friction/law_test_tools.h"
#include "point_run.h"
#include "tests/file_text.h"

using namespace SlipStep;
using namespace SlipStep::Testing;
using dealii::Tensor;

namespace
{
  std::vector<HistoryRow> drive(const Settings &settings)
  {
    return point_history(point_parameters(settings));
  }
} // namespace



TEST(Machine, coulomb_with_a_spring)
{
  // Two springs in series, then the friction force.
  const double k = 50., alpha_t = 1e4, limit = 0.115 * 5.8;
  for (const HistoryRow &row :
       drive({{"Friction/Effects", ""},
              {"Loading/Machine stiffness", "50 MPa/mm"},
              {"Loading/Programme",
               "press 5.8 MPa in 1 s; slide 1 mm/s for 0.1 mm"}}))
    EXPECT_NEAR(row.tangential_load,
                std::min(k * alpha_t / (k + alpha_t) * row.displacement, limit),
                1e-11);
}



TEST(Machine, an_isotropic_contact_feels_a_softer_stick)
{
  // Slip being radial, the springs of machine and contact act as one: the law
  // with the stiffness of both, on a rigid machine, gives the same traction.
  // (Not with subloading, whose r_s falls on the elastic path of the contact
  // alone.)
  const double   k = 120., alpha_t = 1e4;
  const Settings law = {{"Effects", "overstress, softening, heating, stribeck"},
                        {"softening/Rate", "5"}};
  Settings       soft_law = law;
  soft_law.push_back(
    {"Tangential stiffness", std::to_string(k * alpha_t / (k + alpha_t))});
  const auto    contact = make_law(law), both = make_law(soft_law);
  const Machine machine(
    point_parameters({{"Loading/Machine stiffness", "120"}}));
  Slider                                 slider;
  ContactPoint                           a(*contact), b(*both);
  std::mt19937                           random(1);
  std::uniform_real_distribution<double> number(-1., 1.);
  for (unsigned int step = 0; step < 3000; ++step)
    {
      const Tensor<1, 2> motion =
        vector(0.01 * number(random), 0.01 * number(random));
      const double pressure = 5. + 2. * number(random);
      slider = machine.step(*contact, a, slider, motion, pressure, 0.1).slider;
      Machine().step(*both, b, {}, motion, pressure, 0.1);
      a.commit();
      b.commit();
      ASSERT_NEAR((a.committed().traction - b.committed().traction).norm(),
                  0.,
                  1e-6)
        << step;
    }
}



// With a core the traction may be beyond its elastic trial, and beside it.
TEST(Machine, a_contact_with_a_core_feels_a_softer_stick)
{
  const double alpha_t = 1e4;
  for (const std::string effects :
       {"subloading, elastic_core", "subloading, elastic_core, overstress"})
    for (const double k : {50., 1e4})
      {
        Settings settings = {
          {"Friction/Effects", effects},
          {"Friction/Static coefficient", "0.1"},
          {"Friction/subloading/Elastic range", "0.2"},
          {"Time stepping/Tolerance", "1e-4"},
          {"Loading/Programme",
           "press 5 MPa in 1 s; slide 0.045 mm/s for 1 s; slide 0.01 mm/s for "
           "1 s at 90 deg; slide 0.01 mm/s for 1 s at 180 deg; slide 0.02 mm/s "
           "for 1 s at -45 deg; slide -0.008 mm/s for 1 s"}};
        Settings series = settings;
        settings.push_back({"Loading/Machine stiffness", exact_text(k)});
        series.push_back({"Friction/Tangential stiffness",
                          exact_text(k * alpha_t / (k + alpha_t))});
        const auto a = drive(settings), b = drive(series);
        for (const double end : {2., 3., 4., 5., 6.})
          {
            const HistoryRow &of_a = row_at(a, end), &of_b = row_at(b, end);
            EXPECT_NEAR(of_a.time, end, 1e-9);
            EXPECT_NEAR(of_b.time, end, 1e-9);
            EXPECT_NEAR(of_a.friction, of_b.friction, 2e-5)
              << effects << ", k = " << k << ", t = " << end;
            EXPECT_NEAR(of_a.friction_y, of_b.friction_y, 2e-5)
              << effects << ", k = " << k << ", t = " << end;
          }
      }
}



TEST(Machine, rigid_is_the_law_itself)
{
  const auto       law   = make_law({});
  constexpr double gamma = TwoStages::gamma;
  ContactPoint     a(*law), b(*law);
  Machine().step(*law, a, {}, vector(1e-3, 2e-4), 5., 0.1);
  b.update(*law, gamma * vector(1e-3, 2e-4), gamma * 5., gamma * 0.1);
  b.begin_second_stage(*law);
  b.update(*law, gamma * vector(1e-3, 2e-4), 5., gamma * 0.1);
  EXPECT_EQ(a.trial().traction, b.trial().traction);
  EXPECT_TRUE(Machine(point_parameters({})).is_rigid());
}



TEST(Machine, a_soft_one_jumps_instead_of_oscillating)
{
  // Friction falls by 50 MPa/mm on a spring of 1 MPa/mm: at the peak the
  // contact jumps, within one step, to where the spring is as slack.
  const auto history =
    drive({{"Friction/Effects", "softening"},
           {"Friction/Static coefficient", "0.2"},
           {"Friction/softening/Kinetic coefficient", "0.1"},
           {"Friction/softening/Rate", "100"},
           {"Loading/Machine stiffness", "1 MPa/mm"},
           {"Loading/Programme", "press 5 MPa in 1 s; slide 1 mm/s for 2 mm"}});
  double peak = 0., fall = 0.;
  for (unsigned int i = 1; i < history.size(); ++i)
    {
      peak = std::max(peak, history[i].friction);
      fall = std::max(fall, history[i - 1].friction - history[i].friction);
    }
  EXPECT_GT(peak, 0.19);
  EXPECT_GT(fall, 0.07);
  EXPECT_NEAR(history.back().friction, 0.1, 1e-3);
}



TEST(Machine, energy_is_balanced)
{
  // Work at the load point = stored in contact and spring + dissipated, also
  // when the contact opens and lets the spring go.
  for (const std::string effects :
       {"subloading, overstress", "subloading, overstress, anisotropy"})
    {
      const HistoryRow end =
        drive({{"Friction/Effects", effects},
               {"Loading/Machine stiffness", "30 MPa/mm"},
               {"Time stepping/Tolerance", "1e-5"},
               {"Loading/Programme",
                "press 5 MPa in 1 s; slide 1 mm/s for 0.3 mm at 30 deg; slide "
                "-1 mm/s for 0.1 mm; press 0 MPa in 1 s"}})
          .back();
      EXPECT_GT(end.dissipated_energy, 0.1);
      EXPECT_NEAR(end.stored_energy, 0., 1e-12);
      EXPECT_NEAR(end.external_work,
                  end.dissipated_energy,
                  5e-3 * end.dissipated_energy);
    }
}



TEST(Machine, finds_equilibrium_with_anisotropy)
{
  const auto law =
    make_law({{"Effects", "subloading, overstress, anisotropy, viscous"},
              {"anisotropy/Ratio", "0.3"},
              {"anisotropy/Angle", "20 deg"}});
  const Machine machine(
    point_parameters({{"Loading/Machine stiffness", "40"}}));
  ContactPoint                           point(*law);
  Slider                                 slider;
  Tensor<1, 2>                           load_point;
  std::mt19937                           random(1);
  std::uniform_real_distribution<double> number(-1., 1.);
  for (unsigned int step = 0; step < 20000; ++step)
    {
      const Tensor<1, 2> motion = std::pow(10., 2. * number(random) - 3.) *
                                  vector(number(random), number(random));
      const double pressure = 5. + 4. * number(random);
      const double dt       = std::pow(10., 2. * number(random));
      load_point += motion;
      slider = machine.step(*law, point, slider, motion, pressure, dt).slider;

      // The spring and the law agree, at the end of the second stage as at
      // that of the first.
      const Tensor<1, 2> traction = point.trial().traction;
      ASSERT_NEAR((40. * (load_point - slider.slip) - traction).norm(),
                  0.,
                  1e-9)
        << step;
      ASSERT_EQ(slider.load, traction) << step;
      point.commit();
    }
}



namespace
{
  // A mass of 1e-4 MPa s^2/mm, pulled by a spring of 50 MPa/mm over a contact
  // that sticks elastically: beyond reach is its strength.
  const Settings elastic_oscillator = {
    {"Friction/Effects", ""},
    {"Friction/Static coefficient", "100"},
    {"Friction/Tangential stiffness", "150"},
    {"Loading/Machine stiffness", "50 MPa/mm"},
    {"Loading/Machine mass", "1e-4 MPa s^2/mm"}};

  /// Times at which the velocity of the contact comes to zero from above.
  std::vector<double> turning_times(const std::vector<HistoryRow> &history)
  {
    std::vector<double> times;
    for (unsigned int i = 1; i < history.size(); ++i)
      {
        const double before = history[i - 1].probes[1];
        const double after  = history[i].probes[1];
        if (before > 0. && after <= 0.)
          times.push_back(history[i].time -
                          history[i].step_size * after / (after - before));
      }
    return times;
  }
} // namespace



TEST(MachineWithMass, swings_with_the_frequency_of_springs_and_mass)
{
  // The load point is moved away quickly, then rests: the mass swings between
  // spring and contact, sqrt((k + alpha_t) / m), for ever.
  const double omega  = std::sqrt((50. + 150.) / 1e-4);
  const double period = 2. * dealii::numbers::PI / omega;
  for (const char *tolerance : {"1e-4", "1e-5"})
    {
      const auto history =
        drive(elastic_oscillator +
              Settings{{"Time stepping/Tolerance", tolerance},
                       {"Loading/Programme",
                        "press 5 MPa in 1 s; slide 1 m/s for 1 mm; hold 0.5 "
                        "s"}});
      const auto times = turning_times(history);
      ASSERT_GT(times.size(), 100u);
      const double measured =
        (times.back() - times.front()) / (times.size() - 1);
      EXPECT_NEAR(measured, period, 1e-2 * period) << tolerance;
      // Friction takes no energy out, and the time steps little: work = energy
      // of springs and motion.
      const HistoryRow &end = history.back();
      EXPECT_EQ(end.dissipated_energy, 0.);
      EXPECT_NEAR(end.external_work,
                  end.stored_energy,
                  50. * std::stod(tolerance) * end.external_work);
    }
}



TEST(MachineWithMass, is_of_second_order)
{
  // Against U = V t, x = k/(k + alpha_t) V (t - sin(omega t) / omega).
  const double        k = 50., stiffness = 200.;
  const double        omega = std::sqrt(stiffness / 1e-4), V = 1.;
  std::vector<double> errors;
  for (const char *steps : {"100", "200", "400"})
    {
      double error = 0.;
      for (const HistoryRow &row :
           drive(elastic_oscillator +
                 Settings{{"Time stepping/Equal steps per statement", steps},
                          {"Loading/Programme",
                           "press 5 MPa in 1 s; slide 1 mm/s for 0.01 s"}}))
        {
          const double t = std::max(0., row.time - 1.);
          error          = std::max(error,
                           std::abs(row.probes[0] -
                                    k / stiffness * V *
                                      (t - std::sin(omega * t) / omega)));
        }
      errors.push_back(error);
    }
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2., 0.05);
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2., 0.05);
}



TEST(MachineWithMass, a_light_one_is_the_spring_alone)
{
  const Settings slide = {
    {"Friction/Effects", "subloading, overstress, softening"},
    {"Friction/softening/Rate", "1"},
    {"Loading/Machine stiffness", "20 MPa/mm"},
    {"Time stepping/Equal steps per statement", "400"},
    {"Loading/Programme",
     "press 5 MPa in 1 s; slide 1 mm/s for 0.5 mm; slide -2 mm/s for 0.3 mm"}};
  const auto spring = drive(slide);
  // What is left is the swing with which the mass starts: V sqrt(m alpha_t).
  const double V = 2., alpha_t = 1e4;
  for (const double mass : {1e-5, 1e-7, 1e-9, 1e-11})
    {
      std::ostringstream text;
      text << mass;
      const auto history =
        drive(slide + Settings{{"Loading/Machine mass", text.str()}});
      ASSERT_EQ(history.size(), spring.size());
      double difference = 0.;
      for (unsigned int i = 0; i < history.size(); ++i)
        difference = std::max(difference,
                              std::abs(history[i].tangential_load -
                                       spring[i].tangential_load));
      EXPECT_LT(difference, V * std::sqrt(mass * alpha_t)) << mass;
    }
}



TEST(MachineWithMass, stick_slip_keeps_its_energy)
{
  // Strong weakening on a soft spring, without and with smooth sticking: work
  // = spring + motion + contact + dissipated, better with smaller steps.
  for (const char *effects : {"softening, healing, overstress",
                              "softening, healing, overstress, subloading"})
    {
      std::vector<double> errors;
      for (const char *tolerance : {"4e-4", "1e-4"})
        {
          const auto history =
            drive({{"Friction/Effects", effects},
                   {"Friction/Static coefficient", "0.3"},
                   {"Friction/softening/Kinetic coefficient", "0.1"},
                   {"Friction/softening/Rate", "100"},
                   {"Friction/healing/Rate", "0.2"},
                   {"Loading/Machine stiffness", "1 MPa/mm"},
                   {"Loading/Machine mass", "1e-5"},
                   {"Friction/Tangential stiffness", "500"},
                   {"Time stepping/Tolerance", tolerance},
                   {"Time stepping/Most steps per statement", "2000000"},
                   {"Loading/Programme",
                    "press 5 MPa in 1 s; slide 0.5 mm/s for 4 mm"}});
          double fastest = 0.;
          for (const HistoryRow &row : history)
            fastest = std::max(fastest, row.probes[1]);
          EXPECT_GT(fastest, 50.) << "it does not jump";
          const HistoryRow &end = history.back();
          errors.push_back(std::abs(end.external_work - end.stored_energy -
                                    end.dissipated_energy) /
                           end.external_work);
        }
      EXPECT_LT(errors[1], 0.7 * errors[0]);
      EXPECT_LT(errors[1], 1e-4);
    }
}



TEST(MachineWithMass, flies_free_when_the_contact_opens)
{
  // Off the plane the mass swings on its spring alone and loses nothing more.
  const auto history = drive(
    elastic_oscillator +
    Settings{{"Time stepping/Least steps per statement", "2000"},
             {"Friction/Static coefficient", "1"},
             {"Loading/Programme",
              "press 5 MPa in 1 s; slide 1 mm/s for 0.02 mm; press 0 MPa in "
              "0.1 s; hold 0.5 s"}});
  const auto   times    = turning_times(history);
  const double measured = times.back() - times[times.size() - 2];
  EXPECT_NEAR(measured,
              2. * dealii::numbers::PI / std::sqrt(50. / 1e-4),
              1e-2 * measured);
  const HistoryRow &end = history.back();
  EXPECT_NEAR(end.external_work,
              end.stored_energy + end.dissipated_energy,
              5e-3 * end.external_work);
  EXPECT_GT(end.stored_energy, 0.01 * end.external_work);
  EXPECT_EQ(end.dissipated_energy,
            history[history.size() - 50].dissipated_energy);
}



TEST(Machine, is_checked_when_read)
{
  EXPECT_THROW(Machine(point_parameters({{"Loading/Machine mass", "1e-3"}})),
               InputError);
  for (const char *text : {"soft", "0", "-3 MPa/mm", "5 mm"})
    EXPECT_THROW(Machine(
                   point_parameters({{"Loading/Machine stiffness", text}})),
                 InputError)
      << text;
}



// On a spring softer than the critical one, contacts that age let go at a speed
// that friction itself bounds. Friction after the first event and the time of
// the second peak are those of an integrator of its own (implicit Euler,
// extrapolated, 1e-8).
TEST(Machine, an_event_that_friction_bounds_is_no_jump)
{
  struct Run
  {
    const char *tolerance;
    unsigned    most_rows;
    double      balance, time;
  };
  for (const auto &[tolerance, most_rows, balance, time] :
       {Run{"1e-3", 300, 1e-5, 2.},
        Run{"2e-4", 600, 4e-6, 0.5},
        Run{"2e-5", 2000, 4e-7, 0.5}})
    {
      const auto history =
        drive({{"Friction/Effects", "subloading, overstress, ageing"},
               {"Friction/Static coefficient", "0.5"},
               {"Friction/Tangential stiffness", "1e6"},
               {"Friction/subloading/Rate", "1e5"},
               {"Friction/overstress/Viscosity", "1e7"},
               {"Friction/overstress/Exponent", "60"},
               {"Friction/overstress/Maximum ratio", "1.8"},
               {"Friction/ageing/Growth", "0.025"},
               {"Friction/ageing/Time", "0.01 s"},
               {"Friction/ageing/Renewal length", "0.01 mm"},
               {"Loading/Machine stiffness", "2.47 MPa/mm"},
               {"Time stepping/Tolerance", tolerance},
               {"Loading/Programme",
                "press 5 MPa in 1 s; slide 1 um/s for 0.5 mm; slide 1.01 um/s "
                "for 1.2 mm"}});
      double least = 1., peak = 0., time_of_peak = 0.;
      for (const HistoryRow &row : history)
        {
          if (row.time > 1400. && row.time < 1500.)
            least = std::min(least, row.friction);
          if (row.time > 1500. && row.friction > peak)
            {
              peak         = row.friction;
              time_of_peak = row.time;
            }
        }
      EXPECT_NEAR(least, 0.62835, 1e-4) << tolerance;
      EXPECT_NEAR(time_of_peak, 1629., time) << tolerance;
      EXPECT_LT(history.size(), most_rows) << tolerance;
      const HistoryRow &end = history.back();
      EXPECT_NEAR(end.external_work,
                  end.stored_energy + end.dissipated_energy,
                  balance * end.external_work);
    }
}



// A heavy mass that stops: its swing shakes the friction down, unless the first
// step of the rest is too long for it. A leapfrog of its own: 0.0009.
TEST(Machine, tells_of_a_swing_that_steps_lose)
{
  const auto stop = [](const std::string &tolerance) {
    std::vector<HistoryRow> history;
    const StepControl       control =
      run_point(point_parameters(
                  {{"Friction/Effects", "subloading"},
                   {"Friction/Static coefficient", "0.2"},
                   {"Friction/Tangential stiffness", "2590"},
                   {"Friction/subloading/Rate", "125"},
                   {"Loading/Machine stiffness", "257 MPa/mm"},
                   {"Loading/Machine mass", "1e5 kg/m^2"},
                   {"Time stepping/Tolerance", tolerance},
                   {"Loading/Programme",
                    "press 3.78 MPa in 1 s; slide 0.114 mm/s for 0.5 mm; hold "
                    "0.8 s"}}),
                history);
    return std::make_pair(history.back().friction, control.warning_of_swing());
  };
  const auto [lost, warning] = stop("5e-4");
  EXPECT_GT(lost, 0.19);
  EXPECT_TRUE(contains(warning, "oscillate at t = 5.38596 s, by 9.4"));
  const auto [followed, none] = stop("5e-5");
  EXPECT_NEAR(followed, 0.0009, 0.002);
  EXPECT_EQ(none, "");
}
