// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/commands/run_checkpoints.h>

#include <slipstep/experiment/archive_file.h>
#include <slipstep/solid/attempt_together.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/process.h>
#include <slipstep/utilities/version.h>

#include <deal.II/base/mpi.h>

#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <algorithm>
#include <sstream>

namespace SlipStep
{
  using namespace dealii;

  namespace
  {
    std::string step_in_words(const unsigned int step, const double time)
    {
      std::ostringstream text;
      text << "step " << step << " (t = " << time << " s)";
      return text.str();
    }
  } // namespace



  RunCheckpoints::RunCheckpoints(const Parameters            &parameters,
                                 const std::filesystem::path &output,
                                 const bool                   resume,
                                 const MPI_Comm              &communicator)
    : parameters(parameters)
    , communicator(communicator)
    , is_first_rank(Utilities::MPI::this_mpi_process(communicator) == 0)
    , is_wanted(resume)
    , period(checkpoint_period(parameters))
    , store(output)
    , last_time(Clock::now())
  {
    if (!resume)
      return;
    // The first rank chooses; the others read what it chose.
    std::string folder, reason;
    if (is_first_rank)
      try
        {
          manifest = store.find(parameters, warnings);
          if (manifest)
            folder = manifest->folder.string();
        }
      catch (const InputError &error)
        {
          reason = error.what();
        }
    reason = agreed(reason, communicator);
    if (!reason.empty())
      throw InputError(reason);
    folder = Utilities::MPI::broadcast(communicator, folder);
    if (!folder.empty() && !is_first_rank)
      manifest = read_manifest(folder);
    if (manifest)
      last_step = manifest->step;
  }



  template <int dim>
  void RunCheckpoints::resume(Block<dim>       &block,
                              BlockOutput<dim> &fields,
                              RunRecorder      &recorder)
  {
    for (const std::string &warning : warnings)
      recorder.warn(warning);
    if (!manifest)
      {
        if (is_wanted)
          recorder.announce("There is no checkpoint: the run starts anew.");
        return;
      }
    const bool is_same = block.load(manifest->folder, manifest->ranks);
    read_archive(manifest->folder / "fields", fields);

    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    std::string        text =
      "Resumed after " + step_in_words(manifest->step, manifest->time);
    if (n_ranks != manifest->ranks)
      text += " on " + std::to_string(n_ranks) + " instead of " +
              std::to_string(manifest->ranks) +
              " ranks: results agree to round-off, not bit for bit";
    recorder.announce(text + ".");
    if (n_ranks == manifest->ranks && !is_same)
      recorder.warn("cells are distributed otherwise than before: results "
                    "agree to round-off, not bit for bit");
    if (manifest->git_hash != git_hash())
      recorder.warn(
        "the checkpoint was written by another build of slipstep (" +
        manifest->git_hash + ", this is " + git_hash() +
        "): results may not be the same bit for bit");
  }



  template <int dim>
  void RunCheckpoints::write_if_due(const Block<dim>       &block,
                                    const BlockOutput<dim> &fields,
                                    RunRecorder            &recorder)
  {
    // A signal may have hit one rank only, and clocks differ.
    const std::chrono::duration<double> elapsed = Clock::now() - last_time;
    std::array<int, 3>                  wishes  = {
                        {SignalGuard::caught(),
       SignalGuard::take_checkpoint_request() ? 1 : 0,
       is_first_rank && elapsed.count() >= period ? 1 : 0}};
    Utilities::MPI::max(ArrayView<const int>(wishes.data(), wishes.size()),
                        communicator,
                        ArrayView<int>(wishes.data(), wishes.size()));
    if (*std::max_element(wishes.begin(), wishes.end()) == 0)
      return;

    const int          signal = wishes[0];
    const unsigned int step   = block.state().control.n_accepted();
    if (step == 0)
      {
        if (signal == 0)
          return;
        SignalGuard::share(signal);
        throw RunError(SignalGuard::in_words() + " before the first step");
      }
    const std::string failure = write(block, fields, recorder);
    const std::string present =
      step_in_words(step, block.state().control.time());
    const std::string last =
      last_step > 0 ? "the last one is of step " + std::to_string(last_step) :
                      "there is none before";
    if (signal != 0)
      {
        SignalGuard::share(signal);
        throw RunError(SignalGuard::in_words() + " after " + present + "; " +
                       (failure.empty() ? "" :
                                          "no checkpoint could be written (" +
                                            failure + "), " + last + "; ") +
                       "the same command with --resume goes on");
      }
    // Once is enough until it works again.
    if (!failure.empty() && !has_failed)
      recorder.warn("no checkpoint could be written at step " +
                    std::to_string(step) + " (" + failure + "), " + last);
    else if (failure.empty() && wishes[1] != 0)
      recorder.announce("Checkpoint written after " + present + ".");
    has_failed = !failure.empty();
  }



