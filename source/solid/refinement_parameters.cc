// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/solid/refinement_parameters.h>

#include <slipstep/solid/mesh_goal.h>
#include <slipstep/utilities/nearest_name.h>
#include <slipstep/utilities/pattern_words.h>

#include <unistd.h>

#include <sstream>

namespace SlipStep
{
  namespace
  {
    const std::string kind_key = "Block/Refinement";
    const std::string section  = "Block/Adaptivity";

    // A cell that is halved more often than this is smaller than a billionth of
    // the block.
    const unsigned int most_levels = 10;



    unsigned int read_levels(const Parameters  &parameters,
                             const std::string &kind,
                             const std::string &text)
    {
      const bool is_number =
        !text.empty() && text.size() < 9 &&
        text.find_first_not_of("0123456789") == std::string::npos;
      const unsigned int least  = kind == "adaptive" ? 1 : 0;
      const unsigned int levels = is_number ? std::stoul(text) : 0;
      if (!is_number || levels < least || levels > most_levels)
        parameters.reject(kind_key,
                          "write '" + kind +
                            "' with a number of levels between " +
                            std::to_string(least) + " and " +
                            std::to_string(most_levels) + ", e.g. '" + kind +
                            " 2'");
      return levels;
    }
  } // namespace



  double installed_memory()
  {
    return 1e-6 * sysconf(_SC_PHYS_PAGES) *
           static_cast<double>(sysconf(_SC_PAGESIZE));
  }



  void RefinementParameters::declare_parameters(Parameters &parameters)
  {
    using namespace dealii::Patterns;
    parameters.declare(
      kind_key,
      "none",
      AnythingWithWords({"none", "uniform", "adaptive"}),
      "'none': the subdivisions are the cells; 'uniform N': each is halved N "
      "times in all directions, 0 to 10; 'adaptive N': cells are refined and "
      "merged during the run, at most N times finer than the subdivisions, 1 "
      "to 10 (see section Adaptivity).");
    parameters.declare(
      section + "/Goal",
      "energy",
      Selection("energy|contact"),
      "Quantity for which the mesh is refined and to whose error the tolerance "
      "applies: 'energy' is the stress in the whole block, in the energy norm; "
      "'contact' is the traction on the contact face, in the L2 norm, so that "
      "a cell counts the less the farther it is from the plane: for pressures "
      "at edges and corners of the face, also in 3-D.");
    parameters.declare(
      section + "/Tolerance",
      "0.01",
      Quantity(Dimension::number, 1e-6, 1.),
      "Error at which the mesh is fine enough, as estimated from jumps of "
      "stress, from the misfit of tractions and from the border between stick "
      "and slip, in the norm of the goal and relative to that of the solution. "
      "While the error is larger, cells are refined that have more than an "
      "equal share of the tolerated one. A warning says so if limits leave a "
      "larger error than the tolerance. Between 1e-6 and 1, no unit.");
    parameters.declare(
      section + "/Merging share",
      "0.5",
      Quantity(Dimension::number, 0., 0.9),
      "Cells are merged if the cell made of them may be expected to have less "
      "than this share of the error for which it would be refined again. "
      "Between 0 (never) and 0.9, no unit.");
    parameters.declare(section + "/Steps between checks",
                       "1",
                       Integer(1, 1000000),
                       "Number of steps after which the mesh is checked again. "
                       "1 or more.");
    parameters.declare(
      section + "/Most repeats",
      "3",
      Integer(0, 100),
      "How often, at most, a step that needs a finer mesh is repeated on it; "
      "with 0 the mesh changes only after the step.");
    parameters.declare(section + "/Most cells",
                       "1000000",
                       Quantity(Dimension::number, 1., 1e15),
                       "Number of cells above which the mesh does not grow. 1 "
                       "or more.");
    parameters.declare(
      section + "/Most memory",
      "0",
      Quantity(Dimension::number, 0., 1e12),
      "Memory in MB that the solver may need on the largest mesh, as estimated "
      "from its unknowns; 0 for the memory of the machine.");
    parameters.declare(
      section + "/Beyond the limit",
      "stop",
      Selection("stop|warn"),
      "What happens if more cells are wanted than are allowed: 'stop' ends the "
      "run, 'warn' refines only where the error is largest and says so in the "
      "summary.");
  }



  RefinementParameters::RefinementParameters(const Parameters &parameters)
    : tolerance(parameters.number(section + "/Tolerance"))
    , merging_share(parameters.number(section + "/Merging share"))
    , check_interval(parameters.integer(section + "/Steps between checks"))
    , most_repeats(parameters.integer(section + "/Most repeats"))
    , most_cells(parameters.number(section + "/Most cells"))
    , most_memory(parameters.number(section + "/Most memory"))
    , stop_at_cap(parameters.text(section + "/Beyond the limit") == "stop")
    , goal(parameters.text(section + "/Goal") == "contact" ? MeshGoal::contact :
                                                             MeshGoal::energy)
  {
    std::istringstream words(parameters.text(kind_key));
    std::string        kind, rest;
    words >> kind;
    std::getline(words >> std::ws, rest);
    if (kind == "none")
      {
        if (!rest.empty())
          parameters.reject(kind_key,
                            "'none' takes nothing, but '" + rest +
                              "' follows it");
      }
    else if (kind == "uniform" || kind == "adaptive")
      {
        type   = kind == "uniform" ? RefinementType::uniform :
                                     RefinementType::adaptive;
        levels = read_levels(parameters, kind, rest);
      }
    else
      parameters.reject(kind_key,
                        "'" + kind +
                          "' is no kind of refinement; there are 'none', "
                          "'uniform N' and 'adaptive N'" +
                          did_you_mean(kind, {"none", "uniform", "adaptive"}));

    if (most_memory == 0.)
      most_memory = installed_memory();
    for (const std::string &unused : inactive_sections(parameters))
      for (const std::string &path : parameters.paths(unused + "/"))
        if (parameters.is_set(path) &&
            parameters.layer(path) >= parameters.layer(kind_key))
          parameters.reject(path,
                            "the mesh is not adaptive: write e.g. 'set "
                            "Refinement = adaptive 3' in section Block or "
                            "remove this line");
  }



  std::set<std::string>
  RefinementParameters::inactive_sections(const Parameters &parameters)
  {
    std::istringstream words(parameters.text(kind_key));
    std::string        kind;
    words >> kind;
    return kind == "adaptive" ? std::set<std::string>{} :
                                std::set<std::string>{section};
  }
} // namespace SlipStep
