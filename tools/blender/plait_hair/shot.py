"""What a bake reads of Blender's scene: curves, surface, bodies, wind and gravity, in plait's metres with y up."""
import bpy
from mathutils import Matrix
from mathutils.bvhtree import BVHTree
import numpy

from . import capi

# Modifiers that give a mesh the same shape in every frame.
STATIC = {"BEVEL", "BOOLEAN", "DATA_TRANSFER", "DECIMATE", "EDGE_SPLIT", "MASK", "MIRROR", "MULTIRES", "NORMAL_EDIT", "REMESH",
          "SCREW", "SKIN", "SOLIDIFY", "SUBSURF", "TRIANGULATE", "UV_PROJECT", "UV_WARP", "WELD", "WEIGHTED_NORMAL",
          "WIREFRAME"}


def metres(scene):
    """Of a unit of the scene."""
    return scene.unit_settings.scale_length


def to_plait(scene):
    """The 4 x 4 matrix from Blender's world to plait's."""
    return Matrix.Scale(metres(scene), 4) @ Matrix(((1, 0, 0, 0), (0, 0, 1, 0), (0, -1, 0, 0), (0, 0, 0, 1)))


def turned(vector):
    """A direction of Blender's world in plait's."""
    return (vector[0], vector[2], -vector[1])


def transformed(matrix, points):
    matrix = numpy.array(matrix)
    return numpy.ascontiguousarray(points @ matrix[:3, :3].T + matrix[:3, 3], numpy.float32)


def frame_seconds(scene):
    return scene.render.fps_base / scene.render.fps


def point_counts(curves):
    if not curves.curves:
        return numpy.zeros(0, numpy.int32)
    offsets = numpy.zeros(len(curves.curves) + 1, numpy.int32)
    curves.curve_offset_data.foreach_get("value", offsets)
    return numpy.diff(offsets)


def points(curves):
    values = numpy.zeros(3 * len(curves.points), numpy.float32)
    curves.position_data.foreach_get("vector", values)
    return values.reshape(-1, 3)


def radii(curves):
    """Of each point; none where curves have none of their own."""
    own = curves.attributes.get("radius")
    values = numpy.zeros(len(own.data) if own else 0, numpy.float32)
    if own:
        own.data.foreach_get("value", values)
    return values


def vertices(mesh):
    values = numpy.zeros(3 * len(mesh.vertices), numpy.float32)
    mesh.vertices.foreach_get("co", values)
    return values.reshape(-1, 3)


def triangles(mesh):
    values = numpy.zeros(3 * len(mesh.loop_triangles), numpy.int32)
    mesh.loop_triangles.foreach_get("vertices", values)
    return values.reshape(-1, 3)


def bends(thing):
    """Whether a mesh object may have another shape in another frame."""
    return (thing.data.shape_keys is not None or thing.parent_type in {"ARMATURE", "LATTICE"}
            or any(modifier.show_viewport and modifier.type not in STATIC for modifier in thing.modifiers))


def evaluated(thing):
    """Vertices in the object's own space and triangles, as the present frame has them."""
    now = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = now.to_mesh()
    try:
        mesh.calc_loop_triangles()
        return vertices(mesh), triangles(mesh)
    finally:
        now.to_mesh_clear()


def at_rest(scene, thing):
    """As `evaluated`, of the object without shape keys and without what bends it."""
    copy = thing.copy()
    try:
        copy.parent_type = "OBJECT"
        for modifier in list(copy.modifiers):
            if modifier.type not in STATIC:
                copy.modifiers.remove(modifier)
        copy.show_only_shape_key, copy.active_shape_key_index = True, 0
        copy.hide_viewport = False
        scene.collection.objects.link(copy)
        return evaluated(copy)
    finally:
        bpy.data.objects.remove(copy)


def root_distances(places, mesh):
    """How far each of the points is from a mesh of vertices and triangles."""
    tree = BVHTree.FromPolygons(mesh[0].tolist(), mesh[1].tolist())
    return numpy.array([tree.find_nearest(place)[3] for place in places.tolist()])


