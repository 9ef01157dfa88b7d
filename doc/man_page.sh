#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Writes the man page from what the program says about itself.
#   doc/man_page.sh <slipstep> > slipstep.1
set -eu
program=$1

# Text as it is: backslashes, and dots and apostrophes that begin a line.
verbatim() { sed -e 's/\\/\\e/g' -e "s/^\([.']\)/\\\\\&\1/" -e 's/-/\\-/g'; }

"$program" --version | sed 's/^slipstep \([^ ]*\).*/.TH SLIPSTEP 1 "" "slipstep \1"/'
cat <<'END'
.SH NAME
slipstep \- rate\-dependent friction of a sliding elastic block
.SH SYNOPSIS
.B slipstep
.I COMMAND
.RI [ CASE.prm ]
.RI [ options ]
.SH DESCRIPTION
.nf
END
"$program" --help | sed '1,4d' | verbatim
echo .fi
"$program" --help | sed -n '/^commands:/,/^$/s/^  \([a-z]*\) .*/\1/p' |
  grep -v '^help$' | while read -r command; do
    printf '.SH SLIPSTEP %s\n.nf\n' "$(echo "$command" | tr a-z A-Z)"
    "$program" "$command" --help | verbatim
    echo .fi
  done
