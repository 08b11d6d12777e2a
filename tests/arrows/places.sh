#!/usr/bin/env bash
# places.sh ROOT: one name everywhere. Each stage of stages.def has its kernel, reference, test and
# page under its own name, and no such file is left over for a stage that is gone. The table of stages in
# docs/stages/README.md is what stages.def generates, row by row.
set -euo pipefail
cd "$1"
bad=0
complain() {
    echo "$1"
    bad=1
}

# What stages.def says of the stages, as the table's rows; LANES and the like in words.
rows=$(sed -nE 's/^PLAIT_STAGE\(([a-z_]+), ([A-Z_]+), [a-z_]+, "(.*)"\)$/| [\1](\1.md) | \2 | \3 |/p' \
    cl/shared/plait/stages.def |
    sed -E 's/\| (VERTEX|STRAND|VOXEL|WORD) \|/| \L\1\E |/; s/\| LANES \|/| strand, over lanes |/
            s/\| STRAND_GROUP \|/| strand, V work-items |/; s/\| VOXEL_GROUP \|/| voxel, one work-group |/')
stages=$(sed -nE 's/^PLAIT_STAGE\(([a-z_]+),.*/\1/p' cl/shared/plait/stages.def)
[ -n "$stages" ] || complain "cl/shared/plait/stages.def: no stage found"

for stage in $stages; do
    for place in "cl/$stage.cl" "lib/backend/reference/$stage.cpp" "docs/stages/$stage.md"; do
        [ -s "$place" ] || complain "$place: missing, though $stage is in stages.def"
    done
    if [ -d tests/cases ] && [ ! -s "tests/cases/$stage.cpp" ]; then
        complain "tests/cases/$stage.cpp: missing, though $stage is in stages.def"
    fi
    grep -qs "($stage.md)" docs/stages/README.md || complain "docs/stages/README.md: no link to $stage.md"
    grep -qsE "__kernel .*\bplait_$stage\b|\bplait_$stage\(" "cl/$stage.cl" ||
        complain "cl/$stage.cl: does not define the kernel plait_$stage"
done

for kernel in cl/*.cl; do
    grep -qx "$(basename "$kernel" .cl)" <<<"$stages" || complain "$kernel: not in stages.def"
done
for page in docs/stages/*.md; do
    name=$(basename "$page" .md)
    [ "$name" = README ] || grep -qx "$name" <<<"$stages" || complain "$page: not in stages.def"
done

diff <(grep -E '^\| \[' docs/stages/README.md) - <<<"$rows" ||
    complain "docs/stages/README.md: its table is not that of stages.def; the rows marked > belong there"

echo "$(wc -w <<<"$stages") stages"
exit $bad
