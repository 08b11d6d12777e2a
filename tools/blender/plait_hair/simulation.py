"""One groom that moves, in plait's terms: metres, seconds, y up. Knows nothing of Blender."""
import ctypes
from ctypes import byref

import numpy

from . import capi

CELLS = 96  # of a rigid body's grid of distances, along its longest side: 3 mm of a head


def floats(values):
    return numpy.ascontiguousarray(values, numpy.float32)


def pose(matrix):
    """plait_pose of a 4 x 4 matrix that only turns and moves."""
    (a, b, c), (d, e, f), (g, h, i) = (matrix[row][:3] for row in range(3))
    # The quaternion's largest component by the largest of these is the most exact.
    squares = [1 + a - e - i, 1 - a + e - i, 1 - a - e + i, 1 + a + e + i]
    most = squares.index(max(squares))
    q = [[squares[0], b + d, c + g, h - f], [b + d, squares[1], f + h, c - g],
         [c + g, f + h, squares[2], d - b], [h - f, c - g, d - b, squares[3]]][most]
    length = sum(component * component for component in q) ** 0.5
    return capi.Pose((ctypes.c_float * 4)(*(component / length for component in q)),
                     (ctypes.c_float * 3)(*(matrix[row][3] for row in range(3))))


def rigid_fit(before, after):
    """The 4 x 4 matrix that turns and moves the points `before` nearest to `after` (Kabsch 1976)."""
    from_middle, to_middle = before.mean(0), after.mean(0)
    u, _, vt = numpy.linalg.svd((before - from_middle).T.astype(float) @ (after - to_middle))
    mirrored = numpy.sign(numpy.linalg.det(u @ vt))
    matrix = numpy.eye(4)
    matrix[:3, :3] = (u @ numpy.diag([1, 1, mirrored]) @ vt).T
    matrix[:3, 3] = to_middle - matrix[:3, :3] @ from_middle
    return matrix


class Mesh:
    """A plait_mesh. `sources`: for each of its vertices the number of the one it was made of."""

    def __init__(self, api, positions, triangles):
        positions, triangles = floats(positions), numpy.ascontiguousarray(triangles, numpy.uint32)
        desc = api.make(capi.MeshDesc, positions=capi.view(positions, 12), triangles=capi.view(triangles, 12))
        self._api = api
        self.handle = api.create("mesh", byref(desc), None)
        self.info = api.make(capi.MeshInfo)
        api.call("mesh_describe", self.handle, byref(self.info))
        self.sources = numpy.zeros(self.info.vertices, numpy.uint32)
        size = ctypes.c_size_t(self.sources.nbytes)
        api.call("mesh_read", self.handle, capi.SOURCES, self.sources.ctypes.data, byref(size))
        self._rest = positions[self.sources]

    def turned(self, positions):
        """What turns and moves the mesh as a whole to where its vertices came to be, and these seen from there: on the way
        there the mesh turns, as all of it would go along chords."""
        positions = floats(positions)[self.sources]
        matrix = rigid_fit(self._rest, positions)
        return matrix, floats((positions - matrix[:3, 3]) @ matrix[:3, :3])

    def destroy(self):
        self._api.destroy("mesh", self.handle)


