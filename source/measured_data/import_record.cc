// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/measured_data/import_columns.h>
#include <slipstep/measured_data/import_record.h>
#include <slipstep/measured_data/odd_rows.h>
#include <slipstep/measured_data/record_parts.h>
#include <slipstep/measured_data/resample.h>
#include <slipstep/measured_data/sensor_zero.h>
#include <slipstep/measured_data/test_rows.h>
#include <slipstep/measured_data/tidy_rows.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/text.h>

#include <boost/algorithm/string/predicate.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <sstream>

namespace SlipStep
{
  namespace
  {
    // Nothing that a shell or a URL would need quoted.
    std::string plain_name(const std::string &text)
    {
      std::string name;
      for (const char c : text)
        name += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' ||
                    c == '-' || c == '_' ?
                  c :
                  '_';
      return name;
    }



    // From the first row that has both, by trapezia; rows without are none.
    std::vector<double> integral(const std::vector<double> &time,
                                 const std::vector<double> &rate)
    {
      std::vector<double>        result(time.size());
      std::optional<std::size_t> last;
      for (std::size_t i = 0; i < time.size(); ++i)
        if (!std::isfinite(time[i] * rate[i]))
          result[i] = std::numeric_limits<double>::quiet_NaN();
        else
          {
            result[i] = last.has_value() ?
                          result[*last] + (time[i] - time[*last]) *
                                            (rate[i] + rate[*last]) / 2. :
                          0.;
            last      = i;
          }
      return result;
    }



    /// Converts one file. Columns are called by their keys in the map.
    class Converter
    {
    public:
      Converter(const Parameters  &map,
                const RawFile     &raw_file,
                const std::string &name)
        : map(map)
        , raw_file(raw_file)
        , name(name)
        , table(raw_file.file, raw_format(map))
        , columns(map, table)
      {}

      std::vector<MeasuredTest> convert()
      {
        if (!columns.has("Time"))
          map.reject("Columns/Time", "this column is needed");
        columns.read();
        doubt_header();
        select_rows();

        MeasuredTest record;
        record.file         = raw_file.file;
        record.time         = values("Time");
        record.displacement = turned(displacement(record.time));
        record.pressure     = pressure();
        doubt_zero_of_coefficient(record.pressure);
        record.friction = friction("", record.time, record.displacement);
        for (const std::string key : {"Friction y", "Tangential load y"})
          if (columns.has(key) && !columns.has("Displacement y"))
            map.reject("Columns/" + key,
                       "a second axis needs Columns/Displacement y, too");
        if (columns.has("Displacement y"))
          {
            record.displacement_y = turned(values("Displacement y"));
            record.friction_y =
              friction(" y", record.time, record.displacement_y);
          }
        if (columns.has("Temperature"))
          record.temperature = values("Temperature");
        note_signs();
        tidy(record);
        for (const std::string &words : doubts)
          record.warnings.push_back(raw_file.file.string() + ": " + words);
        for (const std::string &words : columns.contradictions())
          {
            record.warnings.push_back(raw_file.file.string() + ": " + words);
            std::string &note = notes["units"];
            note += (note.empty() ? "" : "; ") + words;
          }
        notes.insert(record.notes.begin(), record.notes.end());
        record.notes                   = notes;
        record.notes["converted from"] = raw_file.file.filename().string();
        return parts_of(record);
      }

    private:
      // A record without names begins with numbers, of which the first would
      // be lost as names.
      void doubt_header()
      {
        if (!raw_format(map).has_header)
          return;
        std::size_t n = 0;
        for (std::size_t i = 0; i < table.header().size(); ++i)
          {
            std::string name = table.header()[i];
            std::replace(name.begin(), name.end(), ',', '.');
            std::istringstream text(name);
            double             value = 0.;
            if (text >> value && text.eof() && value != i + 1.)
              ++n;
            else if (!name.empty())
              return;
          }
        if (n > 0)
          doubts.push_back(
            "the names of its columns are numbers (" + table.header_words() +
            "): if they are a row of the record, set Raw file/Has header = "
            "false");
      }

      // A displacement by its sign.
      std::vector<double> turned(std::vector<double> values) const
      {
        if (map.text("Convention/Displacement sign") == "reversed")
          for (double &value : values)
            value = -value;
        return values;
      }

