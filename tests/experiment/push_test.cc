// SPDX-License-Identifier: LGPL-2.1-or-later

// A contact point under a tangential load instead of a displacement.

#include <gtest/gtest.h>

#include <slipstep/experiment/contact_under_load.h>
#include <slipstep/utilities/exceptions.h>

#include <cmath>

#include "tests/file_text.h"
#include "tests/message_of.h"
#include "../friction/law_test_tools.h"
#include "point_run.h"

using namespace SlipStep;
using namespace SlipStep::Testing;
using dealii::Tensor;

namespace
{
  std::vector<HistoryRow> drive_pushed(const Settings &settings)
  {
    return point_history(point_parameters(settings));
  }

  const double half_pi = std::acos(0.);
} // namespace



TEST(Push, reaches_its_load_and_slips_as_the_closed_form)
{
  // r_s = r = f_t / (mu f_n) in loading, so slip is the integral of dr/U(r)
  // from 0, and the rest of the displacement is elastic.
  const double mu = 0.2, pressure = 5., u = 50., alpha_t = 1e4;
  unsigned int n_loaded = 0;
  for (const HistoryRow &row : drive_pushed(
         {{"Friction/Effects", "subloading"},
          {"Friction/Static coefficient", "0.2"},
          {"Friction/subloading/Rate", "50"},
          {"Time stepping/Tolerance", "1e-5"},
          {"Loading/Programme", "press 5 MPa in 1 s; push 0.9 MPa in 2 s"}}))
    if (row.time > 1.01)
      {
        const double load = 0.45 * (row.time - 1.);
        const double slip =
          -std::log(std::cos(half_pi * load / (mu * pressure))) / (half_pi * u);
        EXPECT_NEAR(row.tangential_load, load, 1e-10);
        EXPECT_NEAR(row.displacement,
                    slip + load / alpha_t,
                    2e-4 * slip + 1e-8);
        ++n_loaded;
      }
  EXPECT_GT(n_loaded, 9u);
}



TEST(Push, ratchets_as_the_initial_subloading_surface_says)
{
  // Every reloading slips from the lower ratio on, unloading does not:
  // 2/(pi u) ln(cos(pi r_1/2) / cos(pi r_2/2)) per cycle. With a lower load
  // below zero the contact slips both ways.
  const double mu = 0.2, pressure = 5., u = 50.;
  const auto   slip = [&](const double load) {
    return -std::log(std::cos(half_pi * load / (mu * pressure))) /
           (half_pi * u);
  };
  for (const double low : {0.7, 0.3, 0., -0.4})
    for (const std::string angle : {"", " at 30 deg"})
      {
        const auto rows = drive_pushed(
          {{"Friction/Effects", "subloading"},
           {"Friction/Static coefficient", "0.2"},
           {"Friction/subloading/Rate", "50"},
           {"Loading/Programme",
            "press 5 MPa in 1 s; push between " + std::to_string(low) +
              " MPa and 0.9 MPa 5 times, 2 s each" + angle}});
        const double c = angle.empty() ? 1. : std::cos(half_pi / 3.);
        const double cycle =
          low < 0. ? slip(0.9) - slip(-low) : slip(0.9) - slip(low);
        for (const double time : {5., 7., 9., 11.})
          EXPECT_NEAR(row_at(rows, time).displacement -
                        row_at(rows, time - 2.).displacement,
                      c * cycle,
                      0.01 * cycle)
            << low << angle << " at " << time;
        EXPECT_NEAR(rows.back().tangential_load, c * low, 1e-10);
        EXPECT_NEAR(rows.back().friction_y,
                    std::sqrt(1. - c * c) * low / pressure,
                    1e-10);
      }
}



