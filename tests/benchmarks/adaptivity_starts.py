#!/usr/bin/env python3
"""Targets from starts that are drawn by lot: adaptivity_starts.py --binary MORTISE [--beside MORTISE] [--number N] [--seed S] [--jobs J]

Bodies of all generators with meshes, degrees, strategies, materials, boundary conditions and exact fields that are drawn; the exact
solution tells the error of a run that says that its target is met. Prints runs whose error is above the target, and the seconds of
the processor beside those of another binary on the same starts. --write FILE: starts, one a line, as tests/scenes/adaptivity_starts
reads them. --nonlinear: those of nonlinear_starts.py. --steps: in four load steps, in which smooth fields move."""
import argparse
import concurrent.futures
import functools
import json
import math
import os
import random
import re
import resource
import statistics
import subprocess
import sys
import tempfile
import time

from processor import openblas

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
BOX_SIDES = ("xmin", "xmax", "ymin", "ymax", "zmin", "zmax")
SHELL_SIDES = {"shell octant": ("inside", "outside", "xmin", "ymin", "zmin"), "cylinder sector": ("inside", "outside", "xmin", "ymin", "zmin", "zmax")}
SECONDS = 40  # of one run


def amount(value):
    return f"{value:.6g}"


def near(x):
    """A coordinate in brackets, from which others are taken."""
    return f"({amount(x)})"


def smooth(lot, lower, upper):
    centre = [lot.uniform(a, b) for a, b in zip(lower, upper)]
    size = max(b - a for a, b in zip(lower, upper))
    kind = lot.choice(["waves", "even waves", "one wave", "gauss", "pole", "layer", "front", "polynomial"])
    axes = ["x", "y", "z"]
    if kind == "waves":
        k = [lot.uniform(0.5, 6.0) / size for _ in range(6)]
        return kind, [f"sin({amount(k[0])}*x+{amount(k[1])}*y)*cos({amount(k[2])}*z)", f"cos({amount(k[3])}*x)*sin({amount(k[4])}*y+{amount(k[5])}*z)",
                      f"exp({amount(k[0])}*x/4)*sin({amount(k[2])}*y)*cos({amount(k[4])}*z)"]
    if kind == "even waves":
        a, n = lot.choice(axes), lot.choice([1, 2, 3, 4])
        f = f"{lot.choice(['sin', 'cos'])}({n}*pi*{a}/{amount(size)})"
        return kind, [f if c == lot.randrange(3) or c == 0 else "0" for c in range(3)]
    if kind == "one wave":
        return kind, [f"sin({amount(lot.uniform(1., 6.) / size)}*{lot.choice(axes)})", "0", "0"]
    distance = "+".join(f"({a}-{near(c)})^2" for a, c in zip(axes, centre))
    weights = [amount(lot.uniform(-1., 1.)) for _ in range(3)]
    if kind == "gauss":
        width = size * lot.uniform(0.15, 0.6)
        return kind, [f"{w}*exp(-({distance})/{amount(width ** 2)})" for w in weights]
    if kind == "pole":
        outside = [upper[i] + size * lot.uniform(0.05, 0.5) if lot.random() < 0.5 else lower[i] - size * lot.uniform(0.05, 0.5) for i in range(3)]
        r = "+".join(f"({a}-{near(c)})^2" for a, c in zip(axes, outside))
        return kind, [f"{w}/sqrt({r})" for w in weights]
    if kind == "layer":
        d = lot.randrange(3)
        return kind, [f"{w}*exp(-({axes[d]}-{near(lower[d])})/{amount(size * lot.uniform(0.05, 0.5))})" for w in weights]
    if kind == "front":
        n = [lot.gauss(0., 1.) for _ in range(3)]
        length = math.sqrt(sum(v * v for v in n))
        line = "+".join(f"{amount(v / length)}*({a}-{near(c)})" for v, a, c in zip(n, axes, centre))
        return kind, [f"{w}*tanh(({line})/{amount(size * lot.uniform(0.1, 0.5))})" for w in weights]
    p = lot.randint(2, 7)
    return kind, [f"{w}*({'+'.join(f'{amount(lot.uniform(-1., 1.))}*{a}' for a in axes)}+0.3)^{p}" for w in weights]


