// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_solid_block_h
#define slipstep_solid_block_h

#include <deal.II/distributed/tria.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/fe/fe_system.h>

#include <deal.II/lac/affine_constraints.h>

#include <slipstep/experiment/history.h>
#include <slipstep/experiment/programme.h>
#include <slipstep/experiment/step_control.h>
#include <slipstep/experiment/summary.h>
#include <slipstep/solid/block_output.h>
#include <slipstep/solid/block_parameters.h>
#include <slipstep/solid/contact_face.h>
#include <slipstep/solid/drive.h>
#include <slipstep/solid/inertia.h>
#include <slipstep/solid/mesh_marker.h>
#include <slipstep/solid/linear_solver/tangent_system.h>

#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

namespace SlipStep
{
  // @sect3{The class Block}

  // The class declaration is the table of contents of this program. A block is
  // made from what the case file says; run() goes through the programme step by
  // step. The functions come in the order in which they are called: mesh,
  // unknowns, constraints and loads are set up once, then every time step is a
  // Newton iteration.
  //
  // The unknown is the displacement relative to a frame which moves with the
  // drive. In this frame the driven face stands still and the plane slides
  // underneath: nothing grows with the length of the slide, so 300 mm of
  // sliding cost no digits of an elastic displacement of 100 nm, and the last
  // displacement is a good first guess for the next.

  /// What an observer sees of a block after a step; to be asked for anew after
  /// the next. References hold as long as the block.
  template <int dim>
  struct BlockState
  {
    const dealii::DoFHandler<dim> &unknowns;
    /// Ghosted, relative to the frame [mm].
    const Vector &displacements;
    /// Motion of the frame, along the axes of the block [mm].
    dealii::Tensor<1, dim>  frame_motion;
    const ContactFace<dim> &contact_face;
    const Drive            &drive;
    const StepControl      &control;
    /// Estimated error of the meshes of accepted steps.
    const MeshErrorSummary &mesh_error;
    /// What the mesh did so far.
    const std::vector<MeshChange> &mesh_changes;
    /// Norms of the unbalanced forces in the Newton iterations of the last step
    /// tried, relative to the scale of the convergence test.
    const std::vector<double> &newton_residuals;
    /// Largest difference met between the contact forces and the sum of loads
    /// and support reactions, relative to the normal load.
    double force_imbalance;
  };



  /// What acts on the block through a face: reactions of its supports and of
  /// the drive, its loads, and the contact. In 2-D per mm of thickness.
  struct FaceAction
  {
    dealii::Tensor<1, 3> force;  ///< [N]
    dealii::Tensor<1, 3> moment; ///< about the centre of the face [N mm]
  };



  /// An elastic block pressed on a rigid plane and slid; see the page "The
  /// commented program".
  template <int dim>
  class Block
  {
  public:
    Block(const BlockParameters &parameters,
          const FrictionLaw     &law,
          const Programme       &programme,
          const StepControl     &control,
          const MPI_Comm        &communicator,
          const Machine         &machine = Machine());

    /// Go through the programme.
    /// @param output where fields are written, or nullptr for none
    /// @param observe called on all ranks with the row of every accepted step
    /// @param between_steps called on all ranks when all of a step is done, or
    ///   when it is about to be made again: the moment to save()
    /// @param gives_up_step asked on all ranks before every linear system:
    ///   whether to leave the step undone and call between_steps
    /// @throws RunError with the reason if the programme cannot be finished
    void run(BlockOutput<dim>                              *output,
             const std::function<void(const HistoryRow &)> &observe,
             const std::function<void()>                   &between_steps = {},
             const std::function<bool()>                   &gives_up_step = {});

    /// Save what is needed to go on after the last step: every rank writes
    /// `cells.N`, N its number (mesh, displacements, contact states), one also
    /// `block`.
    /// @return the names of the files this rank wrote
    /// @throws RunError if the disk refuses; not on all ranks alike
    std::vector<std::string> save(const std::filesystem::path &folder) const;

    /// Take over what save() wrote, on any number of ranks; run() then goes on
    /// as if nothing had happened.
    /// @param n_files the number of ranks that wrote it
    /// @return whether the cells are distributed as they were, so that results
    ///   are the same bit for bit
    /// @throws InputError if it does not fit this block
    bool load(const std::filesystem::path &folder, const unsigned int n_files);

    /// Numbers that go with the state, for boost::serialization; vectors and
    /// contact points are the matter of save() and load().
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &control &old_step &n_newton_total &n_linear_total &external_work
        &largest_imbalance &largest_normal_load &contact_share &worn_depth
          &worn_depth_at_start &cells_across &largest_contact_share &opening
            .share &steps_since_check &most_cells_wanted &largest_jump
              &mesh_changes &mesh_is_new &tolerance &solver_in_use
                &n_solver_failures &first_solver_failure &opening
            .time &drive &damped_energy &lean.share &lean.moment_of_load &lean
            .moment_of_friction;
    }

