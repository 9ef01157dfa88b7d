#ifndef slipstep_friction_contact_point_h
#define slipstep_friction_contact_point_h

#include <deal.II/base/tensor.h>

#include <array>

namespace SlipStep
{
  struct ContactState;

  /// Something that single effects remember of a contact point.
  struct ContactMemory
  {
    double ContactState::*value;
    /// In files, with its unit.
    const char *name;
  };

  /// Everything a contact point remembers from one step to the next.
  struct ContactState
  {
    /// Tangential traction with which the plane resists the block [MPa];
    /// positive along positive slip.
    dealii::Tensor<1, 2> traction;
    /// Normal traction f_n [MPa], positive in compression, 0 when open.
    double normal_traction = 0.;
    /// Yield level tau_y [MPa].
    double strength = 0.;
    /// Dynamic-loading ratio r = |f_t| / tau_y.
    double loading_ratio = 0.;
    /// Subloading normal ratio r_s.
    double normal_ratio = 0.;
    /// Quasi-static coefficient of friction mu.
    double coefficient = 0.;
    /// Viscoplastic slip path, the integral of lambda [mm].
    double slip_path = 0.;
    /// Viscoplastic slip rate lambda in the step just made [mm/s].
    double slip_rate = 0.;
    /// Energy dissipated per area [MPa mm].
    double dissipation = 0.;

    // What single effects remember, 0 while they are off. None is negative; a
    // change of the mesh averages them.

    /// Temperature of the contact above that of its surroundings [degC].
    double temperature_rise = 0.;
    /// How long what now touches has been in touch, of effect ageing [s].
    double contact_age = 0.;
    /// The same with the renewal length of effect expression [s].
    double hold_time = 0.;

    /// The memories, for those who treat all alike: a new one is added here,
    /// and is then transferred, saved and shown.
    static constexpr std::array<ContactMemory, 3> memories()
    {
      return {{{&ContactState::temperature_rise, "temperature_rise_degC"},
               {&ContactState::contact_age, "contact_age_s"},
               {&ContactState::hold_time, "hold_time_s"}}};
    }

    /// All of it, for boost::serialization.
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &traction &normal_traction &strength &loading_ratio &normal_ratio
        &coefficient &slip_path &slip_rate &dissipation;
      for (const auto memory : memories())
        archive &(this->*memory.value);
    }
  };

  /// What a step of a contact point answers, with its exact linearisation.
  struct ContactResponse
  {
    /// Tangential traction [MPa].
    dealii::Tensor<1, 2> traction;
    /// d traction / d slip increment [MPa/mm], in general unsymmetric.
    dealii::Tensor<2, 2> d_slip;
    /// d traction / d normal traction [1].
    dealii::Tensor<1, 2> d_normal;
    /// Estimated error of the tangential traction made in this step [MPa].
    double error = 0.;
    /// Whether more of the slip increment was viscoplastic than elastic.
    bool slips = false;
  };

  class FrictionLaw;

  /// One point of the contact face: a committed state and a trial state.
  ///
  /// update() always starts from the committed state, so it can be repeated as
  /// often as an iteration needs; commit() accepts the last update, revert()
  /// forgets it.
  class ContactPoint
  {
  public:
    ContactPoint() = default;

    /// A point that has not been loaded yet.
    explicit ContactPoint(const FrictionLaw &law);

    /// Continue from a known state.
    explicit ContactPoint(const ContactState &state);

    /// Make one step.
    /// @param slip_increment slip in the contact plane [mm] since the committed
    ///   state
    /// @param normal_traction f_n at the end of the step [MPa]; not positive
    ///   means open
    /// @param time_step [s], greater than 0
    ContactResponse update(const FrictionLaw          &law,
                           const dealii::Tensor<1, 2> &slip_increment,
                           const double                normal_traction,
                           const double                time_step);

    void commit()
    {
      committed_state = trial_state;
    }

    void revert()
    {
      trial_state = committed_state;
    }

    const ContactState &committed() const
    {
      return committed_state;
    }

    const ContactState &trial() const
    {
      return trial_state;
    }

    /// Both states, for boost::serialization.
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &committed_state &trial_state;
    }

  private:
    ContactState committed_state;
    ContactState trial_state;
  };
} // namespace SlipStep

#endif