      void note_signs()
      {
        const std::string motion   = map.text("Convention/Displacement sign"),
                          friction = map.text("Convention/Friction sign");
        std::string &note          = notes["signs"];
        if (motion == "reversed")
          note = "displacement reversed";
        if (friction == "reversed" || friction == "of the motion")
          note += (note.empty() ? "friction " : ", friction ") + friction;
        if (note.empty())
          notes.erase("signs");
      }

      // With what is known in place of {1}, {part} and so on.
      std::string
      filled_text(const std::string                        &path,
                  const std::map<std::string, std::string> &values) const
      {
        return map.attempt(path,
                           [&] { return filled_in(map.text(path), values); });
      }

      std::optional<double> constant(const std::string &path,
                                     const Dimension    dimension,
                                     const bool         is_positive)
      {
        std::string text = filled_text(path, raw_file.found);
        if (text.empty())
          return {};
        const std::string mark = " assumed";
        if (text != mark && boost::algorithm::ends_with(text, mark))
          {
            text.resize(text.size() - mark.size());
            const std::string word =
              path.substr(path.find('/') + 1) + " = " + text;
            std::string &assumed = notes["assumed"];
            if (assumed.find(word) == std::string::npos)
              assumed += (assumed.empty() ? "" : ", ") + word;
          }
        return map.attempt(path, [&] {
          try
            {
              const double value = parse_quantity(text, dimension, true);
              if (is_positive && value <= 0.)
                throw InputError("must be positive");
              return value;
            }
          catch (const InputError &error)
            {
              throw InputError(error.what() +
                               (raw_file.found.empty() ?
                                  std::string() :
                                  " (of " + raw_file.file.string() + ")"));
            }
        });
      }

      void select_rows()
      {
        const double infinity = std::numeric_limits<double>::infinity();
        const double begin = constant("Selection/Begin", Dimension::time, false)
                               .value_or(-infinity);
        const double end =
          constant("Selection/End", Dimension::time, false).value_or(infinity);
        if (end < begin)
          map.reject("Selection/End", "this is before Selection/Begin");
        const std::vector<double> time = columns.values("Time");
        for (std::size_t i = 0; i < time.size(); ++i)
          if (!(time[i] < begin - columns.clock()) &&
              !(time[i] > end - columns.clock()))
            selected.push_back(i);
        if (time.size() < 2)
          throw InputError(table.name() + ": it has " +
                           counted(time.size(), "row") +
                           ", and a test needs two");
        const std::string rows = std::to_string(selected.size()) + " of " +
                                 std::to_string(time.size()) + " rows";
        if (selected.size() < 2)
          throw InputError(table.name() + ": " + rows +
                           " are between Selection/Begin and End");
        if (selected.size() < time.size())
          notes["selection"] = rows + ", by their times";
      }

      std::vector<double> values(const std::string &key) const
      {
        return chosen(columns.values(key), selected);
      }

      std::vector<double> displacement(const std::vector<double> &time)
      {
        const auto speed = constant("Constants/Speed", Dimension::speed, false);
        if (columns.has("Displacement") + columns.has("Speed") +
              speed.has_value() !=
            1)
          map.reject(
            "Columns/Displacement",
            "give either this column, Columns/Speed or Constants/Speed");
        if (columns.has("Displacement"))
          return values("Displacement");
        if (columns.has("Speed"))
          {
            notes["positions"] = "integral of the recorded speed";
            return integral(time, values("Speed"));
          }
        const auto first = // a gap may begin the record
          std::find_if(time.begin(), time.end(), [](const double value) {
            return std::isfinite(value);
          });
        std::vector<double> result(time);
        for (double &value : result)
          value = first == time.end() ? value : *speed * (value - *first);
        return result;
      }

      std::vector<double> normal_load()
      {
        const auto load =
          constant("Constants/Normal load", Dimension::force, true);
        if (columns.has("Normal load") && load.has_value())
          map.reject("Columns/Normal load",
                     "give either this column or Constants/Normal load");
        if (columns.has("Normal load"))
          return values("Normal load");
        return load.has_value() ? std::vector<double>(selected.size(), *load) :
                                  std::vector<double>();
      }

      // Of a load, an area and a pressure two are enough.
      void
      check_area(const double load, const double area, const double pressure)
      {
        constexpr double alike = 0.05;

        if (std::abs(load / area - pressure) > alike * std::abs(pressure))
          map.reject("Constants/Area",
                     "the normal load of " + rounded_text(load, 4) +
                       " N over this area is " + rounded_text(load / area, 4) +
                       " MPa, but the pressure is " +
                       rounded_text(pressure, 4) +
                       " MPa: give two of the three");
        notes["area"] = exact_text(area) + " mm^2";
      }

