#!/usr/bin/env python3
"""Mortise on the two scenes of spheres.py. Prints a JSON line.

    pip install numpy
    mortise_spheres.py build/mortise --problem balloon|hill --degree 4 --n 2 --m 2 [--tied] [--steps 1] [--set SECTION/NAME=VALUE] [--keep DIRECTORY]

--tied: two bodies that meet at r = 1.5 without matching, the inner one with n, the outer one with n + 1 cells along an edge, and m / 2 layers
each. The error is the program's own errors/displacement_h1, of a second run with the Exact solution of spheres.py, which is not timed. cpu: the
whole process, which writes no fields; cpu_solve: without that of `mortise --version`, which is the start-up of the program and its libraries;
wall_solve: the program's own total."""
import argparse
import json
import os
import subprocess
import tempfile
import time

import spheres


def scene(o):
    parts = [("inner", 1, 1.5, o.n), ("outer", 1.5, 2, o.n + 1)] if o.tied else [("shell", 1, 2, o.n)]
    lines = ["set Bodies = " + ", ".join(p[0] for p in parts)] + ["set Interfaces = tie"] * o.tied
    for name, start, end, n in parts:
        lines += ["subsection Body " + name, "set Degree = %d" % o.degree, "set Body force = 0, 0, 0", "subsection Mesh", "set Source = shell octant", "set Extent = %g, %g" % (start, end)]
        lines += ["set Subdivisions = %d, %d" % (n, o.m // len(parts)), "set Cells = hexahedra", "end", "subsection Material"]
        if o.problem == "balloon":
            lines += ["set Law = neo-Hookean", "set Young modulus = %g" % (3 * spheres.MU), "set Poisson ratio = 0.5", "end"]
        else:
            lines += ["set Law = J2 plasticity", "set Young modulus = %g" % spheres.YOUNG, "set Poisson ratio = %g" % spheres.POISSON, "set Yield stress = %g" % spheres.YIELD, "end"]
        held = [("xmin", "Displacement = 0, -, -"), ("ymin", "Displacement = -, 0, -"), ("zmin", "Displacement = -, -, 0")]
        if start == 1:
            held.append(("inside", "Displacement = x*t, y*t, z*t" if o.problem == "balloon" else "Pressure = %.16g*t" % spheres.PRESSURE["hill"]))
        for boundary, what in held:
            lines += ["subsection Boundary " + boundary, "set " + what, "end"]
        lines += ["end"]
    if o.tied:
        lines += ["subsection Interface tie", "set Slave = outer: inside", "set Master = inner: outside", "end"]
    return lines + ["subsection Steps", "set Step = %.16g" % (1 / o.steps), "set End time = 1", "end", "subsection Output", "set Fields =", "set Resultants = bore: %s: inside" % parts[0][0], "end"]


def exact(o):
    """Settings of the exact solution."""
    r = "(x^2 + y^2 + z^2)"
    if o.problem == "balloon":
        stretch = "(1 + 7/%s^1.5)^(1/3)" % r  # r / R
        outside = spheres.OUTER_GROWN / spheres.OUTER
        factor = stretch + " - 1"
        # sigma_r + 2/3 (sigma_t - sigma_r), mu = 1
        pressure = "%.17g - 2/(%s) - 0.5/(%s)^4 - 2/3*((%s)^2 - (%s)^(-4))" % (2 / outside + 0.5 / outside**4, *[stretch] * 4)
        settings = ["Exact solution/Pressure=" + pressure]
    else:
        k, cube = (1 - 2 * spheres.POISSON) / spheres.YOUNG, spheres.YIELD * spheres.FRONT**3 / spheres.YOUNG
        rest = "/%s^1.5" % r
        inside = "%.17g*(%.17g + log(%s)*%.17g) + %.17g%s" % (k, -spheres.PRESSURE["hill"], r, spheres.YIELD, (1 - spheres.POISSON) * cube, rest)
        outside = "%.17g + %.17g%s" % (k * 2 * spheres.YIELD * spheres.FRONT**3 / 3 / spheres.OUTER**3, (1 + spheres.POISSON) * cube / 3, rest)
        factor = "if(%s < %.17g, %s, %s)" % (r, spheres.FRONT**2, inside, outside)
        settings = []
    return ["Exact solution/Displacement=" + "; ".join("%s*(%s)" % (c, factor) for c in "xyz")] + settings


def run(o, name, directory, settings):
    """Seconds of the processor, of the wall, MB, the summary."""
    command = [o.mortise, "--output", directory, name] + [v for s in settings + o.set for v in ("--set", s)]
    start = time.perf_counter()
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    log = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    if status:
        raise RuntimeError(log[-400:])
    with open(os.path.join(directory, "summary.json"), encoding="utf-8") as f:
        return usage.ru_utime + usage.ru_stime, time.perf_counter() - start, usage.ru_maxrss / 1024, json.load(f)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("mortise")
    parser.add_argument("--problem", choices=("balloon", "hill"), default="balloon")
    parser.add_argument("--degree", type=int, default=4)
    parser.add_argument("--n", type=int, default=2)
    parser.add_argument("--m", type=int, default=2)
    parser.add_argument("--steps", type=int, default=1)
    parser.add_argument("--tied", action="store_true")
    parser.add_argument("--set", action="append", default=[])
    parser.add_argument("--keep")
    o = parser.parse_args()
    for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "DEAL_II_NUM_THREADS"):
        os.environ[variable] = "1"
    result = dict(code="Mortise", problem=o.problem, element="hex tied" if o.tied else "hex", order=o.degree, n=o.n, m=o.m, steps=o.steps)
    with tempfile.TemporaryDirectory() as temporary:
        directory = o.keep or temporary
        os.makedirs(directory, exist_ok=True)
        name = os.path.join(directory, "scene.prm")
        with open(name, "w", encoding="utf-8") as f:
            f.write("\n".join(scene(o)) + "\n")
        try:
            usage = os.wait4(subprocess.Popen([o.mortise, "--version"], stdout=subprocess.DEVNULL).pid, 0)[2]
            start_up = usage.ru_utime + usage.ru_stime
            cpu, wall, memory, summary = run(o, name, directory, [])
            steps = summary["steps"]
            result.update(unknowns=steps[-1]["dofs"]["total"], cells=sum(b["cells"] for b in steps[-1]["bodies"]), cpu=round(cpu, 3), cpu_solve=round(cpu - start_up, 3), wall=round(wall, 3), wall_solve=round(summary["timings_s"]["total"], 3),
                          memory_MB=round(memory), solves=len(steps), newton=sum(s["solver"]["newton_iterations"] for s in steps), linear=sum(s["solver"]["linear_iterations"] for s in steps))
            if o.problem == "balloon":
                result["error_pressure"] = abs(spheres.pressure_of(steps[-1]["quantities"]["bore"][0]) / spheres.PRESSURE["balloon"] - 1)
            errors = run(o, name, directory, exact(o))[3]["steps"][-1]["errors"]
            result["error"] = errors["displacement_h1"]
        except (RuntimeError, OSError, KeyError) as failure:
            result["failure"] = str(failure)[-300:]
    spheres.report(**result)


main()
