"""A bake: the scene's frames, one after another, through a simulation into a file."""
import contextlib

import bpy

from . import cache, capi, checks, params, shot
from .simulation import Mesh, Recorder, Simulation


def _set_params(simulation, settings):
    for param in params.TABLE:
        value = getattr(settings, param.name)
        ours = param.name in ("friction", "margin") or param.name == "volume_share" and not settings.keep_volume
        if not ours and value != param.default:
            simulation.set_param(param.name, params.library_values(param, value))


def _simulation(api, scene, hair, taken, device, kernels, stack):
    """The shot at rest: roots bound, bodies in place."""
    settings = hair.plait
    simulation = Simulation(api, hair.name, taken.counts, taken.points, shot.frame_seconds(scene),
                            settings.substeps, shot.gravity(scene), device, kernels)
    stack.callback(simulation.destroy)
    if settings.keep_volume:
        simulation.keep_volume()
    _set_params(simulation, settings)
    simulation.bind(taken.surface.rest, taken.surface.triangles)
    names = []
    for body in taken.bodies:
        mesh = Mesh(api, body.rest, body.triangles)
        stack.callback(mesh.destroy)
        checks.check_closed(body.name, mesh)
        names.append(simulation.add_body(mesh, settings.friction, settings.margin / 1e3, body.bends))
    return simulation, names


def _set_frame(simulation, names, taken, frame, use_wind, at_once=False):
    for name, body in zip(names, taken.bodies):
        simulation.move(name, body.place(frame))
    simulation.place_roots(taken.surface.positions(frame), at_once)
    air = shot.wind(taken.scene) if use_wind else None
    if air:
        simulation.set_wind(**air)


def bake(api, scene, hair, device="", kernels=""):
    """Bakes the scene's frames into cache.path(hair) and shows them; yields (frames done, of all) before each and at the
    end. A generator that is closed midway leaves no file, and one that was there before. Raises capi.Error."""
    found = checks.problems(scene, hair)
    if found:
        raise capi.Error(found[0])
    settings, file, present = hair.plait, cache.path(hair), scene.frame_current
    first, total = scene.frame_start, scene.frame_end - scene.frame_start + 1 + settings.preroll
    was_shown = cache.is_shown(hair)
    with contextlib.ExitStack() as stack:
        stack.callback(scene.frame_set, present)
        cache.show(hair, False)
        stack.callback(lambda: cache.show(hair, was_shown))
        yield 0, total
        scene.frame_set(first)
        taken = shot.Shot(scene, hair)
        checks.check_roots(hair, taken.root_distances, first)
        simulation, names = _simulation(api, scene, hair, taken, device, kernels, stack)
        recorder = Recorder(api, file, 1 / shot.metres(scene), 1 / shot.frame_seconds(scene), taken.widths)
        stack.callback(recorder.destroy)
        _set_frame(simulation, names, taken, first, settings.use_wind, at_once=True)
        for done in range(1, settings.preroll + 1):
            simulation.step()
            yield done, total
        for frame in range(first, scene.frame_end + 1):
            if frame > first:
                scene.frame_set(frame)
                _set_frame(simulation, names, taken, frame, settings.use_wind)
                simulation.step()
            recorder.add(simulation, frame * shot.frame_seconds(scene))
            yield settings.preroll + frame - first + 1, total
        cache.remove(hair)  # it reads the file that is replaced
        was_shown = True
        recorder.close()
        cache.attach(hair, file)


def bake_whole(*arguments, **words):
    """Without a window. Returns the number of frames."""
    for done, total in bake(*arguments, **words):
        pass
    return total
