// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_experiment_step_control_h
#define slipstep_experiment_step_control_h

#include <slipstep/experiment/programme.h>
#include <slipstep/friction/law.h>

#include <string>
#include <vector>

namespace SlipStep
{
  /// What to say where no time step is small enough and the law has effects
  /// with which friction can fall at once; else "".
  std::string words_of_sudden_effects(const FrictionLaw &law);

  /// Chooses the time steps of a programme from the error that the friction law
  /// estimates, for a contact point and for the block alike.
  ///
  /// The estimate grows with the square of the step, so the next step is
  /// step * sqrt(tolerance / error), within limits. Steps
  /// end exactly at the borders of the programme's segments; after a border the
  /// step starts anew, small enough for the elastic part of the contact. Steps
  /// are taken from a fixed series of numbers (ten per decade), so that
  /// round-off cannot change them.
  ///
  /// Alternatively every segment has a stated number of equal steps, whatever
  /// the error: for studies of convergence.
  class StepControl
  {
  public:
    static void declare_parameters(Parameters &parameters);

    /// The keys that "Equal steps per statement" makes idle.
    static std::vector<std::string> idle_keys(const Parameters &parameters);

    /// @throws InputError for a value other than the default that is idle
    StepControl(const Parameters  &parameters,
                const Programme   &programme,
                const FrictionLaw &law);

    /// Try a step of another length, unless all of them shall be equal.
    void plan_anew(const double step);

    bool is_finished() const;

    /// Time at the beginning of the step [s].
    double time() const
    {
      return begin;
    }

    /// Time at the end of the step to be tried [s].
    double end_of_step() const
    {
      return end;
    }

    double step_size() const
    {
      return end - begin;
    }

    /// A step no longer than this may not be cut once more [s].
    double shortest_step() const
    {
      return 8. * resolution();
    }

    /// Whether the step is the first of a segment of the programme, where
    /// extrapolating from the last step makes no sense.
    bool is_first_of_segment() const
    {
      return first_of_segment;
    }

    /// Whether the step is the first of a statement of the programme.
    bool is_first_of_statement() const;

    /// Error of a step that is neither too long nor too short.
    double wanted_error() const
    {
      return tolerance;
    }

    /// What accept() would answer.
    bool would_accept(const double error) const;

    /// Judge a step by the measure of its estimated error: go on to the next
    /// and return true, or ask for the same again, smaller, and return false.
    /// @param remedy to be said where no step is small enough
    /// @throws RunError if the statement takes too many steps, or too small
    /// ones
    bool accept(const StepError &estimate, const std::string &remedy = "");

    /// The step could not be made: try a smaller one.
    /// @throws RunError with @p reason if it is too small already
    void cut(const std::string &reason);

    /// What to warn of: steps at rest so long that friction is off; else "".
    std::string warning() const;

    /// A swing of the machine's mass was lost in the first step of a segment.
    /// @param share of the strength
    void note_lost_swing(const double share, const double time);

    /// Of the largest one; "" if none is worth a word.
    std::string warning_of_swing() const;

    unsigned int n_accepted() const
    {
      return accepted;
    }

    /// How often the present step was made shorter.
    unsigned int n_tries() const
    {
      return tries;
    }

    unsigned int n_rejected() const
    {
      return rejected;
    }

    /// Where it is, for boost::serialization; what the case says is not part of
    /// it.
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &segment &begin &end &largest_step &first_step &full_step
        &first_of_segment &accepted &rejected &tries &smallest_step
          &steps_of_statement &rows_of_statement &largest_error &time_of_largest
            &lost_swing &time_of_swing;
    }

  private:
    void start_segment();
    void count_step();
    void plan(const double wanted_step);
    /// The least step that is tried [s].
    double resolution() const;
    void   shrink(const double wanted_step, const std::string &reason);

    const Programme    programme;
    const double       tolerance;
    const double       first_slip;
    const unsigned int least_steps;
    const unsigned int equal_steps; ///< per statement, 0 for adaptive ones
    const unsigned int most_steps;  ///< per statement
    const double       least_step;  ///< relative to the statement
    const double       elastic_slip_per_pressure;
    const std::string  sudden; ///< words_of_sudden_effects()

    std::size_t  segment          = 0;
    double       begin            = 0.;
    double       end              = 0.;
    double       largest_step     = 0.;
    double       first_step       = 0.; ///< of the statement
    double       full_step        = 0.; ///< wanted, before clipping to borders
    bool         first_of_segment = true;
    unsigned int accepted         = 0;
    unsigned int rejected         = 0;
    unsigned int tries            = 0; ///< of the step, that were rejected
    double       smallest_step    = 0.;
    unsigned int steps_of_statement = 0;  ///< tried
    unsigned int rows_of_statement  = 0;  ///< of a test that is followed
    double       largest_error      = 0.; ///< at the end of a step at rest
    double       time_of_largest    = 0.; ///< its end [s]
    double       lost_swing         = 0.; ///< the largest, of the strength
    double       time_of_swing      = 0.; ///< [s]
  };
} // namespace SlipStep

#endif
