"""blender.py CLIP_POINTS FOLDER: Blender shows the clips that plait records as plait has them, frame by frame; plait loads the
hair curves that Blender exports as Blender has them."""
import sys

import clips

bpy = clips.need("bpy")
program, folder = sys.argv[1:]


def curves_object():
    return next(o for o in bpy.data.objects if o.type == "CURVES")


def shown():
    """Points of the curves as the present frame shows them, with plait's y up."""
    evaluated = curves_object().evaluated_get(bpy.context.evaluated_depsgraph_get())
    places = [evaluated.matrix_world @ point.position for point in evaluated.data.points]
    return [c for p in places for c in (p.x, p.z, -p.y)], [2 * p.radius for p in evaluated.data.points]


def check_recorded(kind):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    file = f"{folder}/clip.{kind}"
    importer = bpy.ops.wm.alembic_import if kind == "abc" else bpy.ops.wm.usd_import
    importer(filepath=file)
    for frame, expected in enumerate(recorded):
        bpy.context.scene.frame_set(frame)
        positions, widths = shown()
        clips.compare(f"{kind}, frame {frame}", positions, expected, 1e-6)
        clips.compare(f"{kind}, diameters", widths, [8e-5] * len(widths), 1e-10)


def check_exported():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    data = bpy.data.hair_curves.new("hair")
    sizes = [4, 3, 7, 5]
    data.add_curves(sizes)
    data.set_types(type="POLY")
    for i, point in enumerate(data.points):
        point.position = (0.1 * i, 0.01 * i * i, 0.03 * (i % 5))
        point.radius = 0.0001 * (1 + i % 2)
    hair = bpy.data.objects.new("hair", data)
    bpy.context.scene.collection.objects.link(hair)
    hair.location, hair.rotation_euler, hair.scale = (0.5, 0.25, 1.5), (0.3, 0.2, 0.1), (2, 2, 2)
    bpy.context.view_layer.update()
    expected, _ = shown()
    bpy.ops.wm.alembic_export(filepath=f"{folder}/blender.abc", start=1, end=1)
    bpy.ops.wm.usd_export(filepath=f"{folder}/blender.usda", export_hair=True)
    for kind in ("abc", "usda"):
        counts, positions, widths = clips.run(program, "read", f"{folder}/blender.{kind}")
        assert counts == sizes, counts
        clips.compare(f"exported {kind}", positions, expected, 2e-6)
        assert len(widths) == len(sizes)


recorded = clips.run(program, "record", f"{folder}/clip.abc", f"{folder}/clip.usda")
check_recorded("abc")
check_recorded("usda")
check_exported()
