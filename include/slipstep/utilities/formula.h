// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_utilities_formula_h
#define slipstep_utilities_formula_h

#include <memory>
#include <string>
#include <vector>


namespace SlipStep
{
  /// A formula out of a case file, of one variable or several, as muParser
  /// reads it: + - * / ^, comparisons, a ? b : c, exp, log and ln (both
  /// natural), log10, sqrt, abs, min, max, pow and the like; and pi.
  class ParsedFormula
  {
  public:
    /// @param variable name of the variable, or "" if there is none
    /// @throws InputError that says what is wrong with the text
    explicit ParsedFormula(const std::string &text,
                           const std::string &variable = "");

    /// @param variables their names
    ParsedFormula(const std::string              &text,
                  const std::vector<std::string> &variables);

    /// @param x value of the variable
    double operator()(const double x = 0.) const;

    /// @param values of the variables, in the order of their names
    double operator()(const std::vector<double> &values) const;

  private:
    // muParser keeps the place of the variable, which must not move.
    struct Content;
    std::shared_ptr<Content> content;
  };

  /// Refuse what muParser takes but nobody means: a comma outside of the
  /// arguments of a function, of which it evaluates what follows (a decimal
  /// comma, most likely), and a single =, which assigns.
  /// @param text may have {names}, which are not looked into
  /// @throws InputError with a mark below the place
  void check_formula(const std::string &text);
} // namespace SlipStep

#endif
