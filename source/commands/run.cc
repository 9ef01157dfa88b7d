// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/mpi.h>

#include <slipstep/commands/commands.h>
#include <slipstep/experiment/checkpoint.h>
#include <slipstep/experiment/point_driver.h>
#include <slipstep/report/run_report.h>
#include <slipstep/commands/results_folder.h>
#include <slipstep/experiment/run_recorder.h>
#include <slipstep/commands/sweep.h>
#include <slipstep/solid/attempt_together.h>
#include <slipstep/solid/block_parameters.h>
#include <slipstep/commands/case.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/process.h>
#include <slipstep/utilities/text.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <memory>

namespace SlipStep
{
  namespace fs = std::filesystem;

  namespace
  {
    // The signal that any rank has caught.
    int agreed_signal()
    {
      return dealii::Utilities::MPI::job_supports_mpi() ?
               dealii::Utilities::MPI::max(SignalGuard::caught(),
                                           MPI_COMM_WORLD) :
               SignalGuard::caught();
    }



    // A block that the programme presses by another multiple, or not at all, is
    // no block that the point stands for.
    void print_warnings_of_point(const Case &the_case)
    {
      for (const Parameters &parameters : the_case.complete)
        {
          const BlockParameters block(parameters, parse_programme(parameters));
          double                multiple = 0.;
          for (const FaceConditions &face : block.faces)
            multiple += block.outward_sign() *
                        face.tractions[programme_pressure][block.normal_axis()];
          if (std::abs(multiple - 1.) < 1e-12)
            continue;
          print_warnings({"the faces of the block take " +
                          rounded_text(multiple, 6) +
                          " x the pressure of the programme; the contact point "
                          "takes that pressure itself"});
          return;
        }
    }



    // A key without a say in the results, or one value written in two ways: the
    // table of the sweep would look as if it made no difference.
    void print_warning_of_twins(const Case        &the_case,
                                const std::string &command)
    {
      constexpr std::size_t     most = 100; // as all are compared with all
      const std::size_t         n    = std::min(most, the_case.complete.size());
      std::vector<CaseIdentity> identities;
      for (std::size_t j = 0; j < n; ++j)
        {
          const CaseIdentity identity(the_case.complete[j], command);
          for (std::size_t i = 0; i < j; ++i)
            if (identity.is_same(identities[i], the_case.parameters))
              return print_warnings(
                {"'" + the_case.variants[i].label + "' and '" +
                 the_case.variants[j].label +
                 "' of the sweep are the same case as far as the results of "
                 "slipstep " +
                 command + " go"});
          identities.push_back(identity);
        }
    }



    class Runner
    {
    public:
      // Whatever can be wrong is found here, before anything is written.
      explicit Runner(const CommandLine &line)
        : line(line)
        , is_first_rank(launched_rank() == 0)
        , the_case(read_case(line.files.front(), line))
      {
        check_all(the_case);
        if (line.command == "run")
          for (const Parameters &parameters : the_case.complete)
            check_block(parameters, n_launched());
        output = chosen_output(the_case, line);
        if (!line.is_child)
          check_output(the_case, line);
        if (is_first_rank && !line.is_child)
          tell_warnings();
        earlier.assign(the_case.complete.size(), EarlierRun::none);
        if (line.resume)
          look_for_earlier_runs();
      }

      Outcome run()
      {
        if (!line.slurm.empty())
          return guarded(
            [this]() { return write_job_array(the_case, line, output); });
        if (the_case.variants.size() > 1 && !is_under_mpirun())
          return guarded([this]() { return run_children(); });
        const auto work = [this]() { return run_in_process(); };
        if (line.command == "run")
          return guarded_with_mpi(work);
        return guarded(work);
      }

    private:
      void tell_warnings() const
      {
        print_warnings(warnings_of_equal_variants(the_case));
        print_warning_of_other_runs();
        print_warnings(warnings_of_programmes(the_case));
        if (line.command == "run")
          print_warnings(warnings_of_followed_areas(the_case));
        else
          {
            print_warnings_of_point(the_case);
            print_warnings(warnings_of_face(the_case));
          }
        if (the_case.is_sweep())
          print_warning_of_twins(the_case, line.command);
      }

