// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/utilities.h>

#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/nearest_name.h>
#include <slipstep/utilities/pattern_words.h>
#include <slipstep/utilities/text.h>
#include <slipstep/utilities/units.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <limits>
#include <regex>

namespace SlipStep
{
  namespace
  {
    using dealii::Patterns::PatternBase;

    std::string machine_words(const PatternBase &pattern)
    {
      return pattern.description(PatternBase::Machine);
    }



    // deal.II keeps the alternatives and bounds of its patterns private; its
    // machine-readable descriptions are the documented way to them.
    std::vector<std::string> alternatives(const PatternBase &pattern)
    {
      static const std::regex form(R"(\[(?:Multiple)?Selection (.*)\])");
      const std::string       words = machine_words(pattern);
      std::smatch             match;
      if (!std::regex_match(words, match, form))
        return {};
      return dealii::Utilities::split_string_list(
        dealii::Utilities::trim(match[1]), '|');
    }



    // " from 1 to 3", " of at least 0", "": the range of an Integer or Double.
    std::string range_in_words(const PatternBase &pattern)
    {
      static const std::regex form(
        R"(\[(?:Integer range|Double) (\S+?)\.\.\.(\S+) \(inclusive\)\])");
      const std::string words = machine_words(pattern);
      std::smatch       match;
      if (!std::regex_match(words, match, form))
        return "";
      const auto is_open = [](const std::string &bound) {
        return bound.find("DOUBLE") != std::string::npos ||
               bound == std::to_string(std::numeric_limits<int>::max()) ||
               bound == std::to_string(std::numeric_limits<int>::min());
      };
      const std::string low  = match[1];
      const std::string high = match[2];
      if (is_open(low) && is_open(high))
        return "";
      if (is_open(high))
        return " of at least " + low;
      if (is_open(low))
        return " of at most " + high;
      return " from " + low + " to " + high;
    }
  } // namespace



  std::vector<std::string> choices_of(const PatternBase &pattern)
  {
    if (dynamic_cast<const dealii::Patterns::Bool *>(&pattern))
      return {"true", "false"};
    return dynamic_cast<const dealii::Patterns::Selection *>(&pattern) ?
             alternatives(pattern) :
             std::vector<std::string>();
  }



  std::string allowed_in_words(const PatternBase &pattern)
  {
    namespace P = dealii::Patterns;
    if (const auto quantity = dynamic_cast<const Quantity *>(&pattern))
      return quantity->description();
    if (dynamic_cast<const P::Integer *>(&pattern))
      return "a whole number" + range_in_words(pattern);
    if (dynamic_cast<const P::Double *>(&pattern))
      return "a number" + range_in_words(pattern);
    if (dynamic_cast<const P::Bool *>(&pattern))
      return "true or false";
    if (dynamic_cast<const P::Selection *>(&pattern))
      return "one of: " + boost::algorithm::join(alternatives(pattern), ", ");
    if (dynamic_cast<const P::MultipleSelection *>(&pattern))
      return "any of: " + boost::algorithm::join(alternatives(pattern), ", ");
    if (dynamic_cast<const P::Anything *>(&pattern))
      return "any text";
    if (dynamic_cast<const P::FileName *>(&pattern))
      return "the name of a file";
    if (dynamic_cast<const P::DirectoryName *>(&pattern))
      return "the name of a folder";
    if (const auto list = dynamic_cast<const P::List *>(&pattern))
      {
        const std::string separator = list->get_separator();
        // "[List of <...> of length 1...2 (inclusive)]"
        static const std::regex form(
          R"(.*of length (\d+)\.\.\.(\d+) \(inclusive\).*)");
        const std::string words = machine_words(pattern);
        std::smatch       match;
        std::string       count;
        if (std::regex_match(words, match, form))
          {
            const std::string most = match[2];
            const bool is_open = most == std::to_string(P::List::max_int_value);
            if (match[1] == most)
              count = " of " + most;
            else if (!is_open)
              count = " of " + match[1].str() + " to " + most;
            else if (match[1] != "0")
              count = " of at least " + match[1].str();
          }
        const PatternBase &base = list->get_base_pattern();
        return "a list" + count + " (separated by " +
               (separator == "," ? "commas" :
                separator == ";" ? "semicolons" :
                                   "\"" + separator + "\"") +
               ")" +
               (dynamic_cast<const P::Anything *>(&base) ?
                  "" :
                  ", each " + allowed_in_words(base));
      }
    return pattern.description(PatternBase::Text);
  }