class Body:
    """A mesh object. Where hair, scalp and bodies belong together it has the vertices `rest`, in plait's world."""

    def __init__(self, scene, thing):
        self.object, self.name = thing, thing.name
        self.bends = bends(thing)
        self._to_plait = to_plait(scene)
        self._size = thing.matrix_world.to_scale()
        self._first = self._to_plait @ thing.matrix_world
        shown, self.triangles = evaluated(thing)
        self.shown = self.rest = transformed(self._first, shown)
        if self.bends:
            rest, rest_triangles = at_rest(scene, thing)
            if numpy.array_equal(rest_triangles, self.triangles):
                self.rest = transformed(self._first, rest)

    def _now(self, frame):
        now = self.object.evaluated_get(bpy.context.evaluated_depsgraph_get()).matrix_world
        size = now.to_scale()
        if any(abs(a - b) > 1e-3 * abs(b) for a, b in zip(size, self._size)):
            raise capi.Error(f"'{self.name}' has the scale {numbers(size)} in frame {frame} and {numbers(self._size)} in the "
                             "first; allowed is one that stays.")
        return self._to_plait @ now

    def positions(self, frame):
        """Its vertices now."""
        matrix = self._now(frame)
        found, _ = evaluated(self.object)
        if len(found) != len(self.rest):
            raise capi.Error(f"'{self.name}' has {len(found)} vertices in frame {frame} and {len(self.rest)} at rest; "
                             "allowed are modifiers that keep their number.")
        return transformed(matrix, found)

    def place(self, frame):
        """Where it is now, for Simulation.move: its vertices, or a matrix from rest."""
        return self.positions(frame) if self.bends else self._now(frame) @ self._first.inverted()


def numbers(values):
    return "(" + ", ".join(f"{value:.4g}" for value in values) + ")"


class Shot:
    """The scene at its first frame, and what moves in it in those that follow."""

    def __init__(self, scene, hair):
        settings, curves = hair.plait, hair.data
        self.scene = scene
        self.counts = point_counts(curves)
        self.points = transformed(to_plait(scene) @ hair.matrix_world, points(curves))
        self.widths = 2 * metres(scene) * hair.matrix_world.median_scale * radii(curves)
        self.surface = Body(scene, curves.surface)
        self._choose_rest()
        self.bodies = [self.surface] if settings.surface_is_body else []
        self.bodies += [Body(scene, thing) for thing in body_objects(settings) if thing != curves.surface]

    def _choose_rest(self):
        """The groom belongs to the surface at rest, or as the first frame shows it: to that which its roots are nearer."""
        roots = self.points[numpy.cumsum(self.counts) - self.counts]
        self.root_distances = root_distances(roots, (self.surface.rest, self.surface.triangles))
        if self.surface.rest is not self.surface.shown:
            shown = root_distances(roots, (self.surface.shown, self.surface.triangles))
            if shown.mean() < self.root_distances.mean():
                self.surface.rest, self.root_distances = self.surface.shown, shown


def body_objects(settings):
    """The meshes of the body's collection."""
    return [thing for thing in settings.body.all_objects if thing.type == "MESH"] if settings.body else []


def gravity(scene):
    """m/s^2"""
    return turned(scene.gravity) if scene.use_gravity else (0, 0, 0)


def wind(scene):
    """What the wind and turbulence fields of the scene add up to in this frame, for Simulation.set_wind; None without any.
    A strength of 1 is a wind of 1 m/s along the field's z axis; its noise is the share by which gusts change it. The
    strength of a turbulence field is that of its eddies, in m/s, its size theirs."""
    velocity, eddies, gusts, size, seed, found = numpy.zeros(3), 0.0, 0.0, 0.0, 0, False
    graph = bpy.context.evaluated_depsgraph_get()
    for thing in scene.objects:
        if thing.field is None or thing.field.type not in {"WIND", "TURBULENCE"} or not thing.visible_get():
            continue
        now = thing.evaluated_get(graph)
        field, found = now.field, True
        seed = seed or field.seed
        if field.type == "WIND":
            along = now.matrix_world.to_3x3().col[2].normalized()
            velocity += field.strength * numpy.array(turned(along))
            gusts = max(gusts, field.noise)
        else:
            eddies = float(numpy.hypot(eddies, field.strength))
            size = max(size, field.size * metres(scene))
    if not found:
        return None
    return {"velocity": velocity, "turbulence": eddies, "gusts": min(gusts, 2), "size": size or 0.5, "seed": seed}
