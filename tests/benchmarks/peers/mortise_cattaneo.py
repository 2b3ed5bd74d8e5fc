#!/usr/bin/env python3
"""Mortise on partial slip of Cattaneo and Mindlin (scene, meshes and formulas: cattaneo.py). The last line of stdout is a JSON line.

    pip install numpy scipy pyvista
    mortise_cattaneo.py build/mortise [--scene line|point] --n 48 --degree 2 [--normal 2] [--tangential 4] [--back 0] [--set "Solver/Friction=fixed point"] [--directory KEPT]

The meshes are those of cattaneo.py, but with the upper body flat: the gap is the Offset of the interface, so that it is the same for all degrees. One core.

Figures come from the field `traction` of the slave on y = 0 in the last step, a polynomial in each face that does the same work as the multipliers; for degree 1 from forces at nodes divided
by the integrals of their functions, as cattaneo.py has them for cells of 8 nodes. The point is evaluated for degree 1 alone. P and Q are the force on the upper boundary. iterations: linear solves of each
step; linear_iterations: those of conjugate gradients or GMRES in each step. cpu: seconds of the processor for the whole run with reading and writing of files; solve: those
of all solves as the log has them, wall time."""
import argparse
import glob
import json
import math
import os
import re
import resource
import subprocess
import sys
import tempfile
import time

import numpy as np
import pyvista

import cattaneo


def scene_file(o, directory):
    """Writes both meshes and the parameter file; returns its name."""
    own_gap, cattaneo.gap = cattaneo.gap, lambda scene, x, y: 0 * x
    cattaneo.write_msh(os.path.join(directory, "lower.msh"), o.scene, o.n, 1, False)
    cattaneo.write_msh(os.path.join(directory, "upper.msh"), o.scene, cattaneo.master_cells(o.n), 1, True)
    cattaneo.gap = own_gap
    d, s = cattaneo.SHIFT[o.scene]
    far = {"lower": "0, 0, 0", "upper": "%.10g*(max(0, min(1, (t - %d)/%d)) - 2*max(0, t - %d)/%d), 0, -%.10g*min(1, t/%d)" % (s, o.normal, o.tangential, o.normal + o.tangential, max(1, o.back), d, o.normal)}
    lines = ["set Bodies = lower, upper", "set Interfaces = touch"]
    for body in ("lower", "upper"):
        lines += ["subsection Body " + body, "set Degree = %d" % o.degree]
        lines += ["subsection Mesh", "set Source = file", "set File = %s.msh" % body, "end"]
        lines += ["subsection Material", "set Young modulus = %g" % cattaneo.YOUNG, "set Poisson ratio = %g" % cattaneo.POISSON, "end"]
        for boundary, held in [("far", far[body]), ("y0", "-, 0, -")] + [("y1", "-, 0, -")] * (o.scene == "line"):
            lines += ["subsection Boundary " + boundary, "set Displacement = " + held, "end"]
        lines += ["end"]
    lines += ["subsection Interface touch", "set Slave = lower: contact", "set Master = upper: contact", "set Law = contact", "set Offset = (x^2%s) / %g" % ("" if o.scene == "line" else " + y^2", 2 * cattaneo.RADIUS),
              "set Friction coefficient = %g" % cattaneo.FRICTION, "end"]
    lines += ["subsection Steps", "set Step = 1", "set End time = %d" % (o.normal + o.tangential + o.back), "end"]
    lines += ["subsection Output", "set Directory = " + directory, "set Fields = traction", "set Resultants = top: upper: far", "end"]
    name = os.path.join(directory, "scene.prm")
    with open(name, "w", encoding="utf-8") as f:
        f.write("\n".join(lines) + "\n")
    return name


