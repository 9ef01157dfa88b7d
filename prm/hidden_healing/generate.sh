#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Writes the tests in measured/ again, with the same noise:
#   prm/hidden_healing/generate.sh
# (after the program has been built)
set -e
here=$(dirname "$0")
. "$here/../hidden_rate_effect/make_tests.sh"

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
