// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/measured_data/column_words.h>
#include <slipstep/measured_data/import_columns.h>
#include <slipstep/measured_data/import_proposal.h>
#include <slipstep/measured_data/import_record.h>
#include <slipstep/measured_data/measured_test.h>
#include <slipstep/measured_data/test_rows.h>
#include <slipstep/measured_data/tidy_rows.h>
#include <slipstep/utilities/encoding.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/text.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

namespace SlipStep
{
  namespace
  {
    const std::string days_of_spreadsheets =
      "; the file does not say the unit, but it looks like a date of "
      "spreadsheets, in days";

    // Without letters that a map in another encoding would not show.
    bool is_plain(const std::string &text)
    {
      return all_of(text, [](const char c) {
        return static_cast<unsigned char>(c) < 0x7f;
      });
    }



    /// Looks at one file.
    class Observer
    {
    public:
      explicit Observer(const std::filesystem::path &file)
      {
        proposal.file    = file;
        proposal.layout  = record_layout(file);
        proposal.guesses = guesses_of_layout(file, proposal.layout);
      }

      ImportProposal propose()
      {
        read_columns();
        choose_axis();
        choose_columns();
        choose_second_axis();
        guess_shear_stress();
        guess_loads();
        guess_signs();
        guess("Test/Condition",
              condition(),
              "tests of the same condition are replicates: state everything in "
              "which tests differ",
              true);
        return proposal;
      }

    private:
      void guess(const std::string &path,
                 const std::string &value,
                 const std::string &reason,
                 const bool         is_open = false)
      {
        proposal.guesses.push_back({path, value, reason, is_open});
      }

      void read_columns()
      {
        CsvTable table(proposal.file, raw_format(proposal.map()));
        header = table.header();
        std::map<std::string, std::size_t> positions;
        const bool is_named = proposal.layout.header_line > 0 &&
                              !proposal.layout.has_unclear_header;
        for (std::size_t i = 0; i < header.size(); ++i)
          {
            SeenColumn column;
            column.number = i + 1;
            if (is_named)
              split_name(header[i], column.name, column.unit);
            else if (!proposal.layout.names.empty())
              split_name(proposal.layout.names[i], column.name, column.unit);
            if (!table.units()[i].empty())
              column.unit = table.units()[i];
            column.has_numbers = holds(proposal.layout.numbers, i);
            if (column.has_numbers)
              positions["column " + std::to_string(i + 1)] = i;
            proposal.columns.push_back(column);
          }
        table.read(positions);
        values.resize(proposal.columns.size());
        finite.resize(proposal.columns.size());
        for (const auto &[name, i] : positions)
          {
            values[i] = table[name];
            for (const double value : values[i])
              if (!std::isnan(value))
                finite[i].push_back(value);
            if (finite[i].empty())
              continue;
            const auto range =
              std::minmax_element(finite[i].begin(), finite[i].end());
            proposal.columns[i].least = *range.first;
            proposal.columns[i].most  = *range.second;
          }
      }

      static Dimension dimension_of(const std::string &key)
      {
        for (const ColumnKey &known : column_keys())
          if (known.name == key)
            return known.dimension;
        return Dimension::number;
      }