  // A step that is given up and made again by --resume does not end with the
  // same digits, so steps that take no time are waited for.
  bool RunCheckpoints::cannot_wait() const
  {
    constexpr double patience = 1.; // [s]
    return Utilities::MPI::max(SignalGuard::age() > patience ? 1 : 0,
                               communicator) == 1;
  }



  // All ranks write their files, then the first one makes the checkpoint valid.
  template <int dim>
  std::string RunCheckpoints::write(const Block<dim>       &block,
                                    const BlockOutput<dim> &fields,
                                    const RunRecorder      &recorder)
  {
    const auto on_first_rank = [&](const auto &work) {
      return attempt_together(communicator, [&]() {
        if (is_first_rank)
          work();
      });
    };

    std::filesystem::path folder;
    std::string reason = on_first_rank([&]() { folder = store.begin(); });
    if (reason.empty())
      {
        folder = Utilities::MPI::broadcast(communicator, folder.string());
        std::vector<SealedFile> files;
        reason = attempt_together(communicator, [&]() {
          for (const std::string &name : block.save(folder))
            files.push_back(seal_file(folder / name));
          if (is_first_rank)
            {
              write_archive(folder / "fields", fields);
              files.push_back(seal_file(folder / "fields"));
            }
        });
        const auto files_of_rank =
          Utilities::MPI::gather(communicator, files, 0);
        const ResourceUsage usage = ResourceUsage::now();
        const double        cpu_time =
          Utilities::MPI::sum(usage.cpu_time, communicator);
        const double peak_memory =
          Utilities::MPI::sum(usage.peak_memory, communicator);
        Summary sizes;
        block.fill(sizes);
        if (reason.empty())
          reason = on_first_rank([&]() {
            CheckpointManifest next;
            next.identity = CaseIdentity(parameters);
            next.step     = block.state().control.n_accepted();
            next.time     = block.state().control.time();
            next.ranks    = Utilities::MPI::n_mpi_processes(communicator);
            next.cells    = sizes.cells;
            next.dofs     = sizes.dofs;
            for (const auto &some : files_of_rank)
              next.files.insert(next.files.end(), some.begin(), some.end());
            recorder.fill(next, cpu_time, peak_memory);
            store.publish(next);
          });
      }
    if (reason.empty())
      last_step = block.state().control.n_accepted();
    else if (is_first_rank)
      store.abandon();
    // From now on, so that slow disks do not take all the time.
    last_time = Clock::now();
    return reason;
  }



  void RunCheckpoints::remove()
  {
    if (is_first_rank)
      store.remove();
  }



  template void
  RunCheckpoints::resume(Block<2> &, BlockOutput<2> &, RunRecorder &);
  template void
  RunCheckpoints::resume(Block<3> &, BlockOutput<3> &, RunRecorder &);
  template void RunCheckpoints::write_if_due(const Block<2> &,
                                             const BlockOutput<2> &,
                                             RunRecorder &);
  template void RunCheckpoints::write_if_due(const Block<3> &,
                                             const BlockOutput<3> &,
                                             RunRecorder &);
} // namespace SlipStep
