// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/candidates.h>
#include <slipstep/diagnosis/covariate.h>
#include <slipstep/report/diagnosis_report.h>

#include <cmath>

namespace SlipStep
{
  namespace
  {
    /// The rivals that stand in the place of an effect; rivals of which that
    /// is not said stand in the place of the first.
    std::vector<std::string> rivals_of(const Diagnosis  &diagnosis,
                                       const std::size_t effect)
    {
      std::vector<std::string> rivals;
      for (const RivalEffect &rival : diagnosis.rivals)
        if (holds(diagnosis.effects, rival.instead_of) ?
              rival.instead_of == diagnosis.effects[effect] :
              effect == 0)
          rivals.push_back(rival.name);
      return rivals;
    }

    /// ", by the formula of ageing": the effect whose parameters were added,
    /// where it is called otherwise than the name.
    std::string formula_words(const Diagnosis   &diagnosis,
                              const std::string &name)
    {
      for (const CandidateResult &candidate : diagnosis.candidates)
        if (candidate.name == name && !candidate.parameters.empty())
          {
            const std::string label  = label_text(candidate.parameters[0]);
            const std::string effect = label.substr(0, label.find('/'));
            return effect == label || effect == name || effect == "Friction" ?
                     "" :
                     ", by the formula of " + effect;
          }
      return "";
    }

    /// In brackets behind one name or two.
    std::string all_plain_words(const Diagnosis &diagnosis)
    {
      std::vector<std::string> names = diagnosis.effects;
      for (const RivalEffect &rival : diagnosis.rivals)
        names.push_back(rival.name);
      // More would bury the numbers.
      if (names.size() > 2)
        return "";
      std::string text;
      for (const std::string &name : names)
        text += (text.empty() ? "" : "; ") +
                (names.size() > 1 ? name + ": " : std::string()) +
                plain_words(name) + formula_words(diagnosis, name);
      return " (" + text + ")";
    }

    /// "the gap falls from 4.12 % to 1.05 % of friction ..."
    std::string shrink_words(const Shrink &shrink)
    {
      const std::string before = percent_text(shrink.fitted_before);
      const std::string after  = percent_text(shrink.fitted_after);
      std::string       text =
        (shrink.grows() ?
           "the fit weighted by the noise improves, though the plain gap "
           "grows from " +
             before + " to " + after :
         before == after ? "the gap to the measurements stays " + before :
                           "the gap to the measurements falls from " + before +
                             " to " + after) +
        " of friction (noise alone: " +
        (shrink.is_noise_overrated() ? "less than the " : "") +
        percent_text(shrink.noise_floor) +
        (shrink.is_noise_overrated() ? " assumed" : "") +
        (shrink.systematic_before > 0. ?
           "; beyond it " + percent_text(shrink.systematic_before) + " → " +
             percent_text(shrink.systematic_after) :
           ", so that the gap shows by its pattern, not by its size") +
        ")";
      if (shrink.left_out_before > 0.)
        text += std::string(!shrink.grows() &&
                                shrink.left_out_after > shrink.left_out_before ?
                              ", but rises under conditions left out of the "
                              "fit from " :
                            shrink.hardly_predicts() ?
                              ", but hardly under conditions left out of the "
                              "fit, from " :
                              ", under conditions left out of the fit from ") +
                percent_text(shrink.left_out_before) + " to " +
                percent_text(shrink.left_out_after);
      return text;
    }

    /// What is there before anything is added.
    std::string gap_words(const Diagnosis &diagnosis)
    {
      const Shrink     &shrink = diagnosis.shrink;
      const std::string text   = "simulation and measurements differ by " +
                               percent_text(shrink.fitted_before) +
                               " of friction, ";
      return shrink.noise_floor < shrink.fitted_before ?
               text + "of which noise alone accounts for " +
                 percent_text(shrink.noise_floor) :
               text + "no more than noise would (" +
                 percent_text(shrink.noise_floor) + ")" +
                 (diagnosis.has_gap ? ", but not at random" : "");
    }

    /// " (p = 0.2)"
    std::string gap_chance(const Diagnosis &diagnosis)
    {
      const std::string text = chance_text(diagnosis.gap.p, diagnosis.n_draws);
      return std::string(" (p ") + (text.rfind("≤", 0) == 0 ? "" : "= ") +
             text + ")";
    }

    std::string named_words(const Diagnosis &diagnosis)
    {
      return list_text(diagnosis.effects) +
             (diagnosis.effects.size() > 1 ? " are" : " is") + " missing" +
             all_plain_words(diagnosis) + ": with " +
             (diagnosis.effects.size() > 1 ? "them " : "it ") +
             shrink_words(diagnosis.shrink);
    }