      // Above 0: it may be; a name and a unit are worth more than either.
      int score(const KeyWords &words, const std::size_t column) const
      {
        const SeenColumn &seen = proposal.columns[column];
        if (!seen.has_numbers || !seen.taken_as.empty() ||
            has_word(seen.name, words.against) ||
            (words.is_along_axis && is_across(seen.name)))
          return 0;
        const Dimension dimension = dimension_of(words.key);
        const auto      known = seen.unit.empty() ? std::optional<Dimension>() :
                                                    dimension_of_unit(seen.unit);
        const bool      has_unit = !seen.unit.empty() && seen.unit != "-" &&
                              seen.unit != "." && seen.unit != "1" &&
                              seen.unit != "/" && seen.unit != "%";
        if (known.has_value() ? *known != dimension :
                                has_unit && dimension == Dimension::number)
          return 0;
        int points = 0;
        for (const std::string &word : words.words)
          points += seen.name.find(word) != std::string::npos ? 4 : 0;
        for (const std::string &label : words.labels)
          points += label_of(seen.name) == label ? 4 : 0;
        const bool varies = seen.most > seen.least;
        // Of many lengths and forces only the name tells which they are.
        if (known.has_value() && dimension != Dimension::force &&
            dimension != Dimension::length)
          points += 3;
        if (points == 0)
          return 0;
        if (known.has_value())
          points += 2;
        if ((words.key == "Normal load" || words.key == "Pressure") &&
            is_called_normal(seen.name))
          points += 4;
        if (varies)
          points += 2;
        if ((words.key == "Time" && !is_in_order(column)) ||
            ((words.key == "Time" || words.key == "Displacement") && !varies))
          return 0;
        if (has_word(seen.name, ordered_words()))
          --points;
        if (words.key == "Friction" && seen.unit != "%" &&
            !finite[column].empty() &&
            median(finite[column]) > 3.) // a percentage, or a force
          return 0;
        return points;
      }

      // Along a vertical axis, or along that which does not move.
      bool is_across(const std::string &name) const
      {
        const char own = axis_of(name);
        return own == 'z' || (own != '\0' && axis != '\0' && own != axis);
      }

      // Of two axes that which moves by far more, if one does.
      void choose_axis()
      {
        constexpr double clearly = 5.;

        std::map<char, double> motions;
        std::set<char>         frictions;
        for (const KeyWords &words : key_words())
          for (std::size_t i = 0; words.is_along_axis && i < values.size(); ++i)
            {
              const SeenColumn &seen = proposal.columns[i];
              const char        own  = axis_of(seen.name);
              if (own == '\0' || score(words, i) == 0)
                continue;
              if (words.key == "Displacement")
                motions[own] =
                  std::max(motions[own],
                           (dimension_of_unit(seen.unit) == Dimension::length ?
                              unit_conversion(seen.unit, Dimension::length) :
                              UnitConversion())(seen.most - seen.least));
              else
                frictions.insert(own);
            }
        for (const char one : {'x', 'y'})
          if (motions[one] > clearly * motions[one == 'x' ? 'y' : 'x'])
            axis = one;
        const bool moves = motions['x'] > 0. || motions['y'] > 0.;
        has_two_axes     = moves && axis == '\0' && frictions.size() > 1;
        if (has_two_axes)
          axis = 'x';
        else if (moves ? axis == '\0' : frictions.size() > 1)
          axis_doubt =
            "; the record has a second axis (Displacement y, Tangential load "
            "y, Friction y): or is that the axis of sliding?";
        else if (moves && !frictions.empty() && frictions.count(axis) == 0)
          {
            axis_doubt = "; no friction is recorded along the axis that moves";
            axis       = '\0';
          }
      }

      // How a map names a column.
      std::string reference(const std::size_t column) const
      {
        const std::string &name = header[column];
        const bool         is_unique =
          std::count(header.begin(), header.end(), name) == 1;
        const bool is_plain = !name.empty() && all_of(name, [](char c) {
          const auto byte = static_cast<unsigned char>(c);
          return byte >= 0x20 && byte < 0x7f && c != '#' && c != '\\' &&
                 c != '{' && c != '}';
        });
        return is_unique && is_plain ? name :
                                       "column " + std::to_string(column + 1);
      }

      // What a number stands for.
      std::string heading_behind(const std::string &reference,
                                 const std::size_t  column) const
      {
        const std::string &name = proposal.layout.names.empty() ?
                                    header[column] :
                                    proposal.layout.names[column];
        if (reference == name || proposal.columns[column].name.empty())
          return "";
        return "'" + readable_text(name) + "' ";
      }

