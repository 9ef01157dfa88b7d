// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/nearest_name.h>
#include <slipstep/utilities/text.h>
#include <slipstep/utilities/units.h>

#include <boost/algorithm/string/join.hpp>

#include <charconv>
#include <cmath>
#include <vector>

namespace SlipStep
{
  namespace
  {
    // Value in base units = number * numerator / denominator. Two numbers, so
    // that 60 mm/min is 1 mm/s to the last bit.
    struct Unit
    {
      std::string name;
      double      numerator;
      double      denominator;
      double      offset = 0.;
    };

    struct DimensionEntry
    {
      std::string       name; // with its article
      std::vector<Unit> units;
    };



    // The first unit of each list is the base unit.
    const DimensionEntry &entry(const Dimension dimension)
    {
      static const std::map<Dimension, DimensionEntry> entries = {
        {Dimension::number, {"a number", {}}},
        {Dimension::length,
         {"a length",
          {{"mm", 1, 1},
           {"um", 1, 1e3},
           {"nm", 1, 1e6},
           {"cm", 10, 1},
           {"m", 1e3, 1},
           {"km", 1e6, 1},
           {"inch", 25.4, 1},
           {"ft", 304.8, 1},
           {"mil", 25.4, 1e3},
           {"µm", 1, 1e3}}}},
        {Dimension::time,
         {"a time",
          {{"s", 1, 1},
           {"ms", 1, 1e3},
           {"us", 1, 1e6},
           {"min", 60, 1},
           {"h", 3600, 1},
           {"d", 86400, 1}}}},
        {Dimension::speed,
         {"a speed",
          {{"mm/s", 1, 1},
           {"mm/min", 1, 60},
           {"mm/h", 1, 3600},
           {"um/s", 1, 1e3},
           {"nm/s", 1, 1e6},
           {"cm/s", 10, 1},
           {"cm/min", 10, 60},
           {"m/s", 1e3, 1},
           {"m/min", 1e3, 60},
           {"m/h", 1e3, 3600},
           {"km/h", 1e6, 3600},
           {"in/s", 25.4, 1},
           {"in/min", 25.4, 60},
           {"µm/s", 1, 1e3}}}},
        {Dimension::stress,
         {"a stress",
          {{"MPa", 1, 1},
           {"Pa", 1, 1e6},
           {"kPa", 1, 1e3},
           {"GPa", 1e3, 1},
           {"bar", 1, 10},
           {"mbar", 1, 1e4},
           {"atm", 0.101325, 1},
           {"kgf/cm^2", 0.0980665, 1},
           {"psi", 4.4482216152605, 645.16},
           {"ksi", 4448.2216152605, 645.16},
           {"N/mm^2", 1, 1}}}},
        {Dimension::stiffness,
         {"a stiffness",
          {{"MPa/mm", 1, 1},
           {"kPa/mm", 1, 1e3},
           {"GPa/mm", 1e3, 1},
           {"MPa/m", 1, 1e3},
           {"GPa/m", 1, 1},
           {"N/mm^3", 1, 1}}}},
        {Dimension::per_length,
         {"a value per length",
          {{"1/mm", 1, 1},
           {"1/um", 1e3, 1},
           {"1/cm", 1, 10},
           {"1/m", 1, 1e3}}}},
        {Dimension::per_time,
         {"a rate per time",
          {{"1/s", 1, 1},
           {"1/ms", 1e3, 1},
           {"1/min", 1, 60},
           {"1/h", 1, 3600}}}},
        {Dimension::viscosity,
         {"a viscosity",
          {{"s/mm", 1, 1},
           {"min/mm", 60, 1},
           {"s/um", 1e3, 1},
           {"s/m", 1, 1e3}}}},
        {Dimension::drag,
         {"a drag",
          {{"MPa s/mm", 1, 1}, {"MPa min/mm", 60, 1}, {"MPa s/m", 1, 1e3}}}},
        {Dimension::areal_mass,
         {"a mass per area",
          {{"MPa s^2/mm", 1, 1},
           {"kg/mm^2", 1, 1e3},
           {"kg/cm^2", 1, 1e5},
           {"kg/m^2", 1, 1e9},
           {"g/mm^2", 1, 1e6},
           {"g/cm^2", 1, 1e8}}}},
        {Dimension::per_temperature,
         {"a value per temperature", {{"1/degC", 1, 1}, {"1/K", 1, 1}}}},
        {Dimension::heating,
         {"a temperature per work and area",
          {{"degC mm/N", 1, 1}, {"K mm/N", 1, 1}, {"K m^2/kJ", 1, 1}}}},
        {Dimension::density,
         {"a density",
          {{"t/mm^3", 1, 1},
           {"MPa s^2/mm^2", 1, 1},
           {"kg/m^3", 1, 1e12},
           {"kg/mm^3", 1, 1e3},
           {"g/cm^3", 1, 1e9}}}},
        {Dimension::angle,
         {"an angle", {{"deg", 1, 1}, {"rad", 180, dealii::numbers::PI}}}},
        {Dimension::force,
         {"a force",
          {{"N", 1, 1},
           {"kN", 1e3, 1},
           {"mN", 1, 1e3},
           {"uN", 1, 1e6},
           {"MN", 1e6, 1},
           {"daN", 10, 1},
           {"kgf", 9.80665, 1},
           {"gf", 9.80665, 1e3},
           {"tf", 9806.65, 1},
           {"lbf", 4.4482216152605, 1},
           {"klbf", 4448.2216152605, 1},
           {"kip", 4448.2216152605, 1}}}},
        {Dimension::area,
         {"an area",
          {{"mm^2", 1, 1},
           {"um^2", 1, 1e6},
           {"cm^2", 100, 1},
           {"in^2", 645.16, 1},
           {"m^2", 1e6, 1}}}},
        {Dimension::temperature,
         {"a temperature",
          {{"degC", 1, 1},
           {"C", 1, 1},
           {"K", 1, 1, -273.15},
           {"degF", 5, 9, -160. / 9.}}}}};
      return entries.at(dimension);
    }



