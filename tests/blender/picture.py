"""picture.py ASSETS GROOM.abc FOLDER WIDTH SAMPLES FRAMES...: the walking character of the assets with a groom, baked, and frames
of it by Cycles. PYTHONPATH has a folder in which the add-on's zip is unpacked as plait_hair. The groom of docs/images/blender.png:
`plait-groom long --strands 2500 --vertices 24`, as Alembic; 560 40 1 40."""
import math
import os
import sys
import time

import bpy
from mathutils import Vector

import blender
import characters


def character(assets, groom):
    """The scene: body, hair on it, wind."""
    scene = characters.empty_scene(1, 96, 24)
    import addon_utils
    addon_utils.enable("io_scene_gltf2")
    bpy.ops.import_scene.gltf(filepath=os.path.join(assets, "character.gltf"))
    bpy.data.objects.remove(bpy.data.objects["Icosphere"])  # the importer's picture of a bone
    bpy.ops.wm.alembic_import(filepath=groom)
    scene.frame_start, scene.frame_end = 1, 96
    body, hair = bpy.data.objects["body"], next(o for o in bpy.data.objects if o.type == "CURVES")
    hair.data.surface = body
    return body, hair


def _material(name, node, **inputs):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    shader, out = nodes.new(node), nodes.new("ShaderNodeOutputMaterial")
    if hasattr(shader, "parametrization"):
        shader.parametrization = "MELANIN"
    for key, value in inputs.items():
        shader.inputs[key.replace("_", " ")].default_value = value
    material.node_tree.links.new(shader.outputs[0], out.inputs["Surface"])
    return material


def _light(name, place, target, power, size):
    light = bpy.data.lights.new(name, "AREA")
    light.energy, light.size = power, size
    thing = characters.link(name, light)
    thing.location = place
    thing.rotation_euler = (Vector(target) - Vector(place)).to_track_quat("-Z", "Y").to_euler()


def studio(body, hair, width, samples, azimuth=35):
    """Materials, lights and a camera; `azimuth`: degrees to the left of the face."""
    scene = bpy.context.scene
    body.data.materials.clear()
    body.data.materials.append(_material("skin", "ShaderNodeBsdfPrincipled", Base_Color=(0.42, 0.23, 0.16, 1), Roughness=0.6))
    body.data.shade_smooth()
    hair.data.materials.clear()
    hair.data.materials.append(_material("hair", "ShaderNodeBsdfHairPrincipled", Melanin=0.78, Melanin_Redness=0.45, Roughness=0.3,
                                         Radial_Roughness=0.4, Random_Color=0.25))
    middle = Vector((0, 0, -0.13))
    turn = math.radians(azimuth)
    camera = characters.link("camera", bpy.data.cameras.new("camera"))
    camera.location = middle + Vector((1.55 * math.sin(turn), -1.55 * math.cos(turn), 0.18))
    camera.rotation_euler = (middle - camera.location).to_track_quat("-Z", "Y").to_euler()
    camera.data.lens = 72
    scene.camera = camera
    _light("key", (1.1, -1.2, 0.9), middle, 26, 0.5)
    _light("rim", (-0.9, 1.2, 0.9), middle, 34, 0.4)
    _light("fill", (-1.6, -1.0, 0.3), middle, 8, 1.2)
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs[0].default_value = (0.05, 0.055, 0.065, 1)
    scene.render.engine = "CYCLES"
    scene.cycles.device, scene.cycles.samples, scene.cycles.use_denoising = "CPU", samples, True
    scene.cycles.max_bounces = 8
    scene.view_settings.view_transform = "AgX"
    scene.view_settings.look = "AgX - Medium High Contrast"
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = width, width, 100
    scene.render.image_settings.file_format = "PNG"


def render(file):
    bpy.context.scene.render.filepath = os.path.abspath(file)
    bpy.ops.render.render(write_still=True)


def pictures():
    assets, groom, folder, width, samples, *frames = sys.argv[1:]
    body, hair = character(assets, groom)
    characters.wind(1.4, 0.5, (-0.8, 1.2, 0))
    studio(body, hair, int(width), int(samples))
    hair.data.attributes.new("radius", "FLOAT", "POINT").data.foreach_set("value", [1.5e-4] * len(hair.data.points))
    characters.children(hair, 8, 0.004)
    settings = hair.plait
    settings.bend_stiffness, settings.line_density = 47, 50
    settings.keep_volume = True
    blender.save(os.path.join(folder, "walk.blend"))
    begin = time.time()
    blender.bake.bake_whole(blender.API, bpy.context.scene, hair)
    print(f"{len(hair.data.curves)} curves, 96 frames: baked in {time.time() - begin:.1f} s")
    for frame in frames:
        bpy.context.scene.frame_set(int(frame))
        render(os.path.join(folder, f"frame{frame}.png"))


if __name__ == "__main__":
    blender.run(pictures)
