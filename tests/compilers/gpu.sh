#!/usr/bin/env bash
# gpu.sh TEXTS TOOLS RESULTS KERNEL_BYTES TABLES: compiles every program of one lane that kernel_texts wrote into TEXTS by the
# compilers of GPUs and writes RESULTS/gpu-compilers.md and TABLES/gpu-compilers.csv. `./dev gpu` runs it, and puts into TOOLS what is
# not installed: intel/ (Debian's ocloc, unpacked) and nvidia/ (PyPI's ptxas). A compiler that is absent
# leaves its part of the page out, with a line that says so. KERNEL_BYTES is the program that bytes.sh runs.
set -euo pipefail
texts=$1 tools=$2 results=${3-} kernel_bytes=${4-} tables=${5:-${3-}}
clang=$(command -v clang-19 || command -v clang)
clc=${PLAIT_LIBCLC:-/usr/lib/clc}
ptxas=$(command -v ptxas || { ls "$tools/nvidia/nvidia/cuda_nvcc/bin/ptxas" /usr/local/cuda/bin/ptxas 2>/dev/null || true; } | head -1)
ocloc=$tools/intel/usr/bin/ocloc
here=${PLAIT_GPU_SCRATCH:-}

# Of the one-lane programs, for the usual number of vertices: the options of a stage.
options_of() { awk -v stage="$1" '$1 == stage && $2 == 1 && $3 == 16 { for (i = 5; i <= NF; i++) print $i }' "$texts/list.txt"; }

kernel_of() { awk -v stage="$1" '$1 == stage { print $4; exit }' "$texts/list.txt"; }

# AMD: LLVM's own remarks. What the code calls by name must stand in it.
measure_amd() {
    local code=$here/$1.$2.s log=$here/$1.$2.log
    "$clang" -x cl -target amdgcn-mesa-mesa3d "-mcpu=$2" -nogpulib -O3 -w -Rpass-analysis=kernel-resource-usage \
        -Xclang -mlink-builtin-bitcode -Xclang "$clc/$2-amdgcn-mesa-mesa3d.bc" "${options[@]}" -S "$texts/$1.cl" -o "$code" 2>"$log" || return 1
    if comm -23 <(grep -oE '[A-Za-z_0-9.$]+@(rel32|gotpcrel32)@lo' "$code" | cut -d@ -f1 | sort -u) \
        <(grep -oE '^[A-Za-z_0-9.$]+:' "$code" | tr -d : | sort -u) | grep .; then return 1; fi
    awk -v name="$(kernel_of "$1")" '
        { sub(/ \[-Rpass.*/, "") }
        /Function Name:/ { ours = ($NF == name) }
        ours && / VGPRs:/ { registers = $NF } ours && /VGPRs Spill:/ { spilled += $NF * 4 } ours && /ScratchSize/ { private = $NF }
        ours && /Occupancy/ { waves = $NF } ours && /LDS Size/ { local = $NF }
        END { print registers, spilled, private, local, waves }' "$log"
}

# NVIDIA: registers are given to warps by 256 and a multiprocessor has 65,536; what is undefined ptxas refuses.
measure_nvidia() {
    local code=$here/$1.$2.ptx log=$here/$1.$2.log most
    case $2 in sm_75) most=32 ;; sm_86) most=48 ;; *) most=64 ;; esac
    "$clang" -x cl -target nvptx64-nvidia-nvcl -Xclang -target-cpu -Xclang "$2" -nogpulib -O3 -w \
        -Xclang -mlink-builtin-bitcode -Xclang "$clc/nvptx64--nvidiacl.bc" "${options[@]}" -S "$texts/$1.cl" -o "$code" 2>"$log" &&
        "$ptxas" -v "-arch=$2" "$code" -o /dev/null 2>>"$log" || return 1
    awk -v most="$most" '
        /bytes stack frame/ { if ($1 > private) private = $1; spilled += $5 }
        match($0, /[0-9]+ bytes cumulative stack size/) { private = substr($0, RSTART) + 0 }
        match($0, /Used [0-9]+ registers/) { registers = substr($0, RSTART + 5) + 0 }
        match($0, /[0-9]+ bytes smem/) { local = substr($0, RSTART) + 0 }
        END { warps = int(65536 / (int((registers * 32 + 255) / 256) * 256))
              print registers, spilled + 0, private + 0, local + 0, warps < most ? warps : most }' "$log"
}

