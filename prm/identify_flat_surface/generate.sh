#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Writes all records of this case again, with the same noise:
#   prm/identify_flat_surface/generate.sh
# (from where ./run was called, after the program has been built)
set -e
here=$(dirname "$0")
slipstep=${SLIPSTEP:-$here/../../build/slipstep}
scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT
mkdir -p "$here/levels" "$here/softening" "$here/planted"

for noise in 0 5e-4; do
  awk -v seed=1 -v noise=$noise -f "$here/noise.awk" -f "$here/softening.awk" \
    > "$here/softening/noise_$noise.csv"
done

"$slipstep" point "$here/truth.prm" --output "$scratch" --quiet
for speed in 1 10 50 200; do
  file=$(printf %03d $speed)_mm-min.csv
  awk -v speed=$speed -f "$here/noise.awk" -f "$here/levels.awk" \
    > "$here/levels/$file"
  awk -v seed=1$speed -v noise=5e-4 -v rows=401 -v speed=$speed \
    -f "$here/noise.awk" -f "$here/sample.awk" "$scratch/${speed}_mm-min/history.csv" \
    > "$here/planted/$file"
done
