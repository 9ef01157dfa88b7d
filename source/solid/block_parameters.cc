// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/solid/block_parameters.h>

#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/nearest_name.h>
#include <slipstep/utilities/pattern_words.h>
#include <slipstep/utilities/text.h>

#include <deal.II/base/types.h>
#include <deal.II/base/utilities.h>

#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/predicate.hpp>

#include <cmath>
#include <limits>
#include <sstream>

namespace SlipStep
{
  using dealii::Tensor;

  std::vector<std::string> face_names(const unsigned int dim)
  {
    return dim == 3 ?
             std::vector<std::string>{
               "left", "right", "front", "back", "bottom", "top"} :
             std::vector<std::string>{"left", "right", "bottom", "top"};
  }



  namespace
  {
    const char *const density_key = "Block/Density";
    const char *const damping_key = "Block/Damping time";

    // That the conditions of a face begin with.
    const auto verbs = dealii::Utilities::split_string_list(
      "contact free drive flat pressure traction displacement",
      ' ');



    // Reads the conditions of one face, e.g. "pressure programme; drive; flat".
    class FaceReader
    {
    public:
      FaceReader(const Parameters  &parameters,
                 const std::string &path,
                 const unsigned int dim,
                 const unsigned int face)
        : parameters(parameters)
        , path(path)
        , dim(dim)
        , normal_axis(face / 2)
        , outward_sign(face % 2 == 0 ? -1. : 1.)
      {}

      FaceConditions read()
      {
        for (const std::string &condition :
             dealii::Utilities::split_string_list(parameters.text(path), ';'))
          if (!condition.empty())
            read_condition(condition);
        if (n_conditions == 0)
          parameters.reject(path,
                            "the conditions are missing; write 'free' if there "
                            "are none");
        check_consistency();
        return face;
      }

    private:
      const Parameters  &parameters;
      const std::string  path;
      const unsigned int dim;
      const unsigned int normal_axis;
      const double       outward_sign;
      FaceConditions     face;
      bool               is_free                = false;
      bool               has_programme_pressure = false;
      unsigned int       n_conditions           = 0;

      void read_condition(const std::string &condition)
      {
        ++n_conditions;
        std::istringstream words(condition);
        std::string        verb, rest;
        words >> verb;
        for (std::string word; words >> word;)
          rest += (rest.empty() ? "" : " ") + word;
        const bool is_sudden = take_off_end(rest, "at once");
        if (verb == "contact" || verb == "free" || verb == "drive" ||
            verb == "flat")
          {
            if (is_sudden)
              rest += rest.empty() ? "at once" : " at once";
            if (!rest.empty())
              parameters.reject(path,
                                "'" + verb + "' takes nothing, but '" + rest +
                                  "' follows it");
            set_once(verb == "contact" ? face.is_contact :
                     verb == "free"    ? is_free :
                     verb == "drive"   ? face.is_driven :
                                         face.is_flat,
                     verb);
          }
        else if (verb == "pressure")
          read_pressure(rest, is_sudden);
        else if (verb == "traction")
          read_traction(rest, is_sudden ? at_once : gradual);
        else if (verb == "displacement")
          read_displacement(rest, is_sudden ? at_once : gradual);
        else
          {
            const std::string near = nearest_name(verb, verbs);
            parameters.reject(path,
                              "'" + verb + "' is no condition of a face; " +
                                (near.empty() ?
                                   "there are " +
                                     boost::algorithm::join(verbs, ", ") :
                                   "did you mean '" + near + "'?"));
          }
      }

      // Whether it was there.
      static bool take_off_end(std::string &text, const std::string &end)
      {
        if (!boost::algorithm::ends_with(text, end))
          return false;
        text =
          dealii::Utilities::trim(text.substr(0, text.size() - end.size()));
        return true;
      }

      void set_once(bool &condition, const std::string &name) const
      {
        if (condition)
          parameters.reject(path, "'" + name + "' is given twice");
        condition = true;
      }

