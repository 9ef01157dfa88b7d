// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <slipstep/commands/outcome.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/process.h>
#include <slipstep/utilities/text.h>
#include <slipstep/utilities/write_file.h>

#include <chrono>
#include <filesystem>
#include <iostream>
#include <new>
#include <sstream>
#include <thread>

namespace SlipStep
{
  Outcome guarded(const std::function<int()> &work)
  {
    try
      {
        return {work(), ""};
      }
    catch (const InputError &error)
      {
        return {input_wrong, readable(error.what())};
      }
    catch (const std::filesystem::filesystem_error &error)
      {
        const bool is_name =
          error.code() == std::errc::filename_too_long ||
          error.code() == std::errc::not_a_directory ||
          error.code() == std::errc::permission_denied ||
          error.code() == std::errc::too_many_symbolic_link_levels;
        return {is_name ? input_wrong : run_failed,
                excerpt(error.path1().string(), 300) + ": " +
                  error.code().message()};
      }
    catch (const RunError &error)
      {
        return {run_failed, error.what()};
      }
    catch (const dealii::StandardExceptions::ExcIO &)
      {
        return {run_failed, write_failure("a file of the results").what()};
      }
    catch (const dealii::ExceptionBase &error)
      {
        std::ostringstream info;
        error.print_info(info);
        return {run_failed,
                std::string("the run failed in deal.II: ") +
                  error.get_exc_name() + ": " + essential_lines(info.str(), 2)};
      }
    catch (const std::bad_alloc &)
      {
        return {run_failed, "the run failed: out of memory"};
      }
    catch (const std::exception &error)
      {
        return {run_failed,
                "the run failed: " + essential_lines(error.what(), 2)};
      }
    catch (...)
      {
        return {run_failed, "the run failed for an unknown reason"};
      }
  }



  Outcome agreed(Outcome outcome)
  {
    if (!dealii::Utilities::MPI::job_supports_mpi())
      return outcome;
    const MPI_Comm     comm = MPI_COMM_WORLD;
    const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(comm);
    MPI_Request        all_are_here;
    MPI_Ibarrier(comm, &all_are_here);
    int  is_complete = 0;
    auto start       = std::chrono::steady_clock::now();
    while (MPI_Test(&all_are_here, &is_complete, MPI_STATUS_IGNORE),
           is_complete == 0)
      {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        if (outcome.exit_code != done &&
            std::chrono::steady_clock::now() - start > std::chrono::seconds(10))
          {
            std::cerr << outcome.message << std::endl;
            MPI_Abort(comm, outcome.exit_code);
          }
      }

    // One rank speaks for all.
    const int worst = dealii::Utilities::MPI::max(outcome.exit_code, comm);
    const unsigned int speaker =
      dealii::Utilities::MPI::min(outcome.exit_code == worst ? rank : ~0u,
                                  comm);
    if (rank != speaker)
      outcome.message.clear();
    outcome.exit_code = worst;
    return outcome;
  }



  Outcome guarded_with_mpi(const std::function<int()> &work)
  {
    start_mpi_without_daemon();
    // MPI implementations want no arguments nowadays.
    int                                      argc = 0;
    char                                   **argv = nullptr;
    dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
    // MPI and p4est must not end the program in their own words.
    dealii::deal_II_exceptions::disable_abort_on_exception();
    const Outcome outcome = agreed(guarded(work));
    if (!outcome.message.empty())
      std::cerr << outcome.message << std::endl;
    return {outcome.exit_code, ""};
  }
} // namespace SlipStep
