// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_calibration_fit_parameter_h
#define slipstep_calibration_fit_parameter_h

#include <slipstep/utilities/parameters.h>

#include <string>
#include <vector>

namespace SlipStep
{
  /// A parameter of the case that is to be found from tests.
  ///
  /// Inside the fit it is a number z between 0 and 1, its position between the
  /// bounds on a linear or a logarithmic scale.
  struct FitParameter
  {
    std::string path;
    Dimension   dimension = Dimension::number;
    /// Bounds and start in base units (rad for angles).
    double lower          = 0.;
    double upper          = 1.;
    double start          = 0.;
    bool   is_logarithmic = false;

    double to_scaled(const double value) const;

    double from_scaled(const double scaled) const;

    /// Its value in a case, base units.
    double value_in(const Parameters &parameters) const;

    /// "0.045 1/mm", as it stands in a case file.
    std::string text(const double value, const int n_digits = 10) const;

    /// The unit of text(), "" for a number.
    std::string unit() const;

    /// A value in unit(): degrees for angles, else the same.
    double in_unit(const double value) const;

    /// The last part of the path with as much before it as tells it from the
    /// others: "Rate", "softening/Rate".
    std::string name;
  };

  /// Where a path is among parameters that are or may be fitted; their number
  /// if it is not.
  template <typename Parameter>
  std::size_t place_among(const std::vector<Parameter> &parameters,
                          const std::string            &path)
  {
    std::size_t i = 0;
    while (i < parameters.size() && parameters[i].path != path)
      ++i;
    return i;
  }

  /// Whether a path is among them.
  template <typename Parameter>
  bool lists(const std::vector<Parameter> &parameters, const std::string &path)
  {
    return place_among(parameters, path) < parameters.size();
  }

  /// Whether a scaled value is one of the bounds, but for round-off.
  inline bool is_on_bound(const double scaled)
  {
    return scaled < 1e-6 || scaled > 1. - 1e-6;
  }

  /// Declares section "Calibration".
  void declare_calibration_parameters(Parameters &parameters);

  /// The parameters that "Calibration/Parameters" lists.
  /// @throws InputError for a path that does not exist, a key that is no number
  /// or without meaning for a contact point, bounds that are not allowed, a
  /// start outside of them, none at all
  std::vector<FitParameter> read_fit_parameters(const Parameters &parameters);

  /// A parameter with bounds and start as they would stand in a case, to ten
  /// digits; without a name yet, see name_apart().
  /// @throws InputError for what the case does not allow
  FitParameter make_fit_parameter(const Parameters  &parameters,
                                  const std::string &path,
                                  const double       lower,
                                  const double       upper,
                                  const double       start,
                                  const bool         is_logarithmic);

  /// As "Calibration/Parameters" lists them.
  std::string statements(const std::vector<FitParameter> &parameters,
                         const bool                       with_starts);

  /// Give parameters the names that tell them apart.
  void name_apart(std::vector<FitParameter> &parameters);

  /// A number in base units as it stands in a case.
  std::string quantity_text(const Parameters  &parameters,
                            const std::string &path,
                            const double       value,
                            const int          n_digits = 10);

  /// How the tables call a parameter.
  std::string label_of(const FitParameter &parameter);
} // namespace SlipStep

#endif
