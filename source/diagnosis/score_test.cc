// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/score_test.h>
#include <slipstep/utilities/lists.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <utility>

namespace SlipStep
{
  namespace
  {
    // Rounding errs alike wherever friction is alike, as in replicates, and
    // nobody knows where within a step it is.
    Eigen::VectorXd errors_of_rounding(const Comparison &comparison,
                                       std::mt19937_64  &random)
    {
      Eigen::VectorXd result = Eigen::VectorXd::Zero(comparison.n_rows());
      std::uniform_real_distribution<double>                within(-0.5, 0.5);
      std::map<std::pair<std::size_t, std::size_t>, double> places;
      for (const ComparedTest &test : comparison.tests)
        for (std::size_t s = 0; s < test.series.size(); ++s)
          {
            if (test.rounding.kept == 0.)
              continue;
            const auto found = places.try_emplace({test.condition, s});
            if (found.second)
              found.first->second = within(random);
            double *row = &result(test.begin + s * test.n_bins());
            for (const double friction : test.series[s].friction)
              {
                const double steps =
                  friction / test.rounding.step + found.first->second;
                *row++ += test.rounding.kept * test.rounding.step *
                          (std::round(steps) - steps);
              }
          }
      return result;
    }
  } // namespace



  RowMatrix draw_noise(const Comparison    &comparison,
                       const NoiseEstimate &estimate,
                       const unsigned int   n_draws,
                       const std::uint64_t  seed)
  {
    RowMatrix draws(comparison.n_rows(), n_draws);
    side_by_side(n_draws, [&](const std::size_t draw) {
      std::seed_seq   sequence{std::uint64_t(seed), std::uint64_t(draw)};
      std::mt19937_64 random(sequence);
      const Noise     noise = estimate.draw(random);
      for (const ComparedTest &test : comparison.tests)
        draws.block(test.begin, draw, test.size, 1) =
          sample_noise(test.series, test.level, noise, random);
      draws.col(draw) += errors_of_rounding(comparison, random);
    });
    return draws;
  }



  RowMatrix draw_null(const Comparison    &comparison,
                      const NoiseEstimate &estimate,
                      const unsigned int   n_draws,
                      const std::uint64_t  seed)
  {
    RowMatrix draws = draw_noise(comparison, estimate, n_draws, seed);
    comparison.whiten(draws);
    return draws;
  }



  namespace
  {
    // Below this share of its length a direction is what the model's own
    // parameters do already.
    constexpr double least_free_share = 1e-4;

    // The same whenever they are asked for.
    Eigen::MatrixXd normal_draws(const Eigen::Index n_rows,
                                 const Eigen::Index n_draws)
    {
      std::mt19937_64            random(1);
      std::normal_distribution<> normal;
      return Eigen::MatrixXd::NullaryExpr(n_rows, n_draws, [&]() {
        return normal(random);
      });
    }



    /// What the parameters of a model can do to what is simulated.
    class TangentSpace
    {
    public:
      explicit TangentSpace(const Model &model)
        : basis(model.derivatives.householderQr().householderQ() *
                Eigen::MatrixXd::Identity(model.derivatives.rows(),
                                          model.derivatives.cols()))
      {}

      // With rows of zeros for what is believed of the parameters.
      Eigen::MatrixXd without(const RowMatrix &columns) const
      {
        Eigen::MatrixXd result =
          Eigen::MatrixXd::Zero(basis.rows(), columns.cols());
        result.topRows(columns.rows()) = columns;
        // Twice, for round-off.
        for (unsigned int i = 0; i < 2; ++i)
          result -= basis * (basis.transpose() * result).eval();
        return result;
      }

      // What draws of noise have along columns without it: of the products with
      // the columns as they were. What is believed of the parameters errs like
      // noise, too: where tests say little of them, a fit that is off from its
      // start would else be a gap.
      Eigen::MatrixXd products_without(const DirectionSet &set,
                                       const RowMatrix    &null_draws) const
      {
        const Eigen::Index    n_beliefs = basis.rows() - null_draws.rows();
        const Eigen::MatrixXd top       = basis.topRows(null_draws.rows());
        const Eigen::MatrixXd along =
          top.transpose() * null_draws +
          basis.bottomRows(n_beliefs).transpose() *
            normal_draws(n_beliefs, null_draws.cols());
        return set.products -
               (top.transpose() * set.whitened).transpose() * along;
      }

    private:
      const Eigen::MatrixXd basis;
    };



    // Chance of a sum of squares as large, its mean without cause and its
    // scatter.
    struct SquareSum
    {
      double mean = 0., deviation = 0.;
      double p = 1.;
    };

