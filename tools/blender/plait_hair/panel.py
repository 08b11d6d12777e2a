"""One panel, in the data properties of a hair curves object."""
import bpy

from . import cache, checks, capi, library, operators, params, properties

WIDTH = 44  # letters of a line of the panel


def _sentence(layout, text, icon="ERROR"):
    """In as many lines as it needs, since Blender cuts a label at the panel's edge."""
    column, line = layout.column(align=True), ""
    for word in text.split():
        if line and len(line) + 1 + len(word) > WIDTH:
            column.label(text=line, icon=icon)
            line, icon = word, "BLANK1"
        else:
            line = f"{line} {word}".strip()
    column.label(text=line, icon=icon)


def answers(context, hair):
    """What keeps a bake from beginning, or ended the last one early."""
    found = checks.problems(context.scene, hair)
    chosen = properties.preferences()
    try:
        library.load(bpy.path.abspath(chosen.library) if chosen else "")
    except capi.Error as error:
        found.append(str(error))
    if hair.plait.answer and hair.plait.answer not in found:
        found.append(hair.plait.answer)
    return found


class PLAIT_PT_hair(bpy.types.Panel):
    bl_label = "Plait: Simulated Hair"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "data"

    @classmethod
    def poll(cls, context):
        return operators.groom(context.object) is not None

    def draw(self, context):
        layout, hair = self.layout, operators.groom(context.object)
        layout.use_property_split = True
        if hair is context.object:
            self._draw_settings(layout, hair)
            for text in answers(context, hair):
                _sentence(layout, text)
        else:
            _sentence(layout, f"This is the cache of '{hair.name}'.", "INFO")
        self._draw_bake(layout, hair)

    def _draw_settings(self, layout, hair):
        settings = hair.plait
        bodies = layout.column()
        bodies.prop(hair.data, "surface")
        bodies.prop(settings, "surface_is_body")
        bodies.prop(settings, "body")
        numbers = layout.column()
        for param in params.TABLE:
            if param.name == "volume_share":
                numbers.prop(settings, "keep_volume")
            row = numbers.row()
            row.enabled = param.name != "volume_share" or settings.keep_volume
            row.prop(settings, param.name)
        rest = layout.column()
        rest.prop(settings, "use_wind")
        rest.prop(settings, "substeps")
        rest.prop(settings, "preroll")

    def _draw_bake(self, layout, hair):
        if operators.progress:
            done, total = operators.progress
            layout.progress(factor=done / total, text=f"{done} of {total} frames; Esc cancels")
            return
        row = layout.row()
        row.operator("plait.bake", icon="PHYSICS")
        if hair.plait.cache is not None:
            shown = cache.is_shown(hair)
            text = "Show the Curves" if shown else "Show the Cache"
            row.operator("plait.show", text=text, icon="HIDE_OFF").shown = not shown


def register():
    bpy.utils.register_class(PLAIT_PT_hair)


def unregister():
    bpy.utils.unregister_class(PLAIT_PT_hair)
