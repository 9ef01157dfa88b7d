// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_solid_attempt_together_h
#define slipstep_solid_attempt_together_h

#include <slipstep/utilities/exceptions.h>

#include <deal.II/base/mpi.h>

#include <string>

namespace SlipStep
{
  /// What went wrong on the first rank where something did; "" if nothing did.
  /// @param reason what went wrong on this rank, or ""
  inline std::string agreed(const std::string &reason,
                            const MPI_Comm    &communicator)
  {
    // Asked in every step: reasons are sent only if there are any.
    const unsigned int has_failed = reason.empty() ? 0 : 1;
    if (dealii::Utilities::MPI::max(has_failed, communicator) == 0)
      return "";
    for (const std::string &other :
         dealii::Utilities::MPI::all_gather(communicator, reason))
      if (!other.empty())
        return other;
    return "";
  }

  /// Do what may fail on one rank only, so that all ranks know.
  /// @return agreed() on the RunError that it threw
  template <class Work>
  std::string attempt_together(const MPI_Comm &communicator, const Work &work)
  {
    std::string reason;
    try
      {
        work();
      }
    catch (const RunError &error)
      {
        reason = error.what();
      }
    return agreed(reason, communicator);
  }

  /// The same, for what cannot go on after a failure.
  /// @throws RunError on all ranks if one of them did
  template <class Work>
  void do_together(const MPI_Comm &communicator, const Work &work)
  {
    const std::string failure = attempt_together(communicator, work);
    if (!failure.empty())
      throw RunError(failure);
  }
} // namespace SlipStep

#endif
