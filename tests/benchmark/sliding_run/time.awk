# SPDX-License-Identifier: LGPL-2.1-or-later
# Shares of samples by what a function belongs to. In: lines "samples dso symbol",
#   perf report --no-children --sort dso,sym -F sample,dso,sym | grep -v '^#'
NF {
  what = "the rest"
  if (/float/ && /ElasticOperator|FEEvaluation|EvaluatorTensor|MFWorker/)
    what = "products in single precision"
  else if (/VectorUpdater|PreconditionChebyshev/)
    what = "vectors of the Chebyshev polynomials"
  else if (/MGTwoLevel|CellRestrictor|CellProlongator|CellTransfer|ConstraintInfo/)
    what = "transfer between levels"
  else if (/double/ && /ElasticOperator|FEEvaluation|EvaluatorTensor|MFWorker/)
    what = "products in double precision"
  else if (/FrictionLaw|Subloading|Softening|Overstress|Contact(Face|Point|State)|libm\./)
    what = "friction law and contact face"
  else if (/TangentTransfer|definite_part|set_contact|FaceTangent/)
    what = "contact tangent of the levels"
  else if (/VectorOperations|memset|memmove|ConjugateResiduals|FloatVector|copy_locally/)
    what = "vectors of solver and block"
  sum[what] += $1
  all += $1
}
END {
  for (what in sum)
    printf "%5.1f %%  %s\n", 100 * sum[what] / all, what | "sort -rn"
}
