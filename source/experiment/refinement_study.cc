// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/experiment/refinement_study.h>

#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/nearest_name.h>
#include <slipstep/utilities/pattern_words.h>

#include <deal.II/base/utilities.h>

#include <algorithm>

namespace SlipStep
{
  namespace
  {
    const std::string section      = "Refinement study/";
    const std::string time_section = "Time stepping/";

    const std::string mesh_key      = "Block/Refinement";
    const std::string tolerance_key = "Block/Adaptivity/Tolerance";
    const std::string goal_key      = "Block/Adaptivity/Goal";

    /// A kind of time steps: how a study names it, and the key that it varies.
    struct StepKind
    {
      std::string name;
      std::string key;
      bool        counts_steps; ///< else it is a tolerance
    };

    const std::vector<StepKind> step_kinds = {
      {"equal steps", time_section + "Equal steps per statement", true},
      {"tolerance", time_section + "Tolerance", false}};

    StudyRun
    make_run(const std::string                                      &label,
             const std::vector<std::pair<std::string, std::string>> &settings)
    {
      std::string folder = label;
      for (char &c : folder)
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' &&
            c != '-')
          c = '_';
      return {label, folder, settings};
    }

    /// The block's own mesh with the cells halved so many times.
    StudyRun uniform_mesh(const std::string &level)
    {
      return make_run("uniform " + level, {{mesh_key, "uniform " + level}});
    }

    /// Say what is wrong with a value, as Parameters::set would.
    void check_value(const Parameters  &parameters,
                     const std::string &study_key,
                     const std::string &key,
                     const std::string &value)
    {
      parameters.attempt(study_key, [&] { parameters.check(key, value, ""); });
    }

    /// A mesh that the run refines until its estimated error is small enough.
    StudyRun adaptive_mesh(const Parameters  &parameters,
                           const std::string &tolerance)
    {
      const std::string goal = parameters.text(section + "Adaptive goal");
      return make_run(
        "adaptive " + tolerance,
        {{mesh_key, "adaptive " + parameters.text(section + "Adaptive levels")},
         {goal_key, goal},
         {tolerance_key, tolerance}});
    }

    double number_in(const std::string &text)
    {
      return std::strtod(text.c_str(), nullptr);
    }

    /// Runs go from coarse to fine, and no two are the same.
    void check_order(const Parameters               &parameters,
                     const std::string              &study_key,
                     const std::vector<std::string> &values,
                     const bool                      grows)
    {
      for (unsigned int i = 1; i < values.size(); ++i)
        if (!(grows ? number_in(values[i]) > number_in(values[i - 1]) :
                      number_in(values[i]) < number_in(values[i - 1])))
          parameters.reject(study_key,
                            "from coarse to fine, '" + values[i] +
                              "' must be " +
                              std::string(grows ? "more" : "less") + " than '" +
                              values[i - 1] + "'");
    }

    /// "equal steps 50, 100, 200"
    StudySequence read_time_steps(const Parameters  &parameters,
                                  const std::string &study_key)
    {
      const std::string text = parameters.text(study_key);
      for (const StepKind &kind : step_kinds)
        {
          if (text.rfind(kind.name + " ", 0) != 0)
            continue;
          StudySequence sequence;
          sequence.kind = StudySequence::Kind::time_step;
          sequence.name = kind.name;
          const auto values =
            dealii::Utilities::split_string_list(text.substr(kind.name.size()),
                                                 ',');
          for (const std::string &value : values)
            {
              check_value(parameters, study_key, kind.key, value);
              if (kind.counts_steps && number_in(value) < 1.)
                parameters.reject(study_key, "a statement has 1 step or more");
              sequence.runs.push_back(
                make_run(kind.name + " " + value, {{kind.key, value}}));
            }
          check_order(parameters, study_key, values, kind.counts_steps);
          return sequence;
        }
      parameters.reject(study_key,
                        "write the kind of steps and a list, e.g. 'equal steps "
                        "50, 100, 200' or 'tolerance 1e-3, 1e-4, 1e-5'");
    }