    std::string ambiguous_words(const Diagnosis &diagnosis)
    {
      std::string text = "these tests do not tell what is missing, " +
                         names_text(diagnosis) + all_plain_words(diagnosis) +
                         ": with " + list_text(diagnosis.effects) + " " +
                         shrink_words(diagnosis.shrink);
      const NextTest &next = diagnosis.next_test;
      if (next.tells())
        text += "; " + next.words + " would tell";
      else if (!next.words.empty())
        text += "; none of the usual tests would decide it reliably, and the "
                "best of them, " +
                next.words + ", separates the predictions by " +
                short_text(next.distance, 2) + " standard deviations";
      else
        text += "; none of the usual tests would tell";
      return text;
    }

    /// Effects that are seen, though not surely enough to be fitted, for which
    /// the first name has a quarter of the level: none if others had been.
    std::vector<const CandidateResult *> unsure(const Diagnosis &diagnosis)
    {
      std::vector<const CandidateResult *> found;
      for (const CandidateResult &candidate : diagnosis.candidates)
        if (std::isfinite(candidate.gain) || diagnosis.is_cut_short)
          return {};
        else if (candidate.standing == Standing::not_enough)
          {
            if (diagnosis.has_gap && candidate.p <= diagnosis.level / 4.)
              return {};
            found.push_back(&candidate);
          }
      return found;
    }

    /// "; viscous and overstress come nearest, too unsure for a name (p = 0.03
    /// at best)"
    std::string unsure_words(const Diagnosis &diagnosis)
    {
      std::vector<std::string> names;
      double                   least = 1.;
      for (const CandidateResult *candidate : unsure(diagnosis))
        {
          names.push_back(candidate->name);
          least = std::min(least, candidate->p);
        }
      return names.empty() ?
               "" :
               "; " + list_text(names) +
                 (names.size() > 1 ? " come" : " comes") +
                 " nearest, but not surely enough to be named (p = " +
                 short_text(least, 2) + (names.size() > 1 ? " at best)" : ")");
    }

    // What time was too short for, where nothing has been named.
    std::string open_words(const Diagnosis &diagnosis)
    {
      const auto count = [&](const Standing standing) {
        return count_if(diagnosis.candidates,
                        [&](const CandidateResult &candidate) {
                          return candidate.standing == standing;
                        });
      };
      const std::size_t n_untried   = count(Standing::not_tried);
      const std::size_t n_undecided = count(Standing::undecided);
      const auto        effects     = [](const std::size_t n) {
        return std::to_string(n) + (n == 1 ? " effect" : " effects");
      };
      return (n_undecided > 0 ?
                "; " + effects(n_undecided) + " may be what is missing, but " +
                  (n_undecided == 1 ? "was" : "were") + " not judged" :
                "") +
             (n_untried > 0 ?
                "; " + effects(n_untried) +
                  (n_untried == 1 ? " was" : " were") + " not examined" :
                "");
    }

    std::string unnamed_words(const Diagnosis &diagnosis)
    {
      std::string text =
        (diagnosis.is_cut_short ?
           "something is missing: " :
           "something is missing that " + nothing_explains(diagnosis) + ": ") +
        gap_words(diagnosis) + gap_chance(diagnosis);
      if (!diagnosis.where.empty())
        text += ", most " + place_words(diagnosis.where[0]);
      if (diagnosis.correction.has_value())
        text += "; a correction that depends on " +
                diagnosis.correction->covariate +
                ", cause unknown, reduces the difference to " +
                percent_text(diagnosis.shrink.fitted_after);
      return text + (diagnosis.is_cut_short ? open_words(diagnosis) :
                                              unsure_words(diagnosis));
    }

    std::string verdict_words(const Diagnosis &diagnosis)
    {
      const std::string chance = gap_chance(diagnosis);
      if (diagnosis.is_cut_short && !diagnosis.has_gap)
        return "nothing is seen to be missing: " + gap_words(diagnosis) +
               chance + open_words(diagnosis);
      switch (diagnosis.verdict)
        {
          case Verdict::named:
            return named_words(diagnosis);
          case Verdict::ambiguous:
            return ambiguous_words(diagnosis);
          case Verdict::unnamed:
            return unnamed_words(diagnosis);
          case Verdict::no_gap:
            return "nothing is missing as far as these tests can tell: " +
                   gap_words(diagnosis) + chance + unsure_words(diagnosis);
          case Verdict::not_testable:
            return "these tests cannot tell whether anything is missing: " +
                   gap_words(diagnosis) + chance +
                   ", and no effect of the catalogue would have been seen";
        }
      return "";
    }

