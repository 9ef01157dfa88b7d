// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_calibration_fit_coordinates_h
#define slipstep_calibration_fit_coordinates_h

#include <slipstep/calibration/campaign.h>

#include <Eigen/Core>

#include <cstddef>
#include <string>
#include <vector>

namespace SlipStep
{
  /// What a fit varies, each between 0 and 1: the scaled values of the
  /// parameters, but of one that must not exceed another
  /// (EffectParameter::at_most) its share of what it may be; where that stays,
  /// the other one's share of what is left for it. The law refuses more, and a
  /// fit that is led there by other coordinates stops beside its optimum. Of
  /// parameters that Calibration/Derived ties nothing is known here.
  ///
  /// All vectors have one entry per parameter of the campaign.
  class FitCoordinates
  {
  public:
    /// @param scaled where parameters that are not free stay
    FitCoordinates(const Campaign                  &campaign,
                   const std::vector<double>       &scaled,
                   const std::vector<unsigned int> &free);

    /// Of these scaled values, or of the nearest that the law allows.
    Eigen::VectorXd of(const std::vector<double> &scaled) const;

    std::vector<double> scaled(const Eigen::VectorXd &coordinates) const;

    /// d scaled / d coordinates
    Eigen::MatrixXd jacobian(const Eigen::VectorXd &coordinates) const;

  private:
    /// A parameter and the one that it must not exceed, both free; this one
    /// exceeds no third.
    struct Pair
    {
      std::size_t lower, upper;
    };

    void add_order(const std::string         &lower,
                   const std::string         &upper,
                   const std::vector<double> &scaled,
                   const std::vector<bool>   &is_free);

    /// Of one that is not the lower of a pair.
    double scaled_alone(const std::size_t i, const double coordinate) const;

    /// What the lower one may be, scaled.
    double most(const Pair &pair, const double scaled_upper) const;

    const Campaign     &campaign;
    std::vector<Pair>   pairs;
    std::vector<double> least, greatest; ///< by what is not free
  };
} // namespace SlipStep

#endif
