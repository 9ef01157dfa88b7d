// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/experiment/checkpoint.h>

#include <slipstep/experiment/summary.h>
#include <slipstep/utilities/process.h>
#include <slipstep/utilities/version.h>
#include <slipstep/utilities/json_file.h>
#include <slipstep/utilities/write_file.h>

#include <boost/crc.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <iostream>

namespace SlipStep
{
  namespace
  {
    namespace fs = std::filesystem;
    using json   = nlohmann::ordered_json;

    // Grows when an older program could not read what this one writes, or the
    // other way round.
    constexpr unsigned int manifest_format = 10;

    const char *const manifest_name = "manifest.json";



    // A checkpoint, or a part of it, is not what it was when it was written.
    class Damage : public std::runtime_error
    {
    public:
      using std::runtime_error::runtime_error;
    };
  } // namespace



  void declare_checkpoint_parameters(Parameters &parameters)
  {
    parameters.declare(
      "Checkpoint/Every",
      "10 min",
      Quantity(Dimension::time, 0., 1e30, false, true),
      "Wall-clock time after which a run of the block writes a checkpoint, from "
      "which --resume goes on. With its unit; 0 s switches it off. Checkpoints "
      "on SIGUSR1 and when a run is stopped are written in any case.");
  }



  double checkpoint_period(const Parameters &parameters)
  {
    const double period = parameters.number("Checkpoint/Every");
    return period > 0. ? period : std::numeric_limits<double>::infinity();
  }



  // ------------------------------------------------------------------ files

  namespace
  {
    // @return false if the file is shorter or cannot be read
    bool compute_checksum(const fs::path      &file,
                          const std::uintmax_t bytes,
                          std::uint32_t       &checksum)
    {
      std::ifstream      in(file, std::ios::binary);
      std::vector<char>  buffer(1 << 16);
      boost::crc_32_type crc;
      for (std::uintmax_t left = bytes; left > 0;)
        {
          in.read(buffer.data(), std::min<std::uintmax_t>(left, buffer.size()));
          if (in.gcount() == 0)
            return false;
          crc.process_bytes(buffer.data(), in.gcount());
          left -= in.gcount();
        }
      checksum = crc.checksum();
      return in.is_open();
    }



    void verify(const fs::path &file, const SealedFile &sealed)
    {
      std::error_code error;
      const auto      size     = fs::file_size(file, error);
      std::uint32_t   checksum = 0;
      if (error)
        throw Damage(file.string() + " is missing");
      if (size < sealed.bytes)
        throw Damage(file.string() + " has " + std::to_string(size) + " of " +
                     std::to_string(sealed.bytes) + " bytes");
      if (!compute_checksum(file, sealed.bytes, checksum) ||
          checksum != sealed.checksum)
        throw Damage(file.string() + " has changed");
    }
  } // namespace



  SealedFile seal_file(const fs::path &file, const std::uintmax_t bytes)
  {
    synchronise(file);
    SealedFile      sealed{file.filename().string(), 0, 0};
    std::error_code error;
    sealed.bytes = std::min(fs::file_size(file, error), bytes);
    if (error || !compute_checksum(file, sealed.bytes, sealed.checksum))
      throw RunError(file.string() + ": cannot be read back");
    return sealed;
  }



  // --------------------------------------------------------------- manifest

  namespace
  {
    std::uint32_t checksum_of(const json &object)
    {
      const std::string text =
        object.dump(-1, ' ', false, json::error_handler_t::replace);
      boost::crc_32_type crc;
      crc.process_bytes(text.data(), text.size());
      return crc.checksum();
    }



