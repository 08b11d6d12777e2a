"""What of plait.h the solvers call, by ctypes. The library is PLAIT_LIBRARY, or libplait.so where the
loader finds it. Structs are filled by the library's own _init; parameters are found by name."""

from __future__ import annotations

import ctypes as c
import os

import numpy as np

ARTICULATED = 1
FIELD_POSITION = 0
FIELD_ACCELERATION = 11
FIELD_PIN = 12


class View(c.Structure):
    _fields_ = [("data", c.c_void_p), ("count", c.c_size_t), ("stride", c.c_size_t)]

    @classmethod
    def of(cls, array: np.ndarray) -> View:
        """One element per row; the array outlives the call."""
        return cls(array.ctypes.data, len(array), 0)


class ParamInfo(c.Structure):
    _fields_ = [
        ("struct_size", c.c_uint32),
        ("kind", c.c_int32),
        ("name", c.c_char_p),
        ("unit", c.c_char_p),
        ("choices", c.c_void_p),
        ("offset", c.c_uint32),
        ("count", c.c_uint32),
        ("least", c.c_double),
        ("most", c.c_double),
        ("least_excluded", c.c_uint32),
        ("models", c.c_uint32),
        ("text", c.c_char_p),
        ("feature", c.c_char_p),
        ("default_value", c.c_double * 3),
        ("slider_least", c.c_double),
        ("slider_most", c.c_double),
        ("slider_log", c.c_uint32),
    ]


class GroomDesc(c.Structure):
    _fields_ = [
        ("struct_size", c.c_uint32),
        ("positions", View),
        ("vertex_counts", View),
        ("vertices_per_strand", c.c_uint32),
        ("strand_uv", View),
        ("thickness", View),
        ("bone_indices", View),
        ("bone_weights", View),
    ]


class Material(c.Structure):
    _fields_ = [
        ("struct_size", c.c_uint32),
        ("line_density", c.c_float),
        ("bend_stiffness", c.c_float),
        ("stretch_stiffness", c.c_float),
        ("twist_stiffness", c.c_float),
        ("section_ratio", c.c_float),
        ("curl", c.c_float),
        ("clamp_stiffness", c.c_float),
        ("stiffness_ramp", c.c_float * 4),
        ("density_ramp", c.c_float * 4),
        ("drag_scale", c.c_float),
        ("friction_scale", c.c_float),
    ]


class SimDescHead(c.Structure):
    """plait_sim_desc up to its parameters."""

    _fields_ = [
        ("struct_size", c.c_uint32),
        ("model", c.c_int32),
        ("step", c.c_float),
        ("substeps", c.c_uint32),
        ("max_steps_per_call", c.c_uint32),
        ("interpolate_output", c.c_uint32),
        ("keep_last_frame", c.c_uint32),
        ("accelerations", c.c_uint32),
        ("pins", c.c_uint32),
    ]


class Error(RuntimeError):
    pass


def _load() -> c.CDLL:
    library = c.CDLL(os.environ.get("PLAIT_LIBRARY", "libplait.so"))
    library.plait_last_error.restype = c.c_char_p
    return library


_library = _load()


def _call(name: str, *arguments) -> None:
    if getattr(_library, name)(*arguments) != 0:
        raise Error(_library.plait_last_error().decode())


def _filled(struct_type: type[c.Structure], name: str) -> c.Structure:
    struct = struct_type()
    getattr(_library, f"{name}_init")(c.byref(struct), c.c_size_t(c.sizeof(struct)))
    return struct


# Longer than any struct of plait.h: the library takes what is zero beyond its own.
_LONG = 4096


class _SimDesc(SimDescHead):
    _fields_ = [("rest", c.c_ubyte * (_LONG - c.sizeof(SimDescHead)))]