# Intel: the note that ocloc leaves in the binary. Sizes are a work-item's where is_simt_thread says so.
measure_intel() {
    local folder=$here/$1.$2
    LD_LIBRARY_PATH=$tools/intel/usr/lib/x86_64-linux-gnu "$ocloc" compile -file "$texts/$1.cl" -device "$2" --format zebin \
        -options "${options[*]}" -out_dir "$folder" >"$folder.log" 2>&1 || return 1
    grep -aE '^ *(- type|usage|size|is_simt_thread|grf_count|slm_size|simd_size|per_thread_memory_buffers|payload_arguments)' "$folder"/*.bin | awk '
        { sub(/.*bin:/, "") }
        /grf_count/ { registers = $2 } /simd_size/ { simd = $2 } /slm_size/ { local = $2 }
        /per_thread_memory_buffers/ { inside = 1 }
        inside && /usage:/ { usage = $2 }
        inside && /size:/ { if (usage == "spill_fill_space") spilled = $2; else { private = $2; shared = 1 } }
        inside && /is_simt_thread/ && usage != "spill_fill_space" { shared = 0 }
        END { if (shared) private /= simd
              print registers, int(spilled / simd), int(private), local + 0, simd }'
}

# gpu.sh --one TARGET STAGE: a line of the CSV file; run many at a time.
one() {
    local vendor=${1%%:*} target=${1#*:} found
    mapfile -t options < <(options_of "$2")
    if found=$("measure_$vendor" "$2" "$target"); then
        echo "$2,$vendor,$target,yes,${found// /,}" >"$here/$2.$target.row"
    else
        echo "$2,$vendor,$target,no,,,,," >"$here/$2.$target.row"
    fi
}

# cells VENDOR TARGET...: the vendor's table, a row for each stage.
table() {
    local vendor=$1 stage target cells
    shift
    printf '| stage |%s\n' "$(printf ' %s |' "$@")"
    printf '|---|%s\n' "$(printf -- '---:|%.0s' "$@")"
    while read -r stage; do
        cells=
        for target in "$@"; do
            cells+=$(awk -F, '{ if ($4 == "no") print " **does not build** |"
                                else { if ($7 > 0 || $6 > 0) $7 = "**" $7 "**"; print " " $5 " · " $6 " · " $7 " · " $8 " · " $9 " |" } }' "$here/$stage.$target.row")
        done
        echo "| \`$stage\` |$cells"
    done < <(stages)
}

stages() { cut -d' ' -f1 "$texts/list.txt" | uniq; }

page() {
    local vendor
    cat <<END
# What compilers of GPUs make of the kernels

Written by \`./dev gpu\`: every program as the library hands it to a driver of a GPU (one strand per work-item, ${usual} vertices a strand),
compiled for GPUs that are not here. It shows that the kernels build and link and what they need; it is no measurement of speed, and
a vendor's driver may have a newer compiler.

Each cell: registers of a work-item · bytes spilled · bytes of private memory a work-item · bytes of local memory a work-group · what fits.
Private memory and spills lie in the GPU's memory, behind its caches, and are bold. Local memory that a kernel is handed as an
argument (a \`LOCAL\` buffer of stages.def, an element for each work-item) is not in these numbers. In the solves over strands private memory grows in
proportion to the vertices of a strand. A stage whose name ends in \`-8\` is built for a grid of 8 voxels each way, whose sums a work-group
keeps in local memory; without, for grids that do not fit.
END
    if [ ${#amd[@]} -gt 0 ]; then
        printf '\n## AMD\n\nBy %s and libclc. Registers are vector registers; what fits: wavefronts a SIMD, of 10 (gfx906) or 16.\n\n' "$("$clang" --version | head -1)"
        table amd "${amd[@]}"
    else
        printf '\n## AMD\n\nLeft out: clang 19 or its built-in functions in %s are not here.\n' "$clc"
    fi
    if [ ${#nvidia[@]} -gt 0 ]; then
        printf '\n## NVIDIA\n\nBy the same clang, and ptxas %s. What fits: warps a multiprocessor by registers, of 32 (sm_75), 48 (sm_86) or 64 (sm_90).\n\n' \
            "$("$ptxas" --version | grep -oE 'V[0-9.]+')"
        table nvidia "${nvidia[@]}"
    else
        printf '\n## NVIDIA\n\nLeft out: there is no ptxas here, nor pip to fetch it.\n'
    fi
    if [ ${#intel[@]} -gt 0 ]; then
        printf "\n## Intel\n\nBy Debian's ocloc. Registers are 32 bytes, of a thread; what fits: how many work-items share a thread. On tgllp spills\nare among the private memory.\n\n"
        table intel "${intel[@]}"
    else
        printf '\n## Intel\n\nLeft out: ocloc is not here.\n'
    fi
    bytes
}

# What kernels read and write: a row for each of the lines of bytes.csv that begin with SCENE,PROGRAM.
bytes_row() {
    awk -F, -v key="$1,$2," -v label="$3" '
        function number(x) { return x < 99.5 ? sprintf("%.3g", x) : sprintf("%.0f", x) }
        function ms(rate) { return touched < 9.95 * rate ? sprintf("%.2g", touched / rate) : sprintf("%.0f", touched / rate) } # B * 1e6 / (GB/s) is ms
        index($0, key) == 1 {
            touched = $3 + $4 + $5 + $6 + 8 * $9
            printf "| %s | %s | %s | %s | %s |", label, number($3), number($4), number($5), number($6)
            if (grid) printf " %s | %s | %s | %s | %s |\n", number($9), number(touched), number($7), number($8), number($10)
            else printf " %s | %s | %s | %s |\n", number(touched), ms(3350), ms(504), ms(960)
        }' grid="${4-}" "$here/bytes.csv"
}

bytes() {
    printf '\n## What a step reads and writes\n\n'
    if [ ! -s "$here/bytes.csv" ]; then
        printf 'Left out: clang 19, or its built-in functions in %s, or the program kernel_bytes (of a build with PLAIT_TOOLS) are not here.\n' "$clc"
        return
    fi
    cat <<END
Counted, not estimated: \`tests/compilers/bytes.sh\` compiles each kernel for NVIDIA (sm_90) up to LLVM's optimised code (-O3, every function
inlined, as drivers do), puts a counter before every load, store and atomic addition of it, and runs it on this machine on every fifth
of 60 frames of long hair (256 strands of ${usual} vertices) on the mannequin, whose head turns by 29° to and fro at 1 Hz; defaults
otherwise. Bytes per strand and step; private memory is what lies in arrays, as in the tables above, and not what a
compiler keeps in registers. *touched* is all of it but local memory, 8 bytes for an atomic addition.

The last three columns are **predictions from bytes, not measured**: touched, for a million strands, over the published bandwidth of
the device's memory, as if no cache held anything and nothing else took time. Caches make it less, latency and instructions more.

| solve | private read | private written | global read | global written | touched | H100 SXM, 3,350 GB/s, ms | RTX 4070, 504 GB/s, ms | RX 7900 XTX, 960 GB/s, ms |
|---|---:|---:|---:|---:|---:|---:|---:|---:|
END
    bytes_row alone articulated '`articulated`'
    bytes_row capsules articulated '`articulated`, 14 capsules'
    awk -F, -v most_private=2048 -v most_touched=14336 -v stack="$(awk -F, '{ if ($7 > most) most = $7 } END { print most + 0 }' "$here"/articulated.gfx*.row "$here"/articulated.sm_*.row 2>/dev/null)" '
        index($0, "alone,articulated,") == 1 { alone = $3 + $4 + $5 + $6 }
        index($0, "capsules,articulated,") == 1 { capsules = $3 + $4 + $5 + $6 }
        function against(value, most) { return sprintf("%.0f, %.1f times that", value, value / most) }
        END {
            printf "\nWhat is aimed at for the default model, `articulated`: 2,048 B of private memory a strand; it has %s. 14,336 B touched a step: %s, and with 14 capsules %s.\n", against(stack, most_private), against(alone, most_touched), against(capsules, most_touched)
        }' "$here/bytes.csv"
    cat <<END

The grid's stages, 8 voxels each way, by either tent, and those of \`volume\` in a sim with it. Of \`-8\` the sums lie in local memory, of groups of 128
strands; what clears and hands them on is in it. Here a group is half of the head's hair: of more hair a group meets fewer voxels, and the grid
gets fewer additions.

| stage | private read | private written | global read | global written | global atomics | touched | local read | local written | local atomics |
|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|
END
    local stage scene
    for scene in voxel trilinear; do
        for stage in grid_splat grid_splat-8 grid_diffuse; do
            bytes_row "$scene" "$stage" "\`$stage\`, $scene" 1
        done
    done
    for stage in volume_splat volume_splat-8 volume_gather; do
        bytes_row volume "$stage" "\`$stage\`" 1
    done
}

if [ "$results" = --one ]; then
    one "$4" "$5"
    exit
fi

here=$(mktemp -d)
export PLAIT_GPU_SCRATCH=$here
trap 'rm -rf "$here"' EXIT
usual=16
amd=() nvidia=() intel=()
if [ -r "$clc/gfx1100-amdgcn-mesa-mesa3d.bc" ]; then amd=(gfx906 gfx1030 gfx1100); fi
if [ -r "$clc/nvptx64--nvidiacl.bc" ] && [ -n "$ptxas" ]; then nvidia=(sm_75 sm_86 sm_90); fi
if [ -x "$ocloc" ]; then intel=(tgllp dg2); fi
for target in "${amd[@]/#/amd:}" "${nvidia[@]/#/nvidia:}" "${intel[@]/#/intel:}"; do
    if [ -n "$target" ]; then stages | sed "s/^/$target /"; fi
done | xargs -P "$(nproc)" -L 1 "$0" "$texts" "$tools" --one
if [ -x "$kernel_bytes" ] && command -v clang-19 >/dev/null && [ -r "$clc/nvptx64--nvidiacl.bc" ]; then
    "$(dirname "$0")/bytes.sh" "$texts" "$kernel_bytes" >"$here/bytes.csv"
fi
page >"$results/gpu-compilers.md"
{
    echo "stage,vendor,target,builds,registers,spilled_bytes,private_bytes,local_bytes,fits"
    cat "$here"/*.row
} >"$tables/gpu-compilers.csv"
! grep -q ',no,' "$tables/gpu-compilers.csv"
