// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/measured_data/import_map.h>

#include <slipstep/measured_data/resample.h>
#include <slipstep/measured_data/test_rows.h>
#include <slipstep/utilities/csv.h>
#include <slipstep/utilities/text.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace SlipStep
{
  namespace
  {
    /// A key of section Columns: what it holds.
    struct ColumnKey
    {
      std::string name;
      Dimension   dimension;
      std::string text;
    };

    const std::vector<ColumnKey> &column_keys()
    {
      using D                                 = Dimension;
      static const std::vector<ColumnKey> all = {
        {"Time", D::time, "Time."},
        {"Displacement", D::length, "Displacement, or distance slid."},
        {"Pressure", D::stress, "Nominal pressure."},
        {"Normal load", D::force, "Normal load, instead of the pressure."},
        {"Friction", D::number, "Coefficient of friction."},
        {"Tangential load",
         D::force,
         "Tangential load, instead of the coefficient."},
        {"Displacement y", D::length, "The same along the second axis."},
        {"Friction y", D::number, "The same along the second axis."},
        {"Tangential load y", D::force, "The same along the second axis."},
        {"Temperature", D::temperature, "Temperature, optional."}};
      return all;
    }

    void declare_raw_file(Parameters &map)
    {
      using namespace dealii::Patterns;
      map.declare("Raw file/Name",
                  "",
                  Anything(),
                  "The file to convert, relative to the folder of this map or "
                  "the one on the command line.");
      map.declare("Raw file/Delimiter",
                  "auto",
                  Selection("auto|tab|comma|semicolon|blanks"),
                  "Between columns. auto: tab, semicolon, comma or blanks, the "
                  "first of them that the header has.");
      map.declare("Raw file/Decimal mark",
                  "auto",
                  Selection("auto|point|comma"),
                  "Of the numbers. auto: whichever they have; both in one file "
                  "is an error.");
      map.declare("Raw file/Header line",
                  "0",
                  Integer(0),
                  "Line with the names of the columns, counted from 1; lines "
                  "before it are skipped. 0: the first line that is neither "
                  "blank nor a comment.");
      map.declare("Raw file/Has header",
                  "true",
                  Bool(),
                  "false: columns are named by their number only, 'column 1', "
                  "and rows begin at the header line.");
      // A value in a .prm file cannot contain the mark itself.
      map.declare("Raw file/Comment marks",
                  "",
                  Anything(),
                  "Lines that begin with one of these words, separated by "
                  "commas, are skipped, as are those that begin with a hash.");
    }

    void declare_constants(Parameters &map)
    {
      const auto declare = [&](const std::string &name,
                               const std::string &text) {
        map.declare("Constants/" + name,
                    "",
                    dealii::Patterns::Anything(),
                    text + " With its unit; empty: none.");
      };
      declare("Area",
              "Nominal contact area, to turn a normal load into a pressure.");
      declare("Pressure", "Nominal pressure, where no column has it.");
      declare("Normal load", "Normal load, where no column has it.");
      declare("Speed", "Speed, where no column has the displacement.");
    }

    void declare_rest(Parameters &map)
    {
      using namespace dealii::Patterns;
      for (const std::string name : {"Friction sign", "Displacement sign"})
        map.declare("Convention/" + name,
                    "as recorded",
                    Selection("as recorded|reversed"),
                    "Friction is positive where it resists motion in the "
                    "positive direction; reversed: the record has it the other "
                    "way. A record with friction that drives the motion is "
                    "refused.");
      map.declare("Convention/Start from zero",
                  "true",
                  Bool(),
                  "Whether time and displacement count from the first row.");
      for (const std::string name : {"Begin", "End"})
        map.declare("Selection/" + name,
                    "",
                    Anything(),
                    "Time of the first and of the last row to be taken, by the "
                    "clock of the raw file, with its unit; empty: all rows.");
      map.declare("Selection/Most rows",
                  "0",
                  Integer(0),
                  "Resample to about so many rows: peaks, reversals and the "
                  "onset of motion are kept. 0: keep every row.");
      for (const std::string name :
           {"Name", "Condition", "Source", "Licence", "Remark"})
        map.declare("Test/" + name,
                    "",
                    Anything(),
                    name == "Condition" ?
                      "Tests of the same condition are replicates." :
                      "Written into the comments of the converted file.");
    }
  } // namespace



  void declare_import_parameters(Parameters &map)
  {
    declare_raw_file(map);
    for (const ColumnKey &key : column_keys())
      map.declare("Columns/" + key.name,
                  "",
                  dealii::Patterns::Anything(),
                  key.text +
                    " 'NAME' or 'NAME in UNIT', as the header has it, or "
                    "'column 3 in UNIT'; a unit in the name, as in Load [N], "
                    "need not be repeated." +
                    (key.dimension == Dimension::number ?
                       "" :
                       " Base unit: " + base_unit(key.dimension) + "."));
    declare_constants(map);
    declare_rest(map);
  }



  namespace
  {
    CsvFormat format_of(const Parameters &map)
    {
      const std::string delimiter = map.text("Raw file/Delimiter");
      const std::string mark      = map.text("Raw file/Decimal mark");
      CsvFormat         format;
      format.delimiter    = delimiter == "tab"       ? '\t' :
                            delimiter == "comma"     ? ',' :
                            delimiter == "semicolon" ? ';' :
                            delimiter == "blanks"    ? ' ' :
                                                       '\0';
      format.decimal_mark = mark == "point" ? '.' : mark == "comma" ? ',' : 0;
      format.header_line  = map.integer("Raw file/Header line");
      format.has_header   = map.boolean("Raw file/Has header");
      for (const std::string &mark : map.list("Raw file/Comment marks"))
        format.comment_marks.push_back(mark);
      format.may_have_gaps = true;
      return format;
    }



    /// Converts one file. Columns are called by their keys in the map.
    class Converter
    {
    public:
      Converter(const Parameters &map, const std::filesystem::path &raw_file)
        : map(map)
        , raw_file(raw_file)
        , table(raw_file, format_of(map))
      {}

      MeasuredTest convert();

    private:
      std::size_t find_column(const std::string &path,
                              const std::string &name) const;

      void find_source(const ColumnKey &key);

      bool has(const std::string &column) const
      {
        return table.has(column);
      }

      std::optional<double> constant(const std::string &name,
                                     const Dimension    dimension,
                                     const bool         is_positive) const;

      void select_rows();

      std::vector<double> values(const std::string &column) const;

      std::vector<double> displacement(const std::vector<double> &time) const;

      std::vector<double> normal_load() const;

      std::vector<double> pressure() const;

      std::vector<double> friction(const std::string &axis) const;

      void tidy(MeasuredTest &test) const;

      void resample_as_told(MeasuredTest &test) const;

      const Parameters                     &map;
      const std::filesystem::path           raw_file;
      CsvTable                              table;
      std::map<std::string, UnitConversion> conversions;
      std::map<std::string, std::size_t>    positions;
      std::vector<std::size_t>              selected;
    };



    // "column 3", or a name in the header.
    std::size_t Converter::find_column(const std::string &path,
                                       const std::string &name) const
    {
      const std::vector<std::string> &header = table.header();
      if (name.rfind("column ", 0) == 0 &&
          name.find_first_not_of("0123456789", 7) == std::string::npos)
        {
          const std::size_t number = std::atol(name.c_str() + 7);
          if (number < 1 || number > header.size())
            map.reject(path,
                       raw_file.string() + " has " +
                         std::to_string(header.size()) + " columns");
          return number - 1;
        }
      std::string known;
      std::size_t position = header.size();
      for (std::size_t i = 0; i < header.size(); ++i)
        {
          if (!header[i].empty())
            known += (known.empty() ? "" : ", ") + header[i];
          if (header[i] != name)
            continue;
          if (position < header.size())
            map.reject(path,
                       raw_file.string() + " has two columns '" + name +
                         "': choose by number, 'column " +
                         std::to_string(position + 1) + "' or 'column " +
                         std::to_string(i + 1) + "'");
          position = i;
        }
      if (position == header.size())
        map.reject(path,
                   raw_file.string() + " has no column '" + name + "'" +
                     did_you_mean(name, header) + " (it has: " + known + ")");
      return position;
    }



    // Read "NAME in UNIT".
    void Converter::find_source(const ColumnKey &key)
    {
      const std::string path = "Columns/" + key.name;
      const std::string text = map.text(path);
      if (text.empty())
        return;
      const std::size_t in   = text.rfind(" in ");
      std::string       name = text.substr(0, in);
      std::string unit = in == std::string::npos ? "" : text.substr(in + 4);
      for (const std::string &heading : table.header())
        if (heading == text) // "Stroke in mm" is its name
          name = text;
      positions[key.name] = find_column(path, name);
      if (unit.empty())
        unit = split_heading(table.header()[positions[key.name]]).unit;
      if (key.dimension == Dimension::number)
        return;
      if (unit.empty())
        map.reject(path,
                   "the unit is missing: write '" + name + " in " +
                     base_unit(key.dimension) + "', or whatever it is");
      try
        {
          conversions[key.name] = unit_conversion(unit, key.dimension);
        }
      catch (const InputError &error)
        {
          map.reject(path, error.what());
        }
    }



    std::optional<double> Converter::constant(const std::string &name,
                                              const Dimension    dimension,
                                              const bool is_positive) const
    {
      const std::string path =
        name.find('/') == std::string::npos ? "Constants/" + name : name;
      if (map.text(path).empty())
        return {};
      try
        {
          const double value = parse_quantity(map.text(path), dimension, true);
          if (is_positive && value <= 0.)
            throw InputError("must be positive");
          return value;
        }
      catch (const InputError &error)
        {
          map.reject(path, error.what());
        }
    }



    void Converter::select_rows()
    {
      const double infinity = std::numeric_limits<double>::infinity();
      const double begin =
        constant("Selection/Begin", Dimension::time, false).value_or(-infinity);
      const double end =
        constant("Selection/End", Dimension::time, false).value_or(infinity);
      const std::vector<double> &time       = table["Time"];
      const UnitConversion       conversion = conversions["Time"];
      for (std::size_t i = 0; i < time.size(); ++i)
        if (!(conversion(time[i]) < begin) && !(conversion(time[i]) > end))
          selected.push_back(i);
      if (selected.size() < 2)
        throw InputError(raw_file.string() + ": " +
                         std::to_string(selected.size()) + " of " +
                         std::to_string(time.size()) +
                         " rows are between Selection/Begin and End");
    }



    std::vector<double> Converter::values(const std::string &column) const
    {
      std::vector<double> result(selected.size());
      const auto          found = conversions.find(column);
      const auto          conversion =
        found == conversions.end() ? UnitConversion() : found->second;
      for (std::size_t i = 0; i < selected.size(); ++i)
        result[i] = conversion(table[column][selected[i]]);
      return result;
    }



    std::vector<double>
    Converter::displacement(const std::vector<double> &time) const
    {
      const auto speed = constant("Speed", Dimension::speed, false);
      if (has("Displacement") == speed.has_value())
        map.reject("Columns/Displacement",
                   "give either this column or Constants/Speed");
      if (has("Displacement"))
        return values("Displacement");
      std::vector<double> result(time);
      for (double &value : result)
        value = *speed * (value - time.front());
      return result;
    }



    std::vector<double> Converter::normal_load() const
    {
      const auto load = constant("Normal load", Dimension::force, true);
      if (has("Normal load") && load.has_value())
        map.reject("Columns/Normal load",
                   "give either this column or Constants/Normal load");
      if (has("Normal load"))
        return values("Normal load");
      return load.has_value() ? std::vector<double>(selected.size(), *load) :
                                std::vector<double>();
    }



    std::vector<double> Converter::pressure() const
    {
      const auto          given = constant("Pressure", Dimension::stress, true);
      const auto          area  = constant("Area", Dimension::area, true);
      std::vector<double> load  = normal_load();
      if (has("Pressure") && given.has_value())
        map.reject("Columns/Pressure",
                   "give either this column or Constants/Pressure");
      if (has("Pressure"))
        return values("Pressure");
      if (given.has_value())
        return std::vector<double>(selected.size(), *given);
      if (load.empty() || !area.has_value())
        map.reject(load.empty() ? "Columns/Pressure" : "Constants/Area",
                   load.empty() ? "the pressure is needed: a column, "
                                  "Constants/Pressure, or a normal load with "
                                  "Constants/Area" :
                                  "the area is needed to turn the normal load "
                                  "into a pressure");
      for (double &value : load)
        value /= *area;
      return load;
    }



    // axis: "" or " y".
    std::vector<double> Converter::friction(const std::string &axis) const
    {
      const std::string coefficient = "Friction" + axis;
      const std::string tangential  = "Tangential load" + axis;
      if (has(coefficient) == has(tangential))
        map.reject("Columns/" + coefficient,
                   "give either this column or '" + tangential + "'");
      std::vector<double> result =
        values(has(coefficient) ? coefficient : tangential);
      if (has(tangential))
        {
          std::vector<double> load = normal_load();
          const auto          area = constant("Area", Dimension::area, true);
          if (load.empty() && !area.has_value())
            map.reject("Columns/" + tangential,
                       "a coefficient needs the normal load, too, or the "
                       "pressure with Constants/Area");
          if (load.empty())
            for (const double value : pressure())
              load.push_back(value * *area);
          // Before the first touch there is no load, and no friction.
          for (std::size_t i = 0; i < result.size(); ++i)
            result[i] =
              load[i] == 0. && result[i] == 0. ? 0. : result[i] / load[i];
        }
      if (map.text("Convention/Friction sign") == "reversed")
        for (double &value : result)
          value = -value;
      return result;
    }



    void Converter::tidy(MeasuredTest &test) const
    {
      const auto key_of = [this](const std::string &channel) {
        const std::string axis =
          channel.size() > 2 && channel.substr(channel.size() - 2) == "_y" ?
            " y" :
            "";
        if (channel.rfind("friction", 0) == 0)
          return (has("Friction" + axis) ? "Friction" : "Tangential load") +
                 axis;
        if (channel.rfind("displacement", 0) == 0)
          return "Displacement" + axis;
        if (channel == "pressure")
          return std::string(has("Pressure") ? "Pressure" : "Normal load");
        return std::string(channel == "time" ? "Time" : "Temperature");
      };
      tidy_rows(test,
                {[&](const std::size_t  row,
                     const std::string &channel,
                     const std::string &why) {
                   table.reject(selected[row], key_of(channel), why);
                 },
                 [&](const std::size_t row) {
                   return table.line(selected[row]);
                 }});
      if (!map.boolean("Convention/Start from zero"))
        return;
      for (auto *series :
           {&test.time, &test.displacement, &test.displacement_y})
        if (!series->empty())
          {
            const double first = series->front();
            for (double &value : *series)
              value -= first;
          }
    }



    void Converter::resample_as_told(MeasuredTest &test) const
    {
      const std::size_t most = map.integer("Selection/Most rows");
      const std::size_t n    = test.time.size();
      if (most == 0 || n <= most)
        return;
      ResampleOptions options;
      options.most_rows       = most;
      const auto resampled    = resample(test, options);
      test                    = resampled.test;
      test.notes["resampled"] = std::to_string(test.time.size()) + " of " +
                                std::to_string(n) + " rows; friction within " +
                                rounded_text(resampled.friction_tolerance, 3) +
                                " of every row left out";
    }



    MeasuredTest Converter::convert()
    {
      for (const ColumnKey &key : column_keys())
        find_source(key);
      if (positions.count("Time") == 0)
        map.reject("Columns/Time", "this column is needed");
      table.read(positions);
      select_rows();

      MeasuredTest test;
      test.file         = raw_file;
      test.time         = values("Time");
      test.displacement = displacement(test.time);
      test.pressure     = pressure();
      test.friction     = friction("");
      if (has("Displacement y"))
        {
          test.displacement_y = values("Displacement y");
          test.friction_y     = friction(" y");
        }
      if (has("Temperature"))
        test.temperature = values("Temperature");
      if (map.text("Convention/Displacement sign") == "reversed")
        for (auto *series : {&test.displacement, &test.displacement_y})
          for (double &value : *series)
            value = -value;
      tidy(test);

      test.name      = map.text("Test/Name");
      test.condition = map.text("Test/Condition");
      if (test.name.empty())
        test.name = raw_file.stem().string();
      for (const std::string key : {"Source", "Licence", "Remark"})
        test.notes[key == "Source"  ? "source" :
                   key == "Licence" ? "licence" :
                                      "remark"] = map.text("Test/" + key);
      test.notes["converted from"] = raw_file.filename().string();
      resample_as_told(test);
      return test;
    }
  } // namespace



  MeasuredTest import_test(const Parameters            &map,
                           const std::filesystem::path &raw_file)
  {
    return Converter(map, raw_file).convert();
  }
} // namespace SlipStep
