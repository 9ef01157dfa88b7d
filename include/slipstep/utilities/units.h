// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_utilities_units_h
#define slipstep_utilities_units_h

#include <deal.II/base/patterns.h>

#include <limits>
#include <memory>
#include <string>

namespace SlipStep
{
  /// Physical dimensions of the quantities in a case file. Inside the program
  /// every number is in the consistent system mm, s, N, MPa, degC.
  enum class Dimension
  {
    number,          ///< no unit
    length,          ///< mm
    time,            ///< s
    speed,           ///< mm/s
    stress,          ///< MPa
    stiffness,       ///< MPa/mm
    per_length,      ///< 1/mm
    per_time,        ///< 1/s
    viscosity,       ///< s/mm
    drag,            ///< MPa s/mm
    areal_mass,      ///< mass per area, MPa s^2/mm
    per_temperature, ///< 1/degC
    heating,         ///< degC per work and area, degC mm/N
    angle,           ///< deg in text, rad inside
    force,           ///< N
    area,            ///< mm^2
    temperature,     ///< degC
    density          ///< t/mm^3, which is MPa s^2/mm^2
  };

  /// From mm/s to mm/min.
  constexpr double mm_min = 60.;

  /// The unit that a bare number of this dimension is taken to be in, as shown
  /// in documentation ("mm", "MPa/mm", ...; "deg" for angles).
  std::string base_unit(const Dimension dimension);

  /// Read "5.8 MPa", "1 mm/min", "30 deg", "0.045" and return the value in base
  /// units (rad for angles).
  ///
  /// @throws InputError if the text is not a number followed by a unit of the
  /// given dimension; the message lists the known units. A missing unit is an
  /// error if @p unit_required, otherwise the number is in base_unit().
  double parse_quantity(const std::string &text,
                        const Dimension    dimension,
                        const bool         unit_required = false);

  /// From the numbers of a column to base units.
  struct UnitConversion
  {
    double numerator   = 1.;
    double denominator = 1.;
    double offset      = 0.; ///< added last, in base units

    double operator()(const double value) const
    {
      return value * numerator / denominator + offset;
    }
  };

  /// A unit as column headers have it, in ASCII: "um" for "µm" (in UTF-8 or
  /// Latin-1), "kgf/cm^2" for "kgf/cm²", "degF" for "°F", "s" for "sec".
  std::string plain_unit(std::string unit);

  /// The conversion from a unit as column headers have it: "um", "µm" (in
  /// UTF-8 or Latin-1), "mm/min", "N/mm²", "°C".
  /// @throws InputError if it is no unit of the dimension, naming the known
  /// ones and the nearest
  UnitConversion unit_conversion(const std::string &unit,
                                 const Dimension    dimension);

  /// A deal.II pattern for a physical quantity with bounds (in base units,
  /// degrees for angles), so that units can be written in a case file.
  class Quantity : public dealii::Patterns::PatternBase
  {
  public:
    explicit Quantity(
      const Dimension dimension,
      const double    minimum = -std::numeric_limits<double>::infinity(),
      const double    maximum = std::numeric_limits<double>::infinity(),
      const bool      minimum_is_excluded = false,
      const bool      unit_required       = false);

    virtual bool match(const std::string &text) const override;

    /// Why the text does not match ("the unit is missing ..."), or "".
    std::string why_not(const std::string &text) const;

    /// What is allowed, in words: "a speed with its unit (mm/s, mm/min, ...)
    /// greater than 0".
    virtual std::string
    description(const OutputStyle style = Machine) const override;

    /// The same without the units: "a speed greater than 0 mm/s".
    std::string description_of_range() const;

    virtual std::unique_ptr<dealii::Patterns::PatternBase>
    clone() const override;

    /// The value in base units; the text has been matched.
    double value(const std::string &text) const;

    const Dimension dimension;
    const double    minimum;
    const double    maximum;
    const bool      minimum_is_excluded;
    const bool      unit_required;

  private:
    /// The bounds in words: " greater than 0 mm/s".
    std::string range() const;
  };
} // namespace SlipStep

#endif