def faces_of(directory):
    """x of the nodes on y = 0 of each face in ascending order (faces x nodes), and there the traction (3 each) and the status."""
    mesh = pyvista.read(sorted(glob.glob(os.path.join(directory, "touch_*.vtu")))[-1])
    rows = []
    for k in range(mesh.n_cells):
        ids = mesh.get_cell(k).point_ids
        ids = [i for i in ids if abs(mesh.points[i, 1]) < 1e-9]
        rows.append(sorted(ids, key=lambda i: mesh.points[i, 0]))
    rows = np.array(sorted(rows, key=lambda r: mesh.points[r[0], 0]))
    return np.float64(mesh.points[rows, 0]), np.nan_to_num(np.float64(mesh["traction"][rows])), np.nan_to_num(np.float64(mesh["status"][rows]))


def evaluate_point(directory, P, Q):
    """cattaneo.evaluate from forces at nodes of the fields of degree 1 on rectangles."""
    mesh = pyvista.read(sorted(glob.glob(os.path.join(directory, "touch_*.vtu")))[-1])
    ids = np.array([mesh.get_cell(k).point_ids for k in range(mesh.n_cells)])
    points, place = np.unique(np.round(mesh.points.astype(float), 7), axis=0, return_inverse=True)
    faces = place.ravel()[ids]
    area = np.prod(np.ptp(points[faces][..., :2], axis=1), axis=1)
    mass = np.array([[4, 2, 1, 2], [2, 4, 2, 1], [1, 2, 4, 2], [2, 1, 2, 4]]) / 36
    force, size, open_or_slip = np.zeros((len(points), 3)), np.zeros(len(points)), np.zeros(len(points), bool)
    np.add.at(force, faces, area[:, None, None] * np.einsum("nm,emk->enk", mass, np.nan_to_num(mesh["traction"].astype(float))[ids]))
    np.add.at(size, faces, area[:, None] / 4)
    open_or_slip[place.ravel()] = np.nan_to_num(mesh["status"]) < 1.5
    return cattaneo.evaluate("point", points, faces, force / size[:, None], P, Q, open_or_slip)


def divided_by_integrals(x, f):
    """Of degree 1: forces at nodes of the field f, divided by the integrals of their functions."""
    h = x[:, 1] - x[:, 0]
    force, size = np.zeros((len(x) + 1, f.shape[2])), np.zeros(len(x) + 1)
    for i in range(2):
        np.add.at(force, np.arange(len(x)) + i, h[:, None] * (2 * f[:, i] + f[:, 1 - i]) / 6)
        np.add.at(size, np.arange(len(x)) + i, h / 2)
    nodes = force / size[:, None]
    return np.stack([nodes[:-1], nodes[1:]], axis=1)


