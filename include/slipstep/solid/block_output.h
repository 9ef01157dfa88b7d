// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_solid_block_output_h
#define slipstep_solid_block_output_h

#include <deal.II/base/data_out_base.h>

#include <slipstep/solid/contact_face.h>
#include <slipstep/solid/mesh_change.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace SlipStep
{
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
