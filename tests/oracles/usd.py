"""usd.py CLIP_POINTS FOLDER: USD finds in a clip what plait recorded, to the bit, and plait finds in what USD writes, as text, with
transforms and units, the points where USD puts them."""
import struct
import sys

import clips

clips.need("pxr")
from pxr import Gf, Usd, UsdGeom  # noqa: E402  # behind the check that it is there

program, folder = sys.argv[1:]


def as_float(value):
    return struct.unpack("f", struct.pack("f", value))[0]


def check_recorded():
    recorded = clips.run(program, "record", f"{folder}/clip.usda")
    stage = Usd.Stage.Open(f"{folder}/clip.usda")
    assert stage.GetStartTimeCode() == 0 and stage.GetEndTimeCode() == len(recorded) - 1
    assert UsdGeom.GetStageMetersPerUnit(stage) == 1 and UsdGeom.GetStageUpAxis(stage) == "Y"
    curves = UsdGeom.BasisCurves(stage.GetPrimAtPath("/hair/strands"))
    times = curves.GetPointsAttr().GetTimeSamples()
    for time, expected in zip(times, recorded):
        found = [c for p in curves.GetPointsAttr().Get(time) for c in p]
        clips.compare(f"time {time}", found, [as_float(c) for c in expected], 0)
    seconds = (times[3] - times[1]) / stage.GetTimeCodesPerSecond()
    velocities = [c for v in curves.GetVelocitiesAttr().Get(times[2]) for c in v]
    expected = [(b - a) / seconds for a, b in zip(recorded[1], recorded[3])]
    clips.compare("velocities", velocities, expected, 1e-4)


def check_written():
    file = f"{folder}/usd.usda"
    stage = Usd.Stage.CreateNew(file)
    UsdGeom.SetStageMetersPerUnit(stage, 0.01)
    UsdGeom.SetStageUpAxis(stage, "Z")
    head = UsdGeom.Xform.Define(stage, "/head")
    head.AddTranslateOp().Set(Gf.Vec3d(1, 2, 3))
    head.AddRotateYZXOp().Set(Gf.Vec3f(30, 40, 50))
    head.AddScaleOp().Set(Gf.Vec3f(2, 3, 4))
    hair = UsdGeom.BasisCurves.Define(stage, "/head/hair")
    points = [(i % 3, 0.5 * i, 2.0 * (i % 4)) for i in range(9)]
    hair.CreateTypeAttr("linear")
    hair.CreateCurveVertexCountsAttr([4, 5])
    hair.CreatePointsAttr(points)
    stage.GetRootLayer().Save()
    to_world = UsdGeom.XformCache().GetLocalToWorldTransform(hair.GetPrim())
    places = [to_world.Transform(Gf.Vec3d(*point)) * 0.01 for point in points]
    expected = [c for p in places for c in (p[0], p[2], -p[1])]
    counts, positions, _ = clips.run(program, "read", file)
    assert counts == [4, 5], counts
    clips.compare("written by USD", positions, expected, 1e-7)


check_recorded()
check_written()
