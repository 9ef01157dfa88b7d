// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/utilities.h>

#include <slipstep/measured_data/column_words.h>
#include <slipstep/measured_data/import_columns.h>
#include <slipstep/measured_data/measured_test.h>
#include <slipstep/utilities/encoding.h>
#include <slipstep/utilities/lists.h>

#include <boost/algorithm/string/predicate.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>

namespace SlipStep
{
  const std::vector<ColumnKey> &column_keys()
  {
    using D                                 = Dimension;
    static const std::vector<ColumnKey> all = {
      {"Time",
       D::time,
       "Time. 'NAME in clock' is the time of a clock, 23:59:59.5 or 2026-11-27 "
       "23:59:59.5, counted from midnight; without a date it runs on past the "
       "next midnight. 'NAME in clock d/m' and 'm/d' say which number of "
       "3/4/2026 is the month."},
      {"Displacement", D::length, "Displacement, or distance slid."},
      {"Speed",
       D::speed,
       "Speed of sliding, instead of the displacement, which is then its "
       "integral over time by the trapezoidal rule."},
      {"Pressure", D::stress, "Nominal pressure."},
      {"Normal load", D::force, "Normal load, instead of the pressure."},
      {"Friction", D::number, "Coefficient of friction."},
      {"Tangential load",
       D::force,
       "Tangential load, instead of the coefficient."},
      {"Displacement y", D::length, "Displacement along the second axis."},
      {"Friction y",
       D::number,
       "Coefficient of friction along the second axis."},
      {"Tangential load y", D::force, "Tangential load along the second axis."},
      {"Temperature", D::temperature, "Temperature, optional."}};
    return all;
  }



  std::optional<Dimension> dimension_of_unit(const std::string &unit)
  {
    for (const Dimension dimension : {Dimension::length,
                                      Dimension::time,
                                      Dimension::speed,
                                      Dimension::stress,
                                      Dimension::force,
                                      Dimension::area,
                                      Dimension::temperature})
      try
        {
          unit_conversion(unit, dimension);
          return dimension;
        }
      catch (const InputError &)
        {
          // It is one of the others, or none.
        }
    return {};
  }



  namespace
  {
    // Powers of length, time and force in a quantity; none in a number.
    double power_of(const Dimension dimension, const unsigned int unit)
    {
      static const std::map<Dimension, std::array<double, 3>> powers = {
        {Dimension::length, {{1., 0., 0.}}},
        {Dimension::time, {{0., 1., 0.}}},
        {Dimension::speed, {{1., -1., 0.}}},
        {Dimension::stress, {{-2., 0., 1.}}},
        {Dimension::force, {{0., 0., 1.}}},
        {Dimension::area, {{2., 0., 0.}}}};
      const auto found = powers.find(dimension);
      return found == powers.end() ? 0. : found->second[unit];
    }
  } // namespace



  /// Reads what a map has for one key.
  class ImportColumns::RecipeReader
  {
  public:
    RecipeReader(const Parameters         &map,
                 const CsvTable           &table,
                 const ColumnKey          &key,
                 std::vector<std::string> &contradictions)
      : map(map)
      , table(table)
      , key(key)
      , path("Columns/" + key.name)
      , contradictions(contradictions)
    {}

    Recipe read()
    {
      const std::string text = map.text(path);
      if (text.find('{') != std::string::npos)
        return read_formula(text);
      Recipe recipe;
      recipe.sources          = {find_source(text, key.dimension)};
      recipe.sources[0].label = key.name;
      return recipe;
    }

  private:
    [[noreturn]] void reject(const std::string &why) const
    {
      map.reject(path, why);
    }

