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
      std::log(gain), std::log(offset), std::log(slope);
    return result;
  }



  Noise Noise::from_logarithms(const Logarithms &logarithms)
  {
    const Logarithms values = logarithms.array().exp();
    return {values(0), values(1), values(2), values(3), values(4), values(5)};
  }



  namespace
  {
    std::size_t n_rows(const std::vector<Series> &series)
    {
      std::size_t n = 0;
      for (const Series &one : series)
        n += one.time.size();
      return n;
    }



    // What a unit of gain, offset and slope adds to the rows, times their
    // standard deviations: the gain in common, the others of each axis.
    RowMatrix common_columns(const std::vector<Series> &series,
                             const double               level,
                             const Noise               &noise)
    {
      RowMatrix columns =
        RowMatrix::Zero(n_rows(series), 1 + 2 * series.size());
      Eigen::Index row = 0;
      for (std::size_t s = 0; s < series.size(); ++s)
        for (std::size_t i = 0; i < series[s].time.size(); ++i, ++row)
          {
            columns(row, 0)         = noise.gain * series[s].friction[i];
            columns(row, 1 + 2 * s) = noise.offset * level;
            columns(row, 2 + 2 * s) =
              noise.slope * level * (series[s].time[i] - 0.5);
          }
      return columns;
    }
  } // namespace



  Whitener::Whitener(const std::vector<Series> &series,
                     const double               level,
                     const Noise               &noise)
  {
    const double stationary = std::pow(noise.drift * level, 2);
    for (const Series &one : series)
      {
        double variance = stationary;
        for (std::size_t i = 0; i < one.time.size(); ++i)
          {
            begins.push_back(i == 0);
            decay.push_back(i == 0 ? 0. :
                                     std::exp((one.time[i - 1] - one.time[i]) /
                                              noise.drift_time));
            const double keep = decay.back() * decay.back();
            if (i > 0)
              variance = keep * variance + (1. - keep) * stationary;
            const double total =
              variance + std::pow(noise.white * one.row_noise[i], 2);
            gains.push_back(variance / total);
            inverse_deviation.push_back(1. / std::sqrt(total));
            log_det += std::log(total);
            variance *= 1. - gains.back();
          }
      }
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



  void Whitener::filter(Eigen::Ref<RowMatrix> columns) const
  {
    Eigen::RowVectorXd state = Eigen::RowVectorXd::Zero(columns.cols());
    for (Eigen::Index i = 0; i < columns.rows(); ++i)
      {
        if (begins[i])
          state.setZero();
        else
          state *= decay[i];
        columns.row(i) -= state;
        state += gains[i] * columns.row(i);
        columns.row(i) *= inverse_deviation[i];
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
        double state = noise.drift * level * normal(random);
        for (std::size_t i = 0; i < one.time.size(); ++i, ++row)
          {
            if (i > 0)
              {
                const double keep =
                  std::exp((one.time[i - 1] - one.time[i]) / noise.drift_time);
                state = keep * state + noise.drift * level *
                                         std::sqrt(1. - keep * keep) *
                                         normal(random);
              }
            result(row) +=
              state + noise.white * one.row_noise[i] * normal(random);
          }
      }
    return result;
  }



  Noise NoiseEstimate::draw(std::mt19937_64 &random) const
  {
    std::normal_distribution<double> normal(0., 1.);
    Noise::Logarithms                independent;
    for (double &value : independent)
      value = normal(random);
    return Noise::from_logarithms(noise.logarithms() +
                                  covariance.llt().matrixL() * independent);
  }



  Noise::Logarithms prior_deviations()
  {
    Noise::Logarithms result;
    result << 0.2, 0.6, 0.5, 0.6, 0.6, 0.6;
    return result;
  }



  namespace
  {
    using Logarithms = Noise::Logarithms;

    // Farther from what is thought of before noise is not believed to be.
    constexpr double largest_deviation = 5.;



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
          for (Eigen::Index i = 0; i < center.size(); ++i)
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
  } // namespace



  namespace
  {
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
          for (Eigen::Index i = 0; i < at.size(); ++i)
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
    result.n_contrasts = contrasts.size();
    result.noise       = prior;
    result.covariance  = prior_deviations().cwiseAbs2().asDiagonal();
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
    Eigen::Matrix<double, 6, 6> curvature;
    for (Eigen::Index i = 0; i < at.size(); ++i)
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
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(
      curvature);
    result.covariance =
      eigen.eigenvectors() *
      eigen.eigenvalues().cwiseMax(1.).cwiseInverse().asDiagonal() *
      eigen.eigenvectors().transpose();
    return result;
  }
} // namespace SlipStep
