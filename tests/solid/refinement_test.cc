// SPDX-License-Identifier: LGPL-2.1-or-later

// Orders of convergence on a case with a closed form, and of the time step.

#include "block_test_tools.h"

#include <slipstep/experiment/convergence.h>
#include <slipstep/experiment/quantities.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  // A thin strip (nu = 0) that sticks everywhere and is pulled at one end by
  // u_0: a bar on tangential springs k, so that F = E h u_0 / Lambda
  // tanh(L / Lambda) with Lambda = sqrt(E h / k) = 1 mm; what the bar theory
  // leaves out is of the order k h / G = 2e-6.
  Settings strip(const std::string &degree, const unsigned int n_cells)
  {
    return {{"Friction/Effects", ""},
            {"Friction/Static coefficient", "0.9"},
            {"Friction/Tangential stiffness", "206"},
            {"Friction/Normal stiffness", "1e6"},
            {"Block/Dimension", "2"},
            {"Block/Size", "3 mm, 0.001 mm"},
            {"Block/Subdivisions", std::to_string(n_cells) + ", 1"},
            {"Block/Degree", degree},
            {"Block/Poisson ratio", "0"},
            {"Block/Newton tolerance", "1e-12"},
            {"Block/Faces/top", "pressure programme; flat"},
            {"Block/Faces/right", "drive"},
            {"Loading/Programme",
             "press 1 MPa in 1 s; slide 1 mm/s for 0.00002 mm"},
            {"Time stepping/Equal steps per statement", "1"}};
  }

  double force(const std::string &degree, const unsigned int n_cells)
  {
    const auto result =
      run_block_case<2>(make_parameters(strip(degree, n_cells)));
    EXPECT_EQ(result.failure, "");
    return result.history.back().tangential_load;
  }

  // The value of the one quantity of a contact point at a number of steps.
  double point_value(const Settings &settings, const unsigned int n_steps)
  {
    const Parameters parameters = make_parameters(
      settings + Settings{{"Time stepping/Equal steps per statement",
                           std::to_string(n_steps)}});
    const Programme programme = parse_programme(parameters);
    return evaluate_quantities(parse_quantities(parameters, programme),
                               programme,
                               point_history(parameters),
                               0)[0]
      .value;
  }
} // namespace



// The force is an energy norm of the solution, so its error has twice the order
// of the gradient's.
TEST(Refinement, orders_of_Q1_and_Q2)
{
  constexpr double L = 3., h = 1e-3, E = 206e3, u_0 = 2e-5;
  const double     exact = E * h * u_0 * std::tanh(L);
  for (const unsigned int degree : {1, 2})
    {
      std::vector<double> sizes, forces;
      for (const unsigned int n : {3, 6, 12})
        {
          sizes.push_back(L / n);
          forces.push_back(force(std::to_string(degree), n));
        }
      for (unsigned int i = 1; i < forces.size(); ++i)
        EXPECT_NEAR(std::log(
                      std::abs((forces[i - 1] - exact) / (forces[i] - exact))) /
                      std::log(sizes[i - 1] / sizes[i]),
                    2. * degree,
                    0.2)
          << "Q" << degree << ": " << forces[i];
      const Extrapolation limit = richardson(sizes, forces);
      EXPECT_NEAR(limit.order, 2. * degree, 0.2);
      EXPECT_NEAR(limit.limit / exact, 1., degree == 1 ? 1e-3 : 1e-5);
    }
}



// Two stages, with all that the friction law has to integrate.
// Subloading starts with an infinite rate, of which equal steps make order 1.5.
TEST(Refinement, order_of_the_time_step)
{
  const Settings law = {{"Friction/Static coefficient", "0.115"},
                        {"Friction/softening/Kinetic coefficient", "0.098"},
                        {"Friction/softening/Rate", "10"},
                        {"Friction/overstress/Viscosity", "1.15e4"},
                        {"Friction/overstress/Exponent", "16.52"},
                        {"Friction/overstress/Maximum ratio", "1.8"},
                        {"Loading/Programme",
                         "press 5.8 MPa in 1 s; slide 1 mm/min for 0.01 mm"}};
  for (const bool with_subloading : {false, true})
    for (const std::string quantity : {"friction force at 0.001 mm",
                                       "friction force at 0.01 mm",
                                       "dissipated energy"})
      {
        std::vector<double> sizes, values;
        for (const unsigned int n : {160, 320, 640})
          {
            sizes.push_back(1. / n);
            values.push_back(
              point_value(law +
                            Settings{{"Friction/Effects",
                                      with_subloading ?
                                        "subloading, overstress, softening" :
                                        "overstress, softening"},
                                     {"Output/Quantities", quantity}},
                          n));
          }
        const Extrapolation limit = richardson(sizes, values);
        EXPECT_GT(limit.order, with_subloading ? 1.4 : 1.8) << quantity;
        EXPECT_NEAR(values.back() / limit.limit, 1., 1e-4) << quantity;
      }
}



TEST(Refinement, equal_steps_are_equal)
{
  const auto history = point_history(make_parameters(
    {{"Loading/Programme", "press 5.8 MPa in 1 s; slide 1 mm/s for 3 mm"},
     {"Time stepping/Equal steps per statement", "7"}}));
  ASSERT_EQ(history.size(), 14u);
  for (unsigned int i = 0; i < 14; ++i)
    EXPECT_NEAR(history[i].step_size, i < 7 ? 1. / 7. : 3. / 7., 1e-12);
}
