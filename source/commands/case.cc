// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/commands/case.h>

#include <slipstep/calibration/fit_parameter.h>
#include <slipstep/diagnosis/diagnosis_parameters.h>
#include <slipstep/experiment/checkpoint.h>
#include <slipstep/experiment/machine.h>
#include <slipstep/experiment/point_driver.h>
#include <slipstep/experiment/refinement_study.h>
#include <slipstep/report/run_report.h>
#include <slipstep/commands/results_folder.h>
#include <slipstep/experiment/step_control.h>
#include <slipstep/friction/law.h>
#include <slipstep/solid/block_parameters.h>
#include <slipstep/solid/face_probes.h>
#include <slipstep/solid/point_lines.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/text.h>
#include <slipstep/utilities/variants.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace SlipStep
{
  void declare_all_parameters(Parameters &parameters)
  {
    declare_loading_parameters(parameters);
    FrictionLaw::declare_parameters(parameters);
    BlockParameters::declare_parameters(parameters);
    declare_output_parameters(parameters);
    declare_quantities(parameters);
    declare_lines(parameters);
    RefinementStudy::declare_parameters(parameters);
    declare_checkpoint_parameters(parameters);
    declare_calibration_parameters(parameters);
    declare_diagnosis_parameters(parameters);
    declare_report_parameters(parameters);
  }



  std::set<std::string> inactive_sections(const Parameters &parameters)
  {
    auto sections = FrictionLaw(parameters).inactive_sections();
    sections.merge(RefinementParameters::inactive_sections(parameters));
    return sections;
  }



  Parameters declared_parameters()
  {
    Parameters parameters;
    declare_all_parameters(parameters);
    return parameters;
  }



  void apply_settings(const CommandLine &line, Parameters &parameters)
  {
    for (const auto &setting : line.settings)
      parameters.set(setting.first, setting.second, "--set");
  }



  namespace
  {
    // A variant whose keys are all given by --set would be one in name only.
    void reject_void_variant(const Parameters  &with_settings,
                             const Variant     &variant,
                             const CommandLine &line)
    {
      if (line.is_child || !with_settings.variants().empty())
        return;
      throw InputError("--variant " + variant.label + ": --set gives " +
                       variant.overrides.front().path +
                       ", which is what the variants change: leave out one of "
                       "the two");
    }



    // A run has the number that the case says, whichever test it follows.
    void warn_of_order(const Parameters      &parameters,
                       const Programme       &programme,
                       std::set<std::string> &warnings)
    {
      const EffectInfo *const effect =
        effect_of_order(FrictionLaw(parameters).effects());
      if (effect == nullptr)
        return;
      const std::string key = effect->section() + effect->test_number;
      for (const FollowedTest &followed : programme.followed())
        if (followed.test.order().value_or(parameters.number(key)) !=
            parameters.number(key))
          warnings.insert(followed.test.file.string() +
                          " was made as test number " +
                          rounded_text(*followed.test.order(), 6) + ", but " +
                          key + " is " + parameters.text(key));
    }



    // A file in which every key is written has the default in any case.
    void warn_of_idle_speed(const Parameters      &parameters,
                            const Programme       &programme,
                            std::set<std::string> &warnings)
    {
      const std::string key        = "Loading/Speed";
      const std::string origin     = parameters.origin(key);
      const bool        is_on_line = origin.compare(0, 2, "--") == 0;
      const bool        is_intended =
        is_on_line ||
        parameters.text(key) != parameters.entry(key).default_value;
      if (is_intended && !programme.takes_default_speed())
        warnings.insert(origin + " is not used: Loading/Programme has no "
                                 "'slide' without a speed of its own");
    }



    bool is_idle(const EffectInfo &info, const Parameters &parameters)
    {
      return parameters.text("Calibration/Parameters").find(info.section()) ==
               std::string::npos &&
             !info.neutral_settings.empty() &&
             all_of(info.neutral_settings, [&](const auto &setting) {
               const std::string path     = info.section() + setting.first;
               const auto       *quantity = dynamic_cast<const Quantity *>(
                 parameters.entry(path).pattern.get());
               return quantity == nullptr ?
                        parameters.text(path) == setting.second :
                        parameters.number(path) ==
                          quantity->value(setting.second);
             });
    }



    // Another effect may need its memory, as a formula of the temperature does.
    bool is_asked_for(const std::string &name, const Parameters &parameters)
    {
      std::vector<std::string> others = parameters.list("Friction/Effects");
      boost::range::remove_erase(others, name);
      if (others.empty())
        return false;
      Parameters without = parameters;
      without.set("Friction/Effects",
                  boost::algorithm::join(others, ", "),
                  "without " + name);
      try
        {
          const FrictionLaw law(without);
          return false;
        }
      catch (const InputError &)
        {
          return true;
        }
    }



    // Without a flow rule nothing is taken out of coefficients that were read
    // at a speed; a diagnosis may add one.
    bool has_idle_speed_of_coefficients(const Parameters &parameters)
    {
      const double speed =
        parameters.number("Friction/Speed of the coefficients");
      return speed > 0. && parameters.text("Calibration/Parameters").empty() &&
             FrictionLaw(parameters).steady_ratio(speed) == 1.;
    }



    // One member of a sweep may be the one without the effect.
    void warn_of_idle_effects(const Case            &the_case,
                              std::set<std::string> &warnings)
    {
      const FrictionLaw law(the_case.complete.front());
      for (const std::string &name : law.effects())
        {
          const EffectInfo &info = effect_registry().at(name);
          if (all_of(the_case.complete, [&](const Parameters &parameters) {
                return is_idle(info, parameters) &&
                       !is_asked_for(name, parameters);
              }))
            warnings.insert("effect " + name +
                            " is on but does nothing: " + info.section() +
                            info.neutral_settings[0].first + " is " +
                            the_case.complete.front().text(
                              info.section() + info.neutral_settings[0].first));
        }
      if (all_of(the_case.complete, has_idle_speed_of_coefficients))
        warnings.insert(
          the_case.complete.front().origin(
            "Friction/Speed of the coefficients") +
          " is not used: coefficients are divided by the loading ratio at that "
          "speed, which differs from 1 only with overstress or perzyna");
    }
  } // namespace



  Case read_case(const std::filesystem::path &file, const CommandLine &line)
  {
    Parameters as_written = declared_parameters();
    as_written.read(file);
    // A member of the file's own sweep can be swept further.
    const bool is_swept_member =
      !line.sweeps.empty() && as_written.keep_variant(line.variant);
    for (const auto &[path, values] : line.sweeps)
      as_written.sweep(path, values, "--sweep");

    Case result;
    result.parameters = as_written;
    apply_settings(line, result.parameters);
    result.variants           = result.parameters.variants();
    result.n_variants_written = as_written.variants().size();
    const std::string chosen  = !line.member.empty() ? line.member :
                                is_swept_member      ? "" :
                                                       line.variant;
    if (!chosen.empty())
      {
        // Named as the case has it, or as what --set leaves of it.
        Parameters with_settings = result.parameters;
        result.selected          = with_settings.keep_variant(chosen) ?
                                     with_settings.variants().front() :
                                     find_variant(as_written.variants(), chosen, file);
        reject_void_variant(result.parameters, result.selected, line);
        result.parameters = as_written.with_variant(result.selected);
        apply_settings(line, result.parameters);
        result.variants.clear();
      }

    // Options go before variants, which go before the file.
    for (const Variant &variant : result.variants)
      {
        result.complete.push_back(as_written.with_variant(variant));
        apply_settings(line, result.complete.back());
      }
    if (!result.is_sweep())
      result.complete.push_back(result.parameters);
    return result;
  }



  Case read_single_case(const CommandLine &line)
  {
    const Case the_case = read_case(line.files.front(), line);
    if (the_case.is_sweep())
      throw InputError("slipstep " + line.command + " fits one case, but " +
                       line.files.front().string() +
                       " is a sweep: choose a member with --variant \"" +
                       the_case.variants.front().label + "\"");
    check_all(the_case);
    check_output(the_case, line);
    print_warnings(warnings_of_face(the_case));
    return the_case;
  }



  RunOptions options_of(const Case &the_case, const CommandLine &line)
  {
    RunOptions options;
    options.quiet             = line.quiet;
    options.output            = chosen_output(the_case, line);
    options.inactive_sections = inactive_sections(the_case.parameters);
    return options;
  }



  void check_all(const Case &the_case)
  {
    output_folder(the_case.parameters);
    for (unsigned int i = 0; i < the_case.complete.size(); ++i)
      try
        {
          check_case(the_case.complete[i]);
        }
      catch (const InputError &error)
        {
          if (!the_case.is_sweep())
            throw;
          // A marked column follows in the second line.
          std::string message = error.what();
          message.insert(std::min(message.find('\n'), message.size()),
                         " (variant \"" + the_case.variants[i].label + "\")");
          throw InputError(message);
        }
  }



  std::vector<std::string> warnings_of_programmes(const Case &the_case)
  {
    std::set<std::string> warnings;
    for (const Parameters &parameters : the_case.complete)
      {
        const Programme programme = parse_programme(parameters);
        warnings.insert(programme.warnings().begin(),
                        programme.warnings().end());
        warn_of_order(parameters, programme, warnings);
        warn_of_idle_speed(parameters, programme, warnings);
      }
    warn_of_idle_effects(the_case, warnings);
    return {warnings.begin(), warnings.end()};
  }



  std::vector<std::string> warnings_of_equal_variants(const Case &the_case)
  {
    const std::size_t n = the_case.variants.size();
    if (!the_case.selected.label.empty() || n >= the_case.n_variants_written)
      return {};
    const std::string begin = "--set overrides the keys in which the " +
                              std::to_string(the_case.n_variants_written) +
                              " variants of the case differ: ";
    if (n == 0)
      return {begin + "the case is now one run, without a variant folder"};
    std::vector<std::string> labels;
    for (const Variant &variant : the_case.variants)
      labels.push_back("'" + variant.label + "'");
    return {begin +
            "of variants that are now equal only one is left, and its name may "
            "no longer fit (" +
            boost::algorithm::join(labels, ", ") + ")"};
  }



  std::vector<std::string>
  warnings_of_areas(const Parameters                &parameters,
                    const std::vector<MeasuredTest> &tests)
  {
    constexpr double largest_difference = 0.01;
    // Of the default block nobody thinks.
    if (tests.empty() || !parameters.is_set("Block/Size"))
      return {};
    const BlockParameters block(parameters, parse_programme(parameters));
    if (block.dimension != 3)
      return {}; // a load per thickness
    const double             face = block.nominal_contact_area();
    std::vector<std::string> warnings;
    std::set<double>         told;
    for (const MeasuredTest &test : tests)
      {
        const auto note = test.notes.find("area");
        if (note == test.notes.end())
          continue;
        try
          {
            const double area =
              parse_quantity(note->second, Dimension::area, true);
            if (std::abs(area - face) > largest_difference * face &&
                told.insert(area).second)
              warnings.push_back(
                test.file.string() +
                ": its pressure is the normal load divided by " +
                rounded_text(area, 4) +
                " mm^2, but the block of the case has a face of " +
                rounded_text(face, 4) +
                " mm^2 (Block/Size): the pressures agree, the loads do not");
          }
        catch (const InputError &error)
          {
            warnings.push_back(test.file.string() +
                               ": comment 'area': " + error.what());
          }
      }
    return warnings;
  }



  std::vector<std::string> warnings_of_followed_areas(const Case &the_case)
  {
    std::set<std::string> warnings;
    for (const Parameters &parameters : the_case.complete)
      {
        const Programme           programme = parse_programme(parameters);
        std::vector<MeasuredTest> tests;
        for (const FollowedTest &followed : programme.followed())
          tests.push_back(followed.test);
        for (const std::string &words : warnings_of_areas(parameters, tests))
          warnings.insert(words);
      }
    return {warnings.begin(), warnings.end()};
  }



  std::vector<std::string> warnings_of_face(const Case &the_case)
  {
    std::set<std::string> warnings;
    for (const Parameters &parameters : the_case.complete)
      for (const char *key : {"Contact/Gap", "Contact/Strength"})
        if (parameters.text(key) != parameters.entry(key).default_value)
          warnings.insert(parameters.origin(key) +
                          " acts only on the face of a block: a contact point, "
                          "a fit by contact points and an exported law do not "
                          "take it into account");
    return {warnings.begin(), warnings.end()};
  }



  std::filesystem::path chosen_output(const Case        &the_case,
                                      const CommandLine &line)
  {
    // What a case is for is its run; other commands go beside it.
    std::filesystem::path output = line.output;
    if (line.output.empty())
      {
        output = output_folder(the_case.parameters);
        if (line.command != "run" && line.command != "check")
          output /= line.command;
      }
    output = output.lexically_normal();
    // A child is told its own folder.
    return the_case.selected.folder.empty() || line.is_child ?
             output :
             output / the_case.selected.folder;
  }



  void check_output(const Case &the_case, const CommandLine &line)
  {
    const std::filesystem::path output = chosen_output(the_case, line);
    const std::string           origin =
      line.output.empty() ? "Output/Directory" : "--output";
    check_output_folder(output, origin);
    for (const Variant &variant : the_case.variants)
      check_output_folder(output / variant.folder, origin);
  }



  void check_case(const Parameters &parameters)
  {
    const FrictionLaw law(parameters);
    for (const std::string &effect : law.effects())
      if (const EffectInfo &info = effect_registry().at(effect); info.check)
        info.check(info.section_of(parameters));
    const Programme       programme = parse_programme(parameters);
    const BlockParameters block(parameters, programme);
    const StepControl     control(parameters, programme, law);
    const Machine         machine(parameters);
    check_probes(parameters, block, parse_quantities(parameters, programme));
    parse_lines(parameters, block);
    check_report_parameters(parameters);
    check_diagnosis_parameters(parameters);
    for (const std::string &path : parameters.paths("Refinement study/"))
      if (parameters.text(path) != parameters.entry(path).default_value)
        {
          const RefinementStudy study(parameters);
          break;
        }
  }



  void check_block(const Parameters &parameters, const unsigned int n_processes)
  {
    const Programme       programme = parse_programme(parameters);
    const BlockParameters block(parameters, programme);
    if (!Machine(parameters).is_rigid() &&
        none_of(block.faces,
                [](const FaceConditions &face) { return face.is_driven; }))
      parameters.reject("Loading/Machine stiffness",
                        "the machine moves the driven faces of the block, but "
                        "no face has 'drive'");
    if (block.least_memory() <= n_processes * installed_memory())
      return;
    std::ostringstream message;
    message << std::setprecision(2) << block.n_unknowns()
            << " unknowns need at least " << block.least_memory() / 1e3
            << " GB of memory, more than the " << installed_memory() / 1e3
            << " GB of this machine; take fewer cells";
    parameters.reject(block.key_of_cells(), message.str());
  }
} // namespace SlipStep
