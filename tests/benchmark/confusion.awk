# SPDX-License-Identifier: LGPL-2.1-or-later
# What was hidden against what was said, as a table, from lines that
# diagnosis_benchmark prints: awk -v least=25 -f confusion.awk FILE...
# least: detectability of the campaigns that count.
$3 == "FAILED" || $11 < least { next }
{
  row = $3; column = $4 == "named" ? $5 : $4
  if ($4 == "ambiguous") column = "ambiguous"
  if (!(row in n)) rows[++n_rows] = row
  if (!(column in seen)) { seen[column] = 1; columns[++n_columns] = column }
  n[row]++; count[row, column]++
}
function sorted(list, size,   i, j, v) {
  for (i = 2; i <= size; ++i) { v = list[i]; for (j = i - 1; j >= 1 && rank(list[j]) > rank(v); --j) list[j + 1] = list[j]; list[j + 1] = v }
}
# Words of the verdict stand behind the names.
function rank(word) { return (word ~ /^(ambiguous|unnamed|no_gap|not_testable)$/ ? "~" : "") word }
END {
  sorted(rows, n_rows); sorted(columns, n_columns)
  line = "| Hidden, said |"; rule = "|---|"
  for (c = 1; c <= n_columns; ++c) { line = line " " columns[c] " |"; rule = rule "---:|" }
  print line; print rule
  for (r = 1; r <= n_rows; ++r) {
    line = "| " rows[r] " |"
    for (c = 1; c <= n_columns; ++c) line = line " " (((rows[r], columns[c]) in count) ? count[rows[r], columns[c]] : "") " |"
    print line
  }
}