      std::vector<double> pressure()
      {
        const auto given =
          constant("Constants/Pressure", Dimension::stress, true);
        const auto area = constant("Constants/Area", Dimension::area, true);
        std::vector<double> load = normal_load();
        if (columns.has("Pressure") && given.has_value())
          map.reject("Columns/Pressure",
                     "give either this column or Constants/Pressure");
        if (columns.has("Pressure") || given.has_value())
          {
            const std::vector<double> result =
              given.has_value() ? std::vector<double>(selected.size(), *given) :
                                  values("Pressure");
            if (!load.empty() && area.has_value())
              check_area(median(load), *area, median(result));
            return result;
          }
        if (load.empty() || !area.has_value())
          map.reject(load.empty() ? "Columns/Pressure" : "Constants/Area",
                     load.empty() ?
                       "the pressure is needed: a column, "
                       "Constants/Pressure, or a normal load with "
                       "Constants/Area" :
                       "the area is needed to turn the normal load "
                       "into a pressure");
        for (double &value : load)
          value /= *area;
        notes["area"] = exact_text(*area) + " mm^2";
        return load;
      }

      // axis: "" or " y".
      std::vector<double> friction(const std::string         &axis,
                                   const std::vector<double> &time,
                                   const std::vector<double> &motion)
      {
        const std::string coefficient = "Friction" + axis;
        const std::string tangential  = "Tangential load" + axis;
        if (columns.has(coefficient) == columns.has(tangential))
          map.reject("Columns/" + coefficient,
                     "give either this column or '" + tangential + "'");
        const std::string key =
          columns.has(coefficient) ? coefficient : tangential;
        std::vector<double> result = values(key);
        correct_sensor(key, time, motion, result);
        if (key == tangential)
          {
            std::vector<double> load = normal_load();
            doubt_constant_load(load);
            // Where the normal load varies, the quotient does not repeat
            // itself.
            if (const auto found = repeated_value(result);
                found.has_value() && range_of(load) > 0.)
              doubts.push_back(
                "the tangential load" + axis + " [N] " + found->words +
                " (first: line " +
                std::to_string(table.line(selected[found->first])) + ")");
            const auto area = constant("Constants/Area", Dimension::area, true);
            if (load.empty() && !area.has_value())
              map.reject("Columns/" + tangential,
                         "a coefficient needs the normal load, too: a column, "
                         "Constants/Normal load ('5 N assumed' if nobody knows "
                         "it), or the pressure with Constants/Area");
            if (load.empty())
              {
                for (const double value : pressure())
                  load.push_back(value * *area);
                notes["area"] = exact_text(*area) + " mm^2";
              }
            divide_by_load(load, result);
          }
        const std::string sign = map.text("Convention/Friction sign");
        if (sign == "reversed")
          for (double &value : result)
            value = -value;
        else if (sign == "of the motion")
          map.attempt("Convention/Friction sign",
                      [&] { give_sign_of_motion(time, motion, result); });
        return result;
      }

      // A load that stays while the pressure does not.
      void doubt_constant_load(const std::vector<double> &load)
      {
        constexpr double much = 0.2;

        if (load.empty() || range_of(load) > 0. || !columns.has("Pressure"))
          return;
        const std::vector<double> pressure = values("Pressure");
        const double              varies   = range_of(pressure);
        const std::string         words =
          "friction is the tangential load divided by a normal load of " +
          rounded_text(load.front(), 4) +
          " N throughout, although the pressure varies by " +
          rounded_text(varies, 3) +
          " MPa: give Constants/Area instead of the load, or a column of the "
          "load";
        if (varies > much * median(pressure) && !holds(doubts, words))
          doubts.push_back(words);
      }

      // Before the first touch there is no load, and no friction but what the
      // sensor's noise is.
      static void divide_by_load(const std::vector<double> &load,
                                 std::vector<double>       &tangential)
      {
        constexpr double noise = 0.02;

        const double most = range_of(tangential);
        for (std::size_t i = 0; i < tangential.size(); ++i)
          tangential[i] =
            load[i] == 0. && std::abs(tangential[i]) <= noise * most ?
              0. :
              tangential[i] / load[i];
      }

