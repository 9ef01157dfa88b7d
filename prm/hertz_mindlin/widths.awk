# Half-widths and peak of the contact from contact_face.csv. By Hertz p^2 is a
# parabola, and by Cattaneo and Mindlin so is (mu p - q)^2 where the contact sticks;
# their places are free, since the drag shifts the contact a little.
#   awk -F, -v mu=0.3 [-v centre=20 -v R=100 -v E=967.7 -v nu=0.49] -f widths.awk contact_face.csv
BEGIN { if (!R) R = 100; if (!E) E = 967.7; if (nu == "") nu = 0.49 } # of the case
NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
{
  x[NR] = $1 - (centre == "" ? 20 : centre); w[NR] = $column["area_mm2"]
  p[NR] = $column["pressure_MPa"]; q[NR] = $column["traction_x_MPa"]
  P += w[NR] * p[NR]; Q += w[NR] * q[NR]
}
# Half-width of the parabola through the squares of values[i] that are more than a
# share of the largest; sets its peak and its middle.
function half_width(values,    i, j, k, y, m, s, t, f, b) {
  peak = 0
  for (i in values) if (values[i] > peak) peak = values[i]
  for (j = 0; j < 5; ++j) s[j] = 0
  for (j = 0; j < 3; ++j) t[j] = 0
  for (i in values) {
    if (values[i] < 0.3 * peak) continue
    y = values[i]^2
    for (j = 0; j < 5; ++j) s[j] += w[i] * x[i]^j
    for (j = 0; j < 3; ++j) t[j] += w[i] * x[i]^j * y
  }
  for (j = 0; j < 3; ++j) { for (k = 0; k < 3; ++k) m[j, k] = s[j + k]; m[j, 3] = t[j] }
  for (j = 0; j < 3; ++j)
    for (i = 0; i < 3; ++i) if (i != j) {
      f = m[i, j] / m[j, j]
      for (k = j; k < 4; ++k) m[i, k] -= f * m[j, k]
    }
  for (j = 0; j < 3; ++j) b[j] = m[j, 3] / m[j, j]
  middle = -b[1] / (2 * b[2])
  peak = sqrt(b[0] - b[1]^2 / (4 * b[2]))
  return sqrt(b[1]^2 - 4 * b[0] * b[2]) / (-2 * b[2])
}
END {
  pi = atan2(0, -1); modulus = E / (1 - nu^2)
  hertz = sqrt(4 * P * R / (pi * modulus)); p_0 = 2 * P / (pi * hertz)
  a = half_width(p); place = middle
  printf "P   %.4f N/mm, Q %.4f N/mm, Q/(mu P) %.4f\n", P, Q, Q / (mu * P)
  printf "a   %.5f mm, half-space %.5f, off by %.2f %%\n", a, hertz, 100 * (a / hertz - 1)
  printf "p_0 %.4f MPa, half-space %.4f, off by %.2f %%\n", peak, p_0, 100 * (peak / p_0 - 1)
  if (Q < 0) { Q = -Q; for (i in q) q[i] = -q[i] } # dragged the other way
  if (Q > 0.01 * mu * P) {
    for (i in p) rest[i] = mu * p[i] - q[i]
    c = half_width(rest); mindlin = hertz * sqrt(1 - Q / (mu * P))
    printf "c   %.5f mm, half-space %.5f, off by %.2f %%\n", c, mindlin, 100 * (c / mindlin - 1)
    for (i in p) if (p[i] > 0) {
      s = 1 - ((x[i] - place) / hertz)^2; r = 1 - ((x[i] - middle) / mindlin)^2
      q_h = mu * p_0 * ((s > 0 ? sqrt(s) : 0) - (r > 0 ? mindlin / hertz * sqrt(r) : 0))
      error += w[i] * (q[i] - q_h)^2; norm += w[i] * q_h^2
    }
    printf "q   off by %.2f %% (root mean square), contact shifted by %.4f mm, what sticks by %.4f mm\n", 100 * sqrt(error / norm), place, middle
  }
}
