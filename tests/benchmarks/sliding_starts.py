#!/usr/bin/env python3
"""sliding_starts.py MORTISE FIRST LAST: blocks of tests/field/block_slides_far.prm, drawn at random by the numbers FIRST to LAST - 1, of any size, modulus, mesh, degree, position, gap or
overlap at the start, compression up to a half, way and number of steps, on one to three processes. The homogeneous state is exact at all times: the pressure is E/2 (1/l - l), and nothing acts
along the base. Prints the draws that do not end well or that are wrong by more than 1e-6, and how many there are."""
import json
import math
import os
import random
import subprocess
import sys
import tempfile

from contact import on_ranks
from processor import openblas

SCENE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "field", "block_slides_far.prm")
SECONDS, TOLERANCE = 100, 1e-6


def rotated(vector, angles):
    """About the axes x, then y, then z, as Mesh/Rotate."""
    v = list(vector)
    for axis, angle in enumerate(angles):
        i, j = (axis + 1) % 3, (axis + 2) % 3
        c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
        v[i], v[j] = c * v[i] - s * v[j], s * v[i] + c * v[j]
    return v


def numbers(values):
    return ", ".join(f"{value:.15g}" for value in values)


def draw(number):
    """Settings, ranks, the size of the block's top, angles and the exact force on it."""
    lot = random.Random(number)
    size, young, angles = 10 ** lot.uniform(-3, 3), 10 ** lot.uniform(-3, 12), [lot.choice([0, lot.uniform(-180, 180)]) for _ in range(3)]
    compression, gap, side = lot.uniform(0.01, 0.5), lot.choice([0, 0, lot.uniform(0, 0.2), -lot.uniform(0, 0.05)]), lot.choice([0, lot.uniform(0, 0.2)])
    way, n = lot.uniform(0, 4), lot.randint(1, 12)
    ahead, down = rotated([size * way, 0, 0], angles), rotated([0, 0, -size * (compression + gap)], angles)
    steps = lot.choice([[1], [0.5, 1]]) + [1 + k / n for k in range(1, n + 1)]
    settings = ["Steps/Step=" + numbers(steps), "Output/Points=", "Output/Fields=", f"Body block/Material/Young modulus={young:.10g}", f"Body base/Material/Young modulus={young * 10 ** lot.uniform(-3, 3):.10g}",
                "Body block/Boundary zmax/Displacement=" + ", ".join(f"{a:.15g}*max(t - 1, 0) + {d:.15g}*min(t, 1)" for a, d in zip(ahead, down))]
    for body, extent, counts, degree in (("base", [0, 0, 0, 6.2, 1, 0.5], [lot.randint(3, 14), lot.randint(1, 4), 1], lot.randint(1, 3)),
                                         ("block", [0.1, side, 0.5 + gap, 1.1, 1 - side, 1.5 + gap], [lot.randint(1, 4), lot.randint(1, 4), lot.randint(1, 3)], lot.randint(1, 4))):
        settings += [f"Body {body}/Degree={degree}", f"Body {body}/Mesh/Extent=" + numbers(size * x for x in extent), f"Body {body}/Mesh/Subdivisions=" + numbers(counts),
                     f"Body {body}/Mesh/Cells=" + lot.choice(["hexahedra", "hexahedra", "tetrahedra"]), f"Body {body}/Mesh/Rotate=" + numbers(angles)]
    stretch = 1 - compression
    return settings, lot.choice([1, 1, 2, 3]), compression, angles, young / 2 * (1 / stretch - stretch) * size**2 * (1 - 2 * side)


def error(summary, angles, exact):
    """The largest one of the force on the top, beside the exact one, when it is pressed down."""
    back = [rotated(axis, angles) for axis in ([1, 0, 0], [0, 1, 0], [0, 0, 1])]
    return max(abs(sum(a * f for a, f in zip(axis, step["quantities"]["top"])) / exact + (c == 2))
               for step in summary["steps"] if step["time"] > 1 - 1e-9 for c, axis in enumerate(back))


def main(mortise, first, last):
    failed = wrong = 0
    for number in range(first, last):
        settings, ranks, compression, angles, exact = draw(number)
        with tempfile.TemporaryDirectory() as work:
            command = (on_ranks(ranks) if ranks > 1 else []) + ["timeout", str(SECONDS), mortise, "--output", work, SCENE] + [word for setting in settings for word in ("--set", setting)]
            code = subprocess.run(command, capture_output=True, env={**os.environ, **openblas(), "OMPI_MCA_mpi_yield_when_idle": "1"}, check=False).returncode
            if code == 0:
                with open(os.path.join(work, "summary.json")) as file:
                    off = error(json.load(file), angles, exact)
        failed += code != 0
        wrong += code == 0 and not off < TOLERANCE
        if code != 0 or not off < TOLERANCE:
            print(f"{number}: " + (f"exit code {code}" if code != 0 else f"off by {off:.1e}") + f", compression {compression:.2f}, {ranks} ranks", flush=True)
    print(f"{last - first} draws: {failed} do not end well, {wrong} are wrong")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(os.path.abspath(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3]))
