#include <slipstep/solid/case.h>

#include <slipstep/experiment/point_driver.h>
#include <slipstep/experiment/report.h>
#include <slipstep/experiment/run_options.h>
#include <slipstep/experiment/step_control.h>
#include <slipstep/friction/law.h>
#include <slipstep/solid/block_parameters.h>
#include <slipstep/solid/face_probes.h>

#include <unistd.h>

#include <iomanip>
#include <sstream>

namespace SlipStep
{
  void declare_all_parameters(Parameters &parameters)
  {
    declare_loading_parameters(parameters);
    FrictionLaw::declare_parameters(parameters);
    BlockParameters::declare_parameters(parameters);
    declare_output_parameters(parameters);
    declare_quantities(parameters);
    declare_report_parameters(parameters);
  }



  void check_case(const Parameters &parameters)
  {
    const FrictionLaw     law(parameters);
    const Programme       programme = parse_programme(parameters);
    const BlockParameters block(parameters, programme);
    const StepControl     control(parameters, programme, law);
    check_probes(parameters, block, parse_quantities(parameters, programme));
    check_report_parameters(parameters);
  }



  void check_memory(const Parameters  &parameters,
                    const unsigned int n_processes)
  {
    const BlockParameters block(parameters, parse_programme(parameters));
    const double          installed = 1e-6 * sysconf(_SC_PHYS_PAGES) *
                             static_cast<double>(sysconf(_SC_PAGESIZE));
    if (block.least_memory() <= n_processes * installed)
      return;
    std::ostringstream message;
    message << std::setprecision(2) << block.n_unknowns()
            << " unknowns need at least " << block.least_memory() / 1e3
            << " GB of memory, more than the " << installed / 1e3
            << " GB of this machine; take fewer cells";
    parameters.reject("Block/Subdivisions", message.str());
  }
} // namespace SlipStep
