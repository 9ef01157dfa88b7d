// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tests_restart_background_run_h
#define tests_restart_background_run_h

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/file_text.h"

/// The real program at work, to be disturbed.
class BackgroundRun
{
public:
  /// @param folder the working directory of the program; what it prints goes
  ///   into files beside that folder
  /// @param launcher words before the program
  BackgroundRun(const std::filesystem::path    &folder,
                const std::vector<std::string> &arguments,
                const std::vector<std::string> &launcher = {})
    : out_file(folder.string() + ".out")
    , err_file(folder.string() + ".err")
  {
    const char              *from_environment = std::getenv("SLIPSTEP_BINARY");
    std::vector<std::string> words            = launcher;
    words.push_back(from_environment != nullptr ? from_environment :
                                                  SLIPSTEP_BINARY);
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char *> argv;
    for (std::string &word : words)
      argv.push_back(word.data());
    argv.push_back(nullptr);

    pid = fork();
    if (pid == 0)
      {
        const auto redirect = [](const std::string &file, const int to) {
          dup2(open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), to);
        };
        redirect(out_file, STDOUT_FILENO);
        redirect(err_file, STDERR_FILENO);
        dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
        if (chdir(folder.c_str()) == 0)
          execvp(argv.front(), argv.data());
        _exit(127);
      }
  }

  ~BackgroundRun()
  {
    send(SIGKILL);
    wait();
  }

  BackgroundRun(const BackgroundRun &)            = delete;
  BackgroundRun &operator=(const BackgroundRun &) = delete;

  void send(const int signal) const
  {
    if (!is_over)
      kill(pid, signal);
  }

  /// SIGKILL to the program and all that it has started, as in a power cut.
  void kill_all() const
  {
    const std::string  self = std::to_string(pid);
    std::ifstream      in("/proc/" + self + "/task/" + self + "/children");
    std::vector<pid_t> children;
    for (pid_t child; in >> child;)
      children.push_back(child);
    send(SIGKILL);
    for (const pid_t child : children)
      kill(child, SIGKILL);
  }

  /// Let files grow no more than this, as on a full disk.
  void limit_file_size(const unsigned long bytes) const
  {
    const rlimit limit{bytes, RLIM_INFINITY};
    prlimit(pid, RLIMIT_FSIZE, &limit, nullptr);
  }

  bool is_running()
  {
    if (!is_over && waitpid(pid, &status, WNOHANG) == pid)
      is_over = true;
    return !is_over;
  }

  void wait()
  {
    if (!is_over)
      waitpid(pid, &status, 0);
    is_over = true;
  }

  /// Wait until something is the case or the program ends.
  /// @return whether it is
  template <class Condition>
  bool wait_until(const Condition &is_true)
  {
    while (!is_true())
      {
        if (!is_running())
          return is_true();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    return true;
  }

  /// Exit code, or minus the signal that ended it.
  int outcome() const
  {
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

  std::string out() const
  {
    return content(out_file);
  }

  /// Without what Open MPI's daemon says when the program that it serves is
  /// killed under its hands.
  std::string err() const
  {
    std::istringstream in(content(err_file));
    std::string        line, own;
    while (std::getline(in, line))
      if (line.find("ORTE_ERROR_LOG") == std::string::npos)
        own += line + '\n';
    return own;
  }

private:
  const std::string out_file, err_file;
  pid_t             pid     = -1;
  int               status  = 0;
  bool              is_over = false;
};

#endif
