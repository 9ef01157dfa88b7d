// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_experiment_archive_file_h
#define slipstep_experiment_archive_file_h

#include <slipstep/utilities/write_file.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>

#include <filesystem>
#include <fstream>

namespace SlipStep
{
  /// Write an object, bit for bit, into a file that read_archive() of the same
  /// program reads.
  /// @throws RunError if the disk refuses
  template <class Object>
  void write_archive(const std::filesystem::path &file, const Object &object)
  {
    bool is_written = false;
    try
      {
        std::ofstream out(file, std::ios::binary);
        boost::archive::binary_oarchive(out) << object;
        is_written = static_cast<bool>(out.flush());
      }
    catch (const boost::archive::archive_exception &)
      {}
    if (!is_written)
      throw write_failure(file);
  }

  /// @throws InputError if it is no such file, or of another build
  template <class Object>
  void read_archive(const std::filesystem::path &file, Object &object)
  {
    try
      {
        std::ifstream in(file, std::ios::binary);
        boost::archive::binary_iarchive(in) >> object;
      }
    catch (const std::exception &)
      {
        throw InputError(file.string() +
                         ": cannot be read; it is damaged, or was written by "
                         "another build of slipstep");
      }
  }
} // namespace SlipStep

#endif
