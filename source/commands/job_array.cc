// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/commands/job_array.h>
#include <slipstep/commands/outcome.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/write_file.h>

#include <boost/algorithm/string/replace.hpp>

#include <iostream>

namespace SlipStep
{
  namespace fs = std::filesystem;

  namespace
  {
    // As one word of a shell, whatever is in it.
    std::string word(const std::string &text)
    {
      return "'" + boost::algorithm::replace_all_copy(text, "'", "'\\''") + "'";
    }



    std::string job_array(const Case        &the_case,
                          const CommandLine &line,
                          const fs::path    &output)
    {
      const std::string program   = word(line.program.string());
      const fs::path    case_file = fs::absolute(line.files.front());
      std::string       call =
        program + " " + line.command + " " + word(case_file.string());
      for (const std::string &sweep : line.sweeps_as_typed)
        call += " --sweep " + word(sweep);
      for (const std::string &setting : line.settings_as_typed)
        call += " --set " + word(setting);
      call += " --output " + word(fs::absolute(output).string());

      std::string text = "#!/bin/bash\n"
                         "#SBATCH --job-name=" +
                         case_file.stem().string() + "\n#SBATCH --array=1-" +
                         std::to_string(the_case.variants.size()) +
                         "\n#SBATCH --ntasks=1\n"
                         "# Submit with sbatch. A job that is repeated goes on "
                         "where it was stopped. When all\n"
                         "# are done, the page of the sweep comes from\n"
                         "#   " +
                         call + " --resume\nset -eu\nvariants=(\n";
      for (const Variant &variant : the_case.variants)
        text += "  " + word(variant.folder) + '\n';
      return text +
             ")\nvariant=${variants[$((SLURM_ARRAY_TASK_ID - 1))]}\n"
             "launch=\n"
             "[ \"${SLURM_NTASKS:-1}\" -gt 1 ] && launch=srun\n"
             "exec $launch " +
             call + " --variant \"$variant\" --quiet --resume\n";
    }
  } // namespace



  int write_job_array(const Case        &the_case,
                      const CommandLine &line,
                      const fs::path    &output)
  {
    if (!the_case.is_sweep())
      throw InputError("--slurm: the case is no sweep, one job computes it; "
                       "--sweep \"Section/Key=A|B|C\" makes it one");
    if (fs::exists(line.slurm))
      throw InputError("--slurm " + line.slurm +
                       ": this file is there already, and is kept");
    write_file(line.slurm, job_array(the_case, line, output));
    if (!line.quiet)
      std::cout << "sbatch "
                << (line.slurm.find_first_of(" '\"\\$&;|<>*?()#~`!") ==
                        std::string::npos ?
                      line.slurm :
                      word(line.slurm))
                << "   # " << the_case.variants.size() << " jobs" << std::endl;
    return done;
  }
} // namespace SlipStep
