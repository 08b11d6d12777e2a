#!/usr/bin/env bash
# readme.sh ROOT: the first C block of README.md is examples/01_hello.c, which CTest compiles and runs.
set -euo pipefail
cd "$1"
# shellcheck disable=SC2016  # the backticks are Markdown's
block=$(awk '/^```$/ && inside { exit } inside { print } /^```c$/ { inside = 1 }' README.md)
diff <(echo "$block") examples/01_hello.c || { echo "README.md and examples/01_hello.c differ"; exit 1; }
