#!/usr/bin/env bash
# constants.sh ROOT: docs/constants.md lists exactly the constants of constants.h, in order and with their
# values, and each of them is read by a kernel and by the float64 reference.
set -euo pipefail
cd "$1"
header=cl/shared/plait/constants.h
bad=0
# shellcheck disable=SC2016  # the backticks are Markdown's
listed=$(sed -nE 's/^\| `(PLAIT_[A-Z0-9_]+)` \| ([^ ]+) \|.*/\1 \2/p' docs/constants.md)
defined=$(sed -nE 's/^#define (PLAIT_[A-Z0-9_]+) (.+)$/\1 \2/p' "$header" |
    sed -E 's/PLAIT_NUMBER\(([^)]*)\)/\1/; s/ \((.*)\)$/ \1/')
[ -n "$defined" ] || { echo "$header: no constant found"; exit 1; }
diff <(echo "$listed") <(echo "$defined") || { echo "docs/constants.md is not $header; the lines marked > belong there"; bad=1; }

# Names in the files of a folder, each once.
names_in() { grep -rohE --include='*.cl' --include='*.clh' --include='*.[ch]pp' 'PLAIT_[A-Z0-9_]+' "$1" | sort -u; }
names=$(cut -d' ' -f1 <<<"$defined" | sort)
for folder in cl lib/backend/reference; do
    unread=$(comm -23 <(echo "$names") <(names_in "$folder"))
    [ -z "$unread" ] || { echo "nothing in $folder reads: ${unread//$'\n'/, }"; bad=1; }
done
echo "$(wc -l <<<"$defined") constants"
exit $bad