def singular(lot, at, inwards):
    """Infinite stresses at a point or along an edge through it; the body is on the side of the direction."""
    power = lot.uniform(0.35, 1.6)
    weights = [amount(lot.uniform(-1., 1.)) for _ in range(3)]
    x, y, z = (f"({a}-{near(c)})" for a, c in zip("xyz", at))
    if lot.random() < 0.6:
        return "point", [f"{w}*({x}^2+{y}^2+{z}^2)^{amount(power / 2)}" for w in weights]
    # antiplane: no force on the volume
    power = lot.uniform(0.4, 0.95)
    a, b = inwards
    along, across = f"({a}*{x}+{b}*{y})", f"({a}*{y}-{b}*{x})"
    return "edge", ["0", "0", f"({x}^2+{y}^2)^{amount(power / 2)}*cos({amount(power)}*atan2({across},{along}))"]


def material(lot):
    return [f"Material/Young modulus={amount(10. ** lot.uniform(-1., 3.))}", f"Material/Poisson ratio={lot.choice(['0', '0.2', '0.3', '0.3', '0.3', '0.45', '0.4999'])}"]


def degrees(lot, centre, size):
    p = lot.choice([1, 1, 1, 1, 2, 2, 3, 3, 4, 5, 6])
    result = [f"Degree={p}"]
    if lot.random() < 0.2:
        ball = ", ".join(amount(c + size * lot.uniform(-0.5, 0.5)) for c in centre)
        result.append(f"Degree near={ball}, {amount(size * lot.uniform(0.1, 0.5))}, {lot.choice([1, 6, p + 1 if p < 7 else p])}")
    return result


def graded(lot, at, size):
    if lot.random() > 0.25:
        return []
    return ["Mesh/Refine near=" + ", ".join(amount(c) for c in at) + f", {amount(size * lot.choice([1e-6, 0.2]))}, {lot.choice([1, 1, 2])}"]


def conditions(lot, sides, must_hold=()):
    """Displacements on one at least, tractions on others, symmetry nowhere."""
    held = set(must_hold) | {lot.choice(sides)}
    held |= {side for side in sides if lot.random() < lot.choice([0.2, 0.5, 0.9])}
    return [f"Boundary {side}/{'Displacement' if side in held else 'Traction'}=exact" for side in sides]


def of_body(name, settings):
    return [f"Body {name}/{setting}" for setting in settings]


def cubes(lot, sides, most):
    return ", ".join(str(lot.randint(1, most)) for _ in range(sides))


def as_tetrahedra(settings):
    return [s for s in settings if not s.startswith("Mesh/Refine near")] + ["Mesh/Cells=tetrahedra"]


def into(corner):
    """From a corner of a box that begins at the origin."""
    return tuple(-1 if c > 0. else 1 for c in corner[:2])


def one_box(lot):
    upper = [lot.choice([1., 1., 2., 0.5]) for _ in range(3)]
    corner = [lot.choice([0., u]) for u in upper]
    field = smooth(lot, [0.] * 3, upper) if lot.random() < 0.65 else singular(lot, corner, into(corner))
    settings = ["Mesh/Extent=0, 0, 0, " + ", ".join(amount(u) for u in upper), f"Mesh/Subdivisions={cubes(lot, 3, lot.choice([1, 2, 3]))}"]
    settings += material(lot) + degrees(lot, [u / 2 for u in upper], max(upper)) + graded(lot, corner, max(upper)) + conditions(lot, BOX_SIDES, BOX_SIDES if field[0] in ("edge",) else ())
    if lot.random() < 0.15:
        settings = as_tetrahedra(settings)
    elif lot.random() < 0.15:
        settings += [f"Mesh/Distort={amount(lot.uniform(0.05, 0.25))}"]
    return "box", field, ["Bodies=b"] + of_body("b", settings)


def two_boxes(lot):
    middle = lot.choice([0.5, 1. / 3., 0.25])
    corner = [lot.choice([0., 1.]) for _ in range(2)] + [lot.choice([0., middle, 1.])]
    field = smooth(lot, [0.] * 3, [1.] * 3) if lot.random() < 0.65 else singular(lot, corner, into(corner))
    shared = material(lot)
    result = ["Bodies=b0, b1", "Interfaces=i"]
    stiff = shared
    if lot.random() < 0.4:  # no strain, and so no traction, where materials meet
        field = (field[0], [f"({c})*(z-{near(middle)})^2" for c in field[1]])
        stiff = [f"Material/Young modulus={amount(10. ** lot.uniform(-2., 4.))}", lot.choice(shared[1:])]
    for b, (low, high, mine) in enumerate(((0., middle, shared), (middle, 1., stiff))):
        sides = [side for side in BOX_SIDES if side != ("zmin" if b else "zmax")]
        settings = [f"Mesh/Extent=0, 0, {low:.17g}, 1, 1, {high:.17g}", f"Mesh/Subdivisions={cubes(lot, 3, lot.choice([1, 3, 3, 8]))}"] + mine
        settings += degrees(lot, [0.5, 0.5, (low + high) / 2], 1.) + graded(lot, corner, 1.) + conditions(lot, sides, sides if field[0] == "edge" else ())
        if lot.random() < 0.1:
            settings = as_tetrahedra(settings)
        result += of_body(f"b{b}", settings)
    slave = lot.randrange(2)
    sides = ("b0: zmax", "b1: zmin")
    return "two boxes", field, result + [f"Interface i/Slave={sides[slave]}", f"Interface i/Master={sides[1 - slave]}", f"Interface i/Multiplier={lot.choice(['standard', 'dual'])}"]


