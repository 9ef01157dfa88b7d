// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_utilities_write_file_h
#define slipstep_utilities_write_file_h

#include <slipstep/utilities/exceptions.h>

#include <cerrno>
#include <filesystem>
#include <string>

namespace SlipStep
{
  /// What to throw when a file or folder could not be written: names it and
  /// why, "output/history.csv: cannot be written (the disk is full)".
  /// @param error of the system call; streams leave it in errno, too
  RunError write_failure(const std::filesystem::path &file,
                         const int                    error = errno);

  /// Force a file or a folder onto the disk.
  /// @throws RunError if the disk refuses
  void synchronise(const std::filesystem::path &path);

  /// Write a text file atomically: a temporary file beside it is renamed into
  /// place when it is on the disk, so that a reader never meets half of it,
  /// not even after a power cut.
  /// @throws RunError if the disk refuses
  void write_file(const std::filesystem::path &file,
                  const std::string           &content);
} // namespace SlipStep

#endif
