// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tests_utilities_declared_parameters_h
#define tests_utilities_declared_parameters_h

// A few parameters, and cases that set them.

#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/parameters.h>

#include <deal.II/base/patterns.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/temporary_folder.h"

namespace SlipStep::Testing
{
  namespace Patterns = dealii::Patterns;

  inline Parameters declared()
  {
    Parameters p;
    p.declare("Title", "none", Patterns::Anything(), "A text.");
    p.declare("Friction/Effects",
              "subloading, softening",
              Patterns::MultipleSelection("subloading|softening|healing"),
              "What acts.");
    p.declare("Friction/softening/Rate",
              "0.045",
              Quantity(Dimension::per_length, 0.),
              "How fast it softens.");
    p.declare("Friction/healing/Rate",
              "0",
              Quantity(Dimension::per_time, 0.),
              "How fast it heals.");
    p.declare("Loading/Speed",
              "1 mm/min",
              Quantity(Dimension::speed, 0.),
              "Of the drive.");
    p.declare("Block/Degree", "1", Patterns::Integer(1, 2), "Of elements.");
    p.declare("Block/Form", "box", Patterns::Selection("box|wedge"), "Shape.");
    p.declare("Block/Ratio", "0.5", Patterns::Double(0., 0.5), "A number.");
    p.declare("Block/Curved", "false", Patterns::Bool(), "A switch.");
    p.declare("Block/Size",
              "10, 20 mm",
              Patterns::List(Quantity(Dimension::length, 0.), 2, 3),
              "Edges.");
    return p;
  }



  class ParametersTest : public testing::Test
  {
  protected:
    std::filesystem::path write(const std::string &name,
                                const std::string &text) const
    {
      std::ofstream(folder / name) << text;
      return folder / name;
    }

    Parameters read(const std::string &text) const
    {
      Parameters p = declared();
      p.read(write("case.prm", text));
      return p;
    }

    // The message, with the folder cut out.
    std::string error_of(const std::string &text) const
    {
      try
        {
          read(text);
        }
      catch (const InputError &error)
        {
          std::string message = error.what();
          for (std::size_t at;
               (at = message.find(folder.string() + "/")) != std::string::npos;)
            message.erase(at, folder.string().size() + 1);
          return message;
        }
      return "";
    }

    const std::filesystem::path folder = test_folder();
  };
} // namespace SlipStep::Testing

#endif
