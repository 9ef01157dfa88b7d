#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Tests of ./run that build nothing: arguments, messages, and what would be
# installed on machines of several kinds, played by fake programs in PATH.
#   tests/run_script_test.sh <path of run>
set -u
run=$(realpath "$1") || exit 1
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
failures=0

# expect <description> <exit code> <pattern in the output> <command> ...
# A pattern that begins with ! must not appear.
expect()
{
  local description=$1 code=$2 pattern=$3 output status found=0
  shift 3
  output=$("$@" 2>&1)
  status=$?
  grep -qE -- "${pattern#!}" <<<"$output" || found=1
  [[ $pattern == !* ]] && found=$((1 - found))
  if [ $status -ne "$code" ] || [ $found -ne 0 ]; then
    printf 'FAILED: %s\n  wanted exit code %s and output with: %s\n' \
           "$description" "$code" "$pattern"
    printf '  got exit code %s and:\n%s\n' "$status" "$output" | sed 's/^/  /'
    failures=$((failures + 1))
  fi
}

# fake <name> <<< body: a program in the fake PATH.
fake()
{
  { echo '#!/bin/bash'; cat; } >"$work/bin/$1"
  chmod +x "$work/bin/$1"
}

# Everything ./run needs besides the programs that are faked.
mkdir "$work/bin"
for tool in bash env cat sed grep awk nproc dirname mkdir rm tail printf; do
  ln -s "$(command -v $tool)" "$work/bin/$tool"
done
echo 'set Any = 1' >"$work/case.prm"
echo '' >"$work/two words.prm"

# A dry run in that PATH, as user $1.
dry()
{
  fake id <<<"echo $1"
  (cd "$work" &&
    PATH=$work/bin SLIPSTEP_DRY_RUN=1 SLIPSTEP_BUILD_DIR=$work/build \
      SLIPSTEP_JOBS=2 "$run" "${@:2}")
}

expect 'the script parses' 0 '' bash -n "$run"
expect 'help' 0 '^Usage: ./run <case.prm>' "$run" --help
expect 'no arguments: usage' 2 '^Usage' "$run"
expect 'unknown command' 2 "'fly' is neither a case" "$run" fly
expect 'a file that is no case' 2 'neither a case' "$run" notes.txt
expect 'a case that is not there' 2 "no file 'absent.prm'" "$run" absent.prm
expect 'the same behind a command' 2 "no file 'absent.prm'" \
       "$run" point absent.prm

# Debian with nothing installed.
fake dpkg-query <<<'exit 1'
fake apt-get <<<'echo apt-get was called; exit 1'
expect 'root installs deal.II' 0 \
       '^env DEBIAN_FRONTEND=noninteractive apt-get -y install --no-install-recommends .*libdeal.ii-dev' \
       dry 0 case.prm
expect 'each package has its reason' 0 \
       'gnuplot-nox +draws the pictures' dry 0 case.prm
expect 'a dry run calls nothing' 0 '!was called' dry 0 case.prm
expect 'neither root nor sudo' 1 'not root and there is no sudo' \
       dry 1000 case.prm
expect 'what to install by hand' 1 \
       '^  apt-get install --no-install-recommends g\+\+ cmake' \
       dry 1000 case.prm
fake sudo <<<'echo sudo was called; exit 1'
expect 'others use sudo' 0 '^sudo env .* apt-get -y install' dry 1000 case.prm
expect 'root does not' 0 '!^sudo' dry 0 case.prm
expect 'installing can be forbidden' 0 '!apt-get' \
       env SLIPSTEP_NO_INSTALL=1 bash -c "$(declare -f dry fake)
         work=$work run=$run; dry 0 case.prm"
expect 'a deal.II of the user is respected' 0 '!libdeal' \
       env DEAL_II_DIR=/opt/deal.II bash -c "$(declare -f dry fake)
         work=$work run=$run; dry 0 case.prm"

# Debian with everything but gnuplot, then with everything.
fake dpkg-query <<'END'
for name in "$@"; do
  case $name in
    -*) ;;
    gnuplot-nox) echo "not-installed $name" ;;
    *) echo "installed $name" ;;
  esac
