#!/usr/bin/env python3
"""Press fits, and what a rotation of one part changes in the other: press_fit.py MORTISE

A shell pressed into another, cylinder and sphere, that slide on each other. Writes doc/measurements/press_fit.md."""
import argparse
import json
import math
import os
import subprocess
import tempfile

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
BODIES = ("inner", "outer")
SIDES = {"xmin": "0, -, -", "ymin": "-, 0, -", "zmin": "-, -, 0", "zmax": "-, -, 0"}
CELLS = {  # of the inner and the outer part, n of the inner around a quarter
    "cylinder": lambda n: (f"{n}, {max(1, n // 2)}, 1", f"{3 * n // 2}, {max(1, n // 2)}, 1"),
    "sphere": lambda n: (f"{n}, {max(1, n // 2)}", f"{3 * n // 2}, {max(1, n // 2)}")}
MESHES = {"cylinder": {1: (8, 16, 32), 2: (4, 8, 16), 3: (4, 8), 4: (4, 8), 5: (2, 4), 6: (2, 4)},
          "sphere": {1: (4, 8, 16), 2: (2, 4, 8), 3: (2, 4), 4: (2, 4), 5: (2, 4), 6: (2, 4)}}


def scene(shape, outer_sides=None):
    """@outer_sides: displacement on the planes through the axis, symmetry if None."""
    text = ("set Bodies = inner, outer\nset Interfaces = fit\nsubsection Interface fit\n  set Slave = inner: outside\n  set Master = outer: inside\n"
            "  set Law = slide\n  set Offset = -0.01\nend\nsubsection Solver\n  set Tolerance = 1e-13\nend\n")
    for body, radii, modulus in zip(BODIES, ("1, 1.5", "1.5, 2"), (10, 4)):
        source, extent = ("cylinder sector", radii + ", 0.5") if shape == "cylinder" else ("shell octant", radii)
        text += (f"subsection Body {body}\n  subsection Mesh\n    set Source = {source}\n    set Extent = {extent}\n  end\n"
                 f"  subsection Material\n    set Young modulus = {modulus}\n    set Poisson ratio = 0.3\n  end\n")
        for side, symmetry in SIDES.items():
            if side == "zmax" and shape == "sphere":
                continue
            turned = body == "outer" and outer_sides and (shape == "sphere" or side[0] != "z")
            text += f"  subsection Boundary {side}\n    set Displacement = {outer_sides if turned else symmetry}\n  end\n"
        text += "end\n"
    return text


def run(mortise, text, shape, p, n, extra=()):
    with tempfile.TemporaryDirectory() as work:
        file = os.path.join(work, "scene.prm")
        with open(file, "w") as out:
            out.write(text)
        settings = [f"Body {b}/Degree={p}" for b in BODIES] + [f"Body {b}/Mesh/Subdivisions={s}" for b, s in zip(BODIES, CELLS[shape](n))]
        command = [mortise, file, "--output", work, "--set", "Output/Fields="]
        for setting in [*settings, *extra]:
            command += ["--set", setting]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        with open(os.path.join(work, "summary.json")) as summary:
            return json.load(summary)["steps"][-1]


def rates(mortise):
    yield ("\n| shape | p | n | dofs | L2 | rate | energy | rate | pressure | rate | iterations |\n" + "|---" * 11 + "|")
    for shape, meshes in MESHES.items():
        for p, sizes in meshes.items():
            before = None
            for n in sizes:
                step = run(mortise, scene(shape), shape, p, n, [f"Exact solution/Displacement=thick {shape}"])
                errors = [step["errors"][key] for key in ("displacement_l2", "energy", "multiplier_l2")]
                rate = [f"{math.log(a / b) / math.log(n / before[0]):.2f}" for a, b in zip(before[1], errors)] if before else [""] * 3
                columns = " | ".join(f"{e:.2e} | {r}" for e, r in zip(errors, rate))
                line = f"| {shape} | {p} | {n} | {step['dofs']['total']} | {columns} | {step['solver']['iterations']} |"
                print(line, flush=True)
                yield line
                before = n, errors


def turned(mortise, shape, cells, p, n, angle):
    """Displacement at a point of the inner part, the outer one's sides displaced and turned by @angle about the axis z."""
    r = "(x^2 + y^2)" if shape == "cylinder" else "(x^2 + y^2 + z^2)^1.5"
    sides = f"0.01*x/{r} - {angle}*y, 0.01*y/{r} + {angle}*x, " + ("-" if shape == "cylinder" else f"0.01*z/{r}")
    step = run(mortise, scene(shape, sides), shape, p, n,
               ["Output/Points=a: inner: 1.1, 0.5, 0.3", *(f"Body {body}/Mesh/Cells={cells}" for body in BODIES)])
    return step["quantities"]["a"]


def rotations(mortise):
    yield "\n| shape | cells | n | " + " | ".join(f"p = {p}" for p in (1, 2, 3, 4, 6, 8)) + " |\n" + "|---" * 9 + "|"
    for cells in ("hexahedra", "tetrahedra"):
        for shape, n in (("cylinder", 2), ("cylinder", 4), ("sphere", 2)):
            changes = ["-"] if cells == "tetrahedra" else []  # facets are no round surface: refused
            for p in (1, 2, 3, 4, 6, 8)[len(changes):]:
                before, after = (turned(mortise, shape, cells, p, n, angle) for angle in (0, 0.001))
                changes.append(f"{max(abs(a - b) for a, b in zip(after, before)) / max(map(abs, before)):.1e}")
            line = f"| {shape} | {cells} | {n} | " + " | ".join(changes) + " |"
            print(line, flush=True)
            yield line


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition(":")[0])
    parser.add_argument("mortise", help="the program")
    mortise = os.path.abspath(parser.parse_args().mortise)
    lines = ["# Press fits\n\nRegenerate: `tests/benchmarks/press_fit.py build/mortise`. A shell between the radii 1 and 1.5 pressed into one up to 2, "
             "0.01 too large,\n`Law = slide`, octant and quarter; `n` cells of the inner part around a quarter for 3 n / 2 of the outer one; exact "
             "solution of Lamé.\nTolerance 1e-13.", *rates(mortise),
             "\n## A rotation of the outer part\n\nBy 0.001 about the axis: how far it moves a point of the inner part, over what that point moves "
             "without. It would move nothing if\nmeshes held the circle and the sphere; they hold them to the order of the cells. Goal: below 1e-9.", *rotations(mortise)]
    with open(os.path.join(TOP, "doc", "measurements", "press_fit.md"), "w") as page:
        print(*lines, sep="\n", file=page)


if __name__ == "__main__":
    main()
