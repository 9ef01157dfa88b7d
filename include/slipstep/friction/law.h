// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_friction_law_h
#define slipstep_friction_law_h

#include <slipstep/friction/effect.h>
#include <slipstep/friction/two_stages.h>

#include <array>
#include <ostream>
#include <set>
#include <string>
#include <vector>

namespace SlipStep
{
  /// The subloading-overstress friction law: effects around one core.
  ///
  /// The contact traction has a normal part f_n and a tangential part f_t,
  /// bounded by the yield level
  /// \f[ \tau_y = s\,(f_n\,\mu\,G_1 G_2\cdots + c_1 + c_2 + \cdots), \qquad
  ///     r = |f_t| / \tau_y, \f]
  /// where s, ContactState::strength_factor, is 1 unless the face has a map,
  /// and changes with the elastic part of the sliding velocity, \f$\dot f_t =
  /// \alpha_t (V - \lambda f_t/|f_t|)\f$. The viscoplastic slip rate
  /// \f$\lambda\f$ follows from the flow rule (Overstress; without it r = r_s),
  /// the normal ratio r_s grows with slip (Subloading; without it r_s = 1) and
  /// falls with r, and mu evolves with slip and time (Softening, Healing).
  /// ElasticCore changes from where r and r_s are measured.
  ///
  /// update() makes one implicit stage (TwoStages) by backward Euler: the
  /// traction stays along its elastic trial, which leaves one scalar unknown,
  /// the slip in the stage, bracketed by 0 and |f_trial| / alpha_t. Strength
  /// that falls with slip or speed gives it several roots; the one that goes on
  /// as the contact did before is taken. With Anisotropy this holds in the
  /// metric of its ellipse, in which |f_t| and lambda are then measured, and
  /// alpha_t is the stiffness along the first axis; the slip path is that over
  /// the plane. Immutable: one law serves all points.
  class FrictionLaw
  {
  public:
    static void declare_parameters(Parameters &parameters);

    /// @throws InputError for unknown or conflicting effects, values given to
    /// an effect that is off, and coefficients that contradict each other
    explicit FrictionLaw(const Parameters &parameters);

    /// State of a point that has not been loaded yet.
    ContactState initial_state() const;

    /// One stage from @p start; the result depends on the arguments only.
    /// @param[out] end state at the end of the stage
    ContactResponse update(const StageStart           &start,
                           const dealii::Tensor<1, 2> &slip_increment,
                           const double                normal_traction,
                           const double                time_step,
                           ContactState               &end) const;

    /// A step of backward Euler: one stage from a state.
    ContactResponse update(const ContactState         &start,
                           const dealii::Tensor<1, 2> &slip_increment,
                           const double                normal_traction,
                           const double                time_step,
                           ContactState               &end) const
    {
      return update(
        StageStart(start), slip_increment, normal_traction, time_step, end);
    }

    /// Where the second stage starts after the first of a step from @p start.
    StageStart second_stage(const ContactState &start,
                            const StageRecord  &first) const;

    /// How far two stages are from one: the estimated error of a step, seen by
    /// traction, mu, r_s and the memories, of which the last count as much as
    /// they change the strength.
    /// @param start of the step
    /// @param second where its second stage started
    /// @param compliance of a spring in series with the contact [mm/MPa]
    StepError step_error(const ContactState &start,
                         const StageRecord  &first,
                         const StageStart   &second,
                         const StageRecord  &last,
                         const double        compliance = 0.) const;

    /// Make a state consistent that comes from averaging or interpolating
    /// others: r follows from traction and strength, r_s obeys r_s <= r (and
    /// equals it without overstress), an open point carries no traction.
    void complete(ContactState &state) const;

    /// Whether friction depends on how fast the contact slips.
    bool is_rate_dependent() const
    {
      return flow != &neutral || depends_on_rate;
    }

    /// Least upper bound of r.
    double maximum_ratio() const
    {
      return flow->maximum_ratio() +
             (flow == &neutral ? 0. : core->core_limit());
    }

    /// Whether the elastic core that a state remembers is within its limit.
    bool admits_core(const ContactState &state) const
    {
      return core->core(state).centre.norm() <=
             (1. + 1e-12) * core->core_limit();
    }

    /// What the elastic core remembers; nothing without one.
    std::vector<ContactMemory> core_memories() const
    {
      return core->memories();
    }

    /// The smallest and the largest mu that can be reached from the initial
    /// one.
    const std::array<double, 2> &coefficient_range() const
    {
      return range_of_coefficient;
    }

