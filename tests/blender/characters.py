"""Scenes for the tests: a character with hair, in Blender."""
import math

import bpy
from mathutils import Vector
from mathutils.bvhtree import BVHTree
import numpy


def _outline():
    """(height, half width along x, along y) of head, neck and shoulders, m, from below."""
    rows = []
    for i in range(57):
        z = -0.20 + 0.36 * i / 56
        head = 0.078 * math.sqrt(max(0, 1 - ((z - 0.05) / 0.11) ** 2))
        neck = 0.05 if z < 0.04 else 0
        shoulders = 0.18 * math.sqrt(max(0, 1 - ((z + 0.20) / 0.11) ** 2)) if z < -0.09 else 0
        wide = (head ** 6 + neck ** 6 + shoulders ** 6) ** (1 / 6)
        rows.append((z, wide, (head ** 6 + neck ** 6 + (0.5 * shoulders) ** 6) ** (1 / 6)))
    return [row for row in rows if row[1] > 1e-3]


def body_mesh(name="body", around=48):
    """Closed head, neck and shoulders; the head's middle is 5 cm above the origin."""
    rows = _outline()
    points = [(wide * math.cos(2 * math.pi * j / around), deep * math.sin(2 * math.pi * j / around), z)
              for z, wide, deep in rows for j in range(around)]
    below, above = len(points), len(points) + 1
    points += [(0, 0, rows[0][0]), (0, 0, rows[-1][0] + 1e-3)]
    last = around * (len(rows) - 1)
    faces = []
    for j in range(around):
        k = (j + 1) % around
        faces += [(i * around + j, i * around + k, (i + 1) * around + k, (i + 1) * around + j) for i in range(len(rows) - 1)]
        faces += [(below, k, j), (above, last + j, last + k)]
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(points, [], faces)
    mesh.shade_smooth()
    return mesh


def link(name, data):
    thing = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def rig(body, turn=40, frames=(1, 13, 25, 37, 48)):
    """An armature whose bone `head` turns the head to both sides, `turn` degrees, through a neck that twists."""
    skeleton = link("rig", bpy.data.armatures.new("rig"))
    bpy.context.view_layer.objects.active = skeleton
    bpy.ops.object.mode_set(mode="EDIT")
    for name, low, high in (("chest", -0.2, -0.05), ("head", -0.05, 0.16)):
        bone = skeleton.data.edit_bones.new(name)
        bone.head, bone.tail = (0, 0, low), (0, 0, high)
    bpy.ops.object.mode_set(mode="OBJECT")
    groups = {name: body.vertex_groups.new(name=name) for name in ("chest", "head")}
    for vertex in body.data.vertices:
        share = min(max((vertex.co.z + 0.09) / 0.06, 0), 1)
        groups["head"].add([vertex.index], share, "REPLACE")
        groups["chest"].add([vertex.index], 1 - share, "REPLACE")
    body.modifiers.new("rig", "ARMATURE").object = skeleton
    bone = skeleton.pose.bones["head"]
    bone.rotation_mode = "XYZ"
    for i, frame in enumerate(frames):
        bone.rotation_euler = (0, math.radians(turn) * (0, 1, 0, -1)[i % 4], 0)  # y: along the bone
        bone.keyframe_insert("rotation_euler", frame=frame)
    return skeleton


def hair(body, strands=500, points=16, length=0.2, seed=1, lowest=0.06, apart=0.002):
    """Curves that leave the upper head, above `lowest`, and fall around the body at rest, which they stay `apart` from; in the
    body's space."""
    mesh = body.data
    mesh.calc_loop_triangles()
    tree = BVHTree.FromPolygons([v.co for v in mesh.vertices], [t.vertices for t in mesh.loop_triangles])
    chance = numpy.random.default_rng(seed)
    places = []
    middle = Vector((0, 0, lowest))
    while len(places) < strands * points:
        along = Vector(chance.normal(size=3)).normalized()
        root, normal, _, _ = tree.ray_cast(middle + along, -along)
        if root is None or root.z < lowest:
            continue
        place, direction = root.copy(), normal.copy()
        for _ in range(points):
            places.append(place.copy())
            direction = (0.75 * direction + 0.25 * Vector((0, 0, -1))).normalized()
            place = place + length / (points - 1) * direction
            near, out, _, _ = tree.find_nearest(place)
            if (place - near).dot(out) < apart:
                place = near + apart * out
    data = bpy.data.hair_curves.new("hair")
    data.add_curves([points] * strands)
    data.position_data.foreach_set("vector", numpy.array(places, numpy.float32).ravel())
    data.attributes.new("radius", "FLOAT", "POINT").data.foreach_set(
        "value", numpy.tile(numpy.linspace(4e-4, 1e-4, points, dtype=numpy.float32), strands))
    data.surface = body
    thing = link("hair", data)
    thing.parent = body
    return thing


def wind(strength, noise, towards):
    field = link("wind", None)
    field.rotation_euler = Vector(towards).to_track_quat("Z", "Y").to_euler()
    bpy.context.view_layer.objects.active = field
    field.select_set(True)
    bpy.ops.object.forcefield_toggle()
    field.field.type, field.field.strength, field.field.noise = "WIND", strength, noise


def children(hair, number, apart):
    """Geometry nodes that make `number` hairs of each curve, up to `apart` m from it along each axis."""
    tree = bpy.data.node_groups.new("children", "GeometryNodeTree")
    for side in ("INPUT", "OUTPUT"):
        tree.interface.new_socket("Geometry", in_out=side, socket_type="NodeSocketGeometry")
    make, join = tree.nodes.new, tree.links.new
    came, left = make("NodeGroupInput"), make("NodeGroupOutput")
    copies, place, chance = make("GeometryNodeDuplicateElements"), make("GeometryNodeSetPosition"), make("FunctionNodeRandomValue")
    curve, number_of = make("GeometryNodeFieldOnDomain"), make("GeometryNodeInputIndex")
    copies.domain, chance.data_type, curve.domain, curve.data_type = "SPLINE", "FLOAT_VECTOR", "CURVE", "FLOAT_VECTOR"
    copies.inputs["Amount"].default_value = number
    chance.inputs[0].default_value, chance.inputs[1].default_value = [-apart] * 3, [apart] * 3
    join(came.outputs[0], copies.inputs["Geometry"])
    join(copies.outputs["Geometry"], place.inputs["Geometry"])
    join(number_of.outputs[0], chance.inputs["ID"])
    join(chance.outputs[0], curve.inputs[0])
    join(curve.outputs[0], place.inputs["Offset"])
    join(place.outputs[0], left.inputs[0])
    hair.modifiers.new("children", "NODES").node_group = tree


def empty_scene(first=1, last=48, fps=24):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end, scene.render.fps = first, last, fps
    return scene


def turning_character(strands=500):
    """A character that turns its head for 48 frames, and its hair."""
    empty_scene()
    body = link("body", body_mesh())
    rig(body)
    return body, hair(body, strands)
