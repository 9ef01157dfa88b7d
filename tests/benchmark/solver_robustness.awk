# SPDX-License-Identifier: LGPL-2.1-or-later
# Sums up the table of solver_robustness.cc: iterations over the friction
# coefficient, in the middle and at worst of all patterns of the contact,
# stiffnesses of a group and local refinements; and how many did not converge.
#   build/tests/solver_robustness_benchmark | awk -f tests/benchmark/solver_robustness.awk
BEGIN { FS = " *[|] *" }

NR == 1 {
  n_mu = NF - 8
  for (i = 1; i <= n_mu; ++i)
    mu[i] = $(i + 7)
  next
}

{
  key = $5 " | " $3 " | " $2 " | " ($7 + 0 > 1e6 ? $7 : "to 1e+06")
  if (!(key in seen))
    {
      seen[key] = 1
      keys[++n_keys] = key
    }
  for (i = 1; i <= NF - 8; ++i)
    if ($(i + 7) ~ /^-/)
      ++failed[key, i]
    else
      values[key, i] = values[key, i] " " ($(i + 7) + 0)
}

function middle_and_worst(text,    n, v, i, j, t)
{
  n = split(text, v, " ")
  for (i = 2; i <= n; ++i)
    for (j = i; j > 1 && v[j - 1] + 0 > v[j] + 0; --j)
      {
        t = v[j]
        v[j] = v[j - 1]
        v[j - 1] = t
      }
  return n == 0 ? "–" : v[int((n + 1) / 2)] ", " v[n]
}

END {
  line = "| nu | elements | dimension | k [MPa/mm] |"
  for (i = 1; i <= n_mu; ++i)
    line = line " " mu[i] " |"
  print line
  for (k = 1; k <= n_keys; ++k)
    {
      line = "| " keys[k] " |"
      for (i = 1; i <= n_mu; ++i)
        line = line " " middle_and_worst(values[keys[k], i]) \
               (failed[keys[k], i] ? ", – ×" failed[keys[k], i] : "") " |"
      print line
    }
}
