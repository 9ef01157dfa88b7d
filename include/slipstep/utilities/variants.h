// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_utilities_variants_h
#define slipstep_utilities_variants_h

#include <slipstep/utilities/parameters.h>

#include <string>
#include <vector>

namespace SlipStep
{
  /// The last part of a path.
  std::string name_of_key(const std::string &path);

  /// Add a variant that differs in nothing yet.
  /// @throws InputError if its label or folder is taken or too long
  void add_variant(std::vector<Variant> &variants,
                   const std::string    &label,
                   const std::string    &origin);

  /// One variant for each value of a key.
  /// @param is_alone whether no other key is swept: then a value with a unit
  ///   says enough in a legend
  /// @throws InputError if a value is not allowed or is there twice
  std::vector<Variant>
  variants_of_values(const Parameters               &known,
                     const std::string              &path,
                     const std::vector<std::string> &values,
                     const std::string              &origin,
                     const bool                      is_alone);

  /// Every variant of one sweep with every one of another, which changes first.
  /// @throws InputError if both change the same key, or there are too many
  std::vector<Variant> product(const std::vector<Variant> &slow,
                               const std::vector<Variant> &fast,
                               const std::string          &origin);

  /// The variants without what they say of a key. Of those that then say the
  /// same one is left, and none if that is nothing.
  /// @param but_those_from origin of settings that stay
  std::vector<Variant> without_key(const std::vector<Variant> &variants,
                                   const std::string          &path,
                                   const std::string &but_those_from = "");

  /// The variant of this label or folder.
  /// @throws InputError naming those that there are
  const Variant &find_variant(const std::vector<Variant>  &variants,
                              const std::string           &name,
                              const std::filesystem::path &file);
} // namespace SlipStep

#endif