      void print_warning_of_other_runs() const
      {
        std::vector<std::string> members;
        for (const Variant &variant : the_case.variants)
          members.push_back(variant.folder);
        const auto others = other_runs_in(output, line.command, members);
        if (!others.empty())
          print_warnings({output.string() + " has " +
                          counted(others.size(), "run") +
                          " of another sweep, which this one leaves there (" +
                          others.front() + (others.size() > 1 ? ", ..." : "") +
                          "); --output keeps them apart"});
      }

      // One rank does it for all.
      std::unique_ptr<ResultsFolder> claim(const fs::path &folder) const
      {
        std::unique_ptr<ResultsFolder> results;
        std::string                    refusal;
        if (is_first_rank)
          try
            {
              // The last child may still be writing its checkpoint.
              const std::chrono::seconds patience(line.is_child ? 60 : 2);
              results = std::make_unique<ResultsFolder>(folder,
                                                        line.command,
                                                        line.files.at(0),
                                                        patience);
            }
          catch (const InputError &error)
            {
              refusal = error.what();
            }
        if (dealii::Utilities::MPI::job_supports_mpi())
          refusal = SlipStep::agreed(refusal, MPI_COMM_WORLD);
        if (!refusal.empty())
          throw InputError(refusal);
        return results;
      }

      int run_in_process()
      {
        const auto results = claim(output);
        if (the_case.is_sweep() && is_first_rank && !line.is_child)
          write_case_parameters();
        Outcome           worst;
        const SignalGuard guard;
        for (unsigned int i = 0; i < the_case.complete.size(); ++i)
          {
            // The ranks must stop together.
            if (const int signal = agreed_signal())
              {
                SignalGuard::share(signal);
                break;
              }
            Outcome outcome = guarded([&]() {
              run_one(i);
              return done;
            });
            if (the_case.complete.size() > 1)
              {
                // The ranks must go on to the next variant together.
                outcome = agreed(outcome);
                if (!outcome.message.empty())
                  std::cerr << the_case.variants[i].label << ": "
                            << outcome.message << std::endl;
                outcome.message.clear();
              }
            if (outcome.exit_code > worst.exit_code)
              worst = outcome;
          }
        // A case that is refused leaves everything as it is.
        const bool is_refused =
          worst.exit_code == input_wrong && !the_case.is_sweep();
        if (is_first_rank && !line.is_child && !is_refused &&
            SignalGuard::caught() == 0)
          {
            // After a failure the reason counts, not a report that cannot be.
            const Outcome reported = guarded([this]() {
              report();
              return done;
            });
            if (worst.exit_code == done)
              worst = reported;
          }
        // Passed on as an exception, because its message is still to be
        // printed.
        if (!worst.message.empty() && worst.exit_code == input_wrong)
          throw InputError(worst.message);
        if (!worst.message.empty())
          throw RunError(worst.message);
        return worst.exit_code;
      }

      int run_children()
      {
        const auto results = claim(output);
        write_case_parameters();
        std::vector<SweepJob> jobs;
        for (unsigned int i = 0; i < the_case.variants.size(); ++i)
          {
            if (!is_to_run(i))
              continue;
            const Variant &variant = the_case.variants[i];
            jobs.push_back(child_job(line,
                                     line.command,
                                     variant.label,
                                     output / variant.folder,
                                     variant.folder));
            if (!line.variant.empty())
              jobs.back().arguments.push_back("--variant=" + line.variant);
            for (const std::string &setting : line.settings_as_typed)
              jobs.back().arguments.push_back("--set=" + setting);
            for (const std::string &sweep : line.sweeps_as_typed)
              jobs.back().arguments.push_back("--sweep=" + sweep);
            if (earlier[i] == EarlierRun::none)
              remove_earlier_results(output / variant.folder);
          }
        const std::vector<int> exit_codes =
          run_side_by_side(jobs,
                           the_case.parameters.case_file().stem().string(),
                           line.quiet);
        report();
        return exit_codes.empty() ?
                 done :
                 *std::max_element(exit_codes.begin(), exit_codes.end());
      }

