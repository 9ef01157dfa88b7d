// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/numbers.h>

#include <slipstep/diagnosis/basis.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace SlipStep
{
  using dealii::numbers::PI;

  namespace
  {
    double largest(const Eigen::VectorXd &values)
    {
      return values.size() == 0 ? 0. : values.maxCoeff();
    }



    // The logarithm where there is one, else nothing.
    Eigen::VectorXd logarithm(const Eigen::VectorXd &x)
    {
      return x.unaryExpr([](const double value) {
        return value > 0. ? std::log10(value) :
                            std::numeric_limits<double>::quiet_NaN();
      });
    }



    /// Adds functions of one covariate after the other.
    class BasisMaker
    {
    public:
      explicit BasisMaker(const Covariates &covariates)
        : covariates(covariates)
        , n(covariates.friction.size())
      {}

      // Three polynomials over the rows where there is a value, times friction;
      // nothing if it hardly varies there.
      void polynomials(const Covariate &covariate)
      {
        const bool             is_logarithmic = covariate.is_logarithmic;
        const Eigen::VectorXd &values         = covariates.*covariate.values;
        const Eigen::VectorXd  x = is_logarithmic ? logarithm(values) : values;
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (Eigen::Index i = 0; i < n; ++i)
          if (std::isfinite(x(i)))
            {
              low  = std::min(low, x(i));
              high = std::max(high, x(i));
            }
        if (!(high - low > (is_logarithmic ? 0.05 : 1e-6 * std::abs(high))))
          return;
        for (unsigned int degree = 1; degree <= 3; ++degree)
          factor(covariate.name, [&](const Eigen::Index i) {
            const double t = 2. * (x(i) - low) / (high - low) - 1.;
            return std::isfinite(x(i)) ? std::legendre(degree, t) : 0.;
          });
      }

      // Friction times of_row(row), unless that is nothing.
      template <class Factor>
      void factor(const std::string &name, const Factor &of_row)
      {
        Eigen::VectorXd column(n);
        for (Eigen::Index i = 0; i < n; ++i)
          column(i) = covariates.friction(i) * of_row(i);
        add(name, column);
      }

      void add(const std::string &name, const Eigen::VectorXd &column)
      {
        if (column.squaredNorm() > 0.)
          columns.push_back({column, false, name});
      }

      const Covariates      &covariates;
      const Eigen::Index     n;
      std::vector<Direction> columns;
    };



    void add_memories(BasisMaker &maker)
    {
      const Covariates &at     = maker.covariates;
      const double      length = largest(at.path);
      // After a rest, a function of how long it was, forgotten by slip.
      for (const double share : {0.01, 0.1, 1.})
        maker.factor("rest", [&](const Eigen::Index i) {
          return at.rest(i) > 0. && at.speed(i) > 0. ?
                   std::log1p(at.rest(i)) *
                     std::exp(-at.since_start(i) / (share * length)) :
                   0.;
        });
      // Since every start.
      for (const double share : {0.003, 0.03, 0.3})
        maker.factor("slip since start", [&](const Eigen::Index i) {
          return at.speed(i) > 0. ?
                   std::exp(-at.since_start(i) / (share * length)) :
                   0.;
        });
      // Since the beginning of the test.
      for (const double share : {0.01, 0.1})
        maker.factor("path", [&](const Eigen::Index i) {
          return std::exp(-at.path(i) / (share * length));
        });
    }



    // Of pressure and speed: what was before is forgotten by slip, or never.
    void add_histories(BasisMaker &maker, const Comparison &comparison)
    {
      const Covariates &at = maker.covariates;
      const auto add = [&](const std::string &name, const Eigen::VectorXd &x) {
        if (x.size() == 0 || !(x.maxCoeff() - x.minCoeff() > 0.05))
          return;
        maker.add(name, at.friction.cwiseProduct(x));
      };
      add("unloading", at.unloading);
      const double fastest = largest(at.pressure_rate.cwiseAbs());
      // Not the tremble of a load cell.
      const bool is_changed = largest(at.pressure_change.cwiseAbs()) > 0.05;
      if (fastest > 0. && is_changed)
        for (const double scale : {1., 20.})
          add("rate of pressure",
              (at.pressure_rate * (scale / fastest)).array().tanh().matrix());
      const double path = largest(at.path);
      if (!(path > 0.))
        return;
      for (const double share : {0.02, 0.1, 0.4})
        {
          add("change of pressure",
              lagging_change(comparison, at.path, at.pressure, share * path));
          add("change of speed",
              lagging_change(comparison, at.path, at.speed, share * path));
        }
    }



    // Something that breaks or wears through, after any path.
    void add_steps(BasisMaker &maker)
    {
      constexpr unsigned int n_places = 9;
      constexpr double       ratio = 1.6, sharpness = 6.;

      const Covariates &at    = maker.covariates;
      double            place = largest(at.path);
      for (unsigned int k = 0; k < n_places; ++k)
        {
          place /= ratio;
          maker.factor("path", [&](const Eigen::Index i) {
            return 1. /
                   (1. + std::pow(place / std::max(at.path(i), 1e-3 * place),
                                  2. * sharpness));
          });
        }
    }



    void add_directions(BasisMaker &maker)
    {
      const Covariates &at = maker.covariates;
      maker.factor("direction",
                   [&](const Eigen::Index i) { return at.is_reverse(i); });
      bool is_oblique = false;
      for (Eigen::Index i = 0; i < maker.n; ++i)
        is_oblique = is_oblique || std::abs(std::sin(at.angle(i))) > 0.05;
      if (!is_oblique)
        return;
      for (const double multiple : {2., 4.})
        {
          maker.factor("angle", [&](const Eigen::Index i) {
            return std::cos(multiple * at.angle(i));
          });
          maker.factor("angle", [&](const Eigen::Index i) {
            return std::sin(multiple * at.angle(i));
          });
        }
    }
  } // namespace



  std::vector<Direction> smooth_basis(const Comparison &comparison,
                                      const Covariates &covariates)
  {
    BasisMaker maker(covariates);
    for (const char *const name :
         {"speed", "pressure", "path", "heat", "order of the tests"})
      maker.polynomials(covariate_called(name));
    add_memories(maker);
    add_steps(maker);
    add_histories(maker, comparison);
    add_directions(maker);
    // The pressure's own change, along the flanks.
    Eigen::VectorXd flank = Eigen::VectorXd::Zero(maker.n);
    for (const ComparedTest &test : comparison.tests)
      for (Eigen::Index i = test.begin; i < test.begin + test.size; ++i)
        if (is_flank(covariates.phase[i]))
          flank(i) = test.level;
    maker.add("flank", flank);
    return maker.columns;
  }



  std::vector<Direction> condition_basis(const Comparison  &comparison,
                                         const Covariates  &covariates,
                                         const unsigned int n_waves)
  {
    std::vector<Direction> result;
    for (std::size_t c = 0; c < comparison.conditions.size(); ++c)
      for (unsigned int wave = 0; wave <= n_waves; ++wave)
        {
          Eigen::VectorXd column = Eigen::VectorXd::Zero(comparison.n_rows());
          for (const ComparedTest &test : comparison.tests)
            if (test.condition == c)
              for (Eigen::Index i = 0; i < test.size; ++i)
                {
                  const Eigen::Index row = test.begin + i;
                  column(row)            = covariates.friction(row) *
                                std::cos(wave * PI * (i % test.n_bins() + 0.5) /
                                         test.n_bins());
                }
          result.push_back({column});
        }
    return result;
  }
} // namespace SlipStep
