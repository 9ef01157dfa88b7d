// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/measured_data/mains_hum.h>
#include <slipstep/measured_data/test_rows.h>

#include <boost/math/constants/constants.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace SlipStep
{
  namespace
  {
    using Complex = std::complex<double>;

    constexpr double two_pi = boost::math::constants::two_pi<double>();

    /// By chance as high in one series of those with a hum, or in all of them.
    constexpr double rare_in_one = 0.01, rare_in_all = 1e-5;

    /// Of many none tells for all: no chance counts as less.
    constexpr double most_of_one = 1e-3;

    double window_at(const HumSeries &series, const std::size_t row)
    {
      return 0.5 *
             (1. - std::cos(two_pi * (series.time[row] - series.time.front()) /
                            (series.time.back() - series.time.front())));
    }



    Complex
    turn(const HumSeries &series, const std::size_t row, const double frequency)
    {
      return std::polar(1.,
                        -two_pi * frequency *
                          (series.time[row] - series.time.front()));
    }



    // Amplitude and phase of the cosine whose steps are nearest to those of the
    // series.
    Complex amplitude_of(const HumSeries &series, const double frequency)
    {
      // Sums of products of the steps of cosine and minus sine.
      double cc = 0., cs = 0., ss = 0., cy = 0., sy = 0.;
      for (std::size_t i = 1; i < series.time.size(); ++i)
        {
          const Complex unit =
            turn(series, i, frequency) - turn(series, i - 1, frequency);
          const double y      = series.left[i] - series.left[i - 1];
          const double weight = window_at(series, i);
          cc += weight * unit.real() * unit.real();
          cs += weight * unit.real() * unit.imag();
          ss += weight * unit.imag() * unit.imag();
          cy += weight * unit.real() * y;
          sy += weight * unit.imag() * y;
        }
      // Where rows meet every wave twice, one of the two is never seen.
      const double ridge = 1e-3 * (cc + ss);
      cc += ridge;
      ss += ridge;
      const double determinant = cc * ss - cs * cs;
      return {(ss * cy - cs * sy) / determinant,
              (cc * sy - cs * cy) / determinant};
    }



    /// Steps of a series from row to row, seen from a frequency: what is near
    /// to it turns slowly, and is added up in a few hundred blocks. Steps,
    /// since what is smooth or jumps has no slope in their spectrum. Distances
    /// of frequencies are counted in waves per duration.
    class Neighbourhood
    {
    public:
      /// @param values of the series, what is left or another
      /// @param is_seen as it is, not as another one
      Neighbourhood(const HumSeries           &series,
                    const std::vector<double> &values,
                    const double               frequency,
                    const bool                 is_seen = false)
      {
        // The mains keep their frequency within this [Hz]. In a longer record
        // they wander, and are a wave of one frequency no more.
        constexpr double      mains_tolerance = 0.05;
        constexpr double      farthest        = 1.;
        constexpr std::size_t most_blocks     = 256;

        const std::size_t n        = series.time.size();
        const std::size_t n_blocks = std::min(n - 1, most_blocks);
        const double      duration = series.time.back() - series.time.front();
        n_waves                    = is_seen ? frequency * duration : 0.;
        reach   = std::clamp(mains_tolerance * duration, 0.5, farthest);
        weights = 0.;
        for (std::size_t b = 0; b < n_blocks; ++b)
          {
            const std::size_t begin = 1 + b * (n - 1) / n_blocks;
            const std::size_t end   = 1 + (b + 1) * (n - 1) / n_blocks;
            double            at    = 0.;
            Complex           step = 0., constant = 0.;
            for (std::size_t i = begin; i < end; ++i)
              {
                const double  weight = window_at(series, i);
                const Complex turned = weight * turn(series, i, frequency);
                step += turned * (values[i] - values[i - 1]);
                constant += turned;
                weights += weight;
                at += (series.time[i] - series.time.front()) / duration /
                      (end - begin);
              }
            place.push_back(at);
            steps.push_back(step);
            window.push_back(constant);
          }
      }

      /// Whether the rows see the frequency as one or two waves at most, or as
      /// a constant.
      bool is_slow() const
      {
        constexpr double seen = 0.15; // of a constant

        return std::max(std::abs(sum(window, -0.25)),
                        std::abs(sum(window, 0.25))) > seen;
      }

      /// @return chance that a peak near the frequency is as high, and its
      ///   distance from it
      std::pair<double, double> peak() const
      {
        // The median of n exponential numbers scatters as the mean of fewer.
        constexpr int    first = 5, step = 2, n = 10;
        constexpr double n_known = 0.48 * n;

        std::vector<double> neighbours;
        for (int i = 0; i < n / 2; ++i)
          for (const int side : {-1, 1})
            neighbours.push_back(power(side * (first + i * step)));
        double highest = 0., distance = 0.;
        for (double at = -reach; at <= reach; at += 0.5)
          if (power(at) > highest)
            {
              highest  = power(at);
              distance = at;
            }
        const auto best = boost::math::tools::brent_find_minima(
          [&](const double at) { return -power(at); },
          distance - 0.5,
          distance + 0.5,
          12);
        const double usual = median(std::move(neighbours));
        if (!(usual > 0.))
          return {highest > 0. ? 0. : 1., best.first};
        const double chance =
          std::pow(1. + std::log(2.) * power(best.first) / usual / n_known,
                   -n_known);
        return {std::min(1., (1. + 2. * reach) * chance), best.first};
      }

      /// The highest one farther away [waves].
      double highest_beyond() const
      {
        constexpr double nearest = 2.;

        // Of rows, or of blocks of them.
        const double farthest = 0.45 * place.size();
        double       highest = 0., result = nearest;
        for (double at = nearest; at < farthest; at += 0.5)
          if (power(at) / at > highest)
            {
              highest = power(at) / at;
              result  = at;
            }
        return result;
      }

      /// Of the noise of rows the power of steps grows with the square of the
      /// frequency, of a drift it does not: where that is known, it is held
      /// against its first power.
      double power(const double distance) const
      {
        const double from_zero = std::abs(n_waves + distance);
        return std::norm(sum(steps, distance)) /
               (n_waves > 0. ? std::max(from_zero, 1.) : 1.);
      }

    private:
      Complex sum(const std::vector<Complex> &values,
                  const double                distance) const
      {
        Complex result = 0.;
        for (std::size_t b = 0; b < values.size(); ++b)
          result +=
            values[b] * std::polar(1. / weights, -two_pi * distance * place[b]);
        return result;
      }

      std::vector<double>  place;   ///< of the blocks, from 0 to 1
      std::vector<Complex> steps;   ///< times a window
      std::vector<Complex> window;  ///< the same of a constant
      double               n_waves; ///< that rows see; 0 if they may see others
      double               reach;   ///< of the search for a peak
      double               weights; ///< of the window
    };



    // Whether friction has a wave there of which a share is as strong as what
    // is left: so have strokes forth and back at all multiples of their
    // frequency.
    bool is_of_friction(const HumSeries &series,
                        const double     frequency,
                        const double     power_left)
    {
      constexpr double share = 0.2;

      if (series.friction.empty())
        return false;
      const Neighbourhood near(series, series.friction, frequency);
      const auto [chance, distance] = near.peak();
      return chance < rare_in_one &&
             share * share * near.power(distance) > power_left;
    }



    /// Series of about the same speed and the same distance of rows: a wave of
    /// the track looks alike in them.
    using Motion = std::pair<long, long>;



    Motion motion_of(const HumSeries &series)
    {
      constexpr double per_factor_of_e = 30.;

      const double duration = series.time.back() - series.time.front();
      return {std::lround(per_factor_of_e *
                          std::log(duration / series.time.size())),
              series.speed > 0. ?
                std::lround(per_factor_of_e * std::log(series.speed)) :
                0};
    }



    /// One frequency in the series of one motion.
    struct Group
    {
      std::vector<double>  chances;
      bool                 is_seen = false; ///< by rows that are close enough
      std::vector<Complex> phases;          ///< of those that tell
    };



    // Of several such chances together. (R. A. Fisher, Statistical Methods for
    // Research Workers, 1932.)
    double joint_chance(const std::vector<double> &chances)
    {
      double sum = 0.;
      for (const double chance : chances)
        sum -= 2. * std::log(std::max(chance, 1e-300));
      return boost::math::cdf(
        boost::math::complement(boost::math::chi_squared(2. * chances.size()),
                                sum));
    }



    // Whether waves of the same motion begin at the same place, as what the
    // track does to friction: the mean of the cosines of differences of phase.
    bool is_led_by_motion(const std::map<Motion, Group> &groups)
    {
      constexpr double together = 0.7;

      double cosines = 0., n_pairs = 0.;
      for (const auto &[motion, group] : groups)
        {
          Complex sum = 0.;
          for (const Complex &phase : group.phases)
            sum += phase;
          const double n = group.phases.size();
          cosines += 0.5 * (std::norm(sum) - n);
          n_pairs += 0.5 * n * (n - 1.);
        }
      return n_pairs >= 2. && cosines > together * n_pairs;
    }



    // One motion alone would also have one wave of the track: it must be seen
    // as fast as it is, or begin anywhere; and of many none tells for all.
    double chance_of(const std::map<Motion, Group> &groups)
    {
      constexpr std::size_t several = 3; // speeds

      std::vector<double> chances;
      std::set<long>      speeds;
      bool                is_told = false, has_any = false;
      for (const auto &[motion, group] : groups)
        {
          const double chance = joint_chance(group.chances);
          chances.push_back(groups.size() > 1 ? std::max(chance, most_of_one) :
                                                chance);
          if (chance < rare_in_one)
            speeds.insert(motion.second);
          is_told = is_told || group.is_seen || group.phases.size() > 2;
          has_any = has_any || !group.phases.empty();
        }
      if (!has_any || (groups.size() == 1 && !is_told) ||
          (speeds.size() < several && is_led_by_motion(groups)))
        return 1.;
      return joint_chance(chances);
    }



    /// One frequency in all series.
    struct Tried
    {
      std::vector<Hum> hums;
      double           chance = 1.;
    };



    void set_wave(Hum &hum, const Complex &amplitude)
    {
      hum.amplitude = std::abs(amplitude);
      hum.phase     = std::arg(amplitude);
    }



    // A hum that is as strong as in other series is told, too, however faint
    // there; where it is slow, or otherwise, it is only believed to be.
    void compare_with_others(const std::vector<HumSeries> &series,
                             const std::vector<bool>      &are_mute,
                             std::vector<Hum>             &hums)
    {
      constexpr double factor = 2.;

      std::vector<double> shares;
      for (std::size_t i = 0; i < hums.size(); ++i)
        if (hums[i].is_told)
          shares.push_back(hums[i].amplitude / series[i].level);
      const double share = median(std::move(shares));
      for (std::size_t i = 0; i < hums.size(); ++i)
        if (!hums[i].is_told && hums[i].frequency > 0.)
          {
            const double usual = share * series[i].level;
            if (!are_mute[i])
              set_wave(hums[i], amplitude_of(series[i], hums[i].frequency));
            hums[i].is_told = hums[i].amplitude > usual / factor &&
                              hums[i].amplitude < usual * factor;
            if (!hums[i].is_told)
              hums[i].amplitude = usual;
          }
    }



    // One frequency in one series.
    Hum look(const HumSeries         &series,
             const double             frequency,
             std::map<Motion, Group> &groups,
             bool                    &is_mute)
    {
      const Neighbourhood near(series, series.left, frequency);
      Hum                 hum;
      hum.frequency                 = frequency;
      const auto [chance, distance] = near.peak();
      is_mute                       = near.is_slow() ||
                is_of_friction(series, frequency, near.power(distance));
      if (is_mute)
        return hum;
      const double duration = series.time.back() - series.time.front();
      Group       &group    = groups[motion_of(series)];
      group.chances.push_back(chance);
      group.is_seen = 2. * frequency * duration < series.time.size() - 1;
      if (chance < rare_in_one)
        {
          hum.frequency += distance / duration;
          set_wave(hum, amplitude_of(series, hum.frequency));
          hum.is_told = true;
          group.phases.push_back(std::polar(1., hum.phase));
        }
      return hum;
    }



    bool is_long_enough(const HumSeries &series)
    {
      constexpr std::size_t fewest_rows = 32;

      return series.time.size() >= fewest_rows;
    }



    Tried try_frequency(const std::vector<HumSeries> &series,
                        const double                  frequency)
    {
      Tried                   result;
      std::map<Motion, Group> groups;
      std::vector<bool>       are_mute;
      for (const HumSeries &one : series)
        {
          bool is_mute = true;
          result.hums.push_back(is_long_enough(one) ?
                                  look(one, frequency, groups, is_mute) :
                                  Hum());
          are_mute.push_back(is_mute);
        }
      result.chance = chance_of(groups);
      compare_with_others(series, are_mute, result.hums);
      return result;
    }
  } // namespace



  double Hum::at(const double time) const
  {
    return amplitude * std::cos(two_pi * frequency * time + phase);
  }



  namespace
  {
    // Less what a gain makes, by which replicates differ.
    HumSeries without_gain(const HumSeries &series)
    {
      HumSeries    result = series;
      const double n      = series.friction.size();
      double       mean = 0., product = 0., square = 0.;
      for (const double friction : series.friction)
        mean += friction / n;
      for (std::size_t i = 0; i < series.friction.size(); ++i)
        {
          product += (series.friction[i] - mean) * series.left[i];
          square += std::pow(series.friction[i] - mean, 2);
        }
      if (square > 0.)
        for (std::size_t i = 0; i < series.friction.size(); ++i)
          result.left[i] -= product / square * (series.friction[i] - mean);
      return result;
    }



    // Of a peak in one of the differences, and of what is there in all others.
    struct Chances
    {
      double of_own = 1., of_others = 1.;
      bool   is_at_two_speeds = false;
    };

    Chances chances_of(const std::vector<HumSeries> &differences,
                       const std::size_t             own,
                       const double                  frequency)
    {
      constexpr double apart = 1.3; // speeds

      Chances             result;
      std::vector<double> others;
      double slowest = std::numeric_limits<double>::infinity(), fastest = 0.;
      for (std::size_t i = 0; i < differences.size(); ++i)
        {
          const HumSeries    &one = differences[i];
          const Neighbourhood near(one, one.left, frequency, true);
          const Neighbourhood plain(one, one.left, frequency);
          if (near.is_slow() ||
              is_of_friction(one, frequency, plain.power(plain.peak().second)))
            continue;
          const double chance = near.peak().first;
          if (chance < rare_in_one)
            {
              slowest = std::min(slowest, one.speed);
              fastest = std::max(fastest, one.speed);
            }
          if (i == own)
            result.of_own = chance;
          else
            others.push_back(std::max(chance, most_of_one));
        }
      if (others.size() > 1)
        result.of_others = joint_chance(others);
      result.is_at_two_speeds = fastest > apart * slowest;
      return result;
    }
  } // namespace



  std::vector<Hum>
  find_hum_of_replicates(const std::vector<HumSeries> &differences,
                         const std::vector<HumSeries> &series,
                         double                       &at_one_speed)
  {
    constexpr double      rare = 1e-3;
    constexpr std::size_t most = 10; // peaks that are tried

    std::vector<HumSeries> plain;
    for (const HumSeries &difference : differences)
      if (is_long_enough(difference))
        plain.push_back(without_gain(difference));
    double least = rare, best = 0., least_of_one = rare;
    at_one_speed = 0.;
    for (std::size_t i = 0; i < std::min(plain.size(), most); ++i)
      {
        const double frequency =
          Neighbourhood(plain[i], plain[i].left, 0.).highest_beyond() /
          (plain[i].time.back() - plain[i].time.front());
        const Chances chances = chances_of(plain, i, frequency);
        if (!(chances.of_own < rare))
          continue;
        double &smallest = chances.is_at_two_speeds ? least : least_of_one;
        if (chances.of_others < smallest)
          {
            smallest = chances.of_others;
            (chances.is_at_two_speeds ? best : at_one_speed) = frequency;
          }
      }
    return best > 0. ? try_frequency(series, best).hums : std::vector<Hum>();
  }



  std::vector<Hum> find_mains_hum(const std::vector<HumSeries> &series)
  {
    Tried  best;
    double nominal = 0.;
    for (const double frequency : {50., 60., 100., 120.})
      {
        Tried tried = try_frequency(series, frequency);
        if (tried.chance < best.chance)
          {
            best    = std::move(tried);
            nominal = frequency;
          }
      }
    if (best.chance > rare_in_all)
      return {};
    for (Hum &hum : best.hums)
      if (hum.frequency > 0.)
        hum.mains = nominal;
    return best.hums;
  }
} // namespace SlipStep
