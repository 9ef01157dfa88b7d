// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_utilities_parameter_reader_h
#define slipstep_utilities_parameter_reader_h

#include <slipstep/utilities/parameters.h>

#include <filesystem>
#include <string>
#include <vector>

namespace SlipStep
{
  /// "file:line", as messages begin.
  std::string place(const std::filesystem::path &file, const unsigned int line);

  /// A line of a .prm file that says something; continuation lines are joined.
  struct PrmStatement
  {
    enum class Kind
    {
      subsection, ///< name
      end,        ///<
      set,        ///< name, value
      include,    ///< value
      wrong       ///< none of these: value is the message
    };
    Kind         kind = Kind::end;
    std::string  name;
    std::string  value;
    unsigned int line = 0; ///< the first one, counted from 1
    std::string  where;    ///< "file:line"
  };

  /// Split a .prm file into statements, without knowing any key.
  /// @throws InputError if it cannot be read, is not named *.prm, or is not
  /// text.
  std::vector<PrmStatement>
  read_prm_statements(const std::filesystem::path &file);

  /// A value with the place it was written in.
  struct Assignment
  {
    std::string  path;
    std::string  value;
    std::string  origin;    ///< "file:line"
    unsigned int layer = 0; ///< 1 for the file included first, then upwards
  };

  /// What a case file and its includes say.
  struct CaseText
  {
    /// In the order in which they are to be applied.
    std::vector<Assignment> assignments;
    std::vector<Variant>    variants;
    unsigned int            n_layers = 0;
  };

  /// Read a case file and everything it includes; every key and value is
  /// checked against @p known in the order in which a reader of the file meets
  /// it. A file overrides what it includes, a later include an earlier one; the
  /// including file's sweep replaces an included one.
  /// @throws InputError naming file:line; all that is wrong is told at once, a
  /// line each, up to a bound
  CaseText read_case_text(const std::filesystem::path &file,
                          const Parameters            &known);
} // namespace SlipStep

#endif
