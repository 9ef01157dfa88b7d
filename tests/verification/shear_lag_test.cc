// SPDX-License-Identifier: LGPL-2.1-or-later

// The shear-lag strip: the shipped case against its closed form.

#include "../solid/block_test_tools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  // A strip of length L and height h whose displacement u(x) is the same over
  // the height, pulled at x = L. The plane holds it by springs k_t that slip at
  // the traction tau:
  //   E h u'' = k_t u  in 0 < x < L - l     (stick)
  //   E h u'' = tau    in L - l < x < L     (slip),   k_t u(L - l) = tau.
  // All forces are per width. The slip length l is the parameter of the curve.
  struct ShearLagStrip
  {
    double young_modulus, height, length, stiffness, limit;

    struct State
    {
      double slip_length  = 0.; // l [mm]
      double displacement = 0.; // of the pulled end [mm]
      double force        = 0.; // [N/mm]
      double dissipated   = 0.; // since the unloaded strip [N]
    };

    // Lambda
    double decay_length() const
    {
      return std::sqrt(young_modulus * height / stiffness);
    }

    double tension_at_front(const double l) const
    {
      const double Lambda = decay_length();
      return limit * Lambda * std::tanh((length - l) / Lambda);
    }

    State at_slip_length(const double l) const
    {
      const double Eh = young_modulus * height, N = tension_at_front(l);
      State        state;
      state.slip_length  = l;
      state.force        = limit * l + N;
      state.displacement = limit / stiffness + (N + limit * l / 2.) * l / Eh;
      // tau times the integral of the slip (N xi + tau xi^2 / 2) / (E h).
      state.dissipated = limit * (N / 2. + limit * l / 6.) * l * l / Eh;
      return state;
    }

    // Pulled for the first time, by u >= 0.
    State first_loading(const double u) const
    {
      const State begin = at_slip_length(0.);
      if (u <= begin.displacement)
        {
          State state;
          state.displacement = u;
          state.force        = begin.force * u / begin.displacement;
          return state;
        }
      double lower = 0., upper = length;
      while (upper - lower > 1e-14 * length)
        {
          const double l = (lower + upper) / 2.;
          (at_slip_length(l).displacement < u ? lower : upper) = l;
        }
      return at_slip_length(lower);
    }

    // Masing's rule, here exact: what changes after a reversal at +-u_m obeys
    // the equations of the first loading with springs that slip at 2 tau, as
    // long as the new slip stays within the old, that is while |u| <= |u_m|.
    // The slip length is that of the new slip, the dissipation since u_m.
    State after_reversal(const double u_m, const double u) const
    {
      State        state = first_loading(std::abs(u - u_m) / 2.);
      const double change =
        first_loading(std::abs(u_m)).force - 2. * state.force;
      state.displacement = u;
      state.force        = std::copysign(1., u_m) * change;
      state.dissipated *= 2.;
      return state;
    }

    // There and back again: each way slips twice as far as the first loading.
    double loop_energy(const double u_m) const
    {
      return 4. * first_loading(u_m).dissipated;
    }
  };

  // The slipping points are those at the limit; the front lies between the last
  // of them and the first that sticks.
  double slip_length(const ContactFace<2> &contact, const double length)
  {
    double slipping = length, sticking = 0.;
    for (const auto &face : contact.cell_faces())
      for (const auto &point : face.points)
        {
          const bool   slips = point.point.trial().loading_ratio > 1. - 1e-9;
          const double x     = point.position[0];
          if (slips)
            slipping = std::min(slipping, x);
          else
            sticking = std::max(sticking, x);
        }
    return length - (slipping + sticking) / 2.;
  }

  ShearLagStrip strip_of(const Parameters &parameters)
  {
    const Programme       programme = parse_programme(parameters);
    const BlockParameters block(parameters, programme);
    const FrictionLaw     law(parameters);
    return {block.young_modulus,
            block.size[1],
            block.size[0],
            law.tangential_stiffness(),
            law.static_coefficient() * programme.largest_pressure()};
  }
} // namespace



TEST(ShearLag, closed_form_conserves_energy)
{
  const ShearLagStrip strip = {206e3, 0.5, 100., 1e3, 0.58};

  // The integral of F du over the way from u_m to -u_m, by the trapezoidal rule
  // in l; the way back adds as much.
  const double u_m = 0.02, F_m = strip.first_loading(u_m).force;
  const double l_m   = strip.first_loading(u_m).slip_length;
  const auto   first = strip.at_slip_length(0.);
  double       work  = 2. * first.displacement * (first.force - F_m);
  auto         last  = first;
  const int    n     = 10000;
  for (int i = 1; i <= n; ++i)
    {
      const auto state = strip.at_slip_length(l_m * i / n);
      work += 2. * (state.displacement - last.displacement) *
              (state.force + last.force - F_m);
      last = state;
    }
  EXPECT_NEAR(2. * work / strip.loop_energy(u_m), 1., 1e-6);
}



