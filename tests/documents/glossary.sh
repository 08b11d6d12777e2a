#!/usr/bin/env bash
# glossary.sh ROOT: the terms of docs/glossary.md are in alphabetical order, each once, and every one is used
# by another document, a public header or a kernel.
set -euo pipefail
cd "$1"
bad=0
terms=$(sed -nE 's/^\| \*\*([^*]+)\*\* \|.*/\1/p' docs/glossary.md)
[ -n "$terms" ] || { echo "docs/glossary.md: no term found"; exit 1; }
# shellcheck disable=SC2001  # line by line
sorted=$(sed 's/^Γ/gamma/' <<<"$terms" | LC_ALL=C sort -fu | sed 's/^gamma/Γ/')
diff <(echo "$terms") <(echo "$sorted") || { echo "docs/glossary.md: the order of the lines marked > is right"; bad=1; }
text=$(mktemp)
trap 'rm -f "$text"' EXIT
find README.md CONTRIBUTING.md docs tools/lab/docs include cl -type f \( -name '*.md' -o -name '*.h' -o -name '*.clh' -o -name '*.cl' \) \
    -not -name glossary.md -not -path 'docs/results/*' -exec cat {} + | tr '\n_-' '   ' >"$text"
while read -r term; do
    grep -qiF -- "${term//[-_]/ }" "$text" || { echo "docs/glossary.md: nothing says '$term'"; bad=1; }
done <<<"$terms"
echo "$(wc -l <<<"$terms") terms"
exit $bad
