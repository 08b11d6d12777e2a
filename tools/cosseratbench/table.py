"""Writes the results of cosseratbench, a folder of result.json files, as a page: table.py RESULTS PAGE."""

from __future__ import annotations

import json
import sys
from pathlib import Path

SOLVERS = ("plait", "mujoco", "pyelastica")
HEAD = """# A public benchmark of rods

Written by `./dev cosseratbench`, which runs [cosseratbench](https://github.com/jakeryderv/cosseratbench) {versions}, a
suite of rod problems with known answers, on plait's model `articulated` (`plait`) through the
C API, and on the solvers that it brings. Each solver chooses its own time step; the number of elements is the
benchmark's. Cells: the error that the problem measures, and seconds of wall time for one rod, start and reading
included, on {machine}.

"""
TAIL = """
Not run by plait, as the adapter says: what begins with a free end (`capstan`, `pile`), turns a clamped far end
(`twist`) or lets rods touch each other (`crossing`, `pile`): strands are held at their roots, a pin holds a place
and not a direction, and strands touch each other only through the grid.
"""


def load(folder: Path) -> list[dict]:
    found = sorted(folder.glob("*/default/*/result.json"))
    return [json.loads(path.read_text()) for path in found]


def cell(result: dict | None, metric: str) -> str:
    if result is None:
        return "not run"
    if result["outcome"] != "completed":
        return result["outcome"]
    return f"{result['metrics'][metric]:.2g} in {result['wall_time']:.1f} s"


def rows(results: list[dict]) -> list[str]:
    by_key = {(r["experiment"], r["solver"]): r for r in results}
    lines = []
    for experiment in dict.fromkeys(r["experiment"] for r in results):
        done = [r for r in results if r["experiment"] == experiment and r["metrics"]]
        if not any(r["solver"].startswith("plait") for r in done):
            continue
        for metric in done[0]["metrics"]:
            cells = (cell(by_key.get((experiment, solver)), metric) for solver in SOLVERS)
            lines.append(f"| {experiment}: {metric.replace('_', ' ')} | " + " | ".join(cells) + " |")
    return lines


def machine() -> str:
    for line in Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return "this machine"


def main(folder: str, page: str) -> None:
    results = load(Path(folder))
    if not results:
        sys.exit(f"{folder} has no results")
    versions = {r["solver"]: r["provenance"]["solver_version"] for r in results}
    named = ", ".join(f"{solver} {versions[solver]}" for solver in SOLVERS if solver in versions)
    text = HEAD.format(versions=f"({named})", machine=machine())
    text += "| | " + " | ".join(SOLVERS) + " |\n|---|" + "---:|" * len(SOLVERS) + "\n"
    text += "\n".join(rows(results)) + "\n" + TAIL
    Path(page).write_text(text)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
