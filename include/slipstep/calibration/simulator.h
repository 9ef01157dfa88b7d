// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_calibration_simulator_h
#define slipstep_calibration_simulator_h

#include <slipstep/calibration/campaign.h>
#include <slipstep/utilities/exceptions.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace SlipStep
{
  /// @throws RunError if a signal asked to stop
  void throw_if_stopped();

  /// What @p attempt returns; nothing if it asks for a model that cannot be made
  /// or simulated.
  template <class Attempt>
  auto if_possible(const Attempt &attempt) -> decltype(attempt())
  {
    try
      {
        return attempt();
      }
    catch (const InputError &)
      {}
    catch (const RunError &)
      {
        throw_if_stopped();
      }
    return {};
  }

  /// Do work for 0 to n - 1 side by side on the cores, each writing only what
  /// is its own; the first exception is thrown again.
  /// @throws RunError if a signal asked to stop
  void side_by_side(const std::size_t                             n,
                    const std::function<void(const std::size_t)> &work);

  /// Simulates all tests of a campaign. Each thread of a fit has its own; the
  /// tests of one simulation run side by side on all cores. Tests of the same
  /// motion, as replicates on a good machine are, are simulated once.
  class Simulator
  {
  public:
    explicit Simulator(const Campaign &campaign);

    /// Choose the steps for these scaled values; forgets what correct() found.
    /// @throws InputError if the law refuses them, RunError if a test cannot be
    /// simulated
    /// @param like whose tests take at most a few times fewer steps; none: some
    ///   ten thousand, and more for many rows
    void plan(const std::vector<double> &scaled,
              const Simulator           *like = nullptr);

    /// From now on, add to all simulated curves what is missing from those of
    /// very small steps at these values: their error then is one of second
    /// order, and small as long as the values stay near.
    void correct(const std::vector<double> &scaled);

    /// The same from the curves of another simulator at its values, whose case
    /// differs in effects that are weak still.
    void correct_by(Simulator                 &reference,
                    const std::vector<double> &reference_scaled);

    /// From now on, subtract the curves of another case by the same steps: what
    /// is left is what the cases differ in.
    void subtract(const Parameters &other);

    /// By test, those that are not simulated: their residuals are 0. Empty for
    /// none of them.
    std::vector<bool> is_left_out;

    /// Simulated minus measured friction over noise, all rows of all tests, by
    /// the steps planned.
    /// @throws InputError, RunError
    void residuals(const std::vector<double> &scaled, double *result);

    /// Their sum of squares.
    double misfit(const std::vector<double> &scaled);

    /// d residuals / d scaled by differences, columns of the parameters named,
    /// stored by rows.
    /// @param at residuals(scaled)
    void derivatives(const std::vector<double>       &scaled,
                     const std::vector<unsigned int> &columns,
                     const double                    *at,
                     double                          *result);

    /// The simulated curves of a test at its rows.
    Replay::Curve simulate(const std::vector<double> &scaled,
                           const std::size_t          test);

    /// The condition of the law that a value beside that of a parameter breaks,
    /// in words; "" if there is none.
    /// @param direction -1 for a smaller value, 1 for a larger
    std::string condition_beside(const std::vector<double> &scaled,
                                 const std::size_t          parameter,
                                 const double               direction);

    /// The case with these values.
    const Parameters &with(const std::vector<double> &scaled);

    /// How often all tests were simulated.
    unsigned int n_simulations() const
    {
      return n_done;
    }

    /// Updates of the contact point that one simulation takes.
    std::size_t n_steps() const;

    const Campaign &campaign;

  private:
    /// Simulated minus measured friction of a test over its noise.
    void
    weigh(Replay::Curve curve, const std::size_t number, double *result) const;

    Parameters          parameters;
    std::vector<Replay> replays; ///< one per motion
    /// Numbers of the tests of each motion.
    std::vector<std::vector<std::size_t>> tests_of;
    /// To be added to the curves at the rows of each test; empty for none.
    std::vector<Replay::Curve> corrections;
    unsigned int               n_done = 0;
    std::vector<double>        shifted; ///< residuals, kept to save its memory
  };
} // namespace SlipStep

#endif