      double quantity(const std::string &text, const Dimension dimension) const
      {
        return parameters.attempt(path, [&] {
          return parse_quantity(text, dimension, true);
        });
      }

      // "pressure 5 MPa", "pressure programme", "pressure 3 x programme".
      void read_pressure(std::string text, const bool is_sudden)
      {
        const std::string given           = text;
        const auto        reject_multiple = [&](const std::string &multiple) {
          parameters.reject(path,
                            "'" + multiple +
                              "' is no multiple of the programme's pressure; "
                                     "write e.g. 'pressure 3 x programme'");
        };
        if (!take_off_end(text, "programme"))
          {
            if (text.find("programme") != std::string::npos)
              reject_multiple(given);
            if (text.empty())
              parameters.reject(path,
                                "write e.g. 'pressure 5 MPa', 'pressure "
                                "programme' or 'pressure 3 x programme'");
            face.tractions[is_sudden ? at_once : gradual][normal_axis] -=
              outward_sign * quantity(text, Dimension::stress);
            return;
          }
        if (is_sudden)
          parameters.reject(path,
                            "the programme says when its pressure acts: remove "
                            "'at once'");
        set_once(has_programme_pressure, "pressure programme");
        double times = 1.;
        if (!text.empty())
          {
            const std::string multiple = text;
            if (!take_off_end(text, "x") ||
                !dealii::Patterns::Double().match(text))
              reject_multiple(multiple);
            times = dealii::Utilities::string_to_double(text);
          }
        face.tractions[programme_pressure][normal_axis] -= outward_sign * times;
      }

      // "traction 1 0 0 MPa": one number per direction, one unit.
      void read_traction(const std::string &text, const LoadPart part)
      {
        std::istringstream       in(text);
        std::vector<std::string> words;
        for (std::string word; in >> word;)
          words.push_back(word);
        if (words.size() != dim + 1 || text.find(',') != std::string::npos)
          parameters.reject(path,
                            "write 'traction', without commas, with " +
                              std::to_string(dim) +
                              " numbers and a unit, e.g. 'traction 1 0" +
                              (dim == 3 ? " 0" : "") + " MPa'");
        for (unsigned int d = 0; d < dim; ++d)
          face.tractions[part][d] +=
            quantity(words[d] + " " + words[dim], Dimension::stress);
      }

      // "displacement x 0 mm"
      void read_displacement(const std::string &text, const LoadPart part)
      {
        const std::string axes = dim == 3 ? "xyz" : "xy";
        const auto axis = text.empty() ? std::string::npos : axes.find(text[0]);
        if (axis == std::string::npos || text.size() < 3 || text[1] != ' ')
          parameters.reject(path,
                            "write 'displacement' with an axis (" + axes +
                              ") and a length, e.g. 'displacement x 0 mm'");
        if (face.is_prescribed[axis])
          parameters.reject(path,
                            std::string("the displacement along ") +
                              axes[axis] + " is prescribed twice");
        face.is_prescribed[axis] = true;
        face.displacements[part][axis] =
          quantity(text.substr(2), Dimension::length);
      }

      void check_consistency() const
      {
        if (is_free && n_conditions > 1)
          parameters.reject(path,
                            face.is_driven ?
                              "a face cannot be both driven and free" :
                              "'free' cannot stand beside other conditions");
        if (face.is_contact && n_conditions > 1)
          parameters.reject(path,
                            "'contact' cannot stand beside other conditions");
        if (face.is_flat && face.is_prescribed[normal_axis])
          parameters.reject(path,
                            "a face whose normal displacement is prescribed "
                            "is flat already: remove 'flat'");
      }
    };



