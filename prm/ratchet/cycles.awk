# SPDX-License-Identifier: LGPL-2.1-or-later
# Slip per cycle [mm] of the files history.csv given, and what the closed form says of
# the initial subloading surface:
#   awk -F, [-v u=1000] -f prm/ratchet/cycles.awk output/ratchet/point/*/history.csv
# It holds where the load goes to and fro between two values, of any signs.
# Slip path from no load to the ratio r, backwards for a load backwards.
function path(r) {
  return (r < 0 ? 1 : -1) * 2 / (3.14159265358979 * u) * log(cos(1.5707963267948966 * r))
}
/^#/ { next }
/^time_s/ {
  for (i = 1; i <= NF; ++i) column[$i] = i
  if (name != "") report()
  n = 0; last = 0; lowest = 1e9; highest = -1e9
  name = FILENAME; sub(/\/history.csv$/, "", name); sub(/.*\//, "", name)
  next
}
$1 > 0.999 {
  r = $column["r_mean"] * ($column["friction"] < 0 ? -1 : 1)
  # A second is a cycle, which the press takes as well.
  cycle = int($1 - 1 - 1e-9)
  if (cycle != last) { slip[++n] = before; last = cycle }
  before = $column["slip_mm"]
  if ($1 > 2) { if (r < lowest) lowest = r; if (r > highest) highest = r }
}
function report() {
  slip[++n] = before
  printf "%-20s %10.4e %10.4e %10.4e %10.4e %12s\n", name, slip[1],
    slip[2] - slip[1], slip[10] - slip[9], slip[n] - slip[n - 1],
    name ~ /extended/ ? "" : sprintf("%.4e", path(highest) - path(lowest))
}
BEGIN {
  if (!u) u = 1000
  printf "%-20s %10s %10s %10s %10s %12s\n", "r_1 to r_2", "first", "second", "tenth",
    "last", "closed form"
}
END { report() }
