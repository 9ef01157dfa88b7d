// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_solid_loads_h
#define slipstep_solid_loads_h

#include <deal.II/lac/la_parallel_vector.h>

#include <slipstep/experiment/programme.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace SlipStep
{
  /// The parts of the loading of a block; each is scaled as a whole.
  enum LoadPart : unsigned int
  {
    programme_pressure, ///< per MPa of the programme's pressure
    gradual,            ///< what grows over the first statement
    at_once,            ///< what acts from the first step on
    frame_x,            ///< per mm that the drive's frame has moved
    frame_y,
    n_load_parts
  };

  /// How much of each part acts.
  using LoadFactors = std::array<double, n_load_parts>;

  /// Nothing acts in full from the first instant: it would do more work than is
  /// stored, and shorter steps would not make it less.
  /// @param first_step over which what acts at once comes [s]
  /// @param time [s]
  inline LoadFactors load_factors_at(const Programme &programme,
                                     const double     first_step,
                                     const double     time)
  {
    const Loading now = programme.at(time);
    return {{now.pressure,
             std::min(1., time / programme.segments().front().end_time),
             std::min(1., time / first_step),
             now.displacement[0],
             now.displacement[1]}};
  }

  /// A distributed vector that is zero but for a few faces: its entries there,
  /// of the unknowns of this rank.
  class FaceVector
  {
  public:
    using Vector = dealii::LinearAlgebra::distributed::Vector<double>;

    FaceVector() = default;

    /// Its entries that are not zero.
    explicit FaceVector(const Vector &vector)
      : norm(vector.l2_norm())
    {
      for (unsigned int i = 0; i < vector.locally_owned_size(); ++i)
        if (vector.local_element(i) != 0.)
          entries.emplace_back(i, vector.local_element(i));
    }

    /// @param[in,out] vector distributed like the one of the constructor
    void add_to(const double factor, Vector &vector) const
    {
      for (const auto &entry : entries)
        vector.local_element(entry.first) += factor * entry.second;
    }

    /// Dot product, of the entries of this rank.
    double dot(const Vector &vector) const
    {
      double sum = 0.;
      for (const auto &entry : entries)
        sum += entry.second * vector.local_element(entry.first);
      return sum;
    }

    double l2_norm() const
    {
      return norm;
    }

  private:
    std::vector<std::pair<unsigned int, double>> entries;
    double                                       norm = 0.;
  };

  /// What a part of the loading is: forces and prescribed displacements.
  struct LoadCase
  {
    FaceVector force;        ///< [N], not constrained
    FaceVector displacement; ///< [mm]
  };
} // namespace SlipStep

#endif