    // They would go into the support, all of them.
    void reject_loads_on_supports(const BlockParameters &block,
                                  const Parameters      &parameters)
    {
      const auto names = face_names(block.dimension);
      for (unsigned int f = 0; f < names.size(); ++f)
        for (unsigned int d = 0; d < block.dimension; ++d)
          if (block.faces[f].is_prescribed[d] ||
              (block.faces[f].is_driven && d != block.normal_axis()))
            for (const auto &traction : block.faces[f].tractions)
              if (traction[d] != 0.)
                parameters.reject("Block/Faces/" + names[f],
                                  std::string("the displacement along ") +
                                    "xyz"[d] +
                                    " is prescribed, so a load along it "
                                    "changes nothing: remove one of the two");
    }



    void read_size(BlockParameters &block, const Parameters &parameters)
    {
      const auto lengths = parameters.list("Block/Size");
      const auto cells   = parameters.list("Block/Subdivisions");
      for (const auto &[key, entries] :
           {std::make_pair("Block/Size", lengths),
            std::make_pair("Block/Subdivisions", cells)})
        if (entries.size() != block.dimension)
          parameters.reject(key,
                            "needs " + std::to_string(block.dimension) +
                              " numbers because Block/Dimension is " +
                              std::to_string(block.dimension));
      block.size.fill(1.);
      block.subdivisions.fill(1);
      for (unsigned int d = 0; d < block.dimension; ++d)
        {
          block.size[d]         = parse_quantity(lengths[d], Dimension::length);
          block.subdivisions[d] = dealii::Utilities::string_to_int(cells[d]);
        }
    }



    void check_number_of_cells(const BlockParameters &block,
                               const Parameters      &parameters)
    {
      if (block.n_unknowns() >
          std::numeric_limits<dealii::types::global_dof_index>::max())
        parameters.reject(block.key_of_cells(),
                          "these are " + short_text(block.n_unknowns(), 6) +
                            " unknowns, more than the program can number; take "
                            "fewer cells");
      if (block.refinement.type == RefinementType::adaptive &&
          block.n_cells() > block.refinement.most_cells)
        parameters.reject("Block/Adaptivity/Most cells",
                          "the subdivisions alone are " +
                            short_text(block.n_cells(), 6) + " cells");
    }



    void read_faces(BlockParameters &block, const Parameters &parameters)
    {
      bool       has_contact = false;
      const auto names       = face_names(block.dimension);
      for (unsigned int f = 0; f < names.size(); ++f)
        {
          const std::string path = "Block/Faces/" + names[f];
          block.faces[f] =
            FaceReader(parameters, path, block.dimension, f).read();
          if (!block.faces[f].is_contact)
            continue;
          // Blame the line in the file, not the default.
          const std::string first = "Block/Faces/" + names[block.contact_face];
          const bool        blame_first = !parameters.is_set(path);
          if (has_contact)
            parameters.reject(blame_first ? first : path,
                              "one face is in contact with the plane, but so "
                              "is " +
                                (blame_first ? path : first));
          block.contact_face = f;
          has_contact        = true;
        }
      if (block.dimension == 2)
        for (const std::string path : {"Block/Faces/front", "Block/Faces/back"})
          if (parameters.is_set(path) && parameters.text(path) != "free")
            parameters.reject(path, "a block in 2-D has no such face");
      if (!has_contact)
        parameters.reject("Block/Faces/bottom",
                          "no face is in contact: give one face 'contact'");
    }



    void check_supports(const BlockParameters &block,
                        const Parameters      &parameters)
    {
      const auto names = face_names(block.dimension);
      for (unsigned int f = 0; f < names.size(); ++f)
        for (unsigned int d = 0; d < block.dimension; ++d)
          if (block.faces[f].is_driven && block.faces[f].is_prescribed[d] &&
              d != block.normal_axis())
            parameters.reject("Block/Faces/" + names[f],
                              "'drive' prescribes the displacements in the "
                              "contact plane already");
    }



