#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# How much of its time a rank computes, and how much it waits for others.
#   tests/benchmark/sliding_run/ranks.sh [M] [RANKS...]
# M: the block has 4M x 4M x M cells Q2 (default 8: 215475 unknowns); RANKS
# default to 1 2. A rank that waits asks all the time and uses its core, so times
# tell little, on a machine that is shared nothing at all. This counts samples
# instead: those in the MPI library are waiting, the others are own work.
# Needs perf (linux-perf) and slipstep in build/ (or in $SLIPSTEP_BUILD_DIR).
set -eu -o pipefail
export LC_ALL=C OMP_NUM_THREADS=1

here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
export SLIPSTEP=$(realpath -m "${SLIPSTEP_BUILD_DIR:-$here/../../../build}")/slipstep
export CASE=$here/sliding_run.prm

fail() { printf 'ranks.sh: %s\n' "$*" >&2; exit 1; }
command -v perf >/dev/null || fail "perf is missing: apt-get install linux-perf"
[ -x "$SLIPSTEP" ] || fail "$SLIPSTEP is missing; ./run --help tells how to build"

m=${1:-8}
[ $# -gt 0 ] && shift
[ $# -gt 0 ] || set -- 1 2
export CELLS="$((4 * m)), $((4 * m)), $m"
WORK=$(mktemp -d)
export WORK
trap 'rm -rf "$WORK"' EXIT

printf '%5s %4s %9s %9s %9s %12s\n' ranks rank samples waiting own 'own/serial'
serial=0
for RANKS in "$@"; do
  export RANKS
  mpirun --oversubscribe --allow-run-as-root -np "$RANKS" bash -c '
    perf record -q -e cpu-clock:u -F 99 \
      -o "$WORK/$RANKS.$OMPI_COMM_WORLD_RANK" \
      "$SLIPSTEP" run "$CASE" --quiet --variant "1 mm/min" \
      --set "Block/Subdivisions=$CELLS" --output "$WORK/out$RANKS"' \
    >"$WORK/log" 2>&1 || { tail -n 20 "$WORK/log" >&2; fail "the run failed"; }
  for ((rank = 0; rank < RANKS; ++rank)); do
    read -r samples own < <(
      perf report -i "$WORK/$RANKS.$rank" --no-children --sort dso,sym \
        -F sample,dso,sym 2>/dev/null | grep -v '^#' | awk 'NF {
        n += $1
        if ($2 !~ /lib(mpi|open-|uc|event|fabric|psm|pmix)|mca_|vdso/ &&
            !/sched_yield|poll|clock_gettime/)
          own += $1
      }
      END { print n, own }')
    [ "$serial" -ne 0 ] || serial=$own
    printf '%5d %4d %9d %9d %9d %12s\n' "$RANKS" "$rank" "$samples" \
      $((samples - own)) "$own" "$(awk "BEGIN { printf \"%.3f\", $own / $serial }")"
  done
done