      void choose_columns()
      {
        for (const KeyWords &words : key_words())
          {
            std::size_t best = best_column(words.key);
            if (best == values.size() ||
                (words.key == "Tangential load" && taken_as("Friction")) ||
                (words.key == "Speed" && taken_as("Displacement")) ||
                (words.key == "Pressure" && taken_as("Normal load") &&
                 !taken_as("Tangential load")))
              continue;
            if (words.key == "Displacement")
              best = motion_of_friction(words, best);
            guess_column(words, best);
          }
      }

      void choose_second_axis()
      {
        if (!has_two_axes)
          return;
        axis = 'y';
        for (KeyWords words : key_words())
          {
            const std::string key  = words.key + " y";
            const std::size_t best = best_column(words.key);
            if (!words.is_along_axis || !taken_as(words.key) || taken_as(key) ||
                best == values.size() ||
                axis_of(proposal.columns[best].name) != axis)
              continue;
            words.key = key;
            guess_column(words, best);
          }
      }

      // A strip between two tools is pressed on both sides; and what was wanted
      // may stand beside what was measured.
      // @param points of the one that is taken
      std::string twin_doubt(const KeyWords &words, const int points) const
      {
        if (words.key == "Normal load" || words.key == "Pressure")
          for (std::size_t i = 0; i < values.size(); ++i)
            if (const int rival = score(words, i);
                (is_called_normal(proposal.columns[i].name) &&
                 !has_word(proposal.columns[i].name, ordered_words()) &&
                 rival > 0) ||
                rival >= points)
              return "; " + reference(i) +
                     " has such a name, too: which of the two counts, or do "
                     "both?";
        return "";
      }

      void guess_column(const KeyWords &words, const std::size_t column)
      {
        const std::string &key      = words.key;
        SeenColumn        &seen     = proposal.columns[column];
        const int          points   = score(words, column);
        seen.taken_as               = key;
        const Dimension   dimension = dimension_of(key);
        const std::string name      = reference(column);
        // With the digits that tell them apart.
        int n_digits = 5;
        while (n_digits < 12 && seen.least < seen.most &&
               rounded_text(seen.least, n_digits) ==
                 rounded_text(seen.most, n_digits))
          ++n_digits;
        const std::string range = heading_behind(name, column) + "from " +
                                  rounded_text(seen.least, n_digits) + " to " +
                                  rounded_text(seen.most, n_digits);
        const std::string doubt =
          words.is_along_axis && axis_of(seen.name) != '\0' ?
            axis_doubt :
            twin_doubt(words, points);
        if (dimension == Dimension::number)
          {
            const bool may_be_force = seen.name == "f" && seen.unit.empty();
            guess("Columns/" + key,
                  name,
                  range + (may_be_force ? "; or is it a force?" : "") + doubt,
                  may_be_force || !doubt.empty());
            return;
          }
        const auto [unit, unit_doubt] = unit_in_map(words, column, name);
        const bool is_negative = (key == "Normal load" || key == "Pressure") &&
                                 !finite[column].empty() &&
                                 median(finite[column]) < 0.;
        const std::string in = name + " in " + unit;
        guess("Columns/" + key,
              is_negative ? "-1*{" + in + "}" : in,
              range + unit_doubt +
                (is_negative ? "; compression counts positive here" : "") +
                doubt,
              !unit_doubt.empty() || !doubt.empty());
      }