    Recipe read_formula(std::string text)
    {
      Recipe recipe;

      if (text.rfind('{') > text.rfind('}') ||
          text.find('}') == std::string::npos)
        reject("a } is missing");
      // "... in kN": behind the last column, for their names may have the word.
      const std::size_t in = text.rfind(" in ");
      if (in != std::string::npos && text.find('}', in) == std::string::npos)
        {
          const std::string unit = dealii::Utilities::trim(text.substr(in + 4));
          text.resize(in);
          recipe.conversion = map.attempt(path, [&] {
            return unit_conversion(unit, key.dimension);
          });
        }

      std::string              plain;
      std::vector<std::string> variables;
      for (std::size_t at = 0; at < text.size();)
        {
          const std::size_t open = text.find('{', at);
          plain += text.substr(at, open - at);
          if (open == std::string::npos)
            break;
          const std::size_t close = text.find('}', open);
          const std::string inside =
            dealii::Utilities::trim(text.substr(open + 1, close - open - 1));
          Source source = find_source(inside, {});
          source.label  = key.name + ": " + inside;
          std::size_t i = 0;
          while (i < recipe.sources.size() &&
                 recipe.sources[i].label != source.label)
            ++i;
          if (i == recipe.sources.size())
            {
              recipe.sources.push_back(source);
              variables.push_back("column" + std::to_string(i + 1));
            }
          plain += variables[i];
          at = close + 1;
        }
      try
        {
          // First as it is written, for a mark at the right place.
          check_formula(text);
          recipe.formula.emplace(plain, variables);
        }
      catch (const InputError &error)
        {
          reject(std::string(error.what()) +
                 "; columns stand in braces, {NAME in UNIT}, and count in "
                 "mm, s, N, MPa, degC");
        }
      check_units(recipe);
      return recipe;
    }

    // "column 3", or a name in the header.
    std::size_t find_column(const std::string &name) const
    {
      const std::vector<std::string> &header = table.header();
      if (name.rfind("column ", 0) == 0 &&
          name.find_first_not_of("0123456789", 7) == std::string::npos)
        {
          const std::size_t number = std::atol(name.c_str() + 7);
          if (number < 1 || number > header.size())
            reject(table.name() + " has " + std::to_string(header.size()) +
                   " columns");
          return number - 1;
        }
      std::size_t position = header.size();
      for (std::size_t i = 0; i < header.size(); ++i)
        {
          if (header[i] != to_utf8(name))
            continue;
          if (position < header.size())
            reject(table.name() + " has two columns '" + name +
                   "': choose by number, 'column " +
                   std::to_string(position + 1) + "' or 'column " +
                   std::to_string(i + 1) + "'");
          position = i;
        }
      if (position == header.size())
        reject(table.name() + " has no column '" + name + "'" +
               did_you_mean(name, header) +
               " (it has: " + table.header_words() + ")");
      return position;
    }

    // Read "NAME in UNIT". Without a dimension any unit will do, or none if the
    // map says so.
    Source find_source(const std::string             &text,
                       const std::optional<Dimension> dimension)
    {
      const std::string bare    = " as recorded";
      std::size_t       in      = text.rfind(" in ");
      const bool        is_bare = !dimension.has_value() && text != bare &&
                           boost::algorithm::ends_with(text, bare);
      if (is_bare)
        in = text.size() - bare.size();
      std::string name = text.substr(0, in);
      std::string unit =
        in == std::string::npos || is_bare ? "" : text.substr(in + 4);
      for (const std::string &heading : table.header())
        if (heading == text) // "Stroke in mm" is its name
          name = text;
      Source source{"", find_column(name), {}, {}, {}};
      if (is_bare)
        return source;
      if (dimension == Dimension::time)
        for (const std::string order : {"", "d/m", "m/d"})
          if (unit == "clock" + (order.empty() ? "" : " " + order))
            {
              source.clock.emplace(order);
              return source;
            }
      if (dimension == Dimension::number)
        {
          source.conversion = conversion_of_share(name, unit, source);
          return source;
        }
      const bool is_told = !unit.empty();
      if (!is_told)
        unit = unit_in_file(source.position);
      const std::string remedy = dimension.has_value() ?
                                   "'" + name + " in " + base_unit(*dimension) +
                                     "', or whatever its unit is" :
                                   "{" + name +
                                     " in N}, or whatever its unit is; {" +
                                     name + " as recorded} is the bare number";
      if (unit.empty())
        reject("the unit is missing: write " + remedy);
      const std::optional<Dimension> wanted =
        dimension.has_value() ? dimension : dimension_of_unit(unit);
      source.dimension = wanted;
      if (!wanted.has_value())
        reject("\"" + unit + "\" is no unit that this program knows; {" + name +
               " as recorded} is the bare number");
      source.conversion =
        map.attempt(path, [&] { return unit_conversion(unit, *wanted); });
      if (is_told)
        compare_units(source.position, unit, *wanted);
      return source;
    }

