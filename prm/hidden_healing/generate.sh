#!/bin/sh
# Writes the tests in measured/ again, with the same noise:
#   prm/hidden_healing/generate.sh
# (after the program has been built)
set -e
here=$(dirname "$0")
slipstep=${SLIPSTEP:-$here/../../build/slipstep}
scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT
mkdir -p "$here/measured"

# tests FILE CONDITION PRESSURE PIECES SEED...: a test for every seed
tests() {
  file=$1; condition=$2; pressure=$3; pieces=$4; shift 4
  "$slipstep" point "$here/truth.prm" --output "$scratch" --quiet \
    --set "Loading/Programme=$(awk -v pressure="$pressure" -v pieces="$pieces" \
                                 -f "$here/../hidden_rate_effect/programme.awk")"
  run=1
  for seed in "$@"; do
    awk -v seed="$seed" -v pressure="$pressure" -v pieces="$pieces" \
      -v name="$condition, run $run" -v condition="$condition" \
      -f "$here/../identify_flat_surface/noise.awk" \
      -f "$here/../hidden_rate_effect/record.awk" "$scratch/history.csv" \
      > "$here/measured/${file}_$run.csv"
    run=$((run + 1))
  done
}

for time in 3 30 300 3000; do
  tests "rest_$(printf %04d $time)_s" "rest of $time s, 5.8 MPa" 5.8 \
    "hold:10 50:60 hold:$time 50:40" 1$time 2$time
done
tests 001_mm-min  "1 mm/min, 5.8 MPa"    5.8 "hold:10 1:100"   11
tests 010_mm-min  "10 mm/min, 5.8 MPa"   5.8 "hold:10 10:100"  21 22
tests 200_mm-min  "200 mm/min, 5.8 MPa"  5.8 "hold:10 200:100" 41
tests speed_steps "speed steps, 5.8 MPa" 5.8 \
  "hold:10 10:70 50:15 1:15 200:15 10:15" 51
tests half_load   "rest of 300 s, 2.9 MPa" 2.9 "hold:10 50:60 hold:300 50:40" 61
