// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/report/calibration_report.h>

#include <slipstep/utilities/text.h>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  namespace
  {
    /// Over all rows of all tests.
    double total_rms(const Calibration &calibration, double TestMisfit::*rms)
    {
      double sum = 0., n = 0.;
      for (const TestMisfit &test : calibration.tests)
        {
          sum += test.n_rows * test.*rms * test.*rms;
          n += test.n_rows;
        }
      return std::sqrt(sum / n);
    }

    /// Whether both parameters are members of the same weak direction.
    bool are_named(const Calibration &calibration,
                   const std::size_t  i,
                   const std::size_t  j)
    {
      return any_of(calibration.weak, [&](const WeakDirection &weak) {
        return holds(weak.members, i) && holds(weak.members, j);
      });
    }

    /// Beyond this a factor says only that nothing is known.
    constexpr double largest_factor = 1000.;

    std::string factor_text(const double logarithm)
    {
      const double factor = std::exp(std::abs(logarithm));
      return factor > largest_factor ? "> " + short_text(largest_factor) :
                                       short_text(factor, factor < 1.1 ? 4 : 3);
    }



    bool is_open(const FittedParameter &fitted)
    {
      return fitted.constraint.empty() &&
             (fitted.is_lower_open || fitted.is_upper_open);
    }



    TableLines short_parameter_lines(const Calibration &calibration)
    {
      TableLines lines = {table_head("parameter | value | unit | " +
                                     interval_name(calibration.confidence) +
                                     " | start")};
      for (const FittedParameter &fitted : calibration.parameters)
        lines.push_back(
          {label_of(fitted.parameter),
           (fitted.is_at_bound ? "* " : "") + digits_text(fitted, fitted.value),
           fitted.parameter.unit(),
           interval_text(fitted),
           plain_text(fitted.parameter.in_unit(fitted.parameter.start), 5)});
      return lines;
    }
  } // namespace



  std::string calibration_headline(const Calibration &calibration)
  {
    std::string text = counted(calibration.parameters.size(), "parameter") +
                       " from " + counted(calibration.tests.size(), "test") +
                       ": rms difference of friction " +
                       short_text(total_rms(calibration, &TestMisfit::rms), 3);
    const double ratio = std::sqrt(calibration.misfit / calibration.n_rows);
    if (std::isfinite(ratio))
      text += ", " +
              (ratio < 10. ? fixed_text(ratio, 2) : short_text(ratio, 3)) +
              " times the noise";
    text += "; it was " +
            short_text(total_rms(calibration, &TestMisfit::start_rms), 3) +
            " with the start values.";
    const std::size_t n_open = count_if(calibration.parameters, is_open);
    if (n_open > 0)
      text += " " + counted(n_open, "parameter") +
              (n_open == 1 ? " has" : " have") + " an open interval.";
    return text;
  }



  std::string open_intervals(const Calibration &calibration)
  {
    std::string text;
    for (const FittedParameter &fitted : calibration.parameters)
      if (is_open(fitted))
        text += (text.empty() ? "" : ", ") + label_of(fitted.parameter) +
                (!fitted.is_upper_open ? " (no lower end)" :
                 !fitted.is_lower_open ? " (no upper end)" :
                                         " (neither end)");
    return text.empty() ?
             "" :
             "Up to their bounds, these tests do not limit: " + text + ".";
  }



  std::string close_pairs(const Calibration &calibration)
  {
    constexpr double                            close    = 0.95;
    constexpr std::size_t                       n_listed = 6;
    std::vector<std::pair<double, std::string>> pairs;
    const auto &matrix = calibration.correlation;
    for (std::size_t i = 0; i < matrix.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (std::abs(matrix[i][j]) > close && !are_named(calibration, i, j))
          pairs.emplace_back(std::abs(matrix[i][j]),
                             label_of(calibration.parameters[j].parameter) +
                               " and " +
                               label_of(calibration.parameters[i].parameter) +
                               " (" + correlation_text(matrix[i][j]) + ")");
    if (pairs.empty())
      return "";
    stable_sort(pairs,
                [](const auto &a, const auto &b) { return a.first > b.first; });
    std::string text;
    for (std::size_t i = 0; i < std::min(pairs.size(), n_listed); ++i)
      text += (i > 0 ? ", " : "") + pairs[i].second;
    if (pairs.size() > n_listed)
      text += ", and " + std::to_string(pairs.size() - n_listed) + " more";
    return "These values belong together, changing one alone spoils the fit "
           "(correlation): " +
           text + ".";
  }



  std::string correlation_text(const double correlation)
  {
    // Full correlation is claimed only where it is full.
    if (std::abs(correlation) > 0.9999 && std::abs(correlation) < 1.)
      return correlation < 0. ? "< -0.9999" : "> 0.9999";
    return fixed_text(correlation, std::abs(correlation) > 0.99 ? 4 : 2);
  }



  std::string change_text(const Calibration   &calibration,
                          const WeakDirection &direction)
  {
    std::string text;
    for (const std::size_t i : direction.members)
      {
        const FitParameter &parameter = calibration.parameters[i].parameter;
        const double        change    = direction.change[i];
        const std::string   unit      = parameter.unit();
        text += (text.empty() ? "" : ", ") + label_of(parameter);
        if (parameter.is_logarithmic)
          text += (change < 0. ? " ÷ " : " × ") + factor_text(change);
        else
          text += (change < 0. ? " " : " +") +
                  short_text(parameter.in_unit(change), 3) +
                  (unit.empty() ? "" : " " + unit);
      }
    return text;
  }



  std::string interval_name(const double confidence)
  {
    return short_text(100. * confidence) + " % interval";
  }



  std::string digits_text(const FittedParameter &fitted, const double value)
  {
    const FitParameter &parameter = fitted.parameter;
    const double        size      = std::abs(parameter.in_unit(fitted.value));
    const double        deviation = parameter.is_logarithmic ?
                                      fitted.deviation * size :
                                      parameter.in_unit(fitted.deviation);
    const double        shown     = parameter.in_unit(value);
    // Two digits of the deviation, the value to the same decimals; but not for
    // values that differ by orders of magnitude or need many zeros.
    if (deviation > 0. && deviation < 0.3 * size && size > 1e-3 && size < 1e6 &&
        (!parameter.is_logarithmic || shown > 0.1 * size))
      {
        const int decimals = 1 - std::floor(std::log10(deviation));
        if (decimals >= 0)
          return fixed_text(shown, std::min(decimals, 8));
        const double step = std::pow(10., -decimals);
        return fixed_text(step * std::round(shown / step), 0);
      }
    const bool   is_known = deviation > 0. && deviation < size;
    const double digits   = is_known ? 2. - std::log10(deviation / size) : 3.;
    return plain_text(shown, std::clamp(static_cast<int>(digits), 3, 7));
  }



  std::string interval_text(const FittedParameter &fitted)
  {
    if (!fitted.constraint.empty())
      return "–";
    const std::string lower = digits_text(fitted, fitted.lower);
    const std::string upper = digits_text(fitted, fitted.upper);
    return fitted.is_lower_open ?
             (fitted.is_upper_open ? "open" : "≤ " + upper) :
             (fitted.is_upper_open ? "≥ " + lower : lower + " … " + upper);
  }



  std::string deviation_text(const FittedParameter &fitted)
  {
    if (!std::isfinite(fitted.deviation))
      return "unknown";
    return fitted.parameter.is_logarithmic ?
             "×/÷ " + factor_text(fitted.deviation) :
             "± " + short_text(fitted.parameter.in_unit(fitted.deviation), 2);
  }



  TableLines derived_lines(const Calibration &calibration, const bool in_full)
  {
    ColumnTable<DerivedQuantity> table(calibration.derived);
    table.add(in_full ? "quantity" : "derived", &DerivedQuantity::name);
    if (in_full)
      table.add("formula", &DerivedQuantity::formula);
    table.add_short("value", 4, &DerivedQuantity::value);
    table.add("standard deviation", [](const DerivedQuantity &quantity) {
      return std::isfinite(quantity.deviation) ?
               "± " + short_text(quantity.deviation, 2) :
               "unknown";
    });
    return table.lines;
  }



  TableLines test_lines(const Calibration &calibration, const bool in_full)
  {
    ColumnTable<TestMisfit> table(calibration.tests);
    table.add("test", &TestMisfit::name);
    table.add("rows", &TestMisfit::n_rows);
    table.add_short("start rms", 3, &TestMisfit::start_rms);
    table.add_short("rms", 3, &TestMisfit::rms);
    table.add("noise", [&](const TestMisfit &test) {
      return short_text(test.noise, 3) +
             (in_full && test.noise_is_stated ? " (stated)" : "");
    });
    table.add("rms/noise", 2, noise_ratio);
    if (!in_full)
      return table.lines;

    table.add("mean offset", 5, &TestMisfit::mean);
    table.add_short("correlated rows", 2, &TestMisfit::correlation_length);
    table.add_short("work measured [N/mm]", 4, &TestMisfit::measured_work);
    table.add_short("fitted [N/mm]", 4, &TestMisfit::simulated_work);
    table.add("difference [%]", [](const TestMisfit &test) {
      const double difference =
        100. * (test.simulated_work / test.measured_work - 1.);
      return (difference > 0. ? "+" : "") + fixed_text(difference, 2);
    });
    return table.lines;
  }



  std::string calibration_table(const Calibration &calibration)
  {
    std::string text = wrapped_text(calibration_headline(calibration)) +
                       table_paragraph(short_parameter_lines(calibration));
    if (any_of(calibration.parameters,
               std::mem_fn(&FittedParameter::is_at_bound)))
      text += "  * at a bound, or at a condition of the law\n";
    text += table_paragraph(derived_lines(calibration, false)) +
            table_paragraph(test_lines(calibration, false));
    if (!calibration.weak.empty())
      text += "\n  What these tests hardly determine:\n";
    for (const WeakDirection &direction : calibration.weak)
      {
        std::string words = wrapped_text(direction.words, 4);
        if (words.size() > 2)
          words[2] = '-';
        text += words;
      }
    return text;
  }
} // namespace SlipStep
