#include <slipstep/utilities/process.h>

#include <fcntl.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <iostream>

namespace SlipStep
{
  namespace
  {
    volatile std::sig_atomic_t caught_signal = 0;

    void remember_signal(const int signal)
    {
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



  // Whoever has set the variable keeps its value. Other MPI implementations do
  // not know it.
  void start_mpi_without_daemon()
  {
    if (!is_under_mpirun())
      setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
  }



  SignalGuard::SignalGuard(const bool is_patient)
  {
    caught_signal = 0;
    struct sigaction action
    {};
    action.sa_handler = remember_signal;
    if (!is_patient)
      action.sa_flags = SA_RESETHAND;
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, &old_interrupt);
    sigaction(SIGTERM, &action, &old_terminate);
    action.sa_handler = remember_request;
    action.sa_flags   = SA_RESTART;
    sigaction(SIGUSR1, &action, &old_user);
  }



  SignalGuard::~SignalGuard()
  {
    sigaction(SIGINT, &old_interrupt, nullptr);
    sigaction(SIGTERM, &old_terminate, nullptr);
    sigaction(SIGUSR1, &old_user, nullptr);
  }



  int SignalGuard::caught()
  {
    return caught_signal;
  }



  void SignalGuard::share(const int signal)
  {
    caught_signal = signal;
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
} // namespace SlipStep