def fichera(lot):
    power = lot.uniform(0.35, 1.4)
    size = 10. ** lot.uniform(-3., 0.)
    c = [size * lot.uniform(-1., 1.) for _ in range(3)]
    young, nu = 10., lot.choice([0.2, 0.3, 0.4])
    mu, lam = young / 2 / (1 + nu), young * nu / (1 + nu) / (1 - 2 * nu)
    free = f"(x^2 + y^2)^{near(power / 2 - 1)}"
    part = [f"{amount(mu * power * c[2])}*x*{free}", f"{amount(mu * power * c[2])}*y*{free}", f"{amount(lam * power)}*({amount(c[0])}*x+{near(c[1])}*y)*{free}"]
    traction = "; ".join(f"if(x > 0, if(y > 0, {t}, 0), 0)" for t in part)
    field = ("corner", [f"{amount(v)}*(x^2+y^2+z^2)^{amount(power / 2)}" for v in c])
    p = lot.choice([1, 1, 2, 3, 4, 5])
    lower = ["Mesh/Extent=-1, -1, -1, 1, 1, 0", "Mesh/Subdivisions=" + lot.choice(["2, 2, 1", "2, 2, 1", "4, 4, 2", "2, 2, 2"])] + graded(lot, [0.] * 3, 1.)
    lower += [f"Boundary {side}/Displacement=exact" for side in BOX_SIDES[:5]] + [f"Boundary zmax/Traction={traction}", f"Degree={p}"]
    upper = ["Mesh/Source=file", "Mesh/File=meshes/l_shape.msh"] + graded(lot, [0.] * 3, 1.)
    upper += [f"Boundary {side}/Displacement=exact" for side in ("sides", "zmax")] + ["Boundary inner sides/Traction=exact", f"Degree={lot.choice([p, p, lot.randint(1, 5)])}"]
    shared = [f"Material/Young modulus={young}", f"Material/Poisson ratio={nu}"]
    result = ["Bodies=b0, b1", "Interfaces=i"] + of_body("b0", lower + shared) + of_body("b1", upper + shared)
    return "fichera", field, result + ["Interface i/Slave=b1: zmin", "Interface i/Master=b0: zmax"]


def l_shape(lot):
    field = smooth(lot, [-1., -1., 0.], [1., 1., 1.]) if lot.random() < 0.3 else singular(lot, [0., 0., lot.choice([0., 1.])], (-1, -1))
    settings = ["Mesh/Source=file", "Mesh/File=meshes/l_shape.msh"] + material(lot) + degrees(lot, [0.] * 3, 1.) + graded(lot, [0.] * 3, 1.)
    sides = ["sides", "inner sides", "zmin", "zmax"]
    return "L", field, ["Bodies=b"] + of_body("b", settings + conditions(lot, sides, sides if field[0] == "edge" else ()))


