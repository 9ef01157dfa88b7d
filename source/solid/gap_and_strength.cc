// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/solid/gap_and_strength.h>

#include <slipstep/utilities/exceptions.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <sstream>

namespace SlipStep
{
  namespace
  {
    const char *const gap_key      = "Contact/Gap";
    const char *const strength_key = "Contact/Strength";

    struct PlaceNames
    {
      std::vector<std::string> names;
      std::vector<double>      lengths; // [mm]
    };



    ParsedFormula read_face_formula(const Parameters  &parameters,
                                    const std::string &key,
                                    const PlaceNames  &face)
    {
      try
        {
          return {parameters.text(key), face.names};
        }
      catch (const InputError &error)
        {
          std::string why = error.what();
          if (why.find('\n') == std::string::npos)
            why += face.names.size() == 1 ?
                     "; the variable is " + face.names[0] + ", in mm" :
                     "; the variables are " + face.names[0] + " and " +
                       face.names[1] + ", in mm";
          parameters.reject(key, why);
        }
    }



    // The ends of n intervals along each axis, or with a shift of a half their
    // midpoints.
    void at_many_places(
      const PlaceNames                                         &face,
      const unsigned int                                        n,
      const double                                              shift,
      const std::function<void(const GapAndStrength::Place &)> &visit)
    {
      const bool is_line = face.names.size() == 1;
      for (unsigned int j = 0; j + shift <= (is_line ? shift : n); ++j)
        for (unsigned int i = 0; i + shift <= n; ++i)
          {
            GapAndStrength::Place place = {face.lengths[0] * (i + shift) / n};
            if (!is_line)
              place.push_back(face.lengths[1] * (j + shift) / n);
            visit(place);
          }
    }



    // By midpoints, n of them along each axis.
    double mean_of(const ParsedFormula &formula,
                   const PlaceNames    &face,
                   const unsigned int   n)
    {
      double sum = 0.;
      at_many_places(face, n, 0.5, [&](const GapAndStrength::Place &place) {
        sum += formula(place);
      });
      return sum / n / (face.names.size() == 1 ? 1 : n);
    }



    [[noreturn]] void reject_value(const Parameters            &parameters,
                                   const std::string           &key,
                                   const PlaceNames            &face,
                                   const GapAndStrength::Place &place,
                                   const double                 value,
                                   const std::string           &allowed)
    {
      std::ostringstream message;
      message << "is " << value << " at";
      for (unsigned int i = 0; i < place.size(); ++i)
        message << (i == 0 ? " " : ", ") << face.names[i] << " = " << place[i]
                << " mm";
      parameters.reject(key, message.str() + "; " + allowed);
    }
  } // namespace



  void GapAndStrength::declare_parameters(Parameters &parameters)
  {
    parameters.declare(
      gap_key,
      "0",
      dealii::Patterns::Anything(),
      "Distance in mm of the contact face from the rigid plane before loading, "
      "a formula of the coordinates in mm along the face (of the bottom: x, and "
      "y in 3-D), e.g. (x - 5)^2/(2*200) for a radius of 200 mm. 0 or more "
      "everywhere. There is no contact before the gap has closed. A block that "
      "nothing holds along the normal stands on the plane at first, so a "
      "constant makes no difference.");
    parameters.declare(
      strength_key,
      "1",
      dealii::Patterns::Anything(),
      "Factor of the strength of friction, a formula of the coordinates in mm "
      "along the face like Gap, e.g. 1 - 0.4*(abs(x - 20) < 2). More than 0 "
      "everywhere, no unit.");
  }



  GapAndStrength::GapAndStrength(const Parameters                &parameters,
                                 const std::vector<unsigned int> &axes,
                                 const std::array<double, 3>     &size,
                                 const bool                       falls)
    : smallest_gap(std::numeric_limits<double>::infinity())
  {
    PlaceNames face;
    for (const unsigned int axis : axes)
      {
        face.names.emplace_back(1, "xyz"[axis]);
        face.lengths.push_back(size[axis]);
      }
    gap_formula      = read_face_formula(parameters, gap_key, face);
    strength_formula = read_face_formula(parameters, strength_key, face);
    // Dense enough for what meshes resolve, and with both ends.
    const unsigned int n = axes.size() == 1 ? 2000 : 200;
    at_many_places(face, n, 0., [&](const Place &place) {
      const double gap = gap_formula(place);
      if (!std::isfinite(gap) || gap < 0.)
        reject_value(
          parameters, gap_key, face, place, gap, "a distance is 0 or more");
      const double factor = strength_formula(place);
      if (!std::isfinite(factor) || !(factor > 0.))
        reject_value(parameters,
                     strength_key,
                     face,
                     place,
                     factor,
                     "a strength is more than 0");
      has_gap      = has_gap || gap != 0.;
      is_graded    = is_graded || factor != 1.;
      smallest_gap = std::min(smallest_gap, gap);
    });
    if (is_graded)
      {
        // The difference of two tells how well it is known.
        const unsigned int fine = axes.size() == 1 ? 6000 : 400;
        mean_factor             = mean_of(strength_formula, face, fine);
        mean_error =
          std::abs(mean_factor - mean_of(strength_formula, face, 3 * fine / 4));
      }
    if (falls)
      datum = smallest_gap;
  }
} // namespace SlipStep
