"""The ctypes side of the adapter, whose structs plait.h may outgrow: a strand that is held, loaded,
pinned, and found where theory has it. Exits with 77 where there is no numpy."""

import sys

try:
    import numpy as np
except ImportError:
    print("skipped: Python has no numpy")
    sys.exit(77)

from plait_cosseratbench import api


def cantilever() -> float:
    """Tip deflection over that of beam theory, F L^3 / (3 EI), of 20 segments."""
    n, length, line_density, bend, force = 20, 0.1, 1e-3, 1e-5, 1e-4
    points = np.zeros((n + 1, 3))
    points[:, 0] = np.linspace(0, length, n + 1)
    strand = api.Strand(points, 1 / 120, 1)
    strand.set_params(gravity=(0, 0, 0), drag=20.0, bdf2=1, iterations=2)
    strand.set_material(line_density=line_density, bend_stiffness=bend)
    strand.accelerate(n, np.array([0, -force / (0.5 * line_density * length / n), 0]))
    strand.advance(360)
    deflection = -strand.positions()[-1, 1]
    strand.close()
    return deflection / (force * length**3 / (3 * bend))


def pinned() -> float:
    """How far a pinned tip is from its pin under gravity, in lengths."""
    points = np.zeros((11, 3))
    points[:, 0] = np.linspace(0, 0.2, 11)
    target = np.array([0.15, 0.0, 0.0])
    strand = api.Strand(points, 1 / 60, 1)
    strand.pin(10, target)
    strand.advance(240)
    distance = np.linalg.norm(strand.positions()[-1] - target) / 0.2
    strand.close()
    return distance


def main() -> int:
    ratio, distance = cantilever(), pinned()
    print(f"cantilever: {ratio:.4f} of beam theory; pinned: {distance:.2e} lengths away")
    return 0 if abs(ratio - 1) < 0.01 and distance < 0.005 else 1


if __name__ == "__main__":
    sys.exit(main())
