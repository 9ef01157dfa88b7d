// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/score_test.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <random>

namespace SlipStep
{
  RowMatrix draw_null(const Comparison    &comparison,
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
    });
    comparison.whiten(draws);
    return draws;
  }



  namespace
  {
    // Below this share of its length a direction is what the model's own
    // parameters do already.
    constexpr double least_free_share = 1e-4;

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

    private:
      const Eigen::MatrixXd basis;
    };



    // Chance of a sum of squares as large, and its mean without cause.
    struct SquareSum
    {
      double mean = 0.;
      double p    = 1.;
    };

    SquareSum compare_squares(const Eigen::MatrixXd &orthonormal,
                              const RowMatrix       &null_draws,
                              const double           observed)
    {
      const Eigen::MatrixXd parts =
        orthonormal.topRows(null_draws.rows()).transpose() * null_draws;
      std::vector<double> sums;
      for (Eigen::Index draw = 0; draw < parts.cols(); ++draw)
        sums.push_back(parts.col(draw).squaredNorm());
      std::sort(sums.begin(), sums.end());
      double sum = 0.;
      for (const double value : sums)
        sum += value;
      return {sum / sums.size(), share_above(sums, observed)};
    }



    // Of full rank only.
    Eigen::MatrixXd orthonormal(const Eigen::MatrixXd &columns)
    {
      Eigen::MatrixXd scaled = columns;
      for (Eigen::Index i = 0; i < scaled.cols(); ++i)
        {
          const double length = scaled.col(i).norm();
          if (length > 0.)
            scaled.col(i) /= length;
        }
      // By the eigenvectors of the small matrix; cheaper than pivoting.
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(
        scaled.transpose() * scaled);
      Eigen::Index n = 0;
      while (n < scaled.cols() &&
             eigen.eigenvalues()(scaled.cols() - 1 - n) > 1e-6)
        ++n;
      return scaled * eigen.eigenvectors().rightCols(n) *
             eigen.eigenvalues()
               .tail(n)
               .cwiseSqrt()
               .cwiseInverse()
               .asDiagonal();
    }
  } // namespace



  ScoreTest::ScoreTest(const Comparison             &comparison,
                       const Model                  &model,
                       const RowMatrix              &null_draws,
                       const std::vector<Direction> &directions)
    : residual(model.residual)
    , null_draws(null_draws)
  {
    RowMatrix whitened(comparison.n_rows(), directions.size());
    for (std::size_t i = 0; i < directions.size(); ++i)
      whitened.col(i) = directions[i].friction;
    comparison.whiten(whitened);
    columns = TangentSpace(model).without(whitened);
    scores.resize(directions.size());
    for (std::size_t i = 0; i < directions.size(); ++i)
      {
        scores[i].own_length  = whitened.col(i).norm();
        scores[i].free_length = columns.col(i).norm();
        if (scores[i].free_length > least_free_share * scores[i].own_length)
          columns.col(i) /= scores[i].free_length;
        else
          {
            scores[i].free_length = 0.;
            columns.col(i).setZero();
          }
      }

    const Eigen::MatrixXd parts =
      columns.topRows(comparison.n_rows()).transpose() * null_draws;
    const Eigen::VectorXd deviations =
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



  ScoreTest::Together
  ScoreTest::together(const std::vector<std::size_t> &which) const
  {
    Eigen::MatrixXd chosen = columns;
    if (!which.empty())
      {
        chosen.resize(columns.rows(), which.size());
        for (std::size_t i = 0; i < which.size(); ++i)
          chosen.col(i) = columns.col(which[i]);
      }
    const Eigen::MatrixXd basis = orthonormal(chosen);
    Together              result;
    const Eigen::VectorXd parts = basis.transpose() * residual;
    result.gain                 = parts.squaredNorm();
    result.explained            = basis * parts;
    const SquareSum chance = compare_squares(basis, null_draws, result.gain);
    result.excess          = std::max(0., result.gain - chance.mean);
    result.p               = chance.p;
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
