# SPDX-License-Identifier: LGPL-2.1-or-later
# normal(): numbers with standard deviation 1, the same ones from every awk
# (Park and Miller's generator, Box and Muller's formula). Needs seed.
function uniform() {
  seed = (16807*seed) % 2147483647
  return seed/2147483647
}
# Near each other seeds begin alike.
BEGIN { for (i = 0; i < 10; ++i) uniform() }
function normal(  radius) {
  radius = sqrt(-2*log(uniform()))
  return radius*cos(6.283185307179586*uniform())
}

# The lines before the rows of a measured test.
function heading(name, condition, source) {
  print "# name: " name
  print "# condition: " condition
  print "# source: " source
  print "# licence: that of slipstep"
}
function columns() {
  print "time_s,displacement_mm,pressure_MPa,friction"
}