    /// "; the formula of pressure is not quite right"
    std::string completed_words(const Diagnosis &diagnosis)
    {
      std::vector<std::string> effects;
      for (const CompletedFormula &one : diagnosis.completed)
        effects.push_back(one.effect);
      return effects.empty() ?
               "" :
               std::string(effects.size() > 1 ? "; the formulas of " :
                                                "; the formula of ") +
                 list_text(effects) + (effects.size() > 1 ? " are" : " is") +
                 " not quite right: a factor that depends on " +
                 diagnosis.completed[0].covariate +
                 " completes it, and its parameters are valid with that "
                 "factor only";
    }

    /// "; without 't11', which has no replicate, ..."
    std::string lone_words(const Diagnosis &diagnosis)
    {
      std::vector<std::string> names, tests;
      for (const auto &[name, test] : diagnosis.lone_tests)
        {
          if (!holds(names, name))
            names.push_back(name);
          if (!holds(tests, in_quotes(test)))
            tests.push_back(in_quotes(test));
        }
      return names.empty() ?
               "" :
               "; without " + list_text(tests, "or") + ", which " +
                 (tests.size() > 1 ? "have" : "has") +
                 " no replicate, the other tests would not require " +
                 list_text(names, "or");
    }

    /// "; not all of it is explained, most of the rest is ..."
    std::string remainder_words(const Diagnosis &diagnosis)
    {
      if (!has_after(diagnosis) || diagnosis.effects.empty())
        return "";
      const Shrink     &shrink = diagnosis.shrink;
      const std::string little =
        diagnosis.shrink.grows() ?
          "; differences between whole tests, of gain or zero, mask the "
          "improvement: repetitions would make it more certain" :
        is_worth_little(diagnosis) ?
          "; hardly any of the difference beyond the noise is explained, so "
          "that the verdict is worth little" :
          "";
      if (!diagnosis.is_incomplete)
        return little;
      std::string text =
        !little.empty() ?
          little :
        shrink.systematic_after > 0. ?
          "; not all of it is explained" :
          "; what remains is no larger than noise, but has a pattern";
      if (diagnosis.remains.empty())
        return text;
      const Localisation &where = diagnosis.remains[0];
      text += ": the rest shows most " + place_words(where);
      if (!where.tests.empty())
        text += " in " + list_text(where.tests);
      return text;
    }

    /// "; stribeck could not be simulated with this model, and may be it"
    std::string untried_words(const Diagnosis &diagnosis)
    {
      if (!diagnosis.has_gap ||
          (diagnosis.verdict != Verdict::unnamed && !diagnosis.is_incomplete))
        return "";
      std::vector<std::string> names;
      for (const CandidateResult &candidate : diagnosis.candidates)
        if (candidate.standing == Standing::not_simulated &&
            !(candidate.is_testable && candidate.p > diagnosis.level))
          names.push_back(candidate.name);
      return names.empty() ? "" :
                             "; " + list_text(names) +
                               " could not be simulated with this model, and "
                               "may be what is missing";
    }

    // Each once, in quotes, the first three or so.
    std::vector<std::string> outlier_names(const std::vector<Outlier> &outliers,
                                           const bool                  are_rows)
    {
      std::vector<std::string> names;
      for (const Outlier &outlier : outliers)
        if (outlier.is_of_rows == are_rows && !outlier.is_copy &&
            !holds(names, in_quotes(outlier.test)))
          names.push_back(in_quotes(outlier.test));
      if (names.size() > 3)
        {
          const std::size_t n_more = names.size() - 2;
          names.resize(2);
          names.push_back(std::to_string(n_more) + " more");
        }
      return names;
    }

    std::string outlier_words(const std::vector<Outlier> &outliers)
    {
      const std::vector<std::string> tests = outlier_names(outliers, false);
      const std::vector<std::string> rows  = outlier_names(outliers, true);
      std::string                    text;
      if (!tests.empty())
        text += "; look at " + list_text(tests) + " first, which " +
                (tests.size() > 1 ? "do" : "does") +
                " not behave like the other tests";
      if (!rows.empty())
        text += "; a few numbers of " + list_text(rows) +
                " that nothing explains have less weight: check whether they "
                "are right";
      return text;
    }

    /// Digits by the width of the interval.
    FittedParameter as_fitted(const DiagnosedParameter &parameter)
    {
      const double above = parameter.upper - parameter.value;
      const double below = parameter.value - parameter.lower;
      return {parameter,
              FitParameter(),
              0.5 * (parameter.is_lower_open ? above :
                     parameter.is_upper_open ? below :
                                               0.5 * (above + below))};
    }