      // With what is doubtful of it: nothing that would be taken where nobody
      // looks.
      std::pair<std::string, std::string>
      unit_in_map(const KeyWords    &words,
                  const std::size_t  column,
                  const std::string &name) const
      {
        const std::string &unit      = proposal.columns[column].unit;
        const Dimension    dimension = dimension_of(words.key);
        if (!unit.empty() && dimension_of_unit(unit) == dimension)
          return {is_plain(unit) ? unit : plain_unit(unit), ""};
        if (unit.empty() && words.key == "Time" &&
            has_days_of_spreadsheets(column))
          return {"d", days_of_spreadsheets};
        if (unit.empty())
          return {base_unit(dimension), "; the file does not say the unit"};
        const std::string weight = unit_of_weight(unit);
        if (dimension == Dimension::force && !weight.empty())
          return {weight,
                  "; " + unit + " is a mass: does it mean " + weight + "?"};
        return {"?",
                "; no unit is known as '" + unit + "'" +
                  (words.key == "Speed" ?
                     " (of a rotation: 2*pi*25/60*{" + name +
                       " as recorded}, for a track of 25 mm radius)" :
                     "")};
      }

      // With the most points for a key; none: one beyond the last.
      std::size_t best_column(const std::string &key) const
      {
        std::size_t best   = values.size();
        int         points = 0;
        for (const KeyWords &words : key_words())
          for (std::size_t i = 0; words.key == key && i < values.size(); ++i)
            if (const int found = score(words, i); found > points)
              {
                best   = i;
                points = found;
              }
        return best;
      }

      // A way that only grows may be called like a displacement as well: beside
      // friction of both signs that which it resists is taken.
      std::size_t motion_of_friction(const KeyWords   &displacement,
                                     const std::size_t best) const
      {
        constexpr double hardly = 0.5, clearly = 0.9;

        std::size_t friction = best_column("Friction");
        if (friction == values.size())
          friction = best_column("Tangential load");
        if (friction == values.size())
          return best;
        const auto has_sign = [&](const double sign) {
          const auto &signal = finite[friction];
          return 10 * count_if(signal,
                               [&](const double value) {
                                 return sign * value > 0.;
                               }) >
                 static_cast<std::ptrdiff_t>(signal.size());
        };
        const auto share = [&](const std::size_t i) {
          return std::abs(share_of_resistance(values[i], values[friction]));
        };
        if (share(best) >= hardly || !has_sign(1.) || !has_sign(-1.))
          return best;
        std::size_t other = best;
        for (std::size_t i = 0; i < values.size(); ++i)
          if (score(displacement, i) > 0 && share(i) > clearly &&
              share(i) > share(other))
            other = i;
        return other;
      }

      // Friction of a laboratory that records stresses.
      void guess_shear_stress()
      {
        if (taken_as("Friction") || taken_as("Tangential load") ||
            !taken_as("Pressure"))
          return;
        for (std::size_t i = 0; i < proposal.columns.size(); ++i)
          {
            SeenColumn &seen = proposal.columns[i];
            if (!seen.has_numbers || !has_word(seen.name, shear_words()) ||
                dimension_of_unit(seen.unit) != Dimension::stress)
              continue;
            seen.taken_as = "Friction";
            // With its unit and sign, as far as they are known.
            const ImportGuess &pressure =
              *std::find_if(proposal.guesses.begin(),
                            proposal.guesses.end(),
                            [](auto &guess) {
                              return guess.path == "Columns/Pressure";
                            });
            const bool is_formula =
              pressure.value.find('{') != std::string::npos;
            const std::string divisor = is_formula ?
                                          "(" + pressure.value + ")" :
                                          "{" + pressure.value + "}";
            guess("Columns/Friction",
                  "{" + reference(i) + " in " + seen.unit + "}/" + divisor,
                  "shear stress over normal stress",
                  pressure.is_open);
            return;
          }
      }

      std::size_t first_column_left() const
      {
        // The first is the time, if none is called so.
        for (std::size_t i = taken_as("Time") ? 0 : 1;
             i < proposal.columns.size();
             ++i)
          if (proposal.columns[i].has_numbers &&
              proposal.columns[i].taken_as.empty())
            return i;
        return proposal.columns.size() - 1;
      }

