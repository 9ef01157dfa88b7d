// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_experiment_summary_h
#define slipstep_experiment_summary_h

#include <slipstep/experiment/history.h>
#include <slipstep/experiment/programme.h>
#include <slipstep/experiment/quantities.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace SlipStep
{
  /// What one `slide` of the programme showed.
  struct SlideSummary
  {
    double speed             = 0.;   ///< [mm/s], magnitude
    double pressure          = 0.;   ///< at the end of the slide [MPa]
    double angle             = 0.;   ///< direction of motion [rad]
    double length            = 0.;   ///< [mm]
    double peak              = 0.;   ///< largest friction in this direction
    double peak_displacement = 0.;   ///< path since the start of the slide [mm]
    double kinetic           = 0.;   ///< friction at the end of the slide
    double dynamic_ratio     = 0.;   ///< mean r at the end of the slide
    double coefficient       = 0.;   ///< mean mu at the end of the slide
    bool   is_complete       = true; ///< not cut short by a failure
    unsigned int statement =
      0;                       ///< of the programme, counted from 1; 0: unknown
    double rest          = 0.; ///< since the motion before, 0 for the first [s]
    double before        = 0.; ///< friction where it starts
    double dip           = 0.; ///< smallest friction in this direction
    double slip_fraction = 1.; ///< share of the contact that slips at the end
    double relative_rate = 1.; ///< of slip, over the speed, at the end
    double growth        = 0.; ///< of r in the last tenth, a share of r
    double change        = 0.; ///< of friction there, a share of the largest
    /// The least and the largest friction at which it turns, where it goes up
    /// and down at the end; else 0.
    double swing_from = 0., swing_to = 0.;

    bool swings() const
    {
      return swing_to > swing_from;
    }

    /// Whether the contact slides at the end as it would go on sliding: about
    /// as fast as it is driven, with a loading ratio that has stopped to rise
    /// and friction that has stopped to change.
    bool is_settled() const
    {
      return !swings() && std::abs(relative_rate - 1.) < 0.1 && growth < 0.01 &&
             change < 0.02;
    }
  };

  /// Whether sliding at one speed of the programme is steady on the spring of
  /// the machine, see SteadySliding.
  struct StabilitySummary
  {
    double speed              = 0.; ///< [mm/s]
    double pressure           = 0.; ///< [MPa]
    double friction           = 0.; ///< of steady sliding
    double stiffness          = 0.; ///< of the machine, k [MPa/mm]
    double critical_stiffness = 0.; ///< k_c, 0 to infinity [MPa/mm]
    double critical_frequency = 0.; ///< of the disturbance at k_c [Hz]
    double direction          = 0.; ///< of the motion [deg]

    bool is_stable() const
    {
      return stiffness > critical_stiffness;
    }

    /// Whether a slide is at this speed and pressure.
    bool is_of(const SlideSummary &slide) const;
  };

  /// Estimated error of an adaptive mesh, of the steps that were accepted on it
  /// and looked at; relative, in the norm of the goal.
  struct MeshErrorSummary
  {
    double             tolerance       = 0.; ///< 0: the mesh is not adaptive
    double             last            = 0.;
    double             largest         = 0.;
    double             time_of_largest = 0.; ///< [s]
    unsigned long long n_checked       = 0;  ///< steps
    unsigned long long n_missed        = 0;  ///< with more than the tolerance

    /// In words, by how much and how often the mesh missed its tolerance, or ""
    /// if it never did.
    std::string missed() const;

    /// For boost::serialization.
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &tolerance &last &largest &time_of_largest &n_checked &n_missed;
    }
  };

  /// How much of the contact face was open at worst.
  struct OpeningSummary
  {
    double share = 0.; ///< of the nominal area
    double time  = 0.; ///< [s]

    /// Round-off of sums of areas opens nothing.
    bool has_happened() const
    {
      return share > 1e-9;
    }
  };

  /// The content of summary.json.
  ///
  /// Of a resumed run, times add up what led to the result: sessions up to the
  /// checkpoint from which the next one went on, and the last one. Work that
  /// was lost between a checkpoint and the end of a session is not in them.
  struct Summary
  {
    std::string              case_name;
    std::string              label;   ///< of the variant, or ""
    std::string              command; ///< "run" or "point"
    std::vector<std::string> effects;
    std::string              status = "running";    ///< or "finished", "failed"
    std::string              reason;                ///< why it failed
    unsigned int             dimension         = 0; ///< 0 for a contact point
    unsigned long long       cells             = 0;
    unsigned long long       dofs              = 0;
    unsigned int             ranks             = 1;
    unsigned int             steps             = 0;
    unsigned int             rejected_steps    = 0;
    unsigned long long       newton_iterations = 0;
    unsigned long long       linear_iterations = 0;
    unsigned int             sessions          = 1; ///< 1 + resumptions
    /// Of what was done, see CaseIdentity; 0 in results of earlier versions.
    std::uint32_t programme     = 0;
    double        wall_time     = 0.; ///< [s], all sessions
    double        cpu_time      = 0.; ///< [s], all sessions and ranks
    double        peak_memory   = 0.; ///< [MB], all ranks
    double        peak_friction = 0.; ///< largest magnitude
    double        peak_displacement =
      0.; ///< of the drive there, along its first direction [mm]
    bool   is_pushed      = false; ///< by a load, at some time
    double final_friction = 0.;    ///< along the last direction of motion
    double work           = 0.;    ///< [N mm]
    double stored         = 0.;    ///< [N mm]
    double kinetic        = 0.;    ///< part of what is stored [N mm]
    double dissipated     = 0.;    ///< [N mm]
    double balance_error  = 0.;    ///< relative to work
    std::vector<SlideSummary>  slides;
    std::vector<QuantityValue> quantities;
    std::vector<std::string>   probes; ///< of history.csv, what they are
    /// Empty without a spring.
    std::vector<StabilitySummary> stability;
    MeshErrorSummary              mesh_error;
    OpeningSummary                opening;
    std::vector<std::string>      warnings;

    /// Whether a slide is faster or slower than the machine allows to be
    /// steady: then what it ends with is an instant of stick-slip.
    bool is_unstable(const SlideSummary &slide) const;

    /// In words, which share of the work is missing in the energy balance, or
    /// "" if that is at most 1 %.
    std::string missing_energy() const;
  };

  /// Write atomically (a temporary file renamed into place).
  /// @throws RunError if the disk refuses
  void write_summary(const std::filesystem::path &file, const Summary &summary);

  /// @throws InputError if it is missing or not such a file
  Summary read_summary(const std::filesystem::path &file);

  /// Fill peak, final, energy and slides from a history and its programme.
  ///
  /// Every statement that moves is a slide, seen along its own direction, so
  /// that friction of a reverse slide is positive, too; a followed test that
  /// turns round is none. A history that ends
  /// early gives the slides it reached.
  void summarise_history(const std::vector<HistoryRow> &history,
                         const Programme               &programme,
                         Summary                       &summary);

  /// Its energies alone, of a history that is not empty.
  void summarise_energies(const std::vector<HistoryRow> &history,
                          Summary                       &summary);
} // namespace SlipStep

#endif
