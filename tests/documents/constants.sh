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
for name in $(cut -d' ' -f1 <<<"$defined"); do
    grep -rqw "$name" cl --include='*.cl' --include='*.clh' || { echo "$name: no kernel reads it"; bad=1; }
    grep -rqw "$name" lib/backend/reference || { echo "$name: the reference does not read it"; bad=1; }
done
echo "$(wc -l <<<"$defined") constants"
exit $bad
