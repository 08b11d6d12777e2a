"""The baked Alembic in place of the curves: a copy of the hair object that reads it. The groom stays as it was."""
import os

import bpy
from mathutils import Matrix

STRANDS = "/hair/strands"  # in the file


def path(hair):
    """Beside the .blend, named after it and the object."""
    stem = os.path.splitext(os.path.basename(bpy.data.filepath))[0]
    return os.path.join(os.path.dirname(bpy.data.filepath), bpy.path.clean_name(f"{stem}_{hair.name}") + ".abc")


def is_shown(hair):
    return hair.plait.cache is not None and not hair.plait.cache.hide_render


def show(hair, shown):
    """The cache in place of the curves, or the curves again."""
    cache = hair.plait.cache
    if cache is not None:
        cache.hide_viewport = cache.hide_render = not shown
    shown = shown and cache is not None
    hair.hide_viewport = hair.hide_render = shown
    active = bpy.context.view_layer.objects
    if active.active in (hair, cache):
        active.active = cache if shown else hair


def remove(hair):
    """Takes the cache out of the scene; its file stays."""
    show(hair, False)
    cache = hair.plait.cache
    hair.plait.cache = None
    if cache is None:
        return
    data, files = cache.data, {m.cache_file for m in cache.modifiers if m.type == "MESH_SEQUENCE_CACHE" and m.cache_file}
    bpy.data.objects.remove(cache)
    if not data.users:
        bpy.data.hair_curves.remove(data)
    bpy.data.batch_remove([file for file in files if not file.users])


def _open(file):
    before = set(bpy.data.cache_files)
    bpy.ops.cachefile.open(filepath=file)
    found, = set(bpy.data.cache_files) - before
    found.filepath = bpy.path.relpath(file)
    return found


def _moves_with_surface(modifier):
    """Whether geometry nodes put curves on the deformed surface, where the cache has them already."""
    def within(tree):
        return tree is not None and any(node.bl_idname == "GeometryNodeDeformCurvesOnSurface"
                                        or node.type == "GROUP" and within(node.node_tree) for node in tree.nodes)
    return modifier.type == "NODES" and within(modifier.node_group)


def attach(hair, file):
    """A new object that shows `file` with the hair's materials, radii, attributes and modifiers; the curves are hidden."""
    remove(hair)
    cache = hair.copy()
    cache.data = hair.data.copy()
    cache.name = f"{hair.name} (plait)"
    cache.plait.source = hair
    cache.animation_data_clear()
    cache.constraints.clear()
    cache.parent = None
    cache.matrix_world = Matrix.Identity(4)
    for modifier in [m for m in cache.modifiers if _moves_with_surface(m)]:
        cache.modifiers.remove(modifier)
    reader = cache.modifiers.new("plait", "MESH_SEQUENCE_CACHE")
    reader.cache_file, reader.object_path = _open(file), STRANDS
    cache.modifiers.move(len(cache.modifiers) - 1, 0)
    for collection in hair.users_collection:
        collection.objects.link(cache)
    hair.plait.cache = cache
    show(hair, True)
    return cache