      void run_one(const unsigned int number)
      {
        if (!is_to_run(number))
          return;
        const RunOptions run_options = options(number);
        const auto       results =
          the_case.is_sweep() ? claim(run_options.output) : nullptr;
        if (is_first_rank && earlier[number] == EarlierRun::none)
          remove_earlier_results(run_options.output);
        const Summary summary =
          line.command == "run" ?
            run_block(the_case.complete[number], run_options) :
            run_point(the_case.complete[number], run_options);
        if (summary.status == "failed")
          throw RunError(summary.reason);
        if (is_first_rank)
          print_warnings(summary.warnings);
      }

      void look_for_earlier_runs()
      {
        const Parameters declared = declared_parameters();
        for (unsigned int i = 0; i < the_case.complete.size(); ++i)
          earlier[i] = find_earlier_run(options(i).output,
                                        the_case.complete[i],
                                        declared,
                                        line.command);
      }

      // A finished run is kept.
      bool is_to_run(const unsigned int number)
      {
        if (earlier[number] != EarlierRun::finished)
          return true;
        const RunOptions run_options = options(number);
        if (!run_options.quiet)
          std::cout << (run_options.label.empty() ? "" :
                                                    run_options.label + ": ")
                    << "Finished earlier: the results are kept." << std::endl;
        return false;
      }

      // The sweep as a whole, re-runnable. Values for an effect that is off
      // would be an error: its section is left out if it is off in all
      // variants, or in one that takes its effects from the case. The same
      // holds for adaptivity.
      void write_case_parameters() const
      {
        // It takes the place of an earlier run of the case alone.
        if (fs::exists(output / "history.csv"))
          remove_earlier_results(output);
        std::map<std::string, unsigned int> n_variants_without;
        for (unsigned int i = 0; i < the_case.complete.size(); ++i)
          {
            const auto &overrides = the_case.variants[i].overrides;
            const auto  has_own   = [&](const std::string &path) {
              return any_of(overrides,
                            [&](const auto &own) { return own.path == path; });
            };
            for (const std::string &section :
                 inactive_sections(the_case.complete[i]))
              n_variants_without[section] +=
                has_own(section.compare(0, 6, "Block/") == 0 ?
                          "Block/Refinement" :
                          "Friction/Effects") ?
                  1 :
                  the_case.complete.size();
          }
        std::set<std::string> unused;
        for (const auto &entry : n_variants_without)
          if (entry.second >= the_case.complete.size())
            unused.insert(entry.first);
        write_used_parameters(the_case.parameters, output, unused);
      }

      // A failed run is reported as far as it came.
      void report()
      {
        std::vector<ReportedRun> runs;
        for (unsigned int i = 0; i < the_case.complete.size(); ++i)
          {
            const RunOptions  run_options = options(i);
            const std::string label =
              run_options.label.empty() ?
                the_case.parameters.case_file().stem().string() :
                run_options.label;
            if (fs::exists(run_options.output / "history.csv") &&
                fs::exists(run_options.output / "summary.json"))
              runs.push_back({label, run_options.output});
          }
        if (runs.empty())
          return;
        print_warnings(write_report(output, the_case.parameters, runs));
        if (!line.quiet)
          std::cout << result_table(the_case.parameters, runs)
                    << "Report: " << (output / "report.html").string()
                    << std::endl;
      }

      RunOptions options(const unsigned int number) const
      {
        RunOptions result;
        result.quiet             = line.quiet || !is_first_rank;
        result.resume            = line.resume;
        result.output            = output;
        result.label             = the_case.selected.label;
        result.inactive_sections = inactive_sections(the_case.complete[number]);
        if (the_case.is_sweep())
          {
            result.label = the_case.variants[number].label;
            result.output /= the_case.variants[number].folder;
          }
        return result;
      }

      const CommandLine line;
      const bool        is_first_rank;
      Case              the_case;
      fs::path          output;
      // With --resume: what there is of every run.
      std::vector<EarlierRun> earlier;
    };
  } // namespace



  Outcome run(const CommandLine &line)
  {
    std::unique_ptr<Runner> runner;
    const Outcome           set_up = guarded([&]() {
      runner = std::make_unique<Runner>(line);
      return done;
    });
    return set_up.exit_code == done ? runner->run() : set_up;
  }
} // namespace SlipStep
