#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Cost of a sliding run of 200 time steps: CPU time, iterations and memory over
# the number of unknowns and of ranks.
#   tests/benchmark/sliding_run/measure.sh [M...] [--ranks R[,R...]]
#                                          [--set PATH=VALUE...]
# M: the block has 4M x 4M x M cells Q2 (default 4 8: 29403 and 215475
# unknowns). --set goes to slipstep, for instance
#   measure.sh 4 8 --ranks 1,2 --set Block/Solver=amg
# Needs slipstep in build/ (or in $SLIPSTEP_BUILD_DIR).
set -eu -o pipefail
export LC_ALL=C OMP_NUM_THREADS=1

here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
slipstep=$(realpath -m "${SLIPSTEP_BUILD_DIR:-$here/../../../build}")/slipstep
case_file=$here/sliding_run.prm

say() { printf '%s\n' "$*"; }
fail() { local code=$1; shift; say "measure.sh: $*" >&2; exit "$code"; }

sizes=()
ranks=(1)
settings=()
while [ $# -gt 0 ]; do
  case $1 in
    --set)
      [ $# -ge 2 ] || fail 2 "--set needs PATH=VALUE"
      settings+=(--set "$2")
      shift
      ;;
    --ranks)
      [[ ${2:-} =~ ^[1-9][0-9]*(,[1-9][0-9]*)*$ ]] ||
        fail 2 "--ranks needs numbers of ranks, for instance 1,2"
      IFS=, read -ra ranks <<<"$2"
      shift
      ;;
    '' | 0* | *[!0-9]*) fail 2 "'$1' is neither a number M nor an option" ;;
    *) sizes+=("$1") ;;
  esac
  shift
done
[ ${#sizes[@]} -gt 0 ] || sizes=(4 8)
[ -x "$slipstep" ] || fail 1 "$slipstep is missing; ./run --help tells how to build"
command -v mpirun >/dev/null || fail 1 "mpirun is missing: apt-get install openmpi-bin"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# run RANKS M: leaves the path of summary.json in $summary.
run()
{
  local cells="$((4 * $2)), $((4 * $2)), $2" output=$work/$2_$1
  local command=("$slipstep" run "$case_file" --quiet --variant '1 mm/min'
                 --set "Block/Subdivisions=$cells" --output "$output"
                 ${settings[@]+"${settings[@]}"})
  [ "$1" -eq 1 ] ||
    command=(mpirun --oversubscribe --allow-run-as-root -np "$1" "${command[@]}")
  "${command[@]}" >"$work/log" 2>&1 ||
    { tail -n 20 "$work/log" >&2; fail 1 "the run failed"; }
  summary=$(find "$output" -name summary.json | head -n 1)
}

# The number at a key of summary.json.
value() { sed -nE "s/^ *\"$1\": ([0-9.e+-]+),?$/\1/p" "$summary"; }

say "$("$slipstep" --version | head -n 1)"
printf '%9s %6s %6s %8s %7s %8s %9s %13s %12s %10s\n' \
  unknowns ranks steps rejected Newton linear 'CPU [s]' 'CPU/rank [s]' \
  'us/(unk.*N)' 'memory [MB]'
for m in "${sizes[@]}"; do
  for n in "${ranks[@]}"; do
    run "$n" "$m"
    awk -v dofs="$(value dofs)" -v ranks="$(value ranks)" \
        -v steps="$(value steps)" -v rejected="$(value rejected_steps)" \
        -v newton="$(value newton_iterations)" \
        -v linear="$(value linear_iterations)" -v cpu="$(value cpu_s)" \
        -v memory="$(value peak_memory_MB)" 'BEGIN {
      printf "%9d %6d %6d %8d %7d %8d %9.2f %13.2f %12.3f %10.0f\n", dofs,
             ranks, steps, rejected, newton, linear, cpu, cpu / ranks,
             1e6 * cpu / (dofs * newton), memory }'
  done
done
say "us/(unk.*N): CPU microseconds of all ranks per unknown and Newton step"
