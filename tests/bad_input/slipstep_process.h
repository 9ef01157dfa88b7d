// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tests_bad_input_slipstep_process_h
#define tests_bad_input_slipstep_process_h

#include <deal.II/base/mpi.h>

#include <slipstep/commands/commands.h>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/file_text.h"
#include "tests/temporary_folder.h"

/// The real program, started in a folder of its own. Loading its two hundred
/// libraries takes half a second, more than most inputs do: where nothing is to
/// be set up before, a copy of this process, which has them, becomes the
/// program.
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
  /// @param seconds after which it is killed: a case that is wrongly accepted
  ///   must not run for hours
  Result run(const std::vector<std::string> &arguments,
             const std::string              &launcher = "",
             const std::string              &set_up   = "",
             const unsigned int              seconds  = 1500) const
  {
    const bool is_bare = launcher.empty() && set_up.empty() &&
                         std::getenv("SLIPSTEP_BINARY") == nullptr &&
                         !dealii::Utilities::MPI::job_supports_mpi();
    const int status =
      is_bare ? run_copy(arguments, seconds) :
                run_in_shell(arguments,
                             set_up + " timeout " + std::to_string(seconds) +
                               " " + launcher);
    Result result;
    result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    result.out       = content(root / "out");
    result.err       = content(root / "err");
    return result;
  }

private:
  int run_in_shell(const std::vector<std::string> &arguments,
                   const std::string              &before) const
  {
    std::string command = "cd " + quoted(folder().string()) + " && { " +
                          before + " " + quoted(binary());
    for (const std::string &argument : arguments)
      command += " " + quoted(argument);
    command += "; } < /dev/null > " + quoted((root / "out").string()) + " 2> " +
               quoted((root / "err").string());
    return std::system(command.c_str());
  }

  int run_copy(const std::vector<std::string> &arguments,
               const unsigned int              seconds) const
  {
    std::vector<std::string> words = {binary()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char *> argv;
    for (std::string &word : words)
      argv.push_back(word.data());
    argv.push_back(nullptr);

    std::cout.flush();
    std::fflush(nullptr);
    const pid_t pid = fork();
    if (pid == 0)
      {
        const auto open_as = [](const std::string &file, const int descriptor) {
          const int opened =
            open(file.c_str(), O_RDWR | O_CREAT | O_TRUNC, 0644);
          dup2(opened, descriptor);
          close(opened);
        };
        open_as("/dev/null", STDIN_FILENO);
        open_as(root / "out", STDOUT_FILENO);
        open_as(root / "err", STDERR_FILENO);
        std::filesystem::current_path(folder());
        alarm(seconds);
        std::exit(
          SlipStep::program(arguments.size() + 1, argv.data(), binary()));
      }
    int status = -1;
    waitpid(pid, &status, 0);
    return status;
  }

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
