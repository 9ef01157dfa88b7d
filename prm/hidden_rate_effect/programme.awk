# SPDX-License-Identifier: LGPL-2.1-or-later
# The programme of a test, from pieces "SPEED:LENGTH" (in mm/min and mm; a negative
# speed reverses) or "hold:TIME" (in s). Needs pressure [MPa], pieces.
BEGIN {
  text = "press " pressure " MPa in 1 s"
  n = split(pieces, piece, " ")
  for (i = 1; i <= n; ++i) {
    split(piece[i], part, ":")
    if (part[1] == "hold") text = text "; hold " part[2] " s"
    else text = text "; slide " part[1] " mm/min for " part[2] " mm"
  }
  print text
}
