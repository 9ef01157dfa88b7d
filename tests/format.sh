#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Names the places that clang-format (the version .clang-format is written for)
# would change. Repair with: clang-format -i <file>
#   tests/format.sh <clang-format> [<root>]
set -u -o pipefail
cd "${2:-$(dirname "$0")/..}" || exit 1
find include source tests -type f \( -name '*.h' -o -name '*.cc' \) -print0 |
  sort -z | xargs -0 "$1" --dry-run --Werror
