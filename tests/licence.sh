#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Every source says its licence in the first two lines, and CHANGELOG.md is that
# of doc/news.
#   tests/licence.sh [<root>]    prints what is missing; exit code 1 if any
set -u
cd "${1:-$(dirname "$0")/..}" || exit 1

missing=$(find run .ci/run include source tests doc cmake -type f \
               \( -name '*.h' -o -name '*.cc' -o -name '*.sh' -o -name '*.pl' \
                  -o -name '*.py' -o -name '*.awk' -o -name '*.cmake' \
                  -o -name '*.js' -o -name '*.css' \
                  -o -name run \) -exec \
  awk 'FNR == 1 {if (name && !said) print name; name = FILENAME; said = 0}
       FNR <= 2 && /SPDX-License-Identifier: LGPL-2.1-or-later/ {said = 1}
       FNR == 2 {nextfile}
       END {if (name && !said) print name}' {} + | sort)
if [ -n "$missing" ]; then
  printf 'No line "SPDX-License-Identifier: LGPL-2.1-or-later":\n%s\n' "$missing"
  exit 1
fi
doc/changelog.sh | cmp -s - CHANGELOG.md && exit 0
echo 'CHANGELOG.md is not that of doc/news: doc/changelog.sh > CHANGELOG.md'
exit 1
