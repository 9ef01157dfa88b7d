// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/noise.h>

#include <Eigen/Dense>
#include <ceres/gradient_problem.h>
#include <ceres/gradient_problem_solver.h>

#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  Noise::Logarithms Noise::logarithms() const
  {
    Logarithms result;
    result << std::log(white), std::log(drift), std::log(drift_time),
      std::log(gain), std::log(offset), std::log(slope), std::log(row_memory),
      by_seconds, by_sensor;
    return result;
  }



  Noise Noise::from_logarithms(const Logarithms &logarithms)
  {
    const Logarithms values = logarithms.array().exp();
    return {values(0),
            values(1),
            values(2),
            values(3),
            values(4),
            values(5),
            values(6),
            logarithms(7),
            logarithms(8)};
  }



  double Series::level(const double friction, const Noise &noise) const
  {
    return friction * std::pow(noise_share, noise.by_sensor);
  }



  double Series::drift_time(const Noise &noise) const
  {
    return noise.drift_time * std::pow(duration, -noise.by_seconds);
  }



  double Series::row_kept(const Noise &noise) const
  {
    return std::pow(row_decay, 1. / noise.row_memory);
  }



  namespace
  {
    // What a unit of gain, offset, slope and hum adds to the rows, times their
    // standard deviations: the gain in common, the others of each axis.
    RowMatrix common_columns(const std::vector<Series> &series,
                             const double               level,
                             const Noise               &noise)
    {
      Eigen::Index n_rows = 0, n_waves = 0;
      for (const Series &one : series)
        {
          n_rows += one.time.size();
          n_waves += one.hum.size();
        }
      Eigen::Index row = 0, wave = 1 + 2 * series.size();
      RowMatrix    columns = RowMatrix::Zero(n_rows, wave + n_waves);
      for (std::size_t s = 0; s < series.size(); ++s)
        {
          const double own_level = series[s].level(level, noise);
          for (const std::vector<double> &values : series[s].hum)
            columns.col(wave++).segment(row, values.size()) =
              Eigen::Map<const Eigen::VectorXd>(values.data(), values.size());
          for (std::size_t i = 0; i < series[s].time.size(); ++i, ++row)
            {
              columns(row, 0)         = noise.gain * series[s].friction[i];
              columns(row, 1 + 2 * s) = noise.offset * own_level;
              columns(row, 2 + 2 * s) =
                noise.slope * own_level * (series[s].time[i] - 0.5);
            }
        }
      return columns;
    }
  } // namespace



  Whitener::Whitener(const std::vector<Series> &series,
                     const double               level,
                     const Noise               &noise)
  {
    for (const Series &one : series)
      add_steps(one, level, noise);
    common = common_columns(series, level, noise);
    filter(common);
    // I + U U^T, by the eigenvectors of U^T U.
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(
      common.transpose() * common);
    const Eigen::VectorXd values = eigen.eigenvalues().cwiseMax(1e-12);
    common                       = common * eigen.eigenvectors() *
             values.cwiseSqrt().cwiseInverse().asDiagonal();
    shrinkage = (1. + values.array()).rsqrt() - 1.;
    log_det += (1. + values.array()).log().sum();
  }



  // The steps of a Kalman filter with two states, the drift (an
  // Ornstein-Uhlenbeck process in time) and what a row keeps of the one before
  // (AR(1) in rows): each row less what those before it predict, in units of
  // the deviation of that, is white. (R. E. Kalman, J. Basic Eng. 82, 1960.)
  void Whitener::add_steps(const Series &series,
                           const double  level,
                           const Noise  &noise)
  {
    const double stationary =
      std::pow(noise.drift * series.level(level, noise), 2);
    const double drift_time = series.drift_time(noise);
    const double row_kept   = series.row_kept(noise);
    // Covariance of the states.
    double drift = stationary, both = 0., row = 1.;
    for (std::size_t i = 0; i < series.time.size(); ++i)
      {
        Step step;
        step.begins = i == 0;
        if (i > 0)
          {
            step.drift_kept =
              std::exp((series.time[i - 1] - series.time[i]) / drift_time);
            step.row_kept   = row_kept;
            const double kd = step.drift_kept, kr = step.row_kept;
            drift = kd * kd * drift + (1. - kd * kd) * stationary;
            both *= kd * kr;
            row = kr * kr * row + 1. - kr * kr;
          }
        const double own        = noise.white * series.row_noise[i];
        step.row_weight         = own * std::sqrt(series.row_share);
        const double a          = step.row_weight;
        const double drift_seen = drift + a * both, row_seen = both + a * row;
        const double total =
          drift_seen + a * row_seen + (1. - series.row_share) * own * own;
        step.drift_gain        = drift_seen / total;
        step.row_gain          = row_seen / total;
        step.inverse_deviation = 1. / std::sqrt(total);
        log_det += std::log(total);
        drift -= step.drift_gain * drift_seen;
        both -= step.drift_gain * row_seen;
        row -= step.row_gain * row_seen;
        steps.push_back(step);
      }
  }



  void Whitener::filter(Eigen::Ref<RowMatrix> columns) const
  {
    Eigen::RowVectorXd drift = Eigen::RowVectorXd::Zero(columns.cols());
    Eigen::RowVectorXd row   = drift;
    for (Eigen::Index i = 0; i < columns.rows(); ++i)
      {
        const Step &step = steps[i];
        if (step.begins)
          drift.setZero();
        else
          drift *= step.drift_kept;
        columns.row(i) -= drift;
        if (step.row_weight > 0.)
          {
            if (step.begins)
              row.setZero();
            else
              row *= step.row_kept;
            columns.row(i) -= step.row_weight * row;
            row += step.row_gain * columns.row(i);
          }
        drift += step.drift_gain * columns.row(i);
        columns.row(i) *= step.inverse_deviation;
      }
  }



  void Whitener::apply(Eigen::Ref<RowMatrix> columns) const
  {
    filter(columns);
    const RowMatrix parts =
      shrinkage.asDiagonal() * (common.transpose() * columns);
    columns.noalias() += common * parts;
  }



  Eigen::VectorXd sample_noise(const std::vector<Series> &series,
                               const double               level,
                               const Noise               &noise,
                               std::mt19937_64           &random)
  {
    std::normal_distribution<double> normal(0., 1.);
    const RowMatrix columns = common_columns(series, level, noise);
    Eigen::VectorXd parts(columns.cols());
    for (double &part : parts)
      part = normal(random);
    Eigen::VectorXd result = columns * parts;
    Eigen::Index    row    = 0;
    for (const Series &one : series)
      {
        const double drift      = noise.drift * one.level(level, noise);
        double       state      = drift * normal(random);
        const double drift_time = one.drift_time(noise);
        double       together   = one.row_share > 0. ? normal(random) : 0.;
        for (std::size_t i = 0; i < one.time.size(); ++i, ++row)
          {
            if (i > 0)
              {
                const double keep =
                  std::exp((one.time[i - 1] - one.time[i]) / drift_time);
                state = keep * state +
                        drift * std::sqrt(1. - keep * keep) * normal(random);
              }
            double own = normal(random);
            if (one.row_share > 0.)
              {
                const double keep = one.row_kept(noise);
                if (i > 0)
                  together = keep * together +
                             std::sqrt(1. - keep * keep) * normal(random);
                own = std::sqrt(1. - one.row_share) * own +
                      std::sqrt(one.row_share) * together;
              }
            result(row) += state + noise.white * one.row_noise[i] * own;
          }
      }
    return result;
  }



  Noise NoiseEstimate::draw(std::mt19937_64 &random) const
  {
    std::normal_distribution<double> normal(0., 1.);
    Noise::Logarithms                independent;
    // Where sensors are alike, nothing is drawn of how they differ.
    for (Eigen::Index i = 0; i < independent.size(); ++i)
      independent(i) = covariance(i, i) > 0. ? normal(random) : 0.;
    Noise result = Noise::from_logarithms(
      noise.logarithms() + covariance.llt().matrixL() * independent);
    if (row_freedom > 0.)
      result.white *= std::exp(normal(random) / std::sqrt(2. * row_freedom));
    return result;
  }



  Noise::Logarithms prior_deviations()
  {
    Noise::Logarithms result;
    result << 0.2, 0.6, 0.5, 0.6, 0.6, 0.6, 0.4, 0.5, 0.5;
    return result;
  }



  namespace
  {
    using Logarithms = Noise::Logarithms;

    // Farther from what is thought of before noise is not believed to be.
    constexpr double largest_deviation = 5.;



    // How many components are felt: the last one where sensors differ only.
    Eigen::Index n_felt(const std::vector<Contrast> &contrasts)
    {
      for (const Contrast &contrast : contrasts)
        for (const Series &series : contrast.series)
          if (series.noise_share < 1.)
            return Noise::n_components;
      return Noise::n_components - 1;
    }



    /// Minus the logarithm of likelihood times prior.
    double implausibility(const std::vector<Contrast> &contrasts,
                          const Logarithms            &prior,
                          const Logarithms            &at)
    {
      double sum = (at - prior).cwiseQuotient(prior_deviations()).squaredNorm();
      const Noise noise = Noise::from_logarithms(at);
      for (const Contrast &contrast : contrasts)
        {
          const Whitener whitener(contrast.series, contrast.level, noise);
          RowMatrix      values = contrast.values;
          whitener.apply(values);
          sum += values.squaredNorm() + whitener.log_determinant();
        }
      return sum / 2.;
    }



    class Implausibility : public ceres::FirstOrderFunction
    {
    public:
      Implausibility(const std::vector<Contrast> &contrasts,
                     const Logarithms            &prior)
        : contrasts(contrasts)
        , prior(prior)
      {}

      virtual bool Evaluate(const double *const at,
                            double             *cost,
                            double             *gradient) const override
      {
        const Logarithms center = Eigen::Map<const Logarithms>(at);
        *cost                   = implausibility(contrasts, prior, center);
        if (gradient != nullptr)
          std::fill_n(gradient, center.size(), 0.);
        if (gradient != nullptr)
          for (Eigen::Index i = 0; i < n_felt(contrasts); ++i)
            {
              constexpr double step   = 1e-4;
              Logarithms       beyond = center, before = center;
              beyond(i) += step;
              before(i) -= step;
              gradient[i] = (implausibility(contrasts, prior, beyond) -
                             implausibility(contrasts, prior, before)) /
                            (2. * step);
            }
        return std::isfinite(*cost);
      }

      virtual int NumParameters() const override
      {
        return Noise::n_components;
      }

    private:
      const std::vector<Contrast> &contrasts;
      const Logarithms             prior;
    };



    // Where the search above gives up early, one component after the other.
    void descend(const std::vector<Contrast> &contrasts,
                 const Logarithms            &prior,
                 Logarithms                  &at)
    {
      constexpr unsigned int most_sweeps = 30;
      constexpr double       reach       = 1.5;

      double value = implausibility(contrasts, prior, at);
      for (unsigned int sweep = 0; sweep < most_sweeps; ++sweep)
        {
          const double before = value;
          for (Eigen::Index i = 0; i < n_felt(contrasts); ++i)
            {
              const auto along = [&](const double x) {
                Logarithms moved = at;
                moved(i)         = x;
                return implausibility(contrasts, prior, moved);
              };
              const auto best = boost::math::tools::brent_find_minima(
                along, at(i) - reach, at(i) + reach, 12);
              if (best.second < value)
                {
                  at(i) = best.first;
                  value = best.second;
                }
            }
          if (value > before - 0.01)
            return;
        }
    }
  } // namespace



  NoiseEstimate estimate_noise(const std::vector<Contrast> &contrasts,
                               const Noise                 &prior)
  {
    NoiseEstimate result;
    result.n_contrasts         = contrasts.size();
    result.noise               = prior;
    result.covariance          = prior_deviations().cwiseAbs2().asDiagonal();
    const Eigen::Index n_known = Noise::n_components - n_felt(contrasts);
    result.covariance.diagonal().tail(n_known).setZero();
    if (contrasts.empty())
      return result;

    Logarithms                   at       = prior.logarithms();
    auto                        *function = new Implausibility(contrasts, at);
    const ceres::GradientProblem problem(function);
    ceres::GradientProblemSolver::Options options;
    ceres::GradientProblemSolver::Summary summary;
    options.logging_type       = ceres::SILENT;
    options.max_num_iterations = 60;
    options.function_tolerance = 1e-7;
    ceres::Solve(options, problem, at.data(), &summary);
    descend(contrasts, prior.logarithms(), at);
    // Records without any noise would be infinitely plausible.
    const Logarithms reach = largest_deviation * prior_deviations();
    at                     = at.cwiseMax(prior.logarithms() - reach)
           .cwiseMin(prior.logarithms() + reach);
    result.noise = Noise::from_logarithms(at);

    // The curvature is at least that of the prior.
    using Square =
      Eigen::Matrix<double, Noise::n_components, Noise::n_components>;
    Square curvature = Square::Zero();
    for (Eigen::Index i = 0; i < n_felt(contrasts); ++i)
      {
        constexpr double step   = 0.02;
        Logarithms       beyond = at, before = at, rise, fall;
        double           cost;
        beyond(i) += step;
        before(i) -= step;
        function->Evaluate(beyond.data(), &cost, rise.data());
        function->Evaluate(before.data(), &cost, fall.data());
        curvature.row(i) = (rise - fall).transpose() / (2. * step);
      }
    curvature = (curvature + curvature.transpose()).eval() / 2.;
    const Eigen::SelfAdjointEigenSolver<Square> eigen(curvature);
    result.covariance =
      eigen.eigenvectors() *
      eigen.eigenvalues().cwiseMax(1.).cwiseInverse().asDiagonal() *
      eigen.eigenvectors().transpose();
    result.covariance.rightCols(n_known).setZero();
    result.covariance.bottomRows(n_known).setZero();
    return result;
  }
} // namespace SlipStep
