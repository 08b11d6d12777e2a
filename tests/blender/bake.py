"""A character turns its head under 500 curves for 48 frames: what is baked, what Blender shows of it, and what a bake that is
cancelled leaves."""
import os

import bpy
import numpy

import blender
import characters
import measure
from plait_hair import bake, cache


def a_baked_shot_is_right():
    body, hair = characters.turning_character()
    blender.save()
    recorded = blender.bake_all(hair)
    scene = bpy.context.scene
    assert len(recorded) == 48 and os.path.isfile("shot_hair.abc")
    roots, stretch, deep = measure.report(scene, body, hair)
    assert roots <= 1e-4 and stretch <= 1e-4 and deep <= 1e-3
    off = 0
    for frame in range(1, 49):
        scene.frame_set(frame)
        off = max(off, abs(measure.shown(hair.plait.cache).reshape(-1, 3) - recorded[frame - 1]).max())
    print(f"the cache is off by {off:.2e} m from what was simulated")
    assert off <= 1e-6
    tips = numpy.array([frame.reshape(500, 16, 3)[:, -1] for frame in recorded])
    moved = numpy.linalg.norm(tips.max(0) - tips.min(0), axis=1)
    assert numpy.median(moved) > 0.03, "hair moves with the head"


def without_a_body_hair_would_be_inside():
    """So that the measure of depth measures something."""
    body, hair = characters.turning_character(100)
    hair.plait.surface_is_body = False
    blender.save("bodiless.blend")
    blender.bake_all(hair)
    assert measure.report(bpy.context.scene, body, hair)[2] > 1e-2


def the_cache_stands_in_place_of_the_curves():
    hair = bpy.data.objects["hair"]
    shown = hair.plait.cache
    assert shown.visible_get() and not hair.visible_get()
    assert [m.type for m in shown.modifiers] == ["MESH_SEQUENCE_CACHE"] and shown.modifiers[0].cache_file.filepath == "//shot_hair.abc"
    radii = [p.radius for p in shown.evaluated_get(bpy.context.evaluated_depsgraph_get()).data.points]
    own = [p.radius for p in hair.data.points]
    assert own[0] > own[15] and max(abs(a / b - 1) for a, b in zip(radii, own)) < 1e-6
    bpy.context.view_layer.objects.active = shown
    assert bpy.ops.plait.show(shown=False) == {"FINISHED"}
    assert hair.visible_get() and not shown.visible_get() and bpy.context.object == hair
    assert bpy.ops.plait.show(shown=True) == {"FINISHED"}
    assert shown.visible_get() and bpy.context.object == shown


def it_is_there_when_the_blend_is_opened_again():
    scene = bpy.context.scene
    scene.frame_set(30)
    before = measure.shown(bpy.data.objects["hair"].plait.cache)
    blender.save()
    bpy.ops.wm.open_mainfile(filepath=os.path.abspath("shot.blend"))
    bpy.context.scene.frame_set(30)
    hair = bpy.data.objects["hair"]
    assert numpy.array_equal(before, measure.shown(hair.plait.cache))
    assert hair.plait.cache.plait.source == hair


def a_second_bake_replaces_the_first():
    hair = bpy.data.objects["hair"]
    hair.plait.groom = 1
    bpy.context.view_layer.objects.active = hair.plait.cache
    before = os.stat("shot_hair.abc").st_ino
    assert bpy.ops.plait.bake() == {"FINISHED"}
    assert os.stat("shot_hair.abc").st_ino != before
    assert len(bpy.data.cache_files) == 1 and len(bpy.data.hair_curves) == 2
    assert [o.name for o in bpy.data.objects if o.type == "CURVES"] == ["hair", "hair (plait)"]


def a_cancelled_bake_leaves_no_file():
    _, hair = characters.turning_character(50)
    blender.save("cancelled.blend")
    bpy.context.scene.frame_set(7)
    files, frames = set(os.listdir()), bake.bake(blender.API, bpy.context.scene, hair)
    for done, total in frames:
        if done == hair.plait.preroll + 20:
            break
    assert total == 48 + hair.plait.preroll and set(os.listdir()) != files, "it is under way"
    frames.close()
    assert set(os.listdir()) == files, set(os.listdir()) - files
    assert hair.plait.cache is None and hair.visible_get() and bpy.context.scene.frame_current == 7


def a_cancelled_bake_keeps_the_one_before():
    hair = bpy.data.objects["hair"]
    blender.bake_all(hair)
    before = os.stat("cancelled_hair.abc")
    frames = bake.bake(blender.API, bpy.context.scene, hair)
    for done, _ in frames:
        if done == hair.plait.preroll + 20:
            break
    frames.close()
    assert os.stat("cancelled_hair.abc") == before and cache.is_shown(hair)
    bpy.context.scene.frame_set(10)
    assert len(measure.shown(hair.plait.cache)) == 50


blender.run(without_a_body_hair_would_be_inside, a_baked_shot_is_right, the_cache_stands_in_place_of_the_curves, it_is_there_when_the_blend_is_opened_again,
            a_second_bake_replaces_the_first, a_cancelled_bake_leaves_no_file, a_cancelled_bake_keeps_the_one_before)
