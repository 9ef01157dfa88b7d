// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/commands/commands.h>

#include <slipstep/measured_data/import_map.h>
#include <slipstep/measured_data/test_set.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/sweep.h>
#include <slipstep/utilities/home_folder.h>
#include <slipstep/utilities/text.h>

#include <fstream>
#include <iostream>
#include <sstream>

namespace SlipStep
{
  namespace
  {
    namespace fs = std::filesystem;

    /// A test to be converted: the map as it is for this test, and the name of
    /// its file without extension, "" = that of the raw file.
    struct Job
    {
      Parameters  map;
      std::string stem;
    };



    std::vector<Job> read_jobs(const fs::path &file, const CommandLine &line)
    {
      Parameters as_written;
      declare_import_parameters(as_written);
      as_written.read(file);
      const auto with_settings = [&](Parameters map) {
        for (const auto &setting : line.settings)
          map.set(setting.first, setting.second, "--set");
        return map;
      };

      std::vector<Variant> variants = as_written.variants();
      if (!line.variant.empty())
        variants = {find_variant(variants, line.variant, file)};
      std::vector<Job> jobs;
      for (const Variant &variant : variants)
        jobs.push_back(
          {with_settings(as_written.with_variant(variant)), variant.folder});
      if (jobs.empty())
        jobs.push_back({with_settings(as_written), ""});
      return jobs;
    }



    fs::path raw_file_of(const Job &job, const CommandLine &line)
    {
      const std::string name = job.map.text("Raw file/Name");
      const bool        is_told =
        line.files.size() > 1 && !fs::is_directory(line.files[1]);
      if (!is_told && name.empty())
        throw InputError(line.files.front().string() +
                         ": the raw file is missing: set Raw file/Name, or "
                         "name it behind the map");
      const fs::path file = is_told ? line.files[1] :
                            line.files.size() > 1 ?
                                      line.files[1] / with_home(name) :
                                      job.map.resolve(name);
      if (!fs::is_regular_file(file))
        throw InputError((is_told ? std::string("slipstep import") :
                                    job.map.origin("Raw file/Name")) +
                         ": there is no file " + file.string() +
                         (is_told ? "" :
                                    "; name the folder of the raw files behind "
                                    "the map"));
      return file;
    }



    void create_folder(const fs::path &folder)
    {
      std::error_code error;
      fs::create_directories(folder, error);
      if (error || !fs::is_directory(folder))
        throw InputError(folder.string() + ": this folder cannot be created");
    }
  } // namespace



  bool is_import_map(const fs::path &file)
  {
    std::ifstream stream(file);
    std::string   text;
    while (std::getline(stream, text))
      {
        std::istringstream words(text);
        std::string        first, second;
        words >> first >> second;
        if ((first == "subsection" &&
             (second == "Raw" || second == "Columns")) ||
            (first == "set" && second.rfind("Columns/", 0) == 0))
          return true;
      }
    return false;
  }



  void check_import_map(const fs::path &file, const CommandLine &line)
  {
    const std::size_t n_tests = read_jobs(file, line).size();
    if (!line.quiet)
      std::cout << file.string() << ": OK, a map for slipstep import, "
                << counted(n_tests, "test") << std::endl;
  }



  int import_tests(const CommandLine &line)
  {
    const std::vector<Job> jobs = read_jobs(line.files.front(), line);
    if (jobs.size() > 1 && line.files.size() > 1 &&
        !fs::is_directory(line.files[1]))
      throw InputError(line.files[1].string() +
                       ": the map has variants, which need a folder of raw "
                       "files (or choose one with --variant)");
    const fs::path folder = line.output.empty() ?
                              line.files.front().parent_path() / "measured" :
                              fs::path(line.output);

    std::vector<MeasuredTest> tests;
    for (const Job &job : jobs)
      {
        const fs::path raw = raw_file_of(job, line);
        tests.push_back(import_test(job.map, raw));
        tests.back().file =
          folder /
          ((job.stem.empty() ? raw.stem().string() : job.stem) + ".csv");
      }
    check_conditions(tests);

    create_folder(folder);
    constexpr unsigned int n_digits = 7;
    for (const MeasuredTest &test : tests)
      {
        write_measured_test(test.file, test, n_digits);
        print_warnings(test.warnings);
        if (!line.quiet)
          std::cout << test.file.string() << ": " << describe(test)
                    << std::endl;
      }
    return 0;
  }
} // namespace SlipStep
