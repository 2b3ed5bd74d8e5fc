#!/usr/bin/env python3
"""Errors of numbers where the solution is singular and not known: adaptivity_singular.py MORTISE [--beside MORTISE_BEFORE]

Draws boxes, posts on feet, stacks and lap joints with random sizes, moduli and forces, whose edges and clamped ends make stresses infinite, and
asks for a displacement. The reference is of meshes with half the edges and degrees 4 and 5, from which the rest is extrapolated. Writes its part of
doc/measurements/adaptivity.md."""
import argparse
import concurrent.futures
import json
import os
import random
import re
import subprocess
import tempfile

from page import write_part

RATE = 2.2  # errors of displacements fall at least with this power of the degree at a clamped or a re-entrant edge
UNKNOWNS = 40000


def listed(numbers):
    return ", ".join(f"{number:g}" for number in numbers)


def boundary(name, what, value):
    return f"  subsection Boundary {name}\n    set {what} = {value}\n  end\n"


def body(lot, name, lower, upper, boundaries):
    return f"""subsection Body {name}
  set Degree = {lot.choice([1, 1, 2, 2, 3])}
  subsection Mesh
    set Source = box
    set Extent = {listed(list(lower) + list(upper))}
    set Subdivisions = {listed(lot.randint(1, 3) for _ in range(3))}
  end
  subsection Material
    set Young modulus = {10**lot.uniform(3, 5.5):g}
    set Poisson ratio = {lot.choice([0., 0.2, 0.3, 0.33, 0.45])}
  end
{boundaries}end
"""


def force(lot):
    components = [0., 0., 0.]
    while not any(components):
        components = [lot.uniform(-100, 100) if lot.random() < 0.6 else 0. for _ in range(3)]
    return "; ".join(f"{c:.3g}" for c in components)


CLAMPED = ("Displacement", "0, 0, 0")


def one_box(lot):
    size = [lot.uniform(0.5, 2), lot.uniform(0.5, 2), lot.uniform(0.5, 3)]
    points = {"p": ("a", (size[0] * lot.uniform(0.1, 0.9), size[1] * lot.uniform(0.1, 0.9), size[2])),
              "q": ("a", (size[0] / 2, size[1] / 2, size[2] * lot.uniform(0.3, 0.9)))}
    return "set Bodies = a\n" + body(lot, "a", (0, 0, 0), size, boundary("zmin", *CLAMPED) + boundary("zmax", "Force", force(lot))), points


def two_boxes(lot, kind):
    x, y, z = lot.uniform(1, 3), lot.uniform(1, 3), lot.uniform(0.3, 1.5)
    lower, upper = (0., 0.), (x, y)
    if kind == "post":
        lower, upper = (x * lot.uniform(0.1, 0.35), y * lot.uniform(0.1, 0.35)), (x * lot.uniform(0.6, 0.9), y * lot.uniform(0.6, 0.9))
    elif kind == "lap joint":
        lower, upper = (x * lot.uniform(0.3, 0.6), 0.), (x * lot.uniform(1.3, 2.), y)
    held, pulled = ("xmin", "xmax") if kind == "lap joint" else ("zmin", "zmax")
    top = z + lot.uniform(0.5, 3)
    sides = ["b: zmin", "a: zmax"]
    if kind != "post" and lot.random() < 0.5:
        sides.reverse()
    text = "set Bodies = a, b\nset Interfaces = tie\n" + body(lot, "a", (0, 0, 0), (x, y, z), boundary(held, *CLAMPED))
    text += body(lot, "b", (*lower, z), (*upper, top), boundary(pulled, "Force", force(lot)))
    text += f"subsection Interface tie\n  set Slave = {sides[0]}\n  set Master = {sides[1]}\nend\n"
    points = {"p": ("b", (*(a + (b - a) * lot.uniform(0.1, 0.9) for a, b in zip(lower, upper)), top)),
              "q": ("a", (x * lot.uniform(0.2, 0.8), y * lot.uniform(0.2, 0.8), z * lot.uniform(0.4, 0.9)))}
    return text, points


def scene(seed, number):
    lot = random.Random(f"{seed}/{number}")
    kind = lot.choice(["box", "post", "stack", "lap joint"])
    text, points = one_box(lot) if kind == "box" else two_boxes(lot, kind)
    text += "subsection Output\n  set Fields =\n  set Points = " + "; ".join(f"{name}: {of}: {listed(p)}" for name, (of, p) in points.items()) + "\nend\n"
    return kind, text, lot.choice("ppq"), lot.randrange(3), lot.choice([5e-2, 3e-2, 1e-2, 5e-3])