class Simulation:
    """Hair on a scalp, among bodies. Made at rest: where groom, scalp and bodies belong together."""

    def __init__(self, api, name, counts, points, step, substeps, gravity=(0, -9.81, 0), device="", kernels=""):
        """`name`: what messages call it; `counts`: points of each strand; `points`: all of them, root first; `step`: s, of a call of `step`."""
        self._api, self._made = api, []
        self.step_seconds = ctypes.c_float(step).value  # exactly one fixed step of the sim
        try:
            context = self._create("context", byref(api.make(
                capi.ContextDesc, device=device.encode() or None, program_folder=str(kernels).encode() or None)))
            counts, points = numpy.ascontiguousarray(counts, numpy.uint32), floats(points)
            groom = self._create("groom", byref(api.make(
                capi.GroomDesc, positions=capi.view(points, 12), vertex_counts=capi.view(counts, 4))), None)
            self._check_repairs(name, groom, len(counts), len(points))
            desc = api.make(capi.SimDesc, step=step, substeps=substeps, interpolate_output=0)
            desc.params.gravity[:] = gravity
            self.handle = self._create("sim", context, groom, byref(desc))
        except BaseException:
            self.destroy()
            raise
        self._counts, self._row = counts, int(counts.max())

    def _create(self, noun, *arguments):
        handle = self._api.create(noun, *arguments)
        self._made.append((noun, handle))
        return handle

    def destroy(self):
        while self._made:
            self._api.destroy(*self._made.pop())

    def _check_repairs(self, name, groom, strands, vertices):
        """Every point of the groom has to be there in the cache, so strands that the library drops are an error."""
        info = self._api.make(capi.GroomInfo)
        self._api.call("groom_describe", groom, byref(info))
        if (info.strands, info.vertices) != (strands, vertices):
            raise capi.Error(f"Not every curve of '{name}' can be simulated: {info.first_repair.decode()}.")

    def set_param(self, name, values):
        self._api.call("sim_set_param", self.handle, name.encode(), (ctypes.c_double * len(values))(*values), len(values))

    def keep_volume(self):
        self._api.call("sim_set_volume", self.handle, byref(self._api.make(capi.VolumeDesc)))

    def set_wind(self, velocity, turbulence, gusts, size, seed):
        """m/s; gusts as a share of the velocity; the size of the largest eddies in m."""
        desc = self._api.make(capi.WindDesc, turbulence=turbulence, gusts=gusts, scale=size, seed=seed)
        desc.velocity[:] = velocity
        self._api.call("sim_set_wind", self.handle, byref(desc))

    def bind(self, positions, triangles):
        """Roots go with this surface from now on; see `place`. Returns how far each was from it, in m."""
        self._scalp = Mesh(self._api, positions, triangles)
        self._made.append(("mesh", self._scalp.handle))
        places = (capi.RootPlace * len(self._counts))()
        self._api.call("sim_bind_roots", self.handle, self._scalp.handle, places, len(places))
        return numpy.array([place.distance for place in places])

    def add_body(self, mesh, friction, margin, bends):
        """A closed Mesh that hair stays out of, at rest. Its name for `move`: (its id, its mesh or None)."""
        desc = self._api.make(capi.ColliderMeshDesc, friction=friction, margin=margin, cells=CELLS,
                              form=capi.NEAREST if bends else capi.FIELD)
        collider = capi.ColliderId()
        self._api.call("collider_create_mesh", self.handle, mesh.handle, byref(desc), byref(collider))
        return collider, mesh if bends else None

    def move(self, body, place):
        """Where a body will be at the end of the next step: vertices of one that bends, else a 4 x 4 matrix from rest."""
        collider, mesh = body
        if mesh is not None:
            place, within = mesh.turned(place)
            self._api.call("collider_set_positions", self.handle, collider, byref(capi.view(within, 12)))
        self._api.call("collider_set_pose", self.handle, collider, byref(pose(place)))

    def place_roots(self, positions, at_once=False):
        """Where the scalp's vertices will be at the end of the next step, or, with hair carried along, are at once."""
        head, within = self._scalp.turned(positions)
        roots = self._api.make(capi.Roots, head=pose(head), mesh_positions=capi.view(within, 12))
        self._api.call("sim_teleport" if at_once else "sim_set_roots", self.handle, byref(roots))

    def step(self):
        self._api.call("sim_step", self.handle, self.step_seconds)

    def positions(self):
        """All points as they are shown, in the order of the groom's: float32 [points, 3]."""
        rows = numpy.empty((len(self._counts), self._row, 4), numpy.float32)
        size = ctypes.c_size_t(rows.nbytes)
        self._api.call("sim_read", self.handle, capi.POSITION, rows.ctypes.data, byref(size))
        return rows[numpy.arange(self._row) < self._counts[:, None], :3]


class Recorder:
    """A file of hair as it moves. One that is destroyed before it is closed leaves none."""

    def __init__(self, api, path, scale, frames_per_second, widths):
        """`scale`: metres to the file's units; `widths`: diameter of each point, m, or of none."""
        self._api = api
        widths = floats(widths)
        desc = api.make(capi.RecorderDesc, scale=scale, frames_per_second=frames_per_second, widths=capi.view(widths, 4))
        self._handle = api.create("recorder", str(path).encode(), byref(desc))

    def add(self, simulation, seconds):
        self._api.call("recorder_add", self._handle, simulation.handle, seconds)

    def close(self):
        self._api.call("recorder_close", self._handle)

    def destroy(self):
        self._api.destroy("recorder", self._handle)
        self._handle = None
