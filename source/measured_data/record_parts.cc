// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/utilities.h>

#include <slipstep/measured_data/record_parts.h>
#include <slipstep/measured_data/test_rows.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/text.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

namespace SlipStep
{
  namespace
  {
    const char *const allowed_cuts =
      "allowed: none, at reversals, every 5 cycles, at holds of 2 s, after "
      "holds of 2 s, at 10 s, 20 s";

    bool read_count(const std::string &text, std::size_t &number)
    {
      const char *const end    = text.data() + text.size();
      const auto [stop, error] = std::from_chars(text.data(), end, number);
      return error == std::errc() && stop == end && number > 0;
    }

    // The text behind a beginning.
    bool begins_with(const std::string &text,
                     const std::string &beginning,
                     std::string       &rest)
    {
      if (text.rfind(beginning, 0) != 0)
        return false;
      rest = dealii::Utilities::trim(text.substr(beginning.size()));
      return true;
    }

    double read_duration(const std::string &text)
    {
      const double duration = parse_quantity(text, Dimension::time, true);
      if (!(duration > 0.))
        throw InputError("a rest lasts longer than " + text);
      return duration;
    }

    /// Where strokes end: of a rest between them the first row, wherever noise
    /// makes another one of it the farthest.
    std::vector<std::size_t> ends_of_strokes(const MeasuredTest &record)
    {
      constexpr double scatter = 8., longer = 4.;

      const std::vector<double> &x = record.displacement, &t = record.time;
      const double               noise = noise_level(x);
      std::vector<std::size_t>   rows =
        turning_rows(x, std::max(4. * noise, 0.005 * range_of(x)));
      const double speed =
        (rows.size() + 1) * range_of(x) / (t.back() - t.front());
      for (std::size_t &row : rows)
        {
          const auto is_near = [&, turn = row](const std::size_t other) {
            return std::abs(x[other] - x[turn]) <= scatter * noise;
          };
          std::size_t first = row, last = row;
          while (first > 0 && is_near(first - 1))
            --first;
          while (last + 1 < x.size() && is_near(last + 1))
            ++last;
          // To and fro takes some time, too, and a crank slows down; but then
          // the middle is farther than the rest.
          const auto mean = [&](const std::size_t begin,
                                const std::size_t end) {
            return std::accumulate(x.begin() + begin, x.begin() + end, 0.) /
                   (end - begin);
          };
          const std::size_t n = last - first + 1, third = n / 3;
          if (third == 0 ||
              (t[last] - t[first]) * speed < longer * 2. * scatter * noise)
            continue;
          const double ends =
            (mean(first, first + third) + mean(last + 1 - third, last + 1)) /
            2.;
          if (std::abs(mean(first + third, last + 1 - third) - ends) < noise)
            row = first;
        }
      return rows;
    }

    /// Rests of at least a duration.
    std::vector<RecordPart> rests(const MeasuredTest &record,
                                  const double        duration)
    {
      const std::vector<double> &x = record.displacement;
      const double band = std::max(4. * noise_level(x), 1e-4 * range_of(x));
      std::vector<RecordPart> result;
      double                  least = x[0], most = x[0];
      std::size_t             begin = 0;
      for (std::size_t i = 0; i <= x.size(); ++i)
        {
          if (i < x.size() &&
              std::max(most, x[i]) - std::min(least, x[i]) <= 2. * band)
            {
              least = std::min(least, x[i]);
              most  = std::max(most, x[i]);
              continue;
            }
          if (record.time[i - 1] - record.time[begin] >= duration)
            {
              result.push_back({begin, i});
              begin = i;
            }
          else if (i < x.size())
            // The latest beginning from which all rows are within the band.
            for (begin = i; begin > 0; --begin)
              {
                least = begin == i ? x[i] : std::min(least, x[begin]);
                most  = begin == i ? x[i] : std::max(most, x[begin]);
                if (std::max(most, x[begin - 1]) -
                      std::min(least, x[begin - 1]) >
                    2. * band)
                  break;
              }
          if (i < x.size())
            {
              const auto range =
                std::minmax_element(x.begin() + begin, x.begin() + i + 1);
              least = *range.first;
              most  = *range.second;
            }
        }
      return result;
    }

