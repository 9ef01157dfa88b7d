// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_experiment_quantities_h
#define slipstep_experiment_quantities_h

#include <slipstep/experiment/history.h>
#include <slipstep/experiment/programme.h>
#include <slipstep/utilities/parameters.h>

#include <limits>
#include <string>
#include <vector>

namespace SlipStep
{
  /// A number that a run is made for, as "Output/Quantities" names it.
  ///
  /// Displacements are paths of the drive: the distance it has moved since the
  /// beginning of the programme, whatever the direction, so that every one
  /// belongs to one time. Between the ends of two steps a quantity is
  /// interpolated by a monotone cubic in time, which does not look across the
  /// borders of the programme's segments; so it does not jump when the steps
  /// fall elsewhere.
  struct QuantityOfInterest
  {
    enum class Kind
    {
      friction_force,       ///< along the motion of the drive [N]
      peak_coefficient,     ///< largest magnitude of friction
      displacement_at_peak, ///< path of the drive there [mm]
      pressure,             ///< at a point of the contact face [MPa]
      largest_pressure,     ///< of the contact [MPa]
      smallest_pressure,    ///< of the contact [MPa]
      displacement,         ///< of a point of the block, in space [mm]
      force,                ///< on the block through a face [N]
      moment,               ///< the same about the face's centre [N mm]
      slip_front,           ///< coordinate along the sliding axis [mm]
      dissipated_energy     ///< [N mm]
    };

    static constexpr double undefined =
      std::numeric_limits<double>::quiet_NaN();

    Kind        kind;
    std::string name; ///< as written
    /// Path of the drive [mm]; NaN for the end of the run.
    double displacement = undefined;
    /// Of a pressure: coordinates along the axes of the contact plane [mm],
    /// two in 3-D, one in 2-D. Of a displacement: all coordinates.
    std::vector<double> position;
    /// Of a displacement, a force or a moment: the axis, 0 to 2.
    unsigned int component = 0;
    /// Of a force or a moment: "left", ...
    std::string face;
    /// Of a slip front: the loading ratio that marks it.
    double loading_ratio = 0.99;

    bool has_component() const
    {
      return kind == Kind::displacement || kind == Kind::force ||
             kind == Kind::moment;
    }

    /// Whether it is found on the contact face alone.
    bool is_on_contact_face() const
    {
      return kind == Kind::pressure || kind == Kind::largest_pressure ||
             kind == Kind::smallest_pressure || kind == Kind::slip_front;
    }

    /// Whether it is found in the block step by step (a column "probe_N" of
    /// history.csv), so that a single contact point does not have it.
    bool is_probe() const
    {
      return has_component() || is_on_contact_face();
    }
  };

  /// A quantity with its value; NaN if the run did not get there, if there is
  /// no slip front, or if a single point cannot tell.
  struct QuantityValue
  {
    std::string name;
    double      value = QuantityOfInterest::undefined;
    std::string unit;
  };

  /// Declares "Output/Quantities".
  void declare_quantities(Parameters &parameters);

  /// @throws InputError for an unknown quantity (naming the nearest), a missing
  ///   unit, a displacement beyond the end of the programme
  std::vector<QuantityOfInterest> parse_quantities(const Parameters &parameters,
                                                   const Programme  &programme);

  /// Of the parsed quantities those that have a column in history.csv.
  std::vector<QuantityOfInterest>
  probes_among(const std::vector<QuantityOfInterest> &quantities);

  /// What loads and energies count per: a contact point stands for 1 mm^2 of
  /// contact, a block in 2-D for 1 mm of its thickness.
  /// @param dimension of the block, 0 for a contact point
  /// @return "/mm^2", "/mm" or ""
  std::string per_size(const unsigned int dimension);

  /// Evaluate what a run came to.
  /// @param history rows with as many probes as probes_among() has, or none
  /// @param dimension of the block, 0 for a contact point: tells the units
  std::vector<QuantityValue>
  evaluate_quantities(const std::vector<QuantityOfInterest> &quantities,
                      const Programme                       &programme,
                      const std::vector<HistoryRow>         &history,
                      const unsigned int                     dimension);

  /// Value at @p x of the monotone cubic through (@p abscissas, @p values),
  /// with the slopes of parabolas, limited as Fritsch and Carlson do: no
  /// overshoot, and on smooth data an error of third order.
  /// @param abscissas increasing
  /// @return NaN outside their range or beside a value that is NaN
  double monotone_interpolation(const std::vector<double> &abscissas,
                                const std::vector<double> &values,
                                const double               x);
} // namespace SlipStep

#endif