class _Params:
    """plait_sim_params, whose fields the library lists by name."""

    def __init__(self, sim: c.c_void_p) -> None:
        self.bytes = (c.c_ubyte * _LONG)()
        c.cast(self.bytes, c.POINTER(c.c_uint32))[0] = _LONG
        _call("plait_sim_get_params", sim, self.bytes)
        count = c.c_size_t(256)
        infos = (ParamInfo * count.value)()
        for info in infos:
            info.struct_size = c.sizeof(ParamInfo)
        _call("plait_params_list", infos, c.byref(count))
        self.fields = {info.name.decode(): info for info in infos[: count.value]}

    def set(self, name: str, value) -> None:
        info = self.fields[name]
        number = c.c_float if info.kind == 0 else c.c_uint32
        values = (number * info.count).from_buffer(self.bytes, info.offset)
        values[:] = np.broadcast_to(value, info.count).tolist()


class Pin(c.Structure):
    _fields_ = [
        ("strand", c.c_uint32),
        ("vertex", c.c_uint32),
        ("frame", c.c_int32),
        ("target", c.c_float * 3),
        ("stiffness", c.c_float),
    ]


PIN_FRAME_WORLD = 2
PIN_HELD = 1e6  # N/m


class Strand:
    """One strand on the best device there is, held at its root."""

    def __init__(self, points: np.ndarray, step: float, substeps: int) -> None:
        self._context, self._groom, self._sim = c.c_void_p(), c.c_void_p(), c.c_void_p()
        _call("plait_context_create", None, c.byref(self._context))
        groom = _filled(GroomDesc, "plait_groom_desc")
        positions = np.ascontiguousarray(points, dtype=np.float32)
        groom.positions = View.of(positions)
        groom.vertices_per_strand = len(positions)
        _call("plait_groom_create", c.byref(groom), None, c.byref(self._groom))
        desc = _filled(_SimDesc, "plait_sim_desc")
        desc.model = ARTICULATED
        desc.step = step
        desc.substeps = substeps
        desc.max_steps_per_call = 1000
        desc.accelerations = desc.pins = 1
        _call("plait_sim_create", self._context, self._groom, c.byref(desc), c.byref(self._sim))
        self._vertices = len(positions)
        self._step = step

    def close(self) -> None:
        _library.plait_sim_destroy(self._sim)
        _library.plait_groom_destroy(self._groom)
        _library.plait_context_destroy(self._context)

    def set_params(self, **values) -> None:
        params = _Params(self._sim)
        for name, value in values.items():
            params.set(name, value)
        _call("plait_sim_set_params", self._sim, params.bytes)

    def set_material(self, **values) -> None:
        material = _filled(Material, "plait_material")
        for name, value in values.items():
            setattr(material, name, value)
        _call("plait_sim_set_materials", self._sim, c.byref(material), c.c_size_t(1), View())

    def pin(self, vertex: int, target: np.ndarray) -> None:
        """Held at `target`, m."""
        pin = Pin(0, vertex, PIN_FRAME_WORLD, (c.c_float * 3)(*target), PIN_HELD)
        _call("plait_sim_set_pins", self._sim, c.byref(pin), c.c_size_t(1))

    def accelerate(self, vertex: int, acceleration: np.ndarray) -> None:
        """One vertex, m/s^2: a point load over the vertex' mass."""
        values = np.zeros((self._vertices, 4), dtype=np.float32)
        values[vertex, :3] = acceleration
        _call("plait_sim_write", self._sim, FIELD_ACCELERATION, values.ctypes.data_as(c.c_void_p),
              c.c_size_t(values.nbytes))

    def advance(self, steps: int) -> None:
        for _ in range(steps):
            _call("plait_sim_step", self._sim, c.c_double(self._step))

    def positions(self) -> np.ndarray:
        values = np.empty((self._vertices, 4), dtype=np.float32)
        size = c.c_size_t(values.nbytes)
        _call("plait_sim_read", self._sim, FIELD_POSITION, values.ctypes.data_as(c.c_void_p),
              c.byref(size))
        return values[:, :3].astype(float)


def version() -> str:
    packed = _library.plait_version()
    return f"{packed // 10000}.{packed // 100 % 100}.{packed % 100}"
