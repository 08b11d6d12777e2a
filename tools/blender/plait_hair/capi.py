"""libplait by ctypes: those structs and calls of plait.h that the add-on uses. Knows nothing of Blender.

A struct has the fields of its namesake in the header, in order. tests/blender/layout.py compares sizes and offsets with a C
compiler's; the library's own _init sets the defaults.
"""
import ctypes
from ctypes import POINTER, byref, c_char, c_char_p, c_double, c_float, c_int, c_size_t, c_uint32, c_uint64, c_void_p
import os

# The minor version that the structs below are of: before 1.0 another one may have other structs.
VERSION = (0, 2)


class Error(Exception):
    """A call that failed, or a library that cannot be used; the message is a sentence."""


class View(ctypes.Structure):
    NAME = "plait_view"
    _fields_ = [("data", c_void_p), ("count", c_size_t), ("stride", c_size_t)]


class Pose(ctypes.Structure):
    NAME = "plait_pose"
    _fields_ = [("q", c_float * 4), ("t", c_float * 3)]


class Allocator(ctypes.Structure):
    NAME = "plait_allocator"
    _fields_ = [("allocate", c_void_p), ("release", c_void_p), ("user", c_void_p)]


class Versioned(ctypes.Structure):
    """A struct that begins with struct_size. Made by Api.make, which lets the library set the defaults."""


class ContextDesc(Versioned):
    NAME = "plait_context_desc"
    _fields_ = [("struct_size", c_uint32), ("backend", c_char_p), ("device", c_char_p), ("log", c_void_p),
                ("log_user", c_void_p), ("allocator", Allocator), ("profile", c_uint32), ("stage_sources", c_void_p),
                ("stage_source_count", c_size_t), ("lanes", c_uint32), ("program_folder", c_char_p)]


class GroomDesc(Versioned):
    NAME = "plait_groom_desc"
    _fields_ = [("struct_size", c_uint32), ("positions", View), ("vertex_counts", View), ("vertices_per_strand", c_uint32),
                ("strand_uv", View), ("thickness", View), ("bone_indices", View), ("bone_weights", View)]


class GroomInfo(Versioned):
    NAME = "plait_groom_info"
    _fields_ = [("struct_size", c_uint32), ("strands", c_uint64), ("vertices", c_uint64), ("min_vertices", c_uint32),
                ("max_vertices", c_uint32), ("has_strand_uv", c_uint32), ("has_thickness", c_uint32), ("bones", c_uint32),
                ("bounds_min", c_float * 3), ("bounds_max", c_float * 3), ("min_length", c_float),
                ("mean_length", c_float), ("max_length", c_float), ("likely_scale", c_float), ("repairs", c_uint64 * 6),
                ("repairs_total", c_uint64), ("first_repair", c_char * 192), ("roots_contradicted", c_uint64),
                ("thickness_unlikely", c_uint64), ("warning", c_char * 512)]


class SimParams(Versioned):
    NAME = "plait_sim_params"
    _fields_ = [("struct_size", c_uint32), ("gravity", c_float * 3), ("follow_contact", c_uint32),
                ("tip_separation", c_float), ("follow_form", c_int), ("drag", c_float), ("air_with_head", c_float),
                ("groom", c_float), ("iterations", c_uint32), ("bdf2", c_uint32)]


class SimDesc(Versioned):
    NAME = "plait_sim_desc"
    _fields_ = [("struct_size", c_uint32), ("model", c_int), ("step", c_float), ("substeps", c_uint32),
                ("max_steps_per_call", c_uint32), ("interpolate_output", c_uint32), ("keep_last_frame", c_uint32),
                ("follows_per_guide", c_uint32), ("follow_radius", c_float), ("seed", c_uint64), ("follow_map", c_void_p),
                ("strand_stiffness", View), ("materials", c_void_p), ("material_count", c_size_t),
                ("strand_material", View), ("sag_free", c_int), ("params", SimParams), ("levels", c_void_p),
                ("level_top", c_uint32)]


class Roots(Versioned):
    NAME = "plait_roots"
    _fields_ = [("struct_size", c_uint32), ("head", Pose), ("root_poses", View), ("bones", View),
                ("mesh_positions", View), ("scale", c_float)]