// To the load asked, back to nothing, and round, where slip goes backwards.
TEST(Push, reaches_its_load_on_a_contact_with_a_core)
{
  for (const std::string effects :
       {"subloading, elastic_core", "subloading, elastic_core, overstress"})
    for (const std::string mass : {"", "1e-9"})
      {
        Settings settings = {
          {"Friction/Effects", effects},
          {"Friction/Static coefficient", "0.1"},
          {"Loading/Programme",
           "press 5 MPa in 1 s; push 0.45 MPa in 1 s; push 0.15 MPa in 1 s; "
           "push 0.45 MPa in 1 s; push 0 MPa in 1 s; push 0.3 MPa in 1 s at 60 "
           "deg; push 0.3 MPa in 1 s at 180 deg; push 0.3 MPa in 1 s at 300 "
           "deg"}};
        if (!mass.empty())
          {
            settings.push_back({"Loading/Machine stiffness", "10 MPa/mm"});
            settings.push_back({"Loading/Machine mass", mass});
          }
        const double loads[][2] = {{0.45, 0.},
                                   {0.15, 0.},
                                   {0.45, 0.},
                                   {0., 0.},
                                   {0.15, 0.3 * std::sin(half_pi / 1.5)},
                                   {-0.3, 0.},
                                   {0.15, -0.3 * std::sin(half_pi / 1.5)}};
        unsigned int n          = 0;
        for (const HistoryRow &row : drive_pushed(settings))
          if (n < 7 && std::abs(row.time - (n + 2.)) < 1e-9)
            {
              EXPECT_NEAR(5. * row.friction, loads[n][0], 2e-6)
                << effects << ", mass " << mass << ", t = " << row.time;
              EXPECT_NEAR(5. * row.friction_y, loads[n][1], 2e-6)
                << effects << ", mass " << mass << ", t = " << row.time;
              EXPECT_LT(std::abs(row.displacement), 0.2);
              ++n;
            }
        EXPECT_EQ(n, 7u);
      }
}



TEST(Push, goes_over_into_slides_and_rests)
{
  // A slide goes on from where the load has moved the drive.
  const auto rows = drive_pushed(
    {{"Friction/Effects", "subloading, overstress"},
     {"Loading/Programme",
      "press 5 MPa in 1 s; push 0.3 MPa in 1 s; slide 0.01 mm/s for 0.02 mm; "
      "hold 1 s; push 0 MPa in 1 s; push -0.2 MPa in 1 s"}});
  const HistoryRow &pushed = row_at(rows, 2.), &slid = row_at(rows, 4.);
  EXPECT_NEAR(pushed.tangential_load, 0.3, 1e-10);
  EXPECT_GT(pushed.displacement, 0.3 / 1e4);
  EXPECT_NEAR(slid.displacement - pushed.displacement, 0.02, 1e-12);
  EXPECT_GT(slid.tangential_load, 0.3);
  EXPECT_NEAR(row_at(rows, 5.).displacement, slid.displacement, 1e-12);
  EXPECT_NEAR(row_at(rows, 6.).tangential_load, 0., 1e-10);
  EXPECT_NEAR(rows.back().tangential_load, -0.2, 1e-10);
}



TEST(Push, keeps_the_balance_of_energy)
{
  for (const std::string effects :
       {"subloading", "subloading, overstress, softening", "anisotropy"})
    for (const std::string stiffness : {"rigid", "50 MPa/mm"})
      {
        const HistoryRow end =
          drive_pushed(
            {{"Friction/Effects", effects},
             {"Loading/Machine stiffness", stiffness},
             {"Time stepping/Tolerance", "1e-5"},
             {"Loading/Programme",
              "press 5 MPa in 1 s; push between 0.1 MPa and 0.4 MPa 3 times, 1 "
              "s each at 20 deg; slide 0.1 mm/s for 0.1 mm; push 0 MPa in 1 "
              "s"}})
            .back();
        EXPECT_GT(end.dissipated_energy, 1e-3);
        EXPECT_NEAR(end.external_work,
                    end.dissipated_energy + end.stored_energy,
                    2e-3 * end.dissipated_energy)
          << effects << " " << stiffness;
      }
}



