#include <slipstep/experiment/sweep.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/progress.h>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <memory>
#include <thread>

namespace SlipStep
{
  namespace
  {
    volatile std::sig_atomic_t caught_signal = 0;

    void remember_signal(const int signal)
    {
      caught_signal = signal;
    }



    // While it lives, SIGINT and SIGTERM are remembered, not obeyed.
    class SignalGuard
    {
    public:
      SignalGuard()
      {
        caught_signal = 0;
        struct sigaction action
        {};
        action.sa_handler = remember_signal;
        sigemptyset(&action.sa_mask);
        sigaction(SIGINT, &action, &old_interrupt);
        sigaction(SIGTERM, &action, &old_terminate);
      }

      ~SignalGuard()
      {
        sigaction(SIGINT, &old_interrupt, nullptr);
        sigaction(SIGTERM, &old_terminate, nullptr);
      }

    private:
      struct sigaction old_interrupt, old_terminate;
    };



    // The reading end of a child's stdout or stderr, taken apart into lines.
    struct Pipe
    {
      int         descriptor = -1;
      std::string rest;

      // Append the complete lines that have arrived; close at the end.
      void read_lines(std::vector<std::string> &lines)
      {
        char          buffer[4096];
        const ssize_t n = ::read(descriptor, buffer, sizeof(buffer));
        if (n < 0 && (errno == EINTR || errno == EAGAIN))
          return;
        if (n > 0)
          rest.append(buffer, n);
        for (std::size_t end; (end = rest.find('\n')) != std::string::npos;)
          {
            lines.push_back(rest.substr(0, end));
            rest.erase(0, end + 1);
          }
        if (n <= 0)
          {
            if (!rest.empty())
              lines.push_back(rest);
            ::close(descriptor);
            descriptor = -1;
          }
      }
    };



    struct Child
    {
      std::size_t  job = 0;
      pid_t        pid = 0;
      Pipe         out, err;
      ProgressLine progress;

      bool is_open() const
      {
        return out.descriptor >= 0 || err.descriptor >= 0;
      }
    };



    // This environment, with one thread for each child: the cores are shared
    // out among the children.
    std::vector<std::string> child_environment()
    {
      const std::array<std::string, 2> threads = {
        {"DEAL_II_NUM_THREADS=1", "OMP_NUM_THREADS=1"}};
      std::vector<std::string> environment(threads.begin(), threads.end());
      for (char **variable = environ; *variable != nullptr; ++variable)
        {
          const std::string text = *variable;
          const std::string name = text.substr(0, text.find('=') + 1);
          if (threads[0].compare(0, name.size(), name) != 0 &&
              threads[1].compare(0, name.size(), name) != 0)
            environment.push_back(text);
        }
      return environment;
    }



    std::vector<char *> c_strings(std::vector<std::string> &strings)
    {
      std::vector<char *> pointers;
      for (std::string &string : strings)
        pointers.push_back(string.data());
      pointers.push_back(nullptr);
      return pointers;
    }



