// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_measured_data_import_proposal_h
#define slipstep_measured_data_import_proposal_h

#include <slipstep/measured_data/record_layout.h>
#include <slipstep/utilities/parameters.h>

#include <filesystem>
#include <string>
#include <vector>

namespace SlipStep
{
  /// A line of a map that looking at the file suggests.
  struct ImportGuess
  {
    std::string path; ///< "Columns/Time"
    std::string value;
    std::string reason; ///< what speaks for it, or what is missing
    /// What only the user can say: it stands in the map as a comment.
    bool is_open = false;
  };

  /// A column of a record, as the eye finds it.
  struct SeenColumn
  {
    std::size_t number = 0; ///< counted from 1
    std::string name, unit; ///< "" if the file has none
    bool        has_numbers = false;
    double      least = 0., most = 0.; ///< as recorded
    std::string taken_as;              ///< "Time"; "" if it is not used
  };

  /// A map for a record that nobody has described, and what it rests on.
  struct ImportProposal
  {
    std::filesystem::path    file;
    RecordLayout             layout;
    std::vector<SeenColumn>  columns;
    std::vector<ImportGuess> guesses; ///< in the order of a map

    /// Whether nothing is left open.
    bool is_complete() const;

    /// The map without what is open.
    Parameters map() const;

    /// The same as a file, each line with what speaks for it. What is open is a
    /// comment.
    std::string text() const;
  };

  /// Section Raw file of the map of a file.
  std::vector<ImportGuess> guesses_of_layout(const std::filesystem::path &file,
                                             const RecordLayout &layout);

  /// Look at a record: how it is laid out, which column is what, in which unit
  /// and with which sign.
  /// @throws InputError if there is no table of numbers, or a cell cannot be
  /// read
  ImportProposal propose_import(const std::filesystem::path &file);
} // namespace SlipStep

#endif
