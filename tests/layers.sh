#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# The shape of the house: a room includes only rooms below it, the friction law
# needs no mesh, and no file is too long to read.
#   tests/layers.sh [<root>]    prints each violation; exit code 1 if any
set -u
cd "${1:-$(dirname "$0")/..}" || exit 1

# Of every room, the rooms that it stands on. The law, what is measured and what
# is made up do not know one another, neither do block and fit.
declare -A below=(
  [utilities]=''
  [friction]='utilities'
  [measured_data]='utilities'
  [law_library]='utilities friction'
  [synthetic_tests]='utilities measured_data'
  [experiment]='utilities friction measured_data'
  [calibration]='utilities friction measured_data experiment'
  [solid]='utilities friction measured_data experiment'
  [diagnosis]='utilities friction measured_data experiment calibration'
  [report]='utilities friction measured_data experiment calibration diagnosis'
)
below[commands]="${!below[*]}"
most_lines=700
violations=0

complain()
{
  printf '%s\n' "$*"
  violations=$((violations + 1))
}

# Prints "file:line header" for every include of the given files.
includes()
{
  grep -nHE '^[[:space:]]*#[[:space:]]*include[[:space:]]*[<"]' "$@" /dev/null |
    sed -E 's/:[[:space:]]*#[[:space:]]*include[[:space:]]*[<"]([^>"]*).*/ \1/'
}

for folder in include/slipstep/*/ source/*/; do
  room=$(basename "$folder")
  [ -n "${below[$room]+known}" ] || complain "$folder: no room that has a place"
done

for room in "${!below[@]}"; do
  allowed=" $room ${below[$room]} "
  mapfile -t files < <(find "include/slipstep/$room" "source/$room" -type f \
                         \( -name '*.h' -o -name '*.cc' \) 2>/dev/null)
  [ ${#files[@]} -eq 0 ] && continue

  while read -r place header; do
    case $header in
      slipstep/*/*)
        target=${header#slipstep/}
        [[ $allowed == *" ${target%%/*} "* ]] ||
          complain "$place: $room does not stand on $header"
        ;;
      deal.II/base/mpi.h | deal.II/base/mpi_* | mpi.h)
        [[ $room == solid || $room == commands ]] ||
          complain "$place: $room must not use MPI ($header)"
        ;;
      deal.II/base/*) ;;
      deal.II/*)
        case $room in
          utilities | friction | measured_data | synthetic_tests)
            complain "$place: $room may use deal.II/base only, not $header"
            ;;
        esac
        ;;
      Epetra* | Teuchos* | ml_* | ML_* | Amesos* | p4est* | petsc*)
        [[ $room == solid ]] ||
          complain "$place: only solid may use $header"
        ;;
    esac
  done < <(includes "${files[@]}")
done

while read -r lines file; do
  [ "$lines" -gt "$most_lines" ] &&
    complain "$file has $lines lines, more than $most_lines"
done < <(find include source tests -type f \( -name '*.h' -o -name '*.cc' \) \
           -exec wc -l {} \; 2>/dev/null)

# Two types of one name are one to the linker, which mixes their functions.
while read -r name files; do
  complain "$name is defined twice: $files"
done < <(find include -name '*.h' -exec awk '
           /^  (struct|class) [A-Za-z0-9_]+/ && !/;/ { name = $2; next }
           name != "" && /^  (\{|:)/ { print name, FILENAME }
           { name = "" }' {} + | sort |
         awk '$1 == name { print name, file, $2 } { name = $1; file = $2 }')

[ "$violations" -eq 0 ] && echo "The layers hold."
exit $((violations > 0))