  AnythingWithWords::AnythingWithWords(const std::vector<std::string> &words)
    : words(words)
  {}



  std::unique_ptr<PatternBase> AnythingWithWords::clone() const
  {
    return std::make_unique<AnythingWithWords>(words);
  }



  namespace
  {
    std::string respelt(const std::string              &word,
                        const std::vector<std::string> &words)
    {
      for (const std::string &known : words)
        if (is_same_word(word, known))
          return known;
      return word;
    }



    // Words stand between blanks or marks: the parts of a path are none.
    std::string words_respelt(const std::string              &text,
                              const std::vector<std::string> &words)
    {
      const char *const borders = " \t,;()";
      std::string       result;
      for (std::size_t begin = 0; begin < text.size();)
        {
          const std::size_t end =
            std::min(text.find_first_of(borders, begin), text.size());
          result += respelt(text.substr(begin, end - begin), words);
          begin = std::min(text.find_first_not_of(borders, end), text.size());
          result += text.substr(end, begin - end);
        }
      return result;
    }



    // "10,5 mm, 10 mm" may be two lengths or three.
    std::string why_ambiguous(const dealii::Patterns::List &list,
                              const std::string            &text)
    {
      const auto quantity =
        dynamic_cast<const Quantity *>(&list.get_base_pattern());
      if (quantity == nullptr || list.get_separator() != ",")
        return "";
      const std::string hint = decimal_comma_hint(text);
      const bool        has_unit =
        text.find_first_not_of("0123456789.,+- \t") != std::string::npos;
      if (hint.empty() || !(has_unit || text.find(", ") != std::string::npos))
        return "";
      return hint + " (commas separate values; write a blank after each)";
    }
  } // namespace



  std::string as_meant(const PatternBase &pattern, const std::string &text)
  {
    namespace P = dealii::Patterns;
    if (const auto list = dynamic_cast<const P::List *>(&pattern))
      return as_meant(list->get_base_pattern(), text);
    if (const auto any = dynamic_cast<const AnythingWithWords *>(&pattern))
      return words_respelt(text, any->words);
    if (dynamic_cast<const P::Bool *>(&pattern))
      return respelt(text, {"true", "false", "yes", "no"});
    if (dynamic_cast<const P::MultipleSelection *>(&pattern))
      return words_respelt(text, alternatives(pattern));
    return respelt(text, alternatives(pattern));
  }



  std::string why_not_allowed(const PatternBase &pattern,
                              const std::string &text)
  {
    namespace P = dealii::Patterns;
    if (const auto list = dynamic_cast<const P::List *>(&pattern))
      {
        const std::string why = why_ambiguous(*list, text);
        if (!why.empty())
          return why;
      }
    if (pattern.match(text))
      return "";

    if (const auto list = dynamic_cast<const P::List *>(&pattern))
      for (const std::string &element :
           dealii::Utilities::split_string_list(text, list->get_separator()))
        if (!list->get_base_pattern().match(element))
          return "\"" + excerpt(element) +
                 "\": " + why_not_allowed(list->get_base_pattern(), element) +
                 (list->get_separator() == "," &&
                      (element.find(';') != std::string::npos ||
                       element.find(" x ") != std::string::npos) ?
                    " (commas separate values)" :
                    "");

    const std::string allowed = "allowed is " + allowed_in_words(pattern);
    if (text.empty())
      return "the value is missing; " + allowed;
    if (const auto quantity = dynamic_cast<const Quantity *>(&pattern))
      {
        const std::string why = quantity->why_not(text);
        // The units are listed once.
        const bool lists_units = why.find("(known: ") != std::string::npos;
        return why + "; " +
               (lists_units ? "allowed is " + quantity->description_of_range() :
                              allowed);
      }

    const std::vector<std::string> words = alternatives(pattern);
    if (words.empty())
      return allowed;
    std::string unknown = text;
    if (dynamic_cast<const P::MultipleSelection *>(&pattern))
      for (const std::string &word : dealii::Utilities::split_string_list(text))
        if (!holds(words, word))
          {
            unknown = word;
            break;
          }
    const std::string nearest = did_you_mean(unknown, words);
    return "\"" + excerpt(unknown) + "\" is not known" + nearest +
           (nearest.empty() ? "; allowed" : " Allowed") +
           allowed.substr(std::string("allowed").size());
  }
} // namespace SlipStep
