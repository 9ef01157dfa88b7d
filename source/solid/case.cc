#include <slipstep/solid/case.h>

#include <slipstep/experiment/point_driver.h>
#include <slipstep/experiment/report.h>
#include <slipstep/experiment/run_options.h>
#include <slipstep/friction/law.h>
#include <slipstep/solid/block_parameters.h>

namespace SlipStep
{
  void declare_all_parameters(Parameters &parameters)
  {
    declare_loading_parameters(parameters);
    FrictionLaw::declare_parameters(parameters);
    BlockParameters::declare_parameters(parameters);
    declare_output_parameters(parameters);
    declare_report_parameters(parameters);
  }



  void check_case(const Parameters &parameters)
  {
    const FrictionLaw     law(parameters);
    const Programme       programme = parse_programme(parameters);
    const BlockParameters block(parameters, programme);
    check_report_parameters(parameters);
  }
} // namespace SlipStep