    // A coefficient is a plain number, or per cent.
    UnitConversion conversion_of_share(const std::string &name,
                                       const std::string &told,
                                       const Source      &source)
    {
      const std::string in_file = unit_in_file(source.position);
      const auto        is_none = [](const std::string &unit) {
        return unit.empty() || unit == "-" || unit == "1";
      };
      if (!is_none(told) && told != "%")
        reject("a coefficient of friction has no unit \"" + told +
               "\": write '" + name + "', or '" + name +
               " in %'; a force belongs in Columns/Tangential load");
      if (told.empty() ? dimension_of_unit(in_file).has_value() :
                         in_file == "%" && told != "%")
        add_contradiction(source.position, "as a plain number", in_file);
      UnitConversion percent;
      percent.denominator = 100.;
      return told == "%" || (told.empty() && in_file == "%") ? percent :
                                                               UnitConversion{};
    }

    void add_contradiction(const std::size_t  position,
                           const std::string &taken,
                           const std::string &in_file)
    {
      const std::string words = "column " + std::to_string(position + 1) +
                                " is taken " + taken + ", the file says " +
                                in_file;
      if (!holds(contradictions, words))
        contradictions.push_back(words);
    }

    std::string unit_in_file(const std::size_t position) const
    {
      const std::string &unit = table.units()[position];
      return unit.empty() ? split_heading(table.header()[position]).unit : unit;
    }

    // The file may be wrong, but nobody should find out by a factor of 60.
    void compare_units(const std::size_t  position,
                       const std::string &unit,
                       const Dimension    dimension)
    {
      const std::string in_file = unit_in_file(position);
      const auto        known   = dimension_of_unit(in_file);
      if (!known.has_value() ?
            in_file.empty() || in_file == unit || in_file.size() > 3 ||
              unit_of_weight(in_file) == unit :
            *known == dimension && unit_conversion(in_file, dimension)(1.) ==
                                     unit_conversion(unit, dimension)(1.))
        return;
      add_contradiction(position,
                        "in " + unit,
                        in_file + (known.has_value() ?
                                     "" :
                                     ", which is not a known unit"));
    }

    // A formula without a number of its own, and with all columns in units, can
    // only be right if other units of length, time and force change its value
    // as they change the quantity.
    bool fits_units(const Recipe              &recipe,
                    const std::vector<double> &arguments) const
    {
      constexpr double other = 1.37, alike = 1e-9;

      const double value = (*recipe.formula)(arguments);
      for (unsigned int unit = 0; unit < 3; ++unit)
        {
          std::vector<double> changed = arguments;
          for (std::size_t i = 0; i < changed.size(); ++i)
            changed[i] *=
              std::pow(other, power_of(*recipe.sources[i].dimension, unit));
          const double expected =
            value * std::pow(other, power_of(key.dimension, unit));
          if (std::abs((*recipe.formula)(changed)-expected) >
              alike * std::abs(expected))
            return false;
        }
      return true;
    }

