// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tests_bad_input_slipstep_process_h
#define tests_bad_input_slipstep_process_h

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/file_text.h"
#include "tests/temporary_folder.h"

/// The real program, started in a folder of its own.
class SlipstepProcess
{
public:
  struct Result
  {
    int         exit_code = -1;
    std::string out;
    std::string err;

    unsigned int n_error_lines() const
    {
      std::istringstream in(err);
      unsigned int       n = 0;
      for (std::string line; std::getline(in, line);)
        ++n;
      return n;
    }
  };

  SlipstepProcess()
    : root(temporary.path())
  {
    std::filesystem::create_directory(folder());
  }

  /// The working directory of the program.
  std::filesystem::path folder() const
  {
    return root / "work";
  }

  /// @return whether the program left its working directory empty
  bool wrote_nothing() const
  {
    return std::filesystem::is_empty(folder());
  }

  /// The content of a file in the working directory.
  std::string read(const std::string &name) const
  {
    return content(folder() / name);
  }

  void write(const std::string &name, const std::string &text) const
  {
    std::ofstream(folder() / name) << text;
  }

  /// @param launcher shell words before the program, e.g. "mpirun -np 2"
  /// @param set_up shell commands before it, e.g. "ulimit -f 20 &&"
  Result run(const std::vector<std::string> &arguments,
             const std::string              &launcher = "",
             const std::string              &set_up   = "") const
  {
    // A case that is wrongly accepted must not run for hours.
    std::string command = "cd " + quoted(folder().string()) + " && { " +
                          set_up + " timeout 1500 " + launcher + " " +
                          quoted(binary());
    for (const std::string &argument : arguments)
      command += " " + quoted(argument);
    command += "; } < /dev/null > " + quoted((root / "out").string()) + " 2> " +
               quoted((root / "err").string());
    const int status = std::system(command.c_str());
    Result    result;
    result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    result.out       = content(root / "out");
    result.err       = content(root / "err");
    return result;
  }

private:
  static std::string binary()
  {
    const char *from_environment = std::getenv("SLIPSTEP_BINARY");
    return from_environment != nullptr ? from_environment : SLIPSTEP_BINARY;
  }

  static std::string quoted(const std::string &text)
  {
    std::string result = "'";
    for (const char c : text)
      result += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return result + "'";
  }

  const TemporaryFolder       temporary;
  const std::filesystem::path root;
};

/// One message naming the matter, exit code 2.
inline void expect_refusal(const SlipstepProcess::Result  &result,
                           const std::vector<std::string> &words)
{
  EXPECT_EQ(result.exit_code, 2) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_LE(result.n_error_lines(), 2u) << result.err;
  for (const std::string &word : words)
    EXPECT_TRUE(contains(result.err, word));
}

/// A case which is right and short, should it ever be run.
const char *const right = "set Loading/Programme = press 1 MPa in 1 s; "
                          "slide 1 mm/s for 0.01 mm\n";

#endif
