#!/usr/bin/env bash
# run.sh PYTHON SCRIPT FOLDER ZIP ARGUMENTS...: runs SCRIPT with ARGUMENTS in a new FOLDER, in which the add-on of ZIP is unpacked
# as plait_hair. PYTHON bpy: that of the environment's PLAIT_ORACLE_PYTHON, or python3; 77 where it has no bpy.
set -euo pipefail
python=$1 script=$2 folder=$3 zip=$4
shift 4
rm -rf "$folder"
mkdir -p "$folder/plait_hair"
cd "$folder"
if [ "$python" = bpy ]; then
    python=${PLAIT_ORACLE_PYTHON:-python3}
    "$python" -c 'import importlib.util, sys; sys.exit(importlib.util.find_spec("bpy") is None)' || {
        echo "skipped: $python has no module bpy; set PLAIT_ORACLE_PYTHON to a Python that has"
        exit 77
    }
fi
"$python" -m zipfile -e "$zip" plait_hair
export PYTHONPATH=$folder PYTHONDONTWRITEBYTECODE=1 PLAIT_ZIP=$zip BLENDER_USER_RESOURCES=$folder/user
exec "$python" "$script" "$@"
