// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/solid/block_output.h>

#include <slipstep/solid/attempt_together.h>
#include <slipstep/solid/surface_output.h>
#include <slipstep/solid/error_indicator.h>
#include <slipstep/solid/stress.h>
#include <slipstep/utilities/text.h>
#include <slipstep/utilities/write_file.h>

#include <deal.II/base/mpi.h>

#include <deal.II/fe/fe_dgq.h>
#include <deal.II/fe/fe_tools.h>

#include <deal.II/numerics/data_component_interpretation.h>
#include <deal.II/numerics/data_out.h>
#include <deal.II/numerics/data_postprocessor.h>

#include <algorithm>
#include <functional>
#include <sstream>

#include "slipstep_paraview_state.h"

namespace SlipStep
{
  using namespace dealii;

  namespace
  {
    // Cauchy stress from the gradient of the displacement.
    template <int dim>
    class StressPostprocessor : public DataPostprocessorTensor<dim>
    {
    public:
      explicit StressPostprocessor(const BlockParameters &parameters)
        : DataPostprocessorTensor<dim>("stress_MPa", update_gradients)
        , parameters(parameters)
      {}

      virtual void evaluate_vector_field(
        const DataPostprocessorInputs::Vector<dim> &input,
        std::vector<dealii::Vector<double>>        &stresses) const override
      {
        for (unsigned int q = 0; q < stresses.size(); ++q)
          {
            Tensor<2, dim> gradient;
            for (unsigned int d = 0; d < dim; ++d)
              gradient[d] = input.solution_gradients[q][d];
            const SymmetricTensor<2, 3> stress =
              stress_of(gradient, parameters);
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int j = 0; j < dim; ++j)
                stresses[q](Tensor<2, dim>::component_to_unrolled_index(
                  TableIndices<2>(i, j))) = stress[i][j];
          }
      }

    private:
      const BlockParameters &parameters;
    };



    // Where the point is in space: adds the motion of the frame.
    template <int dim>
    class DisplacementPostprocessor : public DataPostprocessorVector<dim>
    {
    public:
      explicit DisplacementPostprocessor(const Tensor<1, dim> &frame)
        : DataPostprocessorVector<dim>("displacement_mm", update_values)
        , frame(frame)
      {}

      virtual void evaluate_vector_field(
        const DataPostprocessorInputs::Vector<dim> &input,
        std::vector<dealii::Vector<double>>        &values) const override
      {
        for (unsigned int q = 0; q < values.size(); ++q)
          for (unsigned int d = 0; d < dim; ++d)
            values[q](d) = input.solution_values[q](d) + frame[d];
      }

    private:
      const Tensor<1, dim> frame;
    };



    // Names and values of what is shown on the contact face: the same on all
    // ranks.
    struct FaceField
    {
      std::string name;
      // Of the state and the distance from the plane [mm].
      std::function<double(const ContactState &, const double)> value;
      // Open points have none of it.
      bool is_of_closed = false;
    };

    // Of the contact face, as the block calls them. In 2-D the second one is
    // across the face, and all along it is zero.
    std::array<std::string, 2> face_axes(const BlockParameters &parameters)
    {
      const unsigned int first = parameters.tangential_axis(0);
      const unsigned int second =
        parameters.dimension == 2 ? first + 1 : parameters.tangential_axis(1);
      return {{std::string(1, "xyz"[first]), std::string(1, "xyz"[second])}};
    }



