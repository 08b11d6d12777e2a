#!/usr/bin/env bash
# links.sh ROOT: every relative link of the documents leads to a file.
set -euo pipefail
cd "$1"
bad=0 seen=0
while IFS=: read -r page link; do
    target=${link#](}
    target=${target%)}
    target=${target%%#*}
    seen=$((seen + 1))
    if [ -n "$target" ] && [ ! -e "$(dirname "$page")/$target" ]; then
        echo "$page: $target does not exist"
        bad=1
    fi
done < <(find . -name '*.md' -not -path './build/*' -not -path './out/*' \
    -exec grep -noE '\]\([^)]*\)' {} + | sed -E 's/:[0-9]+:/:/' | grep -v '](http')
echo "$seen links"
[ $bad -eq 0 ] && [ $seen -gt 0 ]
