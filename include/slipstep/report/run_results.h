// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_report_run_results_h
#define slipstep_report_run_results_h

#include <slipstep/experiment/history.h>
#include <slipstep/report/run_report.h>
#include <slipstep/experiment/summary.h>
#include <slipstep/utilities/csv.h>
#include <slipstep/utilities/formula.h>
#include <slipstep/utilities/parameters.h>

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace SlipStep
{
  /// State of every contact cell at the end.
  struct FaceTable
  {
    CsvTable cells;
    /// Of the block, as its columns are called: "x", "y" or "z".
    std::array<std::string, 2> axes;
  };



  /// What a run left in its folder.
  struct RunResults
  {
    std::string label;
    /// The parts of it, between commas, that not all runs of the page have.
    std::string             short_label;
    std::filesystem::path   folder;
    Summary                 summary;
    std::vector<HistoryRow> history;
    /// Absent for a contact point.
    std::optional<FaceTable> contact_face;
  };

  using Runs = std::vector<RunResults>;

  /// Whether the drive moves, ever.
  bool is_driven(const RunResults &run);

  /// Load the runs; what cannot be read is left out with a warning.
  Runs load_runs(const std::vector<ReportedRun> &runs,
                 std::vector<std::string>       &warnings);

  /// What the results are compared with: a formula for the kinetic coefficient
  /// as a function of speed, from section "Report".
  class Reference
  {
  public:
    /// @throws InputError if formula or speeds cannot be read
    explicit Reference(const Parameters &parameters);

    /// Whether the case states a reference at all.
    bool exists() const
    {
      return formula != nullptr;
    }

    /// Kinetic coefficient at a speed [mm/s].
    double kinetic(const double speed) const;

    /// Dynamic loading ratio at a speed [mm/s]; 0 if the quasi-static
    /// coefficient is not given.
    double dynamic_ratio(const double speed) const;

    const std::string name;
    /// Where marks are drawn [mm/s]; may be empty.
    std::vector<double> speeds;

  private:
    const double                         quasi_static;
    std::shared_ptr<const ParsedFormula> formula;
  };

  /// One line of the table of results: a slide of a run.
  struct ResultRow
  {
    std::string  label;
    std::size_t  run = 0; ///< its index among the runs
    SlideSummary slide;
    /// What there is none of is NaN: kinetic, r and mu in `slide` unless
    /// has_kinetic(), peak(), dip(), drop, difference.
    double drop = 0.; ///< from peak to kinetic [%]
    double end  = 0.; ///< friction at the end, whatever it is
    /// Not one at whose end the contact sticks and slips.
    bool is_steady = true;
    /// Follows another speed without a rest.
    bool is_step = false;
    /// Whether friction was higher than where the slide starts and ends.
    bool has_peak = true;
    /// Whether friction was lower than that, after a step of speed.
    bool has_dip = false;

    double peak() const
    {
      return has_peak ? slide.peak : std::nan("");
    }

    double dip() const
    {
      return has_dip ? slide.dip : std::nan("");
    }

    /// Whether all of the contact slips at the end.
    bool slides_fully() const
    {
      return slide.slip_fraction > 0.999;
    }

    /// A completed and steady slide of all of the contact, which has settled.
    bool has_kinetic() const
    {
      return slide.is_complete && is_steady && slides_fully() &&
             slide.is_settled();
    }

    /// Whether it ends before steady sliding.
    bool is_on_the_way() const
    {
      return slide.is_complete && is_steady && !slide.swings() &&
             !has_kinetic();
    }

    /// NaN without a reference.
    double reference  = 0.;
    double difference = 0.; ///< of kinetic from reference [%]
  };
  using ResultRows = std::vector<ResultRow>;


  /// A value of the slide of a row.
  template <typename Value>
  auto of_slide(Value SlideSummary::*value)
  {
    return [value](const ResultRow &row) { return row.slide.*value; };
  }

  ResultRows result_rows(const Runs &runs, const Reference &reference);

  /// A sentence or two with the numbers that matter of this kind of test, of
  /// completed slides only.
  /// @param is_one_law whether the runs have the same friction law, so that a
  ///   difference between them is one of speed or pressure
  std::string headline(const ResultRows &rows,
                       const Reference  &reference,
                       const bool        is_one_law = true);

  /// The same of runs without slides, in which the contact is pushed by a load.
  std::string headline_of_pushes(const Runs &runs);
} // namespace SlipStep

#endif