    void check_motion(const BlockParameters &block,
                      const Parameters      &parameters,
                      const Programme       &programme)
    {
      const bool is_driven =
        any_of(block.faces,
               [](const FaceConditions &face) { return face.is_driven; });
      for (const Segment &segment : programme.segments())
        if (!is_driven && (segment.pushes || segment.end.velocity.norm() > 0.))
          parameters.reject("Loading/Programme",
                            std::string("the programme ") +
                              (segment.pushes ? "pushes" : "slides") +
                              ", but no face of the block has 'drive'");
      if (block.dimension == 2)
        for (const Segment &segment : programme.segments())
          for (const auto &direction : {segment.end.velocity, segment.push})
            if (std::abs(direction[1]) > 1e-12 * direction.norm())
              parameters.reject("Loading/Programme",
                                "a block in 2-D can slide and be pushed at 0 "
                                "or 180 deg only; other directions need "
                                "Block/Dimension = 3, on one point, too");
    }



    // A flat face must be free to move as a whole.
    void check_flat_faces(const BlockParameters &block,
                          const Parameters      &parameters)
    {
      const auto names = face_names(block.dimension);
      for (unsigned int f = 0; f < names.size(); ++f)
        for (unsigned int g = 0; g < names.size(); ++g)
          if (block.faces[f].is_flat && g / 2 != f / 2 && block.holds(g, f / 2))
            parameters.reject(
              "Block/Faces/" + names[f],
              "the face cannot be kept flat, because face '" + names[g] +
                "' prescribes the displacement normal to it along "
                "their common edge");
    }



    // Without pressure the block would drift away.
    void check_pressure(const BlockParameters &block,
                        const Parameters      &parameters,
                        const Programme       &programme)
    {
      const bool begins_pressed =
        programme.segments().front().end.pressure > 0.;
      const LoadFactors  all    = {{begins_pressed ? 1. : 0., 1., 1., 0., 0.}};
      const unsigned int normal = block.normal_axis();
      for (const FaceConditions &face : block.faces)
        for (unsigned int k = 0; k < n_load_parts; ++k)
          if (all[k] * face.tractions[k][normal] * block.outward_sign() > 0. ||
              face.displacements[k][normal] * block.outward_sign() > 0.)
            return;
      parameters.reject(
        begins_pressed ? "Block/Faces/top" : "Loading/Programme",
        begins_pressed ?
          "no contact pressure: the programme presses, but no face has "
          "'pressure programme' towards it, nor does any other load press the "
          "block on the plane" :
          "no contact pressure: nothing presses the block on the plane; begin "
          "with e.g. 'press 5.8 MPa in 1 s'");
    }



    void read_surface(BlockParameters &block, const Parameters &parameters)
    {
      std::vector<unsigned int> axes;
      for (unsigned int i = 0; i + 1 < block.dimension; ++i)
        axes.push_back(block.tangential_axis(i));
      block.surface = GapAndStrength(parameters,
                                     axes,
                                     block.size,
                                     !block.is_held_along_normal());

      // What is moved without a load goes as far as it is moved.
      double farthest = 0.;
      for (const FaceConditions &face : block.faces)
        {
          double motion = 0.;
          for (unsigned int k = 0; k < n_load_parts; ++k)
            {
              if (face.tractions[k] != dealii::Tensor<1, 3>())
                return;
              motion += block.outward_sign() *
                        face.displacements[k][block.normal_axis()];
            }
          farthest = std::max(farthest, motion);
        }
      if (block.surface.is_curved() && block.surface.least_gap() >= farthest)
        parameters.reject("Contact/Gap",
                          "is " + short_text(block.surface.least_gap(), 6) +
                            " mm or more everywhere, but the block is moved "
                            "by " +
                            short_text(farthest, 6) +
                            " mm towards the plane: it never touches");
    }
  } // namespace



