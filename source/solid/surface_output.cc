// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/solid/surface_output.h>

#include <slipstep/solid/stress.h>
#include <slipstep/utilities/text.h>
#include <slipstep/utilities/write_file.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <sstream>

namespace SlipStep
{
  using namespace dealii;

  namespace
  {
    constexpr std::size_t most_quadrilaterals = 20000;

    // 12 coordinates, 12 displacements, von Mises, in contact, pressure, slip,
    // r.
    using SurfaceRow = std::array<double, 29>;

    const char *const surface_head =
      "x0_mm,y0_mm,z0_mm,x1_mm,y1_mm,z1_mm,x2_mm,y2_mm,z2_mm,x3_mm,y3_mm,"
      "z3_mm,ux0_mm,uy0_mm,uz0_mm,ux1_mm,uy1_mm,uz1_mm,ux2_mm,uy2_mm,uz2_mm,"
      "ux3_mm,uy3_mm,uz3_mm,von_mises_MPa,contact,pressure_MPa,slip_mm,r\n";

    double von_mises(const SymmetricTensor<2, 3> &stress)
    {
      return std::sqrt(1.5) * deviator(stress).norm();
    }



    // From values at the corners in deal.II's order.
    template <int dim>
    SurfaceRow surface_row(const FEValuesBase<dim> &corners,
                           const Vector            &displacement,
                           const BlockParameters   &parameters)
    {
      const FEValuesExtractors::Vector u(0);
      std::vector<Tensor<1, dim>>      values(4);
      std::vector<Tensor<2, dim>>      gradients(4);
      corners[u].get_function_values(displacement, values);
      corners[u].get_function_gradients(displacement, gradients);
      SurfaceRow row{};
      for (unsigned int v = 0; v < 4; ++v)
        {
          const unsigned int place = v < 2 ? v : 5 - v; // going round
          for (unsigned int d = 0; d < dim; ++d)
            {
              row[3 * place + d]      = corners.quadrature_point(v)[d];
              row[12 + 3 * place + d] = values[v][d];
            }
          row[24] += von_mises(stress_of(gradients[v], parameters)) / 4.;
        }
      return row;
    }



    template <int dim>
    void add_contact(SurfaceRow                                &row,
                     const typename ContactFace<dim>::CellFace &face)
    {
      double area = 0.;
      for (const auto &point : face.points)
        area += point.JxW;
      row[25] = 1.;
      for (const auto &point : face.points)
        {
          const ContactState &state = point.point.committed();
          row[26] += point.JxW / area * state.normal_traction;
          row[27] += point.JxW / area * state.slip_path;
          row[28] += point.JxW / area * state.loading_ratio;
        }
    }



    std::vector<SurfaceRow> surface_rows(const BlockParameters &parameters,
                                         const DoFHandler<2>   &dof_handler,
                                         const Vector          &displacement,
                                         const ContactFace<2> &)
    {
      FEValues<2>             corners(dof_handler.get_fe(),
                          QTrapezoid<2>(),
                          update_values | update_gradients |
                            update_quadrature_points);
      std::vector<SurfaceRow> rows;
      for (const auto &cell : dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            corners.reinit(cell);
            rows.push_back(surface_row(corners, displacement, parameters));
          }
      return rows;
    }



    std::vector<SurfaceRow> surface_rows(const BlockParameters &parameters,
                                         const DoFHandler<3>   &dof_handler,
                                         const Vector          &displacement,
                                         const ContactFace<3>  &contact)
    {
      const auto              in_contact = contact.places_of_cells();
      FEFaceValues<3>         corners(dof_handler.get_fe(),
                              QTrapezoid<2>(),
                              update_values | update_gradients |
                                update_quadrature_points);
      std::vector<SurfaceRow> rows;
      for (const auto &cell : dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
          for (const unsigned int f : cell->face_indices())
            if (cell->at_boundary(f))
              {
                corners.reinit(cell, f);
                rows.push_back(surface_row(corners, displacement, parameters));
                if (f == parameters.contact_face)
                  add_contact<3>(
                    rows.back(),
                    contact.cell_faces()[in_contact.at(cell->id())]);
              }
      return rows;
    }
  } // namespace



  template <int dim>
  void write_surface(const std::filesystem::path &file,
                     const BlockParameters       &parameters,
                     const DoFHandler<dim>       &dof_handler,
                     const Vector                &displacement,
                     const ContactFace<dim>      &contact,
                     const MPI_Comm              &communicator)
  {
    const auto rows =
      surface_rows(parameters, dof_handler, displacement, contact);
    if (Utilities::MPI::sum(rows.size(), communicator) > most_quadrilaterals)
      return;
    const auto parts = Utilities::MPI::gather(communicator, rows, 0);
    if (Utilities::MPI::this_mpi_process(communicator) != 0)
      return;
    std::vector<SurfaceRow> all;
    for (const auto &part : parts)
      all.insert(all.end(), part.begin(), part.end());
    // The same on any number of ranks.
    std::sort(all.begin(), all.end());

    std::ostringstream out;
    out << surface_head;
    for (const SurfaceRow &row : all)
      for (std::size_t i = 0; i < row.size(); ++i)
        out << rounded_text(row[i], 7) << (i + 1 < row.size() ? ',' : '\n');
    write_file(file, out.str());
  }



  template void write_surface(const std::filesystem::path &,
                              const BlockParameters &,
                              const DoFHandler<2> &,
                              const Vector &,
                              const ContactFace<2> &,
                              const MPI_Comm &);
  template void write_surface(const std::filesystem::path &,
                              const BlockParameters &,
                              const DoFHandler<3> &,
                              const Vector &,
                              const ContactFace<3> &,
                              const MPI_Comm &);
} // namespace SlipStep
