// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_experiment_history_h
#define slipstep_experiment_history_h

#include <slipstep/friction/contact_state.h>
#include <slipstep/utilities/exceptions.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace SlipStep
{
  /// Columns of probes that a history can have.
  constexpr std::size_t most_probes = 99;

  /// Mean over the contact (weighted by normal load) and extremes.
  struct Spread
  {
    double mean    = 0.;
    double minimum = 0.;
    double maximum = 0.;
  };

  /// One row of history.csv: the state at the end of a step. A run on one
  /// contact point and a run of the block fill the same columns.
  struct HistoryRow
  {
    double time            = 0.; ///< [s]
    double displacement    = 0.; ///< of the drive, first tangential axis [mm]
    double pressure        = 0.; ///< normal load / nominal contact area [MPa]
    double friction        = 0.; ///< tangential / normal load; > 0 resists
    double displacement_y  = 0.; ///< second tangential axis [mm]
    double friction_y      = 0.;
    double normal_load     = 0.;   ///< [N]
    double tangential_load = 0.;   ///< first tangential axis [N]
    Spread loading_ratio;          ///< r
    Spread normal_ratio;           ///< r_s
    Spread coefficient;            ///< mu
    double slip_fraction     = 0.; ///< share of the area in contact that slips
    double dissipated_energy = 0.; ///< [N mm]
    /// In block, contact stiffness and machine, kinetic energy included [N mm].
    double       stored_energy     = 0.;
    double       external_work     = 0.; ///< [N mm]
    double       step_size         = 0.; ///< [s]
    unsigned int newton_iterations = 0;
    unsigned int linear_iterations = 0;
    double       slip              = 0.; ///< mean slip path of the contact [mm]
    double kinetic_energy = 0.; ///< of the block and the machine's mass [N mm]
    /// Mean of what effects remember, as ContactState::memories.
    std::array<double, ContactState::most_memories> memories{};
    /// Quantities of interest on the contact face, see "Output/Quantities".
    std::vector<double> probes;
  };

  /// The column of a probe, counted from 0.
  std::string probe_name(const std::size_t i);

  /// Writes history.csv, complete after every row, every number with as many
  /// digits as it takes to read back exactly.
  ///
  /// Columns: time_s, displacement_mm, pressure_MPa, friction,
  /// displacement_y_mm, friction_y, normal_load_N, tangential_load_N, r_mean,
  /// r_min, r_max, r_s_mean, r_s_min, r_s_max, mu_mean, mu_min, mu_max,
  /// slip_fraction, dissipated_energy_Nmm, stored_energy_Nmm,
  /// external_work_Nmm, step_s, newton_iterations, linear_iterations, slip_mm,
  /// kinetic_energy_Nmm; then of contact_memories() those that the effects of
  /// the law use (contact_age_s, temperature_rise_degC, ...), then probe_1,
  /// probe_2, ..., which summary.json explains. A header and rows, no more, as
  /// every reader of tables wants it; it can be read back as a measured test.
  class HistoryWriter
  {
  public:
    HistoryWriter() = default;

    /// @param memories which memories of a row are written
    /// @param n_probes of every row
    /// @throws InputError if the file cannot be created, RunError if the disk
    ///   is full
    HistoryWriter(const std::filesystem::path      &file,
                  const std::vector<ContactMemory> &memories = {},
                  const std::size_t                 n_probes = 0);

    /// Continue a file, which is cut after its first @p bytes.
    /// @throws RunError if that fails
    HistoryWriter(const std::filesystem::path      &file,
                  const std::uintmax_t              bytes,
                  const std::vector<ContactMemory> &memories);

    /// @throws RunError if the row cannot be written (disk full); the file then
    ///   ends with the row before
    void write(const HistoryRow &row);

    /// Size of the file, with all complete rows.
    std::uintmax_t bytes() const
    {
      return size;
    }

  private:
    std::ofstream              out;
    std::filesystem::path      file;
    std::vector<ContactMemory> memories;
    std::uintmax_t             size = 0; ///< of the file, all complete rows
  };

  /// Read a history.csv back, without a last row that a kill cut off.
  /// @param warnings if given, gets a line for each column, but for probes, that
  ///   has numbers which are not finite; no run writes such
  /// @throws InputError naming file:line
  std::vector<HistoryRow>
  read_history(const std::filesystem::path &file,
               std::vector<std::string>    *warnings = nullptr);
} // namespace SlipStep

#endif