  void BlockParameters::declare_parameters(Parameters &parameters)
  {
    using namespace dealii::Patterns;
    parameters.declare("Block/Dimension",
                       "3",
                       Integer(2, 3),
                       "2 for plane strain (forces per mm of thickness) or 3.");
    parameters.declare("Block/Size",
                       "10 mm, 10 mm, 10 mm",
                       List(Quantity(Dimension::length, 0., 1e30, true), 2, 3),
                       "Lengths of the box along x, y (and z). More than 0, in "
                       "mm unless a unit is given.");
    parameters.declare("Block/Subdivisions",
                       "4, 4, 4",
                       List(Integer(1, 100000), 2, 3),
                       "Number of cells along x, y (and z). 1 or more each.");
    RefinementParameters::declare_parameters(parameters);
    parameters.declare(
      "Block/Degree",
      "2",
      Integer(1, largest_degree),
      "Polynomial degree of the elements: 1 for Q1, 2 for Q2. Q2 needs fewer "
      "unknowns for the same error and less time for each of them.");
    parameters.declare("Block/Young modulus",
                       "206 GPa",
                       Quantity(Dimension::stress, 0., 1e30, true),
                       "Young's modulus E of the block. More than 0, in MPa "
                       "unless a unit is given.");
    parameters.declare("Block/Poisson ratio",
                       "0.3",
                       Quantity(Dimension::number, -0.99, 0.4999),
                       "Poisson's ratio nu of the block. Between -0.99 and "
                       "0.4999, no unit.");
    parameters.declare(
      density_key,
      "0 kg/m^3",
      Quantity(Dimension::density, 0., 1., false, true),
      "Density rho of the block, with its unit. With it the block has inertia "
      "and carries waves, of speeds sqrt(G/rho) in shear and sqrt((lambda + 2 "
      "G)/rho) in compression; with 0 it is in equilibrium at all times. "
      "Oscillations are resolved if the time steps are short enough; those far "
      "quicker than a step die out within it. 0 to 1 t/mm^3.");
    parameters.declare(
      damping_key,
      "0",
      Quantity(Dimension::time, 0., 1e30),
      "Damping of a block with a density: its stress is that of the strain eps "
      "+ t deps/dt with this time t (Kelvin and Voigt). An oscillation of "
      "frequency f then fades as with a damping ratio of pi f t: a value of "
      "some tenths of the time in which a wave crosses a cell smooths out what "
      "a mesh cannot resolve. 0 or more, in s unless a unit is given. Only "
      "with Block/Density.");
    for (const std::string &name : face_names(3))
      parameters.declare(
        "Block/Faces/" + name,
        name == "bottom" ? "contact" :
        name == "top"    ? "pressure programme; drive" :
                           "free",
        AnythingWithWords(dealii::Utilities::split_string_list(
          "contact free drive flat pressure programme traction displacement at "
          "once",
          ' ')),
        "Conditions on the face at " +
          std::string(name == "left"   ? "x = 0" :
                      name == "right"  ? "the end of x" :
                      name == "front"  ? "y = 0 (3-D only)" :
                      name == "back"   ? "the end of y (3-D only)" :
                      name == "bottom" ? "z = 0 (y = 0 in 2-D)" :
                                         "the end of z (of y in 2-D)") +
          ", separated by ';': 'free', 'contact' (with the rigid plane; one "
          "face), 'drive' (displacements in the contact plane follow the "
          "programme), 'pressure programme', 'pressure 3 x programme', "
          "'pressure 5 MPa', 'traction 1 0 0 MPa', 'displacement x 0 mm', "
          "'flat' (same normal displacement everywhere). Loads and "
          "displacements that do not follow the programme grow linearly over "
          "the first statement of the programme (of 'follow': over its first "
          "interval); with 'at once' behind them they act from the first step "
          "on.");
    parameters.declare(
      "Block/Solver",
      "automatic",
      Selection("automatic|multigrid|amg|direct"),
      "Preconditioner of the Krylov solver: 'multigrid' is geometric, with "
      "matrix-free products, for meshes that can be coarsened; "
      "'amg' is algebraic multigrid with rigid-body modes; "
      "'direct' factorises a recent tangent, on one process; "
      "'automatic' takes direct below 3000 unknowns, else multigrid; where "
      "that does not converge, amg and then direct take over for the rest of "
      "the statement, with a warning.");
    parameters.declare("Block/Newton tolerance",
                       "1e-8",
                       Quantity(Dimension::number, 1e-14, 1e-2),
                       "Norm of the unbalanced forces at which Newton's method "
                       "stops, relative to the contact forces. A smaller one "
                       "is used where the block is far softer than its "
                       "contact. Between 1e-14 and 0.01, no unit.");
    parameters.declare("Block/Newton iterations",
                       "40",
                       Integer(2, 1000),
                       "Iterations after which the time step is cut. 2 or "
                       "more.");
    FieldSchedule::declare_parameters(parameters);
    GapAndStrength::declare_parameters(parameters);
  }



