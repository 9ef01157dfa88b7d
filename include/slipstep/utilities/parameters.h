// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_utilities_parameters_h
#define slipstep_utilities_parameters_h

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>

#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/nearest_name.h>
#include <slipstep/utilities/units.h>

#include <filesystem>
#include <functional>
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
  /// Declarations and values are held by a dealii::ParameterHandler, and a file
  /// has its format. This class is the front that a user meets: it knows the
  /// file and line of every value, tells keys given twice and the nearest known
  /// key, reads includes relative to the file, and has the sweep.
  ///
  /// A parameter is named by its path, e.g. "Friction/softening/Rate".
  class Parameters
  {
  public:
    enum class Format
    {
      prm,
      json,
      schema, // JSON schema
      keys,   // one per line
      markdown
    };

    /// What a ParameterHandler does not tell of a parameter.
    struct Entry
    {
      std::string                                          path;
      std::string                                          default_value;
      std::shared_ptr<const dealii::Patterns::PatternBase> pattern;
      std::string                                          documentation;
      /// "file:line", "--set"; "" while the value is the default.
      std::string  origin;
      unsigned int layer = 0;
    };

    /// For code that reads its parameters from a ParameterHandler.
    const dealii::ParameterHandler &handler();

    /// Declare a parameter. The documentation gives meaning, formula or
    /// reference, range and unit. Declared order is printed order.
    void declare(const std::string                   &path,
                 const std::string                   &default_value,
                 const dealii::Patterns::PatternBase &pattern,
                 const std::string                   &documentation);

    /// Read a .prm file: `subsection`/`end`, `set key = value`, `include FILE`
    /// (relative to the including file), `#` comments, `\` at the end of a line
    /// to continue. Sections `Variants` and `Sweep` define the sweep, see
    /// variants(). A file overrides what it includes, which must come first.
    /// @throws InputError naming file:line.
    void read(const std::filesystem::path &file);

    /// Override one value, e.g. from `--set`; later calls win. The origin is
    /// what messages name instead of file:line.
    /// @throws InputError for an unknown path (naming the nearest) or a value
    /// which is not allowed. A value set for a key that variants change holds
    /// for all of them: those which then differ in nothing are dropped.
    void set(const std::string &path,
             const std::string &value,
             const std::string &origin);

    /// Value as written (trimmed).
    std::string text(const std::string &path) const;

    /// Value of a Quantity, Double or Integer, in base units.
    double number(const std::string &path) const;

    int integer(const std::string &path) const;

    bool boolean(const std::string &path) const;

    /// Value split at commas, trimmed; empty text gives an empty list.
    std::vector<std::string> list(const std::string &path) const;

    /// Whether the value was given by the user (file, variant or --set).
    bool is_set(const std::string &path) const
    {
      return layer(path) > 0;
    }

    /// 0 = default, then growing with every included file, the case file, every
    /// variant and every set(). A value is superseded by a setting in a higher
    /// layer.
    unsigned int layer(const std::string &path) const
    {
      return entry(path).layer;
    }

    /// @throws InputError "origin: unknown key ..." with the nearest known one.
    void check_path(const std::string &path, const std::string &origin) const;

    /// The same for a section such as "Friction/softening".
    void check_section(const std::string &path,
                       const std::string &origin) const;

    /// check_path(), and that the value is allowed.
    void check(const std::string &path,
               const std::string &value,
               const std::string &origin) const;

    /// Everything known of one parameter.
    const Entry &entry(const std::string &path) const;

    /// All declared paths that begin with @p prefix, in declared order.
    std::vector<std::string> paths(const std::string &prefix = "") const;

    /// The paths of a key or of all keys of a section. Outer sections may be
    /// left out, if that is unique.
    /// @throws InputError "origin: there is no ..." with the nearest
    std::vector<std::string> find(const std::string &name,
                                  const std::string &origin) const;

    /// Where a value was given, as messages begin: "file:line: key" or
    /// "--set key".
    std::string origin(const std::string &path) const;

    /// Report a wrong value: throws InputError
    /// "file:line: key = value: why" (or "--set key = value: why").
    [[noreturn]] void reject(const std::string &path,
                             const std::string &why) const;

    /// Do what may find a value wrong.
    /// @throws InputError as reject() does, with what that of @p work says
    template <typename Work>
    auto attempt(const std::string &path, const Work &work) const
    {
      try
        {
          return work();
        }
      catch (const InputError &error)
        {
          reject(path, error.what());
        }
    }

    /// A file name in the case, made relative to the folder of the .prm file.
    std::filesystem::path resolve(const std::string &file_name) const;

    /// The case file read ("" before read()).
    const std::filesystem::path &case_file() const
    {
      return file_read;
    }

    /// The members of the sweep in order, empty if the case is a single run.
    /// Either `subsection Sweep` with `set Key = <path>` and
    /// `set Values = a, b, c` (separated by `;` if one contains a comma), with
    /// `Key 2` and `Values 2` and so on for all combinations, or
    /// `subsection Variants` holding one subsection per variant whose entries
    /// are `set <full path> = value`. An empty `Variants` undoes an included
    /// sweep.
    const std::vector<Variant> &variants() const
    {
      return variant_list;
    }

    /// Sweep one more key: every variant there is with each of these values,
    /// which take the place of those that it has from elsewhere.
    /// @throws InputError for a key that @p origin sweeps already, or wrong
    ///   values
    void sweep(const std::string              &path,
               const std::vector<std::string> &values,
               const std::string              &origin);

    /// Leave out all members of the sweep but that of this label or folder.
    /// @return whether there is one
    bool keep_variant(const std::string &name);

    /// The complete parameters of one variant, which is no sweep any more.
    Parameters with_variant(const Variant &variant) const;

    /// Say the same in other words: change a value and what variants give
    /// instead of it.
    void
    rewrite(const std::string                                     &path,
            const std::function<std::string(const std::string &)> &rewritten);

    /// Write all parameters with their values. Sections named in
    /// @p omitted_sections (paths such as "Friction/healing") are left out, in a
    /// .prm file those in @p disabled_sections are put behind "#".
    /// @param only the paths to be written, all if empty
    void print(std::ostream                   &out,
               const Format                    format,
               const std::set<std::string>    &omitted_sections  = {},
               const std::set<std::string>    &disabled_sections = {},
               const std::vector<std::string> &only              = {}) const;

    /// All sections, as paths, those of sweeps included.
    std::vector<std::string> sections() const;

    /// Write what has other values than in @p other, as for a file that includes
    /// the file of @p other.
    void print_changes(std::ostream &out, const Parameters &other) const;

    /// Whether all values are those of @p other, as text.
    bool has_values_of(const Parameters &other) const;

  private:
    /// It cannot be copied: copies share it and have what is set after that
    /// beside it, since a diagnosis copies cases by the thousand.
    std::shared_ptr<dealii::ParameterHandler> values =
      std::make_shared<dealii::ParameterHandler>();
    std::map<std::string, std::string> own_values; ///< by path
    std::vector<Entry>                 entries;
    std::map<std::string, std::size_t> index_of_path;
    std::filesystem::path              file_read;
    std::vector<Variant>               variant_list;
    unsigned int                       n_layers = 0;

    /// Call what is given with the name of the key, inside of its sections.
    void in_section(const std::string                              &path,
                    const std::function<void(const std::string &)> &action);

    void set_value(const std::string &path, const std::string &value);

    void stop_sharing();
  };
} // namespace SlipStep

#endif
