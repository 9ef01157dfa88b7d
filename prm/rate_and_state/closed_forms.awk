# SPDX-License-Identifier: LGPL-2.1-or-later
# What comes after each change of speed and each rest, against the closed forms:
#   awk -F, -f prm/rate_and_state/closed_forms.awk output/rate_and_state/point/*/history.csv
# Value after so little slip that the state is the old one (2 % of D_c), length over which
# the state decays, steady level, and the largest difference in between [%].
BEGIN {
  mu = 0.5; b = 0.025; t0 = 0.01; D = 0.01; eta = 1e7; n = 60; r_m = 1.8
  split("1 101 111 211 221 421 521 721 1721 1921 11921 12121", time, " ")
  printf "%-10s %-16s %9s %9s %10s %9s %9s %8s\n", "law", "after", "at once", "closed",
    "decay [mm]", "steady", "closed", "most [%]"
}
function ratio(V,    low, high, r, i) {
  low = 1; high = r_m
  for (i = 0; i < 60; ++i) {
    r = (low + high) / 2
    if (eta * V * (r_m - r) > exp(n * (r - 1)) - 1) low = r; else high = r
  }
  return r
}
function friction(theta) { return r * mu * (1 + b * log(1 + theta / t0)) }
function state(f) { return t0 * (exp((f / (r * mu) - 1) / b) - 1) }
function closed(s) {
  if (law == "ageing") return D / V + (theta0 - D / V) * exp(-s / D)
  return D / V * exp(log(V * theta0 / D) * exp(-s / D))
}
# Straight in the slip: what is left of the state's change, as a logarithm.
function rest_of_change(theta) {
  if (law == "ageing") return log((theta - D / V) / (theta0 - D / V))
  return log(log(V * theta / D) / log(V * theta0 / D))
}
function begin(name, speed, from) { label = name; V = speed; theta0 = from
  r = ratio(V); first = 0; most = 0; m = sx = sy = sxx = sxy = 0; s0 = slip }
function finish(    slope) {
  if (label == "") return
  slope = m > 2 ? (m * sxy - sx * sy) / (m * sxx - sx * sx) : 0
  printf "%-10s %-16s %9.4f %9.4f %10s %9.4f %9.4f %8.3f\n", law, label, first,
    friction(closed(at)), slope < 0 ? sprintf("%.6f", -1 / slope) : "-", last,
    friction(D / V), most
}
/^#/ { next }
/^time_s/ { finish(); label = ""; for (i = 1; i <= NF; ++i) column[$i] = i
  law = FILENAME; sub(/\/history.csv$/, "", law); sub(/.*\//, "", law); next }
{
  t = $1; f = $column["friction"]
  for (i = 2; i < 12; ++i) if (t > time[i] + 1e-9 && !(before > time[i] + 1e-9)) {
    finish(); label = ""
    if (i == 2) begin("1 to 10 um/s", 0.01, 10)
    else if (i == 3) begin("10 to 1 um/s", 0.001, 1)
    else if (i % 2 == 1) begin("rest of " 10 ^ ((i - 3) / 2) " s", 0.001,
                               10 + (law == "ageing") * 10 ^ ((i - 3) / 2))
  }
  before = t; slip = $column["slip_mm"]; s = slip - s0; last = f
  if (label == "" || s < 2e-4) next
  if (first == 0) { first = f; at = s }
  difference = 100 * (f / friction(closed(s)) - 1)
  if (difference < 0) difference = -difference
  if (difference > most) most = difference
  if (theta0 != D / V && s > 0.1 * D && s < 2 * D) {
    y = rest_of_change(state(f)); ++m; sx += s; sy += y; sxx += s * s; sxy += s * y }
}
END { finish() }