      // The newest row may stand first.
      bool is_in_order(const std::size_t column) const
      {
        const std::vector<double> &time = finite[column];
        return std::is_sorted(time.begin(), time.end()) ||
               std::is_sorted(time.rbegin(), time.rend());
      }

      // They count from 1900; rows of a test are not hours apart.
      bool has_days_of_spreadsheets(const std::size_t column) const
      {
        constexpr double first = 20000., last = 80000., largest_step = 1e-3;

        const SeenColumn &seen = proposal.columns[column];
        return seen.least >= first && seen.most <= last &&
               seen.most > seen.least &&
               seen.most - seen.least <= largest_step * values[column].size() &&
               is_in_order(column);
      }

      // Where nothing that is called so grows from row to row.
      void guess_time()
      {
        const RecordLayout &layout = proposal.layout;
        if (layout.clock > 0)
          {
            const bool is_open = layout.date_orders.size() > 1;
            guess("Columns/Time",
                  reference(layout.clock - 1) + " in clock" +
                    (layout.date_orders[0].empty() ?
                       "" :
                       " " + layout.date_orders[0]),
                  std::string("times of a clock") +
                    (is_open ? "; or is the month first, 'in clock m/d'?" : ""),
                  is_open);
            return;
          }
        for (std::size_t i = 0; i < values.size(); ++i)
          {
            const SeenColumn          &seen = proposal.columns[i];
            const std::vector<double> &time = finite[i];
            const auto back = std::is_sorted_until(time.begin(), time.end());
            if (back == time.end() ||
                dimension_of_unit(seen.unit) != Dimension::time)
              continue;
            guess(
              "Columns/Time",
              reference(i) + " in " + seen.unit,
              "it goes back from " + rounded_text(*std::prev(back), 6) +
                " to " + rounded_text(*back, 6) +
                ": if the clock starts anew, first make its times run on, or "
                "split the file",
              true);
            return;
          }
        std::size_t day = 0;
        while (day < values.size() && !has_days_of_spreadsheets(day))
          ++day;
        if (day < values.size())
          guess("Columns/Time",
                reference(day) + " in d",
                "no column name suggests a time" + days_of_spreadsheets,
                true);
        else
          guess("Columns/Time",
                "column 1 in s",
                "no column of increasing numbers has a name that suggests a "
                "time",
                true);
      }

      // What no column is called like: of two loads or stresses it is the one
      // that is not normal; and a load that is only called so may be it.
      void guess_other_load()
      {
        const std::string why =
          "no column name suggests a coefficient or a tangential load";
        for (ImportGuess &load : proposal.guesses)
          for (const std::string &key :
               {std::string("Normal load"), std::string("Pressure")})
            if (const SeenColumn *seen = taken_as(key);
                seen != nullptr && load.path == "Columns/" + key &&
                !is_called_normal(seen->name))
              {
                load.is_open = true;
                load.reason += "; or is it the friction? " + why;
              }
        const bool        is_stress = taken_as("Pressure") != nullptr;
        const SeenColumn *other     = nullptr;
        for (const SeenColumn &seen : proposal.columns)
          if (seen.has_numbers && seen.taken_as.empty() &&
              dimension_of_unit(seen.unit) ==
                (is_stress ? Dimension::stress : Dimension::force))
            other = &seen;
        if (other == nullptr)
          guess("Columns/Friction",
                "column " + std::to_string(first_column_left() + 1),
                why,
                true);
        else if (!is_stress)
          guess("Columns/Tangential load",
                reference(other->number - 1) + " in " + other->unit,
                why + "; is it the other one?",
                true);
        else
          guess("Columns/Friction",
                "{" + reference(other->number - 1) + " in " + other->unit +
                  "}/{" + reference(taken_as("Pressure")->number - 1) + " in " +
                  taken_as("Pressure")->unit + "}",
                why + "; is it the other stress?",
                true);
      }

