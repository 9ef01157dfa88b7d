#include <slipstep/experiment/quantities.h>

#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/nearest_name.h>
#include <slipstep/utilities/units.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace SlipStep
{
  namespace
  {
    using Kind = QuantityOfInterest::Kind;

    const char *const key = "Output/Quantities";

    constexpr std::size_t most_probes = 99;

    /// How each quantity is written: its name, and an example to show.
    struct Form
    {
      Kind        kind;
      std::string name;
      std::string example;
    };

    const std::vector<Form> forms = {
      {Kind::friction_force, "friction force", "friction force at 0.005 mm"},
      {Kind::peak_coefficient, "peak coefficient", "peak coefficient"},
      {Kind::displacement_at_peak,
       "displacement at peak",
       "displacement at peak"},
      {Kind::pressure, "pressure", "pressure at (9.5 mm, 5 mm) after 0.005 mm"},
      {Kind::slip_front, "slip front", "slip front at r = 0.99 after 0.005 mm"},
      {Kind::dissipated_energy,
       "dissipated energy",
       "dissipated energy after 0.005 mm"}};

    std::string squeezed(const std::string &text)
    {
      std::istringstream in(text);
      std::string        result;
      for (std::string word; in >> word;)
        result += (result.empty() ? "" : " ") + word;
      return result;
    }

    /// Path of the drive at the end of each segment [mm].
    std::vector<double> paths(const Programme &programme)
    {
      std::vector<double> result;
      double              path = 0.;
      for (const Segment &segment : programme.segments())
        {
          path +=
            (segment.end.displacement - segment.start.displacement).norm();
          result.push_back(path);
        }
      return result;
    }



    class Reader
    {
    public:
      Reader(const Parameters &parameters, const Programme &programme)
        : parameters(parameters)
        , whole_path(paths(programme).back())
      {}

      std::vector<QuantityOfInterest> read();

    private:
      void read_item(const std::string &item);

      const Form &find_form(const std::string &item) const;

      /// The words from "after" on, removed from @p rest.
      double take_after(std::string &rest) const;

      /// What follows "at", "" if nothing does.
      std::string words_after_at(const std::string &rest) const;

      void read_point(const std::string &text, QuantityOfInterest &quantity);

      void read_ratio(const std::string &text, QuantityOfInterest &quantity);

      double path(const std::string &text) const;

      double length(const std::string &text) const;

      void add(const QuantityOfInterest &quantity);

      [[noreturn]] void fail(const std::string &why) const
      {
        parameters.reject(key, why);
      }

      [[noreturn]] void show_example() const
      {
        fail("'" + present_item + "' is not understood; write e.g. '" +
             present_example + "'");
      }

      const Parameters               &parameters;
      const double                    whole_path;
      std::vector<QuantityOfInterest> quantities;
      std::string                     present_item, present_example;
    };



    std::vector<QuantityOfInterest> Reader::read()
    {
      for (const std::string &item :
           dealii::Utilities::split_string_list(parameters.text(key), ';'))
        if (!item.empty())
          read_item(squeezed(item));
      if (probes_among(quantities).size() > most_probes)
        fail("there can be " + std::to_string(most_probes) +
             " pressures and slip fronts at most");
      return quantities;
    }



    const Form &Reader::find_form(const std::string &item) const
    {
      for (const Form &form : forms)
        if (item == form.name || item.rfind(form.name + " ", 0) == 0)
          return form;

      // As many words as the name has may be misspelt.
      const std::vector<std::string> words =
        dealii::Utilities::split_string_list(item, ' ');
      std::string known;
      for (const Form &form : forms)
        {
          const std::size_t n =
            1 + std::count(form.name.begin(), form.name.end(), ' ');
          std::string beginning;
          for (std::size_t i = 0; i < std::min(n, words.size()); ++i)
            beginning += (i > 0 ? " " : "") + words[i];
          if (!nearest_name(beginning, {form.name}).empty())
            fail("'" + item + "' is no quantity of interest; did you mean '" +
                 form.name + "'?");
          known += (known.empty() ? "" : ", ") + form.name;
        }
      fail("'" + item + "' is no quantity of interest; there are " + known);
    }



    void Reader::read_item(const std::string &item)
    {
      const Form &form = find_form(item);
      present_item     = item;
      present_example  = form.example;
      std::string rest = squeezed(item.substr(form.name.size()));

      QuantityOfInterest quantity;
      quantity.kind = form.kind;
      quantity.name = item;
      if (quantity.is_probe() || form.kind == Kind::dissipated_energy)
        quantity.displacement = take_after(rest);
      const std::string place = words_after_at(rest);

      if (form.kind == Kind::friction_force)
        {
          if (place.empty())
            show_example();
          for (const std::string &text :
               dealii::Utilities::split_string_list(place, ','))
            {
              quantity.displacement = path(text);
              quantity.name         = form.name + " at " + text;
              add(quantity);
            }
          return;
        }
      if (form.kind == Kind::pressure)
        read_point(place, quantity);
      else if (form.kind == Kind::slip_front)
        read_ratio(place, quantity);
      else if (!rest.empty())
        show_example();
      add(quantity);
    }



    double Reader::take_after(std::string &rest) const
    {
      const std::string padded = " " + rest;
      const auto        begin  = padded.find(" after ");
      if (begin == std::string::npos)
        return QuantityOfInterest::undefined;
      const double displacement = path(padded.substr(begin + 7));
      rest                      = squeezed(padded.substr(0, begin));
      return displacement;
    }



    std::string Reader::words_after_at(const std::string &rest) const
    {
      if (rest.empty())
        return "";
      if (rest.rfind("at ", 0) != 0)
        show_example();
      return squeezed(rest.substr(3));
    }



    // "(9.5 mm, 5 mm)", and "9.5 mm" in two dimensions.
    void Reader::read_point(const std::string  &text,
                            QuantityOfInterest &quantity)
    {
      std::string inside = text;
      if (!text.empty() && text.front() == '(' && text.back() == ')')
        inside = text.substr(1, text.size() - 2);
      const auto coordinates =
        dealii::Utilities::split_string_list(inside, ',');
      if (text.empty() || coordinates.empty() || coordinates.size() > 2)
        show_example();
      for (const std::string &coordinate : coordinates)
        quantity.position.push_back(length(coordinate));
    }



    void Reader::read_ratio(const std::string  &text,
                            QuantityOfInterest &quantity)
    {
      if (text.empty())
        return;
      const auto sides = dealii::Utilities::split_string_list(text, '=');
      if (sides.size() != 2 || sides[0] != "r")
        show_example();
      try
        {
          quantity.loading_ratio = parse_quantity(sides[1], Dimension::number);
        }
      catch (const InputError &error)
        {
          fail("'" + present_item + "': " + error.what());
        }
      if (!(quantity.loading_ratio > 0.))
        fail("'" + present_item + "': the loading ratio r must be above 0");
    }



    double Reader::length(const std::string &text) const
    {
      try
        {
          return parse_quantity(text, Dimension::length, true);
        }
      catch (const InputError &error)
        {
          fail("'" + present_item + "': " + error.what());
        }
    }



    double Reader::path(const std::string &text) const
    {
      const double      displacement = length(text);
      const std::string where        = "'" + present_item + "': ";
      if (!(displacement > 0.))
        fail(where + "the displacement must be above 0 mm");
      if (displacement > whole_path * (1. + 1e-9))
        {
          std::ostringstream message;
          if (whole_path > 0.)
            message << where << "the drive moves by " << whole_path
                    << " mm in the whole programme";
          else
            message << where << "the programme does not slide";
          fail(message.str());
        }
      return std::min(displacement, whole_path);
    }



    void Reader::add(const QuantityOfInterest &quantity)
    {
      for (const QuantityOfInterest &other : quantities)
        if (other.name == quantity.name)
          fail("'" + quantity.name + "' is listed twice");
      quantities.push_back(quantity);
    }
  } // namespace



  void declare_quantities(Parameters &parameters)
  {
    parameters.declare(
      key,
      "",
      dealii::Patterns::Anything(),
      "Quantities of interest, evaluated at the end of a run and written to "
      "summary.json, separated by ';': 'friction force at <length>, <length>, "
      "...', 'peak coefficient', 'displacement at peak', 'pressure at "
      "(<length>, <length>)' (a point of the contact face along the axes of "
      "the block; one length in 2-D), 'slip front [at r = <number>]' (where "
      "the loading ratio crosses 0.99 or the number, on the centre line of the "
      "face along the sliding axis, first seen from the rear), 'dissipated "
      "energy'. Those of the face and the energy are taken at the end or "
      "'after <length>'. Displacements are paths of the drive since the "
      "beginning of the programme; between steps a monotone cubic in time "
      "interpolates. Empty: none.");
  }



  std::vector<QuantityOfInterest> parse_quantities(const Parameters &parameters,
                                                   const Programme  &programme)
  {
    return Reader(parameters, programme).read();
  }



  std::vector<QuantityOfInterest>
  probes_among(const std::vector<QuantityOfInterest> &quantities)
  {
    std::vector<QuantityOfInterest> probes;
    std::copy_if(quantities.begin(),
                 quantities.end(),
                 std::back_inserter(probes),
                 [](const auto &quantity) { return quantity.is_probe(); });
    return probes;
  }



  double monotone_interpolation(const std::vector<double> &abscissas,
                                const std::vector<double> &values,
                                const double               x)
  {
    const std::size_t n = abscissas.size();
    if (n == 0 || !(x >= abscissas.front() && x <= abscissas.back()))
      return QuantityOfInterest::undefined;
    if (n == 1)
      return values.front();
    const std::size_t right = std::min<std::size_t>(
      n - 1,
      std::max<std::size_t>(
        1,
        std::lower_bound(abscissas.begin(), abscissas.end(), x) -
          abscissas.begin()));
    const auto step = [&](const std::size_t i) {
      return abscissas[i + 1] - abscissas[i];
    };
    const auto secant = [&](const std::size_t i) {
      return (values[i + 1] - values[i]) / step(i);
    };

    // The slope of a parabola through three points, kept within what leaves the
    // cubic monotone; none where the secants change sign.
    const auto slope = [&](const std::size_t i) {
      if (n == 2)
        return secant(0);
      if (i == 0 || i == n - 1)
        {
          const std::size_t near = i == 0 ? 0 : n - 2, far = i == 0 ? 1 : n - 3;
          const double      h = step(near), H = step(far);
          const double      d = secant(near), D = secant(far);
          const double      parabola = ((2. * h + H) * d - h * D) / (h + H);
          // Undefined neighbours leave the straight line.
          if (!std::isfinite(parabola))
            return d;
          return parabola * d <= 0. ? 0. :
                 d * D <= 0. && std::abs(parabola) > 3. * std::abs(d) ?
                                      3. * d :
                                      parabola;
        }
      const double d = secant(i - 1), D = secant(i);
      if (!std::isfinite(d) || !std::isfinite(D))
        return std::isfinite(d) ? d : D;
      if (d * D <= 0.)
        return 0.;
      const double h = step(i - 1), H = step(i);
      const double parabola = (H * d + h * D) / (h + H);
      const double limit    = 3. * std::min(std::abs(d), std::abs(D));
      return std::copysign(std::min(std::abs(parabola), limit), d);
    };

    const std::size_t left = right - 1;
    const double      h    = step(left);
    const double      t    = (x - abscissas[left]) / h;
    if (t == 0. || t == 1.)
      return values[t == 0. ? left : right];
    const double s = 1. - t;
    return s * s * (1. + 2. * t) * values[left] +
           t * t * (1. + 2. * s) * values[right] +
           t * s * h * (s * slope(left) - t * slope(right));
  }



  namespace
  {
    /// What a history says between its rows.
    class HistoryReader
    {
    public:
      HistoryReader(const Programme               &programme,
                    const std::vector<HistoryRow> &history)
        : programme(programme)
        , history(history)
        , path_after(paths(programme))
      {}

      /// @param displacement path of the drive [mm]; NaN for the end
      template <typename Value>
      double at(const double displacement, const Value &value) const
      {
        std::size_t  segment = programme.segments().size() - 1;
        const double time    = std::isnan(displacement) ?
                                 programme.end_time() :
                                 time_of(displacement, segment);
        return interpolate(segment, time, value);
      }

      /// Force against the motion of the drive, at a path of the drive.
      double friction_force(const double displacement) const
      {
        std::size_t segment = 0;
        const auto  time    = time_of(displacement, segment);
        const auto  motion  = programme.segments()[segment].end.velocity;
        return interpolate(segment, time, [&](const HistoryRow &row) {
          return (motion[0] * row.tangential_load +
                  motion[1] * row.friction_y * row.normal_load) /
                 motion.norm();
        });
      }

      /// Path and value of the largest friction coefficient.
      std::pair<double, double> peak() const;

    private:
      const Programme              &programme;
      const std::vector<HistoryRow> history;
      const std::vector<double>     path_after; ///< of each segment

      double time_of(const double displacement, std::size_t &segment) const;

      double path_at(const double time) const;

      /// Steps end at the borders of segments but for round-off.
      double round_off() const
      {
        return 8. * std::numeric_limits<double>::epsilon() *
               programme.end_time();
      }

      template <typename Value>
      double interpolate(const std::size_t segment,
                         const double      time,
                         const Value      &value) const;
    };



    double HistoryReader::time_of(const double displacement,
                                  std::size_t &segment) const
    {
      segment =
        std::min<std::size_t>(path_after.size() - 1,
                              std::lower_bound(path_after.begin(),
                                               path_after.end(),
                                               displacement * (1. - 1e-12)) -
                                path_after.begin());
      const Segment &moving = programme.segments()[segment];
      const double   before = segment == 0 ? 0. : path_after[segment - 1];
      const double   share =
        (displacement - before) / (path_after[segment] - before);
      return moving.start_time +
             std::min(share, 1.) * (moving.end_time - moving.start_time);
    }



    double HistoryReader::path_at(const double time) const
    {
      const auto &segments = programme.segments();
      std::size_t i        = 0;
      while (i + 1 < segments.size() && time > segments[i].end_time)
        ++i;
      const double before = i == 0 ? 0. : path_after[i - 1];
      const double share  = (time - segments[i].start_time) /
                           (segments[i].end_time - segments[i].start_time);
      return before + std::min(share, 1.) * (path_after[i] - before);
    }



    template <typename Value>
    double HistoryReader::interpolate(const std::size_t segment,
                                      const double      time,
                                      const Value      &value) const
    {
      // A replayed test has a segment per sample, which says nothing about the
      // friction: only the borders of statements are kinks.
      const auto &segments = programme.segments();
      std::size_t first = segment, last = segment;
      while (first > 0 &&
             segments[first - 1].statement == segments[segment].statement)
        --first;
      while (last + 1 < segments.size() &&
             segments[last + 1].statement == segments[segment].statement)
        ++last;
      std::vector<double> times, values;
      for (const HistoryRow &row : history)
        if (row.time >= segments[first].start_time - round_off() &&
            row.time <= segments[last].end_time + round_off())
          {
            times.push_back(row.time);
            values.push_back(value(row));
          }
      if (!times.empty() && std::abs(time - times.back()) <= round_off())
        return values.back();
      return monotone_interpolation(times, values, time);
    }



    // The vertex of the parabola through the largest coefficient and its
    // neighbours, so that the place does not depend on where the steps fall.
    std::pair<double, double> HistoryReader::peak() const
    {
      const auto magnitude = [](const HistoryRow &row) {
        return std::hypot(row.friction, row.friction_y);
      };
      double largest = 0.;
      for (const HistoryRow &row : history)
        largest = std::max(largest, magnitude(row));
      std::size_t i = 0;
      while (i < history.size() &&
             magnitude(history[i]) < (1. - 1e-9) * largest)
        ++i;
      if (i == history.size())
        return {QuantityOfInterest::undefined, QuantityOfInterest::undefined};

      const double x1 = path_at(history[i].time), y1 = magnitude(history[i]);
      if (i > 0 && i + 1 < history.size())
        for (const Segment &segment : programme.segments())
          if (history[i - 1].time >= segment.start_time - round_off() &&
              history[i + 1].time <= segment.end_time + round_off())
            {
              const double h         = x1 - path_at(history[i - 1].time);
              const double H         = path_at(history[i + 1].time) - x1;
              const double d         = (y1 - magnitude(history[i - 1])) / h;
              const double D         = (magnitude(history[i + 1]) - y1) / H;
              const double curvature = (D - d) / (h + H); // half of it
              const double slope     = (H * d + h * D) / (h + H);
              if (h > 0. && H > 0. && curvature < 0.)
                return {x1 - slope / (2. * curvature),
                        y1 - slope * slope / (4. * curvature)};
            }
      return {x1, y1};
    }



    std::string unit(const Kind kind, const unsigned int dimension)
    {
      const std::string per = dimension == 0 ? "/mm^2" :
                              dimension == 2 ? "/mm" :
                                               "";
      switch (kind)
        {
          case Kind::friction_force:
            return "N" + per;
          case Kind::dissipated_energy:
            return "N mm" + per;
          case Kind::pressure:
            return "MPa";
          case Kind::peak_coefficient:
            return "";
          default:
            return "mm";
        }
    }
  } // namespace



  std::vector<QuantityValue>
  evaluate_quantities(const std::vector<QuantityOfInterest> &quantities,
                      const Programme                       &programme,
                      const std::vector<HistoryRow>         &history,
                      const unsigned int                     dimension)
  {
    const HistoryReader        reader(programme, history);
    std::vector<QuantityValue> values;
    std::size_t                n_probes = 0;
    for (const QuantityOfInterest &quantity : quantities)
      {
        QuantityValue result;
        result.name = quantity.name;
        result.unit = unit(quantity.kind, dimension);
        if (quantity.is_probe())
          {
            const std::size_t probe = n_probes++;
            result.value =
              reader.at(quantity.displacement, [&](const HistoryRow &row) {
                return dimension > 0 && probe < row.probes.size() ?
                         row.probes[probe] :
                         QuantityOfInterest::undefined;
              });
          }
        else if (quantity.kind == Kind::friction_force)
          result.value = reader.friction_force(quantity.displacement);
        else if (quantity.kind == Kind::dissipated_energy)
          result.value =
            reader.at(quantity.displacement, [](const HistoryRow &row) {
              return row.dissipated_energy;
            });
        else
          result.value = quantity.kind == Kind::peak_coefficient ?
                           reader.peak().second :
                           reader.peak().first;
        values.push_back(result);
      }
    return values;
  }
} // namespace SlipStep
