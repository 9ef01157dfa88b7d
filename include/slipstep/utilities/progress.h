// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_utilities_progress_h
#define slipstep_utilities_progress_h

#include <chrono>
#include <limits>
#include <ostream>
#include <string>

namespace SlipStep
{
  /// Tells how far a run is: on a terminal one live line, with the time left if
  /// that is known, in a file or pipe a plain line about every 5 % or 10 s,
  /// nothing if quiet.
  ///
  /// A plain line is `[ 42.0 %] <label>: <text>, about 12 s left`;
  /// parse_progress_line() reads it back.
  class Progress
  {
  public:
    /// On stdout; live if that is a terminal. mpirun makes every stdout look
    /// like one, so there are no live lines under it.
    /// @param quiet print nothing (also for all ranks but one)
    /// @param label what is running, e.g. the variant's
    Progress(const bool quiet, const std::string &label);

    /// For tests and for output to somewhere else than stdout.
    Progress(const bool         quiet,
             const std::string &label,
             std::ostream      &out,
             const bool         is_live);

    /// Ends a live line, so that what follows starts on its own.
    ~Progress();

    Progress(const Progress &)            = delete;
    Progress &operator=(const Progress &) = delete;

    /// Cheap enough to be called in every step.
    /// @param fraction done so far, from 0 to 1
    /// @param text the present state, e.g. "12.3 mm, step 240"
    /// @param time_left [s], told unless it is NaN
    void update(const double       fraction,
                const std::string &text,
                const double       time_left = unknown);

    /// Since the object was made [s].
    double time_spent() const;

    /// The last line.
    /// @param outcome what stands before the time taken
    void finish(const std::string &outcome = "done in");

    /// Remove the live line, because something else is to be printed; the next
    /// update() shows it again.
    void clear();

    /// From now on plain lines come up to five times a second: set in a child
    /// process whose parent shows the live line.
    static void report_often();

  private:
    using Clock = std::chrono::steady_clock;

    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

    void print(const double       fraction,
               const std::string &text,
               const double       time_left = unknown);

    const bool        quiet;
    const std::string label;
    std::ostream     &out;
    const bool        is_live;
    bool              line_is_open  = false;
    bool              has_printed   = false;
    bool              is_finished   = false;
    double            last_fraction = 0.;
    Clock::time_point start;
    Clock::time_point last_print;

    static bool often;
  };

  /// What a plain progress line said.
  struct ProgressLine
  {
    double      fraction = 0.;
    std::string text; ///< after the label, without the time left
    /// [s]; NaN if it is not told.
    double time_left = std::numeric_limits<double>::quiet_NaN();
  };

  /// @return whether the line is a progress line
  bool parse_progress_line(const std::string &line, ProgressLine &parsed);

  /// "45 s", "3 min 20 s", "2 h 5 min".
  std::string duration_in_words(const double seconds);

  /// The same read back [s]. @return NaN for other words
  double parse_duration(const std::string &words);
} // namespace SlipStep

#endif
