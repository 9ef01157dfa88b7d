#include <slipstep/solid/run_block.h>

#include <slipstep/experiment/point_driver.h>
#include <slipstep/experiment/run_recorder.h>
#include <slipstep/solid/block.h>
#include <slipstep/solid/face_probes.h>
#include <slipstep/solid/run_checkpoints.h>
#include <slipstep/utilities/exceptions.h>

#include <deal.II/base/mpi.h>

namespace SlipStep
{
  using namespace dealii;

  namespace
  {
    // A full disk hits one rank only: all must stop together.
    void record_together(RunRecorder      &recorder,
                         const HistoryRow &row,
                         const MPI_Comm   &communicator)
    {
      std::string reason;
      try
        {
          recorder.record(row);
        }
      catch (const RunError &error)
        {
          reason = error.what();
        }
      const unsigned int has_failed = reason.empty() ? 0 : 1;
      if (Utilities::MPI::max(has_failed, communicator) > 0)
        throw RunError(reason.empty() ? "another process was stopped" : reason);
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
      Block<dim>       block(block_parameters,
                       law,
                       programme,
                       StepControl(parameters, programme, law),
                       communicator);
      BlockOutput<dim> output(block_parameters, options.output, communicator);
      const FaceProbes<dim> probes(block_parameters,
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
                recorder.note = std::to_string(block.n_cells()) + " cells";
              HistoryRow with_probes = row;
              with_probes.probes =
                probes.values(block.contact_face(), communicator);
              record_together(recorder, with_probes, communicator);
            },
            [&]() { checkpoints.write_if_due(block, output, recorder); });
        }
      catch (const RunError &error)
        {
          reason = error.what();
        }
      output.write_contact_table(block.contact_face());
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
  } // namespace



  namespace
  {
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
    if (block_parameters.dimension == 2)
      run_block_in<2>(block_parameters,
                      parameters,
                      options,
                      law,
                      programme,
                      checkpoints,
                      recorder);
    else
      run_block_in<3>(block_parameters,
                      parameters,
                      options,
                      law,
                      programme,
                      checkpoints,
                      recorder);
    return recorder.summary;
  }
} // namespace SlipStep
