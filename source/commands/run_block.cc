// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/commands/commands.h>

#include <slipstep/experiment/point_driver.h>
#include <slipstep/experiment/run_recorder.h>
#include <slipstep/solid/attempt_together.h>
#include <slipstep/solid/block.h>
#include <slipstep/solid/block_probes.h>
#include <slipstep/solid/point_lines.h>
#include <slipstep/commands/run_checkpoints.h>
#include <slipstep/utilities/exceptions.h>

#include <deal.II/base/mpi.h>

#include <iomanip>
#include <sstream>

namespace SlipStep
{
  using namespace dealii;

  namespace
  {
    // Of an adaptive mesh: its size, and its error in the last step looked at.
    template <int dim>
    std::string note(const Block<dim> &block)
    {
      std::ostringstream text;
      text << block.state().unknowns.get_triangulation().n_global_active_cells()
           << " cells";
      if (block.state().mesh_error.n_checked > 0)
        text << ", mesh error " << std::setprecision(2)
             << 100. * block.state().mesh_error.last << " %";
      return text.str();
    }



    template <int dim>
    void run_block_in(const BlockParameters &block_parameters,
                      const Parameters      &parameters,
                      const RunOptions      &options,
                      const FrictionLaw     &law,
                      const Programme       &programme,
                      RunCheckpoints        &checkpoints,
                      RunRecorder           &recorder)
    {
      const MPI_Comm   communicator = MPI_COMM_WORLD;
      const Machine    machine(parameters);
      Block<dim>       block(block_parameters,
                       law,
                       programme,
                       StepControl(parameters, programme, law),
                       communicator,
                       machine);
      BlockOutput<dim> output(block_parameters, options.output, communicator);
      const BlockProbes<dim> probes(block_parameters,
                                    programme,
                                    parse_quantities(parameters, programme));
      checkpoints.resume(block, output, recorder);
      block.fill(recorder.summary);

      std::string reason;
      try
        {
          block.run(
            &output,
            [&](const HistoryRow &row) {
              if (block_parameters.refinement.type == RefinementType::adaptive)
                recorder.note = note(block);
              HistoryRow with_probes = row;
              with_probes.probes     = probes.values(block, communicator);
              if (!machine.is_rigid())
                for (const double value :
                     Machine::probes(block.state().drive.state(), row.pressure))
                  with_probes.probes.push_back(value);
              // A full disk hits one rank only: all must stop together.
              do_together(communicator,
                          [&]() { recorder.record(with_probes); });
            },
            [&]() { checkpoints.write_if_due(block, output, recorder); },
            [&]() { return checkpoints.cannot_wait(); });
        }
      catch (const RunError &error)
        {
          reason = error.what();
        }
      output.write_end(block.state().unknowns,
                       block.state().displacements,
                       block.state().contact_face);
      write_lines(options.output,
                  parse_lines(parameters, block_parameters),
                  block,
                  communicator);
      block.fill(recorder.summary);
      const ResourceUsage usage = ResourceUsage::now();
      recorder.summary.cpu_time =
        Utilities::MPI::sum(usage.cpu_time, communicator);
      recorder.summary.peak_memory =
        Utilities::MPI::sum(usage.peak_memory, communicator);
      recorder.finish(reason);
      if (reason.empty())
        checkpoints.remove();
    }



    // A program built on one machine may be started on an older one.
    void check_processor()
    {
#ifdef SLIPSTEP_PROCESSOR
      if (!__builtin_cpu_supports(SLIPSTEP_PROCESSOR))
        throw RunError("this program was built for processors with " +
                       std::string(SLIPSTEP_PROCESSOR) +
                       ", which this machine has not got: configure it with "
                       "-DSLIPSTEP_SIMD=128");
#endif
    }
  } // namespace



  Summary run_block(const Parameters &parameters, const RunOptions &options)
  {
    check_processor();
    const FrictionLaw     law(parameters);
    const Programme       programme = parse_programme(parameters);
    const BlockParameters block_parameters(parameters, programme);
    RunCheckpoints        checkpoints(parameters,
                               options.output,
                               options.resume,
                               MPI_COMM_WORLD);
    RunRecorder           recorder(parameters,
                         options,
                         "run",
                         law,
                         programme,
                         Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0,
                         checkpoints.found());
    const auto            run_in = [&](const auto dim) {
      run_block_in<dim()>(block_parameters,
                          parameters,
                          options,
                          law,
                          programme,
                          checkpoints,
                          recorder);
    };
    if (block_parameters.dimension == 2)
      run_in(std::integral_constant<int, 2>());
    else
      run_in(std::integral_constant<int, 3>());
    return recorder.summary;
  }
} // namespace SlipStep