    // @param parts of the draws along orthonormal directions
    SquareSum compare_squares(const Eigen::MatrixXd &parts,
                              const double           observed)
    {
      std::vector<double> sums;
      for (Eigen::Index draw = 0; draw < parts.cols(); ++draw)
        sums.push_back(parts.col(draw).squaredNorm());
      std::sort(sums.begin(), sums.end());
      const Eigen::Map<const Eigen::ArrayXd> all(sums.data(), sums.size());
      const double                           mean = all.mean();
      return {mean,
              std::sqrt((all - mean).square().mean()),
              share_above(sums, observed)};
    }



    // Mixtures of columns of length one (or none) that are orthonormal, of full
    // rank only.
    Eigen::MatrixXd orthonormal_mixtures(const Eigen::MatrixXd &columns)
    {
      // By the eigenvectors of the small matrix; cheaper than pivoting.
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(
        columns.transpose() * columns);
      Eigen::Index n = 0;
      while (n < columns.cols() &&
             eigen.eigenvalues()(columns.cols() - 1 - n) > 1e-6)
        ++n;
      return eigen.eigenvectors().rightCols(n) * eigen.eigenvalues()
                                                   .tail(n)
                                                   .cwiseSqrt()
                                                   .cwiseInverse()
                                                   .asDiagonal();
    }
  } // namespace



  DirectionSet::DirectionSet(const Comparison             &comparison,
                             const RowMatrix              &null_draws,
                             const std::vector<Direction> &directions)
    : directions(directions)
    , whitened(comparison.n_rows(), directions.size())
  {
    if (directions.empty())
      return;
    for (std::size_t i = 0; i < directions.size(); ++i)
      whitened.col(i) = directions[i].friction;
    comparison.whiten(whitened);
    products = whitened.transpose() * null_draws;
  }



  DirectionSet DirectionSet::with(const DirectionSet &others) const
  {
    if (directions.empty() || others.directions.empty())
      return directions.empty() ? others : *this;
    DirectionSet both;
    both.directions = directions;
    both.directions.insert(both.directions.end(),
                           others.directions.begin(),
                           others.directions.end());
    both.whitened.resize(whitened.rows(), both.directions.size());
    both.whitened << whitened, others.whitened;
    both.products.resize(both.directions.size(), products.cols());
    both.products << products, others.products;
    return both;
  }



  ScoreTest::ScoreTest(const Comparison             &comparison,
                       const Model                  &model,
                       const RowMatrix              &null_draws,
                       const std::vector<Direction> &directions)
    : ScoreTest(model,
                null_draws,
                DirectionSet(comparison, null_draws, directions))
  {}



  ScoreTest::ScoreTest(const Model        &model,
                       const RowMatrix    &null_draws,
                       const DirectionSet &set)
    : residual(model.residual)
  {
    const std::vector<Direction> &directions = set.directions;
    const TangentSpace            tangents(model);
    columns    = tangents.without(set.whitened);
    null_parts = tangents.products_without(set, null_draws);
    scores.resize(directions.size());
    for (std::size_t i = 0; i < directions.size(); ++i)
      {
        scores[i].free_length = columns.col(i).norm();
        if (scores[i].free_length >
            least_free_share * set.whitened.col(i).norm())
          {
            columns.col(i) /= scores[i].free_length;
            null_parts.row(i) /= scores[i].free_length;
          }
        else
          {
            scores[i].free_length = 0.;
            columns.col(i).setZero();
            null_parts.row(i).setZero();
          }
      }

    const Eigen::MatrixXd &parts = null_parts;
    const Eigen::VectorXd  deviations =
      (parts.rowwise().squaredNorm() / parts.cols()).cwiseSqrt().cwiseMax(0.5);
    const Eigen::VectorXd observed = columns.transpose() * residual;
    const auto standard = [&](const std::size_t i, const double part) {
      const double value = part / deviations(i);
      return directions[i].is_one_sided ? std::max(value, 0.) : std::abs(value);
    };
    for (std::size_t i = 0; i < directions.size(); ++i)
      {
        scores[i].value     = standard(i, observed(i));
        scores[i].deviation = deviations(i);
        scores[i].strength =
          scores[i].free_length > 0. ? observed(i) / scores[i].free_length : 0.;
      }
    for (Eigen::Index draw = 0; draw < parts.cols(); ++draw)
      {
        double value = 0.;
        for (std::size_t i = 0; i < directions.size(); ++i)
          value = std::max(value, standard(i, parts(i, draw)));
        largest.push_back(value);
      }
    std::sort(largest.begin(), largest.end());
  }



  double ScoreTest::family_p(const double value) const
  {
    return share_above(largest, value);
  }



