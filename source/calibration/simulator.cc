// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/parallel.h>

#include <slipstep/calibration/simulator.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/process.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>

namespace SlipStep
{
  namespace
  {
    /// One simulation, for all tests of its motion; where their order matters
    /// one for each, by the same steps.
    class Simulation
    {
    public:
      Simulation(const Replay      &motion,
                 const FrictionLaw &law,
                 const Machine     &machine)
        : replay(motion)
        , law(law)
        , machine(machine)
        , heeds_order(effect_of_order(law.effects()) != nullptr)
      {
        replay.simulate(law, machine, curve);
      }

      Replay::Curve at_rows(const CampaignTest &test)
      {
        if (heeds_order && test.replay.order != replay.order)
          {
            replay.order = test.replay.order;
            replay.simulate(law, machine, curve);
          }
        Replay::Curve result;
        result.friction = replay.at(curve.friction, test.rows.time);
        if (!test.rows.friction_y.empty())
          result.friction_y = replay.at(curve.friction_y, test.rows.time);
        return result;
      }

    private:
      Replay             replay;
      const FrictionLaw &law;
      const Machine     &machine;
      const bool         heeds_order;
      Replay::Curve      curve;
    };



    void plan_test(Replay             &replay,
                   const CampaignTest &test,
                   const FrictionLaw  &law,
                   const Machine      &machine,
                   const double        tolerance,
                   const std::size_t   most_steps = Replay::most_steps)
    {
      try
        {
          replay.plan(law, machine, tolerance, most_steps);
        }
      catch (const RunError &error)
        {
          throw RunError(test.rows.file.string() +
                         " cannot be simulated: " + error.what());
        }
    }



    // y = y + factor x
    void add(const double               factor,
             const std::vector<double> &x,
             std::vector<double>       &y)
    {
      for (std::size_t i = 0; i < x.size(); ++i)
        y[i] += factor * x[i];
    }



    void add(const double factor, const Replay::Curve &x, Replay::Curve &y)
    {
      add(factor, x.friction, y.friction);
      add(factor, x.friction_y, y.friction_y);
    }
  } // namespace



  void throw_if_stopped()
  {
    if (SignalGuard::caught() != 0)
      throw RunError(SignalGuard::in_words() + "; nothing was written");
  }



  void side_by_side(const std::size_t                             n,
                    const std::function<void(const std::size_t)> &work)
  {
    dealii::parallel::apply_to_subranges(
      std::size_t(0),
      n,
      [&](const std::size_t begin, const std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
          {
            throw_if_stopped();
            try
              {
                work(i);
              }
            catch (const RunError &)
              {
                // A signal is no trouble of the test that it met.
                throw_if_stopped();
                throw;
              }
          }
      },
      1);
  }



  Simulator::Simulator(const Campaign &campaign)
    : campaign(campaign)
    , parameters(campaign.parameters)
  {
    for (std::size_t i = 0; i < campaign.tests.size(); ++i)
      {
        const Replay     &own = campaign.tests[i].replay;
        const std::size_t motion =
          std::find_if(replays.begin(),
                       replays.end(),
                       [&](const Replay &other) {
                         return own.has_motion_of(other);
                       }) -
          replays.begin();
        if (motion == replays.size())
          {
            replays.push_back(own);
            tests_of.emplace_back();
          }
        tests_of[motion].push_back(i);
      }
  }



  const Parameters &Simulator::with(const std::vector<double> &scaled)
  {
    for (std::size_t i = 0; i < scaled.size(); ++i)
      {
        const FitParameter &parameter = campaign.fitted[i];
        parameters.set(parameter.path,
                       parameter.text(parameter.from_scaled(scaled[i]), 17),
                       "calibration");
      }
    apply_ties(campaign.derived, parameters);
    return parameters;
  }



