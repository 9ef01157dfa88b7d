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
      std::optional<Clock>     clock;     ///< whose times it has
    };

    /// What the values of a key are made of.
    struct Recipe
    {
      std::vector<Source>          sources;
      std::optional<ParsedFormula> formula;
      UnitConversion               conversion; ///< of what the formula gives
    };

    class RecipeReader;

    void find_clock();

    CsvTable                     &table;
    std::map<std::string, Recipe> recipes;
    double                        first_stamp = 0.; ///< in the file's unit
    std::vector<std::string>      contradicting_units;
  };
} // namespace SlipStep

#endif
