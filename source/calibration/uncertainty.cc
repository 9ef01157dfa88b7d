// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/calibration/fit.h>
#include <slipstep/calibration/profile_side.h>
#include <slipstep/calibration/row_matrix.h>
#include <slipstep/calibration/uncertainty.h>
#include <slipstep/measured_data/resample.h>
#include <slipstep/measured_data/row_noise.h>

#include <boost/math/distributions/fisher_f.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace SlipStep
{
  namespace
  {
    constexpr double infinite = std::numeric_limits<double>::infinity();



    // dx / d scaled, see Linearisation.
    double natural_size(const FitParameter &parameter, const double scaled)
    {
      if (parameter.is_logarithmic)
        return std::log(parameter.upper / parameter.lower);
      if (parameter.lower * parameter.upper < 0.)
        return 1.;
      const double value = std::abs(parameter.from_scaled(scaled));
      const double range = parameter.upper - parameter.lower;
      return range / std::max(value, 0.01 * range);
    }



    TestMisfit misfit_of(const CampaignTest  &test,
                         const Replay::Curve &curve,
                         const double        *residuals)
    {
      const std::size_t n = test.rows.time.size();
      TestMisfit        result;
      result.name            = test.rows.name;
      result.condition       = test.rows.condition;
      result.file            = test.rows.file.string();
      result.n_rows          = n;
      result.noise           = mean_noise(test.axes);
      result.noise_is_stated = test.noise_is_stated;
      result.rms             = test.root_mean_square(residuals);
      result.mean =
        -test.axes[0].noise * std::accumulate(residuals, residuals + n, 0.) / n;
      MeasuredTest simulated   = test.rows;
      simulated.friction       = curve.friction;
      simulated.friction_y     = curve.friction_y;
      result.measured_work     = frictional_work(test.rows);
      result.simulated_work    = frictional_work(simulated);
      const FrictionAxis &axis = test.axes[0];
      result.time              = test.rows.time;
      result.displacement =
        axis.of(test.rows.displacement, test.rows.displacement_y);
      result.measured  = test.friction(axis);
      result.simulated = axis.of(curve.friction, curve.friction_y);
      result.noise_1   = axis.noise;
      if (test.axes.size() < 2)
        return result;
      const FrictionAxis &second = test.axes[1];
      result.displacement_2 =
        second.of(test.rows.displacement, test.rows.displacement_y);
      result.measured_2  = test.friction(second);
      result.simulated_2 = second.of(curve.friction, curve.friction_y);
      result.noise_2     = second.noise;
      return result;
    }



    // Singular values that are nothing but round-off and the error of
    // differences.
    constexpr double least_singular_value = 1e-7;

    void analyse(Linearisation &result)
    {
      const Eigen::JacobiSVD<Eigen::MatrixXd> svd(result.R,
                                                  Eigen::ComputeFullV);
      const Eigen::Index                      n = result.R.cols();
      result.directions = svd.matrixV().rowwise().reverse();
      result.direction_deviations.resize(n);
      const double largest = svd.singularValues()(0);
      for (Eigen::Index i = 0; i < n; ++i)
        {
          const double value = svd.singularValues()(n - 1 - i);
          result.direction_deviations(i) =
            value > least_singular_value * largest ?
              std::sqrt(result.inflation) / value :
              infinite;
        }

      // Where little is known, the bounds are what is.
      result.bounded_deviations = result.direction_deviations;
      for (Eigen::Index k = 0; k < n; ++k)
        for (Eigen::Index i = 0; i < n; ++i)
          if (result.has_part_in(i, k))
            result.bounded_deviations(k) =
              std::min(result.bounded_deviations(k),
                       result.size[i] / std::abs(result.directions(i, k)));
      const Eigen::MatrixXd scaled_directions =
        result.directions * result.bounded_deviations.asDiagonal();
      const Eigen::MatrixXd covariance =
        scaled_directions * scaled_directions.transpose();
      result.deviations  = covariance.diagonal().cwiseSqrt();
      result.correlation = result.deviations.cwiseInverse().asDiagonal() *
                           covariance *
                           result.deviations.cwiseInverse().asDiagonal();
      result.deviations = result.deviations.cwiseProduct(result.between_tests);
      constexpr double unknown = 1e6;
      for (Eigen::Index k = 0; k < n; ++k)
        for (Eigen::Index i = 0; i < n; ++i)
          if (result.has_part_in(i, k) &&
              result.direction_deviations(k) *
                  std::abs(result.directions(i, k)) >
                unknown)
            result.deviations(i) = infinite;
    }
  } // namespace



  // Estimates of a series of noise scatter by 1 / sqrt(n).
  double correlation_length(const double *values, const std::size_t n)
  {
    if (n < 4)
      return 1.;
    // About 0, which is what residuals should be.
    const auto lagged = [&](const std::size_t lag) {
      return std::inner_product(values + lag, values + n, values, 0.) / n;
    };
    const double variance = lagged(0);
    if (!(variance > 0.))
      return 1.;
    const double significant = 2. / std::sqrt(static_cast<double>(n));
    double       length      = 1.;
    // Far lags count by strides, so that a long record takes no longer.
    std::size_t stride = 1;
    for (std::size_t lag = 1; lag < n / 2; lag += stride)
      {
        const double correlation = lagged(lag) / variance;
        if (correlation < significant)
          break;
        length += 2. * correlation * stride;
        stride = std::max<std::size_t>(1, lag / 10);
      }
    return std::min(length, static_cast<double>(n));
  }



  namespace
  {
    // How many neighbouring rows of every record hang together by its scatter
    // on several scales, which a fit takes less off than off autocorrelations.
    std::vector<double> lengths_by_scatter(const Campaign &campaign,
                                           const double   *residuals)
    {
      // Drifts within a record hang together, too.
      constexpr double drift = 1e-6, drift_time = 0.1;

      RowNoiseFit              fit(drift, drift_time);
      std::vector<std::size_t> n_rows;
      for (const CampaignTest &test : campaign.tests)
        {
          const std::vector<double> &time = test.rows.time;
          std::vector<double>        shares;
          for (const double t : time)
            shares.push_back((t - time.front()) / (time.back() - time.front()));
          for (const FrictionAxis &axis : test.axes)
            {
              fit.add({residuals, residuals + time.size()},
                      shares,
                      1.,
                      1.,
                      typical_friction(test.rows) / axis.noise);
              n_rows.push_back(time.size());
              residuals += time.size();
            }
        }
      const RowNoiseFit::Result found = fit.solve();
      std::vector<double>       lengths;
      for (std::size_t i = 0; i < n_rows.size(); ++i)
        {
          RowNoise unit  = found.records[i];
          unit.deviation = 1.;
          lengths.push_back(n_rows[i] * unit.variance_of_mean(n_rows[i]));
        }
      return lengths;
    }



    // How many rows of rounded friction are off together: those at one level,
    // by the share of the error that means keep.
    double rows_rounded_alike(const CampaignTest &test)
    {
      const std::vector<double> &friction = test.rows.friction;
      const double               n_levels =
        std::set<double>(friction.begin(), friction.end()).size();
      return 1. + std::pow(test.rounding.kept, 2) *
                    (friction.size() / n_levels - 1.);
    }



    // As residuals are: first one axis, then the other.
    Eigen::VectorXd friction_over_noise(const CampaignTest &test)
    {
      Eigen::VectorXd result(test.n_residuals());
      double         *out = result.data();
      for (const FrictionAxis &axis : test.axes)
        for (const double friction : test.friction(axis))
          *out++ = friction / axis.noise;
      return result;
    }



    /// How rows hang together.
    struct RowScatter
    {
      double              inflation   = 1.; ///< see Linearisation
      double              n_effective = 0.;
      std::vector<double> lengths; ///< of every test, the axis with more of it
    };

    RowScatter scatter_of_rows(const Campaign            &campaign,
                               const std::vector<double> &residuals,
                               const std::size_t          n_parameters)
    {
      RowScatter                result;
      const std::vector<double> by_scatter =
        lengths_by_scatter(campaign, residuals.data());
      auto          least = by_scatter.begin();
      const double *part  = residuals.data();
      double        sum = 0., together = 0.;
      for (const CampaignTest &test : campaign.tests)
        {
          // The noise of each axis is its own.
          const std::size_t n_rows = test.rows.time.size();
          result.lengths.push_back(0.);
          for (const double *end = part + test.n_residuals(); part != end;
               part += n_rows)
            {
              // Second differences of few steps are none, or as large as one.
              const bool   is_rounded = test.rounding.kept > 0.;
              const double length =
                std::max(correlation_length(part, n_rows),
                         is_rounded ? rows_rounded_alike(test) : *least);
              ++least;
              const double squares =
                std::inner_product(part, part + n_rows, part, 0.);
              sum += squares;
              together += length * squares;
              // How much rounding errs is known without any rows.
              result.n_effective += is_rounded ? n_rows : n_rows / length;
              result.lengths.back() = std::max(result.lengths.back(), length);
            }
        }
      result.inflation = std::max(1., sum / (residuals.size() - n_parameters)) *
                         (sum > 0. ? together / sum : 1.);
      return result;
    }



    // What tests differ by is in all their rows: without it these tell how far
    // tests may differ by chance.
    std::vector<double> without_gains(const Campaign     &campaign,
                                      std::vector<double> residuals)
    {
      double *begin = residuals.data();
      for (const CampaignTest &test : campaign.tests)
        {
          Eigen::Map<Eigen::VectorXd> part(begin, test.n_residuals());
          const Eigen::VectorXd       friction = friction_over_noise(test);
          const double                squares  = friction.squaredNorm();
          if (squares > 0.)
            part -= friction.dot(part) / squares * friction;
          begin += part.size();
        }
      return residuals;
    }



    /// The parameters of which the tests say something, beside the ones before;
    /// the others stay.
    struct Known
    {
      Known(const RowMatrix &derivatives, const Eigen::MatrixXd &R);

      std::vector<Eigen::Index> indices;
      Eigen::MatrixXd           inverse; ///< R^-1
      RowMatrix                 rows;    ///< J R^-1
    };

    Known::Known(const RowMatrix &derivatives, const Eigen::MatrixXd &R)
    {
      const Eigen::VectorXd diagonal = R.diagonal().cwiseAbs();
      for (Eigen::Index i = 0; i < R.cols(); ++i)
        if (diagonal(i) > least_singular_value * diagonal.maxCoeff())
          indices.push_back(i);
      const Eigen::Index p = indices.size();
      if (p == 0)
        return;
      const Eigen::MatrixXd columns = R(Eigen::all, indices);
      inverse = Eigen::HouseholderQR<Eigen::MatrixXd>(columns)
                  .matrixQR()
                  .topRows(p)
                  .triangularView<Eigen::Upper>()
                  .solve(Eigen::MatrixXd::Identity(p, p));
      rows = derivatives(Eigen::all, indices) * inverse;
    }



    /// What the tests, left out one at a time, move a parameter by.
    struct LeftOutTests
    {
      std::size_t n_told = 0;
      double      factor = 0.; ///< over what rows make of it
    };

    // A jackknife over tests, in units of what the scatter of rows would make
    // of it: without a test with the share H of the information, x moves by
    // (1 - H)^-1 s, of variance (1 - H)^-1 - 1. What one test alone tells is
    // not compared with anything.
    std::vector<LeftOutTests>
    leave_out_tests(const Campaign            &campaign,
                    const Known               &known,
                    const std::vector<double> &residuals,
                    const double               inflation)
    {
      constexpr double least_left = 1e-3, least_share = 1e-4;

      const Eigen::Index        p = known.indices.size();
      std::vector<LeftOutTests> result(p);
      // Not zero where a parameter is at its bound: what all tests ask for
      // alike, each by its share of the information, is no difference.
      const Eigen::VectorXd common =
        known.rows.transpose() *
        Eigen::Map<const Eigen::VectorXd>(residuals.data(), residuals.size());
      Eigen::Index begin = 0;
      for (const CampaignTest &test : campaign.tests)
        {
          const Eigen::Index    n_rows = test.n_residuals();
          const Eigen::MatrixXd J      = known.rows.middleRows(begin, n_rows);
          const Eigen::VectorXd s =
            J.transpose() *
            (Eigen::Map<const Eigen::VectorXd>(residuals.data() + begin,
                                               n_rows) -
             J * common);
          begin += n_rows;
          const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> left(
            Eigen::MatrixXd::Identity(p, p) - J.transpose() * J);
          Eigen::VectorXd move = left.eigenvectors().transpose() * s,
                          variance(p);
          for (Eigen::Index k = 0; k < p; ++k)
            {
              const double share   = left.eigenvalues()(k);
              const bool   is_told = share > least_left;
              move(k)              = is_told ? move(k) / share : 0.;
              variance(k) = is_told ? std::max(0., 1. / share - 1.) : 0.;
            }
          const Eigen::MatrixXd to_x = known.inverse * left.eigenvectors();
          for (Eigen::Index i = 0; i < p; ++i)
            {
              const double expected =
                to_x.row(i).cwiseAbs2().dot(variance.transpose());
              if (expected < least_share * known.inverse.row(i).squaredNorm())
                continue;
              result[i].factor +=
                std::pow(to_x.row(i).dot(move.transpose()), 2) /
                (inflation * expected);
              ++result[i].n_told;
            }
        }
      for (LeftOutTests &parameter : result)
        parameter.factor = std::sqrt(
          parameter.factor / std::max<std::size_t>(1, parameter.n_told));
      return result;
    }



    /// Gains that differ from test to test.
    struct Gains
    {
      double variance = 0.;
      double freedom  = 0.; ///< how many squares tell of it
    };

    // A column per test: by how much the known parameters move, times R, if its
    // friction goes up by these shares of itself.
    template <class Shares>
    Eigen::MatrixXd
    pulls(const Campaign &campaign, const Known &known, const Shares &shares)
    {
      const Eigen::Index n_tests = campaign.tests.size();
      Eigen::MatrixXd    result(known.indices.size(), n_tests);
      Eigen::Index       begin = 0;
      for (Eigen::Index t = 0; t < n_tests; ++t)
        {
          const Eigen::VectorXd change =
            shares(campaign.tests[t])
              .cwiseProduct(friction_over_noise(campaign.tests[t]));
          result.col(t) =
            known.rows.middleRows(begin, change.size()).transpose() * change;
          begin += change.size();
        }
      return result;
    }



    // From nothing in the first row to 1 in the last one, along each axis.
    Eigen::VectorXd drift_shares(const CampaignTest &test)
    {
      const std::vector<double> &time = test.rows.time;
      const Eigen::ArrayXd       along =
        (Eigen::Map<const Eigen::ArrayXd>(time.data(), time.size()) -
         time.front()) /
        (time.back() - time.front());
      return along.matrix().replicate(test.axes.size(), 1);
    }



    // A gain g of its own in every test moves the parameters by G g, and leaves
    // (1 - P) g of itself in the residuals, where rows make gains as well.
    Gains find_gains(const Campaign            &campaign,
                     const Known               &known,
                     const std::vector<double> &residuals,
                     const double               inflation,
                     Eigen::MatrixXd           &moves)
    {
      const Eigen::Index n_tests = campaign.tests.size();
      Eigen::VectorXd    left(n_tests), by_rows(n_tests);
      Eigen::Index       begin = 0;
      for (Eigen::Index t = 0; t < n_tests; ++t)
        {
          const Eigen::VectorXd friction =
            friction_over_noise(campaign.tests[t]);
          const double squares = friction.squaredNorm();
          by_rows(t)           = squares > 0. ? 1. / squares : 0.;
          left(t) = by_rows(t) * friction.dot(Eigen::Map<const Eigen::VectorXd>(
                                   residuals.data() + begin, friction.size()));
          begin += friction.size();
        }
      const Eigen::MatrixXd sums =
        pulls(campaign, known, [](const CampaignTest &test) {
          return Eigen::VectorXd::Ones(test.n_residuals());
        });
      moves = known.inverse * sums;
      const Eigen::MatrixXd remaining =
        Eigen::MatrixXd::Identity(n_tests, n_tests) -
        by_rows.asDiagonal() * (sums.transpose() * sums);
      Gains result;
      result.freedom = remaining.squaredNorm();
      // One test alone tells nothing of it.
      if (n_tests > 1 && result.freedom > 0.5)
        result.variance =
          std::max(0., left.squaredNorm() - inflation * by_rows.sum()) /
          result.freedom;
      return result;
    }



    // Rows, gains and whatever else differs between tests.
    void compare_tests(const Campaign            &campaign,
                       const RowMatrix           &derivatives,
                       const std::vector<double> &residuals,
                       Linearisation             &result)
    {
      const Eigen::Index n       = result.R.cols();
      const double       of_rows = std::max(1., result.n_effective - n);
      result.between_tests       = Eigen::VectorXd::Ones(n);
      result.freedom             = Eigen::VectorXd::Constant(n, of_rows);
      result.by_gains  = Eigen::MatrixXd::Zero(n, campaign.tests.size());
      result.by_drifts = result.by_gains;
      const Known known(derivatives, result.R);
      if (known.indices.empty())
        return;
      Eigen::MatrixXd moves;
      const Gains     gains =
        find_gains(campaign, known, residuals, result.inflation, moves);
      result.gain = std::sqrt(gains.variance);
      const Eigen::MatrixXd drift_moves =
        known.inverse * pulls(campaign, known, drift_shares);
      const auto left_out =
        leave_out_tests(campaign, known, residuals, result.inflation);
      for (std::size_t k = 0; k < known.indices.size(); ++k)
        {
          const Eigen::Index i    = known.indices[k];
          result.by_gains.row(i)  = moves.row(k);
          result.by_drifts.row(i) = drift_moves.row(k);
          // Degrees of freedom after Welch and Satterthwaite.
          const double rows =
            result.inflation * known.inverse.row(k).squaredNorm();
          const double by_gains   = gains.variance * moves.row(k).squaredNorm();
          result.between_tests(i) = std::sqrt(1. + by_gains / rows);
          if (by_gains > 0.)
            result.freedom(i) =
              std::pow(rows + by_gains, 2) /
              (rows * rows / of_rows + by_gains * by_gains / gains.freedom);
          const LeftOutTests &others = left_out[k];
          if (others.n_told > 1 && others.factor > result.by_chance &&
              others.factor > result.between_tests(i))
            {
              result.between_tests(i) = others.factor;
              result.freedom(i)       = others.n_told - 1.;
            }
        }
    }
  } // namespace



  double Linearisation::threshold(const double      confidence,
                                  const std::size_t i) const
  {
    return inflation * between_tests(i) * between_tests(i) *
           boost::math::quantile(
             boost::math::fisher_f(1., std::max(1., freedom(i))), confidence);
  }



  Linearisation linearise(Simulator                 &simulator,
                          const std::vector<double> &scaled,
                          std::vector<TestMisfit>   &tests)
  {
    const Campaign   &campaign = simulator.campaign;
    const std::size_t n = campaign.n_residuals(), n_parameters = scaled.size();
    std::vector<double> residuals(n);
    simulator.residuals(scaled, residuals.data());
    RowMatrix derivatives(n, n_parameters);
    simulator.derivatives(scaled,
                          all_parameters(campaign),
                          residuals.data(),
                          derivatives.data());

    Linearisation result;
    result.scaled = scaled;
    result.misfit = std::inner_product(residuals.begin(),
                                       residuals.end(),
                                       residuals.begin(),
                                       0.);
    for (std::size_t i = 0; i < n_parameters; ++i)
      {
        result.size.push_back(natural_size(campaign.fitted[i], scaled[i]));
        derivatives.col(i) /= result.size[i];
      }
    result.R = Eigen::HouseholderQR<RowMatrix>(derivatives)
                 .matrixQR()
                 .topRows(n_parameters)
                 .triangularView<Eigen::Upper>();

    // What tests differ by is in all rows of theirs, and no part of the scatter
    // of rows.
    const RowScatter rows =
      scatter_of_rows(campaign,
                      campaign.tests.size() > 1 ?
                        without_gains(campaign, residuals) :
                        residuals,
                      n_parameters);
    result.inflation       = rows.inflation;
    result.n_effective     = rows.n_effective;
    const double *residual = residuals.data();
    tests.clear();
    for (std::size_t i = 0; i < campaign.tests.size(); ++i)
      {
        const CampaignTest &test = campaign.tests[i];
        tests.push_back(
          misfit_of(test, simulator.simulate(scaled, i), residual));
        tests.back().correlation_length = rows.lengths[i];
        residual += test.n_residuals();
      }
    compare_tests(campaign, derivatives, residuals, result);
    analyse(result);
    return result;
  }



  namespace
  {
    // Where an interval ends to first order [scaled].
    double first_order_reach(const Linearisation &optimum,
                             const unsigned int   parameter,
                             const double         confidence)
    {
      // What tests differ by is in both the deviation and the threshold.
      return optimum.deviations(parameter) / optimum.between_tests(parameter) /
             optimum.size[parameter] *
             std::sqrt(optimum.threshold(confidence, parameter) /
                       optimum.inflation);
    }
  } // namespace



  Profile symmetric_profile(const Linearisation &optimum,
                            const unsigned int   parameter,
                            const double         confidence)
  {
    const double at    = optimum.scaled[parameter];
    const double reach = first_order_reach(optimum, parameter, confidence);
    Profile      result;
    result.value         = at;
    result.lower         = std::max(0., at - reach);
    result.upper         = std::min(1., at + reach);
    result.is_lower_open = at - reach < 0.;
    result.is_upper_open = at + reach > 1.;
    result.profile       = {{at, 0.}};
    return result;
  }



  Profile profile(const Simulator                            &planned,
                  const Linearisation                        &optimum,
                  const unsigned int                          parameter,
                  const double                                confidence,
                  const std::chrono::steady_clock::time_point deadline)
  {
    std::vector<unsigned int> others;
    for (unsigned int i = 0; i < optimum.scaled.size(); ++i)
      if (i != parameter)
        others.push_back(i);
    // Where the others go to first order.
    Eigen::MatrixXd columns(optimum.R.rows(), others.size());
    for (std::size_t i = 0; i < others.size(); ++i)
      columns.col(i) = optimum.R.col(others[i]) * optimum.size[others[i]];
    Eigen::VectorXd slopes = Eigen::VectorXd::Zero(optimum.scaled.size());
    if (!others.empty())
      {
        const Eigen::VectorXd found =
          -columns.completeOrthogonalDecomposition().solve(
            optimum.R.col(parameter) * optimum.size[parameter]);
        for (std::size_t i = 0; i < others.size(); ++i)
          slopes(others[i]) = found(i);
      }
    const double threshold = optimum.threshold(confidence, parameter);
    const double first_distance =
      first_order_reach(optimum, parameter, confidence);

    Profile result;
    result.value = optimum.scaled[parameter];
    result.profile.emplace_back(result.value, 0.);
    for (const int sign : {-1, 1})
      {
        Simulator   simulator(planned);
        ProfileSide side(
          [&](const std::vector<double> &from) {
            const FitResult fitted = fit(simulator, from, others, 0, deadline);
            return ProfileSide::Fitted{fitted.misfit, fitted.scaled};
          },
          {optimum.misfit, optimum.scaled},
          slopes,
          parameter,
          threshold,
          sign,
          deadline);
        side.follow(first_distance);
        side.add_to(result);
        if (!side.better.empty())
          result.better = side.better;
      }
    return result;
  }
} // namespace SlipStep