class MeshDesc(Versioned):
    NAME = "plait_mesh_desc"
    _fields_ = [("struct_size", c_uint32), ("positions", View), ("triangles", View), ("bone_indices", View),
                ("bone_weights", View)]


class MeshInfo(Versioned):
    NAME = "plait_mesh_info"
    _fields_ = [("struct_size", c_uint32), ("vertices", c_uint64), ("triangles", c_uint64), ("open_edges", c_uint64),
                ("unsided_edges", c_uint64), ("components", c_uint32), ("bounds_min", c_float * 3),
                ("bounds_max", c_float * 3), ("volume", c_double), ("area", c_double), ("repairs", c_uint64 * 5),
                ("repairs_total", c_uint64), ("first_repair", c_char * 192), ("bones", c_uint32)]


FIELD, NEAREST = 0, 1  # plait_mesh_form


class ColliderMeshDesc(Versioned):
    NAME = "plait_collider_mesh_desc"
    _fields_ = [("struct_size", c_uint32), ("cells", c_uint32), ("margin", c_float), ("friction", c_float),
                ("clearance", c_uint32), ("two_sided", c_uint32), ("pose", Pose), ("form", c_int)]


class ColliderId(ctypes.Structure):
    NAME = "plait_collider_id"
    _fields_ = [("value", c_uint64)]


class RootPlace(ctypes.Structure):
    NAME = "plait_root_place"
    _fields_ = [("triangle", c_uint32), ("weights", c_float * 3), ("height", c_float), ("distance", c_float)]


class WindDesc(Versioned):
    NAME = "plait_wind_desc"
    _fields_ = [("struct_size", c_uint32), ("velocity", c_float * 3), ("turbulence", c_float), ("scale", c_float),
                ("octaves", c_uint32), ("gain", c_float), ("gusts", c_float), ("gust_period", c_float), ("seed", c_uint32),
                ("tangential", c_float), ("diameter", c_float), ("air_density", c_float), ("viscosity", c_float),
                ("shelter", c_uint32), ("hairs_per_strand", c_float)]


class VolumeDesc(Versioned):
    NAME = "plait_volume_desc"
    _fields_ = [("struct_size", c_uint32), ("share", c_float), ("sweeps", c_uint32), ("rate", c_float),
                ("viscosity", c_float), ("cohesion", c_float)]


class RecorderDesc(Versioned):
    NAME = "plait_recorder_desc"
    _fields_ = [("struct_size", c_uint32), ("strands", c_int), ("velocities", c_uint32), ("axes", c_int),
                ("scale", c_float), ("frames_per_second", c_double), ("widths", View), ("strand_uv", View),
                ("allocator", Allocator)]


class ParamInfo(Versioned):
    NAME = "plait_param_info"
    _fields_ = [("struct_size", c_uint32), ("kind", c_int), ("name", c_char_p), ("unit", c_char_p),
                ("choices", POINTER(c_char_p)), ("offset", c_uint32), ("count", c_uint32), ("least", c_double),
                ("most", c_double), ("least_excluded", c_uint32), ("models", c_uint32), ("text", c_char_p),
                ("feature", c_char_p), ("default_value", c_double * 3), ("slider_least", c_double),
                ("slider_most", c_double), ("slider_log", c_uint32)]


PLAIN = (View, Pose, Allocator, ColliderId, RootPlace)

SOURCES = 2  # plait_mesh_field
POSITION = 0  # plait_field

_HANDLE = c_void_p
_OUT = POINTER(c_void_p)