    std::vector<std::string> unit_names(const Dimension dimension)
    {
      std::vector<std::string> names;
      for (const Unit &unit : entry(dimension).units)
        names.push_back(unit.name);
      return names;
    }



    std::string joined_unit_names(const Dimension dimension)
    {
      return boost::algorithm::join(unit_names(dimension), ", ");
    }


    // What people write, and the unit that it means. Without an exact match
    // case does not matter.
    const std::vector<std::pair<std::string, std::string>> &words_for_units()
    {
      static const std::vector<std::pair<std::string, std::string>> words = {
        {"sec", "s"},         {"secs", "s"},
        {"second", "s"},      {"seconds", "s"},
        {"msec", "ms"},       {"minutes", "min"},
        {"hours", "h"},       {"micron", "um"},
        {"microns", "um"},    {"micrometer", "um"},
        {"in", "inch"},       {"inches", "inch"},
        {"in2", "in^2"},      {"newton", "N"},
        {"N/mm2", "N/mm^2"},  {"mm2", "mm^2"},
        {"celsius", "degC"},  {"deg c", "degC"},
        {"deg. c", "degC"},   {"hr", "h"},
        {"hrs", "h"},         {"hour", "h"},
        {"day", "d"},         {"days", "d"},
        {"\"", "inch"},       {"kips", "kip"},
        {"kp", "kgf"},        {"KN", "kN"},
        {"cm2", "cm^2"},      {"m2", "m^2"},
        {"MM", "mm"},         {"UM", "um"},
        {"MPA", "MPa"},       {"KPA", "kPa"},
        {"GPA", "GPa"},       {"BAR", "bar"},
        {"PSI", "psi"},       {"MM/S", "mm/s"},
        {"MM/MIN", "mm/min"}, {"kgf/cm2", "kgf/cm^2"},
        {"deg f", "degF"}};
      return words;
    }
  } // namespace



  std::string plain_unit(std::string unit)
  {
    const std::vector<std::pair<std::string, std::string>> spellings = {
      {"\xC2\xB5", "u"}, // micro sign, UTF-8
      {"\xCE\xBC", "u"}, // Greek mu, UTF-8
      {"\xC2\xB0", "deg"},
      {"\xC2\xB2", "^2"},
      {"\xB5", "u"}, // the same three in Latin-1
      {"\xB0", "deg"},
      {"\xB2", "^2"}};
    for (const auto &[written, plain] : spellings)
      for (std::size_t at = unit.find(written); at != std::string::npos;
           at             = unit.find(written))
        unit.replace(at, written.size(), plain);
    for (const auto &[written, plain] : words_for_units())
      if (unit == written || lower_case(unit) == written)
        return plain;
    return unit;
  }



  namespace
  {
    const Unit *find_unit(const std::string &name, const Dimension dimension)
    {
      for (const Unit &known : entry(dimension).units)
        if (known.name == name)
          return &known;
      return nullptr;
    }



    std::string why_no_unit(const std::string &unit, const Dimension dimension)
    {
      const std::string nearest = nearest_name(unit, unit_names(dimension));
      return "\"" + unit + "\" is not a unit of " + entry(dimension).name +
             (nearest.empty() ? "" : ", nearest is " + nearest) +
             " (known: " + joined_unit_names(dimension) + ")";
    }



