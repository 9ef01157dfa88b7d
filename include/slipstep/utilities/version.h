// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_utilities_version_h
#define slipstep_utilities_version_h

namespace SlipStep
{
  /// Version of the program, `major.minor.patch`.
  const char *version();

  /// Abbreviated hash of the commit the program was built from, with `-dirty`
  /// appended when files differed from it, or `unknown` outside a git checkout.
  const char *git_hash();
} // namespace SlipStep

#endif
