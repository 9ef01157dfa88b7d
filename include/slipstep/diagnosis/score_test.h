// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_score_test_h
#define slipstep_diagnosis_score_test_h

#include <slipstep/diagnosis/comparison.h>
#include <slipstep/diagnosis/covariates.h>

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace SlipStep
{
  /// What a campaign in which the model is right would look like: samples of
  /// noise as columns. Each has noise of its own, as plausible as the estimate,
  /// so that the few degrees of freedom of replicates are in the scatter of
  /// everything computed from it.
  RowMatrix draw_noise(const Comparison    &comparison,
                       const NoiseEstimate &estimate,
                       const unsigned int   n_draws,
                       const std::uint64_t  seed);

  /// The same, whitened by the noise that was estimated.
  RowMatrix draw_null(const Comparison    &comparison,
                      const NoiseEstimate &estimate,
                      const unsigned int   n_draws,
                      const std::uint64_t  seed);

  /// A change of the simulated friction, to be held against what is left over.
  struct Direction
  {
    Eigen::VectorXd friction; ///< the change, not whitened
    bool            is_one_sided = false;
    std::string     covariate    = ""; ///< of a column of the smooth basis
    /// Which candidate it is.
    std::size_t candidate = 0;
    std::size_t formula   = 0;
    std::size_t shape     = 0;
  };

  /// Directions with what does not depend on a model: they are whitened, and
  /// multiplied by the draws of noise.
  struct DirectionSet
  {
    std::vector<Direction> directions;
    RowMatrix              whitened; ///< columns
    Eigen::MatrixXd        products; ///< by direction and draw

    DirectionSet() = default;

    DirectionSet(const Comparison             &comparison,
                 const RowMatrix              &null_draws,
                 const std::vector<Direction> &directions);

    /// These and others behind them.
    DirectionSet with(const DirectionSet &others) const;
  };

  /// How well one direction fits the residual.
  struct Score
  {
    /// In standard deviations of the null; 0 for the wrong sign.
    double value = 0.;
    /// Standard deviation of the null along this direction: 1 if the noise
    /// were known.
    double deviation = 1.;
    /// Of the change, by least squares.
    double strength = 0.;
    /// Length of the whitened change without what the model's own parameters
    /// could do.
    double free_length = 0.;
  };

  /// When two directions are seen at once.
  enum class Pairing
  {
    if_opposed, ///< if they nearly cancel each other
    always,
    never
  };

  /// Directions seen from a fitted model, with what chance makes of them.
  class ScoreTest
  {
  public:
    ScoreTest(const Comparison             &comparison,
              const Model                  &model,
              const RowMatrix              &null_draws,
              const std::vector<Direction> &directions);

    ScoreTest(const Model        &model,
              const RowMatrix    &null_draws,
              const DirectionSet &set);

    std::vector<Score> scores;

    /// Chance of a largest score among all directions as large as this value.
    double family_p(const double value) const;

    /// What any mixture of the directions would take off the objective beyond
    /// chance, and the chance of as much.
    struct Together
    {
      double          gain    = 0.; ///< with what chance takes off
      double          excess  = 0.; ///< without
      double          scatter = 0.; ///< of the excess, by chance
      double          p       = 1.;
      Eigen::VectorXd explained; ///< part of the residual, whitened
    };

    Together together() const;

    /// Two directions that nearly cancel each other, seen at once.
    struct Pair
    {
      std::size_t first = 0, second = 0;
      double      first_strength = 0., second_strength = 0.;
      double      gain  = 0.; ///< what both take off the objective
      double      value = 0.; ///< in standard deviations of the null
      double      p     = 1.; ///< chance of such a value among all pairs
    };

    /// Pairs of different candidates, best first.
    std::vector<Pair> pairs(
      const std::vector<Direction>                           &directions,
      const std::function<Pairing(std::size_t, std::size_t)> &pairing) const;

    /// How strong each direction is in the mixture that explains most.
    /// @param smoothness of neighbours, 0 for none: a share of the mean square
    ///   by which second differences are kept small
    Eigen::VectorXd mixture(const double smoothness = 0.) const;

  private:
    Eigen::MatrixXd     columns; ///< whitened, free of the model's, length 1
    Eigen::VectorXd     residual;
    Eigen::MatrixXd     null_parts; ///< of the draws along the columns
    std::vector<double> largest;    ///< of every draw, sorted
  };

  /// Chance of a value as large, by draws in ascending order.
  double share_above(const std::vector<double> &sorted, const double value);
} // namespace SlipStep

#endif
