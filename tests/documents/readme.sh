#!/usr/bin/env bash
# readme.sh ROOT: the first C block of README.md is examples/01_hello.c, which CTest compiles and runs,
# and no longer than docs/hello.md says. The other examples are near 100 lines, and README.md leads to each.
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