    /// Cells, unknowns and iterations so far.
    void fill(Summary &summary) const;

    /// The block after the last step.
    BlockState<dim> state() const;

    /// What acts on the block through one of its faces at the end of the step
    /// just made; all ranks take part.
    FaceAction action_on(const unsigned int face) const;

  private:
    // Setting up.
    void make_grid();
    void setup_system();
    void setup_unknowns();
    void find_supports();
    void constrain(Vector &displacement) const;
    void find_groups_of_unknowns();
    void check_map_of_strength();
    void assemble_tractions(const std::function<dealii::Tensor<1, 3>(
                              const dealii::types::boundary_id)> &traction_on,
                            Vector                               &load) const;
    void assemble_loads();

    // Linear systems.
    void         choose_solver();
    unsigned int solve_linear_system(Vector &update, const double tolerance);
    void         count_linear_iterations(const unsigned int n);
    void         note_failure_of_solver();
    bool         take_next_solver(std::string &failures);
    void         begin_with_first_solver();

    // Another mesh during the run.
    bool        adapt_to_trial(BlockOutput<dim> *output);
    bool        is_time_to_check() const;
    void        adapt_after_step(BlockOutput<dim> *output);
    MarkedCells mark_cells();
    void        change_mesh(const MarkedCells &marked,
                            const bool         repeats_step,
                            BlockOutput<dim>  *output);
    void        transfer_to_new_mesh();
    bool        find_equilibrium_at_start();

    // One time step.
    bool       make_step();
    void       begin_stage(const double end_time, const double time_step);
    bool       finish_stage(const double weight);
    void       predict();
    bool       is_put_down() const;
    bool       bring_to_touch();
    bool       settle();
    void       add_loads(const double factor, Vector &vector) const;
    void       impose_displacements();
    bool       solve_stage();
    double     compute_residual();
    double     least_force_scale() const;
    double     newton_tolerance() const;
    double     wanted_norm() const;
    void       forget_iterations();
    bool       only_round_off_is_left() const;
    double     linear_tolerance(const double norm) const;
    double     share_of_uphill_update();
    double     line_search(const Vector               &update,
                           const dealii::Tensor<1, 2> &motion,
                           const double                old_norm);
    StepError  error_of_step(const ContactTotals &totals);
    double     error_of_wear(const ContactTotals &totals) const;
    bool       wears_at_held_approach() const;
    HistoryRow accept_step(const ContactTotals &totals, const double step_size);

    // Inertia of the body.
    const Vector          &strained_displacement();
    dealii::Tensor<1, dim> frame_motion_in_stage() const;
    double                 damped_energy_of_stage();
    dealii::Tensor<1, 2>   let_through(const dealii::Tensor<1, 2> &on_drive,
                                       Vector                     &forces);
    double                 error_of_motion(const ContactTotals &totals);
    std::vector<Vector *>  fields_of_state();

    // The drive, where its displacement is an unknown.
    void move_frame_to(const dealii::Tensor<1, 2> &displacement);
    void find_driven_unknowns();
    dealii::Tensor<1, 2> force_on_drive(const Vector &forces) const;
    dealii::Tensor<1, 2> force_missing_on_drive() const;
    void                 begin_modes();
    dealii::Tensor<1, 2>
    yielding_of_drive(const dealii::Tensor<1, 2> &force) const;
    dealii::Tensor<1, 2> move_drive(Vector &update);
    void                 compute_force_changes(const Vector               &displacement,
                                               const dealii::Tensor<1, 2> &frame,
                                               Vector                     &changes) const;

    // Checkpoints.
    void restore_mesh(const std::filesystem::path &folder,
                      const unsigned int           n_files);
    void restore_cells(const std::filesystem::path &folder,
                       const unsigned int           n_files);

    // What an accepted step did to the energy and to the balance of forces.
    double                 work_of_stage();
    void                   check_balance_of_forces();
    void                   note_lean(const ContactTotals &totals);
    dealii::Tensor<1, dim> sum_by_component(const Vector &forces) const;
    double                 elastic_energy();

    // What the user is told.
    void                     check_contact(const ContactTotals &totals);
    void                     check_small_strains();
    bool                     tips_over() const;
    std::string              reason_of_failure() const;
    std::string              remedy_of_jumps() const;
    std::string              remedy_of_proportional_loads() const;
    std::string              warning_of_loads() const;
    std::string              warning_of_pressure() const;
    std::string              warning_of_penetration() const;
    std::string              warning_of_opening() const;
    std::string              warning_of_lean() const;
    std::string              warning_of_few_cells() const;
    std::string              warning_of_wear() const;
    std::string              warning_of_solver() const;
    std::vector<std::string> warnings() const;

    // Constant through the run.
    const BlockParameters parameters;
    const Programme       programme;
    const MPI_Comm        communicator;

