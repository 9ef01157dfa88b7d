// SPDX-License-Identifier: LGPL-2.1-or-later

// The cases on one contact point against the closed forms of their READMEs.

#include "../solid/block_test_tools.h"

#include <slipstep/experiment/stability.h>

#include <deal.II/base/numbers.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <map>

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  std::vector<SlideSummary> slides(const Parameters &parameters)
  {
    Summary summary;
    summarise_history(point_history(parameters),
                      parse_programme(parameters),
                      summary);
    return summary.slides;
  }

  /// A function that falls from above to below zero is zero here.
  double root(const std::function<double(double)> &function,
              double                               lower,
              double                               upper)
  {
    for (unsigned int i = 0; i < 100; ++i)
      {
        const double middle                     = (lower + upper) / 2.;
        (function(middle) > 0. ? lower : upper) = middle;
      }
    return lower;
  }

  // Of the two laws with healing.
  constexpr double mu_s = 0.0915, mu_k = 0.078;

  /// mu at which softening (kappa, a) and healing (xi, b) balance at a speed.
  double steady_coefficient(const double speed,
                            const double kappa,
                            const double a,
                            const double xi,
                            const double b)
  {
    return root(
      [&](const double mu) {
        return xi * std::expm1(b * (mu_s - mu)) -
               kappa * std::expm1(a * (mu - mu_k)) * speed;
      },
      mu_k,
      mu_s);
  }
} // namespace



TEST(VelocityStep, levels_and_direct_effect)
{
  const Parameters parameters =
    make_parameters({}, "velocity_step/velocity_step.prm");
  const FrictionLaw         law(parameters);
  const auto                result = slides(parameters);
  const std::vector<double> speeds = {1., 10., 100., 10., 1.}; // mm/min
  ASSERT_EQ(result.size(), speeds.size());
  const auto mu = [&](const std::size_t i) {
    return steady_coefficient(speeds[i] / 60., 0.05, 10., 8.3e-4, 10.);
  };
  for (std::size_t i = 0; i < speeds.size(); ++i)
    {
      const double r = law.steady_ratio(speeds[i] / 60.);
      EXPECT_NEAR(result[i].kinetic / (r * mu(i)), 1., 1e-4) << i;
      // Faster: at once the ratio, then the coefficient.
      if (i > 0 && speeds[i] > speeds[i - 1])
        {
          EXPECT_NEAR(result[i].peak / (r * mu(i - 1)), 1., 1e-3) << i;
        }
    }
}



TEST(SlideHoldSlide, peaks_are_those_of_the_healed_coefficient)
{
  for (const double V : {1., 10., 100.})
    {
      const Parameters parameters =
        make_parameters({{"Loading/Speed", std::to_string(V) + " mm/min"}},
                        "slide_hold_slide/slide_hold_slide.prm");
      const FrictionLaw law(parameters);
      const auto        result = slides(parameters);
      ASSERT_EQ(result.size(), 7u);
      const double b = 600., xi = 5e-7;
      const double r   = law.steady_ratio(V / 60.);
      const double mu0 = steady_coefficient(V / 60., 0.05, 10., xi, b);
      double       t   = 1.;
      for (std::size_t i = 1; i < result.size(); ++i, t *= 10.)
        {
          const double healed =
            mu_s + std::log1p(-(1. - std::exp(-b * (mu_s - mu0))) *
                              std::exp(-b * xi * t)) /
                     b;
          EXPECT_NEAR(result[i].kinetic / (r * mu0), 1., 1e-3) << V << " " << t;
          // Until the peak some of it is worn down again: never above.
          EXPECT_LT(result[i].peak / (r * healed), 1. + 1e-5) << V << " " << t;
          EXPECT_GT(result[i].peak / (r * healed), 1. - 1e-3) << V << " " << t;
        }
    }
}



TEST(PressureSweep, friction_over_pressure)
{
  const Parameters parameters =
    make_parameters({}, "pressure_sweep/pressure_sweep.prm");
  const std::vector<double> pressures = {
    0.5, 1., 2., 5., 10., 20., 50., 100., 200.};
  const std::map<std::string, std::function<double(double)>> closed_form = {
    {"constant", [](const double) { return mu_k; }},
    {"pressure exponent",
     [](const double p) { return mu_k * std::pow(p / 5.8, -0.1); }},
    {"shear cap",
     [](const double p) { return 6. / p * std::tanh(mu_k * p / 6.); }},
    {"adhesion", [](const double p) { return mu_k + 0.05 / p; }}};
  const auto variants = parameters.variants();
  ASSERT_EQ(variants.size(), closed_form.size());
  for (const Variant &variant : variants)
    {
      const Parameters  with = parameters.with_variant(variant);
      const FrictionLaw law(with);
      const auto        result = slides(with);
      ASSERT_EQ(result.size(), pressures.size());
      for (std::size_t i = 0; i < result.size(); ++i)
        EXPECT_NEAR(result[i].kinetic,
                    law.steady_ratio(10. / 60.) *
                      closed_form.at(variant.label)(pressures[i]),
                    1e-9)
          << variant.label << " " << pressures[i];
    }
}