    /// @param parameters the values of the identity by their paths
    void list_manifest(JsonMembers         members,
                       CheckpointManifest &manifest,
                       json               &parameters)
    {
      const auto list_file = [](JsonMembers members, SealedFile &file) {
        members("name", file.name);
        members("bytes", file.bytes);
        members("crc32", file.checksum);
      };
      members("git_hash", manifest.git_hash);
      members("step", manifest.step);
      members("time_s", manifest.time);
      members("ranks", manifest.ranks);
      members("cells", manifest.cells);
      members("dofs", manifest.dofs);
      members("sessions", manifest.sessions);
      members("wall_s", manifest.wall_time);
      members("cpu_s", manifest.cpu_time);
      members("peak_memory_MB", manifest.peak_memory);
      members("programme_crc32", manifest.identity.programme);
      members("parameters", parameters);
      members.group("history", [&](JsonMembers members) {
        list_file(members, manifest.history);
      });
      members.array("files", manifest.files, list_file);
    }



    json to_json(CheckpointManifest manifest)
    {
      json parameters = json::object();
      for (const auto &value : manifest.identity.values)
        parameters[value.first] = value.second;
      manifest.git_hash = git_hash();
      json object       = {{"format", manifest_format}, {"version", version()}};
      list_manifest(JsonMembers(object, false), manifest, parameters);
      object["manifest_crc32"] = checksum_of(object);
      return object;
    }



    CheckpointManifest manifest_from_json(json object)
    {
      CheckpointManifest manifest;
      json               parameters;
      list_manifest(JsonMembers(object, true), manifest, parameters);
      for (const auto &value : parameters.items())
        manifest.identity.values.emplace_back(value.key(),
                                              value.value().get<std::string>());
      return manifest;
    }



    // Who wrote it is asked before anything else: another program may have
    // arranged the rest otherwise.
    void require_same_program(const json &object, const std::string &owner)
    {
      const std::string remedy = "; run without --resume to start anew";
      const auto        format = object.at("format").get<unsigned int>();
      const auto        writer = object.at("version").get<std::string>();
      if (format != manifest_format)
        throw InputError(owner + " has format " + std::to_string(format) +
                         " (written by slipstep " + writer +
                         "), this program reads format " +
                         std::to_string(manifest_format) + remedy);
      if (writer != version())
        throw InputError(owner + " was written by slipstep " + writer +
                         ", this is slipstep " + version() + remedy);
    }
  } // namespace



  CheckpointManifest read_manifest(const fs::path &folder)
  {
    const fs::path file = folder / manifest_name;
    std::ifstream  in(file);
    if (!in)
      throw Damage(file.string() + " is missing");
    try
      {
        json object = json::parse(in);
        require_same_program(object, "the checkpoint " + folder.string());
        const auto checksum = object.at("manifest_crc32").get<std::uint32_t>();
        object.erase("manifest_crc32");
        if (checksum_of(object) != checksum)
          throw Damage(file.string() + " has changed");
        CheckpointManifest manifest = manifest_from_json(object);
        manifest.folder             = folder;
        return manifest;
      }
    catch (const json::exception &)
      {
        throw Damage(file.string() + " is incomplete");
      }
  }



  // ------------------------------------------------------------------ store

  CheckpointStore::CheckpointStore(const fs::path &output)
    : present(output / "checkpoint")
    , previous(output / "checkpoint.previous")
    , next(output / "checkpoint.new")
  {}



  std::optional<CheckpointManifest>
  CheckpointStore::find(const Parameters         &parameters,
                        std::vector<std::string> &warnings)
  {
    std::string damages;
    for (const fs::path &folder : {present, previous})
      if (fs::exists(folder))
        try
          {
            const CheckpointManifest manifest = read_manifest(folder);
            manifest.identity.require_same(parameters,
                                           "the checkpoint " + folder.string());
            verify(folder.parent_path() / manifest.history.name,
                   manifest.history);
            for (const SealedFile &file : manifest.files)
              verify(folder / file.name, file);
            if (!damages.empty())
              warnings.push_back(damages + ": going on from " +
                                 folder.string() + ", step " +
                                 std::to_string(manifest.step));
            return manifest;
          }
        catch (const Damage &damage)
          {
            damages +=
              (damages.empty() ? "" : ", ") + std::string(damage.what());
            if (folder == present)
              present_is_damaged = true;
          }
    if (!damages.empty())
      throw InputError("--resume: no checkpoint can be used: " + damages +
                       "; run without --resume to start anew");
    return {};
  }



