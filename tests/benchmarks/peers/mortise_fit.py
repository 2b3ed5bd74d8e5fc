#!/usr/bin/env python3
"""Mortise on the press fit of fit.py. Prints a JSON line.

    pip install numpy scipy
    mortise_fit.py --mortise build/mortise --p 3 --n 2 [--layers 1,1] [--sliding finite|small] [--set SECTION/NAME=VALUE]

The error is that of a second run, which is not timed and whose Points are those of a rule of integration. cpu_solve: the whole process, which writes no fields, without that of
`mortise --version`."""
import json
import math
import os
import subprocess
import tempfile
import time

import numpy as np

import fit
import spheres


def scene(o, points):
    lines = ["set Bodies = inner, outer", "set Interfaces = fit"]
    for k, (name, extent, n) in enumerate((("inner", fit.INNER, o.n), ("outer", fit.OUTER, o.n + 1))):
        lines += ["subsection Body " + name, "set Degree = %d" % o.p, "subsection Mesh", "set Source = shell octant", "set Extent = %g, %g" % extent, "set Subdivisions = %d, %d" % (n, o.m[k]), "set Cells = hexahedra", "end"]
        lines += ["subsection Material", "set Law = neo-Hookean", "set Young modulus = %g" % fit.YOUNG, "set Poisson ratio = %g" % fit.POISSON, "end"]
        for c in range(3):
            lines += ["subsection Boundary %smin" % "xyz"[c], "set Displacement = " + ", ".join("0" if d == c else "-" for d in range(3)), "end"]
        lines += ["end"]
    lines += ["subsection Interface fit", "set Slave = inner: outside", "set Master = outer: inside", "set Law = contact", "set Sliding = " + o.sliding, "end"]
    lines += ["subsection Output", "set Fields =", "set Resultants = " + "; ".join("%s%s: inner: %smin" % ("r", c, c) for c in "xyz")]
    return lines + ["set Points = " + "; ".join("q%d: %s: %.15g, %.15g, %.15g" % (k, ("inner", "outer")[body], *x) for k, (body, x) in enumerate(points))] * bool(points) + ["end"]


def sample(order=4):
    """(body, point) of a rule on both balls, and the weights."""
    rule = [((g + 1) / 2, w / 2) for g, w in zip(*np.polynomial.legendre.leggauss(order))]
    points, weights = [], []
    for body, (start, end) in enumerate((fit.INNER, fit.OUTER)):
        for (a, wa), (b, wb), (c, wc), f in ((i, j, k, f) for i in rule for j in rule for k in rule for f in range(3)):
            s, t, r = math.tan(math.pi / 4 * a), math.tan(math.pi / 4 * b), start + (end - start) * c
            points.append((body, np.roll(np.array([1, s, t]) * r / math.sqrt(1 + s * s + t * t), f)))
            weights.append(wa * wb * wc * (end - start) * r * r * (1 + s * s) * (1 + t * t) / (1 + s * s + t * t)**1.5)
    return points, np.array(weights)


def run(mortise, arguments, directory):
    """Usage and wall of the process, its summary, and the end of its output where it failed."""
    start = time.perf_counter()
    process = subprocess.Popen(["timeout", "300", mortise, "--output", directory] + arguments, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    log = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    wall = time.perf_counter() - start
    try:
        with open(os.path.join(directory, "summary.json"), encoding="utf-8") as f:
            summary = json.load(f)
    except OSError:
        summary = None
    return usage, wall, summary, log[-300:] if status else None


def main():
    o = fit.arguments(mortise="build/mortise", sliding="finite", set=[])
    result = dict(code="Mortise", order=o.p, n=o.n, layers=o.layers, method="pairs that stay" if o.sliding == "small" else "", set=", ".join(o.set))
    points, weights = sample()
    with tempfile.TemporaryDirectory() as directory:
        summaries = []
        for given in ([], points):
            with open(os.path.join(directory, "scene.prm"), "w", encoding="utf-8") as f:
                f.write("\n".join(scene(o, given)) + "\n")
            usage, wall, summary, failure = run(o.mortise, [f.name] + [v for s in o.set for v in ("--set", s)], directory)
            if not given:
                empty = os.wait4(subprocess.Popen([o.mortise, "--version"], stdout=subprocess.DEVNULL).pid, 0)[2]
                result.update(fit.child_times(usage, wall, empty.ru_utime + empty.ru_stime))
            if failure:
                spheres.report(failure=failure, **result)
                return
            summaries.append(summary)
    step, exact = summaries[1]["steps"][-1], fit.Exact()
    result.update(unknowns=step["dofs"]["total"], newton=sum(s["solver"]["newton_iterations"] for s in summaries[0]["steps"]))
    u = [step["quantities"]["q%d" % k] for k in range(len(points))]
    lost = np.array([len(v) != 3 for v in u])  # outside the straight cells of degree 1
    u, weights = np.array([v if len(v) == 3 else [0, 0, 0] for v in u]), np.where(lost, 0, weights)
    right = np.array([exact.displacement(b, np.linalg.norm(x)) / np.linalg.norm(x) * x for b, x in points])
    result["error"] = math.sqrt(weights @ ((u - right)**2).sum(axis=1) / (weights @ (right**2).sum(axis=1)))
    result["error_pressure"] = exact.pressure_error([step["quantities"]["r" + c][k] for k, c in enumerate("xyz")])
    result["error_pressure_max"] = abs(step["interfaces"][0]["contact"]["pressure_max"] * (fit.INNER[1] / exact.c)**2 / exact.p - 1)
    spheres.report(**result)


if __name__ == "__main__":
    main()
