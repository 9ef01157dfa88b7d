// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/experiment/run_recorder.h>

#include <slipstep/experiment/stability.h>

#include <slipstep/experiment/point_driver.h>
#include <slipstep/friction/largest_coefficient.h>
#include <slipstep/utilities/process.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/text.h>
#include <slipstep/utilities/write_file.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <sstream>

namespace SlipStep
{
  void write_used_parameters(const Parameters            &parameters,
                             const std::filesystem::path &folder,
                             const std::set<std::string> &omitted_sections)
  {
    std::ostringstream text;
    relocated_case(parameters, folder)
      .print(text, Parameters::Format::prm, omitted_sections);
    write_file(folder / "used_parameters.prm", text.str());
  }



  namespace
  {
    std::string way_to_shorter_steps(const Parameters &parameters)
    {
      const bool by_tolerance = StepControl::idle_keys(parameters).empty();
      const std::string key   = by_tolerance ?
                                  "Time stepping/Tolerance" :
                                  "Time stepping/Equal steps per statement";
      return (by_tolerance ? "a smaller " : "more ") + key + " than " +
             parameters.text(key);
    }



    std::string way_to_longer_steps(const Parameters  &parameters,
                                    const FrictionLaw &law)
    {
      const std::string capped = largest_coefficient().key;
      const EffectInfo *effect =
        find_effect(law.effects(), [&](const EffectInfo &info) {
          return any_of(info.parameters, [&](const EffectParameter &parameter) {
            return parameter.key == capped;
          });
        });
      return "a larger Time stepping/Tolerance than " +
             parameters.text("Time stepping/Tolerance") +
             " passes over quick vibrations" +
             (effect == nullptr ?
                "" :
                "; a Friction/" + effect->name + '/' + capped +
                  " of 1 or 2 lets friction fall less suddenly where the contact "
                  "opens");
    }



    // Vibrations that nothing damps, or a contact that chatters, go on for a
    // programme of any length. "" if it ends in some time.
    std::string pace_in_words(const std::vector<HistoryRow> &history,
                              const double                   end_time)
    {
      constexpr std::size_t n_steps = 2000;
      constexpr double      many = 1e5, many_times = 20.;

      const std::size_t n = history.size();
      if (n % n_steps != 1 || n == 1)
        return "";
      const double now  = history.back().time;
      const double step = (now - history[n - 1 - n_steps].time) / n_steps;
      const double left = (end_time - now) / step;
      if (!(left > std::max(many, many_times * n)))
        return "";
      return "the last " + std::to_string(n_steps) +
             " steps advanced the time of the programme by " +
             rounded_text(step, 2) + " s each; at that pace it takes " +
             rounded_text(left, 2) + " more steps";
    }
  } // namespace



  RunRecorder::RunRecorder(const Parameters         &parameters,
                           const RunOptions         &options,
                           const std::string        &command,
                           const FrictionLaw        &law,
                           const Programme          &programme,
                           const bool                is_writer,
                           const CheckpointManifest *resumed)
    : options(options)
    , programme(programme)
    , is_writer(is_writer)
    , shorter_steps(way_to_shorter_steps(parameters))
    , longer_steps(way_to_longer_steps(parameters, law))
    , has_equal_steps(!StepControl::idle_keys(parameters).empty())
    , quantities(parse_quantities(parameters, programme))
    , start(ResourceUsage::now())
    , progress(options.quiet || !is_writer, options.label)
    , work(programme)
  {
    summary.case_name = parameters.case_file().stem().string();
    summary.programme = checksum_of(programme);
    summary.label     = options.label;
    summary.command   = command;
    summary.effects   = law.effects();
    if (resumed != nullptr)
      {
        summary.sessions    = resumed->sessions + 1;
        earlier.wall_time   = resumed->wall_time;
        earlier.cpu_time    = resumed->cpu_time;
        earlier.peak_memory = resumed->peak_memory;
      }
    if (!is_writer)
      return;
    const Machine machine(parameters);
    instabilities = instability_warnings(law, programme, machine);
    for (const std::string &text : instabilities)
      warn(text);
    std::set<std::string> inactive = law.inactive_sections();
    inactive.insert(options.inactive_sections.begin(),
                    options.inactive_sections.end());
    write_used_parameters(parameters, options.output, inactive);
    if (command == "run")
      for (const QuantityOfInterest &probe : probes_among(quantities))
        summary.probes.push_back(probe.name);
    if (!machine.is_rigid())
      for (const std::string &name : Machine::probe_names())
        summary.probes.push_back(name);
    write_summary(options.output / "summary.json", summary);
    const std::filesystem::path file = options.output / "history.csv";
    if (resumed == nullptr)
      {
        writer = HistoryWriter(file, law.memories(), summary.probes.size());
        return;
      }
    writer  = HistoryWriter(file, resumed->history.bytes, law.memories());
    history = read_history(file);
    for (const HistoryRow &row : history)
      work.share_done(row.time);
    work.resume();
  }



  void RunRecorder::record(const HistoryRow &row)
  {
    if (!is_writer)
      return;
    history.push_back(row);
    writer.write(row);
    const double      moved = 1e3 * row.displacement; // [µm]
    const std::string where =
      std::abs(row.displacement) > 0. && std::abs(row.displacement) < 0.01 ?
        short_text(moved, 3) + " µm" :
        short_text(std::round(moved) / 1e3, 3) + " mm";
    const double share_done = work.share_done(row.time);
    progress.update(share_done,
                    "step " + std::to_string(history.size()) + ", " + where +
                      (note.empty() ? "" : ", ") + note,
                    work.time_left(row.time, progress.time_spent()));

    const std::string pace = has_equal_steps || has_told_pace ?
                               "" :
                               pace_in_words(history, programme.end_time());
    if (pace.empty())
      return;
    announce("note: " + pace + "; " + longer_steps);
    has_told_pace = true;
  }