    /// "0.5 … 1.7 mm/s", or the length of a wave
    std::string values_text(const Localisation &where)
    {
      const bool        is_wave = where.wavelength > 0.;
      const std::string from =
        plain_text(is_wave ? where.wavelength : where.from, 3);
      const std::string to = is_wave ? from : plain_text(where.to, 3);
      return (from == to ? from : from + " … " + to) +
             (where.unit.empty() ? "" : " " + where.unit);
    }
  } // namespace



  std::string look_alike_words(const LookAlike &look_alike)
  {
    switch (look_alike.kind)
      {
        case LookAlike::Kind::friction_zero:
          return "a zero of the sensor, " + rounded_text(look_alike.value, 3) +
                 " of friction";
        case LookAlike::Kind::load_zero:
          return "a zero of the sensor, " + rounded_text(look_alike.value, 3) +
                 " MPa of load";
        case LookAlike::Kind::held_parameter:
          return look_alike.path + " = " + look_alike.text +
                 " instead of the " + look_alike.held_text +
                 " that the case holds" +
                 (look_alike.instead_of.empty() ?
                    "" :
                    ", in the place of " + look_alike.instead_of + ",");
      }
    return "";
  }



  std::string headline(const Diagnosis &diagnosis)
  {
    const bool        is_stated = diagnosis.n_replicate_pairs == 0;
    const std::string words     = verdict_words(diagnosis);
    std::string       text;
    if (diagnosis.is_cut_short)
      text = std::string("Not decided, the search was cut short (") +
             (diagnosis.was_stopped ? "Ctrl-C" : "Diagnosis/Most time") +
             "). So far: ";
    const bool is_doubted = diagnosis.look_alike.has_value();
    if (is_doubted)
      text += capitalised(look_alike_words(*diagnosis.look_alike)) +
              (diagnosis.look_alike->kind == LookAlike::Kind::held_parameter ?
                 " explains these tests as well: fit this parameter "
                 "(Calibration/Parameters) if its value is not known. "
                 "Otherwise, " :
                 ", explains these tests as well: remove it if it is one "
                 "(Correction/Zero of an import). If it is not, ");
    // How surely noise is stated is a part of what is believed of it.
    if (is_stated)
      text += (!diagnosis.has_gap && !is_doubted ?
                 "Judged by the stated noise" :
                 std::string(is_doubted ? "and if" : "If") +
                   " the stated noise is right") +
              " (there are no replicates), ";
    return text + (text.empty() ? capitalised(words) : words) +
           completed_words(diagnosis) + lone_words(diagnosis) +
           remainder_words(diagnosis) + untried_words(diagnosis) +
           outlier_words(diagnosis.outliers) + ".";
  }



  std::string short_verdict(const Diagnosis &diagnosis)
  {
    if (diagnosis.is_cut_short)
      return "not decided, the search was cut short";
    switch (diagnosis.verdict)
      {
        case Verdict::named:
          return diagnosis.is_incomplete ? "named, incomplete" :
                                           "missing effect named";
        case Verdict::ambiguous:
          return diagnosis.is_incomplete ? "several explanations, incomplete" :
                                           "several explanations";
        case Verdict::unnamed:
          return "something unknown is missing";
        case Verdict::no_gap:
          return "nothing found to be missing";
        case Verdict::not_testable:
          return "these tests cannot tell";
      }
    return "";
  }



  std::string reservation(const Diagnosis &diagnosis)
  {
    const bool is_stated = diagnosis.n_replicate_pairs == 0;
    if (diagnosis.look_alike.has_value())
      return std::string(diagnosis.look_alike->kind ==
                             LookAlike::Kind::held_parameter ?
                           "or a parameter that the case holds" :
                           "or a zero of the sensor") +
             (is_stated ? ", if the stated noise is right" : "");
    return is_stated && !diagnosis.has_gap ? "judged by the stated noise" :
           is_stated                       ? "if the stated noise is right" :
           diagnosis.n_conditions == 1 && diagnosis.has_gap ?
                       "under the one condition tested" :
                       "";
  }



  std::string names_text(const Diagnosis &diagnosis)
  {
    std::vector<std::string> alternatives;
    for (std::size_t i = 0; i < diagnosis.effects.size(); ++i)
      {
        std::vector<std::string> names = rivals_of(diagnosis, i);
        names.insert(names.begin(), diagnosis.effects[i]);
        alternatives.push_back(list_text(names, "or"));
      }
    // "a, b, and c or d", but "a and b".
    std::string text;
    for (std::size_t i = 0; i < alternatives.size(); ++i)
      text += (i == 0                                              ? "" :
               i + 1 < alternatives.size()                         ? ", " :
               diagnosis.rivals.empty() || alternatives.size() < 2 ? " and " :
                                                                     ", and ") +
              alternatives[i];
    return text;
  }



