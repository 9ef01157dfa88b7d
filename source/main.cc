// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/commands/commands.h>

int main(int argc, char **argv)
{
  std::error_code no_proc;
  return SlipStep::program(
    argc, argv, std::filesystem::read_symlink("/proc/self/exe", no_proc));
}