def shells(lot):
    source = lot.choice(["shell octant", "cylinder sector"])
    sphere = source == "shell octant"
    a, b, c = 1., lot.choice([1.2, 1.5]), 2.
    known = lot.random() < 0.4
    corner = [c, 0., 0.]
    field = ("thick sphere" if sphere else "thick cylinder", None) if known else (
        smooth(lot, [0.] * 3, [c, c, c if sphere else 0.5]) if lot.random() < 0.7 else singular(lot, corner, (-1, 1)))
    shared, other = material(lot), material(lot) if known else None
    result = ["Bodies=b0, b1", "Interfaces=i"]
    for k, radii in enumerate(((a, b), (b, c))):
        extent = f"Mesh/Extent={amount(radii[0])}, {amount(radii[1])}" + ("" if sphere else ", 0.5")
        settings = [f"Mesh/Source={source}", extent, f"Mesh/Subdivisions={cubes(lot, 2 if sphere else 3, 2)}"]
        settings += (other if known and k else shared) + degrees(lot, [radii[1], 0.5, 0.25], 1.) + graded(lot, corner if k else [b, 0., 0.], 0.5)
        if known:
            settings += ["Boundary xmin/Displacement=0, -, -", "Boundary ymin/Displacement=-, 0, -", "Boundary zmin/Displacement=-, -, 0"]
            settings += [] if sphere else ["Boundary zmax/Displacement=-, -, 0"]
            settings += [] if k else ["Boundary inside/Pressure=1"]
        else:
            sides = [side for side in SHELL_SIDES[source] if side != ("inside" if k else "outside")]
            settings += conditions(lot, sides, sides if field[0] == "edge" else ())
        result += of_body(f"b{k}", settings)
    slave = lot.randrange(2)
    sides = ("b0: outside", "b1: inside")
    return source, field, result + [f"Interface i/Slave={sides[slave]}", f"Interface i/Master={sides[1 - slave]}"]


GENERATORS = (one_box, one_box, two_boxes, two_boxes, fichera, l_shape, shells)


def point_in(lot, settings):
    """Of a start: one of its bodies and a point in it, now and then one on its boundary or at a corner."""
    body = lot.choice([s for s in settings if s.startswith("Bodies=")][0][7:].split(", "))
    of = dict(s.removeprefix(f"Body {body}/").split("=", 1) for s in settings if s.startswith(f"Body {body}/"))
    part = [lot.choice([0., 1.]) if lot.random() < 0.15 else lot.uniform(0.02, 0.98) for _ in range(3)]
    extent = [float(v) for v in of.get("Mesh/Extent", "-1, -1, 0, 1, 1, 1").split(",")]
    source = of.get("Mesh/Source")
    if source in SHELL_SIDES:
        radius = extent[0] + part[0] * (extent[1] - extent[0])
        angle, height = part[1] * math.pi / 2, part[2] * math.pi / 2 if source == "shell octant" else 0.
        return body, [radius * math.cos(height) * math.cos(angle), radius * math.cos(height) * math.sin(angle),
                      radius * math.sin(height) if source == "shell octant" else part[2] * extent[2]]
    point = [extent[c] + part[c] * (extent[3 + c] - extent[c]) for c in range(3)]
    if source == "file" and point[0] > 0. and point[1] > 0.:  # what the L lacks
        point[lot.randrange(2)] *= -1.
    return body, point


@functools.lru_cache(64)
def compiled(expression):
    return compile(expression.replace("^", "**"), "expression", "eval")


def value_at(expression, point):
    names = {name: getattr(math, name) for name in ("sin", "cos", "exp", "tanh", "sqrt", "atan2", "pi")}
    return eval(compiled(expression), {**names, **dict(zip("xyz", point))})


def moving(lot, components, axes):
    """The same field, moved by up to 0.3 along each of the axes from step to step."""
    shift = {axis: f"({axis}-{near(lot.uniform(-0.3, 0.3))}*(t-1))" if axis in axes else axis for axis in "xyz"}
    return [re.sub(r"\b[xyz]\b", lambda found: shift[found.group()], c) for c in components]


def start(seed, number, quantity=False, nonlinear=False, steps=False):
    """Name, settings and, with a quantity, its exact value of one start; its target is drawn as a part of its first error."""
    lot = random.Random(f"{seed} {number}")
    if nonlinear:
        from nonlinear_starts import GENERATORS as generators  # which takes bodies and fields from here
    else:
        generators = GENERATORS
    name, (field, components), settings = lot.choice(generators)(lot)
    if components is None:
        settings.append(f"Exact solution/Displacement={field}")
    else:
        scale = 1. if nonlinear or name == "fichera" else 10. ** lot.uniform(-3., 0.)
        settings.append("Exact solution/Displacement=" + "; ".join(f"{amount(scale)}*({c})" for c in components))
    if steps:
        settings.append("Steps/Step=1, 2, 3, 4")
        if components is not None and field not in ("point", "edge", "corner") and "plastic" not in name:  # whose loads depend on the path
            settings[-2] = "Exact solution/Displacement=" + "; ".join(f"{amount(scale)}*({c})" for c in moving(lot, components, "xy" if name == "two boxes" else "xyz"))
    strategy = lot.choice(["hp", "hp", "hp", "h", "p"])
    settings += [f"Adaptivity/Strategy={strategy}", "Output/Fields="]
    part, exact = 10. ** lot.uniform(-1.1, -0.05), None
    if quantity and components is not None:
        (body, point), c = point_in(lot, settings), lot.randrange(3)
        settings += [f"Output/Points=point: {body}: " + ", ".join(f"{v:.17g}" for v in point), f"Adaptivity/Quantity=point, {'xyz'[c]}"]
        values = [value_at(f"{amount(scale)}*({f})", point) for f in components]
        exact = (c, values[c]) if abs(values[c]) > 0.01 * max(abs(v) for v in values) else None
    return f"{seed}.{number}: {name}, {field}, {strategy}", settings, part, exact


