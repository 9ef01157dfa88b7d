// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/commands/outcome.h>
#include <slipstep/commands/sweep.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/process.h>
#include <slipstep/utilities/progress.h>
#include <slipstep/utilities/write_file.h>

#include <boost/algorithm/string/replace.hpp>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <limits>
#include <thread>

namespace SlipStep
{
  namespace fs = std::filesystem;

  namespace
  {
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

      std::vector<std::string> words = job.arguments;
      std::vector<char *>      arguments;
      for (std::string &word : words)
        arguments.push_back(word.data());
      arguments.push_back(nullptr);
      Child child;
      child.job       = number;
      const int error = posix_spawn(&child.pid,
                                    arguments.front(),
                                    &actions,
                                    nullptr,
                                    arguments.data(),
                                    environ);
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

      std::vector<int> run()
      {
        const SignalGuard guard(true);
        while (n_finished < jobs.size() && SignalGuard::caught() == 0)
          {
            start_children();
            if (SignalGuard::take_checkpoint_request())
              for (const Child &child : children)
                kill(child.pid, SIGUSR1);
            listen();
            bury_the_dead();
            show_progress();
          }
        if (SignalGuard::caught() != 0)
          stop_children();
        else
          {
            const auto n_failed =
              exit_code.size() -
              std::count(exit_code.begin(), exit_code.end(), 0);
            progress.finish(n_failed == 0 ?
                              "done in" :
                              std::to_string(n_failed) + " of " +
                                std::to_string(jobs.size()) + " failed, after");
          }
        return exit_code;
      }

    private:
      void start_children()
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
      void listen()
      {
        std::vector<pollfd> descriptors;
        for (const Child &child : children)
          for (const Pipe *pipe : {&child.out, &child.err})
            if (pipe->descriptor >= 0)
              descriptors.push_back({pipe->descriptor, POLLIN, 0});
        if (poll(descriptors.data(), descriptors.size(), 200) <= 0)
          return;
        for (Child &child : children)
          pass_on(child);
      }

      void pass_on(Child &child)
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

      void bury_the_dead()
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
              if (SignalGuard::caught() != 0)
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

      void show_progress()
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
        // How long those take that have not begun, nobody knows.
        double time_left = 0.;
        bool   is_known  = n_started == jobs.size();
        for (const Child &child : children)
          {
            is_known  = is_known && std::isfinite(child.progress.time_left);
            time_left = std::max(time_left, child.progress.time_left);
          }
        // All work done is announced by finish() only.
        progress.update(std::min(sum / jobs.size(), 0.999),
                        text,
                        is_known ? time_left :
                                   std::numeric_limits<double>::quiet_NaN());
      }

      void stop_children()
      {
        progress.clear();
        for (const Child &child : children)
          kill(child.pid, SIGTERM);
        // They write a checkpoint after the present step, if that is soon.
        const auto start = std::chrono::steady_clock::now();
        for (const Child &child : children)
          while (waitpid(child.pid, nullptr, WNOHANG) == 0)
            {
              if (std::chrono::steady_clock::now() - start >
                  std::chrono::seconds(30))
                kill(child.pid, SIGKILL);
              std::this_thread::sleep_for(std::chrono::milliseconds(10));
            }
      }

      const std::vector<SweepJob> &jobs;
      const unsigned int           n_parallel;
      Progress                     progress;
      std::vector<double>          fraction;
      std::vector<int>             exit_code;
      std::vector<Child>           children;
      std::size_t                  n_started  = 0;
      std::size_t                  n_finished = 0;
    };



    // As one word of a shell, whatever is in it.
    std::string word(const std::string &text)
    {
      return "'" + boost::algorithm::replace_all_copy(text, "'", "'\\''") + "'";
    }



    std::string job_array(const Case        &the_case,
                          const CommandLine &line,
                          const fs::path    &output)
    {
      const std::string program   = word(line.program.string());
      const fs::path    case_file = fs::absolute(line.files.front());
      std::string       call =
        program + " " + line.command + " " + word(case_file.string());
      if (!line.variant.empty())
        call += " --variant " + word(line.variant);
      for (const std::string &sweep : line.sweeps_as_typed)
        call += " --sweep " + word(sweep);
      for (const std::string &setting : line.settings_as_typed)
        call += " --set " + word(setting);
      call += " --output " + word(fs::absolute(output).string());

      std::string text = "#!/bin/bash\n"
                         "#SBATCH --job-name=" +
                         case_file.stem().string() + "\n#SBATCH --array=1-" +
                         std::to_string(the_case.variants.size()) +
                         "\n#SBATCH --ntasks=1\n"
                         "# Submit with sbatch. A job that is repeated goes on "
                         "where it was stopped. When all\n"
                         "# are done, the page of the sweep comes from\n"
                         "#   " +
                         call + " --resume\nset -eu\nvariants=(\n";
      for (const Variant &variant : the_case.variants)
        text += "  " + word(variant.folder) + '\n';
      return text +
             ")\nvariant=${variants[$((SLURM_ARRAY_TASK_ID - 1))]}\n"
             "launch=\n"
             "[ \"${SLURM_NTASKS:-1}\" -gt 1 ] && launch=srun\n"
             "exec $launch " +
             call + " --member \"$variant\" --quiet --resume\n";
    }
  } // namespace



  SweepJob child_job(const CommandLine           &line,
                     const std::string           &command,
                     const std::string           &label,
                     const std::filesystem::path &output,
                     const std::string           &member)
  {
    SweepJob job;
    job.label     = label;
    job.arguments = {line.program.string(),
                     command,
                     line.files.front().string(),
                     "--child",
                     "--output=" + output.string()};
    if (!member.empty())
      job.arguments.push_back("--member=" + member);
    if (line.quiet)
      job.arguments.push_back("--quiet");
    if (line.resume)
      job.arguments.push_back("--resume");
    return job;
  }



  std::vector<int> run_side_by_side(const std::vector<SweepJob> &jobs,
                                    const std::string           &label,
                                    const bool                   quiet,
                                    const unsigned int           n_parallel,
                                    const bool                   is_resumable)
  {
    // The children inherit it: the cores are shared out among them.
    for (const char *variable : {"DEAL_II_NUM_THREADS", "OMP_NUM_THREADS"})
      setenv(variable, "1", 1);
    std::vector<int> exit_codes =
      Crew(jobs,
           label,
           quiet,
           n_parallel > 0 ? n_parallel :
                            std::max(1u, std::thread::hardware_concurrency()))
        .run();
    // The shell is to see the signal, not an exit code.
    if (is_resumable && SignalGuard::caught() != 0)
      {
        std::cerr << SignalGuard::in_words()
                  << "; what was computed so far is kept, and the "
                     "same command with --resume goes on"
                  << std::endl;
        SignalGuard::obey();
      }
    return exit_codes;
  }



  int write_job_array(const Case        &the_case,
                      const CommandLine &line,
                      const fs::path    &output)
  {
    if (!the_case.is_sweep())
      throw InputError("--slurm: the case is no sweep, one job computes it; "
                       "--sweep \"Section/Key=A|B|C\" makes it one");
    if (fs::exists(line.slurm))
      throw InputError("--slurm " + line.slurm +
                       ": this file is there already, and is kept");
    write_file(line.slurm, job_array(the_case, line, output));
    if (!line.quiet)
      std::cout << "sbatch "
                << (line.slurm.find_first_of(" '\"\\$&;|<>*?()#~`!") ==
                        std::string::npos ?
                      line.slurm :
                      word(line.slurm))
                << "   # " << the_case.variants.size() << " jobs" << std::endl;
    return done;
  }
} // namespace SlipStep
