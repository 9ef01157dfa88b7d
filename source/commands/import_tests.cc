// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/commands/case.h>
#include <slipstep/commands/commands.h>
#include <slipstep/commands/results_folder.h>

#include <slipstep/measured_data/import_proposal.h>
#include <slipstep/measured_data/import_record.h>
#include <slipstep/measured_data/test_set.h>
#include <slipstep/report/import_report.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/variants.h>
#include <slipstep/utilities/paths.h>
#include <slipstep/utilities/text.h>
#include <slipstep/utilities/write_file.h>

#include <fstream>
#include <iostream>
#include <map>
#include <set>
#include <sstream>

namespace SlipStep
{
  namespace
  {
    namespace fs = std::filesystem;

    /// What one map converts: the map as it is for a variant, and the name of
    /// the test's file without extension, "" = that of the raw file.
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
      std::vector<Variant> variants = as_written.variants();
      if (!line.variant.empty())
        variants = {find_variant(variants, line.variant, file)};
      std::vector<Job> jobs;
      for (const Variant &variant : variants)
        jobs.push_back({as_written.with_variant(variant), variant.folder});
      if (jobs.empty())
        jobs.push_back({as_written, ""});
      for (Job &job : jobs)
        apply_settings(line, job.map);
      return jobs;
    }



    std::vector<RawFile> raw_files_of(const Job &job, const CommandLine &line)
    {
      const std::string name = job.map.text("Raw file/Name");
      const bool        is_told =
        line.files.size() > 1 && !fs::is_directory(line.files[1]);
      if (!is_told && name.empty())
        throw InputError(line.files.front().string() +
                         ": the raw file is missing: set Raw file/Name, or "
                         "name it behind the map");
      const fs::path pattern = line.files.size() > 1 && !is_told ?
                                 line.files[1] / with_home(name) :
                                 job.map.resolve(name);
      if (is_told)
        {
          RawFile file{line.files[1], {}};
          if (!fs::is_regular_file(file.file))
            throw InputError("slipstep import: there is no file " +
                             file.file.string());
          if (has_wildcards(name) &&
              !matches_pattern(file.file.filename().string(),
                               pattern.filename().string(),
                               file.found))
            job.map.reject("Raw file/Name",
                           file.file.filename().string() +
                             " does not match this pattern");
          return {file};
        }
      const std::string hint =
        line.files.size() > 1 ? "; this name is looked for in the folder that "
                                "is named behind the map" :
                                "; name the folder of the raw files behind the "
                                "map";
      if (has_wildcards(name))
        try
          {
            return files_of_pattern(pattern);
          }
        catch (const InputError &error)
          {
            throw InputError(job.map.origin("Raw file/Name") + ": " +
                             error.what() + hint);
          }
      if (!fs::is_regular_file(pattern))
        throw InputError(job.map.origin("Raw file/Name") +
                         ": there is no file " + pattern.string() + hint);
      return {{pattern, {}}};
    }



    // Each to a file of its own.
    void add_tests(std::vector<MeasuredTest>       &tests,
                   std::map<fs::path, std::string> &origins,
                   const std::vector<MeasuredTest> &more,
                   const RawFile                   &raw,
                   const fs::path                  &folder)
    {
      for (MeasuredTest test : more)
        {
          test.file = folder / test.file;
          const auto [it, is_new] =
            origins.emplace(test.file, raw.file.string());
          if (!is_new)
            throw InputError(test.file.string() + " would come from " +
                             it->second + " and from " + raw.file.string() +
                             ": give them other names (Test/File)");
          tests.push_back(test);
        }
    }



    // Rows of a record that was cut another way, or named otherwise, would
    // count twice.
    void warn_of_others(const fs::path                  &folder,
                        const std::vector<MeasuredTest> &tests)
    {
      const std::string     mark = "converted from";
      std::set<std::string> origins, files, others;
      for (const MeasuredTest &test : tests)
        {
          origins.insert(test.notes.at(mark));
          files.insert(test.file.filename().string());
        }
      std::error_code error;
      for (const auto &entry : fs::directory_iterator(folder, error))
        {
          const std::string name = entry.path().filename().string();
          std::ifstream     stream(entry.path());
          std::string       line;
          while (entry.path().extension() == ".csv" && files.count(name) == 0 &&
                 std::getline(stream, line) && line.rfind("#", 0) == 0)
            if (line.rfind("# " + mark + ": ", 0) == 0 &&
                origins.count(line.substr(mark.size() + 4)) > 0)
              others.insert(name);
        }
      if (!others.empty())
        print_warnings(
          {folder.string() + " has " + counted(others.size(), "other test") +
           " of the same records, of an earlier import (" + *others.begin() +
           (others.size() > 1 ? ", ..." : "") +
           "): whatever reads the folder counts the same rows twice; remove "
           "those tests if they are not wanted"});
    }



