// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/basis.h>
#include <slipstep/diagnosis/track_waves.h>
#include <slipstep/diagnosis/localisation.h>
#include <slipstep/utilities/lists.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>

namespace SlipStep
{
  namespace
  {
    // Below this share of a test's friction, shares of it are noise.
    constexpr double least_friction = 0.3;

    // Covariates that explain less of the excess are not told.
    constexpr double least_share_told = 0.05;

    using Rows = std::vector<bool>;

    // Where the correction is more than half of its largest, around that; and
    // whether the tests are above or below there, if they agree with it.
    // @return the rows there, or all if it is nowhere
    Rows find_range(const Workspace       &workspace,
                    const Covariate       &covariate,
                    const Eigen::VectorXd &correction,
                    const Eigen::VectorXd &difference,
                    Localisation          &place)
    {
      const Covariates      &covariates = workspace.covariates;
      const Eigen::VectorXd &x          = covariates.*covariate.values;
      Eigen::VectorXd        share      = Eigen::VectorXd::Zero(x.size());
      double                 mean       = 0.;
      Eigen::Index           n = 0, top = -1;
      for (Eigen::Index i = 0; i < x.size(); ++i)
        if (std::abs(covariates.friction(i)) >
              least_friction * workspace.range.typical_friction &&
            (covariate.name != "speed" || x(i) > 0.))
          {
            share(i) = correction(i) / covariates.friction(i);
            mean += share(i);
            ++n;
            if (share(i) != 0.)
              top = i;
          }
      Rows inside(x.size(), true);
      if (top < 0)
        return inside;
      mean /= n;
      // What is the same everywhere is in the coefficients.
      for (Eigen::Index i = 0; i < x.size(); ++i)
        if (share(i) != 0. &&
            std::abs(share(i) - mean) > std::abs(share(top) - mean))
          top = i;
      const int                sign = share(top) > mean ? 1 : -1;
      std::map<double, double> sizes;
      for (Eigen::Index i = 0; i < x.size(); ++i)
        if (share(i) != 0.)
          {
            const double size  = (share(i) - mean) * sign;
            const double value = covariate.shown(x(i));
            double      &known = sizes.emplace(value, size).first->second;
            known              = std::max(known, size);
          }
      std::tie(place.from, place.to) =
        range_around(sizes, covariate.shown(x(top)));
      double measured_above = 0.;
      for (Eigen::Index i = 0; i < x.size(); ++i)
        {
          const double value = covariate.shown(x(i));
          inside[i] =
            share(i) != 0. && value >= place.from && value <= place.to;
          if (inside[i])
            measured_above -= difference(i) / covariates.friction(i);
        }
      place.sign = measured_above * sign > 0. ? sign : 0;
      return inside;
    }



    // The members that hold most of a sum of squares.
    std::vector<std::string>
    largest_members(const std::map<std::string, double> &squares)
    {
      std::vector<std::pair<double, std::string>> sorted;
      double                                      sum = 0.;
      for (const auto &member : squares)
        {
          sorted.emplace_back(-member.second, member.first);
          sum += member.second;
        }
      std::sort(sorted.begin(), sorted.end());
      std::vector<std::string> result;
      double                   so_far = 0.;
      for (const auto &member : sorted)
        {
          if (so_far > 0.7 * sum || result.size() == 4)
            break;
          so_far -= member.first;
          result.push_back(member.second);
        }
      return result;
    }



    // Phases and tests, by what is explained of their rows there.
    void find_members(const Workspace       &workspace,
                      const Eigen::VectorXd &explained,
                      const Rows            &inside,
                      Localisation          &place)
    {
      std::map<std::string, double> by_phase, by_test;
      for (std::size_t t = 0; t < workspace.tests.size(); ++t)
        {
          const ComparedTest &test = workspace.comparison.tests[t];
          for (Eigen::Index i = test.begin; i < test.begin + test.size; ++i)
            {
              if (!inside[i])
                continue;
              const double square = explained(i) * explained(i);
              by_phase[name_of(workspace.covariates.phase[i])] += square;
              by_test[workspace.tests[t].rows.name] += square;
            }
        }
      place.phases = largest_members(by_phase);
      place.tests  = largest_members(by_test);
    }



    // What one covariate explains beyond noise is beyond it, even if all of
    // them, which noise can do much with, explain no more.
    double share_of(const ScoreTest::Together &alone, const GapTest &gap)
    {
      const double all = std::max(alone.excess, gap.excess);
      return all > 0. ? alone.excess / all : 0.;
    }



