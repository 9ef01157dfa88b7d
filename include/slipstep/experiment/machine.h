#ifndef slipstep_experiment_machine_h
#define slipstep_experiment_machine_h

#include <slipstep/friction/law.h>

namespace SlipStep
{
  /// The machine that moves a contact point: a spring in series, the same in
  /// all directions of the contact plane.
  ///
  /// The programme moves the load point at its far end by U; the contact slips
  /// by u, and carries what the spring carries,
  /// \f[ f_t = k (U - u). \f]
  /// That belongs to the experiment: the friction law knows nothing of it. Slip
  /// and spring are found together, at the end of the step, so a soft spring on
  /// a weakening contact jumps instead of oscillating.
  class Machine
  {
  public:
    static void declare_parameters(Parameters &parameters);

    /// A rigid machine, of which U = u.
    Machine() = default;

    /// @throws InputError
    explicit Machine(const Parameters &parameters);

    bool is_rigid() const
    {
      return compliance == 0.;
    }

    /// One step of a contact point, with its tangent for slip of the contact.
    /// @param load_point_increment motion of the load point [mm]
    /// @param normal_traction at the end of the step [MPa]
    /// @param time_step [s]
    ContactResponse update(const FrictionLaw          &law,
                           ContactPoint               &point,
                           const dealii::Tensor<1, 2> &load_point_increment,
                           const double                normal_traction,
                           const double                time_step) const;

    /// Slip of the contact [mm] while the load point moves and the traction
    /// changes.
    dealii::Tensor<1, 2>
    contact_slip(const dealii::Tensor<1, 2> &load_point_increment,
                 const dealii::Tensor<1, 2> &traction_change) const
    {
      return load_point_increment - compliance * traction_change;
    }

    /// Energy stored per area in the spring [MPa mm].
    double stored_energy(const dealii::Tensor<1, 2> &traction) const
    {
      return compliance / 2. * traction.norm_square();
    }

  private:
    double compliance = 0.; ///< c = 1 / k [mm/MPa]
  };
} // namespace SlipStep

#endif
