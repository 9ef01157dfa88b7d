// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/calibration/fit_coordinates.h>
#include <slipstep/friction/effect.h>
#include <slipstep/utilities/lists.h>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  namespace
  {
    // Less is none.
    constexpr double least_range = 1e-9;
  } // namespace



  FitCoordinates::FitCoordinates(const Campaign                  &campaign,
                                 const std::vector<double>       &scaled,
                                 const std::vector<unsigned int> &free)
    : campaign(campaign)
    , least(scaled.size(), 0.)
    , greatest(scaled.size(), 1.)
  {
    std::vector<bool> is_free(scaled.size(), false);
    for (const unsigned int i : free)
      is_free[i] = true;
    for (const std::string &effect :
         campaign.parameters.list("Friction/Effects"))
      {
        const EffectInfo &info = effect_registry().at(effect);
        for (const EffectParameter &parameter : info.parameters)
          if (!parameter.at_most.empty())
            add_order(info.section() + parameter.key,
                      parameter.at_most,
                      scaled,
                      is_free);
      }
  }



  void FitCoordinates::add_order(const std::string         &lower,
                                 const std::string         &upper,
                                 const std::vector<double> &scaled,
                                 const std::vector<bool>   &is_free)
  {
    const std::vector<FitParameter> &fitted = campaign.fitted;
    // What is tied is no coordinate: the law may still refuse it.
    if (any_of(campaign.derived, [&](const Derived &derived) {
          return derived.name == lower || derived.name == upper;
        }))
      return;
    const std::size_t i = place_among(fitted, lower);
    const std::size_t j = place_among(fitted, upper);
    const auto value    = [&](const std::size_t n, const std::string &path) {
      return n < fitted.size() ? fitted[n].from_scaled(scaled[n]) :
                                    campaign.parameters.number(path);
    };
    const bool lower_is_free = i < fitted.size() && is_free[i];
    const bool upper_is_free = j < fitted.size() && is_free[j];
    const auto limit         = [](const double most) {
      return std::clamp(most, 0., 1.);
    };
    if (lower_is_free && upper_is_free)
      {
        pairs.push_back({i, j});
        least[j] = limit(fitted[j].to_scaled(fitted[i].lower));
      }
    else if (lower_is_free)
      greatest[i] = limit(fitted[i].to_scaled(value(j, upper)));
    else if (upper_is_free)
      least[j] = limit(fitted[j].to_scaled(value(i, lower)));
  }



  double FitCoordinates::most(const Pair &pair, const double scaled_upper) const
  {
    const double value = campaign.fitted[pair.upper].from_scaled(scaled_upper);
    return std::clamp(campaign.fitted[pair.lower].to_scaled(value), 0., 1.);
  }



  Eigen::VectorXd FitCoordinates::of(const std::vector<double> &scaled) const
  {
    const auto share = [](const double part, const double whole) {
      return std::clamp(part / std::max(whole, least_range), 0., 1.);
    };
    Eigen::VectorXd result(scaled.size());
    for (std::size_t i = 0; i < scaled.size(); ++i)
      result(i) = share(scaled[i] - least[i], greatest[i] - least[i]);
    for (const Pair &pair : pairs)
      result(pair.lower) =
        share(scaled[pair.lower],
              most(pair, scaled_alone(pair.upper, result(pair.upper))));
    return result;
  }



  double FitCoordinates::scaled_alone(const std::size_t i,
                                      const double      coordinate) const
  {
    return least[i] + coordinate * (greatest[i] - least[i]);
  }



  std::vector<double>
  FitCoordinates::scaled(const Eigen::VectorXd &coordinates) const
  {
    std::vector<double> result;
    for (Eigen::Index i = 0; i < coordinates.size(); ++i)
      result.push_back(scaled_alone(i, coordinates(i)));
    for (const Pair &pair : pairs)
      result[pair.lower] =
        coordinates(pair.lower) * most(pair, result[pair.upper]);
    return result;
  }



  namespace
  {
    // d value / d scaled
    double slope(const FitParameter &parameter, const double value)
    {
      return parameter.is_logarithmic ?
               value * std::log(parameter.upper / parameter.lower) :
               parameter.upper - parameter.lower;
    }
  } // namespace



  Eigen::MatrixXd
  FitCoordinates::jacobian(const Eigen::VectorXd &coordinates) const
  {
    // So that it has an inverse, where there is no range, too.
    const auto in_range = [](const double range) {
      return std::max(range, least_range);
    };
    Eigen::MatrixXd result =
      Eigen::MatrixXd::Zero(coordinates.size(), coordinates.size());
    for (Eigen::Index i = 0; i < coordinates.size(); ++i)
      result(i, i) = in_range(greatest[i] - least[i]);
    for (const auto &[i, j] : pairs)
      {
        const FitParameter &lower = campaign.fitted[i],
                           &upper = campaign.fitted[j];
        const double scaled_upper = scaled_alone(j, coordinates(j));
        const double value        = upper.from_scaled(scaled_upper);
        result(i, i)              = in_range(most({i, j}, scaled_upper));
        if (value < lower.upper)
          result(i, j) = coordinates(i) * slope(upper, value) /
                         slope(lower, value) * result(j, j);
      }
    return result;
  }
} // namespace SlipStep