    // The clearest wave along the track.
    void add_track_wave(const Workspace           &workspace,
                        const Model               &base,
                        const GapTest             &gap,
                        std::vector<Localisation> &result)
    {
      const double wavelength = clear_track_wave(workspace, base).wavelength;
      if (wavelength == 0.)
        return;
      const ScoreTest::Together together =
        ScoreTest(workspace.comparison,
                  base,
                  workspace.null_draws,
                  track_waves(workspace.comparison,
                              workspace.covariates,
                              {wavelength}))
          .together();
      if (!(together.excess > least_share_told * gap.excess))
        return;
      const Covariate &covariate = covariate_called("position");
      Localisation     place;
      place.covariate  = covariate.name;
      place.unit       = covariate.unit;
      place.share      = share_of(together, gap);
      place.wavelength = wavelength;
      find_members(workspace,
                   together.explained,
                   Rows(together.explained.size(), true),
                   place);
      result.push_back(place);
    }
  } // namespace



  std::pair<double, double> range_around(const std::map<double, double> &sizes,
                                         const double                    top)
  {
    const auto   begin     = sizes.find(top);
    const double least     = 0.5 * begin->second;
    const auto   is_inside = [least](const auto &entry) {
      return entry.second >= least;
    };
    const auto last =
      std::find_if_not(std::next(begin), sizes.end(), is_inside);
    const auto first = std::find_if_not(std::make_reverse_iterator(begin),
                                        sizes.rend(),
                                        is_inside);
    return {first.base()->first, std::prev(last)->first};
  }



  std::vector<Localisation>
  localise(const Workspace &workspace, const Model &base, const GapTest &gap)
  {
    const Eigen::VectorXd difference = workspace.comparison.difference(base);
    const std::vector<Direction> basis =
      smooth_basis(workspace.comparison, workspace.covariates);
    std::vector<Localisation> result;
    for (const Covariate &covariate : all_covariates())
      {
        std::vector<Direction> directions;
        for (const Direction &direction : basis)
          if (direction.covariate == covariate.name)
            directions.push_back(direction);
        if (directions.empty())
          continue;
        const ScoreTest           test(workspace.comparison,
                             base,
                             workspace.null_draws,
                             directions);
        const ScoreTest::Together together = test.together();
        if (together.p > workspace.level ||
            !(together.excess > least_share_told * gap.excess))
          continue;
        Localisation place;
        place.covariate                 = covariate.name;
        place.unit                      = covariate.unit;
        place.share                     = share_of(together, gap);
        const Eigen::VectorXd strengths = test.mixture();
        Eigen::VectorXd       correction =
          Eigen::VectorXd::Zero(workspace.comparison.n_rows());
        for (std::size_t i = 0; i < directions.size(); ++i)
          correction += strengths(i) * directions[i].friction;
        Rows inside(workspace.comparison.n_rows(), true);
        // Changes are of either sign, and forgotten on several lengths.
        if (covariate.name.compare(0, 9, "change of") != 0)
          inside =
            find_range(workspace, covariate, correction, difference, place);
        find_members(workspace, together.explained, inside, place);
        result.push_back(place);
      }
    add_track_wave(workspace, base, gap, result);
    stable_sort(result, [](const Localisation &a, const Localisation &b) {
      return a.share > b.share;
    });
    return result;
  }



  namespace
  {
    // Borders of bins with about as many rows each, but none with two levels
    // that tests were made at; or equally wide where most rows would be in one.
    std::vector<double> bin_borders(std::vector<double> values,
                                    const bool          equally_wide)
    {
      constexpr std::size_t most_bins = 14;
      std::sort(values.begin(), values.end());
      std::vector<double> borders;
      if (equally_wide && values.back() > values.front())
        {
          for (std::size_t i = 0; i < most_bins; ++i)
            borders.push_back(values.front() +
                              (values.back() - values.front()) * i / most_bins);
          return borders;
        }
      const double gap = (values.back() - values.front()) / most_bins;
      for (std::size_t i = 0, begun = 0; i < values.size(); ++i)
        {
          bool begins = i > 0 && values[i] > values[i - 1] + gap;
          for (; begun < most_bins &&
                 begun * (values.size() - 1) / most_bins <= i;
               ++begun)
            begins = true;
          if (begins && (borders.empty() ||
                         values[i] > borders.back() * (1. + 1e-3) + 1e-12))
            borders.push_back(values[i]);
        }
      return borders;
    }



    /// Means of the tests, bin by bin.
    struct Bin
    {
      std::map<std::size_t, std::pair<double, double>> by_test; // sum, number
      double                                           x = 0., n = 0.;

      void add(const std::size_t test, const double value)
      {
        by_test[test].first += value;
        by_test[test].second += 1.;
      }

      double mean() const
      {
        double sum = 0., number = 0.;
        for (const auto &entry : by_test)
          {
            sum += entry.second.first;
            number += entry.second.second;
          }
        return sum / number;
      }

      // Of the mean, from how far the tests are apart.
      double deviation(const double of_one_test) const
      {
        const double center = mean();
        double       sum    = 0.;
        for (const auto &entry : by_test)
          sum += std::pow(entry.second.first / entry.second.second - center, 2);
        const double n_tests = by_test.size();
        return std::max(of_one_test / std::sqrt(n_tests),
                        n_tests > 1. ?
                          std::sqrt(sum / (n_tests - 1.) / n_tests) :
                          0.);
      }
    };



