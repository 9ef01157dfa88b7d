#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Names the files that clang-format (the version .clang-format is written for)
# would change. Repair with: clang-format -i <file>
#   tests/format.sh <clang-format> [<root>]
set -u
formatter=$1
cd "${2:-$(dirname "$0")/..}" || exit 1

unformatted=$(find include source tests -type f \( -name '*.h' -o -name '*.cc' \) |
  sort | while read -r file; do
    "$formatter" "$file" | cmp -s - "$file" || echo "$file"
  done)
[ -z "$unformatted" ] && exit 0
printf 'Not formatted:\n%s\nRepair with: %s -i <file>\n' \
       "$unformatted" "$formatter"
exit 1