  ScoreTest::Together ScoreTest::together() const
  {
    const Eigen::MatrixXd mixtures = orthonormal_mixtures(columns);
    Together              result;
    const Eigen::VectorXd parts =
      mixtures.transpose() * (columns.transpose() * residual);
    result.gain      = parts.squaredNorm();
    result.explained = columns * (mixtures * parts);
    const SquareSum chance =
      compare_squares(mixtures.transpose() * null_parts, result.gain);
    result.excess  = std::max(0., result.gain - chance.mean);
    result.scatter = chance.deviation;
    result.p       = chance.p;
    return result;
  }



  namespace
  {
    /// Least squares of two directions of length one.
    struct TwoStrengths
    {
      double first = 0., second = 0., gain = 0.;

      // Nothing where physics forbids a sign: then one alone does it.
      TwoStrengths(const double     a,
                   const double     b,
                   const double     cosine,
                   const Direction &of_a,
                   const Direction &of_b)
      {
        const double free  = 1. - cosine * cosine;
        const double own_a = (a - cosine * b) / free;
        const double own_b = (b - cosine * a) / free;
        if ((of_a.is_one_sided && own_a < 0.) ||
            (of_b.is_one_sided && own_b < 0.))
          return;
        first  = own_a;
        second = own_b;
        gain   = a * own_a + b * own_b;
      }
    };
  } // namespace



  std::vector<ScoreTest::Pair> ScoreTest::pairs(
    const std::vector<Direction>                           &directions,
    const std::function<Pairing(std::size_t, std::size_t)> &pairing) const
  {
    constexpr double nearly_opposite = 0.8, the_same = 0.9995;

    const Eigen::MatrixXd cosines  = columns.transpose() * columns;
    const Eigen::VectorXd observed = columns.transpose() * residual;
    Eigen::VectorXd       most     = Eigen::VectorXd::Zero(null_parts.cols());
    std::vector<Pair>     result;
    for (std::size_t i = 0; i < directions.size(); ++i)
      for (std::size_t j = i + 1; j < directions.size(); ++j)
        {
          const double  cosine = cosines(i, j);
          const Pairing when   = pairing(i, j);
          const bool    is_free =
            !directions[i].is_one_sided || !directions[j].is_one_sided;
          const bool are_opposed =
            (is_free ? -std::abs(cosine) : cosine) < -nearly_opposite;
          if (directions[i].candidate == directions[j].candidate ||
              scores[i].free_length == 0. || scores[j].free_length == 0. ||
              std::abs(cosine) > the_same || when == Pairing::never ||
              (when == Pairing::if_opposed && !are_opposed))
            continue;
          const auto of = [&](const double a, const double b) {
            return TwoStrengths(a, b, cosine, directions[i], directions[j]);
          };
          Eigen::VectorXd null(null_parts.cols());
          for (Eigen::Index draw = 0; draw < null.size(); ++draw)
            null(draw) = of(null_parts(i, draw), null_parts(j, draw)).gain;
          const double scale      = std::max(0.5, null.mean());
          most                    = most.cwiseMax(null / scale);
          const TwoStrengths here = of(observed(i), observed(j));
          if (here.gain > 0.)
            result.push_back({i,
                              j,
                              here.first / scores[i].free_length,
                              here.second / scores[j].free_length,
                              here.gain,
                              here.gain / scale,
                              1.});
        }
    std::vector<double> sorted(most.data(), most.data() + most.size());
    std::sort(sorted.begin(), sorted.end());
    for (Pair &pair : result)
      pair.p = share_above(sorted, pair.value);
    sort(result, [](const Pair &a, const Pair &b) { return a.gain > b.gain; });
    return result;
  }



  Eigen::VectorXd ScoreTest::mixture(const double smoothness) const
  {
    const Eigen::Index n = columns.cols();
    Eigen::MatrixXd    own(columns.rows(), n);
    for (Eigen::Index i = 0; i < n; ++i)
      own.col(i) = columns.col(i) * scores[i].free_length;
    Eigen::MatrixXd matrix = own.transpose() * own;
    const double    size   = matrix.trace() / n;
    matrix.diagonal().array() += 1e-6 * size;
    for (Eigen::Index i = 1; i + 1 < n; ++i)
      {
        Eigen::VectorXd second = Eigen::VectorXd::Zero(n);
        second(i - 1) = second(i + 1) = 1.;
        second(i)                     = -2.;
        matrix += smoothness * size * second * second.transpose();
      }
    return matrix.ldlt().solve(own.transpose() * residual);
  }



  double share_above(const std::vector<double> &sorted, const double value)
  {
    const auto n =
      sorted.end() - std::lower_bound(sorted.begin(), sorted.end(), value);
    return (n + 1.) / (sorted.size() + 1.);
  }
} // namespace SlipStep
