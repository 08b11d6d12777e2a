#!/usr/bin/env bash
# bytes.sh TEXTS KERNEL_BYTES: what the solves over strands and the grid's stages read and write at one lane, as
# CSV: compiles what kernel_texts wrote into TEXTS for NVIDIA up to LLVM's optimised code, every function
# inlined as drivers do, has loads and stores counted (touch.awk), and runs it on this machine.
set -euo pipefail
texts=$1 program=$2
clang=$(command -v clang-19)
clc=${PLAIT_LIBCLC:-/usr/lib/clc}
here=$(dirname "$0")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

while read -r name lanes vertices kernel options; do
    case $name in articulated | grid_splat* | volume_splat* | grid_diffuse | volume_gather) ;; *) continue ;; esac
    if [ "$lanes" -ne 1 ] || [ "$vertices" -ne 16 ]; then continue; fi
    # the reference, whose buffers are taken, has tiles of one strand
    options=${options/-DPLAIT_TILE=32/-DPLAIT_TILE=1}
    # shellcheck disable=SC2086  # several options
    "$clang" -x cl -target nvptx64-nvidia-nvcl -Xclang -target-cpu -Xclang sm_90 -nogpulib -O3 -w -mllvm -inline-threshold=1000000 \
        -Xclang -mlink-builtin-bitcode -Xclang "$clc/nvptx64--nvidiacl.bc" $options -S -emit-llvm "$texts/$name.cl" -o "$folder/$name.ll"
    awk -f "$here/touch.awk" "$folder/$name.ll" >"$folder/touch.ll"
    sed -E -e '/^target /d; s/ spir_kernel / /; s/"target-(cpu|features)"="[^"]*"//g' \
        -e 's/llvm\.nvvm\.read\.ptx\.sreg\.tid\.x/plait_local_id/; s/llvm\.nvvm\.read\.ptx\.sreg\.ntid\.x/plait_local_size/' \
        -e 's/llvm\.nvvm\.read\.ptx\.sreg\.ctaid\.x/plait_group_id/; s/llvm\.nvvm\.barrier0/plait_barrier/' \
        "$folder/touch.ll" >"$folder/host.ll"
    "$clang" -O1 -w -fPIC -shared "$folder/host.ll" -o "$folder/$name.so"
    # a group where it shares local memory
    case $name in *-8) group=128 ;; *) group=1 ;; esac
    echo "$name ${kernel#plait_} $group" >>"$folder/list.txt"
done <"$texts/list.txt"
"$program" "$folder"
