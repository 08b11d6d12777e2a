#!/usr/bin/env bash
# readme.sh ROOT: the first C block of README.md is examples/01_hello.c, which CTest compiles and runs,
# and no longer than docs/hello.md says. The other examples are near 100 lines, and README.md leads to each and
# says how many they are. README.md and docs/concepts.md name every kind of collider, README.md every page of docs
# and every public header.
set -euo pipefail
cd "$1"
# shellcheck disable=SC2016  # the backticks are Markdown's
block=$(awk '/^```$/ && inside { exit } inside { print } /^```c$/ { inside = 1 }' README.md)
diff <(echo "$block") examples/01_hello.c || { echo "README.md and examples/01_hello.c differ"; exit 1; }
lines=$(wc -l <examples/01_hello.c)
[ "$lines" -le 40 ] || { echo "examples/01_hello.c has $lines lines; docs/hello.md says 40"; exit 1; }
for example in examples/*.c; do
    lines=$(wc -l <"$example")
    [ "$lines" -le 125 ] || { echo "$example has $lines lines; README.md says about a hundred"; exit 1; }
    grep -qF "]($example)" README.md || { echo "README.md does not lead to $example"; exit 1; }
done

numbers=(none one two three four five six seven eight nine ten)
others=${numbers[$(find examples -name '0[2-9]_*.c' | sed 's/_.*//' | sort -u | wc -l)]}
grep -qi "^.*$others more examples" README.md || { echo "README.md does not say $others more examples"; exit 1; }
grep -q "the other $others\](#in-c)" README.md || { echo "README.md does not say the other $others"; exit 1; }
for kind in $(sed -n 's/^ *PLAIT_COLLIDER_KIND_\([A-Z]*\) = [0-9].*/\L\1/p' include/plait/*.h); do
    for page in README.md docs/concepts.md; do
        grep -qE "${kind}(e?s)\b" "$page" || { echo "$page does not name colliders of kind $kind"; exit 1; }
    done
done
for page in docs/*.md; do
    grep -qF "($page" README.md || { echo "README.md does not lead to $page"; exit 1; }
done
for header in include/plait/*; do
    grep -qF "($header)" README.md || { echo "README.md does not say what $header is"; exit 1; }
done
