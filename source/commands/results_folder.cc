// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/experiment/checkpoint.h>
#include <slipstep/commands/results_folder.h>
#include <slipstep/utilities/command_line.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/lists.h>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <regex>
#include <system_error>
#include <thread>

namespace SlipStep
{
  namespace
  {
    namespace fs = std::filesystem;

    const char *const marker = ".slipstep";

    bool holds_results(const fs::path &folder)
    {
      // Names that few others use, where the marker got lost on the way.
      for (const char *name : {marker,
                               "summary.json",
                               "calibration.json",
                               "diagnosis.json",
                               "refinement.json"})
        if (fs::exists(folder / name))
          return true;
      return false;
    }

    // Nothing is there but the marker.
    bool is_alone(const fs::path &folder)
    {
      std::error_code              error;
      const fs::directory_iterator entries(folder, error);
      return !error && std::distance(begin(entries), end(entries)) == 1;
    }

    // In the folder of a case, other commands have folders of their own.
    bool holds_other_files(const fs::path &folder)
    {
      if (holds_results(folder))
        return false;
      for (const auto &entry : fs::directory_iterator(folder))
        if (!fs::exists(entry.path() / marker))
          return true;
      return false;
    }
  } // namespace



  void check_output_folder(const fs::path &folder, const std::string &origin)
  {
    const std::string place = origin + " = " + folder.string() + ": ";
    if (folder.empty())
      throw InputError(place + "the name of a folder is needed");

    std::error_code error;
    // The deepest part of the path that exists decides.
    fs::path existing = fs::absolute(folder).lexically_normal();
    if (!existing.has_filename())
      existing = existing.parent_path();
    const fs::path wanted = existing;
    while (!fs::exists(fs::symlink_status(existing, error)) &&
           existing.has_relative_path())
      existing = existing.parent_path();

    if (!fs::is_directory(existing, error))
      throw InputError(place + (existing == wanted ? "it" : existing.string()) +
                       " is not a folder; give another one with --output");
    if (access(existing.c_str(), W_OK | X_OK) != 0)
      throw InputError(place + (existing == wanted ? "it" : existing.string()) +
                       " is read-only; give another one with --output");
    if (existing == wanted && holds_other_files(existing))
      throw InputError(place +
                       "it holds files which are no slipstep results; empty it "
                       "or give another one with --output");
  }



  void remove_earlier_results(const fs::path &folder)
  {
    std::error_code error;
    for (const char *name : {"history.csv",
                             "summary.json",
                             "report.html",
                             "refinement.csv",
                             "lines.csv",
                             "fields.pvd",
                             "contact.pvd",
                             "paraview_state.py",
                             "contact_face.csv",
                             "surface.csv",
                             "refinement.json"})
      fs::remove(folder / name, error);
    // Fields of times that the new run may not have.
    const std::regex numbered(
      R"((fields|contact|surface)_[0-9]+(\.[0-9]+)?\.(vtu|pvtu|csv))");
    for (const auto &entry : fs::directory_iterator(folder, error))
      if (std::regex_match(entry.path().filename().string(), numbered))
        fs::remove(entry.path(), error);
    CheckpointStore(folder).remove();
  }



  std::vector<std::string>
  other_runs_in(const fs::path                 &folder,
                const std::string              &command,
                const std::vector<std::string> &members)
  {
    std::vector<std::string> result;
    std::error_code          error;
    for (const auto &entry : fs::directory_iterator(folder, error))
      {
        std::string   owner;
        std::ifstream text(entry.path() / marker);
        const auto    name = entry.path().filename().string();
        if (text >> owner && owner == command && !holds(members, name) &&
            fs::exists(entry.path() / "summary.json"))
          result.push_back(name);
      }
    sort(result);
    return result;
  }



  ResultsFolder::ResultsFolder(const fs::path            &name,
                               const std::string         &command,
                               const fs::path            &case_file,
                               const std::chrono::seconds patience)
    : folder(name)
  {
    std::error_code error;
    folder = fs::absolute(folder).lexically_normal();
    for (fs::path part = folder; !fs::exists(part, error);
         part          = part.parent_path())
      first_created = part;
    fs::create_directories(folder, error);
    if (error)
      throw InputError(name.string() + ": the folder cannot be created (" +
                       error.message() + "); give another one with --output");
    try
      {
        lock(command,
             case_file.empty() ? "" :
                                 fs::absolute(case_file).lexically_normal(),
             patience);
      }
    catch (const InputError &refusal)
      {
        release();
        throw InputError(name.string() + refusal.what() +
                         "; give another folder with --output");
      }
  }



  // A process that was just told to stop has some moments for it. Where a file
  // system knows no locks, there are none.
  void ResultsFolder::lock(const std::string         &command,
                           const fs::path            &case_file,
                           const std::chrono::seconds patience)
  {
    const fs::path file = folder / marker;
    descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor < 0)
      throw InputError(": no file can be created there (" +
                       std::string(std::strerror(errno)) + ")");
    const auto start = std::chrono::steady_clock::now();
    bool       is_taken;
    while ((is_taken = ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 &&
                       errno == EWOULDBLOCK) &&
           std::chrono::steady_clock::now() - start < patience)
      std::this_thread::sleep_for(std::chrono::milliseconds(50));

    std::string   owner, process, earlier;
    std::ifstream text(file);
    text >> owner >> process >> std::ws;
    std::getline(text, earlier);
    if (is_taken)
      {
        ::close(descriptor);
        descriptor = -1;
        throw InputError(" is in use by slipstep " + owner + ", process " +
                         process + ": wait for its end");
      }
    if (!owner.empty() && owner != command && !is_alone(folder))
      throw InputError(" holds results of slipstep " + owner +
                       ", not of slipstep " + command);
    std::error_code error;
    if (!earlier.empty() && earlier != case_file &&
        fs::exists(earlier, error) && !is_alone(folder))
      print_warnings(
        {folder.string() + " holds results of " + earlier +
         ", which the results of this case replace; --output keeps both"});
    std::ofstream(file) << command << ' ' << getpid() << ' '
                        << case_file.string() << '\n';
  }



  ResultsFolder::~ResultsFolder()
  {
    release();
  }



  void ResultsFolder::release() noexcept
  {
    if (descriptor < 0)
      return;
    std::error_code error;
    // Removed while it is locked, so that nobody has begun here meanwhile.
    if (!first_created.empty() && is_alone(folder))
      {
        fs::remove(folder / marker, error);
        for (fs::path part = folder;; part = part.parent_path())
          if (!fs::remove(part, error) || error || part == first_created)
            break;
      }
    ::close(descriptor);
    descriptor = -1;
  }
} // namespace SlipStep
