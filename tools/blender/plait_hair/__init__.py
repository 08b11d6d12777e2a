"""Plait for Blender: hair curves that move. docs/blender.md says how it is used.

rooms: capi, simulation and library know nothing of Blender; shot reads a scene, checks says what it lacks; bake takes one into
the other, cache shows what came of it; properties, operators and panel are the face.
"""


def _rooms():
    from . import operators, panel, properties
    return properties, operators, panel


def register():
    for room in _rooms():
        room.register()


def unregister():
    for room in reversed(_rooms()):
        room.unregister()
