// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_utilities_find_variant_h
#define slipstep_utilities_find_variant_h

#include <slipstep/utilities/parameters.h>

namespace SlipStep
{
  /// The variant of this label or folder.
  /// @throws InputError naming those that there are
  const Variant &find_variant(const std::vector<Variant>  &variants,
                              const std::string           &name,
                              const std::filesystem::path &file);
} // namespace SlipStep

#endif
