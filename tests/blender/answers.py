"""Each input that cannot be baked is answered, in the panel and by the operator, by a sentence that names object, value and what
is allowed."""
import os

import bpy
import numpy

import blender
import characters
from plait_hair import library, panel


def answer(hair, *words):
    """Bakes, which must fail with these words, and says so in the panel, too."""
    bpy.context.view_layer.objects.active = hair
    files = set(os.listdir())
    try:
        bpy.ops.plait.bake()
    except RuntimeError as error:
        said = str(error)
    else:
        raise AssertionError(f"was baked; expected {words}")
    print(said.strip())
    for word in words:
        assert word in said, f"{said} lacks {word}"
    assert any(all(word in line for word in words) for line in panel.answers(bpy.context, hair))
    assert set(os.listdir()) == files


def character(saved=True):
    body, hair = characters.turning_character(20)
    if saved:
        blender.save("wrong.blend")
    return body, hair


def good_input_has_no_answer():
    _, hair = character()
    assert panel.answers(bpy.context, hair) == []


def an_unsaved_blend():
    answer(character(saved=False)[1], "no file", "save it")


def no_surface():
    _, hair = character()
    hair.data.surface = None
    answer(hair, "'hair'", "no surface", "mesh object")


def a_surface_without_faces():
    _, hair = character()
    hair.data.surface = characters.link("cloud", bpy.data.meshes.new("cloud"))
    answer(hair, "'cloud'", "0 faces", "1 or more")


def an_open_body():
    body, hair = character()
    mesh = body.data
    mesh.polygons.foreach_get("select", numpy.zeros(len(mesh.polygons), bool))
    kept = [tuple(p.vertices) for p in mesh.polygons][3:]
    points = [tuple(v.co) for v in mesh.vertices]
    mesh.clear_geometry()
    mesh.from_pydata(points, [], kept)
    answer(hair, "'body'", "open edges", "allowed are 0")
    hair.plait.surface_is_body = False
    assert panel.answers(bpy.context, hair) == [], "a change takes the answer back"
    assert bpy.ops.plait.bake() == {"FINISHED"}, "as a surface it may be open"


def an_open_mesh_of_the_collection():
    _, hair = character()
    hair.plait.body = bpy.data.collections.new("clothes")
    bpy.context.scene.collection.children.link(hair.plait.body)
    collar = bpy.data.meshes.new("collar")
    collar.from_pydata([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [], [(0, 1, 2)])
    hair.plait.body.objects.link(bpy.data.objects.new("collar", collar))
    answer(hair, "'collar'", "3 open edges", "allowed are 0")


def a_hidden_body():
    body, hair = character()
    body.hide_set(True)
    answer(hair, "'body'", "hidden", "show it")


def a_scale_that_is_not_applied():
    _, hair = character()
    hair.scale = (1, 2, 1)
    bpy.context.view_layer.update()
    answer(hair, "'hair'", "(1, 2, 1)", "equal numbers above 0")
    hair.scale = (-1, 1, 1)
    bpy.context.view_layer.update()
    answer(hair, "'hair'", "equal numbers above 0")


def a_body_that_grows():
    body, hair = character()
    body.keyframe_insert("scale", frame=1)
    body.scale = (1.5, 1.5, 1.5)
    body.keyframe_insert("scale", frame=48)
    answer(hair, "'body'", "the scale (1.", "in frame", "(1, 1, 1)", "allowed is one that stays")


def curves_of_one_point():
    _, hair = character()
    hair.data.add_curves([1, 300])
    answer(hair, "Curve 20", "'hair'", "1 point;", "2 to 256", "2 of 22")


def a_curve_of_too_many_points():
    _, hair = character()
    hair.data.add_curves([300])
    answer(hair, "Curve 20", "300 points", "2 to 256")


def a_curve_without_length():
    _, hair = character()
    root = tuple(hair.data.points[0].position)
    hair.data.add_curves([5])
    for point in list(hair.data.points)[-5:]:
        point.position = root
    answer(hair, "'hair'", "strand 20", "0 m long", "at least 1e-06 m")


def no_curves():
    _, hair = character()
    hair.data = bpy.data.hair_curves.new("bald")
    hair.data.surface = bpy.data.objects["body"]
    answer(hair, "'hair'", "0 curves", "1 or more")


def roots_far_from_the_surface():
    _, hair = character()
    hair.location.x = 1
    bpy.context.view_layer.update()
    answer(hair, "'hair'", "'body'", "in frame 1", "allowed are 0.05 m")


def a_scene_of_one_frame():
    _, hair = character()
    bpy.context.scene.frame_end = 1
    answer(hair, "frame 1", "begins with 1")


def a_mesh_whose_vertices_change():
    body, hair = character()
    finer = body.modifiers.new("finer", "SUBSURF")
    finer.levels = 0
    finer.keyframe_insert("levels", frame=9)
    finer.levels = 1
    finer.keyframe_insert("levels", frame=10)
    answer(hair, "'body'", "vertices in frame 10", "keep their number")


def a_library_that_is_not_there():
    _, hair = character()
    load, library.load = library.load, lambda given: load("/nowhere/libplait.so")
    try:
        answer(hair, "/nowhere/libplait.so", "0.2.x", "preferences")
    finally:
        library.load = load


blender.run(good_input_has_no_answer, an_unsaved_blend, no_surface, a_surface_without_faces, an_open_body,
            an_open_mesh_of_the_collection, a_hidden_body, a_scale_that_is_not_applied, a_body_that_grows, curves_of_one_point,
            a_curve_of_too_many_points, a_curve_without_length, no_curves, roots_far_from_the_surface, a_scene_of_one_frame,
            a_mesh_whose_vertices_change, a_library_that_is_not_there)
