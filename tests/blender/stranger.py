"""Scenes that the add-on was not made for: other units, rates, frames, parents and bodies. Each is baked and measured."""
import math

import bpy
from mathutils import Matrix, Vector
import numpy

import blender
import characters
import measure


def check(hair, surface, bodies=None, unit=1.0):
    """`unit`: m of a unit of the scene. Returns the points of each frame."""
    blender.save()
    recorded = blender.bake_all(hair)
    roots, stretch, depth = measure.report(bpy.context.scene, surface, hair, bodies)
    assert roots * unit <= 1e-4 and stretch <= 1e-4 and depth * unit <= 1e-3
    return recorded


def keyed(thing, path, values):
    """Keys of `path` ("location", or "location.x") by frame."""
    name, _, axis = path.partition(".")
    for frame, value in values.items():
        if axis:
            setattr(getattr(thing, name), axis, value)
        else:
            setattr(thing, name, value)
        thing.keyframe_insert(name, frame=frame)


def ball(name, radius):
    import bmesh
    shape, mesh = bmesh.new(), bpy.data.meshes.new(name)
    bmesh.ops.create_icosphere(shape, subdivisions=4, radius=radius)
    shape.to_mesh(mesh)
    shape.free()
    return characters.link(name, mesh)


def a_scaled_doll_that_is_bent_by_shape_keys():
    """A tenth as large as its object makes it, far from the origin, at 30 fps, frames 101 to 160; hair is its child."""
    scene = characters.empty_scene(101, 160, 30)
    mesh = characters.body_mesh("doll")
    mesh.transform(Matrix.Scale(0.1, 4))
    body = characters.link("doll", mesh)
    body.scale, body.location, body.rotation_euler = (10, 10, 10), (3, -2, 1), (0, 0, 2)
    body.shape_key_add(name="Basis")
    puffed = body.shape_key_add(name="puffed")
    for point, vertex in zip(puffed.data, mesh.vertices):
        point.co = vertex.co * (1.15 if vertex.co.z > 0 else 1)
    keyed(puffed, "value", {101: 0, 120: 1, 140: 0, 160: 1})
    keyed(body, "location.x", {101: 3, 120: 3.2, 140: 2.9, 160: 3})
    hair = characters.hair(body, 200, length=0.02, lowest=0.01, apart=2e-4)
    recorded = check(hair, body)
    assert abs(recorded[0][:, 0] - 3).max() < 0.5
    shown = hair.plait.cache.evaluated_get(bpy.context.evaluated_depsgraph_get())
    assert math.isclose(shown.data.points[0].radius, 10 * hair.data.points[0].radius, rel_tol=1e-6), "as thick as its object"


def a_character_in_centimetres_that_walks_off():
    """A rig that moves as an object, at 60 fps, frames 1100 to 1140; a fist comes from behind; hair has no parent."""
    scene = characters.empty_scene(1100, 1140, 60)
    scene.unit_settings.system, scene.unit_settings.scale_length = "METRIC", 0.01
    body = characters.link("body", characters.body_mesh())
    hair = characters.hair(body, 200)
    hair.parent = None
    skeleton = characters.rig(body, 30, (1100, 1110, 1120, 1130, 1140))
    grown = Matrix.Scale(100, 4)
    body.data.transform(grown)
    skeleton.data.transform(grown)
    for point in hair.data.points:
        point.position = 100 * Vector(point.position)
    body.parent = skeleton
    keyed(skeleton, "location.y", {1100: 0, 1140: -80})
    fist = ball("fist", 3)
    fist.parent = skeleton
    keyed(fist, "location", {1100: (0, 40, -2), 1120: (0, 13, -2), 1140: (6, 13, 4)})
    hair.plait.body = bpy.data.collections.new("props")
    hair.plait.body.objects.link(fist)
    scene.collection.children.link(hair.plait.body)
    check(hair, body, [body, fist], unit=0.01)


def fur_on_a_ball_that_rolls_under_a_turned_parent():
    """The surface is subdivided and rigid, as an imported one its parent turns y up to z up; 25 fps; a gale."""
    characters.empty_scene(1, 40, 25)
    up = characters.link("up", None)
    up.rotation_euler.x = math.radians(90)
    body = ball("ball", 0.15)
    body.modifiers.new("finer", "SUBSURF").levels = 1
    body.parent = up
    keyed(body, "rotation_euler.y", {1: 0, 40: 3})
    chance, places = numpy.random.default_rng(3), []
    for direction in chance.normal(size=(300, 3)):
        normal = Vector(direction).normalized()
        places += [0.1475 * normal + 0.05 * i / 7 * normal for i in range(8)]  # the cage is outside of what is shown
    data = bpy.data.hair_curves.new("fur")
    data.add_curves([8] * 300)
    data.position_data.foreach_set("vector", numpy.array(places, numpy.float32).ravel())
    data.surface = body
    fur = characters.link("fur", data)
    fur.parent = body
    still = check(fur, body)
    characters.wind(5, 0, (1, 0, 0))
    windy = check(fur, body)
    blown = numpy.array(windy[-1]) - numpy.array(still[-1])
    assert blown[7::8, 0].mean() > 0.003, "towards +x"
    assert abs(blown[7::8, 1:]).mean() < blown[7::8, 0].mean()


def a_groom_made_on_a_posed_character():
    """Its arms or its head are not as the mesh is without its rig: hair belongs to what the first frame shows."""
    characters.empty_scene(1, 24, 24)
    body = characters.link("body", characters.body_mesh())
    characters.rig(body, 50, (-5, 1, 13, 25))
    bpy.context.scene.frame_set(1)
    posed = body.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh().copy()
    sculpted = characters.link("sculpted", posed)
    hair = characters.hair(sculpted, 100)
    bpy.data.objects.remove(sculpted)
    hair.data.surface, hair.parent = body, body
    check(hair, body)


def hair_that_geometry_nodes_put_on_the_deformed_surface():
    """What Blender's own tools add to hair curves is not applied twice; what follows it works on the cache."""
    body, hair = characters.turning_character(50)
    tree = bpy.data.node_groups.new("Surface Deform", "GeometryNodeTree")
    for side in ("INPUT", "OUTPUT"):
        tree.interface.new_socket("Geometry", in_out=side, socket_type="NodeSocketGeometry")
    deform = tree.nodes.new("GeometryNodeDeformCurvesOnSurface")
    tree.links.new(tree.nodes.new("NodeGroupInput").outputs[0], deform.inputs[0])
    tree.links.new(deform.outputs[0], tree.nodes.new("NodeGroupOutput").inputs[0])
    hair.modifiers.new("Surface Deform", "NODES").node_group = tree
    characters.children(hair, 3, 0.001)
    blender.save()
    recorded = blender.bake_all(hair)
    cache = hair.plait.cache
    assert [m.type for m in cache.modifiers] == ["MESH_SEQUENCE_CACHE", "NODES"] and cache.modifiers[1].name == "children"
    bpy.context.scene.frame_set(20)
    shown = measure.shown(cache)
    assert len(shown) == 150
    assert abs(shown.reshape(50, 3, 16, 3) - recorded[19].reshape(50, 1, 16, 3)).max() < 0.00101


blender.run(a_scaled_doll_that_is_bent_by_shape_keys, a_character_in_centimetres_that_walks_off,
            fur_on_a_ball_that_rolls_under_a_turned_parent, a_groom_made_on_a_posed_character,
            hair_that_geometry_nodes_put_on_the_deformed_surface)
