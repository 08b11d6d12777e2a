"""The ten parameters that the panel shows: what the library calls them, and in which unit the panel has them.

Names, ranges, sliders and defaults are those of the library's table of parameters, times `factor`; tests/blender/library.py
compares them with it. Friction and margin are of the colliders, plait_collider_mesh_desc, which are not in that table.
"""
from typing import NamedTuple


class Param(NamedTuple):
    name: str  # of the library
    label: str
    unit: str  # of the panel
    factor: float  # from the library's unit to the panel's
    least: float
    most: float
    slider: tuple  # least and most of it
    default: float
    text: str


TABLE = (
    Param("bend_stiffness", "Bend Stiffness", "nN m²", 1e9, 0, 1e12, (0.1, 1e4), 4.7,
          "Larger: harder to bend, sags less, springs back faster. A hair of 70 um has 4.7; a lock that one curve stands for, "
          "as many times that as it has hairs which hold together"),
    Param("line_density", "Mass", "mg/m", 1e6, 1e-3, 1e9, (1, 1e3), 5,
          "Mass of a metre of it. Larger: sags more, and swings longer in the air. A hair has 5"),
    Param("stiffness_ramp", "Tip Stiffness", "", 1, 0, 100, (0, 2), 1,
          "Stiffness at the tip over that at the root. Below 1: softer towards the tip"),
    Param("clamp_stiffness", "Root Stiffness", "", 1, 0, 100, (0, 2), 1,
          "How firmly hair is held in the direction in which it leaves the skin; 0: by a hinge"),
    Param("curl", "Curl", "", 1, 0, 4, (0, 2), 1, "1: the groom's curls. Below: straighter; above: tighter"),
    Param("groom", "Keep Groom", "", 1, 0, 1, (0, 1), 0,
          "0: only its stiffness holds hair up. 1: hair stays in its groomed shape"),
    Param("drag", "Air Drag", "1/s", 1, 0, 1e4, (0, 20), 2,
          "How strongly still air brakes hair, while the scene has no wind field: a swing halves in 1.4 / this seconds"),
    Param("volume_share", "Density", "", 1, 0, 4, (0, 2), 1,
          "With Keep Volume. Below 1: fuller than the groom; above: hair may lie closer"),
    Param("friction", "Friction", "", 1, 0, 10, (0, 2), 0.3, "Between hair and bodies"),
    Param("margin", "Margin", "mm", 1e3, 0, 50, (0, 5), 0.5, "Hair stays so far outside of bodies"),
)


def library_values(param, shown):
    """What the library takes, all its components, for the value that the panel shows."""
    value = shown / param.factor
    if param.name == "stiffness_ramp":  # at the root, a third, two thirds, the tip
        return [1 + (value - 1) * third / 3 for third in range(4)]
    return [value]
