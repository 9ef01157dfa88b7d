// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/process.h>

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <initializer_list>
#include <iostream>
#include <thread>

namespace SlipStep
{
  namespace
  {
    volatile std::sig_atomic_t caught_signal  = 0;
    int                        put_off_signal = 0;
    unsigned int               n_guards       = 0;

    struct timespec time_of_signal; // written before caught_signal

    void remember_signal(const int signal)
    {
      if (caught_signal == 0)
        clock_gettime(CLOCK_MONOTONIC, &time_of_signal);
      caught_signal = signal;
    }



    volatile std::sig_atomic_t checkpoint_request = 0;

    void remember_request(const int)
    {
      checkpoint_request = 1;
    }



    unsigned int
    number_in_environment(const std::initializer_list<const char *> &names,
                          const unsigned int                         otherwise)
    {
      if (is_under_mpirun())
        for (const char *name : names)
          if (const char *number = std::getenv(name))
            return std::atoi(number);
      return otherwise;
    }
  } // namespace



  void open_closed_descriptors()
  {
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
      if (fcntl(descriptor, F_GETFD) == -1)
        open("/dev/null", O_RDWR);
  }



  bool is_under_mpirun()
  {
    for (const char *name :
         {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK", "SLURM_STEP_ID"})
      if (std::getenv(name) != nullptr)
        return true;
    return false;
  }



  unsigned int launched_rank()
  {
    return number_in_environment(
      {"OMPI_COMM_WORLD_RANK", "PMI_RANK", "SLURM_PROCID"}, 0);
  }



  unsigned int n_launched()
  {
    return number_in_environment(
      {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_NTASKS"}, 1);
  }



  // Whoever has set the variables keeps their values. Other MPI implementations
  // do not know them. All isolated processes would share one session directory,
  // which the first of them to end takes from those that are just starting.
  void start_mpi_without_daemon()
  {
    if (is_under_mpirun())
      return;
    setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
    setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
  }



  namespace
  {
    // How it ended, if it has.
    bool has_ended(const pid_t pid, ProgramEnd &end)
    {
      int status = 0;
      if (waitpid(pid, &status, WNOHANG) == 0)
        return false;
      const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 1;
      end            = code == 0   ? ProgramEnd::success :
                       code == 127 ? ProgramEnd::not_found :
                                     ProgramEnd::failure;
      return true;
    }
  } // namespace



  ProgramEnd run_program(std::vector<std::string>     words,
                         const std::filesystem::path &folder,
                         const std::string           &log,
                         const std::chrono::seconds   time_limit)
  {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
    posix_spawn_file_actions_addopen(
      &actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(
      &actions, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
    std::vector<char *> arguments;
    for (std::string &word : words)
      arguments.push_back(word.data());
    arguments.push_back(nullptr);
    pid_t     pid   = 0;
    const int error = posix_spawnp(
      &pid, arguments.front(), &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0)
      return error == ENOENT ? ProgramEnd::not_found : ProgramEnd::failure;

    const auto start = std::chrono::steady_clock::now();
    ProgramEnd end   = ProgramEnd::success;
    while (!has_ended(pid, end))
      {
        const bool is_too_slow =
          std::chrono::steady_clock::now() - start > time_limit;
        if (is_too_slow || SignalGuard::caught() != 0)
          {
            kill(pid, SIGKILL);
            waitpid(pid, nullptr, 0);
            return is_too_slow ? ProgramEnd::too_slow : ProgramEnd::stopped;
          }
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
      }
    return end;
  }



  SignalGuard::SignalGuard(const bool is_patient)
  {
    if (n_guards++ == 0)
      caught_signal = put_off_signal = 0;
    struct sigaction action
    {};
    action.sa_handler = remember_signal;
    if (!is_patient)
      action.sa_flags = SA_RESETHAND;
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, &old_interrupt);
    sigaction(SIGTERM, &action, &old_terminate);
    // Of which there may be two, by the shell and by the terminal.
    action.sa_flags = 0;
    sigaction(SIGHUP, &action, &old_hangup);
    // What nohup started goes on.
    if (old_hangup.sa_handler == SIG_IGN)
      sigaction(SIGHUP, &old_hangup, nullptr);
    action.sa_handler = remember_request;
    action.sa_flags   = SA_RESTART;
    sigaction(SIGUSR1, &action, &old_user);
  }



  SignalGuard::~SignalGuard()
  {
    --n_guards;
    sigaction(SIGINT, &old_interrupt, nullptr);
    sigaction(SIGTERM, &old_terminate, nullptr);
    sigaction(SIGHUP, &old_hangup, nullptr);
    sigaction(SIGUSR1, &old_user, nullptr);
  }



  int SignalGuard::caught()
  {
    return caught_signal;
  }



  double SignalGuard::age()
  {
    if (caught_signal == 0)
      return 0.;
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec - time_of_signal.tv_sec +
           1e-9 * (now.tv_nsec - time_of_signal.tv_nsec);
  }



  void SignalGuard::throw_if_caught()
  {
    if (caught_signal != 0)
      throw RunError(in_words());
  }



  void SignalGuard::put_off()
  {
    put_off_signal = caught_signal;
    caught_signal  = 0;
  }



  void SignalGuard::recall()
  {
    if (put_off_signal != 0)
      caught_signal = put_off_signal;
  }



  void SignalGuard::share(const int signal)
  {
    remember_signal(signal);
  }



  bool SignalGuard::take_checkpoint_request()
  {
    if (checkpoint_request == 0)
      return false;
    checkpoint_request = 0;
    return true;
  }



  std::string SignalGuard::in_words()
  {
    return std::string("stopped by a signal (") + strsignal(caught_signal) +
           ")";
  }



  void SignalGuard::obey()
  {
    if (caught_signal == 0)
      return;
    std::cout.flush();
    std::cerr.flush();
    std::raise(caught_signal);
  }



  std::chrono::steady_clock::time_point deadline_after(const double seconds)
  {
    using Clock = std::chrono::steady_clock;
    return Clock::now() + std::chrono::duration_cast<Clock::duration>(
                            std::chrono::duration<double>(seconds));
  }



  ResourceUsage ResourceUsage::now()
  {
    ResourceUsage usage;
    usage.wall_time = std::chrono::duration<double>(
                        std::chrono::steady_clock::now().time_since_epoch())
                        .count();
    rusage process;
    getrusage(RUSAGE_SELF, &process);
    for (const timeval &time : {process.ru_utime, process.ru_stime})
      usage.cpu_time += time.tv_sec + 1e-6 * time.tv_usec;
    usage.peak_memory = process.ru_maxrss * 1024. / 1e6;
    return usage;
  }
} // namespace SlipStep