TEST(ShearLag, closed_form_without_interface_stiffness)
{
  const ShearLagStrip strip = {206e3, 0.5, 100., 1e12, 0.58};
  const double        Eh = 206e3 * 0.5, tau = 0.58, u_m = 0.02;
  const auto          state = strip.first_loading(u_m);
  const double        F_m   = state.force;
  EXPECT_NEAR(state.slip_length, F_m / tau, 1e-3);
  EXPECT_NEAR(F_m * F_m / (2. * Eh * tau) / u_m, 1., 1e-5);
  EXPECT_NEAR(strip.loop_energy(u_m) /
                (2. * std::pow(F_m, 3) / (3. * Eh * tau)),
              1.,
              1e-5);
  const double F = strip.after_reversal(u_m, 0.005).force;
  EXPECT_NEAR(u_m - std::pow(F_m - F, 2) / (4. * Eh * tau), 0.005, 1e-7);
}



TEST(ShearLag, shipped_case)
{
  const Parameters parameters =
    make_parameters({}, "slip_front/slip_front.prm");
  const ShearLagStrip   strip     = strip_of(parameters);
  const Programme       programme = parse_programme(parameters);
  const BlockParameters block_parameters(parameters, programme);
  const FrictionLaw     law(parameters);
  Block<2>              block(block_parameters,
                 law,
                 programme,
                 StepControl(parameters, programme, law),
                 MPI_COMM_SELF);

  const auto  &segments = programme.segments();
  const double u_m      = segments[1].end.displacement[0];
  const double F_m      = strip.first_loading(u_m).force;
  ASSERT_EQ(segments.size(), 4u);
  ASSERT_LT(strip.first_loading(u_m).slip_length, 0.9 * strip.length);

  std::size_t           segment = 0;
  std::array<double, 4> worst_force{}, worst_front{}, dissipated{}, work{};
  std::array<int, 4>    n_fronts{};
  unsigned long long    most_unknowns = 0;
  block.run(nullptr, [&](const HistoryRow &row) {
    if (segment > 0)
      {
        const auto exact =
          segment == 1 ?
            strip.first_loading(row.displacement) :
            strip.after_reversal(segments[segment - 1].end.displacement[0],
                                 row.displacement);
        // On the first way relative to the present force, which starts at 0.
        const double scale = segment == 1 ? exact.force : F_m;
        worst_force[segment] =
          std::max(worst_force[segment],
                   std::abs(row.tangential_load - exact.force) / scale);
        if (exact.slip_length > 0.25 * strip.length)
          {
            const double front =
              slip_length(block.state().contact_face, strip.length);
            worst_front[segment] =
              std::max(worst_front[segment],
                       std::abs(front / exact.slip_length - 1.));
            ++n_fronts[segment];
          }
      }
    Summary summary;
    block.fill(summary);
    most_unknowns       = std::max(most_unknowns, summary.dofs);
    dissipated[segment] = row.dissipated_energy;
    work[segment]       = row.external_work;
    if (row.time >= segments[segment].end_time)
      ++segment;
  });
  ASSERT_EQ(segment, 4u);

  for (const unsigned int s : {1, 2, 3})
    {
      EXPECT_LT(worst_force[s], 2e-3) << "slide " << s;
      EXPECT_GE(n_fronts[s], 10) << "slide " << s;
      EXPECT_LT(worst_front[s], 0.01) << "slide " << s;
    }
  EXPECT_NEAR(dissipated[1] / strip.first_loading(u_m).dissipated, 1., 2e-3);

  // The loop from u_m over -u_m back to u_m, by slip and by force.
  const double loop = strip.loop_energy(u_m);
  EXPECT_NEAR((dissipated[3] - dissipated[1]) / loop, 1., 5e-3);
  EXPECT_NEAR((work[3] - work[1]) / loop, 1., 5e-3);

  // A uniform mesh of one layer, as fine along the strip, has 2406.
  EXPECT_LT(most_unknowns, 1200u);

  for (const unsigned int s : {1, 2, 3})
    std::cout << "slide " << s << ": force within " << 100. * worst_force[s]
              << " %, front within " << 100. * worst_front[s] << " % ("
              << n_fronts[s] << " steps)\n";
  std::cout << "loop energy " << dissipated[3] - dissipated[1] << " (slip), "
            << work[3] - work[1] << " (force), closed form " << loop
            << " N, at most " << most_unknowns << " unknowns\n";
}
