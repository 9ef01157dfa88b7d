// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/numbers.h>

#include <slipstep/diagnosis/outlier.h>
#include <slipstep/utilities/lists.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace SlipStep
{
  namespace
  {
    /// Sums of squares of the slow part of whitened contrasts: waves, and what
    /// a gain would do where friction changes its sign.
    class SlowPart
    {
    public:
      SlowPart(const Contrast &contrast, const Noise &noise)
        : whitener(contrast.series, contrast.level, noise)
      {
        constexpr unsigned int n_waves = 5;
        const Eigen::Index     n       = contrast.series[0].time.size();
        const Eigen::Index     n_rows  = contrast.values.size();
        RowMatrix              columns(n_rows, n_waves + 1);
        for (Eigen::Index i = 0; i < n_rows; ++i)
          {
            for (unsigned int wave = 0; wave < n_waves; ++wave)
              columns(i, wave) =
                std::cos(wave * dealii::numbers::PI * (i % n + 0.5) / n);
            columns(i, n_waves) =
              contrast.series[i / n].friction[i % n] / contrast.level;
          }
        whitener.apply(columns);
        // Constant friction is the first wave once more.
        const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
        basis =
          qr.householderQ() * Eigen::MatrixXd::Identity(n_rows, qr.rank());
      }

      double squares(const Eigen::VectorXd &values) const
      {
        RowMatrix whitened = values;
        whitener.apply(whitened);
        return (basis.transpose() * whitened).squaredNorm();
      }

    private:
      const Whitener  whitener;
      Eigen::MatrixXd basis;
    };



    // By the noise of those that are not suspected.
    Contradiction judge_contrast(const std::vector<Contrast>    &contrasts,
                                 const std::size_t               which,
                                 const std::vector<std::size_t> &suspected,
                                 const Noise                    &prior,
                                 const std::uint64_t             seed)
    {
      constexpr unsigned int n_draws = 2000;

      std::vector<Contrast> others;
      for (std::size_t i = 0; i < contrasts.size(); ++i)
        if (!holds(suspected, i))
          others.push_back(contrasts[i]);
      const NoiseEstimate estimate = estimate_noise(others, prior);
      const Contrast     &contrast = contrasts[which];
      const SlowPart      slow(contrast, estimate.noise);
      const double        observed = slow.squares(contrast.values);
      unsigned int        n_larger = 0;
      std::mt19937_64     random(seed);
      for (unsigned int draw = 0; draw < n_draws; ++draw)
        n_larger += slow.squares(sample_noise(contrast.series,
                                              contrast.level,
                                              estimate.draw(random),
                                              random)) >= observed;
      return {contrast.tests, (n_larger + 1.) / (n_draws + 1.), estimate.noise};
    }
  } // namespace



  double slow_squares(const Contrast &contrast, const Noise &noise)
  {
    return SlowPart(contrast, noise).squares(contrast.values);
  }



  std::optional<Contradiction>
  find_contradiction(const std::vector<Contrast> &contrasts,
                     const Noise                 &present,
                     const Noise                 &prior,
                     const std::uint64_t          seed)
  {
    constexpr double      level      = 0.01;
    constexpr std::size_t n_examined = 2;

    if (contrasts.size() < 3)
      return {};
    // A contradiction is in the present noise, too, but not in it alone: it
    // still is among the largest.
    std::vector<double> squares;
    for (const Contrast &contrast : contrasts)
      squares.push_back(slow_squares(contrast, present));
    std::vector<std::size_t> order(contrasts.size());
    std::iota(order.begin(), order.end(), 0);
    sort(order, [&](const std::size_t a, const std::size_t b) {
      return squares[a] > squares[b];
    });
    Contradiction worst;
    for (std::size_t i = 0; i < n_examined; ++i)
      {
        const Contradiction found =
          judge_contrast(contrasts, order[i], {order[i]}, prior, seed);
        if (found.chance < worst.chance)
          worst = found;
      }
    const double n = contrasts.size();
    if (worst.chance * n <= level)
      return worst;

    // Two hide each other: both, by the noise of those without them. The two
    // largest of many are large by chance, too.
    constexpr double      sure        = 1e-4;
    constexpr std::size_t least_other = 4;
    if (contrasts.size() < least_other + 2)
      return {};
    double largest_chance = 0.;
    for (const std::size_t i : {order[0], order[1]})
      {
        worst = judge_contrast(contrasts, i, {order[0], order[1]}, prior, seed);
        largest_chance = std::max(largest_chance, worst.chance);
      }
    if (std::pow(largest_chance, 2) * n * (n - 1.) / 2. > sure)
      return {};
    return worst;
  }
} // namespace SlipStep