    std::vector<FaceField> face_fields(const FrictionLaw     &law,
                                       const BlockParameters &parameters)
    {
      using State                   = ContactState;
      const GapAndStrength &surface = parameters.surface;
      const auto [first, second]    = face_axes(parameters);
      // The value of a member, as a function.
      const auto of = [](double State::*const member) {
        return [member](const State &s, const double) { return s.*member; };
      };
      std::vector<FaceField> fields = {
        {"pressure_MPa", of(&State::normal_traction)},
        {"traction_" + first + "_MPa",
         [](const State &s, const double) { return s.traction[0]; }},
        {"traction_" + second + "_MPa",
         [](const State &s, const double) { return s.traction[1]; }},
        {"slip_mm", of(&State::slip_path)},
        {"r", of(&State::loading_ratio), true},
        {"r_s", of(&State::normal_ratio), true},
        {"mu", of(&State::coefficient)},
        {"dissipated_energy_Nmm_per_mm2", of(&State::dissipation)}};
      for (const ContactMemory &memory : law.memories())
        fields.push_back({memory.name, [memory](const State &s, const double) {
                            return s[memory];
                          }});
      if (surface.has_map_of_strength())
        fields.push_back({"strength_factor", of(&State::strength_factor)});
      if (surface.is_curved())
        fields.push_back({"gap_mm", [](const State &, const double distance) {
                            return std::max(0., distance);
                          }});
      return fields;
    }



    const char *const squared_error = "squared_error_Nmm";

    constexpr unsigned int n_digits = 4; // in names of files



    // Surface patches of the contact face, for all formats of deal.II. Values
    // at the corners come from the quadrature points by projection.
    template <int dim>
    class ContactPatches : public DataOutInterface<dim - 1, dim>
    {
    public:
      ContactPatches(const ContactFace<dim>       &contact,
                     const BlockParameters        &parameters,
                     const dealii::Vector<double> &squared_errors)
        : names({"slips", squared_error})
      {
        const auto fields = face_fields(contact.friction_law(), parameters);
        for (const FaceField &field : fields)
          names.push_back(field.name);
        const FE_DGQ<dim - 1> corners(1);
        const unsigned int    n_points  = contact.quadrature().size();
        const unsigned int    n_corners = corners.dofs_per_cell;
        FullMatrix<double>    to_corners(n_corners, n_points);
        FETools::compute_projection_from_quadrature_points_matrix(
          corners, contact.quadrature(), contact.quadrature(), to_corners);

        for (const auto &cell_face : contact.cell_faces())
          {
            DataOutBase::Patch<dim - 1, dim> patch;
            // Left to its default, the patch is written without a cell.
            patch.reference_cell = ReferenceCells::get_hypercube<dim - 1>();
            patch.n_subdivisions = 1;
            patch.patch_index    = patches.size();
            patch.data.reinit(names.size(), n_corners);
            const auto face = cell_face.cell->face(cell_face.face);
            for (unsigned int v = 0; v < n_corners; ++v)
              {
                patch.vertices[v] = face->vertex(v);
                patch.data(1, v) =
                  squared_errors[cell_face.cell->active_cell_index()];
                for (unsigned int q = 0; q < n_points; ++q)
                  {
                    const auto  &point  = cell_face.points[q];
                    const double weight = to_corners(v, q);
                    patch.data(0, v) += point.slips ? weight : 0.;
                    for (unsigned int i = 0; i < fields.size(); ++i)
                      patch.data(2 + i, v) +=
                        weight * fields[i].value(point.point.committed(),
                                                 point.distance);
                  }
              }
            patches.push_back(patch);
          }
      }

      virtual const std::vector<DataOutBase::Patch<dim - 1, dim>> &
      get_patches() const override
      {
        return patches;
      }

      virtual std::vector<std::string> get_dataset_names() const override
      {
        return names;
      }

    private:
      std::vector<std::string>                      names;
      std::vector<DataOutBase::Patch<dim - 1, dim>> patches;
    };