def run(binary, settings, work, seconds=SECONDS):
    """Exit code, seconds of the processor, summary and log."""
    scene = os.path.join(work, "scene.prm")
    with open(scene, "w") as file:
        file.write("# all by settings\n")
    command = [binary, "--output", work]
    for setting in settings:
        command += ["--set", setting]
    before = time.time()
    with open(os.path.join(work, "log"), "w+") as log:
        process = subprocess.Popen(command + [scene], stdout=log, stderr=subprocess.STDOUT, cwd=TOP,
                                   env={**os.environ, **openblas(), "OMP_NUM_THREADS": "1", "DEAL_II_NUM_THREADS": "1"})
        used = None
        while used is None:
            pid, status, usage = os.wait4(process.pid, os.WNOHANG)
            if pid:
                used = usage.ru_utime + usage.ru_stime
            elif time.time() - before > 4 * seconds:
                process.kill()
                os.wait4(process.pid, 0)
                return None, seconds, None, "too long"
            else:
                time.sleep(0.01)
        code = os.waitstatus_to_exitcode(status)
        log.seek(0)
        text = log.read()
    summary = None
    if code in (0, 3):
        with open(os.path.join(work, "summary.json")) as file:
            summary = json.load(file)
    return code, used, summary, text


def error_of(step, exact):
    """In the energy or, where an exact value is given, of that component of the point."""
    if exact is None:
        return step["errors"]["energy"]
    component, value = exact
    return abs(dict(step["quantities"])["point"][component] / value - 1)


def cycles(summary, exact):
    return [{"step": step.get("step", 1), "unknowns": step["dofs"]["total"], "error": error_of(step, exact), "estimate": step["adaptivity"].get("estimate")} for step in summary["steps"]]


def measure(arguments):
    binaries, seed, number, unknowns, idle, quantity, nonlinear, steps = arguments
    name, settings, part, exact = start(seed, number, quantity, nonlinear, steps)
    if quantity and exact is None:
        return {"name": name, "skipped": "no exact value, or one of nearly zero"}
    settings.append(f"Adaptivity/Largest number of unknowns={unknowns}")
    with tempfile.TemporaryDirectory() as work:
        # the first mesh tells what there is to be won
        code, _, summary, log = run(binaries[0], [s for s in settings if not s.startswith("Adaptivity")], work)
        if code == 2 and "finds no cell" in log:
            return {"name": name, "skipped": "a ball beside the body"}
        if code != 0:
            return {"name": name, "skipped": f"first mesh: exit {code}", "log": log[-600:]}
        if exact and not dict(summary["steps"][-1]["quantities"])["point"]:
            return {"name": name, "skipped": "a point beside the first mesh"}
        first, size = error_of(summary["steps"][-1], exact), summary["steps"][-1]["dofs"]["total"]
        target = min(0.9, max(1e-6, first * part))
        if not first > 1e-8 or size > 0.4 * unknowns:
            return {"name": name, "skipped": f"{size} unknowns, error {first:.1e}"}
        result = {"name": name, "target": target, "settings": settings + [f"Adaptivity/Target error={amount(target)}"], "runs": []}
        for binary in binaries:
            code, used, summary, log = run(binary, result["settings"], work)
            one = {"code": code, "seconds": max(1e-3, used - idle)}
            if summary:
                one["cycles"] = cycles(summary, exact)
            if code not in (0, 3):
                one["log"] = log[-600:]
            result["runs"].append(one)
    return result


def worst(one):
    """Of the last cycles of the steps that met their target, that with the largest error."""
    ends = one["cycles"] if one["code"] == 0 else [c for c in one["cycles"] if c["step"] < one["cycles"][-1]["step"]]
    return max({c["step"]: c for c in ends}.values(), key=lambda c: c["error"], default=None)


