#ifndef slipstep_diagnosis_candidates_h
#define slipstep_diagnosis_candidates_h

#include <slipstep/utilities/parameters.h>

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace SlipStep
{
  /// The ranges that a campaign covers.
  struct TestedRange
  {
    double slowest          = 0.; ///< [mm/s]
    double fastest          = 0.;
    double lowest           = 0.; ///< [MPa]
    double highest          = 0.;
    double longest_path     = 0.; ///< [mm]
    double longest_rest     = 0.; ///< [s]
    double longest_test     = 0.; ///< [s]
    double longest_slide    = 0.; ///< without a rest [s]
    double typical_friction = 0.;
  };

  /// A number of the case that is to be fitted with an effect. Base units.
  struct CandidateParameter
  {
    std::string path;
    double      lower          = 0.;
    double      upper          = 1.;
    bool        is_logarithmic = false;
    /// A fit that ends at a bound is no explanation, unless that bound is a
    /// limit which makes sense: nothing cools, the speeds are all fast.
    bool lower_makes_sense = false;
    bool upper_makes_sense = false;
  };

  /// A way in which an effect may act, its strength apart.
  struct Shape
  {
    /// Values (base units) of all parameters when the effect is @p strength
    /// times as strong as one that is only just noticed.
    std::function<std::map<std::string, double>(const double strength)> values;
  };

  /// An effect by one formula.
  struct Formula
  {
    /// What is added to Friction/Effects; "" for an effect of other keys.
    std::string                     effect;
    std::vector<CandidateParameter> parameters;
    /// Keys that are set and stay, with their values as text.
    std::map<std::string, std::string> settings;
    std::vector<Shape>                 shapes;
    bool                               is_one_sided = false;
  };

  /// What might be missing in the model.
  struct Candidate
  {
    std::string name;
    /// How it shows, for reports.
    std::string          signature;
    std::vector<Formula> formulas;
    /// Why it cannot be tried; then there are no formulas.
    std::string why_not;
    bool        is_in_model = false; ///< that is why
  };

  /// The catalogue as seen from a case and its tests.
  /// @param parameters the starting model with its fitted values
  std::vector<Candidate> make_candidates(const Parameters  &parameters,
                                         const TestedRange &range);

  /// Names that "Diagnosis/Candidates" may list.
  std::vector<std::string> candidate_names();

  /// An effect that was added to the starting model.
  struct Part
  {
    std::string name; ///< of the candidate
    Formula     formula;
  };

  /// The values of parameters by their paths, base units.
  using Values = std::map<std::string, double>;

  /// The starting model with effects added, and all their parameters listed
  /// to be fitted. Where a fit begins is what the case says; where a parameter
  /// of the starting model is believed to be stays its start.
  /// @param values of any of the parameters; the others stay
  Parameters assemble(const Parameters        &start,
                      const std::vector<Part> &parts,
                      const Values            &values);

  /// A number in base units as it stands in a case.
  std::string quantity_text(const Parameters  &parameters,
                            const std::string &path,
                            const double       value,
                            const int          n_digits = 10);
} // namespace SlipStep

#endif
