# When the rupture arrives where, from the column probe_1 (the slip front) of
#   awk -F, -f prm/rupture/arrivals.awk output/rupture/S_0.8/history.csv
# Distances are from the middle of the patch [mm], times since the first of them [us],
# speeds between two of them as shares of that of shear waves.
BEGIN {
  if (!centre) centre = 240
  if (!every)  every  = 10
  if (!wave)   wave   = 3.3333 # mm/us
  mark = 40
}
NR == 1 {
  for (i = 1; i <= NF; ++i) column[$i] = i
  printf "%8s %10s %8s\n", "mm", "us", "V/c_s"
  next
}
$(column["probe_1"]) !~ /nan/ {
  time  = 1e6 * $(column["time_s"])
  front = centre - $(column["probe_1"])
  while (has_last && front >= mark && last_front < mark && mark < centre) {
    at = last_time + (mark - last_front) / (front - last_front) * (time - last_time)
    if (!has_mark) { first = at; has_mark = 1; printf "%8d %10.3f\n", mark, 0 }
    else printf "%8d %10.3f %8.3f\n", mark, at - first, every / (at - before) / wave
    before = at
    mark += every
  }
  last_time = time
  last_front = front
  has_last = 1
}
