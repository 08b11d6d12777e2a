#!/usr/bin/env bash
# exported.sh NM LIBRARY DECLARED: the dynamic symbols of LIBRARY are exactly the lines of DECLARED.
set -euo pipefail
exported=$("$1" --dynamic --defined-only --format=posix "$2" | awk '$2 != "A" { print $1 }' | sort)
missing=$(comm -13 <(echo "$exported") <(sort "$3"))
extra=$(comm -23 <(echo "$exported") <(sort "$3"))
if [ -n "$missing" ]; then echo "declared PLAIT_API, not exported:" "$missing"; fi
if [ -n "$extra" ]; then echo "exported, not declared PLAIT_API:" "$extra"; fi
wc -l <<<"$exported" | xargs echo "exported:"
[ -z "$missing$extra" ] && [ -s "$3" ]
