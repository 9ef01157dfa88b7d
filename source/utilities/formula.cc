// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/numbers.h>

#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/formula.h>
#include <slipstep/utilities/text.h>

#include <muParser.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <vector>

namespace SlipStep
{
  struct ParsedFormula::Content
  {
    std::vector<double> values;
    mu::Parser          parser;
  };



  namespace
  {
    [[noreturn]] void fail(const std::string &text,
                           const std::size_t  column,
                           const std::string &why)
    {
      // Letters of several bytes are one wide.
      std::size_t width = 0;
      for (std::size_t i = 0; i < column; ++i)
        width += (text[i] & 0xC0) != 0x80;
      throw InputError(why + "\n  " + text + "\n  " + std::string(width, ' ') +
                       "^");
    }



    bool ends_name(const std::string &text, const std::size_t end)
    {
      std::size_t last = end;
      while (last > 0 && text[last - 1] == ' ')
        --last;
      return last > 0 &&
             (std::isalnum(static_cast<unsigned char>(text[last - 1])) != 0 ||
              text[last - 1] == '_');
    }



    // Beyond those that muParser has, the ones of deal.II's parser.
    void define_functions(mu::Parser &parser)
    {
      using Unary  = double (*)(double);
      using Binary = double (*)(double, double);
      parser.DefineFun("pow", static_cast<Binary>(std::pow));
      parser.DefineFun("ceil", static_cast<Unary>(std::ceil));
      parser.DefineFun("floor", static_cast<Unary>(std::floor));
      parser.DefineFun("int", static_cast<Unary>(std::round));
      parser.DefineFun("erf", static_cast<Unary>(std::erf));
      parser.DefineFun("erfc", static_cast<Unary>(std::erfc));
      parser.DefineFun(
        "cot", +[](double x) { return 1. / std::tan(x); });
      parser.DefineFun(
        "csc", +[](double x) { return 1. / std::sin(x); });
      parser.DefineFun(
        "sec", +[](double x) { return 1. / std::cos(x); });
      parser.DefineFun(
        "if", +[](double condition, double yes, double no) {
          return std::round(condition) != 0. ? yes : no;
        });
      parser.DefineConst("pi", dealii::numbers::PI);
    }
  } // namespace



  void check_formula(const std::string &text)
  {
    std::vector<bool> is_call; // of the brackets that are open
    for (std::size_t i = 0; i < text.size(); ++i)
      switch (text[i])
        {
          case '{':
            i = std::min(text.find('}', i), text.size());
            break;
          case '(':
            is_call.push_back(ends_name(text, i));
            break;
          case ')':
            if (!is_call.empty())
              is_call.pop_back();
            break;
          case ',':
            if (is_call.empty() || !is_call.back())
              fail(text,
                   i,
                   "this comma separates nothing; decimals begin with a point");
            break;
          case '=':
            if (i + 1 < text.size() && text[i + 1] == '=')
              ++i;
            else if (i == 0 ||
                     std::string("<>!").find(text[i - 1]) == std::string::npos)
              fail(text, i, "a single = would assign; to compare, write ==");
            break;
          default:
            break;
        }
  }



  ParsedFormula::ParsedFormula(const std::string &text,
                               const std::string &variable)
    : ParsedFormula(text,
                    variable.empty() ? std::vector<std::string>() :
                                       std::vector<std::string>{variable})
  {}



  ParsedFormula::ParsedFormula(const std::string              &text,
                               const std::vector<std::string> &variables)
    : content(std::make_shared<Content>())
  {
    check_formula(text);
    try
      {
        define_functions(content->parser);
        content->values.resize(variables.size());
        for (std::size_t i = 0; i < variables.size(); ++i)
          content->parser.DefineVar(variables[i], &content->values[i]);
        content->parser.SetExpr(text);
        // Parsing happens at the first evaluation.
        content->parser.Eval();
      }
    catch (const mu::ParserError &error)
      {
        std::string why = error.GetMsg();
        while (!why.empty() && (why.back() == '.' || why.back() == ' '))
          why.pop_back();
        if (const std::string hint = minus_hint(text); !hint.empty())
          why = hint;
        if (error.GetCode() == mu::ecTOO_MANY_PARAMS)
          why += "; decimals begin with a point";
        else if (error.GetCode() == mu::ecUNASSIGNABLE_TOKEN &&
                 variables == std::vector<std::string>{"x"})
          why += "; it knows only x, pi and functions";
        throw InputError(why);
      }
  }



  double ParsedFormula::operator()(const double x) const
  {
    if (!content->values.empty())
      content->values[0] = x;
    return content->parser.Eval();
  }



  double ParsedFormula::operator()(const std::vector<double> &values) const
  {
    std::copy_n(values.begin(),
                content->values.size(),
                content->values.begin());
    return content->parser.Eval();
  }
} // namespace SlipStep
