"""The zip as Blender installs it: enabled, disabled, enabled again; a bake with its own library, and with that of the
preferences."""
import os
import sys

import bpy

import characters

sys.modules.pop("plait_hair", None)  # that beside this test is not what is installed
NAME = "bl_ext.user_default.plait_hair"


def registered():
    return hasattr(bpy.types.Object, "plait"), hasattr(bpy.types, "PLAIT_PT_hair"), hasattr(bpy.types, "PLAIT_OT_bake")


def it_is_installed_and_bakes():
    import addon_utils
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.extensions.package_install_files(filepath=os.environ["PLAIT_ZIP"], repo="user_default", enable_on_install=True)
    assert NAME in bpy.context.preferences.addons and all(registered())
    for _ in range(2):
        addon_utils.disable(NAME)
        assert not any(registered())
        addon_utils.enable(NAME)
        assert all(registered())


def it_bakes_with_its_own_library():
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=False)
    body = characters.link("body", characters.body_mesh())
    hair = characters.hair(body, 20)
    bpy.context.scene.frame_start, bpy.context.scene.frame_end = 1, 5
    bpy.context.view_layer.objects.active = hair
    bpy.ops.wm.save_as_mainfile(filepath=os.path.abspath("installed.blend"))
    assert bpy.ops.plait.bake() == {"FINISHED"}
    assert os.path.isfile("installed_hair.abc")
    mapped = {line.split()[-1] for line in open("/proc/self/maps") if "libplait" in line}
    assert mapped and all("/extensions/user_default/plait_hair/lib/" in path for path in mapped), mapped


def the_preferences_name_another():
    bpy.context.preferences.addons[NAME].preferences.library = "/nowhere/libplait.so"
    try:
        bpy.ops.plait.bake()
    except RuntimeError as error:
        print(error)
        assert "/nowhere/libplait.so" in str(error) and "preferences" in str(error)
    else:
        raise AssertionError("was baked")


code = 1
try:
    for test in (it_is_installed_and_bakes, it_bakes_with_its_own_library, the_preferences_name_another):
        print(f"-- {test.__name__}", flush=True)
        test()
    code = 0
finally:
    if code:
        import traceback
        traceback.print_exc()
    sys.stdout.flush()
    os._exit(code)