    void create_folder(const fs::path &folder)
    {
      std::error_code error;
      fs::create_directories(folder, error);
      if (error || !fs::is_directory(folder))
        throw InputError(folder.string() + ": this folder cannot be created");
    }
    // What the map makes of the file, or why it makes nothing of it.
    std::vector<MeasuredTest> tests_of(const ImportProposal &proposal,
                                       std::string          &problem)
    {
      if (!proposal.is_complete())
        return {};
      try
        {
          return import_record(proposal.map(),
                               {proposal.file, {}},
                               proposal.file.stem().string());
        }
      catch (const InputError &error)
        {
          problem = error.what();
          return {};
        }
    }



    // A record without a map: look at it, and write one.
    int propose_map(const CommandLine &line)
    {
      const fs::path file = line.files.front();
      if (fs::is_directory(file))
        throw InputError(file.string() +
                         ": this is a folder; name one record of it to get a "
                         "map, which may then have wildcards");
      if (line.files.size() > 1 || !line.settings.empty() ||
          !line.variant.empty())
        throw InputError("slipstep import: " + file.string() +
                         " is not a map (.prm); a record is named alone, "
                         "without --set and --variant");
      const fs::path map =
        file.parent_path() / (file.stem().string() + "_map.prm");
      if (fs::exists(map))
        throw InputError(map.string() +
                         ": this map is there already; go on with slipstep "
                         "import " +
                         map.string() + ", or remove it");
      const fs::path output = line.output.empty() ?
                                fs::path("output") / file.stem() / "import" :
                                fs::path(line.output);
      check_output_folder(output, "--output");

      const ImportProposal proposal = propose_import(file);
      std::string          problem;
      const auto           tests = tests_of(proposal, problem);
      const ResultsFolder  results(output, line.command, file);
      remove_earlier_results(output);
      write_file(map, proposal.text());
      print_warnings(
        write_import_report(output, proposal, map, tests, problem));
      if (!problem.empty())
        print_warnings({"the map does not convert the record yet: " + problem});
      if (!line.quiet)
        {
          std::cout << import_table(proposal);
          for (const MeasuredTest &test : tests)
            std::cout << describe(test) << '\n';
          std::cout << "Map: " << map.string()
                    << (proposal.is_complete() ? " (look through it)" :
                                                 " (incomplete: see 'open')")
                    << "\nReport: " << (output / "report.html").string()
                    << std::endl;
        }
      return done;
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
        // Of sections and keys that no case has.
        for (const std::string section :
             {"Raw", "Columns", "Convention", "Correction", "Selection"})
          if ((first == "subsection" && second == section) ||
              (first == "set" && second.rfind(section + "/", 0) == 0))
            return true;
        if (first == "set" && second == "Raw")
          return true;
      }
    return false;
  }



  void check_import_map(const fs::path &file, const CommandLine &line)
  {
    const std::vector<Job> jobs = read_jobs(file, line);
    const std::string      name = jobs.front().map.text("Raw file/Name");
    if (!line.quiet)
      std::cout << file.string() << ": OK, a map for slipstep import, "
                << (jobs.size() == 1 && has_wildcards(name) ?
                      "all " + name :
                      counted(jobs.size(), "test"))
                << std::endl;
  }



  int import_tests(const CommandLine &line)
  {
    if (line.files.front().extension() != ".prm")
      return propose_map(line);
    const std::vector<Job> jobs = read_jobs(line.files.front(), line);
    if (jobs.size() > 1 && line.files.size() > 1 &&
        !fs::is_directory(line.files[1]))
      throw InputError(line.files[1].string() +
                       ": the map has variants, which need a folder of raw "
                       "files (or choose one with --variant)");
    const fs::path folder = line.output.empty() ?
                              line.files.front().parent_path() / "measured" :
                              fs::path(line.output);

    std::vector<MeasuredTest>       tests;
    std::map<fs::path, std::string> origins;
    for (const Job &job : jobs)
      {
        const std::vector<RawFile> raw_files = raw_files_of(job, line);
        for (const RawFile &raw : raw_files)
          add_tests(tests,
                    origins,
                    import_record(job.map,
                                  raw,
                                  job.stem.empty() || raw_files.size() > 1 ?
                                    raw.file.stem().string() :
                                    job.stem),
                    raw,
                    folder);
      }
    check_conditions(tests);
    warn_of_oddities(tests);
    warn_of_others(folder, tests);

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
