#!/usr/bin/env bash
# presets.sh ROOT: docs/presets.md has a row for every preset, with its sentence and its groom, and for nothing else.
set -euo pipefail
cd "$1"
status=0
count=0
for file in assets/presets/*.json; do
    name=$(basename "$file" .json)
    text=$(sed -n 's/^  "text": "\(.*\)",$/\1/p' "$file")
    groom=$(sed -n 's/^  "groom": "\(.*\)",$/\1/p' "$file")
    count=$((count + 1))
    if ! grep -qxF "| \`$name\` | $text | \`$groom\` |" docs/presets.md; then
        echo "docs/presets.md has no row | \`$name\` | $text | \`$groom\` |"
        status=1
    fi
done
rows=$(sed '/^## /q' docs/presets.md | grep -c '^| `')
if [ "$rows" -ne "$count" ]; then
    echo "docs/presets.md has $rows rows, there are $count presets"
    status=1
fi
echo "$count presets"
exit $status