def evaluate(x, traction, status, P, Q):
    """The figures of cattaneo.evaluate for faces of any degree, by Gauss points in six parts of each face."""
    a, p0, c = cattaneo.hertz("line", P, Q)
    degree = x.shape[1] - 1
    pressure, shear = -traction[..., 2], traction[..., 0]
    shear = shear * (np.sign(shear.sum()) or 1)
    parts, (g, w) = 6, np.polynomial.legendre.leggauss(4)
    g, w = np.concatenate([(2 * k + 1 + g) / parts - 1 for k in range(parts)]), np.tile(w / parts, parts)
    nodes = np.linspace(-1, 1, degree + 1)
    value = np.stack([np.prod([(g - nodes[j]) / (nodes[i] - nodes[j]) for j in range(degree + 1) if j != i], axis=0) if degree else 1 + 0 * g for i in range(degree + 1)], axis=1)
    weight = w * (x[:, -1] - x[:, 0])[:, None] / 2
    r, p, t = abs(x @ value.T), pressure @ value.T, shear @ value.T
    p_exact = p0 * cattaneo.root(r, a)
    t_exact = cattaneo.FRICTION * (p_exact - p0 * c / a * cattaneo.root(r, c))

    def norm(f):
        return math.sqrt((weight * f * f).sum())

    def radius(inside):
        at = np.concatenate([x[:, :-1].ravel(), x[-1:, -1]])
        k = np.where(np.concatenate([inside[:, :-1].ravel(), inside[-1:, -1]]))[0]
        return float((at[k[-1]] + at[k[-1] + 1] - at[k[0]] - at[k[0] - 1]) / 4) if len(k) else 0.

    force, moment, force_t, moment_t = ((weight * f).sum() for f in (p, p * r**2, t, t * r**2))
    result = dict(P=P, Q=Q, load=Q / cattaneo.FRICTION / P, a=a, p0=p0, a_nodes=radius(status > 0.5), a_moment=math.sqrt(max(0., moment / force * 4)), error_pressure=norm(p - p_exact) / norm(p_exact),
                  force_from_pressure=force / P, p_max=pressure.max() / p0, spacing=float(np.diff(x).min()),
                  c_over_a=c / a, c_over_a_nodes=radius(status > 1.5) / (radius(status > 0.5) or 1), c_over_a_moment=max(0., 1 - moment_t / (cattaneo.FRICTION * moment))**(1 / 4),
                  error_shear=norm(t - t_exact) / norm(t_exact), force_from_shear=force_t / Q, shear_max=abs(shear).max() / cattaneo.FRICTION / p0, shear_max_exact=float(cattaneo.root(c, a)))
    return {k: float("%.6g" % v) for k, v in result.items()}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("mortise")
    parser.add_argument("--scene", choices=("line", "point"), default="line")
    parser.add_argument("--n", type=int, default=24)
    parser.add_argument("--degree", type=int, default=1)
    parser.add_argument("--normal", type=int, default=2)
    parser.add_argument("--tangential", type=int, default=4)
    parser.add_argument("--back", type=int, default=0, help="steps from s back to -s; figures are left out then")
    parser.add_argument("--set", action="append", default=[], help="passed on to mortise")
    parser.add_argument("--directory", help="where the files stay; without it they are deleted")
    o = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        directory = os.path.abspath(o.directory or temporary)
        os.makedirs(directory, exist_ok=True)
        command = [o.mortise, scene_file(o, directory)] + [v for s in o.set for v in ("--set", s)]
        start = time.perf_counter()
        run = subprocess.run(command, env=dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1"), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        seconds, usage = time.perf_counter() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
        if run.returncode not in (0, 3):
            sys.exit(run.stdout)
        with open(os.path.join(directory, "summary.json"), encoding="utf-8") as f:
            summary = json.load(f)
        steps = summary["steps"]
        solves = [text.count("  active set ") for text in re.split(r"^step \d+", run.stdout, flags=re.M)[1:]]
        iterations = [s["solver"]["linear_iterations"] for s in steps]
        result = dict(code=subprocess.run([o.mortise, "--version"], stdout=subprocess.PIPE, text=True, check=True).stdout.split(" (")[0].strip(), scene=o.scene, n=o.n, order=o.degree,
                      elements="hexahedra of degree %d" % o.degree, method="mortar, Newton" if not o.set else "; ".join(o.set), steps=[o.normal, o.tangential], unknowns=steps[-1]["dofs"]["displacement"],
                      multipliers=steps[-1]["dofs"]["multiplier"], seconds=round(seconds, 2), cpu=round(usage.ru_utime + usage.ru_stime, 2),
                      solve=round(sum(float(s) for s in re.findall(r"^  solve +([\d.]+) s", run.stdout, flags=re.M)), 2), memory_MB=round(usage.ru_maxrss / 1024),
                      iterations=[solves[:o.normal], solves[o.normal:]], linear_iterations=[iterations[:o.normal], iterations[o.normal:]], converged=run.returncode == 0)
        if run.returncode == 0 and not o.back:
            force = np.array(steps[-1]["quantities"]["top"]) * (1 / cattaneo.THICKNESS if o.scene == "line" else 2)
            if o.scene == "point":
                result.update(evaluate_point(directory, abs(force[2]), abs(force[0])) if o.degree == 1 else {})
                print(json.dumps(result))
                return
            x, traction, status = faces_of(directory)
            if o.degree == 1:
                traction = divided_by_integrals(x, traction)
            result.update(evaluate(x, traction, status, abs(force[2]), abs(force[0])))
        print(json.dumps(result))


main()
