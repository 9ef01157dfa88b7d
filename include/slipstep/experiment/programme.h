// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_experiment_programme_h
#define slipstep_experiment_programme_h

#include <deal.II/base/tensor.h>

#include <slipstep/measured_data/measured_test.h>

#include <filesystem>
#include <string>
#include <vector>

namespace SlipStep
{
  /// What the programme imposes at one instant.
  struct Loading
  {
    /// Nominal contact pressure [MPa], positive in compression.
    double pressure = 0.;
    /// Displacement of the drive in the contact plane [mm].
    dealii::Tensor<1, 2> displacement;
    /// Its rate [mm/s]; within a step, that of the segment being traversed.
    dealii::Tensor<1, 2> velocity;
  };

  /// A part of the programme in which pressure and displacement are linear in
  /// time.
  struct Segment
  {
    double  start_time = 0.; ///< [s]
    double  end_time   = 0.; ///< [s]
    Loading start;           ///< velocity is that of the segment
    Loading end;
    /// Which statement of the programme it belongs to, counted from 0: a
    /// `follow` has many segments, every other statement one.
    unsigned int statement = 0;
    /// Whether the load of the drive is given instead of its displacement: the
    /// displacement above then stays, and what the drive moves comes on top.
    bool pushes = false;
    /// Tangential load per nominal area at the end [MPa], reached evenly from
    /// the one at the start.
    dealii::Tensor<1, 2> push;
  };

  /// A measured test whose motion the programme repeats.
  struct FollowedTest
  {
    MeasuredTest         test;
    double               start_time = 0.; ///< of the programme [s]
    dealii::Tensor<1, 2> origin;          ///< displacement there [mm]
  };

  /// The loading programme, written to be read aloud:
  /// `press 5.8 MPa in 1 s; hold 10 s; slide 1 mm/min for 60 mm;
  ///  slide -1 mm/min for 5 mm at 30 deg; slide for 10 mm; slide 2 mm/s for 3
  ///  s; push 0.5 MPa in 1 s at 30 deg; push between 0.2 MPa and 0.5 MPa 20
  ///  times, 1 s each; follow measured/test_01.csv; repeat 10 times { slide 1
  ///  mm/s for 2 s; slide -1 mm/s for 2 s }`
  ///
  /// Units are mandatory. Pressure starts at 0 and displacement at the origin;
  /// `press` ramps from the present pressure; a negative speed reverses the
  /// direction, which is (cos, sin) of the angle in the contact plane. `follow`
  /// replays displacement relative to the start of the test, and its pressure;
  /// a different pressure at its start is reached within its first interval.
  /// `push` ramps the tangential load of the drive from what it is; `push
  /// between` goes to the second load and back to the first so many times, in
  /// two statements each, and so long for both.
  /// What `repeat` has in braces happens again from where it ended: every time
  /// with statements of its own, and with other repetitions inside if wanted.
  class Programme
  {
  public:
    Programme() = default;

    /// @param text the programme
    /// @param default_speed speed [mm/s] of a `slide` that states none
    /// @param directory what file names after `follow` are relative to
    /// @throws InputError with a caret under the column where it went wrong
    Programme(const std::string           &text,
              const double                 default_speed,
              const std::filesystem::path &directory);

    /// Loading at a time within [0, end_time()]. At the border of two segments
    /// the velocity is that of the earlier one.
    Loading at(const double time) const;

    /// The segment that at() takes.
    const Segment &segment_at(const double time) const;

    /// By what the error of a step counts. It is relative to the strength that
    /// is left; where the load goes to zero that would ask for ever shorter
    /// steps, and what matters is relative to the load from which it went.
    double weight_of_error(const double begin, const double end) const;

    double end_time() const
    {
      return segment_list.empty() ? 0. : segment_list.back().end_time;
    }

    const std::vector<Segment> &segments() const
    {
      return segment_list;
    }

    /// Largest nominal pressure met [MPa].
    double largest_pressure() const;

    /// Measured tests that are followed, each where it is first.
    const std::vector<FollowedTest> &followed() const
    {
      return followed_list;
    }

    /// What was done to the rows of tests that are followed, to be shown.
    const std::vector<std::string> &warnings() const
    {
      return warning_list;
    }

    /// Whether a `slide` states no speed.
    bool takes_default_speed() const
    {
      return is_speed_left_open;
    }

  private:
    std::vector<Segment>      segment_list;
    std::vector<FollowedTest> followed_list;
    std::vector<std::string>  warning_list;
    bool                      is_speed_left_open = false;
  };

  /// Path of the drive: the distance it has moved since the beginning of the
  /// programme, whatever the direction.
  class SlidingPath
  {
  public:
    explicit SlidingPath(const Programme &programme);

    /// At a time of the programme [mm].
    double at(const double time) const;

    /// At the end of each segment [mm].
    const std::vector<double> &after_segments() const
    {
      return path_after;
    }

    /// At the end [mm].
    double whole() const
    {
      return path_after.empty() ? 0. : path_after.back();
    }

  private:
    std::vector<Segment> segments;
    std::vector<double>  path_after;
  };

  /// The text of a programme whose file names are relative to @p from, as it
  /// has to be where they are relative to @p to.
  std::string relocated_programme(const std::string           &text,
                                  const std::filesystem::path &from,
                                  const std::filesystem::path &to);
} // namespace SlipStep

#endif
