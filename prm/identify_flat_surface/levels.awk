# SPDX-License-Identifier: LGPL-2.1-or-later
# Steady sliding at the kinetic coefficient of eq. 4, needs speed [mm/min].
BEGIN {
  heading("eq. 4, " speed " mm/min", speed " mm/min",
    "generated: the kinetic coefficient of eq. 4 of the source paper, 4.20e-3 ln V + 0.100, over 1 mm; not measured")
  print "# noise: 0.0005"
  columns()
  for (i = 0; i <= 4; ++i) {
    s = 0.25*i
    printf "%.6g,%.6g,5.8,%.9f\n", s*60/speed, s, 4.20e-3*log(speed) + 0.100
  }
}
