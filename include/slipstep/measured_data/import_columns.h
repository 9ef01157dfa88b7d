// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_measured_data_import_columns_h
#define slipstep_measured_data_import_columns_h

#include <slipstep/utilities/csv.h>
#include <slipstep/utilities/formula.h>
#include <slipstep/utilities/parameters.h>
#include <slipstep/utilities/units.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace SlipStep
{
  /// A key of section Columns of a map: what it holds.
  struct ColumnKey
  {
    std::string name;
    Dimension   dimension;
    std::string text; ///< for the documentation
  };

  const std::vector<ColumnKey> &column_keys();

  /// Which quantity has this unit, of those that a column of a record may have;
  /// none if no unit is known by the name.
  std::optional<Dimension> dimension_of_unit(const std::string &unit);

  /// The columns of a raw file as section Columns of a map names them, in base
  /// units. A key is a column, "NAME in UNIT", or a formula of columns,
  /// "({F in N} - 0.02*{p in bar})/{N in N}".
  class ImportColumns
  {
  public:
    /// Find all columns in the header of @p table.
    /// @throws InputError naming the place in the map
    ImportColumns(const Parameters &map, CsvTable &table);

    /// Read the rows.
    void read();

    /// Whether the map says where the values of this key are.
    bool has(const std::string &key) const;

    /// The values of a key in base units; NaN where a cell is empty. Time
    /// counts from clock().
    std::vector<double> values(const std::string &key) const;

    /// The first stamp [s] of a clock that shows the date, whose small steps
    /// would be lost with its units; else 0.
    double clock() const;

    /// Columns whose unit in the map is not that in the file, in words.
    const std::vector<std::string> &contradictions() const
    {
      return contradicting_units;
    }

    /// Report a value of a key.
    /// @throws InputError "file:line:column: why"
    [[noreturn]] void reject(const std::size_t  row,
                             const std::string &key,
                             const std::string &why) const;

  private:
    /// A column of the file that a key uses.
    struct Source
    {
      std::string              label; ///< its name in the table
      std::size_t              position;
      UnitConversion           conversion;
      std::optional<Dimension> dimension; ///< none: the bare number
    };

    /// What the values of a key are made of.
    struct Recipe
    {
      std::vector<Source>          sources;
      std::optional<ParsedFormula> formula;
      UnitConversion               conversion; ///< of what the formula gives
    };

    std::size_t find_column(const std::string &path,
                            const std::string &name) const;

    Source find_source(const std::string             &path,
                       const std::string             &text,
                       const std::optional<Dimension> dimension);

    /// "" if it says none.
    std::string unit_in_file(const std::size_t position) const;

    UnitConversion conversion_of_share(const std::string &path,
                                       const std::string &name,
                                       const std::string &told,
                                       const Source      &source);

    void add_contradiction(const std::size_t  position,
                           const std::string &taken,
                           const std::string &in_file);

    void compare_units(const std::size_t  position,
                       const std::string &unit,
                       const Dimension    dimension);

    Recipe read_formula(const ColumnKey &key);

    static bool fits_units(const Recipe             &recipe,
                           const std::vector<double> arguments,
                           const Dimension           dimension);

    /// @throws InputError if the result of a formula has units of another kind
    void check_units(const Recipe      &recipe,
                     const std::string &text,
                     const ColumnKey   &key) const;

    void find_clock();

    const Parameters             &map;
    CsvTable                     &table;
    std::map<std::string, Recipe> recipes;
    double                        first_stamp = 0.; ///< in the file's unit
    std::vector<std::string>      contradicting_units;
  };
} // namespace SlipStep

#endif
