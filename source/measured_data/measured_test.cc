// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/measured_data/measured_test.h>

#include <slipstep/measured_data/test_rows.h>
#include <slipstep/measured_data/tidy_rows.h>
#include <slipstep/utilities/csv.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/nearest_name.h>
#include <slipstep/utilities/text.h>
#include <slipstep/utilities/units.h>
#include <slipstep/utilities/write_file.h>

#include <algorithm>
#include <cctype>

namespace SlipStep
{
  std::string Channel::column() const
  {
    return unit.empty() ? name : name + "_" + unit;
  }



  const std::vector<Channel> &channels()
  {
    using Test                            = MeasuredTest;
    using D                               = Dimension;
    static const std::vector<Channel> all = {
      {"time", D::time, "s", true, &Test::time},
      {"displacement", D::length, "mm", true, &Test::displacement},
      {"pressure", D::stress, "MPa", true, &Test::pressure},
      {"friction", D::number, "", true, &Test::friction},
      {"displacement_y", D::length, "mm", false, &Test::displacement_y},
      {"friction_y", D::number, "", false, &Test::friction_y},
      {"temperature", D::temperature, "C", false, &Test::temperature}};
    return all;
  }



  std::optional<double> MeasuredTest::order() const
  {
    const auto note = notes.find("order");
    return note == notes.end() || note->second.empty() ?
             std::nullopt :
             std::make_optional(
               parse_quantity(note->second, Dimension::number));
  }



  Heading split_heading(const std::string &cell)
  {
    Heading result{cell, "", false};
    for (const std::string brackets : {"[]", "()"})
      {
        const std::size_t open = cell.rfind(brackets[0]);
        if (!cell.empty() && cell.back() == brackets[1] &&
            open != std::string::npos)
          result = {cell.substr(0, open),
                    cell.substr(open + 1, cell.size() - open - 2),
                    true};
      }
    std::string &name = result.name;
    while (!name.empty() && name.back() == ' ')
      name.pop_back();
    for (char &c : name)
      c = c == ' ' ? '_' : std::tolower(static_cast<unsigned char>(c));
    return result;
  }



  namespace
  {
    /// The column that holds a channel, and how its numbers become base units.
    struct Source
    {
      std::size_t    position;
      UnitConversion conversion;
    };

    /// Finds the columns of the channels in a header.
    class HeaderReader
    {
    public:
      explicit HeaderReader(const CsvTable &table)
        : table(table)
      {}

      std::optional<Source> find(const Channel &channel)
      {
        nearly.clear();
        std::optional<Source> source;
        for (std::size_t i = 0; i < table.header().size(); ++i)
          {
            UnitConversion conversion;
            if (!matches(i, channel, conversion))
              continue;
            if (source.has_value())
              table.reject_header(i,
                                  "column '" + channel.column() +
                                    "' is given twice");
            source = Source{i, conversion};
          }
        if (source.has_value())
          return source;
        if (!nearly.empty() && channel.is_required)
          table.reject_header(nearly.front().first, nearly.front().second);
        if (!nearly.empty())
          ignored.push_back(nearly.front().second + "; the column is not read");
        if (channel.is_required)
          reject_missing(channel);
        return {};
      }

    private:
      bool matches(const std::size_t position,
                   const Channel    &channel,
                   UnitConversion   &conversion)
      {
        const std::string &cell    = table.header()[position];
        Heading            heading = split_heading(cell);
        const std::string  start   = channel.name + "_";
        if (!heading.has_brackets && heading.name.rfind(start, 0) == 0)
          heading = {channel.name, cell.substr(start.size()), false};
        if (heading.name != channel.name)
          return false;

        if (channel.dimension == Dimension::number)
          return heading.unit.empty() || heading.unit == "-" ||
                 heading.unit == "1";
        if (heading.unit.empty())
          nearly.emplace_back(position,
                              "the unit of '" + cell +
                                "' is missing: write it as '" +
                                channel.column() + "' or '" + channel.name +
                                " [" + channel.unit + "]'");
        else
          try
            {
              conversion = unit_conversion(heading.unit, channel.dimension);
              return true;
            }
          catch (const InputError &error)
            {
              // Columns such as time_of_day mean no harm; displacement_y_mm
              // is another one.
              if (none_of(channels(), [&](const Channel &other) {
                    return other.name.size() > channel.name.size() &&
                           cell.rfind(other.name, 0) == 0;
                  }))
                nearly.emplace_back(position,
                                    "'" + cell +
                                      "': " + std::string(error.what()));
            }
        return false;
      }

