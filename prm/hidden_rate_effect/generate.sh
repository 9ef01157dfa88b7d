#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Writes the tests in measured/ again, with the same noise:
#   prm/hidden_rate_effect/generate.sh
# (after the program has been built)
set -e
here=$(dirname "$0")
. "$here/../hidden_rate_effect/make_tests.sh"

tests 001_mm-min  "1 mm/min, 5.8 MPa"    5.8 "hold:10 1:100"   11 12
tests 010_mm-min  "10 mm/min, 5.8 MPa"   5.8 "hold:10 10:100"  21 22
tests 050_mm-min  "50 mm/min, 5.8 MPa"   5.8 "hold:10 50:100"  31 32
tests 200_mm-min  "200 mm/min, 5.8 MPa"  5.8 "hold:10 200:100" 41 42
tests speed_steps "speed steps, 5.8 MPa" 5.8 \
  "hold:10 10:70 50:15 1:15 200:15 10:15" 51 52
tests half_load   "10 mm/min, 2.9 MPa"   2.9 "hold:10 10:100"  61
tests rests       "rests, 5.8 MPa"       5.8 \
  "hold:10 10:70 hold:100 10:15 hold:1000 10:15" 71
tests there_and_back "there and back, 5.8 MPa" 5.8 \
  "hold:10 50:50 -50:50 50:50" 81
