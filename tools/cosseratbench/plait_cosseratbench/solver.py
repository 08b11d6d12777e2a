"""plait's inextensible rod and its stretching one as solvers. A strand is held at its root, so a rod
begins at one; its section is round, and it touches nothing here."""

from __future__ import annotations

import math

import numpy as np

from cosseratbench.scenario import End, EndCondition, Rod as RodSpec, Scenario, parallel_transport
from cosseratbench.solver import Capability, Diverged
from cosseratbench.trajectory import Trajectory

from plait_cosseratbench import api

# Fixed steps per second. Far more than a game takes, since what is compared here is accuracy.
RATE = 480


def _supported(scenario: Scenario) -> RodSpec:
    if len(scenario.rods) != 1:
        raise NotImplementedError("strands do not touch each other but through the grid")
    if scenario.obstacles:
        raise NotImplementedError("rods that touch something here have free ends, strands a root")
    if scenario.self_contact:
        raise NotImplementedError("strands do not touch themselves")
    rod = scenario.rods[0]
    if rod.start is EndCondition.FREE:
        raise NotImplementedError("a strand is held at its root")
    if rod.end is EndCondition.CLAMPED or rod.start_motion or rod.end_motion:
        raise NotImplementedError("of the far end a pin holds the place and not the direction")
    return rod


def _at_rest_length(rod: RodSpec, n_elements: int) -> np.ndarray:
    """The initial shape, each segment as long as it is without a load."""
    nodes = rod.nodes(n_elements)
    edges = np.diff(nodes, axis=0)
    edges *= rod.length / n_elements / np.linalg.norm(edges, axis=1, keepdims=True)
    return np.concatenate([nodes[:1], nodes[0] + np.cumsum(edges, axis=0)])


class _Plait:
    model: str
    stretches: bool

    def __init__(self, time_step_scale: float = 1.0) -> None:
        self._rate = RATE / time_step_scale

    @property
    def backend_version(self) -> str:
        return api.version()

    def settings(self, scenario: Scenario, *, n_elements: int, n_frames: int) -> dict:
        steps = self._steps_per_frame(scenario, n_frames)
        return {
            "model": self.model,
            "time_step": scenario.duration / (n_frames - 1) / steps,
            "integrator": "BDF2",
            "drag": self._drag(scenario),
        }

    def run(self, scenario: Scenario, *, n_elements: int, n_frames: int) -> Trajectory:
        rod = _supported(scenario)
        steps = self._steps_per_frame(scenario, n_frames)
        strand = api.Strand(
            _at_rest_length(rod, n_elements),
            scenario.duration / (n_frames - 1) / steps, 1,
        )
        try:
            return self._record(strand, scenario, rod, n_elements, n_frames, steps)
        finally:
            strand.close()

    def _steps_per_frame(self, scenario: Scenario, n_frames: int) -> int:
        return max(1, math.ceil(self._rate * scenario.duration / (n_frames - 1)))

    def _drag(self, scenario: Scenario) -> float:
        """1/s, of mass: what brings the slowest mode to rest at once, or none."""
        return 2.0 * scenario.slowest_frequency() if scenario.quasi_static else 0.0

    def _set_up(self, strand: api.Strand, scenario: Scenario, rod: RodSpec, n: int) -> None:
        line_density = rod.material.density * rod.area
        strand.set_params(
            gravity=scenario.gravity, drag=self._drag(scenario), bdf2=1, iterations=4
        )
        strand.set_material(
            line_density=line_density,
            bend_stiffness=rod.material.youngs_modulus * rod.second_moment_of_area,
            twist_stiffness=2.0 * rod.material.shear_modulus * rod.second_moment_of_area,
            stretch_stiffness=rod.material.youngs_modulus * rod.area,
            curl=0.0,  # straight without a load, whatever its first shape
            clamp_stiffness=0.0 if rod.start is EndCondition.PINNED else 1.0,
        )
        if rod.end is EndCondition.PINNED:
            strand.pin(n, rod.nodes(n)[-1])
        tip_mass = 0.5 * line_density * rod.length / n
        for load in rod.loads:
            if load.at is End.END:  # the root bears what pulls at it
                strand.accelerate(n, np.asarray(load.force) / tip_mass)

    def _record(self, strand, scenario, rod, n_elements, n_frames, steps) -> Trajectory:
        self._set_up(strand, scenario, rod, n_elements)
        times = np.linspace(0.0, scenario.duration, n_frames)
        frames = [rod.nodes(n_elements)]
        for time in times[1:]:
            strand.advance(steps)
            frames.append(strand.positions())
            if not np.all(np.isfinite(frames[-1])):
                raise Diverged("a vertex is not finite", float(time))
        normal = np.asarray(rod.normal, dtype=float)
        directors = np.stack([parallel_transport(nodes, normal) for nodes in frames])
        return Trajectory(times, (np.stack(frames),), (directors,))


class Articulated(_Plait):
    """The default: an inextensible rod."""

    name = "plait"
    model = "articulated"
    capabilities = frozenset()
