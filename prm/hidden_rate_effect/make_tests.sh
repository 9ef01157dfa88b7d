# SPDX-License-Identifier: LGPL-2.1-or-later
# For the scripts that write planted tests, which say where they stand: here.

slipstep=${SLIPSTEP:-$here/../../build/slipstep}
tools=$here/../hidden_rate_effect
scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT
mkdir -p "$here/measured"

# tests FILE CONDITION PRESSURE PIECES SEED...: a test for every seed
tests() {
  file=$1; condition=$2; pressure=$3; pieces=$4; shift 4
  "$slipstep" point "$here/truth.prm" --output "$scratch" --quiet \
    --set "Loading/Programme=$(awk -v pressure="$pressure" -v pieces="$pieces" \
                                 -f "$tools/programme.awk")"
  run=1
  for seed in "$@"; do
    awk -v seed="$seed" -v pressure="$pressure" -v pieces="$pieces" \
      -v name="$condition, run $run" -v condition="$condition" \
      -f "$tools/../identify_flat_surface/noise.awk" \
      -f "$tools/record.awk" "$scratch/history.csv" \
      > "$here/measured/${file}_$run.csv"
    run=$((run + 1))
  done
}