def run(binary, text, settings=()):
    """Exit code and summary, which a scene that is refused has not."""
    with tempfile.TemporaryDirectory() as work:
        with open(os.path.join(work, "scene.prm"), "w") as file:
            file.write(text)
        command = [binary, os.path.join(work, "scene.prm"), "--output", work]
        code = subprocess.run(command + [part for setting in settings for part in ("--set", setting)],
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=600).returncode
        if code == 2:
            return code, None
        if code not in (0, 3):
            raise RuntimeError(f"exit code {code} of\n{text}")
        with open(os.path.join(work, "summary.json")) as file:
            return code, json.load(file)


def reference(binary, text, name):
    """All components, and how far they are not known."""
    finer = re.sub(r"Subdivisions = (\d+), (\d+), (\d+)", lambda m: "Subdivisions = " + listed(max(3, 2 * int(n)) for n in m.groups()), text)
    of = [run(binary, re.sub(r"Degree = \d", f"Degree = {p}", finer))[1]["steps"][-1]["quantities"][name] for p in (4, 5)]
    rest = [(fine - coarse) / ((5 / 4)**RATE - 1) for coarse, fine in zip(*of)]
    return [fine + more for fine, more in zip(of[1], rest)], [abs(more) for more in rest]


def measure(arguments):
    """Of each binary: exit code, error less what the reference may be wrong by, and estimate; None where the number is small or a scene refused."""
    binaries, seed, number = arguments
    kind, text, name, c, target = scene(seed, number)
    exact, unsure = reference(binaries[0], text, name)
    if abs(exact[c]) < 1e-3 * max(map(abs, exact)):
        return None
    results = []
    for binary in binaries:
        code, summary = run(binary, text, [f"Adaptivity/Target error={target}", f"Adaptivity/Quantity={name}, {'xyz'[c]}",
                                           f"Adaptivity/Largest number of unknowns={UNKNOWNS}"])
        if summary is None:
            return None
        last = summary["steps"][-1]
        error = max(0., abs(last["adaptivity"]["value"] - exact[c]) - unsure[c]) / abs(exact[c])
        results.append((code, error, last["adaptivity"].get("estimate")))
    return f"{seed}/{number}, {kind}", target, results


def row(name, measured, k):
    met = [(target, results[k]) for _, target, results in measured if results[k][0] == 0]
    ratios = sorted(estimate / max(error, 1e-12) for _, (_, error, estimate) in met)
    parts = [error / target for target, (_, error, _) in met]
    quantile = [f"{ratios[int(part * len(ratios))]:.2g}" for part in (0.1, 0.5, 0.9)]
    return f"| {name} | {len(measured)} | {len(met)} | {sum(part > 1 for part in parts)} | {max(parts):.2g} | " + " | ".join(quantile) + " |"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("mortise")
    parser.add_argument("--beside")
    parser.add_argument("--seed", default="271828")
    parser.add_argument("--number", type=int, default=150)
    arguments = parser.parse_args()
    binaries = [os.path.abspath(binary) for binary in (arguments.mortise, arguments.beside) if binary]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        measured = [m for m in pool.map(measure, [(binaries, arguments.seed, n) for n in range(arguments.number)]) if m]
    for name, target, results in measured:
        for binary, (code, error, estimate) in zip(binaries, results):
            if code == 0 and error > target:
                print(f"{binary}: {name}: target {target:g}, error {error:.2e}, estimate {estimate:.2e}")
    rows = [row("now", measured, 0)] + [row("before residuals were looked at", measured, 1)] * (len(binaries) - 1)
    write_part("adaptivity.md", "singular", TEXT.format(seed=arguments.seed, number=arguments.number, unknowns=f"{UNKNOWNS:,}", rows="\n".join(rows)))


TEXT = """## Numbers where stresses are infinite

Regenerate: `tests/benchmarks/adaptivity_singular.py build/mortise --beside BEFORE --seed {seed} --number {number}` writes this section.

Boxes, posts on feet, stacks and lap joints of random sizes, moduli and forces have clamped and re-entrant edges. The target, 0.5 to 5 %, is that of a
displacement at a point; runs end at {unknowns} unknowns. The reference has half the edges and degrees 4 and 5; errors are those beyond what it may be
wrong by. Numbers below a thousandth of the displacement, and scenes that are refused since a coarse slave holds too little, are left out.

| estimate | numbers | met | error above target | largest error by target | estimate by error, 10 % | 50 % | 90 % |
|---|---|---|---|---|---|---|---|
{rows}

Before, estimates knew the changes of a number alone. After one refinement of degree one or two they took the solution for smooth.
"""

if __name__ == "__main__":
    main()
