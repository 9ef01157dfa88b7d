// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_utilities_json_file_h
#define slipstep_utilities_json_file_h

#include <slipstep/utilities/write_file.h>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <limits>
#include <vector>

namespace SlipStep
{
  /// Write a JSON file, see write_file(). Numbers that are not finite become
  /// null. Names may hold anything: what is no UTF-8 is replaced.
  /// @throws RunError if the disk refuses
  inline void write_json(const std::filesystem::path  &file,
                         const nlohmann::ordered_json &object)
  {
    using Handler = nlohmann::ordered_json::error_handler_t;
    write_file(file, object.dump(2, ' ', false, Handler::replace) + "\n");
  }

  /// A JSON object whose members are written, or read back, by the same list of
  /// what they are: `members("peak", slide.peak);` and so on. Of optional
  /// members, groups and arrays older files have none.
  class JsonMembers
  {
  public:
    using json = nlohmann::ordered_json;

    JsonMembers(json &object, const bool reads)
      : object(object)
      , reads(reads)
    {}

    template <typename Value>
    void operator()(const char *key, Value &value)
    {
      if (reads)
        object.at(key).get_to(value);
      else
        object[key] = value;
    }

    /// @param unit how many of the file's units a number is; null is NaN
    void operator()(const char *key, double &value, const double unit = 1.)
    {
      if (!reads)
        object[key] = value * unit;
      else if (object.at(key).is_null())
        value = std::numeric_limits<double>::quiet_NaN();
      else
        value = object[key].get<double>() / unit;
    }

    template <typename Value>
    void optional(const char *key, Value &value)
    {
      if (!reads || object.contains(key))
        (*this)(key, value);
    }

    /// @param list called with the members of an object inside, which is
    ///   written as null unless it @p exists
    template <typename List>
    void group(const char *key, const List &list, const bool exists = true)
    {
      if (!reads)
        object[key] = json();
      if (reads ? !object.value(key, json()).is_null() : exists)
        list(JsonMembers(object[key], reads));
    }

    /// @param list called with the members of each element, and the element
    template <typename Element, typename List>
    void
    array(const char *key, std::vector<Element> &elements, const List &list)
    {
      if (!reads)
        object[key] = json(elements.size(), json());
      else
        elements.resize(object.value(key, json::array()).size());
      for (std::size_t i = 0; i < elements.size(); ++i)
        list(JsonMembers(object[key][i], reads), elements[i]);
    }

  private:
    json      &object;
    const bool reads;
  };
} // namespace SlipStep

#endif
