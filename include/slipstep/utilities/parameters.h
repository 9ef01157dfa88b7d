#ifndef slipstep_utilities_parameters_h
#define slipstep_utilities_parameters_h

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>

#include <slipstep/utilities/units.h>

#include <filesystem>
#include <map>
#include <memory>
#include <ostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace SlipStep
{
  /// One member of a sweep: a name, used for its folder and its legend, and the
  /// keys in which it differs from the case.
  struct Variant
  {
    /// What legends and tables show, e.g. "10 mm/min".
    std::string label;
    /// The same, safe as a folder name, e.g. "10_mm-min".
    std::string folder;
    /// Pairs (full path of a key, value), with where they were written.
    struct Override
    {
      std::string path;
      std::string value;
      std::string origin;
    };
    std::vector<Override> overrides;
  };

  /// All parameters of a case: declared by the rooms that use them, read from a
  /// .prm file, overridden by variants and by `--set`.
  ///
  /// Declarations, patterns and printed forms are those of
  /// dealii::ParameterHandler; reading is done here, because a user needs what
  /// ParameterHandler does not keep: the file and line of every value, keys
  /// given twice, the nearest known key, includes relative to the file.
  ///
  /// A parameter is named by its path, e.g. "Friction/softening/Rate".
  class Parameters
  {
  public:
    enum class Format
    {
      prm,
      json,
      markdown
    };

    /// Declare a parameter. The documentation gives meaning, formula or
    /// reference, range and unit. Declared order is printed order.
    void
    declare(const std::string &                  path,
            const std::string &                  default_value,
            const dealii::Patterns::PatternBase &pattern,
            const std::string &                  documentation);

    /// Read a .prm file: `subsection`/`end`, `set key = value`, `include FILE`
    /// (relative to the including file), `#` comments, `\` at the end of a line
    /// to continue. Sections `Variants` and `Sweep` define the sweep, see
    /// variants().
    /// @throws InputError naming file:line.
    void
    read(const std::filesystem::path &file);

    /// Override one value, e.g. from `--set`; later calls win. The origin is
    /// what messages name instead of file:line.
    /// @throws InputError for an unknown path (naming the nearest) or a value
    /// which is not allowed.
    void
    set(const std::string &path,
        const std::string &value,
        const std::string &origin);

    /// Value as written (trimmed).
    std::string
    text(const std::string &path) const;

    /// Value of a Quantity, Double or Integer, in base units.
    double
    number(const std::string &path) const;

    int
    integer(const std::string &path) const;

    bool
    boolean(const std::string &path) const;

    /// Value split at commas, trimmed; empty text gives an empty list.
    std::vector<std::string>
    list(const std::string &path) const;

    /// Whether the value was given by the user (file, variant or --set).
    bool
    is_set(const std::string &path) const;

    /// 0 = default, 1 = case file, then growing with every override. A value is
    /// superseded by a setting in a higher layer.
    unsigned int
    layer(const std::string &path) const;

    /// All declared paths that begin with @p prefix, in declared order.
    std::vector<std::string>
    paths(const std::string &prefix = "") const;

    /// Report a wrong value: throws InputError
    /// "file:line: key = value: why" (or "--set key = value: why").
    [[noreturn]] void
    reject(const std::string &path, const std::string &why) const;

    /// A file name in the case, made relative to the folder of the .prm file.
    std::filesystem::path
    resolve(const std::string &file_name) const;

    /// The case file read ("" before read()).
    const std::filesystem::path &
    case_file() const;

    /// The members of the sweep in order, empty if the case is a single run.
    /// Either `subsection Sweep` with `set Key = <path>` and
    /// `set Values = a, b, c` (separated by `;` if one contains a comma), or
    /// `subsection Variants` holding one subsection per variant whose entries
    /// are `set <full path> = value`.
    const std::vector<Variant> &
    variants() const;

    /// Write all parameters with their values. Sections named in
    /// @p omitted_sections (paths such as "Friction/healing") are left out.
    void
    print(std::ostream &               out,
          const Format                 format,
          const std::set<std::string> &omitted_sections = {}) const;

  private:
    // helper's choice
  };

  /// The candidate closest to @p name in edit distance (case ignored), or "" if
  /// none is near enough to be meant.
  std::string
  nearest_name(const std::string &             name,
               const std::vector<std::string> &candidates);
} // namespace SlipStep

#endif