# Every call that returns a plait_result, and its parameters.
CALLS = {
    "plait_context_create": [POINTER(ContextDesc), _OUT],
    "plait_groom_create": [POINTER(GroomDesc), c_void_p, _OUT],
    "plait_groom_describe": [_HANDLE, POINTER(GroomInfo)],
    "plait_mesh_create": [POINTER(MeshDesc), c_void_p, _OUT],
    "plait_mesh_describe": [_HANDLE, POINTER(MeshInfo)],
    "plait_mesh_read": [_HANDLE, c_int, c_void_p, POINTER(c_size_t)],
    "plait_sim_create": [_HANDLE, _HANDLE, POINTER(SimDesc), _OUT],
    "plait_sim_set_param": [_HANDLE, c_char_p, POINTER(c_double), c_size_t],
    "plait_sim_set_wind": [_HANDLE, POINTER(WindDesc)],
    "plait_sim_set_volume": [_HANDLE, POINTER(VolumeDesc)],
    "plait_sim_bind_roots": [_HANDLE, _HANDLE, POINTER(RootPlace), c_size_t],
    "plait_sim_set_roots": [_HANDLE, POINTER(Roots)],
    "plait_sim_teleport": [_HANDLE, POINTER(Roots)],
    "plait_sim_step": [_HANDLE, c_double],
    "plait_sim_read": [_HANDLE, c_int, c_void_p, POINTER(c_size_t)],
    "plait_collider_create_mesh": [_HANDLE, _HANDLE, POINTER(ColliderMeshDesc), POINTER(ColliderId)],
    "plait_collider_set_pose": [_HANDLE, ColliderId, POINTER(Pose)],
    "plait_collider_set_positions": [_HANDLE, ColliderId, POINTER(View)],
    "plait_recorder_create": [c_char_p, POINTER(RecorderDesc), _OUT],
    "plait_recorder_add": [_HANDLE, _HANDLE, c_double],
    "plait_recorder_close": [_HANDLE],
    "plait_params_list": [POINTER(ParamInfo), POINTER(c_size_t)],
}
DESTROYED = ("context", "groom", "mesh", "sim", "recorder")


def view(data, element_bytes):
    """A plait_view of packed elements in a writable buffer (an array of numpy or of the array module), which the caller
    keeps until the call it is for has returned."""
    size = memoryview(data).nbytes
    if size == 0:
        return View(None, 0, 0)
    return View(ctypes.addressof(c_char.from_buffer(data)), size // element_bytes, 0)


class Api:
    """A library that is loaded and of the right version. `call` and `make` do the rest."""

    def __init__(self, path):
        try:
            self._library = ctypes.CDLL(os.fspath(path))
        except OSError as error:
            raise Error(f"The library {path} cannot be loaded: {error}.") from None
        try:
            self._library.plait_version.restype = c_uint32
            number = self._library.plait_version()
        except AttributeError:
            raise Error(f"The library {path} is not plait: it has no function plait_version.") from None
        version = (number // 10000, number // 100 % 100, number % 100)
        if version[:2] != VERSION:
            raise Error("The library {} is of version {}.{}.{}; allowed is {}.{}.x.".format(path, *version, *VERSION))
        self.path, self.version = path, version
        self._library.plait_last_error.restype = c_char_p
        for name, parameters in CALLS.items():
            function = getattr(self._library, name)
            function.argtypes, function.restype = parameters, c_int
        for noun in DESTROYED:
            function = getattr(self._library, f"plait_{noun}_destroy")
            function.argtypes, function.restype = [c_void_p], None

    def call(self, name, *arguments):
        """Calls plait_<name>; raises Error with the library's sentence where it fails."""
        if getattr(self._library, f"plait_{name}")(*arguments):
            raise Error(self._library.plait_last_error().decode("utf-8", "replace"))

    def make(self, struct, **fields):
        """A struct with the library's defaults, then these fields."""
        value = struct()
        initialise = getattr(self._library, f"{struct.NAME}_init")
        initialise.argtypes, initialise.restype = [c_void_p, c_size_t], None
        initialise(byref(value), ctypes.sizeof(value))
        for name, field in fields.items():
            setattr(value, name, field)
        return value

    def create(self, noun, *arguments):
        """Calls plait_<noun>_create with these arguments and a place for its handle."""
        handle = c_void_p()
        self.call(f"{noun}_create", *arguments, byref(handle))
        return handle

    def destroy(self, noun, handle):
        getattr(self._library, f"plait_{noun}_destroy")(handle)

    def params(self):
        """The library's table of parameters, by name."""
        count = c_size_t()
        self.call("params_list", None, byref(count))
        table = (ParamInfo * count.value)()
        for info in table:
            info.struct_size = ctypes.sizeof(ParamInfo)
        self.call("params_list", table, byref(count))
        return {info.name.decode(): info for info in table}
