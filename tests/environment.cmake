# SPDX-License-Identifier: LGPL-2.1-or-later
# Read by ctest: the environment of all tests. Ranks may outnumber the cores,
# the user may be root on a fresh machine, and MPI itself is not free of leaks.
set(ENV{OMPI_ALLOW_RUN_AS_ROOT} 1)
set(ENV{OMPI_ALLOW_RUN_AS_ROOT_CONFIRM} 1)
set(ENV{OMPI_MCA_rmaps_base_oversubscribe} 1)
set(ENV{OMPI_MCA_btl_vader_single_copy_mechanism} none)
set(ENV{DEAL_II_NUM_THREADS} 1)
set(ENV{OMP_NUM_THREADS} 1)
set(ENV{ASAN_OPTIONS} detect_leaks=0)
