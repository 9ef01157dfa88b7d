// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_friction_contact_state_h
#define slipstep_friction_contact_state_h

#include <deal.II/base/tensor.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <vector>

namespace SlipStep
{
  /// Something that an effect remembers of a contact point. The file of the
  /// effect registers it; then it is transferred, saved and shown.
  struct ContactMemory
  {
    /// In files, with its unit.
    const char *name;
    /// Value of a point that was never loaded, and while the effect is off.
    double initial = 0.;
    /// A change of the mesh averages a memory and keeps it between these.
    double least    = 0.;
    double greatest = std::numeric_limits<double>::infinity();
    /// Of a place on the plane [mm] the axis, 0 or 1: it changes off the plane,
    /// too. Else none of them.
    unsigned int axis = 2;
    /// Where ContactState holds it; set by register_memory().
    unsigned int slot = 0;
  };

  /// For a global constant in the file of an effect.
  /// @param memory its name must not be taken
  ContactMemory register_memory(ContactMemory memory);

  /// All memories linked into the program, by name.
  const std::vector<ContactMemory> &contact_memories();

  /// A memory of another file.
  const ContactMemory &contact_memory(const std::string &name);

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
    /// Way that the contact has slipped over the plane [mm].
    double slip_path = 0.;
    /// Viscoplastic slip rate lambda at the end of the step [mm/s].
    double slip_rate = 0.;
    /// Energy dissipated per area [MPa mm].
    double dissipation = 0.;

    /// Factor of the strength at this place of the face, which stays.
    double strength_factor = 1.;

    /// Room for what single effects remember, without an allocation per point.
    static constexpr unsigned int     most_memories = 20;
    std::array<double, most_memories> memories{};

    double &operator[](const ContactMemory &memory)
    {
      return memories[memory.slot];
    }

    double operator[](const ContactMemory &memory) const
    {
      return memories[memory.slot];
    }

    /// All of it, for boost::serialization.
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &traction &normal_traction &strength &loading_ratio &normal_ratio
        &coefficient &slip_path &slip_rate &dissipation &strength_factor;
      for (const ContactMemory &memory : contact_memories())
        archive &memories[memory.slot];
    }
  };

  /// What a stage of a contact point answers, with its exact linearisation.
  struct ContactResponse
  {
    /// Tangential traction [MPa].
    dealii::Tensor<1, 2> traction;
    /// d traction / d slip increment [MPa/mm], in general unsymmetric.
    dealii::Tensor<2, 2> d_slip;
    /// d traction / d normal traction [1].
    dealii::Tensor<1, 2> d_normal;
    /// Whether more of the slip increment was viscoplastic than elastic.
    bool slips = false;
  };

  /// Estimated error of a step, relative to the present strength.
  struct StepError
  {
    /// Of traction, mu, r_s and strength, which the memories make, at the end
    /// of the step.
    double at_end = 0.;
    /// Of the straight line from the beginning of the step to its end.
    double of_line = 0.;

    /// What the tolerance of a step is compared with: a line, of which the
    /// error does not add up, may err four times as much.
    double measure() const
    {
      return std::max(at_end, of_line / 4.);
    }

    /// Let the measure be no more than this.
    void limit_to(const double most)
    {
      at_end  = std::min(at_end, most);
      of_line = std::min(of_line, 4. * most);
    }
  };

  /// Where an implicit stage starts.
  struct StageStart
  {
    StageStart() = default;

    /// The first stage of a step.
    explicit StageStart(const ContactState &state);

    ContactState state;
    /// Where the elastic path begins on which the smallest r is looked for
    /// [MPa], and what of the trial traction is counted from there: the
    /// traction, in the second stage less what slip will take.
    dealii::Tensor<1, 2> path_start, path_base;
    /// By how much the elastic core has moved since there, of the strength.
    dealii::Tensor<1, 2> core_motion;
    double normal_traction = 0.; ///< from which that changes [MPa]
  };

  /// One stage that has been made.
  struct StageRecord
  {
    ContactState         end;
    ContactResponse      response;
    dealii::Tensor<1, 2> slip_increment; ///< [mm]
    double               time_step = 0.; ///< [s]
  };
} // namespace SlipStep

#endif
