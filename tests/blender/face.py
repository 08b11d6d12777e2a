"""The panel and the bake that runs while Blender is used, with stand-ins for the window that a test has not: every property, icon
and operator that the panel names is one, and Esc ends a bake."""
import os
from types import SimpleNamespace

import bpy

import blender
import characters
from plait_hair import operators, panel, params


class Layout:
    """Notes what is drawn, and refuses what Blender would."""
    icons = bpy.types.UILayout.bl_rna.functions["label"].parameters["icon"].enum_items

    def __init__(self, seen):
        self.seen, self.enabled = seen, True

    def row(self, **_):
        return Layout(self.seen)

    column = row

    def label(self, text="", icon="NONE"):
        assert icon in self.icons and len(text) <= panel.WIDTH, text
        self.seen.append(text)

    def prop(self, data, name):
        assert name in data.bl_rna.properties or name in data.bl_rna.base.properties, name
        self.seen.append(name)

    def progress(self, factor, text):
        assert 0 <= factor <= 1
        self.seen.append(text)

    def operator(self, name, text="", icon="NONE"):
        room, verb = name.split(".")
        assert icon in self.icons and hasattr(bpy.types, f"{room.upper()}_OT_{verb}"), (name, icon)
        self.seen.append(text or name)
        return SimpleNamespace()


def stand_in(kind, **attributes):
    """An object with the methods of a registered class, which Blender alone makes objects of."""
    methods = {name: value for name, value in vars(kind).items() if callable(value) and not name.startswith("__")}
    return type(kind.__name__, (), methods | attributes)()


def drawn(thing):
    seen = []
    context = SimpleNamespace(object=thing, scene=bpy.context.scene)
    assert panel.PLAIT_PT_hair.poll(context)
    stand_in(panel.PLAIT_PT_hair, layout=Layout(seen)).draw(context)
    return seen


class Window:
    """A context with a window manager."""

    def __init__(self, thing):
        self.object, self.scene, self.window = thing, bpy.context.scene, None
        self.screen, self.window_manager, self.calls = SimpleNamespace(areas=[]), self, []

    def __getattr__(self, name):
        return lambda *arguments, **_: self.calls.append(name) or name


def bake_in(window):
    """Invokes; the operator, and a function that gives it an event."""
    said = []
    operator = stand_in(operators.PLAIT_OT_bake)
    operator.report, operator.said = lambda kind, text: said.append(text), said
    result = operator.invoke(window, None)
    return operator, result, lambda kind: operator.modal(window, SimpleNamespace(type=kind))


def the_panel_has_all_that_matters():
    body, hair = characters.turning_character(20)
    blender.save("face.blend")
    seen = drawn(hair)
    assert [p.name for p in params.TABLE if p.name not in seen] == [] and len(params.TABLE) == 10
    assert {"surface", "body", "use_wind", "substeps", "plait.bake"} <= set(seen) and "Show the Cache" not in seen
    hair.data.surface = None
    assert "'hair' has no surface; choose the mesh" in drawn(hair)
    hair.data.surface = body


def a_bake_ends_by_itself():
    window = Window(bpy.data.objects["hair"])
    operator, result, event = bake_in(window)
    assert result == {"RUNNING_MODAL"} and not operators.PLAIT_OT_bake.poll(window), "one at a time"
    assert event("LEFTMOUSE") == {"RUNNING_MODAL"}
    while (result := event("TIMER")) == {"RUNNING_MODAL"}:
        assert any("Esc cancels" in text for text in drawn(window.object))
    assert result == {"FINISHED"} and os.path.isfile("face_hair.abc") and not operator.said
    assert window.calls.count("event_timer_add") == window.calls.count("event_timer_remove") == 1
    assert operators.progress is None and operators.PLAIT_OT_bake.poll(window)
    assert "Show the Curves" in drawn(window.object) and "This is the cache of 'hair'." in drawn(window.object.plait.cache)


def escape_ends_it():
    os.remove("face_hair.abc")
    window = Window(bpy.data.objects["hair"])
    files = set(os.listdir())
    operator, _, event = bake_in(window)
    while operators.progress[0] < 40:
        assert event("TIMER") == {"RUNNING_MODAL"}
    assert set(os.listdir()) != files, "it is under way"
    assert event("ESC") == {"CANCELLED"} and operator.said == ["The bake was cancelled."]
    assert set(os.listdir()) == files and operators.progress is None
    assert window.calls.count("event_timer_remove") == 1


def what_goes_wrong_midway_is_said():
    hair, body = bpy.data.objects["hair"], bpy.data.objects["body"]
    files = set(os.listdir())
    for frame, size in ((20, 1), (21, 1.1)):
        body.scale = (size, size, size)
        body.keyframe_insert("scale", frame=frame)
    window = Window(hair)
    operator, _, event = bake_in(window)
    while (result := event("TIMER")) == {"RUNNING_MODAL"}:
        pass
    assert result == {"CANCELLED"} and "in frame 21" in operator.said[0] and hair.plait.answer == operator.said[0]
    assert set(os.listdir()) == files and operators.progress is None


blender.run(the_panel_has_all_that_matters, a_bake_ends_by_itself, escape_ends_it, what_goes_wrong_midway_is_said)