      [[noreturn]] void reject_missing(const Channel &channel) const
      {
        const std::string found = table.header_words();
        table.reject_header(0,
                            "column '" + channel.column() +
                              "' is missing (the header has: " + found + ")" +
                              did_you_mean(channel.column(), table.header()) +
                              "; slipstep import converts other files");
      }

      const CsvTable &table;
      /// Columns that would do but for their unit, with what is wrong of it.
      std::vector<std::pair<std::size_t, std::string>> nearly;

    public:
      /// What was found of optional columns that cannot be read.
      std::vector<std::string> ignored;
    };



    void read_notes(const CsvTable &table, MeasuredTest &test)
    {
      const auto note = [&](const std::string &key) {
        const auto found = table.comments().find(key);
        return found == table.comments().end() ? std::string() : found->second;
      };
      for (const char *key : {"area", "condition", "noise", "order"})
        {
          const auto other = table.contradicting_comments().find(key);
          if (other != table.contradicting_comments().end())
            throw InputError(
              test.file.string() + ": its comments contradict each other on '" +
              key + "': '" + note(key) + "' and '" + other->second + "'");
        }
      const Quantity order(Dimension::number);
      if (!note("order").empty() && !order.match(note("order")))
        throw InputError(test.file.string() + ": order: " + note("order") +
                         ": " + order.why_not(note("order")));
      test.notes     = table.comments();
      test.condition = note("condition");
      test.name      = note("name");
      if (test.name.empty())
        test.name = test.file.stem().string();
    }



    // An axis along which nothing moves, and of which the friction is 0 to the
    // last digit, was not measured.
    void leave_out_idle_axis(MeasuredTest &test)
    {
      if (range_of(test.displacement_y) != 0. ||
          any_of(test.friction_y,
                 [](const double value) { return value != 0.; }))
        return;
      test.displacement_y.clear();
      test.friction_y.clear();
    }
  } // namespace



  MeasuredTest read_measured_test(const std::filesystem::path &file)
  {
    CsvFormat format;
    format.may_have_gaps = true;
    CsvTable                           table(file, format);
    HeaderReader                       header(table);
    std::map<std::string, Source>      sources;
    std::map<std::string, std::size_t> positions;
    for (const Channel &channel : channels())
      if (const auto source = header.find(channel))
        {
          sources[channel.name]       = *source;
          positions[channel.column()] = source->position;
        }
    table.read(positions);

    MeasuredTest test;
    test.file = file;
    read_notes(table, test);
    for (const std::string &text : header.ignored)
      test.warnings.push_back(file.string() + ": " + text);
    for (const Channel &channel : channels())
      if (sources.count(channel.name))
        {
          std::vector<double> &values = test.*channel.values;
          values                      = table[channel.column()];
          for (double &value : values)
            value = sources[channel.name].conversion(value);
        }

    const auto column = [](const std::string &name) {
      for (const Channel &channel : channels())
        if (channel.name == name)
          return channel.column();
      return name;
    };
    tidy_rows(test,
              {[&](const std::size_t  row,
                   const std::string &channel,
                   const std::string &why) {
                 table.reject(row, column(channel), why);
               },
               [&](const std::size_t row) { return table.line(row); }});
    leave_out_idle_axis(test);
    return test;
  }



  namespace
  {
    std::string one_line(std::string text)
    {
      std::replace(text.begin(), text.end(), '\n', ' ');
      return text;
    }

    std::string text_of_test(const MeasuredTest &test,
                             const unsigned int  n_digits)
    {
      std::string text = "# name: " + one_line(test.name) + '\n';
      if (!test.condition.empty())
        text += "# condition: " + one_line(test.condition) + '\n';
      for (const auto &[key, value] : test.notes)
        if (key != "name" && key != "condition" && !value.empty())
          text += "# " + key + ": " + one_line(value) + '\n';

      const auto  written   = filled_channels(test);
      const char *separator = "";
      for (const Channel *channel : written)
        {
          text += separator + channel->column();
          separator = ",";
        }
      for (std::size_t row = 0; row < test.time.size(); ++row)
        {
          separator = "\n";
          for (const Channel *channel : written)
            {
              const double value = (test.*(channel->values))[row];
              text += separator;
              text +=
                n_digits == 0 ?
                  exact_text(value) :
                  rounded_text(value,
                               n_digits + (channel->name == "time" ? 3 : 0));
              separator = ",";
            }
        }
      return text + '\n';
    }
  } // namespace



  void write_measured_test(const std::filesystem::path &file,
                           const MeasuredTest          &test,
                           const unsigned int           n_digits)
  {
    write_file(file, text_of_test(test, n_digits));
  }
} // namespace SlipStep