  namespace
  {
    // "calibration: path = value: must not ... (1.23)" without the numbers.
    std::string condition_in(const std::string &refusal)
    {
      const std::size_t begin =
        std::min(refusal.find(": ") + 2, refusal.size());
      const std::size_t sign  = refusal.find(" = ", begin);
      const std::size_t value = refusal.find(": ", sign);
      if (sign == std::string::npos || value == std::string::npos)
        return refusal;
      std::string       why  = refusal.substr(value + 2);
      const std::size_t open = why.find(" ("), close = why.find(')');
      if (open < close && close != std::string::npos)
        why.erase(open, close + 1 - open);
      return refusal.substr(begin, sign - begin) + " " + why;
    }
  } // namespace



  std::string Simulator::condition_beside(const std::vector<double> &scaled,
                                          const std::size_t          parameter,
                                          const double               direction)
  {
    constexpr double beside = 1e-4;

    std::vector<double> other = scaled;
    other[parameter] += direction * beside;
    try
      {
        const FrictionLaw law(with(other));
      }
    catch (const InputError &error)
      {
        return condition_in(error.what());
      }
    return "";
  }



  void Simulator::plan(const std::vector<double> &scaled, const Simulator *like)
  {
    // Where sliding jumps in every row, steps get as short as they may: a fit
    // to such a law would take hours.
    constexpr std::size_t times_more = 5, least = 500, per_row = 20,
                          of_any = 10000;

    const FrictionLaw law(with(scaled));
    const Machine     machine(parameters);
    corrections.clear();
    side_by_side(replays.size(), [&](const std::size_t i) {
      plan_test(replays[i],
                campaign.tests[tests_of[i].front()],
                law,
                machine,
                campaign.search_tolerance,
                like == nullptr ?
                  of_any +
                    per_row *
                      campaign.tests[tests_of[i].front()].rows.time.size() :
                  least + times_more * like->replays[i].n_steps());
    });
    ++n_done;
  }



  Replay::Curve Simulator::simulate(const std::vector<double> &scaled,
                                    const std::size_t          test)
  {
    const auto is_of_test = [&](const std::vector<std::size_t> &tests) {
      return holds(tests, test);
    };
    const std::size_t motion =
      std::find_if(tests_of.begin(), tests_of.end(), is_of_test) -
      tests_of.begin();
    const FrictionLaw law(with(scaled));
    Replay::Curve curve = Simulation(replays[motion], law, Machine(parameters))
                            .at_rows(campaign.tests[test]);
    if (!corrections.empty())
      add(1., corrections[test], curve);
    return curve;
  }



  // Richardson's extrapolation from fine steps and halved fine steps.
  void Simulator::correct(const std::vector<double> &scaled)
  {
    // Of the tolerance of the search; what Richardson leaves of it is of higher
    // order.
    constexpr double share = 0.02;

    const FrictionLaw law(with(scaled));
    const Machine     machine(parameters);
    // The steps shrink with the root of the tolerance.
    const double times_more = 10. / std::sqrt(share);
    corrections.clear();
    std::vector<Replay::Curve> found(campaign.tests.size());
    side_by_side(replays.size(), [&](const std::size_t i) {
      Replay fine = replays[i];
      plan_test(fine,
                campaign.tests[tests_of[i].front()],
                law,
                machine,
                share * campaign.search_tolerance,
                static_cast<std::size_t>(times_more *
                                         (100. + replays[i].n_steps())));
      const Replay halved = fine.halved();
      Simulation   by_halved(halved, law, machine);
      Simulation   by_fine(fine, law, machine);
      Simulation   planned(replays[i], law, machine);
      for (const std::size_t t : tests_of[i])
        {
          const CampaignTest &test = campaign.tests[t];
          found[t]                 = by_halved.at_rows(test);
          // Of second order: (4 halved - fine) / 3.
          add(1. / 3., found[t], found[t]);
          add(-1. / 3., by_fine.at_rows(test), found[t]);
          add(-1., planned.at_rows(test), found[t]);
        }
    });
    corrections = std::move(found);
    ++n_done;
  }



