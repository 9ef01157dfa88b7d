# SPDX-License-Identifier: LGPL-2.1-or-later
# Rates of the lines that diagnosis_benchmark prints, with 95 % intervals by
# Wilson: awk -f rates.awk FILE...
function rate(k, n,   p, c, h) {
  if (n == 0) return "-"
  p = k / n; c = (p + 1.9207 / n) / (1 + 3.8415 / n)
  h = 1.96 / (1 + 3.8415 / n) * sqrt(p * (1 - p) / n + 0.9604 / n / n)
  return sprintf("%d/%d = %.1f %% (%.1f-%.1f)", k, n, 100 * p, 100 * (c - h > 0 ? c - h : 0), 100 * (c + h < 1 ? c + h : 1))
}
$3 == "FAILED" { failed[$1]++; next }
{
  class[$1] = 1; all[$1]++; cpu[$1] += $17
  alarm[$1] += $7; wrong[$1] += $9; verdict[$1, $4]++
  if ($5 != "-") { inside[$1] += $21; intervals[$1] += $20; if ($22 > 0) { left[$1]++; near[$1] += $22 <= 1.25 } }
  next_test[$1] += $23; solved[$1] += $24; misled[$1] += $25
  if ($3 != "-") {
    strong = $11 >= 25
    n[$1, strong]++; exact[$1, strong] += $8; holds[$1, strong] += $10
    falsely[$1, strong] += $9
    partner[$1, strong] += $9 && $10
    if ($5 != "-" && $13 > 0) ratio[$1, ++n_ratio[$1]] = $12 / $13
  }
}
END {
  for (c in class) {
    printf "%s: %d campaigns, %d failed, %.1f s of CPU each\n", c, all[c], failed[c], cpu[c] / all[c]
    printf "  verdicts: named %d, ambiguous %d, unnamed %d, no gap %d, not testable %d\n", verdict[c, "named"], verdict[c, "ambiguous"], verdict[c, "unnamed"], verdict[c, "no_gap"], verdict[c, "not_testable"]
    printf "  any alarm %s, any false name %s\n", rate(alarm[c], all[c]), rate(wrong[c], all[c])
    printf "  unnamed %s\n", rate(verdict[c, "unnamed"], all[c])
    for (s = 1; s >= 0; --s)
      if (n[c, s])
        printf "  %s: exact %s, truth held %s, any false name %s, besides the right one %s\n", s ? "detectable (>= 25)" : "weak", rate(exact[c, s], n[c, s]), rate(holds[c, s], n[c, s]), rate(falsely[c, s], n[c, s]), rate(partner[c, s], n[c, s])
    m = n_ratio[c]
    for (i = 2; i <= m; ++i) { v = ratio[c, i]; for (j = i - 1; j >= 1 && ratio[c, j] > v; --j) ratio[c, j + 1] = ratio[c, j]; ratio[c, j + 1] = v }
    if (intervals[c]) printf "  planted strengths inside their 95 %% intervals: %s\n", rate(inside[c], intervals[c])
    if (left[c]) printf "  left-out conditions within 1.25 times the noise: %s\n", rate(near[c], left[c])
    if (next_test[c]) printf "  ambiguous ones settled by the proposed test: %s, wrongly: %s\n", rate(solved[c], next_test[c]), rate(misled[c], next_test[c])
    if (m) printf "  where named: model error divided by %.1f in the median\n", ratio[c, int((m + 1) / 2)]
  }
}
