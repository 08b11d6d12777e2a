"""What the oracles share: running clip_points, comparing numbers."""
import subprocess
import sys


def need(module):
    try:
        return __import__(module)
    except ImportError:
        print(f"skipped: {sys.executable} has no module {module}; set PLAIT_ORACLE_PYTHON to one that has")
        sys.exit(77)


def run(*words):
    text = subprocess.run(words, check=True, capture_output=True, text=True).stdout
    return [[float(word) for word in line.split()] for line in text.splitlines()]


def compare(what, found, expected, tolerance):
    assert len(found) == len(expected), f"{what}: {len(found)} numbers, {len(expected)} expected"
    worst = max((abs(a - b) for a, b in zip(found, expected)), default=0)
    print(f"{what}: {len(found)} numbers, the worst off by {worst:g}")
    assert worst <= tolerance, f"{what}: off by {worst:g}, allowed {tolerance:g}"
