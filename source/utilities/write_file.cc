// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/utilities/write_file.h>

#include <fcntl.h>
#include <unistd.h>

#include <cstring>
#include <fstream>

namespace SlipStep
{
  RunError write_failure(const std::filesystem::path &file, const int error)
  {
    std::string reason;
    switch (error)
      {
        case 0:
          break;
        case ENOSPC:
          reason = " (the disk is full)";
          break;
        case EDQUOT:
          reason = " (your share of the disk is used up)";
          break;
        case EFBIG:
          reason = " (files may not grow larger here, see ulimit -f)";
          break;
        case ENOENT:
          reason = " (its folder has gone)";
          break;
        default:
          reason = std::string(" (") + std::strerror(error) + ')';
      }
    return RunError(file.string() + ": cannot be written" + reason);
  }



  void synchronise(const std::filesystem::path &path)
  {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0)
      throw write_failure(path);
    const int error = ::fsync(descriptor) == 0 ? 0 : errno;
    ::close(descriptor);
    // Some file systems cannot do this with folders.
    if (error != 0 && error != EINVAL)
      throw write_failure(path, error);
  }



  void write_file(const std::filesystem::path &file, const std::string &content)
  {
    const std::filesystem::path temporary = file.string() + ".part";
    try
      {
        errno = 0;
        std::ofstream out(temporary, std::ios::binary);
        out << content;
        out.close();
        if (!out)
          throw write_failure(file);
        synchronise(temporary);
        std::error_code error;
        std::filesystem::rename(temporary, file, error);
        if (error)
          throw write_failure(file, error.value());
        const auto folder = file.parent_path();
        synchronise(folder.empty() ? "." : folder);
      }
    catch (const RunError &)
      {
        std::error_code error;
        std::filesystem::remove(temporary, error);
        throw;
      }
  }
} // namespace SlipStep
