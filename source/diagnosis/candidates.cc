// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/calibration/fit_parameter.h>
#include <slipstep/diagnosis/candidates.h>
#include <slipstep/friction/effect.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/text.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace SlipStep
{
  namespace
  {
    bool is_fitted(const std::string               &path,
                   const Circumstances             &now,
                   const std::vector<FitParameter> &fitted)
    {
      return now.parameters.text("Calibration/Parameters").find(path + " ") !=
               std::string::npos ||
             lists(fitted, path);
    }



    // A spring in series with the contact's own stiffness: for a contact point
    // the same as a smaller alpha_t, which the block understands, too.
    void complete_compliance(const Circumstances             &now,
                             const std::vector<FitParameter> &fitted,
                             Candidate                       &candidate)
    {
      const std::string stiffness = "Friction/Tangential stiffness";
      if (is_fitted(stiffness, now, fitted) ||
          is_fitted("Loading/Machine stiffness", now, fitted))
        return candidate.leave_to_model("the stiffness is fitted already");
      const double alpha   = now.number(stiffness);
      const double largest = now.friction() * now.range.highest;
      const double softest = largest / (0.3 * now.range.longest_path);
      const double least   = std::min(softest, 0.1 * alpha);
      TrialFormula formula;
      formula.is_one_sided = true;
      formula.parameters   = {{stiffness, least, alpha, true}};
      // A flank that grows by less than the distance of rows is not seen.
      for (const double share : {1e-4, 1e-3, 1e-2})
        {
          const double unit = share * now.range.longest_path / largest;
          formula.shapes.push_back([=](const double strength) {
            return Values{
              {stiffness,
               std::max(1. / (1. / alpha + unit * std::max(strength, 1e-3)),
                        1.01 * least)}};
          });
        }
      candidate.formulas = {formula};
    }



    bool acts(const EffectInfo                &info,
              const Circumstances             &now,
              const std::vector<FitParameter> &fitted)
    {
      const std::string &amplitude = info.search.amplitude;
      const std::string  path      = info.section() + amplitude;
      return now.has(info.name) &&
             (amplitude.empty() || now.number(path) > 0. ||
              is_fitted(path, now, fitted));
    }



    // What contacts remember is added to an effect of the model. It may be
    // much: then what was fitted without it is elsewhere, too, but for the
    // growth, which steady sliding tells.
    TrialFormula with_first_state(const TrialFormula              &whole,
                                  const Circumstances             &now,
                                  const std::vector<FitParameter> &fitted)
    {
      const CandidateParameter &growth = whole.parameters[0],
                               &time   = whole.parameters[1],
                               &length = whole.parameters[2],
                               &first  = whole.parameters.back();
      const double present = std::max(now.number(growth.path), just_noticed);
      const double oldest =
        now.number(time.path) + now.number(length.path) / now.range.slowest;

      TrialFormula formula = whole;
      formula.n_assumed    = 0;
      formula.parameters   = {first};
      for (const CandidateParameter &parameter : {growth, time, length})
        if (is_fitted(parameter.path, now, fitted))
          formula.parameters.push_back(parameter);
      const auto keep_free = [free = formula.parameters](Values values) {
        Values result;
        for (const CandidateParameter &parameter : free)
          if (const auto value = values.find(parameter.path);
              value != values.end())
            result.insert(*value);
        return result;
      };
      for (TrialFormula::Shape &shape : formula.shapes)
        shape = [=, young = shape](const double strength) {
          Values values       = young(strength);
          values[growth.path] = present * strength;
          return keep_free(values);
        };
      // Or contacts are only a little older than at the slowest.
      formula.shapes.push_back([=](const double strength) {
        const double grown = std::min(just_noticed * strength / present, 100.);
        return Values{{first.path,
                       std::clamp(oldest * std::exp(grown),
                                  2. * first.lower,
                                  0.5 * first.upper)}};
      });
      return formula;
    }



    // What contacts remember that rested or slid before the tests, by an effect
    // of the model that lets them begin young.
    void complete_initial_state(const Circumstances             &now,
                                const std::vector<FitParameter> &fitted,
                                Candidate                       &candidate)
    {
      candidate.why_not = "no effect of the model gives the contacts a memory";
      for (const auto &[name, info] : effect_registry())
        {
          if (!info.search.first_state || !acts(info, now, fitted))
            continue;
          const TrialFormula whole = info.search.first_state(now);
          candidate.why_not        = whole.why_not;
          if (!whole.why_not.empty())
            continue;
          const std::string &path = whole.parameters.back().path;
          if (is_fitted(path, now, fitted) || now.number(path) > 0.)
            return candidate.leave_to_model("the model has " + path);
          candidate.formulas.push_back(with_first_state(whole, now, fitted));
        }
      if (!candidate.formulas.empty())
        candidate.why_not = "";
    }



    /// A candidate that adds no effect, but a number of the model.
    struct NumberOfModel
    {
      const char *name, *words, *signature;
      void (*complete)(const Circumstances &,
                       const std::vector<FitParameter> &,
                       Candidate &);
    };

    const std::array<NumberOfModel, 2> numbers_of_model = {
      {{"compliance",
        "another elastic stiffness of contact or machine",
        "loading flanks only",
        complete_compliance},
       {"initial_state",
        "contacts that had rested or slid before the tests",
        "where tests begin, until slip has renewed the contacts",
        complete_initial_state}}};



    const NumberOfModel *number_of_model(const std::string &name)
    {
      for (const NumberOfModel &one : numbers_of_model)
        if (name == one.name)
          return &one;
      return nullptr;
    }



    // By this effect or another formula of it.
    bool has_formula_of(const std::string &candidate, const Circumstances &now)
    {
      for (const auto &[name, info] : effect_registry())
        if ((name == candidate || info.search.candidate == candidate) &&
            now.has(name))
          return true;
      return false;
    }



    // To a candidate those of an effect that can be tried; why the others
    // cannot goes to the reasons, each once.
    void add_formulas(const std::vector<TrialFormula::Form> &forms,
                      const EffectInfo                      &info,
                      const Circumstances                   &now,
                      Candidate                             &candidate,
                      std::vector<std::string>              &reasons)
    {
      for (const TrialFormula::Form &form : forms)
        {
          TrialFormula formula = form(now);
          if (!now.has(info.name))
            formula.effect = info.name;
          formula.along = info.search.along;
          if (formula.why_not.empty())
            candidate.formulas.push_back(formula);
          else if (!holds(reasons, formula.why_not))
            reasons.push_back(formula.why_not);
        }
    }



    // By its own formula and by others of the same.
    Candidate candidate_of(const EffectInfo                &own,
                           const Circumstances             &now,
                           const std::vector<FitParameter> &fitted)
    {
      std::vector<const EffectInfo *> effects = {&own};
      for (const auto &entry : effect_registry())
        if (entry.second.search.candidate == own.name)
          effects.push_back(&entry.second);
      Candidate candidate{own.name, own.search.signature, {}, ""};
      candidate.held_by = own.search.held_by;
      std::vector<std::string> reasons;
      for (const EffectInfo *info : effects)
        {
          if (acts(*info, now, fitted))
            {
              const std::string which =
                info == &own ? "it" : info->name + ", another formula of it,";
              candidate.leave_to_model(which + " is in the model already");
              return candidate;
            }
          if (info->search.formula)
            add_formulas(
              {info->search.formula}, *info, now, candidate, reasons);
          add_formulas(
            info->search.other_forms, *info, now, candidate, reasons);
        }
      if (candidate.formulas.empty())
        candidate.why_not = list_text(reasons);
      return candidate;
    }



    void add_effect(const std::string &name, Parameters &parameters)
    {
      const std::string path = "Friction/Effects", list = parameters.text(path);
      parameters.set(path,
                     list + (list.empty() ? "" : ", ") + name,
                     "diagnosis");
    }



    // Seen from the model with its partner, if the model has not.
    Candidate candidate_beside(const EffectInfo &own, const Circumstances &now)
    {
      const std::string &partner = own.search.beside;
      Candidate candidate{own.name, own.search.beside_signature, {}, ""};
      if (now.has(own.name))
        {
          candidate.leave_to_model("it is in the model already");
          return candidate;
        }
      Parameters with_partner = now.parameters;
      const bool has_partner  = has_formula_of(partner, now);
      if (!has_partner)
        add_effect(partner, with_partner);
      else if (!own.search.candidate.empty() &&
               own.search.formula(now).why_not.empty())
        {
          candidate.why_not =
            "it is tried as a formula of " + own.search.candidate;
          return candidate;
        }
      std::vector<std::string> reasons;
      add_formulas(own.search.beside_formulas,
                   own,
                   {with_partner, now.range},
                   candidate,
                   reasons);
      // Alone it may be a formula of another name.
      if (candidate.formulas.empty() && !reasons.empty())
        candidate.why_not = "beside " + partner + ", where " + reasons.front();
      if (!has_partner)
        candidate.only_beside = partner;
      return candidate;
    }
  } // namespace



  void Candidate::leave_to_model(const std::string &why)
  {
    formulas.clear();
    why_not     = why;
    is_in_model = true;
  }



  std::vector<std::string> candidate_names()
  {
    std::vector<std::string> names;
    for (const auto &entry : effect_registry())
      if (!entry.second.search.beside_formulas.empty() ||
          (entry.second.search.formula &&
           entry.second.search.candidate.empty()))
        names.push_back(entry.first);
    for (const NumberOfModel &one : numbers_of_model)
      names.push_back(one.name);
    return names;
  }



  std::vector<std::string> effect_names(const std::vector<Part> &parts)
  {
    std::vector<std::string> names;
    for (const Part &part : parts)
      if (part.corrects.empty())
        names.push_back(part.name);
    return names;
  }



  std::string plain_words(const std::string &candidate)
  {
    if (const NumberOfModel *number = number_of_model(candidate))
      return number->words;
    const auto found = effect_registry().find(candidate);
    return found == effect_registry().end() ? candidate : found->second.words;
  }



  std::vector<Candidate>
  make_candidates(const Parameters                &parameters,
                  const TestedRange               &range,
                  const std::vector<FitParameter> &fitted)
  {
    const Circumstances      now{parameters, range};
    std::vector<std::string> wanted = parameters.list("Diagnosis/Candidates");
    if (wanted.size() == 1 && wanted[0] == "all")
      wanted = candidate_names();
    std::vector<Candidate> result;
    for (const std::string &name : candidate_names())
      if (holds(wanted, name))
        {
          if (const NumberOfModel *number = number_of_model(name))
            {
              result.push_back({name, number->signature, {}, ""});
              number->complete(now, fitted, result.back());
              continue;
            }
          const EffectInfo &info = effect_registry().at(name);
          result.push_back(info.search.beside.empty() ?
                             candidate_of(info, now, fitted) :
                             candidate_beside(info, now));
        }
    return result;
  }



  namespace
  {
    void add_part(const Part &part, const Values &values, CaseToFit &result)
    {
      const TrialFormula &formula    = part.formula;
      Parameters         &parameters = result.parameters;
      if (!formula.effect.empty())
        add_effect(formula.effect, parameters);
      for (const auto &[path, value] : formula.settings)
        parameters.set(path,
                       quantity_text(parameters, path, value),
                       "diagnosis");
      for (const auto &[path, text] : formula.texts)
        parameters.set(path, text, "diagnosis");
      for (const CandidateParameter &parameter : formula.parameters)
        if (!lists(result.fitted, parameter.path))
          result.fitted.push_back(
            make_fit_parameter(parameters,
                               parameter.path,
                               parameter.lower,
                               parameter.upper,
                               std::clamp(values.at(parameter.path),
                                          parameter.lower,
                                          parameter.upper),
                               parameter.is_logarithmic));
    }
  } // namespace



  CaseToFit assemble(const Parameters        &start,
                     const std::vector<Part> &parts,
                     const Values            &values)
  {
    CaseToFit result{start, read_fit_parameters(start)};
    for (const Part &part : parts)
      add_part(part, values, result);
    name_apart(result.fitted);
    for (const FitParameter &parameter : result.fitted)
      {
        const auto value = values.find(parameter.path);
        if (value != values.end())
          result.parameters.set(parameter.path,
                                parameter.text(std::clamp(value->second,
                                                          parameter.lower,
                                                          parameter.upper),
                                               17),
                                "diagnosis");
      }
    return result;
  }
} // namespace SlipStep