    /// Sorts the rows of a campaign into bins along one covariate.
    class PanelMaker
    {
    public:
      PanelMaker(const Workspace       &workspace,
                 const Eigen::VectorXd &difference,
                 const Changes         &changes,
                 const Covariate       &axis)
        : workspace(workspace)
        , covariates(workspace.covariates)
        , difference(difference)
        , changes(changes)
        , axis(axis)
        , x(covariates.*axis.values)
      {}

      // Nothing if the covariate hardly varies.
      CovariatePanel make();

    private:
      bool is_used(const Eigen::Index i) const
      {
        return std::abs(covariates.friction(i)) >
                 least_friction * workspace.range.typical_friction &&
               covariates.speed(i) > 0. && (!axis.is_logarithmic || x(i) > 0.);
      }

      void sort_rows(const std::vector<double> &borders);

      const Workspace              &workspace;
      const Covariates             &covariates;
      const Eigen::VectorXd        &difference;
      const Changes                &changes;
      const Covariate              &axis;
      const Eigen::VectorXd        &x;
      std::vector<Bin>              bins;
      std::vector<std::vector<Bin>> change_bins;
    };



    void PanelMaker::sort_rows(const std::vector<double> &borders)
    {
      bins.assign(borders.size(), Bin());
      change_bins.assign(changes.size(), std::vector<Bin>(borders.size()));
      for (std::size_t t = 0; t < workspace.comparison.tests.size(); ++t)
        {
          const ComparedTest &test = workspace.comparison.tests[t];
          for (Eigen::Index i = test.begin; i < test.begin + test.size; ++i)
            {
              if (!is_used(i))
                continue;
              const double      value = axis.shown(x(i));
              const std::size_t b =
                std::upper_bound(borders.begin(), borders.end(), value) -
                borders.begin() - 1;
              bins[b].add(t, -difference(i) / covariates.friction(i));
              bins[b].x += axis.is_logarithmic ? std::log(value) : value;
              bins[b].n += 1.;
              for (std::size_t c = 0; c < changes.size(); ++c)
                change_bins[c][b].add(t,
                                      changes[c].second(i) /
                                        covariates.friction(i));
            }
        }
    }



    CovariatePanel PanelMaker::make()
    {
      CovariatePanel panel;
      panel.covariate      = axis.name;
      panel.unit           = axis.unit;
      panel.is_logarithmic = axis.is_logarithmic;
      std::vector<double> values;
      for (Eigen::Index i = 0; i < x.size(); ++i)
        if (is_used(i))
          values.push_back(axis.shown(x(i)));
      if (values.empty())
        return panel;
      sort_rows(bin_borders(values, axis.is_rare));
      for (const auto &change : changes)
        panel.signatures.emplace_back(change.first, std::vector<double>());
      const Noise &noise = workspace.comparison.noise();
      for (std::size_t b = 0; b < bins.size(); ++b)
        {
          if (bins[b].by_test.empty())
            continue;
          const double mean_x = bins[b].x / bins[b].n;
          panel.x.push_back(axis.is_logarithmic ? std::exp(mean_x) : mean_x);
          panel.residual.push_back(bins[b].mean());
          panel.error.push_back(
            bins[b].deviation(std::hypot(noise.gain, noise.offset)));
          for (std::size_t c = 0; c < changes.size(); ++c)
            panel.signatures[c].second.push_back(change_bins[c][b].mean());
        }
      return panel;
    }
  } // namespace



  CovariatePanel covariate_panel(const Workspace       &workspace,
                                 const Eigen::VectorXd &difference,
                                 const Changes         &changes,
                                 const Covariate       &covariate)
  {
    return PanelMaker(workspace, difference, changes, covariate).make();
  }



  std::vector<CovariatePanel>
  covariate_panels(const Workspace                 &workspace,
                   const Eigen::VectorXd           &difference,
                   const Changes                   &changes,
                   const std::vector<Localisation> &where)
  {
    std::vector<CovariatePanel> result;
    std::vector<std::string>    names = {
         "speed", "pressure", "path", "slip since start", "rest", "angle"};
    for (const Localisation &place : where)
      if (covariate_called(place.covariate).is_rare)
        names.push_back(place.covariate);
    for (const std::string &name : names)
      {
        CovariatePanel panel = covariate_panel(workspace,
                                               difference,
                                               changes,
                                               covariate_called(name));
        if (panel.x.size() > 1)
          result.push_back(std::move(panel));
      }
    const auto share = [&](const CovariatePanel &panel) {
      for (const Localisation &place : where)
        if (place.covariate == panel.covariate)
          return place.share;
      return 0.;
    };
    stable_sort(result, [&](const CovariatePanel &a, const CovariatePanel &b) {
      return share(a) > share(b);
    });
    return result;
  }
} // namespace SlipStep
