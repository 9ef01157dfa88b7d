#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include <slipstep/experiment/checkpoint.h>
#include <slipstep/experiment/run_options.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/home_folder.h>

#include <unistd.h>

#include <system_error>

namespace SlipStep
{
  void declare_output_parameters(Parameters &parameters)
  {
    parameters.declare(
      "Output/Directory",
      "output/{case}",
      dealii::Patterns::Anything(),
      "Folder of the results, relative to the working directory; {case} is "
      "the name of the .prm file. The variants of a sweep have a folder each "
      "in it. It is created; an existing one must be empty or hold earlier "
      "results, which are overwritten. The option --output goes before it.");
  }



  std::filesystem::path output_folder(const Parameters &parameters)
  {
    const std::string name =
      dealii::Utilities::replace_in_string(parameters.text("Output/Directory"),
                                           "{case}",
                                           parameters.case_file().stem());
    if (name.find_first_of("{}") != std::string::npos)
      parameters.reject("Output/Directory",
                        "in braces there can only be {case}");
    if (name.empty())
      parameters.reject("Output/Directory", "the name of a folder is needed");
    return with_home(name).lexically_normal();
  }



  namespace
  {
    namespace fs = std::filesystem;

    bool holds_results(const fs::path &folder)
    {
      for (const char *name : {"summary.json",
                               "history.csv",
                               "used_parameters.prm",
                               "calibration.json",
                               "report.html"})
        if (fs::exists(folder / name))
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
    if (existing == wanted && !fs::is_empty(existing, error) &&
        !holds_results(existing))
      throw InputError(place +
                       "it holds files which are no slipstep results; empty it "
                       "or give another one with --output");
  }



  void create_output_folder(const fs::path &folder)
  {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
      throw InputError(folder.string() + ": the folder cannot be created (" +
                       error.message() + "); give another one with --output");
  }



  void remove_earlier_results(const fs::path &folder)
  {
    std::error_code error;
    for (const char *name : {"history.csv",
                             "summary.json",
                             "report.html",
                             "refinement.csv",
                             "lines.csv",
                             "refinement.json"})
      fs::remove(folder / name, error);
    CheckpointStore(folder).remove();
  }
} // namespace SlipStep
