# SPDX-License-Identifier: LGPL-2.1-or-later
# Differentiates a record: displacement, friction, slope over windows of some
# rows, side by side. Needs rows and, for neighbours, way=difference (friction of
# the first row, slope to the last); else a straight line through all of them.
BEGIN { FS = "," }
/^[#t]/ { next }
{
  ++n
  s[n] = $2
  f[n] = $4
}
END {
  for (i = 1; i + rows - 1 <= n; i += (way == "difference" ? rows - 1 : rows)) {
    last = i + rows - 1
    if (way == "difference") {
      print s[i], f[i], (f[last] - f[i])/(s[last] - s[i])
      continue
    }
    x = y = xx = xy = 0
    for (j = i; j <= last; ++j) {
      x += s[j]/rows
      y += f[j]/rows
    }
    for (j = i; j <= last; ++j) {
      xx += (s[j] - x)^2
      xy += (s[j] - x)*(f[j] - y)
    }
    print x, y, xy/xx
  }
}
