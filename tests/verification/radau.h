// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tests_verification_radau_h
#define tests_verification_radau_h

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace SlipStep::Testing
{
  template <std::size_t n>
  using Unknowns = std::array<double, n>;

  /// A linear system, by elimination with partial pivoting.
  template <std::size_t n>
  class LinearSystem
  {
  public:
    double &operator()(const std::size_t i, const std::size_t j)
    {
      return matrix[i][j];
    }

    void factorise()
    {
      for (std::size_t k = 0; k < n; ++k)
        {
          pivot[k] = k;
          for (std::size_t i = k + 1; i < n; ++i)
            if (std::abs(matrix[i][k]) > std::abs(matrix[pivot[k]][k]))
              pivot[k] = i;
          std::swap(matrix[k], matrix[pivot[k]]);
          for (std::size_t i = k + 1; i < n; ++i)
            {
              const double factor = matrix[i][k] /= matrix[k][k];
              if (factor != 0.)
                for (std::size_t j = k + 1; j < n; ++j)
                  matrix[i][j] -= factor * matrix[k][j];
            }
        }
    }

    Unknowns<n> solve(Unknowns<n> x) const
    {
      for (std::size_t k = 0; k < n; ++k)
        std::swap(x[k], x[pivot[k]]);
      for (std::size_t k = 0; k < n; ++k)
        for (std::size_t j = 0; j < k; ++j)
          x[k] -= matrix[k][j] * x[j];
      for (std::size_t k = n; k-- > 0;)
        {
          for (std::size_t j = k + 1; j < n; ++j)
            x[k] -= matrix[k][j] * x[j];
          x[k] /= matrix[k][k];
        }
      return x;
    }

  private:
    std::array<Unknowns<n>, n> matrix{};
    std::array<std::size_t, n> pivot{};
  };



  /// One step of Radau IIA with three stages, of order five: implicit, for
  /// stiff equations, with an estimate of its error and a polynomial in
  /// between. Hairer and Wanner (1996), Solving Ordinary Differential Equations
  /// II, section IV.8.
  template <std::size_t n>
  class RadauStep
  {
  public:
    double begin = 0.;
    double size  = 0.;

    /// Make the step.
    /// @param rates of time and unknowns
    /// @param scale of what an unknown may err
    /// @return the estimated error over the scale, infinite if there is no
    ///   solution
    template <typename Rates>
    double make(const Rates       &rates,
                const double       time,
                const double       time_step,
                const Unknowns<n> &x,
                const Unknowns<n> &scale);

    /// The unknowns at a time.
    Unknowns<n> at(const double time) const
    {
      const double s = size > 0. ? (time - begin) / size : 0.;
      // Lagrange's polynomials on 0 and the stages; the first is not needed.
      Unknowns<n> x = start;
      for (unsigned int i = 0; i < 3; ++i)
        {
          double weight = s / c[i];
          for (unsigned int j = 0; j < 3; ++j)
            if (j != i)
              weight *= (s - c[j]) / (c[i] - c[j]);
          for (std::size_t k = 0; k < n; ++k)
            x[k] += weight * change[i][k];
        }
      return x;
    }

    Unknowns<n> end() const
    {
      Unknowns<n> x = start;
      for (std::size_t k = 0; k < n; ++k)
        x[k] += change[2][k];
      return x;
    }

  private:
    using Matrix = std::array<Unknowns<n>, n>;

    template <typename Rates>
    Matrix jacobian(const Rates       &rates,
                    const Unknowns<n> &rates_0,
                    const Unknowns<n> &scale) const;

    template <typename Rates>
    bool solve_stages(const Rates       &rates,
                      const Matrix      &jacobian,
                      const Unknowns<n> &scale);

    template <typename Rates>
    double error(const Rates       &rates,
                 const Matrix      &jacobian,
                 const Unknowns<n> &rates_0,
                 const Unknowns<n> &scale) const;

    static double norm(const Unknowns<n> &x, const Unknowns<n> &scale)
    {
      double largest = 0.;
      for (std::size_t k = 0; k < n; ++k)
        {
          if (!std::isfinite(x[k]))
            return infinity;
          largest = std::max(largest, std::abs(x[k]) / scale[k]);
        }
      return largest;
    }

    static constexpr double infinity = HUGE_VAL;
    static constexpr double root_6   = 2.449489742783178;

    static constexpr std::array<double, 3> c = {
      {(4. - root_6) / 10., (4. + root_6) / 10., 1.}};
    static constexpr std::array<std::array<double, 3>, 3> a = {
      {{{(88. - 7. * root_6) / 360.,
         (296. - 169. * root_6) / 1800.,
         (-2. + 3. * root_6) / 225.}},
       {{(296. + 169. * root_6) / 1800.,
         (88. + 7. * root_6) / 360.,
         (-2. - 3. * root_6) / 225.}},
       {{(16. - root_6) / 36., (16. + root_6) / 36., 1. / 9.}}}};

    Unknowns<n>                start{};
    std::array<Unknowns<n>, 3> change{}; ///< at the stages
  };



  template <std::size_t n>
  template <typename Rates>
  double RadauStep<n>::make(const Rates       &rates,
                            const double       time,
                            const double       time_step,
                            const Unknowns<n> &x,
                            const Unknowns<n> &scale)
  {
    begin                      = time;
    size                       = time_step;
    start                      = x;
    const Unknowns<n> rates_0  = rates(time, x);
    const Matrix      gradient = jacobian(rates, rates_0, scale);
    if (!solve_stages(rates, gradient, scale))
      return infinity;
    return error(rates, gradient, rates_0, scale);
  }



  // By differences, which only Newton's method sees.
  template <std::size_t n>
  template <typename Rates>
  typename RadauStep<n>::Matrix
  RadauStep<n>::jacobian(const Rates       &rates,
                         const Unknowns<n> &rates_0,
                         const Unknowns<n> &scale) const
  {
    Matrix      matrix;
    Unknowns<n> shifted = start;
    for (std::size_t j = 0; j < n; ++j)
      {
        const double wanted     = std::max(1e-7 * std::abs(start[j]), scale[j]);
        shifted[j]              = start[j] + wanted;
        const double      shift = shifted[j] - start[j];
        const Unknowns<n> rates_1 = rates(begin, shifted);
        shifted[j]                = start[j];
        for (std::size_t i = 0; i < n; ++i)
          matrix[i][j] = (rates_1[i] - rates_0[i]) / shift;
      }
    return matrix;
  }



  template <std::size_t n>
  template <typename Rates>
  bool RadauStep<n>::solve_stages(const Rates       &rates,
                                  const Matrix      &jacobian,
                                  const Unknowns<n> &scale)
  {
    LinearSystem<3 * n> system;
    for (std::size_t i = 0; i < 3 * n; ++i)
      for (std::size_t j = 0; j < 3 * n; ++j)
        system(i, j) =
          (i == j ? 1. : 0.) - size * a[i / n][j / n] * jacobian[i % n][j % n];
    system.factorise();

    for (Unknowns<n> &stage : change)
      stage.fill(0.);
    double last = infinity;
    for (unsigned int iteration = 0; iteration < 15; ++iteration)
      {
        std::array<Unknowns<n>, 3> slopes;
        for (unsigned int i = 0; i < 3; ++i)
          {
            Unknowns<n> x = start;
            for (std::size_t k = 0; k < n; ++k)
              x[k] += change[i][k];
            slopes[i] = rates(begin + c[i] * size, x);
          }
        Unknowns<3 * n> residual;
        for (std::size_t i = 0; i < 3 * n; ++i)
          {
            residual[i] = -change[i / n][i % n];
            for (unsigned int j = 0; j < 3; ++j)
              residual[i] += size * a[i / n][j] * slopes[j][i % n];
          }
        const Unknowns<3 *n> correction = system.solve(residual);
        double               moved      = 0.;
        for (unsigned int i = 0; i < 3; ++i)
          {
            Unknowns<n> part;
            for (std::size_t k = 0; k < n; ++k)
              change[i][k] += part[k] = correction[i * n + k];
            moved = std::max(moved, norm(part, scale));
          }
        if (moved <= 1e-3 || (moved <= 0.1 && moved > 0.5 * last))
          return true;
        if (!(moved < 1e10) || (iteration > 4 && moved > 0.9 * last))
          return false;
        last = moved;
      }
    return false;
  }



  template <std::size_t n>
  template <typename Rates>
  double RadauStep<n>::error(const Rates       &rates,
                             const Matrix      &jacobian,
                             const Unknowns<n> &rates_0,
                             const Unknowns<n> &scale) const
  {
    constexpr double                real    = 3.6378342527444957;
    constexpr std::array<double, 3> weights = {
      {-(13. + 7. * root_6) / 3., (-13. + 7. * root_6) / 3., -1. / 3.}};

    LinearSystem<n> system;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        system(i, j) = (i == j ? real / size : 0.) - jacobian[i][j];
    system.factorise();

    Unknowns<n> sum{};
    for (std::size_t k = 0; k < n; ++k)
      for (unsigned int i = 0; i < 3; ++i)
        sum[k] += weights[i] * change[i][k] / size;
    const auto filtered = [&](const Unknowns<n> &slopes) {
      Unknowns<n> right = sum;
      for (std::size_t k = 0; k < n; ++k)
        right[k] += slopes[k];
      return system.solve(right);
    };
    const Unknowns<n> first  = filtered(rates_0);
    const double      result = norm(first, scale);
    if (result < 1. || !std::isfinite(result))
      return result;
    // Where the first step of a stiff part is overestimated.
    Unknowns<n> x = start;
    for (std::size_t k = 0; k < n; ++k)
      x[k] += first[k];
    return std::min(result, norm(filtered(rates(begin, x)), scale));
  }
} // namespace SlipStep::Testing

#endif
