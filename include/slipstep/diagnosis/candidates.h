// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_candidates_h
#define slipstep_diagnosis_candidates_h

#include <slipstep/calibration/fit_parameter.h>
#include <slipstep/friction/effect_search.h>

#include <string>
#include <vector>

namespace SlipStep
{
  /// What might be missing in the model.
  struct Candidate
  {
    std::string name;
    /// How it shows, for reports.
    std::string               signature;
    std::vector<TrialFormula> formulas;
    /// Why it cannot be tried; then there are no formulas.
    std::string why_not;
    bool        is_in_model = false; ///< that is why
    /// The candidate without which it would not be told from others, so that it
    /// is tried together with it only; "" if it is tried alone.
    std::string only_beside = "";
    /// As EffectSearch::held_by.
    std::string held_by = "";

    /// It cannot be tried, since the model has it or the like.
    void leave_to_model(const std::string &why);
  };

  /// The catalogue as seen from a case and its tests.
  /// @param parameters the model with its fitted values
  /// @param fitted what is fitted beside what the case lists
  std::vector<Candidate>
  make_candidates(const Parameters                &parameters,
                  const TestedRange               &range,
                  const std::vector<FitParameter> &fitted = {});

  /// Names that "Diagnosis/Candidates" may list: effects that are looked for,
  /// and the stiffness of the contact, which is none.
  std::vector<std::string> candidate_names();

  /// What it does, for who knows no formulas; the name itself of what is not in
  /// the catalogue.
  std::string plain_words(const std::string &candidate);

  /// An effect that was added to the starting model, or what its formula lacks.
  struct Part
  {
    std::string  name; ///< of the candidate
    TrialFormula formula;
    /// The part whose formula this corrects, "" if it is an effect by itself.
    std::string corrects = "";
  };

  /// The names of the effects among them.
  std::vector<std::string> effect_names(const std::vector<Part> &parts);

  /// A case and all of its parameters that are to be fitted; it lists those of
  /// the starting model only.
  struct CaseToFit
  {
    Parameters                parameters;
    std::vector<FitParameter> fitted;
  };

  /// The starting model with effects added. Where a fit begins is what the case
  /// says; where a parameter of the starting model is believed to be stays its
  /// start.
  /// @param values of any of the parameters; the others stay
  CaseToFit assemble(const Parameters        &start,
                     const std::vector<Part> &parts,
                     const Values            &values);
} // namespace SlipStep

#endif