      // What a sensor of force shows without force is the less of a coefficient
      // the higher the load.
      void doubt_zero_of_coefficient(const std::vector<double> &pressure)
      {
        constexpr double much = 0.05;

        const double usual = median(pressure);
        if (map.text("Correction/Zero") != "none" && columns.has("Friction") &&
            range_of(pressure) > much * usual)
          doubts.push_back(
            "Correction/Zero of a coefficient: the zero of a load cell is a "
            "force, and the load here varies by " +
            rounded_text(100. * range_of(pressure) / usual, 2) +
            " %: give the tangential load (Columns/Tangential load), or import "
            "parts with one load each");
      }

      void correct_sensor(const std::string         &key,
                          const std::vector<double> &time,
                          const std::vector<double> &motion,
                          std::vector<double>       &signal)
      {
        constexpr double alike = 2.;

        std::string       what  = key;
        const std::string unit  = key.rfind("Tangential", 0) == 0 ? " N" : "";
        const std::string drift = map.text("Correction/Drift"),
                          zero  = map.text("Correction/Zero");
        what[0]                 = std::tolower(what[0]);
        const double slope      = map.attempt("Correction/Drift", [&] {
          return take_off_drift(drift, time, motion, signal);
        });
        const double value      = map.attempt("Correction/Zero", [&] {
          const auto   sign  = zero == "mean of strokes" ?
                                      friction_of_one_sign(time, motion, signal) :
                                      std::nullopt;
          const double value = take_off_zero(zero, time, motion, signal);
          if (sign.has_value() &&
              std::abs(sign->forth - sign->back) <= alike * sign->scatter)
            throw InputError(
              "it subtracts nearly the whole friction, " +
              rounded_text(value, 4) + unit +
              ": is friction recorded without a sign (Convention/Friction "
                   "sign = of the motion)?");
          return value;
        });
        if (zero.rfind("mean of the first", 0) == 0 && std::abs(value) > 0. &&
            moves_in_first(zero, time, motion))
          doubts.push_back(
            "Correction/Zero = " + zero +
            ": there is motion in that time. If there is contact then, too, "
            "friction is subtracted from the " +
            what + " together with the zero");
        std::string &note = notes["corrected"];
        if (drift != "none")
          note += (note.empty() ? "" : "; ") + what + " less a drift of " +
                  rounded_text(slope, 4) + unit + "/s about mid-time";
        if (zero != "none")
          note += (note.empty() ? "" : "; ") + what + " less " +
                  rounded_text(value, 4) + unit + ", its " + zero;
      }

      void tidy(MeasuredTest &test) const
      {
        const auto key_of = [this](const std::string &channel) {
          const std::string axis =
            boost::algorithm::ends_with(channel, "_y") ? " y" : "";
          if (channel.rfind("friction", 0) == 0)
            return (columns.has("Friction" + axis) ? "Friction" :
                                                     "Tangential load") +
                   axis;
          if (channel.rfind("displacement", 0) == 0)
            return "Displacement" + axis;
          if (channel == "pressure")
            return std::string(columns.has("Pressure") ? "Pressure" :
                                                         "Normal load");
          return std::string(channel == "time" ? "Time" : "Temperature");
        };
        tidy_rows(test,
                  {[&](const std::size_t  row,
                       const std::string &channel,
                       const std::string &why) {
                     columns.reject(selected[row], key_of(channel), why);
                   },
                   [&](const std::size_t row) {
                     return table.line(selected[row]);
                   }});
      }

      std::vector<MeasuredTest> parts_of(const MeasuredTest &record) const
      {
        const std::string         cut    = map.text("Selection/Cut");
        const auto                parts  = map.attempt("Selection/Cut", [&] {
          auto found = cut_record(record, cut, columns.clock());
          if (found.empty())
            throw InputError("no part has the two rows that a test needs");
          return found;
        });
        const auto                chosen = map.attempt("Selection/Parts", [&] {
          return chosen_parts(map.text("Selection/Parts"), parts.size());
        });
        std::vector<MeasuredTest> tests;
        for (const std::size_t number : chosen)
          {
            const RecordPart        &part = parts[number - 1];
            MeasuredTest             test = record;
            std::vector<std::size_t> rows(part.end - part.begin);
            std::iota(rows.begin(), rows.end(), part.begin);
            keep_rows(test, rows);
            if (!tests.empty())
              test.warnings.clear(); // they are of the whole record
            if (cut == "none")
              name_test(test, raw_file.found, "", "");
            else
              name_part(test, number, parts.size());
            start_from_zero(test);
            thin_out(test);
            tests.push_back(test);
          }
        return tests;
      }