TEST(AnisotropicPath, traction_lies_on_the_ellipse)
{
  const Parameters parameters =
    make_parameters({}, "anisotropic_path/anisotropic_path.prm");
  const FrictionLaw law(parameters);
  const Programme   programme = parse_programme(parameters);
  const auto        history   = point_history(parameters);
  unsigned int      n_checked = 0;
  for (const Segment &segment : programme.segments())
    if (segment.end.velocity.norm() > 0.)
      {
        const auto end =
          std::find_if(history.begin(), history.end(), [&](const auto &row) {
            return row.time == segment.end_time;
          });
        ASSERT_NE(end, history.end());
        // V' = P V, f = mu r(|V'|) P V' / |V'|, P = diag(1, rho).
        const double rho = 0.6, x = segment.end.velocity[0],
                     y = rho * segment.end.velocity[1];
        const double f =
          0.1 * law.steady_ratio(std::hypot(x, y)) / std::hypot(x, y);
        EXPECT_NEAR(end->friction, f * x, 1e-8);
        EXPECT_NEAR(end->friction_y, f * rho * y, 1e-8);
        ++n_checked;
      }
  EXPECT_EQ(n_checked, 12u);
}



namespace
{
  /// The load of the spring over the normal load, from a displacement of the
  /// load point on.
  struct Swing
  {
    double highest = 0., lowest = 1., period = 0., fastest = 0.;
  };

  Swing swing(const std::vector<HistoryRow> &history, const double from)
  {
    Swing               result;
    std::vector<double> times;
    for (const HistoryRow &row : history)
      if (row.displacement > from)
        {
          result.highest = std::max(result.highest, row.probes[2]);
          result.lowest  = std::min(result.lowest, row.probes[2]);
          result.fastest = std::max(result.fastest, row.probes[1]);
        }
    const double middle = (result.highest + result.lowest) / 2.;
    for (unsigned int i = 1; i < history.size(); ++i)
      if (history[i].displacement > from && history[i].probes[2] < middle &&
          history[i - 1].probes[2] >= middle)
        times.push_back(history[i].time);
    if (times.size() > 1)
      result.period = (times.back() - times.front()) / (times.size() - 1);
    return result;
  }

  Parameters stick_slip(const std::string &speed, const Settings &more = {})
  {
    return make_parameters(Settings{{"Loading/Speed", speed}} + more,
                           "stick_slip/stick_slip.prm");
  }
} // namespace



// Cycles between two loads that friction holds slip by the same amount each.
TEST(Ratchet, slips_per_cycle_as_the_subloading_surface_says)
{
  const double pi = dealii::numbers::PI, u = 1000.;
  for (const auto &[low, high] :
       {std::make_pair(0.3, 0.9), {0.6, 0.9}, {0., 0.6}, {0.3, 0.6}})
    {
      std::ostringstream programme;
      programme << "press 10 MPa in 1 s; push between " << low << " MPa and "
                << high << " MPa 5 times, 1 s each";
      const auto history =
        point_history(make_parameters({{"Loading/Programme", programme.str()}},
                                      "ratchet/ratchet.prm"));
      double slip = 0.;
      for (const HistoryRow &row : history)
        if (row.time < 3. + 1e-9)
          slip = row.slip;
      const double per_cycle = (history.back().slip - slip) / 3.;
      EXPECT_NEAR(per_cycle,
                  2. / (pi * u) *
                    std::log(std::cos(pi * low / 2.) /
                             std::cos(pi * high / 2.)),
                  1e-3 * per_cycle);
    }
}



// As its README says: the tenth cycle slips less than 1 % of the first.
TEST(Ratchet, shakes_down_with_an_elastic_core)
{
  const Parameters parameters = make_parameters({}, "ratchet/ratchet.prm");
  unsigned int     n_extended = 0;
  for (const Variant &variant : parameters.variants())
    if (variant.label == "0.3 to 0.9 extended")
      {
        ++n_extended;
        std::array<double, 22> slip{}; // at the ends of seconds
        for (const HistoryRow &row :
             point_history(parameters.with_variant(variant)))
          slip[std::lround(std::ceil(row.time - 1e-9))] = row.slip;
        const double first = slip[2] - slip[1], tenth = slip[11] - slip[10];
        EXPECT_GT(tenth, 0.);
        EXPECT_LT(tenth, 0.01 * first);
      }
  EXPECT_EQ(n_extended, 1u);
}