    std::vector<std::size_t> rows_at_times(const MeasuredTest &record,
                                           const std::string  &text,
                                           const double        clock)
    {
      const unsigned int       n_digits = clock > 0. ? 13 : 6;
      std::vector<std::size_t> rows;
      double                   last = -1e300;
      for (const std::string &item :
           dealii::Utilities::split_string_list(text, ","))
        {
          const double time =
            parse_quantity(item, Dimension::time, true) - clock;
          if (time <= last)
            throw InputError("the times must increase");
          last = time;
          if (time < record.time.front() || time > record.time.back())
            throw InputError(
              item +
              " is outside of the record, which goes "
              "from " +
              rounded_text(record.time.front() + clock, n_digits) + " s to " +
              rounded_text(record.time.back() + clock, n_digits) + " s");
          rows.push_back(
            std::lower_bound(record.time.begin(), record.time.end(), time) -
            record.time.begin());
        }
      return rows;
    }

    /// Parts from each of these rows to the next.
    std::vector<RecordPart> parts_from(std::vector<std::size_t> rows,
                                       const std::size_t        end)
    {
      rows.push_back(end);
      std::vector<RecordPart> parts;
      for (std::size_t i = 0; i + 1 < rows.size(); ++i)
        if (rows[i + 1] >= rows[i] + 2) // less is no test
          parts.push_back({rows[i], rows[i + 1]});
      return parts;
    }

    std::vector<RecordPart> cycles(const std::vector<std::size_t> &turns,
                                   const std::size_t               n_cycles)
    {
      std::vector<RecordPart> parts;
      for (std::size_t i = 0; i + 2 * n_cycles < turns.size();
           i += 2 * n_cycles)
        parts.push_back({turns[i], turns[i + 2 * n_cycles]});
      if (parts.empty())
        throw InputError("the motion turns " + std::to_string(turns.size()) +
                         " times only, " + std::to_string(2 * n_cycles + 1) +
                         " are needed");
      return parts;
    }
  } // namespace



  std::vector<RecordPart> cut_record(const MeasuredTest &record,
                                     const std::string  &cut,
                                     const double        clock)
  {
    const std::size_t n = record.time.size();

    const std::string text = cut.empty() ? "none" : cut;
    if (text == "none")
      return {{0, n}};

    std::string rest;
    const bool  is_after = begins_with(text, "after holds of", rest);
    if (is_after || begins_with(text, "at holds of", rest))
      {
        const double             duration = read_duration(rest);
        std::vector<std::size_t> rows     = {0};
        for (const RecordPart &hold : rests(record, duration))
          rows.push_back(is_after ? hold.end - 1 : hold.begin);
        if (rows.size() == 1)
          throw InputError("the record has no rest of " + rest);
        return parts_from(rows, n);
      }

    if (text == "at reversals" || begins_with(text, "every", rest))
      {
        const std::vector<std::size_t> turns = ends_of_strokes(record);
        if (turns.empty())
          throw InputError("the motion of the record never turns");
        if (text == "at reversals")
          {
            std::vector<std::size_t> rows = turns;
            rows.insert(rows.begin(), 0);
            return parts_from(rows, n);
          }
        const std::size_t blank    = rest.find(' ');
        std::size_t       n_cycles = 0;
        if (blank == std::string::npos ||
            !read_count(rest.substr(0, blank), n_cycles) ||
            (rest.substr(blank + 1) != "cycles" &&
             rest.substr(blank + 1) != "cycle"))
          throw InputError(allowed_cuts);
        return cycles(turns, n_cycles);
      }

    if (begins_with(text, "at ", rest))
      {
        std::vector<std::size_t> rows = rows_at_times(record, rest, clock);
        rows.insert(rows.begin(), 0);
        return parts_from(rows, n);
      }
    throw InputError(allowed_cuts);
  }



  std::vector<std::size_t> chosen_parts(const std::string &text,
                                        const std::size_t  n_parts)
  {
    std::vector<std::size_t> chosen;
    if (text.empty() || text == "all")
      for (std::size_t i = 1; i <= n_parts; ++i)
        chosen.push_back(i);
    else
      for (const std::string &item :
           dealii::Utilities::split_string_list(text, ","))
        {
          const std::size_t to    = item.find(" to ");
          std::size_t       first = 0, last = 0;
          if (!read_count(dealii::Utilities::trim(item.substr(0, to)), first) ||
              !read_count(dealii::Utilities::trim(to == std::string::npos ?
                                                    item :
                                                    item.substr(to + 4)),
                          last) ||
              first > last)
            throw InputError("'" + item +
                             "': write numbers of parts as in 2, 4, 6 to 8");
          if (last > n_parts)
            throw InputError("the record has " + counted(n_parts, "part") +
                             " only");
          for (std::size_t i = first; i <= last; ++i)
            if (holds(chosen, i))
              throw InputError("part " + std::to_string(i) + " is named twice");
            else
              chosen.push_back(i);
        }
    return chosen;
  }
} // namespace SlipStep
