"""Why a bake cannot begin, each reason as one sentence that names object, value and what is allowed."""
import bpy
import numpy

from . import capi, shot

POINTS = (2, 256)  # of a curve: what a strand of plait may have


def of_file():
    if not bpy.data.filepath:
        yield "The .blend has no file yet; save it first: the cache is written beside it."


def of_surface(hair):
    surface = hair.data.surface
    if surface is None:
        yield f"'{hair.name}' has no surface; choose the mesh object that it grows on, under Surface."
    elif surface.type != "MESH":
        yield f"The surface of '{hair.name}' is '{surface.name}', a {surface.type.lower()}; allowed is a mesh object."
    elif not surface.data.polygons:
        yield f"The surface '{surface.name}' has 0 faces; allowed are 1 or more."


def of_scale(hair):
    size = hair.matrix_world.to_scale()
    mirrors = hair.matrix_world.determinant() <= 0
    if mirrors or max(size) - min(size) > 1e-3 * max(size):
        yield (f"'{hair.name}' has the scale {shot.numbers(size)}; allowed are three equal numbers above 0: "
               "apply it (Object > Apply > Scale).")


def of_curves(hair):
    counts = shot.point_counts(hair.data)
    if not len(counts):
        yield f"'{hair.name}' has 0 curves; allowed are 1 or more."
        return
    wrong = numpy.flatnonzero((counts < POINTS[0]) | (counts > POINTS[1]))
    if len(wrong):
        points = counts[wrong[0]]
        yield (f"Curve {wrong[0]} of '{hair.name}' has {points} point{'s' * (points != 1)}; allowed are {POINTS[0]} to "
               f"{POINTS[1]} ({len(wrong)} of {len(counts)} curves have others).")
    cyclic = hair.data.attributes.get("cyclic")
    if cyclic:
        closed = numpy.zeros(len(cyclic.data), bool)
        cyclic.data.foreach_get("value", closed)
        if closed.any():
            yield f"Curve {closed.argmax()} of '{hair.name}' is cyclic; allowed are open curves."


def of_visibility(hair):
    named = [("surface", hair.data.surface)] + [("body", thing) for thing in shot.body_objects(hair.plait)]
    for role, thing in named:
        if thing is not None and not thing.visible_get():
            yield f"The {role} '{thing.name}' is hidden, so Blender does not move it; show it in the viewport."


def of_frames(scene):
    if scene.frame_end <= scene.frame_start:
        yield f"The scene ends with frame {scene.frame_end} and begins with {scene.frame_start}; allowed is an end after that."


def problems(scene, hair):
    """All that can be said without reading meshes: the panel shows them as they are."""
    return [*of_file(), *of_surface(hair), *of_scale(hair), *of_curves(hair), *of_visibility(hair), *of_frames(scene)]


def check_closed(name, mesh):
    """Raises for a body without an inside."""
    for edges, kind in ((mesh.info.open_edges, "open edges"), (mesh.info.unsided_edges, "edges between faces that face two ways")):
        if edges:
            raise capi.Error(f"The body '{name}' has {edges} {kind}; allowed are 0: close the mesh, or take it out of the body.")


FARTHEST = 0.05  # m, of a root from the surface: at more the hair belongs elsewhere


def check_roots(hair, distances, frame):
    worst = distances.argmax()
    if distances[worst] > FARTHEST:
        raise capi.Error(f"The root of curve {worst} of '{hair.name}' is {distances[worst]:.3g} m from the surface "
                         f"'{hair.data.surface.name}' in frame {frame}; allowed are {FARTHEST:g} m. The first point of a curve "
                         "is its root.")
