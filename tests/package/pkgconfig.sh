#!/usr/bin/env bash
# pkgconfig.sh CC PREFIX CONSUMER [--static]: compile CONSUMER with what plait.pc says, and run it.
set -euo pipefail
cc=$1 prefix=$2 consumer=$3 mode=${4-}
PKG_CONFIG_PATH=$(dirname "$(find "$prefix" -name plait.pc)")
export PKG_CONFIG_PATH
read -ra cflags <<<"$(pkg-config --cflags plait)"
read -ra libs <<<"$(pkg-config --libs ${mode:+"$mode"} plait)"
program=$prefix/consumer
"$cc" "${cflags[@]}" "$consumer" -o "$program" "${libs[@]}"
LD_LIBRARY_PATH=$(pkg-config --variable=libdir plait) "$program"
