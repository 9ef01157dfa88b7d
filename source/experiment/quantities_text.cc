// SPDX-License-Identifier: LGPL-2.1-or-later

// How quantities of interest are written.

#include <slipstep/experiment/quantities.h>

#include <slipstep/experiment/programme.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/nearest_name.h>
#include <slipstep/utilities/pattern_words.h>
#include <slipstep/utilities/text.h>
#include <slipstep/utilities/units.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <sstream>

namespace SlipStep
{
  namespace
  {
    using Kind = QuantityOfInterest::Kind;

    const char *const quantities_key = "Output/Quantities";

    const std::vector<std::string> face_names =
      {"left", "right", "front", "back", "bottom", "top"};

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
      {Kind::largest_pressure,
       "largest pressure",
       "largest pressure after 0.005 mm"},
      {Kind::smallest_pressure,
       "smallest pressure",
       "smallest pressure after 0.005 mm"},
      {Kind::displacement,
       "displacement",
       "displacement x at (9.5 mm, 5 mm, 10 mm) after 0.005 mm"},
      {Kind::force, "force", "force x on right after 0.005 mm"},
      {Kind::moment, "moment", "moment z on right after 0.005 mm"},
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

    class Reader
    {
    public:
      Reader(const Parameters &parameters, const Programme &programme)
        : parameters(parameters)
        , whole_path(SlidingPath(programme).whole())
        , pushes(any_of(programme.segments(),
                        [](const Segment &one) { return one.pushes; }))
      {}

      std::vector<QuantityOfInterest> read()
      {
        for (const std::string &item : dealii::Utilities::split_string_list(
               parameters.text(quantities_key), ';'))
          if (!item.empty())
            read_item(squeezed(item));
        if (probes_among(quantities).size() > most_probes)
          fail("there can be at most " + std::to_string(most_probes) +
               " quantities that are evaluated step by step (all but friction "
               "force, peak and dissipated energy)");
        return quantities;
      }

    private:
      void read_item(const std::string &item)
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
        if (quantity.has_component())
          quantity.component = take_component(rest);
        if (form.kind == Kind::force || form.kind == Kind::moment)
          {
            read_face(rest, quantity);
            return add(quantity);
          }
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
          read_point(place, 2, quantity);
        else if (form.kind == Kind::displacement)
          read_point(place, 3, quantity);
        else if (form.kind == Kind::slip_front)
          read_ratio(place, quantity);
        else if (!rest.empty())
          show_example();
        add(quantity);
      }

      const Form &find_form(const std::string &item) const
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

      /// The words from "after" on, removed from @p rest.
      double take_after(std::string &rest) const
      {
        const std::string padded = " " + rest;
        const auto        begin  = padded.find(" after ");
        if (begin == std::string::npos)
          return QuantityOfInterest::undefined;
        const double displacement = path(padded.substr(begin + 7));
        rest                      = squeezed(padded.substr(0, begin));
        return displacement;
      }

      /// "x", "y" or "z", removed from @p rest.
      unsigned int take_component(std::string &rest) const
      {
        const std::string axes = "xyz";
        if (rest.size() < 2 || axes.find(rest[0]) == std::string::npos ||
            rest[1] != ' ')
          show_example();
        const unsigned int component = axes.find(rest[0]);
        rest                         = rest.substr(2);
        return component;
      }

      /// What follows "at", "" if nothing does.
      std::string words_after_at(const std::string &rest) const
      {
        if (rest.empty())
          return "";
        if (rest.rfind("at ", 0) != 0)
          show_example();
        return squeezed(rest.substr(3));
      }

      // "(9.5 mm, 5 mm)", and "9.5 mm" for a single coordinate.
      void read_point(const std::string  &text,
                      const std::size_t   most_coordinates,
                      QuantityOfInterest &quantity)
      {
        std::string inside = text;
        if (!text.empty() && text.front() == '(' && text.back() == ')')
          inside = text.substr(1, text.size() - 2);
        const auto coordinates =
          dealii::Utilities::split_string_list(inside, ',');
        if (text.empty() || coordinates.empty() ||
            coordinates.size() > most_coordinates)
          show_example();
        for (const std::string &coordinate : coordinates)
          quantity.position.push_back(number(coordinate, Dimension::length));
      }