    void check_units(const Recipe &recipe) const
    {
      const std::string text = map.text(path);
      for (const Source &source : recipe.sources)
        if (!source.dimension.has_value() ||
            *source.dimension == Dimension::temperature)
          return;
      if (recipe.conversion(1.) != 1.)
        reject("columns with units are converted to mm, s, N, MPa already, "
               "whatever their own units are: leave out '" +
               text.substr(text.rfind(" in ") + 1) +
               "', or take the columns as recorded");
      bool is_inside = false;
      for (const char c : text)
        {
          is_inside = c == '{' || (is_inside && c != '}');
          if (!is_inside && std::isdigit(static_cast<unsigned char>(c)) != 0)
            return; // it may have any unit
        }
      std::vector<double> arguments;
      for (std::size_t i = 0; i < recipe.sources.size(); ++i)
        arguments.push_back(1. + 0.1 * std::sqrt(i + 2.));
      if (!fits_units(recipe, arguments))
        reject("the units do not make " +
               (key.dimension == Dimension::number ? "a plain number" :
                                                     base_unit(key.dimension)) +
               ": write a factor that has a unit as a plain number, such as "
               "12*{p in MPa} for an area of 12 mm^2");
    }

    const Parameters         &map;
    const CsvTable           &table;
    const ColumnKey          &key;
    const std::string         path;
    std::vector<std::string> &contradictions;
  };



  ImportColumns::ImportColumns(const Parameters &map, CsvTable &table)
    : table(table)
  {
    for (const ColumnKey &key : column_keys())
      if (!map.text("Columns/" + key.name).empty())
        recipes[key.name] =
          RecipeReader(map, table, key, contradicting_units).read();
  }



  void ImportColumns::read()
  {
    std::map<std::string, std::size_t> positions;
    std::string                        clock_column;
    Clock                              clock;
    for (const auto &recipe : recipes)
      for (const Source &source : recipe.second.sources)
        {
          positions[source.label] = source.position;
          if (source.clock.has_value())
            {
              clock_column = source.label;
              clock        = *source.clock;
            }
        }
    table.read(positions, clock_column, clock);
    find_clock();
  }



  // A formula has the stamps as they are.
  void ImportColumns::find_clock()
  {
    constexpr double longest_test = 1e8; // [s]

    const auto time = recipes.find("Time");
    if (time == recipes.end() || time->second.formula.has_value())
      return;
    const std::vector<double> &stamps = table[time->second.sources[0].label];
    const auto                 first =
      std::find_if(stamps.begin(), stamps.end(), [](const double stamp) {
        return std::isfinite(stamp);
      });
    if (first != stamps.end() &&
        time->second.sources[0].conversion(*first) > longest_test)
      first_stamp = *first;
  }



  double ImportColumns::clock() const
  {
    return first_stamp == 0. ?
             0. :
             recipes.at("Time").sources[0].conversion(first_stamp);
  }



  bool ImportColumns::has(const std::string &key) const
  {
    return recipes.count(key) > 0;
  }



  std::vector<double> ImportColumns::values(const std::string &key) const
  {
    const Recipe       &recipe = recipes.at(key);
    const double        less   = key == "Time" ? first_stamp : 0.;
    std::vector<double> result(table.size());
    std::vector<double> arguments(recipe.sources.size());

    std::vector<const std::vector<double> *> columns;
    for (const Source &source : recipe.sources)
      columns.push_back(&table[source.label]);
    for (std::size_t row = 0; row < result.size(); ++row)
      {
        bool has_gap = false;
        for (std::size_t i = 0; i < columns.size(); ++i)
          {
            arguments[i] =
              recipe.sources[i].conversion((*columns[i])[row] - less);
            has_gap = has_gap || std::isnan(arguments[i]);
          }
        result[row] = has_gap ?
                        std::numeric_limits<double>::quiet_NaN() :
                      recipe.formula.has_value() ?
                        recipe.conversion((*recipe.formula)(arguments)) :
                        arguments[0];
      }
    return result;
  }



  void ImportColumns::reject(const std::size_t  row,
                             const std::string &key,
                             const std::string &why) const
  {
    const auto recipe = recipes.find(key);
    table.reject(row,
                 recipe == recipes.end() ? key :
                                           recipe->second.sources[0].label,
                 why);
  }
} // namespace SlipStep
