// SPDX-License-Identifier: LGPL-2.1-or-later

// Ranks that outnumber the cores yield the processor while they wait for each
// other. Linux puts one that yields behind all that runs, as if it had used up
// its time, so that each of thousands of waits takes milliseconds where other
// programs run, too. One that sleeps is woken soon.
#include <sched.h>
#include <time.h>

// Called by MPI instead of the one of the C library.
extern "C" int sched_yield() noexcept
{
  const timespec twenty_microseconds = {0, 20000};
  nanosleep(&twenty_microseconds, nullptr);
  return 0;
}
