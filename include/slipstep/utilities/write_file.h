#ifndef slipstep_utilities_write_file_h
#define slipstep_utilities_write_file_h

#include <filesystem>
#include <string>

namespace SlipStep
{
  /// Write a text file atomically: a temporary file beside it is renamed into
  /// place, so that a reader never meets half of it.
  /// @throws RunError if the disk refuses
  void write_file(const std::filesystem::path &file,
                  const std::string           &content);
} // namespace SlipStep

#endif