  BlockParameters::BlockParameters(const Parameters &parameters,
                                   const Programme  &programme)
    : dimension(parameters.integer("Block/Dimension"))
    , refinement(parameters)
    , degree(parameters.integer("Block/Degree"))
    , young_modulus(parameters.number("Block/Young modulus"))
    , poisson_ratio(parameters.number("Block/Poisson ratio"))
    , density(parameters.number(density_key))
    , damping_time(parameters.number(damping_key))
    , newton_tolerance(parameters.number("Block/Newton tolerance"))
    , newton_iterations(parameters.integer("Block/Newton iterations"))
    , fields(parameters)
  {
    read_size(*this, parameters);
    if (damping_time > 0. && !is_dynamic())
      parameters.reject(damping_key,
                        "damps the motion of a block that has a mass; give " +
                          std::string(density_key) + ", too");
    check_number_of_cells(*this, parameters);
    read_faces(*this, parameters);
    check_supports(*this, parameters);
    reject_loads_on_supports(*this, parameters);
    check_motion(*this, parameters, programme);
    check_flat_faces(*this, parameters);
    check_pressure(*this, parameters, programme);
    read_surface(*this, parameters);

    const std::string solver_name = parameters.text("Block/Solver");
    solver = (solver_name == "direct"    ? SolverType::direct :
              solver_name == "amg"       ? SolverType::amg :
              solver_name == "multigrid" ? SolverType::multigrid :
                                           SolverType::automatic);
  }



  double BlockParameters::n_cells() const
  {
    double n = 1.;
    for (unsigned int d = 0; d < dimension; ++d)
      n *= static_cast<double>(refinement.initial_cells_per_subdivision()) *
           subdivisions[d];
    return n;
  }



  double BlockParameters::n_unknowns() const
  {
    double n = dimension;
    for (unsigned int d = 0; d < dimension; ++d)
      n *= 1. + static_cast<double>(degree) *
                  refinement.initial_cells_per_subdivision() * subdivisions[d];
    return n;
  }



  double BlockParameters::least_memory(const double n_unknowns) const
  {
    // Mesh, vectors and matrix-free data of a run take 347 bytes per unknown of
    // Q2 elements, and more of Q1.
    if (solver_for(n_unknowns) == SolverType::multigrid)
      return n_unknowns * 350. / 1e6;
    return memory_of_matrix(n_unknowns);
  }



  double BlockParameters::memory_of_matrix(const double n_unknowns) const
  {
    // An unknown is coupled with those of 2^dim cells; in the interior of cells
    // of higher degree with fewer, hence the half.
    const double couplings =
      0.5 * dimension * std::pow(2. * degree + 1., dimension);
    return n_unknowns * couplings *
           (sizeof(double) + sizeof(dealii::types::global_dof_index)) / 1e6;
  }



  std::string BlockParameters::key_of_cells() const
  {
    return refinement.initial_cells_per_subdivision() > 1 ?
             "Block/Refinement" :
             "Block/Subdivisions";
  }



  double BlockParameters::nominal_contact_area() const
  {
    double area = 1.;
    for (unsigned int i = 0; i + 1 < dimension; ++i)
      area *= size[tangential_axis(i)];
    return area;
  }



  double BlockParameters::time_of_first_wave() const
  {
    return is_dynamic() ?
             size[normal_axis()] /
               std::sqrt((lame_lambda() + 2. * shear_modulus()) / density) :
             0.;
  }
} // namespace SlipStep
