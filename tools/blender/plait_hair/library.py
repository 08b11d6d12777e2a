"""Where libplait is: where the preferences say, or inside the add-on."""
import pathlib
import sys

from . import capi

NAMES = {"linux": "libplait.so", "darwin": "libplait.dylib", "win32": "plait.dll"}

_loaded = {}  # path: Api. A library stays loaded as long as Blender runs


def path(given):
    """The library that will be loaded; `given`: that of the preferences, or ""."""
    if given:
        return pathlib.Path(given).absolute()
    return pathlib.Path(__file__).parent / "lib" / NAMES.get(sys.platform, NAMES["linux"])


def load(given=""):
    """The Api. Raises capi.Error, which says what to do."""
    file = path(given)
    if file not in _loaded:
        if not file.is_file():
            where = "The add-on holds no library for this system" if not given else "The preferences name a library that is not there"
            raise capi.Error(f"{where} ({file}); allowed is the path of a libplait of version "
                             f"{capi.VERSION[0]}.{capi.VERSION[1]}.x: give it in the add-on's preferences.")
        _loaded[file] = capi.Api(file)
    return _loaded[file]
