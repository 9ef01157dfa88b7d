// Load point and contact: a spring in series with the friction law.

#include <slipstep/experiment/point_driver.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "../friction/law_test_tools.h"

using namespace SlipStep;
using namespace SlipStep::Testing;
using dealii::Tensor;

namespace
{
  Parameters make_parameters(const Settings &settings)
  {
    Parameters parameters;
    declare_loading_parameters(parameters);
    FrictionLaw::declare_parameters(parameters);
    for (const auto &setting : settings)
      parameters.set(setting.first, setting.second, "test");
    return parameters;
  }

  std::vector<HistoryRow> drive(const Settings &settings)
  {
    const Parameters        parameters = make_parameters(settings);
    const FrictionLaw       law(parameters);
    const Programme         programme = parse_programme(parameters);
    std::vector<HistoryRow> history;
    drive_point(
      law,
      programme,
      StepControl(parameters, programme, law),
      [&](const HistoryRow &row) { history.push_back(row); },
      Machine(parameters));
    return history;
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
    make_parameters({{"Loading/Machine stiffness", "120"}}));
  ContactPoint                           a(*contact), b(*both);
  std::mt19937                           random(1);
  std::uniform_real_distribution<double> number(-1., 1.);
  for (unsigned int step = 0; step < 3000; ++step)
    {
      const Tensor<1, 2> motion =
        vector(0.01 * number(random), 0.01 * number(random));
      const double pressure = 5. + 2. * number(random);
      machine.update(*contact, a, motion, pressure, 0.1);
      b.update(*both, motion, pressure, 0.1);
      a.commit();
      b.commit();
      ASSERT_NEAR((a.committed().traction - b.committed().traction).norm(),
                  0.,
                  1e-6)
        << step;
    }
}



TEST(Machine, rigid_is_the_law_itself)
{
  const auto   law = make_law({});
  ContactPoint a(*law), b(*law);
  Machine().update(*law, a, vector(1e-3, 2e-4), 5., 0.1);
  b.update(*law, vector(1e-3, 2e-4), 5., 0.1);
  EXPECT_EQ(a.trial().traction, b.trial().traction);
  EXPECT_TRUE(Machine(make_parameters({})).is_rigid());
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
  const Machine machine(make_parameters({{"Loading/Machine stiffness", "40"}}));
  ContactPoint  point(*law);
  std::mt19937  random(1);
  std::uniform_real_distribution<double> number(-1., 1.);
  for (unsigned int step = 0; step < 20000; ++step)
    {
      const Tensor<1, 2> motion = std::pow(10., 2. * number(random) - 3.) *
                                  vector(number(random), number(random));
      const double pressure = 5. + 4. * number(random);
      const double dt       = std::pow(10., 2. * number(random));
      machine.update(*law, point, motion, pressure, dt);

      // The spring and the law agree.
      const Tensor<1, 2> traction = point.trial().traction;
      ContactState       end;
      law->update(point.committed(),
                  machine.contact_slip(motion,
                                       traction - point.committed().traction),
                  pressure,
                  dt,
                  end);
      ASSERT_NEAR((end.traction - traction).norm(), 0., 1e-9) << step;
      point.commit();
    }
}



TEST(Machine, is_checked_when_read)
{
  for (const char *text : {"soft", "0", "-3 MPa/mm", "5 mm"})
    EXPECT_THROW(Machine(
                   make_parameters({{"Loading/Machine stiffness", text}})),
                 InputError)
      << text;
}