    // Why a text is not a quantity; "" on success, when @p value is set, in
    // degrees for angles.
    std::string parse(const std::string &written,
                      const Dimension    dimension,
                      const bool         unit_required,
                      double            &value)
    {
      const std::string text  = dealii::Utilities::trim(written);
      const char       *begin = text.data();
      const char *const end   = begin + text.size();
      // from_chars depends on no locale, but does not know a leading plus.
      if (begin != end && *begin == '+')
        ++begin;
      const auto parsed = std::from_chars(begin, end, value);
      if (parsed.ec == std::errc::result_out_of_range)
        return "the number is too large or too small for this program";
      if (parsed.ec == std::errc() && !std::isfinite(value))
        return "not a finite number";
      const char *const stop = parsed.ec == std::errc() ? parsed.ptr : begin;
      if (stop != end && *stop == ',')
        {
          const std::string hint = decimal_comma_hint(text);
          return hint.empty() ? "decimals begin with a point, and nothing "
                                "separates thousands" :
                                hint;
        }
      if (const std::string hint = minus_hint(text); !hint.empty())
        return hint;
      if (parsed.ec != std::errc())
        return "not a number" + std::string(dimension == Dimension::number ?
                                              "" :
                                              " followed by a unit");

      const std::string unit =
        dealii::Utilities::trim(std::string(parsed.ptr, end));
      if (dimension == Dimension::number)
        return unit.empty() ? "" :
                              "a plain number has no unit \"" + unit + "\"";
      if (unit.empty())
        return unit_required ?
                 "the unit is missing (known: " + joined_unit_names(dimension) +
                   ")" :
                 "";
      const Unit *known = find_unit(unit, dimension);
      // "mm2", "µm", but not the "in" of "5 mm in 1 s".
      if (known == nullptr && unit != "in")
        known = find_unit(plain_unit(unit), dimension);
      if (known == nullptr)
        return why_no_unit(unit, dimension);
      value = value * known->numerator / known->denominator + known->offset;
      return "";
    }



    double degrees_to_base(const double value, const Dimension dimension)
    {
      return dimension == Dimension::angle ?
               value * dealii::numbers::PI / 180. :
               value;
    }



    // A bound that nobody can reach is not worth a word.
    constexpr double reachable = 1e30;
  } // namespace



  std::string base_unit(const Dimension dimension)
  {
    const auto &units = entry(dimension).units;
    return units.empty() ? "" : units.front().name;
  }



  double parse_quantity(const std::string &text,
                        const Dimension    dimension,
                        const bool         unit_required)
  {
    double            value = 0.;
    const std::string why   = parse(text, dimension, unit_required, value);
    if (!why.empty())
      throw InputError("\"" + dealii::Utilities::trim(text) + "\": " + why);
    return degrees_to_base(value, dimension);
  }



  UnitConversion unit_conversion(const std::string &unit,
                                 const Dimension    dimension)
  {
    const std::string plain = plain_unit(dealii::Utilities::trim(unit));
    const Unit       *known = find_unit(plain, dimension);
    if (known == nullptr)
      throw InputError(dimension == Dimension::number ?
                         "a plain number has no unit \"" + plain + "\"" :
                         why_no_unit(plain, dimension));
    Assert(dimension != Dimension::angle, dealii::ExcNotImplemented());
    return {known->numerator, known->denominator, known->offset};
  }



  Quantity::Quantity(const Dimension dimension,
                     const double    minimum,
                     const double    maximum,
                     const bool      minimum_is_excluded,
                     const bool      unit_required)
    : dimension(dimension)
    , minimum(minimum)
    , maximum(maximum)
    , minimum_is_excluded(minimum_is_excluded)
    , unit_required(unit_required)
  {
    Assert(minimum <= maximum, dealii::ExcMessage("The range is empty."));
  }



  std::string Quantity::why_not(const std::string &text) const
  {
    double            value = 0.;
    const std::string why   = parse(text, dimension, unit_required, value);
    if (!why.empty())
      return why;
    if (std::abs(value) > reachable)
      return "the number is too large: beyond " + short_text(reachable, 2);
    if (value < minimum || value > maximum ||
        (minimum_is_excluded && value == minimum))
      return "out of range";
    return "";
  }



  bool Quantity::match(const std::string &text) const
  {
    return why_not(text).empty();
  }



  std::string Quantity::description(const OutputStyle) const
  {
    std::string unit;
    if (dimension != Dimension::number)
      unit = (unit_required ? " with its unit (" : " (in ") +
             (unit_required ? joined_unit_names(dimension) :
                              base_unit(dimension) + " if no unit is given") +
             ")";
    return entry(dimension).name + unit + range();
  }



  std::string Quantity::description_of_range() const
  {
    return entry(dimension).name + range();
  }



  std::string Quantity::range() const
  {
    std::string       range;
    const bool        has_minimum = minimum > -reachable;
    const bool        has_maximum = maximum < reachable;
    const std::string base =
      dimension == Dimension::number ? "" : " " + base_unit(dimension);
    if (has_minimum)
      range += (minimum_is_excluded ? " greater than " : " of at least ") +
               short_text(minimum, 10) + (has_maximum ? "" : base);
    if (has_maximum)
      range += std::string(has_minimum ? " and" : " of") + " at most " +
               short_text(maximum, 10) + base;
    return range;
  }



  std::unique_ptr<dealii::Patterns::PatternBase> Quantity::clone() const
  {
    return std::make_unique<Quantity>(
      dimension, minimum, maximum, minimum_is_excluded, unit_required);
  }



  double Quantity::value(const std::string &text) const
  {
    return parse_quantity(text, dimension, unit_required);
  }
} // namespace SlipStep