    // Mesh and unknowns.
    dealii::parallel::distributed::Triangulation<dim> triangulation;
    unsigned int least_level = 0; // that of the subdivisions asked for
    const dealii::FESystem<dim>       fe;
    dealii::DoFHandler<dim>           dof_handler;
    dealii::IndexSet                  relevant;
    dealii::AffineConstraints<double> hanging_constraints;
    dealii::AffineConstraints<double> homogeneous_constraints;

    // Locally owned unknowns by displacement component.
    std::array<std::vector<dealii::types::global_dof_index>, dim>
      dofs_of_component;
    // Those of them whose displacement is prescribed.
    std::array<std::vector<dealii::types::global_dof_index>, dim>
      supported_dofs;
    // Likewise of the driven faces, by direction of the contact plane.
    std::array<std::vector<dealii::types::global_dof_index>, dim - 1>
      driven_dofs;

    // Contact and linear algebra.
    ContactFace<dim>                    contact;
    std::unique_ptr<TangentSystem<dim>> system;
    bool                                is_linearised = false;
    SolverType solver_in_use = SolverType::automatic; // not chosen yet
    // Of geometric and of algebraic multigrid.
    std::array<unsigned long long, 2> n_solver_failures{};
    double                            first_solver_failure = 0.; // [s]

    // The loading: its parts, how long those that act at once take to do so
    // [s], and how much of each acts at the end of the present stage.
    Inertia<dim>                       inertia;
    std::array<LoadCase, n_load_parts> load_cases;
    double                             first_step;
    LoadFactors                        load_factors = {};
    // Mean motion along the plane of the face across from the contact face
    // against that, as a dot product with displacements.
    std::array<FaceVector, dim - 1> head_against_foot;

    // State: displacements at the end and the beginning of the step, and one
    // step before that.
    StepControl control;
    Vector      solution;
    Vector      old_solution;
    Vector      older_solution;
    double      old_step = 0.;
    Loading     old_loading, loading;

    // The present stage of the step: where it starts, and how long it takes
    // [s].
    Vector               stage_solution;
    dealii::Tensor<1, 2> stage_frame;
    double               stage_time          = 0.;
    double               trial_work          = 0.; // of the step [N mm]
    double               trial_damped_energy = 0.; // likewise, by viscosity

    // The drive; how the block follows it where that is unknown, the forces
    // that has to balance, and how block and contact resist it [N/mm].
    Drive                       drive;
    std::array<Vector, dim - 1> drive_modes;
    std::array<double, dim - 1> mode_scale;
    dealii::Tensor<2, 2>        drive_springs;

    // Newton's method in the present step.
    struct NewtonRecord
    {
      double              force_scale  = 0.;
      double              drive_weight = 0.; // of forces of the drive therein
      std::vector<double> residual_norms;
      unsigned int        n_iterations = 0, n_linear = 0;
      unsigned int        n_uphill = 0; // updates of a stage that never helped
      std::string         failure;
    };

    FaceVector         contact_forces; // not constrained
    Vector             unbalanced; // internal - external forces, all supports
    Vector             right_hand_side; // and scratch between the solutions
    NewtonRecord       newton;
    unsigned long long n_newton_total = 0, n_linear_total = 0;

    std::function<bool()> gives_up_step;
    bool                  is_given_up = false;

    // Adaptivity.
    MeshMarker<dim> marker;
    MarkedCells     last_marked;
    MeshTolerance   tolerance;
    bool            is_marked         = false;
    unsigned int    n_repeats         = 0; // of the present step
    bool            mesh_is_new       = false;
    unsigned int    steps_since_check = 0;
    double          most_cells_wanted = 0.; // beyond the limit
    double          largest_jump      = 0.; // of the force, relative

    std::vector<MeshChange> mesh_changes;

    // Bookkeeping.
    double external_work       = 0.;
    double damped_energy       = 0.; // by the viscosity of the body
    double largest_imbalance   = 0.;
    double largest_normal_load = 0.;
    // By how much the map of the strength is off as the contact points see it.
    double strength_error = 0.;
    // Of the loaded part of a curved face, under the largest load.
    double cells_across  = std::numeric_limits<double>::infinity();
    double contact_share = 1.;
    // Means over the load [mm]: the largest, when the step begins, and at the
    // end of its first stage.
    double         worn_depth            = 0.;
    double         worn_depth_at_start   = 0.;
    double         worn_depth_of_stage   = 0.;
    double         largest_contact_share = 0.; // that of a flat face is 1
    OpeningSummary opening;
    // At worst so far: the head's lean as a share of the length of the block,
    // and, of slender ones, the moments that it would give the normal load and
    // that friction has [N mm].
    struct Lean
    {
      double share = 0., moment_of_load = 0., moment_of_friction = 0.;
    };
    Lean lean;
  };
} // namespace SlipStep

#endif
