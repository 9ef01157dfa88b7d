# SPDX-License-Identifier: LGPL-2.1-or-later
# Writes the cube as input of CalculiX: n^3 elements C3D8, the plane as the top
# of one fixed element, penalty contact in its Gauss points, one increment of
# pressing and 20 of dragging.
#   awk -v n=16 -v size=10 -v young=206e3 -v poisson=0.3 -v pressure=5.8 \
#       -v normal=1e5 -v tangential=1e4 -v friction=0.1 -v drag=1 \
#       -v increments=20 -f deck.awk
function node(i, j, k) { return 1 + i + (n + 1) * (j + (n + 1) * k) }

function print_resultants()
{
  print "*NODE PRINT, NSET=PLANE_NODES, TOTALS=ONLY\nRF"
}

BEGIN {
  h = size / n

  print "*NODE"
  for (k = 0; k <= n; ++k)
    for (j = 0; j <= n; ++j)
      for (i = 0; i <= n; ++i)
        printf "%d, %.12g, %.12g, %.12g\n", node(i, j, k), i * h, j * h, k * h
  # The plane, large enough for the whole slide.
  n_nodes = (n + 1)^3
  split("-1 2 2 -1 -1 2 2 -1", x)
  split("-1 -1 2 2 -1 -1 2 2", y)
  for (a = 1; a <= 8; ++a)
    printf "%d, %.12g, %.12g, %.12g\n", n_nodes + a, x[a] * size, y[a] * size,
           (a <= 4 ? -h : 0)

  print "*ELEMENT, TYPE=C3D8, ELSET=CUBE"
  e = 0
  for (k = 0; k < n; ++k)
    for (j = 0; j < n; ++j)
      for (i = 0; i < n; ++i)
        printf "%d, %d, %d, %d, %d, %d, %d, %d, %d\n", ++e,
               node(i, j, k), node(i + 1, j, k),
               node(i + 1, j + 1, k), node(i, j + 1, k),
               node(i, j, k + 1), node(i + 1, j, k + 1),
               node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1)
  print "*ELEMENT, TYPE=C3D8, ELSET=PLANE"
  printf "%d", e + 1
  for (a = 1; a <= 8; ++a)
    printf ", %d", n_nodes + a
  print ""

  printf "*NSET, NSET=PLANE_NODES, GENERATE\n%d, %d\n", n_nodes + 1, n_nodes + 8
  printf "*NSET, NSET=TOP_NODES, GENERATE\n%d, %d\n", node(0, 0, n), n_nodes
  printf "*ELSET, ELSET=TOP, GENERATE\n%d, %d\n", n^2 * (n - 1) + 1, n^3
  print "*SURFACE, NAME=BOTTOM_FACE"
  for (a = 1; a <= n^2; ++a)
    printf "%d, S1\n", a
  printf "*SURFACE, NAME=PLANE_FACE\n%d, S2\n", e + 1

  printf "*MATERIAL, NAME=STEEL\n*ELASTIC\n%.12g, %.12g\n", young, poisson
  print "*SOLID SECTION, ELSET=CUBE, MATERIAL=STEEL"
  print "*SOLID SECTION, ELSET=PLANE, MATERIAL=STEEL"
  print "*SURFACE INTERACTION, NAME=CONTACT"
  # Slope, and a tension far away that is next to nothing.
  printf "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n%.12g, 1e-6\n", normal
  printf "*FRICTION\n%.12g, %.12g\n", friction, tangential
  print "*CONTACT PAIR, INTERACTION=CONTACT, TYPE=SURFACE TO SURFACE"
  print "BOTTOM_FACE, PLANE_FACE"
  print "*BOUNDARY\nPLANE_NODES, 1, 3\nTOP_NODES, 1, 2"

  printf "*STEP\n*STATIC, DIRECT\n1., 1.\n*DLOAD\nTOP, P2, %.12g\n", pressure
  print_resultants()
  printf "*END STEP\n*STEP\n*STATIC, DIRECT\n1., %d.\n", increments
  printf "*BOUNDARY\nTOP_NODES, 1, 1, %.12g\n", drag
  print_resultants()
  print "*END STEP"
}