    StudySequence uniform_meshes(const Parameters &parameters)
    {
      const unsigned int n = parameters.integer(section + "Uniform meshes");
      StudySequence      sequence{StudySequence::Kind::uniform, "uniform", {}};
      for (unsigned int level = 0; level < n; ++level)
        sequence.runs.push_back(uniform_mesh(std::to_string(level)));
      return sequence;
    }

    StudySequence adaptive_meshes(const Parameters &parameters)
    {
      const std::string key = section + "Adaptive tolerances";
      StudySequence     sequence{StudySequence::Kind::adaptive, "adaptive", {}};
      for (const std::string &tolerance : parameters.list(key))
        {
          check_value(parameters, key, tolerance_key, tolerance);
          sequence.runs.push_back(adaptive_mesh(parameters, tolerance));
        }
      check_order(parameters, key, parameters.list(key), false);
      return sequence;
    }

    /// How many runs there are of a kind.
    std::size_t n_runs(const std::vector<StudySequence> &sequences,
                       const StudySequence::Kind         kind)
    {
      for (const StudySequence &sequence : sequences)
        if (sequence.kind == kind)
          return sequence.runs.size();
      return 0;
    }

    /// The finer run that meshes are compared with, or none.
    StudyRun mesh_reference_of(const Parameters                 &parameters,
                               const std::vector<StudySequence> &sequences)
    {
      const std::size_t n_uniform =
        n_runs(sequences, StudySequence::Kind::uniform);
      const bool has_adaptive =
        n_runs(sequences, StudySequence::Kind::adaptive) > 0;
      if (n_uniform == 0 && !has_adaptive)
        return {};
      const std::string key  = section + "Mesh reference";
      const std::string text = parameters.text(key);
      if (text == "Richardson")
        {
          if (n_uniform < 3)
            parameters.reject(section + "Uniform meshes",
                              "the reference by Richardson extrapolation needs "
                              "3 meshes");
          return {};
        }

      const std::string kind = text.substr(0, text.find(' '));
      const std::string rest =
        text.substr(std::min(kind.size() + 1, text.size()));
      if (kind == "uniform" && !rest.empty())
        {
          if (rest.find_first_not_of("0123456789") != std::string::npos ||
              number_in(rest) > 10. || number_in(rest) < n_uniform)
            parameters.reject(key,
                              "take a mesh finer than those compared with it, "
                              "from 'uniform " +
                                std::to_string(n_uniform) +
                                "' to 'uniform 10'");
          return uniform_mesh(rest);
        }
      if (kind == "adaptive" && !rest.empty())
        {
          check_value(parameters, key, tolerance_key, rest);
          if (has_adaptive)
            {
              std::vector<std::string> tolerances =
                parameters.list(section + "Adaptive tolerances");
              tolerances.push_back(rest);
              check_order(parameters, key, tolerances, false);
            }
          return adaptive_mesh(parameters, rest);
        }
      parameters.reject(key,
                        "allowed are 'Richardson', 'uniform <number>' and "
                        "'adaptive <tolerance>'" +
                          did_you_mean(text, {"Richardson"}));
    }

