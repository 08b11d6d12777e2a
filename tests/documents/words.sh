#!/usr/bin/env bash
# words.sh ROOT: public headers and documents have none of these words, for which English has plainer ones: "repair" for
# mend, "compute" for reckon, "also" for besides, a new sentence for "of which", "replaces" for "takes the place of".
set -euo pipefail
cd "$1"
words='mend(s|ed|ing)?|reckon(s|ed|ing)?|besides|let be|of which|so many|(take|takes|took|taken|taking) the place of'
words+='|what [^.,;:|]{1,40} is of'

mapfile -t pages < <(find README.md CONTRIBUTING.md CHANGELOG.md include docs tools/lab/docs -type f \
    \( -name '*.md' -o -name '*.h' \) | sort)
bad=0
for page in "${pages[@]}"; do
    # Each line with the first four words of the next, into which a sentence may run on.
    found=$(awk 'NR > 1 { print NR - 1 ": " previous " " $1 " " $2 " " $3 " " $4 } { previous = $0 }
                 END { print NR ": " previous }' "$page" | sed -E 's| \* +| |; s| +| |g' |
        grep -iE "(^|[^a-z_])($words)([^a-z_]|\$)" || true)
    if [ -n "$found" ]; then
        # shellcheck disable=SC2001  # line by line
        sed "s|^|$page:|" <<<"$found"
        bad=1
    fi
done
echo "${#pages[@]} files"
[ ${#pages[@]} -gt 0 ] && exit $bad
