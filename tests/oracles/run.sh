#!/usr/bin/env bash
# run.sh SCRIPT CLIP_POINTS FOLDER: runs SCRIPT, in Python, in a new FOLDER; 77: the module it needs is not there.
set -euo pipefail
rm -rf "$3"
mkdir -p "$3"
exec "${PLAIT_ORACLE_PYTHON:-python3}" "$1" "$2" "$3"
