"""library.py CC: loading libplait, its answers to what cannot be, its table of parameters beside the panel's, and hair that is
simulated and recorded through the mirror of the API alone."""
import array
import ctypes
from ctypes import byref
import math
import os
import subprocess
import sys

from plait_hair import capi, library, params


def refused(call, *words):
    try:
        call()
    except capi.Error as error:
        missing = [word for word in words if word not in str(error)]
        assert not missing, f"{error} lacks {missing}"
        print("refused:", error)
    else:
        raise AssertionError(f"was not refused; expected {words}")


def stub(name, text):
    with open(f"{name}.c", "w") as file:
        file.write(text)
    subprocess.run([sys.argv[1], "-shared", "-fPIC", f"{name}.c", "-o", f"{name}.so"], check=True)
    return os.path.abspath(f"{name}.so")


def check_loading():
    refused(lambda: library.load("/nowhere/libplait.so"), "/nowhere/libplait.so", "0.2.x", "preferences")
    with open("text.so", "w") as file:
        file.write("no library")
    refused(lambda: library.load("text.so"), "text.so", "cannot be loaded")
    refused(lambda: library.load(stub("other", "int other(void) { return 1; }")), "other.so", "is not plait")
    older = stub("older", "unsigned plait_version(void) { return 103; }")
    refused(lambda: library.load(older), "older.so", "0.1.3", "0.2.x")
    api = library.load()
    assert api.version[:2] == capi.VERSION
    assert library.load() is api
    return api


def check_defaults(api):
    for struct in capi.Versioned.__subclasses__():
        assert api.make(struct).struct_size == ctypes.sizeof(struct), struct.NAME
    assert math.isclose(api.make(capi.SimDesc).params.gravity[1], -9.81, rel_tol=1e-6)
    assert api.make(capi.RecorderDesc).frames_per_second == 24


def check_params(api):
    table = api.params()
    near = lambda a, b: math.isclose(a, b, rel_tol=1e-6)
    for param in params.TABLE:
        if param.name in ("friction", "margin"):  # of colliders
            default = getattr(api.make(capi.ColliderMeshDesc), param.name)
            assert near(param.default, default * param.factor), param.name
            continue
        info = table[param.name]
        for name, shown, own in (("least", param.least, info.least), ("most", param.most, info.most),
                                 ("default", param.default, info.default_value[0])):
            assert near(shown, own * param.factor), f"{param.name}: {name} is {shown}, the library's {own} x {param.factor}"
        assert info.least <= param.slider[0] / param.factor < param.slider[1] / param.factor <= info.most
        assert info.models & 2, f"articulated does not read {param.name}"
        values = params.library_values(param, param.default)
        assert len(values) == info.count and near(values[0], info.default_value[0])
        unit = {"nN m²": "N m^2", "mg/m": "kg/m"}.get(param.unit, param.unit)
        assert unit == info.unit.decode(), f"{param.name}: {param.unit} is not {info.unit}"
    assert params.library_values(next(p for p in params.TABLE if p.name == "stiffness_ramp"), 0.25)[3] == 0.25
    print(f"{len(params.TABLE)} parameters")


def check_simulation(api):
    points = array.array("f", [c for s in range(2) for i in range(8) for c in (0.02 * i, 0, 0.05 * s)])
    context = api.create("context", None)
    desc = api.make(capi.GroomDesc, positions=capi.view(points, 12), vertices_per_strand=8)
    groom = api.create("groom", byref(desc), None)
    sim = api.create("sim", context, groom, byref(api.make(capi.SimDesc, step=1 / 24, substeps=4)))
    recorder = api.create("recorder", b"two.abc", byref(api.make(capi.RecorderDesc)))
    for frame in range(12):
        api.call("recorder_add", recorder, sim, frame / 24)
        api.call("sim_step", sim, ctypes.c_float(1 / 24).value)
    assert not os.path.exists("two.abc"), "before it is closed"
    api.call("recorder_close", recorder)
    assert os.path.getsize("two.abc") > 12 * 4 * len(points)
    shown, size = array.array("f", bytes(2 * 8 * 16)), ctypes.c_size_t(2 * 8 * 16)
    api.call("sim_read", sim, capi.POSITION, shown.buffer_info()[0], byref(size))
    tip = shown[4 * 7:4 * 7 + 3]
    assert tip[1] < -0.05 and math.dist(tip, (0, 0, 0)) < 0.1401, tip
    one = (ctypes.c_double * 1)(1e9)
    refused(lambda: api.call("sim_set_param", sim, b"bend_stiffness", one, 1), "bend_stiffness", "1e+09", "1000")
    body = api.make(capi.ColliderMeshDesc, margin=params.TABLE[-1].most / params.TABLE[-1].factor * 1.01)
    refused(lambda: api.call("collider_create_mesh", sim, tetrahedron(api), byref(body), byref(capi.ColliderId())), "margin", "0.05")
    body = api.make(capi.ColliderMeshDesc, friction=10.1)
    refused(lambda: api.call("collider_create_mesh", sim, tetrahedron(api), byref(body), byref(capi.ColliderId())), "friction", "10")
    for noun, handle in (("recorder", recorder), ("sim", sim), ("groom", groom), ("context", context)):
        api.destroy(noun, handle)


def tetrahedron(api):
    corners = array.array("f", [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1])
    faces = array.array("I", [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3])
    desc = api.make(capi.MeshDesc, positions=capi.view(corners, 12), triangles=capi.view(faces, 12))
    return api.create("mesh", byref(desc), None)


loaded = check_loading()
check_defaults(loaded)
check_params(loaded)
check_simulation(loaded)
