// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_experiment_checkpoint_h
#define slipstep_experiment_checkpoint_h

#include <slipstep/experiment/case_identity.h>

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace SlipStep
{
  /// Declares section "Checkpoint".
  void declare_checkpoint_parameters(Parameters &parameters);

  /// Wall-clock time between two checkpoints [s]; infinite if none is written
  /// at times.
  double checkpoint_period(const Parameters &parameters);

  /// What a file was when it was complete.
  struct SealedFile
  {
    std::string    name;
    std::uintmax_t bytes    = 0;
    std::uint32_t  checksum = 0; ///< CRC-32

    /// For boost::serialization.
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &name &bytes &checksum;
    }
  };

  /// Force a file onto the disk and tell what it is.
  /// @param bytes only the first so many of them
  /// @throws RunError if it cannot be read back or the disk refuses it
  SealedFile seal_file(
    const std::filesystem::path &file,
    const std::uintmax_t bytes = std::numeric_limits<std::uintmax_t>::max());

  /// The content of a checkpoint's manifest.json.
  struct CheckpointManifest
  {
    CaseIdentity       identity;
    unsigned int       step        = 0;  ///< accepted steps so far
    double             time        = 0.; ///< [s]
    unsigned int       ranks       = 1;  ///< that wrote it
    unsigned long long cells       = 0;
    unsigned long long dofs        = 0;
    unsigned int       sessions    = 1;  ///< times the run was started
    double             wall_time   = 0.; ///< of all sessions [s]
    double             cpu_time    = 0.; ///< of all sessions and ranks [s]
    double             peak_memory = 0.; ///< [MB], all ranks
    /// The rows of history.csv up to this step.
    SealedFile              history;
    std::vector<SealedFile> files;
    /// Of the program that wrote it; filled in by CheckpointStore.
    std::string git_hash;
    /// Where the checkpoint is; not part of the file.
    std::filesystem::path folder;
  };

  /// Read the manifest of a checkpoint that CheckpointStore::find() has found.
  CheckpointManifest read_manifest(const std::filesystem::path &folder);

  /// The checkpoints in the output folder of a run: `checkpoint` and the one
  /// before, `checkpoint.previous`. A new one comes into being as
  /// `checkpoint.new` and takes its place by renaming, when all of it is on the
  /// disk; so there is a complete one at every moment.
  ///
  /// Of a run on many ranks, one has the store; the others only write files
  /// into the new folder.
  class CheckpointStore
  {
  public:
    /// @param output folder of the run's results
    explicit CheckpointStore(const std::filesystem::path &output);

    /// The newest checkpoint that is complete and undamaged, none if there has
    /// never been one.
    /// @param[out] warnings a line for every damaged one that was passed over
    /// @throws InputError if it is of another case, program version or format,
    ///   or if all are damaged
    std::optional<CheckpointManifest> find(const Parameters         &parameters,
                                           std::vector<std::string> &warnings);

    /// The same without looking into the data.
    /// @return whether there is any
    bool check(const Parameters &parameters) const;

    /// Make the new folder, empty, and return it.
    /// @throws RunError
    std::filesystem::path begin() const;

    /// Everything but the manifest is written: complete the new checkpoint and
    /// make it the present one.
    /// @throws RunError
    void publish(const CheckpointManifest &manifest);

    /// Forget a checkpoint that was begun.
    void abandon() const noexcept;

    /// Remove all checkpoints.
    void remove() const noexcept;

  private:
    const std::filesystem::path present, previous, next;
    /// Whether the present one is known to be damaged, so that the previous one
    /// is the good one.
    bool present_is_damaged = false;
  };

  /// What a folder holds of a run of the same case.
  enum class EarlierRun
  {
    none,    ///< nothing to go on from
    stopped, ///< a checkpoint
    finished
  };

  /// Find out what `--resume` has to do, without looking into the data.
  /// @param declared all parameters with their defaults
  /// @param command "run" or "point"
  /// @throws InputError if the folder is of another case, command or version
  EarlierRun find_earlier_run(const std::filesystem::path &folder,
                              const Parameters            &parameters,
                              const Parameters            &declared,
                              const std::string           &command);
} // namespace SlipStep

#endif