  std::string chance_text(const double p, const unsigned int n_draws)
  {
    // Two thirds of the chance belong to one statistic, see test_gap().
    if (std::isnan(p))
      return "–";
    const bool is_floor = n_draws > 0 && p < 1.51 / (n_draws + 1.);
    return (is_floor ? "≤ " : "") + short_text(p, 2);
  }



  std::string chance_text(const CandidateResult &candidate,
                          const unsigned int     n_draws)
  {
    return candidate.is_testable ? chance_text(candidate.p, n_draws) : "–";
  }



  std::string nothing_explains(const Diagnosis &diagnosis)
  {
    bool                     is_lost = false;
    std::vector<std::string> tried;
    for (const CandidateResult &candidate : diagnosis.candidates)
      {
        is_lost = is_lost || candidate.standing == Standing::not_simulated;
        if (candidate.standing != Standing::in_the_model)
          tried.push_back(candidate.name);
      }
    if (!diagnosis.is_restricted)
      return std::string("no effect of the catalogue ") +
             (is_lost ? "that could be simulated " : "") +
             (unsure(diagnosis).empty() ? "explains" : "explains for certain");
    return "none of the effects asked for (" + list_text(tried) + ") explains";
  }



  std::string range_text(const Localisation &where)
  {
    if (where.wavelength > 0.)
      return where.covariate + ", in waves of " + values_text(where);
    return where.from == 0. && where.to == 0. ?
             where.covariate :
             where.covariate + " " + values_text(where);
  }



  std::string place_words(const Localisation &where)
  {
    if (where.covariate == "direction")
      return where.from > 0.5 ? "where motion goes back" :
                                "where motion goes forward";
    std::string       words  = covariate_called(where.covariate).words;
    const std::size_t values = words.find('*');
    if (values == std::string::npos)
      return words;
    if (where.wavelength == 0. && where.from == 0. && where.to == 0.)
      return "by " + where.covariate;
    return words.replace(values, 1, values_text(where));
  }



  std::string sign_text(const Localisation &where)
  {
    return where.sign > 0 ? "higher" : where.sign < 0 ? "lower" : "different";
  }



  std::string value_text(const DiagnosedParameter &parameter,
                         const double              value)
  {
    return std::isfinite(value) ? digits_text(as_fitted(parameter), value) :
                                  "–";
  }



  std::string label_text(const DiagnosedParameter &parameter)
  {
    const std::string all = "Friction/";
    return parameter.path.rfind(all, 0) == 0 ?
             parameter.path.substr(all.size()) :
             parameter.path;
  }



  std::string bounds_text(const DiagnosedParameter &parameter)
  {
    const double reach = 0.01 * std::abs(parameter.value);
    return parameter.value > parameter.least + reach &&
               parameter.value < parameter.most - reach ?
             "beyond which the law takes no values" :
             short_text(parameter.least, 4) + " … " +
               short_text(parameter.most, 4);
  }



  std::string interval_reservation(const Diagnosis &diagnosis)
  {
    return diagnosis.is_incomplete ?
             "The intervals account for noise alone: the unexplained "
             "remainder may shift the values by more." :
             "";
  }



  std::string interval_text(const DiagnosedParameter &parameter)
  {
    return interval_text(as_fitted(parameter));
  }



  TableLine element_line(const ElementCheck &check)
  {
    TableLine line = {check.test};
    for (const double gap : {check.block_gap_before,
                             check.block_gap_after,
                             check.point_gap_before,
                             check.point_gap_after,
                             check.difference})
      line.push_back(percent_text(gap));
    return line;
  }



  std::vector<DiagnosedParameter> named_parameters(const Diagnosis &diagnosis)
  {
    std::vector<DiagnosedParameter> result;
    for (const CandidateResult &candidate : diagnosis.candidates)
      if (holds(diagnosis.effects, candidate.name))
        result.insert(result.end(),
                      candidate.parameters.begin(),
                      candidate.parameters.end());
    return result;
  }



  bool has_after(const Diagnosis &diagnosis)
  {
    return !diagnosis.effects.empty() || diagnosis.correction.has_value();
  }



  bool is_worth_little(const Diagnosis &diagnosis)
  {
    return !diagnosis.effects.empty() &&
           diagnosis.shrink.systematic_after >
             Shrink::hardly_less * diagnosis.shrink.systematic_before;
  }
} // namespace SlipStep