  bool CheckpointStore::check(const Parameters &parameters) const
  {
    bool exists = false;
    for (const fs::path &folder : {present, previous})
      if (fs::exists(folder))
        try
          {
            exists = true;
            read_manifest(folder).identity.require_same(parameters,
                                                        "the checkpoint " +
                                                          folder.string());
            return true;
          }
        catch (const Damage &)
          {}
    return exists;
  }



  fs::path CheckpointStore::begin() const
  {
    std::error_code error;
    fs::remove_all(next, error);
    if (!fs::create_directory(next, error))
      throw write_failure(next, error.value());
    return next;
  }



  // Killed at any point, this leaves a complete checkpoint as `checkpoint` or
  // `checkpoint.previous`.
  void CheckpointStore::publish(const CheckpointManifest &manifest)
  {
    write_json(next / manifest_name, to_json(manifest));
    synchronise(next);
    std::error_code error;
    if (present_is_damaged)
      fs::remove_all(present, error);
    else if (fs::exists(present))
      {
        fs::remove_all(previous, error);
        fs::rename(present, previous, error);
        if (error)
          throw write_failure(previous, error.value());
      }
    fs::rename(next, present, error);
    if (error)
      throw write_failure(present, error.value());
    present_is_damaged = false;
    synchronise(present.parent_path());
  }



  void CheckpointStore::abandon() const noexcept
  {
    std::error_code error;
    fs::remove_all(next, error);
  }



  void CheckpointStore::remove() const noexcept
  {
    std::error_code error;
    for (const fs::path &folder : {present, previous, next})
      fs::remove_all(folder, error);
  }



  // ----------------------------------------------------------------- resume

  namespace
  {
    // A checkpoint may be whole where the summary is not.
    std::optional<Summary> find_summary(const fs::path &folder)
    {
      const fs::path file = folder / "summary.json";
      if (!fs::exists(file))
        return {};
      try
        {
          return read_summary(file);
        }
      catch (const InputError &error)
        {
          if (launched_rank() == 0)
            std::cerr << "warning: " << error.what() << std::endl;
          return {};
        }
    }



    // What fields and lines there are is no part of the history.
    // @param programme of what was done, 0 if that is not known
    void require_finished_case(const fs::path     &folder,
                               const Parameters   &parameters,
                               Parameters          used,
                               const std::string  &command,
                               const std::uint32_t programme)
    {
      const std::string owner = "the finished run in " + folder.string();
      try
        {
          used.read(folder / "used_parameters.prm");
        }
      catch (const InputError &error)
        {
          throw InputError(std::string(error.what()) +
                           ": it cannot be determined whether " + owner +
                           " belongs to this case" + anew_or_elsewhere);
        }
      // Left out is what the run had no use for.
      for (const std::string &path : used.paths())
        if (!used.is_set(path))
          used.set(path, parameters.text(path), "");
      CaseIdentity identity(used, command);
      if (command == "run")
        for (const char *path : {"Output/Fields", "Output/Lines"})
          identity.values.emplace_back(path, used.text(path));
      identity.require_same(parameters, owner);
      // The words are the same, what stands in the tests may not be.
      if (programme != 0 && programme != identity.programme)
        reject_changed_test(parameters, owner);
    }
  } // namespace



  EarlierRun find_earlier_run(const fs::path    &folder,
                              const Parameters  &parameters,
                              const Parameters  &declared,
                              const std::string &command)
  {
    const std::optional<Summary> summary = find_summary(folder);
    if (summary && summary->command != command)
      throw InputError("--resume: " + folder.string() +
                       " holds results of slipstep " + summary->command +
                       ", not of slipstep " + command +
                       "; give another folder with --output");
    // Without its history a run is made once more.
    if (summary && summary->status == "finished" &&
        fs::exists(folder / "history.csv"))
      {
        require_finished_case(
          folder, parameters, declared, command, summary->programme);
        return EarlierRun::finished;
      }
    return CheckpointStore(folder).check(parameters) ? EarlierRun::stopped :
                                                       EarlierRun::none;
  }
} // namespace SlipStep
