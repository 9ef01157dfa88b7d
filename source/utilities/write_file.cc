#include <slipstep/utilities/write_file.h>

#include <slipstep/utilities/exceptions.h>

#include <fstream>

namespace SlipStep
{
  void write_file(const std::filesystem::path &file, const std::string &content)
  {
    const std::filesystem::path temporary = file.string() + ".part";
    std::ofstream               out(temporary, std::ios::binary);
    out << content;
    out.close();
    std::error_code error;
    if (out)
      std::filesystem::rename(temporary, file, error);
    if (out && !error)
      return;
    std::filesystem::remove(temporary, error);
    throw RunError(file.string() + ": cannot be written (is the disk full?)");
  }
} // namespace SlipStep