      void name_part(MeasuredTest     &test,
                     const std::size_t number,
                     const std::size_t n_parts) const
      {
        std::map<std::string, std::string> values = raw_file.found;
        const std::string                  digits = std::to_string(number);
        values["part"] =
          std::string(n_parts > 9 && number < 10 ? "0" : "") + digits;
        values["way"] = test.displacement.back() < test.displacement.front() ?
                          "back" :
                          "forth";
        test.notes["part"] = digits + " of " + std::to_string(n_parts) +
                             " (cut " + map.text("Selection/Cut") + "), from " +
                             rounded_text(test.time.front(), 7) + " s to " +
                             rounded_text(test.time.back(), 7) +
                             " s of the record";
        name_test(test, values, "_part_" + values["part"], ", part " + digits);
      }

      // File and name get what tells the part, unless the map says where.
      void name_test(MeasuredTest                             &test,
                     const std::map<std::string, std::string> &values,
                     const std::string                        &numbered,
                     const std::string                        &words) const
      {
        const auto text = [&](const std::string &key) {
          return filled_text("Test/" + key, values);
        };
        const auto is_numbered = [&](const std::string &key) {
          return map.text("Test/" + key).find("{part}") != std::string::npos;
        };
        const std::string file = plain_name(text("File"));
        test.file              = (file.empty() ? name : file) +
                    (is_numbered("File") ? "" : numbered) + ".csv";
        const std::string title = text("Name");
        test.name = (title.empty() ? raw_file.file.stem().string() : title) +
                    (is_numbered("Name") ? "" : words);
        test.condition = text("Condition");
        for (const std::string key : {"Source", "Licence", "Remark"})
          test.notes[lower_case(key)] = text(key);
      }

      void start_from_zero(MeasuredTest &test) const
      {
        if (!map.boolean("Convention/Start from zero"))
          {
            for (double &time : test.time)
              time += columns.clock();
            return;
          }
        for (auto *series :
             {&test.time, &test.displacement, &test.displacement_y})
          if (!series->empty())
            {
              const double first = series->front();
              for (double &value : *series)
                value -= first;
              if (series != &test.time && first != 0.)
                {
                  std::string &note = test.notes["positions"];
                  note += (note.empty() ? "counted from " : " and ") +
                          rounded_text(first, 6) +
                          (series == &test.displacement ? " mm" : " mm (y)");
                }
            }
      }

      void thin_out(MeasuredTest &test) const
      {
        const std::size_t n_recorded = test.time.size();
        const std::size_t step       = map.integer("Selection/Row step");
        if (step > 1)
          {
            std::vector<std::size_t> rows;
            for (std::size_t i = 0; i < n_recorded; i += step)
              rows.push_back(i);
            if (rows.size() < 2)
              map.reject("Selection/Row step",
                         "of " + std::to_string(n_recorded) +
                           " rows fewer than two are left");
            keep_rows(test, rows);
            test.notes["row step"] = std::to_string(step) + ", " +
                                     std::to_string(rows.size()) + " of " +
                                     std::to_string(n_recorded) + " rows";
          }
        const std::size_t most = map.integer("Selection/Most rows");
        const std::size_t n    = test.time.size();
        if (most == 0 || n <= most)
          return;
        ResampleOptions options;
        options.most_rows = most;
        // The few rows left no longer show it: peaks and bends look like noise.
        const double noise = noise_of_friction(test);
        if (noise > 0.)
          test.notes.emplace("noise", rounded_text(noise, 3));
        const auto resampled = resample(test, options);
        // Fewer rows than the turns that are kept no tolerance gets.
        const double tolerance =
          std::min(resampled.friction_tolerance, range_of(test.friction));
        test = resampled.test;
        test.notes["resampled"] =
          std::to_string(test.time.size()) + " of " + std::to_string(n) +
          " rows; friction within " + rounded_text(tolerance, 3) +
          " of every row left out";
      }

      const Parameters        &map;
      const RawFile            raw_file;
      const std::string        name;
      CsvTable                 table;
      ImportColumns            columns;
      std::vector<std::size_t> selected;

      /// What was done and supposed, for the comments of the tests.
      std::map<std::string, std::string> notes;
      std::vector<std::string>           doubts;
    };
  } // namespace



  std::vector<MeasuredTest> import_record(const Parameters  &map,
                                          const RawFile     &raw_file,
                                          const std::string &name)
  {
    return Converter(map, raw_file, name).convert();
  }
} // namespace SlipStep