TEST(Push, beyond_friction_fails_at_that_load)
{
  // Coulomb's friction holds 0.575 MPa, reached after 0.575 s.
  Settings settings = {{"Friction/Effects", ""},
                       {"Friction/Static coefficient", "0.115"},
                       {"Loading/Programme",
                        "press 5 MPa in 1 s; push 1 MPa in 1 s"}};
  for (const std::string effects :
       {"", "subloading", "subloading, elastic_core", "subloading, softening"})
    {
      settings[0].second = effects;
      std::vector<HistoryRow> rows;
      const std::string       reason = message_of<RunError>(
        [&] { run_point(point_parameters(settings), rows); });
      EXPECT_TRUE(contains(reason, "friction cannot hold the push"))
        << effects << ": " << reason;
      if (effects != "subloading, softening")
        {
          EXPECT_NEAR(rows.back().tangential_load, 0.575, 1e-3) << effects;
        }
    }

  // An open contact holds nothing, and no load.
  settings[0].second = "";
  settings[2].second =
    "press 5 MPa in 1 s; press 0 MPa in 1 s; push 0.1 MPa in 1 s";
  EXPECT_THROW(drive_pushed(settings), RunError);
}



// An overstress holds more the faster the contact slips, up to its maximum.
TEST(Push, beyond_the_largest_overstress_fails_at_once)
{
  const Parameters parameters = point_parameters(
    {{"Friction/Effects", "subloading, overstress, softening"},
     {"Friction/Static coefficient", "0.3"},
     {"Friction/softening/Kinetic coefficient", "0.2"},
     {"Friction/softening/Rate", "20"},
     {"Friction/overstress/Viscosity", "100"},
     {"Friction/overstress/Exponent", "50"},
     {"Friction/overstress/Maximum ratio", "1.8"},
     {"Loading/Programme", "press 5 MPa in 1 s; push 2 MPa in 1 s"}});
  std::vector<HistoryRow> rows;
  const std::string       reason =
    message_of<RunError>([&] { run_point(parameters, rows); });
  EXPECT_TRUE(contains(reason, "friction cannot hold the push")) << reason;
  EXPECT_LT(rows.size(), 20000u);
  // mu p r_m of mu softened, or what slip at that speed holds of it.
  EXPECT_LT(rows.back().tangential_load, 1.8);
  EXPECT_GT(rows.back().tangential_load, 1.4);
}



TEST(Push, moves_a_mass_beyond_friction)
{
  // m g'' = F - f_t with constant F and sliding friction.
  const double mass = 1e-3, load = 1., friction = 0.115 * 5.;
  const auto   rows = drive_pushed(
    {{"Friction/Effects", ""},
       {"Friction/Static coefficient", "0.115"},
       {"Loading/Machine stiffness", "50 MPa/mm"},
       {"Loading/Machine mass", "1e-3"},
       {"Time stepping/Tolerance", "1e-5"},
       {"Loading/Programme",
        "press 5 MPa in 1 s; push 1 MPa in 1 s; push 1 MPa in 1 s"}});
  const HistoryRow &start = row_at(rows, 2.), &end = rows.back();
  ASSERT_EQ(end.probes.size(), 3u);
  EXPECT_NEAR(end.probes[1] - start.probes[1],
              (load - friction) / mass,
              1e-3 * (load - friction) / mass);
  EXPECT_NEAR(end.external_work,
              end.dissipated_energy + end.stored_energy,
              1e-3 * end.external_work);
}



TEST(Push, inverts_the_law)
{
  // Random states and loads, also with an ellipse: what comes out is the load.
  for (const std::string effects :
       {"subloading", "subloading, overstress, anisotropy"})
    {
      const auto   law = make_law({{"Effects", effects}});
      RandomLoads  random(7);
      ContactPoint point(*law);
      unsigned int n_held = 0;
      for (unsigned int n = 0; n < 2000; ++n)
        {
          const double       angle = random.uniform(0., 6.3);
          const Tensor<1, 2> load  = random.magnitude(-4., -0.2) *
                                    vector(std::cos(angle), std::sin(angle));
          const double dt = random.magnitude(-2., 2.);
          Tensor<1, 2> slip;
          const auto response = push_contact({*law, point, 5., dt}, load, slip);
          if (!response)
            {
              point.revert();
              continue;
            }
          EXPECT_NEAR((response->traction - load).norm(),
                      0.,
                      2e-9 * load.norm());
          EXPECT_NEAR((point.trial().traction - load).norm(),
                      0.,
                      2e-9 * load.norm());
          point.commit();
          ++n_held;
        }
      EXPECT_GT(n_held, 1500u);
    }
}