      void read_face(const std::string &text, QuantityOfInterest &quantity)
      {
        if (text.rfind("on ", 0) != 0)
          show_example();
        quantity.face = text.substr(3);
        if (!holds(face_names, quantity.face))
          fail("'" + present_item + "': '" + quantity.face +
               "' is no face of the block; there are left, right, front, back, "
               "bottom, top" +
               did_you_mean(quantity.face, face_names));
      }

      void read_ratio(const std::string &text, QuantityOfInterest &quantity)
      {
        if (text.empty())
          return;
        const auto sides = dealii::Utilities::split_string_list(text, '=');
        if (sides.size() != 2 || sides[0] != "r")
          show_example();
        quantity.loading_ratio = number(sides[1], Dimension::number);
        if (!(quantity.loading_ratio > 0.))
          fail("'" + present_item + "': the loading ratio r must be above 0");
      }

      double path(const std::string &text) const
      {
        const double      displacement = number(text, Dimension::length);
        const std::string where        = "'" + present_item + "': ";
        if (!(displacement > 0.))
          fail(where + "the displacement must be above 0 mm");
        if (pushes && whole_path > 0.)
          fail(where + "how far a push moves the drive is known only after the "
                       "run, so a displacement of the drive cannot be named");
        if (displacement > whole_path * (1. + 1e-9))
          fail(where + (whole_path > 0. ?
                          "the drive moves by " + short_text(whole_path, 6) +
                            " mm in the whole programme" :
                          "the programme does not slide"));
        return std::min(displacement, whole_path);
      }

      double number(const std::string &text, const Dimension dimension) const
      {
        try
          {
            return parse_quantity(text,
                                  dimension,
                                  dimension != Dimension::number);
          }
        catch (const InputError &error)
          {
            fail("'" + present_item + "': " + error.what());
          }
      }

      void add(const QuantityOfInterest &quantity)
      {
        for (const QuantityOfInterest &other : quantities)
          if (other.name == quantity.name)
            fail("'" + quantity.name + "' is listed twice");
        quantities.push_back(quantity);
      }

      [[noreturn]] void fail(const std::string &why) const
      {
        parameters.reject(quantities_key, why);
      }

      [[noreturn]] void show_example() const
      {
        fail("'" + present_item + "' is not understood; write e.g. '" +
             present_example + "'");
      }

      const Parameters               &parameters;
      const double                    whole_path;
      const bool                      pushes;
      std::vector<QuantityOfInterest> quantities;
      std::string                     present_item, present_example;
    };



    std::vector<std::string> words_of_quantities()
    {
      std::vector<std::string> words = {"at", "on", "after"};
      words.insert(words.end(), face_names.begin(), face_names.end());
      for (const Form &form : forms)
        for (const std::string &word :
             dealii::Utilities::split_string_list(form.name, ' '))
          words.push_back(word);
      return words;
    }
  } // namespace



  void declare_quantities(Parameters &parameters)
  {
    parameters.declare(
      quantities_key,
      "",
      AnythingWithWords(words_of_quantities()),
      "Quantities of interest, evaluated at the end of a run and written to "
      "summary.json, separated by ';': 'friction force at <length>, <length>, "
      "...', 'peak coefficient', 'displacement at peak', 'pressure at "
      "(<length>, <length>)' (a point of the contact face along the axes of "
      "the block; one length in 2-D), 'largest pressure' and 'smallest "
      "pressure' (among the contact points, 0 where the face is open), "
      "'displacement x|y|z at (<length>, <length>[, <length>])' (in space, of "
      "a point of the block), 'force x|y|z on <face>' (on the block through a "
      "face, left, right, front, back, bottom or top: reaction of supports and "
      "of the drive, loads, contact), 'moment x|y|z on <face>' (of these "
      "forces, about the centre of the face; only z in 2-D), 'slip front [at r "
      "= <number>]' (where the loading ratio crosses 0.99 or the number, on "
      "the centre line of the face along the sliding axis, first seen from the "
      "rear), 'dissipated energy'. All but the first three are taken at the "
      "end or 'after <length>'. This length, that of the friction force and "
      "the displacement at peak are paths of the drive since the beginning of "
      "the programme; between steps quantities are interpolated by a monotone "
      "cubic in time. Empty: none.");
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
} // namespace SlipStep
