#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Cuts four parts of five strokes to and fro out of the record, for diagnose.prm,
# every fourth row, each from the same instant of a stroke: the end of the rest at
# the near end.
#   prm/reciprocating_tribometer/cut.sh
set -e
here=$(dirname "$0")
record=$here/measured/test_data_2.csv
mkdir -p "$here/parts"
for start in 20 65 110 155; do
  awk -F, -v start=$start '
    /^# (licence|remark|source):/ { sub("see LICENSE", "see measured/LICENSE"); print; next }
    /^#/ { next }
    /^time/ {
      print "# name: 5 N, 0.23 mm, from " start " s on"
      print "# condition: 5 N, 0.23 mm"
      print "# converted from: measured/test_data_2.csv, every fourth row"
      print
      next
    }
    { ++n }
    !begin && $1 >= start && last < 0.012 && $2 >= 0.012 { begin = $1; first = n }
    { last = $2 }
    begin && $1 < begin + 20 && (n - first) % 4 == 0 {
      printf "%.2f,%s,%s,%s\n", $1 - begin, $2, $3, $4
    }' "$record" > "$here/parts/from_$(printf %03d $start)_s.csv"
done
