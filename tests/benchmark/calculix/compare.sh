#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# slipstep and CalculiX side by side on the same cube: same mesh, contact
# stiffnesses, increments and constant coefficient, one core each.
#   tests/benchmark/calculix/compare.sh [N...] [--drag sliding|partial]
#                                       [--set PATH=VALUE...]
# N: cells per edge (default 16 24). The cube is dragged until all of it slides,
# and so little that a part of it sticks all the way; --drag does one of the two.
# --set goes to slipstep, for instance
#   compare.sh 16 24 --set Block/Solver=amg
# Needs the Debian packages calculix-ccx and time, and slipstep in build/ (or in
# $SLIPSTEP_BUILD_DIR). Exit code 1 if the friction forces disagree.
set -eu -o pipefail
export LC_ALL=C OMP_NUM_THREADS=1

here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
slipstep=$(realpath -m "${SLIPSTEP_BUILD_DIR:-$here/../../../build}")/slipstep
case_file=$here/cube.prm
increments=20

say() { printf '%s\n' "$*"; }
fail() { local code=$1; shift; say "compare.sh: $*" >&2; exit "$code"; }

sizes=()
settings=()
drags=(sliding partial)
while [ $# -gt 0 ]; do
  case $1 in
    --set)
      [ $# -ge 2 ] || fail 2 "--set needs PATH=VALUE"
      settings+=(--set "$2")
      shift
      ;;
    --drag)
      case ${2-} in
        sliding | partial) drags=("$2") ;;
        *) fail 2 "--drag needs 'sliding' or 'partial'" ;;
      esac
      shift
      ;;
    '' | 0* | *[!0-9]*) fail 2 "'$1' is neither a number of cells nor --drag nor --set" ;;
    *) sizes+=("$1") ;;
  esac
  shift
done
[ ${#sizes[@]} -gt 0 ] || sizes=(16 24)

missing=()
command -v ccx >/dev/null || missing+=(calculix-ccx)
[ -x /usr/bin/time ] || missing+=(time)
[ ${#missing[@]} -eq 0 ] ||
  fail 1 "packages are missing: apt-get install ${missing[*]}"
[ -x "$slipstep" ] || fail 1 "$slipstep is missing; ./run --help tells how to build"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# The number behind "set KEY =" or behind a word of the programme.
value()
{
  local found
  found=$(sed -nE "s/^.*(set $1 *=|$1) *([0-9][0-9.e+-]*).*/\2/p" "$case_file")
  [ -n "$found" ] || fail 1 "$case_file does not tell '$1'"
  say "$found"
}

# measure NAME COMMAND...: its CPU seconds (user + system, children included)
# and peak memory [MB] go into NAME.cost.
measure()
{
  local name=$1
  shift
  /usr/bin/time -f '%U %S %M' -o "$work/time" "$@" >"$work/log" 2>&1 ||
    { tail -n 20 "$work/log" >&2; fail 1 "$1 failed"; }
  awk '{ printf "%.2f %.0f\n", $1 + $2, $3 / 1024 }' "$work/time" \
    >"$work/$name.cost"
}

# run_both N DRAG: costs, and tangential / normal force after each increment in
# slipstep.ratio and calculix.ratio.
run_both()
{
  local n=$1 drag=$2 step programme i
  step=$(awk "BEGIN { printf \"%.12g\", $drag / $increments }")
  programme="press $(value press) MPa in 1 s"
  for ((i = 0; i < increments; ++i)); do
    programme+="; slide $step mm/s for $step mm"
  done
  measure slipstep "$slipstep" run "$case_file" --quiet \
    --set "Block/Subdivisions=$n, $n, $n" --set "Loading/Programme=$programme" \
    ${settings[@]+"${settings[@]}"} --output "$work/slipstep"
  awk -F, '/^[0-9]/ && $2 > 0 { print $4 }' "$work/slipstep/history.csv" \
    >"$work/slipstep.ratio"

  awk -v n="$n" -v drag="$drag" -v increments=$increments \
      -v size="$(value Size)" -v young="$(value 'Young modulus')" \
      -v poisson="$(value 'Poisson ratio')" -v pressure="$(value press)" \
      -v normal="$(value 'Normal stiffness')" \
      -v tangential="$(value 'Tangential stiffness')" \
      -v friction="$(value 'Static coefficient')" \
      -f "$here/deck.awk" >"$work/cube.inp"
  (cd "$work" && measure calculix ccx -i cube)
  # The first force is that of the press.
  awk '/total force/ { getline; getline; print -$1 / $3 }' "$work/cube.dat" |
    tail -n +2 >"$work/calculix.ratio"

  local name
  for name in slipstep calculix; do
    [ "$(wc -l <"$work/$name.ratio")" -eq $increments ] ||
      fail 1 "$name did not make $increments increments"
  done
}

# Prints the first and the last ratio of both, and the largest difference in ppm
# of the force.
compare_ratios()
{
  paste "$work/slipstep.ratio" "$work/calculix.ratio" |
    awk 'NR == 1 { first = sprintf("%.5f %.5f", $1, $2) }
         { d = ($1 - $2) / $2; if (d < 0) d = -d; if (d > worst) worst = d }
         END { printf "%s %.5f %.5f %.0f\n", first, $1, $2, 1e6 * worst }'
}

worse_than() { awk "BEGIN { exit !($1 > $2) }"; }

# race NAME DRAG: a table of costs, a line per size.
race()
{
  local n our_first their_first ours theirs difference
  local our_time our_memory their_time their_memory
  say "$1: drag of $2 mm in $increments increments, one core:"
  printf '  %4s %9s  %17s  %17s %11s %9s %9s %7s %9s %9s\n' \
    N unknowns 'ratio of forces' 'ratio of forces' difference 'CPU [s]' \
    'CPU [s]' times 'MB' 'MB' \
    '' '' slipstep calculix '[ppm]' slipstep calculix '' slipstep calculix
  for n in "${sizes[@]}"; do
    run_both "$n" "$2"
    read -r our_first their_first ours theirs difference < <(compare_ratios)
    read -r our_time our_memory <"$work/slipstep.cost"
    read -r their_time their_memory <"$work/calculix.cost"
    printf '  %4d %9d  %s–%s  %s–%s %11s %9s %9s %7.1f %9s %9s\n' "$n" \
      $((3 * (n + 1) ** 3)) "$our_first" "$ours" "$their_first" "$theirs" \
      "$difference" "$our_time" "$their_time" \
      "$(awk "BEGIN { print $their_time / $our_time }")" \
      "$our_memory" "$their_memory"
    worse_than "$difference" 1000 && disagree=1
  done
  return 0
}

disagree=0
say "$("$slipstep" --version | head -n 1), ccx$(ccx -v | sed -n 's/.*Version/ version/p')"
say "Increments of the elastic stick on 8^3 cells, drag of 0.4 um in all:"
run_both 8 4e-4
say "  slipstep calculix (tangential / normal force)"
paste "$work/slipstep.ratio" "$work/calculix.ratio" |
  awk 'NR % 2 { printf "  %8.5f %8.5f\n", $1, $2 }'
read -r _ _ _ _ difference < <(compare_ratios)
say "  largest difference: $difference ppm"
worse_than "$difference" 10000 && disagree=1

for drag in "${drags[@]}"; do
  case $drag in
    sliding) race "Sliding" 1 ;;
    partial) race "Partial slip" 1.2e-4 ;;
  esac
done
[ $disagree -eq 0 ] || fail 1 "the friction forces disagree"
