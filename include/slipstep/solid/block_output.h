// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_solid_block_output_h
#define slipstep_solid_block_output_h

#include <deal.II/base/data_out_base.h>

#include <slipstep/solid/contact_face.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace SlipStep
{
  /// A change of the mesh during a run, and what it did to the forces.
  struct MeshChange
  {
    double             time = 0.; ///< of the state that was carried over [s]
    bool               repeats_step = false; ///< or it was done after a step
    unsigned long long n_refined    = 0;     ///< cells
    unsigned long long n_merged     = 0;     ///< parents of merged cells
    unsigned long long n_cells      = 0;     ///< of the new mesh
    unsigned long long n_unknowns   = 0;     ///< of the new mesh
    double error_before = 0.; ///< estimated on the old mesh, relative
    /// Estimated on the new mesh in the step made on it, relative; NaN until
    /// that is looked at.
    double error           = std::numeric_limits<double>::quiet_NaN();
    double tangential_load = 0.; ///< on the old mesh [N]
    double dissipated      = 0.; ///< on the old mesh [N mm]
    /// Integral of the traction as carried over, minus that on the old mesh,
    /// relative to the load (to a tenth of that at full slip, if more).
    double load_jump = 0.;
    /// The same for the dissipated energy (relative to it, or to a hundredth
    /// of the work done so far).
    double dissipation_jump = 0.;
    /// The same two with the forces in equilibrium on the new mesh. The load
    /// differs by what the old mesh was too stiff.
    double equilibrium_load_jump        = 0.;
    double equilibrium_dissipation_jump = 0.;

    /// For boost::serialization.
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &time &repeats_step &n_refined &n_merged &n_cells &n_unknowns
        &error_before &error &tangential_load &dissipated &load_jump &
          dissipation_jump &equilibrium_load_jump &equilibrium_dissipation_jump;
    }
  };



  /// Writes the fields of a block for ParaView and for the report.
  ///
  /// `fields.pvd` collects the volume (displacement in space, relative to where
  /// the drive is, stress), `contact.pvd` the contact face (pressure, traction,
  /// slip path, r, r_s, mu, dissipated energy per area, what the effects of the
  /// law remember, and which points slip); both tell the squared error of the
  /// cell by ErrorIndicator. `surface_0000.csv` and so on, or `surface.csv`,
  /// are for the picture of the block in the report. `contact_face.csv` has one
  /// row per contact cell at the last time with averages over the cell, of all
  /// but the last.
  template <int dim>
  class BlockOutput
  {
  public:
    BlockOutput(const BlockParameters       &parameters,
                const std::filesystem::path &folder,
                const MPI_Comm              &communicator);

    /// Write the volume and the face if the case file wants them now.
    /// @param displacement ghosted [mm]
    /// @param frame displacement of the frame [mm]
    /// @param loads that act
    void write_if_due(const dealii::DoFHandler<dim> &dof_handler,
                      const Vector                  &displacement,
                      const dealii::Tensor<1, 2>    &frame,
                      const ContactFace<dim>        &contact,
                      const LoadFactors             &loads,
                      const FinishedStep            &step);

    /// Write the last change into refinement.csv, anew if it is there already;
    /// the first time all of them, because a run that goes on has earlier ones
    /// (all ranks take part).
    void write_mesh_changes(const std::vector<MeshChange> &changes);

    /// Write contact_face.csv and, if the case file wanted no fields at all,
    /// surface.csv of the end (all ranks take part).
    /// @param displacement ghosted [mm]
    void write_end(const dealii::DoFHandler<dim> &dof_handler,
                   const Vector                  &displacement,
                   const ContactFace<dim>        &contact) const;

    /// Which files have been written, for boost::serialization.
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &n_written &volume_files &contact_files;
    }

  private:
    void write_contact_table(const ContactFace<dim> &contact) const;
    void write_surface_file(const std::string             &name,
                            const dealii::DoFHandler<dim> &dof_handler,
                            const Vector                  &displacement,
                            const ContactFace<dim>        &contact) const;
    void write_volume(const dealii::DoFHandler<dim> &dof_handler,
                      const Vector                  &displacement,
                      const dealii::Vector<double>  &squared_errors,
                      const dealii::Tensor<1, 2>    &frame,
                      const double                   time);
    void write_contact(const ContactFace<dim>       &contact,
                       const dealii::Vector<double> &squared_errors,
                       const double                  time);
    /// Write a file per rank with patches and add it to the collection.
    template <int patch_dim>
    void write_patches(const std::string                              &name,
                       const dealii::DataOutInterface<patch_dim, dim> &patches,
                       const bool                                   has_patches,
                       std::vector<std::pair<double, std::string>> &entries,
                       const double                                 time) const;

    const BlockParameters       parameters;
    const std::filesystem::path folder;
    const MPI_Comm              communicator;
    const unsigned int          rank;
    unsigned int                n_written = 0;
    std::ofstream               mesh_changes;        ///< refinement.csv
    std::size_t                 n_final_changes = 0; ///< all but the last in it
    std::uintmax_t              final_bytes     = 0; ///< of the file

    std::vector<std::pair<double, std::string>> volume_files, contact_files;
  };
} // namespace SlipStep

#endif
