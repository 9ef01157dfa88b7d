// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/numbers.h>

#include <slipstep/friction/sampled_function.h>
#include <slipstep/utilities/formula.h>
#include <slipstep/utilities/text.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace SlipStep
{
  namespace
  {
    // How near to each other samples are beside a jump, as a share of x.
    constexpr double sharpest = 1e-6;

    /// Takes the samples.
    class Sampler
    {
    public:
      Sampler(const std::function<double(double)> &formula,
              const double                         from,
              const double                         to)
        : formula(formula)
        , from(from)
        , to(to)
      {}

      /// @return false if the formula varies too quickly
      bool sample()
      {
        // Corners and jumps, not waves.
        constexpr std::size_t most_places = 20, most_intervals = 64000;
        for (std::size_t n = 1000; n <= most_intervals; n *= 4)
          if (sample(n) <= most_places)
            return true;
        return false;
      }

      std::vector<double> x, values;

    private:
      // Returns how many intervals between n + 1 samples are not straight.
      std::size_t sample(const std::size_t n)
      {
        x                  = {from};
        values             = {formula(from)};
        std::size_t n_bent = 0;
        for (std::size_t i = 1; i <= n; ++i)
          {
            const double      share = i / static_cast<double>(n);
            const double      end   = (1. - share) * from + share * to;
            const std::size_t size  = x.size();
            append(end, formula(end), 0);
            n_bent += x.size() > size + 1;
          }
        return n_bent;
      }

      // Add a sample, and others before it if need be.
      void
      append(const double end, const double value, const unsigned int depth)
      {
        constexpr double       tolerance = 3e-4;
        constexpr unsigned int deepest   = 60;

        // Never at the same place of a wave.
        place              = std::fmod(place + dealii::numbers::PI_2, 1.);
        const double share = 0.2 + 0.6 * place;
        const double begin = x.back(), before = values.back();
        const double middle = (1. - share) * begin + share * end;
        const double there  = formula(middle);
        const double line   = (1. - share) * before + share * value;
        const double width =
          sharpest * std::max(std::abs(begin), std::abs(end));
        if (depth < deepest && end - begin > width &&
            !(std::abs(there - line) <= tolerance * std::abs(there)))
          {
            append(middle, there, depth + 1);
            append(end, value, depth + 1);
            return;
          }
        x.push_back(end);
        values.push_back(value);
      }

      const std::function<double(double)> &formula;
      const double                         from, to;
      double                               place = 0.;
    };
  } // namespace



  SampledFunction::SampledFunction(std::vector<double> x,
                                   std::vector<double> samples)
    : places(x)
    , values(samples)
    , curve(std::move(x), std::move(samples))
  {}



  std::optional<double>
  SampledFunction::missed(const std::function<double(double)> &function) const
  {
    constexpr unsigned int n         = 200000;
    constexpr double       tolerance = 0.01;

    const double from = places.front(), to = places.back();
    // A jump is somewhere between two samples.
    const double beside =
      std::max((to - from) / n,
               sharpest * std::max(std::abs(from), std::abs(to)));
    for (unsigned int i = 0; i < n; ++i)
      {
        const double x      = from + (i + 0.5) * (to - from) / n;
        const double near[] = {(*this)(x - beside).value,
                               (*this)(x).value,
                               (*this)(x + beside).value};
        const auto [least, most] =
          std::minmax_element(std::begin(near), std::end(near));
        const double value = function(x);
        if (value < (1. - tolerance) * *least ||
            value > (1. + tolerance) * *most)
          return x;
      }
    return {};
  }



  double SampledFunction::excursion(const double a, const double b) const
  {
    const double at_a = (*this)(a).value, at_b = (*this)(b).value;
    const auto   place = [&](const double x) {
      return values.begin() +
             (std::lower_bound(places.begin(), places.end(), x) -
              places.begin());
    };
    const auto begin = place(std::min(a, b)), end = place(std::max(a, b));
    if (begin == end)
      return 0.;
    const auto [least, most] = std::minmax_element(begin, end);
    return std::max({0.,
                     *most - std::max(at_a, at_b),
                     std::min(at_a, at_b) - *least}) /
           std::min(at_a, at_b);
  }



  std::optional<SampledFunction>
  SampledFunction::of(const std::function<double(double)> &function,
                      const double                         from,
                      const double                         to)
  {
    Sampler sampler(function, from, to);
    if (!sampler.sample())
      return {};
    return SampledFunction(std::move(sampler.x), std::move(sampler.values));
  }



  namespace
  {
    ParsedFormula read_formula(const EffectSection &section)
    {
      try
        {
          return ParsedFormula(section.text("Formula"), "x");
        }
      catch (const InputError &error)
        {
          section.reject("Formula", error.what());
        }
    }



    // The value at x, if it is allowed.
    std::function<double(double)> checked_formula(const EffectSection &section)
    {
      return [section, formula = read_formula(section)](const double x) {
        const double result = formula(x);
        if (!(result >= 1e-6 && result <= 1e6))
          section.reject("Formula",
                         "its value " + rounded_text(result, 6) + " at x = " +
                           rounded_text(x, 6) + " is not between 1e-6 and 1e6");
        return result;
      };
    }
  } // namespace



  SampledFunction SampledFunction::of_section(const EffectSection &section)
  {
    const double from = section.number("From"), to = section.number("To");
    if (!(from < to))
      section.reject("To", "must be greater than From");
    const auto sampled = of(checked_formula(section), from, to);
    if (!sampled.has_value())
      section.reject("Formula",
                     "it varies too quickly between From and To: more than "
                     "64000 samples would be needed; state the range that "
                     "the tests or the programme reach");
    return *sampled;
  }



  void SampledFunction::check_section(const EffectSection &section)
  {
    const auto missed = of_section(section).missed(checked_formula(section));
    if (missed.has_value())
      section.reject("Formula",
                     "it changes within much less than From to To, near x = " +
                       rounded_text(*missed, 6) +
                       "; state the range that the tests or the programme "
                       "reach");
  }
} // namespace SlipStep