    /// Depth that the block loses per normal traction and slip [1/MPa].
    double wear_rate() const;

    double normal_stiffness() const ///< alpha_n [MPa/mm]
    {
      return alpha_n;
    }

    double tangential_stiffness() const ///< alpha_t [MPa/mm]
    {
      return alpha_t;
    }

    /// The traction of an isotropic law with the same r: its norm is the |f_t|
    /// of the formulas. Without an anisotropy the traction itself.
    dealii::Tensor<1, 2>
    isotropic_traction(const dealii::Tensor<1, 2> &traction) const
    {
      return is_anisotropic ? inverse_cone * traction : traction;
    }

    /// d traction / d slip increment while nothing slips [MPa/mm].
    dealii::Tensor<2, 2> elastic_tangent() const
    {
      return alpha_t * cone * cone;
    }

    /// Slip [mm] that goes back if the traction does.
    dealii::Tensor<1, 2>
    elastic_slip(const dealii::Tensor<1, 2> &traction) const
    {
      return true_slip(isotropic_traction(traction) / alpha_t);
    }

    /// Energy stored per area in the tangential stiffness and the elastic core
    /// [MPa mm].
    double stored_energy(const ContactState &state) const
    {
      return isotropic_traction(state.traction).norm_square() / (2. * alpha_t) +
             core->core(state).energy;
    }

    /// Quasi-static mu of a point at rest since ever.
    double static_coefficient() const
    {
      return basis.static_coefficient;
    }

    /// r in steady sliding at a speed [mm/s].
    double steady_ratio(const double speed) const
    {
      return flow->steady_ratio(speed);
    }

    /// Names of the active effects by which a contact in steady sliding gets
    /// weaker when it slips faster.
    std::vector<std::string>
    weakening_effects(const ContactState &steady) const;

    /// Names of the active effects, in the order of the catalogue.
    const std::vector<std::string> &effects() const
    {
      return names;
    }

    /// Whether an effect is active.
    bool has(const std::string &effect) const
    {
      return std::find(names.begin(), names.end(), effect) != names.end();
    }

    /// What the active effects remember, in the order of
    /// contact_memories().
    std::vector<ContactMemory> memories() const;

    /// Move a point that is off the plane to another place, by a way along it
    /// [mm].
    void carry(const dealii::Tensor<1, 2> &way, ContactState &state) const;

    /// Sections of effects that are off, such as "Friction/healing".
    std::set<std::string> inactive_sections() const;

    /// Whether there is an elastic core: then the traction may be beyond its
    /// elastic trial, and beside it.
    bool has_core() const
    {
      return core != &neutral;
    }

  private:
    struct LocalSystem;

    /// What the active effects make of the strength f_n mu: their factors, and
    /// what they add, times ContactState::strength_factor.
    struct Contributions
    {
      Strength factor{1., 0., 0., {}}, sum;
    };

    // A stage.
    ContactResponse isotropic_update(const StageStart           &start,
                                     const dealii::Tensor<1, 2> &slip_increment,
                                     const double  normal_traction,
                                     const double  time_step,
                                     ContactState &end) const;
    void            open(const dealii::Tensor<1, 2> &slip_increment,
                         const double                normal_traction,
                         LocalSystem                &local,
                         ContactState               &end) const;
    SlipStepData    step_data(const LocalSystem &local) const;
    SlipStepData    step_data(const ContactState &start,
                              const ContactState &end,
                              const double        slip,
                              const double        time_step) const;
    double          strength_at_rest(const LocalSystem &local) const;
    void            stick(LocalSystem &local) const;
    void            start_ratio(const double       start_strength,
                                const LocalSystem &end,
                                LocalSystem       &local) const;
    double          smallest_ratio(const dealii::Tensor<1, 2> &traction,
                                   const dealii::Tensor<1, 2> &increment,
                                   const double                strength,
                                   const double                end_strength,
                                   const dealii::Tensor<1, 2> &centre,
                                   double                     &where) const;
    Contributions   contributions(const SlipStepData &step) const;
    void            evolve_coefficient(LocalSystem &local) const;
    void            evolve_strength(LocalSystem &local) const;
    void            evaluate(const double traction, LocalSystem &local) const;
    void            evaluate_flow(LocalSystem &local) const;
    bool            must_slip(const LocalSystem &local) const;
    void            find_slip(LocalSystem &local) const;
    double          expected_traction(const LocalSystem &local) const;
    bool            slide_on(LocalSystem &local) const;
    bool            follow_branch(LocalSystem &local) const;
    void            leave_sticking(LocalSystem &local) const;
    void
    solve(const double lower, const double upper, LocalSystem &local) const;
    bool approach_root(double lower, double upper, LocalSystem &local) const;
    ContactResponse linearise(const LocalSystem &local) const;

