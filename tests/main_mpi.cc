// SPDX-License-Identifier: LGPL-2.1-or-later

// The main() of test executables that use MPI, alone or under mpirun. Every
// rank runs every test; one failing rank fails the executable.
#include <slipstep/utilities/process.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <cstring>

int main(int argc, char **argv)
{
  // Listing the tests needs no MPI, and starting it costs half a second.
  for (int i = 1; i < argc; ++i)
    if (std::strncmp(argv[i], "--gtest_list_tests", 18) == 0)
      {
        testing::InitGoogleTest(&argc, argv);
        return RUN_ALL_TESTS();
      }

  SlipStep::start_mpi_without_daemon();
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  testing::InitGoogleTest(&argc, argv);
  const int failed = RUN_ALL_TESTS();
  return dealii::Utilities::MPI::max(failed, MPI_COMM_WORLD);
}