    Child start(const SweepJob &job, const std::size_t number)
    {
      int out[2], err[2];
      // Closed on exec, or a child would hold open the pipes of its siblings.
      if (pipe2(out, O_CLOEXEC) != 0 || pipe2(err, O_CLOEXEC) != 0)
        throw RunError(job.label +
                       ": cannot be started: " + std::strerror(errno));
      posix_spawn_file_actions_t actions;
      posix_spawn_file_actions_init(&actions);
      posix_spawn_file_actions_addopen(
        &actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
      posix_spawn_file_actions_adddup2(&actions, out[1], STDOUT_FILENO);
      posix_spawn_file_actions_adddup2(&actions, err[1], STDERR_FILENO);

      std::vector<std::string> arguments   = job.arguments;
      std::vector<std::string> environment = child_environment();
      Child                    child;
      child.job       = number;
      const int error = posix_spawn(&child.pid,
                                    arguments.front().c_str(),
                                    &actions,
                                    nullptr,
                                    c_strings(arguments).data(),
                                    c_strings(environment).data());
      posix_spawn_file_actions_destroy(&actions);
      ::close(out[1]);
      ::close(err[1]);
      child.out.descriptor = out[0];
      child.err.descriptor = err[0];
      if (error != 0)
        {
          ::close(out[0]);
          ::close(err[0]);
          throw RunError(job.label +
                         ": cannot be started: " + std::strerror(error));
        }
      return child;
    }



    // Runs the jobs; one call of run() for the whole life.
    class Crew
    {
    public:
      Crew(const std::vector<SweepJob> &jobs,
           const std::string           &label,
           const bool                   quiet,
           const unsigned int           n_parallel)
        : jobs(jobs)
        , n_parallel(n_parallel)
        , progress(quiet, label)
        , fraction(jobs.size(), 0.)
        , exit_code(jobs.size(), 1)
      {}

      std::vector<int> run();

    private:
      void start_children();

      void listen();

      void pass_on(Child &child);

      void bury_the_dead();

      void show_progress();

      void stop_children();

      const std::vector<SweepJob> &jobs;
      const unsigned int           n_parallel;
      Progress                     progress;
      std::vector<double>          fraction;
      std::vector<int>             exit_code;
      std::vector<Child>           children;
      std::size_t                  n_started  = 0;
      std::size_t                  n_finished = 0;
    };



    std::vector<int> Crew::run()
    {
      const SignalGuard guard;
      while (n_finished < jobs.size() && caught_signal == 0)
        {
          start_children();
          listen();
          bury_the_dead();
          show_progress();
        }
      if (caught_signal != 0)
        stop_children();
      else
        progress.finish();
      return exit_code;
    }



    void Crew::start_children()
    {
      while (children.size() < n_parallel && n_started < jobs.size())
        {
          const std::size_t number = n_started++;
          try
            {
              children.push_back(start(jobs[number], number));
            }
          catch (const RunError &error)
            {
              progress.clear();
              std::cerr << error.what() << std::endl;
              ++n_finished;
            }
        }
    }



    // Wait until a child says something, at most a little while.
    void Crew::listen()
    {
      std::vector<pollfd> descriptors;
      for (const Child &child : children)
        for (const Pipe *pipe : {&child.out, &child.err})
          if (pipe->descriptor >= 0)
            descriptors.push_back({pipe->descriptor, POLLIN, 0});
      if (poll(descriptors.data(), descriptors.size(), 200) <= 0)
        return;
      for (const pollfd &polled : descriptors)
        if (polled.revents != 0)
          for (Child &child : children)
            if (child.out.descriptor == polled.fd ||
                child.err.descriptor == polled.fd)
              {
                pass_on(child);
                break;
              }
    }



    void Crew::pass_on(Child &child)
    {
      const auto is_ready = [](const Pipe &pipe) {
        pollfd polled{pipe.descriptor, POLLIN, 0};
        return pipe.descriptor >= 0 && poll(&polled, 1, 0) > 0;
      };
      const std::string        label = jobs[child.job].label;
      std::vector<std::string> lines;
      if (is_ready(child.out))
        child.out.read_lines(lines);
      for (const std::string &line : lines)
        if (!parse_progress_line(line, child.progress))
          {
            progress.clear();
            std::cout << label << ": " << line << std::endl;
          }
      fraction[child.job] = child.progress.fraction;

      lines.clear();
      if (is_ready(child.err))
        child.err.read_lines(lines);
      for (const std::string &line : lines)
        {
          progress.clear();
          std::cerr << label << ": " << line << std::endl;
        }
    }



    void Crew::bury_the_dead()
    {
      for (auto child = children.begin(); child != children.end();)
        {
          if (child->is_open())
            {
              ++child;
              continue;
            }
          int status = 0;
          while (waitpid(child->pid, &status, 0) < 0 && errno == EINTR)
            if (caught_signal != 0)
              return;
          if (WIFEXITED(status))
            exit_code[child->job] = WEXITSTATUS(status);
          else
            {
              progress.clear();
              std::cerr << jobs[child->job].label << ": stopped by signal "
                        << WTERMSIG(status) << " ("
                        << strsignal(WTERMSIG(status)) << ")" << std::endl;
            }
          fraction[child->job] = 1.;
          ++n_finished;
          child = children.erase(child);
        }
    }



    void Crew::show_progress()
    {
      double sum = 0.;
      for (const double part : fraction)
        sum += part;
      std::string text = std::to_string(n_finished) + " of " +
                         std::to_string(jobs.size()) + " done";
      for (const Child &child : children)
        text += "; " + jobs[child.job].label + " " +
                std::to_string(static_cast<int>(100. * fraction[child.job])) +
                " %";
      // All work done is announced by finish() only.
      progress.update(std::min(sum / jobs.size(), 0.999), text);
    }



    void Crew::stop_children()
    {
      progress.clear();
      for (const Child &child : children)
        kill(child.pid, SIGTERM);
      for (const Child &child : children)
        {
          while (waitpid(child.pid, nullptr, 0) < 0 && errno == EINTR)
            {}
        }
    }
  } // namespace



  bool is_under_mpirun()
  {
    for (const char *name :
         {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK", "SLURM_STEP_ID"})
      if (std::getenv(name) != nullptr)
        return true;
    return false;
  }



  std::vector<int> run_side_by_side(const std::vector<SweepJob> &jobs,
                                    const std::string           &label,
                                    const bool                   quiet,
                                    const unsigned int           n_parallel)
  {
    std::vector<int> exit_codes;
    {
      Crew crew(jobs,
                label,
                quiet,
                n_parallel > 0 ?
                  n_parallel :
                  std::max(1u, std::thread::hardware_concurrency()));
      exit_codes = crew.run();
    }
    // The shell is to see the signal, not an exit code.
    if (caught_signal != 0)
      std::raise(caught_signal);
    return exit_codes;
  }
} // namespace SlipStep
