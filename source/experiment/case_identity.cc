// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/experiment/case_identity.h>

#include <slipstep/experiment/point_driver.h>
#include <slipstep/experiment/step_control.h>
#include <slipstep/utilities/lists.h>

#include <deal.II/base/utilities.h>

#include <boost/algorithm/string/erase.hpp>
#include <boost/algorithm/string/predicate.hpp>
#include <boost/crc.hpp>

#include <algorithm>
#include <map>

namespace SlipStep
{
  namespace
  {
    // Quantities have columns in the history.
    bool has_a_say_in_history(const std::string &path,
                              const Parameters  &parameters,
                              const std::string &command)
    {
      using boost::algorithm::starts_with;
      const std::vector<std::string> idle = StepControl::idle_keys(parameters);
      if (holds(idle, path))
        return false;
      return starts_with(path, "Loading/") ||
             starts_with(path, "Time stepping/") ||
             starts_with(path, "Friction/") || path == "Output/Quantities" ||
             (command == "run" &&
              (starts_with(path, "Block/") || starts_with(path, "Contact/")));
    }



    // These are compared as a whole, by what they say.
    bool is_in_programme(const std::string &path)
    {
      return path == "Loading/Programme" || path == "Loading/Speed";
    }
  } // namespace



  std::uint32_t checksum_of(const Programme &programme)
  {
    boost::crc_32_type crc;
    const auto         add = [&crc](const double number) {
      crc.process_bytes(&number, sizeof(number));
    };
    for (const Segment &segment : programme.segments())
      {
        for (const auto &end :
             {std::make_pair(segment.start_time, segment.start),
              std::make_pair(segment.end_time, segment.end)})
          {
            add(end.first);
            add(end.second.pressure);
            for (unsigned int i = 0; i < 2; ++i)
              add(end.second.displacement[i]);
          }
        if (segment.pushes)
          for (unsigned int i = 0; i < 2; ++i)
            add(segment.push[i]);
      }
    return crc.checksum();
  }



  bool is_same_value(const dealii::Patterns::PatternBase &pattern,
                     const std::string                   &value,
                     const std::string                   &other)
  {
    const auto without_blanks = [](std::string text) {
      boost::erase_all(text, " ");
      return text;
    };
    if (without_blanks(value) == without_blanks(other))
      return true;
    if (const auto *quantity = dynamic_cast<const Quantity *>(&pattern))
      return quantity->match(other) &&
             quantity->value(value) == quantity->value(other);
    return dynamic_cast<const dealii::Patterns::Double *>(&pattern) !=
             nullptr &&
           pattern.match(other) &&
           dealii::Utilities::string_to_double(value) ==
             dealii::Utilities::string_to_double(other);
  }



  void reject_changed_test(const Parameters  &parameters,
                           const std::string &owner)
  {
    parameters.reject("Loading/Programme",
                      "a test that it follows has changed since " + owner +
                        " was made" + anew_or_elsewhere);
  }



  CaseIdentity::CaseIdentity(const Parameters  &parameters,
                             const std::string &command)
    : programme(checksum_of(parse_programme(parameters)))
  {
    for (const std::string &path : parameters.paths())
      if (has_a_say_in_history(path, parameters, command))
        values.emplace_back(path, parameters.text(path));
  }



  void CaseIdentity::require_same(const Parameters  &parameters,
                                  const std::string &owner) const
  {
    const auto refuse = [&](const std::string &path, const std::string &value) {
      parameters.reject(path,
                        owner + " has '" + value + "'" + anew_or_elsewhere);
    };

    std::map<std::string, std::string> in_programme;
    for (const auto &[path, value] : values)
      if (is_in_programme(path))
        in_programme[path] = value;
      else if (!is_same_value(*parameters.entry(path).pattern,
                              parameters.text(path),
                              value))
        refuse(path, value);

    if (checksum_of(parse_programme(parameters)) == programme)
      return;
    for (const char *const path : {"Loading/Speed", "Loading/Programme"})
      if (parameters.text(path) != in_programme[path])
        refuse(path, in_programme[path]);
    reject_changed_test(parameters, owner);
  }



  bool CaseIdentity::is_same(const CaseIdentity &other,
                             const Parameters   &declared) const
  {
    return programme == other.programme &&
           std::equal(
             values.begin(),
             values.end(),
             other.values.begin(),
             other.values.end(),
             [&](const auto &one, const auto &another) {
               return one.first == another.first &&
                      (is_in_programme(one.first) ||
                       is_same_value(*declared.entry(one.first).pattern,
                                     one.second,
                                     another.second));
             });
  }
} // namespace SlipStep
