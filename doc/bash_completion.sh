#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Writes the completions of bash from what the program says about itself.
#   doc/bash_completion.sh <slipstep> > slipstep
set -eu
program=$1
commands=$("$program" --help | sed -n '/^commands:/,/^$/s/^  \([a-z]*\) .*/\1/p')

echo "# Completions of bash for slipstep; written by doc/bash_completion.sh"
echo "_slipstep_commands='$(echo $commands)'"
echo "_slipstep_keys='$("$program" parameters --format keys)'"
echo "_slipstep_effects='$("$program" effects | sed -n 's/^\([a-z_]*\): .*/\1/p' | tr '\n' ' ')'"
echo "_slipstep_options() {"
echo "  case \$1 in"
for command in $commands; do
  options=$("$program" "$command" --help |
    sed -n '/^options:/,/^$/s/^  \(--[a-z-]*\).*/\1/p')
  echo "    $command) echo '$(echo $options)' ;;"
done
cat <<'END'
  esac
}

_slipstep() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}
  local command= i
  for ((i = 1; i < COMP_CWORD; ++i)); do
    [[ ${COMP_WORDS[i]} == [a-z]* ]] && { command=${COMP_WORDS[i]}; break; }
  done
  local IFS=$'\n'
  if [[ -z $command ]]; then
    COMPREPLY=($(compgen -W "${_slipstep_commands// /$IFS}" -- "$word"))
  elif [[ $before == --set || $before == --sweep ||
          ( $command == parameters && $word != -* ) ]]; then
    compopt -o filenames 2> /dev/null # which quotes spaces
    COMPREPLY=($(compgen -W "$_slipstep_keys" -- "${word#[\"\']}"))
  elif [[ $word == -* ]]; then
    COMPREPLY=($(compgen -W "$(_slipstep_options "$command" | tr ' ' '\n')" -- "$word"))
  elif [[ $command == effects || $before == --effect ]]; then
    COMPREPLY=($(compgen -W "${_slipstep_effects// /$IFS}" -- "$word"))
  elif [[ $command == help ]]; then
    COMPREPLY=($(compgen -W "${_slipstep_commands// /$IFS}" -- "$word"))
  else
    compopt -o filenames 2> /dev/null
    case $command in
      run | point | refine | calibrate | diagnose | check | export)
        COMPREPLY=($(compgen -f -X '!*.prm' -- "$word") $(compgen -d -- "$word")) ;;
      *) COMPREPLY=($(compgen -f -- "$word")) ;;
    esac
  fi
}
complete -F _slipstep slipstep
END
