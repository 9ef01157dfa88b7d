// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/solid/face_probes.h>

#include <slipstep/utilities/text.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe_dgq.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace SlipStep
{
  using namespace dealii;

  namespace
  {
    /// Part of the contact face that a cell covers, along one of its axes.
    struct Interval
    {
      double lower = 0.;
      double upper = 0.;

      /// Whether a coordinate lies in it, borders included.
      bool contains(const double x) const
      {
        const double round_off = 1e-9 * (upper - lower);
        return x >= lower - round_off && x <= upper + round_off;
      }

      double unit_coordinate(const double x) const
      {
        return (x - lower) / (upper - lower);
      }
    };



    template <int dim>
    Interval extent(const typename ContactFace<dim>::CellFace &cell_face,
                    const unsigned int                         axis)
    {
      const auto box = cell_face.cell->face(cell_face.face)->bounding_box();
      return {box.lower_bound(axis), box.upper_bound(axis)};
    }



    // Where a curve through points passes a level between points i-1 and i: on
    // the cubic through them and the next on both sides, so that the place is
    // as good as the curve.
    double crossing(const std::vector<std::pair<double, double>> &curve,
                    const std::size_t                             i,
                    const double                                  level)
    {
      const std::size_t     begin = i >= 2 ? i - 2 : i - 1;
      const std::size_t     end   = std::min(i + 2, curve.size());
      std::vector<Point<1>> places;
      for (std::size_t k = begin; k < end; ++k)
        places.emplace_back(curve[k].first);
      const auto basis  = Polynomials::generate_complete_Lagrange_basis(places);
      const auto excess = [&](const double x) {
        double sum = -level;
        for (std::size_t k = begin; k < end; ++k)
          sum += curve[k].second * basis[k - begin].value(x);
        return sum;
      };
      double     lower = curve[i - 1].first, upper = curve[i].first;
      const bool rises = curve[i].second > curve[i - 1].second;
      for (unsigned int bisection = 0; bisection < 60; ++bisection)
        {
          const double middle = 0.5 * (lower + upper);
          ((excess(middle) < 0.) == rises ? lower : upper) = middle;
        }
      return 0.5 * (lower + upper);
    }
  } // namespace



  void check_probes(const Parameters                      &parameters,
                    const BlockParameters                 &block,
                    const std::vector<QuantityOfInterest> &quantities)
  {
    const std::string key = "Output/Quantities";
    for (const QuantityOfInterest &quantity : quantities)
      {
        const std::string where = "'" + quantity.name + "': ";
        const bool        is_of_face =
          quantity.kind == QuantityOfInterest::Kind::pressure;
        if (quantity.kind == QuantityOfInterest::Kind::moment &&
            block.dimension == 2 && quantity.component != 2)
          parameters.reject(key, where + "a moment in 2-D is about z");
        if (quantity.has_component() && quantity.component >= block.dimension &&
            quantity.kind != QuantityOfInterest::Kind::moment)
          parameters.reject(key, where + "a block in 2-D has the axes x and y");
        const auto faces = face_names(block.dimension);
        if (!quantity.face.empty() && !holds(faces, quantity.face))
          parameters.reject(key, where + "a block in 2-D has no such face");
        if (quantity.position.empty())
          continue;

        const unsigned int n =
          is_of_face ? block.dimension - 1 : block.dimension;
        if (quantity.position.size() != n)
          parameters.reject(key,
                            where + "a point of the " +
                              (is_of_face ? "face of a block" : "block") +
                              " in " + std::to_string(block.dimension) +
                              "-D has " + std::to_string(n) +
                              (n == 1 ? " coordinate" : " coordinates"));
        for (unsigned int i = 0; i < n; ++i)
          {
            const unsigned int axis = is_of_face ? block.tangential_axis(i) : i;
            if (quantity.position[i] >= 0. &&
                quantity.position[i] <= block.size[axis])
              continue;
            parameters.reject(key,
                              where + "along " + "xyz"[axis] + " the " +
                                (is_of_face ? "contact face" : "block") +
                                " reaches from 0 to " +
                                short_text(block.size[axis], 6) + " mm");
          }
      }
  }



  template <int dim>
  FaceProbes<dim>::FaceProbes(const BlockParameters &parameters,
                              const Programme       &programme)
    : parameters(parameters)
  {
    for (const Segment &segment : programme.segments())
      {
        const Tensor<1, 2> motion =
          segment.pushes ? segment.push : segment.end.velocity;
        if (!(motion.norm() > 0.))
          continue;
        if (dim == 3 && std::abs(motion[1]) > std::abs(motion[0]))
          sliding_axis = 1;
        slides_backward = motion[sliding_axis] < 0.;
        break;
      }
  }



  template <int dim>
  double FaceProbes<dim>::value(const QuantityOfInterest &probe,
                                const ContactFace<dim>   &contact,
                                const MPI_Comm           &communicator) const
  {
    using Kind = QuantityOfInterest::Kind;
    switch (probe.kind)
      {
        case Kind::pressure:
          return pressure(contact, probe.position, communicator);
        case Kind::slip_front:
          return slip_front(contact, probe.loading_ratio, communicator);
        default:
          return extreme_pressure(contact,
                                  probe.kind == Kind::largest_pressure,
                                  communicator);
      }
  }



  template <int dim>
  double FaceProbes<dim>::extreme_pressure(const ContactFace<dim> &contact,
                                           const bool              is_largest,
                                           const MPI_Comm &communicator) const
  {
    const double sign    = is_largest ? 1. : -1.;
    double       extreme = -std::numeric_limits<double>::infinity();
    for (const auto &cell_face : contact.cell_faces())
      for (const auto &point : cell_face.points)
        extreme =
          std::max(extreme,
                   sign *
                     std::max(point.point.committed().normal_traction, 0.));
    return sign * Utilities::MPI::max(extreme, communicator);
  }



  template <int dim>
  double FaceProbes<dim>::pressure(const ContactFace<dim>    &contact,
                                   const std::vector<double> &position,
                                   const MPI_Comm &communicator) const
  {
    // Sum over the cells that touch the point, and their number.
    std::vector<double> sums(2);
    const Quadrature<1> nodes = contact.quadrature().get_tensor_basis()[0];
    const FE_DGQArbitraryNodes<dim - 1> polynomials(nodes);
    const auto                          numbers =
      lexicographic_face_points<dim>(nodes.size(), parameters);
    for (const auto &cell_face : contact.cell_faces())
      {
        Point<dim - 1> place;
        bool           is_here = true;
        for (unsigned int i = 0; i < dim - 1; ++i)
          {
            const Interval side =
              extent<dim>(cell_face, parameters.tangential_axis(i));
            is_here  = is_here && side.contains(position[i]);
            place[i] = side.unit_coordinate(position[i]);
          }
        if (!is_here)
          continue;
        double value = 0.;
        for (unsigned int q = 0; q < numbers.size(); ++q)
          value += cell_face.points[q].point.committed().normal_traction *
                   polynomials.shape_value(numbers[q], place);
        sums[0] += std::max(value, 0.);
        sums[1] += 1.;
      }
    Utilities::MPI::sum(sums, communicator, sums);
    return sums[0] / sums[1];
  }



  // Pairs (distance from the rear end, loading ratio) of this rank. In 3-D
  // those points of every cell on the centre line that lie next to it.
  template <int dim>
  std::vector<std::pair<double, double>>
  FaceProbes<dim>::ratios_along_centre_line(
    const ContactFace<dim> &contact) const
  {
    const unsigned int along = parameters.tangential_axis(sliding_axis);
    const unsigned int across =
      dim == 3 ? parameters.tangential_axis(1 - sliding_axis) : along;
    const double centre = parameters.size[across] / 2.;

    std::vector<std::pair<double, double>> samples;
    for (const auto &cell_face : contact.cell_faces())
      {
        double nearest = std::numeric_limits<double>::infinity();
        if (dim == 3)
          {
            if (!extent<dim>(cell_face, across).contains(centre))
              continue;
            for (const auto &point : cell_face.points)
              nearest =
                std::min(nearest, std::abs(point.position[across] - centre));
          }
        for (const auto &point : cell_face.points)
          {
            const ContactState &state = point.point.committed();
            if (state.normal_traction <= 0. ||
                (dim == 3 && std::abs(point.position[across] - centre) >
                               nearest + 1e-9 * parameters.size[across]))
              continue;
            const double x = point.position[along];
            samples.emplace_back(slides_backward ? parameters.size[along] - x :
                                                   x,
                                 state.loading_ratio);
          }
      }
    return samples;
  }



  template <int dim>
  double FaceProbes<dim>::slip_front(const ContactFace<dim> &contact,
                                     const double            loading_ratio,
                                     const MPI_Comm         &communicator) const
  {
    using Sample = std::pair<double, double>;
    std::vector<Sample> all;
    for (const auto &part :
         Utilities::MPI::all_gather(communicator,
                                    ratios_along_centre_line(contact)))
      all.insert(all.end(), part.begin(), part.end());
    std::sort(all.begin(), all.end());

    const double length =
      parameters.size[parameters.tangential_axis(sliding_axis)];
    // Points of the two cells beside the line, at the same place, count as one.
    std::vector<Sample> profile;
    for (std::size_t i = 0; i < all.size();)
      {
        std::size_t n   = 0;
        double      sum = 0.;
        for (; i + n < all.size() &&
               all[i + n].first - all[i].first < 1e-9 * length;
             ++n)
          sum += all[i + n].second;
        profile.emplace_back(all[i].first, sum / n);
        i += n;
      }

    for (std::size_t i = 1; i < profile.size(); ++i)
      {
        const double before = profile[i - 1].second - loading_ratio;
        const double after  = profile[i].second - loading_ratio;
        if ((before < 0.) == (after < 0.))
          continue;
        const double distance = crossing(profile, i, loading_ratio);
        return slides_backward ? length - distance : distance;
      }
    return QuantityOfInterest::undefined;
  }



  template class FaceProbes<2>;
  template class FaceProbes<3>;
} // namespace SlipStep
