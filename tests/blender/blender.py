"""What the tests in Blender share: the add-on, registered, and an end without Blender's own, which may wait for ever for threads
of a module that is used outside of its program."""
import os
import sys
import traceback

import bpy

import plait_hair
from plait_hair import bake, cache, capi, library

API = library.load()


def run(*tests):
    plait_hair.register()
    try:
        for test in tests:
            print(f"-- {test.__name__}", flush=True)
            test()
        failed = 0
    except BaseException:
        traceback.print_exc()
        failed = 1
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(failed)


def save(name="shot.blend"):
    bpy.ops.wm.save_as_mainfile(filepath=os.path.abspath(name))


def bake_all(hair):
    """Bakes; returns the points that the simulation had in each frame, in Blender's world."""
    recorded, add = [], bake.Recorder.add

    def keep(recorder, simulation, seconds):
        add(recorder, simulation, seconds)
        p = simulation.positions() / bpy.context.scene.unit_settings.scale_length
        recorded.append(p[:, [0, 2, 1]] * (1, -1, 1))
    bake.Recorder.add = keep
    try:
        bake.bake_whole(API, bpy.context.scene, hair)
    finally:
        bake.Recorder.add = add
    return recorded
