#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Writes CHANGELOG.md from the files of doc/news, newest first.
#   doc/changelog.sh > CHANGELOG.md
set -eu
cd "$(dirname "$0")/news"

echo '# What is new'
echo
echo 'Written by doc/changelog.sh from the files of doc/news.'
day=
for file in $(ls -r [0-9]*.md); do
  if [ "${file%%-*}" != "$day" ]; then
    day=${file%%-*}
    printf '\n## %s\n\n' "$(echo "$day" | sed 's/\(....\)\(..\)/\1-\2-/')"
  fi
  # One item, or a list of them.
  sed -E -e '1s/^(- )?/- /' -e '2,$s/^([^- ]|-[^ ])/  \1/' "$file"
done