done
END
expect 'only what is missing' 0 \
       'install --no-install-recommends gnuplot-nox$' dry 0 case.prm
fake dpkg-query <<'END'
for name in "$@"; do [[ $name == -* ]] || echo "installed $name"; done
END
expect 'nothing missing, nothing installed' 0 '!apt-get' dry 0 case.prm
expect 'Release is configured' 0 'cmake -S .* -DCMAKE_BUILD_TYPE=Release' \
       dry 0 case.prm
expect 'a case is run' 0 '/build/slipstep run case.prm --quiet$' \
       dry 0 case.prm --quiet
expect 'a case with a space in its name' 0 'slipstep run two\\ words.prm$' \
       dry 0 'two words.prm'
expect 'other commands pass' 0 '/build/slipstep point case.prm$' \
       dry 0 point case.prm
# Those that the program itself lists.
for command in $(grep -oE '^        \{"[a-z]+",$' \
                      "$(dirname "$run")/source/utilities/command_line.cc" |
                   grep -oE '[a-z]+'); do
  expect "./run knows the command $command" 0 "/build/slipstep $command" \
         dry 0 "$command"
done
expect 'values of --set are no cases' 0 'slipstep run case.prm' \
       dry 0 case.prm --set Include=other.prm
expect 'only the program is built for a case' 0 '--target slipstep -j 2' \
       dry 0 case.prm
expect 'everything is built for the tests' 0 '--target all -j 2' dry 0 tests
expect 'options reach ctest' 0 'ctest .*-L friction$' dry 0 tests -L friction

# A build folder that is ready is not configured again; a moved one is.
mkdir "$work/build"
touch "$work/build/build.ninja"
root=$(cd "$(dirname "$run")" && pwd)
echo "CMAKE_HOME_DIRECTORY:INTERNAL=$root" >"$work/build/CMakeCache.txt"
expect 'ready: no configuring' 0 '!cmake -S' dry 0 case.prm
echo "CMAKE_HOME_DIRECTORY:INTERNAL=/elsewhere" >"$work/build/CMakeCache.txt"
expect 'moved: configured anew' 0 'cmake -S' dry 0 case.prm
rm -r "$work/build"

# Exit codes and failures, with a fake build.
played()
{
  (cd "$work" && PATH=$work/bin:$PATH SLIPSTEP_BUILD_DIR=$work/build "$run" "$@")
}
fake cmake <<END
case \$1 in
  -S) touch $work/build/CMakeCache.txt $work/build/build.ninja ;;
  *)  printf '#!/bin/bash\necho "\$@" in \$PWD; exit 7\n' >$work/build/slipstep
      chmod +x $work/build/slipstep ;;
esac
END
expect "slipstep's exit code is passed on" 7 '^run case.prm in' played case.prm
expect 'it starts in the folder of the caller' 7 "in $work\$" played case.prm
fake ctest <<<'exit 8'
expect "ctest's exit code is passed on" 8 '' played tests
rm -r "$work/build"
fake cmake <<<'echo "CMake Error: deal.II is missing"; exit 1'
expect 'a failed configuration is shown' 1 'deal.II is missing' played case.prm
expect 'and the log is named' 1 'build/build.log' played case.prm
fake cmake <<END
[ "\$1" = -S ] && { touch $work/build/{CMakeCache.txt,build.ninja}; exit 0; }
echo 'block.cc:1: error: broken'; exit 1
END
expect 'a failed build is shown' 1 'block.cc:1: error' played case.prm

# Elsewhere than on Debian.
rm "$work/bin/"{dpkg-query,apt-get}
rm -r "$work/build"
fake cmake <<<'exit 0'
fake c++ <<<'exit 0'
expect 'another system without ninja' 1 'ninja is missing, and this is no Debian' \
       dry 0 case.prm
fake ninja <<<'exit 0'
expect 'another system with the tools' 0 'slipstep run case.prm' dry 0 case.prm

[ $failures -eq 0 ] && echo 'All expectations met.'
exit $((failures > 0))