      // What only a notebook knows.
      void guess_loads()
      {
        if (!taken_as("Time"))
          guess_time();
        if (!taken_as("Displacement") && !taken_as("Speed"))
          guess(
            "Constants/Speed",
            "1 mm/s",
            "no column name suggests a displacement or a speed: which one is "
            "it (Columns/Displacement, Columns/Speed), or how fast did it "
            "slide?",
            true);
        if (!taken_as("Friction") && !taken_as("Tangential load"))
          guess_other_load();
        const bool has_load = taken_as("Normal load");
        if (!has_load && !taken_as("Pressure"))
          {
            if (taken_as("Tangential load"))
              guess("Constants/Normal load",
                    "5 N assumed",
                    "no column name suggests a normal load; leave out "
                    "'assumed' if it is known",
                    true);
            else
              guess("Constants/Pressure",
                    "5 MPa",
                    "no column name suggests a pressure",
                    true);
          }
        const bool has_pressure = taken_as("Pressure");
        const bool has_force    = taken_as("Tangential load");
        if (has_pressure ? has_force && !has_load : has_force || has_load)
          guess("Constants/Area",
                "1 mm^2 assumed",
                has_pressure ?
                  "turns the pressure into a normal load" :
                  "turns the normal load into a pressure; leave out 'assumed' "
                  "if it is known",
                true);
      }

      void guess_signs()
      {
        const SeenColumn *displacement = taken_as("Displacement");
        const SeenColumn *friction     = taken_as("Friction");
        if (friction == nullptr)
          friction = taken_as("Tangential load");
        if (displacement == nullptr || friction == nullptr)
          return;
        const SeenColumn *time = taken_as("Time");
        const bool        is_later =
          time == nullptr || std::is_sorted(finite[time->number - 1].begin(),
                                            finite[time->number - 1].end());
        const double share =
          (is_later ? 1. : -1.) *
          share_of_resistance(values[displacement->number - 1],
                              values[friction->number - 1]);
        const std::string words =
          rounded_text(50. * (1. + share), 3) +
          " % of the work of friction as recorded is done against the motion";
        const auto [least, most] =
          std::minmax_element(finite[friction->number - 1].begin(),
                              finite[friction->number - 1].end());
        if (share < -0.5)
          guess("Convention/Friction sign", "reversed", words);
        else if (share < 0.5 && *least > -0.05 * *most)
          guess("Convention/Friction sign",
                "of the motion",
                "friction has one sign though the displacement comes back: the "
                "record holds only its magnitude");
        else if (share < 0.5)
          guess("Convention/Friction sign",
                "as recorded",
                words + ": is a zero of the sensor to be subtracted "
                        "(Correction/Zero), or is this displacement an "
                        "accumulated path, which only grows?");
      }

      const SeenColumn *taken_as(const std::string &key) const
      {
        for (const SeenColumn &column : proposal.columns)
          if (column.taken_as == key)
            return &column;
        return nullptr;
      }

      // "dry, 50 N": of this load, and who knows what else.
      std::string condition() const
      {
        for (const std::string key : {"Normal load", "Pressure"})
          if (const SeenColumn *seen = taken_as(key); seen != nullptr)
            return "dry, " +
                   rounded_text(std::abs(median(finite[seen->number - 1])), 2) +
                   (seen->unit.empty() || !is_plain(seen->unit) ?
                      "" :
                      " " + seen->unit);
        return "dry";
      }

      ImportProposal           proposal;
      std::vector<std::string> header;
      char                     axis = '\0'; ///< that is looked at, of two
      bool                     has_two_axes = false; ///< both move
      std::string              axis_doubt; ///< why it may be another; or ""

      std::vector<std::vector<double>> values; ///< of each column
      std::vector<std::vector<double>> finite; ///< the same without gaps
    };
  } // namespace



  ImportProposal propose_import(const std::filesystem::path &file)
  {
    return Observer(file).propose();
  }
} // namespace SlipStep