// Jumps, what comes after them, and rests, of both laws of evolution.
TEST(RateAndState, steps_and_rests_follow_the_closed_forms)
{
  const double mu = 0.5, b = 0.025, t_0 = 0.01, D = 0.01;
  struct Phase
  {
    double begin, speed, ageing, slip_law; // [s], [mm/s], states at begin [s]
  };
  const std::vector<Phase> phases = {{101., 0.01, 10., 10.},
                                     {111., 0.001, 1., 1.},
                                     {221., 0.001, 20., 10.},
                                     {521., 0.001, 110., 10.},
                                     {1721., 0.001, 1010., 10.},
                                     {11921., 0.001, 10010., 10.}};
  for (const std::string evolution : {"ageing", "slip_law"})
    {
      const bool       is_ageing = evolution == "ageing";
      const Parameters parameters =
        make_parameters({{"Friction/Effects",
                          "subloading, overstress, " + evolution}},
                        "rate_and_state/rate_and_state.prm");
      const FrictionLaw law(parameters);
      const auto        history = point_history(parameters);
      unsigned int      n_rows  = 0;
      for (std::size_t i = 0; i < phases.size(); ++i)
        {
          const Phase &phase = phases[i];
          const double r     = law.steady_ratio(phase.speed);
          const double end   = i == 0 ? 111. : phase.begin + 100.;
          const double start = is_ageing ? phase.ageing : phase.slip_law;
          const double last  = D / phase.speed;
          double       slip  = 0.;
          for (const HistoryRow &row : history)
            if (row.time < phase.begin + 1e-9)
              slip = row.slip;
            else if (row.time < end + 1e-9 && row.slip - slip > 0.02 * D)
              {
                const double left  = std::exp(-(row.slip - slip) / D);
                const double state = is_ageing ?
                                       last + (start - last) * left :
                                       last * std::pow(start / last, left);
                ASSERT_NEAR(row.friction /
                              (r * mu * (1. + b * std::log1p(state / t_0))),
                            1.,
                            1e-4)
                  << evolution << " at " << row.time;
                ++n_rows;
              }
        }
      EXPECT_GT(n_rows, 100u);
    }
}



TEST(StickSlip, is_an_undamped_swing_about_kinetic_friction)
{
  // Stick from low to high at the speed of the load point, then half a swing of
  // spring and mass about the friction in slip, mu_k r at the middle speed.
  const double k = 1., m = 1e-5, p = 5.;
  for (const auto &[speed, V] :
       {std::make_pair("0.1 mm/s", 0.1), {"1 mm/s", 1.}, {"3 mm/s", 3.}})
    {
      const Parameters  parameters = stick_slip(speed);
      const FrictionLaw law(parameters);
      const Swing       found   = swing(point_history(parameters), 2.);
      const double      half    = (found.highest - found.lowest) / 2.;
      const double      kinetic = 0.2 * law.steady_ratio(found.fastest / 2.);
      const double      period =
        2. * p * half / (k * V) + dealii::numbers::PI * std::sqrt(m / k);
      EXPECT_NEAR((found.highest + found.lowest) / 2. / kinetic, 1., 0.05);
      EXPECT_NEAR(found.period / period, 1., 0.05);
      EXPECT_NEAR(found.fastest / (V + p * half / std::sqrt(k * m)), 1., 0.1);
    }
}



TEST(StickSlip, ends_where_the_machine_is_stiffer_than_critical)
{
  for (const char *speed : {"0.1 mm/s", "1 mm/s", "3 mm/s", "20 mm/s"})
    {
      const Parameters     parameters = stick_slip(speed);
      const FrictionLaw    law(parameters);
      const Machine        machine(parameters);
      dealii::Tensor<1, 2> velocity;
      velocity[0] = parameters.number("Loading/Speed");
      const SteadySliding  sliding(law, velocity, 5.);
      const StabilityLimit limit     = sliding.limit(machine.mass());
      const bool           is_stable = machine.stiffness() > limit.stiffness;
      EXPECT_EQ(is_stable, velocity[0] > 10.) << speed;

      const auto history = point_history(
        stick_slip(speed,
                   {{"Loading/Programme",
                     is_stable ? "press 5 MPa in 1 s; slide for 60 mm" :
                                 "press 5 MPa in 1 s; slide for 5 mm"}}));
      const Swing  found = swing(history, is_stable ? 50. : 3.);
      const double amplitude =
        (found.highest - found.lowest) / sliding.friction();
      if (is_stable)
        EXPECT_LT(amplitude, 1e-2) << speed;
      else
        EXPECT_GT(amplitude, 0.5) << speed;
      // Nothing but the law takes energy out.
      const HistoryRow &end = history.back();
      EXPECT_NEAR(end.external_work,
                  end.stored_energy + end.dissipated_energy,
                  1e-3 * end.external_work);
    }
}