    void write_row(std::ostream &out, const MeshChange &change)
    {
      out << exact_text(change.time) << ',' << change.repeats_step << ','
          << change.n_refined << ',' << change.n_merged << ',' << change.n_cells
          << ',' << change.n_unknowns;
      for (const double value : {change.error,
                                 change.error_before,
                                 change.tangential_load,
                                 change.dissipated,
                                 change.load_jump,
                                 change.dissipation_jump,
                                 change.equilibrium_load_jump,
                                 change.equilibrium_dissipation_jump})
        out << ',' << exact_text(value);
      out << '\n';
    }
  } // namespace



  template <int dim>
  BlockOutput<dim>::BlockOutput(const BlockParameters       &parameters,
                                const std::filesystem::path &folder,
                                const MPI_Comm              &communicator)
    : parameters(parameters)
    , folder(folder)
    , communicator(communicator)
    , rank(Utilities::MPI::this_mpi_process(communicator))
  {}



  template <int dim>
  void BlockOutput<dim>::write_if_due(const DoFHandler<dim>  &dof_handler,
                                      const Vector           &displacement,
                                      const Tensor<1, 2>     &frame,
                                      const ContactFace<dim> &contact,
                                      const LoadFactors      &loads,
                                      const FinishedStep     &step)
  {
    if (!parameters.fields.is_due(step))
      return;
    const std::vector<double> errors =
      ErrorIndicator<dim>(parameters)
        .squared_errors(dof_handler, displacement, contact, loads);
    const dealii::Vector<double> squared_errors(errors.begin(), errors.end());
    write_volume(dof_handler, displacement, squared_errors, frame, step.time);
    write_contact(contact, squared_errors, step.time);
    write_surface_file("surface_" +
                         Utilities::int_to_string(n_written, n_digits) + ".csv",
                       dof_handler,
                       displacement,
                       contact);
    ++n_written;
  }



  template <int dim>
  void BlockOutput<dim>::write_end(const DoFHandler<dim>  &dof_handler,
                                   const Vector           &displacement,
                                   const ContactFace<dim> &contact) const
  {
    write_contact_table(contact);
    if (n_written == 0)
      write_surface_file("surface.csv", dof_handler, displacement, contact);
  }



  template <int dim>
  void
  BlockOutput<dim>::write_surface_file(const std::string      &name,
                                       const DoFHandler<dim>  &dof_handler,
                                       const Vector           &displacement,
                                       const ContactFace<dim> &contact) const
  {
    do_together(communicator, [&]() {
      write_surface(folder / name,
                    parameters,
                    dof_handler,
                    displacement,
                    contact,
                    communicator);
    });
  }



  template <int dim>
  void
  BlockOutput<dim>::write_volume(const DoFHandler<dim>        &dof_handler,
                                 const Vector                 &displacement,
                                 const dealii::Vector<double> &squared_errors,
                                 const Tensor<1, 2>           &frame,
                                 const double                  time)
  {
    const StressPostprocessor<dim>       stress(parameters);
    const DisplacementPostprocessor<dim> in_space(
      parameters.template in_plane<dim>(frame));

    DataOut<dim> data_out;
    data_out.attach_dof_handler(dof_handler);
    data_out.add_data_vector(displacement, in_space);
    data_out.add_data_vector(
      displacement,
      std::vector<std::string>(dim, "deformation_mm"),
      DataOut<dim>::type_dof_data,
      std::vector<DataComponentInterpretation::DataComponentInterpretation>(
        dim, DataComponentInterpretation::component_is_part_of_vector));
    data_out.add_data_vector(displacement, stress);
    data_out.add_data_vector(squared_errors,
                             squared_error,
                             DataOut<dim>::type_cell_data);
    data_out.build_patches(parameters.degree);
    const bool has_cells = dof_handler.n_locally_owned_dofs() > 0;
    write_patches("fields", data_out, has_cells, volume_files, time);
  }



  template <int dim>
  void
  BlockOutput<dim>::write_contact(const ContactFace<dim>       &contact,
                                  const dealii::Vector<double> &squared_errors,
                                  const double                  time)
  {
    const ContactPatches<dim> patches(contact, parameters, squared_errors);
    const bool                has_cells = !contact.cell_faces().empty();
    write_patches("contact", patches, has_cells, contact_files, time);
  }



  // A rank without patches would write a file without points, which other
  // programs cannot read.
  template <int dim>
  template <int patch_dim>
  void BlockOutput<dim>::write_patches(
    const std::string                           &name,
    const DataOutInterface<patch_dim, dim>      &patches,
    const bool                                   has_patches,
    std::vector<std::pair<double, std::string>> &entries,
    const double                                 time) const
  {
    MPI_Comm those_with_patches;
    MPI_Comm_split(communicator,
                   has_patches ? 0 : MPI_UNDEFINED,
                   rank,
                   &those_with_patches);
    if (has_patches)
      {
        patches.write_vtu_with_pvtu_record(
          folder.string() + "/", name, n_written, those_with_patches, n_digits);
        MPI_Comm_free(&those_with_patches);
      }
    entries.emplace_back(time,
                         name + "_" +
                           Utilities::int_to_string(n_written, n_digits) +
                           ".pvtu");
    if (rank != 0)
      return;
    std::ostringstream text;
    DataOutBase::write_pvd_record(text, entries);
    write_file(folder / (name + ".pvd"), text.str());
    if (entries.size() == 1)
      write_file(folder / "paraview_state.py", paraview_state);
  }



  // A full disk hits one rank only: all must stop together.
  template <int dim>
  void
  BlockOutput<dim>::write_mesh_changes(const std::vector<MeshChange> &changes)
  {
    do_together(communicator, [&]() {
      if (rank != 0)
        return;
      const std::filesystem::path file = folder / "refinement.csv";
      if (!mesh_changes.is_open())
        {
          mesh_changes.open(file);
          mesh_changes << "time_s,repeats_step,refined,merged,cells,dofs,"
                          "estimated_error,estimated_error_before,"
                          "tangential_load_N,"
                          "dissipated_energy_Nmm,load_jump,dissipation_jump,"
                          "equilibrium_load_jump,"
                          "equilibrium_dissipation_jump\n";
        }
      else
        {
          std::filesystem::resize_file(file, final_bytes);
          mesh_changes.seekp(final_bytes);
        }
      for (; n_final_changes < changes.size(); ++n_final_changes)
        {
          final_bytes = mesh_changes.tellp();
          write_row(mesh_changes, changes[n_final_changes]);
        }
      --n_final_changes;
      if (!mesh_changes.flush())
        throw write_failure(file);
    });
  }



  template <int dim>
  void
  BlockOutput<dim>::write_contact_table(const ContactFace<dim> &contact) const
  {
    // Position, sizes and area of a cell, then its averages.
    using Row               = std::vector<double>;
    const auto       fields = face_fields(contact.friction_law(), parameters);
    std::vector<Row> rows;
    for (const auto &cell_face : contact.cell_faces())
      {
        Row  row(5 + fields.size());
        auto face = cell_face.cell->face(cell_face.face);
        for (unsigned int i = 0; i < dim - 1; ++i)
          {
            const unsigned int axis = parameters.tangential_axis(i);
            row[i]                  = face->center()[axis];
            row[2 + i] = std::abs(face->vertex(face->n_vertices() - 1)[axis] -
                                  face->vertex(0)[axis]);
          }
        double closed = 0.;
        for (const auto &point : cell_face.points)
          {
            row[4] += point.JxW;
            if (point.point.committed().normal_traction > 0.)
              closed += point.JxW;
          }
        for (const auto &point : cell_face.points)
          for (unsigned int i = 0; i < fields.size(); ++i)
            row[5 + i] +=
              fields[i].value(point.point.committed(), point.distance) *
              point.JxW /
              (fields[i].is_of_closed && closed > 0. ? closed : row[4]);
        rows.push_back(row);
      }

    auto all = Utilities::MPI::gather(communicator, rows, 0);
    if (rank != 0)
      return;
    std::vector<Row> sorted;
    for (const auto &part : all)
      sorted.insert(sorted.end(), part.begin(), part.end());
    std::sort(sorted.begin(), sorted.end(), [](const Row &a, const Row &b) {
      return std::tie(a[1], a[0]) < std::tie(b[1], b[0]);
    });

    std::ostringstream out;
    const auto [first, second] = face_axes(parameters);
    out << first << "_mm," << second << "_mm,cell_size_" << first
        << "_mm,cell_size_" << second << "_mm,area_mm2";
    for (const FaceField &field : fields)
      out << ',' << field.name;
    out << '\n';
    for (const Row &row : sorted)
      for (unsigned int i = 0; i < row.size(); ++i)
        out << exact_text(row[i]) << (i + 1 < row.size() ? ',' : '\n');
    write_file(folder / "contact_face.csv", out.str());
  }



  template class BlockOutput<2>;
  template class BlockOutput<3>;
} // namespace SlipStep
