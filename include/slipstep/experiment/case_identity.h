// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_experiment_case_identity_h
#define slipstep_experiment_case_identity_h

#include <slipstep/utilities/parameters.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace SlipStep
{
  class Programme;

  /// Of the segments, whatever words say them.
  std::uint32_t checksum_of(const Programme &programme);

  /// What to do about results of another case, for the end of a message.
  constexpr const char *anew_or_elsewhere =
    "; run without --resume to start anew, or give another folder with "
    "--output";

  /// Refuse a case that follows another test than before.
  /// @param owner whose test it was, "the checkpoint in output/case"
  /// @throws InputError
  [[noreturn]] void reject_changed_test(const Parameters  &parameters,
                                        const std::string &owner);

  /// What makes two cases the same as far as the histories of a command go: the
  /// programme with the tests that it follows, and the parameters that the
  /// command uses. What another command uses may change.
  struct CaseIdentity
  {
    CaseIdentity() = default;

    /// @param command "run" or "point"
    explicit CaseIdentity(const Parameters  &parameters,
                          const std::string &command = "run");

    /// Refuse a case that differs in anything.
    /// @param owner whose identity this is, "the checkpoint in output/case"
    /// @throws InputError naming the first key that differs, and both values
    void require_same(const Parameters  &parameters,
                      const std::string &owner) const;

    /// Whether another case differs in nothing.
    /// @param declared with the patterns of the keys
    bool is_same(const CaseIdentity &other, const Parameters &declared) const;

    /// Pairs (path of a parameter, value), in declared order.
    std::vector<std::pair<std::string, std::string>> values;
    /// Checksum of the segments of the programme.
    std::uint32_t programme = 0;
  };

  /// Whether two texts give a parameter the same value: "1 cm" is "10 mm",
  /// "0.10" is "0.1", "a, b" is "a,b".
  bool is_same_value(const dealii::Patterns::PatternBase &pattern,
                     const std::string                   &value,
                     const std::string                   &other);
} // namespace SlipStep

#endif