def false(one, target):
    end = worst(one) if one.get("cycles") else None
    return end is not None and end["error"] > target


def report(results, binaries):
    for k, binary in enumerate(binaries):
        ended = [r for r in results if "runs" in r]
        met = [r for r in ended if r["runs"][k]["code"] == 0]
        wrong = [r for r in ended if false(r["runs"][k], r["target"])]
        codes = sorted({str(r["runs"][k]["code"]) for r in ended})
        print(f"{binary}: {len(ended)} starts, exit codes " + ", ".join(f"{c}: {sum(str(r['runs'][k]['code']) == c for r in ended)}" for c in codes) + f"; false at exit 0 or in a step before: {len(wrong)}")
        for r in sorted(wrong, key=lambda r: -worst(r["runs"][k])["error"] / r["target"]):
            last = worst(r["runs"][k])
            print(f"  FALSE {r['name']}: target {r['target']:.2e}, error {last['error']:.2e} ({last['error'] / r['target']:.2f} times), estimate {last['estimate']:.2e}")
        if met:
            parts = sorted(worst(r["runs"][k])["error"] / r["target"] for r in met)
            print(f"  error by target: median {statistics.median(parts):.2f}, largest {parts[-1]:.2f}; seconds: {sum(r['runs'][k]['seconds'] for r in ended):.0f}")
    if len(binaries) == 2:
        both = [r for r in results if "runs" in r and all(one["code"] == 0 for one in r["runs"])]
        right = [r for r in both if not false(r["runs"][1], r["target"])]
        for what, of in (("both met", both), ("both met, and the other right", right)):
            if of:
                ratios = sorted(r["runs"][0]["seconds"] / r["runs"][1]["seconds"] for r in of)
                print(f"  seconds by those of {binaries[1]}, {what} ({len(of)}): median {statistics.median(ratios):.2f}, mean {statistics.mean(ratios):.2f}, nine of ten below {ratios[int(0.9 * len(ratios))]:.2f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--binary", required=True)
    parser.add_argument("--beside")
    parser.add_argument("--number", type=int, default=100)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--unknowns", type=int, default=20000, help="the largest number in a run")
    parser.add_argument("--quantity", action="store_true", help="targets are those of a displacement at a point")
    parser.add_argument("--nonlinear", action="store_true", help="starts of nonlinear_starts.py")
    parser.add_argument("--steps", action="store_true", help="several load steps, in which smooth fields move")
    parser.add_argument("--only", help="numbers of starts, separated by commas")
    parser.add_argument("--json", help="a file for all that was measured")
    parser.add_argument("--write", help="a file for the starts whose targets were met soon")
    given = parser.parse_args()
    binaries = [os.path.abspath(b) for b in (given.binary, given.beside) if b]
    with tempfile.TemporaryDirectory() as work:  # libraries take longer than a small scene
        idle = statistics.median(run(binaries[0], ["Bodies="], work)[1] for _ in range(5))
    numbers = [int(n) for n in given.only.split(",")] if given.only else range(given.first, given.first + given.number)
    results = []
    with concurrent.futures.ProcessPoolExecutor(given.jobs) as pool:
        for result in pool.map(measure, [(binaries, given.seed, n, given.unknowns, idle, given.quantity, given.nonlinear, given.steps) for n in numbers]):
            results.append(result)
            for one in result.get("runs", []):
                if one["code"] not in (0, 3):
                    print(f"  exit {one['code']}: {result['name']}: {one.get('log', '')}", flush=True)
            if result.get("log"):
                print(f"  {result['skipped']}: {result['name']}: {result['log']}", flush=True)
            if given.json:
                with open(given.json, "w") as file:
                    json.dump(results, file)
            if len(results) % 50 == 0:
                met = [r for r in results if "runs" in r and r["runs"][0]["code"] == 0]
                print(f"{len(results)} of {len(numbers)} starts, {len(met)} met their targets, "
                      f"{sum(bool(false(r['runs'][0], r['target'])) for r in met)} of them falsely", file=sys.stderr, flush=True)
    report(results, binaries)
    if given.write:
        with open(given.write, "w") as file:
            for r in results:
                if "runs" in r and r["runs"][0]["code"] == 0 and r["runs"][0]["seconds"] < 0.4:
                    file.write(" | ".join(r["settings"]) + "\n")
    return any(false(r["runs"][0], r["target"]) for r in results if "runs" in r)


if __name__ == "__main__":
    sys.exit(main())