    // With an elastic core.
    struct Similarity;
    struct CoreChange;
    static Similarity similarity(const dealii::Tensor<1, 2> &traction,
                                 const double                strength,
                                 const dealii::Tensor<1, 2> &centre);
    static double
               smallest_similarity_ratio(const dealii::Tensor<1, 2> &traction,
                                         const dealii::Tensor<1, 2> &increment,
                                         const double                strength,
                                         const double                end_strength,
                                         const dealii::Tensor<1, 2> &centre,
                                         double                     &where);
    void       extend_reach(LocalSystem &local) const;
    void       find_forward(LocalSystem &local) const;
    void       place_core(LocalSystem &local) const;
    void       evaluate_with_core(LocalSystem &local) const;
    CoreChange core_change(const LocalSystem          &local,
                           const double                d_slip,
                           const dealii::Tensor<1, 2> &d_trial,
                           const double                d_normal_ratio,
                           const double                d_strength) const;
    CoreChange core_change(const LocalSystem          &local,
                           const double                d_slip,
                           const dealii::Tensor<1, 2> &d_trial,
                           const double                d_normal) const;
    ContactResponse linearise_with_core(const LocalSystem &local) const;
    ElasticCore     moved_core(const ContactState         &start,
                               const double                strength,
                               const dealii::Tensor<1, 2> &normal,
                               const double                slip) const;
    void            complete_with_core(ContactState &state) const;
    double          error_of_core(const ContactState &start,
                                  const StageRecord  &last) const;

    // A step of two stages.
    double error_of_traction(const ContactState &start,
                             const StageRecord  &first,
                             const StageRecord  &last,
                             const double        compliance) const;
    double error_of_coefficient(const ContactState &start,
                                const StageRecord  &first,
                                const StageStart   &second,
                                const StageRecord  &last) const;
    double error_of_memories(const ContactState &start,
                             const StageRecord  &first,
                             const StageRecord  &last) const;
    double error_of_flow_rate(const ContactState &start,
                              const StageRecord  &last) const;
    double error_of_normal_ratio(const ContactState &start,
                                 const StageRecord  &first,
                                 const StageRecord  &last) const;

    dealii::Tensor<1, 2> direction_of(const ContactState &state) const;
    dealii::Tensor<1, 2> slip_normal(const ContactState &state) const;

    dealii::Tensor<1, 2>
    slip_direction(const dealii::Tensor<1, 2> &direction) const;
    dealii::Tensor<1, 2> true_slip(const dealii::Tensor<1, 2> &slip) const;
    dealii::Tensor<1, 2> pull_back(const dealii::Tensor<1, 2> &gradient,
                                   const dealii::Tensor<1, 2> &direction) const;

    Rate coefficient_rate_per_slip(const double coefficient) const;
    Rate coefficient_rate_per_time(const double coefficient) const;
    void create_effects(const Parameters &parameters, const bool flow_rule);

    std::array<double, 2> find_coefficient_range() const;

    const double     alpha_n;
    const double     alpha_t;
    CoefficientBasis basis;
    double           initial_coefficient;

    std::array<double, 2> range_of_coefficient;

    std::vector<std::string>               names;
    std::vector<std::unique_ptr<Effect>>   active; ///< in the order of names
    std::vector<const CoefficientEffect *> coefficient_effects; ///< of those
    std::vector<const StrengthEffect *>    strength_effects;    ///< of those

    /// Owners of the exclusive slots; the neutral effect where there is none.
    const Effect *normal_ratio = &neutral;
    const Effect *flow         = &neutral;
    const Effect *core         = &neutral;

    /// What gives the flow rule its rate; the neutral effect gives the present.
    const Effect *rate_memory = &neutral;

    bool depends_on_rate = false;

    bool                 is_anisotropic = false;
    dealii::Tensor<2, 2> cone, inverse_cone; ///< unity without anisotropy

    static const Effect neutral;
  };

  /// The catalogue: every registered effect with formula, parameters, units,
  /// bounds, neutral value and source; or the effects of these names.
  /// @throws InputError if there is none of a name
  void print_effects(std::ostream                   &out,
                     const bool                      as_markdown = false,
                     const std::vector<std::string> &names       = {});
} // namespace SlipStep

#endif
