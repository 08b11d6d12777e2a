"""What is kept in the .blend of a hair object, and the add-on's preferences."""
import bpy
from bpy.props import BoolProperty, FloatProperty, IntProperty, PointerProperty, StringProperty

from . import params


def _forget_answer(settings, context):
    settings.answer = ""


class PlaitSettings(bpy.types.PropertyGroup):
    surface_is_body: BoolProperty(name="Surface Is Body", default=True, update=_forget_answer,
                                  description="Hair stays out of the surface that it grows on, which then has to be closed")
    body: PointerProperty(name="Body", type=bpy.types.Collection, update=_forget_answer,
                          description="Hair stays out of the meshes of this collection, which have to be closed")
    use_wind: BoolProperty(name="Wind", default=True,
                           description="Wind and turbulence fields of the scene: a strength of 1 is 1 m/s")
    keep_volume: BoolProperty(name="Keep Volume", default=False,
                              description="Hair keeps the room that it has in the groom, by a pressure")
    substeps: IntProperty(name="Substeps", default=4, min=1, max=1000, soft_max=16,
                          description="Of each frame. More: more exact, less hair inside of bodies, slower")
    preroll: IntProperty(name="Frames to Settle", default=24, min=0, max=10000, soft_max=100,
                         description="Hair hangs still for so many frames before the first one, which it then begins at rest")
    cache: PointerProperty(type=bpy.types.Object)  # of a groom
    source: PointerProperty(type=bpy.types.Object)  # of a cache
    answer: StringProperty()  # why the last bake ended early


for _param in params.TABLE:
    PlaitSettings.__annotations__[_param.name] = FloatProperty(
        name=f"{_param.label} ({_param.unit})" if _param.unit else _param.label, description=_param.text,
        default=_param.default, min=_param.least, max=_param.most, soft_min=_param.slider[0], soft_max=_param.slider[1],
        precision=2)


class PlaitPreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    library: StringProperty(name="Library", subtype="FILE_PATH",
                            description="Path of libplait; empty: the one inside the add-on")
    device: StringProperty(name="Device", description="Words of a device's name, or cpu, or gpu; empty: the best there is")

    def draw(self, context):
        self.layout.prop(self, "library")
        self.layout.prop(self, "device")


def preferences():
    """None where the package was not enabled as an add-on."""
    addon = bpy.context.preferences.addons.get(__package__)
    return addon.preferences if addon else None


classes = (PlaitSettings, PlaitPreferences)


def register():
    for each in classes:
        bpy.utils.register_class(each)
    bpy.types.Object.plait = PointerProperty(type=PlaitSettings)


def unregister():
    del bpy.types.Object.plait
    for each in reversed(classes):
        bpy.utils.unregister_class(each)
