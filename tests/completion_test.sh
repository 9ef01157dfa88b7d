#!/bin/bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# What bash completes, by the script that is installed.
#   tests/completion_test.sh <slipstep> <doc/bash_completion.sh>
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$2" "$1" > "$folder/completions"
set +u
source "$folder/completions"
cd "$folder"
touch "my case.prm" table.csv

# complete WORD... = what is offered for the last word
complete_words() {
  COMP_WORDS=("$@")
  COMP_CWORD=$(($# - 1))
  COMPREPLY=()
  _slipstep
  printf '%s|' "${COMPREPLY[@]}"
}
failed=0
expect() {
  local wanted=$1
  shift
  local got
  got=$(complete_words "$@")
  if [[ $got != "$wanted" ]]; then
    echo "$*: \"$got\" instead of \"$wanted\""
    failed=1
  fi
}
expect 'calibrate|' slipstep ca
expect '--resume|' slipstep run --re
expect '|' slipstep check --re
expect 'Friction/healing/Rate|Friction/healing/Steepness|' \
  slipstep point x.prm --set Friction/heal
expect 'Friction/healing/Rate|Friction/healing/Steepness|' \
  slipstep point x.prm --sweep '"Friction/heal'
expect 'Time stepping/Tolerance|' slipstep parameters 'Time stepping/T'
expect 'healing|' slipstep effects heal
expect 'healing|' slipstep plant --effect heal
expect 'calibrate|' slipstep help ca
expect 'my case.prm|' slipstep run m
expect '|' slipstep run t
expect 'table.csv|' slipstep compare t
expect 'table.csv|' slipstep import t
exit $failed