  void RunRecorder::fill(CheckpointManifest &manifest,
                         const double        cpu_time,
                         const double        peak_memory) const
  {
    manifest.history =
      seal_file(options.output / "history.csv", writer.bytes());
    manifest.sessions = summary.sessions;
    manifest.wall_time =
      earlier.wall_time + ResourceUsage::now().wall_time - start.wall_time;
    manifest.cpu_time    = earlier.cpu_time + cpu_time;
    manifest.peak_memory = std::max(earlier.peak_memory, peak_memory);
  }



  void RunRecorder::announce(const std::string &text)
  {
    if (options.quiet || !is_writer)
      return;
    progress.clear();
    std::cout << text << std::endl;
  }



  void RunRecorder::warn(const std::string &text)
  {
    if (!is_writer)
      return;
    progress.clear();
    // At once: a kill leaves all of it or nothing.
    std::cerr << "warning: " + text + '\n' << std::flush;
    warnings.push_back(text);
  }



  namespace
  {
    // Without mass and friction that rises with speed nothing is in equilibrium
    // from the beginning of a jump to its end: the energy that most of a gap is
    // goes in steps of jumps, however short. "" if it does not.
    std::string jump_in_words(const std::vector<HistoryRow> &history,
                              const bool                     is_block)
    {
      constexpr double most = 0.5, far = 10., felt = 1e-3;

      const auto gap = [](const HistoryRow &row) {
        return row.external_work - row.stored_energy - row.dissipated_energy;
      };
      const auto slip_in = [&](const std::size_t i) {
        return history[i].slip - history[i - 1].slip;
      };
      double      largest = 0., sum = 0.;
      std::size_t jump = 0;
      for (std::size_t i = 1; i < history.size(); ++i)
        {
          const HistoryRow &before = history[i - 1], &after = history[i];
          const double      lost = gap(after) - gap(before);
          if (!(slip_in(i) > felt * history.back().slip &&
                slip_in(i) >
                  far *
                    std::hypot(after.displacement - before.displacement,
                               after.displacement_y - before.displacement_y)))
            continue;
          sum += lost;
          if (lost > largest)
            {
              largest = lost;
              jump    = i;
            }
        }
      if (jump == 0 || !(gap(history.back()) > 0.) ||
          sum < most * gap(history.back()))
        return "";
      return "at t = " + rounded_text(history[jump].time, 6) +
             " s the contact jumps by " + rounded_text(slip_in(jump), 3) +
             " mm in one step, however short: no state on the way is in "
             "equilibrium, and friction just after the jump is inaccurate; a " +
             (is_block ? "Block/Density" : "Loading/Machine mass") +
             ", or friction that rises more with speed (effect viscous or "
             "overstress), turns the jump into a motion";
    }
  } // namespace



  void RunRecorder::finish(const std::string &reason)
  {
    const ResourceUsage end = ResourceUsage::now();
    summary.wall_time = earlier.wall_time + end.wall_time - start.wall_time;
    // A driver on many ranks has filled in their sums.
    if (summary.cpu_time == 0.)
      summary.cpu_time = end.cpu_time - start.cpu_time;
    if (summary.peak_memory == 0.)
      summary.peak_memory = end.peak_memory;
    summary.cpu_time += earlier.cpu_time;
    summary.peak_memory = std::max(summary.peak_memory, earlier.peak_memory);
    summary.steps       = history.size();
    summary.status      = reason.empty() ? "finished" : "failed";
    summary.reason      = reason;
    // Who stops a run needs no other cause.
    if (!reason.empty() && SignalGuard::caught() == 0)
      for (const std::string &text : instabilities)
        summary.reason += "; " + text;
    summarise_history(history, programme, summary);
    const std::string missing = summary.missing_energy();
    const std::string jump =
      has_equal_steps ? "" : jump_in_words(history, summary.dimension > 0);
    if (!missing.empty())
      summary.warnings.push_back(
        missing + ": " +
        (jump.empty() ? "the time steps are too long, and friction may be "
                        "wrong, too; " +
                          shorter_steps + " may help" :
                        jump));
    if (has_equal_steps && summary.rejected_steps > 0)
      summary.warnings.push_back(
        "the steps are not equal: " + std::to_string(summary.rejected_steps) +
        " of them had no solution and were cut; with more Time stepping/Equal "
        "steps per statement each step may have a solution");
    summary.quantities =
      evaluate_quantities(quantities, programme, history, summary.dimension);
    const bool is_point = summary.dimension == 0;
    for (std::size_t i = 0; reason.empty() && i < quantities.size(); ++i)
      if (std::isnan(summary.quantities[i].value) &&
          (is_point ||
           quantities[i].kind == QuantityOfInterest::Kind::slip_front))
        summary.warnings.push_back(
          "'" + quantities[i].name + "' has no value" +
          (is_point ? " on a contact point" :
                      ": at that moment no place on the face separates points "
                      "above the loading ratio that defines it from points "
                      "below"));
    if (!is_writer)
      return;
    if (reason.empty())
      progress.finish();
    // The caller prints those of the summary; these were printed at once.
    Summary complete = summary;
    complete.warnings.insert(complete.warnings.begin(),
                             warnings.begin(),
                             warnings.end());
    write_summary(options.output / "summary.json", complete);
  }
} // namespace SlipStep
