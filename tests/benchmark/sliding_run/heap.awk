# SPDX-License-Identifier: LGPL-2.1-or-later
# Bytes per unknown by who asked for them, when most memory is in use.
#   heaptrack -o heap slipstep run ...
#   heaptrack_print -f heap.zst --flamegraph-cost-type peak -F stacks >/dev/null
#   awk -v unknowns=1594323 -f heap.awk stacks
{
  what = "the rest"
  vector = /posix_memalign/
  if (/ConjugateResiduals/) what = "bases of the linear solver"
  else if (vector && /solve_stage/) what = "vectors of a Newton iteration"
  else if (vector && /setup_unknowns/) what = "vectors of the block"
  else if (vector && /MultigridSystem/) what = "vectors of the levels, single precision"
  else if (/find_nodes|append_nodes/) what = "tables of nodes"
  else if (/MatrixFree</) what = "matrix-free tables of the library"
  else if (/MGTwoLevelTransfer/) what = "transfer between levels"
  else if (/geometric_coarsening/) what = "coarser meshes"
  else if (/distribute_dofs|DoFHandler/) what = "numbers of unknowns"
  else if (/AffineConstraints|constrain/) what = "constraints"
  else if (/Triangulation|refine_global|p4est/) what = "finest mesh"
  sum[what] += $NF
}
END {
  for (what in sum)
    printf "%6.1f  %s\n", sum[what] / unknowns, what | "sort -rn"
}