  void Simulator::correct_by(Simulator                 &reference,
                             const std::vector<double> &reference_scaled)
  {
    Assert(tests_of == reference.tests_of,
           dealii::ExcMessage("The simulators are of different tests."));
    subtract(reference.with(reference_scaled));
    const FrictionLaw law(reference.parameters);
    const Machine     machine(reference.parameters);
    side_by_side(replays.size(), [&](const std::size_t i) {
      Simulation there(reference.replays[i], law, machine);
      for (const std::size_t t : tests_of[i])
        {
          add(1., there.at_rows(campaign.tests[t]), corrections[t]);
          if (!reference.corrections.empty())
            add(1., reference.corrections[t], corrections[t]);
        }
    });
    ++n_done;
  }



  void Simulator::subtract(const Parameters &other)
  {
    const FrictionLaw law(other);
    const Machine     machine(other);
    corrections.resize(campaign.tests.size());
    side_by_side(replays.size(), [&](const std::size_t i) {
      Simulation here(replays[i], law, machine);
      for (const std::size_t t : tests_of[i])
        {
          corrections[t] = here.at_rows(campaign.tests[t]);
          add(-2., corrections[t], corrections[t]);
        }
    });
    ++n_done;
  }



  // With what correct() found.
  void Simulator::weigh(Replay::Curve     curve,
                        const std::size_t number,
                        double           *result) const
  {
    const CampaignTest &test = campaign.tests[number];
    if (!corrections.empty())
      add(1., corrections[number], curve);
    add(-1., test.rows.friction, curve.friction);
    add(-1., test.rows.friction_y, curve.friction_y);
    for (const FrictionAxis &axis : test.axes)
      for (const double difference : axis.of(curve.friction, curve.friction_y))
        *result++ = difference / axis.noise;
  }



  void Simulator::residuals(const std::vector<double> &scaled, double *result)
  {
    const FrictionLaw     law(with(scaled));
    const Machine         machine(parameters);
    std::vector<double *> place;
    for (const CampaignTest &test : campaign.tests)
      {
        place.push_back(result);
        result += test.n_residuals();
      }
    const auto is_compared = [&](const std::size_t test) {
      return is_left_out.empty() || !is_left_out[test];
    };
    side_by_side(replays.size(), [&](const std::size_t i) {
      const std::vector<std::size_t> &own = tests_of[i];
      std::optional<Simulation>       simulation;
      if (any_of(own, is_compared))
        simulation.emplace(replays[i], law, machine);
      for (const std::size_t t : own)
        if (is_compared(t))
          weigh(simulation->at_rows(campaign.tests[t]), t, place[t]);
        else
          std::fill_n(place[t], campaign.tests[t].n_residuals(), 0.);
    });
    ++n_done;
  }



  double Simulator::misfit(const std::vector<double> &scaled)
  {
    std::vector<double> values(campaign.n_residuals());
    residuals(scaled, values.data());
    return std::inner_product(values.begin(), values.end(), values.begin(), 0.);
  }



  // To the side where there is room and the law takes the values.
  void Simulator::derivatives(const std::vector<double>       &scaled,
                              const std::vector<unsigned int> &columns,
                              const double                    *at,
                              double                          *result)
  {
    constexpr double  difference = 1e-5;
    const std::size_t n          = campaign.n_residuals();
    shifted.resize(n);
    const auto shift = [&](const unsigned int column, const double step) {
      std::vector<double> other = scaled;
      other[column] += step;
      residuals(other, shifted.data());
    };
    for (std::size_t c = 0; c < columns.size(); ++c)
      {
        double step =
          scaled[columns[c]] + difference > 1. ? -difference : difference;
        try
          {
            shift(columns[c], step);
          }
        catch (const InputError &)
          {
            step = -step;
            shift(columns[c], step);
          }
        for (std::size_t row = 0; row < n; ++row)
          result[row * columns.size() + c] = (shifted[row] - at[row]) / step;
      }
  }



  std::size_t Simulator::n_steps() const
  {
    return std::accumulate(replays.begin(),
                           replays.end(),
                           std::size_t(0),
                           [](const std::size_t sum, const Replay &replay) {
                             return sum + replay.n_steps();
                           });
  }
} // namespace SlipStep
