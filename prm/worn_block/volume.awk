# SPDX-License-Identifier: LGPL-2.1-or-later
# What wore away, and the pressure that is left:
#   awk -F, [-v k=1e-8] -f prm/worn_block/volume.awk output/worn_block/*/contact_face.csv
BEGIN { if (!k) k = 1e-8 # mm^2/N, of the case: 1e-5 mm^3/(N m)
  printf "%-12s %14s %14s %18s %22s\n", "", "volume [mm^2]", "k N s [mm^2]",
  "pressure [MPa]", "depth [um]" }
function finish() {
  if (name != "") printf "%-12s %14.5e %14.5e %8.3f to %6.3f %10.5f to %8.5f\n", name, volume,
    k * work, least, most, 1e3 * shallow, 1e3 * deep
}
FNR == 1 { finish(); for (i = 1; i <= NF; ++i) column[$i] = i
  name = FILENAME; sub(/\/contact_face.csv$/, "", name); sub(/.*\//, "", name)
  volume = work = most = deep = 0; least = shallow = 1e9; next }
{
  area = $column["area_mm2"]; p = $column["pressure_MPa"]; w = $column["worn_depth_mm"]
  volume += area * w; work += area * p * $column["slip_mm"]
  if (p > most) most = p
  if (p < least) least = p
  if (w > deep) deep = w
  if (w < shallow) shallow = w
}
END { finish() }
