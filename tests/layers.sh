#!/usr/bin/env bash
# The shape of the house: a room includes only rooms below it, the friction law
# needs no mesh, and no file is too long to read.
#   tests/layers.sh [<root>]    prints each violation; exit code 1 if any
set -u
cd "${1:-$(dirname "$0")/..}" || exit 1

rooms=(utilities friction measured_data synthetic_tests experiment calibration diagnosis solid)
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

allowed=' '
for room in "${rooms[@]}"; do
  allowed+="$room "
  mapfile -t files < <(find "include/slipstep/$room" "source/$room" -type f \
                         \( -name '*.h' -o -name '*.cc' \) 2>/dev/null)
  [ ${#files[@]} -eq 0 ] && continue

  while read -r place header; do
    case $header in
      slipstep/*/*)
        target=${header#slipstep/}
        [[ $allowed == *" ${target%%/*} "* ]] ||
          complain "$place: $room must not include $header, a room above it"
        ;;
      deal.II/base/mpi.h | deal.II/base/mpi_* | mpi.h)
        [[ $room == solid || $room == diagnosis ]] ||
          complain "$place: $room must not use MPI ($header)"
        ;;
      deal.II/base/*) ;;
      deal.II/*)
        [[ $room == friction || $room == utilities ]] &&
          complain "$place: $room may use deal.II/base only, not $header"
        ;;
      Epetra* | Teuchos* | ml_* | ML_* | Amesos* | p4est* | petsc*)
        [[ $room == solid ]] ||
          complain "$place: only solid may use $header"
        ;;
    esac
  done < <(includes "${files[@]}")

  # A mesh does not help to calibrate: the fit stands on the one-point driver.
  if [ "$room" = calibration ]; then
    while read -r place header; do
      [[ $header == slipstep/solid/* ]] &&
        complain "$place: calibration must not include $header"
    done < <(includes "${files[@]}")
  fi

  # Who plants an effect must not lean on the law that is to find it.
  if [ "$room" = synthetic_tests ]; then
    while read -r place header; do
      case $header in
        slipstep/synthetic_tests/* | slipstep/utilities/*) ;;
        slipstep/measured_data/measured_test.h) ;;
        slipstep/*) complain "$place: synthetic_tests must not include $header" ;;
      esac
    done < <(includes "${files[@]}")
  fi
done

while read -r lines file; do
  [ "$lines" -gt "$most_lines" ] &&
    complain "$file has $lines lines, more than $most_lines"
done < <(find include source tests -type f \( -name '*.h' -o -name '*.cc' \) \
           -exec wc -l {} \; 2>/dev/null)

[ "$violations" -eq 0 ] && echo "The layers hold."
exit $((violations > 0))