    /// The same for time steps.
    StudyRun time_reference_of(const Parameters                 &parameters,
                               const std::vector<StudySequence> &sequences)
    {
      const std::string key = section + "Time reference";
      if (n_runs(sequences, StudySequence::Kind::time_step) == 0)
        {
          if (parameters.is_set(key))
            parameters.reject(key,
                              "there are no " + section +
                                "Time steps that it could be compared with");
          return {};
        }
      const StudySequence &steps = sequences.back();
      if (parameters.text(key) == "Richardson")
        {
          if (steps.runs.size() < 3)
            parameters.reject(
              section + "Time steps",
              "the reference by Richardson extrapolation needs 3 "
              "steps");
          return {};
        }
      const StudySequence reference = read_time_steps(parameters, key);
      if (reference.runs.size() != 1)
        parameters.reject(key, "this is one run: give one number");
      if (reference.name == steps.name)
        check_order(parameters,
                    key,
                    {steps.runs.back().settings.front().second,
                     reference.runs.front().settings.front().second},
                    reference.name == step_kinds[0].name);
      return reference.runs.front();
    }
  } // namespace



  void RefinementStudy::declare_parameters(Parameters &parameters)
  {
    using namespace dealii::Patterns;
    parameters.declare(
      section + "Uniform meshes",
      "4",
      Integer(0, 11),
      "For `slipstep refine`: number of uniform meshes. The first, 'uniform 0', "
      "has the cells of Block/Subdivisions, each further one twice as many in "
      "every direction (see Block/Refinement). 0 to 11; Richardson needs 3.");
    parameters.declare(section + "Adaptive tolerances",
                       "",
                       Anything(),
                       "Adaptive meshes: a list of values of "
                       "Block/Adaptivity/Tolerance, e.g. '0.1, 0.05, 0.02', "
                       "coarse to fine. Empty: none.");
    parameters.declare(section + "Adaptive levels",
                       "6",
                       Integer(1, 10),
                       "How often the adaptive meshes may halve the cells of "
                       "section Block, see Block/Refinement. 1 to 10.");
    parameters.declare(section + "Adaptive goal",
                       "energy",
                       Anything(),
                       "Goal of the adaptive meshes, as "
                       "Block/Adaptivity/Goal.");
    parameters.declare(
      section + "Mesh reference",
      "Richardson",
      AnythingWithWords({"Richardson", "uniform", "adaptive"}),
      "What the meshes are compared with: 'Richardson' extrapolates the last "
      "three uniform meshes with the order that they show (a fourth mesh tells "
      "how far the extrapolation may be off); 'uniform <number>' or 'adaptive "
      "<tolerance>' is a separate, finer run.");
    parameters.declare(
      section + "Time steps",
      "",
      AnythingWithWords({"equal", "steps", "tolerance"}),
      "Sequence of time steps on the mesh of section Block: 'equal steps 50, "
      "100, 200' (see Time stepping/Equal steps per statement) or 'tolerance "
      "1e-3, 1e-4, 1e-5', coarse to fine. Empty: none.");
    parameters.declare(
      section + "Time reference",
      "Richardson",
      AnythingWithWords({"Richardson", "equal", "steps", "tolerance"}),
      "What the time steps are compared with: 'Richardson', or a finer run, "
      "e.g. 'equal steps 800'.");
  }



  RefinementStudy::RefinementStudy(const Parameters &parameters)
  {
    if (parameters.text("Output/Quantities").empty())
      parameters.reject("Output/Quantities",
                        "a refinement study needs quantities of interest, e.g. "
                        "'friction force at 0.005 mm; peak coefficient'");
    check_value(parameters,
                section + "Adaptive goal",
                goal_key,
                parameters.text(section + "Adaptive goal"));
    for (const StudySequence &meshes :
         {uniform_meshes(parameters), adaptive_meshes(parameters)})
      if (!meshes.runs.empty())
        sequences.push_back(meshes);
    const std::string steps_key = section + "Time steps";
    if (!parameters.text(steps_key).empty())
      sequences.push_back(read_time_steps(parameters, steps_key));
    if (sequences.empty())
      parameters.reject(section + "Uniform meshes",
                        "there is nothing to study: no meshes and no time "
                        "steps");
    mesh_reference = mesh_reference_of(parameters, sequences);
    time_reference = time_reference_of(parameters, sequences);
  }



  std::vector<StudyRun> RefinementStudy::runs() const
  {
    std::vector<StudyRun> result;
    const auto            add = [&result](const StudyRun &run) {
      if (!run.label.empty() && none_of(result, [&](const auto &other) {
            return other.folder == run.folder;
          }))
        result.push_back(run);
    };
    for (const StudySequence &sequence : sequences)
      for (const StudyRun &run : sequence.runs)
        add(run);
    add(mesh_reference);
    add(time_reference);
    return result;
  }



  Parameters parameters_of(const StudyRun &run, const Parameters &parameters)
  {
    Parameters result = parameters;
    for (const auto &setting : run.settings)
      result.set(setting.first, setting.second, run.label);
    return result;
  }
} // namespace SlipStep
