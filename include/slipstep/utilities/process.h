// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_utilities_process_h
#define slipstep_utilities_process_h

#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

namespace SlipStep
{
  /// Lead standard input, output and errors to /dev/null where they are closed:
  /// a file of results that is opened next must not get the messages.
  void open_closed_descriptors();

  /// Whether mpirun, srun or the like started this process.
  bool is_under_mpirun();

  /// Which of the processes of mpirun this is, known without MPI_Init.
  unsigned int launched_rank();

  /// How many processes mpirun has started; 1 without it.
  unsigned int n_launched();

  /// A process that mpirun did not start needs neither the daemon nor the
  /// session directory that Open MPI would make for it; before MPI_Init.
  void start_mpi_without_daemon();

  /// How a program that was started ended.
  enum class ProgramEnd
  {
    success,
    failure, ///< or it ended by a signal
    not_found,
    too_slow, ///< killed after the time limit
    stopped   ///< killed because this process has caught a signal
  };

  /// Run another program to its end, without input.
  /// @param words its name, which is looked for in PATH, and its arguments
  /// @param folder in which it works
  /// @param log file in that folder for all that it prints
  ProgramEnd run_program(std::vector<std::string>     words,
                         const std::filesystem::path &folder,
                         const std::string           &log,
                         const std::chrono::seconds   time_limit);

  /// While one lives, SIGINT, SIGTERM and SIGHUP (unless that is ignored) do
  /// not end the process but are remembered, so that files can be completed
  /// first. SIGINT or SIGTERM a second time ends it at once, unless
  /// @p is_patient. SIGUSR1 asks for a checkpoint.
  class SignalGuard
  {
  public:
    explicit SignalGuard(const bool is_patient = false);

    ~SignalGuard();

    SignalGuard(const SignalGuard &)            = delete;
    SignalGuard &operator=(const SignalGuard &) = delete;

    /// The signal that came since the first of the guards that are alive was
    /// set up, 0 if none. Holds beyond their life.
    static int caught();

    /// How long ago it came [s], 0 if none did.
    static double age();

    /// @throws RunError if there was one
    static void throw_if_caught();

    /// Answer the signal that was caught by telling what is at hand: caught()
    /// is 0 until recall(). The same signal again ends the process at once.
    static void put_off();

    static void recall();

    /// Stop as if @p signal had been caught: another rank has.
    static void share(const int signal);

    /// Whether SIGUSR1 came since the last call.
    static bool take_checkpoint_request();

    /// "stopped by a signal (Interrupt)".
    static std::string in_words();

    /// Let the process end by the signal that was caught, as the shell expects;
    /// does nothing if there was none. No guard is alive.
    static void obey();

  private:
    struct sigaction old_interrupt, old_terminate, old_hangup, old_user;
  };

  /// The point of time that many seconds from now.
  std::chrono::steady_clock::time_point deadline_after(const double seconds);

  /// Wall and processor time and memory of this process so far.
  struct ResourceUsage
  {
    double wall_time   = 0.; ///< [s], since some beginning
    double cpu_time    = 0.; ///< [s]
    double peak_memory = 0.; ///< [MB]

    static ResourceUsage now();
  };
} // namespace SlipStep

#endif
