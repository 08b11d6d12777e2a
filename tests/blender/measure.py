"""How good a bake is: the cache as Blender shows it, beside the body as Blender shows it."""
import bpy
from mathutils import Vector
from mathutils.bvhtree import BVHTree
from mathutils.geometry import barycentric_transform, normal
import numpy


def shown(thing):
    """Points of curves in the world, [curves, points, 3], of equal numbers each."""
    now = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    values = numpy.zeros(3 * len(now.data.points), numpy.float32)
    now.data.position_data.foreach_get("vector", values)
    matrix = numpy.array(now.matrix_world)
    return (values.reshape(len(now.data.curves), -1, 3) @ matrix[:3, :3].T + matrix[:3, 3])


def triangles(thing):
    """Corners of the triangles of a mesh object in the world, [triangles][3]."""
    now = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = now.to_mesh()
    mesh.calc_loop_triangles()
    places = [now.matrix_world @ v.co for v in mesh.vertices]
    corners = [[places[i] for i in t.vertices] for t in mesh.loop_triangles]
    now.to_mesh_clear()
    return corners


def tree_of(corners):
    return BVHTree.FromPolygons([p for t in corners for p in t], [(3 * i, 3 * i + 1, 3 * i + 2) for i in range(len(corners))])


class Places:
    """Where roots are on a surface at rest, found without plait: the nearest triangle, the place on it, the height above it."""

    def __init__(self, roots, corners):
        tree, self._found = tree_of(corners), []
        for root in roots.tolist():
            near, _, triangle, _ = tree.find_nearest(root)
            height = (Vector(root) - near).dot(normal(*corners[triangle]))
            self._found.append((triangle, near, height, corners[triangle]))

    def distances(self, roots, corners):
        """How far roots are from the same places over the surface as it is now."""
        now = [barycentric_transform(near, *rest, *corners[triangle]) + height * normal(*corners[triangle])
               for triangle, near, height, rest in self._found]
        return numpy.linalg.norm(roots - numpy.array(now), axis=1)


def lengths(curves):
    return numpy.linalg.norm(numpy.diff(curves, axis=1), axis=2).sum(1)


def depths(points, corners):
    """How deep each point is inside of a closed body, m; below 0: outside."""
    tree, found = tree_of(corners), []
    for point in points.reshape(-1, 3).tolist():
        near, outward, _, distance = tree.find_nearest(point)
        inside = sum((p - n) * o for p, n, o in zip(point, near, outward)) < 0
        found.append(distance if inside else -distance)
    return numpy.array(found)


def report(scene, surface, hair, bodies=None):
    """The worst over all frames, of the cache of `hair`: (roots, m; lengths, relative; depth in bodies, m)."""
    cache = hair.plait.cache
    hair.hide_viewport = False
    scene.frame_set(scene.frame_start)
    rest_length, worst = lengths(shown(hair)), numpy.zeros(3)
    for frame in range(scene.frame_start, scene.frame_end + 1):
        scene.frame_set(frame)
        curves, corners = shown(cache), triangles(surface)
        if frame == scene.frame_start:
            places = Places(curves[:, 0], corners)
        stretch = abs(lengths(curves) / rest_length - 1).max()
        deep = max(depths(curves[:, 1:], triangles(body)).max() for body in bodies or [surface])
        worst = numpy.maximum(worst, (places.distances(curves[:, 0], corners).max(), stretch, deep))
    hair.hide_viewport = True
    print(f"{scene.frame_end - scene.frame_start + 1} frames: roots off by {worst[0]:.2e} m, lengths by {worst[1]:.2e}, "
          f"deepest {worst[2]:.2e} m")
    return worst
