"""Bake, and show the cache or the curves."""
import time

import bpy

from . import bake, cache, capi, library, properties

TURN = 0.05  # s of baking between two looks at the keyboard

progress = None  # (frames done, of all) of the bake that runs, for the panel


def _kernels():
    """A folder of the user's for built kernels, where the add-on is an extension, which may have one."""
    try:
        return bpy.utils.extension_path_user(__package__, path="kernels", create=True)
    except (AttributeError, ValueError):
        return ""


def groom(thing):
    """The groom, also of a cache; None of what is no hair."""
    if thing is None or thing.type != "CURVES":
        return None
    return thing.plait.source or thing


def _begin(context, hair):
    """The bake of this hair, as a generator."""
    chosen = properties.preferences()
    api = library.load(bpy.path.abspath(chosen.library) if chosen else "")
    return bake.bake(api, context.scene, hair, chosen.device if chosen else "", _kernels())


class PLAIT_OT_bake(bpy.types.Operator):
    """Simulate the scene's frames and show the result in place of the curves; Esc cancels"""
    bl_idname = "plait.bake"
    bl_label = "Bake"

    @classmethod
    def poll(cls, context):
        return progress is None and groom(context.object) is not None

    def _advance(self, seconds):
        """Bakes for so long; True at the end."""
        global progress
        until = time.monotonic() + seconds
        try:
            for progress in self._frames:
                if time.monotonic() > until:
                    return False
        except BaseException:
            progress = None
            raise
        return True

    def _end(self, answer=""):
        global progress
        progress = None
        self._hair.plait.answer = answer
        if answer:
            self.report({"ERROR"}, answer)
            return {"CANCELLED"}
        return {"FINISHED"}

    def execute(self, context):
        self._hair = groom(context.object)
        try:
            self._frames = _begin(context, self._hair)
            self._advance(float("inf"))
        except capi.Error as error:
            return self._end(str(error))
        return self._end()

    def invoke(self, context, event):
        self._hair, self._timer = groom(context.object), None
        try:
            self._frames = _begin(context, self._hair)
            self._advance(0)
        except capi.Error as error:
            return self._end(str(error))
        self._timer = context.window_manager.event_timer_add(0.01, window=context.window)
        context.window_manager.modal_handler_add(self)
        context.window_manager.progress_begin(0, 1)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        """Other events are kept from Blender: what they change could be what is read."""
        if event.type == "ESC":
            self.cancel(context)
            return self._end("The bake was cancelled.")
        if event.type != "TIMER":
            return {"RUNNING_MODAL"}
        try:
            done = self._advance(TURN)
        except capi.Error as error:
            self.cancel(context)
            return self._end(str(error))
        self._show_progress(context)
        if not done:
            return {"RUNNING_MODAL"}
        self.cancel(context)
        return self._end()

    def _show_progress(self, context):
        context.window_manager.progress_update(progress[0] / progress[1])
        for area in context.screen.areas:
            if area.type == "PROPERTIES":
                area.tag_redraw()

    def cancel(self, context):
        """Also called by Blender, where it closes meanwhile."""
        global progress
        progress = None
        self._frames.close()
        if self._timer:
            context.window_manager.event_timer_remove(self._timer)
            context.window_manager.progress_end()
            self._timer = None


class PLAIT_OT_show(bpy.types.Operator):
    """The baked cache in place of the curves, or the curves again"""
    bl_idname = "plait.show"
    bl_label = "Show the Cache"

    shown: bpy.props.BoolProperty(default=True)

    @classmethod
    def poll(cls, context):
        hair = groom(context.object)
        return progress is None and hair is not None and hair.plait.cache is not None

    def execute(self, context):
        hair = groom(context.object)
        cache.show(hair, self.shown)
        return {"FINISHED"}


classes = (PLAIT_OT_bake, PLAIT_OT_show)


def register():
    for each in classes:
        bpy.utils.register_class(each)


def unregister():
    for each in reversed(classes):
        bpy.utils.unregister_class(each)
